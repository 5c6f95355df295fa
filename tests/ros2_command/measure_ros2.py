"""How complete and how quick the command is: `measure_ros2.py [N [WORD ...]]`.

Starts four nodes in a domain of their own, one of which publishes 100 times a second, and calls
each command N times (100 by default), or those that have a WORD as command or verb. Prints one
line a command; pytest does not collect this.
"""

import sys
import time
from collections.abc import Callable
from contextlib import ExitStack
from statistics import median

from conftest import SOURCE, Ros2, demo_node

from rosbeat.domains import lease_domain

NODES = [("n1", "t1", 0.01), ("n2", "t2", 1.0), ("n3", "t3", 1.0), ("n4", "t4", 1.0)]
NODE_LIST = "/n1\n/n2\n/n3\n/n4\n"
TOPICS = {f"/{topic}" for _, topic, _ in NODES} | {f"/{name}/in" for name, _, _ in NODES}
SERVICE = ("service", "call", "/n3/enable", "std_srvs/srv/SetBool", "{data: true}")
COMMANDS: dict[tuple[str, ...], Callable[[str], bool]] = {
    ("pkg", "--help"): bool,
    ("pkg", "list"): bool,
    ("interface", "show", "sensor_msgs/msg/Temperature"): bool,
    ("node", "list"): lambda out: out == NODE_LIST,
    ("topic", "list"): lambda out: set(out.split()) >= TOPICS,
    ("topic", "echo", "--once", "/t1"): lambda out: out == "data: 25.5\n---\n",
    ("topic", "pub", "--once", "/n4/in", "std_msgs/msg/Float32", "{data: 1}"): bool,
    ("param", "get", "/n2", "rate"): lambda out: out == "Integer value is: 3\n",
    SERVICE: lambda out: "success=True" in out,
}


def measure(ros2: Ros2, words: tuple[str, ...], right: Callable[[str], bool], count: int) -> str:
    seconds, good = [], 0
    for _ in range(count):
        start = time.perf_counter()
        good += right(ros2.out(*words))
        seconds.append(time.perf_counter() - start)
    seconds.sort()
    late = seconds[int(0.95 * (count - 1))]
    return (
        f"{' '.join(words):60.60} right {good}/{count}  median {median(seconds):.3f} s  "
        f"95 % {late:.3f} s  worst {seconds[-1]:.3f} s"
    )


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    lease = lease_domain()
    ros2 = Ros2(
        ROS_DOMAIN_ID=str(lease.domain_id),
        FASTRTPS_DEFAULT_PROFILES_FILE=str(SOURCE / "ros2_command" / "data" / "fastdds.xml"),
    )
    with ExitStack() as stack:
        stack.callback(lease.release)
        for node in NODES:
            stack.enter_context(demo_node(ros2, *node))
        for words, right in COMMANDS.items():
            if sys.argv[2:] and words[0] not in sys.argv[2:] and words[1] not in sys.argv[2:]:
                continue
            print(measure(ros2, words, right, count), flush=True)


if __name__ == "__main__":
    main()
