"""Whatever a terminal shows, asking for its meaning never fails."""

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.workspace import meanings

PIECES = st.sampled_from(
    [
        "ros2 run sensor_simulator",
        "colcon build",
        "cd ",
        "~",
        "..",
        ";",
        "&&",
        "'",
        '"',
        "\\\n",
        "\n",
        "chmod: cannot access '",
        "': No such file",
        "bash: cd: ",
        ": No such file or directory",
        ": command not found",
        "Traceback",
        "SyntaxError: x",
        "Package '",
        "' not found",
        "**",
        "[",
        "\0",
        "No executable found",
        "invalid choice: 'a' (choose from 'b')",
        "/" * 300,
        "x" * 300,
        "é",
        "{0}",
    ]
)
TEXTS = st.lists(st.one_of(PIECES, st.text(max_size=5)), max_size=8).map("".join)


@settings(
    max_examples=60,
    deadline=None,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(command=TEXTS, output=TEXTS, code=st.integers(0, 255))
def test_it_never_raises(root, package, command, output, code):
    said = meanings.explain(command, output, code, root, root)
    assert said is None or said.strip()


def test_each_meaning_is_asked_once():
    assert len(set(meanings._MEANINGS)) == len(meanings._MEANINGS)


def test_a_file_that_vanishes_meanwhile_is_no_error(root, monkeypatch):
    def vanished(_):
        raise FileNotFoundError

    found = Diagnosis("raised", "seen", "try")
    monkeypatch.setattr(meanings, "_MEANINGS", (vanished, lambda _: found))
    assert meanings.explain("", "", 0, root, root) == "seen try"
    assert meanings.recognise("", "", 0, root, root).mistake == "raised"
