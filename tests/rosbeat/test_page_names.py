"""The names of the course are on every page, without an import, and are not the learner's."""

import json
import os
import sys

import pytest
from jupyter_client.manager import KernelManager

import rosbeat
from rosbeat.authoring.execution import kernel_place

#: Each cell prints a line of JSON.
AT_FIRST = "print(*sorted({'rclpy', 'matplotlib', 'rosbeat.workspace.magics'} & set(sys.modules)))"
ALL = f"print(*(name for name in {rosbeat.__all__} if name not in globals()))"


@pytest.fixture(scope="module")
def run():
    """Run a cell in the course's kernel, started as JupyterLab starts it; return what it shows."""
    with kernel_place() as place:
        manager = KernelManager(**place.options())
        manager.kernel_spec.argv = [sys.executable, "-m", "ipykernel_launcher", "-f",
                                    "{connection_file}"]  # fmt: skip
        manager.start_kernel(env=place.environment, cwd=place.folder)
        client = manager.client()
        client.start_channels()
        client.wait_for_ready(60)

        def run(code):
            shown = []

            def hear(message):
                content = message["content"]
                shown.append(content.get("text") or "\n".join(content.get("traceback", ())))
                shown.append(content.get("data", {}).get("text/plain", ""))

            client.execute_interactive(code, timeout=60, output_hook=hear, store_history=True)
            return "".join(shown)

        yield run
        client.stop_channels()
        manager.shutdown_kernel(now=True)


def test_a_kernel_has_loaded_nothing_large_before_a_cell_needs_it(run):
    assert run(f"import sys\n{AT_FIRST}") == "\n"


def test_every_name_and_command_is_there(run):
    assert run(ALL) == "\n"
    assert "checked" in run("%%terminal first\necho chec''ked")


def test_names_are_not_the_learners(run):
    run("mine = [check, viz]")
    listed = run("%who")
    assert "mine" in listed
    assert not {"check", "viz"} & set(listed.split())
    assert "Did you mean `mine`?" in run("mines")
    assert "Did you mean `Session`?" in run("Sesion()")


def test_a_definition_of_the_learners_wins_until_it_is_gone(run):
    run("hint = 5")
    assert run("hint") == "5"
    assert "hint" in run("%who").split()
    run("del hint")
    assert "exercises.hint" in run("hint")


def test_names_in_functions_strings_and_other_commands_are_found(run):
    assert "module" in run("def what():\n    return type(clinic).__name__\nwhat()")
    assert "module" in run("eval('type(bags).__name__')")
    assert "function" in run("%time print(type(progress).__name__)")


def test_names_come_back_after_a_reset(run):
    run("%reset -f")
    assert "exercises.quiz" in run("quiz")


NODES = "%%save src/sensor_simulator/sensor_simulator/nodes.py\n"


def test_a_file_has_no_names_of_the_course(run):
    run("viz, workspace.catch_up('03')")
    told = run(NODES + "shown = viz")
    assert "nodes.py has no import for viz" in told
    assert "NameError" in told
    assert "Only the cells of a page know `viz` without an import" in told
    assert "A file imports what it uses: `from rosbeat import viz`." in told
    assert "has no import for check, viz" in run(NODES + "def f():\n    check(viz)")
    assert "module" in run("type(viz).__name__")


@pytest.mark.parametrize("text", [
    "from rosbeat import viz\nviz.graph",
    "import rosbeat.viz as viz\nviz.graph",
    "def f(check):\n    return check",
    "hint = 1\nhint",
    "class A:\n    def check(self):\n        return self.check",
    "for check in ():\n    check",
])  # fmt: skip
def test_a_file_that_has_its_own_names_is_fine(run, text):
    run("viz, check, hint")
    told = run(NODES + text)
    assert "saved" in told
    assert not any(word in told for word in ("no import", "Error"))


# A name that a cell of the page defines.

PAGE = [
    ("markdown", "# Title"),
    ("code", "import random\nfrom std_msgs.msg import String"),
    ("markdown", "Text.\n\n## Visit the newsroom #\n\nMore."),
    ("code", "%%terminal one\necho Reader"),
    ("code", "# A comment.\nclass Reader:\n    unseen = 1"),
    ("code", "reader = Reader()\nwith open('/dev/null') as file:\n    (a, *b), c = (1, 2), 3"),
    ("markdown", "## Later"),
    ("code", "reader = 2"),
    ("code", "RUNS"),
    ("code", NODES + "class Saved:\n    pass"),
    ("code", "not Python, but readers"),
    ("code", "reader = 3"),
]


