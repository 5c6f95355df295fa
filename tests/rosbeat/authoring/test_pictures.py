from __future__ import annotations

import pytest

from rosbeat.authoring.pictures import without_pictures


@pytest.mark.parametrize(
    "page",
    [
        b'{"image/png": "%s", "text/plain": "a node"}',
        b'{"text/html": ["<img alt=\\"a node\\"\\n", "src=\\"data:image/png;base64,%s\\">"]}',
    ],
)
def test_payloads_go_and_words_stay(page):
    one, other = without_pictures(page % b"iVBOR/+=="), without_pictures(page % b"AAAA")
    assert one == other
    assert b"a node" in one
    assert without_pictures((page % b"AAAA").replace(b"a node", b"two")) != one


def test_a_picture_that_vanished_is_a_difference():
    assert without_pictures(b'{"image/png": "AAAA"}') != without_pictures(b"{}")
