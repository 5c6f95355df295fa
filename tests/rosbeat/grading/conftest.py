"""Pages and uploads that are made up."""

import pytest

from grading_files import BLANK, page
from rosbeat.grading.notebook import course_pages


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
