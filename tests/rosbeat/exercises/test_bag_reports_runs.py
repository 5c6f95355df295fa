"""A function is handed one bag after the other, and asked once about each."""

import pytest

from rosbeat.exercises.bag_report_runs import RECORDINGS, look_into_bags, words_beside

pytestmark = pytest.mark.ros


def test_each_bag_holds_its_readings_and_another_topic():
    found = []

    def look(bag):
        found.append((len(bag.messages("temperature")), len(bag.messages("status"))))
        return {"messages": found[-1][0]}

    seen = look_into_bags(look)
    assert found == [(len(one), len(words_beside(one))) for one in RECORDINGS]
    assert [one.value["messages"] for one in seen.reports] == [len(one) for one in RECORDINGS]
    assert sum(here != other for here, other in found) > 1  # who counts the other topic is noticed


def test_the_first_bag_without_a_result_is_the_last():
    seen = look_into_bags(lambda bag: 1 / 0)
    assert len(seen.reports) == 1
    assert seen.reports[0].problem.startswith("ZeroDivisionError")
