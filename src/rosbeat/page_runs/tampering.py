"""Notice, while a page runs, what of its code reaches for what runs and observes it.

An answer and what observes it share a process, so evidence can be forged with some effort. What
leads there is noticed when it happens, and not by words in a text: who asks for frames or for all
objects of a process, who calls C, who imports the course's judges or follows a node to the recorder
(PEP 578 for the first three). A remark proves nothing, and neither does its absence; a mark stands.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from types import FrameType, FunctionType, ModuleType
from typing import Any

from rosbeat.ros.exception_origin import is_foreign

#: Tells a remark, a sentence without a full stop.
Tell = Callable[[str], None]
#: What an event of Python says of whoever causes it.
_EVENTS = {
    "sys._getframe": "looks at frames of the running program",
    "sys._getframemodulename": "looks at frames of the running program",
    "sys._current_frames": "looks at frames of the running program",
    "sys.settrace": "traces the running program",
    "sys.setprofile": "traces the running program",
    "sys.addaudithook": "watches the running program",
    "gc.get_objects": "searches all objects of the process",
    "gc.get_referrers": "searches all objects of the process",
    "gc.get_referents": "searches all objects of the process",
    "ctypes.dlopen": "calls C by ctypes",
    "ctypes.dlsym": "calls C by ctypes",
    "ctypes.addressof": "calls C by ctypes",
    "ctypes.string_at": "calls C by ctypes",
    "ctypes.cdata": "calls C by ctypes",
}
#: Attributes that lead from a value to the code or the frame that runs it.
_ATTRIBUTES = frozenset(("tb_frame", "gi_frame", "cr_frame", "ag_frame"))
_SET = frozenset(("__code__", "__defaults__", "__kwdefaults__", "__class__"))
#: Modules in which the judges are, and what they are made of.
_JUDGES = "rosbeat.exercises."
#: Of these modules, only what pages use themselves.
_OF_PAGES = frozenset(
    f"{_JUDGES}{name}" for name in ("check", "greenhouse", "hint", "predict", "progress", "quiz")
)
#: What leads from a node to what records it: module, class and attribute.
_PATHS = (("rosbeat.ros.context", "SessionContext", "session_core"),)
_MOST = 20


class _Watch:
    """Tell each remark once, a few in all."""

    def __init__(self, tell: Tell) -> None:
        self._tell = tell
        self._told: set[str] = set()
        self._is_busy = False

    def note(self, what: str, depth: int = 1) -> None:
        """Tell what the code of the page does, if it is the code of the page that does it.

        Args:
            what: What it does.
            depth: How many frames of this module stand between.
        """
        if self._is_busy or what in self._told or len(self._told) >= _MOST:
            return
        self._is_busy = True
        try:
            frame = _caller(sys._getframe(depth + 1))
            if frame is not None:
                self._told.add(what)
                self._tell(f"line {frame.f_lineno} {what}")
        finally:
            self._is_busy = False

    def hear(self, event: str, arguments: tuple[Any, ...]) -> None:
        """Take an event of Python."""
        if event in _EVENTS:
            self.note(_EVENTS[event])
        elif event == "object.__getattr__" and arguments[1] in _ATTRIBUTES:
            self.note(f"looks at {arguments[1]}")
        elif event in ("object.__setattr__", "object.__delattr__") and arguments[1] in _SET:
            changed = arguments[0]
            if isinstance(changed, FunctionType) and is_foreign(changed.__code__.co_filename):
                self.note(f"changes {changed.__name__}")


def _caller(frame: FrameType | None) -> FrameType | None:
    """Return the innermost frame that is no library's; None if that is not the page's."""
    while frame is not None and _is_library(frame):
        frame = frame.f_back
    return frame if frame is not None and not is_foreign(frame.f_code.co_filename) else None


#: Modules through which code looks at frames, or imports; what calls them counts.
_THROUGH = ("inspect", "importlib", "gc", "ctypes")


def _is_library(frame: FrameType) -> bool:
    name = str(frame.f_globals.get("__name__", ""))
    return name.split(".")[0] in _THROUGH or name.startswith("_frozen_importlib")


class _WatchedModule(ModuleType):
    """Stand for a module of the course, and tell who uses it by its name."""

    def __init__(self, module: ModuleType, watch: _Watch) -> None:
        super().__init__(module.__name__)
        super().__getattribute__("__dict__")["_parts"] = module, watch

    def __getattribute__(self, name: str) -> Any:  # noqa: ANN401 - any attribute of a module
        module, watch = super().__getattribute__("__dict__")["_parts"]
        watch.note(f"uses {module.__name__}")
        return getattr(module, name)

    def __setattr__(self, name: str, value: object) -> None:
        module, watch = super().__getattribute__("__dict__")["_parts"]
        watch.note(f"changes {module.__name__}")
        setattr(module, name, value)


def watch_tampering(tell: Tell) -> None:
    """Tell from now on what the code of a page reaches for; it cannot be undone.

    Args:
        tell: Called with each remark.
    """
    watch = _Watch(tell)
    for name in [name for name in sys.modules if _is_hidden(name)]:
        parent, _, own = name.rpartition(".")
        watched = _WatchedModule(sys.modules[name], watch)
        sys.modules[name] = watched
        setattr(import_module(parent), own, watched)
    for module, kind, attribute in _PATHS:
        _watch_attribute(getattr(import_module(module), kind), attribute, watch)
    sys.addaudithook(watch.hear)


def _is_hidden(name: str) -> bool:
    if name.startswith("rosbeat.grading."):
        return True
    return name.startswith(_JUDGES) and name not in _OF_PAGES


def _watch_attribute(kind: type, name: str, watch: _Watch) -> None:
    """Tell who reads an attribute of the objects of a class."""

    def read(self: Any) -> Any:  # noqa: ANN401 - any object
        watch.note(f"reads {name}")
        try:
            return vars(self)[name]
        except KeyError:
            raise AttributeError(name) from None

    def write(self: Any, value: object) -> None:  # noqa: ANN401 - any object
        vars(self)[name] = value

    setattr(kind, name, property(read, write))
