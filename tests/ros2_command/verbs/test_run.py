import os
import select
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from ros2_command.verbs.run import startable

NODE = f"""#!{sys.executable}
import signal, sys
try:
    print("ready", sys.argv[1:], flush=True)  # whoever reads this may send a signal at once
    signal.sigtimedwait([signal.SIGUSR1], 60)
except KeyboardInterrupt:
    try:
        signal.sigtimedwait([signal.SIGUSR1], 0.5)
    except KeyboardInterrupt:
        print("twice", flush=True)
    sys.exit(7)
"""


@pytest.fixture
def demo(ros2, tmp_path, monkeypatch):
    """Adds an executable to the package `demo`."""
    index = tmp_path / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / "demo").touch()
    monkeypatch.setitem(ros2.environment, "AMENT_PREFIX_PATH", str(tmp_path))

    def add(name, text, mode=0o755, folder=""):
        path = tmp_path / "lib" / "demo" / folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(mode)
        return path

    return add


def test_arguments_and_output_pass(ros2, demo):
    demo("say", '#!/bin/sh\necho "$@"\n')
    words = ("--ros-args", "-r", "a:=b", "-h", "--prefix")
    assert ros2.out("run", "demo", "say", *words) == " ".join(words) + "\n"
    assert ros2.out("run", "demo", "say", "--", "x") == "x\n"
    assert ros2.out("run", "--prefix", "env X='a b'", "demo", "say", "y") == "y\n"


def test_exit_codes_pass(ros2, demo):
    demo("bad", "#!/bin/sh\nexit 3\n")
    demo("shot", "#!/bin/sh\nkill -KILL $$\n")
    assert ros2.out("run", "demo", "bad", code=3) == "[ros2run]: Process exited with failure 3\n"
    assert ros2.out("run", "demo", "shot", code=247) == "[ros2run]: Killed\n"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_for_the_parent_alone_reaches_the_child(ros2, demo, number):
    demo("node", NODE)
    with ros2.running("run", "demo", "node") as process:
        assert process.stdout.readline() == "ready []\n"
        process.send_signal(number)
        out, error = process.communicate(timeout=30)
    if number == signal.SIGINT:
        assert (process.returncode, out) == (7, "[ros2run]: Process exited with failure 7\n")
    else:
        assert (process.returncode, out) == (241, "[ros2run]: Terminated\n")
    assert error == ""


def test_ctrl_c_reaches_the_child_once(ros2, demo):
    demo("node", NODE)
    with ros2.running("run", "demo", "node") as process:
        assert process.stdout.readline() == "ready []\n"
        os.killpg(process.pid, signal.SIGINT)
        out, _ = process.communicate(timeout=60)
    assert (process.returncode, out) == (7, "[ros2run]: Process exited with failure 7\n")


#: Says which signals it gets, and ends some seconds after the last of them.
COUNTER = f"""#!{sys.executable}
import os, signal, time
def note(number, frame):
    global end
    end = time.monotonic() + 3
    os.write(1, signal.Signals(number).name.encode() + b"\\n")
for name in ("SIGINT", "SIGTERM", "SIGHUP"):
    signal.signal(getattr(signal, name), note)
end = time.monotonic() + 60
os.write(1, b"ready\\n")
while time.monotonic() < end:
    time.sleep(0.05)
"""


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_signal_that_comes_twice_from_timeout_reaches_the_child_once(ros2, demo, name):
    """`timeout` sends its signal to the child, and then at once to the whole group."""
    number = getattr(signal, name)
    demo("count", COUNTER)
    with ros2.running("run", "demo", "count") as process:
        assert process.stdout.readline() == "ready\n"
        process.send_signal(number)
        os.killpg(process.pid, number)
        out, error = process.communicate(timeout=60)
    assert (out, error, process.returncode) == (f"{name}\n", "", 0)


