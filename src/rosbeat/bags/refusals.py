"""Create the errors for operations on recordings that are not possible."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from pathlib import Path

from rosbeat.errors import BagError
from rosbeat.records import Sample


def exists_already(folder: Path) -> BagError:
    """Return the error for a new recording whose target already exists."""
    return BagError(
        f"There is something at {folder} already.",
        "A new recording does not overwrite an older one, nor anything else.",
        "Choose another name, or keep the old one beside it: `record(..., keep_old=True)`.",
    )


def unknown_storage(storage: object) -> BagError:
    """Return the error for a storage format that is not supported here."""
    return BagError(
        f"A recording cannot be stored as {storage!r}.",
        "Two storages are known: MCAP, which is the default of ROS 2, and SQLite.",
        'Write `storage="mcap"` or `storage="sqlite3"`.',
    )


def unknown_type(name: str) -> BagError:
    """Return the error for a message type whose definition cannot be found."""
    return BagError(
        f"The message type {name} is not known here.",
        "It is not part of ROS 2, and no package that defines it is installed, so nobody can say "
        "which fields it has.",
        "Build the package that defines it and open the page again, or leave its topic out with "
        "`topics=[...]`.",
    )


def unknown_topic(topic: str, known: Iterable[str]) -> BagError:
    """Return the error for a topic that is not in the recording."""
    names = sorted(known)
    near = get_close_matches(f"/{topic.lstrip('/')}", names, n=1)
    return BagError(
        f"There is no topic {topic!r} in what was recorded.",
        f"Recorded: {', '.join(names)}." if names else "No topic was recorded at all.",
        f"Did you mean {near[0]!r}?" if near else "Choose one of these, or record it first.",
    )


def not_a_name(topic: object) -> BagError:
    """Return the error for a topic name that is not a string."""
    return BagError(
        f"{topic!r} is not the name of a topic, but of type {type(topic).__name__}.",
        "A recording is asked by name, and a name is a text.",
        'Put it in quotation marks: `bag.messages("temperature")`.',
    )


def two_types(topic: str, types: Iterable[str]) -> BagError:
    """Return the error for a topic with messages of more than one type."""
    return BagError(
        f"Messages of two types are on {topic}: {' and '.join(types)}.",
        "In a recording a topic has one type, as it should have in a running system.",
        "Let all its publishers use the same type, or leave it out with `topics=[...]`.",
    )


def no_observation(source: object) -> BagError:
    """Return the error for an object that is not a run."""
    return BagError(
        f"{type(source).__name__!r} is not a run.",
        "It takes a session, what a session observed, or a recording.",
        "Give it the session itself, as in `record(ros, ...)`, or `ros.observation()`.",
    )


def does_not_fit(topic: str, type_name: str, number: int, error: Exception) -> BagError:
    """Return the error for a message with a value that its type cannot hold."""
    return BagError(
        f"Message {number} on {topic} is not a {type_name}: {error}.",
        "Every message on a topic has the fields of its type, each with a value that it can hold.",
        "Look at that message; a fault may have put a value into it that is too large.",
    )


def not_written(folder: Path, error: Exception) -> BagError:
    """Return the error for a recording that could not be written."""
    return BagError(
        f"The recording could not be written to {folder}: {_words(error)}.",
        "Nothing that was there before has changed.",
        "Choose a folder in which you may write, on a disk with room left.",
    )


def not_there(folder: Path) -> BagError:
    """Return the error for a path with no recording."""
    return BagError(
        f"There is no recording at {folder}.",
        "A recording is a folder with a file metadata.yaml and the data beside it, or one file "
        "that ends in .mcap or .db3.",
        "Check the name and the folder in which you are, or record first.",
    )


def damaged(folder: Path, error: Exception) -> BagError:
    """Return the error for a recording that is damaged, incomplete or of an unknown kind."""
    return BagError(
        f"The recording at {folder} cannot be read: {_words(error)}.",
        "It is damaged, incomplete, or of a kind that is not known here. Nothing was changed.",
        "If you have a copy, use that; if the recording was broken off, record again.",
    )


def no_place(folder: object) -> BagError:
    """Return the error for an object that is not the name of a folder."""
    return BagError(
        f"{folder!r} is not the name of a folder.",
        "A recording is a folder, which a text names, or a `Path`.",
        'Write for example `record(ros, "first_run")`.',
    )


def no_fault(found: object) -> BagError:
    """Return the error for an object that is not a fault."""
    return BagError(
        f"{found!r} is not a fault.",
        "A fault is a function from messages to messages.",
        "Write for example `faults=[stuck(at=20), dropouts(share=0.1)]`.",
    )


def bad_argument(call: str, what: str, wanted: str) -> BagError:
    """Return the error for a fault with an invalid argument."""
    return BagError(
        f"{call} was given {what}.",
        f"It takes {wanted}.",
        "Write for example `stuck(at=20, seconds=5)`, `drift(rate=0.1)`, `dropouts(share=0.2)`.",
    )


def no_such_number(sample: Sample, field: str | None, numbers: Iterable[str]) -> BagError:
    """Return the error for a fault whose field is missing or ambiguous in a message."""
    names = ", ".join(map(repr, numbers))
    where = f"the field {field!r}" if field else "one number"
    return BagError(
        f"A message on {sample.topic} does not have {where} to change.",
        f"The numbers in a {sample.type_name} here are {names}."
        if names
        else f"A {sample.type_name} here holds no number.",
        "Choose one with `field=...`, or the topic of the fault with `topic=...`.",
    )


def whole_numbers_only(sample: Sample) -> BagError:
    """Return the error for NaN in a message that holds integers."""
    return BagError(
        f"Messages on {sample.topic} hold whole numbers, and NaN is not one.",
        f"NaN ('not a number') is a value of floating-point types only, and a {sample.type_name} "
        "has none here.",
        "Choose a topic with floating-point numbers, or another fault.",
    )


def no_number(speed: object) -> BagError:
    """Return the error for an invalid replay speed."""
    return BagError(
        f"speed={speed!r} cannot be used.",
        "It is a number above 0: 2 replays twice as fast, 0.5 half as fast.",
        "Leave it out to replay as it was.",
    )


def _words(error: Exception) -> str:
    text = str(error).strip().rstrip(".").partition("\n")[0]
    return text if " " in text else f"{type(error).__name__} {text}".strip()
