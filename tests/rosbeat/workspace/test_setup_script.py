import sys
from types import ModuleType

import pytest

from bank.workspaces import entries
from rosbeat.workspace.setup_script import SetupScript, parse_setup, read_setup
from rosbeat.workspace.stages import finished

HEAD = "from setuptools import setup\npackage_name = 'p'\nsetup(name=package_name, entry_points={\n"


@pytest.fixture
def read(tmp_path):
    def read(text):
        path = tmp_path / "setup.py"
        path.write_text(text)
        return read_setup(path)

    return read


def scripts(*lines):
    return HEAD + "'console_scripts': [\n" + "\n".join(lines) + "\n]})\n"


def test_the_finished_one(read):
    setup = read(finished("setup.py"))
    assert setup.package_name == "sensor_simulator"
    names = [one.executable for one in setup.entry_points]
    assert names == ["temperature_publisher", "temperature_subscriber"]
    first = setup.entry_points[0]
    assert (first.module, first.function) == ("sensor_simulator.temperature_publisher", "main")
    line = finished("setup.py").splitlines()[first.line - 1]
    assert first.text in line
    assert "]" in finished("setup.py").splitlines()[setup.end_of_scripts - 1]


def test_a_missing_comma_joins_two(read):
    setup = read(scripts("'a = p.a:main'", "'b = p.b:main',"))
    (joined,) = setup.entry_points
    assert joined.joined
    assert joined.line == 5


def test_one_text_in_two_parts_is_no_missing_comma(read):
    (one,) = read(scripts("'a = '", "'p.a:main',")).entry_points
    assert not one.joined
    assert one.module == "p.a"


@pytest.mark.parametrize(
    "text", ["f'a = {package_name}.a:main'", "'a = ' + package_name + '.a:main'"]
)
def test_texts_that_are_put_together(read, text):
    assert read(scripts(text)).entry_points[0].module == "p.a"


def test_a_part_is_absent(read):
    (one, two) = read(scripts("'a = p.a',", "'b',")).entry_points
    assert (one.module, one.function) == ("p.a", "")
    assert (two.executable, two.module) == ("b", "")


@pytest.mark.parametrize(
    "rest", ["})", "'other': []})", "'console_scripts': names()})", "**more})"]
)
def test_no_list_of_scripts(read, rest):
    setup = read(HEAD + rest)
    assert setup.entry_points == ()
    assert setup.incomplete == (rest in ("'console_scripts': names()})", "**more})"))
    assert setup.end_of_scripts == 0
    assert setup.problem == ""


@pytest.mark.parametrize(
    ("text", "line"),
    [(HEAD, 3), ("x = 'a\n", 1), ("x = 1\n", 0), ("", 0), ("\0", 0), ("(" * 500, 1)],
)
def test_a_bad_one_has_a_problem(read, text, line):
    setup = read(text)
    assert setup.problem
    assert setup.line in (line, 0) or text.startswith("(")
    assert setup == SetupScript(problem=setup.problem, line=setup.line)


def test_it_is_never_run(read):
    assert read("raise SystemExit(3)\n" + scripts("'a = p.a:main'")).entry_points


def test_a_tuple_is_read_and_is_no_list(read):
    setup = read(HEAD + "'console_scripts': ('a = p.a:main',)})\n")
    assert [one.executable for one in setup.entry_points] == ["a"]
    assert (setup.end_of_scripts, setup.incomplete) == (0, False)


@pytest.mark.parametrize(
    "item",
    ["'{} = p.a:main'.format(name()),", "'%d = p.a:main' % 'a',", "*others,", "unknown,",
     "f'{package_name!r} = p.a:main',", "f'{package_name:>9} = p.a:main',", "'a = ' + name(),"],
)  # fmt: skip
def test_what_cannot_be_seen_is_not_guessed(read, item):
    setup = read(scripts(item, "'b = p.b:main',"))
    assert [one.executable for one in setup.entry_points] == ["b"]
    assert setup.incomplete


