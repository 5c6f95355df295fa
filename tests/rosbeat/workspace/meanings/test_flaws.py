import pytest

from rosbeat.workspace.meanings.flaws import flaw_in_words
from rosbeat.workspace.setup_script import EntryPoint
from rosbeat.workspace.targets import Flaw

ENTRY = EntryPoint("sensor = p.a:main", 26, "sensor", "p.a", "main")
KINDS = ("missing-comma", "no-equals", "bad-name", "slash", "suffix", "no-function-part",
         "no-module", "syntax-error", "no-function")  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_each_has_words_of_two_sentences(kind):
    said = flaw_in_words(Flaw(kind, ENTRY, "wrong", line=3))
    assert said
    assert "Error" not in said
    assert "None" not in said
