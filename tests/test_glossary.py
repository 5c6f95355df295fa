"""The glossary: every entry is linked from the page that explains it, where its word is bold."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
GLOSSARY = (ROOT / "docs" / "glossary.md").read_text("utf-8")
ENTRIES = re.findall(r"(?m)^## (.+)\n\n((?:.+\n)+)", GLOSSARY)
PAGE = re.compile(r"Page\s+(\d\d):\s+\[[^\]]+\]\(\.\./notebooks/(\w+)\.ipynb\)")


def anchor(term):
    return re.sub(r"[^a-z0-9 -]", "", term.lower()).replace(" ", "-")


def test_the_entries_are_in_order_and_say_something():
    terms = [term.lower() for term, _ in ENTRIES]
    assert terms == sorted(terms)
    assert len(set(terms)) == len(terms) >= 60


@pytest.mark.parametrize(("term", "text"), ENTRIES, ids=[term for term, _ in ENTRIES])
def test_the_page_that_explains_a_term_links_to_it(term, text):
    number, stem = PAGE.search(text).groups()
    lesson = (ROOT / "src" / "lessons" / f"{stem}.py").read_text("utf-8")
    assert stem.startswith(number)
    assert re.search(rf"\*\*\]\(\.\./docs/glossary\.md#{anchor(term)}\)", lesson)


@pytest.mark.parametrize(("term", "text"), ENTRIES, ids=[term for term, _ in ENTRIES])
def test_entries_refer_to_entries(term, text):
    known = {anchor(one) for one, _ in ENTRIES}
    assert set(re.findall(r"\]\(#([\w-]+)\)", text)) <= known - {anchor(term)}
