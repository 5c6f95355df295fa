"""Offer the functions of `launch.utilities` that launch files call."""

from launch.substitution import (
    is_substitution,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

__all__ = ["is_substitution", "normalize_to_list_of_substitutions", "perform_substitutions"]
