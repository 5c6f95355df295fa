"""What a learner gets from `from rosbeat import clinic`."""

import subprocess
import sys

from rosbeat import clinic


def test_the_names_are_there():
    assert sorted(clinic.__all__) == clinic.__all__
    assert all(hasattr(clinic, name) for name in clinic.__all__)


def test_reading_a_chart_needs_no_ros():
    code = (
        "import sys; from rosbeat import clinic; "
        "clinic.Ward(7).patient(1).complaint; sys.exit('rosbeat.clinic.nodes' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
