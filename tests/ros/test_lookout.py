"""The hidden node: what it sees and that it is not seen."""

from contextlib import ExitStack
from functools import partial

from nodes import Listener, Talker
from rosbeat import Session
from rosbeat.domains import lease_domain
from rosbeat.ros.graph import owner


def test_it_tells_own_endpoints_from_those_of_another_session(eventually):
    lease = lease_domain()
    with Session(domain_id=lease.domain_id) as one, Session(domain_id=lease.domain_id) as two:
        one.add(Talker)
        two.add(Talker)
        look = one._world.lookout
        eventually(lambda: len(look.publishers("/count")) == 2, 30)
        assert sorted(map(look.is_outside, look.publishers("/count"))) == [False, True]
        eventually(lambda: {owner(end) for end in look.publishers("/count")} == {"/talker"}, 30)
    lease.release()


def test_it_belongs_to_nobody_and_has_nothing_to_say():
    lease = lease_domain()
    with Session(domain_id=lease.domain_id) as ros:
        look = ros._world.lookout
        assert ros.nodes == ()
        assert ros.graph().nodes == ros.graph().endpoints == ()
        assert look.get_name().startswith("_")
        assert look.get_service_names_and_types() == []
        assert not any(look.publishers("/rosout"))
        assert look.nodes() == [f"/{look.get_name()}"]
        ros.add(Listener)
        ros.run(1)
        assert {call.node for call in ros.observation().callbacks} == set()
    lease.release()


def test_a_private_session_has_none(ros):
    assert ros._world.lookout is None
    ros.add(Listener)
    ros.run(0)
    assert ros._world.arrivals is None


def test_a_node_that_is_listed_after_it_has_left_does_not_count(eventually, monkeypatch):
    lease = lease_domain()
    with Session(domain_id=lease.domain_id) as one, Session(domain_id=lease.domain_id) as two:
        two.add(Talker)
        look = one._world.lookout
        eventually(lambda: look.nodes().count("/talker") == 1, 30)
        # As the middleware does it now and then on a busy machine.
        listed = [*look.get_node_names_and_namespaces(), ("ghost", "/"), ("talker", "/")]
        monkeypatch.setattr(look, "get_node_names_and_namespaces", lambda: listed)
        assert look.nodes().count("/talker") == 1
        assert "/ghost" not in look.nodes()
        assert one.graph().nodes == ("/talker",)
    lease.release()


def test_nodes_of_one_name_count_each(eventually):
    lease = lease_domain()
    with ExitStack() as stack:
        join = partial(Session, domain_id=lease.domain_id)
        one, two, three = (stack.enter_context(join()) for _ in range(3))
        for session in two, three:
            session.add(Talker)
        eventually(lambda: one.graph().nodes == ("/talker", "/talker"), 30)
    lease.release()
