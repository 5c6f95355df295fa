from itertools import combinations, pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rosbeat.viz.layers import layering
from rosbeat.viz.placement import GAP_LEAST, SPACE, needed, place, spread

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


def plan_of(links):
    return layering(dict.fromkeys(nodes, 0) | dict.fromkeys(topics, 1), links)


def test_wishes_that_agree_are_granted():
    assert spread([0, 50], [10]) == [0, 50]


def test_wishes_that_clash_meet_in_the_middle():
    assert spread([10, 10, 10], [4, 6]) == pytest.approx([10 - 14 / 3, 10 - 2 / 3, 10 + 16 / 3])


@given(st.lists(st.tuples(st.floats(-1e3, 1e3), st.floats(0, 99)), min_size=1, max_size=9))
def test_spread_keeps_distances_and_the_mean(items):
    wishes = [wish for wish, _ in items]
    distances = [gap for _, gap in items[1:]]
    places = spread(wishes, distances)
    for (one, other), gap in zip(pairwise(places), distances, strict=True):
        assert other - one >= gap - 1e-6
    assert sum(places) == pytest.approx(sum(wishes), abs=1e-6)


def overlap(one, other):
    along = (one.length + other.length) / 2 - abs(one.along - other.along)
    across = (one.breadth + other.breadth) / 2 - abs(one.across - other.across)
    return along > 0.01 and across > 0.01


@settings(max_examples=100, deadline=None)
@given(wires)
def test_boxes_never_overlap_and_nothing_leaves_the_picture(links):
    plan = plan_of(links)
    result = place(plan, sizes, 700)
    assert set(result.boxes) == set(sizes)
    assert not any(overlap(one, other) for one, other in combinations(result.boxes.values(), 2))
    points = [p for way in (*result.routes.values(), *result.returns.values()) for p in way]
    for along, across in points:
        assert -0.01 <= along <= result.length + 0.01
        assert -0.01 <= across <= result.breadth + 0.01


@settings(max_examples=100, deadline=None)
@given(wires)
def test_arrows_go_around_boxes(links):
    result = place(plan_of(links), sizes, 700)
    for (source, target), way in result.routes.items():
        for along, across in way[1:-1]:
            for name, box in result.boxes.items():
                if name not in (source, target):
                    near = abs(along - box.along) < box.length / 2
                    assert not (near and abs(across - box.across) < box.breadth / 2)


def test_the_gap_is_kept_when_room_is_short():
    plan = plan_of([("n0", "t0"), ("t0", "n1")])
    result = place(plan, sizes, 0)
    assert result.length == pytest.approx(needed(plan, sizes))
    ends = result.routes["n0", "t0"]
    assert ends[1][0] - ends[0][0] >= GAP_LEAST - 0.01
    assert SPACE > 0
