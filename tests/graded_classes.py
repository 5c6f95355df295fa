"""Gradebooks that are made up, with everything in them that a page has to survive."""

import random

from rosbeat.exercises.registry import PAGES
from rosbeat.grading.marks import Gradebook, Graded, Mark
from rosbeat.grading.remarks import Remark
from rosbeat.page_runs.traces import trace_of
from rosbeat.records import Endpoint, GraphSnapshot, LogRecord, Observation, Part, QoS, Sample

#: Texts that a stranger may put where a name, a file or a log line belongs.
HOSTILE = (
    "<script>alert(1)</script>",
    '"onload="alert(1)',
    "</style></title><img src=x onerror=alert(1)>",
    "'><svg onload=alert(1)>",
    "abc\u202egnp.exe",
    "a\0b\x1b[31mred\x07",
    "\ud800 half a letter",
    "&amp; {policy} {title} %s $x",
    "א ב ג <b>",
    "W" * 100_000,
    "line\n" * 1_000,
    "",
)

#: The word, and for each sort of mark what it holds.
PARTS = (
    Part("R1", "The greenhouse opens its window above 28 degrees.", True, "", 5),
    Part("R2", "It closes it again below 26.", False, "The window stayed open at 25.", 3, True),
)


def mark(exercise="03a", status="passed", **values):
    page = next(one for one in PAGES if one.number == exercise[:2])
    title = next((one.title for one in page.exercises if one.id == exercise), "an exercise")
    name = f"{exercise[:2]}_{page.title.lower().replace(' ', '_')}"
    standard = {
        "points": 1.0 if status == "passed" else 0.0,
        "out_of": 1.0,
        "cause": f"It is {status}.",
    }
    return Mark(exercise, values.pop("title", title), name, status, **(standard | values))


def one_of_each():
    """A learner with a mark of each sort."""
    return Graded(
        "4711",
        "Ana Muster",
        "moodle",
        (
            mark(evidence="In 60 s there were 60 messages on /temperature.", remarks=("Good.",)),
            mark(
                "03b",
                "failed",
                mistake="topic-misspelled",
                evidence="The node publishes on /temprature, and nobody listens there.",
                hint="Compare the two names letter by letter.",
            ),
            mark("03c", "failed", mistake="new-to-me", evidence="KeyError: 'x'.\n  line 2"),
            mark("04a", "not attempted", evidence="There is still a blank, ____."),
            mark("04b", "held", cause="It used more memory than there is.", late=True,
                 answer="import os\nclass A: pass", file="ana/04.ipynb"),
            mark("04c", differs="The page shows that it has passed.", manual=True, points=0.5,
                 comment="A nice idea.\nNext time with a shorter name?"),
            mark("05a", "missing", cause="The page was not handed in."),
            mark("05b", "missing", cause="The page was not handed in."),
            mark("13b", "looked at", points=1.0, manual=True, comment="Fine, for once."),
            mark("13a", "failed", points=5.0, out_of=8.0, parts=PARTS, mistake="wrong-state"),
        ),
        (Remark("renamed", "ana/homework (1).ipynb", "This is the page 03; it has another name."),),
        "You have come far.",
    )  # fmt: skip


def observation(topic="/status", words=("Fine", "Warm"), name="/monitor"):
    """What a node heard, logged and published, a message a second."""
    float32 = "std_msgs/msg/Float32"
    heard = [
        Sample(n * 10**9, "/temperature", float32, "/feeder", {"data": 5.0 + n})
        for n in range(len(words))
    ]
    said = [
        Sample(n * 10**9, topic, "std_msgs/msg/String", name, {"data": word})
        for n, word in enumerate(words)
    ]
    logs = [
        LogRecord(n * 10**9, "INFO", name.strip("/"), word, "f", 3) for n, word in enumerate(words)
    ]
    end = Endpoint(name, "/temperature", float32, "subscription", QoS())
    graph = GraphSnapshot((name,), (end,))
    return Observation(len(words) * 10**9, 0, (*heard, *said), tuple(logs), graph=graph,
                       subject=name)  # fmt: skip


def hostile_learner(text):
    """A learner of whom every text is the same strange one."""
    part = Part(text, text, False, text)
    trace = trace_of(observation(f"/{text}", (text, "x"), f"/{text}"))
    marks = [
        mark(status=status, title=text, cause=text, mistake=text, evidence=text, hint=text,
             remarks=(text,), parts=(part,), differs=text, comment=text, answer=text, file=text,
             source=text, trace=trace)
        for status in ("passed", "failed", "held", "looked at", "missing", "not attempted", text)
    ]  # fmt: skip
    return Graded(text, text, text, tuple(marks), (Remark(text, text, text),), text)


_MISTAKES = ("topic-misspelled", "depth-missing", "wrong-rate", "not-a-float", "boundary")
_STATUSES = ("passed",) * 6 + ("failed",) * 3 + ("not attempted", "missing", "held")


def a_class(learners, seed=1):
    """A class of a certain size, always the same."""
    dice = random.Random(seed)
    names = [one.id for page in PAGES if page.number for one in page.exercises]
    return Gradebook(
        "0.1.0",
        tuple(_learner(number, names, dice) for number in range(learners)),
        (Remark("left-out", "stray.ipynb", "It lies in no learner's folder."),),
    )


def _learner(number, names, dice):
    if number % 50 == 7:
        marks = tuple(mark(name, "missing") for name in names)
    else:
        marks = tuple(_random_mark(name, dice) for name in names)
    late = Remark("late", f"learner {number}/03.ipynb", "It was handed in after the deadline.")
    return Graded(f"{number:04}", f"Learner {number}", "folder", marks, (late,) * (number % 3 == 0))


def _random_mark(name, dice):
    status = dice.choice(_STATUSES)
    if status != "failed":
        differs = "The page shows another outcome." if dice.random() < 0.02 else ""
        return mark(name, status, differs=differs)
    chosen = dice.choice((*_MISTAKES, *_MISTAKES[:2], "new-to-me"))
    return mark(name, status, mistake=chosen, hint=f"Look at {chosen}.", evidence="It was seen.")
