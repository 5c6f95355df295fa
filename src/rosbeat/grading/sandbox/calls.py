"""System calls that reach what no namespace keeps apart; a sandbox has none of them.

Keys that the kernel keeps for a user or a session are the same inside and outside (keyrings(7)).
And who lets itself be traced is held by whoever waits for it, which is the process outside.

Sources: seccomp(2), and linux/filter.h for the few instructions of a filter.
"""

from __future__ import annotations

import ctypes
import errno
import platform
import struct

from rosbeat.grading.sandbox import linux

#: The machine's number in linux/audit.h, and its numbers of add_key, request_key, keyctl, ptrace.
_CALLS = {
    "x86_64": (0xC000003E, (248, 249, 250, 101)),
    "aarch64": (0xC00000B7, (217, 218, 219, 117)),
}
_LOAD, _IF_EQUAL, _IF_AT_LEAST, _RETURN = 0x20, 0x15, 0x35, 0x06
_ALLOW, _REFUSE = 0x7FFF0000, 0x00050000
#: Where the number of the call and of the machine are in `struct seccomp_data`.
_NUMBER, _MACHINE = 0, 4
#: From here on, numbers of x86_64 are those of another way to call (x32).
_OTHER_WAY = 0x40000000
_PR_SET_SECCOMP, _FILTER = 22, 2


def forbid_calls() -> None:
    """Refuse those calls to this process and all that it starts, for good.

    It needs `PR_SET_NO_NEW_PRIVS`, which `linux.drop_capabilities` sets.

    Raises:
        OSError: If the kernel refuses, or the numbers for this machine are not known here.
    """
    if platform.machine() not in _CALLS:
        raise OSError(errno.ENOSYS, f"calls are not known on {platform.machine()}")
    machine, calls = _CALLS[platform.machine()]
    steps = _steps(machine, calls)
    code = ctypes.create_string_buffer(b"".join(steps), 8 * len(steps))
    program = ctypes.create_string_buffer(struct.pack("HxxxxxxQ", len(steps), _address(code)))
    linux.prctl(_PR_SET_SECCOMP, _FILTER, _address(program))


def _steps(machine: int, calls: tuple[int, ...]) -> list[bytes]:
    """The filter: another machine's calls are not there, those named are not permitted."""
    last = len(calls)
    return [
        _step(_LOAD, _MACHINE),
        _step(_IF_EQUAL, machine, 1, 0),
        _step(_RETURN, _REFUSE | errno.ENOSYS),
        _step(_LOAD, _NUMBER),
        _step(_IF_AT_LEAST, _OTHER_WAY, 0, 1),
        _step(_RETURN, _REFUSE | errno.ENOSYS),
        *(_step(_IF_EQUAL, number, last - place, 0) for place, number in enumerate(calls)),
        _step(_RETURN, _ALLOW),
        _step(_RETURN, _REFUSE | errno.EPERM),
    ]


def _step(code: int, value: int, if_so: int = 0, if_not: int = 0) -> bytes:
    return struct.pack("HBBI", code, if_so, if_not, value)


def _address(buffer: ctypes.Array[ctypes.c_char]) -> int:
    return ctypes.addressof(buffer)
