"""`course lab`, with a program in the place of JupyterLab: its options, its start and its end."""

import ast
import fcntl
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from course_tool import commands, lab

ENVIRONMENT = Path(__file__).parents[2] / "environment"

#: The tool as the launcher runs it, in another checkout and without installing anything.
TOOL = """\
import os, sys
sys.path.insert(0, {environment!r})
from pathlib import Path
from course_tool import cli, prepare
from course_tool.layout import Layout
cli.of_this_checkout = lambda: Layout(Path({root!r}))
prepare.ready = lambda layout, level: dict(os.environ)
sys.exit(cli.main(sys.argv[1:]))
"""
#: What JupyterLab does when its port is open. Its process id stays when it becomes `sleep`.
OPENS = """\
echo "[W] a warning that frightens"
mkdir -p "$JUPYTER_RUNTIME_DIR"
file="$JUPYTER_RUNTIME_DIR/jpserver-$$.json"
echo '{"url": "http://localhost:8888/", "hostname": "localhost", "port": PORT,' > "$file.new"
echo '"token": "abc"}' >> "$file.new"
mv "$file.new" "$file"
exec sleep 1000
"""


def page(layout, name):
    path = layout.root / name
    path.parent.mkdir(exist_ok=True)
    path.write_text("{}")


def options_of(layout, options, root_user=False):
    """The command without what it always begins with: the Python and three settings."""
    return lab.lab_command(layout, options, root_user=root_user)[3:]


def test_it_opens_the_first_page_of_the_learners_folder(layout):
    for name in ("04_listen.ipynb", "03_write.ipynb", "notes.ipynb"):
        page(layout, f"my_course/{name}")
    options = options_of(layout, ["--no-browser", "--port", "9000"])
    assert options[0] == f"--ServerApp.root_dir={layout.root}/my_course"
    assert options[-4:] == [
        "--LabApp.default_url=/lab/tree/03_write.ipynb", *("--no-browser", "--port", "9000")
    ]  # fmt: skip


@pytest.mark.parametrize(
    "options", [["--ServerApp.root_dir=/elsewhere"], ["--notebook-dir", "/elsewhere"], ["/tmp"]]
)
def test_another_folder_has_none_of_our_pages(layout, options, capsys):
    page(layout, "my_course/home.ipynb")
    assert not any("default_url" in option for option in options_of(layout, options))
    assert capsys.readouterr().out == ""
    info = {"url": "http://localhost:8888/", "token": "abc"}
    assert lab.address(layout, info, options) == "http://localhost:8888/lab?token=abc"
    asked = lab.address(layout, info, [*options, "mine.ipynb"])
    assert asked == "http://localhost:8888/lab/tree/mine.ipynb?token=abc"


def setting(options, name):
    """The value of the one option with a name in it."""
    (found,) = (one for one in options if name in one)
    return ast.literal_eval(found.split("=", 1)[1])


def test_terminals_and_the_style_sheet_are_the_courses(layout, capsys):
    options = options_of(layout, [], root_user=True)
    assert setting(options, "terminado") == {"shell_command": commands.interactive_shell()}
    (place,) = setting(options, "tornado_settings")["static_custom_path"]
    assert os.path.isfile(os.path.join(place, "custom.css"))
    assert options.count("--allow-root") == 1
    assert not any("default_url" in option for option in options)
    assert "There is no page" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("option", "name"),
    [
        ("--ServerApp.root_dir=/elsewhere", "root_dir"),
        ("--ServerApp.terminado_settings={'shell_command': ['zsh']}", "terminado"),
        ("--allow-root", "allow-root"),
        ("03_write.ipynb", ".ipynb"),
    ],
)
def test_what_a_person_asks_for_takes_the_place_of_the_courses(layout, option, name):
    page(layout, "my_course/00_hear.ipynb")
    options = options_of(layout, [option], root_user=True)
    assert [one for one in options if name in one] == [option]


def test_an_option_may_be_longer_than_a_file_name(layout):
    page(layout, "my_course/home.ipynb")
    options = options_of(layout, [f"--ServerApp.jpserver_extensions={'x' * 5000}"])
    assert "--LabApp.default_url=/lab/tree/home.ipynb" in options


# From the start to the end.


@pytest.fixture
def tool(made):
    """The tool as a program, in a checkout with one page."""
    page(made, "notebooks/00_hear.ipynb")
    return TOOL.format(environment=str(ENVIRONMENT), root=str(made.root))


@pytest.fixture
def environ():
    dropped = ("ROSBEAT_WORKSPACE_IN", "JUPYTER_RUNTIME_DIR")
    return {name: value for name, value in os.environ.items() if name not in dropped}


