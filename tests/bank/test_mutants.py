"""Each mutant of a reference solution is refused, or docs/mutants.md says why it may pass."""

import ast
from functools import cache

import pytest

from bank import report
from bank.mutants import mutants
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


SENSOR = """
class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.create_timer(1.0, self.tick)

    def tick(self):
        if self.value > 2 and self.on:
            self.value += -max(3.0, self.value)
            self.done = not self.on
            self.send(String(data="x"))
        else:
            return self.last[-5:]
"""


@cache
def made():
    """Return the texts of the sensor's mutants by their changes."""
    return {mutant.change: mutant.text for mutant in mutants(SENSOR)}


@pytest.mark.parametrize(
    "change",
    [
        "line 4: `super().__init__('sensor')` → gone",
        "line 4: `super().__init__('sensor')` → below `self.create_timer(1.0, self.tick)`",
        "line 4: `'sensor'` → `'senso'`",
        "line 5: `1.0` → `2.0`",
        "line 5: `1.0` → `1`",
        "line 5: `self.create_timer(1.0, self.tick)` → `self.create_timer(self.tick, 1.0)`",
        "line 5: `self.create_timer(1.0, self.tick)` → `self.create_timer(1.0)`",
        "line 5: `self.tick` → `self.tick()`",
        "line 5: `self.tick` → `tick`",
        "line 5: `self.tick` → `self.tickx`",
        "line 7: `def tick(self):` → `def tick():`",
        "line 7: `def tick(self):` → `def tick(self, other):`",
        "line 8: `self.value > 2` → `self.value >= 2`",
        "line 8: `self.value > 2 and self.on` → `self.value > 2 or self.on`",
        "line 8: `self.value > 2 and self.on` → `self.value > 2`",
        "line 10: `not self.on` → `self.on`",
        "line 8: `if self.value > 2 and self.on:` → `if True:`",
        "line 9: `max(3.0, self.value)` → `max(self.value, 3.0)`",
        "line 9: `max` → `min`",
        "line 9: `-max(3.0, self.value)` → `max(3.0, self.value)`",
        "line 9: `self.value += -max(3.0, self.value)` → `self.value = -max(3.0, self.value)`",
        "line 11: `String(data='x')` → `'x'`",
        "line 11: `String(data='x')` → `String`",
        "line 11: `String(data='x')` → `String(datax='x')`",
        "line 11: `String` → `Float32`",
        "line 13: `return self.last[-5:]` → `return`",
        "line 13: `-5:` → `:`",
        "line 13: `5` → `6`",
    ],
)
def test_a_program_is_changed_in_every_way(change):
    assert change in made()


def test_each_mutant_is_a_program_of_its_own():
    texts = list(made().values())
    assert len(set(texts)) == len(texts)
    assert ast.unparse(ast.parse(SENSOR)) not in texts
    for text in texts:
        compile(text, "mutant", "exec")


def test_the_page_keeps_its_reasons_and_asks_for_new_ones():
    rows = {"line 4: `a | b` → gone": "Because.", "line 5: `c` → `d`": report.OPEN}
    body = "\n".join(f"| {report._in_table(change)} | {why} |" for change, why in rows.items())
    page = f"| 03a | 72 | 2 |\n\n## 03a\n\n| change | why |\n|---|---|\n{body}\n"
    assert report.read(page) == {"03a": rows}
    assert report.counts(page) == {"03a": (72, 2)}
