"""What one user of the machine tries on another learner; `attempts.py` says what that is."""

import json
import subprocess
from collections import namedtuple
from contextlib import suppress
from pathlib import Path

import pytest

from hub.attempts import ATTEMPTS

PAGE = "00_hear_the_heartbeat.ipynb"
FILES = ("/tmp/of-the-victim", "/var/tmp/of-the-victim", "/dev/shm/of-the-victim")
#: What not even the victim can do: these are not theirs.
NOBODY = {
    "send_the_proxy_elsewhere", "read_the_secrets_of_the_hub", "become_root", "change_the_course",
    "poison_what_python_has_compiled", "poison_the_environment", "plant_a_link_at_a_name_to_be",
    # A learner has no capability, not even over their own network.
    "enter_the_network",
}  # fmt: skip
#: What goes through the hub's port, which a learner's network does not have.
BY_WEB = {
    "ask_the_proxy_for_a_page", "ask_with_a_token_of_ones_own",
    "ask_the_hub_for_a_token_of_the_victim",
}  # fmt: skip
HEARD = "heard"
PUBLISHER = """
import rclpy, sys
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("victim")
publisher = node.create_publisher(String, "secret", 10)
node.create_subscription(String, "forged", lambda message: open({heard!r}, "w"), 10)
node.create_timer(0.1, lambda: publisher.publish(String(data="the secret")))
print("ready", flush=True)
rclpy.spin(node)
"""
Scene = namedtuple("Scene", "hub facts victim attacker outsider")
pytestmark = pytest.mark.timeout(600)


@pytest.fixture(scope="module")
def scene(hub):
    """A victim at work, an attacker with a server of their own, and one outside of the hub."""
    ana, ben, outsider = hub.users[:3]
    victim, attacker = hub.log_in(ana), hub.log_in(ben)
    victim.start_server()
    attacker.start_server()
    heard = str(ana.home / HEARD)
    with victim.kernel(PAGE) as kernel, attacker.kernel(PAGE) as other:
        kernel.says(
            "import os, subprocess, sys\n"
            f"for name in {FILES!r}: open(name, 'w').close()\n"
            f"node = subprocess.Popen([sys.executable, '-c', {PUBLISHER.format(heard=heard)!r}],"
            " stdout=subprocess.PIPE, text=True)\n"
            "assert node.stdout.readline() == 'ready\\n'"
        )
        port = kernel.says(
            "import json; from ipykernel import get_connection_info\n"
            "print(json.loads(get_connection_info())['shell_port'])"
        )
        facts = {
            "home": str(ana.home), "course": str(hub.course), "run": str(hub.run),
            "state": str(hub.state), "uid": ana.uid, "name": ana.name, "pids": ana.pids(),
            "kernel_port": int(port), "url": hub.url, "token": attacker.token, "files": FILES,
            "domain": int(kernel.says("print(os.environ['ROS_DOMAIN_ID'])")),
        }  # fmt: skip
        with victim.terminal():  # one to write into
            yield Scene(hub, facts, kernel, other, outsider)
        kernel.says("node.kill(); node.wait(); node.stdout.close()")
    victim.stop_server()
    attacker.stop_server()
    for name in FILES:  # by the outsider, where all users of the machine may write
        with suppress(FileNotFoundError):
            Path(f"{name}-planted").unlink()


def by_learner(scene, kernel, name, facts):
    """Try it in a learner's own place on the hub."""
    command = program(scene, name, facts)
    return kernel.says(
        "import subprocess\n"
        f"done = subprocess.run({command!r}, capture_output=True, text=True, timeout=120)\n"
        "print(done.stdout + done.stderr)"
    )


def by_outsider(scene, name, facts):
    """Try it as a user of the machine who has a shell on it, outside of the hub's namespaces."""
    user = scene.outsider
    done = subprocess.run(
        program(scene, name, facts), capture_output=True, text=True, timeout=120, check=False,
        user=user.uid, group=user.uid, extra_groups=[], cwd=user.home,
        env={"HOME": str(user.home), "PATH": "/usr/bin:/bin"},
    )  # fmt: skip
    return done.stdout + done.stderr


def program(scene, name, facts):
    python = scene.hub.course / ".venv" / "bin" / "python"
    file = scene.hub.course / "tests" / "hub" / "attempts.py"
    return [str(python), "-B", str(file), name, json.dumps(facts)]


@pytest.mark.parametrize("name", ATTEMPTS)
def test_another_learner_gains_nothing(scene, name):
    assert by_learner(scene, scene.attacker, name, scene.facts).startswith("refused: ")


@pytest.mark.parametrize("name", ATTEMPTS)
def test_another_user_of_the_machine_gains_nothing(scene, name):
    # The web is for all, and each is asked who they are.
    assert by_outsider(scene, name, scene.facts).startswith("refused: ")


def test_the_victim_has_heard_nobody_and_found_no_link(scene):
    """After all attempts: nothing was forged, nothing planted, and the work goes on."""
    planted = [f"{name}-planted" for name in FILES]
    code = f"import os; print([os.path.lexists(name) for name in {planted!r}])"
    assert scene.victim.says(code) == "[False, False, False]\n"
    assert scene.victim.says("print(node.poll(), 6 * 7)") == "None 42\n"
    assert not (Path(scene.facts["home"]) / HEARD).exists()


@pytest.mark.parametrize("name", [one for one in ATTEMPTS if one not in NOBODY | BY_WEB])
def test_the_same_succeeds_for_the_victim(scene, name):
    assert by_learner(scene, scene.victim, name, scene.facts).startswith("gained: ")
