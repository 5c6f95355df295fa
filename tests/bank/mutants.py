"""Wrong answers made mechanically: a program with one small change, in every place and way.

Libraries of mutations exist (mutmut, cosmic-ray). They do not delete or swap statements, hand over
`x` for `self.x`, call a callback or take a call away, which is what learners do, and each of them
would bring a dozen packages into the environment.
"""

import ast
import copy
from collections.abc import Callable, Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class Mutant:
    """A program with one change.

    Attributes:
        line: The line that was changed, counted from 1 in the original.
        before: What stood there.
        after: What stands there now, or what else has become of it.
        text: The program.
    """

    line: int
    before: str
    after: str
    text: str

    @property
    def change(self) -> str:
        """The change and its line, in one line."""
        return f"line {self.line}: `{self.before}` → {self.after}"


#: From a node to others that may stand in its place.
Operator = Callable[[ast.AST], Iterator[ast.AST]]

_COMPARISONS: dict[type, tuple[type, ...]] = {
    ast.Gt: (ast.GtE, ast.Lt),
    ast.GtE: (ast.Gt, ast.LtE),
    ast.Lt: (ast.LtE, ast.Gt),
    ast.LtE: (ast.Lt, ast.GtE),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
}
_ARITHMETIC: dict[type, type] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.And: ast.Or,
    ast.Or: ast.And,
}
#: A statement is shown as far as this, in characters.
_WIDTH = 70
_TWINS = {"max": "min", "min": "max", "Float32": "String", "String": "Float32"}


def mutants(text: str) -> list[Mutant]:
    """Every mutant of a program, each text once, in order of place."""
    tree = ast.parse(text)
    plain = ast.unparse(tree)
    found: dict[str, Mutant] = {}
    for node, changed, after in _changes(tree):
        mutant = ast.unparse(ast.fix_missing_locations(changed))
        if mutant != plain:
            line = getattr(node, "lineno", 0)
            found.setdefault(mutant, Mutant(line, _said(node), after, mutant))
    return sorted(found.values(), key=lambda one: (one.line, one.before, one.after))


def _changes(tree: ast.Module) -> Iterator[tuple[ast.AST, ast.Module, str]]:
    """Each node that is changed, the tree with the change, and what stands in its place."""
    for number, (parent, name, index) in enumerate(_places(tree)):
        node = _at(parent, name, index)
        for operator in OPERATORS:
            for replacement in operator(node):
                changed = copy.deepcopy(tree)
                _put(*_places(changed)[number], copy.deepcopy(replacement))
                yield node, changed, f"`{_said(replacement)}`"
        if isinstance(node, ast.stmt) and index is not None and parent is not tree:
            yield from _moved(tree, number, index)


def _moved(tree: ast.Module, number: int, index: int) -> Iterator[tuple[ast.AST, ast.Module, str]]:
    """A statement gone, and a statement that has changed places with the next."""
    parent, name, _ = _places(tree)[number]
    body = getattr(parent, name)
    gone, swapped = copy.deepcopy(tree), copy.deepcopy(tree)
    _statements(gone, number)[index] = ast.Pass()
    yield body[index], gone, "gone"
    if index + 1 < len(body):
        rest = _statements(swapped, number)
        rest[index : index + 2] = rest[index + 1], rest[index]
        yield body[index], swapped, f"below `{_said(body[index + 1])}`"


def _statements(tree: ast.Module, number: int) -> list[ast.stmt]:
    parent, name, _ = _places(tree)[number]
    found: list[ast.stmt] = getattr(parent, name)
    return found


Place = tuple[ast.AST, str, int | None]


def _places(tree: ast.AST) -> list[Place]:
    """Where each node is: its parent, the field of it, and the index if that is a list."""
    found: list[Place] = []
    for parent in ast.walk(tree):
        for name, value in ast.iter_fields(parent):
            nodes = enumerate(value) if isinstance(value, list) else [(None, value)]
            found += [(parent, name, index) for index, one in nodes if _is_change(parent, one)]
    return found


def _is_change(parent: ast.AST, node: object) -> bool:
    """Whether a change there may matter: the plain words in an f-string are for people."""
    words = isinstance(parent, ast.JoinedStr) and isinstance(node, ast.Constant)
    return isinstance(node, ast.AST) and not words


def _at(parent: ast.AST, name: str, index: int | None) -> ast.AST:
    value = getattr(parent, name)
    found: ast.AST = value if index is None else value[index]
    return found


