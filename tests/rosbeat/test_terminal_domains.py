"""Domains of terminals: one per user and checkout, held by what opens terminals."""

import os
import subprocess
import sys
from contextlib import contextmanager

import pytest

from rosbeat import Session, environment
from rosbeat.domains import TERMINAL_IDS, lease_domain, lease_terminal_domain
from rosbeat.errors import DomainsExhaustedError

HERE, THERE = "/home/ada/course/.venv", "/home/ada/course-2/.venv"
#: Few ids, so that they run out; others for each process that runs these tests.
FEW = range(start := 110 + os.getpid() % 20 * 4, start + 4)
#: A value that the course has chosen, which a lease may replace.
CHOSEN = {"ROS_DOMAIN_ID": "0", "ROSBEAT_DOMAIN_ID": "0"}
#: What a process does that holds the domain for its terminals.
HOLDERS = {
    "kernel": ["-m", "IPython", "--no-banner", "-c", "import rosbeat"],
    "server": ["-c", "import rosbeat.jupyter_lease as j; j._load_jupyter_server_extension(None)"],
}
AND_WAIT = "; import os, sys; print(os.environ['ROS_DOMAIN_ID'], flush=True); sys.stdin.read(1)"


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    """A home in which no id is remembered."""
    monkeypatch.setenv("HOME", str(tmp_path))
    return tmp_path


@pytest.fixture
def lease():
    """Take leases, and give them back at the end."""
    taken = []

    def take(prefix=HERE, ids=TERMINAL_IDS):
        taken.append(lease_terminal_domain({}, prefix, ids))
        return taken[-1]

    yield take
    for one in taken:
        one.release()


def is_free(domain_id):
    try:
        lease_domain(range(domain_id, domain_id + 1)).release()
    except DomainsExhaustedError:
        return False
    return True


