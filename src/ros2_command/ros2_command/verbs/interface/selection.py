"""Which kinds of interfaces a verb of `ros2 interface` shows."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.definitions import KINDS

_OPTIONS = {"msg": ("-m", "msgs", "messages"), "srv": ("-s", "srvs", "services"),
            "action": ("-a", "actions", "actions")}  # fmt: skip


def add_kind_arguments(parser: ArgumentParser) -> None:
    """One option for each kind."""
    for kind, (short, word, title) in _OPTIONS.items():
        parser.add_argument(
            short, f"--only-{word}", action="append_const", dest="kinds", const=kind,
            help=f"Print out only {title}",
        )  # fmt: skip


def kinds(args: Namespace) -> list[str]:
    """The kinds asked for, all of them if none is."""
    return [kind for kind in KINDS if not args.kinds or kind in args.kinds]
