"""Ways in which learners arrange right answers on a page; each has to get the same verdict."""

import copy
import json
import textwrap
from functools import cache

from bank.pages import ROOT
from rosbeat.page_runs.notebook import CoursePage, course_pages


@cache
def course() -> dict[str, CoursePage]:
    """The course's pages by number."""
    return {page.number: page for page in course_pages(ROOT / "notebooks")}


def released(number):
    """The page as learners get it."""
    path = ROOT / "notebooks" / f"{course()[number].lesson}.ipynb"
    return json.loads(path.read_text(encoding="utf-8"))


@cache
def right_answers(number):
    """The texts of the published answers by the id of their cell."""
    path = ROOT / "solutions" / f"{course()[number].lesson}.ipynb"
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return {cell["id"]: _text(cell) for cell in cells if _role(cell, "exercise")}


def _text(cell):
    return "".join(cell["source"])


def _role(cell, role):
    return cell["metadata"].get("rosbeat", {}).get(role, "")


def _code(source, **metadata):
    return {"cell_type": "code", "source": source, "metadata": metadata, "outputs": [],
            "execution_count": None}  # fmt: skip


def _is_python(text):
    return not text.startswith("%%")


def _each_answer(number, arrange):
    """A page on which each cell that waits for an answer has become some cells.

    Args:
        number: The page.
        arrange: Gets the cell with its blank and the answer; returns the cells in its place.
    """
    page, answers = released(number), right_answers(number)
    cells = []
    for cell in page["cells"]:
        answer = answers.get(cell["id"])
        cells += [cell] if answer is None else arrange(cell, answer)
    page["cells"] = cells
    return page


def _filled(cell, answer):
    return {**copy.deepcopy(cell), "source": answer}


def as_asked(number):
    return _each_answer(number, lambda cell, answer: [_filled(cell, answer)])


def in_a_new_cell_below(number):
    return _each_answer(number, lambda cell, answer: [cell, _code(answer)])


def a_wrong_try_above(number):
    def arrange(cell, answer):
        wrong = "1 / 0" if _is_python(answer) else _text(cell)
        return [{**cell, "source": wrong}, _code(answer)]

    return _each_answer(number, arrange)


def a_copy_of_an_old_try_at_the_bottom(number):
    page = as_asked(number)
    blank = [cell for cell in released(number)["cells"] if _role(cell, "exercise")]
    page["cells"] += [cell for cell in blank if _is_python(_text(cell))]
    return page


def a_split_cell(number):
    def arrange(cell, answer):
        rest = "# That was it." if _is_python(answer) else answer.split("\n")[0] + "\npwd"
        return [_filled(cell, answer), {**_filled(cell, rest), "id": f"{cell['id']}-b"}]

    def arrange_files(cell, answer):
        return [_filled(cell, answer)] if answer.startswith("%%save") else arrange(cell, answer)

    return _each_answer(number, arrange_files)


def a_cell_between_answer_and_check(number):
    page, between = as_asked(number), []
    for cell in page["cells"]:
        if _role(cell, "check"):
            subject = _text(cell).rpartition(",")[2].strip(" )\n")
            between += [_code(f"{subject}\nprint({subject})")]
        between.append(cell)
    page["cells"] = between
    return page


def what_it_needs_above(number):
    def arrange(cell, answer):
        if not _is_python(answer):
            return [_filled(cell, answer)]
        above = (
            "settings = {}\ntry:\n    import json as tool\nexcept ImportError:\n    tool = None\n"
            "if tool:\n    settings['depth'] = 10\nfor n in range(3):\n    settings.update(last=n)"
        )
        needs = f"assert settings == {{'depth': 10, 'last': 2}} and tool\n\n{answer}"
        return [_code(above), _filled(cell, needs)]

    return _each_answer(number, arrange)


def another_name(number):
    """Each class has a name of the learner's own, and the check asks for that."""

    def arrange(cell, answer):
        name = _checked_name(number, _role(cell, "exercise"))
        defined = name and (f"class {name}(" in answer or f"def {name}(" in answer)
        # On page 13, one answer needs another one by its name.
        gone = "" if number == "13" else f"\ndel {name}"
        return [_filled(cell, f"{answer}\n\n\nMy{name} = {name}{gone}" if defined else answer)]

    page = _each_answer(number, arrange)
    for cell in page["cells"]:
        exercise = _role(cell, "check")
        name = _checked_name(number, exercise) if exercise else ""
        if any(f"\nMy{name} = {name}" in _text(other) for other in page["cells"] if name):
            cell["source"] = f'check("{exercise}", My{name})'
    return page


def _checked_name(number, exercise):
    cell = next((cell for cell in course()[number].cells if cell.check == exercise), None)
    subject = cell.source.rpartition(",")[2].strip(" )\n") if cell else ""
    return subject if subject.isidentifier() and number != "10" else ""


