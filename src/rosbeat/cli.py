"""The `rosbeat` command: one subcommand, one registration in `COMMANDS`."""

from __future__ import annotations

import argparse
import difflib
import signal
import sys
import textwrap
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from itertools import groupby
from pathlib import Path
from typing import NoReturn

from rosbeat import __version__
from rosbeat.errors import CommandError, LessonError, RosbeatError, StoppedError

__all__ = ["COMMANDS", "Command", "main"]

FAILED = 1
MISUSED = 2
INTERRUPTED = 130


@dataclass(frozen=True)
class Command:
    """Describe a subcommand.

    Attributes:
        name: Name on the command line.
        help: One line for `rosbeat --help`.
        arguments: Function that declares the subcommand's arguments on its parser.
        run: Function that does the work and returns the exit code. It imports its dependencies when
            it is called, so that every other subcommand starts quickly.
        extra: The extra of the package that brings these dependencies.
        audience: Who needs the command; `rosbeat --help` shows what learners need first.
    """

    name: str
    help: str
    arguments: Callable[[argparse.ArgumentParser], None]
    run: Callable[[argparse.Namespace], int]
    extra: str = "course"
    audience: str = "learners"


def _new_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="a new name, as my_course")
    parser.add_argument(
        "--update",
        action="append",
        default=[],
        metavar="PAGE",
        help="take the new version of a page that you have worked in, with your answers in it",
    )


def _new(options: argparse.Namespace) -> int:
    from rosbeat import course_commands

    course_commands.lay_out(options.folder, options.update)
    print(course_commands.next_steps(options.folder))
    return 0


def _no_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare nothing: the command has no arguments."""


def _page_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("pages", nargs="*", metavar="PAGE", help="03, a name, a file; default: all")
    parser.add_argument("--root", type=Path, default=None, help="the checkout (default: found)")


def _build_arguments(parser: argparse.ArgumentParser) -> None:
    _page_arguments(parser)
    parser.add_argument("--check", action="store_true", help="compare only, write nothing")
    parser.add_argument("--no-run", action="store_true", help="leave the solution pages alone")
    parser.add_argument("--fresh", action="store_true", help="new outputs also where none compare")


def _build(options: argparse.Namespace) -> int:
    from rosbeat.authoring import build, source
    from rosbeat.exercises.registry import EXERCISES

    course = source.find_course((options.root or Path.cwd()).resolve())
    choices = (tuple(options.pages), options.check, not options.no_run, options.fresh)
    plan = build.Plan(*choices, {one.id: one.points for one in EXERCISES.values()})
    found = build.build(course, plan, lambda line: print(line, flush=True))
    changes = [change for change in found if change.matters]
    if not options.check or not changes:
        return 0
    names = ", ".join(f"{c.path.parent.name}/{c.path.name} ({c.kind})" for c in changes)
    raise LessonError(
        f"{len(changes)} pages are not what their sources say: {names}.",
        "\n".join(["Learners would open something else.", *(c.diff for c in changes if c.diff)]),
        "Run `rosbeat build`, look at the difference, and keep it.",
    )


def _lint(options: argparse.Namespace) -> int:
    from rosbeat.authoring import lint, source

    course = source.find_course((options.root or Path.cwd()).resolve())
    lessons = course.lessons()
    chosen = source.choose(lessons, options.pages)
    findings = lint.check_lessons(course, lessons, chosen)
    for finding in findings:
        print(finding)
    print(f"{len(chosen)} lessons, {len(findings)} findings")
    return FAILED if findings else 0


def _progress_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="the same as JSON, for programs")
    parser.add_argument(
        "--home",
        type=Path,
        metavar="PAGE",
        help="write it into the course's home page instead, if that is there",
    )


def _progress(options: argparse.Namespace) -> int:
    from rosbeat.exercises import progress

    if options.home:
        progress.refresh_home(options.home)
        return 0
    print(progress.as_json() if options.json else progress.as_text())
    return 0


def _certificate_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--name", default="", metavar="NAME", help="your name, as it is printed (default: asked)")
    add("--paper", choices=("a4", "letter"), default="a4", help="what it is printed on")


def _certificate(options: argparse.Namespace) -> int:
    from rosbeat.exercises import certificate

    print(certificate.certificate(options.name, options.paper))
    return 0


def _share_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("state", nargs="?", choices=("on", "off"), help="default: say what is shared")
    add("--name", default="", metavar="NAME", help="what the class may call you (default: no name)")
    add("--class", dest="folder", type=Path, metavar="FOLDER", help="the folder of the class")


def _explain_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("topic", metavar="TOPIC", help="its name, such as temperature")
    parser.add_argument("--domain-id", type=int, help="the ROS domain (default: this terminal's)")
    parser.add_argument("--seconds", type=float, default=3.0, help="listen no longer (default: 3)")


def _explain(options: argparse.Namespace) -> int:
    from rosbeat.explain_command import explain_domain
    from rosbeat.workspace.packages import stale_builds

    try:
        found = explain_domain(options.topic, options.domain_id, options.seconds, stale_builds)
    except KeyboardInterrupt:
        return INTERRUPTED  # whoever stops it knows that
    print(found)
    return 0 if found.is_well else FAILED


def _share(options: argparse.Namespace) -> int:
    from rosbeat.exercises import share

    if options.state == "on":
        print(share.turn_on(options.name, options.folder))
    elif options.name or options.folder:
        raise CommandError(
            "--name and --class go with `rosbeat share on`.",
            "Nothing was changed.",
            "Type  rosbeat share on  before them.",
        )
    else:
        print(share.turn_off() if options.state == "off" else share.state())
    return 0


_DUE = 'the deadline: "2026-11-30 18:00", or 2026-11-30 for the end of that day'
_ROSTER = "who is in the class: names or ids, one a line, or CSV of a learning platform"
_POINTS = "a CSV file with exercise,points"


def _release_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat release`."""
    add = parser.add_argument
    add("folder", type=Path, metavar="DIR", help="a new folder, or an earlier release")
    add("--lessons", nargs="+", default=(), metavar="PAGE", help="03, a name (default: all pages)")
    add("--points", type=Path, metavar="FILE", help=_POINTS)
    add("--github", action="store_true", help="add a workflow that checks the pages on each push")


