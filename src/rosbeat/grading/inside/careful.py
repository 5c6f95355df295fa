"""Functions that read and write attributes by name, for a stranger's code.

A node may choose one of its own methods by name. What a name is made of is not known before it
runs; so the name is looked at then. What leads to Python's inner parts is answered as if it were
not there.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

#: How the names begin that lead from a value to what runs it.
_INNER = ("__", "f_", "tb_", "gi_", "cr_", "ag_")
#: What leads from a node to whoever runs it, and on.
_RUNNERS = frozenset(("context", "executor", "watcher", "recorder", "mro"))
#: What is harmless all the same.
_PLAIN = frozenset(("__name__", "__doc__", "__class__"))


def careful_functions() -> dict[str, Callable[..., Any]]:
    """The functions by name, to be put where a cell looks for names first."""
    get, put, delete = getattr, setattr, delattr

    def careful_getattr(of: object, name: str, *default: Any) -> Any:  # noqa: ANN401
        if _is_inner(of, name):
            if default:
                return default[0]
            raise _not_there(of, name)
        return get(of, name, *default)

    def careful_setattr(of: object, name: str, value: object) -> None:
        if _is_inner(of, name):
            raise _not_there(of, name)
        put(of, name, value)

    def careful_delattr(of: object, name: str) -> None:
        if _is_inner(of, name):
            raise _not_there(of, name)
        delete(of, name)

    return {
        "getattr": careful_getattr,
        "setattr": careful_setattr,
        "delattr": careful_delattr,
    }


def _is_inner(of: object, name: object) -> bool:
    if not isinstance(name, str):
        return False
    text = str(name)
    # What begins with one underscore, and is not mangled, is a class's own business.
    own = type(of).__module__ == "__main__" and "__" not in text
    private = text.startswith("_") and not own
    return (private or text.startswith(_INNER) or text in _RUNNERS) and text not in _PLAIN


def _not_there(of: object, name: str) -> AttributeError:
    return AttributeError(f"{type(of).__name__!r} object has no attribute {name!r}")
