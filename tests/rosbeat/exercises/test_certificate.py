"""The certificate: who gets one, what it says, and that it is one sheet of paper."""

import re
import shutil
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest

from rosbeat import cli
from rosbeat.exercises.certificate import keep_run
from rosbeat.exercises.check import check
from rosbeat.exercises.exercise import passed
from rosbeat.exercises.progress import progress_file
from rosbeat.exercises.registry import PAGES
from rosbeat.exercises.system import SystemRun
from rosbeat.records import NANOSECONDS, LogRecord

FINISHED = Path(__file__).parents[3] / "solutions" / "sensor_simulator"
CORE = [one for page in PAGES if not page.elective for one in page.exercises]
READINGS = ("22.13", "22.40", "21.97")
SVG = "{http://www.w3.org/2000/svg}"


def logs(name, text):
    """Three log lines of a node, a second apart."""
    lines = enumerate(READINGS, 1)
    return tuple(
        LogRecord(at * NANOSECONDS, "INFO", name, text.format(one), "", 0) for at, one in lines
    )


RUN = SystemRun(
    sent=logs("greenhouse_sensor", "Publishing: {}C"),
    taken=logs("greenhouse_monitor", "Temperature: {}C - Status: Normal"),
)


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    return tmp_path


def pass_core(*but):
    for one in CORE:
        if one.id not in but:
            right = replace(passed(""), points=one.points)
            progress_file().change(one.id, lambda before, right=right: before.after(right))


@pytest.fixture
def finished(home):
    """The folder of a learner who has finished the core."""
    pass_core()
    keep_run(RUN)
    return home


def run(*typed):
    return cli.main(["certificate", *typed])


def text_of(svg):
    return " ".join("".join(one.itertext()) for one in ElementTree.parse(svg).iter(f"{SVG}text"))


def test_it_says_who_has_built_what_and_how_to_check_it(finished, capsys):
    assert run("--name", "Ada Lovelace") == 0
    printed = capsys.readouterr().out
    shown = text_of(finished / "certificate.svg")
    for words in (
        *("Ada Lovelace", f"all {len(CORE)} exercises in the core", "sensor_simulator"),
        *("greenhouse_sensor and greenhouse_monitor", "3 readings crossed on /temperature."),
        *("learner's own statement", "rosbeat grade"),
    ):
        assert words in " ".join(shown.split())
        assert words in printed
    # The learner's own readings are in the picture.
    assert all(shown.split().count(value) == 2 for value in READINGS)
    assert "all arrived at greenhouse_monitor" in printed
    assert printed.endswith(f"{finished / 'certificate.svg'}\n{finished / 'certificate.pdf'}\n")


def test_a_run_without_log_lines_is_told_in_words(home, capsys):
    pass_core()
    line = "Temperature: 22.13C - Status: Normal\n"
    keep_run(replace(RUN, sent=(), taken=(), repeated=line * 2))
    assert run("--name", "Ada") == 0
    printed = capsys.readouterr().out
    assert "2 readings crossed on /temperature." in printed
    assert "none are drawn" in " ".join(text_of(home / "certificate.svg").split())


@pytest.mark.parametrize(("paper", "size"), [("a4", (842, 595)), ("letter", (792, 612))])
def test_it_is_one_sheet_of_paper_across(finished, paper, size):
    assert run("--name", "Ada", "--paper", paper) == 0
    root = ElementTree.parse(finished / "certificate.svg").getroot()
    inches = (float(root.get(one).removesuffix("pt")) for one in ("width", "height"))
    assert tuple(map(round, inches)) == size
    pdf = (finished / "certificate.pdf").read_bytes()
    (box,) = re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", pdf)
    assert tuple(round(float(one)) for one in box) == size
    assert len(re.findall(rb"/Type /Page\b", pdf)) == 1


def test_it_is_light_on_paper_and_has_its_words_for_who_cannot_see_it(finished):
    assert run("--name", "Ada") == 0
    text = (finished / "certificate.svg").read_text()
    assert "prefers-color-scheme" not in text
    root = ElementTree.fromstring(text)
    assert root.get("role") == "img"
    assert root.get("aria-label").startswith("Certificate. Ada has passed all ")
    assert next(root.iter(f"{SVG}path")).get("style").startswith("fill: #ffffff")
    assert b"/Title (Certificate of Ada)" in (finished / "certificate.pdf").read_bytes()