def _put(parent: ast.AST, name: str, index: int | None, node: ast.AST) -> None:
    if index is None:
        setattr(parent, name, node)
    else:
        getattr(parent, name)[index] = node


# What may stand in a node's place.


def _number(node: ast.AST) -> Iterator[ast.AST]:
    if not isinstance(node, ast.Constant) or type(node.value) not in (int, float):
        return
    value = node.value
    for other in (value + 1, value * 2, value / 2 if isinstance(value, float) else 0):
        yield ast.Constant(other)
    if isinstance(value, float) and value == int(value):
        yield ast.Constant(int(value))


def _word(node: ast.AST) -> Iterator[ast.AST]:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        for other in (node.value[:-1], node.value.swapcase(), f"{node.value} x", ""):
            yield ast.Constant(other)


def _comparison(node: ast.AST) -> Iterator[ast.AST]:
    if isinstance(node, ast.Compare):
        for other in _COMPARISONS.get(type(node.ops[0]), ()):
            yield ast.Compare(node.left, [other(), *node.ops[1:]], node.comparators)


def _operator(node: ast.AST) -> Iterator[ast.AST]:
    if isinstance(node, ast.BinOp) and type(node.op) in _ARITHMETIC:
        yield ast.BinOp(node.left, _ARITHMETIC[type(node.op)](), node.right)
        yield node.left
    if isinstance(node, ast.AugAssign):
        yield ast.Assign([node.target], node.value, lineno=node.lineno)
        yield ast.AugAssign(node.target, _ARITHMETIC[type(node.op)](), node.value)
    if isinstance(node, ast.UnaryOp):
        yield node.operand


def _logic(node: ast.AST) -> Iterator[ast.AST]:
    if isinstance(node, ast.BoolOp):
        yield ast.BoolOp(_ARITHMETIC[type(node.op)](), node.values)
        yield from node.values
    if isinstance(node, ast.If | ast.While):
        for test in (ast.Constant(True), ast.Constant(False)):
            yield type(node)(test, node.body, node.orelse)
        if node.orelse:
            yield type(node)(node.test, node.body, [])


def _call(node: ast.AST) -> Iterator[ast.AST]:
    if not isinstance(node, ast.Call):
        return
    args, keywords = node.args, node.keywords
    yield from args[:1]
    yield from (one.value for one in keywords[:1])
    yield node.func
    for n in range(len(args)):
        yield ast.Call(node.func, args[:n] + args[n + 1 :], keywords)
    for n in range(len(args) - 1):
        yield ast.Call(node.func, [*args[:n], args[n + 1], args[n], *args[n + 2 :]], keywords)
    for n, one in enumerate(keywords):
        others = keywords[:n] + keywords[n + 1 :]
        yield ast.Call(node.func, args, others)
        yield ast.Call(node.func, args, [*others, ast.keyword(f"{one.arg}x", one.value)])


def _name(node: ast.AST) -> Iterator[ast.AST]:
    if isinstance(node, ast.Name) and node.id in _TWINS:
        yield ast.Name(_TWINS[node.id], node.ctx)
    if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Load):
        if isinstance(node.value, ast.Name) and node.value.id == "self":
            yield ast.Name(node.attr, node.ctx)
            yield ast.Call(node, [], [])
        yield ast.Attribute(node.value, f"{node.attr}x", node.ctx)


def _flow(node: ast.AST) -> Iterator[ast.AST]:
    if isinstance(node, ast.Return) and node.value is not None:
        yield ast.Return(None)
    if isinstance(node, ast.Break):
        yield ast.Continue()
    if isinstance(node, ast.Slice):
        yield ast.Slice(None, None, None)
        yield ast.Slice(node.upper, node.lower, None)


def _signature(node: ast.AST) -> Iterator[ast.AST]:
    if isinstance(node, ast.FunctionDef):
        names = node.args.args
        for arguments in (names[1:], names[:-1], [*names, ast.arg("other")]):
            changed = copy.deepcopy(node)
            changed.args.args = arguments
            yield changed
        changed = copy.deepcopy(node)
        changed.name = f"{node.name}x"
        yield changed


OPERATORS: tuple[Operator, ...] = (
    *(_number, _word, _comparison, _operator, _logic),
    *(_call, _name, _flow, _signature),
)


def _said(node: ast.AST) -> str:
    text = ast.unparse(ast.fix_missing_locations(copy.deepcopy(node)))
    first = text.splitlines()[0]
    return first if len(first) <= _WIDTH else f"{first[: _WIDTH - 3]}..."
