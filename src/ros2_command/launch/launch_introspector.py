"""Show a launch description as a tree."""

from __future__ import annotations

from collections.abc import Mapping

from launch.action import LaunchDescriptionEntity
from launch.actions import EmitEvent, ExecuteProcess, LogInfo, RegisterEventHandler
from launch.launch_description import LaunchDescription
from launch.substitution import SomeSubstitutionsType, described


class LaunchIntrospector:
    """Show a launch description without carrying it out."""

    def format_launch_description(self, launch_description: LaunchDescription) -> str:
        """Return a line for each action, below the description that holds it."""
        lines = [str(launch_description)]
        entities = launch_description.entities
        for place, entity in enumerate(entities):
            first, *rest = _action_lines(entity)
            is_last = place == len(entities) - 1
            lines.append(f"{'└' if is_last else '├'}── {first}")
            lines += [f"{' ' if is_last else '│'}   {line}" for line in rest]
        return "\n".join(lines)


def _action_lines(action: LaunchDescriptionEntity) -> list[str]:
    if isinstance(action, LogInfo):
        return [f"LogInfo({described(action.msg)})"]
    if isinstance(action, EmitEvent):
        return [f"EmitEvent(event='{action.event.name}')"]
    if isinstance(action, ExecuteProcess):
        about = action.process_description
        words = ", ".join(described(word) for word in about.cmd)
        folder = None if about.cwd is None else f"'{described(about.cwd)}'"
        return [
            f"ExecuteProcess(cmd=[{words}], cwd={folder}, env={_environment(about.env)}, "
            f"shell={action.shell})"
        ]
    if isinstance(action, RegisterEventHandler):
        text, actions = action.event_handler.describe()
        inner = [line for entity in actions for line in _action_lines(entity)]
        return [
            f"RegisterEventHandler('{action.event_handler}'):",
            f"{'├' if inner else '└'}── {text}",
            *(f"    ├── {line}" for line in inner[:-1]),
            *(f"    └── {line}" for line in inner[-1:]),
        ]
    return [f"Action('{action}')"]


def _environment(variables: Mapping[object, SomeSubstitutionsType] | None) -> str | None:
    if variables is None:
        return None
    pairs = (
        f"{described(name)}: {described(value)}"  # type: ignore[arg-type] # a text or substitutions
        for name, value in variables.items()
    )
    return "{" + ", ".join(pairs) + "}"
