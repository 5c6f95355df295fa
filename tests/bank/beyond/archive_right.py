"""08b, listen to everybody: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class Archive(Node):
        def __init__(self):
            super().__init__("archive")
            qos = QoSProfile(depth=16, reliability=ReliabilityPolicy.BEST_EFFORT)
            self.create_subscription(Float32, "reading", self.copy, qos)
            self.copies = self.create_publisher(Float32, "archive", 10)

        def copy(self, msg):
            self.copies.publish(msg)
"""
_QOS = "qos = QoSProfile(depth=16, reliability=ReliabilityPolicy.BEST_EFFORT)"


def _right(name, *edits):
    return right("08b", name, edited(BASE, *edits))


ANSWERS = (
    _right("as on the page", (_QOS, _QOS)),
    _right("some room", ("depth=16", "depth=20")),
    _right("much room", ("depth=16", "depth=1000")),
    _right("everything kept",
           ("class A", "from rclpy.qos import HistoryPolicy\n\nclass A"),
           ("depth=16", "history=HistoryPolicy.KEEP_ALL")),
    _right("set afterwards",
           (_QOS, "qos = QoSProfile(depth=16)\n"
                  "        qos.reliability = ReliabilityPolicy.BEST_EFFORT")),
    _right("a copy of the sensors' profile",
           ("class A", "from copy import copy\n\nclass A"),
           (_QOS, "qos = copy(qos_profile_sensor_data)\n        qos.depth = 16")),
    _right("whatever there is to be had",
           ("BEST_EFFORT", "BEST_AVAILABLE")),
    _right("calculated",
           ("depth=16", "depth=int(2 * 8 / 1.0)")),
    _right("the archive keeps its copies",
           ('"archive", 10', '"archive", QoSProfile(depth=100, '
                             'durability=DurabilityPolicy.TRANSIENT_LOCAL)')),
    _right("a message of its own",
           ("self.copies.publish(msg)", "self.copies.publish(Float32(data=msg.data))")),
    right("08b", "a subscription that hands over to the publisher", '''
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                copies = self.create_publisher(Float32, "archive", 10)
                self.create_subscription(
                    msg_type=Float32,
                    topic="/reading",
                    callback=lambda msg: copies.publish(msg),
                    qos_profile=QoSProfile(depth=32, reliability=ReliabilityPolicy.BEST_EFFORT),
                )
    '''),
    right("08b", "a list that a timer empties", '''
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                qos = QoSProfile(depth=50, reliability=ReliabilityPolicy.BEST_EFFORT)
                self.copies = self.create_publisher(Float32, "archive", 10)
                self.waiting = []
                self.create_subscription(Float32, "reading", self.waiting.append, qos)
                self.create_timer(0.25, self.write)

            def write(self):
                while self.waiting:
                    self.copies.publish(self.waiting.pop(0))
    '''),
    right("08b", "two subscriptions, each reading once", '''
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                self.copies = self.create_publisher(Float32, "archive", 10)
                self.seen = set()
                for reliability in (ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT):
                    qos = QoSProfile(depth=20, reliability=reliability)
                    self.create_subscription(Float32, "reading", self.copy, qos)

            def copy(self, msg):
                if msg.data not in self.seen:
                    self.seen.add(msg.data)
                    self.copies.publish(msg)
    '''),
    right("08b", "async, and raw bytes", '''
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                qos = QoSProfile(depth=16, reliability=ReliabilityPolicy.BEST_EFFORT)
                self.copies = self.create_publisher(Float32, "archive", 10)
                self.create_subscription(Float32, "reading", self.copy, qos, raw=True)

            async def copy(self, data):
                self.copies.publish(data)
    '''),
)  # fmt: skip
