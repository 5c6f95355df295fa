import pytest

from rosbeat.diagnosis.explanation_names import difference, nearest

NAME = "/temperature"


@pytest.mark.parametrize(
    "other",
    [
        *("/temprature", "/Temperature", "/temperatures", "/tempearture", "/temperature_1"),
        *("/room/temperature", "/TEMPERATURE", "/temp_erature"),
    ],
)
def test_what_is_almost_the_same_is_found(other):
    assert nearest(NAME, ["/humidity", other]) == other
    assert nearest(other, [NAME, "/humidity"]) == NAME


@pytest.mark.parametrize("other", ["/humidity", "/temp", "/status", "/mean", "/t", "/pressure"])
def test_what_is_another_word_is_not(other):
    assert nearest(NAME, [other]) == ""


def test_the_name_itself_does_not_count():
    assert nearest(NAME, [NAME]) == ""
    assert nearest(NAME, []) == ""


def test_of_two_the_nearer_one_and_always_the_same():
    others = ["/temprature", "/temperatures", "/tmprature"]
    assert nearest(NAME, others) == nearest(NAME, reversed(others)) == "/temperatures"


def test_a_slash_and_an_underscore_are_no_letters():
    assert difference("/room/temperature", "/room_temperature").endswith("in one character")


@pytest.mark.parametrize(
    ("other", "words"),
    [
        ("/Temperature", "capital letters"),
        ("/room/temperature", "before the last slash"),
        ("/temp_erature", "underscores"),
        ("/temprature", "one letter"),
        ("/temperature1", "one character"),
        ("/temprture", "2 letters"),
    ],
)
def test_in_what_they_differ(other, words):
    assert words in difference(NAME, other)
