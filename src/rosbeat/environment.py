"""Set the environment variables that ROS nodes need, unless they are set already.

Every Python of the course runs this once, as early as it can: the course's own ``.venv`` does it
while the interpreter starts (so a kernel is right wherever it comes from, and `import rclpy` may
come first), and ``import rosbeat`` does it for installations made another way, with conda say.

A value that is already there is somebody's decision and stays. Because this runs at the start of
every Python, it imports almost nothing.

Run as a program, with an installation as its argument, it prints the same for a shell to evaluate.
"""

from __future__ import annotations

import binascii
import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:  # `typing` itself would cost more than everything below together
    from collections.abc import Mapping, MutableMapping

__all__ = [
    "CHOSEN",
    "DOMAIN",
    "SHARED_DOMAINS",
    "apply",
    "apply_for_tests",
    "defaults",
    "discovery_profile",
    "distribution",
    "domain_id",
    "learners_folder",
    "leased_domains",
    "other_ros",
    "profile_variable",
    "shell_lines",
    "usual_domain_id",
    "who",
]

SHARED_DOMAINS = range(1, 51)
"""Usual domain ids of users and checkouts; `rosbeat.domains` says what the others are for."""

DOMAIN = "ROS_DOMAIN_ID"
CHOSEN = "ROSBEAT_DOMAIN_ID"
"""Holds the domain id that the course has chosen. Another ROS_DOMAIN_ID is somebody's decision."""

PROFILE_VARIABLES = ("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE")
"""Name the settings of Fast DDS, in release 3 (Kilted) and in release 2 (Jazzy).

Fast DDS 3 prints a warning about the old name, and Fast DDS 2 does not know the new one.
"""

#: The distributions of ROS, by the first number of their rclpy.
_DISTRIBUTIONS = {"7": "jazzy", "9": "kilted"}
_PATH = "AMENT_PREFIX_PATH"
#: Makes ROS take from that file how much memory a topic gets; see there.
_FROM_PROFILE = "RMW_FASTRTPS_USE_QOS_FROM_XML"
_COLCON = "COLCON_DEFAULTS_FILE"
_CHECKS = "ROS_PYTHON_CHECK_FIELDS"
#: What sessions need, and tests without one do not mind.
_OF_SESSIONS = (_PATH, *PROFILE_VARIABLES, _FROM_PROFILE, _CHECKS)
_INSTALLATION = ("RMW_IMPLEMENTATION", "ROS_DISTRO", "ROS_VERSION", "ROS_PYTHON_VERSION")


def domain_id(prefix: str | None = None) -> int:
    """Return the domain id of this user in a checkout.

    It is the id that was last leased for them on this machine (`rosbeat.domains`), or else the
    usual one.

    Args:
        prefix: The installation, by default that of the running Python.
    """
    try:
        file = os.open(leased_domains(), os.O_RDONLY)
        try:
            _, found, rest = os.read(file, 65536).partition(who(prefix).encode() + b" ")
        finally:
            os.close(file)
        if found:
            return int(rest.split(None, 1)[0])
    except (OSError, ValueError, IndexError):
        pass  # no lease yet, or a file or a system that cannot tell of one
    return usual_domain_id(prefix)


def usual_domain_id(prefix: str | None = None, user: str | None = None) -> int:
    """Return a domain id that is always the same for a user and a checkout, but not theirs alone.

    Args:
        prefix: The installation, by default that of the running Python.
        user: Who runs it, by default the current user.
    """
    return SHARED_DOMAINS[_checksum(prefix, user) % 50]


def leased_domains() -> str:
    """Return the file that names this user's leased ids.

    Each line has what `who` returns, and an id.
    """
    return os.path.join(os.path.expanduser("~"), ".cache", "rosbeat", "domains")


def who(prefix: str | None = None) -> str:
    """Return words that name this user, a checkout, and the machine or container they are on.

    Several machines may have one home, and a container may have its own network.
    """
    network = os.stat("/proc/self/ns/net").st_ino
    return f"{_checksum(prefix):08x} {os.uname().nodename} {network}"


def _checksum(prefix: str | None, user: str | None = None) -> int:
    place = os.path.realpath(prefix or sys.prefix)
    text = f"{user or os.getuid()}\n{place}"
    return binascii.crc32(text.encode("utf-8", "surrogateescape"))


def discovery_profile() -> str:
    """Return the settings of Fast DDS that let two processes find each other at once.

    They also let two sessions of one process use one topic name for two types.

    Returns:
        The file, which in a checkout is that of the `ros2` command, and in a wheel a copy beside
        this file; nothing without it.
    """
    found = _in_checkout("src", "ros2_command", "ros2_command", "data", "fastdds.xml")
    in_wheel = os.path.join(os.path.dirname(os.path.realpath(__file__)), "fastdds.xml")
    return found or (in_wheel if os.path.exists(in_wheel) else "")


