"""Mistakes at `ros2 pkg create`."""

from __future__ import annotations

import re

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.workspace.meanings.situation import Call, Situation
from rosbeat.workspace.place import VARIABLE

_EXISTS = re.compile(r"The directory already exists: (?P<path>\S+)")
_REFUSED = re.compile(r"^ros2.*: error: unrecognized arguments: (?P<rest>.+)$", re.M)
#: What the course's `ros2` prints about a package that was to be made in another one.
INSIDE = "is a package itself (it holds a package.xml)"
_REST = "the rest of the command stays as it is"


def exists_already(seen: Situation) -> Diagnosis | None:
    """A package of this name is there (mistake 26)."""
    found = _EXISTS.search(seen.text)
    if not found or not seen.call("ros2", "pkg", "create"):
        return None
    name = found["path"].rsplit("/", 1)[-1]
    return Diagnosis(
        "package-exists",
        f"A folder {name} is there already, most likely from the first time you ran this command.",
        "Nothing was changed. If it is your package, go on with it; if not, rename it first.",
    )


def without_build_type(seen: Situation) -> Diagnosis | None:
    """`--build-type ament_python` was forgotten (mistake 25)."""
    call = seen.call("ros2", "pkg", "create")
    if not call or any(word.startswith("--build-type") for word in call.words):
        return None
    if "is left out here" in seen.text:
        return Diagnosis(
            "build-type",
            "Without `--build-type ament_python`, `ros2 pkg create` makes a package for C++, and "
            "that is not what your node needs.",
            f"Add it; {_REST}.",
        )
    name = next(
        (
            one.name
            for one in seen.packages
            if one.name in call.words[3:] and one.manifest.build_type.endswith("cmake")
        ),
        None,
    )
    if seen.code == 0 and name:
        return Diagnosis(
            "build-type",
            f"{name} has become a package for C++: it has a CMakeLists.txt and no setup.py, "
            "because `--build-type ament_python` was left out.",
            f"Rename the folder {name} or move it away, then make the package again with that "
            "option.",
        )
    return None


def another_build_type(seen: Situation) -> Diagnosis | None:
    """`--build-type ament_cmake`, where the course's `ros2` makes Python packages only."""
    call = seen.call("ros2", "pkg", "create")
    if not call or "is left out here" not in seen.text:
        return None
    return Diagnosis(
        "build-type",
        "The build type that was asked for is one for C++, and your nodes are in Python.",
        f"Write ament_python behind --build-type; {_REST}.",
    )


def options_missing(seen: Situation) -> Diagnosis | None:
    """The values of the options were typed without the options themselves."""
    call = seen.call("ros2", "pkg", "create")
    found = _REFUSED.search(seen.text)
    if not call or not found or "-" in found["rest"].split()[0][:1]:
        return None
    typed = any(word.startswith("--build-type") for word in call.words)
    kind = [] if typed or "ament_python" not in call.words else ["--build-type"]
    more = len(found["rest"].split()) - len(kind)
    names = ["--dependencies"] if more > 0 and "--dependencies" not in call.words else []
    missing = [*kind, *names]
    if not missing:
        return None
    plural = ("s", "are") if len(missing) > 1 else ("", "is")
    return Diagnosis(
        "option-missing",
        f"The option{plural[0]} {' and '.join(missing)} {plural[1]} missing.",
        "Each option stands before the words that belong to it.",
    )


def commas_between_names(seen: Situation) -> Diagnosis | None:
    """`--dependencies rclpy, sensor_msgs`."""
    call = seen.call("ros2", "pkg", "create")
    if not call or not seen.code or "--dependencies" not in call.words:
        return None
    start = call.words.index("--dependencies")
    if not any("," in word for word in call.words[start:]):
        return None
    return Diagnosis(
        "commas-between-names",
        "There are commas behind --dependencies.",
        "Names are separated by blanks, not by commas.",
    )


def inside_a_package(seen: Situation) -> Diagnosis | None:
    """A package was to be made in another one; the course's `ros2` says so itself."""
    if not seen.call("ros2", "pkg", "create") or INSIDE not in seen.text:
        return None
    return Diagnosis(
        "wrong-folder",
        "This terminal is in a package, and no package lies in another one.",
        "Packages belong into the folder src of the workspace: go there first.",
    )


def in_the_wrong_folder(seen: Situation) -> Diagnosis | None:
    """A package was made outside of `src` (mistake 26)."""
    call = seen.call("ros2", "pkg", "create")
    if not call or seen.code or "--destination-directory" in call.words:
        return None
    source = (seen.workspace / "src").resolve()
    name = _made(call)
    if not name or call.place.resolve() == source:
        return None
    return Diagnosis(
        "wrong-folder",
        f"The package {name} was made in {call.place.name or '/'}, where this terminal is.",
        "Packages belong into the folder src of the workspace. "
        f"Move it there: mv {name} {_way(call, seen)}",
    )


def _made(call: Call) -> str | None:
    """The name among the words whose folder is a package now."""
    return next(
        (
            word
            for word in call.words[3:]
            if not word.startswith("-") and (call.place / word / "package.xml").is_file()
        ),
        None,
    )


def _way(call: Call, seen: Situation) -> str:
    here = call.place.resolve() == seen.workspace.resolve()
    return "src/" if here else f'"${VARIABLE}"/src/'


def bad_name(seen: Situation) -> Diagnosis | None:
    """A name that cannot be a package's."""
    if not seen.call("ros2", "pkg", "create"):
        return None
    if not re.search(r"cannot be the name of a package(?! to depend on)", seen.text):
        return None
    return Diagnosis(
        "package-name",
        "A package for Python is imported under its name, so the name follows Python's rule:",
        "small letters, digits and `_`, and a letter first.",
    )
