import pytest

from rosbeat.workspace.setup_edit import with_entry_points
from rosbeat.workspace.setup_script import parse_setup

SCRIPTS = ["a = p.a:main", "b = p.b:main"]
HEAD = "from setuptools import setup\nsetup(name='p', entry_points={"


@pytest.mark.parametrize(
    "text",
    [
        HEAD + "'console_scripts': []})\n",
        HEAD + "'console_scripts': [], 'gui_scripts': []})\n",
        HEAD + "'gui_scripts': [], 'console_scripts': [ ]})\n",
        HEAD + "\n    'console_scripts': [\n        # mine\n    ],\n})\n",
        "# one\fform feed\n" + HEAD + "'console_scripts': []})\n",
        "x = 'a\u2028b'\n" + HEAD + "'console_scripts': []})\n",
        HEAD + "'é': [], 'console_scripts': []})\n",
        "\ufeff" + HEAD + "'console_scripts': []})\n",
    ],
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_an_empty_list(text, end):
    data = text.replace("\n", end).encode()
    after = with_entry_points(data, SCRIPTS)
    assert [one.text for one in parse_setup(after).entry_points] == SCRIPTS
    # The gaps may differ where the bracket was on the same line; nothing else does.
    added = "".join(f"'{one}'," for one in SCRIPTS).replace(" ", "")
    kept = "".join(after.decode().split()).replace(added, "")
    assert kept == "".join(text.split())
    assert after.count(b"\n") == after.count(end.encode())


@pytest.mark.parametrize(
    "text",
    [
        HEAD + "'console_scripts': ()})\n",
        HEAD + "'console_scripts': ['c = p.c:main']})\n",
        HEAD + "'console_scripts': [*more]})\n",
        HEAD + "'console_scripts': names()})\n",
        HEAD + "**more})\n",
        HEAD + "})\n",
        "x = 1\n",
        "def f(:\n",
    ],
)
def test_others_are_left_alone(text):
    assert with_entry_points(text.encode(), SCRIPTS) is None


def test_a_result_that_would_say_something_else_is_refused():
    data = (HEAD + "'console_scripts': []})\n").encode()
    assert with_entry_points(data, ["a = p.a:main', 'c"]) is None
