import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
REAL = Path(sys.base_prefix) / "bin" / f"python{sys.version_info[0]}.{sys.version_info[1]}"

PYTHON = """\
case "$2" in
    -c) exec '{real}' -I -c '
import sys
sys.version_info = {version}
exec(sys.argv[1])
' "$3" ;;
    *) echo "{name} runs: $*" ;;
esac
"""


def script(path: Path, body: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(0o755)
    return path


class Machine:
    """A launcher in a folder of its own, and a PATH with only what is put there."""

    def __init__(self, folder: Path):
        self.root = folder / "a course"
        self.bin = folder / "bin"
        self.bin.mkdir(parents=True)
        (self.root / "environment").mkdir(parents=True)
        shutil.copy(ROOT / "environment" / "course", self.root / "environment")
        for tool in ("bash", "uname", "sed", "dirname", "readlink"):
            found = shutil.which(tool)
            assert found
            (self.bin / tool).symlink_to(found)

    def has(self, name: str, version: tuple[int, int], where: Path | None = None) -> Path:
        body = PYTHON.format(real=REAL, version=(*version, 0), name=name)
        return script((where or self.bin) / name, body)

    def is_a(self, system: str, machine: str) -> None:
        (self.bin / "uname").unlink()
        script(self.bin / "uname", f'[ "$1" = -s ] && echo {system} || echo {machine}')

    def course(self, *arguments: str, **environ: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [self.bin / "bash", self.root / "environment" / "course", *arguments],
            env={"PATH": str(self.bin), **environ},
            capture_output=True,
            text=True,
            check=False,
        )

    def refuses(self, **environ: str) -> str:
        done = self.course("lab", **environ)
        assert done.returncode == 1
        assert done.stdout == ""
        for label in ("What happened:", "What it means here:", "What to try:"):
            assert label in done.stderr
        return done.stderr


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    return Machine(tmp_path)


def test_hands_over_with_the_arguments_untouched(machine: Machine):
    machine.has("python3", (3, 11))
    done = machine.course("shell", "-c", "echo two words")
    tool = machine.root / "environment" / "course_tool"
    assert done.stdout == f"python3 runs: -I {tool} shell -c echo two words\n"
    assert done.returncode == 0


def test_a_link_to_the_command_works_and_standard_input_reaches_it(
    machine: Machine, tmp_path: Path
):
    script(machine.bin / "python3", '[ "$2" = -c ] && echo fits || exec sed s/^/heard:/')
    link = tmp_path / "link"
    link.symlink_to(machine.root / "environment" / "course")
    done = subprocess.run(
        [machine.bin / "bash", link, "shell"],
        env={"PATH": str(machine.bin)},
        input="hello\n",
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == "heard:hello\n"


OTHER = 'echo "3.11.9 (PyPy), not the ordinary 64-bit CPython"'


@pytest.mark.parametrize(
    ("prepare", "chosen", "words"),
    [
        (lambda one: (one.has("python3", (3, 14)), one.has("python", (3, 9))), "",
         "No Python on this machine fits: python3 is Python 3.14, python is Python 3.9."),
        (lambda one: script(one.bin / "python3", "exit 127"), "", "Python on this machine fits."),
        (lambda one: script(one.bin / "python3", OTHER), "", "python3 is 3.11.9 (PyPy)"),
        # A choice that does not fit is not passed over.
        (lambda one: (one.has("mine", (3, 9)), one.has("python3", (3, 12))), "mine",
         "/mine is Python 3.9."),
        (lambda one: one.has("python3", (3, 12)), "nowhere", "does not run as a Python"),
        # Other machines.
        *((lambda one, kind=kind: one.is_a(*kind), "", f"This machine is {kind[0]} on {kind[1]}.")
          for kind in (("Darwin", "arm64"), ("Linux", "aarch64"))),
        (lambda one: one.is_a("Darwin", "arm64"), "", "to try:         ./environment/container\n"),
        *((lambda one, name=name: one.is_a(name, "x86_64"), "", "wsl --install -d Ubuntu-24.04\n")
          for name in ("MINGW64_NT-10.0", "MSYS_NT-10.0", "CYGWIN_NT-10.0")),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_said(machine: Machine, prepare, chosen: str, words: str):
    prepare(machine)
    environ = {"ROSBEAT_PYTHON": str(machine.bin / chosen)} if chosen else {}
    assert words in machine.refuses(**environ)


def test_an_unfit_python3_is_passed_over(machine: Machine):
    machine.has("python3", (3, 14))
    machine.has("python3.12", (3, 12))
    machine.has("python3.10", (3, 10))
    assert machine.course("lab").stdout.startswith("python3.12 runs:")


def test_the_python_behind_venv_comes_first(machine: Machine, tmp_path: Path):
    machine.has("python3", (3, 13))
    behind = machine.has("python3.10", (3, 10), tmp_path / "some where")
    link = machine.root / ".venv" / "bin" / "python"
    link.parent.mkdir(parents=True)
    link.symlink_to(behind)
    assert machine.course("lab").stdout.startswith("python3.10 runs:")


def test_rosbeat_python_comes_before_everything(machine: Machine, tmp_path: Path):
    machine.has("python3", (3, 13))
    chosen = machine.has("mine", (3, 11), tmp_path / "some where")
    assert machine.course("lab", ROSBEAT_PYTHON=str(chosen)).stdout.startswith("mine runs:")


def test_the_launcher_can_be_run_as_it_is():
    assert os.access(ROOT / "environment" / "course", os.X_OK)
    assert os.access(ROOT / ".ci" / "run", os.X_OK)
