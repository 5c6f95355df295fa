"""What answers may import, and which names of it.

No exercise needs more. What is left out runs texts, reads what is behind a value by a name that is
given as text, starts processes, or is another module under a name of its own. What stands here is
looked up in the documentation of Python 3.10 to 3.13; a test walks through the real modules.
"""

from __future__ import annotations

import sys

#: Packages of ROS; all their parts are ordinary, but for those that lead elsewhere.
ROS = frozenset(
    (
        *("rclpy", "std_msgs", "std_srvs", "sensor_msgs", "geometry_msgs", "rcl_interfaces"),
        *("test_msgs", "builtin_interfaces", "example_interfaces", "action_msgs", "rosgraph_msgs"),
        *("diagnostic_msgs", "lifecycle_msgs", "nav_msgs", "tf2_msgs"),
    )
)
#: Modules of which every public name will do, unless it is another module's or left out below.
_WHOLE = frozenset(
    (
        *("math", "cmath", "random", "statistics", "collections", "collections.abc", "itertools"),
        *("datetime", "time", "re", "string", "typing", "abc", "operator", "json", "decimal"),
        *("fractions", "numbers", "textwrap", "heapq", "bisect", "queue", "struct", "sqlite3"),
        *(
            "calendar",
            "zlib",
            "__future__",
            "numpy",
            "numpy.random",
            "numpy.linalg",
            "json.decoder",
        ),
    )
)
#: Of these, only what is named.
_PARTS = {
    "functools": "partial partialmethod reduce wraps cache lru_cache cached_property cmp_to_key"
    " total_ordering",
    "types": "SimpleNamespace MappingProxyType NoneType",
    "enum": "Enum IntEnum StrEnum Flag IntFlag auto unique",
    "dataclasses": "dataclass field fields replace asdict astuple is_dataclass InitVar KW_ONLY"
    " FrozenInstanceError",
    "copy": "copy deepcopy",
    "contextlib": "suppress contextmanager nullcontext closing ExitStack AbstractContextManager"
    " asynccontextmanager AsyncExitStack",
    "threading": "Thread Lock RLock Event Timer Condition Semaphore BoundedSemaphore Barrier"
    " BrokenBarrierError current_thread get_ident active_count local",
    "asyncio": "sleep Lock Event Queue Semaphore Condition gather wait wait_for create_task run"
    " get_event_loop get_running_loop new_event_loop Future Task TimeoutError CancelledError"
    " ensure_future shield timeout TaskGroup",
    "concurrent": "futures",
    "concurrent.futures": "ThreadPoolExecutor Future as_completed wait TimeoutError",
    "weakref": "ref proxy WeakSet WeakValueDictionary WeakKeyDictionary WeakMethod finalize",
    "warnings": "warn simplefilter filterwarnings catch_warnings",
    "logging": "getLogger debug info warning error critical exception log Logger DEBUG INFO"
    " WARNING ERROR CRITICAL NullHandler StreamHandler Handler Formatter basicConfig",
    "sys": "exit argv",
}
#: What is left out: it reads attributes by text, runs text, opens files, or is a module.
_LEFT_OUT = frozenset(
    (
        *("attrgetter", "methodcaller", "Formatter", "get_type_hints", "ForwardRef", "call"),
        *("evaluate_forward_ref", "bltns", "stdlib_re", "sre_parse", "sre_compile", "yaml"),
        *("ament_index_python", "array", "impl", "importlib_resources", "dbapi2"),
        # Of NumPy.
        *("load", "save", "savez", "savez_compressed", "loadtxt", "savetxt", "genfromtxt", "lib"),
        *("fromfile", "fromregex", "memmap", "ctypeslib", "testing", "f2py", "distutils", "core"),
        *("compat", "DataSource", "rec", "ma", "matrixlib", "emath", "frompyfunc", "mtrand"),
    )
)
#: Names that are a function's or a class's, and a module's as well.
_BOTH = frozenset(("datetime", "time", "copy", "random", "bisect", "calendar", "warnings"))
#: `numpy.array` is no module.
_NUMPY = frozenset(("array", "random", "linalg"))
#: Modules in modules, which lead on to others.
_INNER_MODULES = frozenset(
    (
        *("json.scanner", "json.encoder", "json.decoder.scanner", "numpy.version"),
        *("numpy.exceptions", "numpy.dtypes", "numpy.random.bit_generator"),
    )
)
#: Modules of which `*` brings nothing else.
_BRINGS_ALL = frozenset(("math", "random", "time"))


def may_import(module: str) -> bool:
    """Whether answers may import a module.

    Args:
        module: Its dotted name.
    """
    parts = module.split(".")
    if parts[0] in ROS:
        return not any(one.startswith("_") or one in _LEFT_OUT for one in parts)
    return module in _WHOLE or module in _PARTS


def is_module(name: str) -> bool:
    """Whether a dotted name is that of a module which answers may import.

    Args:
        name: Such as `collections.abc`.
    """
    return name in _WHOLE or name in _PARTS or name in ROS


def may_use(module: str, name: str) -> bool:
    """Whether answers may use a name of a module.

    Args:
        module: A module that they may import.
        name: One name, without a dot.
    """
    if module in _PARTS:
        return name in _PARTS[module].split()
    if is_module(f"{module}.{name}") or (module == "numpy" and name in _NUMPY):
        return True
    if name == "*":
        return module in _BRINGS_ALL or module.rpartition(".")[2] in ("msg", "srv", "action")
    if name.startswith("_") or name in _LEFT_OUT or f"{module}.{name}" in _INNER_MODULES:
        return False
    if module.split(".")[0] in ROS:  # not `rclpy.utilities.os`; `rclpy.time` is its own
        own = module == "rclpy" and name in ("time", "logging")
        return own or name not in sys.stdlib_module_names
    return name not in sys.stdlib_module_names or name in _BOTH
