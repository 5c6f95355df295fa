"""Evidence made in advance: answers that look for what observes them, and put it right.

All are wrong answers. What was made in advance does not fit the seed of the class; what knows the
right answer, such as the times of each message, does: there is a solution inside.
"""

from hostile.channels import FIND_PAGE
from hostile.deed import WRONG, Deed, before

_EMPTY = "class HumiditySensor(Node):\n    def __init__(self):\n        super().__init__('x')\n"
_RIGHT_TIMES = "times[-1] = len(times) * 500_000_000"
_FIND = """
import gc, sys

def find(name):
    return [one for one in gc.get_objects() if type(one).__name__ == name]
"""

DEEDS = (
    Deed(
        "evidence written by what runs the page",
        before(
            f"{FIND_PAGE}\nfrom rosbeat.exercises.registry import EXERCISES\n"
            "class Right(Node):\n    def __init__(self):\n"
            "        super().__init__('humidity_sensor')\n"
            "        self.p = self.create_publisher(Float32, 'humidity', 5)\n"
            "        self.create_timer(0.5, lambda: self.p.publish(Float32(data=1.0)))\n"
            "write(seen=page._observed(EXERCISES['03a'], Right))",
            _EMPTY,
        ),
        forges=True,
    ),
    Deed(
        "the recorder, by the garbage collector",
        before(_FIND, WRONG.replace("0.7", "0.4999")) + "        for one in find('Recorder'):\n"
        f"            times = one._sample_times or [0]\n            {_RIGHT_TIMES}\n",
        forges=True,
    ),
    Deed(
        "another scenario in the observer's frame",
        before(
            "import sys\nframe = sys._getframe()\nwhile frame and 'run' not in frame.f_locals:\n"
            "    frame = frame.f_back\nrun = frame.f_locals['run'] if frame else None\n"
            "print(run)",
            _EMPTY,
        ),
        words="no-publisher",
    ),
    Deed(
        "evidence by another to_json",
        before(
            "import sys\nmodule = sys.modules['rosbeat.page_runs.page_process']\n"
            "real = module.to_json\n"
            "def fake(seen):\n"
            "    import dataclasses\n"
            "    samples = tuple(dataclasses.replace(one, time_ns=(n + 1) * 500_000_000)\n"
            "                    for n, one in enumerate(seen.samples))\n"
            "    return real(dataclasses.replace(seen, samples=samples))\n"
            "module.to_json = fake",
            WRONG.replace("0.7", "0.4999"),
        ),
        words="readings",
    ),
    Deed(
        "json's encoder",
        before(
            "import json\nreal = json.JSONEncoder.encode\n\ndef fake(self, document):\n"
            "    if isinstance(document, dict) and 'samples' in document:\n"
            "        for n, sample in enumerate(document['samples']):\n"
            "            sample['time_ns'] = (n + 1) * 500_000_000\n"
            "    return real(self, document)\n\njson.JSONEncoder.encode = fake",
            WRONG.replace("0.7", "0.4999"),
        ),
        words="readings",
    ),
    Deed(
        "the constructor of what is recorded",
        before(
            "from rosbeat.records import Sample\nreal = Sample.__init__\n\n"
            "def fake(self, time_ns, *args, **more):\n"
            "    real(self, round(time_ns / 5e8) * 500_000_000, *args, **more)\n\n"
            "Sample.__init__ = fake",
            WRONG,
        ),
        words="readings",
    ),
    Deed(
        "the class of the scenario's session",
        before(
            "import rosbeat.ros.scenario as s\nreal = s.observe\n"
            "s.observe = lambda *a, **k: real(*a, **{**k, 'seconds': 0.0})",
            _EMPTY,
        ),
    ),
    Deed(
        "an empty node that looks for a judge",
        before(
            f"{_FIND}\nfor one in find('Exercise'):\n"
            "    object.__setattr__(one, 'judge', lambda seen: 'passed')",
            _EMPTY,
        ),
        words="failed",
    ),
    Deed(
        "an empty node that names itself right",
        before(
            "import rosbeat.exercises.exercise as e\n"
            "e.failed = lambda *a, **k: e.passed('03a', 'ten readings')",
            _EMPTY,
        ),
        words="failed",
    ),
    Deed(
        "a judge in the sandbox that always agrees",
        before(
            "from rosbeat.exercises.registry import EXERCISES\n"
            "object.__setattr__(EXERCISES['03a'], 'judge', lambda seen: True)",
            _EMPTY,
        ),
        words="failed",
    ),
    Deed(
        "a trace function",
        before(
            "import sys\n\ndef trace(frame, event, arg):\n"
            "    if 'changed' in frame.f_locals:\n        frame.f_locals['changed'] = ()\n"
            "    return trace\n\nsys.settrace(trace)",
            WRONG,
        ),
    ),
    Deed(
        "a seal from memory that seals nothing",
        before(
            "import gc, os, re\nseals = [\n"
            "    one for some in gc.get_objects() if isinstance(some, tuple)\n"
            "    for one in some if isinstance(one, str) and re.fullmatch('[0-9a-f]{32}', one)]\n"
            "os.write(3, ((seals or ['0' * 32])[0] + '{\"seen\": \"{}\"}').encode())\nos._exit(0)",
            _EMPTY,
        ),
    ),
)
