"""Attempts on another learner: each function tries one, and returns what it gained.

It runs as a program, with the name of an attempt and what is known of the victim (JSON), where
somebody tries it: in the attacker's own place on the hub; as a plain process of another user of the
machine; and, to see that the attempt can succeed at all, by the victim. It prints `gained`, or
`refused` and why.
"""

from __future__ import annotations

import ctypes
import glob
import json
import os
import socket
import subprocess
import sys
import time
import urllib.request
from contextlib import suppress
from pathlib import Path

#: Seconds to hear a node that publishes ten times a second, and a port that answers at once.
_LISTENING, _ANSWER = 8.0, 10.0


class Known:
    """What is known of the victim: more than an attacker could.

    Args:
        facts: Names and values; see `test_attempts`.
    """

    def __init__(self, facts):
        self.home = Path(facts["home"])
        self.course = Path(facts["course"])
        self.run, self.state = Path(facts["run"]), Path(facts["state"])
        self.uid, self.name = facts["uid"], facts["name"]
        self.pids, self.kernel_port = facts["pids"], facts["kernel_port"]
        self.domain, self.url = facts["domain"], facts["url"]
        self.token, self.files = facts["token"], facts["files"]

    @property
    def pages(self):
        return self.home / "my_course"

    @property
    def socket(self):
        return self.run / "learners" / self.name / "server.sock"


# Files.


def read_a_page(known):
    return (known.pages / "00_hear_the_heartbeat.ipynb").read_text()[:20]


def list_the_home(known):
    return os.listdir(known.home)


def change_a_page(known):
    with (known.pages / "00_hear_the_heartbeat.ipynb").open("a"):
        return "open for writing"


def put_a_file_into_the_folder(known):
    path = known.pages / "planted.py"
    path.touch()
    path.unlink()
    return "made and removed"


def read_the_progress(known):
    return os.listdir(known.pages / ".rosbeat")


def forge_the_progress(known):
    with (known.pages / ".rosbeat" / "progress.json").open("a"):
        return "open for writing"


def read_the_connection_file(known):
    found = glob.glob(f"{known.home}/.local/share/jupyter/runtime/kernel-*.json")
    return found and json.loads(Path(found[0]).read_text())["key"]


def read_what_the_server_signs_with(known):
    return (known.home / ".local/share/jupyter/runtime/jupyter_cookie_secret").read_bytes()[:4]


# The server, the kernel, the hub.


def talk_to_the_kernel_without_its_key(known):
    with socket.create_connection(("127.0.0.1", known.kernel_port), timeout=_ANSWER) as channel:
        channel.settimeout(_ANSWER)
        return channel.recv(10)  # ZMQ greets whoever connects


def connect_to_the_server(known):
    with socket.socket(socket.AF_UNIX) as channel:
        channel.settimeout(_ANSWER)
        channel.connect(str(known.socket))
        return "connected"


def take_the_place_of_the_server(known):
    known.socket.with_name("other.sock").touch()
    known.socket.with_name("other.sock").unlink()
    return "made and removed"


def ask_the_proxy_for_a_page(known):
    return _fetch(f"{known.url}/user/{known.name}/api/contents", {})


def ask_with_a_token_of_ones_own(known):
    headers = {"Authorization": f"token {known.token}"}
    return _fetch(f"{known.url}/user/{known.name}/api/contents", headers)


def ask_the_hub_for_a_token_of_the_victim(known):
    headers = {"Authorization": f"token {known.token}"}
    return _fetch(f"{known.url}/hub/api/users/{known.name}/tokens", headers, b"{}")


def send_the_proxy_elsewhere(known):
    with socket.socket(socket.AF_UNIX) as channel:
        channel.connect(str(known.run / "proxy.sock"))
        return "connected"


def read_the_secrets_of_the_hub(known):
    return (known.state / "cookie_secret").read_bytes()[:4], os.listdir(known.state)


# Processes.


def read_the_environment_of_a_process(known):
    return [one for one in map(_environ_of, _processes(known)) if one]


def read_the_memory_of_a_process(known):
    for pid in _processes(known):
        with suppress(OSError), open(f"/proc/{pid}/mem", "rb") as memory:
            first = Path(f"/proc/{pid}/maps").read_text().partition("-")[0]
            memory.seek(int(first, 16))
            return memory.read(4)
    return None


def attach_to_a_process(known):
    libc = ctypes.CDLL(None, use_errno=True)
    for pid in _processes(known):
        if pid != os.getpid() and libc.ptrace(0x4206, pid, None, None) == 0:  # PTRACE_SEIZE
            return pid
    return None


def signal_a_process(known):
    # 0: whether one may. Inside of namespaces, numbers from outside would mean one's own processes.
    for pid in _processes(known):
        with suppress(OSError):
            os.kill(pid, 0)
            return pid
    return None


