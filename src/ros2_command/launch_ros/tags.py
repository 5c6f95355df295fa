"""Read the tags and substitutions of nodes in launch files in XML and YAML."""

from __future__ import annotations

import typing
from typing import Any

from launch.action import LaunchDescriptionEntity
from launch.frontend import (
    Entity,
    FrontendError,
    pairs,
    parse_substitution,
    process_options,
    split_words,
    substitution,
    tag,
)
from launch.substitution import TextSubstitution, from_text
from ros2_command.untyped import Untyped

from launch_ros import actions
from launch_ros.descriptions import ParameterFile, ParameterValue
from launch_ros.substitutions import (
    ExecutableInPackage,
    FindPackagePrefix,
    FindPackageShare,
)

substitution("find-pkg-share", 1, FindPackageShare)
substitution("find-pkg-prefix", 1, FindPackagePrefix)
substitution("exec-in-pkg", 2, ExecutableInPackage)

_KINDS: dict[str, Any] = {
    "int": int, "float": float, "bool": bool, "str": str, "list_of_int": typing.List[int],  # noqa: UP006
    "list_of_float": typing.List[float], "list_of_bool": typing.List[bool],  # noqa: UP006
    "list_of_str": typing.List[str],  # noqa: UP006
}  # fmt: skip


@tag("node")
def _node(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    for key, name in (("name", "name"), ("namespace", "namespace"), ("exec_name", "exec_name"),
                      ("package", "pkg")):  # fmt: skip
        given[key] = entity.parts(name)
    for key, name in (("arguments", "args"), ("ros_arguments", "ros_args")):
        text = entity.text(name)
        given[key] = None if text is None else split_words(text)
    remappings = pairs(entity.inner("remap"), "from", "to")
    return actions.Node(
        executable=entity.parts("exec", required=True) or "",
        remappings=list(remappings.items()),
        parameters=[_parameter(child) for child in entity.inner("param")],
        **given, **process_options(entity),
    )  # fmt: skip


@tag("push_ros_namespace", "push-ros-namespace")
def _push_namespace(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    return actions.PushROSNamespace(entity.parts("namespace", required=True) or "", **given)


@tag("set_parameter")
def _set_parameter(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    name, value = entity.parts("name", required=True), entity.parts("value", required=True)
    return actions.SetParameter(name or "", value, **given)


@tag("set_parameters_from_file")
def _set_parameters(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    return actions.SetParametersFromFile(entity.parts("filename", required=True) or "", **given)


@tag("set_remap")
def _set_remap(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    before, after = entity.parts("from", required=True), entity.parts("to", required=True)
    return actions.SetRemap(before or "", after or "", **given)


@tag("set_ros_log_dir")
def _set_log_folder(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    return actions.SetROSLogDir(entity.parts("new_log_dir", required=True) or "", **given)


def _parameter(entity: Entity) -> Untyped:
    file, name = entity.parts("from"), entity.text("name")
    if (file is None) == (name is None):
        raise FrontendError(
            "ValueError: param Entity should have name or from attribute",
            "`param` is one parameter with a `name`, or a file with `from`.",
            'Write <param name="..." value="..."/> or <param from="..."/>.',
        )
    if file is not None:
        allowed = entity.value("allow_substs", bool)
        entity.check()
        return ParameterFile(file, allow_substs=allowed or False)
    return _named(entity)


def _named(entity: Entity) -> dict[Any, Any]:
    name = tuple(entity.parts("name", required=True) or ())
    value, inner = entity.get("value"), entity.inner("param")
    word = entity.text("type")
    entity.check()
    if word is not None and word not in _KINDS:
        raise FrontendError(
            f"ValueError: Unrecognized data type: {word}",
            f"A parameter has no type `{word}`.",
            f"The types are: {', '.join(_KINDS)}",
        )
    if (value is None) == (not inner):
        raise FrontendError(
            "RuntimeError: either a value attribute or nested params are needed",
            "A `param` holds a `value`, or further `param`, and not both.",
            'Write <param name="..." value="..."/>.',
        )
    if inner:
        values: dict[Any, Any] = {}
        for child in inner:
            values.update(_named(child))
        return {name: values}
    kind = None if word is None else _KINDS[word]
    if isinstance(value, list):
        items = [_item(entity, item) for item in value]
        return {name: items}
    return {name: ParameterValue(_item(entity, value, kind), value_type=kind)}


def _item(entity: Entity, value: Untyped, kind: object = None) -> Untyped:
    """Return a value, or its substitutions; in XML a text stands for what YAML reads in it."""
    if not isinstance(value, str):
        return value
    parts = parse_substitution(value)
    if not all(isinstance(part, TextSubstitution) for part in parts):
        return parts
    text = "".join(part.text for part in parts if isinstance(part, TextSubstitution))
    return text if entity.is_yaml or kind is not None else from_text(text)
