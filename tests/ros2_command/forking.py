"""Runs `ros2` in forks of one process that has imported what the command needs.

To import rclpy and the messages takes longer than most commands. Run as a program, this file is the
process that forks; each fork has the arguments, environment, folder and streams that it is given,
and does what `python -m ros2_command` does.
"""

import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from importlib import import_module
from pathlib import Path

IMPORTED = (
    "numpy",
    "rclpy.action",
    "rcl_interfaces.srv",
    "test_msgs.action",
    "std_srvs.srv",
    "yaml",
)
_MOST = 1 << 17  # bytes of a request; most of them are the environment


class Forks:
    """Run commands to their end, one after the other.

    Args:
        environment: In which rclpy and the command are found.
    """

    def __init__(self, environment):
        self._socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self._server = subprocess.Popen(
                [sys.executable, __file__, str(theirs.fileno())],
                env=environment | {"OPENBLAS_NUM_THREADS": "1"}, pass_fds=[theirs.fileno()],
                stdin=subprocess.DEVNULL,
            )  # fmt: skip

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._socket.close()  # which ends the server
        self._server.wait(60)

    def run(self, words, environment, cwd, stdin, timeout):
        """Run a command and return the completed process."""
        self._socket.settimeout(timeout)
        request = {"words": words, "environment": environment, "cwd": str(cwd or Path.cwd())}
        with ExitStack() as stack:
            given, *said = (stack.enter_context(tempfile.TemporaryFile()) for _ in range(3))
            given.write((stdin or "").encode())
            given.seek(0)
            streams = [one.fileno() for one in (given, *said)]
            socket.send_fds(self._socket, [json.dumps(request).encode()], streams)
            code = int(self._socket.recv(64))
            texts = [os.pread(one, os.fstat(one).st_size, 0).decode() for one in streams[1:]]
        return subprocess.CompletedProcess(words, code, *texts)


def serve(requests):
    """Fork for each request, and send its exit code, until nobody is there to ask."""
    while True:
        data, streams, _, _ = socket.recv_fds(requests, _MOST, 3)
        if not data:
            return
        pid = os.fork()
        if not pid:
            requests.close()
            become(**json.loads(data), streams=streams)
        for one in streams:
            os.close(one)
        _, status = os.waitpid(pid, 0)
        requests.send(str(os.waitstatus_to_exitcode(status)).encode())


def become(words, environment, cwd, streams):
    """Be a process that runs `ros2` with these words, and end."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    for target, one in enumerate(streams):
        os.dup2(one, target)
        os.close(one)
    os.environ.clear()
    os.environ.update(environment)
    os.chdir(cwd)
    sys.argv[1:] = words
    from ros2_command.main import main

    sys.exit(main())


def prepare():
    """Import what commands import, and start nothing."""
    for name in IMPORTED:
        import_module(name)
    from ros2_command.registry import COMMANDS, verbs_of

    for command in COMMANDS:
        verbs_of(command)


if __name__ == "__main__":
    prepare()
    serve(socket.socket(fileno=int(sys.argv[1])))
