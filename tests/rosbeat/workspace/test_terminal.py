"""Commands, answers and keys, typed into a real bash, and what a page shows of them."""

import signal
import sys
import time

import pytest

from rosbeat.errors import TerminalError
from rosbeat.records import LogRecord
from rosbeat.workspace.terminals import Terminals, output, shell
from rosbeat.workspace.terminals.output import LONGEST_LINE

TICK = 'i=0; while true; do i=$((i+1)); echo "[INFO] [sensor]: tick $i"; sleep 0.05; done'


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """Type into one terminal that all rows of a table share; return what was shown."""
    home = tmp_path_factory.mktemp("home")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROSBEAT_STEADY_HOME", str(home))
        with Terminals() as terminals:

            def type_and_see(text):
                patch.setenv("ROSBEAT_STEADY_HOME", str(home))
                shown = []
                terminals.get("shared").type(text.replace("HOME", str(home)), show=shown.append)
                return [line.replace(str(home), "HOME") for line in shown]

            yield type_and_see


@pytest.mark.parametrize(
    "lines",
    [
        ["~$ echo hello", "hello"],
        ["~$ # nothing happens here"],
        ["~$ (exit 42)", "# exit code 42"],
        ["~$ printf abc", "abc", "~$ echo next", "next"],
        ["~$ for i in 1 2; do", ">   echo $i", "> done", "1", "2"],
    ],
    ids=lambda lines: lines[0],
)
def test_commands_are_shown_with_their_folder(page, lines):
    typed = [line.split(" ", 1)[1] for line in lines if line.startswith(("~$ ", "> "))]
    assert page("\n".join(typed)) == lines


MARK = r"\033]7771;other.;P;0;/\007"


@pytest.mark.parametrize(
    ("typed", "end"),
    [
        ("\necho a\n\n\necho b\n\n", ["~$ echo a", "a", "~$ echo b", "b"]),
        # Over several lines, and none of them lost.
        ("cat <<END\na\tb\n\n  c\nEND", ["a\tb", "", "  c"]),
        ("echo one \\\n  two", ["one two"]),
        ("echo 'a\n\nb'", ["a", "", "b"]),
        # Letters and signs.
        ('echo "Hello!you" !! !1', ["Hello!you !! !1"]),
        ("echo 21 °C ✓ 🤖 Größe 温度", ["21 °C ✓ 🤖 Größe 温度"]),
        ("printf '\\xff\\xfe'; printf '°%.0s' $(seq 5000)", ["��" + "°" * 5000]),
        (f"echo {'x' * 10_000} | wc -c", ["10001"]),
        # Programs know that colours are not shown, and find the Python of the course.
        ("echo $TERM $NO_COLOR $RCUTILS_COLORIZED_OUTPUT $HISTFILE", ["dumb 1 0"]),
        # Exit codes.
        ("sh -c 'kill $$'", ["# exit code 143"]),
        # A line that is repainted is shown by its last state.
        *((f"printf '{sent}\\n'", [shown]) for sent, shown in (
            (r"10%%\r50%%\r100%%", "100%"), (r"a\tb\r\r", "a\tb"),
            (r"long line\r\033[Kshort", "short"),
            (r"\033[31mred\033[0m", "red"),
            (r"\033]0;title\007te\033]0;title\033\\xt", "text"),
            (r"ab\bX\007", "aX"))),
        # A mark of another terminal is text, wherever a read cuts.
        *((f"printf '{'x' * cut}{MARK}\\n'; (exit 3)", ["x" * cut, "# exit code 3"])
          for cut in range(1, 40, 13)),
        # A steady run shows the same on every machine.
        *((f"echo '{real}'", [steady]) for real, steady in (
            ("Finished <<< a [1.23s]", "Finished <<< a [0.00s]"),
            ("Summary: 1 package finished [1min 2.5s]", "Summary: 1 package finished [0.00s]"),
            ("===== 3 passed in 0.05s =====", "===== 3 passed in 0.00s ====="),
            ("[1] 31234", "[1] 1234"),
            ("[INFO] [1732212345.123456789] [a]: b", "[INFO] [a]: b"),
            ("lib/python3.11/site-packages", "lib/python3.12/site-packages"),
            ("Publishing: 22.13C", "Publishing: 22.13C"), ("at HOME.", "at /home/you."),
            ("HOME-2/ws", "HOME-2/ws"),
            (f"{sys.prefix}/bin/ros2", "/home/you/rosbeat/.venv/bin/ros2"))),
    ],
)  # fmt: skip
def test_what_is_typed_and_what_is_shown(page, typed, end):
    shown = [
        line.strip(" ") if "\\r" in typed or "\\033" in typed else line for line in page(typed)
    ]
    assert shown[-len(end) :] == end


