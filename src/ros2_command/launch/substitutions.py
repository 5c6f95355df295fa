"""Define the substitutions of `launch.substitutions`."""

from __future__ import annotations

import importlib
import math
import os
import shlex
import shutil
import subprocess
import uuid
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2_command.untyped import Untyped

from launch.errors import SubstitutionFailure, alias_submodules
from launch.substitution import (
    SomeSubstitutionsType,
    Substitution,
    TextSubstitution,
    described,
    is_substitution,
    normalize_to_list_of_substitutions,
    performed,
    performed_flag,
)

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = [
    "AllSubstitution", "AndSubstitution", "AnonName", "AnySubstitution", "Command",
    "EnvironmentVariable", "EqualsSubstitution", "FileContent", "FindExecutable",
    "IfElseSubstitution", "LaunchConfiguration", "LaunchLogDir", "LocalSubstitution",
    "NotEqualsSubstitution", "NotSubstitution", "OrSubstitution", "PathJoinSubstitution",
    "PythonExpression", "SubstitutionFailure", "TextSubstitution", "ThisLaunchFile",
    "ThisLaunchFileDir",
]  # fmt: skip


class LaunchConfiguration(Substitution):
    """Stand for the value of a launch configuration, such as an argument of the launch."""

    def __init__(self, variable_name: SomeSubstitutionsType, *, default: object = None) -> None:
        self.variable_name = normalize_to_list_of_substitutions(variable_name)
        self._default = None if default is None else _texts(default)

    def describe(self) -> str:
        """Return a description of it."""
        return f"LaunchConfig({described(self.variable_name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value."""
        name = performed(context, self.variable_name)
        if name in context.launch_configurations:
            return str(context.launch_configurations[name])
        if self._default is None:
            raise SubstitutionFailure(
                f"launch configuration '{name}' does not exist",
                "The launch file uses an argument that it has not declared before this line.",
                f"Add DeclareLaunchArgument('{name}', default_value=...) in front of it, or "
                f"type {name}:=VALUE behind the launch file.",
            )
        return performed(context, self._default)


def _texts(value: Untyped) -> list[Substitution]:
    parts = value if isinstance(value, list | tuple) else [value]
    return [
        part for item in parts
        for part in normalize_to_list_of_substitutions(
            item if isinstance(item, str | Substitution) else str(item))
    ]  # fmt: skip


class EnvironmentVariable(Substitution):
    """Stand for the value of an environment variable."""

    def __init__(
        self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None
    ) -> None:
        self.name = normalize_to_list_of_substitutions(name)
        self.default_value = default_value

    def describe(self) -> str:
        """Return a description of it."""
        return f"EnvVar({described(self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value."""
        name = performed(context, self.name)
        if name in context.environment:
            return context.environment[name]
        if self.default_value is None:
            raise SubstitutionFailure(
                f"environment variable '{name}' does not exist",
                "The launch file uses a variable that this terminal does not have.",
                f"Type `export {name}=VALUE` first, or give EnvironmentVariable a default_value.",
            )
        return performed(context, self.default_value)


class PathJoinSubstitution(Substitution):
    """Stand for a path whose parts are substitutions."""

    def __init__(self, substitutions: Iterable[SomeSubstitutionsType]) -> None:
        self.substitutions = [normalize_to_list_of_substitutions(part) for part in substitutions]

    def describe(self) -> str:
        """Return a description of it."""
        return f"PathJoin('{' + '.join(described(part) for part in self.substitutions)}')"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        return os.path.join(*(performed(context, part) for part in self.substitutions))


class PythonExpression(Substitution):
    """Stand for the value of a Python expression."""

    def __init__(
        self, expression: SomeSubstitutionsType, python_modules: SomeSubstitutionsType = ("math",)
    ) -> None:
        self.expression = normalize_to_list_of_substitutions(expression)
        self.python_modules = normalize_to_list_of_substitutions(python_modules)

    def describe(self) -> str:
        """Return a description of it."""
        modules = ", ".join(part.describe() for part in self.python_modules)
        return f"PythonExpr({described(self.expression)}, [{modules}])"

    def perform(self, context: LaunchContext) -> str:
        """Return the value."""
        names: dict[str, Any] = {}
        for part in self.python_modules:
            module = importlib.import_module(part.perform(context))
            names |= vars(math) if module is math else {}
            names[module.__name__] = module
        text = performed(context, self.expression)
        try:
            return str(eval(text, {}, names))
        except Exception as error:
            raise SubstitutionFailure(
                str(error),
                f"PythonExpression gave Python this expression: {text}",
                "Put quotes around a text within it, as in PythonExpression(["
                "\"'\", LaunchConfiguration('mode'), \"' == 'fast'\"]).",
            ) from error


