"""Which results can be read as diagnoses, and what they say."""

import json

import pytest

from rosbeat.exercises.claims import Claim, claims_of, shape, ward_of

PATIENTS = range(1, 5)


def plain(value):
    """As a report holds it."""
    return json.loads(json.dumps(value))


def of(value, number=1):
    return claims_of(plain(value), number)


def test_a_pair_is_one_diagnosis():
    assert of({1: ("a", "/b")}) == [Claim("a", "/b")] == of({"1": [[" a ", "/b "]]})


def test_a_list_of_pairs_is_several():
    assert of({1: [("a", "/b"), ("c", "/d")]}) == [Claim("a", "/b"), Claim("c", "/d")]


NO_DIAGNOSIS = (
    {},
    {2: ("a", "b")},
    {1: []},
    {1: ("____", "____")},
    {1: ("a", "____")},
    {1: ("", "")},
    {1: [("____", "b")]},
)


@pytest.mark.parametrize("value", NO_DIAGNOSIS)
def test_blanks_are_no_diagnosis(value):
    assert of(value) == []
    assert shape("10a", plain(value), PATIENTS) is None


@pytest.mark.parametrize(("value", "ward"), [({}, 7), ({"ward": 9}, 9), ({"ward": "9"}, None),
                                             ({"ward": -1}, None), ({"ward": True}, None),
                                             ([], None), (None, None)])  # fmt: skip
def test_the_ward_is_that_of_the_page_unless_another_one_is_named(value, ward):
    assert ward_of(value) == ward


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ([], "a list, and no dict"),
        ("x", "a str, and no dict"),
        ({"ward": "seven"}, "no ward 'seven'"),
        ({9: ("a", "b")}, "a key 9. Patients 1 to 4 are asked for"),
        ({"first": ("a", "b")}, "a key first"),
        ({1: "a"}, "at patient 1 is no pair"),
        ({1: ("a",)}, "no pair"),
        ({1: ("a", 3)}, "no pair"),
        ({1: [("a", "b"), "c"]}, "no pair"),
        ({1: [("a", "b", "c")]}, "no pair"),
        ({1: {"a": "b"}}, "no pair"),
        ({1: None}, "no pair"),
    ],
)
def test_what_cannot_be_read_is_said(value, said):
    found = shape("10a", plain(value), PATIENTS)
    assert found.mistake == "no-diagnoses"
    assert said in found.evidence
    assert found.hint
