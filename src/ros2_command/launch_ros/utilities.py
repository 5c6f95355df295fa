"""Join namespaces: the functions of `launch_ros.utilities` that launch files call."""

from __future__ import annotations

__all__ = ["is_namespace_absolute", "is_root_namespace", "make_namespace_absolute",
           "prefix_namespace"]  # fmt: skip


def is_root_namespace(ns: str) -> bool:
    """Return whether a namespace is `/`."""
    return ns == "/"


def is_namespace_absolute(ns: str) -> bool:
    """Return whether a namespace begins at the root."""
    return ns.startswith("/")


def prefix_namespace(base_ns: str | None, ns: str | None) -> str | None:
    """Return a namespace within another; None if there is neither."""
    if ns is None:
        joined = base_ns
    elif not base_ns or is_namespace_absolute(ns):
        joined = ns
    else:
        joined = f"{base_ns.rstrip('/')}/{ns}"
    return joined if joined in (None, "/") else str(joined).rstrip("/")


def make_namespace_absolute(ns: str | None) -> str | None:
    """Return a namespace that begins at the root."""
    return ns if ns is None or is_namespace_absolute(ns) else f"/{ns}"
