import json

import pytest

from rosbeat.authoring.opened import only_opened

CELL = {"cell_type": "code", "id": "a1", "source": ["x = ____"], "metadata": {}, "outputs": []}
PAGE = {"cells": [{**CELL, "execution_count": None}], "metadata": {"language_info": {"name": "p"}}}


def as_bytes(page):
    return json.dumps(page).encode()


def changed(**cell):
    return as_bytes({**PAGE, "cells": [{**PAGE["cells"][0], **cell}]})


def test_what_opening_running_and_saving_adds_is_no_difference():
    info = {"language_info": {"name": "p", "version": "3.11.2"}}
    assert only_opened(as_bytes({**PAGE, "metadata": info}), as_bytes(PAGE))
    run = changed(execution_count=3, outputs=[{"text": "1"}], metadata={"scrolled": True})
    assert only_opened(run, as_bytes(PAGE))
    assert only_opened(changed(source="x = ____"), as_bytes(PAGE))


@pytest.mark.parametrize(
    "difference",
    [{"source": ["x = 1"]}, {"id": "b2"}, {"cell_type": "markdown"}, {"metadata": {"tags": ["t"]}}],
)
def test_what_somebody_wrote_is_a_difference(difference):
    assert not only_opened(changed(**difference), as_bytes(PAGE))


def test_a_page_that_should_have_outputs_is_not_judged_here():
    page = changed(outputs=[{"text": "1"}])
    assert not only_opened(page, page)


@pytest.mark.parametrize("broken", [b"", b"half", b"[]", b'{"cells": 3}'])
def test_what_is_no_notebook_is_a_difference(broken):
    assert not only_opened(broken, as_bytes(PAGE))
