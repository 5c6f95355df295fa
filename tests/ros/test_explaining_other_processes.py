"""Nodes of other processes: what arrives from them, and whether they answer."""

from functools import partial

import pytest

from nodes import Listener
from other_process import other_process
from rosbeat import Session
from rosbeat.domains import lease_domain
from rosbeat.records import is_hidden

pytestmark = pytest.mark.ros
#: The second one is in the graph and nobody spins it.
NODES = (
    "Talker(period=0.1), *(kept := [Listener('deaf', 'count'), Talker('quiet', 'hush')])[2:], "
    "Listener(topic='cuont'), Listener(topic='hush'), Words(topic='words'),"
)


@pytest.fixture(scope="module")
def domain():
    lease = lease_domain()
    with other_process(lease.domain_id, NODES):
        yield lease.domain_id
    lease.release()


@pytest.fixture
def joined(domain):
    with Session(domain_id=domain) as session:
        yield session


def verdicts(found):
    return [one.mistake for one in found.diagnoses] or [found.verdict]


def test_a_node_that_is_not_spun_hears_nothing(joined):
    found = joined.explain("count", seconds=20)
    assert verdicts(found) == ["not-spun"]
    assert found.headlines == ("/deaf does not answer",)
    assert found.rate_hz > 0


def test_a_node_that_is_not_spun_says_nothing(joined):
    found = joined.explain("hush", seconds=0.5)
    assert verdicts(found) == ["not-spun"]
    assert found.headlines == ("/quiet does not answer",)


def test_an_own_node_hears_them(joined):
    listener = joined.add(partial(Listener, "own", "words"))
    assert listener.heard == []
    found = joined.explain("words", seconds=20)
    assert verdicts(found) == ["type-mismatch"]
    assert "/words publishes String, and /own subscribes to Int32" in found.diagnoses[0].evidence


def test_nothing_is_left_behind(joined, eventually):
    hidden = lambda: [name for name in joined._world.graph_observer.nodes() if is_hidden(name)]  # noqa: E731
    before = hidden()
    joined.explain("cuont", seconds=0)
    eventually(lambda: hidden() == before, 30)
    assert joined.nodes == ()
