"""Define the launch description: what a launch file returns."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from typing import TYPE_CHECKING

from launch.action import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
    from launch.launch_context import LaunchContext


class LaunchDescription(LaunchDescriptionEntity):
    """Hold the actions of a launch.

    Args:
        initial_entities: The actions.
        deprecated_reason: Why nobody should use it any more.
    """

    def __init__(
        self, initial_entities: Iterable[LaunchDescriptionEntity] | None = None, *,
        deprecated_reason: str | None = None,
    ) -> None:  # fmt: skip
        self.entities = list(initial_entities or ())
        for entity in self.entities:
            if not isinstance(entity, LaunchDescriptionEntity):
                raise TypeError(f"LaunchDescription expected actions, but got {entity!r}")
        self.deprecated_reason = deprecated_reason

    @property
    def deprecated(self) -> bool:
        """Return whether nobody should use it any more."""
        return self.deprecated_reason is not None

    def add_entity(self, entity: LaunchDescriptionEntity) -> None:
        """Add a part."""
        self.entities.append(entity)

    add_action = add_entity

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the parts."""
        if self.deprecated_reason is not None:
            path = context.get_locals_as_dict().get("current_launch_file_path")
            what = (
                f"launch file [{path}] is deprecated" if path else "deprecated launch description"
            )
            context.host.log(logging.WARNING, "root", f"{what}: {self.deprecated_reason}")
        return self.entities

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the parts."""
        return self.entities

    def get_launch_arguments(
        self, conditional_inclusion: bool = False
    ) -> list[DeclareLaunchArgument]:
        """Return the arguments that it declares, as far as that is known before the launch."""
        return [argument for argument, _ in self.arguments_with_includes(conditional_inclusion)]

    def arguments_with_includes(
        self, conditional_inclusion: bool = False
    ) -> list[tuple[DeclareLaunchArgument, list[IncludeLaunchDescription]]]:
        """Return the arguments that it declares, each with the includes that lead there."""
        found: dict[str, tuple[DeclareLaunchArgument, list[IncludeLaunchDescription]]] = {}
        _collect(self.entities, conditional_inclusion, [], found)
        return list(found.values())


def _collect(
    entities: Iterable[LaunchDescriptionEntity], conditional: bool,
    includes: list[IncludeLaunchDescription],
    found: dict[str, tuple[DeclareLaunchArgument, list[IncludeLaunchDescription]]],
) -> None:  # fmt: skip
    from launch.actions import (
        DeclareLaunchArgument,
        IncludeLaunchDescription,
        ResetLaunchConfigurations,
    )

    for entity in entities:
        if isinstance(entity, ResetLaunchConfigurations):
            return  # no argument of the launch gets behind this
        if isinstance(entity, DeclareLaunchArgument):
            entity.conditionally_included = conditional or entity.condition is not None
            found.setdefault(entity.name, (entity, includes))
        inner = includes
        if isinstance(entity, IncludeLaunchDescription):
            source = entity.launch_description_source
            if any(include.launch_description_source.is_same(source) for include in includes):
                continue  # files that include each other
            inner = [*includes, entity]
        _collect(entity.describe_sub_entities(), conditional, inner, found)
        for _, actions in entity.describe_conditional_sub_entities():
            _collect(actions, True, inner, found)
