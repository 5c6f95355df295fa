"""Answers to the exercises of page 10."""

from bank.answer import Answer, edited, either, right, wrong

#: What a learner has to find, in pieces that no hint may hold; spaces do not count.
SECRETS: dict[str, tuple[str, ...]] = {
    "10a": ("topic-misspelled", "first-messages-lost", "node-ended", "not-spun"),
    "10b": ("wrong-unit", "wrong-topic", "two-sources", "no-clamp"),
    "10c": ("depth-too-small", "wrong-unit", "topic-misspelled", "qos-mismatch", "wrong-rate"),
}

_A = """
    def diagnoses():
        return {
            1: ("topic-misspelled", "/hall_Temperature"),
            2: ("first-messages-lost", "/cellar_rule"),
            3: ("node-ended", "/shelf_sensor"),
            4: ("not-spun", "/booth_probe"),
        }
"""
_B = """
    def diagnoses():
        return {
            5: ("wrong-unit", "/leaf_sensor"),
            6: ("wrong-topic", "/water_guard"),
            7: ("two-sources", "/milk_temperature"),
            8: ("no-clamp", "/pool_sensor"),
        }
"""
_C = """
    def diagnoses():
        return {
            9: [("depth-too-small", "/rack_diary"), ("wrong-unit", "/rack_probe")],
            10: [("topic-misspelled", "/stall_logger"), ("qos-mismatch", "/stall_status")],
            11: [("wrong-rate", "/comb_thermometer"), ("node-ended", "/comb_logger")],
        }
"""
_TEXTS = {"10a": _A, "10b": _B, "10c": _C}


def _right(exercise: str, name: str, *edits: tuple[str, str]) -> Answer:
    return right(exercise, name, edited(_TEXTS[exercise], *edits))


def _wrong(exercise: str, name: str, mistake: str, *edits: tuple[str, str]) -> Answer:
    return wrong(exercise, name, mistake, edited(_TEXTS[exercise], *edits))


def _either(exercise: str, name: str, both: tuple[str, ...], *edits: tuple[str, str]) -> Answer:
    return either(exercise, name, both, edited(_TEXTS[exercise], *edits))


