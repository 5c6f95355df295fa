"""Implement `ros2 launch`: find a launch file, and carry it out, show it or its arguments."""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2_command.errors import CommandError
from ros2_command.names import did_you_mean
from ros2_command.packages import SOURCE_FIRST, all_packages, package_prefix, prefixes
from ros2_command.registry import Argument, Verb, argument, flag, one_of

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription

#: How the names of launch files end.
ENDINGS = ("launch.py", "launch.xml", "launch.yaml", "launch.yml", ".launch")
_SET = ":="


def _main(args: Namespace) -> int:
    path, words = _chosen(args)
    if args.launch_prefix is None and args.launch_prefix_filter is not None:
        raise CommandError(
            "--launch-prefix must be specified if --launch-prefix-filter is provided",
            "The filter says which programs get the prefix, and there is none.",
            "Add --launch-prefix with the command that should go before the programs.",
        )
    arguments = _arguments(words)
    if args.show_all_subprocesses_output:
        os.environ["OVERRIDE_LAUNCH_PROCESS_OUTPUT"] = "both"
    _check_launch()
    if args.print or args.show_args:
        _show(path, only_arguments=args.show_args)
        return 0
    for name in ("launch_prefix", "launch_prefix_filter"):
        if getattr(args, name):
            arguments[name.replace("_", "-")] = getattr(args, name)
    return _launch(path, arguments, args)


def _check_launch() -> None:
    """Refuse to run with a `launch` of another installation, whose inside is another."""
    import launch

    if not hasattr(launch, "LaunchError"):
        raise CommandError(
            f"Python finds another `launch` first, in {os.path.dirname(str(launch.__file__))}",
            "PYTHONPATH, or another installed package, puts it in front of the one meant.",
            "With a full ROS 2, use the `ros2` of that; else take the folder out of PYTHONPATH.",
        )


def _chosen(args: Namespace) -> tuple[str, list[str]]:
    """Return the launch file, and the arguments for it."""
    words = list(args.launch_arguments)
    if os.path.isfile(args.package_name):
        if args.launch_file_name is not None:
            words.insert(0, args.launch_file_name)
        return args.package_name, words
    return str(find_launch_file(args.package_name, args.launch_file_name)), words


def find_launch_file(package: str, name: str | None) -> Path:
    """Return the one file of this name in the share folder of a package.

    Raises:
        CommandError: If there is none or more than one.
    """
    packages = all_packages()
    if package not in packages:
        raise CommandError(*_no_package(package, list(packages)))
    share = packages[package] / "share" / package
    files = sorted(path for path in share.rglob("*") if path.is_file())
    found = [path for path in files if path.name == name]
    if len(found) > 1:
        listed = ", ".join(f"'{path}'" for path in found)
        raise CommandError(
            f"file '{name}' was found more than once in the share directory of package "
            f"'{package}': [{listed}]",
            "`ros2 launch` cannot know which of them is meant.",
            f"Type the path of one of them:  ros2 launch {found[0]}",
        )
    if found:
        return found[0]
    names = [path.name for path in files if path.name.endswith(ENDINGS)]
    if names:
        listed = f"Package '{package}' has: {', '.join(names)}"
    else:
        listed = f"Package '{package}' has installed no launch files."
    advice = (
        "A launch file is installed by `data_files` in setup.py, for example "
        f"('share/{package}/launch', ['launch/{name or 'system.launch.py'}']), and `colcon build`."
    )
    if name is None:
        raise CommandError(
            f"No launch file of package '{package}' was named",
            f"{listed}",
            f"Type:  ros2 launch {package} {names[0]}" if names else f"{advice}",
        )
    raise CommandError(
        f"file '{name}' was not found in the share directory of package '{package}' which is at "
        f"'{share}'",
        f"{listed}",
        f"{did_you_mean(name, names, advice)}",
    )


def _no_package(name: str, packages: list[str]) -> list[str]:
    folders = [str(path) for path in prefixes()]
    first = f"Package '{name}' not found: \"package '{name}' not found, searching: {folders}\""
    if name.endswith(ENDINGS) or os.sep in name:
        return [
            first,
            f"'{name}' looks like the path of a launch file, and there is no such file here.",
            "Compare the path with the output of `ls`.",
        ]
    return [
        first,
        "Neither a package nor a file has this name.",
        f"{did_you_mean(name, packages, SOURCE_FIRST)}",
    ]


