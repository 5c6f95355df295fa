"""12c, heat to a target: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.heat_right import BASE

_SERVER = "goal_callback=self.decide, cancel_callback=self.agree,"
_DECIDE = "return GoalResponse.ACCEPT if 10 <= goal.order <= 26 else GoalResponse.REJECT"
_ON, _OFF = "self.heater.publish(Bool(data=True))", "self.heater.publish(Bool(data=False))"
_WHILE = "while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):"
_READ = "degrees.append(await self.reading)"
_TELL = "goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))"
_LOOK = "canceled = goal_handle.is_cancel_requested"
_END = "goal_handle.canceled() if canceled else goal_handle.succeed()"
_BACK = "return Fibonacci.Result(sequence=degrees)"


def _wrong(name, mistake, *edits):
    return wrong("12c", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("12c", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    # Which goals are taken.
    _wrong(
        "a canceled goal gives back other numbers",
        "result-wrong",
        (_BACK, "return Fibonacci.Result(sequence=[1, 2, 3] if canceled else degrees)"),
    ),
    _wrong("every goal is taken", "nonsense-accepted", (_DECIDE, "return GoalResponse.ACCEPT")),
    _wrong("no goal callback", "nonsense-accepted", ("goal_callback=self.decide, ", "")),
    _wrong("no lower limit", "nonsense-accepted", ("10 <= goal.order <= 26", "goal.order <= 26")),
    _wrong("26 is rejected", "boundary", ("<= 26 else", "< 26 else")),
    _wrong("10 is rejected", "boundary", ("10 <= goal", "10 < goal")),
    _wrong("every goal is rejected", "good-value-refused", (_DECIDE, "return GoalResponse.REJECT")),
    _wrong(
        "a truth instead of a GoalResponse",
        "good-value-refused",
        (_DECIDE, "return 10 <= goal.order <= 26"),
    ),
    _wrong("no decision", "good-value-refused", (_DECIDE, "pass")),
    # How the work ends.
    _wrong(
        "succeed is forgotten",
        "succeed-forgotten",
        (_END, "if canceled:\n            goal_handle.canceled()"),
    ),
    _wrong(
        "succeed without brackets",
        "succeed-forgotten",
        (_END, "goal_handle.canceled() if canceled else goal_handle.succeed"),
    ),
    _wrong("abort", "succeed-forgotten", ("goal_handle.succeed()", "goal_handle.abort()")),
    _wrong("no return", "result-missing", (_BACK, "pass")),
    _wrong("the list is returned", "result-missing", (_BACK, "return degrees")),
    _wrong(
        "the feedback is returned",
        "result-missing",
        (_BACK, "return Fibonacci.Feedback(sequence=degrees)"),
    ),
    _wrong("an empty result", "result-wrong", (_BACK, "return Fibonacci.Result()")),
    _wrong(
        "only the last one in the result",
        "result-wrong",
        (_BACK, "return Fibonacci.Result(sequence=degrees[-1:])"),
    ),
    _wrong("always succeeds", "cancel-not-reported", (_END, "goal_handle.succeed()")),
    _wrong("always canceled", "canceled-unasked", (_END, "goal_handle.canceled()")),
    _wrong(
        "swapped",
        "canceled-unasked",
        (_END, "goal_handle.succeed() if canceled else goal_handle.canceled()"),
    ),
    _wrong(
        "canceled is forgotten",
        "cancel-not-reported",
        (_END, "if not canceled:\n            goal_handle.succeed()"),
    ),
    _wrong("ended twice", "ended-twice", (_BACK, f"goal_handle.succeed()\n        {_BACK}")),
    # The loop.
    _wrong("ends at once", "ends-too-soon", (_WHILE, "for _ in range(1):")),
    _wrong(
        "one degree too few",
        "ends-too-soon",
        ("< goal_handle.request.order", "< goal_handle.request.order - 1"),
    ),
    _wrong(
        "one degree too many",
        "boundary",
        ("< goal_handle.request.order", "<= goal_handle.request.order"),
    ),
    _wrong("never ends", "never-ends", (_WHILE, "while not canceled:")),
    _wrong(
        "only an unequal one",
        "result-wrong",
        (_READ, f"{_READ}\n            degrees = sorted(set(degrees), reverse=True)[:1]"),
    ),
    # The feedback.
    _wrong("no feedback", "feedback-missing", (_TELL, "pass")),
    _wrong(
        "feedback only in the end",
        "feedback-missing",
        (_TELL, "pass"),
        (_OFF, f"{_OFF}\n        {_TELL}"),
    ),
    _wrong(
        "only the newest one in the feedback",
        "wrong-values",
        (_TELL, "goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees[-1:]))"),
    ),
    _wrong(
        "empty feedback",
        "wrong-values",
        (_TELL, "goal_handle.publish_feedback(Fibonacci.Feedback())"),
    ),
    _wrong("a result as feedback", "feedback-wrong", ("Fibonacci.Feedback(", "Fibonacci.Result(")),
    _wrong(
        "a list as feedback", "feedback-wrong", (_TELL, "goal_handle.publish_feedback(degrees)")
    ),
    # The heater.
    _wrong("never on", "never-published", (_ON, "pass"), (_OFF, "pass")),
    _wrong("on is left out", "never-switched-on", (_ON, "pass")),
    _wrong("left on", "left-on", (_OFF, "pass")),
    _wrong(
        "left on if canceled",
        "left-on",
        (_OFF, "if not canceled:\n            self.heater.publish(Bool(data=False))"),
    ),
    _wrong(
        "swapped states", "never-switched-on", (_ON, "self.heater.publish(Bool())"), (_OFF, "pass")
    ),
    _wrong("a truth for a message", "number-published", (_ON, "self.heater.publish(True)")),
    # Canceling.
    _wrong("no cancel callback", "cancel-refused", (_SERVER, "goal_callback=self.decide,")),
    _wrong(
        "cancel is rejected", "cancel-refused", ("CancelResponse.ACCEPT", "CancelResponse.REJECT")
    ),
    _wrong("cancel is ignored", "cancel-ignored", (_LOOK, "pass")),
    _wrong(
        "cancel is asked for too early",
        "cancel-ignored",
        (_ON, f"{_LOOK}\n        {_ON}"),
        (f"{_TELL}\n            {_LOOK}", _TELL),
    ),
    # Waiting.
    _wrong("await is forgotten", "await-missing", ("await self.reading", "self.reading")),
    _wrong(
        "await is forgotten, compared",
        "await-missing",
        (_READ, f"cold = self.reading < 26\n            {_READ}"),
    ),
    _wrong("await is forgotten, int", "await-missing", ("await self.reading", "int(self.reading)")),
    _wrong(
        "sleeps",
        "callback-blocks",
        (_WHILE, "import time\n        while not canceled and len(degrees) < 4:"),
        (_READ, "time.sleep(1.0)\n            degrees.append(19 + len(degrees))"),
    ),
    _wrong("spins for ever", "callback-blocks", (_READ, "while True:\n                pass")),
    _wrong("floats", "not-an-integer", (_READ, "degrees.append(float(await self.reading))")),
    _wrong("another name", "service-misspelled", ('"heat"', '"hear"')),
    _wrong("another topic", "topic-misspelled", ('"heater"', '"haeter"')),
    # Two at once.
    _either(
        "left on, and no feedback", ("left-on", "feedback-missing"), (_OFF, "pass"), (_TELL, "pass")
    ),
    _either(
        "succeed forgotten, and every goal taken",
        ("succeed-forgotten", "nonsense-accepted"),
        (_END, "pass"),
        (_DECIDE, "return GoalResponse.ACCEPT"),
    ),
    _either(
        "no cancel, and an empty result",
        ("cancel-refused", "result-wrong"),
        (_SERVER, "goal_callback=self.decide,"),
        (_BACK, "return Fibonacci.Result()"),
    ),
    _either(
        "no return, and left on", ("result-missing", "left-on"), (_BACK, "pass"), (_OFF, "pass")
    ),
)
