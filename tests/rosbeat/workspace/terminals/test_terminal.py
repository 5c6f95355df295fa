"""Commands, answers and keys, typed into a real bash, and what a page shows of them."""

import signal
import sys
import time

import pytest

from rosbeat.errors import TerminalError
from rosbeat.records import LogRecord
from rosbeat.workspace import meanings
from rosbeat.workspace.terminals import Terminals
from rosbeat.workspace.terminals.output import KEPT_CHARACTERS, LONGEST_LINE

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


@pytest.mark.parametrize(
    ("command", "missing"),
    [
        ('echo "abc', 'closing quote `"`'),
        ("echo 'abc", "closing quote `'`"),
        ("echo $(", "closing bracket `)`"),
        ("echo ${HOME", "closing brace `}`"),
        ("echo `ls", "closing backquote"),
        ("for i in 1; do", "`done`"),
        ("cat <<END\nabc", "the line `END`"),
        ("ls |", "its end"),
    ],
)
def test_an_unfinished_command_is_dropped(terminal, seen, command, missing, says):
    shown = []
    with pytest.raises(TerminalError) as caught:
        terminal.type(f"echo before\n{command}", show=shown.append)
    says(caught.value, "is missing", missing)
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
    with pytest.raises(TerminalError):
        terminal.look(until="somewhere", show=str)
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


# How long a page follows a command.


def test_a_command_is_watched_until_a_text_and_goes_on(terminal):
    shown = []
    terminal.type(TICK, until="tick", lines=3, show=shown.append)
    assert shown[1:] == [f"[INFO] [sensor]: tick {number}" for number in (1, 2, 3)]
    assert terminal.busy
    assert terminal.wait_for("tick", lines=6)[5] == "[INFO] [sensor]: tick 6"
    later = []
    terminal.look(until="tick", lines=2, show=later.append)
    assert later == ["[INFO] [sensor]: tick 4", "[INFO] [sensor]: tick 5"]
    assert terminal.logs()[0].text == "tick 1"


def test_only_the_last_command_is_waited_for_by_its_text(terminal):
    shown = []
    terminal.type("cd /\necho tick\necho tock; cat", until="tock", show=shown.append)
    assert shown == ["~$ cd /", "/$ echo tick", "tick", "/$ echo tock; cat", "tock"]


def test_a_command_is_watched_for_a_while(terminal):
    shown = []
    began = time.monotonic()
    terminal.type("echo a; sleep 100", seconds=0.6, show=shown.append)
    assert time.monotonic() - began >= 0.6
    assert shown == [
        "~$ echo a; sleep 100",
        "a",
        "# `echo a; sleep 100` goes on running in the terminal `sensor`",
    ]
    assert terminal.busy


def test_a_command_that_ends_earlier_is_not_waited_for(seen):
    began = time.monotonic()
    assert seen("echo a", seconds=60) == ["~$ echo a", "a"]
    assert time.monotonic() - began < 30


def test_a_text_that_does_not_come_is_an_error(terminal, says):
    with pytest.raises(TerminalError) as caught:
        terminal.type("echo abc; sleep 100", until="xyz", timeout=0.4, show=str)
    says(caught.value, "`xyz` did not appear", "0.4 s", "abc")
    assert terminal.busy
    with pytest.raises(TerminalError):
        terminal.wait_for("xyz", timeout=0.1)


def test_a_command_that_ends_before_the_text_is_an_error(terminal, says):
    with pytest.raises(TerminalError) as caught:
        terminal.type("echo abc", until="xyz", lines=2, show=str)
    says(caught.value, "before the command ended", "in 2 lines")
    assert not terminal.busy


def test_the_typed_line_itself_does_not_count(terminal):
    with pytest.raises(TerminalError):
        terminal.type("true xyz", until="xyz", show=str)


def test_a_question_without_a_newline_counts_when_the_program_is_silent(terminal):
    shown = []
    terminal.type("read -p 'Your name: ' name; echo Hello $name", until="name", show=shown.append)
    assert shown[-1] == "Your name: "
    terminal.answer("Ada", show=shown.append)
    assert shown[-2:] == ["Your name: Ada", "Hello Ada"]


def test_a_question_is_completed_by_its_own_answer_only(terminal):
    terminal.type("read -p 'One? ' a; echo more; read b", until="One?", show=str)
    shown = []
    terminal.answer("x", show=shown.append)
    terminal.answer("y", show=shown.append)
    assert shown == ["One? x", "more", "y"]


def test_what_comes_between_two_cells_is_kept_and_not_shown(terminal, eventually, home):
    terminal.type("(until [ -e go ]; do sleep 0.02; done; echo late) &", show=str)
    (home / "go").touch()
    eventually(lambda: "late" in terminal.text.splitlines())
    shown = []
    terminal.type("echo now", show=shown.append)
    assert shown[:2] == ["~$ echo now", "now"]
    assert "late" not in shown


