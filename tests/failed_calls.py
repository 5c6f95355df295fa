"""Failed calls written shortly: `create_subscription(message_type[Float32], method[cb(self)])`."""

import ast

from rosbeat.records import Argument, FailedCall


def failed_call(text):
    """Return the call that a short text stands for; None for an empty one."""
    if not text:
        return None
    call = ast.parse(text, mode="eval").body
    return FailedCall(
        ast.unparse(call.func),
        tuple(_argument(one) for one in call.args),
        {one.arg: _argument(one.value) for one in call.keywords},
    )


def _argument(node):
    if not isinstance(node, ast.Subscript):
        return Argument(ast.unparse(node))
    kind, what = ast.unparse(node.value), node.slice
    if isinstance(what, ast.Call):
        names = tuple(ast.unparse(one) for one in what.args)
        return Argument(kind, ast.unparse(what.func), names)
    return Argument(kind, ast.unparse(what))
