from hypothesis import given, settings
from hypothesis import strategies as st

from rosbeat.viz.layers import back_links, layering


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


nodes = [f"n{k}" for k in range(6)]
topics = [f"t{k}" for k in range(4)]
wires = st.lists(
    st.tuples(st.sampled_from(nodes), st.sampled_from(topics), st.booleans()).map(
        lambda one: one[:2] if one[2] else one[1::-1]
    ),
    unique=True,
    max_size=20,
)


@settings(max_examples=150, deadline=None)
@given(wires)
def test_forward_links_run_forward_in_any_graph(links):
    starts = dict.fromkeys(nodes, 0) | dict.fromkeys(topics, 1)
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
