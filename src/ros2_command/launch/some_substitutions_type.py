"""Name what may be given where a text is wanted, in the place where the original has it."""

from launch.substitution import SomeSubstitutionsType, SomeSubstitutionsType_types_tuple

__all__ = ["SomeSubstitutionsType", "SomeSubstitutionsType_types_tuple"]
