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
    """Report an error in three parts: what happened, what it means here, what to try.

    Args:
        what: What happened, in one sentence.
        means: What that means here.
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
    """Signal that a session cannot do what it was asked to do."""


class DeadlockError(SessionError):
    """Signal that callbacks wait for something that can never happen."""


class NodeClassError(SessionError):
    """Signal that an object added to a session is neither a node nor a factory for nodes."""


class NoSystemError(NodeClassError):
    """Signal that an object is not a list of nodes."""


class NodeConstructionError(SessionError):
    """Signal that a node's constructor raised; the original exception is the cause."""


class DurationError(SessionError):
    """Signal that a duration is negative, infinite or not a number."""


class UnknownTopicError(SessionError):
    """Signal that nothing was published on the requested topic."""


class EndlessChainError(SessionError):
    """Signal that callbacks trigger each other endlessly while no time passes."""


class DomainsExhaustedError(SessionError):
    """Signal that every private ROS domain id of this machine is in use."""


class NoSessionError(SessionError):
    """Signal that a page created a node without an open session or an initialized ROS context."""


class ClosedSessionError(SessionError):
    """Signal that the session is closed, so its ROS context no longer exists."""


class PictureError(RosbeatError):
    """Signal that a picture cannot be drawn from the given data."""


class ExerciseError(RosbeatError):
    """Signal that an exercise, scenario or patient does not exist, or has invalid arguments."""


class WorkspaceError(RosbeatError):
    """Signal that the learner's workspace is not in the required state."""


class TerminalError(RosbeatError):
    """Signal that a terminal of a page cannot do what it was asked to do."""


class LessonError(RosbeatError):
    """Signal that a lesson source breaks a rule of the builder."""


class BagError(RosbeatError):
    """Signal that a recording cannot be written, read, replayed or compared."""


class GradingError(RosbeatError):
    """Signal that submissions cannot be collected, graded or reported."""


class RecordError(RosbeatError):
    """Signal that saved data does not follow the schema of the records."""


class CommandError(RosbeatError):
    """Signal that the command line was used incorrectly."""


class StoppedError(RosbeatError):
    """Signal that somebody stopped a command; what it had finished by then is kept."""