def distribution(prefix: str | None = None, environ: Mapping[str, str] | None = None) -> str:
    """Return the name of the ROS distribution: that of the installation, else of a sourced ROS.

    Args:
        prefix: The installation, by default that of the running Python.
        environ: The environment that names a sourced ROS, by default that of this process.

    Returns:
        "jazzy" where there is no rclpy yet, and nothing for an rclpy that is not known here.
    """
    for entry in (prefix or sys.prefix, *_entries(os.environ if environ is None else environ)):
        try:
            with open(
                os.path.join(entry, "share", "rclpy", "package.xml"), encoding="utf-8"
            ) as file:
                major = file.read().partition("<version>")[2].partition(".")[0]
        except (OSError, ValueError):
            continue
        return _DISTRIBUTIONS.get(major.strip(), "")
    return "jazzy"


def profile_variable(prefix: str | None = None, environ: Mapping[str, str] | None = None) -> str:
    """Return the variable that names the settings of Fast DDS, in a distribution's Fast DDS.

    Args:
        prefix: The installation, by default that of the running Python.
        environ: The environment that names a sourced ROS, by default that of this process.
    """
    return PROFILE_VARIABLES[distribution(prefix, environ) == "jazzy"]


def learners_folder() -> str:
    """Return the learner's own folder, there or not; an empty text if it could be anywhere.

    `./environment/course lab` fills it in the checkout (`environment/course_tool/folder.py`); it
    has the same place before that. In a release, the pages in `notebooks` are the learner's own.
    Where many learners share a checkout, `ROSBEAT_MY_COURSE` names the folder of each. `rosbeat
    new` makes it anywhere: then it is the nearest one around this process's folder.
    """
    chosen = os.path.expanduser(os.environ.get("ROSBEAT_MY_COURSE", ""))
    if chosen:
        return os.path.abspath(chosen)
    if _in_checkout(".rosbeat-release.json"):
        return _in_checkout("notebooks")
    return (
        os.path.join(_in_checkout(), "my_course") if _in_checkout("notebooks") else _around_here()
    )


def defaults(prefix: str | None = None) -> dict[str, str]:
    """Return what the course would set if nobody had set anything.

    Args:
        prefix: The installation that brings ROS, by default that of the running Python.
    """
    return _settings(os.environ, prefix) | _domain(prefix)


def _domain(prefix: str | None) -> dict[str, str]:
    return dict.fromkeys((DOMAIN, CHOSEN), str(domain_id(prefix)))


def _settings(environ: Mapping[str, str], prefix: str | None) -> dict[str, str]:
    name = distribution(prefix, environ)
    return {
        _PATH: prefix or sys.prefix,
        "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp",
        # Nodes of this machine see each other; the class's network stays quiet.
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        # Message classes read this when they are imported: `String(data=3)` then says why not.
        _CHECKS: "1",
        # Each message package imports NumPy, whose further threads only make nodes start later: no
        # node of the course multiplies matrices.
        "OPENBLAS_NUM_THREADS": "1",
        **({"ROS_DISTRO": name} if name else {}),
        "ROS_VERSION": "2",
        "ROS_PYTHON_VERSION": "3",
        **_files(profile_variable(prefix, environ)),
        **_workspace(),
        **_plain_python(prefix or sys.prefix),
    }


def other_ros(environ: Mapping[str, str], prefix: str | None = None) -> list[str]:
    """Return the ROS installations that the environment names besides the course's own.

    Args:
        environ: The environment to look at.
        prefix: The course's own installation, by default that of the running Python.
    """
    own = os.path.realpath(prefix or sys.prefix)
    return [
        entry for entry in _entries(environ) if os.path.realpath(entry) != own and _has_rclpy(entry)
    ]


def apply_for_tests(environ: MutableMapping[str, str] | None = None) -> dict[str, str]:
    """Set only what sessions need, and return what was set.

    pytest loads the plugin wherever rosbeat is installed: tests that use no session keep their ROS
    domain, for example.

    Args:
        environ: The environment to complete, by default that of this process.
    """
    target = os.environ if environ is None else environ
    complete = dict(target)
    chosen = {name: value for name, value in apply(complete).items() if name in _OF_SESSIONS}
    target.update(chosen)
    return chosen


