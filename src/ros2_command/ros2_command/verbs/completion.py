"""`ros2 completion`: what a shell needs to complete this command."""

from __future__ import annotations

from argparse import REMAINDER, ArgumentParser, Namespace
from importlib.resources import files

from ros2_command.candidates import candidates

_BASH = """_ros2_complete() {
    local IFS=$'\\n'
    COMPREPLY=($(ros2 completion words "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
}
complete -o default -F _ros2_complete ros2
"""


def add_arguments(parser: ArgumentParser) -> None:
    """What to print."""
    parser.description = (
        "Output what a shell needs to complete this command:\n"
        '  eval "$(ros2 completion bash)"    (zsh: after `autoload bashcompinit && bashcompinit`)\n'
        "  ros2 completion profile           (the file for FASTRTPS_DEFAULT_PROFILES_FILE)"
    )
    parser.add_argument("what", choices=["bash", "zsh", "words", "profile"])
    parser.add_argument("words", nargs=REMAINDER, help="The words typed so far (with 'words')")


def main(args: Namespace) -> None:
    """Print the script, the candidates for the last word, or the path of the profile."""
    if args.what == "words":
        print("\n".join(candidates(args.words)))
    elif args.what == "profile":
        print(files("ros2_command") / "data" / "fastdds.xml")
    else:
        print(_BASH, end="")
