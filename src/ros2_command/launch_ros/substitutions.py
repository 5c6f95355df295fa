"""Find packages and their programs: `launch_ros.substitutions`."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from launch.errors import SubstitutionFailure, alias_submodules, left_out
from launch.substitution import (
    SomeSubstitutionsType,
    Substitution,
    described,
    normalize_to_list_of_substitutions,
    performed,
)
from ros2_command.names import did_you_mean
from ros2_command.packages import SOURCE_FIRST, all_packages, prefixes

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["ExecutableInPackage", "FindPackage", "FindPackagePrefix", "FindPackageShare"]

__getattr__ = left_out(__name__, "Parameter")


class FindPackage(Substitution):
    """Stand for a folder of a package."""

    def __init__(self, package: SomeSubstitutionsType) -> None:
        self.package = normalize_to_list_of_substitutions(package)

    def describe(self) -> str:
        """Return a description of it."""
        return f"{type(self).__name__}(pkg={described(self.package)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        return self.find(performed(context, self.package))

    def find(self, package_name: str) -> str:
        """Return the folder of a package.

        Raises:
            SubstitutionFailure: If there is no such package.
        """
        packages = all_packages()
        if package_name not in packages:
            folders = [str(path) for path in prefixes()]
            raise SubstitutionFailure(
                f"\"package '{package_name}' not found, searching: {folders}\"",
                "The launch file names a package that this terminal does not know.",
                did_you_mean(package_name, packages, SOURCE_FIRST),
            )
        return self._folder(str(packages[package_name]), package_name)

    def _folder(self, prefix: str, package: str) -> str:
        raise NotImplementedError


class FindPackagePrefix(FindPackage):
    """Stand for the folder in which a package is installed."""

    def _folder(self, prefix: str, package: str) -> str:
        del package
        return prefix


class FindPackageShare(FindPackage):
    """Stand for the share folder of a package, which holds launch and parameter files."""

    def _folder(self, prefix: str, package: str) -> str:
        return os.path.join(prefix, "share", package)


class ExecutableInPackage(FindPackagePrefix):
    """Stand for the path of a program of a package."""

    def __init__(self, executable: SomeSubstitutionsType, package: SomeSubstitutionsType) -> None:
        super().__init__(package)
        self.executable = normalize_to_list_of_substitutions(executable)

    def describe(self) -> str:
        """Return a description of it."""
        return f"ExecInPkg(pkg={described(self.package)}, exec={described(self.executable)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        name, package = performed(context, self.executable), performed(context, self.package)
        prefix = super().perform(context)
        folder = os.path.join(prefix, "lib", package)
        names = sorted(os.listdir(folder)) if os.path.isdir(folder) else []
        path = os.path.join(folder, name)
        if os.path.isfile(path) and os.access(path, os.X_OK):
            return path
        if not names:
            raise SubstitutionFailure(
                f"package '{package}' found at '{prefix}', but libexec directory '{folder}' does "
                "not exist",
                f"Package '{package}' has no programs at all.",
                "A Python package needs an entry point in setup.py, install_scripts="
                f"$base/lib/{package} in setup.cfg, and `colcon build` after that.",
            )
        if os.path.isfile(path):
            advice = f"It is there, but it has no execute permission:  chmod +x {path}"
        else:
            advice = did_you_mean(
                name, names, "A new entry point in setup.py counts after the next `colcon build`."
            )
        raise SubstitutionFailure(
            f"executable '{name}' not found on the libexec directory '{folder}' ",
            f"Package '{package}' has: {', '.join(names)}",
            advice,
        )


alias_submodules(__name__, __all__)
