"""The house stays in order: who imports whom, how docstrings begin, which errors they name.

Each rule is a function from sources to a list of complaints. It is applied to the whole helper
package, and to a bad sample, which proves that it can fail. That everything public is documented
and annotated is a rule of ruff.
"""

import ast
import importlib.util
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src" / "rosbeat"

#: Which rooms of the house a room may import from; `diagnosis.exceptions` is one module of a room.
#: A room may always import from itself.
MAY_IMPORT = {
    "errors": set(),
    "environment": set(),
    "domains": {"errors", "environment"},
    "local_server": set(),
    "jupyter_lease": {"errors", "domains"},
    "records": {"errors"},
    "records_json": {"errors", "records"},
    "diagnosis": {"records", "errors"},
    "comparisons": {"records", "errors"},
    "bags": {"records", "errors", "comparisons", "ros"},
    "viz": {"records", "errors", "diagnosis", "comparisons"},
    "ros": {"records", "errors", "environment", "domains"},
    "inspection": {"records", "domains", "ros", "diagnosis"},
    "panel": {"records", "errors", "viz", "ros"},
    "page_names": set(),
    "page_cells": {"page_names", "workspace"},
    "page_errors": {"errors", "records", "diagnosis", "page_cells", "page_names"},
    "record_display": {"records"},
    "page_session": {
        *("errors", "records", "ros", "diagnosis", "inspection", "panel", "page_cells"),
    },
    "testing": {"errors", "records", "ros"},
    "pytest_plugin": {"testing"},
    "explain_command": {"errors", "ros", "diagnosis", "inspection"},
    "course_commands": {"errors", "environment"},
    "check_command": {"errors", "records_json", "exercises", "page_runs", "workspace"},
    "clinic": {"page_session", "ros", "diagnosis", "records", "errors"},
    # The import of page 07 in release 0.1.0.
    "scenarios": {"ros"},
    "exercises": {
        *("ros", "records", "records_json", "comparisons", "errors", "viz", "workspace"),
        *("diagnosis", "environment", "rosbeat", "bags", "clinic", "page_cells"),
    },
    "workspace": {"errors", "records", "environment", "diagnosis", "page_names"},
    "page_runs": {
        *("errors", "records", "records_json", "environment", "ros", "viz", "page_names"),
        *("exercises", "workspace", "diagnosis", "rosbeat"),
    },
    "grading": {
        *("errors", "records", "records_json", "viz", "exercises", "workspace", "diagnosis"),
        *("page_runs", "rosbeat", "local_server"),
    },
    "authoring": {"errors", "domains", "environment", "rosbeat"},
    # The package itself hands out names of other rooms.
    "rosbeat": {
        *("environment", "viz", "page_errors", "record_display", "page_session", "exercises"),
        *("workspace", "bags", "clinic", "jupyter_lease", "page_names", "panel"),
    },
}
#: What `pip install rosbeat` installs with all that it needs: for tests of any ROS developer.
ENGINE = {"rosbeat", "errors", "environment", "domains", "records", "ros", "testing",
          "pytest_plugin"}  # fmt: skip
#: `cli` may import everything, and nobody may import `cli`.
EVERYWHERE = {"cli", "__main__"}
#: Rooms that use nothing but the standard library, and those with a short list.
THIRD_PARTY = {
    "errors": set(),
    "records": set(),
    "records_json": {"msgspec"},
    "comparisons": set(),
    "bags": {"rosbags", "numpy"},
    "environment": set(),
    "domains": set(),
    "local_server": set(),
    "jupyter_lease": set(),
    "workspace": {"IPython", "ptyprocess", "ament_index_python", "pygments"},
    "authoring": {"jupytext", "nbformat", "nbclient", "jupyter_client"},
    "viz": {"matplotlib"},
    "panel": {"anywidget", "traitlets", "IPython"},
    "diagnosis": set(),
    "clinic": {"rclpy", "std_msgs"},
}
#: Nodes of the course's own, for learners to examine: the only code with ROS outside of `ros`.
ROS_TOO = {"rosbeat.clinic.nodes"}
ROS = re.compile(r"rclpy|_rclpy|rcl_interfaces|builtin_interfaces|rosidl\w*|rmw\w*|\w+_(msgs|srvs)")
# Written in two parts so that this file does not complain about itself.
MACHINE = re.compile(
    r"(?<![\w.])/wo"
    r"rk(?![\w-])|(?<!\w)\.lib"
    r"rary\b|(?<![\w./])/tmp/pro"
    r"be\b|\.\./sha"
    r"red/"
)