def test_the_folder_is_followed_and_variables_last(seen, home, terminal):
    (home / "setup.bash").write_text("export GREETING=hello\n")
    seen("source setup.bash\nNUMBER=3")
    assert seen("echo $GREETING $NUMBER")[1:] == ["hello 3"]
    assert seen("mkdir -p ROS2_and_RL_Tutorials/src\ncd ROS2_and_RL_Tutorials/src\npwd")[1:] == [
        "~$ cd ROS2_and_RL_Tutorials/src",
        "ROS2_and_RL_Tutorials/src$ pwd",
        "/home/you/ROS2_and_RL_Tutorials/src",
    ]
    assert terminal.folder == home / "ROS2_and_RL_Tutorials" / "src"
    text = "\n".join(f"line {number} " + "y" * 500 for number in range(200))
    seen(f"cat > long.txt <<'END'\n{text}\nEND")
    assert (terminal.folder / "long.txt").read_text() == text + "\n"


@pytest.mark.parametrize(
    ("command", "missing"),
    [
        ('echo "abc', 'A closing `"` is missing.'),
        ("echo $(", "A closing `)` is missing."),
        ("for i in 1; do", "unexpected end of file"),
        ("cat <<END\nabc", "(wanted `END')"),
        ("echo a \\", "its end is missing"),
    ],
)
def test_an_unfinished_command_is_not_typed(terminal, command, missing, says):
    shown = []
    with pytest.raises(TerminalError) as caught:
        terminal.type(f"echo before\n{command}", show=shown.append)
    says(caught.value, "is missing", missing)
    assert shown == []
    assert not terminal.busy


def test_what_only_bash_s_options_make_unfinished_is_dropped(seen):
    seen("alias begin='for i in 1; do'")
    assert seen("begin")[-1] == "# the last command is not finished, and was dropped"
    assert seen("echo fine") == ["~$ echo fine", "fine"]


# Keys.


def tidy(command):
    return f"(trap 'echo tidy; exit 0' INT; {command})"


@pytest.mark.parametrize(
    ("command", "shown"),
    [(TICK, ["# exit code 130"]), (tidy(TICK), ["tidy", "# exit code 0"])],
)
def test_ctrl_c_shows_how_it_ends(terminal, command, shown):
    terminal.type(command, until="tick 2", show=str)
    seen = []
    code = terminal.ctrl_c(show=seen.append)
    assert seen == ["^C", *shown]
    assert code == terminal.exit_code == int(shown[-1].split()[-1])


def test_ctrl_c_reaches_a_loop_between_two_programs(terminal):
    for _ in range(2):
        terminal.type("while true; do /bin/true; done", seconds=0.02, show=str)
        assert terminal.ctrl_c(show=str) == 130


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


def test_a_program_that_ignores_ctrl_c_can_be_killed(terminal, says):
    terminal.type("(trap '' INT; echo deaf; sleep 100)", until="deaf", show=str)
    with pytest.raises(TerminalError) as caught:
        terminal.ctrl_c(timeout=0.5, show=str)
    says(caught.value, "%terminal sensor --kill")
    shown = []
    assert terminal.kill(show=shown.append) == 137
    assert shown[-1] == "# exit code 137"
    assert not terminal.busy


@pytest.mark.parametrize(
    "command",
    [
        "while true; do echo tick; sleep 0.5; done",
        "for i in {1..1000}; do echo tick; bash -c \"trap '' INT; sleep 0.5\"; done",
        "until false; do echo tick; /bin/true; done",
        "echo tick; while :; do :; done",
        "count() { while true; do echo tick; sleep 0.3; done; }; count",
    ],
)
def test_a_loop_is_killed_and_not_only_the_program_that_it_is_at(terminal, command):
    terminal.type(command, until="tick", show=str)
    terminal.kill(show=str)
    assert not terminal.busy
    shown = []
    terminal.type("echo still here", show=shown.append)
    assert (shown[-1], terminal.exit_code) == ("still here", 0)


def test_a_loop_that_ignores_every_request_ends_with_its_terminal(terminal):
    terminal.type("trap '' INT; while true; do echo tick; sleep 0.1; done", until="tick", show=str)
    terminal.kill(show=str)
    assert terminal.ended


def test_ctrl_d_is_never_turned_into_ctrl_c(terminal, says):
    terminal.type("sleep 100", seconds=0.1, show=str)
    with pytest.raises(TerminalError) as caught:
        terminal.ctrl_d(timeout=1.2, show=str)
    says(caught.value, "1.2 s after Ctrl+D", "--kill")
    assert terminal.busy


def test_ctrl_c_works_in_a_terminal_of_a_kernel_that_ignores_it(home):
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with Terminals() as terminals:
            terminals.get("sensor").type("sleep 100", seconds=0.1, show=str)
            assert terminals.get("sensor").ctrl_c(show=str) == 130
    finally:
        signal.signal(signal.SIGINT, before)