def apply(
    environ: MutableMapping[str, str] | None = None, prefix: str | None = None
) -> dict[str, str]:
    """Set what is missing or empty and return what was set.

    When a ROS of the user's own is sourced, its middleware and distribution stay as they are, and
    so does what colcon is told in the user's home.

    Args:
        environ: The environment to complete, by default that of this process.
        prefix: The installation that brings ROS, by default that of the running Python.
    """
    target = os.environ if environ is None else environ
    settled = _settled(target, prefix)
    missing = {
        name: value
        for name, value in _settings(target, prefix).items()
        if not target.get(name) and name not in settled
    }
    missing.update(_longer_path(target, prefix or sys.prefix))
    if not target.get(DOMAIN):
        missing.update(_domain(prefix))
    target.update(missing)
    return missing


def shell_lines(prefix: str, environ: MutableMapping[str, str] | None = None) -> str:
    """Set what is missing and return the lines that do the same in a POSIX shell.

    Args:
        prefix: The installation that brings ROS.
        environ: The environment to complete, by default that of this process.
    """
    changes = apply(environ, prefix).items()
    return "\n".join(f"export {name}={_quoted(value)}" for name, value in changes)


def _around_here() -> str:
    """Return the folder above this process's, or that one, that `rosbeat new` has made."""
    try:
        folder = os.getcwd()
    except OSError:  # it was removed
        return ""
    while not os.path.exists(os.path.join(folder, ".rosbeat", "shipped")):
        folder, below = os.path.dirname(folder), folder
        if folder == below:
            return ""
    return folder


def _files(profile: str) -> dict[str, str]:
    """Return the settings that are files of the course, as far as they are there, and theirs."""
    settings = ("environment", "colcon.yaml")
    in_wheel = os.path.join(os.path.dirname(os.path.realpath(__file__)), "course", *settings)
    colcon = _in_checkout(*settings) or (in_wheel if os.path.exists(in_wheel) else "")
    files = {profile: discovery_profile(), _COLCON: colcon}
    found = {name: path for name, path in files.items() if path}
    return {**found, _FROM_PROFILE: "1"} if profile in found else found


def _workspace() -> dict[str, str]:
    """Return the path of the learner's workspace (`rosbeat.workspace.location`), for terminals."""
    chosen = os.path.expanduser(os.environ.get("ROSBEAT_WORKSPACE_IN", ""))
    parent = chosen or learners_folder()
    return {"ROS2_WORKSPACE": os.path.join(parent, "ROS2_and_RL_Tutorials")} if parent else {}


def _plain_python(prefix: str) -> dict[str, str]:
    """Return the Python that a workspace's setup.bash starts, if ours lies in a path with a space.

    colcon writes that path into the script without quotes; any Python does for what it is to do.
    """
    base = str(getattr(sys, "_base_executable", "") or "")
    if len(prefix.split()) < 2 or len(base.split()) != 1:
        return {}
    return {"COLCON_PYTHON_EXECUTABLE": base}


def _in_checkout(*parts: str) -> str:
    # The link to this file in site-packages leads back to the checkout.
    root = os.path.realpath(__file__).rsplit(os.sep, 3)[0]
    path = os.path.join(root, *parts)
    return path if os.path.exists(path) else ""


def _settled(environ: Mapping[str, str], prefix: str | None) -> list[str]:
    """Return the variables in whose place something else of the person's stands."""
    home = environ.get("COLCON_HOME") or os.path.join(os.path.expanduser("~"), ".colcon")
    settled = list(_INSTALLATION) if other_ros(environ, prefix) else []
    if any(environ.get(name, "") not in ("", discovery_profile()) for name in PROFILE_VARIABLES):
        settled += [*PROFILE_VARIABLES, _FROM_PROFILE]
    if os.path.exists(os.path.join(home, "defaults.yaml")):
        settled.append(_COLCON)
    return settled


def _longer_path(environ: Mapping[str, str], prefix: str) -> dict[str, str]:
    """Return the look-up path with our prefix at its end, unless it is there already."""
    entries = _entries(environ)
    own = os.path.realpath(prefix)
    if any(os.path.realpath(entry) == own for entry in entries):
        return {}
    return {_PATH: os.pathsep.join([*entries, prefix])}


def _entries(environ: Mapping[str, str]) -> list[str]:
    return [entry for entry in environ.get(_PATH, "").split(os.pathsep) if entry]


def _has_rclpy(prefix: str) -> bool:
    index = os.path.join(prefix, "share", "ament_index", "resource_index", "packages", "rclpy")
    return os.path.exists(index)


def _quoted(value: str) -> str:
    """Return a shell word; `shlex` would cost more than everything else here."""
    return "'" + value.replace("'", "'\\''") + "'"


if __name__ == "__main__":
    print(shell_lines(sys.argv[1]))
