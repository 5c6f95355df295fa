import ast
import subprocess

import pytest

from course_tool import bench, lab, prepare, relock, running, shell, testing
from course_tool.messages import Problem
from course_tool.testing import Counts, Verdict

PYTEST_REPORT = """<?xml version="1.0" encoding="utf-8"?>
<testsuites name="pytest tests"><testsuite name="pytest" errors="1" failures="2" skipped="3"
tests="20" time="1.0"></testsuite></testsuites>"""


def test_lab_opens_the_first_page(layout):
    page = layout.root / lab.FIRST_PAGE
    page.parent.mkdir()
    page.touch()
    command = lab.lab_command(layout, ["--no-browser", "--port", "9000"], root_user=False)
    assert command[1:3] == ["-m", "jupyterlab"]
    assert command[3] == f"--ServerApp.root_dir={layout.root}"
    page_address = "--LabApp.default_url=/lab/tree/notebooks/00_hear_the_heartbeat.ipynb"
    assert command[5:] == [page_address, "--no-browser", "--port", "9000"]


def test_lab_opens_the_folder_when_the_page_is_not_there(layout, capsys):
    command = lab.lab_command(layout, [], root_user=False)
    assert len(command) == 5
    assert "is not there" in capsys.readouterr().out


def test_lab_opens_the_first_page_that_there_is(layout):
    for name in ("04_listen.ipynb", "03_write.ipynb", "notes.ipynb"):
        page = layout.root / "notebooks" / name
        page.parent.mkdir(exist_ok=True)
        page.touch()
    command = lab.lab_command(layout, [], root_user=False)
    assert command[5:] == ["--LabApp.default_url=/lab/tree/notebooks/03_write.ipynb"]


def test_lab_opens_another_page_when_asked(layout):
    command = lab.lab_command(layout, ["notebooks/03.ipynb"], root_user=False)
    assert command[5:] == ["notebooks/03.ipynb"]


def test_labs_terminals_are_the_courses_shell(layout):
    option, value = lab.lab_command(layout, ["x.ipynb"], root_user=False)[4].split("=", 1)
    assert option == "--ServerApp.terminado_settings"
    assert ast.literal_eval(value) == {"shell_command": shell.interactive()}


def test_labs_terminals_are_the_persons_choice(layout):
    choice = "--ServerApp.terminado_settings={'shell_command': ['zsh']}"
    command = lab.lab_command(layout, ["x.ipynb", choice], root_user=False)
    assert command[4:] == ["x.ipynb", choice]


def test_lab_allows_the_root_user_once(layout):
    assert lab.lab_command(layout, [], root_user=True).count("--allow-root") == 1
    options = ["--allow-root"]
    assert lab.lab_command(layout, options, root_user=True).count("--allow-root") == 1


def test_test_runs_every_kind_of_check(layout, tmp_path):
    steps = testing.steps(layout, tmp_path / "report.xml")
    commands = [" ".join(step.command) for step in steps]
    for words in ("ruff check", "ruff format --check", "mypy", "rosbeat build --check", "pytest"):
        assert any(words in command for command in commands)
    assert "--dist loadfile" in commands[-1]
    assert "--thorough" not in commands[-1]
    *others, tests = testing.steps(layout, tmp_path / "report.xml", thorough=True)
    assert others == steps[:-1]
    assert tests.command == (*steps[-1].command, "--thorough")


@pytest.mark.parametrize(("cores", "number"), [(None, 3), (1, 3), (2, 3), (4, 5), (64, 6)])
def test_one_more_process_than_cores_shares_the_tests(cores, number):
    assert testing.workers(cores) == number


def test_pytests_report_is_read(tmp_path):
    (tmp_path / "report.xml").write_text(PYTEST_REPORT)
    assert testing.read_counts(tmp_path / "report.xml") == Counts(14, 3, 3)


