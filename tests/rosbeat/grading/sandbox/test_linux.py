"""System calls tell why they fail, as Python's own do."""

import errno

import pytest

from rosbeat.grading.sandbox import linux


@pytest.mark.parametrize(
    "call",
    [
        lambda: linux.mount("nothing", "/no/such/place", "tmpfs"),
        lambda: linux.unmount("/no/such/place"),
        lambda: linux.pivot_root("/no/such/place", "/no/such/place"),
        lambda: linux.prctl(9_999, 0),
        lambda: linux.unshare(1),
    ],
    ids=["mount", "umount", "pivot_root", "prctl", "unshare"],
)
def test_a_call_that_fails_is_an_error_with_its_number(call):
    with pytest.raises(OSError, match=r"\w+.*: \w") as caught:
        call()
    assert caught.value.errno in (errno.ENOENT, errno.EINVAL, errno.EPERM, errno.ENOSYS)
    assert caught.value.strerror


def test_a_machine_without_a_known_number_is_refused(monkeypatch):
    monkeypatch.setattr(linux.platform, "machine", lambda: "vax")
    with pytest.raises(OSError, match="vax"):
        linux.pivot_root("/", "/")
