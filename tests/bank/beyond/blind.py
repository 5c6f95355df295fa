# ruff: noqa: E501
"""Answers to the exercises of pages 07 to 13 by somebody who has read the pages only.

They were written before any of them was run, and without a look at the judges. A right answer's
name says in which way it is unusual, a wrong one's which mistake it makes, in plain words.
Where the first run showed that the expectation was wrong and not the judge, it was corrected;
where the judge is wrong, or may be, the answer stands in `DISAGREE`.
"""

from bank.answer import either, right, wrong

# --------------------------------------------------------------------------------- 07a

_07A = (
    right(
        "07a",
        "dict() with a comprehension over pairs, the float 5.0",
        """
        def findings():
            keys = [
                ("publisher of /moisture", "/soil_probe"),
                ("type of /moisture", "std_msgs/msg/Int32"),
                ("messages a second on /moisture", 5.0),
                ("queue depth of /gardener for /moisture", 3),
                ("topic without a listener", "/lights"),
                ("topic without a publisher", "/light"),
                ("node that warns", "/lamp"),
                ("dry_below of /gardener", 35.0),
            ]
            return {key: value for key, value in keys}
    """,
    ),
    right(
        "07a",
        "names without the slash in front",
        """
        def findings():
            return {
                "publisher of /moisture": "soil_probe",
                "type of /moisture": "std_msgs/msg/Int32",
                "messages a second on /moisture": 5,
                "queue depth of /gardener for /moisture": 3,
                "topic without a listener": "lights",
                "topic without a publisher": "light",
                "node that warns": "lamp",
                "dry_below of /gardener": 35,
            }
    """,
    ),
    right(
        "07a",
        "a rate as hz measures it, 4.998",
        """
        def findings():
            found = dict.fromkeys(["topic without a listener"], "/lights")
            found["publisher of /moisture"] = "/soil_probe"
            found["type of /moisture"] = "std_msgs/msg/Int32"
            found["messages a second on /moisture"] = 4.998
            found["queue depth of /gardener for /moisture"] = 3
            found["topic without a publisher"] = "/light"
            found["node that warns"] = "/lamp"
            found["dry_below of /gardener"] = 35
            return found
    """,
    ),
    wrong(
        "07a",
        "light and lights are swapped",
        "sides-confused",
        """
        def findings():
            return {
                "publisher of /moisture": "/soil_probe",
                "type of /moisture": "std_msgs/msg/Int32",
                "messages a second on /moisture": 5,
                "queue depth of /gardener for /moisture": 3,
                "topic without a listener": "/light",
                "topic without a publisher": "/lights",
                "node that warns": "/lamp",
                "dry_below of /gardener": 35,
            }
    """,
    ),
    wrong(
        "07a",
        "the rate is the seconds between two messages",
        "period-for-rate",
        """
        def findings():
            return {
                "publisher of /moisture": "/soil_probe",
                "type of /moisture": "std_msgs/msg/Int32",
                "messages a second on /moisture": 0.2,
                "queue depth of /gardener for /moisture": 3,
                "topic without a listener": "/lights",
                "topic without a publisher": "/light",
                "node that warns": "/lamp",
                "dry_below of /gardener": 35,
            }
    """,
    ),
    wrong(
        "07a",
        "a listener is named as the publisher",
        "sides-confused",
        """
        def findings():
            return {
                "publisher of /moisture": "/gardener",
                "type of /moisture": "std_msgs/msg/Int32",
                "messages a second on /moisture": 5,
                "queue depth of /gardener for /moisture": 3,
                "topic without a listener": "/lights",
                "topic without a publisher": "/light",
                "node that warns": "/lamp",
                "dry_below of /gardener": 35,
            }
    """,
    ),
    wrong(
        "07a",
        "the type without its package",
        "name-incomplete",
        """
        def findings():
            return {
                "publisher of /moisture": "/soil_probe",
                "type of /moisture": "Int32",
                "messages a second on /moisture": 5,
                "queue depth of /gardener for /moisture": 3,
                "topic without a listener": "/lights",
                "topic without a publisher": "/light",
                "node that warns": "/lamp",
                "dry_below of /gardener": 35,
            }
    """,
    ),
    either(
        "07a",
        "the depth is guessed to be the usual 10",
        ("finding-wrong", "wrong-depth", "sides-confused"),
        """
        def findings():
            return {
                "publisher of /moisture": "/soil_probe",
                "type of /moisture": "std_msgs/msg/Int32",
                "messages a second on /moisture": 5,
                "queue depth of /gardener for /moisture": 10,
                "topic without a listener": "/lights",
                "topic without a publisher": "/light",
                "node that warns": "/lamp",
                "dry_below of /gardener": 35,
            }
    """,
    ),
    wrong(
        "07a",
        "print instead of return",
        "returns-nothing",
        """
        def findings():
            print({
                "publisher of /moisture": "/soil_probe",
                "type of /moisture": "std_msgs/msg/Int32",
                "messages a second on /moisture": 5,
                "queue depth of /gardener for /moisture": 3,
                "topic without a listener": "/lights",
                "topic without a publisher": "/light",
                "node that warns": "/lamp",
                "dry_below of /gardener": 35,
            })
    """,
    ),
)

# --------------------------------------------------------------------------------- 07b

_07B = (
    right(
        "07b",
        "properties, and a match statement",
        """
        class TunableMonitor(Node):
            LIMITS = {"low": 20.0, "high": 26.0}

            def __init__(self):
                super().__init__("tunable_monitor")
                for name, value in self.LIMITS.items():
                    self.declare_parameter(name, value)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            @property
            def low(self) -> float:
                return self.get_parameter("low").value

            @property
            def high(self) -> float:
                return self.get_parameter("high").get_parameter_value().double_value

            def listen(self, msg: Float32) -> None:
                match msg.data:
                    case warm if warm > self.high:
                        word = "High"
                    case cold if cold < self.low:
                        word = "Low"
                    case _:
                        word = "Normal"
                self.statuses.publish(String(data=word))
    """,
    ),
    right(
        "07b",
        "declare_parameters for both, get_parameters for both",
        """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameters("", [("low", 20.0), ("high", 26.0)])
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                low, high = (one.value for one in self.get_parameters(["low", "high"]))
                words = ("Low", "Normal", "High")
                status = words[1 + (msg.data > high) - (msg.data < low)]
                self.get_logger().debug(f"{msg.data=:.1f} {status=}")
                self.statuses.publish(String(data=status))
    """,
    ),
    right(
        "07b",
        "limits kept in attributes by a callback for set parameters",
        """
        from rcl_interfaces.msg import SetParametersResult


        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.low = self.declare_parameter("low", 20.0).value
                self.high = self.declare_parameter("high", 26.0).value
                self.add_on_set_parameters_callback(self.changed)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def changed(self, parameters):
                for one in parameters:
                    if one.name in ("low", "high"):
                        setattr(self, one.name, one.value)
                return SetParametersResult(successful=True)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
                self.statuses.publish(String(data=status))
    """,
    ),
    right(
        "07b",
        "a subclass of a monitor with constants",
        """
        class PlainMonitor(Node):
            low, high = 20.0, 26.0

            def __init__(self, name="plain_monitor"):
                super().__init__(name)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                status = String()
                status.data = "Normal"
                if msg.data > self.high:
                    status.data = "High"
                if msg.data < self.low:
                    status.data = "Low"
                self.statuses.publish(status)


        class TunableMonitor(PlainMonitor):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameter("low", PlainMonitor.low)
                self.declare_parameter("high", PlainMonitor.high)

            def listen(self, msg):
                self.low = self.get_parameter("low").value
                self.high = self.get_parameter("high").value
                super().listen(msg)
    """,
    ),
    right(
        "07b",
        "an async callback and a static helper",
        """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            @staticmethod
            def judge(value, low, high):
                if low <= value <= high:
                    return "Normal"
                return "High" if value > high else "Low"

            async def listen(self, msg):
                limits = [self.get_parameter_or(name).value for name in ("low", "high")]
                self.statuses.publish(String(data=self.judge(msg.data, *limits)))
    """,
    ),
    wrong(
        "07b",
        "the value is asked for only once, in the constructor",
        "parameter-frozen",
        """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.low = self.get_parameter("low").value
                self.high = self.get_parameter("high").value
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
                self.statuses.publish(String(data=status))
    """,
    ),
    wrong(
        "07b",
        ".value is forgotten",
        "parameter-for-value",
        """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                low = self.get_parameter("low")
                high = self.get_parameter("high")
                status = "High" if msg.data > high else "Low" if msg.data < low else "Normal"
                self.statuses.publish(String(data=status))
    """,
    ),
    wrong(
        "07b",
        "only low is declared",
        "parameter-undeclared",
        """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameter("low", 20.0)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                low = self.get_parameter("low").value
                high = self.get_parameter("high").value
                status = "High" if msg.data > high else "Low" if msg.data < low else "Normal"
                self.statuses.publish(String(data=status))
    """,
    ),
    either(
        "07b",
        "whole numbers as first values",
        ("parameter-type", "decimals-lost"),
        """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameter("low", 20)
                self.declare_parameter("high", 26)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                low = self.get_parameter("low").value
                high = self.get_parameter("high").value
                status = "High" if msg.data > high else "Low" if msg.data < low else "Normal"
                self.statuses.publish(String(data=status))
    """,
    ),
    either(
        "07b",
        "the first values are forgotten: declared with type only, values None",
        ("other-default", "parameter-undeclared", "argument-missing", "no-value-yet", "none-used"),
        """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameter("low")
                self.declare_parameter("high")
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                low = self.get_parameter("low").value
                high = self.get_parameter("high").value
                status = "High" if msg.data > high else "Low" if msg.data < low else "Normal"
                self.statuses.publish(String(data=status))
    """,
    ),
    wrong(
        "07b",
        "first values swapped, and asked for the other way round",
        "parameters-swapped",
        """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameter("low", 26.0)
                self.declare_parameter("high", 20.0)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                low = self.get_parameter("high").value
                high = self.get_parameter("low").value
                status = "High" if msg.data > high else "Low" if msg.data < low else "Normal"
                self.statuses.publish(String(data=status))
    """,
    ),
    wrong(
        "07b",
        "the limits are read after the status was made",
        "parameter-late",
        """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.low, self.high = 20.0, 26.0
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
                self.statuses.publish(String(data=status))
                self.low = self.get_parameter("low").value
                self.high = self.get_parameter("high").value
    """,
    ),
)

# --------------------------------------------------------------------------------- 07c

_07C = (
    right(
        "07c",
        "a lambda, a set of levels, and a dict",
        """
        class LogWatcher(Node):
            BAD = {Log.WARN, Log.ERROR, Log.FATAL}

            def __init__(self):
                super().__init__("log_watcher")
                names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(
                    Log,
                    "rosout",
                    lambda log: names.publish(String(data=log.name)) if log.level in self.BAD else None,
                    10,
                )
    """,
    ),
    right(
        "07c",
        "logs what it hears at level INFO, but not what it said itself",
        """
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                self.names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, 10)

            def hear(self, msg: Log) -> None:
                if msg.name == self.get_name():
                    return
                if msg.level < 30:
                    return
                self.get_logger().info(f"{msg.name!r} is not well")
                self.names.publish(String(data=msg.name))
    """,
    ),
    right(
        "07c",
        "deep queues, and a counter of warnings by name",
        """
        from collections import Counter


        class LogWatcher(Node):
            def __init__(self, **kwargs):
                super().__init__(node_name="watches_the_log", **kwargs)
                self.seen = Counter()
                self.pub = self.create_publisher(msg_type=String, topic="warnings", qos_profile=100)
                self.sub = self.create_subscription(
                    msg_type=Log, topic="/rosout", callback=self.hear, qos_profile=1000
                )

            def hear(self, line):
                if line.level > Log.INFO:
                    self.seen[line.name] += 1
                    out = String()
                    out.data = line.name
                    self.pub.publish(out)
    """,
    ),
    right(
        "07c",
        "a separate filter function, partial",
        """
        from functools import partial


        def pass_on(publisher, log):
            if is_bad(log):
                publisher.publish(String(data=str(log.name)))


        def is_bad(log):
            return int(log.level) >= int(Log.WARN)


        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                warnings = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", partial(pass_on, warnings), 10)
    """,
    ),
    either(
        "07c",
        "all but WARN itself: > instead of >=",
        ("level-missed", "boundary"),
        """
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                self.names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, 10)

            def hear(self, msg):
                if msg.level > Log.WARN:
                    self.names.publish(String(data=msg.name))
    """,
    ),
    wrong(
        "07c",
        "errors are no warnings: == Log.WARN",
        "level-missed",
        """
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                self.names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, 10)

            def hear(self, msg):
                if msg.level == Log.WARN:
                    self.names.publish(String(data=msg.name))
    """,
    ),
    wrong(
        "07c",
        "each name once",
        "said-once",
        """
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                self.names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, 10)
                self.seen = set()

            def hear(self, msg):
                if msg.level >= Log.WARN and msg.name not in self.seen:
                    self.seen.add(msg.name)
                    self.names.publish(String(data=msg.name))
    """,
    ),
    wrong(
        "07c",
        "msg.msg is published, not the name",
        "text-for-name",
        """
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                self.names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, 10)

            def hear(self, msg):
                if msg.level >= 30:
                    self.names.publish(String(data=msg.msg))
    """,
    ),
    wrong(
        "07c",
        "logs each line that it hears as a warning",
        "endless-chain",
        """
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                self.names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, 10)

            def hear(self, msg):
                if msg.level >= Log.WARN:
                    self.names.publish(String(data=msg.name))
                    self.get_logger().warning(f"{msg.name} warns")
    """,
    ),
    either(
        "07c",
        "looks for msg.data, which Log does not have",
        ("wrong-field", "wrong-attribute"),
        """
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                self.names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, 10)

            def hear(self, msg):
                if msg.data.level >= Log.WARN:
                    self.names.publish(String(data=msg.name))
    """,
    ),
    either(
        "07c",
        "listens to /logout, where nobody speaks",
        ("wrong-topic", "no-subscription", "topic-misspelled"),
        """
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                self.names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/logout", self.hear, 10)

            def hear(self, msg):
                if msg.level >= Log.WARN:
                    self.names.publish(String(data=msg.name))
    """,
    ),
)

# --------------------------------------------------------------------------------- 08a

_08A = (
    right(
        "08a",
        "a property that publishes when it is set",
        """
        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                latched = QoSProfile(
                    depth=1,
                    durability=DurabilityPolicy.TRANSIENT_LOCAL,
                    reliability=ReliabilityPolicy.RELIABLE,
                )
                self._mode = None
                self._out = self.create_publisher(String, "mode", latched)
                self.create_subscription(String, "command", lambda m: setattr(self, "mode", m.data), 10)
                self.mode = "idle"

            @property
            def mode(self):
                return self._mode

            @mode.setter
            def mode(self, new):
                if new == self._mode:
                    return
                self._mode = new
                self._out.publish(String(data=new))
    """,
    ),
    right(
        "08a",
        "the message itself is the state",
        """
        KEEP = QoSProfile(depth=1)
        KEEP.durability = DurabilityPolicy.TRANSIENT_LOCAL


        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                self.create_subscription(String, "command", self.obey, 10)
                self.modes = self.create_publisher(String, "mode", KEEP)
                self.current = String(data="idle")
                self.modes.publish(self.current)

            def obey(self, msg):
                if msg != self.current:
                    self.current = msg
                    self.modes.publish(msg)
                else:
                    self.get_logger().info("nothing new")
    """,
    ),
    wrong(
        "08a",
        "a text where rclpy wants a DurabilityPolicy",
        "wrong-argument",
        """
        from contextlib import suppress


        class ModeKeeper(Node):
            modes = ()

            def __init__(self):
                super().__init__("mode_keeper")
                self.history = []
                self.pub = self.create_publisher(
                    String, "/mode", QoSProfile(depth=1, durability="transient_local")
                )
                self.create_subscription(String, "/command", self.obey, QoSProfile(depth=50))
                self.obey(String(data="idle"))

            def obey(self, msg):
                with suppress(IndexError):
                    if self.history[-1] == msg.data:
                        return
                self.history.append(msg.data)
                self.pub.publish(msg)
    """,
    ),
    right(
        "08a",
        "a dataclass for the state",
        """
        from dataclasses import dataclass


        @dataclass
        class State:
            mode: str = ""

            def change(self, new: str) -> bool:
                changed = self.mode != new
                self.mode = new
                return changed


        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                self.modes = self.create_publisher(String, "mode", qos)
                self.create_subscription(String, "command", self.obey, 10)
                self.state = State()
                self.obey(String(data="idle"))

            def obey(self, msg):
                if self.state.change(msg.data):
                    self.modes.publish(String(data=self.state.mode))
    """,
    ),
    wrong(
        "08a",
        "the default QoS keeps nothing",
        "not-kept",
        """
        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                qos = QoSProfile(depth=1)
                self.modes = self.create_publisher(String, "mode", qos)
                self.create_subscription(String, "command", self.obey, 10)
                self.change("idle")

            def obey(self, msg):
                if msg.data != self.mode:
                    self.change(msg.data)

            def change(self, mode):
                self.mode = mode
                self.modes.publish(String(data=mode))
    """,
    ),
    wrong(
        "08a",
        "depth 10, so that older modes come, too",
        "old-words-too",
        """
        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                qos = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                self.modes = self.create_publisher(String, "mode", qos)
                self.create_subscription(String, "command", self.obey, 10)
                self.change("idle")

            def obey(self, msg):
                if msg.data != self.mode:
                    self.change(msg.data)

            def change(self, mode):
                self.mode = mode
                self.modes.publish(String(data=mode))
    """,
    ),
    wrong(
        "08a",
        "the mode is said again at each command",
        "status-repeated",
        """
        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                self.modes = self.create_publisher(String, "mode", qos)
                self.create_subscription(String, "command", self.obey, 10)
                self.change("idle")

            def obey(self, msg):
                self.change(msg.data)

            def change(self, mode):
                self.mode = mode
                self.modes.publish(String(data=mode))
    """,
    ),
    either(
        "08a",
        "nobody remembers the new mode",
        ("forgets-itself", "status-repeated", "change-missing"),
        """
        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                self.modes = self.create_publisher(String, "mode", qos)
                self.create_subscription(String, "command", self.obey, 10)
                self.mode = "idle"
                self.modes.publish(String(data="idle"))

            def obey(self, msg):
                if msg.data != self.mode:
                    self.modes.publish(String(data=msg.data))
    """,
    ),
    either(
        "08a",
        "no publish at the start",
        ("wrong-start", "change-missing"),
        """
        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                self.modes = self.create_publisher(String, "mode", qos)
                self.create_subscription(String, "command", self.obey, 10)
                self.mode = "idle"

            def obey(self, msg):
                if msg.data != self.mode:
                    self.mode = msg.data
                    self.modes.publish(msg)
    """,
    ),
    either(
        "08a",
        "transient local asked for of the commands, too: nobody offers it",
        ("qos-mismatch",),
        """
        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                self.modes = self.create_publisher(String, "mode", qos)
                self.create_subscription(String, "command", self.obey, qos)
                self.change("idle")

            def obey(self, msg):
                if msg.data != self.mode:
                    self.change(msg.data)

            def change(self, mode):
                self.mode = mode
                self.modes.publish(String(data=mode))
    """,
    ),
)

