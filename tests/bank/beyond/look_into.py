"""11a, look into a bag: answers."""

from bank.answer import edited, either, right, wrong

BASE = """
    def look_into(bag):
        readings = bag.messages("temperature")
        gaps = [later.time - one.time for one, later in zip(readings, readings[1:])]
        numbers = [one.value for one in readings if not math.isnan(one.value)]
        mean = sum(numbers) / len(numbers)
        return {"messages": len(readings), "gap": max(gaps), "mean": mean}
"""
_COUNT, _GAP, _MEAN = '"messages": len(readings)', '"gap": max(gaps)', '"mean": mean'
_ZIP = "later.time - one.time for one, later in zip(readings, readings[1:])"
_GOOD = "if not math.isnan(one.value)"
_DIVIDED = "sum(numbers) / len(numbers)"


def _right(name, *edits):
    return right("11a", name, edited(BASE, *edits))


def _wrong(name, mistake, *edits):
    return wrong("11a", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("11a", name, mistakes, edited(BASE, *edits))


RIGHT = (
    _right("as on the page"),
    _right("the bag counts", (_COUNT, '"messages": bag.counts["/temperature"]')),
    _right("a full name", ('"temperature"', '"/temperature"')),
    _right("more than was asked for", ('"mean": mean', '"mean": mean, "bag": repr(bag)')),
    _right("not equal to itself", (_GOOD, "if one.value == one.value")),
    _right("nanoseconds, divided",
           (_ZIP, "(b.time_ns - a.time_ns) / 1_000_000_000 "
                  "for a, b in zip(readings, readings[1:])")),
    _right("rounded to two decimals", (_MEAN, '"mean": round(mean, 2)'),
           (_GAP, '"gap": round(max(gaps), 2)')),
    _right("by index", (_ZIP, "readings[k].time - readings[k - 1].time "
                              "for k in range(1, len(readings))")),
    _right("sorted gaps", (_GAP, '"gap": sorted(gaps)[-1]')),
    _right("an if with an else", (_GAP, '"gap": max(gaps) if gaps else 0.0')),
    right("11a", "statistics and pairwise", '''
        from itertools import pairwise
        from statistics import fmean

        def look_into(bag):
            seen = bag.messages("temperature")
            return dict(
                messages=len(seen),
                gap=max(b.time - a.time for a, b in pairwise(seen)),
                mean=fmean(one.value for one in seen if not math.isnan(one.value)),
            )
    '''),
    right("11a", "numpy", '''
        import numpy as np

        def look_into(bag):
            seen = bag.messages("temperature")
            times = np.array([one.time for one in seen])
            values = np.array([one.value for one in seen])
            return {
                "messages": int(times.size),
                "gap": float(np.diff(times).max()),
                "mean": float(np.nanmean(values)),
            }
    '''),
    right("11a", "one loop", '''
        def look_into(bag):
            count, total, numbers, longest, before = 0, 0.0, 0, 0.0, None
            for one in bag.messages("temperature"):
                count += 1
                if before is not None:
                    longest = max(longest, one.time - before)
                before = one.time
                if not math.isnan(one.value):
                    total += one.value
                    numbers += 1
            return {"messages": count, "gap": longest, "mean": total / numbers}
    '''),
    right("11a", "from the observation, in a class", '''
        class Report:
            def __init__(self, samples):
                self.rows = [s for s in samples if s.topic == "/temperature"]

            @property
            def numbers(self):
                return list(filter(math.isfinite, (s.value for s in self.rows)))

            def gap(self):
                times = [s.time for s in self.rows]
                return max(map(float.__sub__, times[1:], times))

        def look_into(bag):
            report = Report(bag.observation().samples)
            mean = math.fsum(report.numbers) / len(report.numbers)
            return {"messages": len(report.rows), "gap": report.gap(), "mean": mean}
    '''),
)  # fmt: skip

WRONG = (
    # How many.
    _wrong("all topics", "all-topics", (_COUNT, '"messages": len(bag)')),
    _wrong("all counts", "all-topics", (_COUNT, '"messages": sum(bag.counts.values())')),
    _wrong("NaN is not counted", "nan-left-out", (_COUNT, '"messages": len(numbers)')),
    _wrong("the gaps are counted", "counted-wrong", (_COUNT, '"messages": len(gaps)')),
    _wrong("one too many", "counted-wrong", (_COUNT, '"messages": len(readings) + 1')),
    _wrong("the messages themselves", "no-number", (_COUNT, '"messages": numbers')),
    _wrong("a number as a text", "no-number", (_COUNT, '"messages": str(len(readings))')),
    _wrong("the first bag by heart", "fixed-answer", (_COUNT, '"messages": 5')),
    # The gap.
    _wrong("nanoseconds", "wrong-unit",
           (_ZIP, "later.time_ns - one.time_ns for one, later in zip(readings, readings[1:])")),
    _wrong("milliseconds", "wrong-unit", (_GAP, '"gap": max(gaps) * 1000')),
    _wrong("the shortest", "other-gap", (_GAP, '"gap": min(gaps)')),
    _wrong("the first", "other-gap", (_GAP, '"gap": gaps[0]')),
    _wrong("the last", "other-gap", (_GAP, '"gap": gaps[-1]')),
    _wrong("from the first to the last", "other-gap",
           (_GAP, '"gap": readings[-1].time - readings[0].time')),
    _wrong("the bag's duration", "other-gap", (_GAP, '"gap": bag.duration')),
    _wrong("the mean gap", "other-gap", (_GAP, '"gap": sum(gaps) / len(gaps)')),
    _wrong("backwards", "other-gap", (_GAP, '"gap": min(one.time - later.time for one, later in '
                                            "zip(readings, readings[1:]))")),
    _wrong("the beginning counts", "other-gap",
           (_GAP, '"gap": max([readings[0].time, *gaps])')),
    _wrong("only between numbers", "nan-left-out",
           ("    gaps", "    good = [r for r in readings if not math.isnan(r.value)]\n"
                        "    gaps"),
           ("zip(readings, readings[1:])", "zip(good, good[1:])")),
    _wrong("all gaps", "no-number", (_GAP, '"gap": gaps')),
    # The mean.
    _wrong("NaN in the sum", "nan-spreads", (f" {_GOOD}", "")),
    _wrong("compared with NaN", "nan-spreads", (_GOOD, "if one.value != math.nan")),
    _wrong("is NaN", "nan-spreads", (_GOOD, "if one.value is not math.nan")),
    _wrong("NaN is nothing", "wrong-share", (_DIVIDED, "sum(numbers) / len(readings)")),
    _wrong("NaN becomes 0", "wrong-share",
           (f"[one.value for one in readings {_GOOD}]",
            "[0.0 if math.isnan(one.value) else one.value for one in readings]")),
    _wrong("the sum", "other-mean", (_DIVIDED, "sum(numbers)")),
    _wrong("a whole number", "other-mean", (_DIVIDED, "sum(numbers) // len(numbers)")),
    _wrong("rounded", "other-mean", (_DIVIDED, "round(sum(numbers) / len(numbers))")),
    _wrong("the median", "other-mean",
           ("def look", "from statistics import median\n\ndef look"),
           (_DIVIDED, "median(numbers)")),
    _wrong("the middle of the extremes", "other-mean",
           (_DIVIDED, "(max(numbers) + min(numbers)) / 2")),
    _wrong("divided by one less", "counted-wrong",
           (_DIVIDED, "sum(numbers) / max(1, len(numbers) - 1)")),
    _wrong("the last reading", "wrong-values", (_DIVIDED, "numbers[-1]")),
    # What is given back.
    _wrong("no return", "returns-nothing", ("return {", "print({"), ("mean}", "mean})")),
    _wrong("a tuple", "no-dict",
           (f"{{{_COUNT}, {_GAP}, {_MEAN}}}", "len(readings), max(gaps), mean")),
    _wrong("other names", "key-missing", ('"messages"', '"count"')),
    _wrong("a capital", "key-missing", ('"gap"', '"Gap"')),
    _wrong("a result that is no data", "not-plain", (_COUNT, '"messages": readings')),
    _wrong("no quotes", "name-error", ('"temperature"', "temperature")),
    _wrong("a topic that is not there", "topic-misspelled", ('"temperature"', '"temperatur"')),
    _wrong("a list that is too short", "index-error", (_GAP, '"gap": gaps[3]')),
    _wrong("divided by nothing", "division-by-zero",
           (_DIVIDED, "sum(numbers) / (len(readings) - 5)")),
    _wrong("an attribute that is not there", "wrong-attribute",
           ("one.value for", "one.data.value for")),
    _wrong("it does not end", "does-not-return",
           ("    gaps", "    while True:\n        pass\n    gaps")),
    wrong("11a", "the result, not the function", "no-function", edited(BASE), '{"messages": 3}'),
    # What a beginner writes.
    _wrong("all topics asked for", "argument-missing", ('"temperature"', "")),
    _wrong("a bag is no dict", "wrong-attribute",
           ('bag.messages("temperature")', 'bag["temperature"]')),
    _wrong("the data, not the value", "message-for-value", ("[one.value for", "[one.data for")),
    _wrong("nothing taken", "argument-missing", ("look_into(bag)", "look_into()")),
    _wrong("the whole run", "other-gap", (_GAP, '"gap": bag.seconds')),
    # Two.
    _either("all topics, and nanoseconds", ("all-topics", "wrong-unit"),
            (_COUNT, '"messages": len(bag)'), (_GAP, '"gap": max(gaps) * 1e9')),
    _either("NaN left out of everything", ("nan-left-out",),
            ('bag.messages("temperature")',
             '[r for r in bag.messages("temperature") if not math.isnan(r.value)]')),
    _either("NaN in the sum, and the shortest gap", ("nan-spreads", "other-gap"),
            (f" {_GOOD}", ""), (_GAP, '"gap": min(gaps)')),
    _either("gaps counted, and no return", ("counted-wrong", "returns-nothing"),
            (_COUNT, '"messages": len(gaps)'), ("return {", "print({"), ("mean}", "mean})")),
    _either("a text, and another name", ("no-number", "key-missing"),
            (_COUNT, '"messages": "5"'), ('"mean"', '"average"')),
    _either("the median in milliseconds", ("other-mean", "wrong-unit"),
            (_DIVIDED, "(max(numbers) + min(numbers)) / 2"), (_GAP, '"gap": max(gaps) * 1000')),
)  # fmt: skip

ANSWERS = (*RIGHT, *WRONG)
