import pytest

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
