"""`course doctor`: look, change nothing, and say what works, with the cure for what does not."""

from __future__ import annotations

import os
import platform
import re
import shlex
import shutil
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from course_tool import prepare, running
from course_tool.folder import shipped_pages
from course_tool.layout import WORKSPACE, WORKSPACE_IN, Layout
from course_tool.problems import Problem, say

_LAB = "./environment/course lab"
_REPAIR = f"remove the folder .venv; {_LAB}  makes it"
_ENOUGH_SHARED_MEMORY = 64 * 10**6
_COMMANDS = {"ros2": "pkg prefix rclpy", "colcon": "version-check --help", "rosbeat": "--help"}
#: Prints the path of a bubblewrap that works; else what is wrong, and what to do about it.
_SANDBOX = """
from rosbeat.errors import GradingError
from rosbeat.page_runs.sandbox import bubblewrap
try:
    print(bubblewrap()[0])
except GradingError as error:
    raise SystemExit(f"{error.what}\\n{error.to_try}")
"""
_PROFILES = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")


@dataclass(frozen=True)
class Finding:
    """One thing that was looked at: `ok`, a `note` that harms nothing, or a `problem`."""

    state: Literal["ok", "note", "problem"]
    subject: str
    text: str
    cure: str = ""

    def __str__(self) -> str:
        line = f"{self.state:8} {self.subject:18} {self.text}"
        return f"{line}\n{'':8} {'':18} -> {self.cure}" if self.cure else line


def doctor(layout: Layout, arguments: Sequence[str]) -> int:
    """Print every finding; return 1 when something needs a cure."""
    findings = look(layout, running.cleaned(os.environ, layout))
    launcher = layout.environment / "course"
    for finding in findings:
        # `rosbeat doctor` is typed anywhere.
        here = Path.cwd() == layout.root or layout.prefix
        said = str(finding)
        say(said if here else said.replace("./environment/course", shlex.quote(str(launcher))))
    problems = sum(finding.state == "problem" for finding in findings)
    if not problems:
        say("\nEverything that the course needs works here.")
        return 0
    things = "One thing needs" if problems == 1 else f"{problems} things need"
    say(f"\n{things} a cure; the arrow beside each says which.")
    return 1


def look(layout: Layout, clean: running.Environment) -> list[Finding]:
    """Look at everything; what is inside `.venv` counts only if `.venv` can be used."""
    # A wheel brings no git, and pip has made the environment.
    of_a_checkout = [] if layout.prefix else [course_files(layout, clean.environ), venv(layout)]
    findings = [
        *of_a_checkout,
        Finding("ok", "Python", f"{platform.python_version()} ({sys.executable})"),
        disk(shutil.disk_usage(layout.root).free, layout.stamp.exists()),
        shared_memory(Path("/dev/shm")),
        another_ros(clean),
        *wsl(platform.release(), layout.root),
    ]
    if all(finding.subject != ".venv" or finding.state == "ok" for finding in findings):
        environ = running.inside(clean.environ, layout)
        findings += ros(layout, clean, environ)
        findings += [command(layout, name, environ) for name in _COMMANDS]
        findings.append(sandbox(layout, environ))
    return [*findings, pages(layout), workspace(layout, clean.environ)]


# The course, and the learner's folder.


def course_files(layout: Layout, environ: Mapping[str, str]) -> Finding:
    """Look whether files of the course are missing or changed: by git."""
    subject = "course files"
    git = ["git", "status", "--porcelain", "-z", "--untracked-files=no"]
    answer = running.quiet(git, environ, timeout=60, cwd=layout.root)
    if not answer.ok or not (layout.root / ".git").exists():
        return Finding("note", subject, "nobody knows what they were: there is no git here")
    theirs = ("notebooks/", "solutions/") if layout.is_release else ()
    listed = [line for line in answer.text.split("\0") if line and not line[3:].startswith(theirs)]
    gone = [line[3:] for line in listed if "D" in line[:2]]
    changed = [line[3:] for line in listed if "D" not in line[:2]]
    if gone:
        # Exactly these: others may be changed on purpose.
        cure = f"cd {shlex.quote(str(layout.root))} && git checkout HEAD -- {shlex.join(gone)}"
        return Finding("problem", subject, f"missing: {_some(gone)}", cure)
    if changed:
        cure = f"copy what is yours; then, as they were: git checkout HEAD -- {shlex.join(changed)}"
        return Finding("note", subject, f"changed: {_some(changed)}", cure)
    return Finding("ok", subject, "all are there, and as they were")


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return ", ".join(names[:3]) + more


