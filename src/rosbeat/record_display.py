"""Show records and rclpy objects at the end of a cell in a readable form, on a line or two.

`repr` stays as it is. IPython asks its formatter for a type by name, so nothing of ROS is loaded.
Shown are attributes by their names, times in seconds, and nothing that every object has.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from math import isfinite
from struct import pack, unpack
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

    from rosbeat.records import GraphSnapshot, Observation

#: For each record the attributes that are shown.
_RECORDS = {
    "Sample": ("time", "topic", "node", "value"),
    "LogRecord": ("time", "level", "name", "text"),
    "CallbackRecord": ("time", "node", "kind", "name", "source"),
    "Fault": ("time", "node", "callback", "kind", "text", "line"),
    "QoS": ("reliability", "durability", "history", "depth"),
    "Endpoint": ("node", "name", "type_name", "kind", "qos", "matched"),
    "Reply": ("time", "name", "word", "data"),
}
#: The same for what has no readable `repr` in rclpy.
_RCLPY = {
    ("rclpy.publisher", "Publisher"): ("topic_name",),
    ("rclpy.subscription", "Subscription"): ("topic_name",),
    ("rclpy.client", "Client"): ("srv_name",),
    ("rclpy.service", "Service"): ("srv_name",),
}
_NANOSECONDS = 1e9
#: Characters of one attribute, and numbers that 32 bits can hold.
_LONGEST, _LARGEST = 200, 3e38
#: What every node brings along.
_BROUGHT = ("/rosout", "/parameter_events")
_SERVICES = ("_parameters", "_atomically", "/get_parameter_types", "/get_type_description")

Printer = Any  # IPython's, which carries no types
View = Callable[[Any], str]


def register(shell: InteractiveShell) -> None:
    """Make the views known to a shell; a second time changes nothing.

    Args:
        shell: The running shell.
    """
    formatter = shell.display_formatter.formatters["text/plain"]
    views: dict[tuple[str, str], View] = {
        ("rosbeat.records", "GraphSnapshot"): graph,
        ("rosbeat.records", "Observation"): observation,
        ("rclpy.node", "Node"): node,
        ("rclpy.timer", "Timer"): lambda one: f"Timer(every {_seconds(one.timer_period_ns)} s)",
        ("rclpy.qos", "QoSProfile"): profile,
    }
    views.update((("rosbeat.records", name), _short(shown)) for name, shown in _RECORDS.items())
    views.update((name, _short(shown)) for name, shown in _RCLPY.items())
    for (module, name), view in views.items():
        formatter.for_type_by_name(module, name, _printer(view))


def _printer(view: View) -> Callable[[Any, Printer, bool], None]:
    def show(value: Any, printer: Printer, cycle: bool) -> None:  # noqa: ANN401 - of many types
        try:
            text = view(value)
        except Exception:  # for example of a node that is destroyed
            text = repr(value)
        for number, line in enumerate(text.split("\n")):
            if number:
                printer.break_()
            printer.text(line)

    return show


def _short(names: Iterable[str]) -> View:
    """Return a view of some attributes."""

    def show(value: Any) -> str:  # noqa: ANN401 - of many types
        shown = ", ".join(f"{name}={_value_text(getattr(value, name))}" for name in names)
        return f"{type(value).__name__}({shown})"

    return show


def _value_text(value: object) -> str:
    if type(value).__name__ == "QoS":
        return _short(_RECORDS["QoS"])(value)
    text = _decimal(value) if isinstance(value, float) else repr(value)
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 4]} ..."


def _decimal(value: float) -> str:
    """Return the shortest decimal number for what was sent with 32 bits, else all its digits."""
    if isfinite(value) and abs(value) < _LARGEST:
        for digits in range(1, 10):
            near = float(f"{value:.{digits}g}")
            if unpack("f", pack("f", near))[0] == value:
                return repr(near)
    return repr(value)


def graph(shown: GraphSnapshot) -> str:
    """Return the nodes and the topics of a graph, each topic with those who use it."""
    topics = shown.topics()
    rows = [f"GraphSnapshot: {_count(shown.nodes, 'node')}, {_count(topics, 'topic')}"]
    for name in topics:
        sides = [_names(shown.on(name, kind)) for kind in ("publisher", "subscription")]
        rows.append(f"  {name}: {sides[0]} → {sides[1]}")
    return "\n".join(rows)


def observation(seen: Observation) -> str:
    """Return how far a session ran, and how much was seen."""
    parts = [
        _count(seen.samples, "message"),
        _count(seen.logs, "log line"),
        _count(seen.callbacks, "callback"),
        _count(seen.faults, "fault"),
    ]
    return f"Observation({seen.time:g} s, seed {seen.seed}: {', '.join(parts)})"


def node(one: Any) -> str:  # noqa: ANN401 - rclpy carries no types
    """Return the name of a node and what it uses, those that every node brings along left out."""
    services = [each.srv_name for each in one.services if not each.srv_name.endswith(_SERVICES)]
    parts = {
        "publishes": [each.topic_name for each in one.publishers],
        "subscribes to": [each.topic_name for each in one.subscriptions],
        "offers": services,
        "asks": [each.srv_name for each in one.clients],
        "timers every": [f"{_seconds(each.timer_period_ns)} s" for each in one.timers],
    }
    said = [
        f"{verb} {', '.join(kept)}"
        for verb, names in parts.items()
        if (kept := [name for name in names if name not in _BROUGHT])
    ]
    return f"{type(one).__name__}({'; '.join([one.get_fully_qualified_name(), *said])})"


def profile(one: Any) -> str:  # noqa: ANN401 - rclpy carries no types
    """Return the policies of a QoS profile, and its limits in time if it has any."""
    names = ("reliability", "durability", "history")
    policies = [f"{name}={getattr(one, name).name}" for name in names]
    times = ((name, getattr(one, name).nanoseconds) for name in ("deadline", "lifespan"))
    limits = [f"{name}={_seconds(ns)} s" for name, ns in times if 0 < ns < 2**62]
    return f"QoSProfile({', '.join([*policies, f'depth={one.depth}', *limits])})"


def _seconds(nanoseconds: int) -> str:
    return f"{nanoseconds / _NANOSECONDS:g}"


def _count(things: Iterable[object], noun: str) -> str:
    number = len(list(things))
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _names(ends: Iterable[Any]) -> str:
    return ", ".join(dict.fromkeys(end.node for end in ends)) or "nobody"
