"""Name the mistakes that learners make.

The first thirty are those that learners of this tutorial make most; `row` is their number in the
course's table (docs/mistakes.md). A row that holds several mistakes has several names. The others
belong to one exercise or another and have no row.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from difflib import SequenceMatcher
from html import escape

_CODE = re.compile(r"`([^`\n]+)`")


@dataclass(frozen=True)
class Mistake:
    """Identify a kind of mistake.

    Attributes:
        id: Id in records and tests, such as `topic-misspelled`.
        title: Short description for people, a few words in lower case.
        row: Row in the table of thirty mistakes, or 0.
    """

    id: str
    title: str
    row: int = 0

    @property
    def heading(self) -> str:
        """Return its title with a capital, unless it begins with code: `super().__init__ ...`."""
        first = self.title.split()[0]
        return self.title[:1].upper() + self.title[1:] if first.isalpha() else self.title


@dataclass(frozen=True)
class Diagnosis:
    """Hold a mistake that was recognised.

    Attributes:
        mistake: Its id, from `MISTAKES`.
        evidence: What was observed that shows it, one or two sentences.
        hint: Where to look, without the answer, one or two sentences.
        share: Of what was asked for, the share that is right all the same, from 0 to 1.
    """

    mistake: str
    evidence: str
    hint: str
    share: float = 0.0


#: Words that say nothing about a mistake.
_SMALL_WORDS = {"a", "an", "by", "in", "is", "not", "of", "on", "the", "to"}

#: What a failed outcome is called if no mistake was recognised.
UNKNOWN = "new-to-me"

_OF_THE_TABLE = (
    Mistake("not-a-float", "a field assigned a value of another type", 1),
    Mistake("number-published", "a value published instead of a message", 2),
    Mistake("class-published", "a message class published instead of a message", 3),
    Mistake("wrong-keyword", "a keyword that the message does not have", 4),
    Mistake("wrong-field", "a field that the message does not have", 5),
    Mistake("depth-missing", "the queue depth is missing", 6),
    Mistake("callback-missing", "the callback is missing", 6),
    Mistake("arguments-swapped", "arguments in a different order", 7),
    Mistake("not-a-message-type", "something that is not a message type", 8),
    Mistake("callback-called", "the callback is called instead of passed", 9),
    Mistake("callback-parameters", "the callback has other parameters than ROS passes", 10),
    Mistake("super-missing", "super().__init__ is missing, or comes too late", 11),
    Mistake("node-name-missing", "the node has no name", 11),
    Mistake("invalid-name", "a name with characters that ROS does not allow", 12),
    Mistake("topic-misspelled", "a topic name that no other node uses", 13),
    Mistake("qos-mismatch", "incompatible QoS policies", 14),
    Mistake("type-mismatch", "two message types on one topic", 15),
    Mistake("not-spun", "a node that is not spun", 16),
    Mistake("callback-blocks", "a callback that does not return", 16),
    Mistake("constructor-blocks", "a constructor that does not return", 16),
    Mistake("not-initialised", "a node created before rclpy.init", 17),
    Mistake("initialised-twice", "rclpy.init called twice", 17),
    Mistake("shut-down-twice", "rclpy.shutdown called twice", 17),
    Mistake("run-twice", "two nodes with the same name", 18),
    Mistake("init-in-with", "rclpy.init in a with statement", 19),
    Mistake("entry-point-missing", "no entry point with that name", 20),
    Mistake("executable-misspelled", "an executable name that setup.py does not have", 20),
    Mistake("entry-point-target", "an entry point whose target cannot be found", 21),
    Mistake("comma-missing", "a missing comma between two strings", 22),
    Mistake("slash-in-module", "a slash instead of a dot in a module name", 22),
    Mistake("not-sourced", "the workspace is not sourced in this terminal", 23),
    Mistake("not-built", "the package is not built yet", 23),
    Mistake("not-rebuilt", "changed since the last build", 24),
    Mistake("build-type", "a package of another build type", 25),
    Mistake("package-exists", "a package with that name already exists", 26),
    Mistake("wrong-folder", "a different folder than intended", 26),
    Mistake("marker-missing", "a file that every package needs is missing", 27),
    Mistake("syntax-error", "Python cannot read a file", 28),
    Mistake("ctrl-c-traceback", "a program that does not end cleanly", 29),
    Mistake("first-messages-lost", "messages published before the subscription was connected", 30),
)

# Errors of Python and of ROS in general, and mistakes of pages 00 to 06.
_PAGES_00_TO_06 = (
    Mistake("name-error", "a name that is not defined"),
    Mistake("wrong-attribute", "an attribute or a method that does not exist"),
    Mistake("argument-missing", "a missing argument"),
    Mistake("wrong-argument", "an argument of the wrong type"),
    Mistake("self-missing", "a method without self"),
    Mistake("constructor-parameters", "a constructor that requires arguments"),
    Mistake("field-without-name", "a value without the name of its field"),
    Mistake("message-for-value", "a message used instead of the value in it"),
    Mistake("class-changed", "a value assigned to a message class"),
    Mistake("text-and-number", "a string and a number combined"),
    Mistake("decimal-comma", "a decimal comma instead of a point"),
    Mistake("format-code", "a format code that does not match the value"),
    Mistake("logged-no-text", "a logged value that is not a string"),
    Mistake("not-callable", "parentheses after something that is not a function"),
    Mistake("brackets-missing", "a method without its parentheses"),
    Mistake("no-value-yet", "a variable that has no value yet"),
    Mistake("none-used", "None where an object is expected"),
    Mistake("name-taken", "a name that every node already uses"),
    Mistake("not-importable", "an import of something that does not exist"),
    Mistake("division-by-zero", "a division by zero"),
    Mistake("index-error", "a list index out of range"),
    Mistake("calls-itself", "a function that calls itself endlessly"),
    Mistake("made-anew", "a publisher, a subscription or a timer created on every call"),
    Mistake("slow-callback", "callbacks that take too long"),
    Mistake("endless-chain", "callbacks that trigger each other endlessly"),
    Mistake("raised", "another exception"),
    Mistake("no-node", "something that is not a node class"),
    Mistake("exits", "a node that ends the whole program"),
    Mistake("no-publisher", "no publisher"),
    Mistake("never-published", "a publisher that publishes nothing"),
    Mistake("gone-quiet", "a publisher that has stopped publishing"),
    Mistake("no-subscription", "no subscription"),
    Mistake("node-ended", "a node that has ended"),
    Mistake("topic-unknown", "a topic that no node uses"),
    Mistake("other-domain", "nodes in another ROS domain"),
    Mistake("no-timer", "a callback that nothing calls"),
    Mistake("wrong-rate", "a different rate than requested"),
    Mistake("wrong-depth", "a different queue depth than requested"),
    Mistake("wrong-values", "different values than requested"),
    Mistake("nothing-logged", "a missing log line"),
    Mistake("boundary", "exactly at a limit: the wrong side"),
    Mistake("wrong-state", "a different state than requested"),
    Mistake("wrong-topic", "a different topic than requested"),
    Mistake("wrong-start", "a different initial value than requested"),
    Mistake("wrong-unit", "a different unit than requested"),
    Mistake("converted-back", "the converted value is kept for the next step"),
    Mistake("never-changes", "a random walk that never changes"),
    Mistake("one-way", "a random walk that goes only one way"),
    Mistake("not-random", "a walk that is not random"),
    Mistake("forgets-itself", "a random walk that forgets its last value"),
    Mistake("set-back", "a random walk that is reset at a limit"),
    Mistake("wraps-round", "a random walk that wraps around at a limit"),
    Mistake("jumps", "a random walk that jumps"),
    Mistake("uneven-steps", "steps that are wider in one direction"),
    Mistake("step-too-wide", "steps that are too wide"),
    Mistake("step-too-small", "steps that are too small"),
    Mistake("no-clamp", "a value that is not clamped"),
    Mistake("clamp-swapped", "min and max swapped"),
    Mistake("clamped-too-early", "the clamp applied before the step"),
    Mistake("clamp-not-kept", "the clamped value is published but not kept"),
    Mistake("other-limits", "different limits than requested"),
    Mistake("alert-too-many", "an unnecessary alert"),
    Mistake("alert-missing", "a missing alert"),
    Mistake("wrong-window", "a mean over a different window"),
    Mistake("wrong-word", "a different word than requested"),
    Mistake("no-hysteresis", "a status that flickers"),
    Mistake("hysteresis-lost", "a status that returns too late"),
    Mistake("status-repeated", "an unchanged status that is repeated"),
    Mistake("package-misspelled", "a package name that does not exist"),
    Mistake("package-name", "a name that a package cannot have"),
    Mistake("package-renamed", "a manifest that names another package"),
    Mistake("names-differ", "different package names in setup.py and package.xml"),
    Mistake("package-twice", "two packages with the same name"),
    Mistake("no-packages", "nothing to build"),
    Mistake("no-manifest", "a folder without package.xml"),
    Mistake("manifest-open", "a placeholder left in the manifest"),
    Mistake("manifest-unreadable", "a manifest that is not valid XML"),
    Mistake("manifest-value", "an invalid value in the manifest"),
    Mistake("tag-misspelled", "an unknown tag in the manifest"),
    Mistake("dependency-missing", "a dependency that is not declared"),
    Mistake("dependency-misspelled", "a dependency on a package that does not exist"),
    Mistake("no-setup-call", "a setup.py that does not call setup"),
    Mistake("packages-missing", "a setup.py that installs no code"),
    Mistake("entry-point-form", "an entry point that is not name = package.module:function"),
    Mistake("other-function", "an entry point that calls another file's function"),
    Mistake("data-files-missing", "a setup.py that leaves out the marker or the manifest"),
    Mistake("entry-points-hidden", "entry points that only running setup.py would reveal"),
    Mistake("group-misspelled", "entry points in an unknown group"),
    Mistake("no-function", "something that is not a function"),
    Mistake("does-not-return", "a function that does not return"),
    Mistake("returns-nothing", "a function without a return"),
    Mistake("not-plain", "a result that is not plain data"),
    Mistake("f-missing", "a string with braces but no f before it"),
    Mistake("stray-characters", "extra characters in a text"),
    Mistake("folder-gone", "a terminal whose folder was removed"),
    Mistake("folder-exists", "a folder that already exists"),
    Mistake("folder-not-found", "a folder that does not exist"),
    Mistake("not-a-folder", "a file where a folder is expected"),
    Mistake("is-a-folder", "a folder where a file is expected"),
    Mistake("file-not-found", "a file that does not exist"),
    Mistake("parents-missing", "a folder whose parent does not exist"),
    Mistake("tilde-missing", "a path that begins at the root by mistake"),
    Mistake("absolute-path", "an absolute path instead of a relative one"),
    Mistake("levels-miscounted", "a path with too few or too many levels"),
    Mistake("path-misspelled", "a misspelled path"),
    Mistake("path-separator", "a path without a slash as its separator"),
    Mistake("folders-side-by-side", "folders side by side instead of nested"),
    Mistake("folders-swapped", "the inner and the outer folder swapped"),
    Mistake("space-missing", "two words without a space between them"),
    Mistake("space-too-many", "a space in the middle of a path"),
    Mistake("commas-between-names", "commas instead of spaces"),
    Mistake("command-misspelled", "a command that does not exist"),
    Mistake("prompt-typed", "the prompt typed along with the command"),
    Mistake("not-installed", "a program that is not installed"),
    Mistake("ros-1-command", "a command of ROS 1"),
    Mistake("environment-inactive", "a terminal without the course's environment"),
    Mistake("other-python", "a Python without ROS"),
    Mistake("ros-elsewhere", "a ROS installation that does not exist here"),
    Mistake("dot-slash-missing", "a program in this folder without ./"),
    Mistake("not-executable", "a file without permission to execute"),
    Mistake("word-misspelled", "a word that the command does not have"),
    Mistake("word-missing", "a command without a required argument"),
    Mistake("option-missing", "an option's value without the option"),
    Mistake("option-misspelled", "an option that does not exist"),
    Mistake("edited-in-install", "a change in install instead of src"),
    Mistake("only-printed", "a change that is printed and not saved"),
    Mistake("nothing-replaced", "a text to replace that is not in the file"),
    Mistake("not-linked", "a build that copies instead of linking"),
    Mistake("other-file", "a change in a different file than requested"),
    Mistake("other-package", "a different package than requested"),
)

_PAGES_07_TO_13 = (
    # Those of page 07.
    # Findings about a system.
    Mistake("finding-missing", "a question without an answer"),
    Mistake("finding-wrong", "a finding that the system contradicts"),
    Mistake("other-kind", "a different kind of finding than requested"),
    Mistake("name-incomplete", "part of a name instead of the full name"),
    Mistake("not-in-graph", "a name that nothing in the graph has"),
    Mistake("sides-confused", "the two sides of a topic confused"),
    Mistake("period-for-rate", "a period instead of a rate"),
    # Parameters.
    Mistake("parameter-frozen", "a parameter that is read only once"),
    Mistake("parameter-late", "a parameter that takes effect one reading too late"),
    Mistake("parameter-refused", "a parameter that refuses a valid value"),
    Mistake("parameters-swapped", "two parameters swapped"),
    # Log lines as messages.
    Mistake("level-too-low", "a counted log line that is not a warning"),
    Mistake("level-missed", "a level above a warning left out"),
    Mistake("text-for-name", "a log line's text instead of its node's name"),
    Mistake("own-name", "the listener's own name instead of the logging node's"),
    Mistake("said-once", "a name that is reported only the first time"),
    Mistake("decimals-lost", "a decimal number turned into a whole one"),
    Mistake("one-name-only", "warnings from one node only"),
    # Those of page 08.
    Mistake("not-kept", "a message that is not kept for late-joining subscriptions"),
    Mistake("old-words-too", "too many messages kept for late-joining subscriptions"),
    Mistake("change-missing", "a change that is not published"),
    Mistake("queue-too-short", "a queue that is too short for the pause"),
    Mistake("heard-twice", "the same message received by two subscriptions"),
    Mistake("no-deadline", "no deadline"),
    Mistake("deadline-unheard", "a deadline without an event callback"),
    Mistake("deadline-wrong-side", "a deadline on the other side of a topic"),
    Mistake("wrong-deadline", "a different deadline than requested"),
    Mistake("lifespan-too-short", "a lifespan that discards messages too early"),
    # Those of page 09.
    Mistake("parameter-type", "a parameter of a different type than declared"),
    Mistake("parameter-undeclared", "a parameter that is not declared"),
    Mistake("parameter-twice", "a parameter declared twice"),
    Mistake("parameter-for-value", "a parameter used instead of its value"),
    Mistake("absolute-name", "an absolute name, which no namespace changes"),
    Mistake("limits-fixed", "limits that no parameter changes"),
    Mistake("unit-fixed", "a unit that no parameter changes"),
    Mistake("other-default", "a different default value than requested"),
    Mistake("beat-starved", "a heartbeat that is delayed by the work"),
    Mistake("work-too-short", "work that takes too little time"),
    Mistake("work-too-long", "work that takes too much time"),
    Mistake("work-at-once", "two orders processed at the same time"),
    Mistake("order-lost", "an order that is never processed"),
    Mistake("order-swapped", "orders processed in a different sequence"),
    Mistake("done-twice", "an order reported as done twice"),
    Mistake("silence-unnoticed", "a silence that is not detected"),
    Mistake("noticed-afterwards", "a silence detected only after it has ended"),
    Mistake("noticed-early", "a silence reported although there is none"),
    Mistake("noticed-late", "a silence detected too late"),
    Mistake("lost-before-found", "a sensor reported lost before it was found"),
    Mistake("back-missing", "a return that is not reported"),
    Mistake("back-too-often", "a return reported for a sensor that was not lost"),
    Mistake("wrong-form", "a text in a different format"),
    # Those of page 10.
    # What a patient may have.
    Mistake("wrong-namespace", "a topic name in another namespace"),
    Mistake("two-sources", "two publishers instead of one"),
    Mistake("depth-too-small", "a queue that is too short for a burst"),
    # What a diagnosis may be.
    Mistake("contradicted", "a diagnosis that the instruments contradict"),
    Mistake("other-place", "the right kind of fault in another place"),
    Mistake("no-such-diagnosis", "a diagnosis that is not in the clinic's list"),
    Mistake("no-such-place", "a place that the patient does not have"),
    Mistake("no-diagnosis-yet", "a patient without a diagnosis"),
    Mistake("half-a-diagnosis", "one diagnosis for two faults"),
    Mistake("no-diagnoses", "a result without diagnoses"),
    # Those of page 11.
    Mistake("all-topics", "messages from other topics counted"),
    Mistake("nan-left-out", "a message left out because it holds NaN"),
    Mistake("counted-wrong", "a count that is off by one"),
    Mistake("other-gap", "a different gap than requested"),
    Mistake("nan-spreads", "a NaN that turns a mean into NaN"),
    Mistake("wrong-share", "a sum divided by a different count"),
    Mistake("other-mean", "a number that is not the mean"),
    Mistake("no-dict", "a result that is not a dict"),
    Mistake("key-missing", "a result without a required key"),
    Mistake("no-number", "a result that is not a single number"),
    Mistake("fixed-answer", "the same answer for every input"),
    Mistake("nan-compared", "a NaN that is not detected"),
    Mistake("nan-kept", "a NaN kept for the next comparison"),
    Mistake("alarm-at-start", "an alarm for the first reading"),
    Mistake("one-direction", "a difference detected in one direction only"),
    Mistake("other-reading", "a comparison with a different reading"),
    Mistake("zero-is-false", "0 treated as a missing value"),
    Mistake("never-reset", "a state that is never reset"),
    Mistake("nearly-equal", "nearly equal values treated as equal"),
    Mistake("no-readings", "a test without readings"),
    Mistake("no-reading", "a reading that is not a number"),
    Mistake("too-many-readings", "a test with too many readings"),
    Mistake("test-lacks-case", "a test without the case that would reveal the fault"),
    Mistake("test-one-direction", "a test in one direction only"),
    Mistake("test-at-limit", "a test that stops just before the fault shows"),
    Mistake("test-no-effect", "a test whose case has no effect"),
    # Those of page 12.
    Mistake("no-service", "no service"),
    Mistake("service-misspelled", "a service or an action with another name"),
    Mistake("response-missing", "a service callback that returns nothing"),
    Mistake("response-wrong", "a service callback that does not return the response"),
    Mistake("response-not-filled", "a response whose success is not set"),
    Mistake("reason-missing", "a refusal without a reason"),
    Mistake("nonsense-accepted", "an implausible value accepted"),
    Mistake("nan-accepted", "a NaN that passes every comparison"),
    Mistake("not-a-goal-response", "a goal callback that does not return a GoalResponse"),
    Mistake("good-value-refused", "a valid value refused"),
    Mistake("refused-and-kept", "a value refused but used anyway"),
    Mistake("accepted-and-lost", "a value accepted but not used"),
    Mistake("not-validated", "a parameter that accepts any value"),
    Mistake("result-of-another-kind", "a parameter callback that does not return a result"),
    Mistake("validated-one-by-one", "a new value compared with an old one"),
    Mistake("no-action", "no action server"),
    Mistake("result-missing", "work on a goal that returns no result"),
    Mistake("result-wrong", "a result with different content"),
    Mistake("feedback-wrong", "feedback of the wrong kind"),
    Mistake("feedback-missing", "feedback that is not sent every second"),
    Mistake("canceled-unasked", "a goal reported canceled without a request"),
    Mistake("ended-twice", "a goal that ends twice"),
    Mistake("await-missing", "a future used instead of its result"),
    Mistake("not-an-integer", "a number that is not whole"),
    Mistake("succeed-forgotten", "a goal that was reached but not reported"),
    Mistake("never-ends", "work that does not end"),
    Mistake("ends-too-soon", "work that ends before the goal is reached"),
    Mistake("left-on", "a heater that is never switched off"),
    Mistake("cancel-refused", "a goal that cannot be canceled"),
    Mistake("cancel-ignored", "a cancel request that the work ignores"),
    Mistake("cancel-not-reported", "a canceled goal reported with another status"),
    # Those of page 13.
    Mistake("no-system", "something that is not a list of nodes"),
    Mistake("two-controllers", "two nodes that command one actuator"),
    Mistake("two-tasks", "one node with two tasks"),
    Mistake("shared-variable", "nodes that share a variable instead of a topic"),
    Mistake("falls-together", "a node whose end stops another one"),
    Mistake("never-switched-on", "an actuator that is not switched on when it should be"),
    Mistake("wrong-duration", "a different duration than requested"),
    Mistake("rest-too-short", "a rest that is too short"),
    Mistake("no-interlock", "two actuators on that exclude each other"),
    Mistake("alarm-too-early", "an alarm that comes too early"),
    Mistake("nonsense-believed", "an impossible reading treated as valid"),
    Mistake("limit-fixed", "a limit that no parameter changes"),
    # Those of grading.
    Mistake("unreadable-cell", "a cell that Python cannot read"),
    Mistake("too-long", "a program that does not end"),
    Mistake("too-much-memory", "a program that uses too much memory"),
    Mistake("too-much-output", "a program that prints endlessly"),
    Mistake("crashed", "a process that crashed"),
    Mistake("left-early", "a program that ends its process"),
    Mistake("evidence-unreadable", "a run whose evidence cannot be read"),
)

MISTAKES: dict[str, Mistake] = {
    one.id: one for one in (*_OF_THE_TABLE, *_PAGES_00_TO_06, *_PAGES_07_TO_13)
}


def unknown_mistake(name: str) -> str:
    """Return what to say to an author who uses a name that the catalog doesn't have."""
    words = {one.id: f"{one.id} {one.title}" for one in MISTAKES.values()}
    rated = sorted(words, key=lambda one: -_likeness(name, words[one]))
    near = ", ".join(f"{one!r} ({MISTAKES[one].title})" for one in rated[:3])
    return (
        f"There is no mistake {name!r}. Every name is a line of rosbeat/diagnosis/mistakes.py, "
        f"which gives it the title that a learner reads. Use the name of one that is there, such "
        f"as {near}, or add a line."
    )


def _likeness(name: str, text: str) -> float:
    """Return how much alike a name and a mistake are, by letters of its id and by whole words."""
    shared = set(name.split("-")) & set(re.findall(r"\w+", text)) - _SMALL_WORDS
    return SequenceMatcher(None, name, text.split()[0]).ratio() + len(shared) / 4


def in_html(text: str, code: Callable[[str], str] = escape) -> str:
    """Return the HTML of what is said; what stands between backquotes becomes a `<code>` element.

    Args:
        text: Any text.
        code: Makes the HTML of what is inside such an element.
    """
    plain_and_code = _CODE.split(text)
    return "".join(
        f"<code>{code(part)}</code>" if number % 2 else escape(part)
        for number, part in enumerate(plain_and_code)
    )
