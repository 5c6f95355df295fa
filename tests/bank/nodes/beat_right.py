"""03a, another sensor: right answers, in many styles."""

from bank.answer import right

ANSWERS = (
    right("03a", "as in the tutorial", '''
        class HumiditySensor(Node):
            def __init__(self):
                super().__init__('humidity_sensor')

                #Create publisher
                self.publisher_ = self.create_publisher(Float32, 'humidity', 5)

                #Create timer
                self.timer = self.create_timer(0.5, self.publish_humidity)
                self.get_logger().info('Humidity Sensor Node Started')

            def publish_humidity(self):
                msg = Float32()
                msg.data = 45.0
                self.publisher_.publish(msg)
                self.get_logger().info(f'Publishing: {msg.data:.1f}%')
    '''),
    right("03a", "a profile", '''
        from rclpy.qos import QoSProfile

        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                qos = QoSProfile(depth=5)
                self.publisher_ = self.create_publisher(Float32, "/humidity", qos)
                self.timer = self.create_timer(1 / 2, self.publish_humidity)

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=45.0))
    '''),
    right("03a", "a full profile", '''
        from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

        QOS = QoSProfile(
            history=HistoryPolicy.KEEP_LAST,
            depth=5,
            reliability=ReliabilityPolicy.RELIABLE,
            durability=DurabilityPolicy.TRANSIENT_LOCAL,
        )

        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.publisher_ = self.create_publisher(Float32, "humidity", QOS)
                self.timer = self.create_timer(0.5, self.publish_humidity)

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=45.0))
    '''),
    right("03a", "parameters", '''
        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.declare_parameters("", [("topic", "humidity"), ("rate", 2.0), ("depth", 5)])
                topic, rate, depth = (
                    self.get_parameter(name).value for name in ("topic", "rate", "depth")
                )
                self.publisher_ = self.create_publisher(Float32, topic, depth)
                self.timer = self.create_timer(1.0 / rate, self.publish_humidity)

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=45.0))
    '''),
    right("03a", "class attributes and type hints", '''
        from typing import ClassVar

        class HumiditySensor(Node):
            topic: ClassVar[str] = "humidity"
            hertz: ClassVar[int] = 2

            def __init__(self) -> None:
                super().__init__("humidity_sensor")
                self.publisher_ = self.create_publisher(Float32, self.topic, qos_profile=5)
                self.timer = self.create_timer(1 / self.hertz, callback=self.publish_humidity)

            def publish_humidity(self) -> None:
                reading: Float32 = Float32(data=float(45))
                self.publisher_.publish(reading)
    '''),
    right("03a", "a dataclass that owns the publisher", '''
        from dataclasses import dataclass
        from typing import Any

        @dataclass
        class Outlet:
            publisher: Any
            value: float = 45.0

            def send(self) -> None:
                self.publisher.publish(Float32(data=self.value))

        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.outlet = Outlet(self.create_publisher(Float32, "humidity", 5))
                self.timer = self.create_timer(0.5, self.outlet.send)
    '''),
    right("03a", "a base class", '''
        class Sensor(Node):
            value = 0.0

            def __init__(self, name, topic, period, depth=10):
                super().__init__(name)
                self.publisher_ = self.create_publisher(Float32, topic, depth)
                self.timer = self.create_timer(period, self.tick)

            def tick(self):
                self.publisher_.publish(Float32(data=self.value))

        class HumiditySensor(Sensor):
            value = 45.0

            def __init__(self):
                super().__init__("humidity_sensor", "humidity", 0.5, depth=5)
    '''),
    right("03a", "a lambda and a property", '''
        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.publisher_ = self.create_publisher(Float32, "humidity", 5)
                self.timer = self.create_timer(0.5, lambda: self.publisher_.publish(self.reading))

            @property
            def reading(self):
                return Float32(data=45.0)
    '''),
    right("03a", "numpy", '''
        import numpy as np

        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.values = np.linspace(40.0, 50.0, 100)
                self.index = 0
                self.publisher_ = self.create_publisher(Float32, "humidity", 5)
                self.timer = self.create_timer(0.5, self.publish_humidity)

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=float(self.values[self.index % 100])))
                self.index += 1
    '''),
    right("03a", "another module's names", '''
        import rclpy.node
        import std_msgs.msg as m

        class Feuchtesensor(rclpy.node.Node):
            """Ein Sensor für die Luftfeuchte."""

            def __init__(self):
                super().__init__("feuchtesensor")
                self.sender = self.create_publisher(m.Float32, "humidity", 5)  # Tiefe fünf
                self.takt = self.create_timer(0.5, self.sende)

            def sende(self):
                self.sender.publish(m.Float32(data=45.0))
    '''),
    right("03a", "a remapped name", '''
        class HumiditySensor(Node):
            def __init__(self):
                remap = ["--ros-args", "--remap", "moisture:=humidity"]
                super().__init__("humidity_sensor", cli_args=remap)
                self.publisher_ = self.create_publisher(Float32, "moisture", 5)
                self.timer = self.create_timer(0.5, self.publish_humidity)

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=45.0))
    '''),
    right("03a", "a callback group and a clock", '''
        from rclpy.callback_groups import MutuallyExclusiveCallbackGroup

        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                group = MutuallyExclusiveCallbackGroup()
                self.publisher_ = self.create_publisher(
                    Float32, "humidity", 5, callback_group=group
                )
                self.timer = self.create_timer(0.5, self.publish_humidity, group)

            def publish_humidity(self):
                seconds = self.get_clock().now().nanoseconds / 1e9
                self.publisher_.publish(Float32(data=45.0 + seconds % 3))
    '''),
    right("03a", "two timers that alternate", '''
        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.publisher_ = self.create_publisher(Float32, "humidity", 5)
                self.ready = False
                self.create_timer(0.25, self.measure)

            def measure(self):
                if self.ready:
                    self.publish_humidity()
                self.ready = not self.ready

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=45.0))
    '''),
    right("03a", "another publisher beside it", '''
        from std_msgs.msg import String

        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.publisher_ = self.create_publisher(Float32, "humidity", 5)
                self.state_ = self.create_publisher(String, "humidity/state", 1)
                self.timer = self.create_timer(0.5, self.publish_humidity)

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=45.0))
                self.state_.publish(String(data="ok"))
    '''),
    right("03a", "a timer that is made anew at each beat", '''
        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.publisher_ = self.create_publisher(Float32, "humidity", 5)
                self.wind_up()

            def wind_up(self):
                self.timer = self.create_timer(0.5, self.tick)

            def tick(self):
                self.destroy_timer(self.timer)
                self.publisher_.publish(Float32(data=45.0))
                self.wind_up()
    '''),
    right("03a", "serialised messages", '''
        from rclpy.serialization import serialize_message

        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.publisher_ = self.create_publisher(Float32, "humidity", 5)
                self.timer = self.create_timer(0.5, self.publish_humidity)

            def publish_humidity(self):
                self.publisher_.publish(serialize_message(Float32(data=45.0)))
    '''),
    right("03a", "a lifecycle node", '''
        from rclpy.lifecycle import LifecycleNode

        class HumiditySensor(LifecycleNode):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.publisher_ = self.create_publisher(Float32, "humidity", 5)
                self.timer = self.create_timer(0.5, self.publish_humidity)

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=45.0))
    '''),
    right("03a", "a timer on the node's clock, and one that was stopped", '''
        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.publisher_ = self.create_publisher(Float32, "humidity", 5)
                self.timer = self.create_timer(0.5, self.beat, clock=self.get_clock())
                self.create_timer(0.1, self.beat).cancel()

            def beat(self):
                self.publisher_.publish(Float32(data=45.0))
    '''),
)  # fmt: skip
