"""A beginner's first day in a fresh kernel: each message names the word, and says what to do."""

import pytest

from first_day import CELLS
from torture.kernel import Kernel


@pytest.mark.ros
def test_each_message_names_what_is_wrong_and_what_to_write(tmp_path):
    with Kernel() as kernel:
        place = f"import os\nos.environ['ROSBEAT_WORKSPACE_IN'] = {str(tmp_path)!r}\nimport rosbeat"
        assert kernel.run(place).error == ""
        replies = {cell: kernel.run(cell) for cell in CELLS}
    said = {cell: f"{reply.text}\n{reply.trace}" for cell, reply in replies.items()}
    missing = {
        cell: (words, said[cell])
        for cell, words in CELLS.items()
        if "What to try" not in said[cell] or not all(word in said[cell] for word in words)
    }
    assert missing == {}
    assert len(CELLS) >= 40