def without_metadata(number):
    page = as_asked(number)
    for number_of, cell in enumerate(page["cells"]):
        cell["metadata"], cell["id"] = {}, f"cell-{number_of}"
    page["metadata"] = {"kernelspec": page["metadata"]["kernelspec"]}
    return page


def without_checks(number):
    page = as_asked(number)
    page["cells"] = [cell for cell in page["cells"] if not _role(cell, "check")]
    return page


def a_second_check(number):
    """The answer stands below the blank and its check, and is checked once more."""
    page, answers, later, cells = released(number), right_answers(number), [], []
    for cell in page["cells"]:
        cells.append(cell)
        if cell["id"] in answers:
            later.append(_code(answers[cell["id"]]))
        if _role(cell, "check"):
            cells += [*later, _code(_text(cell))]
            later = []
    page["cells"] = cells
    return page


def cells_merged(number):
    """All answers of the page stand in the first of its cells, if they are Python."""
    page, answers = released(number), right_answers(number)
    texts = [text for text in answers.values() if _is_python(text)]
    is_first = True
    for cell in page["cells"]:
        text = answers.get(cell["id"])
        if text is not None and _is_python(text):
            cell["source"] = "\n\n\n".join(texts) if is_first else "# see above"
            is_first = False
        elif text is not None:
            cell["source"] = text
    return page


def with_magics(number):
    def arrange(cell, answer):
        if not _is_python(answer):
            return [_filled(cell, answer)]
        return [_filled(cell, f"!ls\n%time total = sum(range(10))\n{answer}"), _code("?print")]

    return _each_answer(number, arrange)


def notes_and_scratch_cells(number):
    def arrange(cell, answer):
        note = {"cell_type": "markdown", "source": "My notes", "metadata": {}}
        raw = {"cell_type": "raw", "source": "raw", "metadata": {}}
        return [note, _code("undefined_name"), _code("class ("), _filled(cell, answer), raw]

    return _each_answer(number, arrange)


def pasted_twice(number):
    return _each_answer(number, lambda cell, answer: [_filled(cell, answer), _code(answer)])


def in_a_block(number):
    """All that an answer defines stands in blocks, as people write who try something out."""

    def arrange(cell, answer):
        if not _is_python(answer):
            return [_filled(cell, answer)]
        block = textwrap.indent(answer, "    ", lambda line: bool(line.strip()))
        return [_filled(cell, f"try:\n{block}\nfinally:\n    print('defined')")]

    return _each_answer(number, arrange)


def methods_added_in_the_next_cell(number):
    """Each class gets its last method later, as page 12 itself does it."""

    def arrange(cell, answer):
        name = _checked_name(number, _role(cell, "exercise"))
        head, mark, method = answer.rpartition("\n    def ")
        title = method.partition("(")[0]
        rest = ("\nclass ", "\n    async def ", "super()")
        is_whole = mark and f"class {name}(" in head and not any(text in method for text in rest)
        if not is_whole or title == "__init__" or "\n    @" in head[-30:]:
            return [_filled(cell, answer)]
        inner, _, outer = method.partition("\n\n\n")
        function = textwrap.dedent(f"    def {inner}")
        below = f"{function}\n\n{name}.{title} = {title}\n\n{outer}"
        return [_filled(cell, head), _code(below)]

    return _each_answer(number, arrange)


def windows_line_endings(number):
    # Commands of a terminal go through IPython as they are typed.
    def arrange(cell, answer):
        return [_filled(cell, answer.replace("\n", "\r\n") if _is_python(answer) else answer)]

    return _each_answer(number, arrange)


def tags_and_comments(number):
    def arrange(cell, answer):
        tagged = _filled(cell, f"{answer}\n# ____ done" if _is_python(answer) else answer)
        tagged["metadata"] |= {"tags": ["mine"], "collapsed": True, "editable": True}
        return [tagged]

    return _each_answer(number, arrange)


ARRANGEMENTS = {
    arrangement.__name__.replace("_", " "): arrangement
    for arrangement in (
        as_asked, in_a_new_cell_below, a_wrong_try_above, a_copy_of_an_old_try_at_the_bottom,
        a_split_cell, a_cell_between_answer_and_check, what_it_needs_above, another_name,
        without_metadata, without_checks, a_second_check, cells_merged, with_magics,
        notes_and_scratch_cells, pasted_twice, in_a_block, methods_added_in_the_next_cell,
        windows_line_endings, tags_and_comments,
    )
}  # fmt: skip
#: What nbgrader gives other points for: it finds cells by what it has written into their metadata,
#: and puts its own checks back. See docs/nbgrader.md.
NOT_IN_NBGRADER = {
    "a copy of an old try at the bottom", "a split cell", "without metadata", "another name",
    "a second check",
}  # fmt: skip
#: Pages whose three answers have one name, so that one cell cannot hold them all.
ONE_NAME = {"10"}
