import re

import pytest
from as_typed import interrupted

pytestmark = pytest.mark.ros

FIBONACCI = ("/house/fibonacci", "test_msgs/action/Fibonacci")
SENT = """\
Waiting for an action server to become available...
Sending goal:
     order: 2

Goal accepted with ID: <id>

Feedback:
    sequence:
- 0
- 1
- 1

Result:
    sequence:
- 0
- 1
- 1

Goal finished with status: SUCCEEDED
"""


def test_lists_and_info(rich):
    assert rich.out("action", "list") == "/house/fibonacci\n"
    assert rich.out("action", "list", "-t") == "/house/fibonacci [test_msgs/action/Fibonacci]\n"
    assert rich.out("action", "list", "-c") == "1\n"
    assert rich.out("action", "type", FIBONACCI[0]) == "test_msgs/action/Fibonacci\n"
    head = "Action: /house/fibonacci\nAction clients: 0\nAction servers: 1\n"
    assert rich.out("action", "info", "-c", FIBONACCI[0]) == head
    typed = "    /house/rich [test_msgs/action/Fibonacci]\n"
    assert rich.out("action", "info", "-t", FIBONACCI[0]) == head + typed


def test_send_goal(rich):
    out = rich.out("action", "send_goal", "-f", *FIBONACCI, "{order: 2}")
    assert re.sub("(?<=ID: )[0-9a-f]{32}", "<id>", out) == SENT
    short = ("/house/fibonacci", "test_msgs/Fibonacci", "--stdin")
    assert "SUCCEEDED" in rich.out("action", "send_goal", *short, stdin="order: 1")


def test_a_rejected_goal(rich):
    out = rich.out("action", "send_goal", *FIBONACCI, "{order: -1}")
    assert out.endswith("Goal was rejected.\n")


def test_ctrl_c_cancels_the_goal(rich):
    with rich.running("action", "send_goal", *FIBONACCI, "{order: 40}") as process:
        while not (line := process.stdout.readline()).startswith("Goal accepted"):
            assert line
        out, error = interrupted(process)
    assert error == ""
    assert out.lstrip("\n") == "Canceling goal...\nGoal canceled.\n"  # the rest is read already


def test_what_is_not_there(rich):
    said = "# Unknown action '/house/fibo'\n# Did you mean '/house/fibonacci'?\n"
    assert rich.error("action", "type", "/house/fibo") == said
    done = rich("action", "info", "/house/fibo")
    assert done.stdout == "Action: /house/fibo\nAction clients: 0\nAction servers: 0\n"
    assert done.stderr == "# Did you mean '/house/fibonacci'?\n"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((FIBONACCI[0], "test_msgs/action/Fibonaci"), "action type is invalid\n# Did you mean"),
        ((FIBONACCI[0], "std_msgs/msg/Bool"), "The passed action type is invalid"),
        ((FIBONACCI[0], "test_msgs/action/NestedMessage"), "has the type [test_msgs/action/Fib"),
        ((*FIBONACCI, "{ordr: 1}"), "Did you mean 'order'?"),
        (
            (*FIBONACCI, "{order: x}"),
            "Failed to populate message fields: "
            """ValueError("invalid literal for int() with base 10: 'x'")""",
        ),
        (("a b", FIBONACCI[1]), "action name 'a b' is invalid"),
    ],
)
def test_goals_that_cannot_be_sent(rich, words, said):
    assert said in rich.error("action", "send_goal", *words)


def test_nobody_to_answer(rich):
    with rich.running("action", "send_goal", "/house/fibonaci", FIBONACCI[1]) as process:
        assert "Did you mean '/house/fibonacci'?" in process.stderr.readline()
        out, _ = interrupted(process)
    assert out == "Waiting for an action server to become available...\n"
