"""Create what earlier pages leave in the workspace and is missing, so that pages run in any order.

A stage makes what one page leaves, and returns what it made or an empty text. It never changes what
a learner has made; if that is in the way it raises `InTheWay`, which says what to do.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

from rosbeat.errors import WorkspaceError, called_as
from rosbeat.workspace.location import workspace
from rosbeat.workspace.packages import (
    find_packages,
    is_stray,
    parse_manifest,
    read_package,
    with_entry_points,
)
from rosbeat.workspace.saving import save, trouble
from rosbeat.workspace.terminals.environment import program_environment

_PAGE = re.compile(r"\d\d?")
PACKAGE = "sensor_simulator"
FOLDERS = ("src", "docs", "scripts", "resources/images")
NODES = ("temperature_publisher", "temperature_subscriber")
_CREATE = (
    *("ros2", "pkg", "create", "--build-type", "ament_python", PACKAGE),
    *("--dependencies", "rclpy", "std_msgs"),
)
_SCRIPTS = [f"{one} = {PACKAGE}.{one}:main" for one in NODES]
_MAKING, _BUILDING = 120.0, 300.0
#: The pages whose terminals need something of earlier pages: all that those before this page leave.
NEEDS = {"02": "02", "05": "05", "06": "06", "07": "07", "09": "05"}


@dataclass(frozen=True)
class Report:
    """Hold what catching up made, and what it left for the learner to decide.

    Attributes:
        made: What was made, in the order of the pages.
        attention: What stands in the way, each with what to do about it.
    """

    made: tuple[str, ...] = ()
    attention: tuple[str, ...] = ()

    @property
    def complete(self) -> bool:
        """Return whether everything that was asked for is there now."""
        return not self.attention

    def __str__(self) -> str:
        rows = [f"Please check: {one}" for one in self.attention]
        if self.made:
            made = "; ".join(self.made)
            rows.insert(0, f"Created for you, because it did not exist yet: {made}.")
        rows = rows or ["Everything that this page needs exists."]
        return "\n".join(textwrap.fill(row, 100, break_long_words=False, break_on_hyphens=False)
                         for row in rows)  # fmt: skip

    __repr__ = __str__


@called_as('workspace.catch_up("05")')
def catch_up(page: str, root: Path | None = None) -> Report:
    """Make what the pages before this one leave in the workspace, as far as it is missing.

    What is there stays as it is. Only a `setup.py` without any entry point gets the two of the
    course, and the version before is kept.

    Args:
        page: The number of the page that needs it, as in `"05"`.
        root: The workspace, by default the learner's.

    Returns:
        What was made, and what stands in the way.

    Raises:
        WorkspaceError: If there is no such page, or the workspace cannot be written.
    """
    if not _PAGE.fullmatch(str(page)):
        raise WorkspaceError(
            f"There is no page {page!r}.",
            "`catch_up` creates the files of all pages before the given one.",
            'Give the number of the page:  workspace.catch_up("05")',
        )
    base = root or workspace()
    made: list[str] = []
    try:
        base.mkdir(parents=True, exist_ok=True)
        for number, stage in STAGES:
            if int(number) < int(page):
                made += filter(None, [stage(base.resolve())])
    except InTheWay as error:
        return Report(tuple(made), (str(error),))
    except OSError as error:
        raise trouble("The workspace cannot be completed", error) from None
    return Report(tuple(made))


def catch_up_on(page: str) -> None:
    """Make what a page needs, and say in a line what was made or stands in the way.

    Args:
        page: The page's number, such as `05`.

    Raises:
        WorkspaceError: If the workspace cannot be written.
    """
    if page in NEEDS:
        report = catch_up(NEEDS[page])
        if report.made or report.attention:
            print(report)


# The stages.


class InTheWay(Exception):  # noqa: N818 - not an error: something to tell
    """Raise it if something of the learner's is where a stage would make something."""


def finished(path: str) -> str:
    """Return a file of the finished package.

    Args:
        path: Its path in the package.
    """
    return (files("rosbeat.workspace") / "finished" / path).read_text(encoding="utf-8")


def folders(root: Path) -> str:
    """Make the folders of page 01."""
    missing = [one for one in FOLDERS if not (root / one).is_dir()]
    for one in missing:
        if (root / one).exists():
            raise InTheWay(f"{one} is a file, but it has to be a folder. Rename the file.")
        (root / one).mkdir(parents=True, exist_ok=True)
    plural = "s" if len(missing) > 1 else ""
    return f"the folder{plural} {_listed(missing)} (page 01)" if missing else ""


def package(root: Path) -> str:
    """Make the package of page 02 with `ros2 pkg create`, in one step."""
    folder = root / "src" / PACKAGE
    _check_place(folder, root)
    if (folder / "package.xml").is_file():
        return ""
    with tempfile.TemporaryDirectory(prefix=".making-", dir=root) as name:
        code, output = run_command(_CREATE, Path(name), _MAKING)
        if code:
            raise InTheWay(f"`ros2 pkg create` failed: {_last_line(output)}")
        _fill_in(Path(name) / PACKAGE)
        (Path(name) / PACKAGE).rename(folder)
    return f"the package {PACKAGE} (page 02)"