def test_somebody_who_insists_is_heard(ros2, demo):
    demo("count", COUNTER)
    with ros2.running("run", "demo", "count") as process:
        assert process.stdout.readline() == "ready\n"
        os.killpg(process.pid, signal.SIGINT)
        assert process.stdout.readline() == "SIGINT\n"
        while not select.select([process.stdout], [], [], 0.3)[0]:  # as a person does
            subprocess.run(["kill", "-INT", str(process.pid)], check=True)
        assert process.stdout.readline() == "SIGINT\n"


def test_what_cannot_be_found(ros2, demo):
    demo("talker", "#!/bin/sh\n")
    demo("plain", "#!/bin/sh\n", mode=0o644)
    demo("twin", "", folder="a")
    demo("twin", "", folder="b")
    assert "Did you mean 'demo'?" in ros2.error("run", "deemo", "talker")
    assert ros2.error("run", "demo", "talkr").startswith(
        "No executable found\n# Did you mean 'talker'?\n"
    )
    assert "Did you mean 'talker'?" in ros2.error("run", "demo", "talker.py")
    assert "no execute permission" in ros2.error("run", "demo", "plain")
    twins = ros2.error("run", "demo", "twin").splitlines()
    assert twins[0] == "Multiple executables found:"
    assert [line[:2] for line in twins[1:]] == ["- ", "- "]
    assert "required: executable_name" in ros2.error("run", "demo", code=2)


def test_what_cannot_be_started(ros2, demo):
    demo("no_line", "print(1)\n")
    demo("wrong_line", "#!/nowhere/python\n")
    assert "#!/usr/bin/env python3" in ros2.error("run", "demo", "no_line")
    assert "No such file or directory" in ros2.error("run", "demo", "wrong_line")
    error = ros2.error("run", "--prefix", "nosuch -x", "demo", "no_line")
    assert error.startswith("Failed to start nosuch: No such file or directory\n# --prefix begins")
    assert "#!/usr/bin" not in error
    assert "cannot be read" in ros2.error("run", "--prefix", "'", "demo", "no_line")


def node_of(process):
    """The node that a `ros2 run` has started; its other child has the command line of `ros2`."""
    own = Path(f"/proc/{process.pid}/cmdline").read_bytes()
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    (node,) = (one for one in children if Path(f"/proc/{one}/cmdline").read_bytes() != own)
    return int(node)


SENDERS = {
    "ros2": lambda process, number: process.send_signal(number),
    "node": lambda process, number: os.kill(node_of(process), number),
    "both": lambda process, number: os.killpg(process.pid, number),
}


@pytest.mark.ros
@pytest.mark.parametrize("to", SENDERS)
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_finished_node_ends_well(ros2, graph, demo, monkeypatch, number, to):
    """As a terminal's Ctrl+C does (both), and as others may who know one process only."""
    monkeypatch.setitem(ros2.environment, "ROS_DOMAIN_ID", graph.environment["ROS_DOMAIN_ID"])
    source = Path(__file__).parents[1] / "finished_node.py"
    demo("node", f"#!{sys.executable}\n{source.read_text()}")
    with ros2.running("run", "demo", "node") as process:
        assert process.stdout.readline() == "published\n"
        SENDERS[to](process, number)
        out, error = process.communicate(timeout=60)
    assert (process.returncode, error) == (0, "")
    assert set(out.splitlines()) <= {"published"}


@pytest.mark.parametrize(
    ("first_line", "words"),
    [
        ('#!"/a b/bin/python"', ["/a b/bin/python"]),
        ("#!/usr/bin/env python3", []),
        ('#!"/a b/bin/python" -E', []),
        ('#!""', []),
        ("", []),
    ],
)
def test_a_python_in_a_folder_with_a_space_is_started_by_name(tmp_path, first_line, words):
    script = tmp_path / "program"
    script.write_text(f"{first_line}\nprint()\n")
    assert startable(script) == [*words, str(script)]
