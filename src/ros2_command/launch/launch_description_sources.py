"""Read launch files in Python, XML and YAML."""

from __future__ import annotations

import os
import sys
import traceback
from contextlib import suppress
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from typing import TYPE_CHECKING

from ros2_command.untyped import Untyped

from launch.action import ArgumentNameError
from launch.errors import InvalidLaunchFileError, LaunchError, alias_submodules
from launch.substitution import (
    SomeSubstitutionsType,
    described,
    normalize_to_list_of_substitutions,
    performed,
)

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description import LaunchDescription

__all__ = [
    "AnyLaunchDescriptionSource", "FrontendLaunchDescriptionSource", "InvalidLaunchFileError",
    "LaunchDescriptionSource", "PythonLaunchDescriptionSource",
    "get_launch_description_from_any_launch_file",
    "get_launch_description_from_frontend_launch_file",
    "get_launch_description_from_python_launch_file",
]  # fmt: skip

#: How the name of a launch file in Python ends.
PYTHON = ".py"


class LaunchDescriptionSource:
    """Be the place that a launch description comes from.

    Args:
        launch_description: The launch description, if there is one already.
        location: The launch file.
        method: How it is read.
    """

    def __init__(
        self, launch_description: LaunchDescription | None = None,
        location: SomeSubstitutionsType = "<string>",
        method: str = "unspecified mechanism from a script",
    ) -> None:  # fmt: skip
        self._description = launch_description
        self._location = normalize_to_list_of_substitutions(location)
        self._path: str | None = None
        self.method = method

    @property
    def location(self) -> str:
        """Return the path of the launch file, or what stands for it as long as it is not known."""
        return described(self._location) if self._path is None else self._path

    def is_same(self, other: LaunchDescriptionSource) -> bool:
        """Return whether this is the same file as another's, as far as both are known."""
        return self is other or (self._path is not None and self._path == other._path)

    def get_launch_description(self, context: LaunchContext) -> LaunchDescription:
        """Return the launch description; read it if that has not been done."""
        if self._path is None:
            self._path = performed(context, self._location)
        if self._description is None:
            self._description = self._read(self._path)
        return self._description

    def try_get_launch_description_without_context(self) -> LaunchDescription | None:
        """Return the launch description; None if what it is depends on the launch."""
        if self._description is None:
            from launch.launch_context import LaunchContext

            with suppress(Exception):
                return self.get_launch_description(LaunchContext())
            self._path = None
        return self._description

    def _read(self, path: str) -> LaunchDescription:
        raise RuntimeError(f"'{path}' has no launch description")


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    """Be a launch file in Python, XML or YAML."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, "interpreted launch file")

    def _read(self, path: str) -> LaunchDescription:
        return get_launch_description_from_any_launch_file(path)


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """Be a launch file in Python."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, "interpreted python launch file")

    def _read(self, path: str) -> LaunchDescription:
        return get_launch_description_from_python_launch_file(path)


class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    """Be a launch file in XML or YAML."""

    def __init__(
        self, launch_file_path: SomeSubstitutionsType, *,
        method: str = "interpreted frontend launch file", parser: object = None,
    ) -> None:  # fmt: skip
        del parser
        super().__init__(None, launch_file_path, method)

    def _read(self, path: str) -> LaunchDescription:
        return get_launch_description_from_frontend_launch_file(path)


def get_launch_description_from_any_launch_file(launch_file_path: str) -> LaunchDescription:
    """Read a launch file in Python, XML or YAML; the end of its name says which.

    Raises:
        InvalidLaunchFileError: If it cannot be read.
    """
    if launch_file_path.endswith(PYTHON):
        return get_launch_description_from_python_launch_file(launch_file_path)
    return get_launch_description_from_frontend_launch_file(launch_file_path)