# --------------------------------------------------------------------------------- 08b

_08B = (
    right(
        "08b",
        "KEEP_ALL",
        """
        from rclpy.qos import HistoryPolicy


        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                qos = QoSProfile(
                    history=HistoryPolicy.KEEP_ALL, reliability=ReliabilityPolicy.BEST_EFFORT
                )
                self.create_subscription(Float32, "reading", self.copy, qos)
                self.copies = self.create_publisher(Float32, "archive", 10)

            def copy(self, msg):
                self.copies.publish(msg)
    """,
    ),
    right(
        "08b",
        "the preset of sensors, copied and made deeper; a lambda",
        """
        from copy import copy


        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                qos = copy(qos_profile_sensor_data)
                qos.depth = 100
                out = self.create_publisher(Float32, "archive", 100)
                self.create_subscription(Float32, "reading", out.publish, qos)
    """,
    ),
    right(
        "08b",
        "new messages, an async callback",
        """
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                self.create_subscription(
                    Float32,
                    "reading",
                    self.copy,
                    QoSProfile(depth=2 * 8 * 2, reliability=ReliabilityPolicy.BEST_EFFORT),
                )
                self.copies = self.create_publisher(Float32, "archive", QoSProfile(depth=32))
                self.kept = []

            async def copy(self, msg):
                self.kept.append(msg.data)
                self.copies.publish(Float32(data=self.kept[-1]))
    """,
    ),
    wrong(
        "08b",
        "reliable as ever: the new sensor is not heard",
        "qos-mismatch",
        """
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                qos = QoSProfile(depth=20)
                self.create_subscription(Float32, "reading", self.copy, qos)
                self.copies = self.create_publisher(Float32, "archive", 10)

            def copy(self, msg):
                self.copies.publish(msg)
    """,
    ),
    wrong(
        "08b",
        "8 seconds, depth 8: two sensors forgotten",
        "queue-too-short",
        """
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                qos = QoSProfile(depth=8, reliability=ReliabilityPolicy.BEST_EFFORT)
                self.create_subscription(Float32, "reading", self.copy, qos)
                self.copies = self.create_publisher(Float32, "archive", 10)

            def copy(self, msg):
                self.copies.publish(msg)
    """,
    ),
    wrong(
        "08b",
        "the ready profile for sensors has depth 5",
        "queue-too-short",
        """
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                self.create_subscription(Float32, "reading", self.copy, qos_profile_sensor_data)
                self.copies = self.create_publisher(Float32, "archive", 10)

            def copy(self, msg):
                self.copies.publish(msg)
    """,
    ),
    wrong(
        "08b",
        "one subscription for each sensor: the reliable one is heard twice",
        "heard-twice",
        """
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                old = QoSProfile(depth=20)
                new = QoSProfile(depth=20, reliability=ReliabilityPolicy.BEST_EFFORT)
                self.create_subscription(Float32, "reading", self.copy, old)
                self.create_subscription(Float32, "reading", self.copy, new)
                self.copies = self.create_publisher(Float32, "archive", 10)

            def copy(self, msg):
                self.copies.publish(msg)
    """,
    ),
    wrong(
        "08b",
        "a lifespan of 2 seconds throws waiting readings away",
        "lifespan-too-short",
        """
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                qos = QoSProfile(
                    depth=20,
                    reliability=ReliabilityPolicy.BEST_EFFORT,
                    lifespan=Duration(seconds=2),
                )
                self.create_subscription(Float32, "reading", self.copy, qos)
                self.copies = self.create_publisher(Float32, "archive", 10)

            def copy(self, msg):
                self.copies.publish(msg)
    """,
    ),
    wrong(
        "08b",
        "the deep queue at the publisher, not at the subscription",
        "queue-too-short",
        """
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                qos = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
                self.create_subscription(Float32, "reading", self.copy, qos)
                self.copies = self.create_publisher(Float32, "archive", 100)

            def copy(self, msg):
                self.copies.publish(msg)
    """,
    ),
)

# --------------------------------------------------------------------------------- 08c