def pages(layout: Layout) -> Finding:
    """Look whether the learner has a folder with pages."""
    if not layout.notes.is_dir():
        makes = f"rosbeat new {layout.learner.name}" if layout.prefix else _LAB
        return Finding("note", "your pages", f"{makes}  makes {layout.learner}")
    number = sum((layout.learner / page.name).exists() for page in shipped_pages(layout))
    return Finding("ok", "your pages", f"{number} in {layout.learner}")


def workspace(layout: Layout, environ: Mapping[str, str]) -> Finding:
    """Say where the workspace of the tutorial lies, and whether it can lie there."""
    chosen = environ.get(WORKSPACE_IN, "")
    parent = Path(chosen).expanduser().absolute() if chosen else layout.learner
    is_to_be_made = not chosen and not parent.exists()
    if not os.access(parent.parent if is_to_be_made else parent, os.W_OK):
        cure = f"make it a folder of yours, or set {WORKSPACE_IN} to another one"
        return Finding("problem", "workspace", f"{parent} cannot be written to", cure)
    there = "" if (parent / WORKSPACE).is_dir() else " (page 01 makes it)"
    because = f", by {WORKSPACE_IN}" if chosen else ""
    return Finding("ok", "workspace", f"{parent / WORKSPACE}{there}{because}")


# The machine.


def disk(free: int, installed: bool) -> Finding:
    """Look whether the disk has room, in bytes, for what is still to come."""
    needed = prepare.REFRESH if installed else prepare.FIRST_TIME
    text = f"{free / prepare.GIGABYTE:.1f} GB free"
    if free >= needed:
        return Finding("ok", "disk", text)
    cure = f"free some space: {needed / prepare.GIGABYTE:.1f} GB are needed"
    return Finding("problem", "disk", text, cure)


def shared_memory(folder: Path) -> Finding:
    """Look whether ROS can use shared memory; without it, messages go over the loopback."""
    subject = "shared memory"
    if not os.access(folder, os.W_OK):
        text = f"{folder} cannot be written to"
        return Finding("problem", subject, text, "in a container: --ipc=host")
    free = shutil.disk_usage(folder).free
    if free < _ENOUGH_SHARED_MEMORY:
        text = f"only {free / 10**6:.0f} MB free in {folder}"
        return Finding("problem", subject, text, f"rm {folder}/fastrtps_* when no node runs")
    return Finding("ok", subject, f"{folder} can be written to")


def another_ros(clean: running.Environment) -> Finding:
    """Say whether another ROS is sourced, and that it does no harm to our commands."""
    if not clean.other_ros:
        return Finding("ok", "another ROS", "none is sourced")
    return Finding(
        "note",
        "another ROS",
        f"{', '.join(clean.other_ros)} is sourced; our commands leave it out, "
        "a Python or an editor that you start yourself does not",
        "start those from a terminal in which it is not sourced",
    )


def wsl(release: str, root: Path) -> list[Finding]:
    """Say what matters in the Linux of Windows (WSL); nothing on any other machine.

    Args:
        release: The release of the kernel, as `uname -r` prints it.
        root: The checkout.
    """
    if "microsoft" not in release.lower():
        return []
    if release.endswith("-Microsoft"):
        name = os.environ.get("WSL_DISTRO_NAME", "Ubuntu")
        cure = f"in PowerShell: wsl --set-version {name} 2"
        return [Finding("problem", "WSL", "is version 1, which is no Linux of its own", cure)]
    text = "version 2; if no browser opens, open the address that course lab prints in Windows"
    findings = [Finding("ok", "WSL", text)]
    if re.match(r"/mnt/[a-z](/|$)", str(root)):
        slow = f"{root} is on a drive of Windows, where installing and building take far longer"
        cure = f"copy the course to Linux, and work there: cp -r {shlex.quote(str(root))} ~"
        findings.append(Finding("note", "WSL", slow, cure))
    return findings


# The environment.


