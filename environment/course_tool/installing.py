"""Fills an environment from a lock: uv (through pip), all else (through uv), and what is ours.

Ours is what makes `.venv` an underlay, as a ROS of the system is one: `source .venv/setup.bash`
activates it. The files that ament's templates make would put the packages of `.venv` on PYTHONPATH,
where every other Python would find them, and do not work in a folder with a space.
"""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

from course_tool import running
from course_tool.layout import COURSE_ROS, Layout
from course_tool.problems import Problem, last_lines, say, status_line

# Runs at the start of every Python of the environment. `_rosbeat_environment` is a link to
# src/rosbeat/environment.py: a broken `rosbeat` must not disturb, so the package is not imported.
_AT_START = (
    "import sys; exec('try:\\n import _rosbeat_environment as e; e.apply()\\n"
    "except Exception:\\n pass')\n"
)
_HOOK = "zz_rosbeat_environment.pth"
#: The name of the course's kernel, in the launcher and on pages.
KERNEL = "ROS 2 (rosbeat)"
#: Files of JupyterLab, by their places in `.venv`. No question about news at the first start, no
#: look-up of newer versions, room for the names of files. What tests bring along stays off, so that
#: JupyterLab is as learners know it, and so does what they do not need: jupytext's kinds of pages,
#: and kernels from elsewhere, which have no ROS. `zz_course.json`: of files that say different
#: things, the last one in the alphabet counts.
_LAB_FILES = Path(__file__).with_name("lab_files")
#: Makes every kernel of an environment bring the names of the course (`rosbeat.page_names`), also
#: one that an editor starts. Of IPython's settings, a person's own list of extensions replaces
#: another list, but not `extra_extensions`.
KERNEL_CONFIG = Path("etc", "ipython", "ipython_kernel_config.json")
_COMPLETIONS = {
    "ros2": ("ros2", "completion", "bash"),
    "colcon": ("register-python-argcomplete", "colcon"),
}
#: What pip knows, the variable that tells uv, and other variables that say the same.
_PIP_TO_UV = {
    "index-url": ("UV_DEFAULT_INDEX", "UV_INDEX_URL"),
    "cert": ("SSL_CERT_FILE",),
    "proxy": ("ALL_PROXY", "HTTPS_PROXY", "https_proxy", "all_proxy"),
    "trusted-host": ("UV_INSECURE_HOST",),
}


def fill(layout: Layout, level: str, environ: Mapping[str, str]) -> None:
    """Install what a level's lock says, and the course's own packages.

    Raises:
        Problem: If an installer stops.
    """
    say("  2/4  fetching uv, the installer")
    log = install_log(layout)
    log.unlink(missing_ok=True)
    install(uv_command(layout), _for_pip(environ), log)
    lock = layout.lock(level).read_text(encoding="utf-8")
    count = len(re.findall(r"^[\w.-]+==", lock, re.MULTILINE))
    say(f"  3/4  installing what {level}.lock lists ({count} packages at most)")
    env = for_installers(layout, environ)
    for command in (lock_command(layout, level), own_command(layout)):
        install(command, env, log)
    write_start_hook(layout)
    if layout.ros == COURSE_ROS:
        write_lab_defaults(layout)  # of other distributions, only the tests run
    write_underlay(layout, environ)


def install_log(layout: Layout) -> Path:
    """Return the file that keeps what the installers say: a line for each of 200 packages."""
    return layout.venv / "install.log"


def install(
    command: Sequence[str | Path], environ: Mapping[str, str], log: Path, cwd: Path | None = None
) -> None:
    """Run an installer; in a terminal, one line shows what it is doing.

    Args:
        command: The installer.
        environ: Its environment.
        log: The file that all it says is added to.
        cwd: Its current folder.

    Raises:
        Problem: If it stops.
    """
    said: list[str] = []
    with (
        log.open("a", encoding="utf-8") as kept,
        subprocess.Popen(
            command,
            env=dict(environ),
            cwd=cwd,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
        ) as process,
        status_line() as show,
    ):
        for line in process.stdout or ():
            said.append(line)
            kept.write(line)
            show(line)
    if process.returncode != 0:
        raise Problem(
            "The installer stopped.",
            "The environment is not complete yet; nothing of yours is touched.",
            "Run the same command again: it goes on where it stopped.\n"
            "The first start fetches about 200 packages (250 MB), and needs 1.5 GB of disk.\n"
            "Behind a proxy, set HTTPS_PROXY, and SSL_CERT_FILE if it has its own certificates.\n"
            "With an index of your own, set UV_DEFAULT_INDEX and PIP_INDEX_URL.\n"
            "No wheel for this platform: ROS 2 needs glibc 2.28; try ./environment/container\n"
            "If it stops again, remove the folder that it fills (.venv; for the tests on another\n"
            "distribution, .venv-kilted) and run the command once more.\n"
            f"All that it said is in {log}",
            last_lines("".join(said)),
        )


def uv_command(layout: Layout) -> list[str | Path]:
    """Return the command that installs uv with pip, if its locked version is not there yet."""
    return [
        *(layout.python, "-I", "-m", "pip", "install", "--quiet", "--require-hashes"),
        *("--only-binary", ":all:", "-r", layout.lock("bootstrap")),
    ]


