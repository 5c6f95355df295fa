import pytest

from failed_calls import failed_call
from rosbeat.diagnosis.exceptions import diagnose_fault
from rosbeat.records import Fault


def _fault(kind, text, asked="", line=0, code="", callback="answer"):
    return Fault(0, "/a", callback, kind, text, line, code, failed_call(asked))


@pytest.mark.parametrize(
    ("fault", "mistake"),
    [
        (_fault("TypeError", "", "send_response(NoneType)"), "response-missing"),
        (_fault("TypeError", "", "send_response(bool)"), "response-wrong"),
        (_fault("TypeError", "", "send_response(message[Trigger_Request])"), "response-wrong"),
        (
            _fault("AssertionError", "The 'result' field must be a sub message of type 'X_Result'"),
            "result-missing",
        ),
        (_fault("TypeError", "", line=3, code="goal.publish_feedback([1])"), "feedback-wrong"),
        (
            _fault("RCLError", "goal_handle attempted invalid transition from state EXECUTING "
                               "with event CANCELED, at /x"),
            "canceled-unasked",
        ),
        (
            _fault("RCLError", "goal_handle attempted invalid transition from state SUCCEEDED "
                               "with event SUCCEED, at /x"),
            "ended-twice",
        ),
        (
            _fault("TypeError", "'float' object cannot be interpreted as an integer", line=2),
            "not-an-integer",
        ),
        (
            _fault("TypeError", "'Future' object cannot be interpreted as an integer", line=2),
            "await-missing",
        ),
        (
            _fault("TypeError", "'<' not supported between instances of 'Future' and 'int'"),
            "await-missing",
        ),
        (
            _fault("RuntimeError", "The service type provided is not valid (<class "
                                   "'std_msgs.msg._float32.Float32'>), this might be a message"),
            "wrong-argument",
        ),
        (
            _fault("TypeError", "Node.create_service() takes 4 positional arguments but 5 were "
                                "given", line=7),
            "wrong-argument",
        ),
        (
            _fault("TypeError", "Node.create_service() missing 1 required positional argument: "
                                "'callback'", line=7),
            "callback-missing",
        ),
        (
            _fault("TypeError", "A.answer() takes 2 positional arguments but 3 were given"),
            "callback-parameters",
        ),
    ],
)  # fmt: skip
def test_what_a_callback_gives_back(fault, mistake):
    found = diagnose_fault(fault)
    assert found is not None
    assert found.mistake == mistake


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("A.answer() takes 1 positional argument but 2 were given",
         "ROS calls answer with 1 argument besides self, and it takes none. One argument is"),
        ("A.answer() takes 2 positional arguments but 3 were given",
         "ROS calls answer with 2 arguments besides self, and it takes 1. A service's callback"),
        ("make.<locals>.answer() takes 1 positional argument but 2 were given",
         "ROS calls answer with 2 arguments, and it takes 1. A service's callback"),
        ("A.answer() missing 1 required positional argument: 'info'", "of an event, its info"),
    ],
)  # fmt: skip
def test_what_is_said_of_a_callback_is_true_whichever_calls_it(text, said):
    found = diagnose_fault(_fault("TypeError", text))
    assert found is not None
    assert said in f"{found.evidence} {found.hint}"


@pytest.mark.parametrize(
    "fault",
    [
        _fault("TypeError", ""),
        _fault("TypeError", "", "publish(NoneType)"),
        _fault("TypeError", "'Future' object is not callable", line=4),
        _fault("TypeError", "A.other() takes 2 positional arguments but 3 were given", line=4),
    ],
)
def test_others_are_not_taken_for_it(fault):
    found = diagnose_fault(fault)
    assert found is None or not found.mistake.startswith(("response", "callback", "await"))
