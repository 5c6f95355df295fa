# ruff: noqa: E501
"""Answers to pages 01, 02 and 05, written by somebody who had seen the pages and no judge."""

from bank.answer import edited
from bank.workspaces.answer import Answer, right, untried, wrong
from rosbeat.workspace.catching_up import finished

_DEF = "def entry_point(executable, package, module, function='main'):\n    "
_SETUP = finished("setup.py")
_XML = finished("package.xml")
_FIRST = "'temperature_publisher = sensor_simulator.temperature_publisher:main'"
_SECOND = "'temperature_subscriber = sensor_simulator.temperature_subscriber:main'"
_ENTRIES = f"            {_FIRST},\n            {_SECOND},\n"
_LICENSE = "<license>Apache-2.0</license>"
_TEXT = "A simulated temperature sensor and a monitor that judges its readings."


def _setup(*edits: tuple[str, str]) -> str:
    return edited(_SETUP, *edits)


def _xml(*edits: tuple[str, str]) -> str:
    return edited(_XML, *edits)


_FOLDERS = (
    right(
        "01a",
        "blind: one folder after the other, with cd",
        "mkdir -p resources\ncd resources\nmkdir -p sounds\ncd sounds\nmkdir -p alarm",
    ),
    right("01a", "blind: a variable", 'PLACE=resources/sounds\nmkdir -p "$PLACE/alarm"'),
    right(
        "01a",
        "blind: a loop",
        "for d in resources resources/sounds resources/sounds/alarm; do [ -d $d ] || mkdir $d; done",
    ),
    right("01a", "blind: the option at the end", "mkdir resources/sounds/alarm -p"),
    right(
        "01a",
        "blind: pathlib",
        "python3 -c \"from pathlib import Path; Path('resources/sounds/alarm').mkdir(parents=True)\"",
    ),
    # Without -p.
    wrong("01a", "blind: no -p", "parents-missing", "mkdir resources/sounds/alarm"),
    # One letter less.
    wrong("01a", "blind: sound", "path-misspelled", "mkdir -p resources/sound/alarm"),
    # All three beside each other.
    wrong(
        "01a",
        "blind: three beside each other",
        "folders-side-by-side",
        "mkdir -p resources sounds alarm",
    ),
    # A slash in front.
    wrong(
        "01a",
        "blind: sounds in the workspace",
        "path-misspelled levels-miscounted new-to-me wrong-folder",
        "mkdir -p sounds/alarm",
    ),
    # The command's name.
    wrong("01a", "blind: mkdri", "command-misspelled", "mkdri -p resources/sounds/alarm"),
    # Below the folder images, because one stood there.
    wrong(
        "01a",
        "blind: in images",
        "wrong-folder levels-miscounted",
        "cd resources/images\nmkdir -p resources/sounds/alarm",
    ),
    right("01b", "blind: through the workspace, with a slash at the end", "cd ../../src/"),
    right("01b", "blind: with dots", "cd ./../../src/."),
    right("01b", "blind: a detour by docs", "cd ../../docs/../src"),
    right("01b", "blind: looks first", "ls ../..\ncd ../../src\npwd"),
    # One level.
    wrong("01b", "blind: one level", "levels-miscounted", "cd ../src"),
    # Three levels.
    wrong("01b", "blind: three levels", "levels-miscounted", "cd ../../../src"),
    # As if it stood in the workspace.
    wrong("01b", "blind: src", "levels-miscounted folder-not-found", "cd src"),
    # No blank.
    wrong("01b", "blind: no blank", "space-missing", "cd../../src"),
    # Absolute.
    wrong("01b", "blind: absolute", "absolute-path", 'cd "$ROS2_WORKSPACE/src"'),
    # Into the sibling.
    wrong("01b", "blind: docs", "wrong-folder path-misspelled new-to-me", "cd ../../docs"),
)