def _check_place(folder: Path, root: Path) -> None:
    """Say what is wrong with a package that lies elsewhere, is of another kind, or half made."""
    for other in find_packages(root):
        if is_stray(other, root):
            path = (other / "package.xml").relative_to(root)
            raise InTheWay(
                f"{path} makes a package of its folder, so colcon finds none of the packages below "
                f'it. Remove it with `rm "$ROS2_WORKSPACE"/{path}`.'
            )
        if other != folder and read_package(other, root).name == PACKAGE:
            place = other.relative_to(root).as_posix()
            raise InTheWay(
                f"a package {PACKAGE} is in {place}, but it belongs in src, and only once. If you "
                f"have no other, move it there with `mv {place} src/`, in the workspace; or else "
                "move it out of the workspace."
            )
    if not folder.exists():
        return
    manifest = read_package(folder, root).manifest
    if manifest.problem:
        raise InTheWay(
            f"src/{PACKAGE} is not a package: its package.xml cannot be read "
            f"({manifest.problem}). Rename it, then run this cell again and move your files to the "
            "new package."
        )
    if manifest.build_type != "ament_python":
        raise InTheWay(
            f"the package {PACKAGE} has the build type {manifest.build_type or '(none)'}: it was "
            "created without `--build-type ament_python`. Move it out of the workspace with `mv "
            f"src/{PACKAGE} ~/{PACKAGE}-old`, then create it again with the whole command."
        )


def _fill_in(folder: Path) -> None:
    """Put description and license in place of the two TODOs."""
    made = read_package(folder, folder.parent).manifest
    wanted = parse_manifest(finished("package.xml").encode())
    for name in ("package.xml", "setup.py"):
        text = (folder / name).read_text(encoding="utf-8")
        text = text.replace(made.description, wanted.description)
        text = text.replace(made.license, wanted.license)
        (folder / name).write_text(text, encoding="utf-8")


def node(name: str, page: str) -> Callable[[Path], str]:
    """Return the stage that makes the file of one node."""

    def stage(root: Path) -> str:
        path = f"src/{PACKAGE}/{PACKAGE}/{name}.py"
        if (root / path).exists():
            return ""
        save(path, finished(f"{PACKAGE}/{name}.py"), root)
        return f"{PACKAGE}/{name}.py (page {page})"

    return stage


def entry_points(root: Path) -> str:
    """Put the entry points of page 05 into a `setup.py` that has none yet."""
    path = f"src/{PACKAGE}/setup.py"
    setup = read_package(root / "src" / PACKAGE, root).setup
    if setup.problem:
        where = f", {setup.place}" if setup.place else ""
        raise InTheWay(
            f"{path} cannot be read: {setup.problem}{where}. Page 05 goes through it line by line."
        )
    missing = sorted(set(NODES) - {one.executable for one in setup.entry_points})
    if not missing:
        return ""
    after = None
    if not (setup.entry_points or setup.incomplete):
        after = with_entry_points((root / path).read_text(encoding="utf-8"), _SCRIPTS)
    if after is None:
        raise InTheWay(
            f"{path} has no entry point for {_listed(missing)}. The file was not changed, "
            "because you wrote it; page 05 shows the line."
        )
    save(path, after, root)
    return "the entry points in setup.py (page 05)"


def build(root: Path) -> str:
    """Build the package, as page 06 does, if it never was built with both nodes."""
    installed = read_package(root / "src" / PACKAGE, root).installed
    if installed and set(NODES) <= set(installed.executables):
        return ""
    print("Building the package with colcon; this takes a few seconds ...", flush=True)
    command = ("colcon", "build", "--packages-select", PACKAGE)
    code, output = run_command(command, root, _BUILDING)
    if code:
        raise InTheWay(
            f"`colcon build` failed: {_last_line(output)}. Run it in a terminal to see its whole "
            "output."
        )
    return "the build (page 06)"


def _last_line(output: str) -> str:
    """Return the last line that names an error, or else the last line."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    errors = [line for line in lines if "rror" in line and len(line) < 300]
    return next(reversed(errors or lines), "it printed nothing").rstrip(".")


def _listed(names: list[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


#: The page that makes something, and the stage that makes it, in order.
STAGES: tuple[tuple[str, Callable[[Path], str]], ...] = (
    ("01", folders),
    ("02", package),
    ("03", node(NODES[0], "03")),
    ("04", node(NODES[1], "04")),
    ("05", entry_points),
    ("06", build),
)


# Programs of the course.


def run_command(command: Sequence[str], folder: Path, seconds: float) -> tuple[int, str]:
    """Run a program of the course and wait for it.

    Args:
        command: Its name, `ros2` or `colcon`, and its arguments.
        folder: Where it runs.
        seconds: How long it may take.

    Returns:
        Its exit code, and everything that it wrote.

    Raises:
        WorkspaceError: If it is not installed, or takes longer.
    """
    place = Path(sys.prefix) / "bin" / command[0]
    try:
        done = subprocess.run(
            [str(place), *command[1:]], cwd=folder, env=program_environment(), timeout=seconds,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
    except FileNotFoundError:
        raise WorkspaceError(
            f"The program {command[0]} is not installed in this Python environment.",
            "This page needs a package, and that program creates or builds it.",
            "Start the course with `./environment/course lab`, which installs missing programs.",
        ) from None
    except subprocess.TimeoutExpired:
        raise WorkspaceError(
            f"`{' '.join(command)}` did not finish within {seconds:g} seconds and was stopped.",
            "Either the computer is very busy, or the program is waiting for something.",
            "Run the cell again when the computer is less busy.",
        ) from None
    return done.returncode, done.stdout.decode("utf-8", "replace")
