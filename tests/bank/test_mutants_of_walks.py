"""The same as `test_mutants` for the two exercises whose node walks for an hour."""

import pytest

from bank import report


@pytest.mark.ros
@pytest.mark.timeout(600)  # 130 checks of 3600 readings each
@pytest.mark.parametrize("exercise", ["03b", "03c"])
def test_what_survives_is_listed_with_a_reason(exercise):
    report.assert_listed(exercise)