_PACKAGES = (
    right("02a", "blind: MIT", _xml((_LICENSE, "<license>MIT</license>"))),
    right(
        "02a",
        "blind: two licences",
        _xml((_LICENSE, f"{_LICENSE}\n  <license>BSD-3-Clause</license>")),
    ),
    right(
        "02a",
        "blind: a text of several lines",
        _xml((_TEXT, "\n    A sensor.\n    And a monitor &amp; its limits.\n  ")),
    ),
    right(
        "02a",
        "blind: a real maintainer and an author",
        _xml(
            (
                '<maintainer email="you@example.com">you</maintainer>',
                '<maintainer email="ana.b@uni.example.org">Ana B.</maintainer>\n  <author>Ben</author>',
            )
        ),
    ),
    right(
        "02a",
        "blind: a remark of one's own",
        _xml((_LICENSE, f"<!-- chosen on page 02 -->\n  {_LICENSE}")),
    ),
    right("02a", "blind: German", _xml((_TEXT, "Ein Temperaturfühler für die Küche"))),
    # The blank is left in one place.
    wrong(
        "02a",
        "blind: TODO stays",
        "manifest-open",
        _xml((_LICENSE, "<license>TODO: License declaration</license>")),
    ),
    # An empty description.
    wrong("02a", "blind: empty", "manifest-open manifest-value", _xml((_TEXT, ""))),
    # British spelling.
    wrong(
        "02a", "blind: licence", "tag-misspelled", _xml((_LICENSE, "<licence>Apache-2.0</licence>"))
    ),
    # The closing tag lost.
    wrong(
        "02a", "blind: not closed", "manifest-unreadable", _xml((_LICENSE, "<license>Apache-2.0"))
    ),
    # & alone.
    wrong("02a", "blind: &", "manifest-unreadable", _xml((_TEXT, "Sensor & monitor"))),
    right(
        "02b",
        "blind: options in another order",
        "cd src\nros2 pkg create room_display --dependencies rclpy sensor_msgs --build-type ament_python",
    ),
    right(
        "02b",
        "blind: with a licence",
        "cd src\nros2 pkg create --build-type=ament_python --license MIT room_display --dependencies sensor_msgs rclpy",
    ),
    # std_msgs as above.
    wrong(
        "02b",
        "blind: std_msgs",
        "dependency-missing",
        "cd src\nros2 pkg create --build-type ament_python room_display --dependencies rclpy std_msgs",
    ),
    # In the workspace.
    wrong(
        "02b",
        "blind: not in src",
        "wrong-folder",
        "ros2 pkg create --build-type ament_python room_display --dependencies rclpy sensor_msgs",
    ),
    # A dash.
    untried(
        "02b",
        "blind: a dash",
        "cd src\nros2 pkg create --build-type ament_python room-display --dependencies rclpy sensor_msgs",
    ),
    # Only one of the two.
    wrong(
        "02b",
        "blind: rclpy only",
        "dependency-missing",
        "cd src\nros2 pkg create --build-type ament_python room_display --dependencies rclpy",
    ),
    # A comma.
    untried(
        "02b",
        "blind: a comma",
        "cd src\nros2 pkg create --build-type ament_python room_display --dependencies rclpy, sensor_msgs",
    ),
)

