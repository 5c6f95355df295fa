"""Whether an answer reaches for what no exercise asks for: a person has to look at it.

A judgement rests on what a program does. Whoever observes it is in the same process, so a program
that reaches into Python itself, into the course or into the operating system could pretend. The
sandbox keeps such a program from doing harm; this keeps it from being judged by a machine. Nothing
is said about whether it is right. It is held, with the line that is the reason.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from rosbeat.grading.importable import may_use
from rosbeat.grading.imports import CLINIC, USES_THE_CLINIC, Imports, imports_in, refused_import

#: Functions that run texts, or show what is behind a program.
_FUNCTIONS = frozenset(
    (
        *("eval", "exec", "compile", "__import__", "globals", "locals", "vars", "open"),
        *("get_ipython", "breakpoint", "memoryview", "__builtins__", "__loader__", "__spec__"),
    )
)
#: Functions that take the name of an attribute: they are looked at where they are called.
_BY_NAME = frozenset(("getattr", "setattr", "delattr", "hasattr", "wraps"))
_MODULES = frozenset(
    (
        *("sys", "os", "gc", "builtins", "inspect", "ctypes", "importlib", "subprocess", "signal"),
        *("socket", "multiprocessing", "pathlib", "shutil", "tempfile", "pickle", "marshal"),
        *("linecache", "traceback", "atexit", "resource", "mmap", "fcntl", "runpy", "pty", "io"),
    )
)
#: Attributes that lead from a value to what runs it.
_INNER = re.compile(
    r"__(?!init__|name__|doc__|post_init__|repr__|str__|len__|iter__|next__|eq__|hash__|call__"
    r"|enter__|exit__|qualname__|class__|version__|file__|lt__|gt__|le__|ge__|contains__|getitem__"
    r"|setitem__|bool__|slots__|add__|sub__|mul__|aenter__|aexit__|all__|author__|truediv__"
    r"|await__|del__|main__|int__|float__|format__|missing__|new__|ne__|abs__|round__|set_name__"
    r"|iadd__|radd__|rsub__|rmul__|neg__|index__|delitem__|reversed__|aiter__|anext__|future__"
    r"|init_subclass__|get__|set__)\w+__$"
    r"|(f_back|f_globals|f_locals|f_code|tb_frame|tb_next|gi_frame|cr_frame|ag_frame|func_globals"
    r"|co_code)$"
)
#: The same in a text, from which such a name may be made.
_IN_A_TEXT = re.compile(r"__[a-z]+(?:_[a-z]+)*__|\b(?:f_back|tb_frame|gi_frame|f_locals)\b")
#: Attributes of a node that lead to whoever runs it, and what programs want of them.
_RUNNERS = frozenset(("context", "executor"))
_OF_RUNNERS = frozenset(
    (
        *("ok", "on_shutdown", "get_domain_id", "create_task", "wake", "spin_once"),
        *("spin_until_future_complete", "spin_once_until_future_complete", "add_node"),
        *("remove_node", "get_nodes"),
    )
)
#: Attributes by which whatever runs a node is moved, or a shell is started.
_LEVERS = frozenset(
    (
        *("watcher", "recorder", "advance", "follow_session", "follow_wall", "mro"),
        *("set_ros_time_override", "subprocess_exec", "subprocess_shell", "run_nested"),
        *("load_extension", "enable_load_extension", "modules", "import_module"),
        *("bltns", "exec", "eval", "update_wrapper", "get_type_hints", "get_field"),
    )
)


@dataclass(frozen=True)
class Reason:
    """Why a person has to look.

    Attributes:
        line: The line of the cell, from 1.
        text: What is there, a few words that begin a sentence.
    """

    line: int
    text: str


@dataclass(frozen=True)
class _Known:
    """What has to be known of a whole cell to judge one place in it.

    Attributes:
        imports: What it and its page import.
        names: Names of what was imported, those of message classes left out.
        own: Names that it gives itself: to attributes, functions and variables.
        called: The ids of nodes that are called.
        read_on: The ids of nodes of which an attribute is read.
        context: The ids of nodes that are handed over as `context=`.
    """

    imports: Imports
    names: frozenset[str]
    own: frozenset[str]
    called: frozenset[int]
    read_on: dict[int, str]
    context: frozenset[int]


def reasons(answer: str, imports: str = "") -> tuple[Reason, ...]:
    """Find what a person has to look at.

    Args:
        answer: The text of a cell of Python.
        imports: The page's cell of imports, whose names must stay what they are.

    Returns:
        The reasons, by line; none for a cell that is no Python at all: it cannot run either.
    """
    tree, given = _parsed(answer), _parsed(imports)
    if tree is None:
        return ()
    known = _known(tree, imports_in(tree, given or ast.Module([], [])))
    found = {one.line: one for one in _look(tree, known)}
    return tuple(found[line] for line in sorted(found))


def _parsed(text: str) -> ast.Module | None:
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _known(tree: ast.Module, imports: Imports) -> _Known:
    nodes = list(ast.walk(tree))
    calls = [one for one in nodes if isinstance(one, ast.Call)]
    keywords = [word for one in calls for word in one.keywords if word.arg == "context"]
    return _Known(
        imports,
        imports.names | _aliases(nodes, imports.names),
        frozenset(name for one in nodes for name in _gives(one)),
        frozenset(id(one.func) for one in calls),
        {id(one.value): one.attr for one in nodes if isinstance(one, ast.Attribute)},
        frozenset(id(one.value) for one in keywords),
    )


def _gives(node: ast.AST) -> Iterator[str]:
    if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
        yield node.name
    elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
        yield node.attr
    elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
        yield node.id


def _aliases(nodes: list[ast.AST], names: frozenset[str]) -> frozenset[str]:
    """Names that are given to what was imported: `other = Node`."""
    found: set[str] = set()
    for node in nodes:
        if isinstance(node, ast.Assign) and _root(node.value) in names | found:
            found |= {one.id for one in node.targets if isinstance(one, ast.Name)}
    return frozenset(found)


def _look(tree: ast.Module, known: _Known) -> Iterator[Reason]:
    for node in ast.walk(tree):
        said = (
            refused_import(node, known.imports)
            or _of_name(node, known)
            or _of_definition(node)
            or _of_attribute(node, known)
            or _of_call(node)
            or _of_change(node, known.names)
        )
        if said:
            yield Reason(getattr(node, "lineno", 0), said)


def _of_name(node: ast.AST, known: _Known) -> str:
    if isinstance(node, ast.Constant):
        return _of_text(node.value)
    if not isinstance(node, ast.Name):
        return ""
    if node.id in _FUNCTIONS:
        return f"uses {node.id}"
    if node.id == CLINIC and CLINIC in known.imports.given:
        return USES_THE_CLINIC
    if _INNER.match(node.id):
        return f"reaches for {node.id}"
    if node.id in _BY_NAME and id(node) not in known.called:
        return f"hands on {node.id}"
    is_read = isinstance(node.ctx, ast.Load) and id(node) not in known.read_on
    return f"hands on the module {node.id}" if is_read and node.id in known.imports.modules else ""


def _of_text(value: object) -> str:
    found = _IN_A_TEXT.findall(value) if isinstance(value, str) else []
    inner = next((one for one in found if _INNER.match(one)), "")
    return f"has {inner[:40]} in a text" if inner else ""


def _of_definition(node: ast.AST) -> str:
    """Methods that Python or NumPy call on their own, and patterns that read attributes."""
    names: list[str] = []
    if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
        names = [node.name] if _INNER.match(node.name) else []
    elif isinstance(node, ast.MatchClass):
        refused = _LEVERS | _RUNNERS | _MODULES
        names = [one for one in node.kwd_attrs if one.startswith("_") or one in refused]
    return f"reaches for {names[0]}" if names else ""


def _of_attribute(node: ast.AST, known: _Known) -> str:
    if not isinstance(node, ast.Attribute):
        return ""
    module = known.imports.module_of(node.value)
    if module and not may_use(module, node.attr):
        return f"reaches for {node.attr}"
    if known.imports.module_of(node) in known.imports.whole and id(node) not in known.read_on:
        return f"hands on the module {ast.unparse(node)}"
    if not module and (_INNER.match(node.attr) or node.attr in _MODULES or _is_lever(node, known)):
        return f"reaches for {node.attr}"
    if node.attr in ("__class__", "wraps") and not _is_harmless(node, known):
        return f"reaches for {node.attr}"
    return _of_private(node, known)


def _of_private(node: ast.Attribute, known: _Known) -> str:
    """What begins with an underscore belongs to whoever wrote it: the node itself, here."""
    if not node.attr.startswith("_") or node.attr.endswith("__"):
        return ""
    own = isinstance(node.value, ast.Name) and node.value.id in ("self", "cls")
    return "" if own and node.attr in known.own else f"reaches for {node.attr}"


def _is_lever(node: ast.Attribute, known: _Known) -> bool:
    own = isinstance(node.value, ast.Name) and node.value.id == "self" and node.attr in known.own
    if node.attr in _LEVERS:
        return not own
    if node.attr not in _RUNNERS or own or id(node) in known.context:
        return False
    return known.read_on.get(id(node), "") not in _OF_RUNNERS


def _is_harmless(node: ast.Attribute, known: _Known) -> bool:
    """`functools.wraps(f)`; `self.__class__.__name__`: only a name is read."""
    if node.attr == "wraps":
        return id(node) in known.called
    return _root(node) == "self" and isinstance(node.ctx, ast.Load)


def _of_call(node: ast.AST) -> str:
    if not isinstance(node, ast.Call):
        return ""
    name = getattr(node.func, "id", "") or getattr(node.func, "attr", "")
    if name == "wraps" and len(node.args) + len(node.keywords) != 1:
        return "uses wraps with more than a function"
    if name == "type" and len(node.args) > 1:
        return "makes a class with type"
    if name == "SimpleNamespace" and any(one.arg is None for one in node.keywords):
        return "makes a namespace with names that are made up"
    is_by_name = isinstance(node.func, ast.Name) and name in _BY_NAME - {"wraps"}
    return _of_named(node, name) if is_by_name else ""


def _of_named(node: ast.Call, function: str) -> str:
    of = node.args[0] if node.args else None
    named = _beginning(node.args[1]) if len(node.args) > 1 else ""
    if not named:
        if function == "getattr" and isinstance(of, ast.Name) and of.id == "self":
            return ""  # a node may choose one of its own methods by name; see `inside.careful`
        return f"uses {function} with a name that is made up"
    inner = _INNER.match(named) or named in _MODULES | _LEVERS | _RUNNERS
    return f"reaches for {named}" if inner or named.startswith("__") else ""


def _beginning(name: ast.expr) -> str:
    """A name that is given as text, or how one begins that is made of text: `f"open_{side}"`."""
    if isinstance(name, ast.JoinedStr) and name.values:
        first = _beginning(name.values[0])
        return first if len(first) > 2 and not first.startswith(("_", "f_", "tb_")) else ""
    known = isinstance(name, ast.Constant) and isinstance(name.value, str)
    return str(name.value) if isinstance(name, ast.Constant) and known else ""


def _of_change(node: ast.AST, names: frozenset[str]) -> str:
    """Something that was imported is given other parts."""
    targets: list[ast.expr] = []
    if isinstance(node, (ast.Assign, ast.Delete)):
        targets = node.targets
    elif isinstance(node, (ast.AugAssign, ast.AnnAssign)):
        targets = [node.target]
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        targets = node.args[:1] if node.func.id in ("setattr", "delattr") else []
        targets = [ast.Attribute(one, "", ast.Store()) for one in targets]
    for target in targets:
        if isinstance(target, (ast.Attribute, ast.Subscript)) and _root(target) in names:
            return f"changes {_root(target)}"
        if isinstance(target, ast.Attribute) and re.fullmatch(r"__\w+__", target.attr):
            return f"changes {target.attr}"
    return ""


def _root(node: ast.AST) -> str:
    while isinstance(node, (ast.Attribute, ast.Subscript)):
        node = node.value
    return node.id if isinstance(node, ast.Name) else ""
