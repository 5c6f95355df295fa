"""Write files completely or not at all, under names that are valid on every operating system."""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterable
from hashlib import sha256
from pathlib import Path
from uuid import uuid4

from rosbeat.errors import GradingError
from rosbeat.grading.remarks import printable

#: Characters of a learner's name and id in a file name.
_MOST_OF_A_NAME = 40
_DIGEST = 12
#: Names that Windows keeps for devices, whatever comes behind them.
_DEVICES = {"con", "prn", "aux", "nul", *(f"{one}{n}" for one in ("com", "lpt") for n in range(10))}
#: Letters that Unicode does not take apart into a letter and a sign, as passports spell them
#: (ICAO Doc 9303-3, section 6).
_SPELT = str.maketrans(
    {
        **{"ß": "ss", "ẞ": "SS", "ø": "oe", "Ø": "OE", "æ": "ae", "Æ": "AE", "œ": "oe", "Œ": "OE"},
        **{"ł": "l", "Ł": "L", "đ": "d", "Đ": "D", "ð": "d", "Ð": "D", "þ": "th", "Þ": "TH"},
        **{"ħ": "h", "Ħ": "H", "ı": "i", "ĸ": "q", "ŋ": "n", "Ŋ": "N", "ŧ": "t", "Ŧ": "T"},
    }
)
_PLAIN = re.compile(r"[a-z0-9]+(?:-[a-z0-9]+)*")
_ENDS_LIKE_A_DIGEST = re.compile(rf"(?:.*-)?[0-9a-f]{{{_DIGEST}}}")


def write_whole(path: Path, content: str | bytes) -> bool:
    r"""Write a file in one step, so that nobody ever sees half of it.

    It is written beside its place, brought to the disk, and then put in place of what is there.

    Args:
        path: The file. Missing folders are made.
        content: All of it. Text is written as UTF-8; halves of characters (lone surrogates), which
            no file can hold, as `\udc80`.

    Returns:
        Whether the file is another one than before; one that is equal already is not touched.

    Raises:
        GradingError: If it cannot be written; then what was there is there still.
    """
    data = content if isinstance(content, bytes) else content.encode("utf-8", "backslashreplace")
    try:
        if path.is_file() and path.read_bytes() == data:
            return False
        path.parent.mkdir(parents=True, exist_ok=True)
        _replace(path, data)
    except OSError as error:
        raise GradingError(
            f"{printable(str(path))} cannot be written: {error.strerror or error}.",
            "What was there before is there still, and nothing else was harmed.",
            "Make room, or give another folder, and run the command again; it goes on from there.",
        ) from error
    return True


def _replace(path: Path, data: bytes) -> None:
    beside = path.with_name(f".{uuid4().hex}.part")
    try:
        with beside.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def file_name(learner: str, name: str = "") -> str:
    """Return a file name for a learner: small letters, digits, hyphens, one underscore; no suffix.

    It depends on this learner alone, so it stays the same whoever else is in the class. Unless the
    id is such a name already, a digest of it makes the name this learner's own: `Ana`, `ana` and
    `../ana` are three.
    """
    front = _slug(name) if name != learner else ""
    if _is_plain(learner):
        return f"{front}_{learner}" if front else learner
    digest = sha256(learner.encode("utf-8", "surrogatepass")).hexdigest()[:_DIGEST]
    return "-".join(one for one in (front or _slug(learner) or "learner", digest) if one)


def file_names(learners: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Return a file name without suffix for each learner, given by id and name; no two the same."""
    return {learner: file_name(learner, name) for learner, name in learners}


def _slug(text: str) -> str:
    spelt = text[: 10 * _MOST_OF_A_NAME].translate(_SPELT)
    spelt = unicodedata.normalize("NFKD", spelt)
    plain = spelt.encode("ascii", "ignore").decode("ascii").lower()
    return re.sub(r"[^a-z0-9]+", "-", plain)[:_MOST_OF_A_NAME].strip("-")


def _is_plain(learner: str) -> bool:
    return (
        len(learner) <= _MOST_OF_A_NAME
        and _PLAIN.fullmatch(learner) is not None
        and learner not in _DEVICES
        and not _ENDS_LIKE_A_DIGEST.fullmatch(learner)
    )
