"""The tree in the docstring is the real one, and every error speaks in three parts."""

import inspect
import re

import pytest

from rosbeat import errors


def drawn(docstring):
    """From every error in the tree to its parent, read from the drawing."""
    parents, branch = {}, []
    for line in docstring.splitlines():
        if name := re.match(r"^    ([│├└─ ]*)([A-Z]\w+Error) ", line):
            depth = len(name[1]) // 4
            branch = [*branch[:depth], name[2]]
            parents[name[2]] = branch[-2] if depth else "Exception"
    return parents


def real():
    """From every error in the module to its parent."""
    return {kind.__name__: kind.__mro__[1].__name__ for kind in every_error()}


def every_error():
    return [kind for kind in vars(errors).values()
            if inspect.isclass(kind) and issubclass(kind, errors.RosbeatError)]  # fmt: skip


def test_the_tree_in_the_docstring_is_the_real_tree():
    assert drawn(errors.__doc__) == real()


@pytest.mark.parametrize("kind", every_error())
def test_an_error_has_three_parts(kind):
    said = str(kind("The sky fell.", "No sky is left.", "Look up."))
    assert said == "The sky fell.\n  What it means: No sky is left.\n  What to try:   Look up."
    assert kind.__doc__


def test_parts_that_are_missing_leave_no_empty_line():
    assert str(errors.RosbeatError("Only this.")) == "Only this."


def test_a_page_shows_the_parts_instead_of_a_stack():
    shown = errors.PictureError("What.", "Means.", "Try.")._render_traceback_()
    assert shown[0] == "PictureError: What."
    assert len(shown) == 3
