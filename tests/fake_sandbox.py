"""Takes the place of a sandbox of grading, and does what the cell of a page says."""

import json
import threading

from rosbeat.errors import GradingError
from rosbeat.exercises.evidence import to_json
from rosbeat.page_runs.sandbox import Ending
from rosbeat.records import LogRecord, Observation

_HEARD = LogRecord(1_000_000_000, "INFO", "rehearsal", "21.0", "hear", 12)


class FakeSandbox:
    """Answer each page that it is to run, and note what they say; the rehearsal goes well."""

    def __init__(self, isolated):
        self.isolated, self.never_starts = isolated, False
        self.words, self.starts, self.pid = [], 0, 0
        self._killed = threading.Event()

    def __enter__(self):
        self.starts += 1
        return self

    def __exit__(self, *_):
        pass

    def kill(self):
        """End it, for good."""
        self._killed.set()

    def run(self, work, limits):
        """Do what the first cell of a page says, and write what the course would write."""
        job, _, seal = work.args
        if self.never_starts or self._killed.is_set():
            raise ConnectionError
        if job.subjects == {"03a": "Rehearsal"}:
            return self._said(seal, to_json(Observation(5, 0, logs=(_HEARD,))))
        text = job.cells[0].source
        word = text.split()[0]
        self.words.append(text)
        if word == "die" or (word == "die-once" and self.words.count(text) == 1):
            raise ConnectionError
        if word == "silent":
            self._killed.wait(60)
            raise ConnectionError
        if word == "refuse":
            raise GradingError("No sandbox.", "Nothing was run.", "Try this.")
        return self._said("no seal" if word == "forged" else seal, text)

    def _said(self, seal, seen):
        lines = [{"evidence": "03a", "seen": seen}, {"done": True}]
        result = "".join(f"{seal}{json.dumps(line)}\n" for line in lines).encode()
        return Ending("ended", 0, result, 0.1)