@pytest.fixture
def start(made, tool, environ):
    """Start `course lab` with a program in the place of JupyterLab."""
    started = []
    port = socket.create_server(("localhost", 0))

    def begin(program, *options):
        program = program.replace("PORT", str(port.getsockname()[1]))
        made.python.write_text(f"#!/bin/sh\n{program}")
        started.append(
            subprocess.Popen(
                [sys.executable, "-I", "-c", tool, "lab", *options],
                env=environ, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            )
        )  # fmt: skip
        return started[-1]

    yield begin
    for process in started:
        if process.poll() is None:
            process.kill()
        process.wait()
        process.stdout.close()
        process.stderr.close()
    port.close()


def is_there(number):
    try:
        os.kill(number, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGHUP])
def test_two_lines_and_then_it_ends_as_one_asks(start, made, number):
    process = start(OPENS)
    lines = [process.stdout.readline() for _ in range(3)]
    assert lines == [
        "Your own pages are in the folder my_course.\n",
        "The course is open at  http://localhost:8888/lab/tree/00_hear.ipynb?token=abc\n",
        "Ctrl+C stops it. JupyterLab's messages go to my_course/.rosbeat/lab.log\n",
    ]
    (info,) = (made.notes / "run").glob("jpserver-*.json")
    process.send_signal(number)
    out, err = process.communicate(timeout=100)
    assert (process.returncode, err) == (0, "")
    assert out.splitlines()[-1].startswith("Stopped.")
    assert not is_there(int(info.stem.partition("-")[2]))
    log = made.notes / "lab.log"
    assert log.read_text() == "[W] a warning that frightens\n"
    assert log.stat().st_mode & 0o777 == 0o600  # a real one has the token in it


def test_a_second_one_says_where_the_first_is_even_if_that_was_killed(start, made):
    first = start(OPENS)
    opened = [first.stdout.readline() for _ in range(3)][1].split()[-1]
    (info,) = (made.notes / "run").glob("jpserver-*.json")
    server = int(info.stem.partition("-")[2])
    log = (made.notes / "lab.log").read_text()
    out, err = start("exit 9").communicate(timeout=100)
    assert out.splitlines()[0] == f"The course is open already, at  {opened}"
    assert "press Ctrl+C in the\nterminal" in out
    assert (err, (made.notes / "lab.log").read_text()) == ("", log)
    # JupyterLab goes on without the command that started it, and can be found.
    first.kill()
    first.wait()
    assert opened in start("exit 9").communicate(timeout=100)[0]
    os.kill(server, signal.SIGKILL)
    info.unlink()
    third = start(OPENS)
    assert "The course is open at" in third.stdout.readline()
    third.send_signal(signal.SIGINT)
    assert "Stopped." in third.communicate(timeout=100)[0]
    assert not (made.notes / "address").exists()


def test_progress_can_be_written_while_the_course_is_open(start, made):
    first = start(OPENS)
    assert "open at" in [first.stdout.readline() for _ in range(3)][1]
    folder = os.open(made.notes, os.O_RDONLY)
    try:
        # What `only_writer` of `rosbeat.workspace.saving` waits for.
        fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
    finally:
        os.close(folder)


def test_a_question_is_answered_while_the_course_is_open(start):
    first = start(OPENS)
    assert "open at" in [first.stdout.readline() for _ in range(3)][1]
    assert start('echo "all options"', "--help").communicate(timeout=100)[0] == "all options\n"


def test_an_option_that_is_wrong_is_said_in_three_parts(start):
    out, err = start('echo "[C] Bad config"; exit 1').communicate(timeout=100)
    assert "The course is open" not in out
    for words in ("What happened:       JupyterLab ended before it was open.", "What to try:"):
        assert words in err
    assert "    [C] Bad config" in err


def test_a_server_that_dies_later_is_told_too(start):
    process = start(OPENS.replace("exec sleep 1000", "exit 3"))
    said = process.communicate(timeout=100)[1]  # before or after it could be opened
    assert "What happened:       JupyterLab " in said
    assert process.returncode == 1


# For the images of containers.


def test_an_image_gets_the_folder_and_nothing_is_opened(tool, environ, made):
    command = [sys.executable, "-I", "-c", tool, "prepare"]
    done = subprocess.run(command, env=environ, capture_output=True, text=True, check=True)
    assert done.stdout == "Your own pages are in the folder my_course.\n"
    assert (made.learner / "00_hear.ipynb").exists()


def test_the_program_that_binder_starts_gets_the_options_of_the_course(tool, environ, made):
    program = ["sh", "-c", 'pwd; printf "%s\\n" "$@"', "sh", "--port=8888"]
    command = [sys.executable, "-I", "-c", tool, "serve", *program]
    done = subprocess.run(command, env=environ, capture_output=True, text=True, check=True)
    folder, *options = done.stdout.splitlines()[1:]
    assert Path(folder).samefile(made.learner)
    assert options[0] == "--port=8888"
    assert options[1:] == lab.lab_options(made, (), root_user=os.geteuid() == 0)
