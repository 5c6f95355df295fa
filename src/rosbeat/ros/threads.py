"""Let threads that the code of nodes starts, and what they wait for, take virtual time.

A thread that is started by code of a node is a greenlet of its simulated process, as in gevent. It
runs until it waits: for a lock, an event, a condition, a queue, a pool, another thread, or the
time. Python builds all of these on two things, locks and threads, so only these are replaced, and
where Python has a version in C and one in Python, the latter is used.

What C code waits for by itself, such as a socket, still takes real time and holds up the session.
"""

from __future__ import annotations

import _thread
import queue
import selectors
import sys
import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import thread as pools
from functools import wraps
from itertools import count
from typing import Any

from rosbeat.ros.waits import Call, Switchboard, Wait, board_here

_real_lock = _thread.allocate_lock
_real_get_ident = threading.get_ident
#: Numbers of simulated threads; the system's own are addresses, which are larger.
_idents = count(1)


class VirtualLock:
    """Be a lock whose `acquire` suspends a simulated thread; for others, be an ordinary lock."""

    def __init__(self, board: Switchboard, lock: Any = None) -> None:  # noqa: ANN401 - Python's lock
        self._board = board
        self._lock = lock or _real_lock()
        self._waits: deque[Wait] = deque()

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Acquire the lock; see `threading.Lock.acquire`."""
        if self._lock.acquire(False):
            return True
        if not blocking:
            return False
        board = self._board
        if not (board.in_callback or (board.running and board.thread == _real_get_ident())):
            if board.thread == _real_get_ident():
                return False  # its process does not run any more, as at the end of Python
            return self._lock.acquire(True, timeout)
        until = board.after(timeout)
        while not self._lock.acquire(False):
            if until is not None and board.now >= until:
                return False
            board.block("a lock", until, prepare=self._waits.append)
        return True

    def release(self) -> None:
        """Release the lock, and let the first thread that waits for it go on."""
        self._lock.release()
        while self._waits:
            wait = self._waits.popleft()
            if not wait.over and not wait.woken:
                self._board.wake(wait)
                break

    def locked(self) -> bool:
        """Return whether somebody holds the lock."""
        return self._lock.locked()

    def _at_fork_reinit(self) -> None:
        self._lock = _real_lock()

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *_: object) -> None:
        self.release()


#: Packages of the page's own kernel, whose locks other threads of the system share.
_KERNELS = ("ipykernel", "IPython", "zmq", "tornado", "jupyter_client", "traitlets", "comm")


def _board_of_caller() -> Switchboard | None:
    """Return the switchboard of the code that makes something to wait for.

    What prints in a page makes locks as well, and waits for a thread of the kernel.
    """
    board = board_here()
    frame = sys._getframe(2) if board is not None else None
    while frame is not None:
        package = str(frame.f_globals.get("__name__", "")).partition(".")[0]
        if package in _KERNELS:
            return None
        if package not in ("threading", "queue", "concurrent", "rosbeat"):
            break
        frame = frame.f_back
    return board


def make_lock() -> Any:  # noqa: ANN401 - Python's lock, or one of ours
    """Return a lock: for code of a node one that waits in virtual time."""
    board = _board_of_caller()
    return _real_lock() if board is None else VirtualLock(board)


def make_reentrant_lock() -> Any:  # noqa: ANN401 - Python's lock, or one of ours
    """Return a reentrant lock: for code of a node one that waits in virtual time."""
    if _board_of_caller() is None:
        return _real_reentrant_lock()
    # Written in Python, on the lock above.
    return threading._PyRLock()  # type: ignore[attr-defined] # it has no public name


_real_reentrant_lock = threading.RLock


def make_simple_queue() -> Any:  # noqa: ANN401 - Python's queue in C or the one in Python
    """Return a simple queue: for code of a node one that waits in virtual time."""
    if _board_of_caller() is None:
        return _real_simple_queue()
    # Written in Python, on the semaphore of `threading`.
    return queue._PySimpleQueue()  # type: ignore[attr-defined] # it has no public name


_real_simple_queue = queue.SimpleQueue


def get_ident() -> int:
    """Return the number of the thread that calls this, simulated or not."""
    board = board_here()
    call = board.current if board is not None else None
    return (call.ident if call is not None else 0) or _real_get_ident()


class _Running:
    """Hold a simulated thread.

    Attributes:
        ended: Whether it has returned, raised or been ended with its process.
    """

    def __init__(self, board: Switchboard, thread: threading.Thread, call: Call) -> None:
        self.board, self.thread, self.call = board, thread, call
        self.ended = False
        self._waits: list[Wait] = []
        call.process.running.append(self)

    def run(self) -> None:
        """Run the thread's code, and say what it raises as Python does."""
        try:
            self.thread.run()
        except SystemExit:
            pass
        except Exception:
            threading.excepthook(_hook_arguments(self.thread))
        finally:
            self.end()

    def end(self) -> None:
        """Note that it has ended, and let go on who has waited for that."""
        self.ended = True
        self.call.process.threads -= 1
        self.call.process.running.remove(self)
        _active().pop(self.call.ident, None)
        for wait in self._waits:
            self.board.wake(wait)

    @property
    def outlives_main(self) -> bool:
        """Return whether Python waits for the thread at the end of `main`."""
        # The threads of a pool end with the program; their queues have no public name.
        is_of_pool = self.thread in pools._threads_queues
        return not self.thread.daemon and not is_of_pool

    def join(self, timeout: float | None) -> None:
        """Wait until it has ended."""
        if self.ended or not self.board.in_callback:
            return  # outside of a run nothing goes on, as at the end of Python
        self.board.block(
            f"the end of {self.thread.name}", self.board.after(timeout), prepare=self._waits.append
        )


