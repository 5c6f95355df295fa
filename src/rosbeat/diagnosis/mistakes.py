"""Name the mistakes that learners make.

The first thirty are those that learners of this tutorial make most; `row` is their number in the
course's table (docs/mistakes.md). A row that holds several mistakes has several names. The others
belong to one exercise or another and have no row.
"""

from __future__ import annotations

from dataclasses import dataclass


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
    """

    mistake: str
    evidence: str
    hint: str


@dataclass(frozen=True)
class Meaning:
    """Hold what an error means, in the words of this course.

    Attributes:
        mistake: Its id, from `mistakes.MISTAKES`.
        means: What happened, as a sentence or two.
        to_try: Where to look, without the answer, one or two sentences.
        aside: A sentence about the error's own words, for where they stand above; may be empty.
    """

    mistake: str
    means: str
    to_try: str
    aside: str = ""

    @property
    def beside_error(self) -> str:
        """Return what happened, said where the error's own words can be read."""
        return f"{self.means} {self.aside}".strip()


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
    Mistake("constructor-blocks", "a constructor that does not return", 16),
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
    Mistake("wrong-attribute", "an attribute or a method that is not there"),
    Mistake("argument-missing", "an argument is missing"),
    Mistake("wrong-argument", "an argument of another kind than is wanted"),
    Mistake("self-missing", "a method without self"),
    Mistake("constructor-parameters", "a constructor that wants to be given something"),
    Mistake("field-without-name", "a message's value without the name of its field"),
    Mistake("message-for-value", "a message where the value in it is meant"),
    Mistake("class-changed", "a value put into a message class"),
    Mistake("text-and-number", "a text and a number put together"),
    Mistake("decimal-comma", "a decimal number with a comma"),
    Mistake("format-code", "a format that does not fit the value"),
    Mistake("logged-no-text", "something logged that is no text"),
    Mistake("not-callable", "brackets after something that is no function"),
    Mistake("brackets-missing", "a method without its brackets"),
    Mistake("no-value-yet", "a variable that has no value yet"),
    Mistake("none-used", "None where an object is meant"),
    Mistake("name-taken", "a name that the node needs for itself"),
    Mistake("not-importable", "an import of something that is not there"),
    Mistake("division-by-zero", "a division by zero"),
    Mistake("index-error", "a place that a list does not have"),
    Mistake("calls-itself", "a function that calls itself without end"),
    Mistake("made-anew", "a publisher, a subscription or a timer made at each call"),
    Mistake("slow-callback", "callbacks that take long"),
    Mistake("endless-chain", "callbacks that cause each other without end"),
    Mistake("raised", "an exception of another kind"),
    Mistake("no-node", "something that is not a node class"),
    Mistake("exits", "the program is ended from inside"),
    Mistake("no-publisher", "nothing to publish with"),
    Mistake("never-published", "a publisher that is never used"),
    Mistake("gone-quiet", "a publisher that has stopped publishing"),
    Mistake("no-subscription", "nothing that listens"),
    Mistake("node-ended", "a node that has ended"),
    Mistake("topic-unknown", "a topic that nobody uses"),
    Mistake("other-domain", "nodes in another ROS domain"),
    Mistake("no-timer", "nothing that calls the callback"),
    Mistake("wrong-rate", "another rate than asked for"),
    Mistake("wrong-depth", "another queue depth than asked for"),
    Mistake("wrong-values", "other values than asked for"),
    Mistake("nothing-logged", "nothing is said about a reading"),
    Mistake("boundary", "a limit counted to the wrong side"),
    Mistake("wrong-state", "another state than asked for"),
    Mistake("wrong-topic", "another topic than asked for"),
    Mistake("wrong-start", "another start than asked for"),
    Mistake("wrong-unit", "another unit than asked for"),
    Mistake("converted-back", "the converted number is kept as the next start"),
    Mistake("never-changes", "a walk that stands still"),
    Mistake("one-way", "a walk that goes only one way"),
    Mistake("not-random", "a walk without chance"),
    Mistake("forgets-itself", "a walk that forgets where it was"),
    Mistake("set-back", "a walk that is set back at a limit"),
    Mistake("wraps-round", "a walk that goes on at the other limit"),
    Mistake("jumps", "a walk that jumps"),
    Mistake("uneven-steps", "steps wider in one direction than in the other"),
    Mistake("step-too-wide", "steps wider than asked for"),
    Mistake("step-too-small", "steps smaller than asked for"),
    Mistake("no-clamp", "a limit that nothing keeps"),
    Mistake("clamp-swapped", "min and max the wrong way round"),
    Mistake("clamped-too-early", "the clamp before the step"),
    Mistake("clamp-not-kept", "the clamped number is published and not kept"),
    Mistake("other-limits", "other limits than asked for"),
    Mistake("alert-too-many", "an alert that nobody needs"),
    Mistake("alert-missing", "an alert that is missing"),
    Mistake("wrong-window", "another mean than asked for"),
    Mistake("wrong-word", "another word than asked for"),
    Mistake("no-hysteresis", "a status that flickers"),
    Mistake("hysteresis-lost", "a status that does not come back in time"),
    Mistake("status-repeated", "a status said again that has not changed"),
    Mistake("package-misspelled", "a package's name that nobody has"),
    Mistake("package-name", "a name that a package cannot have"),
    Mistake("package-renamed", "a manifest that names another package"),
    Mistake("names-differ", "setup.py and package.xml name two packages"),
    Mistake("package-twice", "two packages of one name"),
    Mistake("no-packages", "nothing to build"),
    Mistake("no-manifest", "a folder without package.xml"),
    Mistake("manifest-open", "a text of the manifest that is still open"),
    Mistake("manifest-unreadable", "a manifest that is no XML"),
    Mistake("manifest-value", "a value that a manifest cannot have"),
    Mistake("tag-misspelled", "a tag that manifests do not have"),
    Mistake("dependency-missing", "a dependency that is not written down"),
    Mistake("dependency-misspelled", "a dependency on a package that nobody has"),
    Mistake("no-setup-call", "a setup.py that does not call setup"),
    Mistake("packages-missing", "a setup.py that installs no code"),
    Mistake("entry-point-form", "an entry point that is not name = package.module:function"),
    Mistake("other-function", "an entry point that calls the other file's function"),
    Mistake("data-files-missing", "a setup.py that leaves out the marker or the manifest"),
    Mistake("entry-points-hidden", "entry points that only running setup.py would show"),
    Mistake("group-misspelled", "entry points where nobody looks for them"),
    Mistake("swallowed-parameter", "a parameter that is not used"),
    Mistake("parameters-changed", "a function with other parameters than asked for"),
    Mistake("no-function", "something that is no function"),
    Mistake("does-not-return", "a function that does not come back"),
    Mistake("returns-nothing", "a function without a return"),
    Mistake("not-plain", "a result that is no plain data"),
    Mistake("not-a-text", "something else than the text that was asked for"),
    Mistake("f-missing", "a text with braces and no f before it"),
    Mistake("stray-characters", "more characters than belong to a text"),
    Mistake("folder-gone", "a terminal whose folder was removed"),
    Mistake("folder-exists", "a folder that is there already"),
    Mistake("folder-not-found", "a folder that is not there"),
    Mistake("not-a-folder", "a file where a folder belongs"),
    Mistake("is-a-folder", "a folder where a file belongs"),
    Mistake("file-not-found", "a file that is not there"),
    Mistake("parents-missing", "a folder in a folder that is not there"),
    Mistake("tilde-missing", "a path that begins at the top of the disk by mistake"),
    Mistake("absolute-path", "an absolute path where a relative one was asked for"),
    Mistake("levels-miscounted", "a path with a level too few or too many"),
    Mistake("path-misspelled", "a path with a letter wrong"),
    Mistake("path-separator", "a path with another sign than a slash"),
    Mistake("folders-side-by-side", "folders side by side instead of one in another"),
    Mistake("folders-swapped", "the inner folder outside"),
    Mistake("space-missing", "two words without a space between them"),
    Mistake("space-too-many", "a space in the middle of a path"),
    Mistake("commas-between-names", "commas where spaces belong"),
    Mistake("command-misspelled", "a command that there is not"),
    Mistake("prompt-typed", "the prompt typed along with the command"),
    Mistake("not-installed", "a program that is not installed"),
    Mistake("ros-1-command", "a command of ROS 1"),
    Mistake("environment-inactive", "a terminal without the course's environment"),
    Mistake("other-python", "a Python without ROS"),
    Mistake("ros-elsewhere", "a ROS that is not installed there"),
    Mistake("dot-slash-missing", "a program of this folder without ./"),
    Mistake("not-executable", "a file that may not be started"),
    Mistake("word-misspelled", "a word that the command does not know"),
    Mistake("word-missing", "a command without a word that it needs"),
    Mistake("option-missing", "an option's value without the option"),
    Mistake("option-misspelled", "an option that there is not"),
    Mistake("not-renamed", "a node that keeps its own name"),
    Mistake("wrong-node-name", "another node name than asked for"),
    Mistake("other-executable", "another executable than asked for"),
    Mistake("nobody-publishes", "a listener whose publisher does not run"),
    Mistake("other-package", "another package than asked for"),
)