_PROGRAMS = (
    right(
        "05a",
        "blind: a loop in a list",
        _setup(
            (
                f"[\n{_ENTRIES}        ]",
                "[f'temperature_{x} = sensor_simulator.temperature_{x}:main' for x in ('publisher', 'subscriber')]",
            )
        ),
    ),
    right(
        "05a",
        "blind: f-strings with package_name",
        _setup(
            (_FIRST, "f'temperature_publisher = {package_name}.temperature_publisher:main'"),
            (_SECOND, "f'temperature_subscriber = {package_name}.temperature_subscriber:main'"),
        ),
    ),
    right(
        "05a",
        "blind: no blanks, no last comma",
        _setup(
            (
                _ENTRIES,
                f"            {_FIRST.replace(' ', '')},\n            {_SECOND.replace(' ', '')}\n",
            )
        ),
    ),
    right(
        "05a",
        "blind: a third one",
        _setup(
            (
                _SECOND,
                f"{_SECOND},\n            'sensor = sensor_simulator.temperature_publisher:main'",
            )
        ),
    ),
    right(
        "05a",
        "blind: a function of one's own",
        _setup(
            (
                "setup(\n",
                "def entry(name):\n    return name + ' = ' + package_name + '.' + name + ':main'\n\n\nsetup(\n",
            ),
            (_FIRST, "entry('temperature_publisher')"),
            (_SECOND, "entry('temperature_subscriber')"),
        ),
    ),
    right(
        "05a",
        "blind: a dict of keywords",
        _setup(("setup(\n", "settings = dict(\n")) + "setup(**settings)\n",
    ),
    # A comma is missing.
    wrong("05a", "blind: no comma", "comma-missing", _setup((f"{_FIRST},", _FIRST))),
    # .py.
    wrong(
        "05a",
        "blind: .py",
        "entry-point-target",
        _setup((_FIRST, _FIRST.replace(":main", ".py:main"))),
    ),
    # A slash.
    wrong(
        "05a",
        "blind: a slash",
        "slash-in-module",
        _setup((_FIRST, _FIRST.replace("sensor_simulator.", "sensor_simulator/"))),
    ),
    # Both lead to the same file.
    wrong(
        "05a",
        "blind: twice the publisher",
        "other-function",
        _setup(
            (
                "sensor_simulator.temperature_subscriber:main",
                "sensor_simulator.temperature_publisher:main",
            )
        ),
    ),
    # Brackets.
    wrong("05a", "blind: main()", "entry-point-form", _setup((":main", ":main()"))),
    # The node's name as executable.
    wrong(
        "05a",
        "blind: the node's name",
        "executable-misspelled",
        _setup(("'temperature_publisher =", "'temperature_sensor =")),
    ),
    # The package is left out.
    wrong(
        "05a",
        "blind: no package",
        "entry-point-target entry-point-form",
        _setup((_FIRST, _FIRST.replace("sensor_simulator.", ""))),
    ),
    # A dot for the colon.
    wrong(
        "05a",
        "blind: .main",
        "entry-point-form entry-point-target",
        _setup((_FIRST, _FIRST.replace(":main", ".main"))),
    ),
    # The class for the function.
    wrong(
        "05a",
        "blind: the class",
        "entry-point-target",
        _setup((_FIRST, _FIRST.replace(":main", ":TemperatureSensor"))),
    ),
    # A colon for the equals sign.
    wrong(
        "05a", "blind: a colon", "entry-point-form", _setup((_FIRST, _FIRST.replace(" = ", ": ")))
    ),
    # console_script.
    wrong(
        "05a",
        "blind: console_script",
        "group-misspelled",
        _setup(("console_scripts", "console_script")),
    ),
    # One only.
    wrong(
        "05a", "blind: one only", "entry-point-missing", _setup((f"            {_SECOND},\n", ""))
    ),
)

