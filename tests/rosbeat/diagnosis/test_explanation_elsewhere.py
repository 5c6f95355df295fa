from scenes import TOPIC, elsewhere, pub, scene, silent, sub, well

from rosbeat.diagnosis.explanation import explain
from rosbeat.diagnosis.explanation_elsewhere import private_domains
from rosbeat.diagnosis.situation import OtherDomain, StaleBuild

BUILD = StaleBuild("sensor_simulator", "temperature_publisher", "sensor_simulator/publisher.py")


def causes(told):
    return [one.mistake for one in explain(TOPIC, told).diagnoses]


def test_what_is_missing_here_is_there():
    other = OtherDomain(12, publishers=("/sensor",), subscriptions=("/display",))
    found = explain(TOPIC, elsewhere(scene(sub(), other_domains=(other,))))
    assert [one.mistake for one in found.diagnoses] == ["other-domain", "no-publisher"]
    assert "In ROS domain 12, /sensor publishes on /temperature; this is domain 7." in (
        found.diagnoses[0].evidence
    )
    assert "/display" not in found.diagnoses[0].evidence
    assert "ROS_DOMAIN_ID" in found.diagnoses[0].hint


def test_both_sides_are_there():
    other = OtherDomain(12, publishers=("/sensor",), subscriptions=("/display",))
    found = explain(TOPIC, elsewhere(scene(other_domains=(other,))))
    assert found.verdict == "other-domain"
    assert "/display subscribes to" in found.diagnoses[0].evidence


def test_another_domain_matters_only_if_something_is_missing():
    other = OtherDomain(12, publishers=("/sensor",))
    assert explain(TOPIC, well(other_domains=(other,))).is_well
    assert causes(silent(other_domains=(other,))) == ["never-published"]
    assert causes(scene(sub(), other_domains=(OtherDomain(12),))) == ["no-publisher"]


def test_private_domains_are_a_remark():
    told = scene(sub(), other_domains=(OtherDomain(60, private=True),))
    assert causes(told) == ["no-publisher"]
    assert "ROS domain 60" in explain(TOPIC, told).sentences[-1]
    two = (OtherDomain(60, private=True), OtherDomain(61, private=True))
    assert "domains 60 and 61" in private_domains(scene(other_domains=two))
    assert private_domains(scene()) == ""


def test_a_build_that_is_older_than_its_source():
    found = explain(TOPIC, elsewhere(scene(sub(), stale_builds=(BUILD,))))
    assert [one.mistake for one in found.diagnoses] == ["not-rebuilt", "no-publisher"]
    assert "ros2 run sensor_simulator temperature_publisher" in found.diagnoses[0].evidence
    assert "colcon build" in found.diagnoses[0].hint


def test_a_package_that_was_never_built():
    build = StaleBuild("sensor_simulator", "temperature_publisher", "a/b.py", built=False)
    assert causes(elsewhere(scene(sub(), stale_builds=(build,))))[0] == "not-built"


def test_an_old_build_is_no_cause_if_all_is_well():
    found = explain(TOPIC, well(stale_builds=(BUILD,)))
    assert found.is_well
    assert found.sentences[-1].startswith("Note: temperature_publisher was edited")


def test_a_silent_publisher_may_be_an_old_build():
    told = elsewhere(scene(pub(), sub(), stale_builds=(BUILD,)))
    assert "not-rebuilt" in causes(told)
