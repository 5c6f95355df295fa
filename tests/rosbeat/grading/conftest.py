"""Pages and uploads that are made up, and commands as they are typed."""

import pytest

from grading_files import BLANK, page
from rosbeat import cli
from rosbeat.exercises.exercise import PASSED
from rosbeat.grading import commands
from rosbeat.grading import run as run_module
from rosbeat.page_runs.jobs import Evidence, PageEvidence
from rosbeat.page_runs.notebook import course_pages
from rosbeat.records import Outcome
from small_course import small_course


@pytest.fixture
def pages(tmp_path):
    folder = tmp_path / "course"
    folder.mkdir()
    (folder / "03_write.ipynb").write_text(page())
    blank = BLANK.replace("Beat", "Ear")
    (folder / "04_listen.ipynb").write_text(page("04_listen", "Listen", blank, "04a"))
    return course_pages(folder)


@pytest.fixture
def handed_in(tmp_path):
    """Write files into a folder: paths with slashes, and their text or bytes."""

    def make(files):
        root = tmp_path / "handed in"
        for name, content in files.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return root

    return make


# Commands.


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A very small course, and two learners of it."""
    root = small_course(tmp_path / "course")
    monkeypatch.setattr(commands, "course_root", lambda: root)
    for name in ("ana", "ben"):
        (tmp_path / "class" / name).mkdir(parents=True)
        text = (root / "notebooks/03_write.ipynb").read_text().replace("____", f"x = '{name}'")
        (tmp_path / "class" / name / "03_write.ipynb").write_text(text)


@pytest.fixture
def run(course, capsys):
    """Type a command: what it has printed, and its exit code."""

    def run(name, *words):
        parsed = cli._parser().parse_args([name, *map(str, words)])
        code = parsed.run(parsed)
        return capsys.readouterr(), code

    return run


class Workers:
    """Takes the place of the pool: every answer raises the same, and each job is counted."""

    def __init__(self, *options):
        self.options = options

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def observe(self, submissions):
        for key, job in (one for some in submissions for one in some):
            self.jobs.append(job)
            seen = Evidence("ended", raised="ZeroDivisionError", text="division by zero")
            yield key, PageEvidence(dict.fromkeys(job.subjects, seen))


@pytest.fixture
def workers(monkeypatch):
    made = type("Made", (Workers,), {"jobs": []})
    monkeypatch.setattr(commands, "Pool", made)
    return made


@pytest.fixture
def typed(course, workers, tmp_path, run):
    """Type `rosbeat grade`, and return what it has printed."""

    def typed(*words, code=0):
        words = (tmp_path / "class", "--out", tmp_path / "out", *words)
        said, ended = run("grade", *words)
        assert ended == code
        return said

    return typed


@pytest.fixture
def all_right(workers, monkeypatch):
    """Every answer is right, for all its points."""
    right = Outcome("03a", PASSED, points=1, out_of=1)
    monkeypatch.setattr(run_module, "judge_and_trace", lambda *_: (right, ""))
