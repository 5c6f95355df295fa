"""Answers to 05b, write entry points: cells that define a function."""

from bank.workspaces.answer import Answer, right, untried, wrong

_DEF = "def entry_point(executable, package, module, function='main'):\n    "


def _returns(name: str, mistakes: str, expression: str) -> Answer:
    return wrong("05b", name, mistakes, f"{_DEF}return {expression}\n")


ANSWERS = (
    right("05b", "as on the page", _DEF + "return f'{executable} = {package}.{module}:{function}'"),
    right(
        "05b", "added", _DEF + "return executable + '=' + package + '.' + module + ':' + function"
    ),
    right(
        "05b",
        "format",
        _DEF + "return '{} = {}.{}:{}'.format(executable, package, module, function)",
    ),
    right(
        "05b", "percent", _DEF + "return '%s = %s.%s:%s' % (executable, package, module, function)"
    ),
    right(
        "05b",
        "joined",
        _DEF + "return ' = '.join([executable, ':'.join(['.'.join([package, module]), function])])",
    ),
    right("05b", "a lambda", "entry_point = lambda e, p, m, f='main': f'{e} = {p}.{m}:{f}'"),
    right(
        "05b",
        "any arguments",
        "def entry_point(name, *parts):\n"
        "    parts = (*parts, 'main')\n    return f'{name} = {parts[0]}.{parts[1]}:{parts[2]}'",
    ),
    right(
        "05b",
        "in steps",
        _DEF + "path = f'{package}.{module}'\n    text = f'{executable} = {path}'\n"
        "    return text + f':{function}'",
    ),
    right(
        "05b",
        "a blank after the colon",
        _DEF + "return f'{executable} = {package}.{module}: {function}'",
    ),
    right(
        "05b",
        "with types",
        "def entry_point(executable: str, package: str, module: str, "
        "function: str = 'main') -> str:\n    return f'{executable}={package}.{module}:{function}'",
    ),
    right(
        "05b",
        "a method",
        "class Writer:\n    def write(self, e, p, m, f='main'):\n"
        "        return f'{e} = {p}.{m}:{f}'\nentry_point = Writer().write",
    ),
    right("05b", "no blanks", _DEF + "return f'{executable}={package}.{module}:{function}'"),
    right("05b", "aligned", _DEF + "return f'{executable:<30}= {package}.{module}:{function}'"),
    right(
        "05b",
        "a template of the library",
        "from string import Template\n" + _DEF + "return Template('$e = $p.$m:$f').substitute("
        "e=executable, p=package, m=module, f=function)",
    ),
    right(
        "05b",
        "a named template",
        _DEF + "return '{e} = {p}.{m}:{f}'.format_map("
        "dict(e=executable, p=package, m=module, f=function))",
    ),
    right(
        "05b",
        "a dataclass",
        "from dataclasses import dataclass\n@dataclass\nclass Entry:\n"
        "    e: str\n    p: str\n    m: str\n    f: str = 'main'\n"
        "    def __str__(self):\n        return f'{self.e} = {self.p}.{self.m}:{self.f}'\n"
        "def entry_point(*parts):\n    return str(Entry(*parts))",
    ),
    right(
        "05b",
        "an object that is called",
        "class Writer:\n    def __call__(self, e, p, m, f='main'):\n"
        "        return ''.join((e, ' = ', p, '.', m, ':', f))\nentry_point = Writer()",
    ),
    right(
        "05b",
        "a part of a function",
        "from functools import partial\ndef write(text, e, p, m, f='main'):\n"
        "    return text % (e, p, m, f)\nentry_point = partial(write, '%s = %s.%s:%s')",
    ),
    right(
        "05b",
        "a default of its own",
        "def entry_point(e, p, m, f=None):\n    return f'{e} = {p}.{m}:{f or \"main\"}'",
    ),
    right(
        "05b",
        "printed, too",
        _DEF + "text = f'{executable} = {package}.{module}:{function}'\n"
        "    print(text)\n    return text",
    ),
    right(
        "05b",
        "a text of one's own kind",
        "class Text(str):\n    pass\n"
        + _DEF
        + "return Text(f'{executable} = {package}.{module}:{function}')",
    ),
    right(
        "05b",
        "numpy",
        "import numpy\n"
        + _DEF
        + "return numpy.str_(f'{executable} = {package}.{module}:{function}')",
    ),
    _returns(
        "small letters", "wrong-values", "f'{executable} = {package}.{module}:{function}'.lower()"
    ),
    _returns(
        "one small part", "wrong-values", "f'{executable} = {package}.{module.lower()}:{function}'"
    ),
    _returns(
        "capital letters", "wrong-values", "f'{executable} = {package}.{module}:{function}'.upper()"
    ),
    _returns(
        "dashes for underscores",
        "wrong-values",
        "f'{executable} = {package}.{module}:{function}'.replace('_', '-')",
    ),
    _returns(
        "a fixed package",
        "swallowed-parameter",
        "f'{executable} = sensor_simulator.{module}:{function}'",
    ),
    _returns(
        "a fixed module", "swallowed-parameter", "f'{executable} = {package}.voice:{function}'"
    ),
    _returns("two fixed parts", "swallowed-parameter", "f'{executable} = rosie.voice:{function}'"),
    _returns(
        "package and module swapped",
        "entry-point-target",
        "f'{executable} = {module}.{package}:{function}'",
    ),
    _returns(
        "the executable as the module",
        "entry-point-target",
        "f'{executable} = {package}.{executable}:{function}'",
    ),
    _returns(
        "executable and package swapped",
        "entry-point-form",
        "f'{package} = {executable}.{module}:{function}'",
    ),
    _returns(
        "a colon for the sign", "entry-point-form", "f'{executable}: {package}.{module}:{function}'"
    ),
    _returns(
        "a blank for the dot",
        "entry-point-target",
        "f'{executable} = {package} {module}:{function}'",
    ),
    _returns(
        "a slash for the colon",
        "entry-point-target",
        "f'{executable} = {package}.{module}/{function}'",
    ),
    _returns(
        "a blank at the end", "stray-characters", "f'{executable} = {package}.{module}:{function} '"
    ),
    _returns("a tuple of one", "not-a-text", "f'{executable} = {package}.{module}:{function}',"),
    _returns("bytes", "not-a-text", "f'{executable} = {package}.{module}:{function}'.encode()"),
    _returns("a set", "not-a-text", "{f'{executable} = {package}.{module}:{function}'}"),
    _returns("with ros2 run", "new-to-me", "f'ros2 run {package} {executable}'"),
    wrong(
        "05b",
        "a text that is called",
        "raised",
        _DEF + "text = 'a'\n    return text(executable)",
    ),
    untried("05b", "the blank", f"{_DEF}return ____\n"),
    _returns("a slash", "slash-in-module", "f'{executable} = {package}/{module}:{function}'"),
    _returns(
        "a dot for the colon",
        "entry-point-target",
        "f'{executable} = {package}.{module}.{function}'",
    ),
    _returns("no function", "entry-point-target", "f'{executable} = {package}.{module}'"),
    _returns("no package", "entry-point-target", "f'{executable} = {module}:{function}'"),
    _returns(
        "a colon for the dot",
        "entry-point-target",
        "f'{executable} = {package}:{module}:{function}'",
    ),
    _returns("a file", "entry-point-target", "f'{executable} = {package}.{module}.py:{function}'"),
    _returns("turned round", "entry-point-form", "f'{package}.{module}:{function} = {executable}'"),
    _returns("no sign", "entry-point-form", "f'{executable} {package}.{module}:{function}'"),
    _returns("two signs", "entry-point-form", "f'{executable} == {package}.{module}:{function}'"),
    _returns("brackets", "stray-characters", "f'{executable} = {package}.{module}:{function}()'"),
    _returns("a comma", "stray-characters", "f'{executable} = {package}.{module}:{function},'"),
    _returns("quotes", "stray-characters", "f\"'{executable} = {package}.{module}:{function}'\""),
    _returns(
        "a line end", "stray-characters", "f'{executable} = {package}.{module}:{function}\\n'"
    ),
    _returns("no f", "f-missing", "'{executable} = {package}.{module}:{function}'"),
    _returns("a tuple", "not-a-text", "executable, package, module, function"),
    _returns("a list", "not-a-text", "[f'{executable} = {package}.{module}:{function}']"),
    _returns("always main", "swallowed-parameter", "f'{executable} = {package}.{module}:main'"),
    _returns(
        "a fixed text",
        "swallowed-parameter entry-point-form entry-point-target",
        "'temperature_publisher = sensor_simulator.temperature_publisher:main'",
    ),
    _returns("no quotes", "name-error", "executable + equals + package"),
    _returns("a number added", "raised", "executable + 1"),
    wrong(
        "05b",
        "printed",
        "returns-nothing",
        _DEF + "print(f'{executable} = {package}.{module}:{function}')",
    ),
    wrong(
        "05b", "no return", "returns-nothing", _DEF + "text = f'{executable} = {package}.{module}'"
    ),
    wrong(
        "05b",
        "three parameters",
        "parameters-changed",
        "def entry_point(executable, package, module):\n"
        "    return f'{executable} = {package}.{module}:main'",
    ),
    wrong(
        "05b",
        "one parameter",
        "parameters-changed",
        "def entry_point(executable):\n    return executable",
    ),
    wrong(
        "05b",
        "four that are needed",
        "parameters-changed",
        "def entry_point(e, p, m, f):\n    return f'{e} = {p}.{m}:{f}'",
    ),
    wrong("05b", "the text handed over", "no-function", "entry_point = 'a = b.c:d'"),
    wrong("05b", "an endless loop", "does-not-return", _DEF + "while True: pass"),
    wrong("05b", "exit", "exits", _DEF + "raise SystemExit(executable)"),
    _returns(
        "no f, and a slash", "f-missing slash-in-module", "'{executable} = {package}/{module}'"
    ),
    _returns(
        "brackets, and a slash",
        "stray-characters slash-in-module",
        "f'{executable} = {package}/{module}:{function}()'",
    ),
)
