"""Find packages in the ament index of `AMENT_PREFIX_PATH`, and read their interface definitions.

Neither needs ROS to be imported.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from pathlib import Path

from ros2_command.errors import CommandError
from ros2_command.names import did_you_mean

INDEX = Path("share", "ament_index", "resource_index", "packages")
SOURCE_FIRST = (
    "If you have built it in a workspace: run `source install/setup.bash` there, in this terminal."
)


def prefixes() -> list[Path]:
    """Return the prefixes to look in; the first one wins.

    The variable is set by `source .../setup.bash`. Without it there is still the environment that
    this Python lives in, if ROS is installed there.

    Raises:
        CommandError: If there is nowhere to look.
    """
    given = [Path(part) for part in os.environ.get("AMENT_PREFIX_PATH", "").split(":") if part]
    own = [path for path in [Path(sys.prefix)] if (path / INDEX).is_dir()]
    if not given and not own:
        raise CommandError(
            "Environment variable 'AMENT_PREFIX_PATH' is not set or empty",
            "The variable lists the folders of ROS packages, so without it no package can be "
            "found.",
            "Run `source install/setup.bash` in your workspace, in this terminal.",
        )
    return given or own


def all_packages() -> dict[str, Path]:
    """Return the prefix of every package, by name, sorted."""
    found: dict[str, Path] = {}
    for prefix in prefixes():
        folder = prefix / INDEX
        for entry in folder.iterdir() if folder.is_dir() else ():
            if not entry.name.startswith(".") and entry.is_file():
                found.setdefault(entry.name, prefix)
    return dict(sorted(found.items()))


def package_prefix(name: str, complaint: str = "Package '{}' not found") -> Path:
    """Return the prefix of one package.

    Args:
        name: The package.
        complaint: The first line of the error; verbs of the original differ here.

    Raises:
        CommandError: If there is no such package; the nearest name is suggested.
    """
    packages = all_packages()
    if name not in packages:
        raise CommandError(complaint.format(name), did_you_mean(name, packages, SOURCE_FIRST))
    return packages[name]


def executables(prefix: Path, name: str) -> list[Path]:
    """Return every file of a package that can be run, sorted by path."""
    folder = prefix / "lib" / name
    found = []
    for root, folders, files in os.walk(folder):
        folders[:] = [one for one in folders if not one.startswith(".")]
        found += [Path(root, file) for file in files]
    return sorted(path for path in found if os.access(path, os.X_OK) and path.is_file())


# Interface definitions.

INTERFACES = Path("share", "ament_index", "resource_index", "rosidl_interfaces")
#: The kinds in the order in which they are listed, with their headings.
KINDS = {"msg": "Messages", "srv": "Services", "action": "Actions"}
_SUFFIXES = tuple(f".{kind}" for kind in KINDS)


@dataclass(frozen=True, order=True)
class Interface:
    """Know where an interface is defined.

    Attributes:
        name: `pkg/kind/Name`.
        path: The file with its definition.
    """

    name: str
    path: Path

    @property
    def package(self) -> str:
        """Return the package that defines it."""
        return self.name.split("/")[0]

    @property
    def kind(self) -> str:
        """Return `msg`, `srv` or `action`."""
        return self.name.split("/")[1]


def package_interfaces(package: str, prefix: Path) -> list[Interface]:
    """Return the interfaces of a package, sorted; none if it defines none."""
    index = prefix / INTERFACES / package
    lines = index.read_text(encoding="utf-8").split() if index.is_file() else []
    found = set()
    for line in lines:
        path = Path(line)
        if len(path.parts) == 2 and path.parts[0] in KINDS and path.suffix == f".{path.parts[0]}":
            name = f"{package}/{path.parts[0]}/{path.stem}"
            found.add(Interface(name, prefix / "share" / package / path))
    return sorted(found)


def all_interfaces() -> list[Interface]:
    """Return every interface of every package, sorted by name."""
    found = [
        one
        for package, prefix in all_packages().items()
        for one in package_interfaces(package, prefix)
    ]
    return sorted(found)


def find_interface(name: str) -> Interface:
    """Find one interface by its full name, or by that with the suffix of its file.

    Raises:
        CommandError: If the name has another form, or there is none; the nearest is suggested.
    """
    found = {one.name: one for one in all_interfaces()}
    parts = name.split("/")
    if name.endswith(_SUFFIXES) and (with_suffix := found.get(name.rpartition(".")[0])):
        return with_suffix
    if len(parts) != 3 or not all(parts):
        short = [one for one in found if len(parts) == 2 and one.split("/")[::2] == parts]
        raise CommandError(
            f"Invalid name '{name}'. Expected three parts separated by '/'",
            f"Did you mean '{short[0]}'?" if short else did_you_mean(name, found),
        )
    if name not in found:
        prefix = package_prefix(parts[0], "Unknown package '{}'")
        raise CommandError(
            f"Could not find the interface '{prefix}/share/{name}.idl'", did_you_mean(name, found)
        )
    return found[name]


#: The types that are built into the language of definitions.
PRIMITIVES = frozenset(
    {
        *("bool", "byte", "char", "float32", "float64", "string", "wstring"),
        *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)),
    }
)


def nested_type(line: str, package: str) -> str | None:
    """Return the message type of a field that is itself a message, else None.

    Args:
        line: A line of a definition.
        package: The package that the definition belongs to.
    """
    words = line.split("#")[0].split()
    if len(words) < 2 or "=" in words[1] or words[1:2] == ["="]:
        return None
    base = words[0].split("[")[0].split("<=")[0]
    if base in PRIMITIVES:
        return None
    parts = base.split("/")
    if len(parts) == 1:
        # Headers may be written without their package.
        return f"{'std_msgs' if base == 'Header' else package}/msg/{base}"
    return f"{parts[0]}/msg/{parts[-1]}"


def show_lines(interface: Interface, comments: str = "top") -> list[str]:
    """Return the lines of a definition, with those of nested messages below their fields.

    Args:
        interface: What to show.
        comments: `all`, `none`, or `top` for those of the outermost definition.
    """
    known = {one.name: one for one in all_interfaces()}
    return _expand(interface, known, comments, comments != "none", 0)


def _expand(
    interface: Interface, known: dict[str, Interface], comments: str, keep: bool, level: int
) -> list[str]:
    lines = []
    for line in map(str.rstrip, interface.path.read_text(encoding="utf-8").splitlines()):
        text = line if keep else _without_comment(line)
        if not keep and not text:
            continue
        lines.append("\t" * level + text if text else text)
        inner = known.get(nested_type(line, interface.package) or "")
        if inner is not None:
            lines += _expand(inner, known, comments, comments == "all", level + 1)
    return lines


def _without_comment(line: str) -> str:
    """Return a line as the original shows it where comments are left out; empty if it has none.

    It leaves the mark of a comment at a line's end, and a comment that is indented or says nothing.
    """
    mark = line.find("#")
    comment = line[mark:].lstrip("#").strip() if mark >= 0 else ""
    if not comment or (mark and not line[:mark].strip()):
        return line
    return line[: line.index(comment, mark) - 1].strip() if mark else ""
