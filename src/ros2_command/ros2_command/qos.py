"""Define the QoS options, and choose QoS settings that match the known publishers."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from typing import Any

from ros2_command.untyped import Untyped

PROFILES = (
    *("unknown", "default", "system_default", "sensor_data", "services_default", "parameters"),
    *("parameter_events", "action_status_default", "best_available"),
)
_CHOICES = {
    "history": ["system_default", "keep_last", "keep_all", "unknown"],
    "reliability": ["system_default", "reliable", "best_effort", "unknown", "best_available"],
    "durability": ["system_default", "transient_local", "volatile", "unknown", "best_available"],
    "liveliness": [
        *("system_default", "automatic", "manual_by_topic", "unknown", "best_available"),
    ],
}
#: What the options can ask for one by one.
_POLICIES = (*_CHOICES, "depth", "liveliness_lease_duration_seconds")


def add_qos_arguments(parser: ArgumentParser, entity: str, profile: str) -> None:
    """Add the options.

    Args:
        parser: The verb's parser.
        entity: What the settings are for, for the help.
        profile: The profile that is used by default.
    """
    parser.add_argument(
        "--qos-profile", choices=PROFILES, default=profile,
        help=f"Quality of service preset profile to {entity} with (default: {profile})",
    )  # fmt: skip
    parser.add_argument("--qos-depth", metavar="N", type=int,
                        help=f"Queue size setting to {entity} with")  # fmt: skip
    for name, choices in _CHOICES.items():
        parser.add_argument(
            f"--qos-{name}", choices=choices,
            help=f"Quality of service {name} setting to {entity} with",
        )  # fmt: skip
    parser.add_argument(
        "--qos-liveliness-lease-duration-seconds", type=float,
        help=f"Quality of service liveliness lease duration setting to {entity} with",
    )  # fmt: skip


def asked_profile(args: Namespace) -> Untyped:
    """Return the profile that the options name, as rclpy has it."""
    from rclpy import qos
    from rclpy.duration import Duration

    policies: dict[str, Any] = {
        "history": qos.HistoryPolicy,
        "reliability": qos.ReliabilityPolicy,
        "durability": qos.DurabilityPolicy,
        "liveliness": qos.LivelinessPolicy,
    }
    profile = qos.QoSPresetProfiles.get_from_short_key(args.qos_profile)
    fresh = qos.QoSProfile(
        **{name.lstrip("_"): getattr(profile, name) for name in profile.__slots__}
    )
    for name, policy in policies.items():
        if text := getattr(args, f"qos_{name}"):
            setattr(fresh, name, policy.get_from_short_key(text))
    latched = fresh.durability == qos.DurabilityPolicy.TRANSIENT_LOCAL
    if (args.qos_depth or 0) > 0:
        fresh.depth = args.qos_depth
    elif latched and not fresh.depth:
        fresh.depth = 1
    if (args.qos_liveliness_lease_duration_seconds or 0) > 0:
        nanoseconds = int(args.qos_liveliness_lease_duration_seconds * 1e9)
        fresh.liveliness_lease_duration = Duration(nanoseconds=nanoseconds)
    return fresh


def chosen_profile(args: Namespace, publishers: Sequence[Any]) -> Untyped:
    """Return the profile with which a subscription hears all known publishers.

    It follows them only if no single policy was asked for; then what was not asked for is the
    preset's, also where that hears nobody. A preset alone decides on the other policies.
    """
    from rclpy.qos import QoSDurabilityPolicy, QoSReliabilityPolicy

    profile = asked_profile(args)
    preferences: dict[str, Any] = {
        "reliability": (QoSReliabilityPolicy.RELIABLE, QoSReliabilityPolicy.BEST_EFFORT),
        "durability": (QoSDurabilityPolicy.TRANSIENT_LOCAL, QoSDurabilityPolicy.VOLATILE),
    }
    if not publishers or any(getattr(args, f"qos_{name}") is not None for name in _POLICIES):
        return profile
    for name, (strong, weak) in preferences.items():
        offered = [getattr(one.qos_profile, name) == strong for one in publishers]
        if any(offered) and not all(offered):
            kind = f"QoS{name.capitalize()}Policy"
            print(
                f"Some, but not all, publishers are offering {kind}.{strong.name}. "
                f"Falling back to {kind}.{weak.name} as it will connect to all publishers"
            )
        setattr(profile, name, strong if all(offered) else weak)
    return profile
