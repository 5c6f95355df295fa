import re

import pytest
from as_typed import interrupted

pytestmark = pytest.mark.ros

CALL = """\
requester: making request: std_srvs.srv.SetBool_Request(data=True)

response:
std_srvs.srv.SetBool_Response(success=True, message='on')

"""


def test_list_and_type(graph):
    lines = graph.out("service", "list").splitlines()
    assert len(lines) == 16
    assert "/one/enable" in lines
    assert lines == sorted(lines)
    assert graph.out("service", "list", "-c") == "16\n"
    assert "/one/enable [std_srvs/srv/SetBool]\n" in graph.out("service", "list", "-t")
    assert graph.out("service", "type", "/one/enable") == "std_srvs/srv/SetBool\n"
    said = "# Unknown service '/one/enabl'\n# Did you mean '/one/enable'?\n"
    assert graph.error("service", "type", "/one/enabl") == said


def test_find_and_info(graph, rich):
    assert graph.out("service", "find", "std_srvs/srv/SetBool") == "/ns_two/enable\n/one/enable\n"
    assert graph.out("service", "find", "-c", "std_srvs/srv/SetBool") == "2\n"
    assert graph.out("service", "find", "no_type") == ""
    assert graph.out("service", "info", "/one/enable") == (
        "Type: std_srvs/srv/SetBool\nClients count: 0\nServices count: 1\n"
    )
    said = "Unknown service '/one/enabl'\n# Did you mean '/one/enable'?\n"
    assert graph.error("service", "info", "/one/enabl") == said
    hidden = ("test_msgs/action/Fibonacci_SendGoal",)
    assert rich.out("service", "find", *hidden) == ""
    found = rich.out("service", "find", "--include-hidden-services", *hidden)
    assert found == "/house/fibonacci/_action/send_goal\n"
    before_the_verb = rich.out("service", "--include-hidden-services", "list")
    assert "/house/fibonacci/_action/send_goal\n" in before_the_verb


ECHOED = """\
info:
  event_type: REQUEST_RECEIVED
  stamp:
    sec: <number>
    nanosec: <number>
  client_gid: '<array type: uint8[16]>'
  sequence_number: <number>
request: '<sequence type: std_srvs/srv/SetBool_Request[1], length: 1>'
response: '<sequence type: std_srvs/srv/SetBool_Response[1], length: 0>'
---
"""


def test_echo(rich):
    with rich.running("service", "echo", "/house/enable", "--no-arr") as process:
        while rich.out("topic", "info", EVENTS).splitlines()[-1] != "Subscription count: 1":
            pass
        rich.out("service", "call", "/house/enable", "std_srvs/srv/SetBool")
        lines = [process.stdout.readline() for _ in range(2 * ECHOED.count("\n"))]
        interrupted(process)
    text = re.sub(r"(?<=: )\d+\n", "<number>\n", "".join(lines))
    assert text.startswith(ECHOED)
    assert "event_type: RESPONSE_SENT" in text


def test_echo_shows_whole_arrays(rich):
    with rich.running("service", "echo", "/house/enable", "--flow-style") as process:
        while rich.out("topic", "info", EVENTS).splitlines()[-1] != "Subscription count: 1":
            pass
        rich.out("service", "call", "/house/enable", "std_srvs/srv/SetBool", "{data: true}")
        lines = [process.stdout.readline() for _ in range(6)]
        interrupted(process)
    assert re.fullmatch(r"  client_gid: \[\d+(, \d+){15}\]\n", lines[5])


EVENTS = "/house/enable/_service_event"


def test_echo_of_what_cannot_be_heard(rich):
    said = "Cannot find type for '/house/enabl'\n# Did you mean '/house/enable'?\n"
    assert rich.error("service", "echo", "/house/enabl") == said
    error = rich.error("service", "echo", "/house/enable", "std_srvs/srv/Nope")
    assert error.startswith("The service type 'std_srvs/srv/Nope' is invalid\n# ")
    with rich.running("service", "echo", "/house/rich/get_parameters") as process:
        assert process.stdout.readline() == (
            "No publishers on topic '/house/rich/get_parameters/_service_event'; is service "
            "introspection on the client or server enabled?\n"
        )
        assert "configure_introspection(...)" in process.stderr.readline()


def test_call(graph):
    out = graph.out("service", "call", "one/enable", "std_srvs/srv/SetBool", "{data: true}")
    assert out.replace("waiting for service to become available...\n", "") == CALL
    assert "data=False" in graph.out("service", "call", "one/enable", "std_srvs/SetBool")


def test_call_again_and_again(graph):
    words = ("service", "call", "-r", "20", "/one/enable", "std_srvs/srv/SetBool", "{data: true}")
    with graph.running(*words) as process:
        seen = ""
        while seen.count("response:") < 3:
            seen += process.stdout.readline()
        assert interrupted(process)[1] == ""


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("/one/enable", "std_srvs/srv/Nope"), "The passed service type is invalid"),
        (("/one/enable", "std_msgs/msg/Bool"), "The passed type is not a service"),
        (("/one/enable", "std_srvs/srv/Trigger"), "has the type [std_srvs/srv/SetBool]"),
        (("/one/enable", "std_srvs/srv/SetBool", "{dta: 1}"), "Did you mean 'data'?"),
        (("/one/enable", "std_srvs/srv/SetBool", "-r", "0"), "rate must be greater than zero"),
        (("one enable", "std_srvs/srv/SetBool"), "service name 'one enable' is invalid"),
    ],
)
def test_call_of_what_cannot_be_called(graph, words, said):
    assert said in graph.error("service", "call", *words)


def test_call_of_an_unknown_service_waits_and_says_so(graph):
    with graph.running("service", "call", "/one/enabl", "std_srvs/srv/SetBool") as process:
        assert "Did you mean '/one/enable'?" in process.stderr.readline()
        out, _ = interrupted(process)
    assert out == "waiting for service to become available...\n"