def venv(layout: Layout) -> Finding:
    """Look whether `.venv` is there, and is what the lock says."""
    if not layout.venv.exists():
        return Finding("problem", ".venv", "is not there yet", f"{_LAB}  makes it")
    if not prepare.is_usable(layout):
        text = "is not finished, or was made in another place or for another Python"
        return Finding("problem", ".venv", text, f"{_LAB}  makes it again")
    if not prepare.is_satisfied(layout, "course"):
        text = "the course changed since it was made"
        return Finding("problem", ".venv", text, f"{_LAB}  refreshes it")
    level = prepare.stamped_level(layout)
    return Finding("ok", ".venv", f"{layout.venv} is what environment/{level}.lock lists")


def command(layout: Layout, name: str, environ: Mapping[str, str]) -> Finding:
    """Look whether a command of the environment starts."""
    program = layout.venv / "bin" / name
    answer = running.quiet([program, *_COMMANDS[name].split()], environ, timeout=60)
    if answer.ok:
        return Finding("ok", name, "starts")
    return Finding("problem", name, f"does not start ({answer.last_line})", _REPAIR)


def sandbox(layout: Layout, environ: Mapping[str, str]) -> Finding:
    """Say which bubblewrap makes sandboxes, which only `rosbeat grade` needs, or why none does."""
    answer = running.quiet([layout.venv / "bin" / "python", "-c", _SANDBOX], environ, timeout=60)
    lines = answer.text.strip().splitlines() or ["nothing is said"]
    if answer.ok:
        version = running.quiet([lines[-1], "--version"], environ, timeout=60).last_line
        return Finding("ok", "sandbox", f"works, for grading: {version}, {lines[-1]}")
    return Finding("note", "sandbox", f"only rosbeat grade needs it: {lines[0]}", lines[-1])


# ROS, as a plain Python of `.venv` sees it.


def ros(layout: Layout, clean: running.Environment, environ: Mapping[str, str]) -> list[Finding]:
    """Ask ROS itself, once, and judge its answers."""
    try:
        facts = prepare.ask_ros(layout, environ)
    except Problem as trouble:
        last = trouble.details.strip().splitlines()[-1:]
        text = " ".join([trouble.happened, *(f"({line})" for line in last)])
        return [Finding("problem", "ROS", text, trouble.cure.replace("\n", f"\n{'':30}"))]
    return judge(facts, clean.environ, str(layout.venv))


def judge(facts: Mapping[str, Any], environ: Mapping[str, str], venv: str) -> list[Finding]:
    """Judge what ROS said.

    Args:
        facts: What `ros_check` printed.
        environ: What the person set, before the course's defaults.
        venv: Where ROS should come from.
    """
    seen: Mapping[str, str] = facts["environ"]
    origin = Finding("ok", "rclpy", f"{facts['rclpy']}, from .venv")
    if not facts["rclpy_file"].startswith(venv):
        text = f"comes from {facts['rclpy_file']}"
        origin = Finding("problem", "rclpy", text, "unset PYTHONPATH in this terminal")
    return [
        origin,
        Finding("ok", "message heard", f"after {facts['milliseconds']:.0f} ms"),
        Finding("ok", "middleware", facts["rmw"]),
        _domain(seen.get("ROS_DOMAIN_ID"), environ),
        _reach(seen.get("ROS_AUTOMATIC_DISCOVERY_RANGE") or "SUBNET"),
        _profile(seen),
    ]


def _domain(seen: str | None, environ: Mapping[str, str]) -> Finding:
    if seen is None:
        return Finding("problem", "domain id", "is not set: nodes meet everybody's in 0", _REPAIR)
    if environ.get("ROS_DOMAIN_ID", "") not in ("", environ.get("ROSBEAT_DOMAIN_ID")):
        return Finding("ok", "domain id", f"{seen}, from ROS_DOMAIN_ID in your environment")
    return Finding("ok", "domain id", f"{seen}, the course's choice for you and this checkout")


def _reach(name: str) -> Finding:
    if name == "LOCALHOST":
        return Finding("ok", "discovery range", "LOCALHOST: nodes meet on this machine only")
    text = f"{name}, from your environment; the pages expect LOCALHOST"
    return Finding("note", "discovery range", text)


def _profile(seen: Mapping[str, str]) -> Finding:
    """Say which settings decide how quickly two processes find each other."""
    subject = "discovery profile"
    name = next((name for name in _PROFILES if seen.get(name)), None)
    if name is None:
        return Finding("note", subject, "none: two programs may need 3 s to find each other")
    if not os.path.exists(seen[name]):
        return Finding("problem", subject, f"{name} names {seen[name]}: no file", f"unset {name}")
    return Finding("ok", subject, seen[name])
