"""The greenhouse of page 07."""

import pytest

from rosbeat import Session
from rosbeat.scenarios.stranger import greenhouse

pytestmark = pytest.mark.ros


def test_it_moves_into_any_session():
    with Session() as ros:
        greenhouse(ros)
        assert len(ros.nodes) == 5