@pytest.fixture
def ask(run, tmp_path):
    """Run code as a cell of the page; return what it shows."""
    page = tmp_path / "04 a page.ipynb"
    cells = [{"cell_type": kind, "id": f"c{number}", "source": text.splitlines(keepends=True)}
             for number, (kind, text) in enumerate(PAGE)]  # fmt: skip
    page.write_text(json.dumps({"cells": cells}))
    number = next(n for n, (_, text) in enumerate(PAGE) if text == "RUNS")

    def ask(code, cell=f"c{number}", file=page):
        run(f"import os; os.environ['JPY_SESSION_NAME'] = {str(file)!r}\n%reset -f")
        parent = {"metadata": {"cellId": cell}}
        run(f"real = get_ipython().get_parent; get_ipython().get_parent = lambda: {parent}")
        return run(code)

    yield ask
    run("get_ipython().__dict__.pop('get_parent', None)")
    run(f"os.environ['JPY_SESSION_NAME'] = {os.environ.get('JPY_SESSION_NAME', '')!r}")


ABOVE = "Run the cell above that begins with"
BELOW = "Run the cell further down that begins with"


@pytest.mark.parametrize(("name", "told"), [
    ("Reader", f'{ABOVE} `class Reader:`, under the heading "Visit the newsroom", then this cell'),
    ("String", f'{ABOVE} `import random`, under the heading "Title", then this cell again.'),
    ("reader", f'{ABOVE} `reader = 2`, under the heading "Later", then this cell again. Or choose'),
    ("file", f'{ABOVE} `reader = Reader()`, under the heading'),
    ("b", f'{ABOVE} `reader = Reader()`, under the heading'),
    ("Saved", f'{BELOW} `%%save src/sensor_simulator/sensor_simulator/nodes.py`'),
    ("readers", "Did you mean"),
    ("unseen", "check the spelling"),
])  # fmt: skip
def test_a_name_that_the_page_defines_leads_to_its_cell(ask, name, told):
    mine = "readings = 1\n" if name == "readers" else ""
    assert told in ask(mine + name)


def test_a_check_of_an_exercise_that_did_not_run_leads_to_its_cell(ask):
    assert f"{ABOVE} `class Reader:`" in ask('check("04a", Reader)')


SPEAKER = """
from rclpy.node import Node
class Speaker(Node):
    def __init__(self):
        super().__init__("speaker")
        self.timer = self.create_timer(1.0, self.speak)
    def speak(self):
        NAME
ros = Session()
ros.add(Speaker)
"""
IMPORT = f'{ABOVE} `import random`, under the heading "Title"'


@pytest.mark.parametrize("last", ["ros.run(seconds=2)", 'check("00b", Speaker)'])
def test_a_name_in_a_callback_leads_to_its_cell_and_counts_as_no_mistake(ask, last):
    told = ask(SPEAKER.replace("NAME", "String()") + last)
    assert told.count(IMPORT) == 1
    assert "No cell that has run since the kernel started defines that name" in told
    assert not any(words in told for words in ("not there yet", "imports at the top"))


def test_a_name_in_a_function_that_is_checked_leads_to_its_cell(ask):
    told = ask('check("07a", lambda: String)')
    assert f"{IMPORT}, then this check again." in told


def test_a_name_that_nothing_on_the_page_defines_is_a_mistake_as_before(ask):
    told = ask(SPEAKER.replace("NAME", "Int32()") + 'check("00b", Speaker)')
    assert "Exercise 00b: not there yet" in told


def test_where_the_page_is_not_known_the_advice_is_the_general_one(ask, tmp_path):
    general = "Choose Run, Run All Above Selected Cell in the menu."
    assert general in ask("Reader", cell="new")
    assert general in ask("Reader", file=tmp_path / "gone.ipynb")
    (tmp_path / "broken.ipynb").write_text('{"cells": [')
    assert general in ask("Reader", file=tmp_path / "broken.ipynb")
