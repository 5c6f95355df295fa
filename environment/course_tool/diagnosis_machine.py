"""What the doctor looks at outside ROS: Python, disk, `.venv`, kernels, the clock."""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
import time
from pathlib import Path

from course_tool import checks, making, stamp
from course_tool.findings import Finding, note, ok, problem
from course_tool.layout import Layout
from course_tool.surroundings import Surroundings

LAB = "./environment/course lab"
_COURSE_WAS_MADE = 1_767_225_600  # 2026-01-01; a clock before it breaks every https connection
_ENOUGH_SHARED_MEMORY = 64 * 10**6


def findings(layout: Layout, clean: Surroundings) -> list[Finding]:
    """Look at the machine and at `.venv`; what is inside counts only if `.venv` can be used."""
    made = venv(layout, clean)
    return [
        python(),
        disk(shutil.disk_usage(layout.root).free, layout.stamp.exists()),
        shared_memory(Path("/dev/shm")),
        clock(time.time()),
        foreign_ros(clean),
        isolation(can_isolate()),
        made,
        *([lock(layout), kernel(layout)] if made.state == "ok" else []),
    ]


def python() -> Finding:
    """Say which Python this is; the launcher has refused the others."""
    return ok("Python", f"{platform.python_version()} ({sys.executable})")


def disk(free: int, installed: bool) -> Finding:
    """Look whether the disk has room for what is still to come."""
    needed = checks.REFRESH if installed else checks.FIRST_TIME
    text = f"{free / checks.GIGABYTE:.1f} GB free"
    if free >= needed:
        return ok("disk", text)
    return problem("disk", text, f"free some space: {needed / checks.GIGABYTE:.1f} GB are needed")


def shared_memory(folder: Path) -> Finding:
    """Look whether ROS can use shared memory; without it, messages go over the loopback."""
    if not os.access(folder, os.W_OK):
        return problem(
            "shared memory", f"{folder} cannot be written to", "in a container: --ipc=host"
        )
    free = shutil.disk_usage(folder).free
    if free < _ENOUGH_SHARED_MEMORY:
        size = f"only {free / 10**6:.0f} MB free in {folder}"
        return problem("shared memory", size, f"rm {folder}/fastrtps_* when no node runs")
    return ok("shared memory", f"{folder} can be written to")


def clock(now: float) -> Finding:
    """Look whether the date can be true."""
    today = time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime(now))
    if now < _COURSE_WAS_MADE:
        return problem("clock", f"it says {today}", "set the date: sudo timedatectl set-ntp true")
    return ok("clock", today)


def foreign_ros(clean: Surroundings) -> Finding:
    """Say whether another ROS is sourced, and that it does no harm to our commands."""
    if clean.other_ros:
        return note(
            "another ROS",
            f"{', '.join(clean.other_ros)} is sourced; our commands leave it out, "
            "a Python or an editor that you start yourself does not",
            "start those from a terminal in which it is not sourced",
        )
    return ok("another ROS", "none is sourced")


def venv(layout: Layout, clean: Surroundings) -> Finding:
    """Look whether `.venv` is there and runs."""
    if not os.path.lexists(layout.venv):
        return problem(".venv", "is not there yet", f"{LAB}  makes it")
    reason = making.why_unusable(layout, clean.environ)
    if reason:
        return problem(".venv", reason, f"{LAB}  makes it again")
    return ok(".venv", str(layout.venv))


def lock(layout: Layout) -> Finding:
    """Look whether `.venv` is what the lock says."""
    found = stamp.read(layout)
    if found is None:
        return problem("versions", ".venv is not complete", f"{LAB}  completes it")
    if not stamp.satisfied(layout, "course"):
        return problem(
            "versions", "the course changed since .venv was made", f"{LAB}  refreshes it"
        )
    return ok("versions", f".venv is what environment/{found.level}.lock lists")


def kernel(layout: Layout) -> Finding:
    """Look whether notebooks will run in `.venv`."""
    spec = layout.venv / "share" / "jupyter" / "kernels" / "python3" / "kernel.json"
    try:
        program = json.loads(spec.read_text(encoding="utf-8"))["argv"][0]
    except (OSError, ValueError, KeyError, IndexError):
        return problem("Jupyter kernel", "python3 is not there", f"remove .venv; {LAB}  makes it")
    # A bare "python" means the Python that runs the server, which is ours.
    if program in ("python", "python3") or Path(program).is_relative_to(layout.venv):
        return ok("Jupyter kernel", "python3 runs in .venv")
    return problem("Jupyter kernel", f"python3 runs {program}", f"remove .venv; {LAB}  makes it")


def isolation(possible: bool) -> Finding:
    """Say whether sandboxes can be made; only `rosbeat grade` needs them."""
    if possible:
        return ok("sandbox", "can be made, for grading")
    return note("sandbox", "cannot be made here; only rosbeat grade needs it, and says what to do")


def can_isolate() -> bool:
    """Try to make a user namespace and a mount namespace, in a process that is gone afterwards."""
    program = "import ctypes, sys; sys.exit(ctypes.CDLL(None).unshare(0x10020000) != 0)"
    done = subprocess.run([sys.executable, "-I", "-c", program], capture_output=True)
    return done.returncode == 0
