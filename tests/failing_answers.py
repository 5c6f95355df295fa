"""Answers of learners that go wrong in every way, for `observe` and `check`; each is its own node.

Each of them is an answer to exercise 03a: what should be there is a sensor on `humidity`.
"""

from __future__ import annotations

import builtins
import contextlib
import os
import re
import select
import signal
import subprocess
import sys
import threading
import time
import warnings

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float32


class Base(Node):
    """Does `act` in a callback, twice a second, after it has published."""

    def __init__(self):
        super().__init__("nasty")
        self.publisher = self.create_publisher(Float32, "humidity", 5)
        self.create_timer(0.5, self.beat)

    def beat(self):
        self.publisher.publish(Float32(data=50.0))
        self.act()

    def act(self):
        """What goes wrong."""


def doing(act):
    """A node class that does something in its callback."""
    return type("Doing", (Base,), {"act": act})


def born(act):
    """A node class that does something in its constructor."""

    class Born(Base):
        def __init__(self):
            super().__init__()
            act(self)

    return Born


def loop(node=None):
    while True:
        pass


def swallow(node=None):
    while True:
        try:  # noqa: SIM105 - as a learner writes it
            time.time()
        except:  # noqa: E722
            pass


def suppress(node=None):
    while True:
        with contextlib.suppress(BaseException):
            select.select([], [], [])  # in C, where virtual time does not reach


def prints(node=None):
    while True:
        print("more")


def logs(node):
    while True:
        node.get_logger().info("more")


def publishes(node):
    while True:
        node.publisher.publish(Float32(data=1.0))


def recursive(node):
    return recursive(node)


def spins_alone(node):
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.spin()


class Deadly(Base):
    """Is never quite gone."""

    def __del__(self):
        loop()


class Undestroyable(Base):
    """Resists."""

    def destroy_node(self):
        raise RuntimeError("no")


class Clinging(Base):
    """Resists for ever."""

    def destroy_node(self):
        loop()


class Own(BaseException):
    """An exception that `except Exception` does not catch."""


class Unprintable(Exception):  # noqa: N818
    """An exception that cannot be shown."""

    def __str__(self):
        raise ValueError("no text")


def raising(error):
    def act(node):
        raise error

    return act


class Meta(type):
    """A class of classes that does not like to be looked at."""

    def __repr__(cls):
        raise RuntimeError("no text")

    def __call__(cls, *args):
        raise RuntimeError("no call")


class NoNode(metaclass=Meta):
    """No node at all."""


def threads(act):
    """Start a thread that goes on."""

    def begin(node):
        if not hasattr(node, "thread"):
            node.thread = threading.Thread(target=act, args=(node,), name="nasty", daemon=True)
            node.thread.start()

    return begin


def stubborn_prints(node):
    for _ in range(30):
        print("from a thread", flush=True)
        time.sleep(0.01)


def ignores_signals(node):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGALRM, signal.SIG_IGN)


def changes_everything(node):
    ignores_signals(node)
    sys.stdout = sys.stderr = None
    sys.excepthook = threading.excepthook = None
    os.chdir("/")
    os.environ["ROS_DOMAIN_ID"] = "3"
    builtins.sum = builtins.print = 3  # not len: the other threads of a kernel need that one
    warnings.simplefilter("error")
    sys.setrecursionlimit(5000)


#: Those that never end by themselves.
ENDLESS = {
    "loop in a callback": doing(loop),
    "loop in the constructor": born(loop),
    "loop that catches everything": doing(swallow),
    "the same with suppress": born(suppress),
    "sleep in a thread's wait": doing(lambda _: threading.Event().wait()),
    "subprocess": doing(lambda _: subprocess.run(["sleep", "1000"])),
    "regular expression": doing(lambda _: re.match(r"(a+)+$", "a" * 40 + "b")),
    "numbers": doing(lambda _: 7 ** (10**9)),
    "prints": doing(prints),
    "logs": doing(logs),
    "publishes": doing(publishes),
    "spins an executor of its own": born(spins_alone),
    "replaced handlers, then loop": doing(lambda node: (ignores_signals(node), loop())),
}

#: Those of them that wait for what only a thread could do, where there is none.
DEADLOCKED = ("sleep in a thread's wait",)

#: Those of them that do it in their constructor.
AT_BIRTH = (
    "loop in the constructor",
    "the same with suppress",
    "spins an executor of its own",
)

#: Those that end with an exception, and its class.
RAISING = {
    "sys.exit in a callback": (doing(lambda _: sys.exit(3)), "SystemExit"),
    "sys.exit in the constructor": (born(lambda _: sys.exit(3)), "SystemExit"),
    "its own BaseException": (doing(raising(Own())), "Own"),
    "KeyboardInterrupt": (doing(raising(KeyboardInterrupt())), "KeyboardInterrupt"),
    "GeneratorExit": (doing(raising(GeneratorExit())), "GeneratorExit"),
    "no text": (doing(raising(Unprintable())), "Unprintable"),
    "recursion": (doing(recursive), "RecursionError"),
    "input": (doing(lambda _: input("?")), "EOFError"),
    "sleep without end at birth": (born(lambda _: time.sleep(1000)), "DeadlinePassed"),
    "sleep without end": (doing(lambda _: time.sleep(1000)), "DeadlinePassed"),
    "publisher destroyed": (
        doing(lambda node: node.publisher.destroy()),
        "InvalidHandle",
    ),
    "spins in the constructor": (born(rclpy.spin), "SessionError"),
    "init in a callback": (doing(lambda _: rclpy.init()), "RuntimeError"),
    "metaclass": (NoNode, "NodeClassError"),
}

#: Those that do what they should, and something else besides.
HARMLESS = {
    "prints without need": doing(lambda _: [print("x") for _ in range(5_000)]),
    "changes everything": doing(changes_everything),
    "a thread that prints": doing(threads(stubborn_prints)),
    "a thread that publishes elsewhere": doing(threads(lambda _: time.sleep(1))),
    "never quite gone": Deadly,
    "undestroyable": Undestroyable,
    "clinging": Clinging,
    "sleeps shortly": doing(lambda _: time.sleep(0.1)),
}
