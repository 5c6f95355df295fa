"""Start ROS nodes: `launch_ros.actions`."""

from __future__ import annotations

import logging
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml
from launch.action import Action
from launch.errors import LaunchError, SubstitutionFailure, alias_submodules, left_out
from launch.launch_context import LaunchContext
from launch.processes import ExecuteProcess
from launch.substitution import (
    SomeSubstitutionsType,
    Substitution,
    TextSubstitution,
    normalize_to_list_of_substitutions,
    performed,
)
from launch.substitutions import LocalSubstitution
from ros2_command.untyped import Untyped

from launch_ros.descriptions import (
    Parameter,
    ParameterFile,
    parameter_values,
)
from launch_ros.substitutions import ExecutableInPackage
from launch_ros.utilities import make_namespace_absolute, prefix_namespace

__all__ = [
    "Node", "PushROSNamespace", "PushRosNamespace", "SetParameter", "SetParametersFromFile",
    "SetROSLogDir", "SetRemap",
]  # fmt: skip

__getattr__ = left_out(
    __name__, "ComposableNodeContainer", "LifecycleNode", "LifecycleTransition",
    "LoadComposableNodes", "ROSTimer", "RosTimer", "SetUseSimTime",
)  # fmt: skip

_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_NAMESPACE = re.compile(r"/|(/[A-Za-z_]\w*)+", re.ASCII)
# Launch configurations by which actions give something to all nodes that follow.
_NAMESPACE_KEY, _PARAMETERS_KEY, _REMAPPINGS_KEY = "ros_namespace", "global_params", "ros_remaps"