#: The floors of `ros`, from the ground up: the modules of each, and which of rclpy and greenlet
#: they may import. `docs/architecture.md` says what each floor is for.
FLOORS = (
    ({"schedule", "arguments", "distribution"}, set()),
    ({"waits", "threads"}, {"greenlet"}),
    (
        {
            *("differences", "errors", "exception_origin", "isolation", "logs", "processes"),
            *("taking", "qos_events", "recording", "context", "launch", "graph", "ports"),
            "node_registry",
        },
        {"rclpy"},
    ),
    ({"executors", "engine"}, {"rclpy", "greenlet"}),
    (
        {"clock", "wait_set", "actions", "spinning", "simulated_program", "live", "hooks"},
        {"rclpy", "greenlet"},
    ),
    (
        {
            *("session_core", "session", "scenario", "tester", "programs", "listening"),
            *("test_nodes", "reports", "entity_watch", "node_lives"),
            *("robot_reporter", "launching"),
        },
        {"rclpy", "greenlet"},
    ),
)

#: First words of a docstring that are no verbs in the imperative. A word that is a noun and a verb,
#: such as `Name`, passes.
NOT_A_VERB = {
    # Articles, pronouns and words that count.
    *("A", "An", "The", "This", "That", "These", "Those", "It", "Its", "They", "Their", "He"),
    *("She", "We", "Our", "You", "Your", "I", "My", "One", "Two", "Both", "All", "Any", "Each"),
    *("Every", "Some", "Many", "Several", "Most", "More", "Less", "Only", "Other", "Another"),
    *("Everybody", "Everyone", "Everything", "Somebody", "Someone", "Something", "Anybody"),
    *("Anyone", "Anything", "Nobody", "Nothing", "None", "No", "Not"),
    # Question words, and words that begin a clause or a phrase.
    *("What", "Who", "Whose", "Whom", "Which", "Whether", "How", "Why", "Where", "When", "While"),
    *("If", "As", "Because", "Since", "Until", "After", "Before", "There", "Here", "With"),
    *("Without", "In", "On", "At", "By", "For", "From", "To", "Of", "Like"),
    # Nouns, adjectives and participles.
    *("Callback", "Class", "Code", "Context", "Data", "Error", "Fault", "Full", "Function"),
    *("Message", "Method", "Node", "Quality", "Raised", "Saved", "Text", "Thrown", "Topic"),
    "Value",
}


# What is there.


@cache
def package():
    """Every module of the helper package with its source, by dotted name."""
    found = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        if "finished" in path.parts:  # a package for learners, and not a part of ours
            continue
        parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
        found[".".join(parts).removesuffix(".__init__")] = path.read_text(encoding="utf-8")
    return found


def room_of(module):
    """The room a module is in: the part after `rosbeat`, or `rosbeat` for the package itself."""
    return module.split(".")[1] if "." in module else module


def is_for_types(node):
    return isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test)


def statements(tree, with_types):
    """Every node of a tree, those under `if TYPE_CHECKING` only if asked for."""
    todo = [tree]
    while todo:
        node = todo.pop()
        yield node
        if with_types or not is_for_types(node):
            todo += ast.iter_child_nodes(node)


def imports(source, known=(), with_types=True):
    """Dotted names of everything a module imports, in functions as well."""
    found = []
    for node in statements(ast.parse(source), with_types):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            names = [f"{node.module}.{alias.name}" for alias in node.names]
            found += [name if name in known else node.module for name in names]
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith(
            ("import_module", "__import__")
        ):
            found += [arg.value for arg in node.args[:1] if isinstance(arg, ast.Constant)]
    return found


# The rules.


def wrong_directions(sources):
    said = []
    for module, source in sources.items():
        room = room_of(module)
        if room in EVERYWHERE:
            continue
        for name in imports(source, sources):
            if name.split(".")[0] == "rosbeat":
                named = {room_of(name), name.removeprefix("rosbeat.")}
                if not named & (MAY_IMPORT.get(room, set()) | {room}):
                    said.append(f"{module} imports {name}")
    return said


def unknown_rooms(sources):
    known = set(MAY_IMPORT) | EVERYWHERE
    return sorted({room_of(module) for module in sources} - known)


