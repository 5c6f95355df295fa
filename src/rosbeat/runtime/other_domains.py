"""Who uses a topic in another ROS domain of this machine."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rclpy.context import Context

from rosbeat.diagnosis.situation import OtherDomain
from rosbeat.domains import PRIVATE_IDS
from rosbeat.records import is_hidden
from rosbeat.runtime.context import SESSION_ARGUMENTS
from rosbeat.runtime.lookout import Lookout, owner
from rosbeat.runtime.participants import domains_in_use
from rosbeat.runtime.settling import settle

#: Each takes a part of a second.
_AT_MOST = 10


def others(topic: str, domain_id: int) -> tuple[OtherDomain, ...]:
    """Look for a topic in the other domains in which somebody takes part.

    The private domains of sessions are named and not looked into: nobody shall appear there.

    Args:
        topic: The topic's full name.
        domain_id: The domain that is not another one.
    """
    used = [number for number in domains_in_use() if number != domain_id]
    shared = [number for number in used if number not in PRIVATE_IDS]
    private = [OtherDomain(number, private=True) for number in used if number in PRIVATE_IDS]
    return (*(_look_into(number, topic) for number in shared[:_AT_MOST]), *private)


def _look_into(domain_id: int, topic: str) -> OtherDomain:
    with _visit(domain_id) as lookout:
        settle(lookout, domain_id)
        publishers = {owner(one) for one in lookout.publishers(topic)}
        subscriptions = {owner(one) for one in lookout.subscriptions(topic)}
    return OtherDomain(domain_id, _visible(publishers), _visible(subscriptions))


def _visible(names: set[str]) -> tuple[str, ...]:
    return tuple(sorted(name for name in names if not is_hidden(name)))


@contextmanager
def _visit(domain_id: int) -> Iterator[Lookout]:
    context = Context()
    context.init(SESSION_ARGUMENTS, domain_id=domain_id)
    lookout = Lookout(context)
    try:
        yield lookout
    finally:
        lookout.destroy_node()
        context.try_shutdown()
