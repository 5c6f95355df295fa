"""What a cell shows before its prediction is made, in a real kernel with what JupyterLab sends."""

from __future__ import annotations

import pytest

from torture.kernel import Kernel

CELL = """
print("first 41")
found = 44
predict("____", found)
"""


@pytest.fixture(scope="module")
def kernel():
    with Kernel() as found:
        assert found.run("from rosbeat import predict").error == ""
        yield found


def run(kernel, source):
    return kernel.run(source, {"cellId": "one"})


def test_an_open_prediction_keeps_back_what_the_cell_prints(kernel):
    assert run(kernel, CELL).text == ""
    assert kernel.run("print(found)").text == "44\n"


ANSWER = """
from rosbeat.exercises.cells import cells_of
(field,) = cells_of().widgets["one"]
for sent in ({"do": "guess", "guess": "<b>"}, {"do": "guess", "guess": "44"}):
    field._hear(sent)
    print(field.passed, field.begun, field.done, field.said)
"""


def test_a_guess_that_cannot_be_compared_may_be_made_again(kernel):
    assert run(kernel, CELL).text == ""
    assert kernel.run(ANSWER).text == (
        "False 1 1 That cannot be compared with what happened: write a number.\n"
        "True 2 2 You predicted 44, and it was 44.\n"
    )


def test_a_front_end_without_cell_ids_gets_everything(kernel):
    assert kernel.run(CELL).text == "first 41\n"


@pytest.mark.parametrize(
    "source",
    [
        CELL.replace("____", "40"),
        CELL + "found",
        CELL.replace('predict("____", found)', 'later = lambda: predict("____", found)'),
        CELL.replace('predict("____", found)', '# predict("____", found)'),
    ],
)
def test_everything_is_shown_where_nothing_is_asked(kernel, source):
    assert run(kernel, source).text == "first 41\n"


def test_everything_is_shown_if_the_cell_raises(kernel):
    reply = run(kernel, CELL.replace("44", "1 / 0"))
    assert (reply.error, reply.text) == ("ZeroDivisionError", "first 41\n")
    assert run(kernel, "print('as ever')").text == "as ever\n"


LOGS = "import logging\nlogging.basicConfig(force=True)\n" + CELL
REDIRECTS = """
from contextlib import redirect_stdout
from io import StringIO
with redirect_stdout(StringIO()):
    predict("____", 44)
"""


def test_what_holds_a_stream_for_longer_writes_to_it_after_the_cell(kernel):
    assert run(kernel, LOGS).text == ""
    assert kernel.run("logging.warning('as ever')").text == "WARNING:root:as ever\n"
    run(kernel, REDIRECTS)
    assert run(kernel, "print('as ever')").text == "as ever\n"
