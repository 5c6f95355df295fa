"""Log as `launch.logging` does: `[INFO] [name]: text`, on the screen and in a file."""

from __future__ import annotations

import logging
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from pathlib import Path

from launch.host import Host

_hosts: list[Host] = []


@contextmanager
def logging_to(host: Host) -> Iterator[None]:
    """Let what launch files log themselves go to a host."""
    _hosts.append(host)
    try:
        yield
    finally:
        _hosts.remove(host)


class _ToHost(logging.Handler):
    def emit(self, record: logging.LogRecord) -> None:
        """Give the record to the launch that runs."""
        if _hosts:
            _hosts[-1].log(record.levelno, record.name, record.getMessage())


def get_logger(name: str | None = None) -> logging.Logger:
    """Return a logger whose lines appear among those of the launch."""
    logger = logging.getLogger(name or "launch.root")
    if not any(isinstance(handler, _ToHost) for handler in logger.handlers):
        logger.addHandler(_ToHost())
        logger.propagate = False
        logger.setLevel(launch_config.level)
    return logger


class LaunchConfig:
    """Hold the level and the folder of the log.

    Attributes:
        level: Lines below it are dropped.
        formats: What a line looks like, on the screen and in a file.
    """

    def __init__(self) -> None:
        self.level = logging.INFO
        self._folder: str | None = None
        screen = os.environ.get("OVERRIDE_LAUNCH_SCREEN_FORMAT") or "default"
        file = os.environ.get("OVERRIDE_LAUNCH_LOG_FORMAT") or "default_with_timestamp"
        self.screen_format, self.file_format = _format(screen), _format(file)

    @property
    def log_dir(self) -> str:
        """Return the folder of this launch's log files; the first time it is made."""
        if self._folder is None:
            base = log_base()
            stamp = f"{datetime.now():%Y-%m-%d-%H-%M-%S-%f}"
            folder = base / f"{stamp}-{socket.gethostname()}-{os.getpid()}"
            folder.mkdir(parents=True)
            latest = base / "latest"
            with suppress(OSError):  # another launch does the same now
                if latest.is_symlink():
                    latest.unlink()
                latest.symlink_to(folder, target_is_directory=True)
            self._folder = str(folder)
        return self._folder

    @log_dir.setter
    def log_dir(self, folder: str) -> None:
        self._folder = folder


def _format(text: str) -> str:
    shown = {
        "default": "[{levelname}] [{name}]: {msg}",
        "default_with_timestamp": "{created:.7f} [{levelname}] [{name}]: {msg}",
    }
    return shown.get(text, text.encode("latin1", "replace").decode("unicode_escape"))


def log_base() -> Path:
    """Return the folder in which each launch has one for its log files."""
    given = os.environ.get("ROS_LOG_DIR")
    if given:
        return Path(given).expanduser()
    return Path(os.environ.get("ROS_HOME") or "~/.ros").expanduser() / "log"


launch_config = LaunchConfig()


def reset() -> None:
    """Forget the folder and the level."""
    launch_config.__init__()  # type: ignore[misc] # the object is imported elsewhere