def lock_command(layout: Layout, level: str) -> list[str | Path]:
    """Return the command that installs what a lock lists.

    Not `uv pip sync`: the ROS wheels carry .egg-info folders of their own, which a second sync
    takes for packages that nobody asked for, and removes `rclpy` with them.
    """
    return [
        *(layout.uv, "pip", "install", "--python", layout.python, "--require-hashes"),
        # The lock is complete, and leaves out one package that must not come (override.in).
        "--no-deps",
        # No compiler is needed: empy, one Python file, is the only package without a wheel.
        *("--only-binary", ":all:", "--no-binary", "empy"),
        *("--build-constraint", layout.lock("build"), "-r", layout.lock(level)),
    ]


def own_command(layout: Layout) -> list[str | Path]:
    """Return the command that installs the course's own packages, to be edited in place."""
    return [
        *(layout.uv, "pip", "install", "--python", layout.python, "--offline"),
        *("--no-deps", "--no-build-isolation"),
        *(part for folder in layout.own_packages for part in ("--editable", folder)),
    ]


def pip_settings(listing: str, environ: Mapping[str, str]) -> dict[str, str]:
    """Return the variables that tell uv what a person told pip: uv does not read that.

    Args:
        listing: What `pip config list` prints.
        environ: The environment; what it already tells uv is not changed.
    """
    found: dict[str, str] = {}
    for section in ("global", "install", ":env:"):  # the closer ones count
        for key, text in re.findall(rf"^{section}\.([a-z-]+)='(.*)'$", listing, re.MULTILINE):
            found[key] = " ".join(text.replace("\\n", " ").split())
    return {
        names[0]: found[key]
        for key, names in _PIP_TO_UV.items()
        if key in found and not any(environ.get(name) for name in names)
    }


def for_installers(layout: Layout, environ: Mapping[str, str]) -> dict[str, str]:
    """Return the environment in which uv installs: with what a person told pip."""
    env = _for_pip(environ)
    listing = running.quiet([layout.python, "-I", "-m", "pip", "config", "list"], env)
    return env | (pip_settings(listing.text, env) if listing.ok else {})


def _for_pip(environ: Mapping[str, str]) -> dict[str, str]:
    # pip's own default is five tries; without a network that only delays the message.
    return {"PIP_RETRIES": "2", **environ, "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PIP_USER": "0"}


# What is ours.


def write_ours(layout: Layout, environ: Mapping[str, str]) -> None:
    """Make an environment that pip has filled an underlay, for `rosbeat new`.

    Setup files that are there already, as conda brings them, stay as they are. So does an
    environment that this user may only read: there, `import rosbeat` sets the same for a page.
    """
    if not os.access(layout.site_packages, os.W_OK):
        return
    config = layout.venv / KERNEL_CONFIG
    if not config.exists():
        config.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(_LAB_FILES / KERNEL_CONFIG, config)
    hook, setup = layout.site_packages / _HOOK, layout.venv / "local_setup.bash"
    if setup.exists() and not hook.exists():
        return
    write_start_hook(layout)
    write_underlay(layout, environ)


def write_start_hook(layout: Layout) -> None:
    """Make every Python of the environment set what nodes need, before anything is imported."""
    link = layout.site_packages / "_rosbeat_environment.py"
    link.unlink(missing_ok=True)
    link.symlink_to(layout.settings)
    # "zz": .pth files run in this order, and ROS's own starts Python once more.
    hook = layout.site_packages / _HOOK
    hook.write_text(_AT_START, encoding="utf-8")


def write_lab_defaults(layout: Layout) -> None:
    """Make a first JupyterLab open without asking anything, and without what is for tests only."""
    for path in lab_files():
        target = layout.venv / path.relative_to(_LAB_FILES)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target)  # without the mode: the checkout may be read-only
    kernel = layout.venv / "share" / "jupyter" / "kernels" / "python3" / "kernel.json"
    if kernel.exists():  # its id stays python3, which every tool knows
        spec = json.loads(kernel.read_text(encoding="utf-8"))
        spec["display_name"] = KERNEL
        kernel.write_text(json.dumps(spec, indent=1) + "\n", encoding="utf-8")


def lab_files() -> list[Path]:
    """Return the files that say how JupyterLab and the course's kernel begin."""
    return sorted(_LAB_FILES.rglob("*.json"))


def underlay_templates() -> list[Path]:
    """Return the files that the underlay is made from."""
    return sorted(Path(__file__).with_name("underlay_files").iterdir())


def write_underlay(layout: Layout, environ: Mapping[str, str]) -> None:
    """Write the setup files of the prefix, and the completion of its commands."""
    places = {
        "@PREFIX@": layout.venv,
        "@PYTHON@": layout.python,
        "@ENVIRONMENT@": layout.settings,
        "@COMPLETIONS@": layout.completions,
    }
    for template in underlay_templates():
        text = template.read_text(encoding="utf-8")
        for mark, place in places.items():
            text = text.replace(mark, shlex.quote(str(place)))
        # Nothing lies under this underlay, so its setup.* have nothing to add to its local_setup.*.
        for name in (template.name, template.name.removeprefix("local_")):
            (layout.venv / name).write_text(text, encoding="utf-8", errors="surrogateescape")
    # Each command is asked once how bash completes it: at the start of a shell that takes too long.
    layout.completions.mkdir(parents=True, exist_ok=True)
    inside = running.inside(environ, layout)
    for name, (program, *arguments) in _COMPLETIONS.items():
        answer = running.quiet([layout.venv / "bin" / program, *arguments], inside, timeout=60)
        if answer.ok:
            (layout.completions / name).write_text(answer.text, encoding="utf-8")
