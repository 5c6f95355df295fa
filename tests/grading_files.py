"""Pages and uploads for the tests of grading."""

import io
import json
import zipfile


def cell(source, sort="code", id="", exercise="", check=""):
    ours = {name: value for name, value in (("exercise", exercise), ("check", check)) if value}
    made = {"cell_type": sort, "source": source, "metadata": {"rosbeat": ours} if ours else {}}
    return made | ({"id": id} if id else {})


def notebook(*cells, lesson=""):
    metadata = {"rosbeat": {"lesson": lesson}} if lesson else {}
    return json.dumps({"cells": cells, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5})


BLANK = (
    "class Beat(Node):\n    def __init__(self):\n        super().__init__('beat')\n        ____\n"
)
DONE = BLANK.replace("____", "self.create_timer(1.0, self.tick)")


def page(lesson="03_write", title="Write", source=BLANK, exercise="03a"):
    return notebook(
        cell(f"# {title}", "markdown", f"{exercise}-title"),
        cell("import rclpy", id=f"{exercise}-import"),
        cell(source, id=f"{exercise}-cell", exercise=exercise),
        cell(f'check("{exercise}", Beat)', id=f"{exercise}-check", check=exercise),
        lesson=lesson,
    )


PAGE_03 = page(source=DONE)
PAGE_04 = page("04_listen", "Listen", DONE.replace("Beat", "Ear"), "04a")


def zipped(files):
    """A zip file with these files, as bytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return buffer.getvalue()
