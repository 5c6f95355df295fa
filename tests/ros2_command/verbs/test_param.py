import pytest

pytestmark = pytest.mark.ros

NAMES = ["limits.max", "rate", "start_type_description_service", "use_sim_time"]
DUMP = """\
/ns_two:
  ros__parameters:
    limits:
      max: 30.0
    rate: 3
    start_type_description_service: true
    use_sim_time: false

"""


def test_list(graph):
    one = "".join(f"  {name}\n" for name in NAMES)
    assert graph.out("param", "list", "ns_two") == one
    assert graph.out("param", "list") == f"/ns_two:\n{one}/one:\n{one}"
    typed = graph.out("param", "list", "/one", "--param-type", "--filter", "ma")
    assert typed == "  limits.max (type: double)\n"
    assert "is not a pattern" in graph.error("param", "list", "--filter", "(")


def test_get_set_and_dump(graph):
    assert graph.out("param", "get", "ns_two", "rate") == "Integer value is: 3\n"
    assert graph.out("param", "get", "/ns_two", "limits.max", "--hide-type") == "30.0\n"
    assert graph.out("param", "set", "one", "rate", "5") == "Set parameter successful\n"
    assert graph.out("param", "get", "one", "rate", "--hide-type") == "5\n"
    assert graph.out("param", "dump", "ns_two") == DUMP


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("get", "/onn", "rate"), "Node not found\nDid you mean '/one'?\n"),
        (("get", "/one", "rat"), "Parameter not set\nDid you mean 'rate'?\n"),
        (("list", "/onn"), "Node not found\n"),
        (("dump", "/onn"), "Node not found\n"),
        (("set", "/one", "rate", "2.5"), "Setting parameter failed: Wrong parameter type"),
        (("set", "/one", "rat", "2"), "Did you mean 'rate'?"),
        (("set", "/one", "rate", "a: b"), "cannot be the value of a parameter"),
    ],
)
def test_what_is_refused(graph, words, said):
    assert said in graph.error("param", *words)
