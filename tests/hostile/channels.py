"""The channel by which evidence comes out: closed, flooded, forged."""

from hostile.deed import WRONG, Deed, before

_FORGED = '{"seen": "{}"}'
_FRAMES = """
import json, os, sys
frame = sys._getframe()
while frame and "seal" not in frame.f_locals:
    frame = frame.f_back
seal = frame.f_locals["seal"]
"""

DEEDS = (
    Deed("the channel closed", before("import os\nos.closerange(0, 100)", WRONG), words=""),
    Deed(
        "a result without a seal",
        before(f"import os\nos.write(3, b'{_FORGED}')\nos._exit(0)", WRONG),
        words="seal",
    ),
    Deed(
        "a result with a made-up seal",
        before(f"import os\nos.write(3, b'{'0' * 32}{_FORGED}')\nos._exit(0)", WRONG),
        words="seal",
    ),
    Deed(
        "a result in front of the course's",
        before(f"import os\nos.write(3, b'{_FORGED}')", WRONG),
        words="seal",
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
            f"{_FRAMES}\nos.write(3, (seal + json.dumps({{'seen': '[]'}})).encode())\nos._exit(0)",
            WRONG,
        ),
        words="cannot be",
    ),
    Deed(
        "a sealed result of other types",
        before(
            f"{_FRAMES}\nos.write(3, (seal + json.dumps({{'seen': 1, 'raised': 2, 'line': []}}))"
            ".encode())\nos._exit(0)",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "a sealed result, deeply nested",
        before(f"{_FRAMES}\nos.write(3, (seal + '[' * 100_000).encode())\nos._exit(0)", WRONG),
        words="seal",
    ),
    Deed(
        "a forged observation with the seal",
        before(
            f"{_FRAMES}\nfrom rosbeat.exercises.registry import scenario\n"
            "from rosbeat.exercises.evidence import to_json\n"
            "class Right(Node):\n    def __init__(self):\n"
            "        super().__init__('humidity_sensor')\n"
            "        self.p = self.create_publisher(Float32, 'humidity', 5)\n"
            "        self.create_timer(0.5, lambda: self.p.publish(Float32(data=1.0)))\n"
            "text = to_json(scenario('03a')(Right))\n"
            "os.write(3, (seal + json.dumps({'seen': text})).encode())\n"
            "os._exit(0)",
            WRONG,
        ),
        words="it was to last",
    ),
)
