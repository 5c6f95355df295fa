"""A node that publishes once: its name, its topic, and `reliable` or `best_effort` as arguments.

The reliable one stores its message for those who come late. Says `ready` when it is there, and ends
when its standard input does.
"""

import sys

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float32


def main() -> None:
    name, topic, reliability = sys.argv[1:4]
    strong = reliability == "reliable"
    profile = QoSProfile(
        depth=1,
        reliability=ReliabilityPolicy.RELIABLE if strong else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if strong else DurabilityPolicy.VOLATILE,
    )
    rclpy.init()
    node = Node(name)
    node.create_publisher(Float32, topic, profile).publish(Float32(data=25.5))
    print("ready", flush=True)
    sys.stdin.read()
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