def enter_the_network(known):
    for pid in _processes(known):
        with suppress(OSError), open(f"/proc/{pid}/ns/net") as place:
            if ctypes.CDLL(None, use_errno=True).setns(place.fileno(), 0x40000000) == 0:
                return pid
    return None


def go_in_through_the_root_of_a_process(known):
    for pid in _processes(known):
        with suppress(OSError):
            return os.listdir(f"/proc/{pid}/root/dev/shm")
    return None


def become_root(known):
    commands = (["sudo", "-n", "id", "-u"], ["su", "-c", "id -u"], ["unshare", "--net", "true"])
    for command in commands:
        with suppress(OSError):
            done = subprocess.run(
                command, stdin=subprocess.DEVNULL, capture_output=True, check=False, timeout=60
            )
            if done.returncode == 0:
                return command
    return None


def write_into_a_terminal(known):
    for path in glob.glob("/dev/pts/*"):
        if os.stat(path).st_uid == known.uid:
            with suppress(OSError), open(path, "w"):
                return path
    return None


# What all users of a machine share.


def change_the_course(known):
    with (known.course / "src" / "rosbeat" / "__init__.py").open("a"):
        return "open for writing"


def poison_what_python_has_compiled(known):
    for folder in known.course.rglob("__pycache__"):
        with suppress(OSError):
            (folder / "planted.pyc").touch()
            (folder / "planted.pyc").unlink()
            return str(folder)
    return None


def poison_the_environment(known):
    packages = next((known.course / ".venv" / "lib").glob("python3*")) / "site-packages"
    (packages / "planted.pth").touch()
    return str(packages)


def see_shared_memory(known):
    return [path for path in glob.glob("/dev/shm/*") if os.stat(path).st_uid == known.uid]


def see_temporary_files(known):
    return [name for name in known.files if os.path.exists(name)]


def plant_a_link_at_a_name_to_be(known):
    """Leave links where the victim may write one day; the victim looks for them afterwards."""
    for name in known.files:
        Path(f"{name}-planted").symlink_to(known.pages / "00_hear_the_heartbeat.ipynb")


# ROS.


def hear_the_topic(known):
    return _hear(known, "SUBNET")


def hear_the_topic_by_the_address(known):
    return _hear(known, "LOCALHOST", "127.0.0.1")


def see_open_ports(known):
    """Look for sockets of the victim in this network, the fields of which end with the owner."""
    lines = Path("/proc/net/udp").read_text().splitlines()[1:]
    return [line.split()[1] for line in lines if int(line.split()[7]) == known.uid]


def _hear(known, reach, peers=""):
    os.environ.update(
        ROS_DOMAIN_ID=str(known.domain), ROS_AUTOMATIC_DISCOVERY_RANGE=reach, ROS_STATIC_PEERS=peers
    )
    import rclpy
    from std_msgs.msg import String

    rclpy.init()
    node = rclpy.create_node("eavesdropper")
    heard = []
    node.create_subscription(String, "secret", lambda message: heard.append(message.data), 10)
    # Another process may hear this one, too.
    publisher = node.create_publisher(String, "forged", 10)
    deadline = time.monotonic() + _LISTENING
    while time.monotonic() < deadline and not heard:
        publisher.publish(String(data="forged"))
        rclpy.spin_once(node, timeout_sec=0.1)
    rclpy.shutdown()
    return heard


def _processes(known):
    """The victim's processes: those known from outside, and all that can be seen."""
    seen = []
    for path in glob.glob("/proc/[0-9]*"):
        with suppress(OSError):
            if os.stat(path).st_uid == known.uid:
                seen.append(int(path.rpartition("/")[2]))
    return sorted({*seen, *(pid for pid in known.pids if _is_of(pid, known.uid))})


def _is_of(pid, uid):
    with suppress(OSError):
        return os.stat(f"/proc/{pid}").st_uid == uid
    return False


def _environ_of(pid):
    with suppress(OSError):
        return Path(f"/proc/{pid}/environ").read_bytes()[:4]
    return b""


def _fetch(address, headers, data=None):
    request = urllib.request.Request(address, data, headers)
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}), _NoLogin())
    with opener.open(request, timeout=_ANSWER) as answer:
        return answer.read(20)


class _NoLogin(urllib.request.HTTPRedirectHandler):
    """Take being sent to the login page for what it is."""

    def redirect_request(self, req, fp, code, msg, headers, newurl):
        raise PermissionError(f"sent to {newurl}")


ATTEMPTS = {
    name: one
    for name, one in list(globals().items())
    if not name.startswith("_") and getattr(one, "__module__", "") == __name__ and name != "Known"
}

if __name__ == "__main__":
    try:
        gained = ATTEMPTS[sys.argv[1]](Known(json.loads(sys.argv[2])))
    except OSError as error:
        print("refused:", error)
    else:
        print("gained:", gained) if gained else print("refused: nothing found")
