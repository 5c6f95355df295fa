"""What a learner reads of a mistake: the first moment that shows it, and where to look.

Which answers pass, and what each mistake is called, is in the bank of answers. What is said of one
wrong answer for each mistake is in `grading/examples.json`; here are those that it does not show.
"""

import answers  # the folder is put on the path by conftest.py
import pytest

from bank.pages import solution
from bank.running import outcome_of

BASES = {
    "00a": answers.READER,
    "03a": answers.HUMIDITY,
    **{name: solution(name) for name in ("03b", "04a", "04b", "04c", "04d", "04e")},
    **{name: solution(name) for name in ("08a", "08b", "08c", "09a", "09b", "09c")},
}
_SEND = 'self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))'
_SUBSCRIBE = 'self.create_subscription(String, "weather", self.read, 10)'
TOLD = [
    ("00a", (_SUBSCRIBE, f"{_SUBSCRIBE}; {_SUBSCRIBE.replace('weather', 'politics')}"),
     "/politics, /weather"),
    ("03a", ("self.publisher_.publish", "for _ in 'ab': self.publisher_.publish"),
     "At 0.5 s it was 2 instead of one."),
    ("03b", ("28.0", "99.0"), "cuts it off at 99"),
    ("04a", ("{status}", "Warm or Frost"), "For a reading of 5 the node said Warm and Frost."),
    ("04a", ("temp = msg.data", "temp = int(msg.data)"), "Whole degrees aren't precise enough"),
    ("04a", ("{status}", "None"), "A function that ends without return gives None."),
    ("04a", ("{status}", "{[status]}"), "A list with a word in it is not the word."),
    ("04b", (_SEND, f"[{_SEND} for _ in 'ab']"), "20 alerts for 10"),
    ("04b", (_SEND, f"{_SEND}\n            return\n        self.alerts."
             "publish(String(data='OK'))"), "'OK' was published on /alert for a reading of 22."),
    ("04c", ("[-5:]", "[-4:]"), "of the last five it is 23.900. The last readings were 25.5, 22"),
    ("04c", ("[-5:]", "[-4:]"), "It is the mean of the last 4 readings."),
    ("04d", ("value >= 25.0", "value >= 24.0"), "far enough back"),
    ("04d", ("String(data=self.status))", "String(data=self.status)) if msg.data else None"),
     "Publish one status for each reading."),
    ("04e", ('return "High"', 'return "Normal" if self.status == "Low" else "High"'),
     "Normal was published, and High should have been"),
    ("08a", ("!= self.mode", "!= 'idle'"), "At 2 s the node published 'driveOn' on /mode; nothing "
     "should have been."),
    ("08a", ("depth=1,", "depth=3,"), "offers RELIABLE, TRANSIENT_LOCAL, a depth of 3"),
    ("08a", ("QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)",
             "DurabilityPolicy.TRANSIENT_LOCAL"), "policy alone"),
    ("08b", ('(Float32, "reading"', '(String, "reading"'),
     "On /reading, your node uses String and the other side Float32."),
    ("08c", ("seconds=2", "seconds=3"), "Message 1 on /missed was 1, at 13 s; 1 should have "
     "been published, at 12 s. "
     "Your subscription has a deadline of 3 s."),
    ("09a", ("timer(3.0", "timer(2.0"), "Lost was due, and the node said lost at 8.5 s."),
    ("09b", ("create_timer(3.0", "create_timer(3.4"), "order 7 was done at 5.9 s"),
    ("09b", ("self.waiting.append(msg.data)", "self.waiting = self.waiting or [msg.data]"),
     "No order could wait. An order that comes while another one is worked on has to wait "
     "somewhere. Or: When one order was done, all others were gone."),
    ("09b", ("        if not self.waiting:\n            self.work.cancel()", "        pass"),
     "The list is empty"),
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
