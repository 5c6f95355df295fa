"""`rosbeat check`: all checks of a page in a terminal."""

import json
from pathlib import Path

import pytest

from arrangements import ARRANGEMENTS
from grading_class import filled, pages_of
from rosbeat import check_command, cli
from rosbeat.exercises.hint import answer_to
from rosbeat.exercises.progress import progress_file

(PAGE,) = pages_of("03")


@pytest.fixture
def saved(tmp_path):
    """Save page 03 with these answers, and return its path as it is typed."""

    def save(**answers):
        path = tmp_path / "03_write_a_publisher.ipynb"
        path.write_text(filled(PAGE, {f"03{name}": text for name, text in answers.items()}))
        return str(path)

    return save


@pytest.mark.ros
def test_a_page_with_all_answers_ends_with_0_and_stays_as_it_is(saved, capsys):
    path = saved(a=answer_to("03a"), b=answer_to("03b"), c=answer_to("03c"))
    before = Path(path).read_bytes(), progress_file().standings()
    assert cli.main(["check", path]) == 0
    said = capsys.readouterr().out
    assert "03_write_a_publisher.ipynb: 3 of 3 exercises passed." in said
    assert "Exercise 03c: passed, 4 of 4 points." in said
    assert (Path(path).read_bytes(), progress_file().standings()) == before


@pytest.mark.ros
def test_the_outcomes_are_those_of_the_page_and_the_end_is_1(saved, capsys):
    wrong = answer_to("03a").replace("/humidity", "humid").replace('"humidity"', '"humid"')
    path = saved(a=wrong, c="class Broken(Node:\n    pass")
    assert cli.main(["check", path, "--json"]) == cli.FAILED
    a, b, c = json.loads(capsys.readouterr().out)
    assert [one["exercise"] for one in (a, b, c)] == ["03a", "03b", "03c"]
    assert [one["status"] for one in (a, b, c)] == ["failed", "not attempted", "failed"]
    assert a["outcome"]["mistake"]
    assert "Hint:" in a["text"]
    assert "Python says: " in c["text"]


@pytest.mark.ros
def test_a_cell_that_ends_its_process_costs_its_own_exercise_only(saved, capsys):
    path = saved(a="import os\nos._exit(1)", b=answer_to("03b"), c=answer_to("03c"))
    assert cli.main(["check", path]) == cli.FAILED
    said = capsys.readouterr().out
    assert "2 of 3 exercises passed" in said
    assert "The answer ended its process with exit code 1" in said


@pytest.mark.ros
def test_a_check_that_is_gone_is_made_as_the_course_makes_it_or_missed(saved, capsys, monkeypatch):
    path = saved(a=answer_to("03a"), b=answer_to("03b"), c=answer_to("03c"))
    document = json.loads(Path(path).read_text())
    document["cells"] = [cell for cell in document["cells"] if '03b",' not in str(cell["source"])]
    Path(path).write_text(json.dumps(document).replace('check(\\"03b\\"', 'print(\\"03b\\"'))
    assert cli.main(["check", path]) == 0
    monkeypatch.setattr(check_command, "course_root", lambda: None)
    assert cli.main(["check", path]) == cli.FAILED
    assert (
        'Exercise 03b: not checked. No cell of the page checks it, as `check("03b", ...)` does.'
        in (capsys.readouterr().out)
    )


@pytest.mark.ros
def test_a_bare_cd_changes_nothing_as_on_the_page(saved, capsys):
    stays = "import os\n\nassert os.getcwd() == place\n\n"
    path = saved(a=stays + answer_to("03a"), b=answer_to("03b"), c=answer_to("03c"))
    document = json.loads(Path(path).read_text())
    blank = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    scratch = ["import os\nplace = os.getcwd()", "cd .."]
    document["cells"][:0] = [{**blank, "source": source} for source in scratch]
    Path(path).write_text(json.dumps(document))
    assert cli.main(["check", path]) == 0
    assert "3 of 3" in capsys.readouterr().out


@pytest.mark.ros
def test_every_arrangement_of_right_answers_passes(tmp_path, capsys):
    paths = []
    for name, arranged in ARRANGEMENTS.items():
        paths.append(tmp_path / f"{name}.ipynb")
        paths[-1].write_text(json.dumps(arranged("03")))
    code = cli.main(["check", *map(str, paths), "--json"])
    results = json.loads(capsys.readouterr().out)
    assert [result for result in results if result["status"] != "passed"] == []
    assert (code, len(results)) == (0, 3 * len(ARRANGEMENTS))


@pytest.mark.parametrize("text", [None, "", "{", "[]", '{"cells": []}', '{"nbformat": 4}'])
def test_what_is_not_a_page_is_refused_before_anything_runs(tmp_path, text, capsys):
    path = tmp_path / "03.ipynb"
    if text is not None:
        path.write_text(text)
    assert cli.main(["check", str(path)]) == cli.FAILED
    said = capsys.readouterr().err
    assert "03.ipynb cannot be checked" in said
    assert "no page was run" in said
