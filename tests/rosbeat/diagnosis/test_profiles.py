"""Calls around a quality of service that fail. Needs no ROS."""

import pytest

from rosbeat.diagnosis.exceptions import meaning_of
from rosbeat.records import Fault

KEYS = "Invalid arguments passed to constructor: dict_keys(['depth', 'durabilty'])"
EVENT = (
    "__init__(): incompatible constructor arguments. The following are supported:\n1. EventHandle"
)
MISSING = "Dog.on_silence() missing 1 required positional argument: 'event'"


def meaning(kind, text, code, callback="__init__"):
    return meaning_of(Fault(0, "", callback, kind, text, 4, code))


@pytest.mark.parametrize(
    ("kind", "text", "code", "mistake", "said"),
    [
        ("InvalidQoSProfileException", "('Invalid', 'History and/or depth settings are required.')",
         "QoSProfile()", "depth-missing", "how many messages"),
        ("TypeError", "Duration.__init__() takes 1 positional argument but 2 were given",
         "Duration(2)", "wrong-argument", "without a name"),
        ("TypeError", "Duration.__init__() got an unexpected keyword argument 'second'",
         "Duration(second=2)", "wrong-argument", "Duration has no argument second"),
        ("TypeError",
         "SubscriptionEventCallbacks.__init__() got an unexpected keyword argument 'silence'",
         "x", "wrong-argument", "no argument silence"),
        ("AssertionError", KEYS, "x", "wrong-argument", "QoSProfile has no argument durabilty"),
        ("AssertionError", "", "qos = QoSProfile(depth=10, deadline=2.0)", "wrong-argument",
         "for deadline"),
        ("AssertionError", "", "deadline=2.0,", "wrong-argument", "for deadline"),
        ("AssertionError", "", "QoSProfile(depth=9, deadline=2, lifespan=3)", "wrong-argument",
         "one of the policies"),
        ("AttributeError", "TRANSIENT", "q = DurabilityPolicy.TRANSIENT", "wrong-attribute",
         "DurabilityPolicy has no TRANSIENT"),
        ("TypeError", MISSING, "events = SubscriptionEventCallbacks(deadline=self.on_silence())",
         "callback-called", "on_silence is called"),
        ("TypeError", MISSING, "deadline=self.on_silence(),", "callback-called", "on_silence"),
        ("TypeError", MISSING, 'Float32, "temperature", self.on_silence(), qos',
         "callback-called", "on_silence"),
        ("TypeError", EVENT, "self.create_subscription(", "wrong-argument", "the other side"),
        ("AttributeError", "'method' object has no attribute 'create_event_handlers'",
         "self.create_subscription(", "wrong-argument", "a method"),
        ("AttributeError", "'str' object has no attribute 'create_event_handlers'",
         "self.create_subscription(", "wrong-argument", "a str"),
    ],
)  # fmt: skip
def test_what_it_means(kind, text, code, mistake, said):
    found = meaning(kind, text, code)
    assert (found.mistake, said in found.means) == (mistake, True), found


@pytest.mark.parametrize(
    ("kind", "text", "code", "callback"),
    [
        ("AssertionError", "", "assert depth == 3", "__init__"),
        ("AssertionError", "", "assert self.ready", "tick"),
        ("AttributeError", "TRANSIENT", "q = Mood.TRANSIENT", "__init__"),
        ("TypeError", MISSING, "on_silence()", "tick"),
    ],
)
def test_what_is_no_business_of_a_profile_gets_no_such_name(kind, text, code, callback):
    assert meaning(kind, text, code, callback) is None
