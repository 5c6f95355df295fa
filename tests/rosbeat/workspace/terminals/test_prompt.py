"""The prompt by which a page knows that a command has ended survives what learners do."""

import pytest


@pytest.mark.parametrize(
    "command",
    [
        "PS1='mine> '",
        "PROMPT_COMMAND=",
        "PROMPT_COMMAND='echo prompt'; PS1=x",
        "unset PS1 PROMPT_COMMAND",
        "PS1=; PS2=; PROMPT_COMMAND=; true",
        "exec bash --norc",
        "stty -echo",
        "stty echo",
        "stty sane",
        "set -u",
        "set -o pipefail; set -x; set +x",
        "set -o vi",
        "trap 'true' INT EXIT ERR DEBUG",
        "alias ls='ls -la'; shopt -s expand_aliases",
        "export TERM=xterm LANG=C LC_ALL=C",
        "enable -n echo; enable echo",
    ],
)
def test_the_prompt_survives(terminal, seen, command):
    terminal.type(command, timeout=20, show=str)
    terminal.type("true", show=str)
    assert seen("echo °fine°; (exit 7)") == ["~$ echo °fine°; (exit 7)", "°fine°", "# exit code 7"]


RC = """sleep 0.8
PROMPT_COMMAND="history -a"
PS1='\\u@\\h:\\w\\$ '
"""


@pytest.mark.parametrize("command", ["source ~/.bashrc", "exec bash"])
def test_a_slow_bashrc_does_not_take_the_terminal_away(seen, home, command):
    (home / ".bashrc").write_text(RC)
    assert seen(command, timeout=30) == [f"~$ {command}"]
    assert seen("echo fine") == ["~$ echo fine", "fine"]


def test_a_prompt_that_was_lost_after_watching_comes_back(seen, home, terminal):
    (home / ".bashrc").write_text(RC)
    assert seen("source ~/.bashrc", seconds=0.1)[-1].startswith("# `source ~/.bashrc` goes on")
    assert seen("echo fine") == ["~$ echo fine", "fine"]


@pytest.mark.parametrize("to", ["/dev/null", "&-", "err.txt"])
def test_the_prompt_survives_without_a_standard_error(seen, to):
    assert seen(f"exec 2>{to}", timeout=30) == [f"~$ exec 2>{to}"]
    assert seen("ls nowhere; echo fine")[-1] == "fine"


def test_a_trace_shows_nothing_of_the_prompt(seen):
    assert seen("set -x\ntrue") == ["~$ set -x", "~$ true", "+ true"]
    assert seen("set -v\ntrue")[-2:] == ["true", "+ true"]
    assert seen("unset PROMPT_COMMAND PS1", timeout=30)[-1] == "+ unset PROMPT_COMMAND PS1"
    assert seen("true")[-2:] == ["true", "+ true"]


def test_a_question_for_one_key_is_not_answered_by_a_repair(seen, terminal):
    seen("read -n 1 -p 'Sure? ' X; PS1=", timeout=1.2)
    terminal.answer("y", show=str, timeout=20)
    assert seen("echo $X")[-1] == "y"


def test_what_asked_for_one_key_gets_no_enter_that_the_shell_would_get(seen, terminal):
    seen("read -n 1 -p 'Sure? ' X", timeout=1.2)
    terminal.answer("y", show=str, timeout=20)
    # An empty line that bash reads is a second prompt, and ends the next command for the page.
    terminal.type('sleep 0.3; echo "late $X"', show=(said := []).append)
    assert said[-1] == "late y"


def test_a_program_that_works_after_its_key_leaves_no_enter_behind(seen, terminal):
    seen("read -n 1 -p 'Sure? ' X; sleep 2", timeout=1.2)
    terminal.answer("y", show=str, seconds=5)
    terminal.type('sleep 0.3; echo "late $X"', show=(said := []).append)
    assert said[-1] == "late y"


def test_what_asked_for_three_keys_gets_enter_after_two(seen, terminal):
    seen("read -n 3 -p 'Which? ' X; echo \"<$X>\"", timeout=1.2)
    terminal.answer("ab", show=(said := []).append, timeout=20)
    assert said[-1] == "<ab>"


def test_one_key_for_a_program_that_edits_lines_is_a_line(seen, terminal):
    seen("read -e -p 'Which? ' X; echo \"<$X>\"", timeout=1.2)
    terminal.answer("a", show=(said := []).append, timeout=20)
    assert said[-1] == "<a>"


def test_a_folder_with_odd_letters(seen, terminal, home):
    name = 'o d$d `é\' "x" \\n'
    (home / name).mkdir()
    seen("cd o*")
    assert terminal.folder == home / name


def test_a_folder_that_is_gone(seen, home):
    seen("mkdir gone; cd gone")
    (home / "gone").rmdir()
    assert seen("echo hello") == ["gone$ echo hello", "hello"]
    assert "# exit code 1" in seen("ls .. > /dev/null; cd nowhere 2> /dev/null")


def test_a_folder_that_goes_while_a_program_runs(seen, terminal, home):
    seen("mkdir gone; cd gone\nsleep 100", seconds=0.1)
    (home / "gone").rmdir()
    assert terminal.ctrl_c(show=str) == 130
    assert "does not exist any more" in " ".join(seen("touch x"))
    assert seen("cd ..\npwd")[-1] == "/home/you"
