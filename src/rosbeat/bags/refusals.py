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
        f"{folder} already exists.",
        "A new recording does not overwrite an existing file or folder.",
        "Choose another name, or keep the old recording under a new name: `record(..., "
        "keep_old=True)`.",
    )


def unknown_storage(storage: object) -> BagError:
    """Return the error for a storage format that is not supported here."""
    return BagError(
        f"A recording cannot be stored as {storage!r}.",
        "There are two storage formats: MCAP, which is the default in ROS 2, and SQLite.",
        'Write `storage="mcap"` or `storage="sqlite3"`.',
    )


def unknown_type(name: str) -> BagError:
    """Return the error for a message type whose definition cannot be found."""
    return BagError(
        f"The message type {name} is unknown.",
        "The type is not part of ROS 2, and no package that defines it is installed, so its "
        "fields are unknown.",
        "Build the package that defines the type and open the page again, or leave out its topic "
        "with `topics=[...]`.",
    )


def unknown_topic(topic: str, known: Iterable[str]) -> BagError:
    """Return the error for a topic that is not in the recording."""
    names = sorted(known)
    near = get_close_matches(f"/{topic.lstrip('/')}", names, n=1)
    return BagError(
        f"The recording has no topic {topic!r}.",
        f"Recorded topics: {', '.join(names)}." if names else "The recording has no topics.",
        f"Did you mean {near[0]!r}?"
        if near
        else "Choose one of the recorded topics, or record this one first.",
    )


def not_a_name(topic: object) -> BagError:
    """Return the error for a topic name that is not a string."""
    return BagError(
        f"{topic!r} is not the name of a topic, but of type {type(topic).__name__}.",
        "The argument is a topic name, and a name is a string.",
        'Put it in quotation marks: `bag.messages("temperature")`.',
    )


def two_types(topic: str, types: Iterable[str]) -> BagError:
    """Return the error for a topic with messages of more than one type."""
    return BagError(
        f"The topic {topic} has messages of two types: {' and '.join(types)}.",
        "In a recording, each topic has one type, as it should in a running system.",
        "Use the same type in all its publishers, or leave the topic out with `topics=[...]`.",
    )


def no_observation(source: object) -> BagError:
    """Return the error for an object that is not a run."""
    return BagError(
        f"{type(source).__name__!r} is not a run.",
        "A run is a session, a session's observation, or a recording.",
        "Pass the session itself, as in `record(ros, ...)`, or `ros.observation()`.",
    )


def does_not_fit(topic: str, type_name: str, number: int, error: Exception) -> BagError:
    """Return the error for a message with a value that its type cannot hold."""
    return BagError(
        f"Message {number} on {topic} is not a {type_name}: {error}.",
        "Every message on a topic has the fields of its type, and each field has a value of the "
        "right kind and size.",
        "Check that message: a fault may have given it a value that is too large.",
    )


def not_written(folder: Path, error: Exception) -> BagError:
    """Return the error for a recording that could not be written."""
    return BagError(
        f"The recording could not be written to {folder}: {_words(error)}.",
        "Existing files have not changed.",
        "Choose a folder with write permission, on a disk with enough space.",
    )


def not_there(folder: Path) -> BagError:
    """Return the error for a path with no recording."""
    return BagError(
        f"There is no recording at {folder}.",
        "A recording is a folder that contains metadata.yaml and the data, or a single file that "
        "ends in .mcap or .db3.",
        "Check the name and the current folder, or record first.",
    )


def damaged(folder: Path, error: Exception) -> BagError:
    """Return the error for a recording that is damaged, incomplete or of an unknown kind."""
    return BagError(
        f"The recording at {folder} cannot be read: {_words(error)}.",
        "The recording is damaged, incomplete, or in an unknown format. Nothing was changed.",
        "If you have a copy, use that; if the recording was interrupted, record again.",
    )


def no_place(folder: object) -> BagError:
    """Return the error for an object that is not the name of a folder."""
    return BagError(
        f"{folder!r} is not the name of a folder.",
        "The name of a recording's folder is a string or a `Path`.",
        'For example, write `record(ros, "first_run")`.',
    )


def no_fault(found: object) -> BagError:
    """Return the error for an object that is not a fault."""
    return BagError(
        f"{found!r} is not a fault.",
        "A fault is a function that takes messages and returns messages.",
        "For example, write `faults=[stuck(at=20), dropouts(share=0.1)]`.",
    )


def bad_argument(call: str, what: str, wanted: str) -> BagError:
    """Return the error for a fault with an invalid argument."""
    return BagError(
        f"{call} was given {what}.",
        f"The function takes {wanted}.",
        "For example, write `stuck(at=20, seconds=5)`, `drift(rate=0.1)` or `dropouts(share=0.2)`.",
    )


def no_such_number(sample: Sample, field: str | None, numbers: Iterable[str]) -> BagError:
    """Return the error for a fault whose field is missing or ambiguous in a message."""
    names = ", ".join(map(repr, numbers))
    where = f"the field {field!r}" if field else "one number"
    return BagError(
        f"A message on {sample.topic} does not have {where} to change.",
        f"The fields of this {sample.type_name} that hold numbers are {names}."
        if names
        else f"This {sample.type_name} has no field that holds a number.",
        "Choose a field with `field=...`, or another topic with `topic=...`.",
    )


def whole_numbers_only(sample: Sample) -> BagError:
    """Return the error for NaN in a message that holds integers."""
    return BagError(
        f"Messages on {sample.topic} hold whole numbers, and NaN is not a whole number.",
        "NaN ('not a number') is a value of floating-point types only, and this "
        f"{sample.type_name} has no floating-point field.",
        "Choose a topic with floating-point numbers, or another fault.",
    )


def no_number(speed: object) -> BagError:
    """Return the error for an invalid replay speed."""
    return BagError(
        f"speed={speed!r} cannot be used.",
        "The speed is a number above 0: 2 replays twice as fast, 0.5 half as fast.",
        "Leave the speed out to replay at the original speed.",
    )


def _words(error: Exception) -> str:
    text = str(error).strip().rstrip(".").partition("\n")[0]
    return text if " " in text else f"{type(error).__name__} {text}".strip()
