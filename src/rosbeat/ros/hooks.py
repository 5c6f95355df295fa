"""Replace attributes of rclpy, once per process: the table of all patches that stay.

The wrappers themselves are in the modules of their concepts; here is what they replace, and why.
Importing this module installs them all, and `session_core` does so. Outside of sessions they do
what rclpy does.

Three kinds of patches are elsewhere. What is replaced on one object, such as `publish` of a
publisher, is in `entity_watch`, `actions`, `qos_events` and `recording`. What is replaced only
while nodes run, such as the default context or `time.sleep`, is in `context`, `clock` and
`simulated_program`. What belongs to Python, such as threads, is in `threads`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial, wraps
from typing import Any, NamedTuple

import rclpy
import rclpy.event_handler
import rclpy.executors
from rclpy import experimental
from rclpy import wait_for_message as message_waiting
from rclpy.action import ActionClient, ActionServer
from rclpy.action.server import ServerGoalHandle
from rclpy.clock import Clock
from rclpy.context import Context
from rclpy.executors import Executor, MultiThreadedExecutor
from rclpy.guard_condition import GuardCondition
from rclpy.impl import rcutils_logger
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.node import Node
from rclpy.task import Task
from rclpy.timer import Timer

from rosbeat.ros import actions, clock, context, differences, logs, recording, spinning, wait_set


class Patch(NamedTuple):
    """Describe an attribute of rclpy that is replaced for good.

    Attributes:
        owner: The class or module that has the attribute.
        name: The attribute.
        wrap: Makes what replaces it, given the original.
        why: The reason, in a sentence.
    """

    owner: Any
    name: str
    wrap: Callable[[Any], Any]
    why: str


def _instead(replacement: Any) -> Callable[[Any], Any]:  # noqa: ANN401 - anything
    return lambda _: replacement


def _named(replacement: Callable[..., Any]) -> Callable[[Any], Any]:
    return lambda original: wraps(original)(replacement)


_IMPLEMENTATION = wait_set.Implementation()
_GOAL = ServerGoalHandle

PATCHES = (
    # Nodes and what they make.
    Patch(Node, "__init__", recording.watch_birth,
          "A node starts as its session says, and rclpy has no hook for new nodes."),
    Patch(Node, "destroy_node", recording.watch_end,
          "The session forgets a node before rclpy destroys its handles."),
    Patch(Node, "get_logger", recording.watch_logger,
          "The lines of a node come to its session."),
    Patch(Node, "_get_info_by_topic", recording.show_as_written,
          "The two methods that list endpoints show the QoS that a program has written."),
    Patch(Node, "create_guard_condition", recording.watch_guards,
          "Only rclpy's own executor can run a guard condition."),
    Patch(Node, "add_waitable", recording.watch_waitables,
          "Only rclpy's own executor can run a waitable."),
    *(Patch(Node, method, partial(recording.watch_entity, kind=kind),
            "rclpy has no hook for new entities.")
      for method, kind in recording.ENTITY_METHODS.items()),
    # Actions.
    Patch(ActionServer, "__init__", partial(actions.watch_action, kind=actions.SERVER),
          "rclpy has no hook for new action servers."),
    Patch(ActionClient, "__init__", partial(actions.watch_action, kind=actions.CLIENT),
          "rclpy has no hook for new action clients."),
    Patch(_GOAL, "publish_feedback", partial(actions.watch_publishing, topic="feedback"),
          "Clients look for the feedback that a goal has sent."),
    Patch(_GOAL, "_update_state", partial(actions.watch_publishing, topic="status"),
          "After every change of a goal's state its server publishes the status."),
    # Contexts and clocks.
    Patch(Context, "__new__", _instead(staticmethod(context.new_context)),
          "A context that a program makes is the program's own."),
    Patch(Clock, "__new__", _instead(staticmethod(clock.new_clock)),
          "A clock that a node makes shows virtual time."),
    # Executors.
    Patch(rclpy.executors, "_rclpy", _instead(_IMPLEMENTATION),
          "An executor suspends its greenlet where it would wait in C."),
    Patch(message_waiting, "_rclpy", _instead(_IMPLEMENTATION),
          "`wait_for_message` has a wait set of its own."),
    Patch(Executor, "_make_handler", wait_set.watch_handlers,
          "Callbacks are recorded, and the node is known whose code runs."),
    Patch(Executor, "create_task", wait_set.watch_tasks,
          "A task belongs to the process that has made it."),
    Patch(Executor, "wait_for_ready_callbacks", wait_set.give_way,
          "Processes take turns."),
    Patch(Executor, "get_nodes", wait_set.in_order,
          "Nodes keep an order, which rclpy's set has not."),
    Patch(Executor, "add_node", partial(wait_set.watch_nodes, spins=True),
          "The session knows which nodes spin."),
    Patch(Executor, "remove_node", partial(wait_set.watch_nodes, spins=False),
          "The session knows which nodes no longer spin."),
    Patch(MultiThreadedExecutor, "__init__", wait_set.choose_threads,
          "The number of threads is the same on each machine."),
    Patch(Task, "__call__", wait_set.watch_steps,
          "The engine knows whose code a step of a task runs."),
    Patch(GuardCondition, "trigger", wait_set.watch_trigger,
          "A trigger wakes the executors that wait for it."),
    Patch(Timer, "__init__", wait_set.watch_timers,
          "The engine finds the timer of a handle in a wait set."),
    Patch(rclpy, "get_global_executor", wait_set.own_global_executor,
          "Each process has its own global executor."),
    # Log lines.
    Patch(RcutilsLogger, "log", _instead(logs.hooked_log),
          "The lines of all loggers are captured."),
    Patch(RcutilsLogger, "get_child", _instead(logs.hooked_child),
          "A child is heard by the session of its parent."),
    Patch(rclpy_implementation, "rclpy_logging_rcutils_log", _named(logs.hooked_send),
          "No text of a session goes to file descriptor 2."),
    Patch(rclpy_implementation, "rclpy_logging_logger_is_enabled_for",
          _named(logs.hooked_is_enabled), "Each simulated process has its own levels."),
    Patch(rclpy_implementation, "rclpy_logging_get_logger_effective_level",
          _named(logs.hooked_effective_level), "Each simulated process has its own levels."),
    Patch(rclpy_implementation, "rclpy_logging_get_logger_level",
          _named(logs.hooked_get_level), "Each simulated process has its own levels."),
    Patch(rclpy_implementation, "rclpy_logging_set_logger_level",
          _named(logs.hooked_set_level), "Each simulated process has its own levels."),
    Patch(rclpy.event_handler, "get_logger", differences.let_callbacks_warn,
          "rclpy's own lines call `warn`, which Kilted deprecates."),
    # What a cell calls.
    Patch(rclpy, "init", context.init_for_pages,
          "In a kernel it would install signal handlers that disable Interrupt."),
    Patch(rclpy, "spin", spinning.spin_for_pages,
          "It waits in C, where Interrupt has no effect."),
    Patch(rclpy, "spin_once", spinning.spin_once_for_pages,
          "The session runs the nodes itself."),
    Patch(rclpy, "spin_until_future_complete", spinning.spin_until_for_pages,
          "The nodes that complete the future are run by the session."),
    Patch(experimental, "EventsExecutor", spinning.refuse_in_session,
          "It waits in C++, where virtual time does not reach it."),
)  # fmt: skip


def _install() -> None:
    context.release_interrupt()
    # rclpy names the caller of a log line by skipping the files in this list.
    rcutils_logger._internal_callers.append(logs.THIS_FILE)
    for patch in PATCHES:
        setattr(patch.owner, patch.name, patch.wrap(getattr(patch.owner, patch.name)))


_install()  # at import, so exactly once in a process
