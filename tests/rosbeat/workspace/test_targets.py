import pytest

from rosbeat.workspace.setup_script import EntryPoint
from rosbeat.workspace.targets import flaw_of, top_level_names

NAME = "sensor_simulator.temperature_publisher"


def entry(target, executable="sensor"):
    module, _, function = target.partition(":")
    return EntryPoint(f"{executable} = {target}", 26, executable, module, function)


@pytest.mark.parametrize(
    ("target", "kind", "right"),
    [
        (f"{NAME}:main", None, ""),
        (f"{NAME}:TemperatureSensor", None, ""),
        (f"{NAME}:maine", "no-function", "main"),
        (f"{NAME}", "no-function-part", "main"),
        (f"{NAME}.py:main", "suffix", NAME),
        (f"{NAME}:main()", "called", "main"),
        ("sensor_simulator/temperature_publisher:main", "slash", NAME),
        ("sensor_simulator.temprature_publisher:main", "no-module", NAME),
        ("temperature_publisher:main", "no-module", NAME),
        ("nothing.like_it:main", "no-module", ""),
    ],
)
def test_each_flaw_is_named(package, target, kind, right):
    flaw = flaw_of(entry(target), package)
    assert (flaw.kind if flaw else None) == kind
    assert flaw is None or flaw.right == right


def test_a_name_that_cannot_be_typed(package):
    assert flaw_of(entry(f"{NAME}:main", "my sensor"), package).kind == "bad-name"


def test_no_equals_sign(package):
    assert flaw_of(EntryPoint("sensor", 3, "sensor", "", ""), package).kind == "no-equals"


def test_a_module_with_a_syntax_error(package):
    path = package / "sensor_simulator" / "temperature_publisher.py"
    path.write_text("x = 1\ndef f(:\n    pass\n")
    flaw = flaw_of(entry(f"{NAME}:main"), package)
    assert (flaw.kind, flaw.line) == ("syntax-error", 2)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("def main(): pass", ["main"]),
        ("main = lambda: 0", ["main"]),
        ("from a import main as start", ["start"]),
        ("if True:\n    def main(): pass", ["main"]),
        ("from a import *", None),
        ("", []),
    ],
)
def test_names_of_a_module(tmp_path, text, names):
    (tmp_path / "a.py").write_text(text)
    assert top_level_names(tmp_path / "a.py") == (names, 0)


@pytest.mark.parametrize(("text", "line"), [("return 3", 1), ("x = 1\n  y = 2", 2)])
def test_what_python_cannot_compile(tmp_path, text, line):
    (tmp_path / "a.py").write_text(text)
    assert top_level_names(tmp_path / "a.py") == ([], line)


def test_more_than_one_equals_sign(package):
    text = f"sensor == {NAME}:main"
    assert flaw_of(EntryPoint(text, 3, "sensor", f"= {NAME}", "main"), package).kind == "two-equals"
    text = f"sensor = {NAME}:main [a==1]"
    assert flaw_of(EntryPoint(text, 3, "sensor", NAME, "main"), package) is None