def rclpy_outside_ros(sources):
    return [f"{module} imports {name}" for module, source in sources.items()
            if room_of(module) != "ros" and module not in ROS_TOO
            for name in imports(source, sources) if ROS.fullmatch(name.split(".")[0])]  # fmt: skip


def foreign_imports(sources):
    said = []
    for module, source in sources.items():
        if room_of(module) in THIRD_PARTY:
            allowed = THIRD_PARTY[room_of(module)] | sys.stdlib_module_names | {"rosbeat"}
            tops = {name.split(".")[0] for name in imports(source, sources)}
            said += [f"{module} imports {top}" for top in sorted(tops - allowed)]
    return said


def cycles(sources):
    """Modules that import each other around a circle, imports for types not counted."""
    left = {
        module: set(sources) & set(imports(source, sources, with_types=False))
        for module, source in sources.items()
    }
    while True:
        free = [module for module, ends in left.items() if not any(end in left for end in ends)]
        if not free:
            return sorted(left)
        for module in free:
            del left[module]


def floor_of(module):
    """The number of a module's floor in `ros`; None for the package itself, and elsewhere."""
    parts = module.split(".")
    if parts[:2] != ["rosbeat", "ros"] or len(parts) < 3:
        return None
    return next((k for k, (modules, _) in enumerate(FLOORS) if parts[2] in modules), -1)


def wrong_floors(sources):
    """What a module of `ros` imports, when a program runs, that is above or not for its floor."""
    said = []
    for module, source in sources.items():
        floor = floor_of(module)
        if floor is None:
            continue
        if floor < 0:
            said.append(f"{module} has no floor in FLOORS")
            continue
        _, known = FLOORS[floor]
        for name in imports(source, sources, with_types=False):
            top = name.split(".")[0]
            other = "rclpy" if ROS.fullmatch(top) else top
            above = floor_of(name)
            if (above is not None and above > floor) or other in {"rclpy", "greenlet"} - known:
                said.append(f"{module} imports {name}")
    return said


def names_the_session(sources):
    """Modules of `ros` below the floor of the session that name `SessionCore`, a type included."""
    top = len(FLOORS) - 1
    below = [module for module in sources if floor_of(module) not in (None, top)]
    return [module for module in below if re.search(r"\bSessionCore\b", code(sources[module]))]


def names_of_rclpy(tree):
    """Names that a module binds to rclpy, or to what it imports or takes from there."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {(alias.asname or alias.name).split(".")[0] for alias in node.names
                      if ROS.fullmatch(alias.name.split(".")[0])}  # fmt: skip
        elif isinstance(node, ast.ImportFrom) and ROS.fullmatch((node.module or "").split(".")[0]):
            names |= {alias.asname or alias.name for alias in node.names}
    # `thread: Any = rclpy.Node`, or `goal = ServerGoalHandle`, is the same thing.
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign | ast.AnnAssign) and is_of(node.value, names):
            ends = node.targets if isinstance(node, ast.Assign) else [node.target]
            names |= {end.id for end in ends if isinstance(end, ast.Name)}
    return names


def is_of(node, names):
    """Whether an expression is one of these names, or an attribute of one."""
    while isinstance(node, ast.Attribute):
        node = node.value
    return isinstance(node, ast.Name) and node.id in names


def targets(node):
    """What a statement or call assigns to or deletes, each as an expression."""
    if isinstance(node, ast.Assign | ast.Delete):
        todo = list(node.targets)
    elif isinstance(node, ast.AugAssign | ast.AnnAssign):
        todo = [node.target]
    elif (isinstance(node, ast.Call) and len(node.args) > 1
          and ast.unparse(node.func) in ("setattr", "delattr")):  # fmt: skip
        yield ast.Attribute(node.args[0], "?")
        return
    else:
        return
    while todo:
        end = todo.pop()
        if isinstance(end, ast.Tuple | ast.List):
            todo += end.elts
        else:
            yield end


#: What is replaced while nodes run, and taken back.
AROUND_A_RUN = {
    ("rosbeat.ros.context", "rclpy.utilities.g_default_context"),
    ("rosbeat.ros.simulated_program", "utilities.g_default_context"),
    ("rosbeat.ros.simulated_program", "utilities.Context"),
}


def patches_outside_hooks(sources):
    """What is assigned to an attribute of something of rclpy, other than by `ros.hooks`."""
    said = []
    for module, source in sources.items():
        if module == "rosbeat.ros.hooks":
            continue
        tree = ast.parse(source)
        names = names_of_rclpy(tree)
        said += [f"{module} assigns to {ast.unparse(end)}"
                 for node in ast.walk(tree) for end in targets(node)
                 if isinstance(end, ast.Attribute) and is_of(end, names)
                 and (module, ast.unparse(end)) not in AROUND_A_RUN]  # fmt: skip
    return said


def code(source):
    """A source without its docstrings and comments."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            node.value.value = ""
    return ast.unparse(tree)


