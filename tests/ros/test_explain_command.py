"""The command `rosbeat explain`, beside nodes in processes of their own."""

from contextlib import ExitStack

import pytest

from other_process import other_process
from rosbeat import cli
from rosbeat.diagnosis.topic_snapshot import StaleBuild
from rosbeat.domains import lease_domain
from rosbeat.environment import SHARED_DOMAINS
from rosbeat.explain_command import explain_domain

pytestmark = pytest.mark.ros
NODES = (
    "Talker(period=0.1), Listener(), Listener('other', 'cuont'), "
    "Talker('weak', 'weak', 0.1, qos=qos_profile_sensor_data), Listener('strong', 'weak'), "
    # As `ros2 topic pub` and `ros2 topic echo` name theirs.
    "Talker('_ros2cli_1', 'typed', 0.1), Listener('_ros2cli_2', 'typed'), "
    "Talker('_ros2cli_3', 'rare', 0.1, qos=qos_profile_sensor_data), Listener('ear', 'rare'),"
)
SETUP = "__import__('builtins').__dict__.update(vars(__import__('rclpy.qos').qos)) or "


@pytest.fixture(scope="module")
def domain():
    with ExitStack() as stack:
        lease = lease_domain()
        stack.callback(lease.release)
        stack.enter_context(other_process(lease.domain_id, f"*({SETUP}()), {NODES}"))
        yield lease.domain_id


@pytest.fixture
def empty():
    lease = lease_domain()
    yield lease.domain_id
    lease.release()


def explain(*words):
    return cli.main(["explain", *map(str, words)])


def test_all_is_well(domain, capsys):
    assert explain("count", "--domain-id", domain, "--seconds", 20) == 0
    said = capsys.readouterr()
    assert "All is well on /count" in said.out
    assert "are sent to /listener" in said.out
    assert said.err == ""


def test_nobody_publishes_and_the_near_name(domain, capsys):
    assert explain("cuont", "--domain-id", domain, "--seconds", 20) == cli.FAILED
    assert "No node publishes on /cuont" in capsys.readouterr().out
    assert explain("counts", "--domain-id", domain) == cli.FAILED
    assert "Did you mean /count?" in capsys.readouterr().out


def test_qualities_of_both_ends(domain, capsys):
    assert explain("weak", "--domain-id", domain, "--seconds", 20) == cli.FAILED
    said = capsys.readouterr().out
    assert "/weak offers BEST_EFFORT, but /strong requests RELIABLE" in " ".join(said.split())
    assert "/weak publishes Int32 (BEST_EFFORT, VOLATILE)" in said


def test_nodes_of_commands_count(domain, capsys):
    assert explain("typed", "--domain-id", domain, "--seconds", 20) == 0
    said = capsys.readouterr().out
    assert "are sent to /_ros2cli_2" in said
    assert "/_ros2cli_1 publishes Int32" in said
    assert explain("rare", "--domain-id", domain, "--seconds", 20) == cli.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert "/_ros2cli_3 offers BEST_EFFORT, but /ear requests RELIABLE" in said


def test_the_domain_of_the_terminal(domain, capsys, monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    assert explain("nothing_like_it") == cli.FAILED
    assert "Topics in use: /count" in capsys.readouterr().out


def test_another_domain(empty, capsys):
    with ExitStack() as stack:
        there = lease_domain(SHARED_DOMAINS)
        stack.callback(there.release)
        stack.enter_context(other_process(there.domain_id, "Talker('abroad', 'far_away'),"))
        assert explain("far_away", "--domain-id", empty) == cli.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert f"In ROS domain {there.domain_id}, /abroad publishes on /far_away" in said
    assert f"this is domain {empty}" in said


def test_a_build_that_is_older_than_its_source(empty):
    build = StaleBuild("sensor_simulator", "temperature_publisher", "a/b.py")
    asked = []
    found = explain_domain("count", empty, 0, lambda topic: asked.append(topic) or (build,))
    assert asked == ["/count"]
    assert [one.mistake for one in found.diagnoses] == ["not-rebuilt", "topic-unknown"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["room temperature"], "cannot be the name of a topic"),
        (["count", "--seconds", "-1"], "--seconds"),
        (["count", "--seconds", "nan"], "--seconds"),
        (["count", "--seconds", "soon"], "--seconds"),
        (["count", "--domain-id", "300"], "--domain-id is 300"),
        (["count", "--domain-id", "-1"], "--domain-id"),
        (["count", "--domain-id", "x"], "--domain-id"),
        ([], "TOPIC"),
    ],
)
def test_misuse_ends_with_2(words, said, capsys):
    assert explain(*words) == cli.MISUSED
    told = capsys.readouterr().err
    assert said in told
    assert "What to try:" in told
