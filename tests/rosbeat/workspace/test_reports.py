from rosbeat.workspace.reports import Report


def test_nothing_was_missing():
    assert repr(Report()) == "Everything this page needs is there."
    assert Report().complete


def test_what_was_made_and_what_stands_in_the_way():
    report = Report(("the folder src (page 01)",), ("a file is there. Rename it.",))
    assert str(report).splitlines() == [
        "Made for you, because it was not there yet: the folder src (page 01).",
        "Please look: a file is there. Rename it.",
    ]
    assert not report.complete


def test_long_ones_are_wrapped_between_words():
    shown = str(Report(("word " * 60 + "`a-long-command --with-options`",)))
    assert all(len(line) <= 100 for line in shown.splitlines())
    assert "--with-options" in shown
