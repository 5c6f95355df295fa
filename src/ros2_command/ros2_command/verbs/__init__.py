"""Implement the commands, one module each, with its verbs in `VERBS`; `registry` lists them all."""