def public_things(tree, prefix=""):
    """Public classes and functions, methods of public classes included, with their names."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            overload = any("overload" in ast.unparse(mark) for mark in node.decorator_list)
            if not node.name.startswith("_") and not overload:
                yield prefix + node.name, node
                if isinstance(node, ast.ClassDef):
                    yield from public_things(node, f"{prefix}{node.name}.")


def not_a_verb(sources):
    """Public docstrings whose first word is not a verb in the imperative, judged by its look."""
    said = []
    for module, source in sources.items():
        for name, node in public_things(ast.parse(source)):
            word = (ast.get_docstring(node) or "").split(maxsplit=1)[:1]
            said += [f"{module}.{name}: {one}" for one in word if not is_imperative(one)]
    return said


def is_imperative(word):
    """Judge by the look of a word: capitalized, not known as another word, no third person."""
    bare = word.rstrip(".,:;")
    is_word = re.fullmatch(r"[A-Z][a-z]+(-[a-z]+)?", bare) is not None
    return is_word and not re.search(r"[^s]s$", bare) and bare not in NOT_A_VERB


def raised_errors(function):
    """Names of the package's own errors that a function's body raises itself."""
    todo = list(function.body)
    while todo:
        node = todo.pop()
        if isinstance(node, ast.Raise) and node.exc is not None:
            made = node.exc.func if isinstance(node.exc, ast.Call) else node.exc
            if isinstance(made, ast.Name) and made.id in own_errors():
                yield made.id
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Lambda):
            todo += ast.iter_child_nodes(node)


@cache
def own_errors():
    tree = ast.parse(package()["rosbeat.errors"])
    return {node.name for node in tree.body if isinstance(node, ast.ClassDef)}


def unnamed_errors(sources):
    """Public functions that raise an error of ours which their section `Raises:` does not name."""
    said = []
    for module, source in sources.items():
        for name, node in public_things(ast.parse(source)):
            if not isinstance(node, ast.ClassDef):
                told = (ast.get_docstring(node) or "").partition("\nRaises:\n")[2]
                said += [f"{module}.{name}: {error}" for error in raised_errors(node)
                         if not re.search(rf"^    {error}:", told, re.MULTILINE)]  # fmt: skip
    return said


#: Words of the course, which mean nothing to whoever tests nodes.
OF_PAGES = re.compile(r"\b(cells?|pages?|notebooks?|learners?)\b")


def words_of_pages(sources):
    """Texts of the engine that speak of pages; docstrings and comments may."""
    said = []
    for module, source in sources.items():
        if room_of(module) not in ENGINE - {"rosbeat", "environment", "domains"}:
            continue
        tree = ast.parse(source)
        docs = {node.value for node in ast.walk(tree) if isinstance(node, ast.Expr)}
        said += [f"{module}: {node.value}" for node in ast.walk(tree)
                 if isinstance(node, ast.Constant) and isinstance(node.value, str)
                 and node not in docs and OF_PAGES.search(node.value)]  # fmt: skip
    return said


#: A comment that silences a checker, at the end of its line.
BARE = re.compile(
    r"#\s*(?:noqa(?::\s*[A-Z]+\d+(?:,\s*[A-Z]+\d+)*)?|type:\s*ignore(?:\[[\w, -]+\])?)\s*$"
)


def unexplained(sources):
    """Lines on which a checker is silenced and nothing says why."""
    return [f"{module}: {line.strip()}" for module, source in sources.items()
            for line in source.splitlines() if BARE.search(line)]  # fmt: skip


def machine_paths(texts):
    return [f"{name}: {line.strip()}" for name, text in texts.items()
            for line in text.splitlines() if MACHINE.search(line)]  # fmt: skip


def tracked():
    """Every text file that is or will be in the repository."""
    command = ["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard", "-z"]
    try:
        listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        paths = [ROOT / name for name in listed.split("\0") if name]
    except (OSError, subprocess.CalledProcessError):
        rooms = ("src", "tests", "docs", "environment", "notebooks", "solutions")
        paths = [path for room in rooms for path in (ROOT / room).rglob("*")]
    texts = {}
    for path in paths:
        data = path.read_bytes() if path.is_file() else b"\0"
        if b"\0" not in data:
            texts[str(path.relative_to(ROOT))] = data.decode("utf-8", "replace")
    return texts


# The rules hold.

RULES = [wrong_directions, unknown_rooms, rclpy_outside_ros, foreign_imports, cycles,
         wrong_floors, names_the_session, patches_outside_hooks, not_a_verb, unnamed_errors,
         unexplained, words_of_pages]  # fmt: skip


@pytest.mark.parametrize("rule", RULES)
def test_the_package_keeps_the_rule(rule):
    assert rule(package()) == []


def test_the_picture_of_the_rooms_is_up_to_date():
    path = ROOT / "docs" / "draw_architecture.py"
    spec = importlib.util.spec_from_file_location("draw_architecture", path)
    drawing = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = drawing  # dataclasses look their module up there
    try:
        spec.loader.exec_module(drawing)
        drawn = drawing.picture(drawing.arrows())
    finally:
        del sys.modules[spec.name]
    assert drawn == drawing.PICTURE.read_text(encoding="utf-8"), "run docs/draw_architecture.py"


def test_a_session_of_a_test_loads_nothing_of_the_course():
    """In a fresh interpreter, which has done what a test with the fixture does."""
    code = """