def test_a_look_shows_what_came_and_how_it_ended(terminal, eventually, home):
    terminal.type("until [ -e go ]; do sleep 0.02; done; echo late; (exit 5)", seconds=0, show=str)
    (home / "go").touch()
    eventually(lambda: not terminal.busy)
    shown = []
    terminal.look(show=shown.append)
    assert shown == ["late", "# exit code 5"]
    shown.clear()
    terminal.look(show=shown.append)
    assert shown == []


def test_a_look_for_a_text_that_never_came_is_an_error(terminal, says):
    terminal.type("echo abc", show=str)
    with pytest.raises(TerminalError) as caught:
        terminal.look(until="xyz", show=str)
    says(caught.value, "before the command ended", "abc")


# What a real bash is sent, and what it sends.


def test_variables_and_sourced_files_last(seen, home):
    (home / "setup.bash").write_text("export GREETING=hello\n")
    seen("source setup.bash\nNUMBER=3")
    assert seen("echo $GREETING $NUMBER")[1:] == ["hello 3"]


def test_letters_of_all_languages(seen):
    assert seen("echo 21 °C ✓ 🤖 Größe 温度")[1] == "21 °C ✓ 🤖 Größe 温度"
    assert seen("printf '\\xff\\xfe'; printf '°%.0s' $(seq 5000)")[1] == "��" + "°" * 5000


def test_long_lines_and_long_texts_are_typed_whole(seen, terminal, home):
    assert seen(f"echo {'x' * 10_000} | wc -c")[-1] == "10001"
    text = "\n".join(f"line {number} " + "y" * 500 for number in range(200))
    seen(f"cat > long.txt <<'END'\n{text}\nEND")
    assert (home / "long.txt").read_text() == text + "\n"


def test_much_output_is_cut_and_counted(seen, terminal):
    shown = seen("seq 100000")
    assert len(shown) == 521
    assert shown[:3] == ["~$ seq 100000", "1", "2"]
    assert shown[500] == "# 99,481 lines left out"
    assert shown[-1] == "100000"
    assert len(terminal.text.splitlines()) <= 20_001
    assert not [line for line in seen("seq 510") if "left out" in line]


def test_output_without_end_is_borne(terminal, seen):
    terminal.type("yes", until="y", lines=3000, show=str)
    assert terminal.ctrl_c(show=str) == 130
    assert seen("echo still here")[-1] == "still here"
    assert len(terminal.text) < 5_000_000


@pytest.mark.parametrize(
    ("sent", "shown"),
    [
        (r"10%%\r50%%\r100%%", "100%"),
        (r"a\tb\r\r", "a\tb"),
        (r"long line\rshort", "shortline"),
        (r"long line\r\033[Kshort", "short"),
        (r"\033[31mred\033[0m", "red"),
        (r"\033]0;title\007te\033]0;title\033\\xt", "text"),
        (r"abc\b\bX\007", "aXc"),
        (r"one\033[2Ktwo", "two"),
        (r"one\033[1Gtwo", "two"),
    ],
)
def test_a_repainted_line_is_shown_by_its_last_state(seen, sent, shown):
    assert seen(f"printf '{sent}\\n'")[1].strip() == shown


def test_a_line_without_end_is_cut_and_counted(seen, terminal):
    cut = "x" * LONGEST_LINE + f" ... {1_000_000 - LONGEST_LINE:,} more characters"
    assert seen("head -c 1000000 /dev/zero | tr '\\0' x")[1] == cut
    seen("for i in $(seq 250); do head -c 30000 /dev/zero | tr '\\0' x; echo; done")
    gone, *_ = terminal.text.splitlines()
    assert "earlier lines are not kept" in gone
    assert len(terminal.text) < KEPT_CHARACTERS + 10_000


def test_programs_know_that_colours_are_not_shown(seen):
    assert seen("echo $TERM $NO_COLOR $RCUTILS_COLORIZED_OUTPUT $HISTFILE")[1] == "dumb 1 0"


def test_the_python_of_the_course_is_found(seen):
    assert seen("command -v python")[1] == "/home/you/rosbeat/.venv/bin/python"


@pytest.mark.parametrize(
    ("command", "code"),
    [("exit", 0), ("exit 3", 3), ("set -e\nfalse", 1), ("exec true", 0), ("kill -9 $$", 137)],
)
def test_a_shell_that_ends_is_followed_by_a_new_one(terminals, terminal, seen, command, code):
    shown = seen(f"cd /\n{command}\necho never")
    assert "# the terminal `sensor` has ended; its next use opens a new one" in shown
    assert "echo never" not in "".join(shown)
    assert terminal.ended
    assert terminal.exit_code == code
    again = terminals.get("sensor")
    assert again is not terminal
    again.type("pwd", show=shown.append)
    assert shown[-1] == "/home/you"


