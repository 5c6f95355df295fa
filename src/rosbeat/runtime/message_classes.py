"""Message classes that a learner's code has written into, made whole again.

`msg = Float32` without brackets, and then `msg.data = 25.0`, replaces the field of the class
itself. From then on no message of that type can be made in the whole kernel: `Float32()` raises, in
every node. The class is mended as soon as an exception shows that something is wrong, so that a
cell that is put right runs at once.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import cache
from importlib.util import module_from_spec
from types import ModuleType


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
    # The generated modules are `std_msgs.msg._float32` and the like.
    for name, module in list(sys.modules.items()):
        if ".msg._" in name:
            for kind in _made_in(module):
                if _spoilt(kind):
                    yield kind, module


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
