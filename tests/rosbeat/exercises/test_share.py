"""Sharing with a class: off by default, exactly what was agreed to, and never in a check's way."""

import errno
import getpass
import json
import os
import stat
import threading

import pytest
from answers import HUMIDITY, made  # the folder is put on the path by conftest.py

from rosbeat import check, cli
from rosbeat.exercises import share as sharing
from rosbeat.exercises.exercise import not_attempted
from rosbeat.exercises.share import DAY, FILE_NAME, LARGEST, append, consent, share
from rosbeat.grading.class_folder import ClassFolder
from rosbeat.records import Outcome

NOW = 1_800_000_000
SECRET = "a_secret_of_mine"


@pytest.fixture(autouse=True)
def own(tmp_path, monkeypatch):
    """A learner's own folder, which holds progress and consent."""
    folder = tmp_path / "own"
    monkeypatch.setenv("ROSBEAT_PROGRESS_IN", str(folder))
    monkeypatch.delenv("ROSBEAT_CLASS", raising=False)
    return folder


@pytest.fixture
def eventually(eventually):
    """Wait for the thread that writes, however busy the machine is."""
    return lambda predicate: eventually(predicate, 60.0)


@pytest.fixture
def place(tmp_path, monkeypatch):
    """The folder of the class."""
    folder = tmp_path / "class"
    folder.mkdir()
    monkeypatch.setenv("ROSBEAT_CLASS", str(folder))
    return folder


@pytest.fixture
def shares(place, capsys):
    assert cli.main(["share", "on"]) == 0
    capsys.readouterr()
    return consent()


def lines(agreed=None):
    """The lines of the learner's file."""
    return [json.loads(one) for one in (agreed or consent()).file.read_text().splitlines()]


def wrong(exercise="03a", mistake="wrong-depth"):
    return Outcome(exercise, "failed", f"{SECRET} was seen.", "Try it.", mistake)


def written(agreed, outcome=None, now=NOW):
    append(agreed, outcome or wrong(), now)
    return lines(agreed)


# Off by default, on, and off again.


@pytest.mark.ros
def test_a_check_writes_nothing_unless_somebody_has_turned_it_on(place, own, monkeypatch):
    monkeypatch.setattr(sharing, "_writer", lambda: pytest.fail("nothing is to be written"))
    check("03a", made("03a", HUMIDITY))
    assert list(place.iterdir()) == []
    assert not (own / ".rosbeat" / "share.json").exists()


@pytest.mark.ros
def test_a_check_writes_these_fields_and_no_others(shares, place, eventually):
    outcome = check("03a", made("03a", HUMIDITY, ("5)", "10)"))).outcome
    eventually(lines)
    check("03a", made("03a", HUMIDITY, ('"humidity"', "____")))
    check("03a", made("03a", HUMIDITY))
    eventually(lambda: len(lines()) == 2)
    first, second = lines()
    assert isinstance(first.pop("time"), int)
    assert first == {"exercise": "03a", "status": "failed", "mistake": outcome.mistake}
    assert {**second, "time": 0} == {
        "exercise": "03a", "status": "passed", "mistake": "", "time": 0
    }  # fmt: skip
    assert [one.name for one in place.iterdir()] == [f"{shares.id}.jsonl"]


def test_an_id_is_random_and_says_nothing_about_the_learner(place):
    ids = set()
    for _ in range(3):
        cli.main(["share", "on"])
        ids.add(consent().id)
        cli.main(["share", "off"])
    assert len(ids) == 3
    assert all(FILE_NAME.fullmatch(f"{one}.jsonl") for one in ids)
    assert not any(getpass.getuser() in one for one in ids)


def test_a_name_is_written_only_if_the_learner_says_so(shares, place):
    assert "name" not in written(shares)[0]
    cli.main(["share", "on", "--name", " Ada\u202e\n" + "x" * 100])
    agreed = consent()
    assert agreed.name == "Ada" + "x" * 37
    assert written(agreed)[0]["name"] == agreed.name
    # What was written without a name can't be found beside what has one.
    assert agreed.id != shares.id
    assert [one.name for one in place.iterdir()] == [f"{agreed.id}.jsonl"]


def test_the_longest_name_is_read_in_any_script(shares, place):
    cli.main(["share", "on", "--name", "\N{ROBOT FACE}" * 60])
    written(consent())
    assert [one.name for one in ClassFolder(place, lambda: NOW).read().learners] == [
        "\N{ROBOT FACE}" * 40
    ]


def test_off_deletes_what_was_written(shares, place, capsys):
    written(shares)
    assert cli.main(["share", "off"]) == 0
    assert f"{shares.file} is deleted." in capsys.readouterr().out
    assert list(place.iterdir()) == []
    share(wrong())
    assert consent() is None
    assert cli.main(["share", "off"]) == 0
    assert "Sharing is off" in capsys.readouterr().out


