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
