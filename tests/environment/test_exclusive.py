import subprocess
import sys

from course_tool.exclusive import exclusive

HOLD = """
import fcntl, os, sys
descriptor = os.open(sys.argv[1], os.O_RDONLY)
fcntl.flock(descriptor, fcntl.LOCK_EX)
print("held", flush=True)
sys.stdin.readline()
"""


def test_alone_nothing_is_said(tmp_path, capsys):
    with exclusive(tmp_path):
        pass
    assert capsys.readouterr().out == ""
    assert list(tmp_path.iterdir()) == []


def test_a_second_command_waits_and_says_so(tmp_path, monkeypatch):
    said = []
    with subprocess.Popen(
        [sys.executable, "-I", "-S", "-c", HOLD, str(tmp_path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as other:
        assert other.stdout.readline() == "held\n"

        def say(text):
            said.append(text)
            other.stdin.write("\n")
            other.stdin.flush()

        monkeypatch.setattr("course_tool.exclusive.say", say)
        with exclusive(tmp_path):
            pass
    assert "waiting" in said[0]


def test_a_file_system_without_locks_is_no_obstacle(tmp_path, monkeypatch):
    def refuse(descriptor, how):
        raise OSError(9, "Bad file descriptor")

    monkeypatch.setattr("fcntl.flock", refuse)
    with exclusive(tmp_path):
        pass
