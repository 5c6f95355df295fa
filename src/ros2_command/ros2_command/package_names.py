"""Check whether names work for a Python package, a node's file or a dependency, and say why not."""

from __future__ import annotations

import keyword
import re
import sys
import sysconfig
from importlib.machinery import PathFinder
from pathlib import Path

from ros2_command.errors import CommandError

_DEPENDENCY = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")
# What colcon's reader of package.xml accepts.
_EMAIL = re.compile(
    r"[-\w%+]+(\.[-\w%+]+)*@[-a-zA-Z0-9%]+(\.[-a-zA-Z0-9%]+)*\.[a-zA-Z]{2,}", re.ASCII
)


# XML 1.0 cannot hold these, and neither can a file in UTF-8 hold halves of characters.
_UNWRITABLE = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_INDEX = "share/ament_index/resource_index/packages"


def _not_importable(name: str) -> str:
    """Return why Python cannot import a module of this name, or an empty string."""
    if not name:
        return "it is empty"
    if "-" in name:
        return "Python reads '-' as minus"
    if keyword.iskeyword(name):
        return f"'{name}' is a keyword of the Python language"
    if not name.isascii():
        return "only the letters a to z, digits and '_' are safe"
    if not name.isidentifier():
        return "it may contain only letters, digits and '_', and must not begin with a digit"
    return ""


def _tidy(name: str) -> str:
    """Return the name as it could have been meant."""
    tidy = re.sub(r"[^a-z0-9]+", "_", name.removesuffix(".py").lower()).strip("_")
    return tidy if tidy and not _not_importable(tidy) else ""


def check_package_name(name: str) -> None:
    """Refuse a name that cannot be imported, built or used beside Python's own modules.

    Raises:
        CommandError: With the reason, and a name that would work.
    """
    if name == "test":
        raise CommandError(
            "Aborted since 'ament_python' packages can't be named 'test'. "
            "Please choose a different package name."
        )
    reason = _not_importable(name)
    if not reason and name.startswith("_"):
        reason = "a package's name begins with a letter"
    if not reason and name in sys.stdlib_module_names:
        reason = f"Python's standard library has a module '{name}', and one would hide the other"
    if not reason and _comes_with_ros(name):
        reason = f"'{name}' is already installed with ROS 2, and one would hide the other"
    _refuse("a package", name, reason)


def _comes_with_ros(name: str) -> bool:
    """Return whether this installation, workspaces apart, has a package or module of a name."""
    if (Path(sys.prefix) / _INDEX / name).exists():
        return True
    return PathFinder.find_spec(name, [sysconfig.get_path("purelib")]) is not None


def check_module_name(kind: str, name: str) -> None:
    """Refuse a node or library name that cannot be the name of a module.

    Raises:
        CommandError: With the reason, and a name that would work.
    """
    reason = _not_importable(name)
    if not reason and name.startswith("__"):
        reason = "names that begin with two underscores are reserved for Python"
    _refuse(kind, name, reason)


def _refuse(kind: str, name: str, reason: str) -> None:
    if reason:
        tidy = _tidy(name)
        raise CommandError(
            f"Aborted! '{name}' cannot be the name of {kind}: {reason}.",
            f"Try '{tidy}'." if tidy and tidy != name else "Choose another name.",
        )


def check_dependency(name: str, package: str) -> None:
    """Refuse a dependency that cannot be a package's name, or is the package itself.

    Raises:
        CommandError: With the reason.
    """
    if not _DEPENDENCY.fullmatch(name):
        raise CommandError(f"Aborted! '{name}' cannot be the name of a package to depend on.")
    if name == package:
        raise CommandError(f"Aborted! The package '{name}' cannot depend on itself.")


def check_email(email: str) -> None:
    """Refuse an address for which the package could not be built.

    Raises:
        CommandError: With an example.
    """
    if not _EMAIL.fullmatch(email):
        raise CommandError(
            f"Aborted! '{email}' is not an email address, which package.xml requires.",
            "Give an address:  --maintainer-email you@example.com",
        )


def check_text(option: str, text: str) -> None:
    """Refuse a text that package.xml cannot hold.

    Raises:
        CommandError: If it has control characters, or bytes that are no text.
    """
    if _UNWRITABLE.search(text):
        raise CommandError(
            f"Aborted! The text of --{option} contains characters that package.xml does not "
            f"allow: {text!a}"
        )
