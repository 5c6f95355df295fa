"""Terminals in a page: a real bash on a pseudo-terminal, typed into by cells."""

from rosbeat.workspace.terminals.terminal import Terminal, Terminals, terminal, terminals_of

__all__ = ["Terminal", "Terminals", "terminal", "terminals_of"]
