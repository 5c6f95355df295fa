"""Record what a session published as rosbag2 bags; read, replay and break recordings.

- `record` writes a bag, as MCAP or as SQLite, that other ROS 2 tools can open too (`recording`);
- `Bag` reads a bag from any source (`bag`);
- `replay` turns a bag into a node that publishes everything again, in virtual time (`replaying`);
- `compare` lists the differences between two runs;
- `stuck`, `drift`, `dropouts` and `with_nan` are faults, applied with `inject` or on replay
  (`faults`).

`serialization` converts messages to bytes and back; `arguments` reads what these functions are
given.
Names load when they are first used (PEP 562): only `replay` needs ROS.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rosbeat.bags.bag import Bag as Bag
    from rosbeat.bags.faults import drift as drift
    from rosbeat.bags.faults import dropouts as dropouts
    from rosbeat.bags.faults import inject as inject
    from rosbeat.bags.faults import stuck as stuck
    from rosbeat.bags.faults import with_nan as with_nan
    from rosbeat.bags.recording import record as record
    from rosbeat.bags.replaying import replay as replay
    from rosbeat.comparisons import compare as compare

_FAULTS = ("drift", "dropouts", "inject", "stuck", "with_nan")
_HOMES = {
    "Bag": "rosbeat.bags.bag",
    "compare": "rosbeat.comparisons",
    "record": "rosbeat.bags.recording",
    "replay": "rosbeat.bags.replaying",
    **dict.fromkeys(_FAULTS, "rosbeat.bags.faults"),
}
__all__ = sorted(_HOMES)


def __getattr__(name: str) -> Any:  # noqa: ANN401 - the type depends on the name
    """Load a public name when it is first used."""
    if name not in _HOMES:
        raise AttributeError(f"module 'rosbeat.bags' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    """List the public names, so that completion offers them before they are loaded."""
    return list(__all__)
