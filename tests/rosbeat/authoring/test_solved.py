"""The answers that `hint` gives last are derived: from the exercise cells, answers filled in."""

from __future__ import annotations

from rosbeat.authoring import builder
from rosbeat.authoring.solved import answer_files, folder_of

BODY = """
    # %% exercise="00a"
    def f():
        # --- answer
        return 17 + 4
        # --- blank
        # return ____
        # --- end

    # %% check="00a"
    f

    # %% terminal="one" exercise="00b"
    # --- answer
    # cd ../images
    # --- blank
    # # cd ____
    # --- end

    # %% check="00b"
    f
"""


def place(checkout):
    folder_of(checkout.course).parent.mkdir(parents=True)
    return folder_of(checkout.course)


def test_an_answer_is_the_cell_of_the_solution_page(checkout):
    folder = place(checkout)
    assert answer_files(checkout.course, [checkout.lesson(BODY)]) == {
        folder / "00a.txt": b"def f():\n    return 17 + 4\n",
        folder / "00b.txt": b"%%terminal one\ncd ../images\n",
    }


def test_a_course_without_the_package_has_no_place_for_them(checkout):
    assert answer_files(checkout.course, [checkout.lesson(BODY)]) == {}


def test_the_builder_writes_them_checks_them_and_removes_what_is_stale(checkout):
    folder = place(checkout)
    checkout.write(BODY)

    def build(**plan):
        plan = builder.Plan(run=False, **plan)
        found = builder.build(checkout.course, plan, lambda line: None)
        return {change.path.name: change.kind for change in found if change.path.suffix == ".txt"}

    assert build(check=True) == {"00a.txt": "new", "00b.txt": "new"}
    assert not folder.exists()
    assert build() == {"00a.txt": "new", "00b.txt": "new"}
    assert build(check=True) == {}
    (folder / "00a.txt").write_text("something else")
    (folder / "00z.txt").write_text("nobody makes it")
    assert build(check=True) == {"00a.txt": "changed", "00z.txt": "stale"}
    assert build() == {"00a.txt": "changed", "00z.txt": "stale"}
    assert sorted(path.name for path in folder.iterdir()) == ["00a.txt", "00b.txt"]


SEVERAL = """
    # %% exercise="00a"
    def f():
        # --- answer
        return 17 + 4
        # --- blank
        # return ____
        # --- end

    # %% exercise="00a"
    def g():
        # --- answer
        return f() + 21
        # --- blank
        # return ____
        # --- end

    # %% check="00a"
    g
"""


def test_an_exercise_in_several_cells_has_one_answer(checkout):
    place(checkout)
    (text,) = answer_files(checkout.course, [checkout.lesson(SEVERAL)]).values()
    assert text == b"def f():\n    return 17 + 4\n\n\ndef g():\n    return f() + 21\n"
