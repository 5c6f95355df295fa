"""Waiting until the graph of a domain can be believed."""

from __future__ import annotations

import time

from rosbeat.runtime.lookout import Lookout, participant
from rosbeat.runtime.outside import is_settled
from rosbeat.runtime.participants import count_participants

#: Every participant says on this topic which endpoints belong to which of its nodes.
_EVERYBODY = "ros_discovery_info"
_LOOK_EVERY = 0.02
#: The graph is believed if it was the same so many times in a row. Not a time: on a busy machine
#: time passes in which no news could have come in.
_SAME_LOOKS = 8
#: A process without the course's discovery settings announces itself each 3 s. If there is no news
#: for longer, whoever is missing has stopped. While there is news, a busy machine is waited for.
_NO_NEWS = 4.0
_AT_MOST = 20.0


def settle(lookout: Lookout, domain_id: int) -> bool:
    """Wait until every process of this machine is seen, with its names, and nothing changes.

    Args:
        lookout: Who sees.
        domain_id: The domain that it is in.

    Returns:
        Whether that came; False if some seconds without news came first.
    """
    begin = since = time.monotonic()
    last, same = None, 0
    while time.monotonic() - begin < _AT_MOST and time.monotonic() - since < _NO_NEWS:
        now = _look(lookout)
        if now != last:
            last, since, same = now, time.monotonic(), 0
        same += 1
        if same >= _SAME_LOOKS and _is_complete(lookout, domain_id):
            return True
        time.sleep(_LOOK_EVERY)
    return False


def _look(lookout: Lookout) -> object:
    counts = [
        (topic, lookout.count_publishers(topic), lookout.count_subscribers(topic))
        for topic in lookout.topics()
    ]
    return lookout.nodes(), counts, sorted(lookout.get_service_names_and_types())


def _is_complete(lookout: Lookout, domain_id: int) -> bool:
    publishers = lookout.get_publishers_info_by_topic(_EVERYBODY, True)
    subscriptions = lookout.get_subscriptions_info_by_topic(_EVERYBODY, True)
    seen, heard = set(map(participant, publishers)), set(map(participant, subscriptions))
    return seen == heard and len(seen) >= count_participants(domain_id) and is_settled(lookout)