class LocalSubstitution(Substitution):
    """Stand for something that is known in the place where it is used, as `event.reason` is."""

    def __init__(self, expression: str, *, description: str | None = None) -> None:
        self.expression, self.description = expression, description

    def describe(self) -> str:
        """Return a description of it."""
        return f"LocalVar('{self.description or self.expression}')"

    def perform(self, context: LaunchContext) -> str:
        """Return what it is."""
        names = context.get_locals_as_dict()
        try:
            return str(eval(f"context.locals.{self.expression}", {}, {"context": context}))
        except Exception as error:
            raise SubstitutionFailure(
                str(error),
                f"Here `{self.expression}` is not known; known are: {', '.join(names) or 'none'}.",
                "Use LocalSubstitution within an event handler, for what its event tells.",
            ) from error


class FindExecutable(Substitution):
    """Stand for the path of a program that the terminal finds."""

    def __init__(self, *, name: SomeSubstitutionsType) -> None:
        self.name = normalize_to_list_of_substitutions(name)

    def describe(self) -> str:
        """Return a description of it."""
        return f"FindExec({described(self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        name = performed(context, self.name)
        path = shutil.which(name, path=context.environment.get("PATH"))
        if path is None:
            raise SubstitutionFailure(
                f"executable '{name}' not found on the PATH",
                "No folder in the variable PATH has a program of this name.",
                f"Compare the name, and try it in this terminal:  which {name}",
            )
        return path


class Command(Substitution):
    """Stand for what a command prints."""

    def __init__(
        self, command: SomeSubstitutionsType, *, on_stderr: SomeSubstitutionsType = "fail"
    ) -> None:
        self.command = normalize_to_list_of_substitutions(command)
        self.on_stderr = normalize_to_list_of_substitutions(on_stderr)

    def describe(self) -> str:
        """Return a description of it."""
        return f"Command({described(self.command)})"

    def perform(self, context: LaunchContext) -> str:
        """Return what it prints."""
        text, on_stderr = performed(context, self.command), performed(context, self.on_stderr)
        advice = f"Try the command in this terminal:  {text}"
        try:
            done = subprocess.run(
                shlex.split(text), stdout=subprocess.PIPE, text=True, check=False,
                stderr=subprocess.STDOUT if on_stderr == "capture" else subprocess.PIPE,
                env=dict(context.environment),
            )  # fmt: skip
        except OSError as error:
            raise SubstitutionFailure(f"file not found: {error}", advice=advice) from error
        errors = done.stderr or ""
        if done.returncode != 0:
            raise SubstitutionFailure(
                f"executed command failed. Command: {text}",
                f"It printed: {errors.strip()}" if errors else f"It ended with {done.returncode}.",
                advice,
            )
        if errors and on_stderr == "fail":
            raise SubstitutionFailure(
                f"executed command showed stderr output. Command: {text}",
                f"It printed: {errors.strip()}",
                f"{advice}. Or write Command(..., on_stderr='ignore').",
            )
        return done.stdout


class FileContent(Substitution):
    """Stand for the text of a file."""

    def __init__(self, path: SomeSubstitutionsType) -> None:
        self.path = normalize_to_list_of_substitutions(path)

    def describe(self) -> str:
        """Return a description of it."""
        return f"FileContent({described(self.path)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        path = performed(context, self.path)
        try:
            return Path(path).read_text(encoding="utf-8")
        except OSError as error:
            raise SubstitutionFailure(
                f"File not found: {path}",
                f"The launch file wants the text of this file: {error.strerror}.",
                "Compare the path; a package has its files in its share folder only after "
                "`data_files` in setup.py names them, and the next `colcon build`.",
            ) from error


class AnonName(Substitution):
    """Stand for a name that nothing else has, the same one for the same `name`."""

    def __init__(self, name: SomeSubstitutionsType) -> None:
        self.name = normalize_to_list_of_substitutions(name)

    def describe(self) -> str:
        """Return a description of it."""
        return f"AnonName({described(self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the name."""
        name = performed(context, self.name)
        key = f"anon{name}"
        if key not in context.launch_configurations:
            context.launch_configurations[key] = f"{name}_{os.getpid()}_{uuid.uuid4().hex[:12]}"
        return str(context.launch_configurations[key])


