"""Why nothing arrives on a topic: from scenes to explanations."""

from dataclasses import FrozenInstanceError, replace

import pytest

from diagnosis_scenes import (
    LATCHED,
    SENSOR_DATA,
    TOPIC,
    elsewhere,
    ended,
    heard,
    pub,
    scene,
    seconds,
    silent,
    spoke,
    sub,
    timer,
    well,
)
from parsed_html import Parsed
from record_builders import STRING
from rosbeat.diagnosis import silence
from rosbeat.diagnosis.findings import difference, nearest, sides_of
from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN
from rosbeat.diagnosis.silence import WELL, explain, report
from rosbeat.diagnosis.topic_snapshot import (
    Beat,
    Condition,
    OtherDomain,
    StaleBuild,
    Unreturned,
    rate_of,
)
from rosbeat.records import QoS

# Names that are almost the same.


@pytest.mark.parametrize(
    ("other", "words"),
    [
        ("/Temperature", "capital letters"),
        ("/TEMPERATURE", "capital letters"),
        ("/room/temperature", "before the last slash"),
        ("/temp_erature", "underscores"),
        ("/temprature", "one letter"),
        ("/temperature1", "one character"),
        ("/temprture", "2 letters"),
        *((other, "") for other in ("/temperatures", "/tempearture", "/temperature_1")),
        *((other, None) for other in ("/humidity", "/temp", "/status", "/mean", "/t", TOPIC)),
    ],
)
def test_what_is_almost_the_same_is_found_and_other_words_are_not(other, words):
    assert nearest(TOPIC, ["/pressure", other]) == ("" if words is None else other)
    assert nearest(other, [TOPIC, "/pressure"]) == ("" if words is None else TOPIC)
    assert words is None or words in difference(TOPIC, other)


# The causes.

BUILD = StaleBuild("sensor_simulator", "temperature_publisher", "sensor_simulator/publisher.py")
OTHER = OtherDomain(12, publishers=("/sensor",), subscriptions=("/display",))
LISTENS = sub(matched=0)
UNHEARD = (spoke(), heard(number=0))
TWO = scene(pub(), pub(), sub(), twins=("/sensor",), beats=(spoke(), heard()))
NO_TIME = scene(
    pub(), sub(), beats=(spoke(number=0, watched=0), heard(number=0, since=0)), now_ns=0
)
BUSY = silent(Condition("/busy", "blocked", callback="work"))


def lost(number):
    beats = (spoke(number=number, rate=0.0), heard(number=0, missed=number, since=0))
    return scene(pub(), sub(), beats=beats)


def unrun(state):
    return silent(Condition("/sensor", state, callback="publish"))


SLEEPS = Unreturned("/sensor", "act", seconds(3), "sleep", seconds(1003))


def late(held=SLEEPS, behind=6, **more):
    """A monitor that has not got its newest messages."""
    more = {"behind_ns": seconds(6), "newest": 9, "arrived": 3, **more}
    beat = heard(3, last=3.0, since=9, behind=behind, held=held, **more)
    return scene(pub(), sub(), beats=(spoke(), beat))


def clash(offered=None, asked=None):
    return scene(pub(qos=offered, matched=0), sub(qos=asked, matched=0), beats=UNHEARD)


