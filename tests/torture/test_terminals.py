"""Terminals of a kernel, when the kernel ends in all kinds of ways, and over and over again.

`ROSBEAT_TORTURE=full` runs the same cells a hundred times.
"""

from __future__ import annotations

import signal
import time

import pytest

from rosbeat.workspace.terminals.reaper import marked
from torture.kernel import FULL, Kernel

TIMES = 100 if FULL else 3
PRELUDE = """
import os
from rosbeat import workspace
from rosbeat.workspace.terminals import terminals_of
print(terminals_of(get_ipython())._mark)
"""
SPAWN = """%%terminal sensor --for 0
sleep 300 & setsid sleep 300 & nohup setsid sh -c 'trap "" HUP TERM INT; sleep 300' > /dev/null &
(trap '' HUP TERM INT; sleep 300)
"""
ENDINGS = {
    "politely": lambda kernel: kernel.exit(),
    "by exit()": lambda kernel: kernel.exit("exit()"),
    "by a signal": lambda kernel: kernel.process.terminate(),
    "killed": lambda kernel: kernel.process.kill(),
    "at once": lambda kernel: kernel.exit("os._exit(3)"),
    "killed with a child of its own": lambda kernel: (
        kernel.run("if os.fork() == 0: import time; time.sleep(20); os._exit(0)"),
        kernel.process.send_signal(signal.SIGKILL),
    ),
}


@pytest.mark.parametrize(
    "ending", ENDINGS if FULL else ["politely", "killed with a child of its own"]
)
def test_a_kernel_leaves_no_process(ending, tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    with Kernel() as kernel:
        mark = kernel.run(PRELUDE).text.strip()
        assert kernel.run("%%terminal sensor\ntrue").error == ""
        kernel.run(SPAWN)
        kernel.run("%%terminal monitor --for 0\nsleep 300")
        deadline = time.monotonic() + 20
        while len(marked(mark)) < 6:  # what runs in the background begins when it can
            assert time.monotonic() < deadline, marked(mark)
            time.sleep(0.02)
        ENDINGS[ending](kernel)
        deadline = time.monotonic() + 20
        while marked(mark):
            assert time.monotonic() < deadline, marked(mark)
            time.sleep(0.02)


CELLS = [
    "%%terminal sensor\nmkdir -p w/src; cd w\nls\npwd",
    "%%terminal sensor\nfor i in 1 2 3; do echo $i; done\nls nothing\ncat <<END\nabc\nEND\ncd ..",
    "%%terminal sensor --until tick --lines 3\n"
    "i=0; while true; do i=$((i+1)); echo tick $i; sleep 0.03; done",
    "%%terminal monitor\necho two; sleep 0.05; (exit 3)",
    "%terminal sensor --until tick --lines 2",
    "%terminal sensor --ctrl-c",
    "%terminal",
    "%%terminal monitor\nseq 3000; printf 'no newline'\npython -c 'print(6 * 7)'",
]


def test_the_same_cells_show_the_same_every_time(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    with Kernel() as kernel:
        kernel.run(PRELUDE)
        texts = {"".join(kernel.run(cell).text for cell in CELLS) for _ in range(TIMES)}
    assert len(texts) == 1, texts


def test_two_kernels_do_not_disturb_each_other(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    with Kernel() as one, Kernel() as two:
        for kernel in (one, two):
            kernel.run(PRELUDE)
            kernel.run("%%terminal sensor --for 0\nsleep 300")
        one.process.kill()
        one.process.wait()
        assert two.run("%terminal").text == "sensor  runs `sleep 300`\n"
        assert two.run("%terminal sensor --ctrl-c").text == "^C\n# exit code 130\n"