class ThisLaunchFile(Substitution):
    """Stand for the path of the launch file in which it stands."""

    _local = "current_launch_file_path"

    def describe(self) -> str:
        """Return a description of it."""
        return f"{type(self).__name__}()"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        known = context.get_locals_as_dict()
        if self._local not in known:
            raise SubstitutionFailure(
                f"{type(self).__name__} used outside of a launch file (in a script)",
                "Only a launch file that `ros2 launch` or an include has read has a path.",
                "Use the variable __file__ of your script.",
            )
        return str(known[self._local])


class ThisLaunchFileDir(ThisLaunchFile):
    """Stand for the folder of the launch file in which it stands."""

    _local = "current_launch_file_directory"


class LaunchLogDir(Substitution):
    """Stand for the folder of this launch's log files."""

    def describe(self) -> str:
        """Return a description of it."""
        return "LaunchLogDir()"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        return context.host.log_folder()


# True and false.


def _word(value: bool) -> str:
    return "true" if value else "false"


class NotSubstitution(Substitution):
    """Stand for true if a value is false."""

    def __init__(self, value: SomeSubstitutionsType) -> None:
        self.value = normalize_to_list_of_substitutions(value)

    def describe(self) -> str:
        """Return a description of it."""
        return f"NotSubstitution({described(self.value)})"

    def perform(self, context: LaunchContext) -> str:
        """Return true or false."""
        return _word(not performed_flag(context, self.value))


class AllSubstitution(Substitution):
    """Stand for true if all values are."""

    def __init__(self, *args: SomeSubstitutionsType) -> None:
        self.args = [normalize_to_list_of_substitutions(value) for value in args]

    def describe(self) -> str:
        """Return a description of it."""
        return f"{type(self).__name__}({' '.join(described(value) for value in self.args)})"

    def perform(self, context: LaunchContext) -> str:
        """Return true or false."""
        return _word(all(performed_flag(context, value) for value in self.args))


class AnySubstitution(AllSubstitution):
    """Stand for true if one of the values is."""

    def perform(self, context: LaunchContext) -> str:
        """Return true or false."""
        return _word(any(performed_flag(context, value) for value in self.args))


class AndSubstitution(AllSubstitution):
    """Stand for true if both values are."""

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__(left, right)


class OrSubstitution(AnySubstitution):
    """Stand for true if one of two values is."""

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__(left, right)


class EqualsSubstitution(Substitution):
    """Stand for true if two values are equal, as texts, numbers or truths."""

    def __init__(self, left: object, right: object) -> None:
        self.left, self.right = _comparable(left), _comparable(right)

    def describe(self) -> str:
        """Return a description of it."""
        return f"{type(self).__name__}({described(self.left)} {described(self.right)})"

    def perform(self, context: LaunchContext) -> str:
        """Return true or false."""
        return _word(self._are_equal(context))

    def _are_equal(self, context: LaunchContext) -> bool:
        left, right = performed(context, self.left), performed(context, self.right)
        truths = {"true": True, "1": True, "false": False, "0": False}
        if left.lower() in truths and right.lower() in truths:
            return truths[left.lower()] == truths[right.lower()]
        try:
            return math.isclose(float(left), float(right))
        except ValueError:
            return left == right


class NotEqualsSubstitution(EqualsSubstitution):
    """Stand for true if two values differ."""

    def perform(self, context: LaunchContext) -> str:
        """Return true or false."""
        return _word(not self._are_equal(context))


def _comparable(value: Untyped) -> list[Substitution]:
    if is_substitution(value):
        return normalize_to_list_of_substitutions(value)
    if isinstance(value, bool):
        return [TextSubstitution(text=_word(value))]
    return [TextSubstitution(text="" if value is None else str(value))]


class IfElseSubstitution(Substitution):
    """Stand for one text or another."""

    def __init__(
        self, condition: SomeSubstitutionsType, if_value: SomeSubstitutionsType = "",
        else_value: SomeSubstitutionsType = "",
    ) -> None:  # fmt: skip
        if if_value == else_value == "":
            raise RuntimeError("One of if_value and else_value must be specified")
        self.condition = normalize_to_list_of_substitutions(condition)
        self.if_value = normalize_to_list_of_substitutions(if_value)
        self.else_value = normalize_to_list_of_substitutions(else_value)

    def describe(self) -> str:
        """Return a description of it."""
        parts = (self.condition, self.if_value, self.else_value)
        return f"IfElseSubstitution({', '.join(map(described, parts))})"

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        is_true = performed_flag(context, self.condition)
        return performed(context, self.if_value if is_true else self.else_value)


alias_submodules(__name__, [*__all__, "BooleanSubstitution"])
