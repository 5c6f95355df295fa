"""08a, the last word waits: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class ModeKeeper(Node):
        def __init__(self):
            super().__init__("mode_keeper")
            qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
            self.modes = self.create_publisher(String, "mode", qos)
            self.create_subscription(String, "command", self.obey, 10)
            self.change("idle")

        def obey(self, msg):
            if msg.data != self.mode:
                self.change(msg.data)

        def change(self, mode):
            self.mode = mode
            self.modes.publish(String(data=mode))
"""
_QOS = "qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"


def _right(name, *edits):
    return right("08a", name, edited(BASE, *edits))


ANSWERS = (
    _right("as on the page", (_QOS, _QOS)),
    _right("all of it said",
           ("class M", "from rclpy.qos import HistoryPolicy\n\nclass M"),
           (_QOS, "qos = QoSProfile(\n            history=HistoryPolicy.KEEP_LAST,\n"
                  "            depth=1,\n"
                  "            reliability=ReliabilityPolicy.RELIABLE,\n"
                  "            durability=DurabilityPolicy.TRANSIENT_LOCAL,\n        )")),
    _right("set afterwards",
           (_QOS, "qos = QoSProfile(depth=1)\n"
                  "        qos.durability = DurabilityPolicy.TRANSIENT_LOCAL")),
    _right("a number for the policy", ("DurabilityPolicy.TRANSIENT_LOCAL", "1")),
    _right("the old name of the policies",
           ("class M", "from rclpy.qos import QoSDurabilityPolicy\n\nclass M"),
           ("durability=DurabilityPolicy", "durability=QoSDurabilityPolicy")),
    _right("an early return",
           ("if msg.data != self.mode:\n            self.change(msg.data)",
            "if msg.data == self.mode:\n            return\n        self.change(msg.data)")),
    _right("commands with a queue of one", ("self.obey, 10", "self.obey, 1")),
    _right("commands by best effort",
           ("self.obey, 10", "self.obey, qos_profile_sensor_data")),
    _right("the subscription first",
           ("        self.create_subscription(String, \"command\", self.obey, 10)\n", ""),
           ("        qos =",
            "        self.create_subscription(String, \"command\", self.obey, 10)\n        qos =")),
    _right("a copy of the message",
           ("String(data=mode)", "msg"),
           ("self.mode = mode",
            "self.mode = mode\n        msg = String()\n        msg.data = mode")),
    _right("a deadline that nobody asks for",
           ("depth=1,", "depth=1, deadline=Duration(seconds=60),")),
    right("08a", "a property that publishes", '''
        class Robot(Node):
            def __init__(self):
                super().__init__("robot")
                latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                self._out = self.create_publisher(String, "mode", latched)
                self._mode = None
                self.mode = "idle"
                self.create_subscription(String, "command", self.listen, 10)

            @property
            def mode(self):
                return self._mode

            @mode.setter
            def mode(self, word):
                if word == self._mode:
                    return
                self._mode = word
                self._out.publish(String(data=word))

            def listen(self, msg):
                self.mode = msg.data
    '''),
    right("08a", "closures, and no attribute", '''
        class Keeper(Node):
            def __init__(self):
                super().__init__("keeper")
                out = self.create_publisher(
                    msg_type=String,
                    topic="/mode",
                    qos_profile=QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL),
                )
                said = []

                def say(msg):
                    if not said or said[-1] != msg.data:
                        said.append(msg.data)
                        out.publish(msg)

                say(String(data="idle"))
                self.create_subscription(String, "/command", say, 10)
    '''),
    right("08a", "a message that is kept", '''
        class Keeper(Node):
            def __init__(self):
                super().__init__("keeper")
                kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                self.last = String(data="idle")
                self.publisher = self.create_publisher(String, "mode", kept)
                self.publisher.publish(self.last)
                self.create_subscription(String, "command", self.on_command, 10)

            def on_command(self, command):
                if command == self.last:
                    return
                self.last = command
                self.publisher.publish(command)
    '''),
    right("08a", "async, and type hints", '''
        from rclpy.publisher import Publisher

        class Keeper(Node):
            mode: str = "idle"

            def __init__(self) -> None:
                super().__init__("keeper")
                self.out: Publisher = self.create_publisher(
                    String, "mode", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                )
                self.tell()
                self.create_subscription(String, "command", self.obey, 10)

            def tell(self) -> None:
                self.out.publish(String(data=self.mode))

            async def obey(self, command: String) -> None:
                before, self.mode = self.mode, command.data
                if before != self.mode:
                    self.tell()
    '''),
)  # fmt: skip
