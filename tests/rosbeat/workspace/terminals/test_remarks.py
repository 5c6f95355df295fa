import pytest

from rosbeat.workspace.terminals.remarks import WIDTH, remark, say


def test_every_line_of_a_remark_is_marked():
    shown = []
    say(shown.append, "exit code 1\n\nIt means")
    assert shown == ["# exit code 1", "#", "# It means"]


def test_long_remarks_are_wrapped_and_marked_on_each_line():
    lines = list(remark("  " + "a word " * 40))
    assert len(lines) > 1
    assert all(line.startswith("#   a") or line.startswith("#   word") for line in lines)
    assert max(map(len, lines)) <= WIDTH
    assert " ".join(line[2:].strip() for line in lines) == ("a word " * 40).strip()


@pytest.mark.parametrize("before", [70, 80, 90, 97])
def test_what_is_to_be_typed_is_never_broken(before):
    command = "`colcon build --packages-select sensor_simulator`"
    assert any(command in line for line in remark("x" * before + f" Type {command} again."))
    assert any("build-type" in line for line in remark("x" * before + " build-type"))


def test_nothing_is_no_remark():
    assert list(remark("")) == []
