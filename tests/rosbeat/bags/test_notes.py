import pytest

from rosbeat.bags.notes import Notes, notes_in
from rosbeat.bags.writing import record

WHOLE = {
    "rosbeat.session_ns": "5",
    "rosbeat.seed": "7",
    "rosbeat.publishers": '{"/a": ["/b", "/c"]}',
}


def test_whole_notes_are_read():
    assert notes_in(WHOLE) == Notes(5, 7, {"/a": ("/b", "/c")})


@pytest.mark.parametrize("name", WHOLE)
@pytest.mark.parametrize("value", ["", "[", "null", '"a"', '{"/a": 3}', None])
def test_notes_that_are_not_ours_are_none(name, value):
    assert notes_in({**WHOLE, name: value}) is None


@pytest.mark.parametrize("custom", [None, {}, {"rosbeat.seed": "7"}, {"other": "1"}])
def test_a_bag_of_somebody_else_has_none(custom):
    assert notes_in(custom) is None


def test_they_are_in_the_bag(tmp_path, make):
    record(make.run([1.0]), tmp_path / "run")
    text = (tmp_path / "run" / "metadata.yaml").read_text()
    assert all(name in text for name in WHOLE)
