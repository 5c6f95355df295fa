"""Columns, order, places and frames, as examples and as properties of any graph."""

from dataclasses import replace
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rosbeat.viz.layout import (
    GAP_LEAST,
    Rim,
    back_links,
    clustered,
    enclosed,
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
homes = st.lists(st.integers(0, 3), min_size=len(nodes), max_size=len(nodes))
sizes = {name: (60.0 + 9 * k, 30.0 + 4 * k) for k, name in enumerate(nodes + topics)}
starts = dict.fromkeys(nodes, 0) | dict.fromkeys(topics, 1)


def columns(plan):
    return {name: rank for rank, layer in enumerate(plan.layers) for name in layer}


def test_a_chain_takes_one_column_each():
    plan = layering({"a": 0, "t": 1, "b": 0}, [("a", "t"), ("t", "b")])
    assert plan.layers == [["a"], ["t"], ["b"]]


def test_a_source_stands_right_beside_what_it_feeds():
    links = [("a", "t"), ("t", "b"), ("b", "u"), ("late", "u"), ("u", "c")]
    plan = layering({"a": 0, "b": 0, "late": 0, "c": 0, "t": 1, "u": 1}, links)
    assert columns(plan)["late"] == columns(plan)["b"]


def test_an_empty_first_column_is_closed():
    plan = layering({"b": 0, "t": 1}, [("t", "b")])
    assert plan.layers == [["t"], ["b"]]


def test_a_long_link_gets_stand_ins():
    links = [("a", "t"), ("t", "b"), ("b", "u"), ("u", "c"), ("t", "c")]
    plan = layering({"a": 0, "b": 0, "c": 0, "t": 1, "u": 1}, links)
    assert len(plan.chains["t", "c"]) == 4


def test_a_cycle_gives_one_link_back():
    links = [("a", "t"), ("t", "b"), ("b", "u"), ("u", "a")]
    plan = layering({"a": 0, "b": 0, "t": 1, "u": 1}, links)
    assert plan.back == (("u", "a"),)


def test_a_node_that_hears_itself():
    assert layering({"a": 0, "t": 1}, [("a", "t"), ("t", "a")]).back == (("t", "a"),)


def test_crossings_are_undone():
    links = [("a", "t"), ("b", "u"), ("u", "c"), ("t", "d")]
    plan = layering({"a": 0, "b": 0, "c": 0, "d": 0, "t": 1, "u": 1}, links)
    firsts = [layer[0] for layer in plan.layers]
    assert firsts in (["a", "t", "d"], ["b", "u", "c"])


def test_nothing_at_all():
    assert layering({}, []).layers == []


@settings(max_examples=150, deadline=None)
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


@settings(max_examples=100, deadline=None)
@given(wires)
def test_boxes_never_overlap_and_nothing_leaves_the_picture(links):
    plan = layering(starts, links)
    result = place(plan, sizes, 700)
    assert set(result.boxes) == set(sizes)
    assert all(apart(*pair) > -0.01 for pair in combinations(result.boxes.values(), 2))
    points = [p for way in (*result.routes.values(), *result.returns.values()) for p in way]
    for along, across in points:
        assert -0.01 <= along <= result.length + 0.01
        assert -0.01 <= across <= result.breadth + 0.01


@settings(max_examples=100, deadline=None)
@given(wires)
def test_arrows_go_around_boxes(links):
    result = place(layering(starts, links), sizes, 700)
    for (source, target), way in result.routes.items():
        for along, across in way[1:-1]:
            for name, box in result.boxes.items():
                if name not in (source, target):
                    near = abs(along - box.along) < box.length / 2
                    assert not (near and abs(across - box.across) < box.breadth / 2)


def test_the_gap_is_kept_when_room_is_short():
    plan = layering(starts, [("n0", "t0"), ("t0", "n1")])
    result = place(plan, sizes, 0)
    assert result.length == pytest.approx(needed(plan, sizes))
    ends = result.routes["n0", "t0"]
    assert ends[1][0] - ends[0][0] >= GAP_LEAST - 0.01


def depth(frame, box):
    along = frame.length / 2 - abs(frame.along - box.along) - box.length / 2
    return min(along, frame.breadth / 2 - abs(frame.across - box.across) - box.breadth / 2)


@settings(max_examples=60, deadline=None)
@given(wires, homes)
def test_frames_hold_their_boxes_and_no_others_in_any_graph(links, home):
    groups = [[n for n, h in zip(nodes, home, strict=True) if h == k] for k in range(3)]
    groups = [group for group in groups if len(group) > 1]
    plan = layering(starts, links)
    members = enclosed(groups, links, topics)
    plan = replace(clustered(plan, members), rim=Rim((12.0, 16.0), (12.0, 10.0), (110.0, 90.0)))
    result = place(plan, sizes, 700)
    assert set(result.boxes) == set(sizes)
    assert len(result.frames) == len(groups)
    assert result.length <= max(700, needed(plan, sizes)) + 1e-6
    assert all(apart(*pair) > -0.01 for pair in combinations(result.boxes.values(), 2))
    assert all(apart(*pair) > -0.01 for pair in combinations(result.frames, 2))
    for frame, block in zip(result.frames, plan.clusters, strict=True):
        assert set(block) & set(sizes) in members
        for name, box in result.boxes.items():
            assert (depth(frame, box) if name in block else apart(frame, box)) > 9.9
        assert frame.across - frame.breadth / 2 >= -0.01
        assert frame.across + frame.breadth / 2 <= result.breadth + 0.01


def test_what_a_note_leads_to_goes_with_it():
    links = [("a", "note"), ("note", "t"), ("t", "b"), ("c", "u"), ("u", "b")]
    assert enclosed([["a", "b"]], links, ["note", "t", "u"]) == [{"a", "b", "note", "t"}]


def test_a_topic_that_only_one_node_uses_stays_outside():
    assert enclosed([["a", "b"]], [("a", "t")], ["t"]) == [{"a", "b"}]
