"""Bring the names of the course to a page, each when a cell first mentions it.

They are values of the page's namespace, since Python looks nowhere else that a file of the
workspace would not see, too, and IPython's list of hidden names keeps them out of `%who`. A name
that the learner has defined stays the learner's.
"""

from __future__ import annotations

import re
import symtable
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

_WORD = re.compile(r"\w+")
#: The first word of a cell that becomes a file, which imports what it uses.
_SAVES = "%%save"
_MARK = "_rosbeat_names"


def register(shell: InteractiveShell, names: Iterable[str], load: Callable[[str], Any]) -> None:
    """Bring the names of the course to a shell; a second time changes nothing.

    Args:
        shell: The running shell.
        names: What its pages can use without an import.
        load: Returns what a name stands for.
    """
    if not names_of(shell):
        setattr(shell, _MARK, {name: partial(load, name) for name in names})
        shell.events.register("pre_run_cell", lambda info: bring(shell, str(info.raw_cell)))


def names_of(shell: InteractiveShell) -> Mapping[str, Callable[[], Any]]:
    """Return the names that the course brings to a shell, each with what loads it.

    Args:
        shell: The page's shell.
    """
    names: Mapping[str, Callable[[], Any]] = getattr(shell, _MARK, {})
    return names


def bring(shell: InteractiveShell, code: str) -> None:
    """Define the names of the course that code mentions, unless somebody has.

    Args:
        shell: The page's shell.
        code: The code of a cell; of one that saves a file, nothing is defined.
    """
    if not code.startswith(_SAVES):
        for name in {*_WORD.findall(code)} & names_of(shell).keys() - shell.user_ns.keys():
            shell.push({name: names_of(shell)[name]()}, interactive=False)


def learners_names(shell: InteractiveShell) -> list[str]:
    """Return the names that cells of the page have defined.

    Args:
        shell: The page's shell.
    """
    hidden, names = shell.user_ns_hidden, shell.user_ns
    return [
        name
        for name, value in names.items()
        if not name.startswith("_") and not (name in hidden and hidden[name] is value)
    ]


@contextmanager
def without_names(shell: InteractiveShell) -> Iterator[None]:
    """Take the names of the course from a page while the text of a file runs on it.

    Args:
        shell: The page's shell.
    """
    own = set(learners_names(shell))
    taken = {
        name: shell.user_ns.pop(name)
        for name in names_of(shell).keys() - own
        if name in shell.user_ns
    }
    try:
        yield
    finally:
        for name, value in taken.items():
            shell.user_ns.setdefault(name, value)


def names_bound(source: str) -> frozenset[str]:
    """Return the names that Python code binds at its top level; none if it cannot be read.

    Args:
        source: The code.
    """
    table = _table(source)
    return _bound(table) if table else frozenset()


def names_relied_on(shell: InteractiveShell, source: str) -> list[str]:
    """Return the names of the course that a file uses without defining or importing them.

    Args:
        shell: The shell of the page that saves the file.
        source: The file's text.
    """
    table = _table(source)
    if table is None or any(symbol.get_name() == "*" for symbol in table.get_symbols()):
        return []
    return sorted((_used(table) & names_of(shell).keys()) - _bound(table))


def _table(source: str) -> symtable.SymbolTable | None:
    try:
        return symtable.symtable(source, "<cell>", "exec")
    except (SyntaxError, ValueError, RecursionError):
        return None


def _bound(table: symtable.SymbolTable) -> frozenset[str]:
    return frozenset(
        symbol.get_name()
        for symbol in table.get_symbols()
        if symbol.is_assigned() or symbol.is_imported()
    )


def _used(table: symtable.SymbolTable) -> set[str]:
    """Return the names that code looks up in its module, in functions and classes, too."""
    is_top = table.get_type() == "module"
    used: set[Any] = {
        symbol.get_name()
        for symbol in table.get_symbols()
        if symbol.is_referenced() and (is_top or symbol.is_global())
    }
    return used.union(*map(_used, table.get_children()))
