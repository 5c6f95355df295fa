import pytest
from IPython.core.error import UsageError

from rosbeat.workspace.terminals.options import Options, parse


def test_a_name_is_enough():
    assert parse("sensor", True) == Options("sensor", None, 1, None, None, "")


def test_everything_at_once():
    line = 'sensor --until "Publishing: 2" --lines 3 --timeout 90s --answer'
    assert parse(line, True) == Options("sensor", "Publishing: 2", 3, None, 90.0, "answer")


@pytest.mark.parametrize("action", ["ctrl-c", "ctrl-d", "kill", "close"])
def test_actions_stand_in_a_line(action):
    assert parse(f"sensor --{action}", False).action == action.replace("-", "_")
    with pytest.raises(UsageError, match=f"%terminal sensor --{action}"):
        parse(f"sensor --{action}", True)


def test_ending_a_program_takes_a_time():
    assert parse("sensor --ctrl-c --timeout 2", False).ending() == {"timeout": 2.0}
    assert parse("sensor --kill", False).ending() == {}


def test_no_name_lists_the_terminals():
    assert parse("  ", False).name == ""


@pytest.mark.parametrize(
    ("line", "in_cell", "said"),
    [
        ("", True, "Which terminal"),
        ("--ctrl-c", False, "Which terminal"),
        ("--until x", False, "Which terminal"),
        ("sensor --untill x", True, "no option `--untill`(.|\n)*--until TEXT"),
        ("sensor --unt x", True, "no option `--unt`"),
        ("sensor --help", False, "--until TEXT"),
        ("sensor monitor", True, "`monitor` is too much"),
        ("sensor --until", True, "--until: expected one argument"),
        ("sensor --until ''", True, "needs a text"),
        ('sensor --until "a', True, "quote is not closed"),
        ("sensor --lines 2", True, "--until TEXT"),
        ("sensor --until a --lines none", True, "not a number of lines"),
        ("sensor --until a --lines 0", True, "not a number of lines"),
        ("sensor --for long", True, "not a number of seconds"),
        ("sensor --for -1", True, "."),
        ("sensor --for inf", True, "not a number of seconds"),
        ("sensor --for nan", True, "not a number of seconds"),
        ("sensor --kill --close", False, "not allowed with"),
        ("sensor --ctrl-c --until x", False, "`--until` does not go with `--ctrl-c`"),
        ("sensor --kill --for 0", False, "`--for` does not go with `--kill`"),
        ("sensor --close --timeout 3", False, "`--timeout` does not go with `--close`"),
        ("sensor --answer", False, "needs `%%terminal`"),
        ("sen/sor", True, "is no name"),
        ("../x", False, "is no name"),
    ],
)
def test_what_cannot_be_is_explained(line, in_cell, said):
    with pytest.raises(UsageError, match=said):
        parse(line, in_cell)