#: What is seen, all causes in their order, and what the text says, each part of it.
CASES = {
    # One side is missing, or the two do not fit.
    "nobody publishes": (
        scene(sub(), pub("/other", "/humidity"), beats=[heard(number=0, since=0)]), "no-publisher",
        ["No node publishes on /temperature.", "/monitor subscribes to it",
         "with `ros.add(...)`, and",
         "Topics with a publisher: /humidity."]),
    "with a domain": (scene(sub(), domain_id=7), "no-publisher", ["or in a terminal"]),
    "from a terminal": (elsewhere(scene(sub())), "no-publisher", ["with `ros2 run`"]),
    "nobody subscribes": (scene(pub(matched=0), beats=[spoke()]), "no-subscription",
        ["No node subscribes to /temperature."]),
    "a listener that is not shown": (scene(pub(matched=1), beats=[spoke()]), "", []),
    "nobody uses it": (scene(pub("/a", "/humidity"), sub("/b", "/humidity")), "topic-unknown",
        ["No node uses /temperature.", "Topics in use: /humidity."]),
    "an empty graph": (scene(), "topic-unknown", ["Topics in use: none."]),
    "a misspelt topic": (scene(pub(topic="/temprature", matched=0), LISTENS), "topic-misspelled",
        ["/temprature and /temperature are two different topics.", "one letter"]),
    "a near name with both sides": (
        scene(sub(), pub("/a", "/temperature_2"), sub("/b", "/temperature_2")), "no-publisher", []),
    "another word": (scene(pub(topic="/humidity", matched=0), LISTENS), "no-publisher", []),
    "two types": (
        scene(pub(kind=STRING, matched=0), LISTENS, beats=UNHEARD), "type-mismatch",
        ["/temperature has two message types.",
         "/sensor publishes String, and /monitor subscribes to Float32"]),
    "two types of one name": (
        scene(pub(kind="my_msgs/msg/Float32", matched=0), LISTENS, beats=[spoke()]),
        "type-mismatch", ["publishes my_msgs/msg/Float32"]),
    "another type beside a publisher that is heard": (
        scene(pub(), pub("/other", kind=STRING, matched=0), sub(), beats=[spoke(), heard()]),
        "type-mismatch", ["/other publishes String, and /monitor subscribes to Float32"]),
    "reliability": (clash(SENSOR_DATA), "qos-mismatch",
        ["the reliability of /sensor and /monitor is incompatible.",
         "The rule for reliability: a subscription that asks for"]),
    "durability": (clash(asked=LATCHED), "qos-mismatch",
        ["the durability of /sensor and /monitor is incompatible.", "The rule for durability"]),
    "both policies": (clash(SENSOR_DATA, LATCHED), "qos-mismatch",
        ["reliability and durability of /sensor and /monitor are incompatible."]),
    "one of two publishers fits": (
        scene(pub(qos=SENSOR_DATA, matched=0), pub("/good"), sub(),
              beats=[spoke(), spoke("/good"), heard()]), "qos-mismatch", ["/sensor and /monitor"]),
    "not connected, nobody knows why": (
        scene(pub(matched=0), LISTENS, beats=[spoke(), heard(number=0, since=9)]), UNKNOWN,
        ["/sensor and /monitor are not connected.", "deadline"]),
    "an unknown number of matches": (
        scene(pub(matched=-1), sub(matched=-1), beats=[spoke(), heard()]), "", []),
    # Nodes that do not do their part.
    "has ended": (silent(ended()), "node-ended",
        ["/sensor has ended.", "At 3 s publish raised ZeroDivisionError: division by zero.",
         "Line 5: `1 / 0`"]),
    "ended itself": (
        silent(Condition("/sensor", "ended", callback="publish", cause="shut down")), "node-ended",
        ["/sensor called rclpy.shutdown() in publish, which ended the node."]),
    "ended, and nobody knows how": (
        silent(Condition("/sensor", "ended")), "node-ended", ["how is not known"]),
    "a neighbor raised": (
        silent(replace(ended("/sensor"), callback="act", cause="raised", culprit="/other")),
        "node-ended",
        ["At 3 s publish of /other raised ZeroDivisionError: division by zero.",
         "/sensor ran in the same process, which ended with it.", "the cell that adds the nodes"]),
    "a neighbor shut down": (
        silent(Condition("/sensor", "ended", None, "act", "shut down", "/other")), "node-ended",
        ["act of /other called rclpy.shutdown(), which ends its process. /sensor ran in the same"]),
    "interrupted": (
        silent(Condition("/sensor", "ended", None, "act", "interrupted")), "node-ended",
        ["act was interrupted before it had returned, which ended the node."]),
    "a neighbor was interrupted": (
        silent(Condition("/sensor", "ended", None, "act", "interrupted", "/other")), "node-ended",
        ["act of /other was interrupted", "/sensor ran in the same process"]),
    "paused": (unrun("paused"), "not-spun", ['ros.resume("sensor")']),
    "not added": (unrun("not added"), "not-spun", ["ros.add(...)"]),
    "no answer": (unrun("no answer"), "not-spun", ["rclpy.spin(node)"]),
    "blocked": (unrun("blocked"), "callback-blocks", ["no `time.sleep`"]),
    # Callbacks that have not returned.
    "a publisher's node sleeps": (
        scene(pub(), sub(), beats=(spoke(number=3, last=3.0, held=SLEEPS), heard(3, last=3.0))),
        "callback-blocks",
        ["act of /sensor began at 3 s and has not returned; it sleeps until 1003 s.",
         "it has published no message since 3 s"]),
    "it slept before its first message": (
        scene(pub(), sub(), beats=(spoke(number=0, held=SLEEPS), heard(0, since=0))),
        "callback-blocks", ["it has published no message yet"]),
    "it slept after its only message": (
        scene(pub(), sub(), timers=(timer(1),), beats=(
            spoke(number=1, last=3.0, rate=0.0, held=SLEEPS), heard(1, last=3.0))),
        "callback-blocks", ["no message since 3 s"]),
    "a publisher's node sleeps now and then": (
        scene(pub(), sub(), beats=(spoke(held=SLEEPS), heard())), "", []),
    "a subscriber sleeps": (late(), "callback-blocks",
        ["/monitor hears nothing until then: 6 messages have come since its callback last ran, at "
         "3 s."]),
    "a subscriber waits in a loop": (
        late(replace(SLEEPS, until_ns=seconds(10.5), again=True)), "callback-blocks",
        ["it sleeps until 10.5 s, and not for the first time."]),
    "a response that cannot come": (
        late(replace(SLEEPS, waits_for="a response from /add", until_ns=None, in_vain="which is")),
        "callback-blocks",
        ["it waits for a response from /add, which is. /monitor", "a callback group of its own"]),
    "a response that comes late": (
        late(replace(SLEEPS, waits_for="a response from /add", until_ns=seconds(20))),
        "callback-blocks", ["it waits for a response from /add, until 20 s at most."]),
    "nobody knows what it waits for": (
        late(replace(SLEEPS, since_ns=-1, waits_for="", until_ns=None)), "callback-blocks",
        ["act of /sensor has not returned. /monitor hears"]),
    "a main that does not spin": (late(replace(SLEEPS, is_main=True)), "not-spun",
        ["The main function of its program has waited since 3 s; it sleeps until 1003 s."]),
    "a main that spins others": (
        late(replace(SLEEPS, is_main=True, waits_for="spin", until_ns=None)), "not-spun",
        ["The main function of its program has spun since 3 s, but not this node."]),
    "none has returned": (
        scene(pub(), sub(), beats=(
            spoke(number=1), heard(1, since=1, running=1, held=SLEEPS))),
        "callback-blocks", ["None of the calls of /monitor's callback has returned."]),
    "a message has only just come": (
        late(behind=1, behind_ns=seconds(0.5), newest=10, arrived=9), "", []),
    "one has waited for long": (
        late(behind=1, behind_ns=seconds(5), newest=1, arrived=0), "callback-blocks",
        ["1 message has come"]),
    "slow": (late(behind=2, newest=19, arrived=8, waited_ns=seconds(18)), "slow-callback",
        ["/monitor does not keep up with the messages.",
         "Of the 19 newest messages, 8 have reached the callback of /monitor.",
         "its queue, which holds 10, or wait there. Meanwhile, callbacks of its process waited"]),
    "paused for a while": (
        late(held=None, behind=0, newest=20, arrived=5, at_once=1), "slow-callback", ["paused"]),
    "a burst": (
        late(held=None, behind=0, newest=20, arrived=10, at_once=10), "",
        ["All is well on /temperature: of the 20 newest messages, 10 arrived at /monitor."]),
    "nobody knows why it is late": (
        late(held=None, newest=6, arrived=0), UNKNOWN, ["6 messages were published"]),
    "live, it hears nothing of other processes": (
        replace(late(held=None, behind=0, newest=0, unheard=5), virtual=False), UNKNOWN,
        ["5 messages were published"]),
    "live, a callback keeps it from hearing them": (
        replace(late(behind=0, newest=0, unheard=5), virtual=False), "callback-blocks",
        ["5 messages have come"]),
    "in virtual time, nothing comes from other processes": (
        scene(pub(), sub(), own={"/monitor"}, beats=(spoke(), heard(2, last=1.0))), "not-spun",
        ["/sensor publishes in another process", "ros.start()"]),
    "in virtual time, it has only just come": (
        scene(pub(), sub(), own={"/monitor"}, beats=(spoke(), heard(2, last=10.0))), "", []),
    "a listener of another process": (
        elsewhere(well()), "", ["1 message a second is sent to /monitor."]),
    "listeners of another process, and no rate": (
        elsewhere(scene(pub(), sub(), beats=(spoke(rate=0.0),))), "",
        ["10 messages were sent to /monitor so far."]),
    "who blocks need not be on the topic": (
        replace(BUSY, own=BUSY.own | {"/busy"}, virtual=False), "callback-blocks",
        ["neither does any other node of the session"]),
    "a publisher in a loop of its own": (
        elsewhere(well(conditions=(Condition("/sensor", "no answer"),))), "", []),
    "a monitor that does not answer": (
        elsewhere(well(conditions=(Condition("/monitor", "no answer"),))), "not-spun", []),
    "a node elsewhere": (well(conditions=(ended("/other"),)), "", []),
    "no time has passed": (NO_TIME, "not-spun", ["no time has passed", "ros.run"]),
    "no time has passed, live": (replace(NO_TIME, virtual=False), "never-published", []),
    "waiting for the next run": (
        scene(pub(), sub(), now_ns=0, waiting=True, beats=(
            spoke(number=1, last=0, rate=0.0, watched=0), heard(number=0, since=1))),
        "not-spun", []),
    "no timer": (silent(), "never-published",
        ["/sensor has not published anything.", "The node has no timer"]),
    "a timer that ran": (silent(timers=(timer(calls=10),)), "never-published",
        ["publish_temperature ran 10 times", "reaches its call of `publish`"]),
    "a slow timer": (silent(timers=(timer(period=60.0),)), "never-published",
        ["a period of 60 s and has not fired", "more time pass than 60 s"]),
    "a timer that did not": (silent(timers=(timer(),)), "never-published",
        ["a period of 1 s and has not fired", "cancels"]),
    "a silent publisher of another process": (elsewhere(silent()), "never-published",
        ["published no message in 10 s", "--seconds 30"]),
    "has stopped": (
        scene(pub(), sub(), beats=(spoke(number=4, last=4.0), heard(number=4, last=4.0))),
        "gone-quiet", ["/sensor has stopped publishing.",
                       "4 messages, the last one at 4 s, and nothing in the 6 s since"]),
    "a slow one": (
        scene(pub(), sub(), beats=(spoke(number=2, last=6.0, rate=0.25), heard(number=2))), "", []),
    "only once": (
        scene(pub(), sub(), beats=(spoke(number=1, last=1.0, rate=0.0), heard(number=1))), "", []),
    "two nodes of one name": (TWO, "run-twice",
        ["2 nodes are called /sensor.", "each of them publishes"]),
    "two monitors of one name": (
        scene(pub(), sub(), sub(), twins=("/monitor",), beats=(spoke(), heard())), "run-twice",
        ["each of them receives every message"]),
    "another of that name, not on the topic": (
        scene(pub(), sub(), twins=("/sensor",), beats=(spoke(), heard())), "", []),
    "two publishers of one node": (scene(pub(), pub(), sub(), beats=(spoke(), heard())), "", []),
    "the first is lost": (lost(1), "first-messages-lost",
        ["The only message was", "TRANSIENT_LOCAL"]),
    "the first five are lost": (lost(5), "first-messages-lost", ["All 5 messages were"]),
    "messages that nobody can account for": (
        scene(pub(), sub(), beats=(spoke(), heard(number=0, since=3))), UNKNOWN,
        ["the cause is unknown."]),
    # Live, a message or two may be on their way.
    "on their way": (
        scene(pub(), sub(), beats=(spoke(), heard(number=0, since=2)), virtual=False), "", []),
    "messages that could not be counted": (elsewhere(scene(pub(), sub())), UNKNOWN,
        ["ros2 topic echo /temperature"]),
    # Other domains, and builds.
    "in another domain": (
        elsewhere(scene(sub(), other_domains=(OTHER,))), "other-domain no-publisher",
        ["In ROS domain 12, /sensor publishes on /temperature; this is domain 7.", "ROS_DOMAIN_ID",
         "Also: no node publishes on /temperature."]),
    "both sides in another domain": (
        elsewhere(scene(other_domains=(OTHER,))), "other-domain topic-unknown",
        ["/display subscribes to"]),
    "another domain, and all is well": (well(other_domains=(OTHER,)), "", []),
    "another domain, and nothing is missing": (
        silent(other_domains=(OTHER,)), "never-published", []),
    "an empty domain": (scene(sub(), other_domains=(OtherDomain(12),)), "no-publisher", []),
    "private sessions": (
        scene(sub(), private_sessions=True), "no-publisher",
        ["Pages on this machine have private sessions", "Session(domain_id=...)"]),
    "an old build": (
        elsewhere(scene(sub(), stale_builds=(BUILD,))), "not-rebuilt no-publisher",
        ["ros2 run sensor_simulator temperature_publisher", "colcon build"]),
    "no build": (
        elsewhere(scene(sub(), stale_builds=(replace(BUILD, built=False),))),
        "not-built no-publisher", []),
    "an old build, and all is well": (well(stale_builds=(BUILD,)), "",
        ["Note: temperature_publisher was edited"]),
    "a silent publisher may be an old build": (
        elsewhere(scene(pub(), sub(), stale_builds=(BUILD,))), f"not-rebuilt {UNKNOWN}", []),
    "several publishers add up": (
        scene(pub(), pub("/other"), sub(), beats=(spoke(), spoke("/other", rate=3.0), heard())),
        "", ["4 messages a second arrive at /monitor"]),
    "no rate": (
        scene(pub(), sub(), beats=(spoke(rate=0.0), heard())), "",
        ["10 messages arrived at /monitor so far"]),
    "who listens is not shown": (scene(pub(), beats=(spoke(),)), "", ["not shown here"]),
}  # fmt: skip


