"""`course lab`: JupyterLab in the learner's folder, with its messages in a file; and for images."""

from __future__ import annotations

import fcntl
import json
import os
import signal
import socket
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, BinaryIO, NoReturn

from course_tool import commands, folder, prepare, running
from course_tool.hub import bring_fonts
from course_tool.layout import Layout
from course_tool.problems import Problem, last_lines, say

_TERMINALS = "--ServerApp.terminado_settings"
_FOLDERS = ("--ServerApp.root_dir", "--ServerApp.notebook_dir", "--notebook-dir")
#: With these, JupyterLab answers, and opens nothing.
_ANSWERS = ("--help", "--version", "--show-config")
#: So the buttons of a check can ask JupyterLab to run its cells, and to save the page.
_EXPOSED = "--LabApp.expose_app_in_browser"
#: Where `custom.css` is: narrower launcher, wider file browser, solutions in another colour.
_STYLE = Path(__file__).parents[1] / "lab_style"
#: Seconds that JupyterLab gets to end its kernels and terminals.
_ENDING = 30.0


def lab(layout: Layout, options: Sequence[str]) -> int:
    """Run JupyterLab until somebody stops it, with a person's options passed through.

    A second one in the same folder would save over the pages that are open in the first, so it says
    where that is.

    Raises:
        Problem: If it does not start, or ends with an error.
    """
    environ = _ready(layout)
    if _is_elsewhere(layout, options) or any(one.startswith(_ANSWERS) for one in options):
        return _run(layout, options, environ)
    with only_one(layout) as lock:
        if lock is None:
            say(already_open(layout))
            return 0
        _address_file(layout).unlink(missing_ok=True)  # of one that was killed
        return _run(layout, options, environ, lock)


@contextmanager
def only_one(layout: Layout) -> Iterator[int | None]:
    """Hold the learner's folder for one JupyterLab; yield nothing while another one holds it.

    The lock is on a file of its own: whoever writes progress locks the hidden folder itself.
    JupyterLab inherits the lock, which ends with the last of the two processes, however they end.
    """
    lock = os.open(layout.notes / "lab.lock", os.O_RDONLY | os.O_CREAT, 0o600)
    try:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            yield None
            return
        except OSError:
            pass  # a file system without such locks (some network drives): go on without
        yield lock
    finally:
        os.close(lock)


def already_open(layout: Layout) -> str:
    """Return where the course is open, and how to stop it."""
    stop = (
        "To stop it, press Ctrl+C in the\n"
        "terminal where it was started, or choose File, Shut Down in JupyterLab."
    )
    try:
        place = _address_file(layout).read_text(encoding="utf-8")
    except OSError:  # it is only starting, or somebody else's
        return f"Another command has opened the course in {layout.learner}, or is about to. {stop}"
    again = "To see it again, open that address in a browser."
    return f"The course is open already, at  {place}\n{again} {stop}"


def _address_file(layout: Layout) -> Path:
    return layout.notes / "address"


def _private(path: Path) -> BinaryIO:
    """Open a file to write, which holds the token: whoever has that can run commands."""
    return os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600), "wb")


def _run(layout: Layout, options: Sequence[str], environ: dict[str, str], *inherited: int) -> int:
    """Run JupyterLab, which inherits some open files, until it ends or somebody stops it."""
    newer = [one.name[:2] for one in folder.shipped_pages(layout) if folder.is_newer(layout, one)]
    if newer:
        say(f"There is a new version of {', '.join(newer)}:  ./environment/course update  takes it")
    home = layout.learner / folder.HOME
    if home.exists():  # it opens with today's progress in it
        bring = [str(layout.python), "-m", "rosbeat", "progress", "--home", str(home)]
        running.quiet(bring, environ, timeout=20.0, cwd=layout.learner)
    runtime = environ.setdefault("JUPYTER_RUNTIME_DIR", str(layout.notes / "run"))
    command = lab_command(layout, options, root_user=os.geteuid() == 0)
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _interrupt)
    # Started in the background of a script, it would hand an ignored Ctrl+C on to every terminal.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    log = layout.notes / "lab.log"
    shown = str(log.relative_to(layout.learner.parent))
    with _private(log) as messages:
        server = subprocess.Popen(
            command,
            env=environ,
            cwd=layout.learner,
            stdin=subprocess.DEVNULL,
            stdout=messages,
            stderr=subprocess.STDOUT,
            # Ctrl+C in the terminal reaches this process only, which then ends the server.
            start_new_session=True,
            pass_fds=inherited,
        )
    try:
        info = when_open(server, Path(runtime))
        if info:
            place = address(layout, info, options)
            if inherited:  # it is the one of the learner's folder
                with _private(_address_file(layout)) as file:
                    file.write(place.encode())
            say(f"The course is open at  {place}")
            say(f"Ctrl+C stops it. JupyterLab's messages go to {shown}")
        code = server.wait()
    except KeyboardInterrupt:
        with suppress(OSError):  # nobody reads it if the terminal was closed
            say("\nStopping JupyterLab and its kernels ...")
        end(server)
        with suppress(OSError):
            say("Stopped. Your pages are as you saved them.")
        return 0
    finally:
        if server.poll() is None:
            end(server)
        if inherited:
            _address_file(layout).unlink(missing_ok=True)
    if code == 0:
        say("JupyterLab was shut down." if info else log.read_text(errors="replace").rstrip())
        return 0
    raise Problem(
        "JupyterLab ended by itself." if info else "JupyterLab ended before it was open.",
        "The pages cannot be used any more; what you saved is there.",
        "If you gave it options, look whether they are right:  ./environment/course lab --help\n"
        "Otherwise start it again:  ./environment/course lab\n"
        f"If it ends again, ./environment/course doctor may tell why. All messages are in {shown}",
        last_lines(log.read_text(errors="replace")),
    )


