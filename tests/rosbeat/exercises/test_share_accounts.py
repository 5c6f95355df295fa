"""A folder as docs/instructors.md creates it, used by several accounts of the system.

A test becomes another account in a process of its own, so only root can run these.
"""

import json
import os
import re
import shutil
import tempfile
import warnings
from pathlib import Path

import pytest

from rosbeat.exercises.share import Consent, append
from rosbeat.grading.class_board import shortcomings
from rosbeat.grading.class_folder import ClassFolder
from rosbeat.records import Outcome

pytestmark = pytest.mark.skipif(os.geteuid() != 0, reason="becomes other accounts, as root can")

DOCUMENT = Path(__file__).parents[3] / "docs" / "instructors.md"
#: Accounts and groups that nobody has; a process needs no entry in a table to be one.
LEARNERS, INSTRUCTORS = 61_000, 61_100
ANA, BEN, ADA = 61_001, 61_002, 61_003
NOW = 1_800_000_000
WRONG = Outcome("03a", "failed", mistake="wrong-rate")


@pytest.fixture
def place():
    """The folder of the class, where other accounts can get to it."""
    home = Path(tempfile.mkdtemp(prefix="class-"))
    home.chmod(0o711)
    folder = home / "class"
    folder.mkdir()
    os.chown(folder, ADA, INSTRUCTORS)
    folder.chmod(int(re.search(r"--mode (\d+) /srv/class", DOCUMENT.read_text())[1], 8))
    yield folder
    shutil.rmtree(home)


def become(account, work, group=LEARNERS):
    """Do some work as another account, and return what it returns, or the name of its error."""
    read, write = os.pipe()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the child only makes system calls
        child = os.fork()
    if child == 0:
        try:
            os.setgroups([group])
            os.setresgid(group, group, group)
            os.setresuid(account, account, account)
            os.umask(0o077)
            try:
                answer = work()
            except BaseException as error:
                answer = type(error).__name__
            os.write(write, json.dumps(answer).encode())
        finally:
            os._exit(0)
    os.close(write)
    with os.fdopen(read) as file:
        answer = json.load(file)
    os.waitpid(child, 0)
    return answer


def shared(place, number):
    return Consent(str(place), f"{number:032x}")


@pytest.fixture
def file(place):
    """Ana's file."""
    assert become(ANA, lambda: append(shared(place, 1), WRONG, NOW)) is None
    return shared(place, 1).file


def test_the_folder_of_the_instructions_lacks_nothing(place):
    assert shortcomings(place.stat()) == []


def test_instructors_read_what_learners_of_other_accounts_write(place, file):
    become(BEN, lambda: append(shared(place, 2), WRONG, NOW))
    become(BEN, lambda: append(shared(place, 3), WRONG, NOW))
    assert (file.stat().st_uid, file.stat().st_gid) == (ANA, INSTRUCTORS)

    def read():
        return sorted(len(one.records) for one in ClassFolder(place, lambda: NOW).read().learners)

    assert become(ADA, read, INSTRUCTORS) == [1, 2]
    assert become(ADA, lambda: ClassFolder(place).forget(), INSTRUCTORS) == 3


#: What Ben tries with Ana's file, whose name he would first have to know.
ATTEMPTS = {
    "list the folder": lambda file: os.listdir(file.parent),
    "read": lambda file: file.read_text(),
    "append": lambda file: os.close(os.open(file, os.O_WRONLY | os.O_APPEND)),
    "delete": lambda file: file.unlink(),
    "replace": lambda file: (file.with_name("mine").write_text("x"),
                             os.replace(file.with_name("mine"), file))[1],
    "change the rights": lambda file: file.chmod(0o666),
    "write as Ana": lambda file: append(Consent(str(file.parent), file.stem), WRONG, NOW),
    "forget everybody": lambda file: ClassFolder(file.parent).forget(),
    "look at the class": lambda file: len(ClassFolder(file.parent).read().learners),
}  # fmt: skip


@pytest.mark.parametrize("attempt", ATTEMPTS)
def test_a_learner_cannot_read_or_change_what_another_one_shares(file, attempt):
    before, state = file.read_bytes(), file.stat()
    answer = become(BEN, lambda: ATTEMPTS[attempt](file))
    assert answer in ("PermissionError", "GradingError")
    assert file.read_bytes() == before
    after = file.stat()
    kept = ("st_ino", "st_mode", "st_uid", "st_gid", "st_nlink", "st_mtime_ns")
    assert [getattr(after, one) for one in kept] == [getattr(state, one) for one in kept]


def test_a_file_that_somebody_else_has_put_there_is_not_written_into(place):
    trap = shared(place, 4).file
    become(BEN, lambda: trap.touch() or trap.chmod(0o666))
    assert become(ANA, lambda: append(shared(place, 4), WRONG, NOW)) == "PermissionError"
    assert trap.read_bytes() == b""