def _collect_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat collect`."""
    add = parser.add_argument
    add("submissions", type=Path, metavar="SUBMISSIONS", help="a folder or a zip file")
    add("--due", metavar="WHEN", help=_DUE)
    add("--roster", type=Path, metavar="FILE", help=_ROSTER)
    add("--lessons", nargs="+", default=(), metavar="PAGE", help="03, a name (default: all pages)")
    add("--json", action="store_true", help="the same as JSON, for programs")


def _grade_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat grade`."""
    add = parser.add_argument
    add("submissions", type=Path, metavar="SUBMISSIONS", help="a folder, a zip file, or a page")
    out = "the folder for all results of a class; without, the result of one learner is printed"
    add("--out", type=Path, metavar="GRADES", help=out)
    add("--lessons", nargs="+", default=(), metavar="PAGE", help="pages that count (default: any)")
    add("--points", type=Path, metavar="FILE", help=_POINTS)
    add("--due", metavar="WHEN", help=_DUE)
    add("--late", metavar="RULE", help='what a late page loses: "10%%/day", or "20%%" (nothing)')
    add("--roster", type=Path, metavar="FILE", help=_ROSTER)
    only = "judge again only this learner or exercise, as 03a; may be given several times"
    add("--only", action="append", default=[], metavar="NAME", help=only)
    missing = "what who handed in nothing gets (zero)"
    add("--missing", choices=("zero", "empty"), default="zero", help=missing)
    add("--assignment", default="rosbeat", metavar="TITLE", help="its title on your platform")
    form = parser.add_mutually_exclusive_group()
    forms = ("text", "json", "gradescope", "prairielearn")
    what = "how the result is printed: for people, programs, or the platform of an autograder"
    form.add_argument("--format", choices=forms, default="text", help=what)
    said = "print the result as JSON, for programs"
    form.add_argument("--json", dest="format", action="store_const", const="json", help=said)
    many = "answers at a time (default: one per processor)"
    add("--workers", type=_from(1), metavar="N", help=many)
    add("--scheduler", metavar="ADDRESS", help="a Dask cluster that observes, instead of --workers")
    add("--review", action="store_true", help="then mark by eye, in a browser on this computer")
    add("--unsafe-no-sandbox", action="store_true", help="run strangers' code with limits only")


def _check_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat check`."""
    add = parser.add_argument
    add("pages", nargs="+", type=Path, metavar="PAGE", help="the file of a page, an .ipynb")
    add("--json", action="store_true", help="the same as JSON, for programs")


