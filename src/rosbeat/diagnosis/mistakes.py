"""The names of mistakes.

The first thirty are those that learners of this tutorial make most; `row` is their number in the
course's table (docs/mistakes.md). A row that holds several mistakes has several names. The others
belong to one exercise or another and have no row.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Mistake:
    """A mistake that has a name.

    Attributes:
        id: Its name in records and tests, such as `topic-misspelled`.
        title: Its name for people, a few words in lower case.
        row: Its number in the table of thirty, or 0.
    """

    id: str
    title: str
    row: int = 0


@dataclass(frozen=True)
class Diagnosis:
    """A mistake that was recognised.

    Attributes:
        mistake: Its id, from `MISTAKES`.
        evidence: What was observed that shows it, one or two sentences.
        hint: Where to look, without the answer, one or two sentences.
    """

    mistake: str
    evidence: str
    hint: str


#: What a failed outcome is called if no mistake was recognised.
UNKNOWN = "new-to-me"

_OF_THE_TABLE = (
    Mistake("not-a-float", "a field got a value of another type", 1),
    Mistake("number-published", "a value published instead of a message", 2),
    Mistake("class-published", "a message class published instead of a message", 3),
    Mistake("wrong-keyword", "a keyword that the message does not have", 4),
    Mistake("wrong-field", "a field that the message does not have", 5),
    Mistake("depth-missing", "the queue depth is missing", 6),
    Mistake("callback-missing", "the callback is missing", 6),
    Mistake("arguments-swapped", "arguments in another order", 7),
    Mistake("not-a-message-type", "something that is no message type", 8),
    Mistake("callback-called", "the callback is called instead of handed over", 9),
    Mistake("callback-parameters", "the callback has the wrong parameters", 10),
    Mistake("super-missing", "super().__init__ is missing, or comes too late", 11),
    Mistake("node-name-missing", "the node has no name", 11),
    Mistake("invalid-name", "a name with characters that ROS does not allow", 12),
    Mistake("topic-misspelled", "a topic's name that nobody else uses", 13),
    Mistake("qos-mismatch", "quality of service that does not fit", 14),
    Mistake("type-mismatch", "two message types on one topic", 15),
    Mistake("not-spun", "nobody runs the callbacks", 16),
    Mistake("callback-blocks", "a callback that does not return", 16),
    Mistake("not-initialised", "a node before rclpy.init", 17),
    Mistake("initialised-twice", "rclpy.init a second time", 17),
    Mistake("shut-down-twice", "rclpy.shutdown a second time", 17),
    Mistake("run-twice", "two nodes of the same name", 18),
    Mistake("init-in-with", "rclpy.init in a with statement", 19),
    Mistake("entry-point-missing", "no entry point of that name", 20),
    Mistake("executable-misspelled", "an executable's name that setup.py does not have", 20),
    Mistake("entry-point-target", "an entry point that leads nowhere", 21),
    Mistake("comma-missing", "a comma is missing between two texts", 22),
    Mistake("slash-in-module", "a slash where a dot belongs", 22),
    Mistake("not-sourced", "the terminal does not know the workspace", 23),
    Mistake("not-built", "the package is not built yet", 23),
    Mistake("not-rebuilt", "changed and not built again", 24),
    Mistake("build-type", "another kind of package", 25),
    Mistake("package-exists", "a package of that name exists", 26),
    Mistake("wrong-folder", "in the wrong folder", 26),
    Mistake("marker-missing", "a file that every package needs is gone", 27),
    Mistake("syntax-error", "Python cannot read a file", 28),
    Mistake("ctrl-c-traceback", "a program that does not end cleanly", 29),
    Mistake("first-messages-lost", "messages sent before anybody listened", 30),
)

_OTHERS = (
    Mistake("name-error", "a name that Python does not know"),
    Mistake("raised", "an exception of another kind"),
    Mistake("no-node", "something that is not a node class"),
    Mistake("exits", "the program is ended from inside"),
    Mistake("prints-without-end", "more text than anybody reads"),
    Mistake("no-publisher", "nothing to publish with"),
    Mistake("never-published", "a publisher that is never used"),
    Mistake("no-subscription", "nothing that listens"),
    Mistake("no-timer", "nothing that calls the callback"),
    Mistake("wrong-rate", "another rate than asked for"),
    Mistake("wrong-depth", "another queue depth than asked for"),
    Mistake("wrong-values", "other values than asked for"),
    Mistake("nothing-logged", "nothing is said about a reading"),
    Mistake("boundary", "a limit counted to the wrong side"),
    Mistake("wrong-state", "another state than asked for"),
)

MISTAKES: dict[str, Mistake] = {one.id: one for one in (*_OF_THE_TABLE, *_OTHERS)}


def mistake(name: str) -> Mistake:
    """Return a mistake by its id.

    Raises:
        KeyError: If there is no such mistake.
    """
    return MISTAKES[name]
