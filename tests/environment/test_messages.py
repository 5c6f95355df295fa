from course_tool.messages import Problem, complain, three_parts


def test_three_parts_line_up():
    text = three_parts(Problem("It rains.", "You get wet.", "Take an umbrella,\nor wait."))
    assert text == (
        "What happened:       It rains.\n"
        "What it means here:  You get wet.\n"
        "What to try:         Take an umbrella,\n"
        "                     or wait."
    )


def test_details_come_last():
    text = three_parts(Problem("a", "b", "c", "first\nsecond\n"))
    assert text.endswith("Its last words:\n    first\n    second")


def test_problems_go_to_standard_error(capsys):
    complain(Problem("a", "b", "c"))
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("\nWhat happened:       a\n")
