"""Names that no cell has defined, as a page shows them after a restart of the kernel."""

import subprocess
import sys

import pytest

SHELL = """
import sys
from IPython.core.interactiveshell import InteractiveShell
from traitlets.config import Config

settings = Config()
settings.InteractiveShell.colors = "NoColor" if sys.version_info < (3, 11) else "nocolor"
settings.HistoryManager.enabled = False
shell = InteractiveShell.instance(config=settings)
for cell in sys.argv[1:]:
    shell.run_cell(cell)
"""
IMPORTS = "from rosbeat import Session, check"
ABOVE = "hoose Run, Run All Above Selected Cell in the menu."


def shown(*cells):
    """What the cells of a new kernel show."""
    done = subprocess.run([sys.executable, "-c", SHELL, *cells], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("cell", [
    'check("03a", HumiditySensor)',
    "def make():\n    return HumiditySensor()\nmake()",
    "class Sensor:\n    kind = HumiditySensor",
])  # fmt: skip
def test_a_name_of_an_earlier_cell_says_which_cells_to_run(cell):
    told = shown(IMPORTS, cell)
    assert told.rstrip().endswith(
        "NameError: name 'HumiditySensor' is not defined\n"
        "  What it means: No cell that has run since the kernel started defines "
        "`HumiditySensor`.\n"
        f"  What to try:   C{ABOVE} If that doesn't help, check the spelling."
    )
    assert told.count("NameError: name") == 1


def test_a_misspelled_name_is_compared_with_the_names_of_the_page():
    assert f"What to try:   Did you mean `Session`? If not, c{ABOVE}" in shown(IMPORTS, "Sesion()")


@pytest.mark.parametrize("cell", [
    "____ + 1",
    "def f():\n    a = b\n    b = 1\nf()",
    "1 / 0",
    "import json\njson.nothing",
    "import string\nexec('nothing', vars(string))",
])  # fmt: skip
def test_other_errors_are_as_they_were(cell):
    told = shown(IMPORTS, cell)
    assert "Error" in told
    assert "What to try" not in told


def test_a_handler_that_was_there_stays():
    mine = "def mine(shell, kind, error, trace, tb_offset=None):\n    print('mine:', error)"
    install = "get_ipython().set_custom_exc((NameError,), mine)"
    assert "mine: name 'nothing' is not defined" in shown(mine, install, IMPORTS, "nothing")
