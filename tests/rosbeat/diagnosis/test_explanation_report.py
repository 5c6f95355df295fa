from scenes import TOPIC, elsewhere, heard, pub, scene, spoke, sub, well

from rosbeat.diagnosis.explanation import explain
from rosbeat.diagnosis.explanation_links import sides_of
from rosbeat.diagnosis.explanation_report import arrival, report
from rosbeat.diagnosis.situation import Beat
from rosbeat.records import QoS


def test_who_is_there_and_what_each_has_done():
    told = scene(pub(), sub(), beats=(spoke(), heard(missed=2)))
    assert report(sides_of(TOPIC, told.graph), told) == (
        "/sensor publishes Float32 (RELIABLE, VOLATILE, depth 10): 10 messages, 1 message a "
        "second, the last at 10 s.",
        "/monitor subscribes to Float32 (RELIABLE, VOLATILE, depth 10): its callback ran 10 "
        "times, the last at 10 s; 2 messages had been published before.",
    )


def test_what_is_not_known_is_left_out():
    unknown = QoS(depth=0)
    told = elsewhere(scene(pub(qos=unknown), sub(qos=unknown), arriving_hz=4.0))
    assert report(sides_of(TOPIC, told.graph), told) == (
        "/sensor publishes Float32 (RELIABLE, VOLATILE).",
        "/monitor subscribes to Float32 (RELIABLE, VOLATILE).",
        "Altogether 4 messages a second come from other processes.",
    )


def test_nothing_came():
    silent = Beat("/sensor", "publisher", 0, watched_ns=3_000_000_000)
    told = scene(pub(), sub(), beats=(silent, heard(number=0, since=0)))
    publisher, listener = report(sides_of(TOPIC, told.graph), told)
    assert publisher.endswith("nothing in 3 s.")
    assert listener.endswith("its callback has not run.")


def test_what_arrives():
    told = well()
    sides = sides_of(TOPIC, told.graph)
    assert arrival(sides, told, 4.0) == "4 messages a second arrive at /monitor"
    assert arrival(sides, told, 0.0) == "10 messages arrived at /monitor so far"
    alone = scene(pub(), beats=(spoke(),))
    assert "not shown here" in arrival(sides_of(TOPIC, alone.graph), alone, 1.0)


def test_several_publishers_add_up():
    beats = (spoke(), spoke("/other", rate=3.0), heard())
    found = explain(TOPIC, scene(pub(), pub("/other"), sub(), beats=beats))
    assert found.is_well
    assert found.rate_hz == 4.0
