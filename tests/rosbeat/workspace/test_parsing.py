import pytest

from rosbeat.workspace.parsing import parse


@pytest.mark.parametrize("text", ["def f(:", "return 1", b"\xff", "x = 'a"])
def test_what_is_no_python(text):
    with pytest.raises(SyntaxError):
        parse(text)


def test_a_doubtful_escape_is_not_spoken_about(recwarn):
    parse("x = '\\d'")
    assert len(recwarn) == 0
