"""Printed text in one piece, whatever pieces it arrived in."""

from __future__ import annotations

from typing import Any

from nbformat import NotebookNode

_ORDER = ("stdout", "stderr")


def merge_streams(page: NotebookNode) -> NotebookNode:
    """Join the chunks of a stream between two other outputs, stdout before stderr.

    A kernel sends what is printed whenever a timer says so; where the pieces are cut, and how the
    two streams interleave, is chance and must not show in a page.
    """
    for cell in page.cells:
        if cell.cell_type == "code":
            cell.outputs = _merged(cell.outputs)
    return page


def _merged(outputs: list[Any]) -> list[Any]:
    done: list[Any] = []
    run: list[Any] = []
    for output in outputs:
        if output.output_type == "stream":
            run.append(output)
            continue
        done += [*_joined(run), output]
        run = []
    return done + _joined(run)


def _joined(run: list[Any]) -> list[Any]:
    for stream in run:
        stream.text = "".join(other.text for other in run if other.name == stream.name)
    first = {stream.name: stream for stream in reversed(run)}
    return [first[name] for name in _ORDER if name in first]
