"""What builds packages of messages: wheels, and CMake and a compiler of the machine or in wheels.

The wheels come from another machine, and their CMake files name folders of that one. They are
changed in place, and back when the addition is removed. A script `cmake`, in front of the real one,
tells it what each terminal would have to: which Python, where ROS is, and which compiler.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import sys
import sysconfig
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from course_tool import installing, running
from course_tool.layout import Layout
from course_tool.problems import Problem, say

#: The locks of this addition: always the first one, and the others for what the machine lacks.
LOCKS = ("messages", "cmake", "compiler")
#: What each lock takes of the disk, and how much of that is fetched, in bytes.
_SIZES = {
    "messages": (5_000_000, 1_000_000),
    "cmake": (85_000_000, 27_000_000),
    "compiler": (431_000_000, 101_000_000),
}
#: Where ament's CMake code looks for the checks of C++ code, which are on no registry. Every new
#: package asks for them, so this takes their place, and checks nothing.
_NO_CHECKS = """\
# Made by the course rosbeat, which has no checks of C++ code.
macro(ament_lint_auto_find_test_dependencies)
endmacro()
"""
_CHECKS = Path("share", "ament_lint_auto", "cmake", "ament_lint_autoConfig.cmake")
#: What CMake finds as long as the addition is not there: `share/NAME*/NAME-config.cmake`.
_MISSING = Path("share", "ament_cmake_missing", "ament_cmake-config.cmake")
_SAY_MISSING = """\
# Made by the course rosbeat: what ament_cmake is here until somebody adds it.
message(FATAL_ERROR "
  # This package needs what builds messages of your own, which is not here yet.
  # Add it once, in the folder of the course:  ./environment/course add messages")
"""
_NO_CMAKE = """\
#!/bin/sh
# Made by the course rosbeat: the CMake of this machine, if it has one.
IFS=:
for folder in $PATH; do
    [ "$folder" = {ours} ] || [ ! -x "$folder/cmake" ] || exec "$folder/cmake" "$@"
done
echo "# There is no CMake here. It comes with what builds messages of your own. Add that once,
# in the folder of the course:  ./environment/course add messages" >&2
exit 127
"""
_CMAKE = """\
#!/bin/sh
# Made by the course rosbeat: CMake, with the ROS and the Python of this environment.
prefix={prefix}
export VIRTUAL_ENV="$prefix"
export CMAKE_PREFIX_PATH="${{CMAKE_PREFIX_PATH:+$CMAKE_PREFIX_PATH:}}$prefix"
{settings}exec {cmake} "$@"
"""
_NINJA = 'export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"\n'
_COMPILER = (
    'export CC="${CC:-$prefix/libexec/rosbeat/cc}" CXX="${CXX:-$prefix/libexec/rosbeat/c++}"\n'
)
#: CMake files of the wheels look for libdl, which is empty since glibc 2.34. The compiler in a
#: wheel brings no file of that name, so an archive without members stands in for it.
_NO_LIBRARY = "libdl.a", "!<arch>\n"
_TOOLS = ("cc", "c++", "ar", "ranlib")
#: The package of the course that is built at once, and the list of its installed files.
OWN_PACKAGE = "rosie_interfaces"
_OWN_FILES = Path("share", OWN_PACKAGE, "installed_files.txt")


# What the machine has.


def needed(layout: Layout, search_path: str) -> list[str]:
    """Return the locks that make a machine able to build messages.

    Args:
        layout: The checkout.
        search_path: The PATH on which the machine's own programs are looked for.
    """
    has_cmake = _program(layout, search_path, "cmake") and _program(
        layout, search_path, "make", "ninja"
    )
    has_compiler = _program(layout, search_path, "cc", "gcc", "clang") and _program(
        layout, search_path, "c++", "g++", "clang++"
    )
    return ["messages", *([] if has_cmake else ["cmake"]), *([] if has_compiler else ["compiler"])]


def _program(layout: Layout, search_path: str, *names: str) -> str | None:
    """Return the first of these programs that the machine has, apart from those of `.venv`."""
    ours = str(layout.venv / "bin")
    path = os.pathsep.join(part for part in search_path.split(os.pathsep) if part != ours)
    return next((found for name in names if (found := shutil.which(name, path=path))), None)


def require_headers() -> None:
    """Refuse a Python without its headers, which no wheel brings.

    Raises:
        Problem: If they are not there.
    """
    headers = Path(sysconfig.get_path("include"))
    if not (headers / "Python.h").is_file():
        version = "{}.{}".format(*sys.version_info[:2])
        raise Problem(
            f"Python {version} is here without its headers: there is no {headers}/Python.h.",
            "Messages become modules in C that Python imports, and no wheel brings the headers\n"
            "that these need. Nothing was installed or changed.",
            f"On Debian or Ubuntu, they are a package:  sudo apt install python{version}-dev\n"
            "Then run the same command again.",
        )


def size(locks: Iterable[str]) -> tuple[int, int]:
    """Return how many bytes some locks take of the disk, and how many are fetched."""
    disk, fetched = zip(*(_SIZES[lock] for lock in locks), strict=True)
    return sum(disk), sum(fetched)


# Adding and removing.


def install(layout: Layout, locks: Sequence[str], environ: Mapping[str, str]) -> None:
    """Install what some locks list, make it fit this machine, and build the course's own package.

    Raises:
        Problem: If an installer stops, or the package cannot be built.
    """
    env = installing.for_installers(layout, environ)
    log = installing.install_log(layout)
    for lock in locks:
        say(f"       installing what {lock}.lock lists")
        installing.install(installing.lock_command(layout, lock), env, log)
    shutil.rmtree((layout.venv / _MISSING).parent, ignore_errors=True)
    repair(layout)
    _write(layout.venv / _CHECKS, _NO_CHECKS)
    _write_tools(layout, locks, environ.get("PATH", os.defpath))
    say(f"       building {OWN_PACKAGE}: this takes a minute, or ten seconds with gcc")
    _build_own(layout, environ)


def uninstall(layout: Layout, kept: Iterable[str], environ: Mapping[str, str]) -> None:
    """Remove all that `install` has brought.

    Args:
        layout: The checkout.
        kept: The locks whose packages stay.
        environ: The environment for the installer.
    """
    _remove_own(layout)
    repair(layout, back=True)
    for path in (_CHECKS.parents[1], Path("libexec", "rosbeat")):
        shutil.rmtree(layout.venv / path, ignore_errors=True)
    stays = {name for lock in kept for name in _names(layout, lock)}
    gone = sorted({name for lock in LOCKS for name in _names(layout, lock)} - stays)
    command: list[str | Path] = [layout.uv, "pip", "uninstall", "--python", layout.python, *gone]
    installing.install(command, environ, installing.install_log(layout))
    for folder in (layout.venv / "share").iterdir():  # the installer leaves empty ones
        if folder.is_dir() and not any(path.is_file() for path in folder.rglob("*")):
            shutil.rmtree(folder)
    write_missing(layout)


def write_missing(layout: Layout) -> None:
    """Make CMake, there or not, say what to add, as long as `ament_cmake` is not installed."""
    _write(layout.venv / _MISSING, _SAY_MISSING)
    ours = layout.venv / "bin"
    _write(ours / "cmake", _NO_CMAKE.format(ours=shlex.quote(str(ours))), 0o755)


def _names(layout: Layout, lock: str) -> list[str]:
    path = layout.lock(lock)
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    return re.findall(r"^([\w.-]+)==", text, re.MULTILINE)


def repair(layout: Layout, back: bool = False) -> None:
    """Replace the folders of the machine that built the wheels by this one's, or bring them back.

    Each file is written anew: it may be a link to the one in the installer's cache.
    """
    version = "{}.{}".format(*sys.version_info[:2])
    builders = f"/opt/python/cp{version.replace('.', '')}-cp{version.replace('.', '')}"
    headers = Path("numpy", "_core", "include")
    swaps = [
        (f"{builders}/include/python{version}", sysconfig.get_path("include")),
        (
            f"{builders}/lib/python{version}/site-packages/{headers}",
            str(layout.site_packages / headers),
        ),
    ]
    for path in sorted((layout.venv / "share").rglob("*.cmake")):
        text = path.read_text(encoding="utf-8")
        new = text
        for theirs, ours in swaps:
            new = new.replace(ours, theirs) if back else new.replace(theirs, ours)
        if new != text:
            _write(path, new)


def _write_tools(layout: Layout, locks: Sequence[str], search_path: str) -> None:
    """Write the programs that are called in the place of CMake and of a compiler."""
    settings = ""
    if "cmake" in locks:
        cmake: str | Path | None = layout.site_packages / "cmake" / "data" / "bin" / "cmake"
        settings += _NINJA
    else:
        cmake = _program(layout, search_path, "cmake")
    if "compiler" in locks:
        zig = shlex.quote(str(layout.site_packages / "ziglang" / "zig"))
        for tool in _TOOLS:
            script = f'#!/bin/sh\nexec {zig} {tool} "$@"\n'
            _write(layout.venv / "libexec" / "rosbeat" / tool, script, 0o755)
        name, content = _NO_LIBRARY
        _write(layout.venv / "libexec" / "rosbeat" / name, content)
        settings += 'export CMAKE_LIBRARY_PATH="$prefix/libexec/rosbeat"\n'
        settings += 'PATH="$prefix/libexec/rosbeat:$PATH"\n' + _COMPILER
    text = _CMAKE.format(
        prefix=shlex.quote(str(layout.venv)), settings=settings, cmake=shlex.quote(str(cmake))
    )
    _write(layout.venv / "bin" / "cmake", text, 0o755)


def _write(path: Path, text: str, mode: int = 0o644) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(f".{path.name}.new")
    unfinished.write_text(text, encoding="utf-8")
    unfinished.chmod(mode)
    unfinished.replace(path)


# The package of the course.


def own_package(layout: Layout) -> Path:
    """Return the folder of the package that is built at once."""
    return layout.root / "src" / "rosie" / OWN_PACKAGE


def _build_own(layout: Layout, environ: Mapping[str, str]) -> None:
    """Build the package as any package of messages is built, and install it into `.venv`.

    Raises:
        Problem: If it cannot be built; the same would be true of a learner's own.
    """
    _remove_own(layout)
    active = running.with_ros(running.inside(environ, layout), layout)
    cmake = str(layout.venv / "bin" / "cmake")
    with tempfile.TemporaryDirectory() as folder:
        options = ["-DBUILD_TESTING=OFF", f"-DCMAKE_INSTALL_PREFIX={layout.venv}"]
        steps = (
            [cmake, "-S", str(own_package(layout)), "-B", folder, *options],
            [cmake, "--build", folder, "--parallel", str(os.cpu_count() or 1)],
            [cmake, "--install", folder],
        )
        for step in steps:
            try:
                installing.install(step, active, installing.install_log(layout), cwd=Path(folder))
            except Problem as problem:
                raise Problem(
                    f"{OWN_PACKAGE}, a first package of messages, could not be built.",
                    "What builds messages was installed, and does not work on this machine yet.\n"
                    "The rest of the environment is as it was.",
                    "Read the last words below: a compiler or its headers may be incomplete. On\n"
                    "Debian or Ubuntu:  sudo apt install g++ cmake\nThen run the same command "
                    f"again. All that was said is in {installing.install_log(layout)}",
                    problem.details,
                ) from None
        files = Path(folder, "install_manifest.txt").read_text(encoding="utf-8")
    _write(layout.venv / _OWN_FILES, files)


def _remove_own(layout: Layout) -> None:
    listed = layout.venv / _OWN_FILES
    if not listed.exists():
        return
    for line in listed.read_text(encoding="utf-8").splitlines():
        Path(line).unlink(missing_ok=True)
    for parent in (layout.site_packages, layout.venv / "include", layout.venv / "share"):
        for folder in parent.glob(f"{OWN_PACKAGE}*"):
            shutil.rmtree(folder)
