"""Names that no cell has defined, as a page shows them after a restart of the kernel."""

import json
import subprocess
import sys

import pytest

#: Each line of its input is a kernel's cells: a fork runs them, and the next line waits for it.
SHELLS = """
import json
import os
import sys

import numpy
import rclpy.node
import std_msgs.msg
from IPython.core.interactiveshell import InteractiveShell
from traitlets.config import Config

for line in sys.stdin:
    if os.fork():
        _, status = os.wait()
        print("\\0", status, flush=True)
        continue
    settings = Config()
    settings.InteractiveShell.colors = "NoColor" if sys.version_info < (3, 11) else "nocolor"
    settings.HistoryManager.enabled = False
    shell = InteractiveShell.instance(config=settings)
    for cell in json.loads(line):
        shell.run_cell(cell)
    sys.stdout.flush()
    os._exit(0)
"""
IMPORTS = "from rosbeat import Session, check"
ABOVE = "hoose Run, Run All Above Selected Cell in the menu."


@pytest.fixture(scope="module")
def shells():
    """A process that has imported what takes long, and nothing of rosbeat."""
    command = [sys.executable, "-c", SHELLS]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        yield process
        process.kill()


@pytest.fixture
def shown(shells):
    """Return what the cells of a new kernel show."""

    def show(*cells):
        shells.stdin.write(json.dumps(cells) + "\n")
        shells.stdin.flush()
        lines = []
        while not (line := shells.stdout.readline()).startswith("\0"):
            assert line, "the process that starts kernels has ended"
            lines.append(line)
        assert line == "\0 0\n", "".join(lines)
        return "".join(lines)

    return show


@pytest.mark.parametrize("cell", [
    'check("03a", HumiditySensor)',
    "def make():\n    return HumiditySensor()\nmake()",
    "class Sensor:\n    kind = HumiditySensor",
])  # fmt: skip
def test_a_name_of_an_earlier_cell_says_which_cells_to_run(cell, shown):
    told = shown(IMPORTS, cell)
    assert told.rstrip().endswith(
        "NameError: name 'HumiditySensor' is not defined\n"
        "  What it means: No cell that has run since the kernel started defines "
        "`HumiditySensor`.\n"
        f"  What to try:   C{ABOVE} If that doesn't help, check the spelling."
    )
    assert told.count("NameError: name") == 1


def test_a_misspelled_name_is_compared_with_the_names_of_the_page(shown):
    assert f"What to try:   Did you mean `Session`? If not, c{ABOVE}" in shown(IMPORTS, "Sesion()")


@pytest.mark.parametrize(("cell", "said"), [
    ("print('hello'", "The bracket `(` is opened here"),
    ("def f():\nreturn 1", "the line below it is not indented"),
    ("class A\n    pass", "A colon is missing"),
    ("def f():\n    a = b\n    b = 1\nf()", "b has no value yet at this line."),
    ("from std_msgs.msg import Float32\nFloat32().dat", "A Float32 has no field called dat."),
    ("from std_msgs.msg import Flot32", "Float32"),
    ("1 / 0", "This line divides by zero"),
    ("'a' + 1", "combines a string and a number"),
    ("int('x')", "The cell stopped at the line that is marked"),
    ("import json\njson.loads('{')", "Compare that line with the page."),
])  # fmt: skip
def test_other_errors_say_what_they_mean_and_what_to_try(cell, said, shown):
    told = shown(IMPORTS, cell)
    last = told.rstrip().splitlines()[-2:]
    assert [one[:17] for one in last] == ["  What it means: ", "  What to try:   "]
    assert said in "".join(last)
    assert told.count("What to try") == 1


@pytest.mark.parametrize("cell", [
    "____ + 1",
    "import string\nexec('nothing', vars(string))",
    "get_ipython().run_line_magic('nothing', '')",
])  # fmt: skip
def test_a_blank_and_what_other_code_does_are_as_they_were(cell, shown):
    assert "What to try" not in shown(IMPORTS, cell)


def test_a_broken_module_is_not_taken_for_the_cell(tmp_path, shown):
    (tmp_path / "broken.py").write_text("def f(:\n")
    told = shown(IMPORTS, f"import sys\nsys.path.insert(0, {str(tmp_path)!r})", "import broken")
    assert "none of its lines ran" not in told
    assert "import broken" in told
    assert "The cell stopped at the line that is marked" in told


def test_an_error_that_is_raised_again_is_explained_once_each_time(shown):
    told = shown(IMPORTS, "kept = ValueError('kept')", "raise kept  # one", "raise kept  # two")
    first, second = told.split("# one", 1)[1].split("# two", 1)
    assert first.count("What to try") == 1
    assert second.count("What to try") == 1


def test_an_error_of_the_course_has_its_own_two_lines(shown):
    assert shown(IMPORTS, "check('99z')").count("What to try") == 1


def test_a_handler_that_was_there_stays(shown):
    mine = "def mine(shell, kind, error, trace, tb_offset=None):\n    print('mine:', error)"
    install = "get_ipython().set_custom_exc((NameError,), mine)"
    assert "mine: name 'nothing' is not defined" in shown(mine, install, IMPORTS, "nothing")


HIDDEN = """
import os, pathlib, sys, tempfile
os.chdir(tempfile.mkdtemp())
sys.path.insert(0, "")
sys.modules.pop("colorsys", None)
pathlib.Path("colorsys.py").touch()
module = pathlib.Path("ROS2_and_RL_Tutorials/src/sensors/sensors/helper.py")
module.parent.mkdir(parents=True)
module.touch()
"""


@pytest.mark.parametrize(("cell", "said"), [
    ("import colorsys\ncolorsys.rgb_to_hsv(1, 1, 1)", "Your own file colorsys.py, in the folder"),
    ("import colorsys\ncolorsys.rgb_to_hsv(1, 1, 1)", "such as my_colorsys.py. Then restart"),
    ("from helper import limit", "helper.py is there, in the package sensors"),
    ("from helper import limit", "Write `from sensors.helper import ...`"),
])  # fmt: skip
def test_a_file_in_the_way_or_out_of_reach_is_named(cell, said, shown):
    assert said in shown(IMPORTS, HIDDEN, cell)
