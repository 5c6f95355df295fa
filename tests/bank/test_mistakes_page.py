"""docs/mistakes.md names every mistake of the table as the code does."""

import re

import pytest

from bank.pages import ROOT
from rosbeat.diagnosis import mistakes
from rosbeat.diagnosis.mistakes import MISTAKES

PAGE = (ROOT / "docs" / "mistakes.md").read_text(encoding="utf-8")
PLACES = {"check", "terminal", "package", "explain"}
ROW = re.compile(r"^\| (\d+) \| (.*): `([\w-]+)` \| (.+) \| (.+) \| (.+) \|$")

ROWS = [found.groups() for found in map(ROW.match, PAGE.splitlines()) if found]


def test_rows_titles_and_ids_are_those_of_the_code():
    listed = [(int(row), title.replace("\\", ""), name) for row, title, name, *_ in ROWS]
    wanted = [(one.row, one.title, one.id) for one in MISTAKES.values() if one.row]
    assert listed == wanted


def test_all_thirty_rows_are_there():
    assert {int(row) for row, *_ in ROWS} == set(range(1, 31))


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[2])
def test_a_row_says_where_and_how(row):
    *_, seen, how, where = row
    assert len(seen) > 5
    assert len(how) > 10
    assert set(where.split(", ")) <= PLACES


def test_no_line_of_the_table_is_out_of_form():
    table = [line for line in PAGE.splitlines() if re.match(r"\| \d+ \|", line)]
    assert len(table) == len(ROWS)


def test_no_id_is_given_twice():
    parts = (mistakes._OF_THE_TABLE, mistakes._PAGES_00_TO_06, mistakes._PAGES_07_TO_13)
    assert len(MISTAKES) == sum(len(part) for part in parts)
