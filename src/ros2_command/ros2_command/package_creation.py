"""Implement `ros2 pkg create` for ament_python: check the arguments, and write the files."""

from __future__ import annotations

import getpass
import os
import re
import shlex
import subprocess
import sys
from argparse import Namespace
from collections.abc import Iterator, Sequence
from pathlib import Path

from ros2_command import package_templates as templates
from ros2_command.errors import CommandError
from ros2_command.package_names import (
    check_dependency,
    check_email,
    check_module_name,
    check_package_name,
    check_text,
)
from ros2_command.package_templates import LICENSES, NewPackage


def create(args: Namespace) -> None:
    """Make the package that the arguments of `ros2 pkg create` ask for.

    Raises:
        CommandError: If it cannot be made, or could not be built; nothing is made then.
    """
    if args.license == "?":
        print("\n".join(["Supported licenses:", *LICENSES]))
        return
    destination, name = args.destination_directory, args.package_name
    _check_place(Path(destination), name)
    if args.build_type != "ament_python":
        raise CommandError(
            f"Build type '{args.build_type}' is left out here: this `ros2` makes Python packages, "
            "since ROS 2 from pip has no C++ libraries to build others with.",
            f"Try:  {_as_python_package(args._words)}",
        )
    _announce(new := _asked_for(args), destination)
    try:
        for folder_or_file, content in _files(new, destination):
            _make(folder_or_file, content)
    except OSError as error:
        raise CommandError(f"Failed to create {error.filename}: {error.strerror}") from None
    if new.license not in LICENSES:
        _warn_about_license(new.license)


def _as_python_package(words: Sequence[str]) -> str:
    """Return the command as it was typed, with the build type that works here."""
    kept, old = [], False
    for word in words:
        # Options may be shortened, and no other one begins with `b`.
        if not old and not word.startswith("--b"):
            kept.append(word)
        old = word.startswith("--b") and "=" not in word
    place = kept.index("create") + 1
    return shlex.join(["ros2", *kept[:place], "--build-type", "ament_python", *kept[place:]])


def _check_place(destination: Path, name: str) -> None:
    target = os.path.join(destination, name)
    # The original writes the path with the leading `./`.
    shown = target if os.path.isabs(target) or destination != Path() else f"./{name}"
    if os.path.lexists(target):
        raise CommandError(
            "\nAborted!",
            f"The directory already exists: {shown}",
            "Either remove the directory or choose a different destination directory or "
            "package name",
        )
    place = destination.absolute()
    for parent in [place, *place.parents]:
        if parent.exists() and not parent.is_dir():
            raise CommandError(f"Aborted! {parent} is a file, so nothing can be created in it.")
        if (parent / "package.xml").is_file():
            raise CommandError(
                f"Aborted! {parent} is a package itself (it holds a package.xml).",
                "A package inside a package is not found when building. "
                "Go to the `src` folder of your workspace first.",
            )


def _asked_for(args: Namespace) -> NewPackage:
    check_package_name(args.package_name)
    dependencies = list(dict.fromkeys(args.dependencies))
    for one in dependencies:
        check_dependency(one, args.package_name)
    for kind, one in (("a node", args.node_name), ("a library", args.library_name)):
        if one is not None:
            check_module_name(kind, one)
    for option in ("description", "license", "maintainer_name"):
        check_text(option.replace("_", "-"), getattr(args, option) or "")
    maintainer = args.maintainer_name or getpass.getuser()
    email = args.maintainer_email or _default_email(maintainer)
    check_email(email)
    return NewPackage(
        args.package_name, args.package_format, args.description, maintainer, email,
        args.license, dependencies, _node_name(args), args.library_name,
    )  # fmt: skip


def _default_email(maintainer: str) -> str:
    try:
        found = subprocess.run(["git", "config", "user.email"], capture_output=True, text=True)
    except OSError:
        email = ""
    else:
        email = found.stdout.strip()
    return email or re.sub(r"[^-\w%+]+", "_", maintainer, flags=re.ASCII) + "@todo.todo"


def _node_name(args: Namespace) -> str | None:
    name: str | None = args.node_name
    if name is None or name != args.library_name:
        return name
    print("[WARNING] node name can not be equal to the library name", file=sys.stderr)
    print(f"[WARNING] renaming node to {name}_node", file=sys.stderr)
    return f"{name}_node"


def _announce(new: NewPackage, destination: str) -> None:
    print("going to create a new package")
    print("package name:", new.name)
    print("destination directory:", os.path.abspath(destination))
    print("package format:", new.package_format)
    print("version: 0.0.0")
    print("description:", new.description)
    print("maintainer:", [f"{new.maintainer} <{new.email}>"])
    print("licenses:", [new.license])
    print("build type: ament_python")
    print("dependencies:", list(new.dependencies))
    if new.node:
        print("node_name:", new.node)
    if new.library:
        print("library_name:", new.library)


def _files(new: NewPackage, destination: str) -> Iterator[tuple[str, str | None]]:
    """Yield paths with their content in the order of making; None is a folder."""
    root = os.path.join(destination, new.name)
    source = os.path.join(root, new.name)
    yield root, None
    yield os.path.join(root, "package.xml"), templates.package_xml(new)
    if (text := templates.license_text(new.license)) is not None:
        yield os.path.join(root, "LICENSE"), text
    print("creating source folder")
    yield source, None
    yield os.path.join(root, "setup.py"), templates.setup_py(new)
    yield os.path.join(root, "setup.cfg"), templates.setup_cfg(new)
    yield os.path.join(root, "resource"), None
    yield os.path.join(root, "resource", new.name), ""
    yield os.path.join(source, "__init__.py"), ""
    yield os.path.join(root, "test"), None
    for name, text in templates.linter_tests().items():
        yield os.path.join(root, "test", name), text
    if new.node:
        yield os.path.join(source, f"{new.node}.py"), templates.node_py(new)
    if new.library:
        yield os.path.join(source, new.library), None
        yield os.path.join(source, new.library, "__init__.py"), ""


def _make(path: str, content: str | None) -> None:
    silent = os.path.basename(path) == "LICENSE"  # so does the original
    if content is None:
        print("creating folder", path)
        os.makedirs(path, exist_ok=True)
        return
    if not silent:
        print("creating", path)
    Path(path).write_text(content, encoding="utf-8")


def _warn_about_license(name: str) -> None:
    print(
        f"\n[WARNING]: Unknown license '{name}'.  This has been set in the package.xml, "
        "but no LICENSE file has been created.\n"
        "It is recommended to use one of the ament license identifiers:",
        *LICENSES,
        sep="\n",
    )