_SILENT = (
    # Right.
    _right("10a", "as on the page"),
    _right("10a", "without slashes", ('"/', '"')),
    _right("10a", "the other end of each fault", ("hall_Temperature", "hall_notebook"),
           ("cellar_rule", "cellar_plate")),
    _right("10a", "lists of one pair", ("(", "[("), ("),", ")],"), ("[()", "()")),
    _right("10a", "lists instead of pairs", ('("', '["'), ('"),', '"],')),
    _right("10a", "blanks around", ('"not-spun"', '" not-spun "')),
    _right("10a", "the ward by its number", ("1: (", '"ward": 7, 1: (')),
    right("10a", "another ward", '''
        def diagnoses():
            return {
                "ward": 8,
                1: ("gone-quiet", "/dough_monitor"),
                2: ("not-spun", "/hall_diary"),
                3: ("topic-misspelled", "/shelf_statuss"),
                4: ("node-ended", "/cellar_watch"),
            }
    '''),
    right("10a", "put together", '''
        FOUND = ["topic-misspelled", "first-messages-lost", "node-ended", "not-spun"]
        PLACES = ["/hall_Temperature", "/cellar_plate", "/shelf_sensor", "/booth_probe"]

        def diagnoses():
            found = {}
            for number, pair in enumerate(zip(FOUND, PLACES), start=1):
                found[number] = pair
            return found
    '''),
    right("10a", "with an instrument in it", '''
        from rosbeat import clinic

        def diagnoses():
            ros = clinic.Ward(seed=7).patient(3).ros
            ended = ros.observation().faults[0].node
            return {
                1: ("topic-misspelled", "/hall_notebook"),
                2: ("first-messages-lost", "/cellar_rules"),
                3: (ros.explain("shelf_temperature").verdict, ended),
                4: ("not-spun", "/booth_probe"),
            }
    '''),
    # One mistake.
    _wrong("10a", "silence is quality of service", "contradicted",
           ("topic-misspelled", "qos-mismatch")),
    _wrong("10a", "the namespace", "contradicted", ("topic-misspelled", "wrong-namespace")),
    _wrong("10a", "the node that has not got anything is blocked", "contradicted",
           ('"topic-misspelled", "/hall_Temperature"', '"callback-blocks", "/hall_notebook"')),
    _wrong("10a", "never spun instead of late", "contradicted",
           ('"first-messages-lost", "/cellar_rule"', '"not-spun", "/cellar_plate"')),
    _wrong("10a", "never published instead of late", "contradicted",
           ('"first-messages-lost"', '"never-published"')),
    _wrong("10a", "once is not gone quiet", "contradicted",
           ('"first-messages-lost", "/cellar_rule"', '"gone-quiet", "/cellar_rules"')),
    _wrong("10a", "a name that nobody uses is no other topic", "contradicted",
           ("topic-misspelled", "wrong-topic")),
    _wrong("10a", "gone quiet instead of ended", "contradicted", ("node-ended", "gone-quiet")),
    _wrong("10a", "where it hurts: the display", "other-place", ("shelf_sensor", "shelf_display")),
    _wrong("10a", "where it hurts: the watch", "contradicted",
           ('"node-ended", "/shelf_sensor"', '"gone-quiet", "/shelf_watch"')),
    _wrong("10a", "the listener is not spun", "other-place", ("booth_probe", "booth_panel")),
    _wrong("10a", "the monitor never published", "contradicted",
           ('"not-spun", "/booth_probe"', '"never-published", "/booth_monitor"')),
    _wrong("10a", "twins", "contradicted", ("not-spun", "run-twice")),
    _wrong("10a", "the right name is not the wrong one", "other-place",
           ("hall_Temperature", "hall_temperature")),
    _wrong("10a", "an id with a letter wrong", "no-such-diagnosis", ("not-spun", "not-spinned")),
    _wrong("10a", "a sentence", "no-such-diagnosis", ("not-spun", "nobody runs it")),
    _wrong("10a", "a place with a letter wrong", "no-such-place", ("booth_probe", "booth_prob")),
    _wrong("10a", "a place of another patient", "no-such-place", ("booth_probe", "hall_sensor")),
    _wrong("10a", "place first", "arguments-swapped",
           ('"not-spun", "/booth_probe"', '"/booth_probe", "not-spun"')),
    _wrong("10a", "one without a place", "no-diagnoses", ('("not-spun", "/booth_probe")',
                                                          '"not-spun"')),
    _wrong("10a", "one is missing", "no-diagnosis-yet",
           ('        4: ("not-spun", "/booth_probe"),\n', "")),
    _wrong("10a", "one is still blank", "no-diagnosis-yet",
           ('"not-spun", "/booth_probe"', '"____", "____"')),
    _wrong("10a", "a patient of another exercise", "no-diagnoses", ("4: (", "5: (")),
    _wrong("10a", "a list", "no-diagnoses", ("{", "list({"), ("}", "}.values())")),
    _wrong("10a", "no return", "returns-nothing", ("return {", "found = {")),
    _wrong("10a", "it prints", "returns-nothing", ("return {", "print({"), ("}", "})")),
    _wrong("10a", "no quotes", "name-error", ('"not-spun"', "not_spun")),
    _wrong("10a", "a ward that is a name", "no-diagnoses", ("1: (", '"ward": "seven", 1: (')),
    wrong("10a", "called at once", "no-function", edited(_A), handed="diagnoses()"),
    wrong("10a", "a set of pairs", "not-plain", '''
        def diagnoses():
            return {("topic-misspelled", "/hall_Temperature")}
    '''),
    wrong("10a", "it waits", "does-not-return", '''
        def diagnoses():
            while True:
                pass
    '''),
    # Two mistakes.
    _either("10a", "two places", ("other-place", "no-such-place"),
            ("shelf_sensor", "shelf_watch"), ("booth_probe", "booth")),
    _either("10a", "two causes", ("contradicted", "no-such-diagnosis"),
            ("topic-misspelled", "type-mismatch"), ("node-ended", "died")),
    _either("10a", "one contradicted, one blank", ("contradicted", "no-diagnosis-yet"),
            ("first-messages-lost", "gone-quiet"),
            ('"not-spun", "/booth_probe"', '"____", "____"')),
)  # fmt: skip