def get_launch_description_from_python_launch_file(
    python_launch_file_path: str,
) -> LaunchDescription:
    """Read a launch file in Python.

    Raises:
        InvalidLaunchFileError: If it cannot be read.
    """
    from launch.launch_description import LaunchDescription

    path = str(python_launch_file_path)
    _check_file(path)
    try:
        module = load_python_launch_file_as_module(path)
        if not hasattr(module, "generate_launch_description"):
            raise InvalidLaunchFileError(
                f"launch file at '{path}' does not contain the required function "
                "'generate_launch_description()'",
                "`ros2 launch` calls this function to learn what to start.",
                "Add it:  def generate_launch_description(): return LaunchDescription([...])",
            )
        description = module.generate_launch_description()
    except LaunchError:
        raise
    except Exception as error:
        raise _unreadable(path, "py", error) from error
    if not isinstance(description, LaunchDescription):
        raise InvalidLaunchFileError(
            f"generate_launch_description() of '{path}' returned '{type(description).__name__}'",
            "`ros2 launch` needs a LaunchDescription, which says what to start.",
            "End the function with:  return LaunchDescription([...])",
        )
    return description


def load_python_launch_file_as_module(python_launch_file_path: str) -> Untyped:
    """Run a launch file in Python, and return it as a module."""
    loader = SourceFileLoader("python_launch_file", python_launch_file_path)
    spec = spec_from_loader(loader.name, loader)
    assert spec is not None
    module = module_from_spec(spec)
    writes, sys.dont_write_bytecode = sys.dont_write_bytecode, True  # no cache beside the file
    try:
        loader.exec_module(module)
    finally:
        sys.dont_write_bytecode = writes
    return module


def get_launch_description_from_frontend_launch_file(
    frontend_launch_file_path: str, *, parser: object = None
) -> LaunchDescription:
    """Read a launch file in XML or YAML.

    Raises:
        InvalidLaunchFileError: If it cannot be read.
    """
    del parser
    from launch import frontend

    path = str(frontend_launch_file_path)
    _check_file(path)
    kind = os.path.splitext(path)[1][1:]
    try:
        return frontend.read(path, kind)
    except LaunchError:
        raise
    except Exception as error:
        raise _unreadable(path, kind, error) from error


def _check_file(path: str) -> None:
    if not os.path.isfile(path):
        raise InvalidLaunchFileError(
            f"[Errno 2] No such file or directory: '{path}'",
            "A launch file is included that is not there.",
            "Compare the path; a package has its launch files in its share folder only after "
            "`data_files` in setup.py names them, and the next `colcon build`.",
        )


def _unreadable(path: str, kind: str, error: Exception) -> InvalidLaunchFileError:
    """Return the error that tells why a launch file cannot be read, and where."""
    what = f"Caught exception when trying to load file of format [{kind}]:\n"
    kind = "TypeError" if isinstance(error, ArgumentNameError) else type(error).__name__
    what += f" - {kind}: {error}"
    name = os.path.basename(path)
    frames = [
        frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename == path
    ]
    where = f"'{name}', line {frames[-1].lineno}: {frames[-1].line}" if frames else f"'{name}'"
    meaning = f"This line cannot be done: {where}" if frames else f"{where} cannot be read."
    advice = "Correct the launch file there; `ros2 launch --debug` shows the whole traceback."
    if isinstance(error, SyntaxError):
        meaning = (
            f"Python cannot read line {error.lineno} of '{name}': {(error.text or '').strip()}"
        )
        advice = "Look there, and in the line before, for a bracket or comma that is missing."
    elif isinstance(error, ModuleNotFoundError):
        meaning = (
            f"'{name}' imports the Python package '{error.name}', which is not installed here."
        )
        advice = "Install it, or source the workspace that has it; else leave its part out."
    elif isinstance(error, ArgumentNameError):
        meaning, advice = f"{error.meaning} {meaning}", error.advice
    return InvalidLaunchFileError(what, meaning, advice)


alias_submodules(__name__, __all__)