import sys
import pytest, rclpy, rclpy.action
known = set(sys.modules)
import rosbeat.pytest_plugin
from rclpy.node import Node
from rosbeat.testing import TestSession

def fail():
    raise ValueError

with TestSession(seed=1) as session:
    session.add(lambda: Node("node"))
    session.spawn(fail, check=False)
    session.run(1)
    session.set_parameters("node", {"use_sim_time": True})
    session.observation()
print(*sorted(set(sys.modules) - known))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    loaded = set(done.stdout.split())
    assert "rosbeat.ros.session" in loaded
    assert {room_of(name) for name in loaded if name.split(".")[0] == "rosbeat"} <= ENGINE
    engine, others = set(), set()
    for module, source in package().items():
        tops = {name.split(".")[0] for name in imports(source, package())}
        (engine if room_of(module) in ENGINE else others).update(tops)
    # Each class of messages needs NumPy.
    of_the_course = others - engine - sys.stdlib_module_names - {"numpy"}
    assert {"IPython", "matplotlib", "msgspec", "rosbags", "jinja2"} <= of_the_course
    assert {name.split(".")[0] for name in loaded} & of_the_course == set()


def test_no_file_names_a_machine():
    assert machine_paths(tracked()) == []


def test_there_is_something_to_look_at():
    assert {"rosbeat", "rosbeat.errors", "rosbeat.records", "rosbeat.viz"} <= set(package())
    assert "pyproject.toml" in tracked() or not (ROOT / ".git").exists()


# The rules can fail.

