"""00a, read the weather: right answers, in many styles."""

from bank.answer import right

ANSWERS = (
    right("00a", "a variable for the topic", '''
        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                topic = "weather"
                self.create_subscription(String, topic, self.read, 10)

            def read(self, msg):
                self.get_logger().info(f"I read: {msg.data}")
    '''),
    right("00a", "the absolute name, kept in an attribute", '''
        class Leserin(Node):
            """Liest das Wetter."""

            def __init__(self):
                super().__init__("leserin")
                # Der Schrägstrich gehört zum vollen Namen.
                self.abo = self.create_subscription(String, "/weather", self.lies, 10)

            def lies(self, nachricht):
                self.get_logger().info(f"Gelesen: {nachricht.data}")
    '''),
    right("00a", "a local function", '''
        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")

                def read(msg):
                    self.get_logger().info("I read: " + msg.data)

                self.create_subscription(String, "weather", read, 10)
    '''),
    right("00a", "a lambda", '''
        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.create_subscription(
                    String, "weather", lambda msg: self.get_logger().info(msg.data), 10
                )
    '''),
    right("00a", "a partial, and keywords", '''
        from functools import partial

        class WeatherReader(Node):
            def __init__(self):
                super().__init__(node_name="weather_reader")
                self.create_subscription(
                    msg_type=String,
                    topic="weather",
                    callback=partial(self.read, "weather"),
                    qos_profile=10,
                )

            def read(self, topic, msg):
                self.get_logger().info(f"{topic}: {msg.data}")
    '''),
    right("00a", "a class attribute and a profile", '''
        from rclpy.qos import QoSProfile, ReliabilityPolicy

        class WeatherReader(Node):
            TOPIC: str = "weather"
            QOS = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)

            def __init__(self) -> None:
                super().__init__("weather_reader")
                self._sub = self.create_subscription(String, self.TOPIC, self._read, self.QOS)

            def _read(self, msg: String) -> None:
                self.get_logger().info(f"I read: {msg.data}")
    '''),
    right("00a", "the profile for sensor data", '''
        from rclpy.qos import qos_profile_sensor_data

        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.create_subscription(String, "weather", self.read, qos_profile_sensor_data)

            def read(self, msg):
                print(msg.data)
    '''),
    right("00a", "an async callback", '''
        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.create_subscription(String, "weather", self.read, 10)

            async def read(self, msg):
                self.get_logger().info(f"I read: {msg.data}")
    '''),
    right("00a", "a parameter", '''
        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.declare_parameter("topic", "weather")
                topic = self.get_parameter("topic").get_parameter_value().string_value
                self.create_subscription(String, topic, self.read, 10)

            def read(self, msg):
                self.get_logger().info(f"I read: {msg.data}")
    '''),
    right("00a", "remapped on the command line", '''
        class WeatherReader(Node):
            def __init__(self):
                arguments = ["--ros-args", "-r", "news:=weather"]
                super().__init__("weather_reader", cli_args=arguments)
                self.create_subscription(String, "news", self.read, 10)

            def read(self, msg):
                self.get_logger().info(f"I read: {msg.data}")
    '''),
    right("00a", "a namespace, and the absolute name", '''
        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader", namespace="newsroom")
                self.create_subscription(String, "/weather", self.read, 10)

            def read(self, msg):
                self.get_logger().info(f"I read: {msg.data}")
    '''),
    right("00a", "a factory", '''
        class Reader(Node):
            def __init__(self, name, topic):
                super().__init__(name)
                self.subscription = self.create_subscription(String, topic, self.read, 10)

            def read(self, msg):
                self.get_logger().info(f"I read: {msg.data}")

        def weather_reader():
            return Reader("ben", "weather")
    '''),
    right("00a", "inheritance, a mixin, and a callback group", '''
        from rclpy.callback_groups import ReentrantCallbackGroup

        class Reads:
            def read(self, msg):
                self.get_logger().get_child("desk").info(f"I read: {msg.data}")

        class Reader(Reads, Node):
            def __init__(self, name, topic):
                super().__init__(name)
                group = ReentrantCallbackGroup()
                self.create_subscription(String, topic, self.read, 10, callback_group=group)

        class WeatherReader(Reader):
            def __init__(self):
                super().__init__("weather_reader", "weather")
    '''),
    right("00a", "composition", '''
        class Ear:
            def __init__(self, node, topic):
                self.heard = []
                self.subscription = node.create_subscription(String, topic, self.hear, 10)

            def hear(self, msg):
                self.heard.append(msg.data)

        class WeatherReader(Node):
            def __init__(self):
                Node.__init__(self, "weather_reader")
                self.ear = Ear(self, "weather")
    '''),
    right("00a", "other imports, and information about the message", '''
        import std_msgs.msg as m
        from rclpy.node import Node as N

        class WeatherReader(N):
            def __init__(self):
                super().__init__("weather_reader")
                self.create_subscription(m.String, "weather", self.read, 10)

            def read(self, msg, info):
                self.get_logger().info(f"I read: {msg.data}", throttle_duration_sec=0.5)
    '''),
    right("00a", "an object that can be called, and a default", '''
        class Printer:
            def __call__(self, msg, prefix="I read"):
                print(prefix, msg.data)

        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.create_subscription(String, "weather", Printer(), 10)
    '''),
    right("00a", "a static method", '''
        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.create_subscription(String, "weather", self.read, 10)

            @staticmethod
            def read(msg):
                print(msg.data)
    '''),
    right("00a", "any number of arguments", '''
        class WeatherReader(Node):
            def __init__(self, **kwargs):
                super().__init__("weather_reader", **kwargs)
                self.create_subscription(String, "weather", self.read, 10)

            def read(self, *args):
                self.get_logger().info(f"I read: {args[0].data}")
    '''),
    right("00a", "it reads and reports", '''
        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.digest = self.create_publisher(String, "digest", 10)
                self.create_subscription(String, "weather", self.read, 10)
                self.create_timer(2.0, lambda: self.get_logger().info("still here"))

            def read(self, msg):
                self.digest.publish(String(data=msg.data.upper()))
    '''),
)  # fmt: skip
