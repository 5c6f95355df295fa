"""Answers to 05a, two programs: the text of a setup.py."""

from bank.answer import edited
from bank.workspaces.answer import Answer, right, untried, wrong
from rosbeat.workspace.catching_up import finished

_SETUP = finished("setup.py")
_FIRST = "'temperature_publisher = sensor_simulator.temperature_publisher:main'"
_SECOND = "'temperature_subscriber = sensor_simulator.temperature_subscriber:main'"
_PACKAGES = "packages=find_packages(exclude=['test']),"
_DICT = _SETUP[_SETUP.index("    entry_points=") : _SETUP.rindex(")")]
_NAMES = "('temperature_publisher', 'temperature_subscriber')"
_MANIFEST = "('share/' + package_name, ['package.xml'])"
_DATA = _SETUP[_SETUP.index("    data_files=") : _SETUP.index("    install_requires")]
_DATA_CFG = (
    "printf '[options.data_files]\\nshare/sensor_simulator =\\n  package.xml\\n'"
    " >> src/sensor_simulator/setup.cfg"
)
_CFG = (
    "printf '[options.entry_points]\\nconsole_scripts =\\n"
    "  temperature_publisher = sensor_simulator.temperature_publisher:main\\n"
    "  temperature_subscriber = sensor_simulator.temperature_subscriber:main\\n'"
    " >> src/sensor_simulator/setup.cfg"
)


def _with(*edits: tuple[str, str]) -> str:
    return edited(_SETUP, *edits)


def _given(entry_points: str, before: str = "") -> str:
    """The script with something else behind `entry_points=`, and lines before the call."""
    text = _with((_DICT, f"    entry_points={entry_points},\n"))
    return text.replace("\nsetup(", f"\n{before}\nsetup(", 1)


def _first(name: str, mistakes: str, old: str, new: str) -> Answer:
    """A slip in the first entry."""
    return wrong("05a", name, mistakes, _with((_FIRST, _FIRST.replace(old, new, 1))))


