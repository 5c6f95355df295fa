"""`course doctor`: looks, changes nothing, and says what works, with the cure for what does not."""

from __future__ import annotations

import json
import os
import platform
import re
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from course_tool import prepare, running, surroundings
from course_tool.folder import SETTING, shipped_pages
from course_tool.layout import WORKSPACE, Layout
from course_tool.problems import Problem, say
from course_tool.surroundings import Surroundings

_LAB = "./environment/course lab"
_REPAIR = f"remove .venv/rosbeat-stamp.json; {_LAB}  then repairs .venv"
_COURSE_WAS_MADE = 1_767_225_600  # 2026-01-01; a clock before it breaks every https connection
_ENOUGH_SHARED_MEMORY = 64 * 10**6
_COMMANDS = {"ros2": "pkg prefix rclpy", "colcon": "version-check --help", "rosbeat": "--help"}
_PROFILES = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")
_OUR_PROFILE = os.path.join("ros2_command", "data", "fastdds.xml")


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
    findings = look(layout, surroundings.cleaned(os.environ, layout))
    for finding in findings:
        say(str(finding))
    problems = sum(finding.state == "problem" for finding in findings)
    if not problems:
        say("\nEverything that the course needs works here.")
        return 0
    things = "One thing needs" if problems == 1 else f"{problems} things need"
    say(f"\n{things} a cure; the arrow beside each says which.")
    return 1


def look(layout: Layout, clean: Surroundings) -> list[Finding]:
    """Look at everything; what is inside `.venv` counts only if `.venv` can be used."""
    made = venv(layout, clean)
    findings = [
        course_files(layout, clean.environ),
        Finding("ok", "Python", f"{platform.python_version()} ({sys.executable})"),
        disk(shutil.disk_usage(layout.root).free, layout.stamp.exists()),
        shared_memory(Path("/dev/shm")),
        clock(time.time()),
        another_ros(clean),
        sandbox(_can_isolate()),
        *wsl(platform.release(), layout.root),
        made,
    ]
    if made.state == "ok":
        environ = surroundings.inside(clean.environ, layout)
        findings += [versions(layout), kernel(layout), *ros(layout, clean, environ)]
        findings += [place(layout), underlay(layout, clean)]
        findings += [command(layout, name, environ) for name in _COMMANDS]
    return [*findings, pages(layout), workspace(layout, clean.environ)]


# The course, and the learner's folder.


def course_files(layout: Layout, environ: Mapping[str, str]) -> Finding:
    """Look whether files of the course are missing or changed: by git."""
    subject = "course files"
    listed = _by_git(layout, environ)
    if listed is None:
        return Finding("note", subject, "nobody knows what they were: there is no git here")
    theirs = ("notebooks/", "solutions/") if layout.is_release else ()
    gone, changed = ([one for one in names if not one.startswith(theirs)] for names in listed)
    back = "git checkout HEAD -- "
    if gone:
        # Exactly these: others may be changed on purpose.
        many = "git ls-files -z --deleted | xargs -0 git checkout HEAD --"
        cure = many if len(gone) > 3 else back + shlex.join(gone)
        return Finding("problem", subject, f"missing: {_some(gone)}", f"in {layout.root}: {cure}")
    if changed:
        cure = f"copy what is yours; then, as they were: {back}{shlex.join(changed[:3])}"
        return Finding("note", subject, f"changed: {_some(changed)}", cure)
    return Finding("ok", subject, "all are there, and as they were")


def _by_git(layout: Layout, environ: Mapping[str, str]) -> tuple[list[str], list[str]] | None:
    """Return what is missing and what is changed; None without git."""
    command = ["git", "status", "--porcelain", "-z", "--untracked-files=no"]
    answer = running.quiet(command, environ, timeout=60, cwd=layout.root)
    if not answer.ok or not (layout.root / ".git").exists():
        return None
    listed = [line for line in answer.text.split("\0") if line[2:3] == " "]
    gone = [line[3:] for line in listed if "D" in line[:2]]
    return gone, [line[3:] for line in listed if "D" not in line[:2]]


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return ", ".join(names[:3]) + more


def pages(layout: Layout) -> Finding:
    """Look whether the learner has a folder with pages."""
    number = sum((layout.learner / page.name).exists() for page in shipped_pages(layout))
    if not layout.notes.is_dir():
        return Finding("note", "your pages", f"{_LAB}  makes {layout.learner}")
    return Finding("ok", "your pages", f"{number} in {layout.learner}")


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