# fmt: off
BAD = {
    "viz imports ros": (wrong_directions, "rosbeat.viz.a", "from rosbeat.ros import b"),
    "viz imports the package": (wrong_directions, "rosbeat.viz.a", "from rosbeat import Session"),
    "inside a function": (wrong_directions, "rosbeat.records", "def f():\n import rosbeat.viz"),
    "for types": (wrong_directions, "rosbeat.records",
                  "if TYPE_CHECKING:\n from rosbeat.ros import a"),
    "by name": (wrong_directions, "rosbeat.viz.a", "import_module('rosbeat.ros.session')"),
    "anybody imports cli": (wrong_directions, "rosbeat.grading.a", "from rosbeat.cli import main"),
    "a new room": (unknown_rooms, "rosbeat.cellar.a", ""),
    "cli imports messages": (rclpy_outside_ros, "rosbeat.cli", "from std_msgs.msg import Float32"),
    "workspace imports rclpy": (rclpy_outside_ros, "rosbeat.workspace.a", "import rclpy as r"),
    "records import numpy": (foreign_imports, "rosbeat.records", "import numpy"),
    "the schedule imports the engine": (wrong_floors, "rosbeat.ros.schedule",
                                      "from rosbeat.ros.engine import VirtualTime"),
    "the schedule imports greenlets": (wrong_floors, "rosbeat.ros.schedule",
                                       "def f():\n from greenlet import getcurrent"),
    "waits import messages": (wrong_floors, "rosbeat.ros.waits", "import std_msgs.msg"),
    "nodes import greenlets": (wrong_floors, "rosbeat.ros.processes", "import greenlet"),
    "a module without a floor": (wrong_floors, "rosbeat.ros.cellar", ""),
    "the engine knows the session": (names_the_session, "rosbeat.ros.engine",
                                     "def f(core: SessionCore): pass"),
    "the engine knows its type": (
        names_the_session, "rosbeat.ros.engine",
        "if TYPE_CHECKING:\n from rosbeat.ros.session_core import SessionCore"),
    "a patch": (patches_outside_hooks, "rosbeat.ros.a",
                "from rclpy.node import Node\nNode.get_logger = watch(Node.get_logger)"),
    "a patch in a function": (
        patches_outside_hooks, "rosbeat.ros.a",
        "import rclpy.executors as e\ndef _install():\n a, e.Executor.spin = 1, 2\n_install()"),
    "a patch by another name": (patches_outside_hooks, "rosbeat.ros.a",
                                "from rclpy.task import Task\nkind: Any = Task\nkind.done = f"),
    "a patch by setattr": (patches_outside_hooks, "rosbeat.viz.a",
                           "import rclpy\nfor name in NAMES:\n setattr(rclpy, name, f)"),
    "a noun phrase": (not_a_verb, "rosbeat.a", 'class A:\n """A bag of words."""'),
    "no reason": (unexplained, "rosbeat.a", "import a  # noqa: F401"),
    "no reason, types": (unexplained, "rosbeat.a", "a = b()  # type: ignore[misc, unused-ignore]"),
    "a text of a page": (words_of_pages, "rosbeat.ros.a",
                         'def f():\n """A cell."""\n a("A cell.")'),
    "the third person": (not_a_verb, "rosbeat.a", 'class A:\n """Publishes a status."""'),
    "a name of a method": (not_a_verb, "rosbeat.a",
                           'class A:\n """Hold a."""\n def b(self):\n  """`f` of x."""'),
    "an error without a section": (unnamed_errors, "rosbeat.a",
                                   'def f():\n """Raise a BagError."""\n raise BagError("so")'),
    "an error that the section does not name": (
        unnamed_errors, "rosbeat.a",
        'def f(x):\n """Do.\n\n Raises:\n     BagError: So.\n """\n if x:\n  raise RecordError'),
}
# fmt: on


@pytest.mark.parametrize("case", BAD)
def test_the_rule_notices(case):
    rule, module, source = BAD[case]
    assert rule({module: source}) != []


def test_a_floor_may_name_types_from_above():
    for_types = "if TYPE_CHECKING:\n    from rosbeat.ros.processes import Process"
    assert wrong_floors({"rosbeat.ros.waits": f"from greenlet import greenlet\n{for_types}"}) == []


def test_each_floor_is_in_the_table_of_the_document():
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    part = text.partition("## The floors of `ros/`\n")[2].partition("\n## ")[0]
    rows = [line.split("|")[2] for line in part.splitlines() if line.startswith("|")][2:]
    named = [set(re.findall(r"`(\w+)`", row)) for row in reversed(rows)]
    assert named == [modules for modules, _ in FLOORS]


def test_a_circle_is_noticed_and_one_for_types_is_not():
    one = "from rosbeat.viz import b"
    assert cycles({"rosbeat.viz.a": one, "rosbeat.viz.b": "import rosbeat.viz.a"}) != []
    for_types = "if TYPE_CHECKING:\n    import rosbeat.viz.a"
    assert cycles({"rosbeat.viz.a": one, "rosbeat.viz.b": for_types}) == []


@pytest.mark.parametrize(
    "parts",
    [("see /wo", "rk/main/src"), ("cd /wo", "rk"), ("the .lib", "rary"), ("../sha", "red/a")],
)
def test_a_machine_path_is_noticed(parts):
    assert machine_paths({"README.md": f"fine\n{''.join(parts)}\n"}) != []
