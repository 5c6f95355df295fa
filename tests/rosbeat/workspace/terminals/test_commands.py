"""Commands, answers and keys, typed into a real bash."""

import signal
import sys

import pytest

from rosbeat.errors import TerminalError

TICK = 'i=0; while true; do i=$((i+1)); echo "[INFO] [sensor]: tick $i"; sleep 0.05; done'


def test_commands_are_shown_with_their_folder(seen, home, terminal):
    assert seen("echo hello") == ["~$ echo hello", "hello"]
    assert seen("mkdir -p ROS2_and_RL_Tutorials/src\ncd ROS2_and_RL_Tutorials/src\npwd") == [
        "~$ mkdir -p ROS2_and_RL_Tutorials/src",
        "~$ cd ROS2_and_RL_Tutorials/src",
        "ROS2_and_RL_Tutorials/src$ pwd",
        "/home/you/ROS2_and_RL_Tutorials/src",
    ]
    assert terminal.folder == home / "ROS2_and_RL_Tutorials" / "src"


def test_exit_codes_are_shown_and_kept(seen, terminal):
    assert terminal.exit_code is None
    assert seen("true") == ["~$ true"]
    assert terminal.exit_code == 0
    assert "# exit code 1" in seen("false")
    assert seen("(exit 42)")[1:2] == ["# exit code 42"]
    assert terminal.exit_code == 42
    assert seen("# nothing happens here") == ["~$ # nothing happens here"]
    assert "# exit code 143" in seen("sh -c 'kill $$'")


def test_what_comes_without_a_newline_is_a_line(seen):
    assert seen("printf abc\necho next") == ["~$ printf abc", "abc", "~$ echo next", "next"]


def test_commands_over_several_lines(seen):
    assert seen("for i in 1 2; do\n  echo $i\ndone") == [
        "~$ for i in 1 2; do",
        ">   echo $i",
        "> done",
        "1",
        "2",
    ]
    assert seen("cat <<END\na\tb\n\n  c\nEND")[-3:] == ["a\tb", "", "  c"]
    assert seen("echo one \\\n  two")[-1] == "one two"
    assert seen("echo 'a\n\nb'")[-3:] == ["a", "", "b"]


def test_blank_lines_between_commands_are_nothing(seen):
    assert seen("\necho a\n\n\necho b\n\n") == ["~$ echo a", "a", "~$ echo b", "b"]


@pytest.mark.parametrize("command", ['echo "abc', "for i in 1; do", "cat <<END\nabc", "echo $("])
def test_an_unfinished_command_is_dropped(terminal, seen, command, says):
    shown = []
    with pytest.raises(TerminalError) as caught:
        terminal.type(f"echo before\n{command}", show=shown.append)
    says(caught.value, "is missing")
    assert shown[1] == "before"
    assert not terminal.busy
    assert seen("echo fine") == ["~$ echo fine", "fine"]


def test_a_syntax_error_is_bash_s_own(seen):
    shown = seen("echo )")
    assert "syntax error" in shown[1]
    assert "# exit code 2" in shown


def test_the_history_sign_is_not_special(seen):
    assert seen('echo "Hello!you" !! !1')[1] == "Hello!you !! !1"


def test_ctrl_c_shows_how_it_ends(terminal):
    terminal.type(TICK, until="tick 2", show=str)
    shown = []
    assert terminal.ctrl_c(show=shown.append) == 130
    assert shown == ["^C", "# exit code 130"]
    assert terminal.exit_code == 130


def test_ctrl_c_shows_what_a_program_says_at_the_end(terminal):
    command = f"(trap 'echo tidy; exit 0' INT; {TICK})"
    terminal.type(command, until="tick 2", show=str)
    shown = []
    assert terminal.ctrl_c(show=shown.append) == 0
    assert shown == ["^C", "tidy", "# exit code 0"]


def test_ctrl_c_reaches_a_loop_between_two_programs(terminal):
    for _ in range(5):
        terminal.type("while true; do /bin/true; done", seconds=0.02, show=str)
        assert terminal.ctrl_c(show=str) == 130


def test_ctrl_c_is_not_pressed_again_while_the_prompt_is_on_its_way(terminal):
    slow = "PROMPT_COMMAND='SECONDS=0; while [ $SECONDS -lt 2 ]; do :; done'"
    terminal.type(f"{slow}; (trap 'exit 0' INT; {TICK})", until="tick 2", show=str)
    assert terminal.ctrl_c(show=str) == 0
    terminal.type("true", show=str)
    assert terminal.exit_code == 0


SLOW_TO_LEAVE = """import signal, sys, time
def leave(*_):
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    time.sleep(1.5)
    sys.exit(0)
signal.signal(signal.SIGINT, leave)
print("ready", flush=True)
signal.pause()
"""


def test_ctrl_c_is_not_pressed_again_for_a_program_on_its_way_out(terminal, home):
    """Python takes its handlers away at the end, and may take its time then."""
    (home / "slow.py").write_text(SLOW_TO_LEAVE)
    terminal.type(f"{sys.executable} ~/slow.py", until="ready", show=str)
    assert terminal.ctrl_c(show=str) == 0


def test_ctrl_c_with_nothing_running(terminal):
    shown = []
    assert terminal.ctrl_c(show=shown.append) is None
    assert shown == ["# nothing runs in the terminal `sensor`"]