_08C = (
    right(
        "08c",
        "lambdas, and a flag in place of a word",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.is_lost = False
                self.create_subscription(
                    Float32,
                    "temperature",
                    lambda msg: self.now_is(False),
                    QoSProfile(depth=1, deadline=Duration(seconds=2.0)),
                    event_callbacks=SubscriptionEventCallbacks(deadline=lambda event: self.now_is(True)),
                )

            def now_is(self, lost):
                if lost is not self.is_lost:
                    self.is_lost = lost
                    self.health.publish(String(data=("back", "lost")[lost]))
    """,
    ),
    right(
        "08c",
        "a helper class, nanoseconds, fields set afterwards",
        """
        class Switch:
            def __init__(self, say):
                self.say, self.word = say, "back"

            def to(self, word):
                if self.word == word:
                    return
                self.word = word
                self.say(String(data=word))


        class Watchdog(Node):
            PERIOD = Duration(nanoseconds=2_000_000_000)

            def __init__(self):
                super().__init__("watchdog")
                switch = Switch(self.create_publisher(String, "health", 10).publish)
                qos = QoSProfile(depth=10)
                qos.deadline = self.PERIOD
                events = SubscriptionEventCallbacks()
                events.deadline = lambda _: switch.to("lost")
                self.create_subscription(
                    Float32, "temperature", lambda _: switch.to("back"), qos, event_callbacks=events
                )
    """,
    ),
    right(
        "08c",
        "a timer in place of the deadline: an egg timer of 2 seconds",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.create_subscription(Float32, "temperature", self.on_reading, 10)
                self.egg = self.create_timer(2.000001, self.on_silence)
                self.egg.cancel()
                self.lost = False

            def on_reading(self, msg):
                self.egg.reset()
                if self.lost:
                    self.lost = False
                    self.health.publish(String(data="back"))

            def on_silence(self):
                self.egg.cancel()
                self.lost = True
                self.health.publish(String(data="lost"))
    """,
    ),
    wrong(
        "08c",
        "no deadline in the QoS, only the callback",
        "no-deadline",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.word = "back"
                qos = QoSProfile(depth=10)
                events = SubscriptionEventCallbacks(deadline=self.on_silence)
                self.create_subscription(
                    Float32, "temperature", self.on_reading, qos, event_callbacks=events
                )

            def on_silence(self, event):
                self.say("lost")

            def on_reading(self, msg):
                self.say("back")

            def say(self, word):
                if word != self.word:
                    self.word = word
                    self.health.publish(String(data=word))
    """,
    ),
    wrong(
        "08c",
        "the callback is forgotten, event_callbacks is not given",
        "deadline-unheard",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.word = "back"
                qos = QoSProfile(depth=10, deadline=Duration(seconds=2))
                self.create_subscription(Float32, "temperature", self.on_reading, qos)

            def on_silence(self, event):
                self.say("lost")

            def on_reading(self, msg):
                self.say("back")

            def say(self, word):
                if word != self.word:
                    self.word = word
                    self.health.publish(String(data=word))
    """,
    ),
    wrong(
        "08c",
        "lost is said in each further period",
        "status-repeated",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.lost = False
                qos = QoSProfile(depth=10, deadline=Duration(seconds=2))
                events = SubscriptionEventCallbacks(deadline=self.on_silence)
                self.create_subscription(
                    Float32, "temperature", self.on_reading, qos, event_callbacks=events
                )

            def on_silence(self, event):
                self.lost = True
                self.health.publish(String(data="lost"))

            def on_reading(self, msg):
                if self.lost:
                    self.lost = False
                    self.health.publish(String(data="back"))
    """,
    ),
    either(
        "08c",
        "back is said for each reading",
        ("back-too-often", "status-repeated"),
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.word = "back"
                qos = QoSProfile(depth=10, deadline=Duration(seconds=2))
                events = SubscriptionEventCallbacks(deadline=self.on_silence)
                self.create_subscription(
                    Float32, "temperature", self.on_reading, qos, event_callbacks=events
                )

            def on_silence(self, event):
                if self.word != "lost":
                    self.word = "lost"
                    self.health.publish(String(data="lost"))

            def on_reading(self, msg):
                self.word = "back"
                self.health.publish(String(data="back"))
    """,
    ),
    wrong(
        "08c",
        "a deadline of 1 second: more than the sensor promises",
        "qos-mismatch",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.word = "back"
                qos = QoSProfile(depth=10, deadline=Duration(seconds=1))
                events = SubscriptionEventCallbacks(deadline=self.on_silence)
                self.create_subscription(
                    Float32, "temperature", self.on_reading, qos, event_callbacks=events
                )

            def on_silence(self, event):
                self.say("lost")

            def on_reading(self, msg):
                self.say("back")

            def say(self, word):
                if word != self.word:
                    self.word = word
                    self.health.publish(String(data=word))
    """,
    ),
    either(
        "08c",
        "a number where a Duration belongs",
        ("wrong-argument", "raised"),
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.word = "back"
                qos = QoSProfile(depth=10, deadline=2)
                events = SubscriptionEventCallbacks(deadline=self.on_silence)
                self.create_subscription(
                    Float32, "temperature", self.on_reading, qos, event_callbacks=events
                )

            def on_silence(self, event):
                self.say("lost")

            def on_reading(self, msg):
                self.say("back")

            def say(self, word):
                if word != self.word:
                    self.word = word
                    self.health.publish(String(data=word))
    """,
    ),
    wrong(
        "08c",
        "on_silence without a parameter for the event",
        "callback-parameters",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.word = "back"
                qos = QoSProfile(depth=10, deadline=Duration(seconds=2))
                events = SubscriptionEventCallbacks(deadline=self.on_silence)
                self.create_subscription(
                    Float32, "temperature", self.on_reading, qos, event_callbacks=events
                )

            def on_silence(self):
                self.say("lost")

            def on_reading(self, msg):
                self.say("back")

            def say(self, word):
                if word != self.word:
                    self.word = word
                    self.health.publish(String(data=word))
    """,
    ),
)

# --------------------------------------------------------------------------------- 09a

_09A = (
    right(
        "09a",
        "looks twice a second at the node's clock, Duration compared",
        """
        from rclpy.duration import Duration


        class Watchman(Node):
            LIMIT = Duration(seconds=3)

            def __init__(self):
                super().__init__("watchman")
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.create_timer(0.5, self.look)
                self.heard_at = None
                self.is_lost = False

            def say(self, text):
                self.statuses.publish(String(data=text))

            def hear(self, msg):
                self.heard_at = self.get_clock().now()
                if self.is_lost:
                    self.say("back")
                self.is_lost = False

            def look(self):
                if self.heard_at is None or self.is_lost:
                    return
                if self.get_clock().now() - self.heard_at >= self.LIMIT:
                    self.is_lost = True
                    self.say("lost")
    """,
    ),
    right(
        "09a",
        "a new timer for each reading, the old one destroyed",
        """
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.egg_timer = None
                self.lost = False

            def hear(self, msg):
                if self.egg_timer is not None:
                    self.destroy_timer(self.egg_timer)
                self.egg_timer = self.create_timer(3.2, self.miss)
                if self.lost:
                    self.statuses.publish(String(data="back"))
                    self.lost = False

            def miss(self):
                self.destroy_timer(self.egg_timer)
                self.egg_timer = None
                self.lost = True
                self.statuses.publish(String(data="lost"))
    """,
    ),
    right(
        "09a",
        "a generator as the state machine",
        """
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.statuses = self.create_publisher(String, "status", 10)
                self.states = self.machine()
                next(self.states)
                self.create_subscription(Float32, "temperature", lambda msg: self.states.send("reading"), 10)
                self.timer = self.create_timer(1.0, lambda: self.states.send("tick"))

            def now(self) -> float:
                return self.get_clock().now().nanoseconds / 1e9

            def machine(self):
                while (yield) != "reading":
                    pass
                while True:
                    heard = self.now()
                    while True:
                        event = yield
                        if event == "reading":
                            heard = self.now()
                        elif self.now() - heard >= 3.0:
                            break
                    self.statuses.publish(String(data="lost"))
                    while (yield) != "reading":
                        pass
                    self.statuses.publish(String(data="back"))
    """,
    ),
    right(
        "09a",
        "a count of quarter seconds since the last reading, an enum",
        """
        from enum import Enum, auto


        class State(Enum):
            NEVER = auto()
            HERE = auto()
            LOST = auto()


        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.state, self.quarters = State.NEVER, 0
                self.create_timer(0.25, self.tick)

            def hear(self, msg):
                before, self.state, self.quarters = self.state, State.HERE, 0
                if before is State.LOST:
                    self.statuses.publish(String(data="back"))

            def tick(self):
                self.quarters += 1
                if self.state is State.HERE and self.quarters > 12:
                    self.state = State.LOST
                    self.get_logger().warning("no reading")
                    self.statuses.publish(String(data="lost"))
    """,
    ),
    wrong(
        "09a",
        "lost is said again and again: the timer goes on",
        "status-repeated",
        """
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.lost = False
                self.silence = self.create_timer(3.0, self.miss)
                self.silence.cancel()

            def hear(self, msg):
                self.silence.reset()
                if self.lost:
                    self.lost = False
                    self.statuses.publish(String(data="back"))

            def miss(self):
                self.lost = True
                self.statuses.publish(String(data="lost"))
    """,
    ),
    wrong(
        "09a",
        "the timer runs from the start: lost before the first reading",
        "lost-before-found",
        """
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.lost = False
                self.silence = self.create_timer(3.0, self.miss)

            def hear(self, msg):
                self.silence.reset()
                if self.lost:
                    self.lost = False
                    self.statuses.publish(String(data="back"))

            def miss(self):
                self.silence.cancel()
                self.lost = True
                self.statuses.publish(String(data="lost"))
    """,
    ),
    wrong(
        "09a",
        "the silence is measured when the next reading comes",
        "noticed-afterwards",
        """
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.heard = None

            def hear(self, msg):
                now = self.get_clock().now().nanoseconds
                if self.heard is not None and now - self.heard >= 3e9:
                    self.statuses.publish(String(data="lost"))
                    self.statuses.publish(String(data="back"))
                self.heard = now
    """,
    ),
    wrong(
        "09a",
        "time.time() in place of the node's clock",
        "silence-unnoticed",
        """
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_timer(0.5, self.look)
                self.heard, self.lost = None, False

            def hear(self, msg):
                self.heard = time.time()
                if self.lost:
                    self.lost = False
                    self.statuses.publish(String(data="back"))

            def look(self):
                if self.heard and not self.lost and time.time() - self.heard >= 3.0:
                    self.lost = True
                    self.statuses.publish(String(data="lost"))
    """,
    ),
    wrong(
        "09a",
        "back is not said",
        "back-missing",
        """
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.silence = self.create_timer(3.0, self.miss)
                self.silence.cancel()

            def hear(self, msg):
                self.silence.reset()

            def miss(self):
                self.silence.cancel()
                self.statuses.publish(String(data="lost"))
    """,
    ),
    wrong(
        "09a",
        "3e6 nanoseconds taken for 3 seconds",
        "noticed-early",
        """
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_timer(0.5, self.look)
                self.heard, self.lost = None, False

            def hear(self, msg):
                self.heard = self.get_clock().now().nanoseconds
                if self.lost:
                    self.lost = False
                    self.statuses.publish(String(data="back"))

            def look(self):
                if self.heard and not self.lost:
                    if self.get_clock().now().nanoseconds - self.heard >= 3e6:
                        self.lost = True
                        self.statuses.publish(String(data="lost"))
    """,
    ),
)

# --------------------------------------------------------------------------------- 09b

_09B = (
    right(
        "09b",
        "a deque, and a timer that looks ten times a second",
        """
        from collections import deque


        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.waiting = deque()
                self.until = None
                self.create_subscription(Int32, "order", self.take, 10)
                self.create_timer(1.0, self.beat)
                self.create_timer(0.1, self.look)

            def seconds(self):
                return self.get_clock().now().nanoseconds * 1e-9

            def beat(self):
                self.beats.publish(String(data=f"alive, {len(self.waiting)} waiting"))

            def take(self, msg):
                self.waiting.append(msg.data)
                self.begin()

            def begin(self):
                if self.until is None and self.waiting:
                    self.until = self.seconds() + 3.0

            def look(self):
                if self.until is not None and self.seconds() >= self.until - 1e-6:
                    self.until = None
                    self.dones.publish(Int32(data=self.waiting.popleft()))
                    self.begin()
    """,
    ),
    right(
        "09b",
        "a timer made for each order, which is destroyed when it is done",
        """
        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.create_subscription(Int32, "order", self.take, 10)
                self.orders = []
                self.job = None

            def take(self, msg):
                self.orders += [msg]
                self.start_next()

            def start_next(self):
                if self.job is None and self.orders:
                    order = self.orders.pop(0)
                    self.job = self.create_timer(3.0, lambda: self.done(order))

            def done(self, order):
                self.destroy_timer(self.job)
                self.job = None
                self.dones.publish(order)
                self.start_next()
    """,
    ),
    right(
        "09b",
        "finish times are computed at once; a heap",
        """
        import heapq


        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.create_timer(0.25, self.look)
                self.create_subscription(Int32, "order", self.take, 10)
                self.plan = []
                self.free_at = 0

            def take(self, msg):
                now = self.get_clock().now().nanoseconds
                self.free_at = max(self.free_at, now) + 3 * 10**9
                heapq.heappush(self.plan, (self.free_at, msg.data))

            def look(self):
                while self.plan and self.plan[0][0] <= self.get_clock().now().nanoseconds:
                    at, number = heapq.heappop(self.plan)
                    self.dones.publish(Int32(data=number))
    """,
    ),
    right(
        "09b",
        "the beats in a mixin class",
        """
        class BeatMixin:
            def start_beating(self):
                self._beats = self.create_publisher(String, "beat", 1)
                self._beat_timer = self.create_timer(1.0, self._beat)
                self._n = 0

            def _beat(self):
                self._n += 1
                self._beats.publish(String(data=str(self._n)))


        class SteadyWorker(BeatMixin, Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.start_beating()
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_subscription(Int32, "order", self.take, 10)
                self.waiting = []
                self.work = self.create_timer(3.0, self.finish, autostart=False)

            def take(self, msg):
                if not self.waiting:
                    self.work.reset()
                self.waiting.append(msg.data)

            def finish(self):
                first, *self.waiting = self.waiting
                self.dones.publish(Int32(data=first))
                if self.waiting:
                    return
                self.work.cancel()
    """,
    ),
    wrong(
        "09b",
        "sleeps three seconds: the beat waits",
        "beat-starved",
        """
        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.create_subscription(Int32, "order", self.take, 10)

            def take(self, msg):
                time.sleep(3.0)
                self.dones.publish(msg)
    """,
    ),
    wrong(
        "09b",
        "the timer begins anew when an order comes: the work takes longer",
        "work-too-long",
        """
        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.create_subscription(Int32, "order", self.take, 10)
                self.waiting = []
                self.work = self.create_timer(3.0, self.finish)
                self.work.cancel()

            def take(self, msg):
                self.waiting.append(msg.data)
                self.work.reset()

            def finish(self):
                self.dones.publish(Int32(data=self.waiting.pop(0)))
                if not self.waiting:
                    self.work.cancel()
    """,
    ),
    wrong(
        "09b",
        "the last order first: pop() without 0",
        "order-swapped",
        """
        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.create_subscription(Int32, "order", self.take, 10)
                self.waiting = []
                self.work = self.create_timer(3.0, self.finish)
                self.work.cancel()

            def take(self, msg):
                self.waiting.append(msg.data)
                if self.work.is_canceled():
                    self.work.reset()

            def finish(self):
                self.dones.publish(Int32(data=self.waiting.pop()))
                if not self.waiting:
                    self.work.cancel()
    """,
    ),
    wrong(
        "09b",
        "orders that come during work are forgotten",
        "order-lost",
        """
        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.create_subscription(Int32, "order", self.take, 10)
                self.order = None
                self.work = self.create_timer(3.0, self.finish)
                self.work.cancel()

            def take(self, msg):
                if self.order is None:
                    self.order = msg.data
                    self.work.reset()

            def finish(self):
                self.dones.publish(Int32(data=self.order))
                self.order = None
                self.work.cancel()
    """,
    ),
    wrong(
        "09b",
        "a timer for each order, all at once",
        "work-at-once",
        """
        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.create_subscription(Int32, "order", self.take, 10)

            def take(self, msg):
                def finish():
                    timer.cancel()
                    self.dones.publish(Int32(data=msg.data))

                timer = self.create_timer(3.0, finish)
    """,
    ),
    wrong(
        "09b",
        "the timer of the work is never stopped: pop from an empty list",
        "index-error",
        """
        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.create_subscription(Int32, "order", self.take, 10)
                self.waiting = []
                self.work = self.create_timer(3.0, self.finish)

            def take(self, msg):
                self.waiting.append(msg.data)

            def finish(self):
                self.dones.publish(Int32(data=self.waiting.pop(0)))
    """,
    ),
    either(
        "09b",
        "the timer runs all the time: the first order takes less than 3 seconds",
        ("work-too-short",),
        """
        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.create_subscription(Int32, "order", self.take, 10)
                self.waiting = []
                self.work = self.create_timer(3.0, self.finish)

            def take(self, msg):
                self.waiting.append(msg.data)

            def finish(self):
                if self.waiting:
                    self.dones.publish(Int32(data=self.waiting.pop(0)))
    """,
    ),
)

# --------------------------------------------------------------------------------- 09c

_09C = (
    right(
        "09c",
        "two decimals, a dataclass of limits, str.format",
        """
        from dataclasses import dataclass


        @dataclass(frozen=True)
        class Limits:
            low: float
            high: float

            def word(self, value: float) -> str:
                if value > self.high:
                    return "High"
                if value < self.low:
                    return "Low"
                return "Normal"


        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.statuses = self.create_publisher(String, "status", 10)
                self.limits = Limits(
                    self.declare_parameter("low", 20.0).value,
                    self.declare_parameter("high", 26.0).value,
                )
                self.declare_parameter("unit", "C")
                self.create_subscription(Float32, "reading", self.hear, 10)

            def hear(self, msg):
                unit = self.get_parameter("unit").value
                text = "{} {:.2f} {}".format(self.limits.word(msg.data), msg.data, unit)
                self.statuses.publish(String(data=text))
    """,
    ),
    right(
        "09c",
        "join of parts, round, a walrus",
        """
        class AnyMonitor(Node):
            defaults = {"low": 20.0, "high": 26.0, "unit": "C"}

            def __init__(self):
                super().__init__("any_monitor")
                self.declare_parameters(namespace="", parameters=list(self.defaults.items()))
                self.pub = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "reading", self.hear, 10)

            def __getitem__(self, name):
                return self.get_parameter(name).value

            def hear(self, msg):
                if (value := msg.data) < self["low"]:
                    word = "Low"
                elif value > self["high"]:
                    word = "High"
                else:
                    word = "Normal"
                self.pub.publish(String(data=" ".join([word, str(round(value, 3)), self["unit"]])))
    """,
    ),
    right(
        "09c",
        "percent formatting, all six decimals",
        """
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                for pair in (("low", 20.0), ("high", 26.0), ("unit", "C")):
                    setattr(self, pair[0] + "_", self.declare_parameter(*pair).value)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "reading", self.hear, 10)

            def word(self, x):
                return ["Normal", "High", "Low"][(x > self.high_) - (x < self.low_)]

            def hear(self, msg):
                self.statuses.publish(String(data="%s %f %s" % (self.word(msg.data), msg.data, self.unit_)))
    """,
    ),
    wrong(
        "09c",
        "an absolute name: /status",
        "absolute-name",
        """
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.statuses = self.create_publisher(String, "/status", 10)
                self.low = self.declare_parameter("low", 20.0).value
                self.high = self.declare_parameter("high", 26.0).value
                self.unit = self.declare_parameter("unit", "C").value
                self.create_subscription(Float32, "reading", self.hear, 10)

            def hear(self, msg):
                word = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
                self.statuses.publish(String(data=f"{word} {msg.data:.1f} {self.unit}"))
    """,
    ),
    wrong(
        "09c",
        "the C stands in the text",
        "unit-fixed",
        """
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.statuses = self.create_publisher(String, "status", 10)
                self.low = self.declare_parameter("low", 20.0).value
                self.high = self.declare_parameter("high", 26.0).value
                self.unit = self.declare_parameter("unit", "C").value
                self.create_subscription(Float32, "reading", self.hear, 10)

            def hear(self, msg):
                word = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
                self.statuses.publish(String(data=f"{word} {msg.data:.1f} C"))
    """,
    ),
    wrong(
        "09c",
        "limits declared and not used",
        "limits-fixed",
        """
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.statuses = self.create_publisher(String, "status", 10)
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.unit = self.declare_parameter("unit", "C").value
                self.create_subscription(Float32, "reading", self.hear, 10)

            def hear(self, msg):
                word = "High" if msg.data > 26.0 else "Low" if msg.data < 20.0 else "Normal"
                self.statuses.publish(String(data=f"{word} {msg.data:.1f} {self.unit}"))
    """,
    ),
    wrong(
        "09c",
        "the reading as a whole number",
        "decimals-lost",
        """
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.statuses = self.create_publisher(String, "status", 10)
                self.low = self.declare_parameter("low", 20.0).value
                self.high = self.declare_parameter("high", 26.0).value
                self.unit = self.declare_parameter("unit", "C").value
                self.create_subscription(Float32, "reading", self.hear, 10)

            def hear(self, msg):
                word = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
                self.statuses.publish(String(data=f"{word} {msg.data:.0f} {self.unit}"))
    """,
    ),
    either(
        "09c",
        "the unit right behind the number, without a space",
        ("wrong-form", "space-missing"),
        """
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.statuses = self.create_publisher(String, "status", 10)
                self.low = self.declare_parameter("low", 20.0).value
                self.high = self.declare_parameter("high", 26.0).value
                self.unit = self.declare_parameter("unit", "C").value
                self.create_subscription(Float32, "reading", self.hear, 10)

            def hear(self, msg):
                word = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
                self.statuses.publish(String(data=f"{word} {msg.data:.1f}{self.unit}"))
    """,
    ),
    wrong(
        "09c",
        "the limits belong to Low and High: >= and <=",
        "boundary",
        """
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.statuses = self.create_publisher(String, "status", 10)
                self.low = self.declare_parameter("low", 20.0).value
                self.high = self.declare_parameter("high", 26.0).value
                self.unit = self.declare_parameter("unit", "C").value
                self.create_subscription(Float32, "reading", self.hear, 10)

            def hear(self, msg):
                word = "High" if msg.data >= self.high else "Low" if msg.data <= self.low else "Normal"
                self.statuses.publish(String(data=f"{word} {msg.data:.1f} {self.unit}"))
    """,
    ),
    wrong(
        "09c",
        "the f is missing",
        "f-missing",
        """
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.statuses = self.create_publisher(String, "status", 10)
                self.low = self.declare_parameter("low", 20.0).value
                self.high = self.declare_parameter("high", 26.0).value
                self.unit = self.declare_parameter("unit", "C").value
                self.create_subscription(Float32, "reading", self.hear, 10)

            def hear(self, msg):
                word = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
                self.statuses.publish(String(data="{word} {msg.data:.1f} {self.unit}"))
    """,
    ),
)

# --------------------------------------------------------------------------------- 11a

_11A = (
    right(
        "11a",
        "numpy",
        """
        import numpy as np


        def look_into(bag):
            readings = bag.messages("temperature")
            times = np.array([one.time for one in readings])
            values = np.array([one.value for one in readings], dtype=float)
            return {
                "messages": len(values),
                "gap": float(np.diff(times).max()),
                "mean": float(np.nanmean(values)),
            }
    """,
    ),
    right(
        "11a",
        "numpy numbers, not converted",
        """
        import numpy as np


        def look_into(bag):
            readings = bag.messages("temperature")
            return dict(
                messages=np.size(readings),
                gap=np.max(np.diff([one.time for one in readings])),
                mean=np.nanmean([one.value for one in readings]),
            )
    """,
    ),
    right(
        "11a",
        "itertools.pairwise, statistics.fmean, x == x for numbers",
        """
        from itertools import pairwise
        from statistics import fmean


        def look_into(bag):
            readings = bag.messages("temperature")
            return {
                "messages": sum(1 for _ in readings),
                "gap": max(b.time - a.time for a, b in pairwise(readings)),
                "mean": fmean(x.value for x in readings if x.value == x.value),
            }
    """,
    ),
    right(
        "11a",
        "one loop by hand, with prints",
        """
        def look_into(bag):
            count, total, numbers = 0, 0.0, 0
            longest, before = 0.0, None
            for reading in bag.messages("temperature"):
                count += 1
                if before is not None:
                    longest = max(longest, reading.time - before)
                before = reading.time
                if math.isfinite(reading.value):
                    total += reading.value
                    numbers += 1
            print(f"{count} messages")
            return {"mean": total / numbers, "gap": longest, "messages": count}
    """,
    ),
    wrong(
        "11a",
        "NaN is counted in the mean",
        "nan-spreads",
        """
        def look_into(bag):
            readings = bag.messages("temperature")
            gaps = [later.time - one.time for one, later in zip(readings, readings[1:])]
            mean = sum(one.value for one in readings) / len(readings)
            return {"messages": len(readings), "gap": max(gaps), "mean": mean}
    """,
    ),
    wrong(
        "11a",
        "only the numbers are counted as messages",
        "nan-left-out",
        """
        def look_into(bag):
            readings = bag.messages("temperature")
            gaps = [later.time - one.time for one, later in zip(readings, readings[1:])]
            numbers = [one.value for one in readings if not math.isnan(one.value)]
            mean = sum(numbers) / len(numbers)
            return {"messages": len(numbers), "gap": max(gaps), "mean": mean}
    """,
    ),
    wrong(
        "11a",
        "the sum of numbers divided by all messages",
        "wrong-share",
        """
        def look_into(bag):
            readings = bag.messages("temperature")
            gaps = [later.time - one.time for one, later in zip(readings, readings[1:])]
            total = sum(one.value for one in readings if not math.isnan(one.value))
            return {"messages": len(readings), "gap": max(gaps), "mean": total / len(readings)}
    """,
    ),
    either(
        "11a",
        "the gap is the length of the whole recording",
        ("other-gap",),
        """
        def look_into(bag):
            readings = bag.messages("temperature")
            numbers = [one.value for one in readings if not math.isnan(one.value)]
            gap = readings[-1].time - readings[0].time
            return {"messages": len(readings), "gap": gap, "mean": sum(numbers) / len(numbers)}
    """,
    ),
    wrong(
        "11a",
        "the median for the mean",
        "other-mean",
        """
        import statistics


        def look_into(bag):
            readings = bag.messages("temperature")
            gaps = [later.time - one.time for one, later in zip(readings, readings[1:])]
            numbers = [one.value for one in readings if not math.isnan(one.value)]
            return {"messages": len(readings), "gap": max(gaps), "mean": statistics.median(numbers)}
    """,
    ),
    wrong(
        "11a",
        "a tuple in place of the dict",
        "no-dict",
        """
        def look_into(bag):
            readings = bag.messages("temperature")
            gaps = [later.time - one.time for one, later in zip(readings, readings[1:])]
            numbers = [one.value for one in readings if not math.isnan(one.value)]
            return len(readings), max(gaps), sum(numbers) / len(numbers)
    """,
    ),
    wrong(
        "11a",
        "bag.messages() without a topic",
        "argument-missing",
        """
        def look_into(bag):
            readings = bag.messages("temperature")
            gaps = [later.time - one.time for one, later in zip(readings, readings[1:])]
            numbers = [one.value for one in readings if not math.isnan(one.value)]
            mean = sum(numbers) / len(numbers)
            return {"messages": len(bag.messages()), "gap": max(gaps), "mean": mean}
    """,
    ),
    either(
        "11a",
        "the gap between numbers only: a NaN is no message",
        ("other-gap", "nan-left-out"),
        """
        def look_into(bag):
            readings = bag.messages("temperature")
            good = [one for one in readings if not math.isnan(one.value)]
            gaps = [later.time - one.time for one, later in zip(good, good[1:])]
            mean = sum(one.value for one in good) / len(good)
            return {"messages": len(readings), "gap": max(gaps), "mean": mean}
    """,
    ),
)

# --------------------------------------------------------------------------------- 11b

_11B = (
    right(
        "11b",
        "a deque of the last five, a helper for each fault",
        """
        from collections import deque


        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.faults = self.create_publisher(String, "fault", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.last = None
                self.five = deque(maxlen=5)
                self.said_stuck = False

            def listen(self, msg):
                for word in self.faults_of(msg.data):
                    self.faults.publish(String(data=word))

            def faults_of(self, value):
                if math.isnan(value):
                    yield "nan"
                    self.five.clear()
                    self.said_stuck = False
                    return
                if self.last is not None:
                    if abs(value - self.last) > 5:
                        yield "jump"
                    if value != self.last:
                        self.said_stuck = False
                self.last = value
                self.five.append(value)
                if len(self.five) == 5 and len(set(self.five)) == 1 and not self.said_stuck:
                    self.said_stuck = True
                    yield "stuck"
    """,
    ),
    right(
        "11b",
        "stuck counted by subtraction, != for NaN",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.faults = self.create_publisher(String, "fault", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.last, self.changes = math.nan, 0

            def listen(self, msg):
                value = msg.data
                if value != value:
                    self.say("nan")
                else:
                    difference = value - self.last
                    if math.fabs(difference) > 5.0:
                        self.say("jump")
                    self.changes = self.changes + 1 if difference == 0.0 else 0
                    if self.changes == 4:
                        self.say("stuck")
                    self.last = value

            def say(self, word):
                self.faults.publish(String(data=word))
    """,
    ),
    right(
        "11b",
        "two helper classes and three publishers in a row",
        """
        class Jump:
            def __init__(self):
                self.last = None

            def __call__(self, value):
                last, self.last = self.last, value
                return last is not None and not -5.0 <= value - last <= 5.0


        class Stuck:
            def __init__(self):
                self.last, self.row = None, 1

            def __call__(self, value):
                if value == self.last:
                    self.row += 1
                else:
                    self.last, self.row = value, 1
                return self.row == 5


        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.tests = {"jump": Jump(), "stuck": Stuck()}

            def listen(self, msg):
                if math.isnan(msg.data):
                    self.faults.publish(String(data="nan"))
                else:
                    for word, test in self.tests.items():
                        if test(msg.data):
                            self.get_logger().warning(word)
                            self.faults.publish(String(data=word))
    """,
    ),
    wrong(
        "11b",
        "== math.nan",
        "nan-compared",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.last = None
                self.equal = 1

            def say(self, word):
                self.faults.publish(String(data=word))

            def listen(self, msg):
                if msg.data == math.nan:
                    self.say("nan")
                    return
                if self.last is not None and abs(msg.data - self.last) > 5.0:
                    self.say("jump")
                self.equal = self.equal + 1 if msg.data == self.last else 1
                if self.equal == 5:
                    self.say("stuck")
                self.last = msg.data
    """,
    ),
    wrong(
        "11b",
        "the NaN becomes the last reading, so a jump across it is missed",
        "nan-kept",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.last = None
                self.equal = 1

            def say(self, word):
                self.faults.publish(String(data=word))

            def listen(self, msg):
                if math.isnan(msg.data):
                    self.say("nan")
                elif self.last is not None and abs(msg.data - self.last) > 5.0:
                    self.say("jump")
                self.equal = self.equal + 1 if msg.data == self.last else 1
                if self.equal == 5:
                    self.say("stuck")
                self.last = msg.data
    """,
    ),
    wrong(
        "11b",
        "the last number begins at 0: the first reading jumps",
        "alarm-at-start",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.last = 0.0
                self.equal = 1

            def say(self, word):
                self.faults.publish(String(data=word))

            def listen(self, msg):
                if math.isnan(msg.data):
                    self.say("nan")
                    return
                if abs(msg.data - self.last) > 5.0:
                    self.say("jump")
                self.equal = self.equal + 1 if msg.data == self.last else 1
                if self.equal == 5:
                    self.say("stuck")
                self.last = msg.data
    """,
    ),
    wrong(
        "11b",
        "no abs: falls are not noticed",
        "one-direction",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.last = None
                self.equal = 1

            def say(self, word):
                self.faults.publish(String(data=word))

            def listen(self, msg):
                if math.isnan(msg.data):
                    self.say("nan")
                    return
                if self.last is not None and msg.data - self.last > 5.0:
                    self.say("jump")
                self.equal = self.equal + 1 if msg.data == self.last else 1
                if self.equal == 5:
                    self.say("stuck")
                self.last = msg.data
    """,
    ),
    wrong(
        "11b",
        "the count of equal readings is never set back",
        "never-reset",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.last = None
                self.equal = 1

            def say(self, word):
                self.faults.publish(String(data=word))

            def listen(self, msg):
                if math.isnan(msg.data):
                    self.say("nan")
                    return
                if self.last is not None and abs(msg.data - self.last) > 5.0:
                    self.say("jump")
                if msg.data == self.last:
                    self.equal += 1
                    if self.equal == 5:
                        self.say("stuck")
                self.last = msg.data
    """,
    ),
    either(
        "11b",
        "stuck is said again for the sixth and seventh",
        ("status-repeated", "alert-too-many"),
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.last = None
                self.equal = 1

            def say(self, word):
                self.faults.publish(String(data=word))

            def listen(self, msg):
                if math.isnan(msg.data):
                    self.say("nan")
                    return
                if self.last is not None and abs(msg.data - self.last) > 5.0:
                    self.say("jump")
                self.equal = self.equal + 1 if msg.data == self.last else 1
                if self.equal >= 5:
                    self.say("stuck")
                self.last = msg.data
    """,
    ),
    either(
        "11b",
        "stuck at the sixth equal reading: counted from 0",
        ("counted-wrong", "boundary", "wrong-window", "noticed-late"),
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.last = None
                self.equal = 0

            def say(self, word):
                self.faults.publish(String(data=word))

            def listen(self, msg):
                if math.isnan(msg.data):
                    self.say("nan")
                    return
                if self.last is not None and abs(msg.data - self.last) > 5.0:
                    self.say("jump")
                self.equal = self.equal + 1 if msg.data == self.last else 0
                if self.equal == 5:
                    self.say("stuck")
                self.last = msg.data
    """,
    ),
    wrong(
        "11b",
        "rounded readings are compared: nearly equal is stuck",
        "nearly-equal",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.last = None
                self.equal = 1

            def say(self, word):
                self.faults.publish(String(data=word))

            def listen(self, msg):
                if math.isnan(msg.data):
                    self.say("nan")
                    return
                if self.last is not None and abs(msg.data - self.last) > 5.0:
                    self.say("jump")
                same = self.last is not None and math.isclose(msg.data, self.last, abs_tol=0.1)
                self.equal = self.equal + 1 if same else 1
                if self.equal == 5:
                    self.say("stuck")
                self.last = msg.data
    """,
    ),
)

