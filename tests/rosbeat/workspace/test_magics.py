"""`%%terminal` in a real kernel."""

import pytest

from torture.kernel import Kernel


@pytest.fixture
def kernel(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    with Kernel() as started:
        assert started.run("from rosbeat import workspace").error == ""
        yield started


def test_a_page_types_into_terminals(kernel):
    assert kernel.run("%%terminal sensor\nmkdir src\ncd src\npwd\n").text == (
        "~$ mkdir src\n~$ cd src\nsrc$ pwd\n/home/you/src\n"
    )
    assert kernel.run("%%terminal monitor\npwd").text == "~$ pwd\n/home/you\n"
    assert kernel.run("%terminal").text == "sensor   waits at src$\nmonitor  waits at ~$\n"
    assert kernel.run("HOME = 3\n").error == ""
    assert kernel.run("%%terminal sensor\necho $HOME {HOME}").text.endswith("\n/home/you {HOME}\n")


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
    assert "no option `--untill`" in reply.text
    assert "Traceback" not in reply.text
    assert kernel.run("%%terminal\nls").error == "UsageError"
    assert "Which terminal" in kernel.run("%%terminal\nls").text
    assert "nothing to type" in kernel.run("%%terminal sensor\n  \n").text
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


def test_ctrl_c_has_the_time_that_it_is_given(kernel):
    kernel.run("%%terminal sensor --until deaf\n(trap '' INT; echo deaf; sleep 100)")
    reply = kernel.run("%terminal sensor --ctrl-c --timeout 0.6")
    assert reply.error == "TerminalError"
    assert reply.seconds < 9  # without it, ten
    assert kernel.run("%terminal sensor --close").error == ""


def test_the_extension_makes_the_magic_known(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    with Kernel() as kernel:
        assert kernel.run("%load_ext rosbeat").error == ""
        assert kernel.run("%%terminal a\necho hello").text == "~$ echo hello\nhello\n"
