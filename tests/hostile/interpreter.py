"""The interpreter in which an answer is observed: hooks, limits, signals, standard output."""

from hostile.deed import TRACE, WRONG, Deed, before, within

DEEDS = (
    Deed(
        "an audit hook that refuses everything",
        before(
            "import sys\n\ndef refuse(event, args):\n    raise RuntimeError(event)\n\n"
            "sys.addaudithook(refuse)"
        ),
        words="exit code",
    ),
    Deed(
        "an audit hook that leaves",
        before("import os, sys\nsys.addaudithook(lambda event, args: os._exit(0))", WRONG),
        words="ended",
    ),
    Deed(
        "an import hook",
        before(
            "import importlib.machinery, sys, types\n\nclass Finder:\n"
            "    def find_spec(self, name, path=None, target=None):\n"
            "        return importlib.machinery.ModuleSpec(name, self)\n"
            "    def create_module(self, spec):\n        return types.ModuleType(spec.name)\n"
            "    def exec_module(self, module):\n"
            "        module.judge = module.to_json = lambda *args: 'passed'\n\n"
            "sys.meta_path.insert(0, Finder())\n"
            "for name in [one for one in sys.modules if one.startswith('rosbeat')]:\n"
            "    del sys.modules[name]",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "modules made empty",
        before(
            "import sys\nfor name, module in list(sys.modules.items()):\n"
            "    if name.startswith('rosbeat'):\n        vars(module).clear()",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "no import any more",
        before("import builtins\nbuiltins.__import__ = None", WRONG),
        words="",
    ),
    Deed(
        "open, exec, compile and print",
        before(
            "import builtins\nfor name in ('open', 'exec', 'compile', 'print', 'hasattr'):\n"
            "    setattr(builtins, name, lambda *a, **k: True)",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "an exit that does nothing",
        before("import os\nos._exit = print", WRONG),
        words="",
    ),
    Deed(
        "a standard output whose end never comes",
        before(
            "import sys\n\nclass Endless:\n    def write(self, text):\n        return len(text)\n"
            "    def flush(self):\n        while True:\n            pass\n\nsys.stdout = Endless()"
        ),
        passes=True,
    ),
    Deed(
        "a standard output that lies in the way",
        before(
            "import os, sys\nsys.stdout = sys.stderr = None\nos.close(1)\nos.dup2(3, 1)\n"
            "os.write(1, b'passed')",
            WRONG,
        ),
        words="AttributeError",
    ),
    Deed(
        "a profile function, in all threads",
        before(
            "import sys, threading\n\ndef profile(frame, event, arg):\n"
            "    frame.f_locals.update(period=0.5, seconds=0.5)\n\n"
            "sys.setprofile(profile)\nthreading.setprofile(profile)",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "a recursion limit of almost nothing",
        before("import sys\ntry:\n    sys.setrecursionlimit(40)\nexcept RecursionError:\n    pass",
               WRONG),
        words="",
    ),
    Deed(
        "the garbage collector, at each step",
        before(
            "import gc\ngc.set_threshold(1, 1, 1)\n"
            "gc.callbacks.append(lambda phase, info: None)",
            WRONG,
        ),
        words="readings",
    ),
    Deed(
        "a destructor that answers",
        before(
            "import os\n\nclass Late:\n    def __del__(self):\n"
            "        os.write(3, b'{\"seen\": \"\"}')\n\n"
            "import sys\nsys.modules['late'] = Late()",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "an alarm that ends it",
        before("import signal\nsignal.signal(signal.SIGALRM, signal.SIG_DFL)\n"
               "signal.setitimer(signal.ITIMER_REAL, 0.001, 0.001)\nwhile True:\n    pass"),
        words="SIGALRM",
    ),
    Deed(
        "an alarm that raises wherever it may",
        before(
            "import signal\n\ndef raises(*args):\n    raise TimeoutError\n\n"
            "signal.signal(signal.SIGALRM, raises)\n"
            "signal.setitimer(signal.ITIMER_REAL, 0.002, 0.002)",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "signals that are not heard",
        before(
            "import signal\nfor one in signal.valid_signals() - {signal.SIGKILL, signal.SIGSTOP}:\n"
            "    signal.signal(one, signal.SIG_IGN)\n"
            "signal.pthread_sigmask(signal.SIG_BLOCK, signal.valid_signals())\n"
            "while True:\n    pass"
        ),
        words="end",
    ),
    Deed(
        "limits of its own, of nothing",
        before(
            "import resource as r\nfor one in (r.RLIMIT_FSIZE, r.RLIMIT_NOFILE, r.RLIMIT_NPROC):\n"
            "    r.setrlimit(one, (0, 0))",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "another program in its place",
        before(f"import os\nos.execv('/bin/sh', ['sh', '-c', 'exit 0', '{TRACE}'])"),
        words="ended",
    ),
    Deed(
        "another program that writes where evidence goes",
        before(
            "import os, sys\nos.set_inheritable(3, True)\n"
            "program = 'import os; os.write(3, b\"passed\")'\n"
            "os.execv(sys.executable, [sys.executable, '-c', program])"
        ),
        words="left-early",
    ),
    Deed(
        "numbers with other values",
        before(
            "import ctypes\n"
            "ctypes.c_long.from_address(id(7) + 24).value = 10\n"
            "ctypes.c_double.from_address(id(0.5) + 16).value = 0.7",
            WRONG,
        ),
        words="",
    ),
    Deed(
        "a clock that stands",
        before(
            "import time\nfor name in ('monotonic', 'time', 'perf_counter'):\n"
            "    setattr(time, name, lambda: 0.0)\n"
            "    setattr(time, name + '_ns', lambda: 0)\ntime.sleep = lambda seconds: None",
            WRONG,
        ),
        words="readings",
    ),
    Deed(
        "a thread that goes on and lets nobody else run",
        within(
            "import threading, sys\nsys.setswitchinterval(1000)\n"
            "threading.Thread(target=lambda: sum(iter(int, 1)), daemon=True).start()",
            WRONG,
        ),
        words="",
    ),
)  # fmt: skip