class Node(ExecuteProcess):
    """Start a ROS node.

    Args:
        executable: The name of its program, as `ros2 run` takes it; without a package a path.
        package: The package that has it.
        name: A name in the place of the node's own.
        namespace: Its namespace.
        exec_name: What the log calls it.
        parameters: Dictionaries of parameters, and paths of YAML files with some.
        remappings: Pairs of names: the one in the code, and the one to use.
        ros_arguments: Words behind `--ros-args`.
        arguments: Words in front of it.
        **process: What `ExecuteProcess` takes, such as `output`, `respawn` and `on_exit`.
    """

    UNSPECIFIED_NODE_NAME = "<node_name_unspecified>"
    UNSPECIFIED_NODE_NAMESPACE = "<node_namespace_unspecified>"

    def __init__(
        self, *, executable: SomeSubstitutionsType, package: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None, namespace: SomeSubstitutionsType | None = None,
        exec_name: SomeSubstitutionsType | None = None,
        parameters: Sequence[Any] | None = None,
        remappings: Iterable[tuple[SomeSubstitutionsType, SomeSubstitutionsType]] | None = None,
        ros_arguments: Iterable[SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None, **process: Untyped,
    ) -> None:  # fmt: skip
        program = (
            executable if package is None
            else ExecutableInPackage(package=package, executable=executable)
        )  # fmt: skip
        words: list[SomeSubstitutionsType] = [program, *_words("arguments", arguments)]
        if ros_arguments is not None:
            words += ["--ros-args", *_words("ros_arguments", ros_arguments)]
        words.append("--ros-args")
        if name is not None:
            words += ["-r", LocalSubstitution("ros_specific_arguments['name']",
                                              description="node name")]  # fmt: skip
        super().__init__(cmd=words, name=exec_name, **process)
        self.node_package, self.node_executable = package, executable
        self.is_node = True
        self._given_name, self._given_namespace = name, namespace
        if parameters is not None and not isinstance(parameters, list | tuple):
            raise TypeError(
                "Node expected 'parameters' to be a list of dictionaries and file names, but got "
                f"'{type(parameters)}'"
            )
        self._parameters = list(parameters or ())
        self._remappings = [_pair(rule) for rule in remappings or ()]
        self.node_name = self.UNSPECIFIED_NODE_NAME
        self.expanded_node_namespace = self.UNSPECIFIED_NODE_NAMESPACE
        self.expanded_remapping_rules: list[tuple[str, str]] = []

    def execute(self, context: LaunchContext) -> None:
        """Start the node when the events that wait have been handled."""
        name, namespace = self._name(context), self._namespace(context)
        known = self.UNSPECIFIED_NODE_NAME if name is None else name
        self.node_name = prefix_namespace(
            self.UNSPECIFIED_NODE_NAMESPACE if namespace is None else namespace, known
        ) or known  # fmt: skip
        is_known = name is not None and namespace is not None
        words: list[Any] = [] if namespace is None else ["-r", f"__ns:={namespace}"]
        words += self._parameter_words(context, self.node_name if is_known else "/**")
        rules = [*context.launch_configurations.get(_REMAPPINGS_KEY, ())]
        rules += [(performed(context, a), performed(context, b)) for a, b in self._remappings]
        self.expanded_remapping_rules = rules
        words += [word for before, after in rules for word in ("-r", f"{before}:={after}")]
        self.process_description.cmd += [[TextSubstitution(text=word)] for word in words]
        context.extend_locals({"ros_specific_arguments": {"name": f"__node:={name}"}})
        super().execute(context)
        if is_known:
            self._warn_of_twins(context)

    def _name(self, context: LaunchContext) -> str | None:
        if self._given_name is None:
            return None
        name = performed(context, self._given_name)
        if not _NAME.fullmatch(name):
            self._log_invalid(context)
            raise LaunchError(
                f"Invalid node name: '{name}'",
                "A node's name has letters, digits and underscores, and begins with no digit.",
                f"Write it as {_as_name(name)}; a namespace has an argument of its own.",
            )
        return name

    def _namespace(self, context: LaunchContext) -> str | None:
        own = self._given_namespace
        base = context.launch_configurations.get(_NAMESPACE_KEY)
        given = None if own is None else performed(context, own)
        namespace = make_namespace_absolute(prefix_namespace(base, given))
        if namespace is not None and not _NAMESPACE.fullmatch(namespace):
            self._log_invalid(context)
            raise LaunchError(
                f"Invalid namespace: '{namespace}'",
                "Each part of a namespace has letters, digits and underscores, and begins with no "
                "digit.",
                "Write it as house/kitchen.",
            )
        self.expanded_node_namespace = namespace or self.UNSPECIFIED_NODE_NAMESPACE
        return namespace

    def _log_invalid(self, context: LaunchContext) -> None:
        what = (
            f"package={self.node_package}, executable={self.node_executable}, "
            f"name={self._given_name}, namespace={self._given_namespace}"
        )
        context.host.log(
            logging.ERROR, "launch_ros.actions.node",
            f"Error while expanding or validating node name or namespace for '{what}':",
        )  # fmt: skip

    def _parameter_words(self, context: LaunchContext, section: str) -> list[str]:
        words: list[str] = []
        for given in context.launch_configurations.get(_PARAMETERS_KEY, ()):
            if isinstance(given, tuple):
                words += ["-p", f"{given[0]}:={given[1]}"]
            else:
                words += self._file_words(context, Path(given).absolute())
        for given in self._parameters:
            if isinstance(given, Mapping):
                values = dict(parameter_values(context, given))
                text = yaml.dump({section: {"ros__parameters": values}}, default_flow_style=False)
                words += ["--params-file", str(context.write_file(text))]
            elif isinstance(given, Parameter):
                words += ["-p", given.rule(context)]
            else:
                file = given if isinstance(given, ParameterFile) else ParameterFile(given)
                words += self._file_words(context, file.evaluate(context))
        return words

    def _file_words(self, context: LaunchContext, path: Path) -> list[str]:
        if not path.is_file():
            context.host.log(
                logging.WARNING, "launch_ros.actions.node",
                f"Parameter file path is not a file: {path}",
            )  # fmt: skip
            context.host.note(
                "The node starts without these parameters, with the values in its code.",
                "Compare the path; a package has its files in its share folder only after "
                "`data_files` in setup.py names them, and the next `colcon build`.",
            )
            return []
        context.host.note(*_doubts(path))
        return ["--params-file", str(path)]

    def _warn_of_twins(self, context: LaunchContext) -> None:
        names: dict[str, int] = context.get_locals_as_dict().get("unique_ros_node_names", {})
        names[self.node_name] = names.get(self.node_name, 0) + 1
        context.extend_globals({"unique_ros_node_names": names})
        if names[self.node_name] > 1:
            context.host.log(
                logging.WARNING, (self.process_details or {})["name"],
                f"there are now at least {names[self.node_name]} nodes with the name "
                f"{self.node_name} created within this launch context",
            )  # fmt: skip


def _words(name: str, given: Iterable[SomeSubstitutionsType] | None) -> list[SomeSubstitutionsType]:
    if isinstance(given, str | Substitution):
        raise TypeError(f"Node expected '{name}' to be a list, but got '{type(given)}'")
    return list(given or ())


def _pair(rule: Untyped) -> tuple[SomeSubstitutionsType, SomeSubstitutionsType]:
    if not isinstance(rule, tuple) or len(rule) != 2:
        raise TypeError(f"each of 'remappings' must be a pair, ('from', 'to'), but got {rule!r}")
    return rule


def _as_name(text: str) -> str:
    letters = re.sub(r"\W+", "_", text, flags=re.ASCII).strip("_")
    return letters if _NAME.fullmatch(letters) else f"node_{letters}"


def _doubts(path: Path) -> list[str]:
    """Return what to say of a file that is there and may give a node no parameters."""
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        mark = getattr(error, "problem_mark", None)
        where = f", line {mark.line + 1}" if mark else ""
        return [
            f"The parameter file '{path}'{where} is no YAML, so the node cannot start with it.",
            "Compare the indentation, and the space behind each colon.",
        ]
    if "ros__parameters" in _keys(content):
        return []
    return [
        f"The parameter file '{path}' has no `ros__parameters`, so the node cannot start with it.",
        "Write the node's name, below it `ros__parameters:`, and below that the parameters.",
    ]


def _keys(content: object) -> set[object]:
    if not isinstance(content, Mapping):
        return set()
    return set(content).union(*(_keys(value) for value in content.values()))


class PushROSNamespace(Action):
    """Put a namespace before those of the nodes that follow, in this group."""

    def __init__(self, namespace: SomeSubstitutionsType, **action: Untyped) -> None:
        super().__init__(**action)
        self.namespace = normalize_to_list_of_substitutions(namespace)

    def execute(self, context: LaunchContext) -> None:
        """Put it there."""
        before = context.launch_configurations.get(_NAMESPACE_KEY)
        given = performed(context, self.namespace)
        namespace = make_namespace_absolute(prefix_namespace(before, given)) or "/"
        if not _NAMESPACE.fullmatch(namespace):
            raise SubstitutionFailure(
                f"The resulting namespace is invalid: [previous_namespace='{before}', "
                f"pushed_namespace='{given}']",
                "Each part of a namespace has letters, digits and underscores, and begins with no "
                "digit.",
                "Write it as house/kitchen.",
            )
        context.launch_configurations[_NAMESPACE_KEY] = namespace


PushRosNamespace = PushROSNamespace


class SetParameter(Action):
    """Give all nodes that follow a parameter, in this group."""

    def __init__(self, name: SomeSubstitutionsType, value: Untyped, **action: Untyped) -> None:
        super().__init__(**action)
        self.name, self.value = normalize_to_list_of_substitutions(name), value

    def execute(self, context: LaunchContext) -> None:
        """Give it to them."""
        rules = parameter_values(context, {tuple(self.name): self.value})
        _add(context, _PARAMETERS_KEY, list(rules))


class SetParametersFromFile(Action):
    """Give all nodes that follow the parameters of a file, in this group."""

    def __init__(self, filename: SomeSubstitutionsType, **action: Untyped) -> None:
        super().__init__(**action)
        self.filename = normalize_to_list_of_substitutions(filename)

    def execute(self, context: LaunchContext) -> None:
        """Give them the file."""
        _add(context, _PARAMETERS_KEY, [performed(context, self.filename)])


class SetRemap(Action):
    """Give all nodes that follow a remapping, in this group."""

    def __init__(
        self, src: SomeSubstitutionsType, dst: SomeSubstitutionsType, **action: Untyped
    ) -> None:
        super().__init__(**action)
        self.src = normalize_to_list_of_substitutions(src)
        self.dst = normalize_to_list_of_substitutions(dst)

    def execute(self, context: LaunchContext) -> None:
        """Give it to them."""
        pair = performed(context, self.src), performed(context, self.dst)
        _add(context, _REMAPPINGS_KEY, [pair])


class SetROSLogDir(Action):
    """Let the nodes that follow keep their log files in a folder."""

    def __init__(self, new_log_dir: SomeSubstitutionsType, **action: Untyped) -> None:
        super().__init__(**action)
        self.log_dir = normalize_to_list_of_substitutions(new_log_dir)

    def execute(self, context: LaunchContext) -> None:
        """Set the variable that they read."""
        folder = os.path.abspath(performed(context, self.log_dir))
        context.environment["ROS_LOG_DIR"] = folder


def _add(context: LaunchContext, key: str, values: list[Any]) -> None:
    context.launch_configurations[key] = [*context.launch_configurations.get(key, ()), *values]


alias_submodules(__name__, __all__)