def causes(told):
    return [one.mistake for one in explain(TOPIC, told).diagnoses]


def in_a_line(found):
    return " ".join(str(found).split())


@pytest.mark.parametrize("case", CASES)
def test_the_causes_and_what_is_said(case):
    told, mistakes, parts = CASES[case]
    found = explain(TOPIC, told)
    assert causes(told) == mistakes.split()
    for part in parts:
        assert part in in_a_line(found)
    assert found.verdict == (causes(told)[0] if found.diagnoses else WELL)
    assert found.is_well == (found.verdict == WELL)
    assert len(found.headlines) == max(1, len(found.diagnoses))
    assert all(one.evidence and one.hint for one in found.diagnoses)
    assert found == explain(TOPIC, told)
    assert max(map(len, str(found).splitlines())) <= 100


@pytest.mark.parametrize(
    ("case", "topic", "marks"),
    [
        ("nobody uses it", TOPIC, [("topic", TOPIC, "", None)]),
        ("a misspelt topic", TOPIC, [("near", "/temprature", TOPIC, None)]),
        ("a misspelt topic", "/temprature", [("near", "/temprature", TOPIC, None)]),
        ("two types", TOPIC, [(None, None, None, ("sends String", "expects Float32"))]),
        ("another type beside a publisher that is heard", TOPIC,
         [(None, None, None, ("sends String", "expects Float32"))]),
        ("reliability", TOPIC,
         [(None, "/monitor", None, ("offers BEST_EFFORT", "requests RELIABLE"))]),
        ("durability", TOPIC,
         [(None, "/monitor", None, ("offers VOLATILE", "requests TRANSIENT_LOCAL"))]),
        ("both policies", TOPIC, [(None, None, None,
         ("offers BEST_EFFORT and VOLATILE", "requests RELIABLE and TRANSIENT_LOCAL"))]),
        ("one of two publishers fits", TOPIC, [(None, "/sensor", None, None)]),
        ("has ended", TOPIC, [("node", "/sensor", None, None)]),
        *((state, TOPIC, [("node", "/sensor", None, None)]) for state in
          ("paused", "not added", "no answer", "blocked")),
    ],
)  # fmt: skip
def test_marks_for_the_picture(case, topic, marks):
    found = explain(topic, CASES[case][0]).marks
    assert len(found) == len(marks)
    for mark, wanted in zip(found, marks, strict=True):
        given = (mark.kind, mark.subject, mark.other, mark.words)
        assert all(want in (None, have) for want, have in zip(wanted, given, strict=True)), mark