_FUNCTIONS = (
    right(
        "05b",
        "blind: named parts",
        _DEF + "target = f'{package}.{module}'\n    return f'{executable} = {target}:{function}'\n",
    ),
    right(
        "05b",
        "blind: type hints",
        "def entry_point(executable: str, package: str, module: str, function: str = 'main') -> str:\n    return executable + ' = ' + package + '.' + module + ':' + function\n",
    ),
    right(
        "05b",
        "blind: a template",
        "from string import Template\n\n"
        + _DEF
        + "return Template('$e = $p.$m:$f').substitute(e=executable, p=package, m=module, f=function)\n",
    ),
    right(
        "05b",
        "blind: format, of locals()",
        _DEF + "return '{executable} = {package}.{module}:{function}'.format(**locals())\n",
    ),
    right(
        "05b",
        "blind: a dataclass that says itself",
        "from dataclasses import dataclass\n\n@dataclass\nclass Entry:\n    executable: str\n    package: str\n    module: str\n    function: str\n\n    def __str__(self):\n        return f'{self.executable} = {self.package}.{self.module}:{self.function}'\n\n"
        + _DEF
        + "return str(Entry(executable, package, module, function))\n",
    ),
    right(
        "05b",
        "blind: io, joined",
        "import io\n\n"
        + _DEF
        + "out = io.StringIO()\n    print(executable, '=', f'{package}.{module}:{function}', end='', file=out)\n    return out.getvalue()\n",
    ),
    right(
        "05b",
        "blind: importlib's EntryPoint",
        "from importlib.metadata import EntryPoint\n\n"
        + _DEF
        + "point = EntryPoint(executable, f'{package}.{module}:{function}', 'console_scripts')\n    return f'{point.name} = {point.value}'\n",
    ),
    right(
        "05b",
        "blind: partial",
        "from functools import partial\n\ndef _make(function, executable, package, module):\n    return '%s = %s.%s:%s' % (executable, package, module, function)\n\n"
        + _DEF
        + "return partial(_make, function)(executable, package, module)\n",
    ),
    right(
        "05b",
        "blind: a default of None",
        "def entry_point(executable, package, module, function=None):\n    function = function or 'main'\n    return f'{executable} = {package}.{module}:{function}'\n",
    ),
    right(
        "05b",
        "blind: one parameter more, with a default",
        "def entry_point(executable, package, module, function='main', sep=' = '):\n    return f'{executable}{sep}{package}.{module}:{function}'\n",
    ),
    # f forgotten.
    wrong(
        "05b",
        "blind: no f",
        "f-missing",
        _DEF + "return '{executable} = {package}.{module}:{function}'\n",
    ),
    # Printed.
    wrong(
        "05b",
        "blind: print",
        "returns-nothing",
        _DEF + "print(f'{executable} = {package}.{module}:{function}')\n",
    ),
    # main written out.
    wrong(
        "05b",
        "blind: main always",
        "swallowed-parameter",
        _DEF + "return f'{executable} = {package}.{module}:main'\n",
    ),
    # The module is the executable.
    wrong(
        "05b",
        "blind: executable twice",
        "swallowed-parameter entry-point-target",
        _DEF + "return f'{executable} = {package}.{executable}:{function}'\n",
    ),
    # A slash.
    wrong(
        "05b",
        "blind: a slash",
        "slash-in-module",
        _DEF + "return f'{executable} = {package}/{module}:{function}'\n",
    ),
    # Brackets after the function.
    wrong(
        "05b",
        "blind: brackets",
        "entry-point-form stray-characters",
        _DEF + "return f'{executable} = {package}.{module}:{function}()'\n",
    ),
    # .py.
    wrong(
        "05b",
        "blind: .py",
        "entry-point-target entry-point-form stray-characters",
        _DEF + "return f'{executable} = {package}.{module}.py:{function}'\n",
    ),
    # Quotes and a comma, as in setup.py.
    wrong(
        "05b",
        "blind: quotes and a comma",
        "stray-characters",
        _DEF + "return f\"'{executable} = {package}.{module}:{function}',\"\n",
    ),
    # Module before package.
    wrong(
        "05b",
        "blind: swapped",
        "arguments-swapped entry-point-target new-to-me",
        _DEF + "return f'{executable} = {module}.{package}:{function}'\n",
    ),
    # A line end.
    wrong(
        "05b",
        "blind: a line end",
        "stray-characters",
        _DEF + "return f'{executable} = {package}.{module}:{function}\\n'\n",
    ),
    # A tuple.
    wrong(
        "05b",
        "blind: a tuple",
        "not-a-text",
        _DEF + "return executable, package, module, function\n",
    ),
    # The colon lost.
    wrong(
        "05b",
        "blind: a dot for the colon",
        "entry-point-form entry-point-target",
        _DEF + "return f'{executable} = {package}.{module}.{function}'\n",
    ),
    # The words are fixed.
    wrong(
        "05b",
        "blind: fixed",
        "fixed-answer swallowed-parameter",
        _DEF + "return 'talk = rosie.voice:start'\n",
    ),
)

_LIST = f"[\n{_ENTRIES}        ]"
_BOTH = "('publisher', 'subscriber')"

