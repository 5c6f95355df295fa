import pytest
from as_typed import demo_node
from ros2_command.verbs.completion import candidates
from ros2_command.verbs.doctor import Finding, report, summarize

pytestmark = pytest.mark.ros


def test_the_doctor_looks_at_the_graph(graph):
    done = graph("doctor")
    assert "\nAll 3 checks passed\n" in done.stdout
    assert "Publisher without subscriber detected on /slow." in done.stderr
    report = graph.out("wtf", "--report")
    assert "topic               : /temperature\npublisher count     : 1\n" in report
    assert "/rosout" not in report
    failed = graph("doctor", "-iw")
    assert "\n1/3 check(s) failed\n\nFailed modules: topic\n" in failed.stdout


def test_the_doctor_finds_those_that_cannot_hear_each_other(latched):
    with latched.running(
        "topic", "echo", "--qos-reliability", "reliable", "/weak", "std_msgs/msg/Float32"
    ) as process:
        while "Subscription count: 1" not in latched("topic", "info", "/weak", code=None).stdout:
            assert process.poll() is None
        with demo_node(latched, "weak", "/weak", "best_effort", file="latched_node.py"):
            done = latched("doctor")
            report = latched.out("doctor", "--report-failed")
    assert "\nFailed modules: middleware\n" in done.stdout
    said = "UserWarning: ERROR: QoS compatibility error found on topic '/weak': Best effort "
    assert said in done.stderr
    assert "publisher node          : weak\n" in report
    assert "compatibility status    : ERROR: Best effort publisher and reliable" in report


def test_completion_knows_the_graph(graph):
    assert graph.out("completion", "words", "topic", "echo", "/temp") == "/temperature\n"
    assert graph.out("completion", "words", "node", "info", "") == "/ns_two\n/one\n"
    assert graph.out("completion", "words", "param", "get", "/one", "ra") == "rate\n"


def test_completion_knows_the_type_of_a_name(graph, rich):
    def words(side, *typed):
        return side.out("completion", "words", *typed).splitlines()

    assert words(graph, "service", "call", "/one/enable", "") == ["std_srvs/srv/SetBool"]
    assert words(graph, "topic", "pub", "temperature", "") == ["std_msgs/msg/Float32"]
    assert words(graph, "topic", "pub", "-r", "5", "/temp") == ["/temperature"]
    assert words(graph, "topic", "hz", "-w", "5", "/temp") == ["/temperature"]
    assert words(graph, "topic", "echo", "--qos-depth=5", "/temp") == ["/temperature"]
    assert words(graph, "bag", "record", "-o", "run", "--topics", "/slow", "/temp") == [
        "/temperature"
    ]
    assert words(rich, "action", "send_goal", "/house/fibonacci", "") == [
        "test_msgs/action/Fibonacci"
    ]


def test_the_verdict_of_the_doctor(capsys):
    assert summarize({"topic": [], "network": []}, False) == []
    assert capsys.readouterr().out == "\nAll 2 checks passed\n\n"
    found = {"topic": [Finding("a"), Finding("b", True)], "network": [Finding("c")]}
    assert summarize(found, False) == ["topic"]
    text = "\n1/2 check(s) failed\n\nFailed modules: topic\n"
    assert capsys.readouterr() == (text, "UserWarning: a\nUserWarning: ERROR: b\nUserWarning: c\n")
    assert summarize(found, True) == ["topic", "network"]
    assert report([("A", [("k", "v"), ("key", "w")])]) == "\n   A\nk       : v\nkey     : w"
    assert report([("A", [("eight or more", 1)])]) == "\n   A\neight or more    : 1"


def test_completion():
    assert candidates(["to"]) == ["topic"]
    assert candidates(["topic", "e"]) == ["echo"]
    assert candidates(["topic", "echo", "--fi"]) == ["--field", "--filter"]
    assert candidates(["nosuch", ""]) == []
    assert candidates(["bag", ""]) == ["info", "play", "record"]
    goal = ["action", "send_goal", "/fibonacci", "test_msgs/action/F"]
    assert candidates(goal) == ["test_msgs/action/Fibonacci"]
    assert candidates(["topic", "echo", "--qos-rel", "relia"]) == ["reliable"]
    assert candidates(["pkg", "create", "--build-type", ""]) == [
        *("ament_cmake", "ament_python", "cmake"),
    ]
    assert candidates(["pkg", "create", "--node-name", ""]) == []
    assert candidates(["pkg", "create", ""]) == []
    assert candidates(["daemon", "s"]) == ["start", "status", "stop"]
    assert candidates(["run", "--prefix", "gdb", "rclp"]) == ["rclpy"]
    assert candidates(["interface", "show", "std_srvs/srv/Tri"]) == ["std_srvs/srv/Trigger"]


@pytest.mark.parametrize(
    ("words", "prototype"),
    [
        (["service", "call", "/x", "std_srvs/srv/SetBool", ""], '"{data: false}"'),
        (["topic", "pub", "-1", "/x", "std_msgs/msg/String", ""], "\"{data: ''}\""),
        (["topic", "pub", "/x", "std_msgs/msg/String", '"'], "{data: ''}"),
        (["action", "send_goal", "/x", "test_msgs/action/Fibonacci", ""], '"{order: 0}"'),
        (["topic", "pub", "/x", "geometry_msgs/msg/Point", ""], '"{x: 0.0, y: 0.0, z: 0.0}"'),
        (["topic", "pub", "/x", "std_msgs/msg/Byte", ""], r'"{data: \"\\0\"}"'),
    ],
)
def test_completion_offers_a_prototype_to_fill_in(words, prototype):
    assert candidates(words) == [prototype]