def test_the_question_itself_is_misspelt():
    found = explain("/temprature", well())
    assert found.verdict == "topic-unknown"
    assert "Did you mean /temperature?" in found.diagnoses[0].hint
    assert [mark.kind for mark in found.marks] == ["topic", "near"]


@pytest.mark.parametrize(
    ("told", "lines"),
    [
        (scene(pub(), sub(), beats=(spoke(), heard(missed=2))), (
            "/sensor publishes Float32 (RELIABLE, VOLATILE, depth 10): 10 messages, 1 message a "
            "second, the last at 10 s.",
            "/monitor subscribes to Float32 (RELIABLE, VOLATILE, depth 10): its callback ran 10 "
            "times, the last at 10 s; 2 messages had been published before.")),
        (elsewhere(scene(pub(qos=QoS(depth=0)), sub(qos=QoS(depth=0)), arriving_hz=4.0)), (
            "/sensor publishes Float32 (RELIABLE, VOLATILE).",
            "/monitor subscribes to Float32 (RELIABLE, VOLATILE).",
            "In total, 4 messages a second arrive from other processes.")),
        (scene(pub(), sub(), beats=(Beat("/sensor", "publisher", 0, watched_ns=seconds(3)),
                                    heard(number=0, since=0))), (
            "/sensor publishes Float32 (RELIABLE, VOLATILE, depth 10): no messages in 3 s.",
            "/monitor subscribes to Float32 (RELIABLE, VOLATILE, depth 10): its callback has not "
            "run.")),
    ],
)  # fmt: skip
def test_who_is_there_and_what_each_has_done(told, lines):
    assert report(sides_of(TOPIC, told.graph), told) == lines