def test_exit_with_programs_in_the_background(seen, terminal):
    seen("sleep 100 &\nexit")
    assert terminal.ended


def test_jobs_in_the_background(seen):
    assert seen("sleep 100 &") == ["~$ sleep 100 &", "[1] 1234"]
    assert seen("kill %1; wait")[-1].startswith("[1]+  Terminated")


@pytest.mark.parametrize("cut", range(1, 40, 3))
def test_a_mark_of_another_terminal_is_text_wherever_a_read_cuts(seen, cut):
    mark = r"\033]7771;other.;P;0;/\007"
    assert seen(f"printf '{'x' * cut}{mark}\\n'; (exit 3)")[1:] == ["x" * cut, "# exit code 3"]


def test_lines_of_ros_become_records(terminal):
    terminal.type(
        """cat <<END
[INFO] [1732212345.123456789] [temperature_sensor]: Publishing: 22.13C
[WARN] [ns.monitor]: warm [INFO] [b]: c
[HELLO] [a]: b
END""",
        show=str,
    )
    plain, warm = terminal.logs()
    # A steady run shows no stamps, so both have the time at which they were read.
    assert plain == LogRecord(
        plain.time_ns, "INFO", "temperature_sensor", "Publishing: 22.13C", "", 0
    )
    assert (warm.name, warm.text) == ("ns.monitor", "warm [INFO] [b]: c")
    assert abs(warm.time_ns - time.time_ns()) < 60e9


def test_the_meaning_of_a_failure_stands_below_its_exit_code(seen, home, monkeypatch):
    calls = []

    def explain(*question):
        calls.append(question)
        return f"It means `{'a b ' * 20}` of\n{question[4]}" if question[2] else None

    monkeypatch.setattr(meanings, "explain", explain)
    assert seen("cd /\necho a; false")[-4:] == [
        "a",
        "# exit code 1",
        f"# It means `{'a b ' * 20}` of",
        "# /home/you/ROS2_and_RL_Tutorials",
    ]
    root = home / "ROS2_and_RL_Tutorials"
    assert [call[:4] for call in calls] == [
        ("cd /", "", 0, home),
        ("echo a; false", "a", 1, home.__class__("/")),
    ]
    assert calls[0][4] == root


def test_long_remarks_are_wrapped_and_what_is_to_be_typed_is_not(seen, monkeypatch):
    command = "`colcon build --packages-select sensor_simulator`"
    monkeypatch.setattr(meanings, "explain", lambda *_: "word " * 30 + command + " build-type")
    shown = seen("false")[2:]
    assert len(shown) > 1
    assert all(line.startswith("# ") and len(line) <= 100 for line in shown)
    assert any(command in line for line in shown)


# Commands that are not typed.


@pytest.fixture
def folders(home):
    """Workspaces beside the learner's own, and a checkout around it that holds a package."""
    for package in ("src/command", "mine/src/robots/arm"):
        (home / package).mkdir(parents=True)
        (home / package / "package.xml").touch()
    for folder in ("ROS2_and_RL_Tutorials/src/deep", "notebooks", "other/src/empty"):
        (home / folder).mkdir(parents=True)
    (home / "link").symlink_to(home / "ROS2_and_RL_Tutorials")


@pytest.mark.parametrize(
    ("folder", "command", "outside"),
    [
        ("ROS2_and_RL_Tutorials", "colcon build --packages-select none", False),
        ("ROS2_and_RL_Tutorials/src/deep", "colcon build --packages-select none", False),
        ("link", "colcon build --packages-select none", False),
        ("mine/src/robots", "colcon test --packages-select none", False),
        ("notebooks", "colcon build", True),
        (".", "  colcon  test --event-handlers x", True),
        ("other", "colcon build;ls", True),
        ("/", "colcon --log-base l build && x --base-paths y", True),
        ("notebooks", "colcon build --help", False),
        ("notebooks", "echo colcon build", False),
    ],
)
def test_colcon_builds_in_a_workspace_only(seen, folders, folder, command, outside):
    shown = " ".join(seen(f"cd {folder}\n{command} > /dev/null 2>&1"))
    assert ("nothing was typed" in shown) is outside


def test_a_terminal_types_no_build_outside(seen, terminal):
    shown = seen("mkdir a; cd a\ncolcon build\necho never")
    assert shown[1].startswith("# nothing was typed: the terminal is in `a`, which is outside")
    assert shown[-2].endswith("Page 01 makes the workspace.")
    assert shown[-1] == "# 1 more line in the cell, not typed"
    assert terminal.command == "mkdir a; cd a"