def test_patience_ends_the_watching_only(terminal):
    shown = []
    terminal.type("sleep 100\necho never typed", timeout=0.3, show=shown.append)
    assert shown[1].startswith("# `sleep 100` still runs after 0.3 s")
    assert shown[-1] == "# 1 more line in the cell, not typed"
    assert terminal.busy


def test_a_busy_terminal_refuses_and_says_how_to_go_on(terminal, says):
    terminal.type("sleep 100", seconds=0, show=str)
    with pytest.raises(TerminalError) as caught:
        terminal.type("echo hello", show=str)
    says(caught.value, "`sleep 100`", "%terminal sensor --ctrl-c", "%%terminal monitor")


def test_a_command_that_is_just_ending_is_waited_for(terminal, seen):
    terminal.type("echo done; sleep 0.3", until="done", show=str)
    assert seen("echo next") == ["~$ echo next", "next"]


def test_the_same_cell_again_stops_its_command_first(terminal):
    terminal.type(TICK, until="tick 3", show=str)
    shown = []
    terminal.type(TICK, until="tick 1", show=shown.append)
    assert shown[0].startswith("# `i=0; while true; do")
    assert shown[1] == "# stopped first"
    assert shown[2:] == [f"~$ {TICK}", "[INFO] [sensor]: tick 1"]


def test_a_program_that_ignores_ctrl_c_can_be_killed(terminal, says):
    terminal.type("(trap '' INT; echo deaf; sleep 100)", until="deaf", show=str)
    with pytest.raises(TerminalError) as caught:
        terminal.ctrl_c(timeout=0.5, show=str)
    says(caught.value, "%terminal sensor --kill")
    shown = []
    assert terminal.kill(show=shown.append) == 137
    assert shown[-1] == "# exit code 137"
    assert not terminal.busy


def test_a_program_that_reads_gets_answers(terminal):
    terminal.type("cat", seconds=0, show=str)
    shown = []
    terminal.answer("one\ntwo", show=shown.append)
    assert shown == ["one", "one", "two", "two"]
    assert terminal.ctrl_d(show=shown.append) == 0
    assert shown[-2:] == ["^D", "# exit code 0"]


def test_python_in_a_terminal(terminal):
    terminal.type("python -q", until=">>>", show=str)
    shown = []
    terminal.answer("6 * 7", show=shown.append)
    assert shown == [">>> 6 * 7", "42", ">>> "]
    terminal.answer("exit()", show=shown.append)
    assert not terminal.busy
    assert terminal.exit_code == 0


def test_without_a_program_there_is_nothing_to_answer(terminal, says):
    with pytest.raises(TerminalError) as caught:
        terminal.answer("yes", show=str)
    says(caught.value, "--answer")


def test_an_answer_that_a_terminal_would_cut_is_refused(terminal, says):
    terminal.type("cat", seconds=0, show=str)
    with pytest.raises(TerminalError) as caught:
        terminal.answer("x" * 5000, show=str)
    says(caught.value, "4,095")


def test_keys_in_a_cell_are_refused(terminal, says):
    with pytest.raises(TerminalError) as caught:
        terminal.type("echo \x03", show=str)
    says(caught.value, "control character")


def test_an_interrupt_leaves_the_command_alone(terminal, seen):
    signal.signal(signal.SIGALRM, _press)
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    with pytest.raises(KeyboardInterrupt) as caught:
        terminal.type("sleep 100", show=str)
    (line,) = caught.value._render_traceback_()
    assert line == "KeyboardInterrupt: `sleep 100` goes on running in the terminal `sensor`."
    assert terminal.busy
    assert terminal.ctrl_c(show=str) == 130
    assert seen("echo fine")[-1] == "fine"


def _press(*_):
    raise KeyboardInterrupt


def test_ctrl_d_is_never_turned_into_ctrl_c(terminal, says):
    terminal.type("sleep 100", seconds=0.1, show=str)
    with pytest.raises(TerminalError) as caught:
        terminal.ctrl_d(timeout=1.2, show=str)
    says(caught.value, "1.2 s after Ctrl+D", "--kill")
    assert terminal.busy


def test_a_loop_that_outlives_its_killed_program_can_be_closed(terminal, says):
    terminal.type("while true; do sleep 100; done", seconds=0.1, show=str)
    with pytest.raises(TerminalError) as caught:
        terminal.kill(timeout=0.3, show=str)
    says(caught.value, "after it was killed", "--close")


def test_a_cell_with_a_blank_is_not_typed_at_all(terminal, tmp_path):
    shown = []
    terminal.type("mkdir made\nmkdir ____", show=shown.append)
    assert shown == ["# nothing was typed: there is still a blank, ____, in line 3"]
    assert not list(tmp_path.rglob("made"))
    terminal.type("echo a____b", show=shown.append)
    assert shown[-1] == "a____b"


def test_a_command_that_fails_before_the_text_comes_has_said_so(terminal, says):
    shown = []
    terminal.type("ls nowhere", until="somewhere", show=shown.append)
    assert "# exit code 2" in shown
    with pytest.raises(TerminalError) as caught:
        terminal.type("echo nothing", until="somewhere", show=str)
    says(caught.value, "before the command ended")
    with pytest.raises(TerminalError):
        terminal.look(until="somewhere", show=str)


def test_an_ended_terminal_takes_no_command(terminal, says):
    terminal.type("exit", show=str)
    with pytest.raises(TerminalError) as caught:
        terminal.type("echo hello", show=str)
    says(caught.value, "has ended", "%%terminal sensor")
    assert terminal.ended