@pytest.mark.parametrize(
    ("times", "rate"),
    [([], 0), ([5], 0), ([5, 5], 0), ([0, 10**9], 1), ([0, 10**9 // 4, 10**9 // 2], 4)],
)
def test_rates(times, rate):
    assert rate_of(times) == rate


# All causes together: which comes first, and how it is shown.

#: A scene for every verdict.
SCENES = {((told and causes(told)) or [WELL])[0]: told for told, *_ in CASES.values()}


def test_every_verdict_is_a_mistake_with_a_name_and_is_tried_here():
    assert set(SCENES) == {*silence._ORDER, WELL}
    assert set(silence._ORDER) <= {*MISTAKES, UNKNOWN}


def test_the_text():
    assert str(explain(TOPIC, scene(sub()))).splitlines() == [
        "\N{BALLOT X} No node publishes on /temperature.",
        "  Seen: /monitor subscribes to it, but no node publishes. Topics with a publisher: none.",
        "  Hint: Start the node that publishes, with `ros.add(...)`, and compare the topic name in "
        "its",
        "        `create_publisher`.",
        "  - /monitor subscribes to Float32 (RELIABLE, VOLATILE, depth 10).",
    ]
    found = explain(TOPIC, well())
    assert repr(found) == str(found)
    assert str(found).startswith(
        "\N{CHECK MARK} All is well on /temperature: 1 message a second arrives at /monitor.\n"
    )
    with pytest.raises(FrozenInstanceError):
        found.verdict = "other"


@pytest.mark.parametrize("verdict", SCENES)
def test_the_html_says_the_same_and_takes_the_readers_colours(verdict):
    found = explain(TOPIC, SCENES[verdict])
    html = found._repr_html_()
    assert "background" not in html
    assert ";color:" not in html
    words = Parsed(html).text
    shown = [found.title, *found.headlines[1:], *found.sentences]
    shown += [text for one in found.diagnoses for text in (one.evidence, one.hint)]
    for text in shown:
        assert text.replace("`", "") in words
    assert "`" not in words
    assert html.count("<code>") == sum(text.count("`") for text in shown) / 2


def test_what_a_learner_typed_does_not_become_markup():
    evil = Condition("/monitor", "ended", replace(ended().fault, text="<script>alert(1)</script>"))
    html = explain(TOPIC, silent(evil))._repr_html_()
    assert "<script>" not in html
    assert "&lt;script&gt;" in html
