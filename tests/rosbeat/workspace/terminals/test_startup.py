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
    assert seen("echo °fine°; (exit 7)") == ["~$ echo °fine°; (exit 7)", "°fine°", "exit code 7"]


def test_a_folder_with_odd_letters(seen, terminal, home):
    name = 'o d$d `é\' "x" \\n'
    (home / name).mkdir()
    seen("cd o*")
    assert terminal.folder == home / name


def test_a_folder_that_is_gone(seen, home):
    seen("mkdir gone; cd gone")
    (home / "gone").rmdir()
    assert seen("echo hello") == ["gone$ echo hello", "hello"]
    assert "exit code" in seen("ls .. > /dev/null; cd nowhere 2> /dev/null")[-1]
