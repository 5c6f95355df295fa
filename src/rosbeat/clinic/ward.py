"""Draw a ward of eleven patients from a seed."""

from __future__ import annotations

from functools import cached_property
from random import Random

from rosbeat.clinic.cases import CASES, HEARD, PAIR, SILENT, Ill
from rosbeat.clinic.charts import Chart
from rosbeat.clinic.houses import PLACES
from rosbeat.clinic.patients import Patient, examined
from rosbeat.errors import ExerciseError, called_as

#: How many patients of each level there are, in this order.
_BEDS = ((SILENT, 4), (HEARD, 4), (PAIR, 3))


class Ward:
    """Draw a ward of patients, which are broken systems; the same seed always draws the same ward.

    Patients 1 to 4 have one fault, and something is silent. Patients 5 to 8 have one fault, and
    nothing is silent. Patients 9 to 11 have two faults.

    Args:
        seed: Seed for the faults of each patient, and for all names and numbers.

    Raises:
        ExerciseError: If the seed is not an integer from 0 to 2**32 - 1.
    """

    @called_as("clinic.Ward(seed=7)")
    def __init__(self, seed: int = 7) -> None:
        if not isinstance(seed, int) or isinstance(seed, bool) or not 0 <= seed < 2**32:
            raise ExerciseError(
                f"There is no ward {seed!r}.",
                "A ward's number, its seed, is a whole number of 0 or more.",
                "For example, write clinic.Ward(seed=7).",
            )
        self.seed = seed

    def __len__(self) -> int:
        return sum(count for _, count in _BEDS)

    def __repr__(self) -> str:
        places = [f"  {at}: {ill.plan.place}" for at, ill in enumerate(self._ill, 1)]
        return "\n".join([f"Ward {self.seed}, {len(self)} patients", *places])

    @called_as("ward.patient(1)")
    def patient(self, number: int) -> Patient:
        """Return one patient, with a new session.

        Args:
            number: Number of the patient, from 1.

        Raises:
            ExerciseError: If there is no such patient.
        """
        return Patient(number, self._at(number), self.seed)

    @called_as("ward.chart(1)")
    def chart(self, number: int) -> Chart:
        """Return the chart of one patient, including the correct diagnoses.

        Args:
            number: Number of the patient, from 1.

        Raises:
            ExerciseError: If there is no such patient.
        """
        return examined(self._at(number), self.seed, number)

    def _at(self, number: int) -> Ill:
        if type(number) is not int or not 1 <= number <= len(self):
            raise ExerciseError(
                f"There is no patient {number!r}.",
                f"The patients of this ward are numbered from 1 to {len(self)}.",
                "For example, write ward.patient(1).",
            )
        return self._ill[number - 1]

    @cached_property
    def _ill(self) -> tuple[Ill, ...]:
        rng = Random(self.seed)
        places = rng.sample(PLACES, len(self))
        kinds = [
            case
            for level, count in _BEDS
            for case in rng.sample([one for one in CASES if one.level == level], count)
        ]
        return tuple(case.drawn(rng, place) for case, place in zip(kinds, places, strict=True))
