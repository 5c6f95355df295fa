"""Provide the clinic: broken systems of real nodes, to be examined with the course's instruments.

::

    ward = clinic.Ward(seed=7)
    patient = ward.patient(1)
    patient.ros.explain("temperature")
    clinic.names()

A seed determines the ward: the fault of each patient, and all names and numbers. The same seed
always gives the same ward, so a teacher may give each class a ward of its own.

- `systems` describes systems as plain data, and draws healthy ones; `nodes` has their real nodes;
- `faults` breaks a system, and lists the cases with what their owners say;
- `patients` draws a ward, and runs its patients;
- `charts` summarizes what the instruments show, and `diagnoses` what contradicts a diagnosis.
"""

from rosbeat.clinic.diagnoses import names as names
from rosbeat.clinic.patients import Patient as Patient
from rosbeat.clinic.patients import Ward as Ward

__all__ = ["Patient", "Ward", "names"]
