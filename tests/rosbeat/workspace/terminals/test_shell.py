"""What a real bash is sent, and what it sends."""

import pytest


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


def test_output_without_end_is_borne(terminal, seen):
    terminal.type("yes", until="y", lines=3000, show=str)
    assert terminal.ctrl_c(show=str) == 130
    assert seen("echo still here")[-1] == "still here"
    assert len(terminal.text) < 5_000_000


def test_repainted_lines_are_shown_by_their_last_state(seen):
    assert seen(r"printf '10%%\r50%%\r100%%\n\033[31mred\033[0m\n'")[1:] == ["100%", "red"]


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