@pytest.mark.parametrize(
    ("command", "way"),
    [
        ("vi setup.py", "file browser"),
        ("cat /dev/null | less", "cat FILE"),
        ("cd ..; sudo nano x", "file browser"),
        ("A=1 /usr/bin/top", "top -b -n 1"),
        ("(watch ls)", "File, New, Terminal"),
    ],
)
def test_a_program_that_needs_a_whole_screen_is_not_started(seen, terminal, command, way):
    shown = seen(f"{command}\necho never")
    assert shown[0].startswith("# nothing was typed: `")
    assert way in " ".join(shown)
    assert shown[-1] == "# 1 more line in the cell, not typed"
    assert not terminal.busy


@pytest.mark.parametrize(
    "command", ["echo vi", "top -b -n 1 | head -1", "less --version | head -1"]
)
def test_others_are_started(seen, command):
    assert seen(command)[0] == f"~$ {command}"


def test_a_program_that_only_wants_keys_is_left_alone(seen, terminal, home):
    (home / "keys.py").write_text(
        "import time, tty; tty.setcbreak(0); print('~~~'); time.sleep(99)"
    )
    seen(f"{sys.executable} -u keys.py", until="~~~")
    assert terminal.busy
    assert terminal.ctrl_c(show=str) == 130


# The environment of a terminal.


def test_what_a_kernel_sets_for_itself_stays_behind(home, monkeypatch):
    for name in ("MPLBACKEND", "FORCE_COLOR", "PYTEST_CURRENT_TEST", "PS4", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, "x")
    monkeypatch.setenv("LC_ALL", "C")
    with Terminals() as terminals:
        terminals.get("a").type(
            "echo [$MPLBACKEND$FORCE_COLOR$PYTEST_CURRENT_TEST$XDG_CONFIG_HOME] $LC_ALL; cd; pwd",
            show=(shown := []).append,
        )
    assert shown[1:] == ["[] C.UTF-8", "/home/you"]


def test_a_learner_keeps_home_name_and_folders(monkeypatch, tmp_path):
    monkeypatch.delenv("ROSBEAT_STEADY_HOME", raising=False)
    monkeypatch.setenv("ROSBEAT_WORKSPACE_IN", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path / "ada"))
    monkeypatch.setenv("USER", "ada")
    monkeypatch.setenv("LC_ALL", "de_DE.utf8")
    (tmp_path / "ada" / "more").mkdir(parents=True)
    with Terminals() as terminals:
        terminal = terminals.get("a")
        terminal.type(
            "echo $USER $HOME $LC_ALL; echo 'in 0.05s [INFO] [1732212345.5] [a]: b'\n"
            "mkdir ws; cd ws\ncd ~/more\ncd /\ncd ~\ntrue",
            show=(shown := []).append,
        )
    place = tmp_path.name
    assert shown == [
        f"{place}$ echo $USER $HOME $LC_ALL; echo 'in 0.05s [INFO] [1732212345.5] [a]: b'",
        f"ada {tmp_path}/ada de_DE.utf8",
        "in 0.05s [INFO] [1732212345.5] [a]: b",
        f"{place}$ mkdir ws; cd ws",
        "ws$ cd ~/more",
        "ada/more$ cd /",
        "/$ cd ~",
        "~$ true",
    ]


@pytest.mark.parametrize(
    ("real", "steady"),
    [
        ("Finished <<< a [1.23s]", "Finished <<< a [0.00s]"),
        ("Summary: 1 package finished [1min 2.5s]", "Summary: 1 package finished [0.00s]"),
        ("===== 3 passed in 0.05s =====", "===== 3 passed in 0.00s ====="),
        ("[1] 31234", "[1] 1234"),
        ("[INFO] [1732212345.123456789] [a]: b", "[INFO] [a]: b"),
        ("lib/python3.11/site-packages", "lib/python3.12/site-packages"),
        ("Publishing: 22.13C", "Publishing: 22.13C"),
        ("at HOME.", "at /home/you."),
        ("HOME-2/ws", "HOME-2/ws"),
        ("PREFIX/bin/ros2", "/home/you/rosbeat/.venv/bin/ros2"),
    ],
)
def test_a_steady_run_shows_the_same_on_every_machine(seen, home, real, steady):
    real = real.replace("PREFIX", sys.prefix).replace("HOME", str(home))
    assert seen(f"echo '{real}'")[1] == steady.replace("HOME", str(home))


def test_ctrl_c_works_in_a_terminal_of_a_kernel_that_ignores_it(home):
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with Terminals() as terminals:
            terminals.get("sensor").type("sleep 100", seconds=0.1, show=str)
            assert terminals.get("sensor").ctrl_c(show=str) == 130
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_closed_pipe_ends_a_program_quietly(seen):
    assert seen("yes | head -1") == ["~$ yes | head -1", "y"]
