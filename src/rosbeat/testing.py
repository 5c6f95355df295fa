"""Provide the session of a test, which can also publish messages to the nodes under test."""

from __future__ import annotations

from typing import Any

from rosbeat.errors import SessionError, called_as
from rosbeat.page_session import Session
from rosbeat.records import Endpoint
from rosbeat.ros.errors import check_name, duration_ns
from rosbeat.ros.test_nodes import Tester, message, profile


class TestSession(Session):
    """Run the nodes under test in virtual time, and publish what they are to hear.

    ::

        def test_a_high_temperature_is_reported(ros):
            ros.add(TemperatureMonitor)
            ros.publish("temperature", 30.0, at=1.0)
            ros.run(2)
            assert "High" in ros.logs()[-1].text

    Everything else is as in `rosbeat.Session`.
    """

    #: Tells pytest that this is no class of tests.
    __test__ = False
    _tester: Tester | None = None

    @called_as('ros.publish("temperature", 30.0, at=1.0)')
    def publish(self, topic: str, value: Any, *, at: float | None = None) -> None:  # noqa: ANN401 - of any type
        """Publish a message, now or at a later time of the session.

        It comes from a node `/tester`. Its QoS profile is that of the first subscription to the
        topic, so that it is compatible; without a subscription it is ROS's default, with depth 10.

        Args:
            topic: The topic's name; `temperature` and `/temperature` are the same.
            value: A message of any type. If a node subscribes to the topic already, also the value
                of the field `data`, or a dict with the values of fields: the type is then the
                subscription's.
            at: Seconds of virtual time since the start of the session, not before `ros.time`. Now,
                if it is left out; `ros.run` delivers the message in both cases.

        Raises:
            SessionError: If the type is not known, a field does not fit, or `at` has passed.
            DurationError: If `at` is not a number from 0 up.
        """
        name = "/" + check_name("publish", topic).lstrip("/")
        heard = self.graph().on(name, "subscription")
        if not hasattr(type(value), "get_fields_and_field_types"):
            value = _message(name, value, heard)
        wait = None if at is None else duration_ns(at, "publish(at=...)") / 1e9 - self.time
        if wait is not None and wait < 0:
            raise SessionError(
                f"`at={at}` has passed: it is {self.time:g} s.",
                "`at` counts from the start of the session, and time only goes forward.",
                "Publish before `ros.run`, or leave `at` out to publish now.",
            )
        if self._tester is None:
            self._tester = self.add(Tester)
        self._tester.publish(name, value, profile(heard[0].qos if heard else 10), wait)


def _message(topic: str, value: object, heard: tuple[Endpoint, ...]) -> Any:  # noqa: ANN401 - a message
    """Return a message of the type of the first subscription.

    Raises:
        SessionError: If there is no subscription, or its type has no such fields.
    """
    if not heard:
        raise SessionError(
            f"No node subscribes to {topic}, so {value!r} has no message type.",
            "The type of a plain value is that of the subscription to the topic.",
            "Add the node first, or publish a message: "
            f'`ros.publish("{topic}", Float32(data=30.0))`.',
        )
    type_name = heard[0].type_name
    try:
        return message(type_name, value)
    except (AssertionError, AttributeError, TypeError) as error:
        raise SessionError(
            f"{value!r} does not fit into {type_name}, the type of {topic}.",
            f"A plain value is the field `data`, and a dict holds fields. {error}",
            f"See its fields with `ros2 interface show {type_name}`.",
        ) from None