def clock(now: float) -> Finding:
    """Look whether the date can be true; `now` is in seconds since 1970."""
    today = time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime(now))
    if now >= _COURSE_WAS_MADE:
        return Finding("ok", "clock", today)
    cure = "set the date: sudo timedatectl set-ntp true"
    return Finding("problem", "clock", f"it says {today}", cure)


def another_ros(clean: Surroundings) -> Finding:
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


def sandbox(possible: bool) -> Finding:
    """Say whether sandboxes can be made; only `rosbeat grade` needs them."""
    if possible:
        return Finding("ok", "sandbox", "can be made, for grading")
    text = "cannot be made here; only rosbeat grade needs it, and says what to do"
    return Finding("note", "sandbox", text)


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


def _can_isolate() -> bool:
    """Try to make a user namespace and a mount namespace, in a process that is gone afterwards."""
    program = "import ctypes, sys; sys.exit(ctypes.CDLL(None).unshare(0x10020000) != 0)"
    done = subprocess.run([sys.executable, "-I", "-c", program], capture_output=True)
    return done.returncode == 0


# The environment.


def venv(layout: Layout, clean: Surroundings) -> Finding:
    """Look whether `.venv` is there and runs."""
    if not os.path.lexists(layout.venv):
        return Finding("problem", ".venv", "is not there yet", f"{_LAB}  makes it")
    reason = prepare.why_unusable(layout, clean.environ)
    if reason:
        return Finding("problem", ".venv", reason, f"{_LAB}  makes it again")
    return Finding("ok", ".venv", str(layout.venv))


def versions(layout: Layout) -> Finding:
    """Look whether `.venv` is what the lock says."""
    level = prepare.stamped_level(layout)
    if level is None:
        return Finding("problem", "versions", ".venv is not complete", f"{_LAB}  completes it")
    if not prepare.is_satisfied(layout, "course"):
        text = "the course changed since .venv was made"
        return Finding("problem", "versions", text, f"{_LAB}  refreshes it")
    return Finding("ok", "versions", f".venv is what environment/{level}.lock lists")


def kernel(layout: Layout) -> Finding:
    """Look whether notebooks will run in `.venv`."""
    subject, cure = "Jupyter kernel", f"remove .venv; {_LAB}  makes it"
    spec = layout.venv / "share" / "jupyter" / "kernels" / "python3" / "kernel.json"
    try:
        program = json.loads(spec.read_text(encoding="utf-8"))["argv"][0]
    except (OSError, ValueError, KeyError, IndexError):
        return Finding("problem", subject, "python3 is not there", cure)
    # A bare "python" means the Python that runs the server, which is ours.
    if program in ("python", "python3") or Path(program).is_relative_to(layout.venv):
        return Finding("ok", subject, "python3 runs in .venv")
    return Finding("problem", subject, f"python3 runs {program}", cure)


def place(layout: Layout) -> Finding:
    """Look whether what colcon builds can be started by its own name in this place.

    The first line of a program cannot name an interpreter with a space in its path. `ros2 run`
    reads that line itself.
    """
    if len(str(layout.venv).split()) == 1:
        return Finding("ok", "place", str(layout.root))
    text = f"'{layout.root}' has a space: start what colcon builds with ros2 run, not by its path"
    return Finding("note", "place", text)


def underlay(layout: Layout, clean: Surroundings) -> Finding:
    """Look whether `source .venv/setup.bash` activates ROS in a bash that knows nothing of it."""
    setup = layout.venv / "setup.bash"
    if not setup.exists():
        return Finding("problem", "underlay", "setup.bash is not in .venv", _REPAIR)
    line = f'. {shlex.quote(str(setup))} && printf "%s" "$AMENT_PREFIX_PATH"'
    answer = running.quiet(["bash", "-c", line], clean.environ, timeout=30)
    if answer.ok and str(layout.venv) in answer.text.split(os.pathsep):
        return Finding("ok", "underlay", f"source {setup}  activates ROS in any bash")
    text = f"{setup} does not work ({answer.last_line})"
    return Finding("problem", "underlay", text, _REPAIR)


