"""All answers about files and terminals, and what makes each of them."""

from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

from bank.workspaces import blind, entries, folders, functions, packages, programs
from bank.workspaces.answer import Answer
from bank.workspaces.shell import Terminal, typed
from rosbeat.exercises import scenarios
from rosbeat.exercises.check import check
from rosbeat.records import Outcome
from rosbeat.workspace.catching_up import FOLDERS, NODES, PACKAGE, finished

ANSWERS: tuple[Answer, ...] = (
    *folders.ANSWERS,
    *packages.ANSWERS,
    *entries.ANSWERS,
    *functions.ANSWERS,
    *programs.ANSWERS,
    *blind.ANSWERS,
)

#: What no hint may hold: the part of the reference solution that fills the blank.
SOLUTIONS = {
    "01a": ("resources/sounds/alarm",),
    "01b": ("../../src",),
    "02a": ("<license>Apache-2.0</license>",),
    "02b": ("--build-type ament_python", "--dependencies rclpy sensor_msgs"),
    "05a": ("sensor_simulator.temperature_publisher:main",),
    "05b": ("{executable} = {package}.{module}:{function}", "{package}.{module}"),
    "06a": ("sensor_simulator temperature_subscriber",),
    "06b": ("--symlink-install",),
}
_SETUP_CFG = (
    f"[develop]\nscript_dir=$base/lib/{PACKAGE}\n[install]\ninstall_scripts=$base/lib/{PACKAGE}\n"
)


@dataclass(frozen=True)
class Desk:
    """A workspace of one answer's own.

    Attributes:
        root: The workspace.
    """

    root: Path

    def write(self, path: str, text: str) -> None:
        """Write a file of the workspace, with its folders."""
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def furnish(self, with_package: bool) -> None:
        """Make the folders of page 01, and the finished package if it is asked for."""
        for folder in FOLDERS:
            (self.root / folder).mkdir(parents=True)
        if with_package:
            home = f"src/{PACKAGE}"
            for name in ("package.xml", "setup.py", *(f"{PACKAGE}/{node}.py" for node in NODES)):
                self.write(f"{home}/{name}", finished(name))
            self.write(f"{home}/setup.cfg", _SETUP_CFG)
            self.write(f"{home}/resource/{PACKAGE}", "")
            self.write(f"{home}/{PACKAGE}/__init__.py", "")

    def handed(self, answer: Answer) -> object:
        """Make what an answer says, and return what the page hands over to `check`."""
        self.furnish(with_package=answer.exercise > "02")
        if answer.also and answer.exercise != "05a":
            typed(answer.also, self.root)
        return getattr(self, f"_of_{answer.exercise}", self._typed)(answer)

    def _typed(self, answer: Answer) -> Path:
        typed(answer.given, self.root)
        return self.root

    def _of_01a(self, answer: Answer) -> Terminal:
        return typed(answer.given, self.root)

    def _of_02b(self, answer: Answer) -> Terminal:
        return typed(answer.given, self.root)

    def _of_01b(self, answer: Answer) -> Terminal:
        return typed(answer.given, self.root, "resources/images")

    def _of_02a(self, answer: Answer) -> Path:
        self.write(f"src/{PACKAGE}/package.xml", answer.given)
        return self.root

    def _of_05a(self, answer: Answer) -> Path:
        self.write(f"src/{PACKAGE}/setup.py", answer.given)
        if answer.also:
            typed(answer.also, self.root)
        return self.root

    def _of_05b(self, answer: Answer) -> object:
        space: dict[str, object] = {"__name__": "__main__"}
        exec(compile(answer.given, "<cell>", "exec", dont_inherit=True), space)
        return space["entry_point"]

    def _of_06a(self, answer: Answer) -> Terminal:
        typed(programs.COPY, self.root)
        # A terminal in which a node runs has no exit code; one whose command has failed has.
        running = "[INFO]" in answer.given
        return Terminal(self.root, answer.given, None if running else 1)


def outcome_of(answer: Answer, root: Path) -> Outcome:
    """Make an answer in a new workspace, and check it."""
    handed = Desk(root).handed(answer)
    if answer.exercise not in ("01a", "02b"):
        return check(answer.exercise, handed).outcome
    with patch.object(scenarios, "page_terminals", lambda: (handed,)):
        return check(answer.exercise, root).outcome
