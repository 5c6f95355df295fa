"""The commands of `./environment/course`."""

from __future__ import annotations

import errno
import os
import shlex
import traceback
from collections.abc import Callable, Sequence
from difflib import get_close_matches

from course_tool import additions, commands, folder, testing
from course_tool.doctor import doctor
from course_tool.hub import hub
from course_tool.lab import lab, prepare_image, serve
from course_tool.layout import Layout, of_this_checkout
from course_tool.problems import Problem, complain, say

HELP = """\
Usage:  ./environment/course COMMAND [OPTIONS]

  lab      open the course in JupyterLab; options go to it: --no-browser --port 8889 --ip ...
  reset    bring a page back as it was shipped (reset 03); what you saved is kept beside it
  update   take new versions of the pages that you have not worked in; for one that you have
           (update 03), take the new version with your answers in it
  shell    a bash in which ROS and the course's Python are active; -c "command" runs one command
  add      add what builds messages of your own: add messages (5 MB; 0.5 GB without a compiler)
  remove   take that out again: remove messages
  doctor   say what works here, with the cure for what does not
  test     check everything: lint, types, pages, tests; --thorough adds tests that take minutes;
           with other arguments, pytest alone runs with them; --ros kilted runs what concerns the
           engine on that distribution, in .venv-kilted
  bench    measure the course on this machine
  site     build the course as a site (dist/site); --open shows it in the browser
  hub      run JupyterHub for a class on this machine: docs/jupyterhub.md
  lock     for maintainers: remake the locked versions (lock --upgrade takes newer ones)

All but reset, update, doctor and help first make .venv, or refresh it when the course has changed.
ROSBEAT_PYTHON=/path/to/python3.12 chooses the Python. ROS_DOMAIN_ID=42 chooses the ROS domain.
"""


def main(arguments: Sequence[str]) -> int:
    """Run a command and return its exit code; whatever goes wrong is said in three parts."""
    layout = of_this_checkout()
    try:
        return _run(layout, arguments)
    except Problem as problem:
        complain(problem)
    except KeyboardInterrupt:
        say("\nStopped, as you asked. The same command goes on from here.")
        return 130
    except BrokenPipeError:  # `doctor | head`: nobody reads on
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # Python flushes its output once more
        return 1
    except OSError as error:
        complain(_from_system(layout, error))
    except Exception:  # the last net: never a bare traceback
        complain(_unforeseen(traceback.format_exc()))
    return 1


def _run(layout: Layout, arguments: Sequence[str]) -> int:
    name, *rest = arguments or ["help"]
    if name in ("help", "--help", "-h"):
        say(HELP)
        return 0
    if name not in _COMMANDS:
        raise _unknown(name)
    return _COMMANDS[name](layout, rest)


def _unknown(name: str) -> Problem:
    near = get_close_matches(name, [*_PUBLIC, "help"], n=1)
    cure = f"Did you mean:  ./environment/course {near[0]}" if near else _SEE_ALL
    return Problem(
        f"There is no command '{name}'.", f"The commands are {', '.join(_PUBLIC)} and help.", cure
    )


def _from_system(layout: Layout, error: OSError) -> Problem:
    if error.errno not in _OF_THE_MACHINE:
        return _unforeseen(str(error))
    owner = f'sudo chown -R "$USER" {shlex.quote(str(layout.root))}'
    return Problem(
        f"{error.filename or layout.root} cannot be read or written ({error.strerror}).",
        f"The course writes in {layout.venv}, and your pages are in {layout.learner}.",
        "Free some space if the disk is full. If another user made the files, make them yours:\n"
        f"{owner}\nThen run the same command again, or clone the course below your home.",
    )


def _unforeseen(details: str) -> Problem:
    return Problem(
        "This command met something it does not know.",
        "That is a fault of the course, not yours; your files are as they were.",
        "Run  ./environment/course doctor  for what it can tell.\n"
        "Please send its answer and the lines below to the course's issue tracker.",
        details,
    )


#: Errors that a person can do something about.
_OF_THE_MACHINE = (errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOSPC, errno.EDQUOT)
_SEE_ALL = "See all of them:  ./environment/course help"
_COMMANDS: dict[str, Callable[[Layout, Sequence[str]], int]] = {
    "lab": lab,
    "reset": folder.reset,
    "update": folder.update,
    "shell": commands.shell,
    "add": additions.add,
    "remove": additions.remove,
    "doctor": doctor,
    "test": testing.test,
    "bench": commands.bench,
    "site": commands.site,
    "hub": hub,
    "lock": commands.lock,
    "variables": commands.variables,
    "prepare": prepare_image,
    "serve": serve,
}
#: The last three are for shells and for images of containers.
_PUBLIC = tuple(_COMMANDS)[:-3]
