import ast

import pytest

from rosbeat.grading.imports import imports_in, refused_import

PAGE = ast.parse("import random\nfrom rosbeat import Session, check")


def imports(text):
    return imports_in(ast.parse(text), PAGE)


def refused(text):
    return refused_import(ast.parse(text).body[0], imports(text))


def test_names_and_modules():
    found = imports(
        "import numpy as np\nfrom collections import abc\nfrom std_msgs.msg import Bool"
    )
    assert found.names == {"random", "Session", "check", "np", "abc"}
    assert dict(found.modules) == {"random": "random", "np": "numpy", "abc": "collections.abc"}
    assert found.given == {"Session", "check"}


@pytest.mark.parametrize(
    ("text", "module"),
    [("np", "numpy"), ("np.random", "numpy.random"), ("np.random.uniform", ""),
     ("other.random", ""), ("random", "random"), ("f().random", "")],
)  # fmt: skip
def test_which_module_an_expression_is(text, module):
    found = imports("import numpy as np")
    assert found.module_of(ast.parse(text, mode="eval").body) == module


@pytest.mark.parametrize(
    ("text", "said"),
    [("import os", "imports os"), ("import math, os.path", "imports os.path"),
     ("from random import _os", "imports _os"), ("from . import x", "imports ."),
     ("from rosbeat import Session", ""), ("from rosbeat import grading", "imports rosbeat"),
     ("from rclpy.node import *", "imports *"), ("from std_msgs.msg import *", ""),
     ("x = 1", ""), ("import sys", "")],
)  # fmt: skip
def test_imports_that_are_looked_at(text, said):
    assert refused(text) == said