@pytest.mark.parametrize(
    "given", ["entry_points={**more}", "entry_points={}, **more", "entry_points=names"]
)
def test_keys_that_cannot_be_seen(read, given):
    assert read(f"from setuptools import setup\nsetup({given})\n").incomplete


def test_two_equals_signs_are_no_missing_comma(read):
    for text in ("'a == b:c'", "'a = b = c:d'"):
        assert not read(scripts(text)).entry_points[0].joined
    assert read(scripts("'a = p.a:main'", "'b == p.b:main',")).entry_points[0].joined


def test_the_group_for_windows_makes_programs_too(read):
    text = scripts("'a = p.a:main'").replace("console_scripts", "gui_scripts")
    assert [one.executable for one in read(text).entry_points] == ["a"]


@pytest.mark.parametrize(
    ("given", "installed"),
    [
        ("packages=find_packages()", True),
        ("packages=find_packages(exclude=['test'])", True),
        ("packages=find_packages('.', exclude=['p*'])", False),
        ("packages=find_packages(include=['p', 'p.*'])", True),
        ("packages=find_packages(include=['q'])", False),
        ("packages=find_packages(where='src')", False),
        ("packages=find_packages(exclude=unknown())", True),
        ("packages=['p']", True),
        ("packages=['q']", False),
        ("packages=[]", False),
        ("packages=unknown()", True),
        ("", False),
        ("**unknown()", True),
    ],
)
def test_whether_the_code_is_installed(read, given, installed):
    assert read(f"from setuptools import *\nsetup({given})\n").installs("p") == installed


@pytest.mark.parametrize(
    ("given", "found"),
    [
        ("entry_point={}", "entry_point"),
        ("entry_points={'console_script': []}", "console_script"),
        ("entry_points={'console_scripts': []}", ""),
        ("entry_points={'pytest11': []}", ""),
        ("name='p'", ""),
    ],
)
def test_entries_where_nobody_looks(read, given, found):
    assert read(f"setup({given})").misspelled_group == found


def executed(text, monkeypatch):
    """What a build script hands to setuptools when it is run: its console scripts, as texts."""
    given = {}
    fake = ModuleType("setuptools")
    fake.setup, fake.find_packages = given.update, lambda *_, **__: []
    monkeypatch.setitem(sys.modules, "setuptools", fake)
    exec(compile(text, "setup.py", "exec", dont_inherit=True), {"__name__": "__main__"})
    found = given.get("entry_points", {})
    return list(found["console_scripts"]) if isinstance(found, dict) and found else []


@pytest.mark.parametrize(
    "answer",
    [one for one in entries.ANSWERS if one.status == "passed" and "'''" not in one.given],
    ids=lambda one: one.name,
)
def test_what_is_seen_is_what_a_run_gives(read, answer, monkeypatch):
    setup = read(answer.given)
    assert not setup.incomplete
    assert [one.text for one in setup.entry_points] == executed(answer.given, monkeypatch)


@pytest.mark.parametrize("start", ["'a = p.a:main'", "['a = p.a:main']"])
def test_what_doubles_in_every_line_is_given_up(read, start):
    text = f"x = {start}\n" + "x = x + x\n" * 100
    setup = read(text + "setup(entry_points={'console_scripts': [*x, x]})\n")
    assert setup.incomplete


def test_a_dictionary_that_is_added_to_itself(read):
    text = "x = {'console_scripts': ['a = p.a:main']}\n" + "x = x | x\n" * 100
    setup = read(text + "setup(entry_points=x)\n")
    assert [one.executable for one in setup.entry_points] == ["a"]


def test_the_line_of_a_problem_is_told_once():
    script = parse_setup(b'setup(name="a)\n')
    assert script.line == 1
    assert script.problem.startswith("unterminated string literal")
    assert "detected" not in script.problem