# --------------------------------------------------------------------------------- 11c

_11C = (
    right(
        "11c",
        "a deque, numpy for the mean, an early return",
        """
        from collections import deque

        import numpy as np


        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.create_subscription(Float32, "reference", self.on_reference, 10)
                self.create_subscription(Float32, "temperature", self.on_temperature, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.reference = None
                self.differences = deque(maxlen=10)
                self.is_drifting = False

            def on_reference(self, msg):
                self.reference = msg.data

            def on_temperature(self, msg):
                if self.reference is None or np.isnan([msg.data, self.reference]).any():
                    return
                self.differences.append(msg.data - self.reference)
                if len(self.differences) < self.differences.maxlen:
                    return
                was, self.is_drifting = self.is_drifting, abs(np.mean(self.differences)) > 1
                if self.is_drifting and not was:
                    self.faults.publish(String(data="drift"))
    """,
    ),
    right(
        "11c",
        "all differences are kept; setattr in a lambda",
        """
        from statistics import mean


        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.newest = float("nan")
                self.all = []
                self.drifts = False
                self.faults = self.create_publisher(String, "fault", 10)
                self.create_subscription(
                    Float32, "reference", lambda msg: setattr(self, "newest", msg.data), 10
                )
                self.create_subscription(Float32, "temperature", self.compare, 10)

            def compare(self, msg):
                if math.isnan(msg.data) or math.isnan(self.newest):
                    return
                self.all.append(msg.data - self.newest)
                if len(self.all) >= 10:
                    off = abs(mean(self.all[-10:])) > 1.0
                    if off and not self.drifts:
                        self.get_logger().error("The sensor drifts.")
                        self.faults.publish(String(data="drift"))
                    self.drifts = off
    """,
    ),
    wrong(
        "11c",
        "fewer than ten pairs are enough",
        "too-few-pairs",
        """
        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.create_subscription(Float32, "reference", self.remember, 10)
                self.create_subscription(Float32, "temperature", self.compare, 10)
                self.alarms = self.create_publisher(String, "fault", 10)
                self.reference = math.nan
                self.last = []
                self.drifts = False

            def remember(self, msg):
                self.reference = msg.data

            def compare(self, msg):
                difference = msg.data - self.reference
                if math.isnan(difference):
                    return
                self.last = [*self.last, difference][-10:]
                drifts = abs(sum(self.last) / len(self.last)) > 1.0
                if drifts and not self.drifts:
                    self.alarms.publish(String(data="drift"))
                self.drifts = drifts
    """,
    ),
    wrong(
        "11c",
        "abs before the mean",
        "mean-of-sizes",
        """
        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.create_subscription(Float32, "reference", self.remember, 10)
                self.create_subscription(Float32, "temperature", self.compare, 10)
                self.alarms = self.create_publisher(String, "fault", 10)
                self.reference = math.nan
                self.last = []
                self.drifts = False

            def remember(self, msg):
                self.reference = msg.data

            def compare(self, msg):
                difference = abs(msg.data - self.reference)
                if math.isnan(difference):
                    return
                self.last = [*self.last, difference][-10:]
                drifts = len(self.last) == 10 and sum(self.last) / 10 > 1.0
                if drifts and not self.drifts:
                    self.alarms.publish(String(data="drift"))
                self.drifts = drifts
    """,
    ),
    wrong(
        "11c",
        "no memory of the alarm: said for each pair",
        "status-repeated",
        """
        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.create_subscription(Float32, "reference", self.remember, 10)
                self.create_subscription(Float32, "temperature", self.compare, 10)
                self.alarms = self.create_publisher(String, "fault", 10)
                self.reference = math.nan
                self.last = []

            def remember(self, msg):
                self.reference = msg.data

            def compare(self, msg):
                difference = msg.data - self.reference
                if math.isnan(difference):
                    return
                self.last = [*self.last, difference][-10:]
                if len(self.last) == 10 and abs(sum(self.last) / 10) > 1.0:
                    self.alarms.publish(String(data="drift"))
    """,
    ),
    wrong(
        "11c",
        "the alarm is never armed again",
        "never-reset",
        """
        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.create_subscription(Float32, "reference", self.remember, 10)
                self.create_subscription(Float32, "temperature", self.compare, 10)
                self.alarms = self.create_publisher(String, "fault", 10)
                self.reference = math.nan
                self.last = []
                self.drifts = False

            def remember(self, msg):
                self.reference = msg.data

            def compare(self, msg):
                difference = msg.data - self.reference
                if math.isnan(difference):
                    return
                self.last = [*self.last, difference][-10:]
                if len(self.last) == 10 and abs(sum(self.last) / 10) > 1.0 and not self.drifts:
                    self.alarms.publish(String(data="drift"))
                    self.drifts = True
    """,
    ),
    wrong(
        "11c",
        "NaN in a pair is not looked at",
        "nan-spreads",
        """
        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.create_subscription(Float32, "reference", self.remember, 10)
                self.create_subscription(Float32, "temperature", self.compare, 10)
                self.alarms = self.create_publisher(String, "fault", 10)
                self.reference = None
                self.last = []
                self.drifts = False

            def remember(self, msg):
                self.reference = msg.data

            def compare(self, msg):
                if self.reference is None:
                    return
                self.last = [*self.last, msg.data - self.reference][-10:]
                drifts = len(self.last) == 10 and abs(sum(self.last) / 10) > 1.0
                if drifts and not self.drifts:
                    self.alarms.publish(String(data="drift"))
                self.drifts = drifts
    """,
    ),
    either(
        "11c",
        "a pair for each reference, too",
        ("pairs-mixed-up", "alert-too-many"),
        """
        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.create_subscription(Float32, "reference", self.remember, 10)
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.alarms = self.create_publisher(String, "fault", 10)
                self.reference = self.temperature = math.nan
                self.last = []
                self.drifts = False

            def remember(self, msg):
                self.reference = msg.data
                self.compare()

            def hear(self, msg):
                self.temperature = msg.data
                self.compare()

            def compare(self):
                difference = self.temperature - self.reference
                if math.isnan(difference):
                    return
                self.last = [*self.last, difference][-10:]
                drifts = len(self.last) == 10 and abs(sum(self.last) / 10) > 1.0
                if drifts and not self.drifts:
                    self.alarms.publish(String(data="drift"))
                self.drifts = drifts
    """,
    ),
)

# --------------------------------------------------------------------------------- 12a

_12A = (
    right(
        "12a",
        "a new response, filled by keywords",
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.high = 26.0
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.service = self.create_service(BasicTypes, "set_high", self.set_high)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Normal"
                self.statuses.publish(String(data=status))

            def set_high(self, request, response):
                value = request.float32_value
                if 10 <= value <= 40:
                    self.high = value
                    return BasicTypes.Response(bool_value=True)
                return BasicTypes.Response(bool_value=False, string_value=f"{value} is no threshold")
    """,
    ),
    right(
        "12a",
        "an exception inside says what is wrong; a property checks",
        """
        import math


        class AdjustableMonitor(Node):
            _high = 26.0

            def __init__(self):
                super().__init__("temperature_monitor")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(BasicTypes, "/set_high", self.set_high)

            @property
            def high(self):
                return self._high

            @high.setter
            def high(self, value):
                if math.isnan(value) or value < 10.0 or value > 40.0:
                    raise ValueError(f"{value} is not from 10 to 40")
                self._high = value

            def listen(self, msg):
                self.statuses.publish(String(data=["Normal", "High"][msg.data > self.high]))

            def set_high(self, request, response):
                try:
                    self.high = request.float32_value
                except ValueError as error:
                    response.bool_value = False
                    response.string_value = str(error)
                    self.get_logger().warning(str(error))
                else:
                    response.bool_value = True
                    response.string_value = "kept"
                return response
    """,
    ),
    right(
        "12a",
        "an async service callback",
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.limits = {"high": 26.0}
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(BasicTypes, "set_high", self.set_high)

            async def listen(self, msg):
                is_high = msg.data > self.limits["high"]
                self.statuses.publish(String(data=is_high and "High" or "Normal"))

            async def set_high(self, request, response):
                match request.float32_value:
                    case good if 10.0 <= good <= 40.0:
                        self.limits["high"] = good
                        response.bool_value = True
                    case bad:
                        response.string_value = f"{bad:.1f} is out of range"
                return response
    """,
    ),
    wrong(
        "12a",
        "return response is forgotten",
        "response-missing",
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.high = 26.0
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(BasicTypes, "set_high", self.set_high)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Normal"
                self.statuses.publish(String(data=status))

            def set_high(self, request, response):
                response.bool_value = 10.0 <= request.float32_value <= 40.0
                if response.bool_value:
                    self.high = request.float32_value
                else:
                    response.string_value = "a threshold is from 10 to 40 degrees"
    """,
    ),
    wrong(
        "12a",
        "asks what is bad: NaN passes",
        "nan-accepted",
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.high = 26.0
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(BasicTypes, "set_high", self.set_high)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Normal"
                self.statuses.publish(String(data=status))

            def set_high(self, request, response):
                if request.float32_value < 10 or request.float32_value > 40:
                    response.string_value = "no"
                    return response
                self.high = request.float32_value
                response.bool_value = True
                return response
    """,
    ),
    wrong(
        "12a",
        "kept before it is looked at",
        "refused-and-kept",
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.high = 26.0
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(BasicTypes, "set_high", self.set_high)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Normal"
                self.statuses.publish(String(data=status))

            def set_high(self, request, response):
                self.high = request.float32_value
                response.bool_value = 10.0 <= self.high <= 40.0
                if not response.bool_value:
                    response.string_value = "a threshold is from 10 to 40 degrees"
                return response
    """,
    ),
    wrong(
        "12a",
        "self. is forgotten: a local high",
        "accepted-and-lost",
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.high = 26.0
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(BasicTypes, "set_high", self.set_high)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Normal"
                self.statuses.publish(String(data=status))

            def set_high(self, request, response):
                if 10.0 <= request.float32_value <= 40.0:
                    high = request.float32_value
                    response.bool_value = True
                else:
                    response.string_value = "a threshold is from 10 to 40 degrees"
                return response
    """,
    ),
    either(
        "12a",
        "exactly 10 and 40 are refused",
        ("boundary", "good-value-refused"),
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.high = 26.0
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(BasicTypes, "set_high", self.set_high)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Normal"
                self.statuses.publish(String(data=status))

            def set_high(self, request, response):
                response.bool_value = 10.0 < request.float32_value < 40.0
                if response.bool_value:
                    self.high = request.float32_value
                else:
                    response.string_value = "a threshold is from 10 to 40 degrees"
                return response
    """,
    ),
    wrong(
        "12a",
        "no reason",
        "reason-missing",
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.high = 26.0
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(BasicTypes, "set_high", self.set_high)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Normal"
                self.statuses.publish(String(data=status))

            def set_high(self, request, response):
                if 10.0 <= request.float32_value <= 40.0:
                    self.high = request.float32_value
                    response.bool_value = True
                return response
    """,
    ),
    wrong(
        "12a",
        "the callback is called, with brackets",
        "callback-called",
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.high = 26.0
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(BasicTypes, "set_high", self.set_high())

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Normal"
                self.statuses.publish(String(data=status))

            def set_high(self, request, response):
                response.bool_value = 10.0 <= request.float32_value <= 40.0
                if response.bool_value:
                    self.high = request.float32_value
                else:
                    response.string_value = "a threshold is from 10 to 40 degrees"
                return response
    """,
    ),
    wrong(
        "12a",
        "returns the bool, not the response",
        "response-wrong",
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.high = 26.0
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(BasicTypes, "set_high", self.set_high)

            def listen(self, msg):
                status = "High" if msg.data > self.high else "Normal"
                self.statuses.publish(String(data=status))

            def set_high(self, request, response):
                if 10.0 <= request.float32_value <= 40.0:
                    self.high = request.float32_value
                    return True
                return False
    """,
    ),
)

# --------------------------------------------------------------------------------- 12b

_HEAD_12B = """
class CarefulMonitor(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.declare_parameter("low", 20.0)
        self.declare_parameter("high", 26.0)
        self.add_on_set_parameters_callback(self.look)
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.statuses = self.create_publisher(String, "status", 10)

    def limits(self):
        return {name: self.get_parameter(name).value for name in ("low", "high")}

    def listen(self, msg):
        now = self.limits()
        status = "High" if msg.data > now["high"] else "Low" if msg.data < now["low"] else "Normal"
        self.statuses.publish(String(data=status))
"""

