"""12b, parameters that are checked: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.limits_right import BASE

_REGISTER = "self.add_on_set_parameters_callback(self.look)"
_UPDATE = "new.update({parameter.name: parameter.value for parameter in parameters})"
_GOOD = 'good = new["high"] > new["low"]'
_WHY = 'reason="" if good else "not above low"'
_BACK = f"return SetParametersResult(successful=good, {_WHY})"
_NOW = "now = self.limits()"


def _wrong(name, mistake, *edits):
    return wrong("12b", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("12b", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    _wrong("no return", "result-of-another-kind", (_BACK, "pass")),
    _wrong("a bare return", "result-of-another-kind", (_BACK, "return")),
    _wrong("returns True", "result-of-another-kind", (_BACK, "return good")),
    _wrong("returns a text", "result-of-another-kind", (_BACK, 'return "high must be above low"')),
    _wrong("returns the class", "result-of-another-kind", (_BACK, "return SetParametersResult")),
    _wrong("not registered", "not-validated", (_REGISTER, "pass")),
    _wrong("everything passes", "not-validated", (_GOOD, "good = True")),
    _wrong("the old ones are compared", "nonsense-accepted", (_UPDATE, "pass")),
    _wrong(
        "never successful",
        "good-value-refused",
        ("successful=good", "successful=False"),
        (_WHY, 'reason="no"'),
    ),
    _wrong("successful is left out", "good-value-refused", ("successful=good, ", "")),
    _wrong("upside down", "good-value-refused", (_GOOD, 'good = new["high"] < new["low"]')),
    _wrong(
        "whole numbers are compared",
        "good-value-refused",
        (_GOOD, 'good = int(new["high"]) > int(new["low"])'),
    ),
    _wrong(
        "a degree between them",
        "good-value-refused",
        (_GOOD, 'good = new["high"] - new["low"] >= 1.0'),
    ),
    _wrong("equal passes", "nonsense-accepted", (_GOOD, 'good = new["high"] >= new["low"]')),
    _wrong(
        "only high is looked at",
        "nonsense-accepted",
        (_UPDATE, "new.update({p.name: p.value for p in parameters if p.name == 'high'})"),
    ),
    _wrong(
        "only the first one counts",
        "validated-one-by-one",
        (_UPDATE, "new[parameters[0].name] = parameters[0].value"),
    ),
    _wrong(
        "one after the other",
        "validated-one-by-one",
        (
            _UPDATE,
            "good = True\n        for one in parameters:\n"
            "            now = {**new, one.name: one.value}\n"
            '            good = good and now["high"] > now["low"]',
        ),
        (_GOOD, "pass"),
    ),
    _wrong(
        "each against the old one",
        "validated-one-by-one",
        (_UPDATE, "old = self.limits()\n        values = {p.name: p.value for p in parameters}"),
        (
            _GOOD,
            'good = (values.get("high", old["high"]) > old["low"] and\n'
            '                old["high"] > values.get("low", old["low"]))',
        ),
    ),
    _wrong(
        "asks whether they are bad", "nan-accepted", (_GOOD, 'good = not new["high"] <= new["low"]')
    ),
    _wrong(
        "the name in quotes",
        "nonsense-accepted",
        (_UPDATE, 'for one in parameters:\n            new["one.name"] = one.value'),
    ),
    _wrong(
        "each one is taken for high",
        "nonsense-accepted",
        (_UPDATE, 'for one in parameters:\n            new["high"] = one.value'),
    ),
    _wrong(
        "the limits are read again",
        "nonsense-accepted",
        (_UPDATE, f"{_UPDATE}\n        new = self.limits()"),
    ),
    _wrong("no reason", "reason-missing", (f", {_WHY}", "")),
    _wrong(
        "the limits stand in the code",
        "accepted-and-lost",
        (_NOW, 'now = {"low": 20.0, "high": 26.0}'),
    ),
    _wrong(
        "read once",
        "accepted-and-lost",
        (_REGISTER, f"{_REGISTER}\n        self.first = self.limits()"),
        (_NOW, "now = self.first"),
    ),
    _wrong(
        "kept though refused",
        "refused-and-kept",
        (_REGISTER, f"{_REGISTER}\n        self.kept = self.limits()"),
        (_UPDATE, f"{_UPDATE}\n        self.kept = new"),
        (_NOW, "now = self.kept"),
    ),
    _wrong(
        "an exception instead of a refusal",
        "raised",
        (
            _BACK,
            'if not good:\n            raise ValueError("high must be above low")\n'
            "        return SetParametersResult(successful=True)",
        ),
    ),
    _either(
        "a field that is not there",
        ("parameter-for-value", "wrong-attribute"),
        ("parameter.value for", "parameter.number for"),
    ),
    _wrong("the reason is no text", "not-a-float", (_WHY, "reason=None")),
    _wrong(
        "a parameter for its value", "parameter-for-value", ("parameter.value for", "parameter for")
    ),
    _wrong("a keyword that is not there", "wrong-keyword", ("successful=good", "success=good")),
    _either(
        "another name, and the old limits",
        ("parameter-undeclared",),
        ('"high", 26.0', '"hihg", 26.0'),
    ),
    _either(
        "no reason, and equal passes",
        ("reason-missing", "nonsense-accepted"),
        (f", {_WHY}", ""),
        (_GOOD, 'good = new["high"] >= new["low"]'),
    ),
    _either(
        "returns True, and equal passes",
        ("result-of-another-kind",),
        (_BACK, "return True"),
        (_GOOD, 'good = new["high"] >= new["low"]'),
    ),
    _either(
        "not registered, and read once",
        ("not-validated", "accepted-and-lost"),
        (_REGISTER, "self.first = self.limits()"),
        (_NOW, "now = self.first"),
    ),
    _either(
        "one after the other, and no reason",
        ("validated-one-by-one", "reason-missing"),
        (_UPDATE, "new[parameters[0].name] = parameters[0].value"),
        (f", {_WHY}", ""),
    ),
)
