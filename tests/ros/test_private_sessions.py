"""Private sessions: as many as one likes, in one process and in several; none hears another."""

import json
import os
import signal
import subprocess
import sys
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path

import pytest
from rclpy.node import Node
from std_msgs.msg import Int32

from nodes import Listener
from rosbeat import Session
from rosbeat.domains import SESSION_DOMAINS

pytestmark = pytest.mark.ros


#: So many that two of one process share a domain.
SHARING = len(SESSION_DOMAINS) + 1


class Repeater(Node):
    """Publishes its number again and again."""

    def __init__(self, number: int, period: float = 1.0) -> None:
        super().__init__("repeater")
        self.number = number
        self.publisher = self.create_publisher(Int32, "count", 10)
        self.create_timer(period, self.talk)

    def talk(self) -> None:
        self.publisher.publish(Int32(data=self.number))


@pytest.mark.parametrize("localhost_only", ["", "1"])
def test_live_sessions_hear_only_themselves(localhost_only, monkeypatch):
    # rcl lets this variable take precedence over the range of discovery.
    monkeypatch.setenv("ROS_LOCALHOST_ONLY", localhost_only)
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET")
    monkeypatch.delenv("FASTDDS_BUILTIN_TRANSPORTS", raising=False)
    before = dict(os.environ)
    with ExitStack() as stack:
        sessions = [stack.enter_context(Session()) for _ in range(SHARING)]
        ears = []
        for number, ros in enumerate(sessions):
            ros.add(partial(Repeater, number, 0.02))
            ears.append(ros.add(Listener))
            ros.start()
        for ros, ear in zip(sessions, ears, strict=True):
            assert ros.wait(30, until=lambda ear=ear: len(ear.heard) >= 20)
        assert [set(ear.heard) for ear in ears] == [{number} for number in range(SHARING)]
        assert dict(os.environ) == before


PROGRAM = """
import json, sys
from functools import partial
from nodes import Listener
from rosbeat import Session
from rosbeat.domains import SESSION_DOMAINS
from test_private_sessions import Repeater

first, last = int(sys.argv[1]), int(sys.argv[2])
sessions, ears = [Session() for _ in range(first, last)], []
for number, ros in enumerate(sessions, first):
    ros.add(partial(Repeater, number, 0.05))
    ears.append(ros.add(Listener))
    ros.start()
print("ready", flush=True)
sys.stdin.readline()
arrived = [ros.wait(60, until=lambda ear=ear: len(ear.heard) >= 10)
           for ros, ear in zip(sessions, ears)]
nodes = sorted({name for ros in sessions for name in ros.graph().nodes})
print(json.dumps([all(arrived), [sorted(set(ear.heard)) for ear in ears], nodes]), flush=True)
sys.stdin.readline()
"""


@contextmanager
def sessions_elsewhere(first, last):
    """Open sessions in another process; yield it when their nodes run."""
    places = [str(Path(__file__).parent), *filter(None, sys.path)]
    environ = {**os.environ, "PYTHONPATH": os.pathsep.join(places)}
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(first), str(last)], env=environ, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
    )  # fmt: skip
    try:
        assert process.stdout.readline() == "ready\n"
        yield process
    finally:
        process.kill()
        process.communicate()


def sockets(process):
    """Return the inodes of a process's sockets."""
    links = [os.readlink(link) for link in Path(f"/proc/{process.pid}/fd").iterdir()]
    return {link[len("socket:[") : -1] for link in links if link.startswith("socket:")}


def bound():
    """Return the inodes of all UDP sockets of this machine."""
    lines = Path("/proc/net/udp").read_text(encoding="ascii").splitlines()[1:]
    return {line.split()[9] for line in lines}


def test_sessions_of_several_processes_hear_only_themselves_and_leave_nothing_behind(eventually):
    with ExitStack() as stack:
        ranges = [(0, SHARING // 2), (SHARING // 2, SHARING)]
        running = [stack.enter_context(sessions_elsewhere(*one)) for one in ranges]
        for process in running:  # all are open before anybody is asked
            print(file=process.stdin, flush=True)
        for process, (first, last) in zip(running, ranges, strict=True):
            arrived, heard, nodes = json.loads(process.stdout.readline())
            assert arrived
            assert heard == [[number] for number in range(first, last)]
            assert nodes == ["/listener", "/repeater"]
        process = running[0]
        held = sockets(process) & bound()
        maps = Path(f"/proc/{process.pid}/maps").read_text(encoding="utf-8", errors="replace")
        assert held
        assert "/dev/shm/fastrtps" not in maps  # such files would outlive it
        process.send_signal(signal.SIGKILL)
        process.wait()
        eventually(lambda: not held & bound())


# The same topic with another type in a session beside: in a process of its own, for what this is
# about would end the tests (see `fastdds.xml`).


TWO_TYPES = """
from rclpy.node import Node
from rosbeat import Session
from rosbeat.ros.scenario import observe
from std_msgs.msg import Float32, Float64, String

class Sensor(Node):
    kind, value = Float32, 21.5

    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher_ = self.create_publisher(self.kind, "temperature", 10)
        self.heard = self.create_subscription(self.kind, "temperature", self.hear, 10)
        self.create_timer(1.0, self.tick)
        self.sum = 0

    def tick(self):
        self.publisher_.publish(self.kind(data=self.value))

    def hear(self, message):
        self.sum += message.data == self.value

class Wide(Sensor):
    kind = Float64

class Words(Sensor):
    kind, value = String, "x" * 10_000

first = Session()
sensor = first.add(Sensor)
first.run(10, quiet=True)
for other in (Wide, Words, Sensor, Wide):
    print(len(observe(other, 5).samples), end=" ")
with Session() as second:
    words = second.add(Words)
    second.run(5, quiet=True)
    first.run(5, quiet=True)
    print(words.sum, sensor.sum, len(first.messages("temperature")), end=" ")
first.close()
print("closed")
"""


def test_each_session_hears_its_own():
    done = subprocess.run([sys.executable, "-c", TWO_TYPES], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, "5 5 5 5 5 15 15 closed\n"), done.stderr
    assert not done.stderr
