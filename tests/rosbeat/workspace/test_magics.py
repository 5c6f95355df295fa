"""`%%terminal` in a real kernel, and its options."""

import subprocess
import sys

import pytest
from IPython.core.error import UsageError

from rosbeat.workspace import magics
from torture.kernel import Kernel


@pytest.fixture(scope="module")
def started(tmp_path_factory):
    """One kernel for all tests: what a page does in it is closed after each."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path_factory.mktemp("home")))
        with Kernel() as kernel:
            assert kernel.run("%load_ext rosbeat").error == ""
            assert kernel.run("%terminal").text.startswith("No terminal is open.")
            assert kernel.run("from rosbeat import workspace").error == ""
            yield kernel


@pytest.fixture
def kernel(started):
    yield started
    for name in ("sensor", "monitor"):
        started.run(f"%terminal {name} --close")
    started.run("%%bash\nrm -rf $ROSBEAT_STEADY_HOME/*")


PAGE = """
import os, sys
os.environ["PATH"] = "/usr/bin:/bin"
from IPython.core.interactiveshell import InteractiveShell
shell = InteractiveShell.instance()
shell.run_line_magic("load_ext", "rosbeat")
print(shell.getoutput("which ros2")[0], shell.getoutput("bash -c 'which colcon'")[0], sys.prefix)
"""


def test_a_page_finds_the_programs_of_a_terminal_wherever_its_kernel_was_started():
    done = subprocess.run([sys.executable, "-c", PAGE], capture_output=True, text=True, check=True)
    ros2, colcon, prefix = done.stdout.split()
    assert (ros2, colcon) == (f"{prefix}/bin/ros2", f"{prefix}/bin/colcon")


def test_a_page_types_into_terminals(kernel):
    assert kernel.run("%%terminal sensor\nmkdir src\ncd src\npwd\n").text == (
        "~$ mkdir src\n~$ cd src\nsrc$ pwd\n/home/you/src\n"
    )
    assert kernel.run("%%terminal monitor\npwd").text == "~$ pwd\n/home/you\n"
    assert kernel.run("%terminal").text == "sensor   waits at src$\nmonitor  waits at ~$\n"
    assert kernel.run("HOME = 3\n").error == ""
    assert kernel.run("%%terminal sensor\necho $HOME {HOME}").text.endswith("\n/home/you {HOME}\n")


def test_prompt_command_output_and_remark_differ_in_colour(kernel):
    reply = kernel.run('%%terminal sensor\ncd "$HOME"\nfalse # x')
    prompt, remark, bold, end = "\x1b[38;2;0;138;103m", "\x1b[38;2;0;118;237m", "\x1b[1m", "\x1b[0m"
    first, _, last = reply.raw.splitlines()
    assert first.startswith(f"{prompt}~$ {end}{bold}\x1b[38;2;")
    assert last == f"{remark}# exit code 1{end}"
    assert reply.text.startswith('~$ cd "$HOME"\n~$ false # x\n')
    assert kernel.run("print(workspace.terminal('sensor').text)").raw == reply.text.replace(
        "# exit code 1\n", ""
    )


def test_a_command_goes_on_while_the_page_does(kernel):
    cell = "%%terminal sensor --until tick --lines 2\nfor i in 1 2 3; do echo tick $i; done; cat\n"
    assert kernel.run(cell).text.endswith("\ntick 1\ntick 2\n")
    assert kernel.run("6 * 7").error == ""
    assert kernel.run("%terminal sensor --until tick").text == "tick 3\n"
    assert kernel.run("%terminal").text.startswith("sensor  runs `for i in")
    assert kernel.run("%%terminal sensor --answer\nhello").text == "hello\nhello\n"
    assert kernel.run("print(workspace.terminal('sensor').busy)").text == "True\n"
    assert kernel.run("%terminal sensor --ctrl-c").text == "^C\n# exit code 130\n"
    assert kernel.run("%terminal sensor").text == ""
    assert kernel.run("%terminal sensor --close").text == ""
    assert kernel.run("%terminal").text.startswith("No terminal is open.")


def test_errors_are_explained_without_a_stack(kernel):
    reply = kernel.run("%%terminal sensor --untill x\nls")
    assert reply.error == "UsageError"
    assert "arguments: --untill" in reply.text
    assert "Traceback" not in reply.text
    assert kernel.run("%%terminal\nls").error == "UsageError"
    assert "terminal's name is missing" in kernel.run("%%terminal\nls").text
    assert "has no commands" in kernel.run("%%terminal sensor\n  \n").text
    assert "There is no terminal `sensor`" in kernel.run("%terminal sensor").text
    reply = kernel.run("%%terminal sensor --until xyz\necho abc")
    assert reply.error == "TerminalError"
    assert kernel.run("%%terminal sensor\necho fine").text.endswith("fine\n")


def test_interrupting_a_cell_leaves_its_command_alone(kernel):
    reply = kernel.interrupt("%%terminal sensor\necho go; sleep 100", 0.2)
    assert reply.error == "KeyboardInterrupt"
    assert reply.seconds < 5
    assert kernel.run("print(workspace.terminal('sensor').busy)").text == "True\n"
    assert kernel.run("%terminal sensor --ctrl-c").text == "^C\n# exit code 130\n"


# Options. A shell without terminals is enough: nothing is started before they are understood.


@pytest.mark.parametrize(
    ("line", "in_cell", "said"),
    [
        ("", True, "terminal's name is missing"),
        ("--until x", False, "terminal's name is missing"),
        ("sensor --untill x", True, "arguments: --untill x(.|\n)*--until TEXT"),
        ("sensor --help", False, "arguments: --help(.|\n)*--until TEXT"),
        ("sensor monitor", True, "arguments: monitor"),
        ("sensor --until", True, "--until: expected one argument"),
        ("sensor --until ''", True, "needs a text"),
        ('sensor --until "a', True, "quote is not closed"),
        ("sensor --lines 2", True, "--until TEXT"),
        ("sensor --until a --lines none", True, "not a number of lines"),
        ("sensor --until a --lines 0", True, "not a number of lines"),
        ("sensor --for long", True, "not a number of seconds"),
        ("sensor --for inf", True, "not a number of seconds"),
        ("sensor --kill --close", False, "not allowed with"),
        ("sensor --ctrl-c", True, "%terminal sensor --ctrl-c"),
        ("sensor --ctrl-c --until x", False, "`--until` cannot be combined with `--ctrl-c`"),
        ("sensor --kill --for 0", False, "`--for` cannot be combined with `--kill`"),
        ("sensor --close --timeout 3", False, "`--timeout` cannot be combined with `--close`"),
        ("sensor --answer", False, "needs `%%terminal`"),
        ("sen/sor", True, "is not a valid name"),
    ],
)
def test_what_cannot_be_is_explained(line, in_cell, said):
    with pytest.raises(UsageError, match=said):
        magics.run(object(), line, "ls" if in_cell else None)
