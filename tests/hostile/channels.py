"""The channel by which evidence comes out: closed, flooded, forged."""

from hostile.deed import WRONG, Deed, before

_FORGED = '{"seen": "{}"}'
#: Finds what runs the page, and writes as it does.
FIND_PAGE = """
import gc, json, os, sys
(page,) = (one for one in gc.get_objects() if type(one).__name__ == "_Page")

def write(**said):
    page._write({"evidence": "03a", **said})
    page._write({"done": True})
    os._exit(0)
"""
#: The true evidence of the answer itself, changed.
_TRUE = f"""{FIND_PAGE}
from rosbeat.exercises.registry import scenario
from rosbeat.exercises.evidence import to_json

class Mine(Node):
    def __init__(self):
        super().__init__('humidity_sensor')
        self.p = self.create_publisher(Float32, 'humidity', 5)
        self.create_timer(0.7, lambda: self.p.publish(Float32(data=1.0)))

seen = json.loads(to_json(scenario('03a')(Mine, page._job.seeds['03a'])))
"""
_WRITE = "write(seen=json.dumps(seen))"


def _changed(change):
    return before(f"{_TRUE}\n{change}\n{_WRITE}", WRONG)


DEEDS = (
    Deed("the channel closed", before("import os\nos.closerange(0, 100)", WRONG), words=""),
    Deed(
        "a result without a seal",
        before(f"import os\nos.write(3, b'{_FORGED}')\nos._exit(0)", WRONG),
        words="left-early",
    ),
    Deed(
        "a result with a made-up seal",
        before(f"import os\nos.write(3, b'{'0' * 32}{_FORGED}')\nos._exit(0)", WRONG),
        words="left-early",
    ),
    Deed(
        "a result in front of the course's",
        before(f"import os\nos.write(3, b'{_FORGED}')", WRONG),
        words="readings",
    ),
    Deed(
        "a result behind the course's",
        before(
            "import os, threading, time\ndef later():\n    time.sleep(0.2)\n"
            "    os.write(3, b'{}')\nthreading.Thread(target=later, daemon=True).start()",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "a result of 100 MB",
        before("import os\nwhile True:\n    os.write(3, b'x' * 1_000_000)", WRONG),
        words="",
    ),
    Deed(
        "a result that is no text",
        before("import os\nos.write(3, bytes(range(256)))\nos._exit(0)", WRONG),
        words="seal",
    ),
    Deed(
        "a sealed result that is no evidence",
        before(
            f"{FIND_PAGE}\nwrite(seen='[]')",
            WRONG,
        ),
        words="cannot be",
    ),
    Deed(
        "a sealed result of other types",
        before(
            f"{FIND_PAGE}\nwrite(seen=1, raised=2, line=[])",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "a sealed result, deeply nested",
        before(f"{FIND_PAGE}\nwrite(report='[' * 100_000)", WRONG),
        words="seal",
    ),
    Deed(
        "a forged observation with the seal",
        before(
            f"{FIND_PAGE}\nfrom rosbeat.exercises.registry import scenario\n"
            "from rosbeat.exercises.evidence import to_json\n"
            "class Right(Node):\n    def __init__(self):\n"
            "        super().__init__('humidity_sensor')\n"
            "        self.p = self.create_publisher(Float32, 'humidity', 5)\n"
            "        self.create_timer(0.5, lambda: self.p.publish(Float32(data=1.0)))\n"
            "text = to_json(scenario('03a')(Right))\n"
            "write(seen=text)",
            WRONG,
        ),
        words="it was to last",
    ),
    Deed(
        "the channel read by the answer itself",
        before(
            "import os, threading\nreading = os.open('/proc/self/fd/3', os.O_RDONLY)\n"
            "def reads():\n    while True:\n        os.read(reading, 1)\n"
            "threading.Thread(target=reads, daemon=True).start()",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "another file in the channel's place",
        before("import os\nos.dup2(os.open('/tmp/x', os.O_CREAT | os.O_RDWR), 3)", WRONG),
        words="",
    ),
    Deed(
        "a channel of one page that does not wait",
        before("import fcntl, os\nfcntl.fcntl(3, 1031, 4096)\nos.set_blocking(3, False)", WRONG),
        words="",
    ),
    Deed(
        "two that answer",
        before("import os\nos.fork()", WRONG),
        words="",
    ),
    Deed(
        "a sealed result of ten million lists",
        before(
            f"{FIND_PAGE}\nbig = json.dumps('[' + '[],' * 10_000_000 + '[]]')\nwrite(seen=big)",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "a sealed exception in other alphabets",
        before(
            f"{FIND_PAGE}\nodd = '=1+1' + chr(0x202e) + chr(0xdfff) + chr(27) + '[2J' + chr(7)\n"
            "said = {'raised': '<b>' + odd, 'text': odd, 'line': 10**15,\n"
            "        'code': '<script>alert(1)</script>' + odd}\n"
            "write(**said)",
            WRONG,
        ),
        words="raised",
    ),
    Deed(
        "evidence of a run of years",
        _changed("seen['time_ns'] = 10**19"),
        words="it has lasted",
    ),
    Deed(
        "evidence of readings at no time",
        _changed("for one in seen['samples']:\n    one['time_ns'] = 10**300"),
        words="",
    ),
    Deed(
        "evidence with markup and formulas for names",
        _changed(
            "name = '=<script>alert(1)</script>' + chr(0x202e) + chr(27) + '[31m' + chr(0xd800)\n"
            "seen = json.loads(json.dumps(seen).replace('humidity', json.dumps(name)[1:-1]))"
        ),
        words="",
    ),
    Deed(
        "evidence of another exercise",
        _changed("seen = json.loads(to_json(scenario('04a')(Mine)))"),
        words="",
    ),
)