def _hook_arguments(thread: threading.Thread) -> Any:  # noqa: ANN401 - a structure of Python's
    return threading.ExceptHookArgs((*sys.exc_info(), thread))


def _active() -> dict[int, threading.Thread]:
    active: dict[int, threading.Thread] = threading._active  # type: ignore[attr-defined] # private
    return active


def _start(original: Callable[[threading.Thread], None]) -> Callable[[threading.Thread], None]:
    @wraps(original)
    def start(thread: threading.Thread) -> None:
        board = board_here()
        # A thread knows by this event that it was started.
        started: threading.Event = thread._started  # type: ignore[attr-defined] # private
        if board is None or started.is_set():
            original(thread)
            return
        creator = board.current
        assert creator is not None
        call = Call(creator.process)
        call.ident = next(_idents)
        call.label = board.thread_label(creator, thread.name)
        call.idle = True
        creator.process.threads += 1
        running = _Running(board, thread, call)
        call.abandon = running.end
        vars(thread)["_rosbeat_running"] = running
        thread._ident = thread._native_id = call.ident  # type: ignore[attr-defined] # private
        started.set()
        _active()[call.ident] = thread
        board.start_greenlet(call, running.run)

    return start


def _join(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def join(thread: threading.Thread, timeout: float | None = None) -> None:
        running: _Running | None = vars(thread).get("_rosbeat_running")
        if running is None:
            original(thread, timeout)
        else:
            running.join(timeout)

    return join


def _is_alive(original: Callable[[threading.Thread], bool]) -> Callable[[threading.Thread], bool]:
    @wraps(original)
    def is_alive(thread: threading.Thread) -> bool:
        running: _Running | None = vars(thread).get("_rosbeat_running")
        return original(thread) if running is None else not running.ended

    return is_alive


def _select(original: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(original)
    def select(selector: selectors.BaseSelector, timeout: float | None = None) -> Any:  # noqa: ANN401 - Python's own
        board = board_here()
        if board is None:
            return original(selector, timeout)
        ready: list[Any] = list(original(selector, 0))
        if ready:
            return ready
        if timeout is not None and timeout <= 0:
            board.give_way()
            return ready

        def look() -> bool:
            ready.extend(original(selector, 0))
            return bool(ready)

        board.block("an event loop", board.after(timeout), look, idle=True)
        return ready

    return select


def _install() -> None:
    thread: Any = threading.Thread
    thread.start, thread.join = _start(thread.start), _join(thread.join)
    thread.is_alive = _is_alive(thread.is_alive)
    for kind in ("EpollSelector", "PollSelector", "SelectSelector"):
        selector: Any = getattr(selectors, kind)
        selector.select = _select(selector.select)


_install()  # at import, so exactly once in a process
