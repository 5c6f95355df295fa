"""Which domains are in use, by the ports that are held."""

import pytest

from nodes import Talker
from rosbeat import Session
from rosbeat.ros.graph import count_participants, domains_in_use

HEAD = "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout"


def table(*sockets):
    """What the system says of sockets, each a port and a number."""
    rows = [
        f"  {n}: 00000000:{port:04X} 00000000:0000 07 00000000:00000000 00:00000000 00000000 0 0 "
        f"{inode} 2 0000000000000000 0"
        for n, (port, inode) in enumerate(sockets)
    ]
    return "\n".join([HEAD, *rows])


def both(domain, number=0, inode=1):
    first = 7400 + 250 * domain + 10 + 2 * number
    return (first, inode), (first + 1, inode)


def test_a_participant_holds_two_ports():
    text = table(*both(7), *both(7, 1), *both(8))
    assert [count_participants(domain, text) for domain in (6, 7, 8)] == [0, 2, 1]
    assert domains_in_use(text, ()) == [7, 8]


def test_one_port_alone_is_somebody_elses():
    (first, second) = both(7)
    assert domains_in_use(table(first), ()) == domains_in_use(table(second), ()) == []
    assert domains_in_use(table((7400 + 250 * 7, 1)), ()) == []


def test_the_process_itself_does_not_count():
    text = table(*both(7, inode=41), *both(8, inode=42))
    assert domains_in_use(text, ["41"]) == [8]


def test_nothing_is_known_without_a_table():
    assert domains_in_use("", ()) == []
    assert count_participants(0, "") == 0
    assert count_participants(0, "nonsense\n1: 2") == 0


@pytest.mark.ros
def test_a_session_is_counted_and_is_no_other(ros):
    ros.add(Talker)
    assert count_participants(ros.domain_id) == 1
    assert ros.domain_id not in domains_in_use()
    with Session(domain_id=ros.domain_id):
        assert count_participants(ros.domain_id) == 2
