import pytest

from rosbeat.workspace.parsing import decoded, encoding_of, parse, pieces


@pytest.mark.parametrize("text", ["def f(:", "return 1", b"\xff", "x = 'a"])
def test_what_is_no_python(text):
    with pytest.raises(SyntaxError):
        parse(text)


def test_a_doubtful_escape_is_not_spoken_about(recwarn):
    parse("x = '\\d'")
    assert len(recwarn) == 0


def test_a_text_in_the_encoding_of_its_first_line():
    text = "# coding: latin-1\r\nx = 'é'\r\n"
    assert decoded(text.encode("latin-1")) == text
    assert encoding_of(text.encode("latin-1")) == "iso-8859-1"
    assert decoded("\ufeffx = 1\n".encode()) == "x = 1\n"


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("'a'", 1),
        ("'a' 'b'", 2),
        ("'a'\n  'b'", 2),
        ("f'a{x}' 'b'", 2),
        ("f'{y[\"a\"]}'", 1),
        ("x", 0),
    ],
)
def test_texts_in_a_row(text, count):
    assert pieces(text) == count
