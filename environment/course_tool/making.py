"""Makes `.venv` with Python's own venv module, and knows when one is to be made again."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Mapping

from course_tool import checks, failures, running
from course_tool.layout import Layout
from course_tool.messages import say

# Without `site`, so that nothing installed in the environment has a say.
_WHO = "import sys; print('%d.%d' % sys.version_info[:2], sys.base_prefix)"


def make_or_keep(layout: Layout, environ: Mapping[str, str]) -> None:
    """Leave a usable `.venv` as it is; make it, or make it again, otherwise."""
    reason = why_unusable(layout, environ)
    if reason is None:
        return
    checks.before_making_venv()
    if os.path.lexists(layout.venv):
        say(f"  .venv {reason}; it is made again")
        remove(layout)
    say("  1/4  making .venv")
    make(layout, environ)


def why_unusable(layout: Layout, environ: Mapping[str, str]) -> str | None:
    """Return why a `.venv` cannot be used, as the end of a sentence, or None if it can.

    One without a stamp was interrupted. Which of its packages are whole cannot be told, and from
    the installer's cache a new one takes seconds.
    """
    if not os.path.lexists(layout.python) or not layout.stamp.exists():
        return "is not finished"
    who = running.quiet([layout.python, "-I", "-S", "-c", _WHO], environ, timeout=30)
    if not who.ok:
        return "has a Python that does not run"
    version, _, base = who.text.strip().partition(" ")
    if version != "{}.{}".format(*sys.version_info[:2]) or not _same(base, sys.base_prefix):
        return f"belongs to another Python ({version}, {base})"
    return None if str(layout.venv) in _activate_script(layout) else "was made in another place"


def make(layout: Layout, environ: Mapping[str, str]) -> None:
    """Make a new `.venv`."""
    result = running.quiet([sys.executable, "-I", "-m", "venv", layout.venv], environ)
    if result.ok:
        return
    if "ensurepip" in result.text:
        raise checks.venv_module_missing()
    raise failures.installing(result.text, layout.venv)


def remove(layout: Layout) -> None:
    """Remove `.venv`; of a link, only the link."""
    try:
        if layout.venv.is_symlink() or layout.venv.is_file():
            layout.venv.unlink()
        else:
            shutil.rmtree(layout.venv)
    except OSError as error:
        raise checks.not_writable(layout.venv, error.strerror or str(error)) from None


def _activate_script(layout: Layout) -> str:
    try:
        return (layout.venv / "bin" / "activate").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def _same(one: str, other: str) -> bool:
    return os.path.realpath(one) == os.path.realpath(other)
