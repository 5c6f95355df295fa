"""Create a package: check what was asked for, and write the files.

The files are those of `data/package`, with values in the place of their names.
"""

from __future__ import annotations

import getpass
import keyword
import os
import re
import shlex
import subprocess
import sys
import sysconfig
from argparse import Namespace
from collections.abc import Iterator, Sequence
from importlib.machinery import PathFinder
from importlib.resources import files
from pathlib import Path
from string import Template
from xml.sax.saxutils import escape

from ros2_command.errors import CommandError, note

_DATA = files("ros2_command") / "data"
_INDEX = "share/ament_index/resource_index/packages"
#: The licenses of which the full text is known, in the order in which they are offered.
LICENSES = (
    *("Apache-2.0", "BSL-1.0", "BSD-2.0", "BSD-2-Clause", "BSD-3-Clause"),
    *("GPL-3.0-only", "LGPL-3.0-only", "MIT", "MIT-0"),
)
#: Without a full ROS 2, linters may be missing, and ament_copyright is on no registry at all: these
#: tests are then skipped, where the original's imports at the top would end the whole run.
_LINTER_TESTS = ("test_copyright.py", "test_flake8.py", "test_pep257.py")
_DEPENDENCY = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")
# XML 1.0 cannot hold these, and neither can a file in UTF-8 hold halves of characters.
_UNWRITABLE = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def create(args: Namespace) -> None:
    """Make the package that the arguments of `ros2 pkg create` ask for.

    Raises:
        CommandError: If it cannot be made, or could not be built; nothing is made then.
    """
    if args.license == "?":
        print("\n".join(["Supported licenses:", *LICENSES]))
        return
    _check_place(Path(args.destination_directory), args.package_name)
    if args.build_type == "cmake":
        raise CommandError(
            "Build type 'cmake' is left out here: this `ros2` makes packages of the types "
            "ament_python and ament_cmake.",
        )
    _check_names(args)
    _complete(args)
    _announce(args)
    try:
        for path, content in _files(args):
            _make(path, content)
    except OSError as error:
        raise CommandError(f"Failed to create {error.filename}: {error.strerror}") from None
    if args.license not in LICENSES:
        _warn_about_license(args.license)
    if not _is_python(args):
        note(
            "This package is for C++, or for messages of your own. A package of Python nodes is "
            f"made with:  {_as_python_package(args.typed_words)}",
            "ROS 2 from pip builds packages of Python nodes. It has no rclcpp, so nodes in C++ "
            "need a full ROS 2; packages of messages need CMake and a compiler.",
        )


def _is_python(args: Namespace) -> bool:
    return bool(args.build_type == "ament_python")


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
            f"\nAborted!\nThe directory already exists: {shown}\n"
            "Either remove the directory or choose a different destination directory or "
            "package name"
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


# The names.


def _check_names(args: Namespace) -> None:
    """Refuse what could not be imported or built, with a name that would work.

    Raises:
        CommandError: With the reason.
    """
    if args.package_name == "test" and _is_python(args):
        raise CommandError(
            "Aborted since 'ament_python' packages can't be named 'test'. "
            "Please choose a different package name."
        )
    _refuse("a package", args.package_name, _why_no_package(args.package_name))
    for kind, name in (("a node", args.node_name), ("a library", args.library_name)):
        if name is not None:
            _refuse(kind, name, (_no_module if _is_python(args) else _no_target)(name))
    for one in args.dependencies:
        if not _DEPENDENCY.fullmatch(one):
            raise CommandError(f"Aborted! '{one}' cannot be the name of a package to depend on.")
    if args.package_name in args.dependencies:
        raise CommandError(f"Aborted! The package '{args.package_name}' cannot depend on itself.")
    for option in ("description", "license", "maintainer_name", "maintainer_email"):
        if _UNWRITABLE.search(text := getattr(args, option) or ""):
            raise CommandError(
                f"Aborted! The text of --{option.replace('_', '-')} contains characters that "
                f"package.xml does not allow: {text!a}"
            )


