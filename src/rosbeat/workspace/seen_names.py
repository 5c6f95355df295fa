"""What the names of a module stand for, statement by statement, and which calls are reached."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from rosbeat.workspace.seen_values import Seen

_Names = dict[str, Seen]


def reached(tree: ast.Module, name: str) -> Seen | None:
    """Return the first call of a function that running a module would reach, or None.

    Args:
        tree: The module.
        name: What the function is called, with or without a module in front.

    Returns:
        The call, and what names stand for there. A name that is changed in a way that cannot be
        followed stands for nothing.
    """
    called = {ast.unparse(one.func) for one in ast.walk(tree) if isinstance(one, ast.Call)}
    return next(_calls(tree.body, {}, name, called), None)


def _calls(body: list[ast.stmt], names: _Names, name: str, called: set[str]) -> Iterator[Seen]:
    for statement in body:
        yield from _own_calls(statement, names, name)
        for inner in _inner(statement, called):
            yield from _calls(inner, names, name, called)
        _learn(statement, names)


def _own_calls(statement: ast.stmt, names: _Names, name: str) -> Iterator[Seen]:
    if not isinstance(statement, ast.Expr | ast.Assign | ast.Return):
        return
    for node in ast.walk(statement):
        if isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] == name:
            yield Seen(node, dict(names))


def _inner(statement: ast.stmt, called: set[str]) -> Iterator[list[ast.stmt]]:
    """The statements inside of a statement that may run."""
    if isinstance(statement, ast.FunctionDef):
        if statement.name in called:
            yield statement.body
    elif isinstance(statement, ast.If):
        yield from _branches(statement)
    elif isinstance(statement, ast.Try):
        yield from (statement.body, statement.orelse, statement.finalbody)
    elif isinstance(statement, ast.With | ast.For | ast.While):
        yield statement.body


def _branches(statement: ast.If) -> Iterator[list[ast.stmt]]:
    known = isinstance(statement.test, ast.Constant)
    value = bool(statement.test.value) if isinstance(statement.test, ast.Constant) else True
    if value or not known:
        yield statement.body
    if not value or not known:
        yield statement.orelse


def _learn(statement: ast.stmt, names: _Names) -> None:
    """Write down what a statement does to names."""
    if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
        _assign(statement.targets[0], statement.value, names)
    elif isinstance(statement, ast.AnnAssign) and statement.value:
        _assign(statement.target, statement.value, names)
    elif isinstance(statement, ast.AugAssign) and isinstance(statement.target, ast.Name):
        _add(statement.target.id, statement.op, statement.value, names)
    elif isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
        _method(statement.value, names)
    else:
        _forget(statement, names)


def _assign(target: ast.expr, value: ast.expr, names: _Names) -> None:
    if isinstance(target, ast.Name):
        names[target.id] = Seen(value, dict(names))
    elif isinstance(target, ast.Subscript) and isinstance(target.value, ast.Name):
        more = ast.Dict(keys=[target.slice], values=[value])
        _add(target.value.id, ast.BitOr(), more, names)
    else:
        _forget(target, names)


def _add(name: str, how: ast.operator, value: ast.expr, names: _Names) -> None:
    old = ast.Name(id=name, ctx=ast.Load())
    names[name] = Seen(ast.BinOp(left=old, op=how, right=value), dict(names))


def _method(call: ast.Call, names: _Names) -> None:
    """`names.append(...)` and `names.extend(...)`; another method may change anything."""
    function = call.func
    if not isinstance(function, ast.Attribute) or not isinstance(function.value, ast.Name):
        return
    name = function.value.id
    if name in names and function.attr == "append" and len(call.args) == 1:
        _add(name, ast.Add(), ast.List(elts=call.args, ctx=ast.Load()), names)
    elif name in names and function.attr == "extend" and len(call.args) == 1:
        _add(name, ast.Add(), call.args[0], names)
    elif name in names and function.attr == "update" and len(call.args) == 1:
        _add(name, ast.BitOr(), call.args[0], names)
    else:
        names.pop(name, None)


def _forget(inside: ast.AST, names: _Names) -> None:
    """Forget every name that something might change."""
    if isinstance(inside, ast.FunctionDef | ast.ClassDef):
        names.pop(inside.name, None)
        return
    for node in ast.walk(inside):
        owner = node.value if isinstance(node, ast.Attribute | ast.Subscript) else node
        changed = owner is not node or isinstance(getattr(node, "ctx", None), ast.Store)
        if isinstance(owner, ast.Name) and changed:
            names.pop(owner.id, None)