def test_the_name_is_asked_for_and_nothing_else(finished, monkeypatch):
    asked = []
    monkeypatch.setattr("builtins.input", lambda words: asked.append(words) or "  Grace   Hopper ")
    assert run() == 0
    assert len(asked) == 1
    assert "Grace Hopper" in text_of(finished / "certificate.svg")


@pytest.mark.parametrize("name", ["Zoë O'Brien & <Söhne>", "$x^2$", "M" * 60, "Ng\u0303a"])
def test_any_name_is_written_as_it_is(finished, name):
    assert run("--name", name) == 0
    assert name in text_of(finished / "certificate.svg")
    assert (finished / "certificate.pdf").exists()


@pytest.mark.parametrize("name", ["李小龙", "محمد", "דנה"])
def test_a_name_that_the_pdf_cannot_write_is_written_by_a_browser(finished, capsys, name):
    assert run("--name", "Ada") == 0
    assert run("--name", name) == 0
    assert name in text_of(finished / "certificate.svg")
    # There is none rather than one with boxes, or with somebody else's name.
    assert not (finished / "certificate.pdf").exists()
    assert "print it there" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("name", "what"),
    [(" ", "no name"), ("M" * 61, "61 characters"), ("A\x07da", "cannot be printed")],
)
def test_what_is_no_name_is_refused(finished, monkeypatch, capsys, name, what):
    assert run("--name", name) == 2
    said = capsys.readouterr().err
    assert what in said
    assert "What to try:" in said
    assert not (finished / "certificate.svg").exists()


def test_nobody_there_to_ask_is_refused(finished, monkeypatch, capsys):
    def ask(_):
        raise EOFError

    monkeypatch.setattr("builtins.input", ask)
    assert run() == 2
    assert "--name" in capsys.readouterr().err


def test_open_exercises_of_the_core_are_listed_with_their_pages(home, monkeypatch, capsys):
    monkeypatch.setattr("builtins.input", lambda _: pytest.fail("asked in vain"))
    pass_core("03b", "03c", "system")
    keep_run(RUN)
    assert run() == 1
    said = capsys.readouterr().err
    assert f"3 of {len(CORE)} exercises in the core are still open." in said
    listed = re.findall(r"\n    (\S+): (.+)", said)
    assert listed == [
        ("03_write_a_publisher.ipynb", "03b and 03c"),
        ("06_build_source_run.ipynb", "system"),
    ]
    assert "Open 03_write_a_publisher.ipynb, continue with exercise 03b" in said


OTHER_DAY = '{"format": "rosbeat run of the system", "version": 1, "day": "today", "run": {}}'


@pytest.mark.parametrize("kept", [None, "", '{"format": "another", "version": 1}', OTHER_DAY])
def test_a_run_that_is_not_there_is_asked_for_again(home, capsys, kept):
    pass_core()
    if kept is not None:
        (home / ".rosbeat" / "system.json").write_text(kept)
    assert run("--name", "Ada") == 1
    said = capsys.readouterr().err
    assert "What it means:" in said
    assert 'check("system", workspace.folder())' in said


def test_a_program_of_somebody_else_keeps_no_run(tmp_path, monkeypatch):
    monkeypatch.delenv("ROSBEAT_PROGRESS_IN", raising=False)
    monkeypatch.setenv("ROSBEAT_WORKSPACE_IN", str(tmp_path))
    keep_run(RUN)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.ros
def test_a_check_that_passes_keeps_the_run_for_the_certificate(home, capsys):
    workspace = home / "workspace"
    shutil.copytree(FINISHED, workspace / "src" / "sensor_simulator")
    assert check("system", workspace).outcome.status == "passed"
    pass_core("system")
    assert run("--name", "Ada") == 0
    assert "temperature_sensor and temperature_monitor" in capsys.readouterr().out
    assert (home / "certificate.pdf").exists()
