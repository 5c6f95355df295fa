"""Leases on domain ids: one holder each, free again however the holder ends."""

import os
import subprocess
import sys

import pytest

from rosbeat import Session
from rosbeat.domains import lease_domain
from rosbeat.errors import DomainsExhaustedError

FEW = range(90, 93)


@pytest.fixture
def all_taken():
    leases, error = [], None
    while error is None:
        try:
            leases.append(lease_domain(FEW))
        except DomainsExhaustedError as refusal:
            error = refusal
    yield leases, error
    for lease in leases:
        lease.release()


def test_each_id_has_one_holder(all_taken, says):
    leases, error = all_taken
    ids = [lease.domain_id for lease in leases]
    assert len(set(ids)) == len(ids) <= len(FEW)
    says(error, "All 3 ROS domain ids for checks and builds", "Wait until other checks")


def test_a_released_id_can_be_taken_again(all_taken):
    leases, _ = all_taken
    if not leases:
        pytest.skip("others hold all of them")
    lease = leases.pop()
    lease.release()
    lease.release()
    again = lease_domain(range(lease.domain_id, lease.domain_id + 1))
    assert again.domain_id == lease.domain_id
    again.release()


def test_a_process_that_crashes_gives_its_id_back(eventually):
    code = (
        "import os, sys; from rosbeat.domains import lease_domain; lease = lease_domain(); "
        "print(lease.domain_id, flush=True); sys.stdin.read(1); os.abort()"
    )
    environ = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    with subprocess.Popen(
        [sys.executable, "-c", code], env=environ, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
    ) as process:  # fmt: skip
        number = int(process.stdout.readline())
        with pytest.raises(DomainsExhaustedError):
            lease_domain(range(number, number + 1))
        process.communicate("x")
    assert process.returncode < 0

    def free():
        try:
            lease_domain(range(number, number + 1)).release()
        except DomainsExhaustedError:
            return False
        return True

    eventually(free)


def test_a_chosen_domain_needs_no_lease():
    with Session(domain_id=49) as one, Session(domain_id=49) as two:
        assert one.domain_id == two.domain_id == 49


def test_an_id_in_which_somebody_still_speaks_is_not_given_out():
    lease = lease_domain()
    number = lease.domain_id
    lease.release()
    with Session(domain_id=number), pytest.raises(DomainsExhaustedError):
        lease_domain(range(number, number + 1))
    lease_domain(range(number, number + 1)).release()
