"""Read ROS arguments (`--ros-args -r old:=new -p name:=value --`) as rcl does."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

_BEGIN, _END = "--ros-args", "--"
_PARAMETERS = ("-p", "--param", "--params-file")
#: Of all other flags, these are followed by a value, too.
_WITH_VALUE = (
    *("-r", "--remap", "-e", "--enclave"),
    *("--log-level", "--log-config-file", "--log-file-name"),
)


def ros_arguments(words: Iterable[str]) -> list[str]:
    """Return those words of a command line that are meant for ROS, without their brackets."""
    inside, kept = False, []
    for word in words:
        if word == _BEGIN:
            inside = True
        elif inside and word == _END:
            inside = False
        elif inside:
            kept.append(word)
    return kept


def node_arguments(own: Sequence[str], of_process: Sequence[str]) -> list[str]:
    """Return arguments for a node that say the same as its own ones and those of its process.

    A node's own arguments take precedence. rcl applies the first rule of those that rename, and
    the last of several values of a parameter.

    Args:
        own: What the code passes as `Node(cli_args=...)`.
        of_process: ROS arguments that hold for all nodes of the process; see `ros_arguments`.
    """
    values: list[str] = []
    rules: list[str] = []
    for flag in _flags(of_process):
        (values if flag[0] in _PARAMETERS else rules).extend(flag)
    return [*_bracketed(values), *own, *_bracketed(rules)]


def _flags(words: Sequence[str]) -> Iterator[list[str]]:
    rest = iter(words)
    for word in rest:
        value = next(rest, None) if word in (*_PARAMETERS, *_WITH_VALUE) else None
        yield [word] if value is None else [word, value]


def _bracketed(words: Sequence[str]) -> list[str]:
    return [_BEGIN, *words, _END] if words else []
