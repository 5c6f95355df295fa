from rosbeat.workspace.terminals.history import Line
from rosbeat.workspace.terminals.showing import Display


def shown(count, first=3, last=2):
    lines = []
    display = Display(lines.append, first, last)
    for number in range(10, 10 + count):
        display.add(Line(number, 0, str(number)))
    display.end()
    display.end()
    return lines


def test_everything_is_shown_when_it_is_little():
    assert shown(3) == ["10", "11", "12"]
    assert shown(5) == ["10", "11", "12", "13", "14"]


def test_the_middle_is_left_out_and_counted():
    assert shown(9) == ["10", "11", "12", "# 4 lines left out", "17", "18"]


def test_lines_that_were_forgotten_in_between_count_too():
    lines = []
    display = Display(lines.append, 1, 1)
    display.add(Line(0, 0, "a"))
    display.add(Line(99, 0, "z"))
    display.end()
    assert lines == ["a", "# 98 lines left out", "z"]
