import pytest
from ros2_command.verbs.completion import candidates
from ros2_command.verbs.doctor import Finding, report, summarize

pytestmark = pytest.mark.ros


def test_the_doctor_looks_at_the_graph(graph):
    done = graph("doctor")
    assert "\nAll 3 checks passed\n" in done.stdout
    assert "Publisher without subscriber detected on /slow." in done.stderr
    assert "/temperature [std_msgs/msg/Float32]" in graph.out("wtf", "--report")
    failed = graph("doctor", "-iw", code=1)
    assert "Failed modules: topic" in failed.stdout


def test_completion_knows_the_graph(graph):
    assert graph.out("completion", "words", "topic", "echo", "/temp") == "/temperature\n"
    assert graph.out("completion", "words", "node", "info", "") == "/ns_two\n/one\n"
    assert graph.out("completion", "words", "param", "get", "/one", "ra") == "rate\n"


def test_the_verdict_of_the_doctor(capsys):
    assert summarize({"topic": [], "network": []}, False) == []
    assert capsys.readouterr().out == "\nAll 2 checks passed\n\n"
    found = {"topic": [Finding("a"), Finding("b", True)], "network": [Finding("c")]}
    assert summarize(found, False) == ["topic"]
    text = "\n1/2 check(s) failed\n\nFailed modules: topic\n"
    assert capsys.readouterr() == (text, "WARNING: a\nERROR: b\nWARNING: c\n")
    assert summarize(found, True) == ["topic", "network"]
    assert report([("A", [("k", "v"), ("key", "w")])]) == "\n   A\nk   : v\nkey : w"


def test_completion():
    assert candidates(["to"]) == ["topic"]
    assert candidates(["topic", "e"]) == ["echo"]
    assert candidates(["topic", "echo", "--fi"]) == ["--field", "--filter"]
    assert candidates(["nosuch", ""]) == []
    assert candidates(["bag", ""]) == ["info", "play", "record"]
    goal = ["action", "send_goal", "/fibonacci", "test_msgs/action/F"]
    assert candidates(goal) == ["test_msgs/action/Fibonacci"]
    assert candidates(["interface", "show", "std_srvs/srv/Tri"]) == ["std_srvs/srv/Trigger"]
