import os
import sys

from course_tool import running

ENV = dict(os.environ)


def python(code):
    return [sys.executable, "-I", "-S", "-c", code]


def test_interesting_lines_are_shown_and_all_are_kept(capsys):
    result = running.stream(
        python("print('Downloading a'); print(' + a==1')"), ENV, lambda line: "Down" in line
    )
    assert result.ok
    assert result.text == "Downloading a\n + a==1\n"
    assert capsys.readouterr().out == "      Downloading a\n"


def test_what_goes_to_standard_error_is_kept_too():
    result = running.stream(python("import sys; sys.exit('no')"), ENV, bool)
    assert (result.code, result.text) == (1, "no\n")


def test_a_quiet_program():
    result = running.quiet(python("print('hello')"), ENV)
    assert (result.ok, result.text) == (True, "hello\n")


def test_a_program_that_never_ends():
    result = running.quiet(python("import time; time.sleep(60)"), ENV, timeout=0.2)
    assert result.code == 124


def test_a_program_that_is_not_there():
    assert running.quiet(["/nowhere/program"], ENV).code == 127