def command(layout: Layout, name: str, environ: Mapping[str, str]) -> Finding:
    """Look whether a command of the environment starts."""
    program = layout.venv / "bin" / name
    answer = running.quiet([program, *_COMMANDS[name].split()], environ, timeout=60)
    if answer.ok:
        return Finding("ok", name, "starts")
    return Finding("problem", name, f"does not start ({answer.last_line})", _REPAIR)


def workspace(layout: Layout, environ: Mapping[str, str]) -> Finding:
    """Say where the workspace of the tutorial lies, and whether it can lie there."""
    chosen = environ.get(SETTING, "")
    home = layout.learner if layout.notes.is_dir() else layout.root
    parent = Path(chosen).expanduser().absolute() if chosen else home
    if not parent.is_dir():
        text = f"{SETTING} names {parent}: no folder"
        return Finding("problem", "workspace", text, f"mkdir -p {shlex.quote(str(parent))}")
    if not os.access(parent, os.W_OK):
        text = f"{parent} cannot be written to"
        ours = f'sudo chown -R "$USER" {shlex.quote(str(parent))}'
        return Finding("problem", "workspace", text, f"set {SETTING} elsewhere" if chosen else ours)
    there = "" if (parent / WORKSPACE).is_dir() else " (page 01 makes it)"
    because = f", by {SETTING}" if chosen else ""
    return Finding("ok", "workspace", f"{parent / WORKSPACE}{there}{because}")


# ROS, as a plain Python of `.venv` sees it.


def ros(layout: Layout, clean: Surroundings, environ: Mapping[str, str]) -> list[Finding]:
    """Ask ROS itself, once, and judge its answers."""
    try:
        facts = prepare.ask_ros(layout, environ)
    except Problem as trouble:
        last = trouble.details.strip().splitlines()[-1:]
        text = " ".join([trouble.happened, *(f"({line})" for line in last)])
        return [Finding("problem", "ROS", text, trouble.cure.replace("\n", f"\n{'':30}"))]
    replaced = [Finding("note", "middleware", text) for text in clean.notes if text[:4] == "RMW_"]
    return judge(facts, clean.environ, str(layout.venv)) + replaced


def judge(facts: Mapping[str, Any], environ: Mapping[str, str], venv: str) -> list[Finding]:
    """Judge what ROS said.

    Args:
        facts: What `ros_check` printed.
        environ: What the person set, before the course's defaults.
        venv: Where ROS should come from.
    """
    seen: Mapping[str, str] = facts["environ"]
    return [
        _origin(facts["rclpy"], facts["rclpy_file"], venv),
        Finding("ok", "message heard", f"after {facts['milliseconds']:.0f} ms"),
        Finding("ok", "middleware", facts["rmw"]),
        _domain(seen.get("ROS_DOMAIN_ID"), environ),
        _reach(seen.get("ROS_AUTOMATIC_DISCOVERY_RANGE") or "SUBNET"),
        profile(seen, environ),
        _field_checks(facts["field_checks"], environ.get("ROS_PYTHON_CHECK_FIELDS")),
    ]


def _origin(version: str, file: str, venv: str) -> Finding:
    if file.startswith(venv):
        return Finding("ok", "rclpy", f"{version}, from .venv")
    return Finding("problem", "rclpy", f"comes from {file}", "unset PYTHONPATH in this terminal")


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


def profile(seen: Mapping[str, str], environ: Mapping[str, str]) -> Finding:
    """Look whether two processes find each other quickly, and by whose settings.

    Args:
        seen: The environment that nodes see.
        environ: What the person set, before the course's defaults.
    """
    subject = "discovery profile"
    name = next((name for name in _PROFILES if seen.get(name)), None)
    if name is None:
        return Finding("note", subject, "none: two programs may need 3 s to find each other")
    if not os.path.exists(seen[name]):
        return Finding("problem", subject, f"{name} names {seen[name]}: no file", f"unset {name}")
    if environ.get(name) and not seen[name].endswith(_OUR_PROFILE):
        return Finding("note", subject, f"{seen[name]}, from {name} in your environment")
    return Finding("ok", subject, "the course's: two programs find each other at once")


def _field_checks(works: bool, set_by_user: str | None) -> Finding:
    subject = "field checks"
    if works:
        return Finding("ok", subject, "on: a message refuses a value of the wrong type")
    if set_by_user is not None:
        return Finding("note", subject, "off, by ROS_PYTHON_CHECK_FIELDS in your environment")
    return Finding("problem", subject, "off", _REPAIR)
