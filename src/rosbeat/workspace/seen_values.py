"""What an expression of a build script is, as far as that can be seen without running it.

Texts, lists and dictionaries are followed through names, additions, f-strings, `format`, `%`,
`join`, stars and simple comprehensions. Whatever else an expression does gives None: not seen.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

#: Fields of a template that only put a text in; others could make a short one very long.
_PLAIN_FIELDS = re.compile(r"(?:[^{}]|\{\w*\}|\{\{|\}\})*")
_PLAIN_PERCENTS = re.compile(r"(?:[^%]|%s|%%)*")
#: Characters of a text, and items of a list: no build script has more.
_LONGEST = 10_000
_LISTS = ("list", "tuple", "sorted", "set")


@dataclass(frozen=True)
class Seen:
    """An expression, and what its names stand for.

    Attributes:
        node: The expression.
        names: What was known where it stands.
    """

    node: ast.expr
    names: Mapping[str, Seen]

    # Each is looked at once: `x = x + x` in thirty lines would be looked at a billion times.
    @cached_property
    def text(self) -> str | None:
        """The text that it makes, or None; a name is not followed."""
        return _text(self)

    @cached_property
    def items(self) -> list[Seen] | None:
        """The items of the list that it makes, or None; a name is not followed."""
        return _items(self)

    @cached_property
    def entries(self) -> dict[str, Seen] | None:
        """The entries of the dictionary that it makes, or None; a name is not followed."""
        return _entries(self)

    def of(self, node: ast.expr) -> Seen:
        """Return a part of the expression: the same names count in it."""
        return followed(Seen(node, self.names))


def followed(seen: Seen) -> Seen:
    """Return what a name stands for, or the expression itself if it is no name that is known."""
    while isinstance(seen.node, ast.Name) and seen.node.id in seen.names:
        seen = seen.names[seen.node.id]
    return seen


def text_of(seen: Seen) -> str | None:
    """Return the text that an expression makes, or None if it is none or cannot be seen."""
    return followed(seen).text


def _text(seen: Seen) -> str | None:
    node = seen.node
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else None
    if isinstance(node, ast.BinOp):
        return _sum(seen, node)
    if isinstance(node, ast.JoinedStr):
        return _joined("", [text_of(seen.of(one)) for one in node.values])
    if isinstance(node, ast.FormattedValue):
        plain = node.conversion < 0 and not node.format_spec
        return text_of(seen.of(node.value)) if plain else None
    return _called(seen, node) if isinstance(node, ast.Call) else None


def _sum(seen: Seen, node: ast.BinOp) -> str | None:
    if isinstance(node.op, ast.Add):
        return _joined("", [text_of(seen.of(one)) for one in (node.left, node.right)])
    template = text_of(seen.of(node.left)) if isinstance(node.op, ast.Mod) else None
    if template is None or not _PLAIN_PERCENTS.fullmatch(template):
        return None
    right = seen.of(node.right)
    parts = right.node.elts if isinstance(right.node, ast.Tuple) else [right.node]
    values = _all([text_of(right.of(one)) for one in parts])
    try:
        return template % tuple(values) if values is not None else None
    except TypeError:  # more fields than values, or fewer
        return None


def _called(seen: Seen, node: ast.Call) -> str | None:
    if not isinstance(node.func, ast.Attribute):
        return None
    own = text_of(seen.of(node.func.value))
    if own is None:
        return None
    if node.func.attr == "join" and len(node.args) == 1:
        items = items_of(seen.of(node.args[0]))
        return None if items is None else _joined(own, [text_of(one) for one in items])
    return _formatted(seen, node, own) if node.func.attr == "format" else None


def _formatted(seen: Seen, node: ast.Call, template: str) -> str | None:
    values = _all([text_of(seen.of(one)) for one in node.args])
    named = {one.arg: text_of(seen.of(one.value)) for one in node.keywords if one.arg}
    if values is None or None in named.values() or not _PLAIN_FIELDS.fullmatch(template):
        return None
    try:
        return template.format(*values, **named)
    except (LookupError, ValueError):
        return None


def _all(texts: list[str | None]) -> list[str] | None:
    known = [text for text in texts if text is not None]
    return known if len(known) == len(texts) else None


def _joined(between: str, texts: list[str | None]) -> str | None:
    known = _all(texts)
    if known is None or sum(map(len, known)) > _LONGEST:
        return None
    return between.join(known)


def items_of(seen: Seen) -> list[Seen] | None:
    """Return the items of a list or tuple, or None if it is none or they cannot all be seen."""
    return followed(seen).items


def _items(seen: Seen) -> list[Seen] | None:
    node = seen.node
    if isinstance(node, ast.List | ast.Tuple):
        return _flat(_star(seen, one) for one in node.elts)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return _flat(items_of(seen.of(one)) for one in (node.left, node.right))
    if isinstance(node, ast.ListComp | ast.GeneratorExp):
        return _comprehended(seen, node)
    if isinstance(node, ast.Call) and len(node.args) == 1 and not node.keywords:
        named = isinstance(node.func, ast.Name) and node.func.id in _LISTS
        return items_of(seen.of(node.args[0])) if named else None
    return None


def _star(seen: Seen, node: ast.expr) -> list[Seen] | None:
    return items_of(seen.of(node.value)) if isinstance(node, ast.Starred) else [seen.of(node)]


def _flat(parts: Iterable[list[Seen] | None]) -> list[Seen] | None:
    found = list(parts)
    known = [one for one in found if one is not None]
    if len(known) < len(found) or sum(map(len, known)) > _LONGEST:
        return None
    return list(chain.from_iterable(known))


def _comprehended(seen: Seen, node: ast.ListComp | ast.GeneratorExp) -> list[Seen] | None:
    """The items of `[... for name in ...]`: one loop over one name, without a condition."""
    loop = node.generators[0]
    if len(node.generators) > 1 or loop.ifs or not isinstance(loop.target, ast.Name):
        return None
    over = items_of(seen.of(loop.iter))
    name = loop.target.id
    if over is None:
        return None
    return [Seen(node.elt, {**seen.names, name: one}) for one in over]


def entries_of(seen: Seen) -> dict[str, Seen] | None:
    """Return the entries of a dictionary, or None if it is none or they cannot all be seen."""
    return followed(seen).entries


def _entries(seen: Seen) -> dict[str, Seen] | None:
    node = seen.node
    if isinstance(node, ast.Dict):
        pairs = zip(node.keys, node.values, strict=True)
        return _merged(_entry(seen, key, value) for key, value in pairs)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
        return _merged(entries_of(seen.of(one)) for one in (node.left, node.right))
    if isinstance(node, ast.Call) and ast.unparse(node.func) == "dict":
        given = [entries_of(seen.of(one)) for one in node.args]
        return _merged([*given, keywords_of(seen, node)])
    return None


def keywords_of(seen: Seen, call: ast.Call) -> dict[str, Seen] | None:
    """Return what a call is given by name, `**more` included, or None if not all can be seen."""
    return _merged(
        {one.arg: seen.of(one.value)} if one.arg else entries_of(seen.of(one.value))
        for one in call.keywords
    )


def _entry(seen: Seen, key: ast.expr | None, value: ast.expr) -> dict[str, Seen] | None:
    if key is None:  # {**more}
        return entries_of(seen.of(value))
    name = text_of(seen.of(key))
    return None if name is None else {name: seen.of(value)}


def _merged(parts: Iterable[dict[str, Seen] | None]) -> dict[str, Seen] | None:
    merged: dict[str, Seen] = {}
    for part in parts:
        if part is None:
            return None
        merged.update(part)
    return merged