def _class_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat class`."""
    add = parser.add_argument
    folder = "where learners share (default: what ROSBEAT_CLASS names)"
    add("folder", nargs="?", type=Path, metavar="FOLDER", help=folder)
    add("--port", type=_from(0), default=0, metavar="N", help="on this computer (default: any)")
    add("--no-browser", action="store_true", help="print the address only")
    add("--forget", action="store_true", help="delete what learners have shared, and end")


def _from(least: int) -> Callable[[str], int]:
    """Return what reads a whole number and refuses one that is too small."""

    def whole_number(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            number = least - 1
        if number < least:
            raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from {least} on")
        return number

    return whole_number


def _grading(module: str, function: str) -> Callable[[argparse.Namespace], int]:
    """Return what runs a function of `grading`, whose module is imported only then."""
    return lambda options: int(
        getattr(import_module(f"rosbeat.grading.{module}"), function)(options)
    )


def _check(options: argparse.Namespace) -> int:
    from rosbeat import check_command

    return check_command.run(options.pages, options.json)


def _doctor(options: argparse.Namespace) -> int:
    from rosbeat import course_commands

    return course_commands.doctor()


_INSTRUCTORS, _AUTHORS = "instructors", "authors of pages"
COMMANDS: tuple[Command, ...] = (
    Command("progress", "show how far you are with the course", _progress_arguments, _progress),
    Command(
        *("certificate", "print what you have built, after the core"),
        *(_certificate_arguments, _certificate),
    ),
    Command("explain", "say why nothing arrives on a topic", _explain_arguments, _explain),
    Command("doctor", "say what works here, and how to fix what does not", _no_arguments, _doctor),
    Command("check", "run all checks of a page", _check_arguments, _check),
    Command("share", "let your class see where you are", _share_arguments, _share),
    Command("new", "make a folder with the course's pages", _new_arguments, _new),
    Command(
        *("release", "make what learners get: pages, no answers"),
        *(_release_arguments, _grading("commands", "run_release")),
        extra="class",
        audience=_INSTRUCTORS,
    ),
    Command(
        *("collect", "say who has handed in what"),
        *(_collect_arguments, _grading("commands", "run_collect")),
        extra="class",
        audience=_INSTRUCTORS,
    ),
    Command(
        *("grade", "judge what a class has handed in"),
        *(_grade_arguments, _grading("commands", "run_grade")),
        extra="class",
        audience=_INSTRUCTORS,
    ),
    Command(
        *("class", "show where a class is stuck, live"),
        *(_class_arguments, _grading("class_board", "run")),
        extra="class",
        audience=_INSTRUCTORS,
    ),
    Command(
        *("build", "make the pages from their sources", _build_arguments, _build),
        audience=_AUTHORS,
    ),
    Command(
        *("lint", "check the lesson sources against the rules", _page_arguments, _lint),
        audience=_AUTHORS,
    ),
)


class _Parser(argparse.ArgumentParser):
    """Reports misuse in three parts instead of argparse's one line."""

    def error(self, message: str) -> NoReturn:
        usage = " ".join(self.format_usage().removeprefix("usage: ").split())
        first, others = (f"\n{' ' * width}" for width in (17, 21))
        shown = textwrap.wrap(usage, 76, break_long_words=False, break_on_hyphens=False)
        raise CommandError(
            f"{message[:1].upper()}{message[1:]}.",
            "The command cannot know what you want, so nothing was done.",
            f"`{self.prog} --help` explains each word of it:{first}{others.join(shown)}",
        )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Args:
        arguments: What was typed after ``rosbeat``, by default `sys.argv`.

    Returns:
        0 if all is well, 1 if the work failed, 2 if the command line was misused, 130 if somebody
        stopped it (Ctrl-C or SIGTERM); `rosbeat grade` adds 3, see there.
    """
    typed = list(sys.argv[1:] if arguments is None else arguments)
    trace = "--traceback" in typed
    try:
        with _terminable():
            return _run([word for word in typed if word != "--traceback"])
    except CommandError as error:
        return _complain(error, MISUSED)
    except StoppedError as error:
        return _complain(error, INTERRUPTED)
    except RosbeatError as error:
        return _complain(error, FAILED)
    except KeyboardInterrupt:
        return _complain(_interrupted(), INTERRUPTED)
    except BrokenPipeError:
        # Whoever read our output (`| head`) has seen enough; keep Python from flushing into it.
        sys.stdout = None
        return 0
    except OSError as error:
        return _complain(_system_error(error), FAILED)
    except Exception as error:
        if trace:
            raise
        return _complain(_own_mistake(error), FAILED)


@contextmanager
def _terminable() -> Iterator[None]:
    """Treat SIGTERM as Ctrl-C, so that who stops a command by it reads what was kept."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _run(typed: list[str]) -> int:
    parser = _parser()
    _require_known(typed)
    options = parser.parse_args(typed)
    if options.command is None:
        parser.print_help()
        return 0
    try:
        return int(options.run(options))
    except ModuleNotFoundError as error:
        if not _is_foreign(error.name or ""):
            raise
        raise _not_installed(options.command, error.name or "") from error


def _parser() -> argparse.ArgumentParser:
    groups = [
        "\n".join([f"for {audience}:", *(f"  {one.name:<13}{one.help}" for one in commands)])
        for audience, commands in groupby(COMMANDS, lambda command: command.audience)
    ]
    parser = _Parser(
        prog="rosbeat",
        usage="rosbeat COMMAND ...",
        description="Learn how robots talk: tools of the course.",
        epilog="\n\n".join([*groups, "`rosbeat COMMAND --help` explains a command."]),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"rosbeat {__version__}")
    parser.add_argument("--traceback", action="store_true", help="show where a mistake happened")
    subparsers = parser.add_subparsers(prog="rosbeat", dest="command", help=argparse.SUPPRESS)
    for command in COMMANDS:
        child = subparsers.add_parser(command.name, description=command.help)
        command.arguments(child)
        child.set_defaults(run=command.run)
    return parser


def _require_known(typed: list[str]) -> None:
    names = [command.name for command in COMMANDS]
    if not typed or typed[0].startswith("-") or typed[0] in names:
        return
    nearest = difflib.get_close_matches(typed[0], names, n=1, cutoff=0.5)
    meant = f"Did you mean `rosbeat {nearest[0]}`? " if nearest else ""
    raise CommandError(
        f"rosbeat has no command {typed[0]!r}.",
        "Nothing else was looked at, and nothing was done.",
        f"{meant}The commands are: {', '.join(names)}.",
    )


def _is_foreign(module: str) -> bool:
    """Return whether a module is neither ours nor Python's."""
    top = module.partition(".")[0]
    return top not in ("", "rosbeat") and top not in sys.stdlib_module_names


def _not_installed(name: str, module: str) -> RosbeatError:
    """Return the error for a package that an extra of rosbeat would have brought."""
    (extra,) = (command.extra for command in COMMANDS if command.name == name)
    top = module.partition(".")[0]
    if top == "rclpy" or top.endswith(("_msgs", "_interfaces")):
        return RosbeatError(
            f"`rosbeat {name}` needs ROS 2, and this Python has no module {top!r}.",
            "Either no ROS 2 is installed for this Python, or it was not sourced.",
            f'Source your ROS 2, or install its wheels:  pip install "rosbeat[{extra},ros]"',
        )
    return RosbeatError(
        f"`rosbeat {name}` needs the package {top!r}, which is not installed.",
        "`pip install rosbeat` brings what tests of your own nodes need; the commands of the "
        f"course need its extra `{extra}`.",
        f'Install the extra:  pip install "rosbeat[{extra}]"',
    )


def _complain(error: RosbeatError, code: int) -> int:
    print(f"rosbeat: {error}", file=sys.stderr)
    return code


def _interrupted() -> RosbeatError:
    return StoppedError(
        "interrupted.",
        "You stopped the command before it was done. No file is left half written.",
        "Type the same command again when you want it done.",
    )


def _system_error(error: OSError) -> RosbeatError:
    name = f" ({error.filename})" if error.filename else ""
    return RosbeatError(
        f"{error.strerror or error}{name}.",
        "The operating system refused something that the command needs.",
        "Check that the file exists, that it may be written, and that the disk has room.",
    )


def _own_mistake(error: Exception) -> RosbeatError:
    return RosbeatError(
        f"{type(error).__name__}: {error}",
        "This is a mistake in rosbeat, not in what you typed.",
        "Run the command again with --traceback and report what it prints.",
    )
