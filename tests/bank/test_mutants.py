"""Each mutant of a reference solution is refused, or docs/mutants.md says why it may pass."""

import pytest

from bank import report
from bank.pages import NODE_EXERCISES, solution, subject
from bank.running import outcome_of

PAGE = report.PAGE.read_text(encoding="utf-8")

#: In every run, a node that publishes and one that listens; the others, some minutes, in a thorough
#: one. What they would notice the bank notices, too: each suspect and each named mistake has an
#: answer of its own there.
ALWAYS = ("00b", "04a")


@pytest.mark.ros
@pytest.mark.parametrize("exercise", NODE_EXERCISES)
def test_the_reference_solution_passes(exercise):
    outcome = outcome_of(exercise, solution(exercise), subject(exercise))
    assert (outcome.status, outcome.remarks) == ("passed", ()), outcome


@pytest.mark.ros
@pytest.mark.timeout(600)  # up to 250 checks; some of 3600 readings each
@pytest.mark.parametrize(
    "exercise",
    [
        one if one in ALWAYS else pytest.param(one, marks=pytest.mark.thorough)
        for one in NODE_EXERCISES
    ],
)
def test_what_survives_is_listed_with_a_reason(exercise):
    report.assert_listed(exercise)


@pytest.mark.parametrize("exercise", NODE_EXERCISES)
def test_the_page_counts_as_it_lists(exercise):
    made, alive = report.counts(PAGE)[exercise]
    assert made == len(report.mutants_of(exercise)) >= 50
    assert alive == len(report.read(PAGE)[exercise])


def test_the_page_keeps_its_reasons_and_asks_for_new_ones():
    rows = {"line 4: `a | b` → gone": "Because.", "line 5: `c` → `d`": report.OPEN}
    body = "\n".join(f"| {report._in_table(change)} | {why} |" for change, why in rows.items())
    page = f"| 03a | 72 | 2 |\n\n## 03a\n\n| change | why |\n|---|---|\n{body}\n"
    assert report.read(page) == {"03a": rows}
    assert report.counts(page) == {"03a": (72, 2)}
