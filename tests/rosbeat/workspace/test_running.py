import pytest

from rosbeat.workspace.running import run_as_module


def test_a_module_that_is_imported_stays_the_imported_one(shell, root):
    import json

    run_as_module(shell, "x = __name__\n", "json", root / "json.py", "%%save json.py")
    import json as again

    assert again is json
    assert shell.user_ns["x"] == "json"


def test_what_the_text_raises_comes_out(shell, root):
    with pytest.raises(ZeroDivisionError) as caught:
        run_as_module(shell, "1 / 0\n", "a.b", root / "b.py", "%%save b.py")
    assert "1 / 0" in "\n".join(caught.value._render_traceback_())
