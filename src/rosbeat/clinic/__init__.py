"""Provide the clinic: broken systems of real nodes, to be examined with the course's instruments.

::

    ward = clinic.Ward(seed=7)
    patient = ward.patient(1)
    patient.ros.explain("temperature")
    clinic.names()

A seed determines the ward: the fault of each patient, and all names and numbers. The same seed
always gives the same ward, so a teacher may give each class a ward of its own.
"""

from rosbeat.clinic.names import names as names
from rosbeat.clinic.patients import Patient as Patient
from rosbeat.clinic.ward import Ward as Ward

__all__ = ["Patient", "Ward", "names"]