def test_an_interrupt_leaves_the_command_alone(terminal, seen):
    signal.signal(signal.SIGALRM, _press)
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    with pytest.raises(KeyboardInterrupt) as caught:
        terminal.type("sleep 100", show=str)
    line, *ways = caught.value._render_traceback_()
    assert "`%terminal sensor --ctrl-c` in a cell of its own stops it" in ways[-1]
    assert line == "KeyboardInterrupt: `sleep 100` goes on running in the terminal `sensor`."
    assert terminal.busy
    assert terminal.ctrl_c(show=str) == 130
    assert seen("echo fine")[-1] == "fine"


def _press(*_):
    raise KeyboardInterrupt


# Answers.


def test_a_program_that_reads_gets_answers(terminal):
    shown = []
    terminal.type("cat", seconds=0, show=str)
    terminal.answer("one\ntwo", show=shown.append)
    assert shown == ["one", "one", "two", "two"]
    assert terminal.ctrl_d(show=shown.append) == 0
    assert shown[-2:] == ["^D", "# exit code 0"]
    terminal.type("python -q", until=">>>", show=str)
    shown.clear()
    terminal.answer("6 * 7", show=shown.append)
    assert shown == [">>> 6 * 7", "42", ">>> "]
    terminal.answer("exit()", show=shown.append)
    assert not terminal.busy
    assert terminal.exit_code == 0


def test_a_question_without_a_newline_counts_when_the_program_is_silent(terminal):
    shown = []
    terminal.type("read -p 'Your name: ' name; echo Hello $name", until="name", show=shown.append)
    assert shown[-1] == "Your name: "
    terminal.answer("Ada", show=shown.append)
    assert shown[-2:] == ["Your name: Ada", "Hello Ada"]


def test_a_program_that_does_not_read_is_given_up(terminal, says, monkeypatch):
    terminal.type("sleep 100", seconds=0, show=str)
    monkeypatch.setattr(shell, "_TAKES_WITHIN", 0.3)
    with pytest.raises(TerminalError) as caught:
        terminal.answer("\n".join(["x" * 4000] * 40), show=str, seconds=0.01)
    says(caught.value, "accepts no more input", "Ctrl+C")


# How long a page follows a command, and what is refused meanwhile.


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


def test_a_command_is_watched_until_a_text_and_goes_on(terminal):
    shown = []
    terminal.type(TICK, until="tick", lines=3, show=shown.append)
    assert shown[1:] == [f"[INFO] [sensor]: tick {number}" for number in (1, 2, 3)]
    assert terminal.busy
    later = []
    terminal.look(until="tick", lines=2, show=later.append)
    assert later == ["[INFO] [sensor]: tick 4", "[INFO] [sensor]: tick 5"]
    assert terminal.logs()[0].text == "tick 1"


def test_only_the_last_command_is_waited_for_by_its_text(terminal):
    shown = []
    terminal.type("cd /\necho tick\necho tock; cat", until="tock", show=shown.append)
    assert shown == ["~$ cd /", "/$ echo tick", "tick", "/$ echo tock; cat", "tock"]


def test_a_command_is_watched_for_a_while(terminal, seen):
    began = time.monotonic()
    assert seen("echo a", seconds=60) == ["~$ echo a", "a"]  # it is not waited for
    assert time.monotonic() - began < 30
    began, command = time.monotonic(), "echo a; sleep 100"
    remark = f"# `{command}` goes on running in the terminal `sensor`"
    assert seen(command, seconds=0.6) == [f"~$ {command}", "a", remark]
    assert time.monotonic() - began >= 0.6
    assert terminal.busy
    terminal.ctrl_c(show=str)
    shown = seen("sleep 100\necho never typed", timeout=0.3)
    assert shown[1].startswith("# `sleep 100` still runs after 0.3 s")
    assert shown[-1] == "# 1 more line in the cell, not typed"
    assert terminal.busy


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda one: one.type("echo abc; sleep 100", until="xyz", timeout=0.4, show=str),
         ["`xyz` did not appear", "0.4 s", "abc"]),
        (lambda one: one.type("echo abc", until="xyz", lines=2, show=str),
         ["before the command ended", "in 2 lines"]),
        (lambda one: one.type("true xyz", until="xyz", show=str), []),  # the typed line
        (lambda one: (one.type("echo abc", show=str), one.look(until="xyz", show=str)),
         ["before the command ended", "abc"]),
        (lambda one: (one.type("ls nowhere", until="x", show=str), one.look(until="y", show=str)),
         []),
        (lambda one: one.answer("yes", show=str), ["--answer"]),
        (lambda one: one.type("echo \x03", show=str), ["control character"]),
        (lambda one: (one.type("exit", show=str), one.type("echo hello", show=str)),
         ["has ended", "%%terminal sensor"]),
    ],
)  # fmt: skip
def test_what_cannot_be_done_is_explained(terminal, says, call, words):
    with pytest.raises(TerminalError) as caught:
        call(terminal)
    says(caught.value, *words)


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


