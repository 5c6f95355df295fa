"""What a learner reads of a mistake: the first moment that shows it, and where to look.

Which answers pass, and what each mistake is called, is in the bank of answers.
"""

import answers  # the folder is put on the path by conftest.py
import pytest

from bank.pages import solution
from bank.running import outcome_of

BASES = {
    "00a": answers.READER,
    "00b": answers.REPORTER,
    "03a": answers.HUMIDITY,
    **{name: solution(name) for name in ("03b", "04a", "04b", "04c", "04d", "04e")},
    **{name: solution(name) for name in ("08a", "08b", "08c", "09a", "09b", "09c")},
}
_SEND = 'self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))'
_SUBSCRIBE = 'self.create_subscription(String, "weather", self.read, 10)'
_CLAMP = "max(18.0, min(28.0, self.temperature))"
_UNIFORM = "random.uniform(-0.3, 0.3)"
TOLD = [
    ("00a", ('"weather",', '"sports",'), "for messages on /sports"),
    ("00a", ('"weather",', '"wether",'), "The node subscribes to /wether"),
    ("00a", (_SUBSCRIBE, f"{_SUBSCRIBE}; {_SUBSCRIBE.replace('weather', 'politics')}"),
     "/politics, /weather"),
    ("00a", (_SUBSCRIBE, "pass"), "The node has no subscription"),
    ("00b", ("2.0", "1.0"), "9 came"),
    ("00b", ('"sports"', '"sport"'), "The node publishes on /sport instead"),
    ("00b", ('self.articles.publish(String(data="Goal"))', "pass"), "but never used it"),
    ("00b", ('"Goal"', '" "'), "The article at 2 s is empty."),
    ("03a", ("0.5", "1.0"), "In 5 seconds 10 readings were due, and 5 came. At 0.5 s none came, "
     "and one was due."),
    ("03a", ("self.publisher_.publish", "for _ in 'ab': self.publisher_.publish"),
     "At 0.5 s 2 came, and one was due."),
    ("03a", ("5)", "10)"), "queue depth is 10"),
    ("03a", ("Float32(data", "Float64(data"), "Float64"),
    ("03a", ('"humidity"', '"temperature"'), "publishes on /temperature instead"),
    ("03a", ("self.create_timer(0.5, self.publish_humidity)", "pass"),
     "nothing ever calls one of the node's methods"),
    ("03a", ("self.publisher_.publish(Float32(data=45.0))", "pass"),
     "Does it reach the line that publishes"),
    ("03a", ('Float32, "humidity"', '"humidity", Float32'), "__init__ raised"),
    ("03a", ("self.publish_humidity)", "self.publish_humidity())"), "without parentheses"),
    ("03a", ('"humidity"', "humidity"), "A string needs quotes"),
    ("03b", ("18.0", "10.2"), "cuts it off at 10.2"),
    ("03b", ("28.0", "99.0"), "cuts it off at 99"),
    ("03b", (_UNIFORM, "random.uniform(-0.5, 0.5)"), "too wide"),
    ("03b", (_UNIFORM, "random.uniform(-0.1, 0.1)"), "The steps are small."),
    ("03b", (_UNIFORM, "0.0"), "It never changes."),
    ("03b", (_UNIFORM, "0.3"), "It goes one way only."),
    ("03b", (_CLAMP, "min(18.0, max(28.0, self.temperature))"), "min and max swapped"),
    ("03b", ("18.0", "18"), "18 is an int"),
    ("03b", (_CLAMP, "self.temperature if 18.0 <= self.temperature <= 28.0 else 22.0"),
     "s it went from 27."),
    ("04a", ("temp > 8.0", "temp >= 8.0"), "For a reading of 8 the node said Warm. Exactly 8"),
    ("04a", ("{status}", "Warm or Frost"), "For a reading of 5 the node said Warm and Frost."),
    ("04a", ("self.get_logger", "print if True else self.get_logger"), "nothing was logged"),
    ("04a", ("{status}", "{status.upper()}"), "with capitals"),
    ("04a", ("temp = msg.data", "temp = int(msg.data)"), "Whole degrees aren't precise enough"),
    ("04b", ("> 26.0", ">= 26.0"), "for a reading of 26. Publish only"),
    ("04b", (" or msg.data < 20.0", ""), "No alert for a reading of 0. Low readings"),
    ("04b", (_SEND, f"[{_SEND} for _ in 'ab']"), "20 alerts for 10"),
    ("04b", ('"alert"', '"alerts"'), "The node publishes on /alerts"),
    ("04c", ("[-5:]", "[-4:]"), "of the last five it is 23.900. The last readings were 25.5, 22"),
    ("04c", ("[-5:]", "[-4:]"), "It is the mean of the last 4 readings."),
    ("04d", ("value >= 25.0", "value >= 24.0"), "far enough back"),
    ("04d", ("String(data=self.status))", "String(data=self.status)) if msg.data else None"),
     "Publish one status for each reading."),
    ("04e", ('return "High"', 'return "Normal" if self.status == "Low" else "High"'),
     "Normal was published, and High was due"),
    ("04e", ("value >= 25.0", "value >= 24.0"), "far enough back"),
    ("04a", ("{status}", "None"), "A function that ends without return gives None."),
    ("04a", ("{status}", "{[status]}"), "A list with a word in it is not the word."),
    ("04b", (_SEND, f"{_SEND}\n            return\n        self.alerts."
             "publish(String(data='OK'))"), "'OK' was published on /alert for a reading of 22."),
    ("04b", ("msg.data < 20.0", "20.0"), "each side of `or` needs a comparison of its own"),
    ("08a", ("!= self.mode", "!= 'idle'"), "At 2 s the node published 'driveOn' on /mode; nothing "
     "was due."),
    ("08a", ("depth=1,", "depth=3,"), "offers RELIABLE, TRANSIENT_LOCAL, a depth of 3"),
    ("08b", ("depth=16", "depth=15"), "1 of 40 readings are missing there; the node was away from "
     "5.5 s to 13.5 s."),
    ("08b", ('(Float32, "reading"', '(String, "reading"'),
     "On /reading, your node uses String and the other side Float32."),
    ("08c", ("seconds=2", "seconds=3"), "Message 1 on /missed was 1, at 13 s; 1 was due, at 12 s. "
     "Your subscription has a deadline of 3 s."),
    ("08c", ("data=self.count", "data=event.total_count"), "total_count is never reset"),
    ("09a", ("timer(3.0", "timer(5.0"), "Lost was due, and the node said lost at 11.5 s."),
    ("09a", ("timer(3.0", "timer(2.0"), "Lost was due, and the node said lost at 8.5 s."),
    ("09a", ('self.statuses.publish(String(data="back"))', "pass"),
     "Back was due, and the node said nothing."),
    ("09b", ("create_timer(3.0", "create_timer(3.4"), "order 7 was done at 5.9 s"),
    ("09b", ("create_timer(3.0", "create_timer(2.9"), "The work itself takes 3 s."),
    ("09b", ("self.waiting.append(msg.data)", "self.waiting = [*self.waiting, msg.data][:2]"),
     "has to wait somewhere"),
    ("09b", ("self.waiting.append(msg.data)", "self.waiting = self.waiting or [msg.data]"),
     "No order could wait. An order that comes while another one is worked on has to wait "
     "somewhere. Or: When one order was done, all others were gone."),
    ("09b", ("self.waiting.pop(0)", "self.waiting.pop()"), "The newest came first."),
    ("09c", ("{word}", "{word.upper()}"), "Capitals count."),
    ("09c", (".1f} {", ".1f}{"), "with a space between them"),
    ("09c", ('f"{word}', '"{word}'), "The braces are still there"),
    ("09c", (".1f", ".0f"), "Of 27.5 it said 'High 28 C'."),
    ("09c", ("> self.high", "> 26.0"), "The parameter high changed nothing."),
    ("09c", ("unit", "units"), "no parameter unit."),
]  # fmt: skip


@pytest.mark.ros
@pytest.mark.parametrize(("exercise", "edit", "said"), TOLD)
def test_a_mistake_is_shown_where_it_first_makes_a_difference(exercise, edit, said):
    text = answers.edited(BASES[exercise], edit)
    outcome = outcome_of(exercise, text, answers.subject(text))
    assert outcome.status == "failed"
    assert said in f"{outcome.evidence} {outcome.hint}", outcome


@pytest.mark.ros
def test_only_a_policy_that_stands_alone_is_called_one():
    profile = "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"
    hints = [
        outcome_of("08a", answers.edited(solution("08a"), (profile, wrong)), "ModeKeeper").hint
        for wrong in ("DurabilityPolicy.TRANSIENT_LOCAL", "QoSProfile(depth=1)", "1")
    ]
    assert ["policy alone" in hint for hint in hints] == [True, False, False]


@pytest.mark.ros
def test_what_is_taken_out_of_an_empty_list_is_told_so():
    stop = "        if not self.waiting:\n            self.work.cancel()"
    text = answers.edited(solution("09b"), (stop, "        pass"))
    outcome = outcome_of("09b", text, "SteadyWorker")
    assert (outcome.mistake, "The list is empty" in outcome.evidence) == ("index-error", True)
