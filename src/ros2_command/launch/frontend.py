"""Read launch files in XML and YAML: one form of entity for both, and what each tag makes."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import yaml
from ros2_command.names import did_you_mean
from ros2_command.untyped import Untyped

from launch import actions, substitutions
from launch.action import LaunchDescriptionEntity
from launch.conditions import IfCondition, UnlessCondition
from launch.errors import InvalidLaunchFileError, refuse
from launch.launch_description import LaunchDescription
from launch.substitution import Substitution, TextSubstitution, from_text

_Parts = list[Substitution]


class FrontendError(InvalidLaunchFileError):
    """Say what is wrong in a launch file in XML or YAML."""

    def __init__(self, what: str, meaning: str, advice: str) -> None:
        super().__init__(f"{_KIND[0]}{what}", meaning, advice)


# Set while a file is read; the first line of an error says of which format it is.
_KIND = [""]


@dataclass
class Entity:
    """Be a tag of XML, or a key of YAML with what it holds.

    Attributes:
        tag: Its name.
        attributes: Its attributes; in XML all of them are texts.
        children: The entities in it.
        is_yaml: Whether its attributes have types.
    """

    tag: str
    attributes: dict[str, Any]
    children: list[Entity]
    is_yaml: bool
    _read: set[str] = field(default_factory=set)

    def get(self, name: str, *, required: bool = False) -> Untyped:
        """Return an attribute; None if it has none of this name.

        Raises:
            FrontendError: If it is required.
        """
        self._read.add(name)
        if name in self.attributes:
            separator = f"{name}-sep"
            if separator in self.attributes:
                self._read.add(separator)
                return self.attributes[name].split(self.attributes[separator])
            return self.attributes[name]
        if required:
            raise FrontendError(
                f"AttributeError: Attribute '{name}' of type '<class 'str'>' not found in Entity "
                f"'{self.tag}'",
                f"`{self.tag}` needs the attribute `{name}`.",
                did_you_mean(name, self.attributes) or f"Add it, as in {self._example(name)}",
            )
        return None

    def _example(self, name: str) -> str:
        return f"{name}: ..." if self.is_yaml else f'<{self.tag} {name}="...">'

    def text(self, name: str, *, required: bool = False) -> str | None:
        """Return an attribute as a text."""
        value = self.get(name, required=required)
        if value is None or isinstance(value, str):
            return value
        if isinstance(value, bool | int | float):
            raise FrontendError(
                f"TypeError: Attribute '{name}' of Entity '{self.tag}' expected to be of type "
                f"'{str}', got '{type(value)}'",
                "YAML reads this value as another kind than a text.",
                f'Write it in quotes:  {name}: "{value}"',
            )
        raise self._wrong(name, value, "a text")

    def parts(self, name: str, *, required: bool = False) -> _Parts | None:
        """Return an attribute with its substitutions."""
        text = self.text(name, required=required)
        return None if text is None else parse_substitution(text)

    def value(self, name: str, kind: Untyped) -> Untyped:
        """Return an attribute as a bool or a number, or the substitutions that stand for one."""
        value = self.get(name)
        if isinstance(value, str):
            parts = parse_substitution(value)
            if not all(isinstance(part, TextSubstitution) for part in parts):
                return parts
            try:
                return from_text(value, kind)
            except ValueError:
                raise self._wrong(name, value, kind.__name__) from None
        if value is None or isinstance(value, kind) or (kind is float and type(value) is int):
            return value
        raise self._wrong(name, value, kind.__name__)

    def _wrong(self, name: str, value: object, kind: str) -> FrontendError:
        return FrontendError(
            f"TypeError: Attribute '{name}' of Entity '{self.tag}' expected to be of type "
            f"'{kind}'. '{value}' can not be converted to one of those types",
            f"`{name}` of `{self.tag}` cannot be {value!r}.",
            f"Give it a value of the type {kind}.",
        )

    def inner(self, tag: str) -> list[Entity]:
        """Return the entities in it of one tag."""
        self._read.add(f"<{tag}>")
        return [child for child in self.children if child.tag == tag]

    def actions(self, *without: str) -> list[LaunchDescriptionEntity]:
        """Return what the entities in it make."""
        self._read.update(f"<{child.tag}>" for child in self.children)
        return [make_action(child) for child in self.children if child.tag not in without]

    def check(self) -> None:
        """Refuse what nothing has asked for, such as a misspelled attribute.

        Raises:
            FrontendError: If there is something.
        """
        left = [name for name in self.attributes if name not in self._read]
        left_tags = [child.tag for child in self.children if f"<{child.tag}>" not in self._read]
        known = [name for name in self._read if not name.startswith("<")]
        if not left and not left_tags:
            return
        if self.is_yaml:
            names = {*left, *left_tags}
            what = f"Unexpected key(s) found in `{self.tag}`: {names}"
        elif left_tags:
            what = f"Unexpected nested tag(s) found in `{self.tag}`: {set(left_tags)}"
        else:
            what = f"Unexpected attribute(s) found in `{self.tag}`: {set(left)}"
        tags = [name[1:-1] for name in self._read if name.startswith("<")]
        wrong, choices = (left[0], known) if left else (left_tags[0], tags)
        raise FrontendError(
            f"ValueError: {what}",
            f"`{self.tag}` has no `{wrong}`.",
            did_you_mean(wrong, choices, f"It has: {', '.join(sorted([*known, *tags]))}"),
        )


def read(path: str, kind: str) -> LaunchDescription:
    """Read a launch file in XML or YAML.

    Args:
        path: The file.
        kind: The end of its name, without the dot. A file `x.launch` may be either.

    Raises:
        InvalidLaunchFileError: If it cannot be read.
    """
    text = Path(path).read_text(encoding="utf-8")
    is_yaml = kind in ("yaml", "yml") or (kind != "xml" and not text.lstrip().startswith("<"))
    before = _KIND[0]
    _KIND[0] = f"Caught exception when trying to load file of format [{kind}]:\n - "
    try:
        root = (_from_yaml if is_yaml else _from_xml)(text)
        if root.tag != "launch":
            raise FrontendError(
                "RuntimeError: Expected 'launch' as root tag",
                f"The file begins with `{root.tag}`.",
                "Put all of it into `launch:`." if is_yaml else "Put all of it into <launch>.",
            )
        # Other attributes mean nothing: many files have a `version`.
        return LaunchDescription(root.actions(), deprecated_reason=root.text("deprecated"))
    finally:
        _KIND[0] = before


def _from_xml(text: str) -> Entity:
    try:
        return _from_element(ElementTree.fromstring(text))
    except ElementTree.ParseError as error:
        line, column = error.position
        lines = text.splitlines()
        shown = lines[line - 1].strip() if line <= len(lines) else ""
        raise FrontendError(
            f"ParseError: {error}",
            f"This is no XML from line {line}, column {column}, on: {shown}",
            'Compare the tags: each <tag> ends with </tag>, or is <tag attribute="value"/>.',
        ) from None


def _from_element(element: ElementTree.Element) -> Entity:
    children = [_from_element(child) for child in element if isinstance(child.tag, str)]
    return Entity(element.tag, dict(element.attrib), children, is_yaml=False)


def _from_yaml(text: str) -> Entity:
    try:
        tree = yaml.safe_load(text)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f" {mark.line + 1}" if mark else ""
        raise FrontendError(
            f"{type(error).__name__}: {error}",
            f"This is no YAML at line{line}.",
            "Compare the indentation: what belongs together begins in one column.",
        ) from None
    if not isinstance(tree, dict) or len(tree) != 1:
        raise FrontendError(
            "RuntimeError: Expected only one root",
            "A launch file in YAML holds one key, `launch`, with a list of actions below it.",
            "Begin it with `launch:`, and each action with `- `.",
        )
    ((tag, value),) = tree.items()
    return _from_value(str(tag), value)


def _from_value(tag: str, value: Untyped) -> Entity:
    """Return the entity of a key: a mapping of attributes, or a list of entities."""
    attributes: dict[str, Any] = {}
    children: list[Entity] = []
    if isinstance(value, list):
        children = list(_entities_in(tag, value))
    elif isinstance(value, Mapping):
        for name, item in value.items():
            if name == "children" and isinstance(item, list):
                children += _entities_in(tag, item)
            elif isinstance(item, list) and item and all(isinstance(one, Mapping) for one in item):
                children += [_from_value(str(name), one) for one in item]
            else:
                attributes[str(name)] = item
    elif value is not None:
        raise FrontendError(
            f"TypeError: Expected a dict or list, got {type(value)}",
            f"`{tag}` holds `{value}`, where its attributes should be.",
            f"Write them below it:  {tag}:  and in the next line, further right,  name: value",
        )
    return Entity(tag, attributes, children, is_yaml=True)


def _entities_in(tag: str, items: list[Any]) -> Iterator[Entity]:
    for item in items:
        if not isinstance(item, Mapping) or len(item) != 1:
            raise FrontendError(
                "RuntimeError: Subentities must be a dictionary with only one key, which is the "
                "entity type",
                f"In the list of `{tag}`, this is no action: {item}",
                "Begin each action with its name, and put its attributes further right below it.",
            )
        ((name, value),) = item.items()
        yield _from_value(str(name), value)


# Substitutions in texts: `$(name argument 'another argument')`.


def parse_substitution(text: str) -> _Parts:
    """Return the substitutions in a text of XML or YAML, and the texts between them.

    Raises:
        FrontendError: If the text cannot be read so.
    """
    parts, end = _Reader(text).template("")
    assert end == len(text)
    return parts


class _Reader:
    def __init__(self, text: str) -> None:
        self._text = text

    def template(self, stop: str, at: int = 0) -> tuple[_Parts, int]:
        """Read up to a quote or the end; return the parts, and where they end."""
        parts: _Parts = []
        letters: list[str] = []

        def flush() -> None:
            if letters:
                parts.append(TextSubstitution(text="".join(letters)))
                letters.clear()

        text = self._text
        while at < len(text) and (not stop or text[at] not in stop):
            if text.startswith("$(", at):
                flush()
                part, at = self._call(at)
                parts.append(part)
            elif text[at] == "\\" and at + 1 < len(text):
                letters.append(text[at + 1])
                at += 2
            else:
                letters.append(text[at])
                at += 1
        flush()
        return parts or [TextSubstitution(text="")], at

    def _call(self, start: int) -> tuple[Substitution, int]:
        text, at = self._text, start + 2
        while at < len(text) and (text[at].isalnum() or text[at] in "_-"):
            at += 1
        name, arguments = text[start + 2 : at], list[_Parts]()
        while at < len(text) and text[at] == " ":
            at += 1
            if at < len(text) and text[at] in "'\"":
                quote = text[at]
                argument, at = self.template(quote, at + 1)
                at += 1
            else:
                argument, at = self.template(" )'\"", at)
            arguments.append(argument)
        if at >= len(text) or text[at] != ")" or not name:
            raise FrontendError(
                f"UnexpectedCharacters: '{text}' cannot be read from column {start + 1} on",
                f"A substitution begins there and does not end well: {text[start:]}",
                "Write $(name argument), with an argument that has spaces in quotes.",
            )
        return _substitution(name, arguments), at + 1


_MAKERS: dict[str, tuple[int, int, Callable[..., Substitution]]] = {
    "all": (1, 99, substitutions.AllSubstitution),
    "and": (2, 2, substitutions.AndSubstitution),
    "anon": (1, 1, substitutions.AnonName),
    "any": (1, 99, substitutions.AnySubstitution),
    "command": (1, 2, lambda a, b="fail": substitutions.Command(a, on_stderr=b)),
    "dirname": (0, 0, substitutions.ThisLaunchFileDir),
    "env": (1, 2, lambda a, b=None: substitutions.EnvironmentVariable(a, default_value=b)),
    "equals": (2, 2, substitutions.EqualsSubstitution),
    "eval": (1, 2, lambda a, b="math": substitutions.PythonExpression(a, _modules(b))),
    "file-content": (1, 1, substitutions.FileContent),
    "filename": (0, 0, substitutions.ThisLaunchFile),
    "find-exec": (1, 1, lambda a: substitutions.FindExecutable(name=a)),
    "if": (2, 3, substitutions.IfElseSubstitution),
    "launch_log_dir": (0, 0, substitutions.LaunchLogDir),
    "log_dir": (0, 0, substitutions.LaunchLogDir),
    "not": (1, 1, substitutions.NotSubstitution),
    "not-equals": (2, 2, substitutions.NotEqualsSubstitution),
    "or": (2, 2, substitutions.OrSubstitution),
    "var": (1, 2, lambda a, b=None: substitutions.LaunchConfiguration(a, default=b)),
}
_LEFT_OUT_TAGS = {
    **{"node_container": "ComposableNodeContainer", "load_composable_node": "LoadComposableNodes"},
    **{"ros_timer": "RosTimer", "set_use_sim_time": "SetUseSimTime", "composable_node": "Node"},
    "lifecycle_node": "LifecycleNode",
}


def _modules(given: Untyped) -> list[str]:
    text = given if isinstance(given, str) else "".join(part.text for part in given)
    return [name.strip() for name in text.split(",") if name.strip()]


def _substitution(name: str, arguments: list[_Parts]) -> Substitution:
    _load_ros()
    if name == "param":
        refuse("`$(param)`", "Use `$(var NAME)`, and set NAME with `<let>` or `<arg>`.")
    if name not in _MAKERS:
        raise FrontendError(
            f"Unknown substitution: {name}",
            f"`$({name} ...)` is no substitution.",
            did_you_mean(name, _MAKERS, f"There are: {', '.join(_MAKERS)}"),
        )
    least, most, make = _MAKERS[name]
    if not least <= len(arguments) <= most:
        wanted = str(least) if least == most else f"{least} or {most}"
        raise FrontendError(
            f"TypeError: {name} substitution expects {wanted} arguments",
            f"`$({name} ...)` got {len(arguments)}.",
            "Separate arguments by one space, and put one with spaces in quotes.",
        )
    return make(*arguments)


# Tags.

Maker = Callable[[Entity, dict[str, Any]], LaunchDescriptionEntity]
_TAGS: dict[str, Maker] = {}


def tag(*names: str) -> Callable[[Maker], Maker]:
    """Let a function make the actions of a tag; it gets the entity and its condition."""

    def register(make: Maker) -> Maker:
        _TAGS.update(dict.fromkeys(names, make))
        return make

    return register


def substitution(name: str, arguments: int, make: Callable[..., Substitution]) -> None:
    """Let a function make the substitutions of a name, from so many arguments."""
    _MAKERS[name] = (arguments, arguments, make)


def _load_ros() -> None:
    import launch_ros  # noqa: F401 - which registers its tags and substitutions


def make_action(entity: Entity) -> LaunchDescriptionEntity:
    """Return the action of an entity.

    Raises:
        FrontendError: If it is none, or has something wrong.
    """
    _load_ros()
    if entity.tag in _LEFT_OUT_TAGS:
        import launch_ros.actions

        getattr(launch_ros.actions, _LEFT_OUT_TAGS[entity.tag])
        refuse(f"`{entity.tag}`", "Start each node as a process, with `node`.")
    if entity.tag not in _TAGS:
        raise FrontendError(
            f"RuntimeError: Unrecognized entity of the type: {entity.tag}",
            f"`{entity.tag}` is no action.",
            did_you_mean(entity.tag, _TAGS, f"There are: {', '.join(sorted(_TAGS))}"),
        )
    condition, otherwise = entity.parts("if"), entity.parts("unless")
    if condition is not None and otherwise is not None:
        raise FrontendError(
            "RuntimeError: if and unless conditions can't be used simultaneously",
            f"`{entity.tag}` has both.",
            "Keep one of them; `if` takes an expression such as $(eval ...) for both.",
        )
    given: dict[str, Any] = {}
    if condition is not None:
        given["condition"] = IfCondition(condition)
    if otherwise is not None:
        given["condition"] = UnlessCondition(otherwise)
    action = _TAGS[entity.tag](entity, given)
    entity.check()
    return action


def pairs(entities: list[Entity], name: str = "name", value: str = "value") -> dict[Any, Any]:
    """Return two attributes of each entity, as names and values."""
    found = {}
    for entity in entities:
        key = tuple(entity.parts(name, required=True) or ())
        found[key] = entity.parts(value, required=True)
        entity.check()
    return found


def split_words(text: str) -> list[_Parts]:
    """Return the words of a command line, each with its substitutions."""
    words: list[_Parts] = []
    is_open = False  # whether the next part belongs to the last word
    for part in parse_substitution(text):
        if not isinstance(part, TextSubstitution):
            if is_open:
                words[-1].append(part)
            else:
                words.append([part])
            is_open = True
            continue
        tokens = shlex.split(part.text)
        for place, token in enumerate(tokens):
            if place == 0 and is_open and not part.text[0].isspace():
                words[-1].append(TextSubstitution(text=token))
            else:
                words.append([TextSubstitution(text=token)])
        is_open = bool(part.text) and not part.text[-1].isspace() and (is_open or bool(tokens))
    return words


@tag("arg")
def _arg(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    choices = [child.text("value", required=True) or "" for child in entity.inner("choice")]
    return actions.DeclareLaunchArgument(
        entity.text("name", required=True) or "", default_value=entity.parts("default"),
        description=entity.text("description"), choices=choices or None, **given,
    )  # fmt: skip


@tag("let")
def _let(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    return actions.SetLaunchConfiguration(
        entity.parts("name", required=True) or "", entity.parts("value", required=True) or "",
        **given,
    )  # fmt: skip


@tag("log")
def _log(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    return actions.LogInfo(msg=entity.parts("message", required=True) or "", **given)


@tag("set_env", "append_env")
def _set_env(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    name = entity.parts("name", required=True) or ""
    value = entity.parts("value", required=True) or ""
    if entity.tag == "set_env":
        return actions.SetEnvironmentVariable(name, value, **given)
    separator = entity.parts("separator")
    return actions.AppendEnvironmentVariable(
        name, value, prepend=entity.value("prepend", bool) or False,
        **({} if separator is None else {"separator": separator}), **given,
    )  # fmt: skip


@tag("unset_env")
def _unset_env(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    return actions.UnsetEnvironmentVariable(entity.parts("name", required=True) or "", **given)


@tag("reset_env")
def _reset_env(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    del entity
    return actions.ResetEnvironment(**given)


@tag("reset")
def _reset(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    return actions.ResetLaunchConfigurations(pairs(entity.inner("keep")), **given)


@tag("include")
def _include(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    arguments = pairs([*entity.inner("arg"), *entity.inner("let")])
    return actions.IncludeLaunchDescription(
        entity.parts("file", required=True) or "", launch_arguments=arguments.items(), **given
    )


@tag("group")
def _group(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    for name in ("scoped", "forwarding"):
        value = entity.value(name, bool)
        if value is not None:
            given[name] = value
    kept = pairs(entity.inner("keep"))
    return actions.GroupAction(entity.actions("keep"), launch_configurations=kept or None, **given)


@tag("timer")
def _timer(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    entity.get("period", required=True)
    cancel = entity.value("cancel_on_shutdown", bool)
    return actions.TimerAction(
        period=entity.value("period", float), actions=entity.actions(),
        cancel_on_shutdown=True if cancel is None else cancel, **given,
    )  # fmt: skip


@tag("shutdown")
def _shutdown(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    reason = entity.text("reason")
    return actions.Shutdown(**({} if reason is None else {"reason": reason}), **given)


@tag("executable")
def _executable(entity: Entity, given: dict[str, Any]) -> LaunchDescriptionEntity:
    words = split_words(entity.text("cmd", required=True) or "")
    name = entity.parts("name")
    return actions.ExecuteProcess(cmd=words, name=name, **process_options(entity), **given)


def process_options(entity: Entity) -> dict[str, Any]:
    """Return what an entity says of the process that it starts."""
    options: dict[str, Any] = {
        "cwd": entity.parts("cwd"), "prefix": entity.parts("launch-prefix"),
        "output": entity.parts("output"), "respawn": entity.value("respawn", bool),
        "respawn_delay": entity.value("respawn_delay", float),
        "respawn_max_retries": entity.value("respawn_max_retries", int),
        "shell": entity.value("shell", bool), "emulate_tty": entity.value("emulate_tty", bool),
        "additional_env": pairs(entity.inner("env")) or None,
    }  # fmt: skip
    for name in ("sigterm_timeout", "sigkill_timeout"):
        seconds = entity.value(name, float)
        options[name] = str(seconds) if isinstance(seconds, int | float) else seconds
    on_exit = entity.text("on_exit")
    if on_exit is not None and on_exit != "shutdown":
        raise FrontendError(
            "ValueError: Attribute on_exit of Entity node expected to be shutdown but got "
            f"`{on_exit}`",
            "In XML and YAML, the end of a process can only end the launch.",
            'Write on_exit="shutdown", or use a launch file in Python.',
        )
    if on_exit:
        options["on_exit"] = [actions.Shutdown()]
    return {name: value for name, value in options.items() if value is not None}