_HEARD = (
    # Right.
    _right("10b", "as on the page"),
    _right("10b", "topics instead of nodes", ("leaf_sensor", "leaf_temperature"),
           ("water_guard", "water_humidity"), ("pool_sensor", "pool_temperature")),
    _right("10b", "the node that nobody ordered", ("milk_temperature", "milk_old_sensor")),
    _right("10b", "without slashes", ('"/', '"')),
    _right("10b", "numbers as texts", ("5:", '"5":'), ("8:", '"8":')),
    _right("10b", "a pair twice", ('("no-clamp", "/pool_sensor")',
                                   '[("no-clamp", "/pool_sensor"), ("no-clamp", "pool_sensor")]')),
    right("10b", "another ward", '''
        def diagnoses():
            return {
                5: ("never-changes", "/hall_thermometer"),
                6: ("two-sources", "/cellar_spare"),
                7: ("clamped-too-early", "/shelf_probe"),
                8: ("no-clamp", "/leaf_temperature"),
                "ward": 12,
            }
    '''),
    right("10b", "a lambda", '''
        diagnoses = lambda: dict(zip(range(5, 9), [
            ("wrong-unit", "/leaf_sensor"), ("wrong-topic", "/water_guard"),
            ("two-sources", "/milk_temperature"), ("no-clamp", "/pool_sensor")]))
    ''', handed="diagnoses"),
    right("10b", "a method", '''
        class Doctor:
            def __init__(self):
                self.notes = {}

            def note(self, number, what, where):
                self.notes[number] = [what, where]
                return self

            def diagnoses(self):
                return self.notes

        doctor = Doctor().note(5, "wrong-unit", "leaf_sensor").note(6, "wrong-topic", "water_guard")
        doctor.note(7, "two-sources", "milk_old_sensor").note(8, "no-clamp", "pool_temperature")
    ''', handed="doctor.diagnoses"),
    # One mistake.
    _wrong("10b", "the clamp instead of the unit", "contradicted", ("wrong-unit", "no-clamp")),
    _wrong("10b", "the boundary instead of the unit", "contradicted",
           ('"wrong-unit", "/leaf_sensor"', '"boundary", "/leaf_guard"')),
    _wrong("10b", "the unit of the wrong node", "other-place", ("leaf_sensor", "leaf_guard")),
    _wrong("10b", "humidity taken for a unit", "contradicted",
           ('"wrong-topic", "/water_guard"', '"wrong-unit", "/water_hygrometer"')),
    _wrong("10b", "a wrong topic is not a misspelled one", "contradicted",
           ("wrong-topic", "topic-misspelled")),
    _wrong("10b", "two sensors are not two sources", "contradicted",
           ('"wrong-topic", "/water_guard"', '"two-sources", "/water_probe"')),
    _wrong("10b", "the topic that was ordered", "other-place",
           ("water_guard", "water_temperature")),
    _wrong("10b", "the rate doubles", "contradicted", ("two-sources", "wrong-rate")),
    _wrong("10b", "twins have one name", "contradicted", ("two-sources", "run-twice")),
    _wrong("10b", "the source that was ordered", "other-place",
           ("milk_temperature", "milk_thermometer")),
    _wrong("10b", "clamped, but too early", "contradicted", ("no-clamp", "clamped-too-early")),
    _wrong("10b", "another unit instead of no clamp", "contradicted", ("no-clamp", "wrong-unit")),
    _wrong("10b", "the diary drops readings", "contradicted",
           ('"no-clamp", "/pool_sensor"', '"depth-too-small", "/pool_diary"')),
    _wrong("10b", "an id in capitals", "no-such-diagnosis", ("no-clamp", "NO-CLAMP")),
    _wrong("10b", "a class for a place", "no-such-place", ("pool_sensor", "Sensor")),
    _wrong("10b", "place first", "arguments-swapped",
           ('"no-clamp", "/pool_sensor"', '"/pool_sensor", "no-clamp"')),
    _wrong("10b", "three texts", "no-diagnoses", ('"/pool_sensor"', '"/pool_sensor", "sure"')),
    _wrong("10b", "patients of another exercise", "no-diagnoses", ("5: (", "1: (")),
    _wrong("10b", "one is None", "no-diagnoses", ('("no-clamp", "/pool_sensor")', "None")),
    _wrong("10b", "one left out", "no-diagnosis-yet", ('"no-clamp", "/pool_sensor"', '"", ""')),
    _wrong("10b", "two for one, and one is wrong", "contradicted",
           ('("no-clamp", "/pool_sensor")',
            '[("no-clamp", "/pool_sensor"), ("boundary", "/pool_watch")]')),
    _wrong("10b", "it raises", "raised", ("return {", "return {}[5] or {")),
    # Two mistakes.
    _either("10b", "two clamps", ("contradicted", "other-place"),
            ("wrong-unit", "no-clamp"), ("pool_sensor", "pool_watch")),
    _either("10b", "a letter, and a place", ("no-such-diagnosis", "other-place"),
            ("two-sources", "two-source"), ("leaf_sensor", "leaf_panel")),
    _either("10b", "one blank, one wrong", ("contradicted", "no-diagnosis-yet"),
            ('"no-clamp", "/pool_sensor"', '"____", "____"'), ("wrong-unit", "never-changes")),
)  # fmt: skip

