from rosbeat.workspace.terminals.after_keys import NewOnly, shapes
from rosbeat.workspace.terminals.history import Line


def test_only_what_is_new_is_shown():
    before = [
        Line(0, 0, "~$ run", typed=True),
        Line(1, 0, "[INFO] [sensor]: Publishing: 22.13C"),
    ]
    lines = []
    show = NewOnly(shapes(before), lines.append)
    for text in ("", "[INFO] [sensor]: Publishing: -3C", "~$ run", "[INFO] [sensor]: The end"):
        show(text)
    assert lines == ["~$ run", "[INFO] [sensor]: The end"]
