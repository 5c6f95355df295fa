"""Processes: ended, multiplied, left behind."""

from hostile.deed import RIGHT, TRACE, WRONG, Deed, before, within

_DETACHED = f"""
import subprocess, sys
subprocess.Popen(
    [sys.executable, "-c", "import time; time.sleep(600)", "{TRACE}"], start_new_session=True
)
"""

DEEDS = (
    Deed("endless loop", before("while True:\n    pass"), words="end"),
    Deed("endless loop in a callback", within("while True:\n    pass"), words="still running"),
    Deed("endless loop in C", before("sum(range(10**15))"), words="end"),
    Deed(
        "a thread that never ends",
        before(
            "import threading, time\nthreading.Thread(target=time.sleep, args=(10**6,)).start()"
        ),
        words="passed",
        passes=True,
    ),
    Deed("input", before("input()"), words="StdinNotImplementedError"),
    Deed("exit", before("raise SystemExit(0)"), words="SystemExit"),
    Deed("_exit with 0", before("import os\nos._exit(0)"), words="ended"),
    Deed("SIGKILL of itself", before("import os\nos.kill(os.getpid(), 9)"), words="SIGKILL"),
    Deed(
        "kill of the parent",
        before(
            "import os\ntry:\n    os.kill(os.getppid(), 9)\nexcept PermissionError:\n    pass\n"
            "os._exit(3)"
        ),
        words="exit code 3",
    ),
    Deed(
        "kill of everybody",
        before("import os\nos.kill(-1, 9)\nos._exit(4)"),
        words="ProcessLookupError",
    ),
    Deed("segmentation fault", before("import ctypes\nctypes.string_at(0)"), words="SIGSEGV"),
    Deed(
        "fork bomb",
        before(
            "import os\nwhile True:\n    try:\n        os.fork()\n    except OSError:\n        pass"
        ),
        words="",
    ),
    Deed("a detached process", before(_DETACHED), words="passed", passes=True),
    Deed(
        "a daemon",
        before(
            "import os, time\nif os.fork() == 0:\n    os.setsid()\n    if os.fork() == 0:\n"
            f"        open('/dev/shm/{TRACE}', 'w').close()\n"
            f"        open('/tmp/{TRACE}', 'w').close()\n"
            "        time.sleep(600)\n    os._exit(0)"
        ),
        words="passed",
        passes=True,
    ),
    Deed(
        "an object that is never freed",
        before(
            "class Bad:\n    def __del__(self):\n        while True:\n            pass\n\nBad()"
        ),
        words="passed",  # it is interrupted, as a learner does it on the page
        passes=True,
    ),
    Deed(
        "a main that spins until it is interrupted",
        RIGHT + "\nimport rclpy\n\ndef main():\n    rclpy.init()\n    node = HumiditySensor()\n"
        "    try:\n        rclpy.spin(node)\n    except KeyboardInterrupt:\n        pass\n"
        "    node.destroy_node()\n    rclpy.try_shutdown()\n\n"
        "if __name__ == '__main__':\n    main()\n",
        words="passed",
        passes=True,
    ),
    Deed(
        "an exit when Python ends",
        before("import atexit, os\natexit.register(os._exit, 0)", WRONG),
        words="readings",
    ),
)