_DIARY = '("depth-too-small", "/rack_diary")'
_PROBE = '("wrong-unit", "/rack_probe")'

_PAIRS = (
    # Right.
    _right("10c", "as on the page"),
    _right("10c", "the other way round", (f"{_DIARY}, {_PROBE}", f"{_PROBE}, {_DIARY}")),
    _right("10c", "tuples of pairs", ("[", "("), ("]", ")")),
    _right("10c", "other ends", ("/stall_status", "/stall_lamp"),
           ("/stall_logger", "/stall_tepmerature"), ("/comb_thermometer", "/comb_temperature")),
    _right("10c", "one topic, two faults", ("/rack_diary", "/rack_temperature"),
           ("/rack_probe", "/rack_temperature")),
    _right("10c", "without slashes", ('"/', '"')),
    right("10c", "another ward", '''
        def diagnoses():
            return {
                "ward": 12,
                9: [("node-ended", "stage_monitor"), ("wrong-namespace", "upstairs/stage_status")],
                10: [("wrong-namespace", "dough_panel"), ("boundary", "dough_watch")],
                11: [("node-ended", "stall_notebook"), ("wrong-rate", "stall_sensor")],
            }
    '''),
    right("10c", "appended", '''
        from collections import defaultdict

        def diagnoses():
            notes = defaultdict(list)
            notes[9].append(("wrong-unit", "/rack_probe"))
            notes[9].append(("depth-too-small", "/rack_diary"))
            notes[10] += [("qos-mismatch", "/stall_monitor"), ("topic-misspelled", "/stall_logger")]
            notes[11] += [["node-ended", "/comb_logger"], ["wrong-rate", "/comb_temperature"]]
            return notes
    '''),
    # One mistake.
    _wrong("10c", "the first that was found", "half-a-diagnosis", (f"{_DIARY}, {_PROBE}", _PROBE)),
    _wrong("10c", "the first that was found, in a list", "half-a-diagnosis",
           (f", {_PROBE}", "")),
    _wrong("10c", "one of them twice", "half-a-diagnosis",
           (_PROBE, '("depth-too-small", "/rack_temperature")')),
    _wrong("10c", "one of them blank", "half-a-diagnosis", (_PROBE, '("____", "____")')),
    _wrong("10c", "the queue of the monitor", "other-place", ("rack_diary", "rack_monitor")),
    _wrong("10c", "gaps are a wrong rate", "contradicted",
           (_DIARY, '("wrong-rate", "/rack_probe")')),
    _wrong("10c", "no clamp instead of a unit", "contradicted", ("wrong-unit", "no-clamp")),
    _wrong("10c", "both are misspelled", "other-place",
           ('"qos-mismatch", "/stall_status"', '"topic-misspelled", "/stall_lamp"')),
    _wrong("10c", "both do not fit", "other-place",
           ('"topic-misspelled", "/stall_logger"', '"qos-mismatch", "/stall_logger"')),
    _wrong("10c", "the lamp is not spun", "contradicted",
           ('"qos-mismatch", "/stall_status"', '"not-spun", "/stall_lamp"')),
    _wrong("10c", "the monitor is mute", "contradicted",
           ('"qos-mismatch", "/stall_status"', '"never-published", "/stall_monitor"')),
    _wrong("10c", "the logger has a short queue", "contradicted",
           ('"node-ended", "/comb_logger"', '"depth-too-small", "/comb_logger"')),
    _wrong("10c", "the sensor has gone quiet", "contradicted",
           ('"wrong-rate", "/comb_thermometer"', '"gone-quiet", "/comb_thermometer"')),
    _wrong("10c", "the guard has ended", "other-place", ("comb_logger", "comb_guard")),
    _wrong("10c", "a third one", "contradicted",
           (_PROBE, f'{_PROBE}, ("no-clamp", "/rack_probe")')),
    _wrong("10c", "four texts in a row", "no-diagnoses", (_DIARY, _DIARY.strip("()")),
           (_PROBE, _PROBE.strip("()"))),
    _wrong("10c", "a dict of pairs", "no-diagnoses",
           ('[("depth-too-small", "/rack_diary"), ("wrong-unit", "/rack_probe")]',
            '{"depth-too-small": "/rack_diary", "wrong-unit": "/rack_probe"}')),
    _wrong("10c", "a place of another patient", "no-such-place", ("rack_diary", "comb_logger")),
    _wrong("10c", "an id that is a title", "no-such-diagnosis",
           ("wrong-unit", "another unit than asked for")),
    _wrong("10c", "a whole patient left out", "no-diagnosis-yet",
           (f"[{_DIARY}, {_PROBE}]", "[]")),
    # Two mistakes.
    _either("10c", "half, and a wrong one", ("half-a-diagnosis", "contradicted"),
            (f", {_PROBE}", ""), ("qos-mismatch", "type-mismatch")),
    _either("10c", "two places", ("other-place", "no-such-place"),
            ("rack_diary", "rack_panel"), ("stall_logger", "stall_log")),
    _either("10c", "swapped, and half", ("arguments-swapped", "half-a-diagnosis"),
            (_PROBE, '("/rack_probe", "wrong-unit")'), (', ("node-ended", "/comb_logger")', "")),
)  # fmt: skip

