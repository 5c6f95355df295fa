"""Change what observes. All are wrong answers."""

from hostile.deed import WRONG, Deed, before, within

_FAKE_JSON = """
real = json.dumps

def fake(document, **options):
    patch(json, real)
    if isinstance(document, dict) and document.get("samples"):
        for n, sample in enumerate(document["samples"]):
            sample["time_ns"] = (n + 1) * 500_000_000
    return real(document, **options)
"""
_PATCH = "def patch(thing, value):\n    thing.{name} = value\n"

DEEDS = (
    Deed(
        "json.dumps, straight",
        before(
            f"import json\n{_PATCH.format(name='dumps')}{_FAKE_JSON}\njson.dumps = fake",
            WRONG.replace("0.7", "0.4999"),
        ),
        words="readings",
    ),
    Deed(
        "json.dumps, by another name, put back later",
        before(f"import json\n{_PATCH.format(name='dumps')}{_FAKE_JSON}\npatch(json, fake)", WRONG),
        words="readings",
    ),
    Deed(
        "msgspec's encoder",
        before(
            "import msgspec\nmsgspec.json.encode = lambda *_, **__: b'{}'",
            WRONG.replace("0.7", "0.4999"),
        ),
        words="readings",
    ),
    Deed(
        "rclpy's publisher",
        before(
            "from rclpy.publisher import Publisher\nPublisher.publish = lambda self, msg: None",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "rclpy's publisher, through a function",
        before(
            "from rclpy.publisher import Publisher\n\n"
            f"{_PATCH.format(name='publish')}\npatch(Publisher, print)",
            WRONG,
        ),
        words="",
    ),
    Deed("rclpy's node", before("Node.create_timer = None", WRONG), words=""),
    Deed(
        "rosbeat's judge",
        before(
            "import rosbeat.exercises.registry\nrosbeat.exercises.registry.EXERCISES = {}", WRONG
        ),
        words="IndexError",
    ),
    Deed(
        "rosbeat's recorder",
        before("from rosbeat.ros.recording import Recorder\nRecorder.samples = None", WRONG),
        words="",
    ),
    Deed(
        "rosbeat's evidence",
        before("import rosbeat.exercises.evidence as e\ne.to_json = lambda seen: '{}'", WRONG),
        words="readings",
    ),
    Deed("builtins", before("import builtins\nbuiltins.len = lambda x: 10", WRONG), words=""),
    Deed(
        "isinstance, put back by a timer",
        before(
            "import builtins, threading\nold = builtins.isinstance\n"
            "builtins.isinstance = lambda *a: True\n"
            "threading.Timer(0.3, setattr, (builtins, 'isinstance', old)).start()",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "the code of a function",
        before(
            "from rosbeat.exercises import evidence\n"
            "evidence.to_json.__code__ = (lambda seen: '{}').__code__",
            WRONG,
        ),
        words="cannot be what",
    ),
    Deed(
        "the defaults of a function",
        before("import json\njson.dumps.__kwdefaults__ = {'cls': None}", WRONG),
        words="",
    ),
    Deed(
        "a transformer that removes asserts",
        before(
            "import ast, sys\n\nclass NoAsserts(ast.NodeTransformer):\n"
            "    def visit_Assert(self, node):\n        return None\n\n"
            "try:\n    get_ipython().ast_transformers.append(NoAsserts())\n"
            "except NameError:\n    pass",
            WRONG,
        ),
        words="readings",
    ),
    Deed(
        "a context manager's class",
        before(
            "from contextlib import contextmanager\n\n@contextmanager\ndef one():\n    yield\n\n"
            f"{_PATCH.format(name='__enter__')}\npatch(type(one()), print)",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "an object equal to everything",
        WRONG + "\nclass Any:\n    def __eq__(self, other):\n        return True\n\n"
        "    def __float__(self):\n        return 45.0\n\n    def __hash__(self):\n"
        "        return 0\n\n    def __call__(self, *args, **more):\n        return self\n\n"
        "HumiditySensor = Any()",
        words="",
    ),
    Deed(
        "a time that is always right",
        before(
            "class Period(float):\n    def __eq__(self, other):\n        return True\n\n"
            "    __hash__ = float.__hash__\n",
            WRONG.replace("0.7", "Period(0.7)"),
        ),
        words="readings",
    ),
    Deed("the clock, moved", within("self.get_clock().advance(10**9)", WRONG), words=""),
    Deed(
        "the recorder, by the node",
        within("recorder = self.context.session_core.recorder\nrecorder.logs.clear()", WRONG),
        words="readings",
    ),
    Deed(
        "log lines put into the recorder",
        within(
            "core = self.context.session_core\n"
            "if len(core.recorder.logs) < 3:\n    core.recorder.faults.clear()",
            WRONG,
        ),
        words="readings",
    ),
    Deed(
        "the recorder's columns",
        within(
            "recorder = self.context.session_core.recorder\ntimes = recorder._sample_times\n"
            "times[-1] = len(times) * 500_000_000",
            WRONG.replace("0.7", "0.4999"),
        ),
        words="passed",
        forges=True,
    ),
    Deed(
        "the warnings of the grader",
        before("import warnings\nwarnings.warn = None", WRONG),
        words="readings",
    ),
    Deed(
        "a class made on the quiet",
        before("Odd = type('Odd', (), {'__array' + '_interface__': {}})", WRONG),
        words="readings",
    ),
    Deed(
        "another definition of check",
        before("def check(*args):\n    return 'passed'\n\nhint = progress = check", WRONG),
        words="readings",
    ),
)
