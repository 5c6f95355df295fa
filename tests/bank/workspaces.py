"""Make the workspace that an answer about files or a terminal leaves, and check it."""

import subprocess
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

from bank.reading import Answer
from rosbeat.exercises import scenarios
from rosbeat.exercises.check import check
from rosbeat.records import Outcome
from rosbeat.workspace.prerequisites import FOLDERS, NODES, PACKAGE, finished
from rosbeat.workspace.terminals.environment import program_environment

_SOURCE, _INSTALLED = f"src/{PACKAGE}", f"install/{PACKAGE}"
SETUP_CFG = (
    f"[develop]\nscript_dir=$base/lib/{PACKAGE}\n[install]\ninstall_scripts=$base/lib/{PACKAGE}\n"
)
_LIBRARY = f"{_INSTALLED}/lib/python3.11/site-packages"
#: Lines of a shell that leave what `colcon build` leaves.
BUILT = (
    f"mkdir -p {_LIBRARY} {_INSTALLED}/share/{PACKAGE} {_INSTALLED}/lib/{PACKAGE}\n"
    f"touch install/COLCON_IGNORE install/setup.bash {_INSTALLED}/share/{PACKAGE}/package.xml\n"
    f"cp -r {_SOURCE}/{PACKAGE} {_LIBRARY}/\n"
    + "".join(f"cp /bin/true {_INSTALLED}/lib/{PACKAGE}/{node}\n" for node in NODES)
)
#: Pages that a message leads back to, by what it says, and the files that their cells write.
SAVED_ON = {
    "page 03 or 04 that saves": [f"{PACKAGE}/{node}.py" for node in NODES],
    "page 04 that saves": [f"{PACKAGE}/{NODES[1]}.py"],
    "page 05 that saves": ["setup.py"],
}
#: Exercises that are answered with a file, and where it is.
FILES = {
    "02a": f"{_SOURCE}/package.xml",
    "05a": f"{_SOURCE}/setup.py",
    "05b": "src/lamp_control/setup.py",
}
#: All that are answered with a file or in a terminal.
EXERCISES = ("01a", "01b", "02a", "02b", "05a", "05b", "06a", "06b")

_RUN = r"""
for line in "$@"; do
    printf '%s$ %s\n' "${PWD/#$HOME/\~}" "$line"
    eval "$line"
    code=$?
done
printf '\036%s\036%s' "$code" "$PWD"
"""


@dataclass(frozen=True)
class Terminal:
    """Hold what a check reads of a terminal.

    Attributes:
        folder: Where it is.
        text: All that it shows.
        exit_code: Of the last command that ended; None while one runs.
    """

    folder: Path
    text: str
    exit_code: int | None = 0


def typed(lines: str, root: Path, start: str = ".") -> Terminal:
    """Type lines into a new bash, and say where that has led.

    Args:
        lines: What is typed, each line on its own.
        root: The workspace; the folder that holds it is the home.
        start: Where the bash starts, relative to the workspace.
    """
    env = {
        **program_environment(),
        "HOME": str(root.parent),
        "ROS2_WORKSPACE": str(root),
        "LC_ALL": "C",
    }
    done = subprocess.run(
        ["bash", "--norc", "-c", _RUN, "bash", *lines.strip("\n").splitlines()],
        cwd=root / start,
        env=env,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=100,
        check=True,
    )
    text, code, folder = done.stdout.decode().rsplit("\x1e", 2)
    return Terminal(Path(folder), text, int(code))


@dataclass(frozen=True)
class Desk:
    """Hold a workspace of one answer's own.

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
            for name in ("package.xml", "setup.py", *(f"{PACKAGE}/{node}.py" for node in NODES)):
                self.write(f"{_SOURCE}/{name}", finished(name))
            self.write(f"{_SOURCE}/setup.cfg", SETUP_CFG)
            self.write(f"{_SOURCE}/resource/{PACKAGE}", "")
            self.write(f"{_SOURCE}/{PACKAGE}/__init__.py", "")

    def receive(self, package: str, programs: tuple[str, ...]) -> None:
        """Make a package without entry points whose programs are there already."""
        folder = f"src/{package}"
        manifest = finished("package.xml").replace(PACKAGE, package)
        self.write(f"{folder}/package.xml", manifest)
        self.write(f"{folder}/setup.cfg", SETUP_CFG.replace(PACKAGE, package))
        self.write(f"{folder}/resource/{package}", "")
        for name in ("__init__", *programs):
            self.write(f"{folder}/{package}/{name}.py", "def main():\n    pass\n")

    def handed(self, answer: Answer) -> Path | Terminal:
        """Do what an answer says, and return what the page hands over to `check`."""
        self.furnish(with_package=answer.exercise > "02")
        if answer.exercise == "05b":
            self.receive("lamp_control", ("lamp", "switch"))
        if answer.exercise in FILES:
            self.write(FILES[answer.exercise], answer.text)
        if answer.before:
            typed(answer.before, self.root)
        if answer.exercise in FILES:
            return self.root
        if answer.exercise == "06a":
            typed(BUILT, self.root)
        start = "resources/images" if answer.exercise == "01b" else "."
        return typed(answer.text, self.root, start)


def outcome_of(answer: Answer, root: Path) -> Outcome:
    """Return what `check` says of an answer in a new workspace, which the environment names."""
    handed = Desk(root).handed(answer)
    if not isinstance(handed, Terminal) or answer.exercise == "01b":
        return check(answer.exercise, handed).outcome
    with patch.object(scenarios, "page_terminals", lambda: (handed,)):
        return check(answer.exercise, root).outcome
