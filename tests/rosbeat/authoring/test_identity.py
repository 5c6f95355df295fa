from __future__ import annotations

import re

from hypothesis import given
from hypothesis import strategies as st

from rosbeat.authoring.identity import cell_ids

CELLS = st.lists(
    st.tuples(
        st.sampled_from(["code", "markdown"]),
        st.text(max_size=5),
        st.sampled_from([None, "00a"]),
        st.none(),
    )
)


@given(CELLS)
def test_ids_are_unique_valid_and_repeatable(cells):
    ids = cell_ids(cells)
    assert len(set(ids)) == len(cells)
    assert ids == cell_ids(cells)
    assert all(re.fullmatch(r"[a-zA-Z0-9-_]{1,64}", cell_id) for cell_id in ids)


def test_a_sentence_further_down_does_not_change_the_id():
    before = cell_ids([("markdown", "Opening.\nOne.", None, None)])
    assert before == cell_ids([("markdown", "Opening.\nTwo.", None, None)])
    assert before != cell_ids([("markdown", "Another.\nOne.", None, None)])


def test_a_new_cell_leaves_the_ids_of_others_alone():
    first, last = ("code", "a = 1", None, None), ("code", "b = 2", None, None)
    before = cell_ids([first, last])
    after = cell_ids([first, ("code", "c = 3", None, None), last])
    assert [after[0], after[2]] == before
