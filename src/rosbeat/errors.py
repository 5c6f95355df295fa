"""Every error that rosbeat raises, in one tree.

::

    RosbeatError                    what happened, what it means, what to try
    ├── SessionError                a session was asked for something it cannot do
    │   ├── NodeClassError          what was added is not a node, or cannot be made into one
    │   │   └── NoSystemError       what should be a list of nodes is none
    │   ├── NodeConstructionError   the node's own constructor raised
    │   ├── DurationError           a time span that is negative, not finite or not a number
    │   ├── UnknownTopicError       nobody published on that topic
    │   ├── EndlessChainError       callbacks cause each other for ever without time passing
    │   ├── DeadlockError           callbacks wait for ever
    │   ├── DomainsExhaustedError   no private ROS domain id is left on this machine
    │   ├── NoSessionError          a node was made on a page with no session open
    │   └── ClosedSessionError      the session has ended
    ├── PictureError                a picture cannot be drawn from what it was given
    ├── ExerciseError               a check was asked for an exercise that does not exist
    ├── WorkspaceError              something in the learner's workspace is not as it is needed
    ├── TerminalError               a terminal of a page was asked for something it cannot do
    ├── LessonError                 a lesson source breaks a rule of the builder
    ├── BagError                    a recording cannot be written, read, replayed or compared
    ├── GradingError                submissions cannot be collected, graded or reported
    ├── RecordError                 saved data that does not follow the schema
    ├── CommandError                the command line was used in a way it does not know
    └── StoppedError                a person has stopped a command (Ctrl-C); what is done stays

This module imports nothing of rosbeat, so that every room of the house may raise.
"""

from __future__ import annotations

from collections.abc import Sequence


class RosbeatError(Exception):
    """An error that a person reads: what happened, what it means here, what to try.

    Args:
        what: What happened, one sentence.
        means: What that means in this place.
        to_try: What to do about it.
    """

    def __init__(self, what: str, means: str = "", to_try: str = "") -> None:
        super().__init__(what)
        self.what = what
        self.means = means
        self.to_try = to_try

    def __reduce__(self) -> tuple[type[RosbeatError], tuple[str, str, str]]:
        """All three parts go from one process to another."""
        return type(self), (self.what, self.means, self.to_try)

    def __str__(self) -> str:
        rows = [self.what]
        if self.means:
            rows.append(f"  What it means: {self.means}")
        if self.to_try:
            rows.append(f"  What to try:   {self.to_try}")
        return "\n".join(rows)

    def _render_traceback_(self) -> Sequence[str]:
        """Show the three parts instead of a stack of our own frames (IPython calls this)."""
        return f"{type(self).__name__}: {self}".splitlines()


class SessionError(RosbeatError):
    """A session was asked for something it cannot do."""


class DeadlockError(SessionError):
    """Callbacks wait for something that can never come."""


class NodeClassError(SessionError):
    """What was added to a session is not a node, nor something that makes one."""


class NoSystemError(NodeClassError):
    """What should be a list of nodes is none."""


class NodeConstructionError(SessionError):
    """A node's own constructor raised; the original exception is the cause."""


class DurationError(SessionError):
    """A time span is negative, not finite, or not a number."""


class UnknownTopicError(SessionError):
    """Nothing was published on the topic that was asked for."""


class EndlessChainError(SessionError):
    """Callbacks cause one another without end while no time passes."""


class DomainsExhaustedError(SessionError):
    """Every private ROS domain id of this machine is taken."""


class NoSessionError(SessionError):
    """A node was made on a page while no session was open and ROS was not started otherwise."""


class ClosedSessionError(SessionError):
    """The session has been closed, so its ROS context no longer exists."""


class PictureError(RosbeatError):
    """A picture cannot be drawn from what it was given."""


class ExerciseError(RosbeatError):
    """A check was asked for an exercise that does not exist."""


class WorkspaceError(RosbeatError):
    """Something in the learner's workspace is not as it is needed."""


class TerminalError(RosbeatError):
    """A terminal of a page was asked for something that it cannot do."""


class LessonError(RosbeatError):
    """A lesson source breaks a rule of the builder."""


class BagError(RosbeatError):
    """A recording cannot be written, read, replayed or compared."""


class GradingError(RosbeatError):
    """Submissions cannot be collected, graded or reported."""


class RecordError(RosbeatError):
    """Saved data does not follow the schema of the records."""


class CommandError(RosbeatError):
    """The command line was used in a way it does not know."""


class StoppedError(RosbeatError):
    """A person has stopped a command; what was done until then stays."""
