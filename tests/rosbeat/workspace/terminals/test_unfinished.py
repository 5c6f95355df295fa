import pytest

from rosbeat.workspace.terminals.unfinished import unfinished


@pytest.mark.parametrize(
    ("command", "missing"),
    [
        ('echo "abc', 'closing quote `"`'),
        ("echo 'abc", "closing quote `'`"),
        ("echo $(ls", "closing bracket `)`"),
        ("echo ${HOME", "closing brace `}`"),
        ("echo `ls", "closing backquote"),
        ("for i in 1 2; do\necho $i", "`done`"),
        ("if true; then\necho", "`fi`"),
        ("{ echo a", "`}`"),
        ("cat <<END\nabc", "the line `END`"),
        ("ls \\", "backslash"),
        ("ls |", "its end"),
    ],
)
def test_bash_itself_says_what_is_missing(command, missing, says):
    error = unfinished(command)
    says(error)
    assert missing in error.what