_RARER = (
    right(
        "01a",
        "blind: two mkdirs joined",
        "mkdir -p resources/sounds && mkdir resources/sounds/alarm",
    ),
    right(
        "01a",
        "blind: more than asked for",
        "mkdir -p resources/sounds/alarm/loud resources/sounds/bell",
    ),
    right(
        "01a",
        "blind: there already",
        "mkdir -p resources/sounds/alarm\nmkdir -p resources/sounds/alarm",
    ),
    right(
        "01a",
        "blind: a folder that is moved",
        "mkdir -p tmp/alarm resources/sounds\nmv tmp/alarm resources/sounds\nrmdir tmp",
    ),
    right("01a", "blind: in a shell of its own", "(cd resources; mkdir -p sounds/alarm)"),
    right("01b", "blind: pushd", "pushd ../../src"),
    right("01b", "blind: wrong first, back, then right", "cd ../images\ncd ../../src"),
    right("01b", "blind: two slashes, quotes", 'cd "../..//src"'),
    right("01b", "blind: in two", "cd ../..\ncd src"),
    right("02a", "blind: CDATA", _xml((_TEXT, "<![CDATA[Sensor & monitor <3]]>"))),
    right(
        "02a",
        "blind: a licence with its file",
        _xml((_LICENSE, '<license file="LICENSE">Apache-2.0</license>')),
    ),
    right(
        "02a",
        "blind: an address of its home",
        _xml((_LICENSE, f'{_LICENSE}\n  <url type="website">https://example.org</url>')),
    ),
    right(
        "02a",
        "blind: words for the licence",
        _xml((_LICENSE, "<license>Apache License 2.0</license>")),
    ),
    right(
        "02a",
        "blind: exec_depend",
        _xml(
            ("<depend>rclpy</depend>", "<exec_depend>rclpy</exec_depend>"),
            ("<depend>std_msgs</depend>", "<exec_depend>std_msgs</exec_depend>"),
        ),
    ),
    right("02a", "blind: one word", _xml((_TEXT, "Thermometer"))),
    right("02a", "blind: without the lines about XML", _xml(('<?xml version="1.0"?>\n', ""))),
    right(
        "02b",
        "blind: in another folder, then moved",
        "ros2 pkg create --build-type ament_python room_display --dependencies rclpy sensor_msgs\nmv room_display src/",
    ),
    right(
        "02b",
        "blind: one more dependency, a description",
        "cd src\nros2 pkg create room_display --build-type ament_python --description 'A display' --dependencies rclpy sensor_msgs std_msgs",
    ),
    right(
        "02b",
        "blind: a node along with it",
        "cd src\nros2 pkg create --build-type ament_python --node-name show room_display --dependencies rclpy sensor_msgs",
    ),
    right(
        "05a",
        "blind: added texts",
        _setup(
            (_FIRST, "'temperature_publisher = ' + package_name + '.temperature_publisher:main'"),
            (
                _SECOND,
                "'temperature_subscriber = ' + package_name + '.temperature_subscriber:main'",
            ),
        ),
    ),
    right(
        "05a",
        "blind: format",
        _setup(
            (
                _FIRST,
                "'temperature_publisher = {}.temperature_publisher:main'.format(package_name)",
            ),
            (
                _SECOND,
                "'temperature_subscriber = {}.temperature_subscriber:main'.format(package_name)",
            ),
        ),
    ),
    right(
        "05a",
        "blind: a percent sign",
        _setup(
            (_FIRST, "'temperature_publisher = %s.temperature_publisher:main' % package_name"),
            (_SECOND, "'temperature_subscriber = %s.temperature_subscriber:main' % package_name"),
        ),
    ),
    right(
        "05a",
        "blind: a list above",
        _setup(
            ("setup(\n", f"PROGRAMS = [\n    {_FIRST},\n    {_SECOND},\n]\n\nsetup(\n"),
            (_LIST, "PROGRAMS"),
        ),
    ),
    right(
        "05a",
        "blind: setuptools.setup",
        _setup(
            ("from setuptools import find_packages, setup", "import setuptools"),
            ("=find_packages", "=setuptools.find_packages"),
            ("\nsetup(", "\nsetuptools.setup("),
        ),
    ),
    right(
        "05a",
        "blind: a loop that appends",
        _setup(
            (
                "setup(\n",
                f"programs = []\nfor x in {_BOTH}:\n    programs.append(f'temperature_{{x}} = {{package_name}}.temperature_{{x}}:main')\n\nsetup(\n",
            ),
            (_LIST, "programs"),
        ),
    ),
    right(
        "05a",
        "blind: a lambda and map",
        _setup(
            (
                _LIST,
                f"list(map(lambda x: f'temperature_{{x}} = {{package_name}}.temperature_{{x}}:main', {_BOTH}))",
            )
        ),
    ),
    right(
        "05a",
        "blind: a tuple",
        _setup((_LIST, f"(\n            {_FIRST},\n            {_SECOND},\n        )")),
    ),
    right(
        "05a",
        "blind: one text with two lines",
        _setup(
            (_LIST, f"'''\n            {_FIRST[1:-1]}\n            {_SECOND[1:-1]}\n        '''")
        ),
    ),
    right(
        "05a",
        "blind: double quotes, many blanks",
        _setup(
            (_FIRST, '"temperature_publisher   =   sensor_simulator.temperature_publisher:main"')
        ),
    ),
    right(
        "05a",
        "blind: names from variables",
        _setup(
            (
                "setup(\n",
                "publisher, subscriber = 'temperature_publisher', 'temperature_subscriber'\n\nsetup(\n",
            ),
            (_FIRST, "f'{publisher} = {package_name}.{publisher}:main'"),
            (_SECOND, "f'{subscriber} = {package_name}.{subscriber}:main'"),
        ),
    ),
    right(
        "05a",
        "blind: joined",
        _setup(
            (
                _FIRST,
                "' = '.join(['temperature_publisher', 'sensor_simulator.temperature_publisher:main'])",
            )
        ),
    ),
    right("05a", "blind: starred", _setup((_LIST, f"[*[{_FIRST}], *[{_SECOND}]]"))),
    right(
        "05b",
        "blind: match on the function",
        _DEF
        + "match function:\n        case 'main':\n            end = ':main'\n        case other:\n            end = ':' + other\n    return f'{executable} = {package}.{module}{end}'\n",
    ),
    right(
        "05b",
        "blind: a class that can be called",
        "class Maker:\n    def __call__(self, executable, package, module, function='main'):\n        return f'{executable} = {package}.{module}:{function}'\n\nentry_point = Maker()\n",
    ),
    right(
        "05b",
        "blind: a static method",
        "class Entry:\n    @staticmethod\n    def text(executable, package, module, function='main'):\n        return f'{executable} = {package}.{module}:{function}'\n\nentry_point = Entry.text\n",
    ),
    right(
        "05b",
        "blind: reduced",
        "from functools import reduce\n\n"
        + _DEF
        + "parts = [(' = ', package), ('.', module), (':', function)]\n    return reduce(lambda text, part: text + ''.join(part), parts, executable)\n",
    ),
    right(
        "05b",
        "blind: a generator, joined",
        _DEF
        + "def parts():\n        yield executable\n        yield ' = '\n        yield package + '.' + module\n        yield ':' + function\n    return ''.join(parts())\n",
    ),
    right(
        "05b", "blind: no blanks", _DEF + "return f'{executable}={package}.{module}:{function}'\n"
    ),
    right(
        "05b",
        "blind: prints it, too",
        _DEF
        + "text = f'{executable} = {package}.{module}:{function}'\n    print(text)\n    return text\n",
    ),
    right(
        "05b",
        "blind: cached, and a remark",
        'from functools import lru_cache\n\n@lru_cache\ndef entry_point(executable, package, module, function=\'main\'):\n    """Return the text of an entry point."""\n    return f\'{executable} = {package}.{module}:{function}\'\n',
    ),
    right(
        "05b",
        "blind: any arguments",
        "def entry_point(*names):\n    executable, package, module, function = (*names, 'main')[:4]\n    return f'{executable} = {package}.{module}:{function}'\n",
    ),
    right(
        "05b",
        "blind: checks what it gets",
        _DEF
        + "if not all(part.isidentifier() for part in (package, module, function)):\n        raise ValueError('no name')\n    return f'{executable} = {package}.{module}:{function}'\n",
    ),
)

_ALL: tuple[Answer, ...] = (*_FOLDERS, *_PACKAGES, *_PROGRAMS, *_FUNCTIONS, *_RARER)
_HIDDEN = "entry-points-hidden: it is right when it runs, and page 05 asks for no plain texts."

#: Where the judge is wrong, and what it says: these answers are not in the table.
REASONS = {
    # The check of the page is right about these three; grading holds them for a person.
    "05b blind: format, of locals()": "held: 'uses locals'.",
    "05b blind: io, joined": "held: 'imports io'.",
    "05b blind: importlib's EntryPoint": "held: 'imports importlib.metadata'.",
    "05a blind: a function of one's own": _HIDDEN,
    "05a blind: a loop that appends": _HIDDEN,
    "05a blind: a lambda and map": _HIDDEN,
    "05a blind: names from variables": _HIDDEN,
}
ANSWERS = tuple(one for one in _ALL if one.id not in REASONS)
DISAGREE = tuple(one for one in _ALL if one.id in REASONS)
