"""A seed draws a ward: every case comes, and the same seed is the same ward."""

import subprocess
import sys

import pytest

from rosbeat import clinic
from rosbeat.clinic.cases import CASES, HEARD, PAIR, SILENT
from rosbeat.clinic.ward import Ward
from rosbeat.errors import ExerciseError

WARDS = [Ward(seed) for seed in range(50)]
LEVELS = [SILENT] * 4 + [HEARD] * 4 + [PAIR] * 3


def drawn(ward):
    return [ward._at(number) for number in range(1, len(ward) + 1)]


def test_over_fifty_seeds_every_case_comes():
    assert {ill.case for ward in WARDS for ill in drawn(ward)} == {case.name for case in CASES}


def test_there_are_enough_cases():
    counts = [sum(case.level == level for case in CASES) for level in (SILENT, HEARD, PAIR)]
    assert all(count >= least for count, least in zip(counts, (8, 8, 3), strict=True)), counts


def test_the_beds_are_the_levels_in_order_and_no_case_lies_in_two():
    level_of = {case.name: case.level for case in CASES}
    for ward in WARDS:
        ill = drawn(ward)
        assert [level_of[one.case] for one in ill] == LEVELS
        assert len({one.case for one in ill}) == len({one.plan.place for one in ill}) == len(ward)


def test_the_same_seed_is_the_same_ward_and_another_one_is_another():
    assert [drawn(Ward(seed)) for seed in range(50)] == [drawn(ward) for ward in WARDS]
    assert len({repr(drawn(ward)) for ward in WARDS}) == len(WARDS)


def test_no_complaint_and_no_order_names_the_cause():
    for ward in WARDS:
        for number in range(1, 12):
            said = repr(ward.patient(number))
            truths = ward._at(number).truths
            assert not any(truth.mistake in said for truth in truths)
            assert "{" not in said
            assert ward.patient(number).complaint in said


@pytest.mark.parametrize("seed", ["7", -1, 7.0, True, None, 2**32])
def test_what_is_no_seed_is_refused(seed):
    with pytest.raises(ExerciseError, match="There is no ward") as found:
        Ward(seed)
    assert found.value.means
    assert found.value.to_try


@pytest.mark.parametrize("number", [0, 12, "1", True, None])
def test_what_is_no_patient_is_refused(number):
    with pytest.raises(ExerciseError, match="There is no patient"):
        Ward(7).patient(number)


def test_a_ward_lists_its_patients():
    assert len(Ward(7)) == 11
    assert repr(Ward(7)).splitlines()[0] == "Ward 7, 11 patients"
    assert "  3: the library" in repr(Ward(7)).splitlines()


def test_the_names_are_there():
    assert sorted(clinic.__all__) == clinic.__all__
    assert all(hasattr(clinic, name) for name in clinic.__all__)


def test_reading_a_chart_needs_no_ros():
    code = (
        "import sys; from rosbeat import clinic; "
        "clinic.Ward(7).patient(1).complaint; sys.exit('rosbeat.clinic.nodes' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