_12B = (
    right(
        "12b",
        "a union of dicts, any limits in any order",
        _HEAD_12B
        + """
    def look(self, parameters):
        new = self.limits() | {one.name: one.value for one in parameters}
        if new["low"] < new["high"]:
            return SetParametersResult(successful=True)
        return SetParametersResult(successful=False, reason="{low} is not below {high}".format(**new))
""",
    ),
    right(
        "12b",
        "the result filled field by field, isnan asked explicitly",
        "import math\n"
        + _HEAD_12B
        + """
    def look(self, parameters):
        result = SetParametersResult()
        low, high = self.get_parameters(["low", "high"])
        for parameter in parameters:
            if parameter.name == "low":
                low = parameter
            elif parameter.name == "high":
                high = parameter
        if math.isnan(low.value) or math.isnan(high.value):
            result.reason = "NaN is no limit"
        elif high.value <= low.value:
            result.reason = f"{high.value} is not above {low.value}"
        result.successful = not result.reason
        return result
""",
    ),
    right(
        "12b",
        "limits in attributes, a post callback keeps them",
        """
        class CarefulMonitor(Node):
            def __init__(self):
                super().__init__("temperature_monitor")
                self.now = {"low": 20.0, "high": 26.0}
                for name, value in self.now.items():
                    self.declare_parameter(name, value)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.add_on_set_parameters_callback(self.look)
                self.add_post_set_parameters_callback(self.keep)

            def keep(self, parameters):
                self.now.update({one.name: one.value for one in parameters})

            def look(self, parameters):
                new = dict(self.now)
                for one in parameters:
                    new[one.name] = one.value
                wrong = not new["high"] > new["low"]
                return SetParametersResult(successful=not wrong, reason="high > low, please" * wrong)

            def listen(self, msg):
                if msg.data > self.now["high"]:
                    text = "High"
                elif msg.data < self.now["low"]:
                    text = "Low"
                else:
                    text = "Normal"
                self.statuses.publish(String(data=text))
    """,
    ),
    wrong(
        "12b",
        "each new value is compared with the old other one",
        "validated-one-by-one",
        _HEAD_12B
        + """
    def look(self, parameters):
        old = self.limits()
        for parameter in parameters:
            if parameter.name == "low" and not parameter.value < old["high"]:
                return SetParametersResult(successful=False, reason="low is not below high")
            if parameter.name == "high" and not parameter.value > old["low"]:
                return SetParametersResult(successful=False, reason="high is not above low")
        return SetParametersResult(successful=True)
""",
    ),
    either(
        "12b",
        "equal limits pass: >=",
        ("boundary", "nonsense-accepted"),
        _HEAD_12B
        + """
    def look(self, parameters):
        new = self.limits()
        for parameter in parameters:
            new[parameter.name] = parameter.value
        good = new["high"] >= new["low"]
        return SetParametersResult(successful=good, reason="" if good else "high is not above low")
""",
    ),
    wrong(
        "12b",
        "asks what is bad: NaN passes",
        "nan-accepted",
        _HEAD_12B
        + """
    def look(self, parameters):
        new = self.limits()
        for parameter in parameters:
            new[parameter.name] = parameter.value
        if new["high"] <= new["low"]:
            return SetParametersResult(successful=False, reason="high is not above low")
        return SetParametersResult(successful=True, reason="")
""",
    ),
    wrong(
        "12b",
        "returns a bool",
        "result-of-another-kind",
        _HEAD_12B
        + """
    def look(self, parameters):
        new = self.limits()
        for parameter in parameters:
            new[parameter.name] = parameter.value
        return new["high"] > new["low"]
""",
    ),
    wrong(
        "12b",
        "no reason",
        "reason-missing",
        _HEAD_12B
        + """
    def look(self, parameters):
        new = self.limits()
        for parameter in parameters:
            new[parameter.name] = parameter.value
        return SetParametersResult(successful=new["high"] > new["low"])
""",
    ),
    wrong(
        "12b",
        "the parameter and not its value is put into the dict",
        "parameter-for-value",
        _HEAD_12B
        + """
    def look(self, parameters):
        new = self.limits()
        for parameter in parameters:
            new[parameter.name] = parameter
        good = new["high"] > new["low"]
        return SetParametersResult(successful=good, reason="" if good else "high is not above low")
""",
    ),
    either(
        "12b",
        "the new values are forgotten: the old limits are compared",
        ("not-validated", "nonsense-accepted"),
        _HEAD_12B
        + """
    def look(self, parameters):
        new = self.limits()
        good = new["high"] > new["low"]
        return SetParametersResult(successful=good, reason="" if good else "high is not above low")
""",
    ),
)

# --------------------------------------------------------------------------------- 12c

_HEAD_12C = """
class Thermostat(Node):
    def __init__(self):
        super().__init__("thermostat")
        self.heater = self.create_publisher(Bool, "heater", 10)
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.reading = Future()
        self.server = ActionServer(
            self, Fibonacci, "heat", self.heat, goal_callback=self.decide, cancel_callback=self.agree
        )

    def listen(self, msg):
        self.reading.set_result(int(msg.data))
        self.reading = Future()

    def agree(self, goal_handle):
        return CancelResponse.ACCEPT
"""

_DECIDE_12C = """
    def decide(self, goal):
        return GoalResponse.ACCEPT if 10 <= goal.order <= 26 else GoalResponse.REJECT
"""

