"""The steps after a page has run."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from nbformat import v4

from rosbeat.authoring.transforms.failures import quiet_failures, quiet_message
from rosbeat.authoring.transforms.repeatable import refuse_unrepeatable
from rosbeat.authoring.transforms.streams import merge_streams
from rosbeat.authoring.transforms.whitelist import keep_known_metadata
from rosbeat.errors import LessonError


def page(*outputs, **metadata):
    cell = v4.new_code_cell("x", outputs=list(outputs), metadata={"line": 7, **metadata})
    made = v4.new_notebook(cells=[cell])
    made.metadata.rosbeat = {"lesson": "00_hear_it"}
    return made


def stream(text, name="stdout"):
    return v4.new_output("stream", text=text, name=name)


def result(text):
    return v4.new_output("execute_result", {"text/plain": text}, execution_count=1)


CHUNKS = st.lists(
    st.tuples(
        st.text(alphabet="ab\n", min_size=1, max_size=4), st.sampled_from(["stdout", "stderr"])
    )
)


@given(CHUNKS)
def test_chunks_become_one_text_per_stream_whatever_the_pieces(chunks):
    outputs = merge_streams(page(*(stream(*chunk) for chunk in chunks))).cells[0].outputs
    expected = {
        name: "".join(text for text, other in chunks if other == name)
        for name in ("stdout", "stderr")
    }
    assert [(o.name, o.text) for o in outputs] == [(n, t) for n, t in expected.items() if t]


def test_streams_are_not_moved_past_other_outputs():
    merged = merge_streams(page(stream("a"), result("1"), stream("b"), stream("c")))
    outputs = merged.cells[0].outputs
    assert [output.get("text", "result") for output in outputs] == ["a", "result", "bc"]


def test_a_failure_keeps_its_message_and_loses_its_frames():
    error = v4.new_output(
        "error", ename="E", evalue="no \x1b[31mway\x1b[0m\n(123.py, line 1)", traceback=["frame"]
    )
    output = quiet_failures(page(error)).cells[0].outputs[0]
    assert output.evalue == "no way\n(cell, line 1)"
    assert output.traceback == ["E: no way", "(cell, line 1)"]


def test_of_a_printed_traceback_the_learners_own_lines_stay():
    printed = (
        "Traceback (most recent call last):\n"
        '  File "/tmp/ipykernel_12/34.py", line 9, in main\n'
        "    rclpy.shutdown()\n"
        "    ~~~~~~~~~~~~~~^^\n"
        '  File "/x/site-packages/rclpy/__init__.py", line 134, in shutdown\n'
        "    _shutdown(context=context)\n"
        "    ^^^^^^^^^^\n"
        "RCLError: no\n"
    )
    quiet = quiet_failures(page(stream(printed, "stderr"))).cells[0].outputs[0].text
    assert quiet == (
        "Traceback (most recent call last):\n"
        '  File "cell", line 9, in main\n'
        "    rclpy.shutdown()\n"
        "RCLError: no\n"
    )


def test_a_kernels_file_names_are_nobodys_business():
    assert quiet_message('File "/x/ipykernel_12/34.py", line 1') == 'File "cell", line 1'


@pytest.mark.parametrize("text", ["<Node at 0x7f12ab34cd56>", "\x1b[31mred\x1b[0m", "/tmp/x/y"])
def test_an_output_that_cannot_be_repeated_is_refused(text, monkeypatch):
    monkeypatch.setattr("tempfile.gettempdir", lambda: "/tmp")
    for output in (stream(text), result(text)):
        with pytest.raises(LessonError, match=r"00_hear_it\.py:7"):
            refuse_unrepeatable(page(output))
    ignored = page(stream(text), tags=["nbval-ignore-output"])
    assert refuse_unrepeatable(ignored) is ignored


def test_ordinary_outputs_pass():
    good = page(stream("[INFO] [sensor]: 21.5 (0x10)"), result("1"))
    assert refuse_unrepeatable(good) is good


def test_only_known_metadata_is_written():
    made = page(result("1"), tags=["t"], execution={"iopub.status.busy": "now"}, only=None)
    made.metadata.language_info = {"name": "python", "version": "3.11.7"}
    made.metadata.widgets = {}
    kept = keep_known_metadata(made)
    assert kept.cells[0].metadata == {"tags": ["t"]}
    assert kept.metadata == {
        "language_info": {"name": "python"}, "rosbeat": {"lesson": "00_hear_it"}
    }  # fmt: skip
