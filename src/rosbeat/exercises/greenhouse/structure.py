"""Whether the work is shared out: who says what, who hears whom, who needs whom (R8, R9, R11)."""

from __future__ import annotations

from collections import Counter

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.greenhouse.alarms import judge_alarms
from rosbeat.exercises.greenhouse.days import lossy_day, other_day
from rosbeat.exercises.greenhouse.pump import judge_interlock
from rosbeat.exercises.greenhouse.reading import (
    EPS,
    INPUTS,
    OUTPUTS,
    Switch,
    no_publisher,
    silent,
    stamp,
    switch,
)
from rosbeat.exercises.greenhouse.reports import judge_reports
from rosbeat.exercises.greenhouse.trials import BROKEN, LOSSY, OTHER, Trials
from rosbeat.exercises.greenhouse.vent import judge_vent
from rosbeat.records import GraphSnapshot

#: For each output: which inputs it depends on, and who says whether it does so rightly.
_NEEDS = (
    ("/vent", INPUTS[:1], judge_vent),
    ("/pump", INPUTS, judge_interlock),
    ("/alarm", INPUTS, judge_alarms),
    ("/report", INPUTS[:1], judge_reports),
)


def judge_tasks(trials: Trials) -> Diagnosis | None:
    """R8: one node for each output, and topics between them."""
    graph = trials.runs[BROKEN].graph
    missing = next((topic for topic in OUTPUTS if not graph.on(topic, "publisher")), "")
    if missing:
        return no_publisher(trials.runs[BROKEN], missing)
    return (
        _twins(graph) or _two_controllers(graph) or _two_tasks(graph) or _hidden_ways(trials, graph)
    )


def _twins(graph: GraphSnapshot) -> Diagnosis | None:
    name, count = max(Counter(graph.nodes).items(), key=lambda pair: pair[1])
    if count < 2:
        return None
    hint = "Each node has a name of its own; who starts a class twice gives the second one another."
    return Diagnosis("run-twice", f"{count} nodes are called {name}.", hint)


def _two_controllers(graph: GraphSnapshot) -> Diagnosis | None:
    for topic in OUTPUTS:
        nodes = sorted(end.node for end in graph.on(topic, "publisher"))
        if len(nodes) > 1:
            evidence = f"{' and '.join(nodes)} publish on {topic}."
            hint = "Who is right if the two disagree? One node decides; the others ask it."
            if topic in ("/alarm", "/report"):
                hint = "One node speaks there; the others tell it, on a topic of their own."
            return Diagnosis("two-controllers", evidence, hint)
    return None


def _two_tasks(graph: GraphSnapshot) -> Diagnosis | None:
    for node in graph.nodes:
        topics = [one for one in OUTPUTS if node in {e.node for e in graph.on(one, "publisher")}]
        if len(topics) > 1:
            evidence = f"{node} publishes on {' and on '.join(topics)}."
            hint = "Two tasks, two nodes: then one of them can end, or be replaced, alone."
            return Diagnosis("two-tasks", evidence, hint)
    return None


def _hidden_ways(trials: Trials, graph: GraphSnapshot) -> Diagnosis | None:
    """An output that depends on an input, as it should, while no topic leads there."""
    for topic, needs, judge in _NEEDS:
        for source in needs:
            if topic not in reached(graph, source) and judge(trials) is None:
                evidence = f"{topic} depends on {source}, and no topic or service leads there."
                hint = (
                    "Do two nodes share a variable of Python? In two processes each would have its "
                    "own."
                )
                return Diagnosis("shared-variable", evidence, hint)
    return None


def reached(graph: GraphSnapshot, source: str) -> set[str]:
    """Topics and services that what is said on a topic may lead to, through any nodes.

    Args:
        graph: The graph.
        source: Full name of the topic.
    """
    hears = {(e.node, e.name) for e in graph.endpoints if e.kind != "publisher"}
    says = {(e.node, e.name) for e in graph.endpoints if e.kind != "subscription"}
    known, new = {source}, {source}
    while new:
        nodes = {node for node, name in hears if name in new}
        new = {name for node, name in says if node in nodes} - known
        known |= new
    return known


def judge_endings(trials: Trials) -> Diagnosis | None:
    """R9: the vent goes on whoever else ends."""
    marks = lossy_day(trials.numbers).marks
    react = trials.numbers["react_seconds"]
    vent = switch(trials.runs[LOSSY], "/vent")
    for name, after in (("report", "without alarm"), ("alarm", "without pump"), ("pump", "end")):
        nodes = sorted({end.node for end in trials.plain.graph.on(f"/{name}", "publisher")})
        if not nodes:
            return silent(trials.plain, f"/{name}")
        hot = marks[f"hot without {name}"]
        wrong = _stuck(vent, hot, marks[after], react)
        if wrong:
            evidence = f"After {' and '.join(nodes)} had ended, {wrong}."
            hint = "What does the node of the vent need from the one that ended?"
            return Diagnosis("falls-together", evidence, hint)
    return None


def _stuck(vent: Switch, hot: float, cool: float, react: float) -> str:
    if not vent.at(hot + react):
        return f"it was hot from {stamp(hot)} on, and the vent did not open"
    if vent.at(cool + react):
        return f"it was cool from {stamp(cool)} on, and the vent did not close"
    return ""


def judge_parameters(trials: Trials) -> Diagnosis | None:
    """R11: who starts the nodes can set other limits."""
    seen, n = trials.runs[OTHER], trials.numbers
    marks, react = other_day(n).marks, n["react_seconds"]
    hint = "A node declares a parameter with a default, and asks for its value where it needs it."
    for topic in ("/vent", "/pump"):
        quiet = silent(trials.plain, topic)
        if quiet:
            return quiet
    refused = next((one for one in seen.faults if "arameter" in one.kind), None)
    if refused:
        evidence = f"With other limits, a node was not made: {refused.kind}: {refused.text}"
        return Diagnosis("limit-fixed", evidence, "All three hold floats: 28.0 is one, 28 is none.")
    spans = switch(seen, "/vent").spans(seen.time)
    if len(spans) != 1 or not marks["warm"] <= spans[0][0] <= marks["warm"] + react + EPS:
        evidence = "The vent was started with other values of open_above and close_below."
        return Diagnosis("limit-fixed", f"{evidence} It went on with the old ones.", hint)
    if not marks["cool"] <= spans[0][1] <= marks["cool"] + react + EPS:
        evidence = "With another value of close_below the vent did not close as it should."
        return Diagnosis("limit-fixed", evidence, hint)
    begins = [begin for begin, _ in switch(seen, "/pump").spans(seen.time)]
    if begins and marks["damp"] <= begins[0] <= marks["damp"] + react + EPS:
        return None
    evidence = "The pump was started with another value of dry_below, and went on with the old one."
    return Diagnosis("limit-fixed", evidence, hint)