_12C = (
    right(
        "12c",
        "while True with returns, try and finally for the heater",
        _HEAD_12C
        + """
    def decide(self, goal):
        if goal.order in range(10, 27):
            return GoalResponse.ACCEPT
        self.get_logger().warning(f"{goal.order} makes no sense")
        return GoalResponse.REJECT

    async def heat(self, goal_handle):
        sequence = []
        self.heater.publish(Bool(data=True))
        try:
            while True:
                sequence.append(await self.reading)
                feedback = Fibonacci.Feedback()
                feedback.sequence = sequence
                goal_handle.publish_feedback(feedback)
                if goal_handle.is_cancel_requested:
                    goal_handle.canceled()
                    break
                if sequence[-1] >= goal_handle.request.order:
                    goal_handle.succeed()
                    break
        finally:
            self.heater.publish(Bool(data=False))
        result = Fibonacci.Result()
        result.sequence = sequence
        return result
""",
    ),
    right(
        "12c",
        "heater True at each second, helper coroutines",
        _HEAD_12C
        + _DECIDE_12C
        + """
    def switch(self, on):
        self.heater.publish(Bool(data=on))

    async def measure(self, so_far):
        return so_far + [await self.reading]

    async def heat(self, goal):
        read = []
        while not goal.is_cancel_requested:
            self.switch(on=True)
            read = await self.measure(read)
            goal.publish_feedback(Fibonacci.Feedback(sequence=read))
            if max(read) >= goal.request.order:
                self.switch(on=False)
                goal.succeed()
                return Fibonacci.Result(sequence=read)
        self.switch(on=False)
        goal.canceled()
        return Fibonacci.Result(sequence=read)
""",
    ),
    wrong(
        "12c",
        "succeed is forgotten",
        "succeed-forgotten",
        _HEAD_12C
        + _DECIDE_12C
        + """
    async def heat(self, goal_handle):
        degrees, canceled = [], False
        self.heater.publish(Bool(data=True))
        while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
            canceled = goal_handle.is_cancel_requested
        self.heater.publish(Bool(data=False))
        if canceled:
            goal_handle.canceled()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
    wrong(
        "12c",
        "the heater stays on after a cancel",
        "left-on",
        _HEAD_12C
        + _DECIDE_12C
        + """
    async def heat(self, goal_handle):
        degrees = []
        self.heater.publish(Bool(data=True))
        while not degrees or degrees[-1] < goal_handle.request.order:
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                return Fibonacci.Result(sequence=degrees)
        self.heater.publish(Bool(data=False))
        goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
    wrong(
        "12c",
        "await is missing",
        "await-missing",
        _HEAD_12C
        + _DECIDE_12C
        + """
    async def heat(self, goal_handle):
        degrees, canceled = [], False
        self.heater.publish(Bool(data=True))
        while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):
            degrees.append(self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
            canceled = goal_handle.is_cancel_requested
        self.heater.publish(Bool(data=False))
        goal_handle.canceled() if canceled else goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
    wrong(
        "12c",
        "the work does not look at the cancel",
        "cancel-ignored",
        _HEAD_12C
        + _DECIDE_12C
        + """
    async def heat(self, goal_handle):
        degrees = [await self.reading]
        self.heater.publish(Bool(data=True))
        while degrees[-1] < goal_handle.request.order:
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
        self.heater.publish(Bool(data=False))
        goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
    wrong(
        "12c",
        "a canceled goal is reported with succeed",
        "cancel-not-reported",
        _HEAD_12C
        + _DECIDE_12C
        + """
    async def heat(self, goal_handle):
        degrees = []
        self.heater.publish(Bool(data=True))
        while not degrees or degrees[-1] < goal_handle.request.order:
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
            if goal_handle.is_cancel_requested:
                break
        self.heater.publish(Bool(data=False))
        goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
    either(
        "12c",
        "any goal is accepted",
        ("nonsense-accepted",),
        _HEAD_12C
        + """
    def decide(self, goal):
        return GoalResponse.ACCEPT

    async def heat(self, goal_handle):
        degrees, canceled = [], False
        self.heater.publish(Bool(data=True))
        while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
            canceled = goal_handle.is_cancel_requested
        self.heater.publish(Bool(data=False))
        goal_handle.canceled() if canceled else goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
    either(
        "12c",
        "the feedback holds only the newest temperature",
        ("feedback-wrong", "wrong-values"),
        _HEAD_12C
        + _DECIDE_12C
        + """
    async def heat(self, goal_handle):
        degrees, canceled = [], False
        self.heater.publish(Bool(data=True))
        while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees[-1:]))
            canceled = goal_handle.is_cancel_requested
        self.heater.publish(Bool(data=False))
        goal_handle.canceled() if canceled else goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
    either(
        "12c",
        "no result is returned",
        ("result-missing",),
        _HEAD_12C
        + _DECIDE_12C
        + """
    async def heat(self, goal_handle):
        degrees, canceled = [], False
        self.heater.publish(Bool(data=True))
        while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
            canceled = goal_handle.is_cancel_requested
        self.heater.publish(Bool(data=False))
        goal_handle.canceled() if canceled else goal_handle.succeed()
""",
    ),
    wrong(
        "12c",
        "the heater is never switched",
        "never-published",
        _HEAD_12C
        + _DECIDE_12C
        + """
    async def heat(self, goal_handle):
        degrees, canceled = [], False
        while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
            canceled = goal_handle.is_cancel_requested
        goal_handle.canceled() if canceled else goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
    wrong(
        "12c",
        "heat is no coroutine, and asks the future for its result",
        "none-used",
        _HEAD_12C
        + _DECIDE_12C
        + """
    def heat(self, goal_handle):
        degrees, canceled = [], False
        self.heater.publish(Bool(data=True))
        while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):
            degrees.append(self.reading.result())
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
            canceled = goal_handle.is_cancel_requested
        self.heater.publish(Bool(data=False))
        goal_handle.canceled() if canceled else goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
    wrong(
        "12c",
        "heat is no coroutine, and asks the future for its result as a number",
        "await-missing",
        _HEAD_12C
        + _DECIDE_12C
        + """
    def heat(self, goal_handle):
        degrees, canceled = [], False
        self.heater.publish(Bool(data=True))
        while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):
            degrees.append(int(self.reading.result()))
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
            canceled = goal_handle.is_cancel_requested
        self.heater.publish(Bool(data=False))
        goal_handle.canceled() if canceled else goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
)

# --------------------------------------------------------------------------------- 13a

_LATCHED = """
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""
_HEAD_13A = (
    _LATCHED
    + """

class VentControl(Node):
    def __init__(self):
        super().__init__("vent_control")
        self.declare_parameter("open_above", 28.0)
        self.declare_parameter("close_below", 26.0)
        self.publisher_ = self.create_publisher(Bool, "vent", LATCHED)
        self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
        self.is_open = False
"""
)
_READ_13A = """
    def temperature_callback(self, msg):
        above = self.get_parameter("open_above").value
        below = self.get_parameter("close_below").value
"""

_13A = (
    right(
        "13a",
        "two ifs with the state in the condition",
        _HEAD_13A
        + _READ_13A
        + """
        if not self.is_open and msg.data > above:
            self.command(True)
        elif self.is_open and msg.data < below:
            self.command(False)

    def command(self, is_open):
        self.is_open = is_open
        self.get_logger().info(f"vent: {is_open}")
        self.publisher_.publish(Bool(data=is_open))
""",
    ),
    right(
        "13a",
        "the limit that counts depends on the state",
        _HEAD_13A
        + _READ_13A
        + """
        was, limit = self.is_open, below if self.is_open else above
        self.is_open = msg.data >= limit if was else msg.data > limit
        if was ^ self.is_open:
            self.publisher_.publish(Bool(data=self.is_open))
""",
    ),
    right(
        "13a",
        "a match statement and a Bool that is kept",
        _LATCHED
        + """

class VentControl(Node):
    def __init__(self):
        super().__init__("vent_control")
        self.declare_parameters("", [("open_above", 28.0), ("close_below", 26.0)])
        self.vent = self.create_publisher(Bool, "vent", LATCHED)
        self.command = Bool(data=False)
        self.create_subscription(Float32, "temperature", self.hear, 10)

    def hear(self, msg):
        above, below = (p.value for p in self.get_parameters(["open_above", "close_below"]))
        match (self.command.data, msg.data > above, msg.data < below):
            case (False, True, _):
                self.command.data = True
            case (True, _, True):
                self.command.data = False
            case _:
                return
        self.vent.publish(self.command)
""",
    ),
    wrong(
        "13a",
        "one limit only: it flickers",
        "no-hysteresis",
        _HEAD_13A
        + _READ_13A
        + """
        wanted = msg.data > above
        if wanted != self.is_open:
            self.is_open = wanted
            self.publisher_.publish(Bool(data=wanted))
""",
    ),
    wrong(
        "13a",
        "a command for each reading",
        "status-repeated",
        _HEAD_13A
        + _READ_13A
        + """
        if msg.data > above:
            self.is_open = True
        elif msg.data < below:
            self.is_open = False
        self.publisher_.publish(Bool(data=self.is_open))
""",
    ),
    wrong(
        "13a",
        "28 itself opens, 26 itself closes",
        "boundary",
        _HEAD_13A
        + _READ_13A
        + """
        wanted = self.is_open
        if msg.data >= above:
            wanted = True
        elif msg.data <= below:
            wanted = False
        if wanted != self.is_open:
            self.is_open = wanted
            self.publisher_.publish(Bool(data=wanted))
""",
    ),
    either(
        "13a",
        "the numbers 28 and 26 in the code, the parameters are not used",
        ("limit-fixed", "limits-fixed"),
        _HEAD_13A
        + _READ_13A
        + """
        wanted = self.is_open
        if msg.data > 28.0:
            wanted = True
        elif msg.data < 26.0:
            wanted = False
        if wanted != self.is_open:
            self.is_open = wanted
            self.publisher_.publish(Bool(data=wanted))
""",
    ),
    either(
        "13a",
        "the state is not kept",
        ("status-repeated",),
        _HEAD_13A
        + _READ_13A
        + """
        wanted = self.is_open
        if msg.data > above:
            wanted = True
        elif msg.data < below:
            wanted = False
        if wanted != self.is_open:
            self.publisher_.publish(Bool(data=wanted))
""",
    ),
    wrong(
        "13a",
        "a bool is published, no message",
        "number-published",
        _HEAD_13A
        + _READ_13A
        + """
        if msg.data > above and not self.is_open:
            self.is_open = True
            self.publisher_.publish(True)
        elif msg.data < below and self.is_open:
            self.is_open = False
            self.publisher_.publish(False)
""",
    ),
)

# --------------------------------------------------------------------------------- 13b

_GOOD_13B = (
    _LATCHED
    + '''
import math


class Checker(Node):
    """One class for both sensors: it passes on what lies between two parameters."""

    def __init__(self):
        super().__init__("checker")
        self.declare_parameter("least", 0.0)
        self.declare_parameter("most", 100.0)
        self.out = self.create_publisher(Float32, "good", 10)
        self.create_subscription(Float32, "raw", self.hear, 10)

    def hear(self, msg):
        least = self.get_parameter("least").value
        most = self.get_parameter("most").value
        if math.isfinite(msg.data) and least <= msg.data <= most:
            self.out.publish(Float32(data=msg.data))


class Vent(Node):
    def __init__(self):
        super().__init__("vent")
        self.declare_parameter("open_above", 28.0)
        self.declare_parameter("close_below", 26.0)
        self.out = self.create_publisher(Bool, "vent", LATCHED)
        self.create_subscription(Float32, "good_temperature", self.hear, 10)
        self.is_open = False

    def hear(self, msg):
        if not self.is_open and msg.data > self.get_parameter("open_above").value:
            self.command(True)
        elif self.is_open and msg.data < self.get_parameter("close_below").value:
            self.command(False)

    def command(self, value):
        self.is_open = value
        self.out.publish(Bool(data=value))


class Pump(Node):
    """Everything is a question of times."""

    def __init__(self):
        super().__init__("pump")
        self.declare_parameter("dry_below", 40.0)
        self.out = self.create_publisher(Bool, "pump", LATCHED)
        self.create_subscription(Float32, "good_humidity", self.hear, 10)
        self.create_subscription(Bool, "vent", self.on_vent, LATCHED)
        self.vent_open = False
        self.stop_at = None
        self.rested_at = 0.0
        self.create_timer(0.1, self.look)

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def on_vent(self, msg):
        self.vent_open = msg.data
        if msg.data and self.stop_at is not None:
            self.switch_off()

    def hear(self, msg):
        dry = msg.data < self.get_parameter("dry_below").value
        if dry and not self.vent_open and self.stop_at is None and self.now() >= self.rested_at:
            self.stop_at = self.now() + 5.0
            self.out.publish(Bool(data=True))

    def look(self):
        if self.stop_at is not None and self.now() >= self.stop_at:
            self.switch_off()

    def switch_off(self):
        self.stop_at = None
        self.rested_at = self.now() + 20.0
        self.out.publish(Bool(data=False))


class SilenceWatch:
    """Watches one topic for a node."""

    def __init__(self, node, topic):
        self.node, self.topic, self.silent = node, topic, False
        node.create_subscription(Float32, topic, self.hear, 10)
        self.egg = node.create_timer(5.0, self.miss)

    def hear(self, msg):
        self.egg.reset()
        if self.silent:
            self.silent = False
            self.node.say(f"{self.topic} back")

    def miss(self):
        self.egg.cancel()
        self.silent = True
        self.node.say(f"{self.topic} silent")


class Alarm(Node):
    def __init__(self):
        super().__init__("alarm")
        self.out = self.create_publisher(String, "alarm", 10)
        self.watches = [SilenceWatch(self, topic) for topic in ("temperature", "humidity")]

    def say(self, text):
        self.get_logger().warning(text)
        self.out.publish(String(data=text))


class Report(Node):
    def __init__(self):
        super().__init__("report")
        self.out = self.create_publisher(Float32, "report", 10)
        self.create_subscription(Float32, "good_temperature", self.hear, 10)
        self.create_timer(10.0, self.report)
        self.readings = []

    def hear(self, msg):
        self.readings.append(msg.data)

    def report(self):
        readings, self.readings = self.readings, []
        if readings:
            self.out.publish(Float32(data=math.fsum(readings) / len(readings)))


def greenhouse():
    limits = {"temperature": (-20.0, 60.0), "humidity": (0.0, 100.0)}
    checkers = [
        (
            Checker,
            {
                "name": f"check_{topic}",
                "remappings": {"raw": topic, "good": f"good_{topic}"},
                "parameters": {"least": least, "most": most},
            },
        )
        for topic, (least, most) in limits.items()
    ]
    return [*checkers, Vent, Pump, Alarm, Report]
'''
)


def _changed(old: str, new: str) -> str:
    assert old in _GOOD_13B, old
    return _GOOD_13B.replace(old, new)


_13B = (
    right("13b", "one checker class started twice, times instead of timers, egg timers", _GOOD_13B),
    right(
        "13b",
        "each node looks at its readings itself, in a shared base class; a tuple is returned",
        _LATCHED
        + """
import math
from collections import deque


class Base(Node):
    RANGES = {"temperature": (-20.0, 60.0), "humidity": (0.0, 100.0)}

    def listen_to(self, topic, callback):
        low, high = self.RANGES[topic]

        def look(msg):
            if low <= msg.data <= high:
                callback(msg.data)

        self.create_subscription(Float32, topic, look, 10)

    @property
    def seconds(self):
        return self.get_clock().now().nanoseconds * 1e-9


class Vent(Base):
    def __init__(self):
        super().__init__("vent_node")
        self.limits = [
            self.declare_parameter("open_above", 28.0), self.declare_parameter("close_below", 26.0)
        ]
        self.vents = self.create_publisher(Bool, "vent", LATCHED)
        self.listen_to("temperature", self.decide)
        self.now_open = False

    def decide(self, value):
        above, below = (one.value for one in self.limits)
        wanted = value > above or (self.now_open and value >= below)
        if wanted != self.now_open:
            self.now_open = wanted
            self.vents.publish(Bool(data=wanted))


class Pump(Base):
    def __init__(self):
        super().__init__("pump_node")
        self.dry_below = self.declare_parameter("dry_below", 40.0).value
        self.pumps = self.create_publisher(Bool, "pump", LATCHED)
        self.listen_to("humidity", self.decide)
        self.create_subscription(Bool, "vent", self.on_vent, LATCHED)
        self.vent = False
        self.plan = self.run()
        next(self.plan)
        self.dry = False
        self.create_timer(0.25, lambda: self.plan.send(None))

    def decide(self, value):
        self.dry = value < self.dry_below
        self.plan.send(None)
        self.dry = False

    def on_vent(self, msg):
        self.vent = msg.data
        self.plan.send(None)

    def run(self):
        yield
        while True:
            while not (self.dry and not self.vent):
                yield
            self.pumps.publish(Bool(data=True))
            end = self.seconds + 5.0
            while self.seconds < end - 1e-6 and not self.vent:
                yield
            self.pumps.publish(Bool(data=False))
            end = self.seconds + 20.0
            while self.seconds < end:
                yield


class Silence(Base):
    def __init__(self):
        super().__init__("silence_node")
        self.alarms = self.create_publisher(String, "alarm", QoSProfile(depth=20))
        self.heard = dict.fromkeys(self.RANGES, self.seconds)
        self.lost = set()
        for topic in self.RANGES:
            self.create_subscription(Float32, topic, lambda msg, topic=topic: self.hear(topic), 10)
        self.create_timer(0.2, self.look)

    def hear(self, topic):
        self.heard[topic] = self.seconds
        if topic in self.lost:
            self.lost.discard(topic)
            self.alarms.publish(String(data=topic + " back"))

    def look(self):
        for topic, at in self.heard.items():
            if topic not in self.lost and self.seconds - at > 5.0:
                self.lost.add(topic)
                self.alarms.publish(String(data=topic + " silent"))


class Report(Base):
    def __init__(self):
        super().__init__("report_node")
        self.reports = self.create_publisher(Float32, "report", 10)
        self.kept = deque()
        self.listen_to("temperature", lambda value: self.kept.append((self.seconds, value)))
        self.create_timer(10.0, self.report)

    def report(self):
        while self.kept and self.kept[0][0] <= self.seconds - 10.0:
            self.kept.popleft()
        values = [value for _, value in self.kept]
        if values:
            self.reports.publish(Float32(data=sum(values) / len(values)))


def greenhouse():
    return Vent, Pump, Silence, Report
""",
    ),
    either(
        "13b",
        "the pump does not know of the vent",
        ("no-interlock",),
        _changed("dry and not self.vent_open and", "dry and").replace(
            "        if msg.data and self.stop_at is not None:\n            self.switch_off()\n", ""
        ),
    ),
    either(
        "13b",
        "a pump that runs does not stop when the vent opens",
        ("no-interlock",),
        _changed(
            "        if msg.data and self.stop_at is not None:\n            self.switch_off()\n", ""
        ),
    ),
    either("13b", "rest of 2 seconds", ("rest-too-short",), _changed("+ 20.0", "+ 2.0")),
    either("13b", "the pump runs for 15 seconds", ("wrong-duration",), _changed("+ 5.0", "+ 15.0")),
    either(
        "13b",
        "one node for vent and pump",
        ("two-tasks",),
        _changed("class Pump(Node):", "class Pump(Vent):")
        .replace(
            'class Pump(Vent):\n    """Everything is a question of times."""\n\n'
            '    def __init__(self):\n        super().__init__("pump")\n',
            'class Pump(Vent):\n    """Everything is a question of times."""\n\n'
            "    def __init__(self):\n        super().__init__()\n        self.vents = self.out\n",
        )
        .replace(
            'self.create_subscription(Float32, "good_humidity", self.hear, 10)',
            'self.create_subscription(Float32, "good_humidity", self.hear_humidity, 10)',
        )
        .replace(
            "    def hear(self, msg):\n        dry",
            "    def hear_humidity(self, msg):\n        dry",
        )
        .replace(
            "    def command(self, value):\n        self.is_open = value\n        self.out.publish",
            "    def command(self, value):\n        self.is_open = value\n        self.vents.publish",
        )
        .replace("[*checkers, Vent, Pump,", "[*checkers, Pump,"),
    ),
)

# ------------------------------------------------------------- more right ones, second sitting

_HEAD_07B = """
class TunableMonitor(Node):
    def __init__(self):
        super().__init__("tunable_monitor")
        self.declare_parameter("low", 20.0)
        self.declare_parameter("high", 26.0)
        self.statuses = self.create_publisher(String, "status", 10)
        self.create_subscription(Float32, "temperature", self.listen, 10)
"""
_HEAD_07C = """
class LogWatcher(Node):
    def __init__(self):
        super().__init__("log_watcher")
        self.names = self.create_publisher(String, "warnings", 10)
        self.create_subscription(Log, "/rosout", self.hear, 10)
"""
_HEAD_08A = """
class ModeKeeper(Node):
    def __init__(self):
        super().__init__("mode_keeper")
        qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.modes = self.create_publisher(String, "mode", qos)
        self.create_subscription(String, "command", self.obey, 10)
"""
_HEAD_08C = """
class Watchdog(Node):
    def __init__(self):
        super().__init__("watchdog")
        self.health = self.create_publisher(String, "health", 10)
        qos = QoSProfile(depth=10, deadline=Duration(seconds=2))
        events = SubscriptionEventCallbacks(deadline=self.on_silence)
        self.create_subscription(
            Float32, "temperature", self.on_reading, qos, event_callbacks=events
        )
"""
_HEAD_09A = """
class Watchman(Node):
    def __init__(self):
        super().__init__("watchman")
        self.create_subscription(Float32, "temperature", self.hear, 10)
        self.statuses = self.create_publisher(String, "status", 10)
"""
_HEAD_09B = """
class SteadyWorker(Node):
    def __init__(self):
        super().__init__("steady_worker")
        self.beats = self.create_publisher(String, "beat", 10)
        self.dones = self.create_publisher(Int32, "done", 10)
        self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
        self.create_subscription(Int32, "order", self.take, 10)
"""
_HEAD_09C = """
class AnyMonitor(Node):
    def __init__(self):
        super().__init__("any_monitor")
        self.statuses = self.create_publisher(String, "status", 10)
        self.low = self.declare_parameter("low", 20.0).value
        self.high = self.declare_parameter("high", 26.0).value
        self.unit = self.declare_parameter("unit", "C").value
        self.create_subscription(Float32, "reading", self.hear, 10)
"""
_HEAD_11B = """
class Watchdog(Node):
    def __init__(self):
        super().__init__("watchdog")
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.faults = self.create_publisher(String, "fault", 10)
        self.last = None
        self.equal = 1

    def say(self, word):
        self.faults.publish(String(data=word))
"""
_HEAD_11C = """
class DriftWatch(Node):
    def __init__(self):
        super().__init__("drift_watch")
        self.create_subscription(Float32, "reference", self.remember, 10)
        self.create_subscription(Float32, "temperature", self.compare, 10)
        self.alarms = self.create_publisher(String, "fault", 10)
        self.reference = None
        self.last = []
        self.drifts = False

    def remember(self, msg):
        self.reference = msg.data
"""
_HEAD_12A = """
class AdjustableMonitor(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.high = 26.0
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.statuses = self.create_publisher(String, "status", 10)
        self.create_service(BasicTypes, "set_high", self.set_high)

    def listen(self, msg):
        status = "High" if msg.data > self.high else "Normal"
        self.statuses.publish(String(data=status))
"""

_MORE = (
    right(
        "07a",
        "zip of keys and values, a rate that is a little off",
        """
        def findings():
            keys = (
                "publisher of /moisture, type of /moisture, messages a second on /moisture, "
                "queue depth of /gardener for /moisture, topic without a listener, "
                "topic without a publisher, node that warns, dry_below of /gardener"
            ).split(", ")
            values = "/soil_probe", "std_msgs/msg/Int32", 5.02, 3, "/lights", "/light", "/lamp", 35
            return dict(zip(keys, values, strict=True))
    """,
    ),
    right(
        "07a",
        "an OrderedDict and a key too many for notes",
        """
        from collections import OrderedDict


        def findings() -> dict[str, object]:
            found = OrderedDict()
            found["dry_below of /gardener"] = 35.0
            found["node that warns"] = "/lamp"
            found["topic without a publisher"] = "/light"
            found["topic without a listener"] = "/lights"
            found["queue depth of /gardener for /moisture"] = 3
            found["messages a second on /moisture"] = 5
            found["type of /moisture"] = "std_msgs/msg/Int32"
            found["publisher of /moisture"] = "/soil_probe"
            found["my notes"] = "that was fun"
            return found
    """,
    ),
    right(
        "07b",
        "bisect in a list of the two limits, both limits Normal",
        _HEAD_07B
        + """
    def listen(self, msg):
        low, high = self.get_parameter("low").value, self.get_parameter("high").value
        word = {(True, False): "Low", (False, True): "High"}.get((msg.data < low, msg.data > high))
        self.statuses.publish(String(data=word or "Normal"))
""",
    ),
    right(
        "07b",
        "a describing text and a range for each parameter",
        """
        from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor


        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                span = FloatingPointRange(from_value=-100.0, to_value=100.0)
                for name, first in [("low", 20.0), ("high", 26.0)]:
                    about = ParameterDescriptor(description=f"{name} limit", floating_point_range=[span])
                    self.declare_parameter(name, first, about)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                if msg.data > self.get_parameter("high").value:
                    self.say("High")
                elif msg.data < self.get_parameter("low").value:
                    self.say("Low")
                else:
                    self.say("Normal")

            def say(self, word: str) -> None:
                self.statuses.publish(String(data=word))
    """,
    ),
    right(
        "07b",
        "limits kept after each change by a post callback",
        """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.limits = {}
                self.add_post_set_parameters_callback(self.keep)
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.limits.update(low=20.0, high=26.0)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def keep(self, parameters):
                for one in parameters:
                    self.limits[one.name] = one.value

            def listen(self, msg):
                status = "Normal"
                if msg.data > self.limits["high"]:
                    status = "High"
                elif msg.data < self.limits["low"]:
                    status = "Low"
                self.statuses.publish(String(data=status))
    """,
    ),
    right(
        "07b",
        "a partial asks; a third parameter for a log line",
        """
        from functools import partial


        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("tunable_monitor")
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.declare_parameter("verbose", False)
                self.low = partial(self.get_parameter, "low")
                self.high = partial(self.get_parameter, "high")
                self.statuses = self.create_publisher(String, "status", 5)
                self.create_subscription(Float32, "/temperature", self.listen, 5)

            def listen(self, msg):
                status = "High" if self.high().value < msg.data else "Low" if self.low().value > msg.data else "Normal"
                if self.get_parameter("verbose").value:
                    self.get_logger().info(status)
                self.statuses.publish(String(data=status))
    """,
    ),
    right(
        "07c",
        "lines are collected, and told by a timer a moment later",
        """
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                self.names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, 10)
                self.new = []
                self.create_timer(0.1, self.tell)

            def hear(self, msg):
                if msg.level >= Log.WARN:
                    self.new.append(msg.name)

            def tell(self):
                while self.new:
                    self.names.publish(String(data=self.new.pop(0)))
    """,
    ),
    right(
        "07c",
        "not in the quiet levels; says in the log what it has heard, at level DEBUG",
        _HEAD_07C
        + """
    def hear(self, msg):
        if msg.level not in (Log.DEBUG, Log.INFO):
            self.get_logger().debug(f"heard {msg.name}: {msg.msg}")
            self.names.publish(String(data=f"{msg.name}"))
""",
    ),
    right(
        "07c",
        "best effort, an async callback, a dict by level",
        """
        from rclpy.qos import QoSProfile, ReliabilityPolicy


        class LogWatcher(Node):
            def __init__(self):
                super().__init__("log_watcher")
                qos = QoSProfile(depth=50, reliability=ReliabilityPolicy.BEST_EFFORT)
                self.names = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, qos)

            async def hear(self, msg):
                is_bad = {10: False, 20: False, 30: True, 40: True, 50: True}
                if is_bad.get(msg.level, False):
                    self.names.publish(String(data=msg.name))
    """,
    ),
    right(
        "07c",
        "level divided by ten",
        _HEAD_07C
        + """
    def hear(self, msg):
        for _ in range(msg.level // 10 > 2):
            self.names.publish(String(data=msg.name))
""",
    ),
    right(
        "08a",
        "an async callback, swap of two names",
        _HEAD_08A
        + """
        self.mode = ""
        self.become("idle")

    async def obey(self, msg):
        self.become(msg.data)

    def become(self, new):
        old, self.mode = self.mode, new
        if old != new:
            self.modes.publish(String(data=new))
""",
    ),
    right(
        "08a",
        "a history of modes",
        _HEAD_08A
        + """
        self.history = ["idle"]
        self.tell()

    def obey(self, msg):
        if self.history[-1] == msg.data:
            return
        self.history += [msg.data]
        self.tell()

    def tell(self):
        self.get_logger().info(" -> ".join(self.history))
        self.modes.publish(String(data=self.history[-1]))
""",
    ),
    right(
        "08a",
        "reliability and history said, the command's queue 1, a number for the durability",
        """
        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                self.out = self.create_publisher(
                    String, "mode", QoSProfile(history=1, depth=1, reliability=1, durability=1)
                )
                self.mode = String(data="idle")
                self.out.publish(self.mode)
                self.create_subscription(String, "command", self.obey, 1)

            def obey(self, command):
                if command.data == self.mode.data:
                    return
                self.mode.data = command.data
                self.out.publish(self.mode)
    """,
    ),
    right(
        "08b",
        "a long lifespan, everything said",
        """
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                qos = QoSProfile(
                    depth=64,
                    reliability=ReliabilityPolicy.BEST_EFFORT,
                    durability=DurabilityPolicy.VOLATILE,
                    lifespan=Duration(seconds=60),
                )
                self.copies = self.create_publisher(Float32, "archive", qos)
                self.create_subscription(Float32, "reading", lambda msg: self.copies.publish(msg), qos)
    """,
    ),
    right(
        "08b",
        "the preset as a base, replaced field by field; copied by a timer",
        """
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                preset = QoSPresetProfiles.SENSOR_DATA.value
                qos = QoSProfile(depth=20, reliability=preset.reliability, durability=preset.durability)
                self.create_subscription(Float32, "reading", self.keep, qos)
                self.copies = self.create_publisher(Float32, "archive", 10)
                self.kept = []
                self.create_timer(0.2, self.copy)

            def keep(self, msg):
                self.kept.append(msg)

            def copy(self):
                for msg in self.kept:
                    self.copies.publish(msg)
                self.kept.clear()
    """,
    ),
    right(
        "08b",
        "a log line for each copy, the depth computed from the pause",
        """
        class Archive(Node):
            QUEUE = 8 * 2 + 4

            def __init__(self):
                super().__init__("archive")
                qos = QoSProfile(depth=self.QUEUE)
                qos.reliability = ReliabilityPolicy.BEST_EFFORT
                self.number = 0
                self.copies = self.create_publisher(Float32, "archive", self.QUEUE)
                self.create_subscription(Float32, "reading", self.copy, qos)

            def copy(self, msg):
                self.number += 1
                self.get_logger().info(f"#{self.number:03}: {msg.data}")
                self.copies.publish(Float32(data=float(msg.data)))
    """,
    ),
    right(
        "08c",
        "events counted: only the first period of a silence is told",
        _HEAD_08C
        + """
        self.missed = 0

    def on_silence(self, event):
        self.missed += 1
        if self.missed == 1:
            self.health.publish(String(data="lost"))

    def on_reading(self, msg):
        if self.missed:
            self.health.publish(String(data="back"))
        self.missed = 0
""",
    ),
    right(
        "08c",
        "an async reading callback, a generator of the words in turn",
        """
        from itertools import cycle


        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.words = cycle(["lost", "back"])
                self.next = next(self.words)
                self.create_subscription(
                    Float32,
                    "temperature",
                    self.on_reading,
                    QoSProfile(depth=5, deadline=Duration(seconds=2)),
                    event_callbacks=SubscriptionEventCallbacks(deadline=lambda info: self.turn("lost")),
                )

            async def on_reading(self, msg):
                self.turn("back")

            def turn(self, word):
                if word == self.next:
                    self.health.publish(String(data=word))
                    self.next = next(self.words)
    """,
    ),
    right(
        "08c",
        "a timer that looks at the clock ten times a second",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.create_subscription(Float32, "temperature", self.on_reading, 10)
                self.heard, self.lost = None, False
                self.create_timer(0.1, self.look)

            def on_reading(self, msg):
                self.heard = self.get_clock().now()
                if self.lost:
                    self.lost = False
                    self.health.publish(String(data="back"))

            def look(self):
                if self.heard is None or self.lost:
                    return
                if self.get_clock().now() - self.heard > Duration(seconds=2):
                    self.lost = True
                    self.health.publish(String(data="lost"))
    """,
    ),
    right(
        "09a",
        "an async callback, a timer that is made at the first reading",
        _HEAD_09A
        + """
        self.timer, self.lost = None, False

    async def hear(self, msg):
        if self.timer is None:
            self.timer = self.create_timer(3.5, self.miss)
        self.timer.reset()
        if self.lost:
            self.lost = False
            self.statuses.publish(String(data="back"))

    def miss(self):
        if not self.lost:
            self.lost = True
            self.statuses.publish(String(data="lost"))
""",
    ),
    right(
        "09a",
        "a helper class that is true while there is silence",
        """
        class Silence:
            def __init__(self, clock, seconds):
                self.clock, self.limit = clock, seconds * 1e9
                self.since = None

            def heard(self):
                self.since = self.clock.now().nanoseconds

            def __bool__(self):
                return self.since is not None and self.clock.now().nanoseconds - self.since >= self.limit


        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.silence = Silence(self.get_clock(), 3)
                self.said = "back"
                self.create_timer(0.3, self.look)

            def hear(self, msg):
                self.silence.heard()
                self.look()

            def look(self):
                if self.silence.since is not None:
                    self.say("lost" if self.silence else "back")

            def say(self, word):
                if self.said != word:
                    self.said = word
                    self.statuses.publish(String(data=word))
    """,
    ),
    right(
        "09a",
        "a timer of one second, and a look that may come nearly a second late",
        _HEAD_09A
        + """
        self.last_heard = None
        self.is_lost = False
        self.timer = self.create_timer(1.0, self.look)

    def hear(self, msg):
        self.last_heard = self.get_clock().now().seconds_nanoseconds()
        if self.is_lost:
            self.statuses.publish(String(data="back"))
        self.is_lost = False

    def look(self):
        if self.is_lost or not self.last_heard:
            return
        seconds, nanoseconds = self.get_clock().now().seconds_nanoseconds()
        heard = self.last_heard[0] + self.last_heard[1] / 1e9
        if seconds + nanoseconds / 1e9 - heard > 3:
            self.is_lost = True
            self.statuses.publish(String(data="lost"))
""",
    ),
    right(
        "09b",
        "one timer for the beat and for the work",
        """
        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_subscription(Int32, "order", self.take, 10)
                self.queue = []
                self.ticks = 0
                self.create_timer(0.125, self.tick)

            def take(self, msg):
                self.queue.append([msg.data, None])

            def tick(self):
                self.ticks += 1
                if self.ticks % 8 == 0:
                    self.beats.publish(String(data="tock"))
                now = self.get_clock().now().nanoseconds
                if self.queue:
                    order = self.queue[0]
                    if order[1] is None:
                        order[1] = now
                    if now - order[1] >= 2.99e9:
                        self.dones.publish(Int32(data=order[0]))
                        self.queue.pop(0)
                        if self.queue:
                            self.queue[0][1] = now
    """,
    ),
    right(
        "09b",
        "a coroutine that awaits futures set by a timer, in a group of its own",
        """
        from rclpy.task import Future


        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                group = MutuallyExclusiveCallbackGroup()
                self.create_subscription(Int32, "order", self.work, 10, callback_group=group)

            async def work(self, msg):
                future = Future()
                timer = self.create_timer(3.0, lambda: future.set_result(None))
                await future
                self.destroy_timer(timer)
                self.dones.publish(msg)
    """,
    ),
    right(
        "09b",
        "a state of two words, a timer made when work begins",
        _HEAD_09B
        + """
        self.orders = []
        self.state = "idle"
        self.timer = None

    def take(self, msg):
        self.orders.append(msg)
        if self.state == "idle":
            self.state = "busy"
            self.timer = self.create_timer(3.0, self.finish)

    def finish(self):
        self.dones.publish(self.orders.pop(0))
        if not self.orders:
            self.state = "idle"
            self.timer.cancel()
            self.destroy_timer(self.timer)
""",
    ),
    right(
        "09c",
        "parameters asked for at each reading, format with a sign of two decimals",
        """
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.declare_parameters("", [("low", 20.0), ("high", 26.0), ("unit", "C")])
                self.create_subscription(Float32, "reading", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)

            def hear(self, msg):
                low, high, unit = (
                    one.value for one in self.get_parameters(["low", "high", "unit"])
                )
                match msg.data:
                    case x if x > high:
                        word = "High"
                    case x if x < low:
                        word = "Low"
                    case _:
                        word = "Normal"
                self.statuses.publish(String(data=f"{word} {msg.data:.2f} {unit}"))
    """,
    ),
    right(
        "09c",
        "str of the number itself",
        _HEAD_09C
        + """
    def hear(self, msg):
        word = "Normal"
        if msg.data > self.high:
            word = "High"
        if msg.data < self.low:
            word = "Low"
        self.statuses.publish(String(data=word + " " + str(msg.data) + " " + self.unit))
""",
    ),
    right(
        "09c",
        "printed into a StringIO, and a log line beside it",
        "import io\n"
        + _HEAD_09C
        + """
    def hear(self, msg):
        text = io.StringIO()
        words = {-1: "Low", 0: "Normal", 1: "High"}
        side = int(msg.data > self.high) - int(msg.data < self.low)
        print(words[side], format(msg.data, ".3f"), self.unit, end="", file=text)
        self.get_logger().info(text.getvalue())
        self.statuses.publish(String(data=text.getvalue()))
""",
    ),
    right(
        "09c",
        "numpy's float32, rounded to two decimals, as a text",
        "import numpy\n"
        + _HEAD_09C
        + """
    def hear(self, msg):
        value = numpy.float32(msg.data)
        word = numpy.select([value > self.high, value < self.low], ["High", "Low"], "Normal")
        self.statuses.publish(String(data=f"{word!s} {value:.1f} {self.unit}"))
""",
    ),
    right(
        "11a",
        "a list of pairs sorted by time, and accumulate",
        """
        def look_into(bag):
            readings = sorted(bag.messages("temperature"), key=lambda one: one.time)
            times = [one.time for one in readings]
            gap = max(b - a for a, b in zip(times[:-1], times[1:]))
            finite = list(filter(math.isfinite, (one.value for one in readings)))
            return {"messages": len(times), "gap": gap, "mean": math.fsum(finite) / len(finite)}
    """,
    ),
    right(
        "11a",
        "nanoseconds as whole numbers, then divided",
        """
        def look_into(bag):
            at = [round(one.time * 1e9) for one in bag.messages("temperature")]
            values = [one.value for one in bag.messages("temperature")]
            good = [value for value in values if not value != value]
            longest = 0
            for number in range(1, len(at)):
                longest = max(longest, at[number] - at[number - 1])
            return {"messages": len(at), "gap": longest / 1e9, "mean": sum(good) / len(good)}
    """,
    ),
    right(
        "11a",
        "a dataclass as a dict, an absolute name of the topic",
        """
        from dataclasses import asdict, dataclass


        @dataclass
        class Found:
            messages: int
            gap: float
            mean: float


        def look_into(bag):
            readings = bag.messages("/temperature")
            mean, n = 0.0, 0
            for reading in readings:
                if not math.isnan(reading.value):
                    n += 1
                    mean += (reading.value - mean) / n
            gap = max(readings[i + 1].time - readings[i].time for i in range(len(readings) - 1))
            return asdict(Found(len(readings), gap, mean))
    """,
    ),
    right(
        "11b",
        "a match statement over the last reading and this one",
        _HEAD_11B
        + """
    def listen(self, msg):
        match self.last, msg.data:
            case _, value if math.isnan(value):
                self.say("nan")
            case None, value:
                self.last = value
            case last, value if value == last:
                self.equal += 1
                if self.equal == 5:
                    self.say("stuck")
            case last, value:
                if not -5.0 <= value - last <= 5.0:
                    self.say("jump")
                self.equal = 1
                self.last = value
""",
    ),
    right(
        "11b",
        "a list of all numbers, looked at from its end",
        _HEAD_11B
        + """
        self.all = []

    def listen(self, msg):
        if math.isnan(msg.data):
            return self.say("nan")
        self.all.append(msg.data)
        if len(self.all) >= 2 and abs(self.all[-1] - self.all[-2]) > 5.0:
            self.say("jump")
        run = 0
        for value in reversed(self.all):
            if value != msg.data:
                break
            run += 1
        if run == 5:
            self.say("stuck")
""".replace("        self.all = []\n\n", "")
        .replace("    def listen", "    all = []\n\n    def listen")
        .replace("        self.all.append(msg.data)", "        self.all = [*self.all, msg.data]"),
    ),
    right(
        "11b",
        "itertools.groupby over the memory",
        "from itertools import groupby\n"
        + _HEAD_11B
        + """
    memory = ()

    def listen(self, msg):
        value = msg.data
        if value != value:
            self.say("nan")
            return
        if self.memory and abs(self.memory[-1] - value) > 5:
            self.say("jump")
        self.memory = (*self.memory, value)[-50:]
        *_, (_, newest) = ((key, list(group)) for key, group in groupby(self.memory))
        if len(newest) == 5:
            self.say("stuck")
""",
    ),
    right(
        "11c",
        "the sum of ten compared with ten",
        _HEAD_11C
        + """
    def compare(self, msg):
        if self.reference is None or math.isnan(self.reference) or math.isnan(msg.data):
            return
        self.last.append(msg.data - self.reference)
        if len(self.last) > 10:
            del self.last[0]
        if len(self.last) == 10:
            self.judge(abs(sum(self.last)) > 10.0)

    def judge(self, off):
        if off > self.drifts:
            self.alarms.publish(String(data="drift"))
        self.drifts = off
""",
    ),
    right(
        "11c",
        "numpy's roll over an array full of NaN",
        "import numpy as np\n"
        + _HEAD_11C
        + """
        self.last = np.full(10, np.nan)

    def compare(self, msg):
        difference = msg.data - (np.nan if self.reference is None else self.reference)
        if np.isnan(difference):
            return
        self.last = np.roll(self.last, -1)
        self.last[-1] = difference
        mean = self.last.mean()
        if not np.isnan(mean):
            off = bool(abs(mean) > 1.0)
            if off and not self.drifts:
                self.alarms.publish(String(data="drift"))
            self.drifts = off
""".replace("        self.last = np.full(10, np.nan)\n\n", "")
        .replace("    def compare", "    last = None\n\n    def compare")
        .replace(
            "        self.last = np.roll(self.last, -1)",
            "        if len(self.last) == 0:\n            self.last = np.full(10, np.nan)\n"
            "        self.last = np.roll(self.last, -1)",
        ),
    ),
    right(
        "11c",
        "a window class with maxlen, an async callback, the state as a text",
        """
        from collections import deque


        class Window(deque):
            @property
            def is_full(self):
                return len(self) == self.maxlen

            @property
            def mean(self):
                return sum(self) / len(self)


        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.fault = self.create_publisher(String, "fault", 1)
                self.window = Window(maxlen=10)
                self.state = "fine"
                self.newest = {}
                for topic, then in (("reference", None), ("temperature", self.compare)):
                    self.create_subscription(Float32, topic, self.storing(topic, then), 10)

            def storing(self, topic, then):
                def store(msg):
                    self.newest[topic] = msg.data
                    if then:
                        then()

                return store

            def compare(self):
                if "reference" not in self.newest:
                    return
                difference = self.newest["temperature"] - self.newest["reference"]
                if math.isfinite(difference):
                    self.window.append(difference)
                if not self.window.is_full:
                    return
                new = "drift" if abs(self.window.mean) > 1.0 else "fine"
                if new == "drift" != self.state:
                    self.fault.publish(String(data=new))
                self.state = new
    """,
    ),
    right(
        "12a",
        "the limits as constants, min and max, a service with keywords",
        """
        class AdjustableMonitor(Node):
            LEAST, MOST = 10.0, 40.0

            def __init__(self):
                super().__init__("temperature_monitor")
                self.high = 26.0
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_service(srv_type=BasicTypes, srv_name="set_high", callback=self.set_high)

            def listen(self, msg):
                self.statuses.publish(String(data="High" if msg.data > self.high else "Normal"))

            def set_high(self, request, response):
                wish = request.float32_value
                possible = max(self.LEAST, min(self.MOST, wish))
                response.bool_value = possible == wish
                response.string_value = "" if possible == wish else f"{possible} would be possible"
                self.high = wish if response.bool_value else self.high
                return response
    """,
    ),
    right(
        "12a",
        "guard clauses for each kind of nonsense",
        "import math\n"
        + _HEAD_12A
        + """
    def set_high(self, request, response):
        value = request.float32_value
        for is_bad, why in (
            (math.isnan(value), "not a number"),
            (value < 10.0, "too low"),
            (value > 40.0, "too high"),
        ):
            if is_bad:
                response.bool_value = False
                response.string_value = why
                return response
        self.high = value
        response.bool_value = True
        return response
""",
    ),
    right(
        "12a",
        "the reason is also logged; a reason for good ones, too",
        _HEAD_12A
        + """
    def set_high(self, request, response):
        good = not (not request.float32_value >= 10 or not request.float32_value <= 40)
        old = self.high
        if good:
            self.high = request.float32_value
        response.bool_value = good
        response.string_value = f"was {old}, wished {request.float32_value}, is {self.high}"
        self.get_logger().info(response.string_value)
        return response
""",
    ),
    right(
        "12b",
        "all() over both conditions, ChainMap",
        "from collections import ChainMap\n"
        + _HEAD_12B
        + """
    def look(self, parameters):
        new = ChainMap({one.name: one.value for one in parameters}, self.limits())
        result = SetParametersResult(successful=True)
        if not new["low"] < new["high"]:
            result.successful = False
            result.reason = f"low {new['low']} has to be below high {new['high']}"
        return result
""",
    ),
    right(
        "12b",
        "an exception within, turned into a reason",
        _HEAD_12B
        + """
    def look(self, parameters):
        new = self.limits()
        for parameter in parameters:
            new[parameter.name] = parameter.value
        try:
            self.check(**new)
        except ValueError as error:
            self.get_logger().error(f"refused: {error}")
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    @staticmethod
    def check(low: float, high: float) -> None:
        if low < high:
            return
        raise ValueError(f"{low} is not below {high}")
""",
    ),
    right(
        "12b",
        "the difference is greater than zero; next() with a default",
        _HEAD_12B
        + """
    def look(self, parameters):
        def new(name):
            values = (one.value for one in parameters if one.name == name)
            return next(values, self.get_parameter(name).value)

        room = new("high") - new("low")
        if room > 0:
            return SetParametersResult(successful=True, reason="fine")
        return SetParametersResult(successful=False, reason=f"room for Normal: {room}")
""",
    ),
    right(
        "12c",
        "a return in the middle for a canceled goal",
        _HEAD_12C
        + _DECIDE_12C
        + """
    async def heat(self, goal_handle):
        target = goal_handle.request.order
        temperatures = []
        self.heater.publish(Bool(data=True))
        reached = False
        while not reached:
            temperatures.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=list(temperatures)))
            reached = temperatures[-1] >= target
            if goal_handle.is_cancel_requested:
                self.heater.publish(Bool(data=False))
                goal_handle.canceled()
                return Fibonacci.Result(sequence=temperatures)
        self.heater.publish(Bool(data=False))
        goal_handle.succeed()
        return Fibonacci.Result(sequence=temperatures)
""",
    ),
    right(
        "12c",
        "an async generator of readings, async for, a numpy array in the messages",
        "import numpy as np\n"
        + _HEAD_12C
        + _DECIDE_12C
        + """
    async def readings(self):
        while True:
            yield await self.reading

    async def heat(self, goal_handle):
        self.heater.publish(Bool(data=True))
        seen = []
        end = None
        async for degrees in self.readings():
            seen.append(degrees)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=np.array(seen, dtype=np.int32)))
            if goal_handle.is_cancel_requested:
                end = goal_handle.canceled
            elif degrees >= goal_handle.request.order:
                end = goal_handle.succeed
            if end:
                break
        self.heater.publish(Bool(data=False))
        end()
        return Fibonacci.Result(sequence=seen)
""",
    ),
    right(
        "12c",
        "a context manager for the heater",
        "from contextlib import contextmanager\n"
        + _HEAD_12C
        + """
    LEAST, MOST = 10, 26

    def decide(self, goal):
        is_fine = self.LEAST <= goal.order <= self.MOST
        return [GoalResponse.REJECT, GoalResponse.ACCEPT][is_fine]

    @contextmanager
    def heating(self):
        self.heater.publish(Bool(data=True))
        try:
            yield
        finally:
            self.heater.publish(Bool(data=False))

    async def heat(self, goal_handle):
        result = Fibonacci.Result()
        with self.heating():
            while not (goal_handle.is_cancel_requested or self.is_warm(result, goal_handle.request)):
                result.sequence.append(await self.reading)
                goal_handle.publish_feedback(Fibonacci.Feedback(sequence=result.sequence))
        if goal_handle.is_cancel_requested:
            goal_handle.canceled()
        else:
            goal_handle.succeed()
        return result

    def is_warm(self, result, request):
        return len(result.sequence) > 0 and result.sequence[-1] >= request.order
""",
    ),
    right(
        "12c",
        "the first reading is awaited before heating begins",
        _HEAD_12C
        + _DECIDE_12C
        + """
    async def heat(self, goal_handle):
        degrees = [await self.reading]
        goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
        self.heater.publish(Bool(data=degrees[0] < goal_handle.request.order))
        while degrees[-1] < goal_handle.request.order and not goal_handle.is_cancel_requested:
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
        self.heater.publish(Bool(data=False))
        if goal_handle.is_cancel_requested:
            goal_handle.canceled()
        else:
            goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
""",
    ),
    right(
        "13a",
        "states as functions that follow each other",
        _HEAD_13A.replace("self.temperature_callback", "self.hear")
        + """
        self.state = self.closed

    def hear(self, msg):
        self.state = self.state(msg.data)

    def closed(self, temperature):
        if temperature > self.get_parameter("open_above").value:
            self.publisher_.publish(Bool(data=True))
            return self.opened
        return self.closed

    def opened(self, temperature):
        if temperature < self.get_parameter("close_below").value:
            self.publisher_.publish(Bool(data=False))
            return self.closed
        return self.opened
""",
    ),
    right(
        "13a",
        "None for stays as it is",
        _HEAD_13A
        + _READ_13A
        + """
        wanted = {(True, False): True, (False, True): False}.get((msg.data > above, msg.data < below))
        if wanted is None or wanted is self.is_open:
            return
        self.is_open = wanted
        self.publisher_.publish(Bool(data=self.is_open))
""",
    ),
    right(
        "13a",
        "a command log beside it, an extra topic with the reason",
        _HEAD_13A
        + """
        self.reasons = self.create_publisher(String, "vent_reason", 10)
"""
        + _READ_13A
        + """
        opens = msg.data > above and not self.is_open
        closes = msg.data < below and self.is_open
        if opens or closes:
            self.is_open = opens
            self.publisher_.publish(Bool(data=opens))
            self.reasons.publish(String(data=f"{msg.data:.1f} degrees"))
""",
    ),
    right(
        "13b",
        "the alarm looks with a timer; an extra heartbeat topic",
        _GOOD_13B.replace(
            "        self.egg = node.create_timer(5.0, self.miss)\n",
            "        self.at = node.get_clock().now()\n        node.create_timer(0.5, self.look)\n",
        )
        .replace("        self.egg.reset()\n", "        self.at = self.node.get_clock().now()\n")
        .replace(
            "    def miss(self):\n        self.egg.cancel()\n",
            "    def look(self):\n        age = self.node.get_clock().now() - self.at\n"
            "        if age.nanoseconds >= 5_000_000_000 and not self.silent:\n            self.miss()\n\n"
            "    def miss(self):\n",
        )
        .replace(
            "        self.watches = [",
            '        beats = self.create_publisher(String, "alarm_beat", 1)\n'
            '        self.create_timer(1.0, lambda: beats.publish(String(data="alive")))\n'
            "        self.watches = [",
        ),
    ),
    right(
        "13b",
        "node names and namespaces given from outside",
        _GOOD_13B.replace(
            "[*checkers, Vent, Pump, Alarm, Report]",
            '[*checkers, (Vent, {"name": "luke"}), (Pump, {"name": "pumpe", "parameters": {"dry_below": 40.0}}), '
            '(Alarm, {}), (Report, {"name": "bericht"})]',
        ),
    ),
    right(
        "13b",
        "the pump's timers are made when they are needed",
        _GOOD_13B.replace(
            "        self.create_timer(0.1, self.look)\n\n    def now",
            "        self.timer = None\n\n    def now",
        )
        .replace(
            "            self.out.publish(Bool(data=True))\n\n    def look(self):\n"
            "        if self.stop_at is not None and self.now() >= self.stop_at:\n            self.switch_off()\n",
            "            self.timer = self.create_timer(5.0, self.switch_off)\n"
            "            self.out.publish(Bool(data=True))\n",
        )
        .replace(
            "        self.stop_at = None\n        self.rested_at = self",
            "        self.timer.cancel()\n        self.destroy_timer(self.timer)\n"
            "        self.stop_at = None\n        self.rested_at = self",
        ),
    ),
    right(
        "13b",
        "the report's list is made anew for each reading",
        _GOOD_13B.replace(
            "        self.readings.append(msg.data)",
            "        self.readings = self.readings + [msg.data]",
        ),
    ),
    right(
        "13b",
        "one node wishes, another commands the vent",
        _GOOD_13B.replace(
            "def greenhouse():\n",
            '''
class Wish(Node):
    """Says what the vent should do; another one decides."""

    def __init__(self):
        super().__init__("wish")
        self.declare_parameter("open_above", 28.0)
        self.declare_parameter("close_below", 26.0)
        self.out = self.create_publisher(String, "wish", 10)
        self.create_subscription(Float32, "good_temperature", self.hear, 10)

    def hear(self, msg):
        if msg.data > self.get_parameter("open_above").value:
            self.out.publish(String(data="open"))
        elif msg.data < self.get_parameter("close_below").value:
            self.out.publish(String(data="close"))


class VentByWish(Node):
    def __init__(self):
        super().__init__("vent_by_wish")
        self.out = self.create_publisher(Bool, "vent", LATCHED)
        self.create_subscription(String, "wish", self.obey, 10)
        self.state = "close"

    def obey(self, msg):
        if msg.data != self.state:
            self.state = msg.data
            self.out.publish(Bool(data=msg.data == "open"))


def greenhouse():
''',
        ).replace("[*checkers, Vent,", "[*checkers, Wish, VentByWish,"),
    ),
)

# ------------------------------------------------------------------ third sitting: edges

_EDGES = (
    right(
        "08c",
        "a timer that looks twice a second",
        _HEAD_08C.split("        qos =")[0]
        + """
        self.create_subscription(Float32, "temperature", self.on_reading, 10)
        self.create_timer(0.5, self.look)
        self.heard, self.word = None, "back"

    def on_reading(self, msg):
        self.heard = self.get_clock().now()
        self.say("back")

    def look(self):
        if self.heard and self.get_clock().now() - self.heard >= Duration(seconds=2):
            self.say("lost")

    def say(self, word):
        if word != self.word:
            self.word = word
            self.health.publish(String(data=word))
""",
    ),
    right(
        "11a",
        "numbers rounded to four decimals",
        """
        def look_into(bag):
            readings = bag.messages("temperature")
            times = [one.time for one in readings]
            values = [one.value for one in readings if not math.isnan(one.value)]
            return {
                "messages": len(readings),
                "gap": round(max(b - a for a, b in zip(times, times[1:])), 4),
                "mean": round(sum(values) / len(values), 4),
            }
    """,
    ),
    right(
        "11a",
        "an extra key beside the three",
        """
        def look_into(bag):
            readings = bag.messages("temperature")
            gaps = [b.time - a.time for a, b in zip(readings, readings[1:])]
            values = [one.value for one in readings if not math.isnan(one.value)]
            found = {"messages": len(readings), "gap": max(gaps), "mean": sum(values) / len(values)}
            found["nan"] = len(readings) - len(values)
            return found
    """,
    ),
    right(
        "13a",
        "the limits are asked for once, when the node is started",
        _LATCHED
        + """

class VentControl(Node):
    def __init__(self):
        super().__init__("vent_control")
        self.above = self.declare_parameter("open_above", 28.0).value
        self.below = self.declare_parameter("close_below", 26.0).value
        self.publisher_ = self.create_publisher(Bool, "vent", LATCHED)
        self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
        self.is_open = False

    def temperature_callback(self, msg):
        before = self.is_open
        self.is_open = msg.data > self.above or (before and msg.data >= self.below)
        if self.is_open != before:
            self.publisher_.publish(Bool(data=self.is_open))
""",
    ),
    right(
        "13b",
        "a report of NaN if there is no reading ('may say nothing')",
        _changed(
            "        if readings:\n            self.out.publish(Float32(data=math.fsum(readings) / len(readings)))\n",
            "        mean = math.fsum(readings) / len(readings) if readings else math.nan\n"
            "        self.out.publish(Float32(data=mean))\n",
        ),
    ),
    right(
        "13b",
        "limits read once, at the start",
        _changed(
            '        if not self.is_open and msg.data > self.get_parameter("open_above").value:',
            "        if not self.is_open and msg.data > self.above:",
        ).replace(
            '        self.declare_parameter("open_above", 28.0)\n',
            '        self.above = self.declare_parameter("open_above", 28.0).value\n',
        ),
    ),
    right(
        "13b",
        "the guard of R5 writes a warning for each nonsense",
        _changed(
            "            self.out.publish(Float32(data=msg.data))\n",
            "            self.out.publish(Float32(data=msg.data))\n        else:\n"
            '            self.get_logger().warning(f"{msg.data} cannot be")\n',
        ),
    ),
    right(
        "13b",
        "a pump that stops after 5 s by counting ticks of half a second",
        _changed("self.create_timer(0.1, self.look)", "self.create_timer(0.5, self.look)"),
    ),
    right("13b", "a pump that rests 30 seconds ('at least 20')", _changed("+ 20.0", "+ 30.0")),
    right("13b", "a pump that rests 24 seconds", _changed("+ 20.0", "+ 24.0")),
    right("13b", "a pump that rests 28 seconds", _changed("+ 20.0", "+ 28.0")),
    right("13b", "a pump that rests 60 seconds", _changed("+ 20.0", "+ 60.0")),
    wrong(
        "13b",
        "a pump that rests 60 seconds, and goes on when the vent opens",
        "no-interlock",
        _changed("+ 20.0", "+ 60.0").replace(
            "        if msg.data and self.stop_at is not None:\n            self.switch_off()\n", ""
        ),
    ),
    wrong("13b", "a pump that rests an hour", "never-switched-on", _changed("+ 20.0", "+ 3600.0")),
    right(
        "09b",
        "publishes progress on a topic of its own, and beats by name",
        _HEAD_09B
        + """
        self.progress = self.create_publisher(String, "progress", 10)
        self.waiting = []
        self.left = 0
        self.create_timer(0.25, self.tick)
        self.since = None

    def take(self, msg):
        self.waiting.append(msg.data)
        if self.since is None:
            self.since = self.get_clock().now()

    def tick(self):
        if self.since is None:
            return
        now = self.get_clock().now()
        part = (now - self.since).nanoseconds / 3e9
        self.progress.publish(String(data=f"{part:.0%}"))
        if part >= 1:
            self.dones.publish(Int32(data=self.waiting.pop(0)))
            self.since = now if self.waiting else None
""",
    ),
    right(
        "09c",
        "a tuple is joined, three decimals",
        _HEAD_09C
        + """
    WORDS = ("Normal", "High", "Low")

    def hear(self, msg):
        word = self.WORDS[1 if msg.data > self.high else 2 if msg.data < self.low else 0]
        self.statuses.publish(String(data=" ".join((word, f"{msg.data:.3f}", self.unit)).strip()))
""",
    ),
    right(
        "12a",
        "the service is made before all else; the value rounded for the text only",
        """
        class AdjustableMonitor(Node):
            def __init__(self):
                Node.__init__(self, "temperature_monitor")
                self.threshold = self.create_service(BasicTypes, "set_high", self.answer)
                self.statuses = self.create_publisher(String, "status", 10)
                self.subscription = self.create_subscription(Float32, "temperature", self.listen, 10)
                self.high = 26.0

            def listen(self, msg):
                self.statuses.publish(String(data=("Normal", "High")[int(msg.data > self.high)]))

            def answer(self, request: BasicTypes.Request, response: BasicTypes.Response):
                new = request.float32_value
                if not (10.0 <= new <= 40.0):
                    response.bool_value, response.string_value = False, f"not {round(new, 1)}" if new == new else "NaN"
                    return response
                self.high, response.bool_value = new, True
                return response
    """,
    ),
    right(
        "12b",
        "one limit from a dict with get",
        _HEAD_12B
        + """
    def look(self, parameters):
        asked = {one.name: one.value for one in parameters}
        now = self.limits()
        low = asked.get("low", now["low"])
        high = asked.get("high", now["high"])
        ok = low < high
        return SetParametersResult(successful=ok, reason="" if ok else f"{low=} {high=}")
""",
    ),
    right(
        "11c",
        "the alarm is armed and disarmed",
        _HEAD_11C
        + """
    armed = True

    def compare(self, msg):
        if self.reference is None:
            return
        difference = msg.data - self.reference
        if difference != difference:
            return
        self.last = (self.last + [difference])[-10:]
        if len(self.last) != 10:
            return
        if not -1.0 <= sum(self.last) / 10 <= 1.0:
            if self.armed:
                self.armed = False
                self.alarms.publish(String(data="drift"))
        else:
            self.armed = True
""",
    ),
    right(
        "07c",
        "a dict of levels, printed",
        _HEAD_07C
        + """
    LEVELS = {30: "WARN", 40: "ERROR", 50: "FATAL"}

    def hear(self, msg):
        if msg.level in self.LEVELS:
            print(self.LEVELS[msg.level], msg.name)
            self.names.publish(String(data=msg.name))
""",
    ),
    right(
        "08a",
        "an absolute name, a walrus",
        _HEAD_08A.replace('"command"', '"/command"')
        + """
        self.last = String()
        self.obey(String(data="idle"))

    def obey(self, msg: String) -> None:
        if self.last.data != (new := msg.data):
            self.last = String(data=new)
            self.modes.publish(self.last)
""",
    ),
    either(
        "09c",
        "the f is missing at the unit only",
        ("f-missing",),
        _HEAD_09C
        + """
    def hear(self, msg):
        word = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
        self.statuses.publish(String(data=f"{word} {msg.data:.1f} " + "{self.unit}"))
""",
    ),
    either(
        "08c",
        "back for each reading after the first loss",
        ("back-too-often", "status-repeated"),
        _HEAD_08C
        + """
        self.lost = False
        self.ever = False

    def on_silence(self, event):
        if not self.lost:
            self.lost = self.ever = True
            self.health.publish(String(data="lost"))

    def on_reading(self, msg):
        self.lost = False
        if self.ever:
            self.health.publish(String(data="back"))
""",
    ),
    either(
        "07b",
        "the first values are swapped, nothing else",
        ("other-default", "parameters-swapped"),
        _HEAD_07B.replace("20.0", "x").replace("26.0", "20.0").replace("x)", "26.0)")
        + """
    def listen(self, msg):
        low, high = self.get_parameter("low").value, self.get_parameter("high").value
        status = "High" if msg.data > high else "Low" if msg.data < low else "Normal"
        self.statuses.publish(String(data=status))
""",
    ),
    either(
        "09a",
        "back for each reading",
        ("back-too-often", "status-repeated"),
        _HEAD_09A
        + """
        self.silence = self.create_timer(3.0, self.miss)
        self.silence.cancel()

    def hear(self, msg):
        self.silence.reset()
        self.statuses.publish(String(data="back"))

    def miss(self):
        self.silence.cancel()
        self.statuses.publish(String(data="lost"))
""",
    ),
    either(
        "07c",
        "the INFO lines, too",
        ("level-too-low",),
        _HEAD_07C
        + """
    def hear(self, msg):
        if msg.level >= Log.INFO:
            self.names.publish(String(data=msg.name))
""",
    ),
    either(
        "13a",
        "False at the start, although nothing changes",
        ("status-repeated", "wrong-start"),
        _HEAD_13A
        + """        self.publisher_.publish(Bool(data=False))
"""
        + _READ_13A
        + """
        wanted = msg.data > above or (self.is_open and msg.data >= below)
        if wanted != self.is_open:
            self.is_open = wanted
            self.publisher_.publish(Bool(data=wanted))
""",
    ),
    either(
        "08c",
        "on_silence with two parameters for the event",
        ("callback-parameters",),
        _HEAD_08C
        + """
        self.lost = False

    def on_silence(self, event, info):
        self.lost = True
        self.health.publish(String(data="lost"))

    def on_reading(self, msg):
        if self.lost:
            self.health.publish(String(data="back"))
        self.lost = False
""",
    ),
    either(
        "09b",
        "done is published when the work begins",
        ("work-too-short",),
        _HEAD_09B
        + """
    def take(self, msg):
        self.dones.publish(msg)
""",
    ),
)


_ALL = (
    *_07A,
    *_07B,
    *_07C,
    *_08A,
    *_08B,
    *_08C,
    *_09A,
    *_09B,
    *_09C,
    *_11A,
    *_11B,
    *_11C,
    *_12A,
    *_12B,
    *_12C,
    *_13A,
    *_13B,
    *_MORE,
    *_EDGES,
)

#: What a judge should say otherwise, and why; these are not run.
REASONS = {
    # Passed. "its limits are parameters: values that whoever starts a node can change" is not true
    # of it; but "This node has R1 and R7 to meet", and neither asks for that. May be left so.
    "13a the numbers 28 and 26 in the code, the parameters are not used",
    # Passed, with 5 commands. R7 wants a command "only when it changes", and the vent is closed
    # "until the first command". May be meant kindly; then R7 should say so.
    "13a False at the start, although nothing changes",
}
DISAGREE = tuple(answer for answer in _ALL if answer.id in REASONS)
ANSWERS = tuple(answer for answer in _ALL if answer.id not in REASONS)