def _why_no_package(name: str) -> str:
    """Return why a package cannot have a name, or an empty string."""
    if reason := _not_importable(name):
        return reason
    if name.startswith("_"):
        return "a package's name begins with a letter"
    if name in sys.stdlib_module_names:
        return f"Python's standard library has a module '{name}', and one would hide the other"
    installed = PathFinder.find_spec(name, [sysconfig.get_path("purelib")]) is not None
    if installed or (Path(sys.prefix) / _INDEX / name).exists():
        return f"'{name}' is already installed with ROS 2, and one would hide the other"
    return ""


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


def _no_module(name: str) -> str:
    """Return why a module in a package cannot have a name, or an empty string."""
    reserved = "names that begin with two underscores are reserved for Python"
    return _not_importable(name) or (reserved if name.startswith("__") else "")


def _no_target(name: str) -> str:
    """Return why a program or a library of C++ cannot have a name, or an empty string."""
    if re.fullmatch(r"[A-Za-z]\w*", name, re.ASCII):
        return ""
    return "it may contain only letters, digits and '_', and begins with a letter"


def _refuse(kind: str, name: str, reason: str) -> None:
    if reason:
        tidy = re.sub(r"[^a-z0-9]+", "_", name.removesuffix(".py").lower()).strip("_")
        is_better = tidy and tidy != name and not _not_importable(tidy)
        raise CommandError(
            f"Aborted! '{name}' cannot be the name of {kind}: {reason}.",
            f"Try '{tidy}'." if is_better else "Choose another name.",
        )


# The files.


def _complete(args: Namespace) -> None:
    """Set what was not said, and a node name that is also the library's."""
    args.dependencies = list(dict.fromkeys(args.dependencies))
    args.maintainer_name = args.maintainer_name or getpass.getuser()
    args.maintainer_email = args.maintainer_email or _default_email(args.maintainer_name)
    if args.node_name is not None and args.node_name == args.library_name:
        print("[WARNING] node name can not be equal to the library name", file=sys.stderr)
        args.node_name = f"{args.node_name}_node"
        print(f"[WARNING] renaming node to {args.node_name}", file=sys.stderr)


def _default_email(maintainer: str) -> str:
    try:
        found = subprocess.run(["git", "config", "user.email"], capture_output=True, text=True)
    except OSError:
        email = ""
    else:
        email = found.stdout.strip()
    return email or re.sub(r"[^-\w%+]+", "_", maintainer, flags=re.ASCII) + "@todo.todo"


def _announce(args: Namespace) -> None:
    print("going to create a new package")
    print("package name:", args.package_name)
    print("destination directory:", os.path.abspath(args.destination_directory))
    print("package format:", args.package_format)
    print("version: 0.0.0")
    print("description:", args.description)
    print("maintainer:", [f"{args.maintainer_name} <{args.maintainer_email}>"])
    print("licenses:", [args.license])
    print("build type:", args.build_type)
    print("dependencies:", args.dependencies)
    if args.node_name:
        print("node_name:", args.node_name)
    if args.library_name:
        print("library_name:", args.library_name)


def _files(args: Namespace) -> Iterator[tuple[str, str | None]]:
    """Yield paths with their content in the order of making; None is a folder."""
    root = os.path.join(args.destination_directory, args.package_name)
    yield root, None
    yield os.path.join(root, "package.xml"), _package_xml(args)
    if args.license in LICENSES:
        yield os.path.join(root, "LICENSE"), (_DATA / "licenses" / args.license).read_text("utf-8")
    yield from (_python_files if _is_python(args) else _cpp_files)(args, root)


def _python_files(args: Namespace, root: str) -> Iterator[tuple[str, str | None]]:
    name, node, library = args.package_name, args.node_name, args.library_name
    source = os.path.join(root, name)
    print("creating source folder")
    yield source, None
    yield os.path.join(root, "setup.py"), _setup_py(args)
    yield os.path.join(root, "setup.cfg"), _filled("setup.cfg", name=name)
    yield os.path.join(root, "resource"), None
    yield os.path.join(root, "resource", name), ""
    yield os.path.join(source, "__init__.py"), ""
    yield os.path.join(root, "test"), None
    for test in _LINTER_TESTS:
        yield os.path.join(root, "test", test), _filled(test)
    if node:
        yield os.path.join(source, f"{node}.py"), _filled("node.py", name=name)
    if library:
        yield os.path.join(source, library), None
        yield os.path.join(source, library, "__init__.py"), ""