def test_the_command_says_what_is_written_and_where(place, capsys):
    assert cli.main(["share"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert said.startswith("Sharing is off")
    assert str(place) in said
    cli.main(["share", "on", "--name", "Ada"])
    written(consent())
    capsys.readouterr()
    assert cli.main(["share"]) == 0
    text = capsys.readouterr().out
    said = " ".join(text.split())
    assert "Sharing is on, under the name Ada." in said
    assert f"{consent().file} (1 line so far)" in said
    assert consent().file.read_text().strip() in text
    assert "`rosbeat share off` stops sharing and deletes the file." in said


def test_without_a_class_there_is_nothing_to_turn_on(capsys, tmp_path):
    assert cli.main(["share"]) == 0
    assert "No class is set up on this computer" in capsys.readouterr().out
    assert cli.main(["share", "on"]) == cli.MISUSED
    said = capsys.readouterr().err
    assert all(part in said for part in ("No class", "What it means:", "--class FOLDER"))
    assert cli.main(["share", "on", "--class", str(tmp_path / "gone")]) == cli.MISUSED
    said = capsys.readouterr().err
    assert all(part in said for part in ("No such file", "Nothing was turned on"))
    assert cli.main(["share", "off", "--name", "Ada"]) == cli.MISUSED
    assert "go with `rosbeat share on`" in capsys.readouterr().err
    assert consent() is None


def test_a_page_that_does_not_count_shares_nothing(shares, monkeypatch, eventually, own):
    monkeypatch.setenv("ROSBEAT_WORKSPACE_IN", str(own))
    monkeypatch.delenv("ROSBEAT_PROGRESS_IN")  # a program, and no page
    assert consent() == shares
    share(wrong())
    monkeypatch.setenv("ROSBEAT_PROGRESS_IN", str(own))
    share(Outcome("03a", "passed"))
    eventually(lambda: shares.file.read_text())
    assert [one["status"] for one in lines(shares)] == ["passed"]


def test_a_consent_that_was_edited_counts_as_none(shares, own):
    file = own / ".rosbeat" / "share.json"
    for text in ("", "{}", '{"folder": "/", "id": "../x"}', '{"folder": "/", "id": 1}', "[" * 9999):
        file.write_text(text)
        assert consent() is None
        share(wrong())


# The file.


def test_a_file_is_its_owners_and_in_a_folder_with_a_group_of_its_own_that_may_read(shares, place):
    before = os.umask(0o077)
    try:
        written(shares)
        assert stat.S_IMODE(shares.file.stat().st_mode) == 0o600
        place.chmod(0o3733)
        written(shares)
        assert stat.S_IMODE(shares.file.stat().st_mode) == 0o640
    finally:
        os.umask(before)


def test_lines_older_than_a_day_go(shares):
    written(shares, wrong("00a"), NOW - DAY - 5)
    written(shares, wrong("00b"), NOW - 60)
    assert [one["exercise"] for one in written(shares, wrong("03a"))] == ["00b", "03a"]


def test_a_file_stays_small_and_keeps_the_newest(shares):
    line = json.dumps({"exercise": "03a", "status": "failed", "mistake": "x" * 40, "time": NOW})
    shares.file.write_text(f"{line}\n" * (LARGEST // len(line)))
    found = written(shares, wrong("13b"))
    assert found[-1]["exercise"] == "13b"
    assert len(found) > 100
    assert shares.file.stat().st_size < LARGEST


def test_what_a_full_disk_has_broken_off_does_not_break_the_next_line(shares):
    written(shares)
    with shares.file.open("a") as file:
        file.write('{"exercise": "03a", "sta')
    assert len(written(shares)) == 2


# Failing places.


def a_link(path):
    target = path.parent.parent / "somebody_elses"
    target.write_text("kept")
    path.symlink_to(target)


def test_a_link_in_the_place_of_the_file_is_replaced_and_not_followed(shares, place):
    shares.file.unlink()
    a_link(shares.file)
    assert len(written(shares)) == 1
    assert (place.parent / "somebody_elses").read_text() == "kept"


@pytest.mark.parametrize("is_gone", [True, False])
def test_whatever_is_in_the_place_of_the_file_or_the_folder_a_check_goes_on(shares, is_gone):
    shares.file.unlink()
    if is_gone:
        shares.file.parent.rmdir()
    else:
        shares.file.mkdir()
    with pytest.raises(OSError, match=r"."):
        append(shares, wrong(), NOW)
    share(wrong())


def test_a_full_disk_is_not_told(shares, monkeypatch, eventually):
    tried = threading.Event()

    def full(*_):
        tried.set()
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(sharing, "write", full)
        share(wrong())
        assert tried.wait(60)
    share(wrong())
    eventually(lambda: shares.file.read_text())


@pytest.mark.ros
def test_a_folder_that_hangs_holds_nobody_up(shares, monkeypatch, eventually):
    hangs, goes_on = threading.Event(), threading.Event()

    def slow(*given):
        hangs.set()
        assert goes_on.wait(60)
        append(*given)

    monkeypatch.setattr(sharing, "append", slow)
    assert check("03a", made("03a", HUMIDITY)).outcome.status == "passed"
    assert hangs.wait(60)
    share(wrong())
    assert not shares.file.read_text()
    goes_on.set()
    eventually(lambda: len(lines()) == 2)


def test_a_blank_is_not_shared(shares, eventually):
    share(not_attempted())
    share(Outcome("03a", "passed"))
    eventually(lambda: shares.file.read_text())
    assert [one["status"] for one in lines()] == ["passed"]