#: Written from the page alone.
_FRESH = (
    right("10a", "named tuples", """
        from typing import NamedTuple

        class Diagnosis(NamedTuple):
            what: str
            where: str

        def diagnoses():
            return {
                1: Diagnosis("topic-misspelled", "/hall_notebook"),
                2: Diagnosis(where="/cellar_rules", what="first-messages-lost"),
                3: Diagnosis("node-ended", "shelf_sensor"),
                4: Diagnosis("not-spun", "/booth_probe"),
            }
    """),
    right("10a", "dataclasses, in any order", """
        from dataclasses import astuple, dataclass

        @dataclass(order=True)
        class Note:
            number: int
            what: str
            where: str

        NOTES = [
            Note(4, "not-spun", "/booth_probe"), Note(2, "first-messages-lost", "/cellar_rule"),
            Note(1, "topic-misspelled", "/hall_Temperature"),
            Note(3, "node-ended", "/shelf_sensor"),
        ]

        def diagnoses():
            return {number: pair for number, *pair in map(astuple, sorted(NOTES)[::-1])}
    """),
    right("10a", "a text that is read", """
        TEXT = '''
            1 topic-misspelled /hall_Temperature
            2 first-messages-lost /cellar_plate
            3 node-ended /shelf_sensor
            4 not-spun /booth_probe
        '''

        def diagnoses():
            found = {}
            for line in TEXT.strip().splitlines():
                number, what, where = line.split()
                found[int(number)] = what, where
            return found
    """),
    _right("10a", "a blank second pair", ('("not-spun", "/booth_probe")',
                                          '[("not-spun", "/booth_probe"), ("____", "____")]')),
    right("10b", "an object that is called", """
        class Rounds(dict):
            def __call__(self):
                return dict(self)

        rounds = Rounds()
        rounds[5] = rounds["x"] = "wrong-unit", "/leaf_temperature"
        del rounds["x"]
        rounds.update({
            6: ("wrong-topic", "/water_humidity"),
            7: ("two-sources", "milk_old_sensor"),
            8: ("no-clamp", "/pool_sensor"),
        })
    """, handed="rounds"),
    right("10b", "enumerations and f-strings", """
        from enum import StrEnum

        class Cause(StrEnum):
            UNIT = "wrong-unit"
            TOPIC = "wrong-topic"
            TWO = "two-sources"
            CLAMP = "no-clamp"

        def place(house, part):
            return f"/{house}_{part}"

        def diagnoses():
            return {
                5: (Cause.UNIT, place("leaf", "sensor")),
                6: (Cause.TOPIC, place("water", "guard")),
                7: (Cause.TWO, place("milk", "temperature")),
                8: (Cause.CLAMP, place("pool", "sensor")),
            }
    """),
    right("10c", "one loop for all", """
        FLAT = (
            "depth-too-small", "/rack_diary", "wrong-unit", "/rack_temperature",
            "qos-mismatch", "/stall_monitor", "topic-misspelled", "/stall_logger",
            "node-ended", "/comb_logger", "wrong-rate", "/comb_thermometer",
        )

        def diagnoses():
            pairs = list(zip(FLAT[::2], FLAT[1::2]))
            return {9 + n: pairs[2 * n : 2 * n + 2] for n in range(3)}
    """),
    right("10c", "another ward, from its instruments", """
        from rosbeat import clinic

        def diagnoses():
            ward = clinic.Ward(8)
            (stray,) = [one for one in ward.patient(9).ros.graph().topics() if "stauts" in one]
            return {
                "ward": 8,
                9: [("topic-misspelled", stray), ("never-published", "/stage_guard")],
                10: [("wrong-unit", "/rack_sensor"), ("depth-too-small", "/rack_diary")],
                11: [("qos-mismatch", "/pool_lamp"), ("topic-misspelled", "/pool_logger")],
            }
    """),
    _wrong("10a", "two patients exchanged", "no-such-place", ("3: (", "x: ("), ("4: (", "3: ("),
           ("x: (", "4: (")),
    _wrong("10a", "an id with an underscore", "no-such-diagnosis", ("not-spun", "not_spun")),
    _wrong("10a", "an id in backticks", "no-such-diagnosis", ("not-spun", "`not-spun`")),
    _wrong("10a", "node and topic", "no-such-place",
           ('"/booth_probe"', '"/booth_probe, /booth_temperature"')),
    _wrong("10a", "the topic that is silent", "other-place", ("booth_probe", "booth_temperature")),
    _wrong("10a", "this ward's patients in another", "no-such-place", ("1: (", '"ward": 8, 1: (')),
    _wrong("10a", "a text of JSON", "no-diagnoses",
           ("return {", "import json\n    return json.dumps({"), ("    }\n", "    })\n")),
    _wrong("10a", "a patient that has nothing", "no-diagnoses",
           ('("not-spun", "/booth_probe")', "{}")),
    _wrong("10a", "a number that is no whole one", "no-diagnoses", ("4: (", "4.5: (")),
    _wrong("10b", "a wrong rate, and the right fault", "contradicted",
           ('("two-sources", "/milk_temperature")',
            '[("two-sources", "/milk_temperature"), ("wrong-rate", "/milk_thermometer")]')),
    _wrong("10b", "the boundary at the guard", "contradicted",
           ('"no-clamp", "/pool_sensor"', '"boundary", "/pool_watch"')),
    _wrong("10b", "a wish to know", "raised", ("diagnoses():", "diagnoses(ward):")),
    _wrong("10b", "the classes of the page", "not-plain", ('"/pool_sensor"', "Node")),
    _wrong("10c", "places exchanged", "other-place",
           ("rack_diary", "x"), ("rack_probe", "rack_diary"), ("/x", "/rack_probe")),
    _wrong("10c", "one pair where two belong", "half-a-diagnosis",
           ('[("wrong-rate", "/comb_thermometer"), ("node-ended", "/comb_logger")]',
            '("wrong-rate", "/comb_thermometer")')),
    _wrong("10c", "a text between the pairs", "no-diagnoses",
           (f"{_DIARY}, ", f'{_DIARY}, "and", ')),
    _wrong("10c", "four texts in one pair", "no-diagnoses",
           (f"{_DIARY}, {_PROBE}",
            '"depth-too-small", "/rack_diary", "wrong-unit", "/rack_probe"')),
    _wrong("10c", "the monitor never gets a word", "contradicted",
           ('"qos-mismatch", "/stall_status"', '"wrong-namespace", "/stall_status"')),
)  # fmt: skip

ANSWERS: tuple[Answer, ...] = (*_SILENT, *_HEARD, *_PAIRS, *_FRESH)
