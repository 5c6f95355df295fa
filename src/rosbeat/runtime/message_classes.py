"""Message classes that a learner's code has written into, made whole again.

`msg = Float32` without brackets, and then `msg.data = 25.0`, replaces the field of the class
itself. From then on no message of that type can be made in the whole kernel: `Float32()` raises, in
every node. The class is mended as soon as an exception shows that something is wrong, so that a
cell that is put right runs at once.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from importlib.util import module_from_spec
from types import ModuleType

from rosbeat.runtime.words import Words, words_of_changes


def mend_message_classes() -> list[str]:
    """Give every message class that was written into its fields back.

    Returns:
        The names of the classes that were broken, such as `Float32`.
    """
    broken = list(_broken())
    for kind, module in broken:
        whole = getattr(_loaded_anew(module), kind.__name__)
        for field in _spoilt(kind):
            setattr(kind, field, vars(whole)[field])
    return [kind.__name__ for kind, _ in broken]


def _broken() -> Iterator[tuple[type, ModuleType]]:
    for kind, module in _suspects():
        if _spoilt(kind):
            yield kind, module


def _suspects() -> Iterable[tuple[type, ModuleType]]:
    """The message classes that may have been written into since they were looked at: most are not.

    A session begins with this, and each of them has more than a hundred classes to look at.
    """
    were_known = bool(_known.cache_info().currsize)
    known = _known()
    changed = known.words.changed() if were_known and known.words else [0]
    if changed[:1] != [0]:
        return [known.classes[number - 1] for number in changed]
    _known.cache_clear()
    return _known().classes


@dataclass(frozen=True)
class _Known:
    """All message classes that are loaded.

    Attributes:
        classes: Each with its module.
        words: One that changes when modules come, and one for each class; see `words`.
    """

    classes: tuple[tuple[type, ModuleType], ...]
    words: Words | None


@cache
def _known() -> _Known:
    # The generated modules are `std_msgs.msg._float32` and the like.
    modules = [module for name, module in list(sys.modules.items()) if ".msg._" in name]
    classes = tuple((kind, module) for module in modules for kind in _made_in(module))
    words = words_of_changes([sys.modules, *(vars(kind) for kind, _ in classes)])
    return _Known(classes, words)


@cache
def _made_in(module: ModuleType) -> tuple[type, ...]:
    """The message classes of a generated module, which get no more; looked for once."""
    return tuple(kind for kind in vars(module).values() if _is_made_there(kind, module.__name__))


def _is_made_there(kind: object, module: str) -> bool:
    return (
        isinstance(kind, type)
        and "_fields_and_field_types" in vars(kind)
        and (kind.__module__ == module)
    )


def _spoilt(kind: type) -> list[str]:
    found = vars(kind)
    fields: dict[str, str] = found["_fields_and_field_types"]
    return [name for name in fields if type(found.get(name)) is not property]


def _loaded_anew(module: ModuleType) -> ModuleType:
    spec = module.__spec__
    if spec is None or spec.loader is None:
        return module
    fresh = module_from_spec(spec)
    spec.loader.exec_module(fresh)
    return fresh
