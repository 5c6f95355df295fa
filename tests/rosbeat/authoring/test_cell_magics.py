"""Cells for a terminal and cells that become files."""

from __future__ import annotations

import pytest

from rosbeat.authoring import pages
from rosbeat.authoring.lint import check_lessons
from rosbeat.errors import LessonError

SETUP = "src/sensor_simulator/setup.py"
BODY = f"""
    # %% terminal="build"
    # cd ws
    # # a comment of bash
    #
    # ls

    # %% terminal="sensor --ctrl-c"

    # %% save="src/p/package.xml"
    # <package>
    #   <name>p</name>

    # %% exercise="00a" save="{SETUP}"
    setup(
        # --- answer
        entry="sensor = p.sensor:main",
        # --- blank
        # entry=____,
        # --- end
    )

    # %% check="00a"
    check("00a")
"""


def texts(page):
    return [cell.source for cell in page.cells if cell.cell_type == "code"]


def test_what_stands_behind_comment_signs_stands_bare_on_the_page(checkout):
    terminal, key, xml, setup, _ = texts(pages.solution_draft(checkout.lesson(BODY)))
    assert terminal == "%%terminal build\ncd ws\n# a comment of bash\n\nls"
    assert key == "%terminal sensor --ctrl-c"
    assert xml == "%%save src/p/package.xml\n<package>\n  <name>p</name>"
    assert setup == f'%%save {SETUP}\nsetup(\n    entry="sensor = p.sensor:main",\n)'


def test_blanks_stand_in_files_that_no_kernel_runs(checkout):
    lesson = checkout.lesson(BODY)
    assert texts(pages.notebook_page(lesson))[3] == f"%%save {SETUP}\nsetup(\n    entry=____,\n)"
    lints = {finding.lint for finding in check_lessons(checkout.course, [lesson], [lesson])}
    assert not lints & {"syntax", "blank-outside-function", "stray-blank", "prose-as-code"}


def test_blanks_in_commands_are_blanks(checkout):
    lesson = checkout.lesson("""
        # %% terminal="a" exercise="00a"
        # cd ws
        # --- answer
        # mkdir -p one/two
        # --- blank
        # # mkdir ____
        # --- end

        # %% check="00a"
        check("00a")
    """)
    assert texts(pages.notebook_page(lesson))[0] == "%%terminal a\ncd ws\nmkdir ____"
    assert texts(pages.solution_draft(lesson))[0] == "%%terminal a\ncd ws\nmkdir -p one/two"


def test_a_module_that_a_cell_saves_is_still_python_to_the_rules(checkout):
    lesson = checkout.lesson('# %% save="src/p/p/node.py"\nthis cell is prose')
    lints = {finding.lint for finding in check_lessons(checkout.course, [lesson], [lesson])}
    assert "syntax" in lints


def test_cells_that_begin_with_one_magic_have_different_ids(checkout):
    lesson = checkout.lesson("""
        # %% terminal="a"
        # ls

        # %% terminal="a"
        # pwd
    """)
    ids = [cell.id for cell in lesson.cells if cell.magic]
    assert len(set(ids)) == 2
    assert not any(one.endswith("-2") for one in ids)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('# %% terminal="a"\nls', "'ls' stands without a comment sign"),
        ('# %% terminal="a" save="b.py"\nx = 1', "do not go together"),
    ],
)
def test_what_cannot_be_meant_is_refused(checkout, body, message):
    with pytest.raises(LessonError, match=message):
        checkout.lesson(body)
