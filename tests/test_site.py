"""What the site is built from: pages with their answers folded, and every link's target.

Sphinx itself, whose warnings are errors, and the browser are in tests/browser/test_site.py.
"""

import importlib.util
import json
import re
import subprocess
from html import unescape
from pathlib import Path

import pytest

from rosbeat.exercises.quiz import QUESTIONS

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted(path.name for path in (ROOT / "solutions").glob("[0-9][0-9]_*.ipynb"))
LINK = re.compile(r"\]\((?!https?:)([^)#\s]+)(?:#[^)]*)?\)")
AFTER = "After your prediction: what happened"
FENCE = re.compile(r"(?ms)^( *)(```+|~~~+).*?^\1\2")


@pytest.fixture(scope="module")
def site():
    spec = importlib.util.spec_from_file_location("stage_site", ROOT / "docs" / "site" / "stage.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def staged(site, tmp_path_factory):
    folder = tmp_path_factory.mktemp("staged")
    site.stage(folder)
    return folder


def cells(path):
    return json.loads(path.read_text("utf-8"))["cells"]


def texts(path):
    """The markdown of a document or a page, without its blocks of code."""
    if path.suffix == ".md":
        return [FENCE.sub("", path.read_text("utf-8"))]
    return ["".join(one["source"]) for one in cells(path) if one["cell_type"] == "markdown"]


def is_exercise(cell):
    return "exercise" in cell["metadata"].get("rosbeat", {})


def source(cell):
    return "".join(cell["source"])


def with_boxes(page):
    """Each cell that is shown, with the title of the box it is folded into, or an empty text."""
    title, shown = "", []
    for cell in cells(page):
        opens = re.fullmatch(r"<details class=\"answer\">\n<summary>(.+)</summary>", source(cell))
        if opens:
            assert not title, "a box in a box"
            title = opens[1]
        elif source(cell) == "</details>":
            title = ""
        else:
            shown.append((title, cell))
    assert not title, "a box that is not closed"
    return shown


def said(html):
    """A text as a reader sees it."""
    return " ".join(unescape(re.sub(r"<[^>]+>", "", html)).split())


@pytest.mark.parametrize("name", PAGES)
def test_a_page_shows_what_the_repository_shows(staged, name):
    shown = cells(staged / "notebooks" / name)
    texts = {source(cell) for cell in shown}
    printed = [out["text"] for cell in shown for out in cell.get("outputs", []) if "text" in out]
    for cell in cells(ROOT / "solutions" / name)[1:]:
        if re.match(r"(progress|quiz)\(", source(cell)) or cell["id"].startswith("neighbours"):
            assert source(cell) not in texts
        elif "home.ipynb" not in source(cell) and "predict(" not in source(cell):
            assert source(cell) in texts
        for out in cell.get("outputs", []):
            assert "text" not in out or out["text"] in printed


@pytest.mark.parametrize("name", PAGES)
def test_what_a_learner_begins_with_is_open(staged, name):
    """Blanks, predictions and the calls of checks, in the order of the learner's page."""
    begun = [source(cell) for cell in cells(ROOT / "notebooks" / name) if "outputs" in cell]
    shown = with_boxes(staged / "notebooks" / name)
    # What shows the outcome of a prediction from another side is folded with it.
    looks = {source(cell) for title, cell in shown if title == AFTER}
    wanted = [
        text for text in begun if not re.match(r"(progress|quiz)\(", text) and text not in looks
    ]
    opened = [source(cell) for title, cell in shown if not title and "outputs" in cell]
    assert [text for text in opened if text in wanted] == wanted


@pytest.mark.parametrize("name", PAGES)
def test_an_answer_is_folded_below_its_check(staged, name):
    shown = with_boxes(staged / "notebooks" / name)
    solutions = [cell for cell in cells(ROOT / "solutions" / name) if is_exercise(cell)]
    assert len(solutions) >= 2
    for cell in solutions:
        number = cell["metadata"]["rosbeat"]["exercise"]
        places = [at for at, (_, one) in enumerate(shown) if source(one) == source(cell)]
        assert [shown[at][0] for at in places] == [f"The answer to exercise {number}"]
        blanks = [at for at, (_, one) in enumerate(shown) if one["id"] == cell["id"]]
        assert len(blanks) == 1
        assert "____" in source(shown[blanks[0]][1])
        assert shown[blanks[0]][1]["outputs"] == []
        calls = [at for at, (_, one) in enumerate(shown) if f'check("{number}"' in source(one)]
        assert blanks[0] < calls[0] < places[0]
    for title, cell in shown:
        verdict = "passed.</strong>" in json.dumps(cell.get("outputs", []))
        assert title or not verdict or 'check("system"' in source(cell)


@pytest.mark.parametrize("name", PAGES)
def test_what_answers_a_prediction_is_folded_below_it(staged, name):
    shown = with_boxes(staged / "notebooks" / name)
    folded = [cell for title, cell in shown if title == AFTER]
    answering = [
        re.search(r"</summary>\n\n(.*)\n\n</details>", source(cell), re.DOTALL)[1]
        for cell in cells(ROOT / "notebooks" / name)
        if 'class="rosbeat-answer"' in source(cell)
    ]
    assert set(answering) <= {source(cell) for cell in folded}
    assert not {source(cell) for title, cell in shown if not title} & set(answering)
    for at, (title, cell) in enumerate(shown):
        if 'predict("____"' in source(cell):
            assert not title
            assert cell["outputs"] == []
            below_title, below = shown[at + 1]
            assert below_title == AFTER
            assert below["metadata"]["tags"] == ["remove-input"]
            assert "It was " in below["outputs"][-1]["data"]["text/plain"]
    # Who reads has told the page nothing.
    assert "You predicted" not in json.dumps([cell for _, cell in shown])


def test_the_picture_that_an_answer_is_about_is_folded_with_it(staged):
    shown = with_boxes(staged / "notebooks" / "04_write_a_subscriber.ipynb")
    assert [title for title, cell in shown if source(cell).startswith("viz.queue(")] == [AFTER]


@pytest.mark.parametrize("name", PAGES)
def test_a_question_shows_all_its_choices_and_folds_its_reasons(staged, name):
    shown = with_boxes(staged / "notebooks" / name)
    opened = said(" ".join(source(cell) for title, cell in shown if not title))
    for question in QUESTIONS[name[:2]]:
        folded = [one for title, one in shown if title == f"The answer to question {question.id}"]
        assert len(folded) == 1
        reasons = source(folded[0])
        assert question.text.replace("`", "") in opened
        for letter, choice in zip("abcdef", question.choices, strict=False):
            assert choice.text.replace("`", "") in opened
            assert choice.reason.replace("`", "") in said(reasons)
            assert choice.reason.replace("`", "") not in opened
            assert (f"<strong>{letter}. " in reasons) == choice.right


@pytest.mark.parametrize("name", PAGES)
def test_a_box_has_no_heading(staged, name):
    """Sphinx begins a section with a heading, and the box would end in the middle of it."""
    for title, cell in with_boxes(staged / "notebooks" / name):
        if title and cell["cell_type"] == "markdown":
            assert not re.search(r"(?m)^#+ ", FENCE.sub("", source(cell)))


@pytest.mark.parametrize("name", PAGES)
def test_a_page_has_its_number_and_cells_that_can_be_told_apart(staged, name):
    shown = cells(staged / "notebooks" / name)
    assert source(shown[0]).startswith(f"# {name[:2]} ")
    assert len({cell["id"] for cell in shown}) == len(shown)


def test_every_link_leads_to_something(staged):
    dead = [
        (path.relative_to(staged).as_posix(), target)
        for path in (*staged.rglob("*.md"), *staged.rglob("*.ipynb"))
        for text in texts(path)
        for target in LINK.findall(text)
        if not (path.parent / target).exists()
    ]
    assert dead == []


def test_every_document_is_in_a_table_of_contents(staged):
    listed = set(re.findall(r"(?m)^([\w/]+)$", (staged / "index.md").read_text("utf-8")))
    documents = {
        path.relative_to(staged).with_suffix("").as_posix()
        for path in (*staged.rglob("*.md"), *staged.rglob("*.ipynb"))
    }
    assert documents - listed == {"index"}


def test_every_page_can_be_started_elsewhere_once_the_repository_is_known(site, tmp_path):
    site.stage(tmp_path, "ada/rosbeat")
    for path in (*tmp_path.rglob("*.md"), *tmp_path.rglob("*.ipynb")):
        if path.suffix == ".md":
            title, text = path.read_text("utf-8").split("\n", 1)
        else:
            title, text = "".join(cells(path)[0]["source"]).split("\n", 1)
        assert title.startswith("# ")
        page = path.name if path.suffix == ".ipynb" else "home.ipynb"
        assert text.count(f"mybinder.org/v2/gh/ada/rosbeat/HEAD?urlpath=lab/tree/{page}") == 1
        assert text.count("https://codespaces.new/ada/rosbeat") == 1


def test_a_readme_with_its_own_links_keeps_them(site):
    text = "# rosbeat\n\n[Binder](https://mybinder.org/v2/gh/ada/rosbeat/HEAD)\n"
    assert site.with_launch(text, "ada/rosbeat") == text


@pytest.mark.parametrize(
    ("remote", "found"),
    [
        ("https://github.com/ada/rosbeat", "ada/rosbeat"),
        ("https://github.com/ada/ros.beat.git", "ada/ros.beat"),
        ("https://x-access-token:secret@github.com/ada/rosbeat.git", "ada/rosbeat"),
        ("git@github.com:ada/rosbeat.git", "ada/rosbeat"),
        ("ssh://git@github.com/ada/rosbeat", "ada/rosbeat"),
        ("https://gitlab.com/ada/rosbeat.git", ""),
        ("https://example.org/github.com/ada/rosbeat", ""),
        ("", ""),
    ],
)
def test_the_repository_is_where_origin_is(site, monkeypatch, tmp_path, remote, found):
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    if remote:
        subprocess.run(["git", "remote", "add", "origin", remote], cwd=tmp_path, check=True)
    monkeypatch.setattr(site, "ROOT", tmp_path)
    assert site.on_github() == found


def test_the_version_is_the_same_wherever_it_stands():
    version = re.search(r'__version__ = "(.+)"', (ROOT / "src/rosbeat/__init__.py").read_text())
    assert f"version: {version[1]}\n" in (ROOT / "CITATION.cff").read_text()
    assert 'dynamic = ["version"]' in (ROOT / "pyproject.toml").read_text()
    assert f"[{version[1]}]" in (ROOT / "docs/changelog.md").read_text()
