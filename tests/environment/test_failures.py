from pathlib import Path

import pytest

from course_tool import failures
from course_tool.messages import Problem, Untouched

PLACE = Path("/home/ada/course/.venv")

# Lines as pip and uv print them.
NETWORK = [
    "error: Failed to fetch: `https://example.invalid/simple/anyio/`\n  Caused by: dns error",
    "Temporary failure in name resolution')': /simple/uv/",
    "ERROR: No matching distribution found for uv==0.13.9",
    "error: Request failed\n  Caused by: operation timed out",
    "  Caused by: tcp connect error: Connection refused (os error 111)",
]
DISK = [
    "ERROR: Could not install packages due to an OSError: [Errno 28] No space left on device",
    "error: failed to write to file: No space left on device (os error 28)",
    "Caused by: Disk quota exceeded (os error 122)",
]
CERTIFICATE = [
    "Caused by: invalid peer certificate: UnknownIssuer",
    "SSLCertVerificationError(1, '[SSL: CERTIFICATE_VERIFY_FAILED] certificate verify failed",
]
HASH = [
    "error: Hash mismatch for `anyio==4.16.0`",
    "ERROR: THESE PACKAGES DO NOT MATCH THE HASHES FROM THE REQUIREMENTS FILE.",
]
PERMISSION = ["error: failed to create directory `/home/ada/.cache/uv`: Permission denied"]
BUILD = ["  x Failed to build `rosbeat @ file:///home/ada/course`\n  The build backend returned"]


def kinds():
    for texts, words in (
        (NETWORK, "cannot be reached"),
        (DISK, "not enough room"),
        (CERTIFICATE, "does not trust"),
        (HASH, "not the one the course was locked to"),
        (PERMISSION, "may not write"),
        (BUILD, "could not be built"),
    ):
        yield from ((text, words) for text in texts)


@pytest.mark.parametrize(("text", "words"), list(kinds()))
def test_last_words_are_understood(text, words):
    problem = failures.installing(text, PLACE)
    assert words in problem.happened
    assert problem.means
    assert problem.cure
    assert problem.details == "\n".join(text.strip().splitlines())


def test_a_full_disk_is_not_taken_for_a_network_that_failed():
    text = "error: Failed to fetch: `anyio`\n  Caused by: No space left on device (os error 28)"
    assert "not enough room" in failures.installing(text, PLACE).happened


def test_an_unknown_end_says_so_and_shows_the_last_lines():
    problem = failures.installing("\n".join(f"line {n}" for n in range(100)), PLACE)
    assert "does not know the reason" in problem.happened
    assert problem.details.splitlines() == [f"line {n}" for n in range(88, 100)]


@pytest.mark.parametrize("text", NETWORK + CERTIFICATE + HASH + BUILD)
def test_what_fails_before_anything_changes(text):
    assert isinstance(failures.installing(text, PLACE), Untouched)


@pytest.mark.parametrize("text", [*DISK, *PERMISSION, "killed"])
def test_what_may_fail_half_way(text):
    problem = failures.installing(text, PLACE)
    assert isinstance(problem, Problem)
    assert not isinstance(problem, Untouched)
