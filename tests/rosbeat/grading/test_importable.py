"""What answers may import leads to nothing else: looked at in the real modules."""

import importlib
import pkgutil
import sys
import types
import warnings

import pytest
import rclpy

from rosbeat.grading.importable import is_module, may_import, may_use

STANDARD = [name for name in sorted(sys.stdlib_module_names) if may_import(name)]
INNER = ["collections.abc", "concurrent.futures", "json.decoder", "numpy", "numpy.random"]
OF_ROS = ["rclpy", *(one.name for one in pkgutil.walk_packages(rclpy.__path__, "rclpy."))]


@pytest.mark.parametrize("name", [*STANDARD, *INNER, *filter(may_import, OF_ROS)])
def test_no_name_of_a_module_is_another_module(name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        module = importlib.import_module(name)
    inner = [
        (one, value.__name__)
        for one, value in vars(module).items()
        if isinstance(value, types.ModuleType) and may_use(name, one)
    ]
    wrong = [(one, of) for one, of in inner if not is_module(of) and not of.startswith("rclpy.")]
    assert wrong == []


@pytest.mark.parametrize(
    "name", ["os", "sys.modules", "subprocess", "rclpy.impl", "std_msgs.msg._float32",
             "logging.config", "asyncio.subprocess",
             "numpy.lib", "rosbeat", "ctypes", "rclpy.__main__", ""]
)  # fmt: skip
def test_what_leads_elsewhere_may_not_be_imported(name):
    assert not may_import(name)


@pytest.mark.parametrize(
    ("module", "name"),
    [("math", "sin"), ("datetime", "datetime"), ("time", "time"), ("random", "random"),
     ("collections", "abc"), ("numpy", "array"), ("numpy", "random"), ("rclpy", "time"),
     ("rclpy.node", "Node"), ("functools", "partial"), ("math", "*"), ("std_msgs.msg", "*"),
     ("copy", "copy"), ("threading", "Timer"), ("json", "dumps")],
)  # fmt: skip
def test_what_programs_need_may_be_used(module, name):
    assert may_use(module, name)


@pytest.mark.parametrize(
    ("module", "name"),
    [("enum", "bltns"), ("json", "codecs"), ("re", "enum"), ("operator", "attrgetter"),
     ("functools", "update_wrapper"), ("typing", "get_type_hints"), ("random", "_os"),
     ("rclpy.parameter", "yaml"), ("rclpy.node", "*"), ("numpy", "fromfile"), ("types", "CodeType"),
     ("rclpy.executors", "inspect"), ("string", "Formatter")],
)  # fmt: skip
def test_what_leads_elsewhere_may_not_be_used(module, name):
    assert not may_use(module, name)
