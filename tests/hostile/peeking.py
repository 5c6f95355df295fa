"""Reading what is nobody's business: the environment, the home, others' work, the solutions."""

from hostile.deed import CLASS, COURSE, FRIDGE, HOME, Deed, before, within

_TELL = "raise RuntimeError(repr(found)[:900])"


def _reads(name, code, words=""):
    return Deed(name, before(f"{code}\n{_TELL}"), words=words)


def _file(path):
    return f"found = open({path!r}).read()"


# Python's own packages are shown on purpose, and an answer has not the time to read them all. So is
# the folder of these tests, wherever the course lies.
_WALK = """
import os
found = []
for top in {tops!r}:
    for place, inner, names in os.walk(top):
        inner[:] = [one for one in inner if one != "site-packages"]
        inner[:] = [one for one in inner if os.path.join(place, one) != {course!r}]
        for name in names:
            if name.endswith((".ipynb", ".txt", ".jsonl", ".py")):
                try:
                    with open(os.path.join(place, name), errors="replace") as file:
                        text = file.read()
                except OSError:
                    continue
                if "canary" + "-5c1d" in text:
                    found.append((place, name, text[:200]))
"""

_MEMORY = """
import re
sought, count = re.compile(b"[c]anary-" + b"5c1d"), 0
with open("/proc/self/maps") as maps, open("/proc/self/mem", "rb", 0) as memory:
    for line in maps:
        start, end = (int(one, 16) for one in line.split()[0].split("-"))
        if "rw" in line and "stack" not in line:
            for at in range(start, end, 1 << 20):
                try:
                    memory.seek(at)
                    data = bytearray(memory.read(min(1 << 20, end - at)))
                except (OSError, OverflowError, ValueError):
                    continue
                count += len(sought.findall(data))
                data[:] = bytes(len(data))
found = f"found {count or 'nothing'}"
"""

DEEDS = (
    _reads("the environment", "import os\nfound = dict(os.environ)"),
    _reads("the environment it was started with", _file("/proc/self/environ")),
    _reads(
        "the environment of its parents",
        "found = [open(f'/proc/{n}/environ').read() for n in (1, 2)]",
    ),
    _reads("the home", _file(f"{HOME}/secret.txt"), "FileNotFoundError"),
    _reads(
        "another learner's page",
        _file(f"{CLASS}/honest-ana/03_write_a_publisher.ipynb"),
        "FileNotFoundError",
    ),
    _reads(
        "everything that can be walked to",
        _WALK.format(tops=("/tmp", "/dev", "/home"), course=COURSE),
        "[]",
    ),
    _reads(
        "the solutions", f"import os\nfound = os.listdir('{COURSE}/solutions')", "FileNotFoundError"
    ),
    _reads(
        "the sources of the lessons",
        f"import os\nfound = os.listdir('{COURSE}/src/lessons')",
        "FileNotFoundError",
    ),
    _reads(
        "the answers",
        "import os, rosbeat\n"
        "found = os.listdir(os.path.dirname(rosbeat.__file__) + '/exercises/solved')",
        "[]",
    ),
    _reads("the judges, imported", "from rosbeat.exercises import page_03 as found"),
    _reads(
        "what the grader has loaded",
        "import sys\nfound = [one for one in sys.modules if 'judging' in one or 'ledger' in one]",
        "[]",
    ),
    _reads(
        "what the grader remembers",
        "import sys\nframe, found = sys._getframe(), []\n"
        "while frame:\n    found += [value for value in frame.f_locals.values()"
        " if isinstance(value, str) and 'canary' + '-5c1d' in value]\n    frame = frame.f_back",
        "[]",
    ),
    _reads(
        "objects of the garbage collector",
        "import gc\nfound = [one for one in gc.get_objects()"
        " if isinstance(one, dict) and any(isinstance(v, str) and 'canary' + '-5c1d' in v"
        " for v in list(one.values()))][:1]",
        "[]",
    ),
    _reads("all of its memory", _MEMORY, "PermissionError"),
    _reads(
        "a socket of the machine's host",
        "import socket\nfound = socket.socket(40, socket.SOCK_STREAM)",
        "not supported",
    ),
    _reads(
        "a socket for packets",
        "import socket\nfound = socket.socket(17, socket.SOCK_RAW)",
        "not supported",
    ),
    _reads(
        "memory that belongs to nobody",
        "import os\nfound = os.memfd_create('x')",
        "PermissionError",
    ),
    _reads(
        "what the next answer of the learner leaves",
        "import os\nfound = sorted(os.listdir('/dev/shm'))",
        "[]",
    ),
    _reads(
        "the files of the sandbox's keeper",
        "import os\nfound = [os.readlink(f'/proc/1/fd/{n}') for n in range(20)]",
        "PermissionError",
    ),
    _reads(
        "a file system of one's own",
        "import ctypes\nfound = 'mount', ctypes.CDLL(None).mount(b'x', b'/tmp', b'tmpfs', 0, 0)",
        "('mount', -1)",
    ),
    _reads(
        "a user namespace of one's own",
        "import ctypes\nfound = 'unshare', ctypes.CDLL(None).unshare(0x10000000)",
        "('unshare', -1)",
    ),
    _reads(
        "the machine's cgroups",
        "import os\nfound = os.listdir('/sys/fs/cgroup')",
        "FileNotFoundError",
    ),
    _reads(
        "the seed of the class",
        "import os\nfound = [one for one, _, names in os.walk('/tmp') if 'seed' in names]",
        "[]",
    ),
    _reads(
        "the network",
        "import socket\nfound = socket.create_connection(('1.1.1.1', 53), timeout=1)",
        "OSError",
    ),
    _reads(
        "names of the network",
        "import socket\nfound = socket.getaddrinfo('pypi.org', 443)",
        "gaierror",
    ),
    _reads(
        "the machine",
        "import os, socket\nfound = (os.uname().nodename, socket.gethostname())",
        "sandbox",
    ),
    Deed(
        "topics of other submissions",
        within(
            "found = [name for name, _ in self.get_topic_names_and_types()]\n"
            "raise RuntimeError(str(sorted(found)))"
        ),
        words="/humidity', '/parameter_events', '/rosout']",
    ),
    Deed(
        "another process's domain",
        before(
            "import subprocess\n"
            "found = subprocess.run(['ros2', 'topic', 'list'], capture_output=True, text=True)\n"
            "assert set(found.stdout.split()) <= {'/parameter_events', '/rosout'}, found",
            FRIDGE,
        ),
        exercise="04a",
        words="",
        passes=True,  # the command is there, and hears nothing of what runs outside
    ),
)