# Much output.


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


def test_a_line_without_end_is_cut_and_counted(seen, terminal, monkeypatch):
    monkeypatch.setattr(output, "KEPT_CHARACTERS", 100_000)
    cut = "x" * LONGEST_LINE + f" ... {1_000_000 - LONGEST_LINE:,} more characters"
    assert seen("head -c 1000000 /dev/zero | tr '\\0' x")[1] == cut
    seen("for i in $(seq 9); do head -c 30000 /dev/zero | tr '\\0' x; echo; done")
    gone, *_ = terminal.text.splitlines()
    assert "earlier lines are not kept" in gone
    assert len(terminal.text) < 110_000


# The shell, its jobs and its end.


@pytest.mark.parametrize(
    ("command", "code"),
    [
        *(("exit", 0), ("exit 3", 3), ("set -e\nfalse", 1), ("exec true", 0), ("kill -9 $$", 137)),
        ("sleep 100 &\nexit", 0),
    ],
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


def test_remarks_have_short_lines_and_say_what_a_failure_means(seen):
    shown = seen("ros2 pkg create --build-type ament_python room rclpy sensor_msgs")
    assert shown[-2:] == [
        "# exit code 2",
        "# The option --dependencies is missing. Write each option before its values.",
    ]
    first, *rest = seen("colcon build")
    assert rest
    assert all(line.startswith("# ") and len(line) <= 100 for line in (first, *rest))


# Commands that are not typed.


@pytest.fixture
def folders(home):
    """Workspaces beside the learner's own, and a checkout around it that holds a package."""
    for package in ("src/command", "mine/src/robots/arm"):
        (home / package).mkdir(parents=True)
        (home / package / "package.xml").touch()
    for folder in ("ROS2_and_RL_Tutorials/src/deep", "notebooks", "other/src/empty", "a:b/src"):
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
        # The folder may be changed in the same line.
        (".", "cd ROS2_and_RL_Tutorials && colcon build --packages-select none", False),
        ("ROS2_and_RL_Tutorials", "cd .. && colcon build", True),
        ("ROS2_and_RL_Tutorials", "(cd ../notebooks; time colcon test)", True),
        ("ROS2_and_RL_Tutorials", "pushd /tmp && colcon build", True),
        ("ROS2_and_RL_Tutorials", "if true; then cd ..; colcon build; fi", True),
        ("ROS2_and_RL_Tutorials", "cd .. && cd other/.. && colcon build --help", False),
        ("ROS2_and_RL_Tutorials", "cd nowhere; colcon build --packages-select none", False),
        (".", 'cd "$ROS2_WORKSPACE" && colcon build --packages-select none', False),
        ("ROS2_and_RL_Tutorials", "echo 'cd ..' && echo colcon build", False),
        ("a:b", "colcon build", True),
        ("notebooks", "colcon build --help", False),
        ("notebooks", "echo colcon build", False),
    ],
)
def test_colcon_builds_in_a_workspace_only(seen, folders, folder, command, outside):
    shown = " ".join(seen(f"colcon() {{ :; }}\ncd {folder}\n{command} > /dev/null"))
    assert ("nothing was typed" in shown) is outside


@pytest.mark.parametrize(
    ("typed", "parts"),
    [
        ("colcon build", ["the terminal is in `a`, which is outside", "Page 01 creates"]),
        ("vi setup.py", ["file browser"]),
        ("cat /dev/null | less", ["cat FILE"]),
        ("cd ..; sudo nano x", ["file browser"]),
        ("A=1 /usr/bin/top", ["File, New, Terminal"]),
        ("mkdir made\nmkdir ____", ["there is still a blank, ____, in line 3"]),
        ("echo a____b", None),
        ("echo vi", None),
        ("top -b -n 1 | head -1", None),
        ("less --version | head -1", None),
    ],
)
def test_what_needs_a_whole_screen_or_has_a_blank_is_not_typed(seen, home, terminal, typed, parts):
    seen("mkdir a; cd a")
    shown = seen(f"{typed}\necho done")
    said = " ".join(shown).replace(" # ", " ")
    assert ("# nothing was typed: " in said) == (parts is not None) == (shown[-1] != "done")
    for part in parts or ():
        assert part in said
    assert "____" in typed or parts is None or shown[-1] == "# 1 more line in the cell, not typed"
    assert not terminal.busy
    assert not (home / "a" / "made").exists()