def _arguments(words: list[str]) -> dict[str, str]:
    """Return the arguments that are given as `name:=value`; of two of one name the last."""
    values = {}
    for word in words:
        name, sign, value = word.partition(_SET)
        if not sign or not name or not (value or word.count(_SET) > 1):
            raise CommandError(
                f"malformed launch argument '{word}', expected format '<name>:=<value>'",
                "What stands behind the launch file gives its arguments their values.",
                f"{_correction(word)}",
            )
        values[name] = value
    return values


def _correction(word: str) -> str:
    name, sign, value = word.partition("=")
    if sign and name and value and not name.endswith(":"):
        return f"Type a colon before the equals sign:  {name}:={value}"
    return "Type for example  speed:=2  ; `--show-args` lists the arguments."


def _description(path: str) -> LaunchDescription:
    from launch import LaunchError
    from launch.launch_description_sources import get_launch_description_from_any_launch_file
    from launch.launch_service import explained

    try:
        return get_launch_description_from_any_launch_file(path)
    except LaunchError as error:
        raise CommandError(str(error), *explained(error)) from None


def _show(path: str, only_arguments: bool) -> None:
    from launch import LaunchIntrospector

    description = _description(path)
    if not only_arguments:
        print(LaunchIntrospector().format_launch_description(description))
        return
    print("Arguments (pass arguments as '<name>:=<value>'):")
    arguments = description.get_launch_arguments()
    for given in arguments:
        print(f"\n    '{given.name}':{'*' if given.conditionally_included else ''}")
        print(f"        {given.description}")
        if given.default_value is not None:
            shown = " + ".join(part.describe() for part in given.default_value)
            print(f"        (default: {shown})")
    if any(given.conditionally_included for given in arguments):
        print("\n* argument(s) which are only used if specific conditions occur")
    if not arguments:
        print("\n  No arguments.")


def _launch(path: str, arguments: dict[str, str], args: Namespace) -> int:
    from launch import LaunchDescription, LaunchService
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    service = LaunchService(
        argv=[f"{name}:={value}" for name, value in arguments.items()],
        noninteractive=args.noninteractive,
        debug=args.debug,
    )
    include = IncludeLaunchDescription(
        AnyLaunchDescriptionSource(path), launch_arguments=arguments.items()
    )
    service.include_launch_description(LaunchDescription([include]))
    return service.run()


def words_after(package: str, file: str | None) -> list[str]:
    """Return what may stand behind a package, or behind a launch file: `name:=` of its arguments.

    Args:
        package: The package, or the path of a launch file.
        file: The launch file, if it is typed already.
    """
    if os.path.isfile(package):
        path = package
    elif file is not None:
        path = str(find_launch_file(package, file))
    else:
        share = package_prefix(package) / "share" / package
        return [path.name for path in share.rglob("*") if path.name.endswith(ENDINGS)]
    return [f"{declared.name}{_SET}" for declared in _description(path).get_launch_arguments()]


def _interactive() -> bool:
    return sys.stdin is not None and sys.stdin.isatty()


def _options() -> list[Argument]:
    extra: dict[str, Any] = {"default": not _interactive()}
    return [
        argument("-n", "--noninteractive", action="store_true", help="Run the launch system "
                 "non-interactively, with no terminal associated", **extra),
        flag("-d", "--debug", help="Put the launch system in debug mode, provides more verbose "
             "output."),
        one_of(
            flag("-p", "--print", "--print-description", help="Print the launch description to the "
                 "console without launching it."),
            flag("-s", "--show-args", "--show-arguments", help="Show arguments that may be given "
                 "to the launch file."),
        ),
        flag("-a", "--show-all-subprocesses-output", help="Show all launched subprocesses' output "
             "by overriding their output configuration using the OVERRIDE_LAUNCH_PROCESS_OUTPUT "
             "envvar."),
        argument("--launch-prefix", help="Prefix command, which should go before all executables. "
                 "Command must be wrapped in quotes if it contains spaces (e.g. --launch-prefix "
                 "'xterm -e gdb -ex run --args')."),
        argument("--launch-prefix-filter", help="Regex pattern for filtering which executables the "
                 "--launch-prefix is applied to by matching the executable name."),
        argument("package_name", help="Name of the ROS package which contains the launch file"),
        argument("launch_file_name", nargs="?", help="Name of the launch file"),
        argument("launch_arguments", nargs="*", help="Arguments to the launch file; "
                 "'<name>:=<value>' (for duplicates, last one wins)"),
    ]  # fmt: skip


VERBS = {"": Verb("", _main, *_options())}
