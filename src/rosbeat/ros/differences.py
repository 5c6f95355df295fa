"""Hold what differs between rclpy 7.1 (Jazzy) and 9.1 (Kilted), each difference in one place.

The rest of this folder asks here and knows no distribution. Each difference is recognized by what
rclpy offers rather than by a number, so that a release that takes it back is understood as well.
`docs/distributions.md` says how to take up the next distribution.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import partial
from types import FunctionType, MethodType
from typing import Any, cast

import rclpy
from rclpy.client import Client
from rclpy.context import Context
from rclpy.executors import Executor
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.task import Task
from rclpy.timer import Timer

_LOOP = set(Executor._wait_for_ready_callbacks.__code__.co_names)
HAS_OLDEST_TASK_FIRST = "popleft" in _LOOP or not _LOOP & {"reversed", "pop"}
"""Tell whether an executor continues its tasks in the order in which they were created.

Kilted does. In Jazzy the newest task goes first.
"""

RAISES_WHEN_CALL_TIMES_OUT = "TimeoutError" in Client.call.__code__.co_names
"""Tell whether `client.call(request, timeout_sec)` raises TimeoutError when the time is over.

Kilted does. Jazzy returns None.
"""

INIT_IS_FOR_WITH = hasattr(rclpy, "InitContextManager")
"""Tell whether `rclpy.init()` returns a context manager that shuts down at the end of its block.

Kilted does. Jazzy returns None, so that `with rclpy.init():` is a TypeError there.
"""

FORGIVES_SHUTDOWN_AFTER_SIGNAL = INIT_IS_FOR_WITH
"""Tell whether `rclpy.shutdown()` is in order after Ctrl+C or SIGTERM has shut the context down.

Kilted refuses only a second call ("Context already shutdown."). Jazzy also refuses the first one
after a signal ("rcl_shutdown already called on the given context"), so that a program that ends as
those of the tutorials do has exit code 1.
"""

SHUTDOWN_DESTROYS_NODES = hasattr(Context, "track_node")
"""Tell whether `rclpy.shutdown()` destroys the nodes of its context; what uses one then raises.

Kilted does.
"""

# The tasks of an executor. From 7.1.9 (Jazzy) and 9.1.4 (Kilted) on, those that have not ended are
# the keys of a dict, and one that waits is put into a queue when what it waits for has come
# (rclpy#1469). Before, all are in a list, and each pass asks them.


def tasks_of(executor: Executor) -> list[Task]:
    """Return the tasks of an executor that have not ended."""
    if hasattr(executor, "_pending_tasks"):
        return list(executor._pending_tasks)
    return [task for task, _, _ in executor._tasks]


def tasks_for(executor: Executor, entity: object) -> list[Task]:
    """Return the tasks of an executor that have not ended and run the callback of an entity."""
    if hasattr(executor, "_pending_tasks"):
        items = executor._pending_tasks.items()
        return [task for task, data in items if data.source_entity is entity]
    return [task for task, source, _ in executor._tasks if source is entity and not task.done()]


KEEPS_TASKS_IN_LIST = hasattr(Executor, "create_task") and "_tasks" in (
    Executor.__init__.__code__.co_names
)
"""Tell whether each pass of an executor asks all of its tasks."""


def call_soon(executor: Executor, task: Task) -> None:
    """Let an executor call a handler that was made for it; before, making it was enough."""
    if hasattr(executor, "_call_task_in_next_spin"):
        executor._call_task_in_next_spin(task)


def forget_executing(executor: Executor) -> None:
    """Forget tasks that were interrupted: rclpy would take them for executing, forever."""
    if hasattr(executor, "_pending_tasks"):
        for task in tasks_of(executor):
            if task.executing():
                del executor._pending_tasks[task]
    else:
        executor._tasks[:] = [parts for parts in executor._tasks if not parts[0].executing()]


# Timers. Kilted tells a callback that has a parameter of the type `TimerInfo` when it was due.

_TimerInfo: Any = getattr(inspect.getmodule(Timer), "TimerInfo", None)


def call_timer(timer: Timer) -> Callable[[], Any]:
    """Mark a timer that is due as called, and return its callback, ready to be called.

    Raises:
        InvalidHandle: If the timer was destroyed.
    """
    if _TimerInfo is None:
        timer.handle.call_timer()
        return cast("Callable[[], Any]", timer.callback)
    times = timer.handle.call_timer_with_info()
    name = _parameter_for_info(timer.callback)
    if name is None:
        return cast("Callable[[], Any]", timer.callback)
    info = _TimerInfo(
        expected_call_time=times["expected_call_time"],
        actual_call_time=times["actual_call_time"],
        clock_type=timer.clock.clock_type,
    )
    return partial(timer.callback, **{name: info})


def _parameter_for_info(callback: Callable[..., Any]) -> str | None:
    """Return the first parameter that is annotated with `TimerInfo`, as rclpy looks for it.

    A signature takes a hundred times as long as a look at the annotations, and most have none.
    What cannot be called is called all the same, as in Jazzy: its TypeError names the mistake.
    """
    if not callable(callback):
        return None
    plain = isinstance(callback, FunctionType | MethodType) and not hasattr(callback, "__wrapped__")
    if plain and _TimerInfo not in callback.__annotations__.values():
        return None
    parameters = inspect.signature(callback).parameters.values()
    return next((one.name for one in parameters if one.annotation == _TimerInfo), None)


# Log lines of rclpy itself. In Kilted `logger.warn` is deprecated, and rclpy still calls it: in its
# callbacks for incompatible QoS, and in action servers. Where a DeprecationWarning is an error, as
# in many test suites, a line of rclpy itself would end the node.


def let_rclpy_warn(logger: RcutilsLogger) -> RcutilsLogger:
    """Let a logger that rclpy keeps for itself say `warn` without being told off; return it."""
    if hasattr(RcutilsLogger.warn, "__deprecated__"):
        logger.warn = logger.warning
    return logger


def let_callbacks_warn(original: Callable[..., RcutilsLogger]) -> Callable[..., RcutilsLogger]:
    """Wrap the `get_logger` of rclpy's callbacks for incompatible QoS."""
    return lambda name: let_rclpy_warn(original(name))
