"""07a, a system of strangers: right and wrong findings."""

from bank.answer import edited, either, right, wrong

BASE = """
    def findings():
        return {
            "publisher of /moisture": "/soil_probe",
            "type of /moisture": "std_msgs/msg/Int32",
            "messages a second on /moisture": 5,
            "queue depth of /gardener for /moisture": 3,
            "topic without a listener": "/lights",
            "topic without a publisher": "/light",
            "node that warns": "/lamp",
            "dry_below of /gardener": 35,
        }
"""
_PUBLISHER, _TYPE = '"/soil_probe"', '"std_msgs/msg/Int32"'
_RATE, _DEPTH = 'second on /moisture": 5', 'for /moisture": 3'
_UNHEARD, _UNSPOKEN = '"/lights"', '"/light"'
_WARNS, _DRY = '"/lamp"', "35"

SECRETS = ("soil_probe", "msg/Int32", "/lights", "/lamp", "35")


def _right(name, *edits):
    return right("07a", name, edited(BASE, *edits))


def _wrong(name, mistake, *edits):
    return wrong("07a", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("07a", name, mistakes, edited(BASE, *edits))


def _rate(value):
    return _RATE, f'second on /moisture": {value}'


def _depth(value):
    return _DEPTH, f'for /moisture": {value}'


RIGHT = (
    _right("as on the page"),
    _right("names without a slash", (_PUBLISHER, '"soil_probe"'), (_UNHEARD, '"lights"'),
           (_UNSPOKEN, '"light"'), (_WARNS, '"lamp"')),
    _right("what hz printed", _rate("4.998")),
    _right("a little more than hz should print", _rate("5.2")),
    _right("numbers as decimals", _rate("5.0"), _depth("3.0"), (_DRY, "35.0")),
    _right("numbers in quotes", _rate('"5"'), _depth('"3"'), (_DRY, '"35"')),
    _right("a type as Python writes it", (_TYPE, '"std_msgs.msg.Int32"')),
    _right("blanks around a name", (_WARNS, '" /lamp "'), (_TYPE, '" std_msgs/msg/Int32"')),
    _right("calculated", _rate("1 / 0.2"), (_DRY, "30 + 5")),
    _right("one more key", ('"node that warns"', '"my note": "nice",\n        "node that warns"')),
    right("07a", "step by step", '''
        def findings():
            found = {}
            found["publisher of /moisture"] = "/soil_probe"
            found["type of /moisture"] = "std_msgs/msg/Int32"
            found["messages a second on /moisture"] = 5
            found["queue depth of /gardener for /moisture"] = 3
            found["topic without a listener"] = "/lights"
            found["topic without a publisher"] = "/light"
            found["node that warns"] = "/lamp"
            found["dry_below of /gardener"] = 35
            return found
    '''),
    right("07a", "keys and values", '''
        KEYS = (
            "publisher of /moisture", "type of /moisture", "messages a second on /moisture",
            "queue depth of /gardener for /moisture", "topic without a listener",
            "topic without a publisher", "node that warns", "dry_below of /gardener",
        )

        def findings():
            values = ["/soil_probe", "std_msgs/msg/Int32", 5, 3, "/lights", "/light", "/lamp", 35]
            return dict(zip(KEYS, values, strict=True))
    '''),
    right("07a", "a session is asked", '''
        from rosbeat.scenarios.stranger import greenhouse

        def findings():
            with Session() as own:
                greenhouse(own)
                own.run(seconds=10, quiet=True)
                graph, heard = own.graph(), own.messages("moisture")
                (publisher,) = graph.on("/moisture", "publisher")
                (listener,) = graph.on("/moisture", "subscription")
                sides = {
                    name: [bool(graph.on(name, kind)) for kind in ("publisher", "subscription")]
                    for name in graph.topics()
                }
                (gardener,) = [one for one in own.nodes if one.get_name() == "gardener"]
                return {
                    "publisher of /moisture": publisher.node,
                    "type of /moisture": publisher.type_name,
                    "messages a second on /moisture": len(heard) / 10,
                    "queue depth of /gardener for /moisture": listener.qos.depth,
                    "topic without a listener": next(n for n in sides if not sides[n][1]),
                    "topic without a publisher": next(n for n in sides if not sides[n][0]),
                    "node that warns": {x.name for x in own.logs() if x.level == "WARN"}.pop(),
                    "dry_below of /gardener": gardener.get_parameter("dry_below").value,
                }
    '''),
)  # fmt: skip

WRONG = (
    _wrong("the listener", "sides-confused", (_PUBLISHER, '"/gardener"')),
    _wrong("a bystander", "finding-wrong", (_PUBLISHER, '"/weather"')),
    _wrong("the topic itself", "other-kind", (_PUBLISHER, '"/moisture"')),
    _wrong("the executable's style of a name", "not-in-graph", (_PUBLISHER, '"soil-probe"')),
    _wrong("a letter wrong", "not-in-graph", (_PUBLISHER, '"/soil_prob"')),
    _wrong("a capital", "not-in-graph", (_WARNS, '"/Lamp"')),
    _wrong("a list of publishers", "other-kind", (_PUBLISHER, '["/soil_probe"]')),
    _wrong("half a type", "name-incomplete", (_TYPE, '"Int32"')),
    _wrong("a type without msg", "name-incomplete", (_TYPE, '"std_msgs/Int32"')),
    _wrong("another type of the greenhouse", "finding-wrong", (_TYPE, '"std_msgs/msg/Float32"')),
    _wrong("a type that nobody uses", "finding-wrong", (_TYPE, '"std_msgs/msg/Int64"')),
    _wrong("a period", "period-for-rate", _rate("0.2")),
    _wrong("another topic's rate", "finding-wrong", _rate("2")),
    _wrong("a rate out of the air", "finding-wrong", _rate("10")),
    _wrong("no messages", "finding-wrong", _rate("0")),
    _wrong("a rate with its unit", "other-kind", _rate('"5 Hz"')),
    _wrong("a rate in words", "other-kind", _rate('"five"')),
    _wrong("yes for a number", "other-kind", _rate("True")),
    _wrong("the publisher's depth", "sides-confused", _depth("10")),
    _wrong("a depth guessed", "finding-wrong", _depth("1")),
    _wrong("what the terminal says", "other-kind", _depth('"UNKNOWN"')),
    _wrong("not a number", "finding-wrong", _depth('float("nan")')),
    _wrong("the topic of the other side", "sides-confused", (_UNHEARD, '"/light "')),
    _wrong("a topic that is heard", "finding-wrong", (_UNHEARD, '"/moisture"')),
    _wrong("the log's topic", "finding-wrong", (_UNHEARD, '"/rosout"')),
    _wrong("the deaf node", "other-kind", (_UNSPOKEN, '"/lamp "')),
    _wrong("the topic that nobody hears", "sides-confused", (_UNSPOKEN, '"/lights "')),
    _wrong("a topic with both sides", "finding-wrong", (_UNSPOKEN, '"/watering"')),
    _wrong("a topic that is not there", "not-in-graph", (_UNSPOKEN, '"/dark"')),
    _wrong("who logs", "finding-wrong", (_WARNS, '"/gardener"')),
    _wrong("who is silent", "finding-wrong", (_WARNS, '"/weather"')),
    _wrong("the text of the warning", "not-in-graph",
           (_WARNS, '"I do not know how bright it is"')),
    _wrong("the node of the other page", "not-in-graph", (_WARNS, '"/temperature_sensor"')),
    _wrong("the other parameter", "finding-wrong", (_DRY, "25.0")),
    _wrong("a value near by", "finding-wrong", (_DRY, "34")),
    _wrong("all that param get printed", "other-kind", (_DRY, '"Integer value is: 35"')),
    _wrong("a key renamed", "finding-missing", ('"node that warns"', '"who warns"')),
    _wrong("a key left out", "finding-missing", ('"node that warns": "/lamp",', "")),
    _wrong("no quotes", "name-error", (_WARNS, "lamp")),
    _wrong("printed", "returns-nothing", ("return {", "print({"), ("35,\n    }", "35,\n    })")),
    _wrong("a set", "not-plain", (_WARNS, '{"/lamp"}')),
    wrong("07a", "a list of values", "other-kind", '''
        def findings():
            return ["/soil_probe", "std_msgs/msg/Int32", 5, 3, "/lights", "/light", "/lamp", 35]
    '''),
    wrong("07a", "called", "no-function", BASE, handed="findings()"),
    _either("both one-sided topics swapped", ("sides-confused",),
            (_UNHEARD, '"/light "'), (_UNSPOKEN, '"/lights "')),
    _either("a period and half a type", ("period-for-rate", "name-incomplete"),
            _rate("0.2"), (_TYPE, '"Int32"')),
    _either("the listener, and another value", ("sides-confused", "finding-wrong"),
            (_PUBLISHER, '"/gardener"'), (_DRY, "25")),
    _either("a node for a topic, a topic for a node", ("other-kind", "not-in-graph"),
            (_UNSPOKEN, '"/window"'), (_WARNS, '"/window_state"')),
    _either("everything off by one line", ("other-kind", "not-in-graph"),
            (_PUBLISHER, _TYPE + " "), (_WARNS, "35.5")),
)  # fmt: skip

#: Written from the page alone.
FRESH = (
    right("07a", "an object that is called", """
        class Findings:
            def __init__(self, **words):
                self.words = words

            def __call__(self):
                return {key.replace("__", " /").replace("_", " "): value
                        for key, value in self.words.items()} | {
                    "messages a second on /moisture": round(4.98),
                    "queue depth of /gardener for /moisture": len("abc"),
                    "dry_below of /gardener": int("35"),
                }

        findings = Findings(
            publisher_of__moisture="soil_probe", type_of__moisture="std_msgs/msg/Int32",
            topic_without_a_listener="lights", topic_without_a_publisher="light",
            node_that_warns="lamp",
        )
    """, handed="findings"),
    right("07a", "enumerations", """
        from enum import IntEnum, StrEnum

        class Who(StrEnum):
            SENDS = "/soil_probe"
            WARNS = "/lamp"

        class Number(IntEnum):
            RATE = 5
            DEPTH = 3
            DRY = 35

        def findings():
            return {
                "publisher of /moisture": Who.SENDS,
                "type of /moisture": "/".join(("std_msgs", "msg", "Int32")),
                "messages a second on /moisture": Number.RATE,
                "queue depth of /gardener for /moisture": Number.DEPTH,
                "topic without a listener": "/lights",
                "topic without a publisher": "/lights"[:-1],
                "node that warns": Who.WARNS,
                "dry_below of /gardener": Number.DRY,
            }
    """),
    right("07a", "numbers of numpy", """
        import numpy as np

        def findings():
            times = np.arange(0.2, 10.0, 0.2)
            return {
                "publisher of /moisture": "/soil_probe",
                "type of /moisture": "std_msgs/msg/Int32",
                "messages a second on /moisture": 1 / np.diff(times).mean(),
                "queue depth of /gardener for /moisture": 3,
                "topic without a listener": "/lights",
                "topic without a publisher": "/light",
                "node that warns": "/lamp",
                "dry_below of /gardener": np.float64(35),
            }
    """),
    right("07a", "a partial function", edited(
        BASE, ("def findings():", "from functools import partial\n\ndef notes(dry):"),
        (_DRY, "dry"),
        ("    }\n", "    }\n\nfindings = partial(notes, dry=35)\n")), handed="findings"),
    right("07a", "an ordered dict, and keys to spare", """
        from collections import OrderedDict

        def findings():
            found = OrderedDict(question="what is there?")
            for line in (
                "publisher of /moisture = /soil_probe", "type of /moisture = std_msgs/msg/Int32",
                "messages a second on /moisture = 4.95",
                "queue depth of /gardener for /moisture = 3", "topic without a listener = /lights",
                "topic without a publisher = /light", "node that warns = /lamp",
                "dry_below of /gardener = 35",
            ):
                key, _, value = line.partition(" = ")
                found[key] = value
            return found
    """),
    _wrong("a type in brackets", "stray-characters", (_TYPE, '"[std_msgs/msg/Int32]"')),
    _wrong("a type in capitals", "finding-wrong", (_TYPE, '"std_msgs/msg/INT32"')),
    _wrong("a class for a type", "not-plain", (_TYPE, "Float32")),
    _wrong("both sides at once", "not-in-graph", (_PUBLISHER, '"/soil_probe, /gardener"')),
    _wrong("a line of hz", "other-kind", _rate('"average rate: 5.000"')),
    _wrong("the topic of log lines", "other-kind", (_WARNS, '"/rosout"')),
    _wrong("a wish to know", "raised", ("def findings():", "def findings(ros):")),
    _wrong("a generator", "not-plain", ("return {", "yield {")),
    _wrong("a text of all", "other-kind", ("return {", "return str({"), ("    }\n", "    })\n")),
    _wrong("a key with a capital", "finding-missing", ('"node that', '"Node that')),
    _either("one topic for both", ("sides-confused",), (_UNHEARD, '"/light"')),
)  # fmt: skip

ANSWERS = (*RIGHT, *WRONG, *FRESH)
