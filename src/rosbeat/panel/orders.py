"""What comes from the browser, checked, and carried out on the session."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import isfinite
from typing import TYPE_CHECKING, Any

from rosbeat.errors import RosbeatError, SessionError

if TYPE_CHECKING:
    from rosbeat.panel.instruments import SessionInstruments

#: What a fault does to the messages of a topic.
FAULTS = ("none", "dropout", "nan", "offset")
#: The longest callback that the slider offers, in milliseconds.
LONGEST_LOAD = 900.0

Order = Mapping[str, Any]
Action = Callable[[Order, "SessionInstruments"], None]


def carry_out(order: Order, instruments: SessionInstruments) -> str:
    """Do what the browser asked for.

    Args:
        order: `do` names what; the rest depends on it.
        instruments: The session.

    Returns:
        Empty, or what the person who clicked should read.
    """
    try:
        action = _ACTIONS.get(str(order.get("do")))
        if action is None:
            raise _unknown(order)
        action(order, instruments)
    except RosbeatError as error:
        return " ".join(filter(None, (error.what, error.to_try)))
    return ""


def _on_node(name: str) -> Action:
    def act(order: Order, instruments: SessionInstruments) -> None:
        getattr(instruments, name)(_text(order, "node"))

    return act


def _publish(order: Order, instruments: SessionInstruments) -> None:
    instruments.publish(_text(order, "topic"), _number(order, "value"))


def _repeat(order: Order, instruments: SessionInstruments) -> None:
    value = _number(order, "value") if order.get("on") else None
    instruments.repeat(_text(order, "topic"), value)


def _disturb(order: Order, instruments: SessionInstruments) -> None:
    kind = _text(order, "kind")
    if kind not in FAULTS:
        raise _unknown(order)
    instruments.disturb(_text(order, "topic"), kind, _number(order, "amount"))


def _load(order: Order, instruments: SessionInstruments) -> None:
    instruments.load(max(0.0, min(LONGEST_LOAD, _number(order, "milliseconds"))))


_ACTIONS: dict[str, Action] = {
    **{name: _on_node(name) for name in ("pause", "resume", "stop", "start")},
    "publish": _publish,
    "repeat": _repeat,
    "disturb": _disturb,
    "load": _load,
}


def _text(order: Order, key: str) -> str:
    value = order.get(key)
    if not isinstance(value, str):
        raise _unknown(order)
    return value


def _number(order: Order, key: str) -> float:
    value = order.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise _unknown(order)
    return float(value)


def _unknown(order: Order) -> SessionError:
    return SessionError(
        f"The panel does not understand {dict(order)!r}.",
        "It comes from a page that was opened with another version of the course.",
        "Reload the page in the browser, and run the cell again.",
    )