@contextmanager
def holder(kind):
    """A process that holds this checkout's domain, and the domain."""
    *options, code = HOLDERS[kind]
    environ = {**os.environ, **CHOSEN, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    with subprocess.Popen(
        [sys.executable, *options, code + AND_WAIT], env=environ, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
    ) as process:  # fmt: skip
        try:
            yield process, int(process.stdout.readline())
        finally:
            process.kill()


def test_servers_kernels_and_shells_of_a_checkout_share_an_id(lease):
    one, other = lease(), lease()
    assert one.domain_id == other.domain_id
    one.release()
    assert not is_free(other.domain_id)


@pytest.mark.parametrize("kind", HOLDERS)
def test_an_id_is_free_when_its_last_holder_was_killed(kind, eventually):
    with holder(kind) as (one, domain_id), holder(kind) as (other, same):
        assert same == domain_id in TERMINAL_IDS
        one.kill()
        one.wait()
        assert not is_free(domain_id)
        other.kill()
        other.wait()
        eventually(lambda: is_free(domain_id))


def test_a_lease_goes_on_to_what_a_shell_starts(eventually):
    code = (
        "import os; from rosbeat.domains import lease_terminal_domain as take; found = {}; "
        "take(found).keep_across_exec(); os.environ.update(found); "
        "os.execvp('bash', ['bash', '-c', 'bash -c \"echo $ROS_DOMAIN_ID; read\"; :'])"
    )
    environ = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    with subprocess.Popen(
        [sys.executable, "-c", code], env=environ, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
    ) as process:  # fmt: skip
        domain_id = int(process.stdout.readline())
        assert not is_free(domain_id)
        process.communicate("\n")
    eventually(lambda: is_free(domain_id))


def test_two_checkouts_have_two_ids(lease):
    ids = [lease(prefix).domain_id for prefix in (HERE, THERE, HERE, THERE)]
    assert ids[:2] == ids[2:]
    assert ids[0] != ids[1]


def test_a_python_without_a_lease_uses_the_leased_id(lease):
    found = lease(ids=FEW).domain_id
    environ = {}
    environment.apply(environ, HERE)
    assert environ["ROS_DOMAIN_ID"] == environ["ROSBEAT_DOMAIN_ID"] == str(found)
    environment.apply(environ := {}, THERE)
    assert environ["ROS_DOMAIN_ID"] == str(environment.usual_domain_id(THERE))


def test_a_server_gets_back_the_id_that_it_had(lease):
    first = lease(ids=FEW)
    first.release()
    with Session(domain_id=first.domain_id):  # a node that outlived it
        assert lease().domain_id == first.domain_id


def test_an_id_that_another_checkout_took_meanwhile_does_not_come_back(lease):
    first = lease(ids=FEW)
    first.release()
    only = range(first.domain_id, first.domain_id + 1)
    assert lease(THERE, only).domain_id == first.domain_id
    assert lease(HERE).domain_id != first.domain_id


def test_nobody_gets_an_id_in_which_another_ones_nodes_are(lease):
    first = lease(ids=FEW)
    first.release()
    only = range(first.domain_id, first.domain_id + 1)
    with Session(domain_id=first.domain_id), pytest.raises(DomainsExhaustedError):
        lease(THERE, only)


@pytest.mark.parametrize(
    "environ",
    [{"ROS_DOMAIN_ID": "7"}, {"ROS_DOMAIN_ID": "7", "ROSBEAT_DOMAIN_ID": "8"}],
    ids=["nothing else", "instead of ours"],
)
def test_what_somebody_chose_stays(environ):
    before = dict(environ)
    assert lease_terminal_domain(environ, HERE) is None
    assert environ == before


def test_what_the_course_chose_gives_way_to_a_lease():
    environ = dict(CHOSEN)
    found = lease_terminal_domain(environ, HERE)
    assert environ == dict.fromkeys(CHOSEN, str(found.domain_id))
    found.release()


def test_more_users_than_ids(lease, says):
    ids, error = [], None
    while error is None:
        try:
            ids.append(lease(f"/home/{len(ids)}/.venv", FEW).domain_id)
        except DomainsExhaustedError as refusal:
            error = refusal
    assert len(set(ids)) == len(ids)
    assert set(ids) <= set(FEW)
    says(error, "All 4 ROS domain ids for terminals", "nodes may find each other", "export")
    environ = dict(CHOSEN)
    with pytest.raises(DomainsExhaustedError):
        lease_terminal_domain(environ, "/home/late/.venv", FEW)
    assert environ == CHOSEN


def test_a_home_that_cannot_be_written_in(monkeypatch):
    monkeypatch.setenv("HOME", "/proc/nowhere")
    assert lease_terminal_domain({}, HERE) is None


def test_only_the_user_may_look_at_the_ids(lease, home):
    lease()
    assert (home / ".cache" / "rosbeat").stat().st_mode & 0o777 == 0o700


@pytest.mark.skipif(os.geteuid() != 0, reason="needs root, to become another user")
def test_another_user_gets_another_id(lease, tmp_path):
    mine = lease(ids=FEW).domain_id
    other_home = tmp_path / "other"
    other_home.mkdir()
    os.chown(other_home, 61_000, 61_000)
    tmp_path.chmod(0o755)
    # The other user may not be able to read the installation: everything is imported before.
    code = (
        "import encodings.ascii, os; from rosbeat import Session; "
        "from rosbeat.domains import lease_terminal_domain as take; "
        "from rosbeat.errors import DomainsExhaustedError; os.setgid(61000); os.setuid(61000)\n"
        f"try: print(take({{}}, {HERE!r}, range({mine}, {mine + 1})))\n"
        "except DomainsExhaustedError: print('refused')\n"
        f"print(take({{}}, {HERE!r}).domain_id)\n"
    )
    environ = {
        **os.environ, "HOME": f"/proc/self/cwd/{other_home.name}",
        "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
    }  # fmt: skip
    done = subprocess.run(
        [sys.executable, "-c", code], env=environ, cwd=tmp_path,
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    refused, theirs = done.stdout.split()
    assert refused == "refused"
    assert int(theirs) not in (0, mine)
