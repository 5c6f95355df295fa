import errno

import pytest

from course_tool import cli
from course_tool.messages import Problem


def run(monkeypatch, error):
    def command(layout, arguments):
        raise error

    monkeypatch.setitem(cli._COMMANDS, "doctor", command)
    return cli.main(["doctor"])


@pytest.mark.parametrize("arguments", [[], ["help"], ["--help"], ["-h"]])
def test_help(arguments, capsys):
    assert cli.main(arguments) == 0
    out = capsys.readouterr().out
    for name in ("lab", "test", "shell", "doctor", "bench", "lock"):
        assert f"\n  {name} " in out


@pytest.mark.parametrize(
    ("typed", "meant"), [("lap", "lab"), ("tests", "test"), ("docter", "doctor")]
)
def test_a_slip_is_understood(typed, meant, capsys):
    assert cli.main([typed]) == 1
    assert f"Did you mean:  ./environment/course {meant}\n" in capsys.readouterr().err


def test_an_unknown_word_gets_the_list(capsys):
    assert cli.main(["xyzzy"]) == 1
    err = capsys.readouterr().err
    assert "lab, test, shell, doctor, bench, lock and help" in err
    assert "variables" not in err


def test_a_problem_is_said_in_three_parts(monkeypatch, capsys):
    assert run(monkeypatch, Problem("a", "b", "c")) == 1
    assert "What to try:         c" in capsys.readouterr().err


def test_ctrl_c_gets_a_short_word(monkeypatch, capsys):
    assert run(monkeypatch, KeyboardInterrupt()) == 130
    out, err = capsys.readouterr()
    assert len(out.strip().splitlines()) == 1
    assert err == ""


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (errno.ENOSPC, "not enough room"),
        (errno.EACCES, "Nothing can be written"),
        (errno.EROFS, "Nothing can be written"),
        (errno.EIO, "does not know"),
    ],
)
def test_what_the_system_refuses(monkeypatch, capsys, number, words):
    assert run(monkeypatch, OSError(number, "no", "/some/file")) == 1
    err = capsys.readouterr().err
    assert words in err
    assert "What to try:" in err


def test_never_a_bare_traceback(monkeypatch, capsys):
    assert run(monkeypatch, RuntimeError("oh")) == 1
    err = capsys.readouterr().err
    assert err.lstrip().startswith("What happened:")
    assert "RuntimeError: oh" in err
