import signal

import pytest

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
    assert graph.out("service", "type", "one/enable") == "std_srvs/srv/SetBool\n"
    assert "Did you mean '/one/enable'?" in graph.error("service", "type", "/one/enabl")


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
        process.send_signal(signal.SIGINT)
        _, error = process.communicate(timeout=30)
    assert (process.returncode, error) == (2, "")


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
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=30)
    assert (process.returncode, out) == (2, "waiting for service to become available...\n")
