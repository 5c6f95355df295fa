"""What a session prints in the cell."""

import re
from functools import partial

from nodes import Speaker


def test_printed_logs_are_the_records(ros, capfd):
    ros.add(Speaker)
    ros.add(partial(Speaker, "other", 0.5))
    ros.run(2)
    printed = capfd.readouterr()
    assert printed.err == ""
    lines = [f"[{line.level}] [{line.time:.3f}] [{line.name}]: {line.text}" for line in ros.logs()]
    assert printed.out.splitlines() == lines
    assert len(lines) == 6
    assert [line.name for line in ros.logs("other")] == ["other"] * 4


def test_quiet_prints_nothing_and_a_flood_is_counted(ros, capsys):
    ros.add(partial(Speaker, "flood", 0.001))
    ros.run(1, quiet=True)
    assert capsys.readouterr().out == ""
    ros.run(1)
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 101
    assert re.fullmatch(r"\.\.\. and 900 more lines; logs\(\) has them all\.", lines[-1])
    assert len(ros.logs()) == 2000
