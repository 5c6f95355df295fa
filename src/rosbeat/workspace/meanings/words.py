"""Words that `colcon` or `ros2` do not know."""

from __future__ import annotations

import re

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.workspace.locating import nearest
from rosbeat.workspace.meanings.running import names_to_run
from rosbeat.workspace.meanings.situation import Situation

_CHOICE = re.compile(
    r"^(?P<program>\w+).*: error: .*invalid choice: '?(?P<word>[^'\s]+)'? "
    r"\(choose from (?P<names>[^)]*)\)",
    re.MULTILINE,
)
_UNKNOWN = re.compile(
    r"^(?P<program>colcon|ros2).*: error: unrecognized arguments: (?P<rest>.+)$", re.MULTILINE
)
_MISSING = re.compile(
    r"^(?P<program>ros2 .*): error: the following arguments are required: "
    r"(?P<names>.+)$",
    re.MULTILINE,
)
_REFUSED = r"^ros2.*: error: (unrecognized|the following) arguments"
_OPTIONS = (
    "--packages-select",
    "--symlink-install",
    "--packages-up-to",
    "--packages-skip",
    "--parallel-workers",
    "--base-paths",
    "--cmake-args",
    "--ros-args",
    "--destination-directory",
    "--help",
    "--event-handlers",
    "--build-type",
    "--dependencies",
    "--node-name",
    "--once",
    "--show-types",
)


def unknown_word(seen: Situation) -> Diagnosis | None:
    """A verb that does not exist, with the nearest that does."""
    found = _CHOICE.search(seen.text)
    if not found or not seen.call(found["program"]):
        return None
    names = re.findall(r"[\w-]+", found["names"])
    meant = nearest(found["word"], names)
    hint = f"Did you mean `{meant}`?" if meant else f"It knows: {', '.join(names)}."
    said = f"`{found['program']}` does not know the word `{found['word']}`."
    return Diagnosis(_mistake_of(found["word"]), said, hint)


def _mistake_of(word: str) -> str:
    """A build type is asked for by a word, too, and has a mistake of its own."""
    return "build-type" if word.startswith("ament") else "word-misspelled"


def unknown_option(seen: Situation) -> Diagnosis | None:
    """An option that does not exist, with the nearest that does."""
    found = _UNKNOWN.search(seen.text)
    if not found or not seen.call(found["program"]):
        return None
    word = found["rest"].split()[0]
    meant = _option_like(word.split("=")[0])
    hint = (
        f"Did you mean `{meant}`?" if meant else f"`{found['program']} --help` lists what it takes."
    )
    said = f"`{found['program']}` cannot do anything with `{word}`."
    return Diagnosis("option-misspelled", said, hint)


def _option_like(word: str) -> str | None:
    """The option that was meant: the dashes of `-symlink-install` or `symlink_install` are few."""
    plain = word.lstrip("-").replace("_", "-")
    if f"--{plain}" in _OPTIONS:
        return f"--{plain}"
    return nearest(word, list(_OPTIONS), 0.75) if word.startswith("-") else None


def run_without_two_names(seen: Situation) -> Diagnosis | None:
    """The package or the executable was left out, so an option counted as one of them."""
    names = names_to_run(seen)
    if names is None or len(names) > 1 or not re.search(_REFUSED, seen.text, re.MULTILINE):
        return None
    return Diagnosis(
        "word-missing",
        "`ros2 run` got fewer than two names.",
        "After `ros2 run` come two names: the package and the executable.",
    )


def missing_word(seen: Situation) -> Diagnosis | None:
    """Something that `ros2` needs was left out."""
    found = _MISSING.search(seen.text)
    if not found or not seen.call("ros2"):
        return None
    if found["program"] == "ros2 pkg create":
        return Diagnosis(
            "word-missing",
            "The name of the package is missing, or an option before it has taken it: "
            "`--dependencies` takes every word behind it.",
            "Put the name first.",
        )
    names = found["names"].removesuffix(", argv").replace("_", " ")
    said = f"`{found['program']}` needs something more behind it:"
    return Diagnosis("word-missing", said, f"{names}.")
