"""A small class that hands in real pages, with answers of the bank."""

import json

from bank.pages import ROOT
from rosbeat.grading.submissions import collect
from rosbeat.page_runs.notebook import course_pages


def pages_of(*numbers):
    """Pages of the course."""
    return tuple(one for one in course_pages(ROOT / "notebooks") if one.number in numbers)


def filled(page, answers):
    """A page's notebook with answers, by exercise, in the place of its blanks."""
    document = json.loads((ROOT / "notebooks" / f"{page.lesson}.ipynb").read_text("utf-8"))
    for cell in document["cells"]:
        exercise = cell["metadata"].get("rosbeat", {}).get("exercise")
        cell["source"] = answers.get(exercise, cell["source"])
    return json.dumps(document)


def hand_in(folder, pages, learners):
    """A collection: for each learner the answers by exercise."""
    for number, answers in enumerate(learners):
        for page in pages:
            path = folder / f"learner_{number}" / f"{page.lesson}.ipynb"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(filled(page, answers), "utf-8")
    return collect(folder, pages)