ANSWERS = (
    right("05a", "as on the page", _SETUP),
    right("05a", "double quotes", _with((_FIRST, _FIRST.replace("'", '"')))),
    right("05a", "no blanks around the sign", _with((_FIRST, _FIRST.replace(" = ", "=")))),
    right(
        "05a", "more blanks", _with((_FIRST, _FIRST.replace(" = ", "  =  ").replace(":", " : ")))
    ),
    right("05a", "another order", _with((_FIRST, "'x'"), (_SECOND, _FIRST), ("'x'", _SECOND))),
    right("05a", "no comma at the end", _with((f"{_SECOND},", _SECOND))),
    right("05a", "one line", _given(f"{{'console_scripts': [{_FIRST}, {_SECOND}]}}")),
    right("05a", "tabs and comments", _with((" " * 12 + "'temp", "\t\t\t# mine\n\t\t\t'temp"))),
    right(
        "05a",
        "one more program",
        _with((f"{_FIRST},", f"{_FIRST},\n'more = sensor_simulator.temperature_publisher:main',")),
    ),
    right("05a", "an explicit list", _with((_PACKAGES, "packages=['sensor_simulator'],"))),
    right("05a", "by the name of the package", _with((_PACKAGES, "packages=[package_name],"))),
    right("05a", "find_packages alone", _with((_PACKAGES, "packages=find_packages(),"))),
    right(
        "05a",
        "f-strings",
        _with(
            ("'temperature_p", "f'temperature_p"),
            ("sensor_simulator.temperature_pub", "{package_name}.temperature_pub"),
        ),
    ),
    right(
        "05a",
        "added texts",
        _with(
            (_FIRST, "'temperature_publisher = ' + package_name + '.temperature_publisher:main'")
        ),
    ),
    right(
        "05a",
        "format",
        _with((_FIRST, "'{0} = {1}.{0}:main'.format('temperature_publisher', package_name)")),
    ),
    right(
        "05a",
        "percent",
        _with((_FIRST, "'temperature_publisher = %s.temperature_publisher:main' % package_name")),
    ),
    right("05a", "added lists", _given(f"{{'console_scripts': [{_FIRST}] + [{_SECOND}]}}")),
    right(
        "05a",
        "a variable",
        _given("{'console_scripts': scripts}", f"scripts = [{_FIRST}, {_SECOND}]"),
    ),
    right(
        "05a",
        "a dictionary in a variable",
        _given("programs", f"programs = {{'console_scripts': [{_FIRST}, {_SECOND}]}}"),
    ),
    right(
        "05a",
        "append",
        _given("{'console_scripts': scripts}", f"scripts = [{_FIRST}]\nscripts.append({_SECOND})"),
    ),
    right(
        "05a",
        "one after the other",
        _given(
            "{'console_scripts': scripts}",
            f"scripts = []\nscripts += [{_FIRST}]\nscripts.extend([{_SECOND}])",
        ),
    ),
    right("05a", "dict()", _given(f"dict(console_scripts=[{_FIRST}, {_SECOND}])")),
    right(
        "05a",
        "a comprehension",
        _given(
            f"{{'console_scripts': [f'{{n}} = {{package_name}}.{{n}}:main' for n in {_NAMES}]}}"
        ),
    ),
    right("05a", "a tuple", _given(f"{{'console_scripts': ({_FIRST}, {_SECOND})}}")),
    right(
        "05a",
        "a star",
        _given("{'console_scripts': [*scripts]}", f"scripts = [{_FIRST}, {_SECOND}]"),
    ),
    right(
        "05a",
        "one text",
        _given("'''\n[console_scripts]\n" + f"{_FIRST}\n{_SECOND}\n".replace("'", "") + "'''"),
    ),
    right(
        "05a",
        "everything in a dictionary",
        _with(("setup(\n", "everything = dict(\n")) + "setup(**everything)\n",
    ),
    right(
        "05a",
        "a main",
        _with(
            ("from setuptools import find_packages, setup", "import setuptools"),
            ("\nsetup(", "\nif __name__ == '__main__':\n  setuptools.setup("),
            ("find_packages", "setuptools.find_packages"),
        ),
    ),
    right("05a", "in setup.cfg", _with((_DICT, "")), also=_CFG),
    right(
        "05a",
        "data files by name",
        _with((_MANIFEST, "('share/sensor_simulator', ['package.xml'])")),
    ),
    right(
        "05a",
        "data files with an f",
        _with((_MANIFEST, "(f'share/{package_name}', ['package.xml'])")),
    ),
    right(
        "05a",
        "data files with the library",
        _with(
            (_MANIFEST, "(os.path.join('share', package_name), ['package.xml'])"),
            ("from setuptools", "import os\nfrom setuptools"),
        ),
    ),
    right("05a", "more data files", _with((_MANIFEST, _MANIFEST.replace("]", ", 'LICENSE']")))),
    right(
        "05a",
        "a slash at the end of a folder",
        _with((_MANIFEST, _MANIFEST.replace("e,", "e + '/',"))),
    ),
    right(
        "05a",
        "data files in a variable",
        _with(
            (_DATA, "    data_files=files,\n"),
            ("\nsetup(", f"\nfiles = {_DATA.strip()[11:-1]}\n\nsetup("),
        ),
    ),
    right(
        "05a",
        "data files looked for",
        _with(
            (_MANIFEST, _MANIFEST.replace("['package.xml']", "glob('*.xml')")),
            ("from setuptools", "from glob import glob\nfrom setuptools"),
        ),
    ),
    right(
        "05a",
        "data files as lists",
        _with((_MANIFEST, "['share/' + package_name, ('package.xml',)]")),
    ),
    right("05a", "data files in setup.cfg", _with((_DATA, "")), also=_DATA_CFG),
    right(
        "05a",
        "an update",
        _given("points", f"points = {{}}\npoints['console_scripts'] = [{_FIRST}, {_SECOND}]"),
    ),
    right(
        "05a",
        "two lists in one",
        _given("{'console_scripts': [*one, *two]}", f"one = [{_FIRST}]\ntwo = [{_SECOND}]"),
    ),
    right(
        "05a",
        "joined by name",
        _with(
            (
                _FIRST,
                "'='.join(['temperature_publisher', package_name + '.temperature_publisher:main'])",
            )
        ),
    ),
    wrong(
        "05a",
        "no manifest in data_files",
        "data-files-missing",
        _with((f"        {_MANIFEST},\n", "")),
    ),
    wrong(
        "05a",
        "an empty list of data files",
        "data-files-missing",
        _with((_DATA, "    data_files=[],\n")),
    ),
    wrong("05a", "no data_files", "data-files-missing", _with((_DATA, ""))),
    wrong(
        "05a",
        "no marker in data_files",
        "data-files-missing",
        _with(("['resource/' + package_name]", "[]")),
    ),
    wrong(
        "05a",
        "the manifest in another folder",
        "data-files-missing",
        _with((_MANIFEST, "('share', ['package.xml'])")),
    ),
    wrong(
        "05a",
        "the manifest misspelled",
        "data-files-missing",
        _with(("['package.xml']", "['packages.xml']")),
    ),
    wrong(
        "05a",
        "the subscriber's twice",
        "other-function",
        _with(
            (
                "sensor_simulator.temperature_publisher:main",
                "sensor_simulator.temperature_subscriber:main",
            )
        ),
    ),
    wrong(
        "05a",
        "a dash in the name",
        "executable-misspelled",
        _with(("'temperature_publisher =", "'temperature-publisher =")),
    ),
    wrong("05a", "small console", "group-misspelled", _with(("console_scripts", "console_scrips"))),
    wrong("05a", "only the publisher, twice", "entry-point-missing", _with((_SECOND, _FIRST))),
    untried("05a", "as it was made", _with((f"{_FIRST},", ""), (f"{_SECOND},", ""))),
    untried("05a", "no list at all", _with((_DICT, ""))),
    untried("05a", "blanks", _with((_FIRST, "'____'"), (_SECOND, "'____'"))),
    untried("05a", "no package", _SETUP, also="rm -r src/sensor_simulator"),
    wrong("05a", "no comma", "comma-missing", _with((f"{_FIRST},", _FIRST))),
    wrong(
        "05a",
        "a comma in the text",
        "comma-missing entry-point-target entry-point-form syntax-error",
        _with((f"{_FIRST},", _FIRST.replace("main'", "main,'"))),
    ),
    _first("a slash", "slash-in-module", "simulator.", "simulator/"),
    _first("a file", "entry-point-target", ":main", ".py:main"),
    _first("no function", "entry-point-target", ":main", ""),
    _first("a dot for the colon", "entry-point-target", ":main", ".main"),
    _first("brackets", "entry-point-form", ":main", ":main()"),
    _first("another function", "entry-point-target", ":main", ":start"),
    _first("a capital function", "entry-point-target", ":main", ":Main"),
    _first(
        "a letter in the module",
        "entry-point-target",
        ".temperature_publisher",
        ".temprature_publisher",
    ),
    _first("the module alone", "entry-point-target", "sensor_simulator.", ""),
    _first("the class", "entry-point-target", ":main", ":TemperatureSensor"),
    _first("two signs", "entry-point-form", " = ", " == "),
    _first("a colon for the sign", "entry-point-form", " = ", ": "),
    _first(
        "a blank in the name",
        "entry-point-form",
        "temperature_publisher =",
        "temperature publisher =",
    ),
    _first(
        "a letter in the name",
        "executable-misspelled",
        "temperature_publisher =",
        "temperatur_publisher =",
    ),
    _first(
        "the node's name",
        "executable-misspelled",
        "temperature_publisher =",
        "temperature_sensor =",
    ),
    _first(
        "turned round",
        "entry-point-form entry-point-target",
        _FIRST,
        "'sensor_simulator.temperature_publisher:main = temperature_publisher'",
    ),
    _first("no quote", "syntax-error", "'temp", "temp"),
    wrong("05a", "no bracket", "syntax-error", _with(("        ],\n    },", "    },"))),
    wrong("05a", "one alone", "entry-point-missing", _with((f"{_SECOND},", ""))),
    wrong(
        "05a", "a blank left", "entry-point-form entry-point-missing", _with((_SECOND, "'____'"))
    ),
    wrong(
        "05a",
        "the same module twice",
        "other-function",
        _with(
            (
                "sensor_simulator.temperature_subscriber:main",
                "sensor_simulator.temperature_publisher:main",
            )
        ),
    ),
    wrong(
        "05a",
        "swapped",
        "other-function",
        _with(
            ("temperature_publisher =", "x ="),
            ("temperature_subscriber =", "temperature_publisher ="),
            ("x =", "temperature_subscriber ="),
        ),
    ),
    wrong(
        "05a",
        "a letter in the group",
        "group-misspelled",
        _with(("console_scripts", "console_script")),
    ),
    wrong(
        "05a",
        "a letter in the keyword",
        "group-misspelled",
        _with(("entry_points=", "entry_point=")),
    ),
    wrong("05a", "no packages", "packages-missing", _with((_PACKAGES, "packages=[],"))),
    wrong("05a", "packages left out", "packages-missing", _with((_PACKAGES, ""))),
    wrong(
        "05a",
        "the package excluded",
        "packages-missing",
        _with(("exclude=['test']", "exclude=['test', package_name]")),
    ),
    wrong("05a", "other packages", "packages-missing", _with((_PACKAGES, "packages=['sensor'],"))),
    wrong("05a", "never called", "no-setup-call", _with(("\nsetup(", "\nif False:\n  setup("))),
    wrong(
        "05a",
        "in a function that nobody calls",
        "no-setup-call",
        _with(("\nsetup(", "\ndef install():\n  setup(")),
    ),
    wrong(
        "05a",
        "another name of the package",
        "names-differ",
        _with(("package_name = 'sensor_simulator'", "package_name = 'sensor'")),
    ),
    wrong(
        "05a", "another name in the call", "names-differ", _with(("name=package_name", "name='x'"))
    ),
    wrong(
        "05a",
        "another name, and entries made of it",
        "names-differ",
        _with(
            ("package_name = 'sensor_simulator'", "package_name = 'sensor'"),
            (
                "'temperature_publisher = sensor_simulator",
                "f'temperature_publisher = {package_name}",
            ),
        ),
    ),
    wrong("05a", "no setup", "no-setup-call", "x = 1\n"),
    wrong(
        "05a", "a list", "entry-points-hidden entry-point-form", _given(f"[{_FIRST}, {_SECOND}]")
    ),
    wrong(
        "05a",
        "calculated",
        "entry-points-hidden",
        _given("{'console_scripts': list_of_programs()}"),
    ),
    wrong(
        "05a",
        "no __init__",
        "marker-missing",
        _SETUP,
        also="rm src/sensor_simulator/sensor_simulator/__init__.py",
    ),
    wrong(
        "05a", "no setup.cfg", "marker-missing", _SETUP, also="rm src/sensor_simulator/setup.cfg"
    ),
    wrong(
        "05a",
        "for C++",
        "build-type",
        _SETUP,
        also="sed -i s/ament_python/ament_cmake/ src/sensor_simulator/package.xml",
    ),
    wrong(
        "05a",
        "a node that cannot be read",
        "syntax-error",
        _SETUP,
        also="echo 'def f(:' >> src/sensor_simulator/sensor_simulator/temperature_subscriber.py",
    ),
    wrong(
        "05a",
        "a slash, and no function",
        "slash-in-module entry-point-target",
        _with((_FIRST, _FIRST.replace("r.t", "r/t")), (_SECOND, _SECOND.replace(":main", ""))),
    ),
    wrong(
        "05a",
        "no comma, and a file",
        "comma-missing entry-point-target",
        _with((f"{_FIRST},", _FIRST), (_SECOND, _SECOND.replace(":", ".py:"))),
    ),
)
