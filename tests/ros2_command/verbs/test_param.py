import re

import pytest
from ros2_command.verbs.param import flat, nested

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
    typed = graph.out("param", "list", "/one", "--param-type", "--filter", ".*ma")
    assert typed == "  limits.max (type: double)\n"
    assert graph.out("param", "list", "/one", "--filter", "ma") == ""  # as `re.match` has it
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
        (("get", "/onn", "rate"), "Node not found\n# Did you mean '/one'?\n"),
        (("get", "/one", "rat"), "Parameter not set\n# Did you mean 'rate'?\n"),
        (("list", "/onn"), "Node not found\n"),
        (("dump", "/onn"), "Node not found\n"),
        (("set", "/one", "rate", "a: b"), "cannot be the value of a parameter"),
    ],
)
def test_what_is_refused(graph, words, said):
    assert said in graph.error("param", *words)


def test_a_refusal_of_the_node_is_an_answer(graph):
    done = graph("param", "set", "/one", "rate", "2.5")
    assert done.stdout == ""
    assert done.stderr.startswith("Setting parameter failed: Wrong parameter type")
    assert "\n# Did you mean 'rate'?\n" in graph("param", "set", "/one", "rat", "2").stderr


LIMIT = """\
Parameter name: limit
  Type: double
  Description: upper limit
  Constraints:
    Min value: 0.0
    Max value: 100.0
    Step: 0.5
    Additional constraints: above low
Parameter name: fixed
  Type: string
  Constraints:
    Read only: true
"""


def test_describe(rich):
    assert rich.out("param", "describe", "house/rich", "limit", "fixed") == LIMIT
    done = rich("param", "describe", "house/rich", "limt", "fixed")
    assert done.stdout == ""  # as the original
    assert done.stderr.endswith("\n# Did you mean 'limit'?\n")


def test_delete(rich):
    assert rich.out("param", "delete", "/house/rich", "spare") == "Deleted parameter successfully\n"
    assert "spare" not in rich.out("param", "list", "/house/rich")
    assert rich("param", "delete", "/house/rich", "count").stderr == (
        "Deleting parameter failed: Static parameter cannot be undeclared\n"
    )
    assert "# Did you mean 'limit'?" in rich("param", "delete", "/house/rich", "limt").stderr


FILE = """\
/**:
  ros__parameters:
    count: 11
    names: [x, '12']
{node}:
  ros__parameters:
    count: 12
    fixed: other
/somebody/else:
  ros__parameters:
    limit: 1.0
"""


@pytest.mark.parametrize("node", ["/house/rich", "house/rich"])
def test_load(rich, tmp_path, node):
    path = tmp_path / "file.yaml"
    path.write_text(FILE.format(node=node))
    done = rich("param", "load", "house/rich", path)
    assert done.stdout == "Set parameter count successful\nSet parameter names successful\n"
    refused = "Set parameter fixed failed: Trying to set a read-only parameter: fixed.\n"
    assert done.stderr == refused
    dump = rich.out("param", "dump", "/house/rich")
    assert "    count: 12\n    fixed: x\n    limit: 30.0\n    names:\n    - x\n    - '12'\n" in dump
    alone = rich.out("param", "load", "/house/rich", path, "--no-use-wildcard")
    assert alone == "Set parameter count successful\n"
    path.write_text(dump)
    assert "Set parameter names successful\n" in rich.out("param", "load", "/house/rich", path)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (None, "No such file or directory"),
        ("", "is not a valid ROS parameter file"),
        ("a: [", "is not valid YAML"),
        ("/other: {ros__parameters: {}}", "Param file does not contain selected parameters"),
        ("/house/rich: 5", "is not a valid ROS parameter file for node /house/rich"),
        ("/**: {ros__parameters: {count: [1, x]}}", "cannot be the value of the parameter 'count'"),
    ],
)
def test_files_that_cannot_be_loaded(rich, tmp_path, text, said):
    path = tmp_path / "file.yaml"
    if text is not None:
        path.write_text(text)
    assert said in rich.error("param", "load", "/house/rich", path)


def test_load_for_no_node(rich, tmp_path):
    assert rich.error("param", "load", "/house/rih", tmp_path / "file") == (
        "Node not found\n# Did you mean '/house/rich'?\n"
    )
    words = "required: node_name, parameter_file"
    assert words in rich.error("param", "load", code=2)


def test_a_node_that_does_not_answer(graph, another_node):
    with another_node(graph, "busy", "temperature", 0):
        error = graph.error("param", "describe", "/busy", "rate")
    assert re.fullmatch(r"The service '/busy/\w+' did not answer in 5 seconds\n", error), error


SILENT = (
    "Wait for service timed out waiting for parameter services for node "
    "NodeName(name='silent', namespace='/', full_name='/silent')\n"
)


def test_one_silent_node_among_many(graph, another_node):
    """One offers no parameters, one never answers: the others have theirs listed all the same."""
    one = "".join(f"  {name}\n" for name in NAMES)
    with another_node(graph, "silent", file="silent_node.py"):
        done = graph("param", "list")
        assert (done.stdout, done.stderr) == (f"/ns_two:\n{one}/one:\n{one}{SILENT}", "")
        error = graph.error("param", "get", "silent", "rate")
        assert error.startswith("Wait for service timed out waiting for parameter services for "
                                "node silent\n# ")  # fmt: skip
        with another_node(graph, "busy", "temperature", 0):
            done = graph("param", "list", "--param-type", code=1)
            assert "/one:\n  limits.max (type: double)\n" in done.stdout
            assert "/busy" not in done.stdout
            assert done.stderr.startswith("Exception while calling service of node '/busy': ")
    with graph.running("topic", "echo", "/temperature") as process:
        assert process.stdout.readline() == "data: 25.5\n"
        out = graph.out("param", "list", "--include-hidden-nodes")
        assert f"/ns_two:\n{one}/one:\n{one}" in out
        assert f"full_name='/_ros2cli_{process.pid}')" in out


def test_dots_in_names_of_parameters():
    assert nested({"a.b": 1, "a.c": 2, "d": 3}) == {"a": {"b": 1, "c": 2}, "d": 3}
    assert nested({"a": 1, "a.b": 2}) == {"a": 1, "a.b": 2}
    assert flat({"a": {"b": 1, "c": {"d": 2}}, "e.f": 3}) == {"a.b": 1, "a.c.d": 2, "e.f": 3}
