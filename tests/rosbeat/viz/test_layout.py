"""Columns, order and places of a graph, and text and ticks, as properties of any."""

from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rosbeat.viz.canvas import TimeScale, blank, text_width, wrap
from rosbeat.viz.layout import (
    GAP_LEAST,
    back_links,
    layering,
    needed,
    place,
)

nodes = [f"n{k}" for k in range(6)]

topics = [f"t{k}" for k in range(4)]

wires = st.lists(
    st.tuples(st.sampled_from(nodes), st.sampled_from(topics), st.booleans()).map(
        lambda one: one[:2] if one[2] else one[1::-1]
    ),
    unique=True,
    max_size=20,
)

sizes = {name: (60.0 + 9 * k, 30.0 + 4 * k) for k, name in enumerate(nodes + topics)}

starts = dict.fromkeys(nodes, 0) | dict.fromkeys(topics, 1)


def columns(plan):
    return {name: rank for rank, layer in enumerate(plan.layers) for name in layer}


def links_of(words):
    return [tuple(link.split(">")) for link in words.split()]


@pytest.mark.parametrize(
    ("links", "layers", "back"),
    [
        ("", [], ""),
        ("a>T T>b", [["a"], ["T"], ["b"]], ""),
        ("T>b", [["T"], ["b"]], ""),
        ("a>T T>a", [["a"], ["T"]], "T>a"),
        ("a>T T>b b>U U>a", None, "U>a"),
        ("a>T b>U U>c T>d", None, ""),
    ],
)
def test_columns_of_small_graphs(links, layers, back):
    names = sorted({name for link in links_of(links) for name in link}, key=str.swapcase)
    plan = layering({name: int(name.isupper()) for name in names}, links_of(links))
    assert layers is None or plan.layers == layers
    assert plan.back == tuple(links_of(back))
    # Crossings are undone: each row follows one chain.
    if links.startswith("a>T b>U"):
        assert [layer[0] for layer in plan.layers] in (["a", "T", "d"], ["b", "U", "c"])


def test_a_source_stands_right_beside_what_it_feeds_and_a_long_link_gets_stand_ins():
    begin = {"a": 0, "b": 0, "late": 0, "c": 0, "T": 1, "U": 1}
    plan = layering(begin, links_of("a>T T>b b>U late>U U>c T>c"))
    assert columns(plan)["late"] == columns(plan)["b"]
    assert len(plan.chains["T", "c"]) == 4


@settings(max_examples=60, deadline=None)
@given(wires)
def test_forward_links_run_forward_in_any_graph(links):
    plan = layering(starts, links)
    at = columns(plan)
    assert sorted(name for layer in plan.layers for name in layer if name in starts) == sorted(
        starts
    )
    assert set(plan.chains) | set(plan.back) == set(links)
    for chain in plan.chains.values():
        assert [at[name] for name in chain] == list(range(at[chain[0]], at[chain[-1]] + 1))
    assert back_links(list(starts), list(plan.chains)) == []
    assert layering(starts, links) == plan


def apart(one, other):
    along = abs(one.along - other.along) - (one.length + other.length) / 2
    across = abs(one.across - other.across) - (one.breadth + other.breadth) / 2
    return max(along, across)


@settings(max_examples=60, deadline=None)
@given(wires)
def test_boxes_never_overlap_and_arrows_go_around_them_inside_the_picture(links):
    result = place(layering(starts, links), sizes, 700)
    assert set(result.boxes) == set(sizes)
    assert all(apart(*pair) > -0.01 for pair in combinations(result.boxes.values(), 2))
    points = [p for way in (*result.routes.values(), *result.returns.values()) for p in way]
    for along, across in points:
        assert -0.01 <= along <= result.length + 0.01
        assert -0.01 <= across <= result.breadth + 0.01
    for ends, way in result.routes.items():
        source, target = (result.boxes[one] for one in ends)
        assert way[0] == (source.along + source.length / 2, source.across)
        assert way[-1] == (target.along - target.length / 2, target.across)
        for along, across in way[1:-1]:
            for name, box in result.boxes.items():
                near = abs(along - box.along) < box.length / 2
                hit = near and abs(across - box.across) < box.breadth / 2
                assert name in ends or not hit


def test_the_gap_is_kept_when_room_is_short():
    plan = layering(starts, [("n0", "t0"), ("t0", "n1")])
    result = place(plan, sizes, 0)
    assert result.length == pytest.approx(needed(plan, sizes))
    ends = result.routes["n0", "t0"]
    assert ends[1][0] - ends[0][0] >= GAP_LEAST - 0.01


# Text and ticks.


@pytest.mark.parametrize("words", ["/temperature_sensor", "$x_1$ costs $"])
@pytest.mark.parametrize("weight", ["normal", "bold"])
def test_text_is_as_wide_as_it_was_said_to_be(words, weight):
    with blank(50) as canvas:
        drawn = canvas.text(10, 25, words, weight=weight).get_window_extent()
    assert text_width(words, weight) == pytest.approx(drawn.width, abs=3)
    assert text_width("  ") == 0


@pytest.mark.parametrize(
    ("name", "rows"),
    [
        ("/short", ("/short",)),
        ("/temperature_sensor", ("/temperature_", "sensor")),
        ("/building_site/floor", ("/building_site/", "floor")),
        ("x" * 60, None),  # without joints it breaks anywhere
    ],
)
def test_names_break_after_their_joints(name, rows):
    found = wrap(name, 110)
    assert rows in (None, found)
    assert "".join(found) == name
    assert all(text_width(row) <= 110 for row in found)


@pytest.mark.parametrize("last", [0.001, 1, 7, 60, 12345])
def test_ticks_are_inside_and_few(last):
    scale = TimeScale(last, 150, 700)
    assert [scale(at) for at in (0, last / 2, last)] == pytest.approx([150, 425, 700])
    ticks = scale.ticks()
    assert 2 <= len(ticks) <= 11
    assert ticks[0] == 0
    assert ticks[-1] <= last * 1.0001


def test_one_instant_stands_in_the_middle():
    scale = TimeScale(0, 100, 600)
    assert (scale(0), scale.ticks()) == (350, [0])
