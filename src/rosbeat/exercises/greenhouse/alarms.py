"""Whether alarms come once, in time, with the agreed words, and only then (R4)."""

from __future__ import annotations

from math import inf

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.greenhouse.days import broken_day
from rosbeat.exercises.greenhouse.reading import EPS, said, silent, stamp
from rosbeat.exercises.greenhouse.trials import BROKEN, Trials

ALARM = "/alarm"
Alarm = tuple[float, str]


def judge_alarms(trials: Trials) -> Diagnosis | None:
    """R4: an alarm when a sensor falls silent, and one when it is back."""
    seen, n = trials.runs[BROKEN], trials.numbers
    wrong = silent(seen, ALARM)
    if wrong:
        return wrong
    alarms = [(one.time, str(one.value)) for one in said(seen, ALARM)]
    marks, wait = broken_day(n).marks, n["silent_seconds"]
    for sensor, silences in (("temperature", ("temperature", "both")), ("humidity", ("both",))):
        for word, delay in (("silent", wait - 1), ("back", 0)):
            dues = [marks[f"{silence} {word}"] + delay for silence in silences]
            wrong = wrong or _as_often(alarms, (sensor, word), dues, (n["react_seconds"], wait))
    return wrong or _false_alarm(trials)


def _as_often(
    alarms: list[Alarm], words: tuple[str, str], dues: list[float], times: tuple[float, float]
) -> Diagnosis | None:
    """What is wrong with the alarms of some words; each is due at certain times, and not else."""
    wanted, (react, wait) = " ".join(words), times
    found = [time for time, text in alarms if all(word in text.lower() for word in words)]
    begins = -1.0
    for due in dues:
        here = [time for time in found if begins < time <= due + react + EPS]
        if not here:
            return _missing(alarms, wanted, due, due + react)
        if here[0] < due - EPS:
            if words[1] == "back":
                return _never_away(wanted, here[0], due)
            return _early(wanted, here[0], (due - wait, due))
        begins = due + react + EPS
        after = min([later for later in dues if later > due], default=inf)
        again = [time for time in found if here[0] < time < after - EPS]
        if len(here) > 1 or again:
            return _again(wanted, here[0], [*here[1:], *again][0])
    return None


def _early(wanted: str, time: float, silence: tuple[float, float]) -> Diagnosis:
    last, due = silence
    evidence = f"'{wanted}' came at {stamp(time)}; it was due from {stamp(due)} on"
    if time >= last - EPS:
        evidence += f", as the last message had come at {stamp(last)}"
    evidence += "."
    hint = "How long has it been since the last message? Every message begins that time anew."
    return Diagnosis("alarm-too-early", evidence, hint)


def _never_away(wanted: str, time: float, due: float) -> Diagnosis:
    evidence = f"'{wanted}' came at {stamp(time)}; it was due at {stamp(due)}, after a silence."
    hint = "Only a sensor that was silent can be back: the node has to remember that it was told."
    return Diagnosis("alert-too-many", evidence, hint)


def _again(wanted: str, first: float, second: float) -> Diagnosis:
    evidence = f"'{wanted}' came at {stamp(first)}, and again at {stamp(second)}."
    hint = "One alarm is enough: the node has to remember that it was told."
    return Diagnosis("alert-too-many", evidence, hint)


def _missing(alarms: list[Alarm], wanted: str, due: float, late: float) -> Diagnosis:
    (others_name,) = {"temperature", "humidity"} - {wanted.split()[0]}
    others = [
        text
        for time, text in alarms
        if due - EPS <= time <= late + EPS and others_name not in text.lower()
    ]
    if others:
        evidence = f"At {stamp(due)} to {stamp(late)} the alarm said {others[0]!r}."
        hint = f"The agreed words are '{wanted}'; more words do not matter."
        return Diagnosis("wrong-word", evidence, hint)
    evidence = f"'{wanted}' was due from {stamp(due)} to {stamp(late)}, and did not come."
    hint = "No message comes to say that there is no message. What else can wake the node?"
    if wanted.endswith("back"):
        hint = "The first message after a silence says that the sensor is back."
    return Diagnosis("alert-missing", evidence, hint)


def _false_alarm(trials: Trials) -> Diagnosis | None:
    false = said(trials.plain, ALARM)
    if not false:
        return None
    evidence = f"All sensors spoke every second, and at {stamp(false[0].time)} came an alarm: "
    hint = "On a day like this no alarm is due."
    return Diagnosis("alert-too-many", f"{evidence}{str(false[0].value)!r}.", hint)
