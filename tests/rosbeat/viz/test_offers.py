from rosbeat.records import Endpoint, GraphSnapshot, QoS
from rosbeat.viz.offers import Offer, offers_of, say_offers

_TRIGGER = "std_srvs/srv/Trigger"


def _end(node, name, kind, type_name=_TRIGGER):
    return Endpoint(node, name, type_name, kind, QoS())


def _offers(*ends, nodes=("/a", "/b")):
    return offers_of(GraphSnapshot(nodes, ends), nodes)


def test_a_service_with_both_sides():
    (one,) = _offers(_end("/a", "/ask", "server"), _end("/b", "/ask", "client"))
    assert one == Offer("service", "/ask", _TRIGGER, ("/a",), ("/b",))
    assert one.kind == "service Trigger"
    assert one.nodes == ("/a", "/b")


def test_an_action_hides_its_parts():
    kind = "test_msgs/action/Fibonacci"
    found = _offers(
        _end("/a", "/heat", "action server", kind),
        _end("/a", "/heat/_action/send_goal", "server", f"{kind}_SendGoal"),
    )
    assert [(one.key, one.kind) for one in found] == [("action /heat", "action Fibonacci")]


def test_what_every_node_brings_is_left_out_and_what_asks_for_it_is_not():
    kind = "rcl_interfaces/srv/GetParameters"
    assert _offers(_end("/a", "/a/get_parameters", "server", kind)) == ()
    assert _offers(_end("/a", "/get_parameters", "server", kind))


def test_nodes_that_are_not_shown_offer_nothing():
    assert offers_of(GraphSnapshot(("/_a",), (_end("/_a", "/ask", "server"),)), ()) == ()


def test_words():
    said = say_offers([Offer("action", "/heat", "t/action/Heat", ("/a",)),
                       Offer("service", "/ask", _TRIGGER, (), ("/b",))])  # fmt: skip
    assert said == [
        "/heat (Heat) is an action: offered by /a, used by nobody.",
        "/ask (Trigger) is a service: offered by nobody, used by /b.",
    ]