@pytest.mark.parametrize("text", [None, "", "<cut off"])
def test_no_report_is_a_failure(tmp_path, text):
    if text is not None:
        (tmp_path / "report.xml").write_text(text)
    assert testing.read_counts(tmp_path / "report.xml") == Counts(0, 1, 0)


def closing(ok, counts):
    verdicts = [Verdict("lint", ok[0], 0.1), Verdict("tests", ok[1], 2.0)]
    return testing.summary(verdicts, counts).splitlines()[-1]


def test_the_closing_line_counts_everything():
    assert closing((True, True), Counts(14, 0, 3)) == "15 passed, 0 failed, 3 skipped"
    assert closing((False, True), Counts(14, 0, 0)) == "14 passed, 1 failed, 0 skipped"
    assert closing((True, False), Counts(14, 2, 0)) == "15 passed, 2 failed, 0 skipped"


def test_a_crash_of_pytest_itself_is_a_failure():
    assert closing((True, False), Counts(0, 0, 0)) == "1 passed, 1 failed, 0 skipped"


def test_every_step_runs_and_one_failure_is_enough(layout, monkeypatch, capsys):
    ran = []
    (layout.root / "tests").mkdir()

    def call(command, env, cwd):
        ran.append(command)
        return 0

    def run(command, **_):
        ran.append(command)
        bad = "ruff" in command
        return subprocess.CompletedProcess(command, int(bad), f"what {command[2]} says\n")

    monkeypatch.setattr(prepare, "ready", lambda layout, level: {"LEVEL": level})
    monkeypatch.setattr(testing.subprocess, "call", call)
    monkeypatch.setattr(testing.subprocess, "run", run)
    assert testing.test(layout, []) == 1
    assert len(ran) == 6
    out = capsys.readouterr().out
    assert "FAILED" in out
    assert "=== lint\nwhat ruff says\n\n=== format\nwhat ruff says\n\n=== types\n" in out
    assert out.splitlines()[-1] == "3 passed, 3 failed, 0 skipped"


def test_arguments_go_to_pytest_alone(layout, monkeypatch):
    ran = []
    (layout.root / "tests").mkdir()
    monkeypatch.setattr(prepare, "ready", lambda layout, level: {})
    monkeypatch.setattr(testing.subprocess, "call", lambda command, env: ran.append(command) or 5)
    assert testing.test(layout, ["-k", "clock"]) == 5
    assert ran == [[layout.python, "-m", "pytest", "-k", "clock"]]


def test_without_tests_nothing_is_installed(layout):
    with pytest.raises(Problem, match="no tests in this folder"):
        testing.test(layout, [])


def test_the_shell_is_told_only_what_differs():
    now = {"A": "1", "GONE": "x", "PATH": "/bin"}
    wanted = {"A": "1", "NEW": "two words; and $more", "PATH": "/venv/bin:/bin"}
    assert shell.difference(now, wanted) == [
        "unset GONE",
        "export NEW='two words; and $more'",
        "export PATH=/venv/bin:/bin",
    ]


def test_bench_says_when_its_files_are_missing(layout):
    with pytest.raises(Problem, match="not in this checkout"):
        bench.bench(layout, [])


def test_locks_are_made_for_every_python_and_name_no_machine(layout):
    command = [str(part) for part in relock.compile_command(layout, "test", ["--upgrade"])]
    text = " ".join(command[1:])
    assert "--universal --generate-hashes" in text
    assert "--python-version 3.10" in text
    assert "--constraint course.lock --upgrade test.in --output-file test.lock" in text
    assert str(layout.root) not in text


def test_every_lock_is_remade(layout, monkeypatch):
    ran = []

    def stream(command, env, shown, cwd):
        ran.append(str(command[-1]))
        return running.Result(0, "")

    monkeypatch.setattr(prepare, "ready", lambda layout, level: {})
    monkeypatch.setattr(running, "stream", stream)
    assert relock.relock(layout, []) == 0
    assert ran == ["bootstrap.lock", "build.lock", "course.lock", "test.lock"]