def _cpp_files(args: Namespace, root: str) -> Iterator[tuple[str, str | None]]:
    name, node, library = args.package_name, args.node_name, args.library_name
    source, include = os.path.join(root, "src"), os.path.join(root, "include", name)
    print("creating source and include folder")
    yield source, None
    yield include, None
    yield os.path.join(root, "CMakeLists.txt"), _cmake_lists(args)
    if node:
        yield os.path.join(source, f"{node}.cpp"), _filled("node.cpp", name=name)
    if library:
        words = {
            "name": name,
            "library": library,
            "type": library.replace("_", " ").title().replace(" ", ""),
            "macro": name.upper(),
            "guard": f"{name}__{library}".upper(),
        }
        for path, template in (
            (os.path.join(include, f"{library}.hpp"), "library.hpp"),
            (os.path.join(source, f"{library}.cpp"), "library.cpp"),
            (os.path.join(include, "visibility_control.h"), "visibility_control.h"),
        ):
            yield path, _filled(template, **words)


def _cmake_lists(args: Namespace) -> str:
    """Return how the package is built: what it needs, its library, its program, its tests."""
    name, node, library = args.package_name, args.node_name, args.library_name
    found = [f"find_package({one} REQUIRED)" for one in args.dependencies] or [
        "# Name each further package that is needed, as here:",
        "# find_package(<dependency> REQUIRED)",
    ]
    parts = {"library": "", "node": "", "exports": ""}
    if library:
        found.insert(0, "find_package(ament_cmake_ros REQUIRED)")
        depends = _depends(library, args.dependencies)
        words = {"name": name, "library": library, "macro": name.upper(), "depends": depends}
        parts["library"] = _filled("CMakeLists.library", **words)
        parts["exports"] = _filled("CMakeLists.exports", library=library)
    if node:
        features = f"target_compile_features({node} PUBLIC c_std_99 cxx_std_17)"
        alone = f"{features}  # C99 and C++17 at least\n{_depends(node, args.dependencies)}"
        needs = f"target_link_libraries({node} {library})\n" if library else alone
        parts["node"] = _filled("CMakeLists.node", node=node, needs=needs)
    return _filled("CMakeLists.txt", name=name, found="\n".join(found), **parts)


def _depends(target: str, dependencies: Sequence[str]) -> str:
    names = "".join(f'  "{one}"\n' for one in dependencies)
    return f"ament_target_dependencies(\n  {target}\n{names})\n" if names else ""


def _package_xml(args: Namespace) -> str:
    tool = "ament_cmake_ros" if args.library_name else "ament_cmake"
    python_tests = ("ament_copyright", "ament_flake8", "ament_pep257", "python3-pytest")
    tests = python_tests if _is_python(args) else ("ament_lint_auto", "ament_lint_common")
    groups = [
        _tags("buildtool_depend", () if _is_python(args) else (tool,)),
        _tags("depend", args.dependencies),
        _tags("test_depend", tests),
    ]
    return _filled(
        "package.xml",
        format=args.package_format,
        name=args.package_name,
        description=escape(args.description),
        maintainer=escape(args.maintainer_name),
        email=escape(args.maintainer_email, {'"': "&quot;"}),
        license=escape(args.license),
        depends="\n".join(filter(None, groups)),
        type=args.build_type,
    )


def _tags(name: str, values: Sequence[str]) -> str:
    return "".join(f"  <{name}>{escape(value)}</{name}>\n" for value in values)


def _setup_py(args: Namespace) -> str:
    """Return the build script, with texts as Python would show them, so quotes cannot break it.

    What tests require is an extra, as newer releases of the original write it. Before, it was
    `tests_require`, which draws a warning from setuptools 72 and newer.
    """
    name, node = args.package_name, args.node_name
    return _filled(
        "setup.py",
        name=name,
        maintainer=repr(args.maintainer_name),
        email=repr(args.maintainer_email),
        description=repr(args.description),
        license=repr(args.license),
        scripts=f"            '{node} = {name}.{node}:main'\n" if node else "",
    )


def _filled(file: str, /, **values: object) -> str:
    """Return a file of `data/package` with values in the place of its names."""
    return Template((_DATA / "package" / f"{file}.in").read_text("utf-8")).substitute(values)


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
