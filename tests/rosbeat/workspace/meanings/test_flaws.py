import pytest

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.workspace.meanings.flaws import diagnose_flaw
from rosbeat.workspace.setup_script import EntryPoint
from rosbeat.workspace.targets import Flaw

ENTRY = EntryPoint("sensor = p.a:main", 26, "sensor", "p.a", "main")
KINDS = ("missing-comma", "no-equals", "bad-name", "slash", "suffix", "no-function-part",
         "called", "no-module", "syntax-error", "no-function")  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_each_has_words_of_two_sentences(kind):
    found = diagnose_flaw(Flaw(kind, ENTRY, "wrong", line=3))
    assert found.mistake in MISTAKES
    assert found.hint
    said = f"{found.evidence} {found.hint}"
    assert "Error" not in said
    assert "None" not in said