def prepare_image(layout: Layout, arguments: Sequence[str]) -> int:
    """Make `.venv` and the learner's folder, and open nothing: for the images of containers."""
    _ready(layout)
    return 0


def serve(layout: Layout, arguments: Sequence[str]) -> NoReturn:
    """Become a program that opens JupyterLab, with the course's options behind its own.

    Binder and JupyterHub start every JupyterLab themselves, with options of their own.
    """
    if not arguments:
        raise Problem(
            "The command that opens JupyterLab is missing.",
            "Binder and JupyterHub use this: they give it the command.",
            "Open the course:  ./environment/course lab",
        )
    environ = _ready(layout)
    if layout.is_shared:
        bring_fonts(layout)
    os.chdir(layout.learner)
    command = [*arguments, *lab_options(layout, (), root_user=os.geteuid() == 0)]
    os.execvpe(command[0], command, environ)


def _ready(layout: Layout) -> dict[str, str]:
    """Make what a JupyterLab of the course needs; return its environment."""
    environ = commands.for_shells(prepare.ready(layout, "course"), layout)
    folder.make(layout)
    # A terminal that was opened before the folder was made may have another one in mind.
    environ.pop("ROS2_WORKSPACE", None)
    return environ


def lab_command(layout: Layout, options: Sequence[str], root_user: bool) -> list[str]:
    """Return the command that opens JupyterLab; `lab_options` says what the arguments are."""
    return [str(layout.python), "-m", "jupyterlab", *lab_options(layout, options, root_user)]


def lab_options(layout: Layout, options: Sequence[str], root_user: bool) -> list[str]:
    """Return the options with which JupyterLab is the course's.

    Args:
        layout: The checkout.
        options: What the person added; a page of their own takes the first page's place.
        root_user: Whether to allow what Jupyter refuses to the root user, as in a container.
    """
    command = []
    elsewhere = _is_elsewhere(layout, options)
    if not elsewhere:  # Jupyter refuses to hear two
        command.append(f"--ServerApp.root_dir={layout.learner}")
    if root_user and "--allow-root" not in options:
        command.append("--allow-root")
    if not any(option.startswith(_TERMINALS) for option in options):
        # The same as `course shell`: a person's start file may put another Python or ROS first.
        command.append(f"{_TERMINALS}={ {'shell_command': commands.interactive_shell()}!r}")
    # Open tabs are remembered by their paths, which in another folder would be those of no file.
    command += [f"--LabApp.workspaces_dir={layout.notes / 'workspaces'}"]
    if not any(option.startswith(_EXPOSED) for option in options):
        command.append(f"{_EXPOSED}=True")
    command += ["--LabApp.custom_css=True"]
    command += [f"--ServerApp.tornado_settings={ {'static_custom_path': [str(_STYLE)]}!r}"]
    if not elsewhere and not any(option.endswith(".ipynb") for option in options):
        page = first_page(layout)
        if page:
            # As an address, not as a file, so that the browser shows it beside the folder.
            command.append(f"--LabApp.default_url=/lab/tree/{page}")
        else:
            say("There is no page in the folder; JupyterLab opens on the folder.")
    return [*command, *options]


def _is_elsewhere(layout: Layout, options: Sequence[str]) -> bool:
    """Tell whether a person opens another folder than the learner's, where none of our pages is."""
    return any(one.startswith(_FOLDERS) or os.path.isdir(layout.learner / one) for one in options)


def first_page(layout: Layout) -> str:
    """Return the name of the page to open: the home page, or else the first one; or nothing."""
    if (layout.learner / folder.HOME).exists():
        return folder.HOME
    # What a class gets may begin later.
    return next((page.name for page in sorted(layout.learner.glob(folder.PAGES))), "")


def address(layout: Layout, info: Mapping[str, Any], options: Sequence[str]) -> str:
    """Return the address to open, with the token that lets a person in.

    Args:
        layout: The checkout.
        info: What the server says of itself.
        options: What the person added to the command.
    """
    page = "" if _is_elsewhere(layout, options) else first_page(layout)
    asked = next((option for option in options if option.endswith(".ipynb")), page)
    place = f"{info['url']}lab" + (f"/tree/{asked}" if asked else "")
    return f"{place}?token={info['token']}" if info.get("token") else place


def end(server: subprocess.Popen[bytes]) -> None:
    """End JupyterLab, which ends its kernels and terminals; a second Ctrl+C does not wait."""
    server.terminate()
    try:
        server.wait(_ENDING)
    except (KeyboardInterrupt, subprocess.TimeoutExpired):
        server.kill()  # its kernels notice, and end by themselves
        server.wait()


def when_open(server: subprocess.Popen[bytes], runtime: Path) -> dict[str, Any]:
    """Wait until the server listens; return what it says of itself, nothing if it ended."""
    file = runtime / f"jpserver-{server.pid}.json"
    while server.poll() is None:
        try:
            found: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
            # It says where it listens a little before it does.
            with socket.create_connection((found["hostname"], int(found["port"])), timeout=10):
                return found
        except (OSError, ValueError):
            time.sleep(0.05)
    return {}


def _interrupt(*_: object) -> None:
    raise KeyboardInterrupt