_OF_PAGES = (
    # Those of page 07.
    # Findings about a system.
    Mistake("finding-missing", "a question that has no answer any more"),
    Mistake("finding-wrong", "a finding that the system contradicts"),
    Mistake("other-kind", "a finding of another kind than was asked for"),
    Mistake("name-incomplete", "a part of a name in the place of the whole"),
    Mistake("not-in-graph", "a name that nothing in the graph has"),
    Mistake("sides-confused", "one side of a topic taken for the other"),
    Mistake("period-for-rate", "seconds from one message to the next instead of messages a second"),
    # Parameters.
    Mistake("parameter-frozen", "a parameter that is read only once"),
    Mistake("parameter-late", "a parameter that counts one reading too late"),
    Mistake("parameter-refused", "a parameter that refuses a good value"),
    Mistake("parameters-swapped", "two parameters in each other's place"),
    # Log lines as messages.
    Mistake("level-too-low", "a log line counted that is no warning"),
    Mistake("level-missed", "a level left out that is worse than a warning"),
    Mistake("text-for-name", "a log line's text in the place of its node's name"),
    Mistake("own-name", "the listener's own name in the place of the speaker's"),
    Mistake("said-once", "a name that is said only the first time"),
    Mistake("decimals-lost", "a decimal number made a whole one"),
    Mistake("one-name-only", "warnings of one node only"),
    # Those of page 08.
    Mistake("not-kept", "a last word that is not kept for those who come late"),
    Mistake("old-words-too", "more kept for those who come late than asked for"),
    Mistake("change-missing", "a change that nobody is told about"),
    Mistake("queue-too-short", "a queue too short for the pause"),
    Mistake("heard-twice", "the same message heard by two subscriptions"),
    Mistake("no-deadline", "a silence that nothing measures"),
    Mistake("deadline-unheard", "a deadline that nobody is told about"),
    Mistake("deadline-wrong-side", "a deadline where nothing is waited for"),
    Mistake("wrong-deadline", "another deadline than asked for"),
    Mistake("lifespan-too-short", "a lifespan that throws messages away too early"),
    # Those of page 09.
    Mistake("parameter-type", "a parameter of another type than declared"),
    Mistake("parameter-undeclared", "a parameter that was not declared"),
    Mistake("parameter-twice", "a parameter declared twice"),
    Mistake("parameter-for-value", "a parameter where its value is meant"),
    Mistake("absolute-name", "a name that no namespace moves"),
    Mistake("limits-fixed", "limits that no parameter changes"),
    Mistake("unit-fixed", "a unit that no parameter changes"),
    Mistake("other-default", "another default than asked for"),
    Mistake("beat-starved", "a beat that waits for the work"),
    Mistake("work-too-short", "work that takes less time than it has to"),
    Mistake("work-too-long", "work that takes more time than it has to"),
    Mistake("work-at-once", "two orders worked on at once"),
    Mistake("order-lost", "an order that nobody works on"),
    Mistake("order-swapped", "orders done in another order than they came"),
    Mistake("done-twice", "an order reported done twice"),
    Mistake("silence-unnoticed", "a silence that nobody notices"),
    Mistake("noticed-afterwards", "a silence noticed only when it is over"),
    Mistake("noticed-early", "a silence reported that is none"),
    Mistake("noticed-late", "a silence noticed too late"),
    Mistake("lost-before-found", "a sensor reported lost that was never there"),
    Mistake("back-missing", "a return that nobody reports"),
    Mistake("back-too-often", "a return reported of one that was not lost"),
    Mistake("wrong-form", "a text whose parts stand in another form than asked for"),
    # Those of page 10.
    # What a patient may have.
    Mistake("wrong-namespace", "a topic's name in another namespace"),
    Mistake("two-sources", "two publishers where one was ordered"),
    Mistake("depth-too-small", "a queue too short for what comes at once"),
    # What a diagnosis may be.
    Mistake("contradicted", "a diagnosis that the instruments contradict"),
    Mistake("other-place", "the right kind of fault at another place"),
    Mistake("no-such-diagnosis", "a diagnosis that the clinic does not know"),
    Mistake("no-such-place", "a place that the patient does not have"),
    Mistake("no-diagnosis-yet", "a patient without a diagnosis"),
    Mistake("half-a-diagnosis", "one diagnosis where there are two faults"),
    Mistake("no-diagnoses", "a result that holds no diagnoses"),
    # Those of page 11.
    Mistake("all-topics", "messages of another topic counted"),
    Mistake("nan-left-out", "a message left out because it holds no number"),
    Mistake("counted-wrong", "counted one too many or too few"),
    Mistake("other-gap", "another stretch of time than asked for"),
    Mistake("nan-spreads", "a NaN that spoils a mean"),
    Mistake("wrong-share", "a sum divided by another count than its own"),
    Mistake("other-mean", "another number than the mean"),
    Mistake("no-dict", "a result without names"),
    Mistake("key-missing", "a result without a name that was asked for"),
    Mistake("no-number", "something else than one number"),
    Mistake("fixed-answer", "the same answer whatever is given"),
    Mistake("nan-compared", "a NaN that nobody notices"),
    Mistake("nan-kept", "a NaN kept for the next comparison"),
    Mistake("alarm-at-start", "an alarm for the very first reading"),
    Mistake("one-direction", "a difference noticed in one direction only"),
    Mistake("other-reading", "compared with another reading than asked for"),
    Mistake("zero-is-false", "0 taken for nothing"),
    Mistake("never-reset", "a memory that is never reset"),
    Mistake("nearly-equal", "nearly equal taken for equal"),
    Mistake("too-few-pairs", "a mean of too few pairs"),
    Mistake("mean-of-sizes", "signs lost before the mean is made"),
    Mistake("pairs-mixed-up", "pairs that do not belong together"),
    # Those of page 12.
    Mistake("no-service", "nothing that answers"),
    Mistake("service-misspelled", "a service or action under another name"),
    Mistake("response-missing", "a service's callback that gives nothing back"),
    Mistake("response-wrong", "something else given back than the response"),
    Mistake("response-not-filled", "a response that says no although it was done"),
    Mistake("reason-missing", "a refusal without a reason"),
    Mistake("nonsense-accepted", "a value accepted that makes no sense"),
    Mistake("nan-accepted", "a NaN that passes because it compares with nothing"),
    Mistake("good-value-refused", "a good value refused"),
    Mistake("refused-and-kept", "a value refused and used all the same"),
    Mistake("accepted-and-lost", "a value accepted and not used"),
    Mistake("not-validated", "a parameter that takes any value"),
    Mistake("result-of-another-kind", "a parameter callback that gives back no result"),
    Mistake("validated-one-by-one", "a new value compared with an old one"),
    Mistake("no-action", "nothing that takes a goal"),
    Mistake("result-missing", "work that gives no result back"),
    Mistake("result-wrong", "a result that holds something else"),
    Mistake("feedback-wrong", "something else than feedback"),
    Mistake("feedback-missing", "feedback that does not come each second"),
    Mistake("canceled-unasked", "a goal reported canceled that nobody canceled"),
    Mistake("ended-twice", "a goal that ends twice"),
    Mistake("await-missing", "a future where its result is meant"),
    Mistake("not-an-integer", "a number that is not whole"),
    Mistake("succeed-forgotten", "a goal that was reached and is not reported"),
    Mistake("never-ends", "work that does not end"),
    Mistake("ends-too-soon", "work that ends before the goal is reached"),
    Mistake("left-on", "a heater that nobody switches off"),
    Mistake("cancel-refused", "a goal that cannot be canceled"),
    Mistake("cancel-ignored", "a cancel that the work does not look at"),
    Mistake("cancel-not-reported", "a canceled goal that is reported as another end"),
    # Those of page 13.
    Mistake("no-system", "something that is no list of nodes"),
    Mistake("two-controllers", "two nodes that command one actuator"),
    Mistake("two-tasks", "one node with two tasks"),
    Mistake("shared-variable", "nodes that share a variable and no topic"),
    Mistake("falls-together", "a node that takes another one down with it"),
    Mistake("never-switched-on", "an actuator that is not switched on when it should be"),
    Mistake("wrong-duration", "another duration than asked for"),
    Mistake("rest-too-short", "a rest that is too short"),
    Mistake("no-interlock", "two actuators at work that exclude each other"),
    Mistake("alarm-too-early", "an alarm before its time"),
    Mistake("nonsense-believed", "a reading that cannot be is believed"),
    Mistake("limit-fixed", "a limit that cannot be set from outside"),
    # Those of grading.
    Mistake("unreadable-cell", "a cell that Python cannot read"),
    Mistake("too-long", "a program that does not come to an end"),
    Mistake("too-much-memory", "a program that takes more and more memory"),
    Mistake("too-much-output", "a program that prints without end"),
    Mistake("crashed", "a process that died"),
    Mistake("left-early", "a program that ends its process"),
    Mistake("evidence-unreadable", "a run that leaves something else than evidence"),
)

MISTAKES: dict[str, Mistake] = {one.id: one for one in (*_OF_THE_TABLE, *_OTHERS, *_OF_PAGES)}


def mistake(name: str) -> Mistake:
    """Return a mistake by its id.

    Raises:
        KeyError: If there is no such mistake.
    """
    return MISTAKES[name]
