"""00b, report on sports: right answers, in many styles."""

from bank.answer import right

ANSWERS = (
    right("00b", "a message made in two steps", '''
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "/sports", 10)
                self.timer = self.create_timer(2, self.write)

            def write(self):
                msg = String()
                msg.data = "What a match"
                self.publisher.publish(msg)
    '''),
    right("00b", "local functions", '''
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                publisher = self.create_publisher(String, "sports", 10)

                def write():
                    publisher.publish(String(data="What a match"))

                self.create_timer(2.0, write)
    '''),
    right("00b", "a lambda", '''
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                out = self.create_publisher(String, "sports", 1)
                self.create_timer(2.0, lambda: out.publish(String(data="Goal")))
    '''),
    right("00b", "a partial", '''
        import functools

        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                publisher = self.create_publisher(String, "sports", 10)
                article = String(data="What a match")
                self.timer = self.create_timer(2.0, functools.partial(publisher.publish, article))
    '''),
    right("00b", "class attributes and keywords", '''
        class SportsReporter(Node):
            topic = "sports"
            period = 2.0

            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(
                    msg_type=String, topic=self.topic, qos_profile=10
                )
                self.timer = self.create_timer(timer_period_sec=self.period, callback=self.write)

            def write(self):
                self.publisher.publish(String(data="What a match"))
    '''),
    right("00b", "a parameter for the period", '''
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                period = self.declare_parameter("period", 2.0).value
                self.publisher = self.create_publisher(String, "sports", 10)
                self.timer = self.create_timer(period, self.write)

            def write(self):
                self.publisher.publish(String(data="What a match"))
    '''),
    right("00b", "a duration", '''
        from rclpy.duration import Duration

        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                period = Duration(seconds=2)
                self.timer = self.create_timer(period.nanoseconds / 1e9, self.write)

            def write(self):
                self.publisher.publish(String(data="What a match"))
    '''),
    right("00b", "an async callback", '''
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.timer = self.create_timer(2.0, self.write)

            async def write(self):
                self.publisher.publish(String(data="What a match"))
    '''),
    right("00b", "a faster beat, every fourth one counts", '''
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.timer = self.create_timer(0.5, self.beat)
                self.beats = 0

            def beat(self):
                self.beats += 1
                if self.beats % 4:
                    return
                self.publisher.publish(String(data=f"Goal {self.beats // 4}"))
    '''),
    right("00b", "a reporter with arguments, and a factory", '''
        class Reporter(Node):
            def __init__(self, topic, article, period):
                super().__init__(f"{topic}_reporter")
                self.article = article
                self.publisher = self.create_publisher(String, topic, 10)
                self.timer = self.create_timer(period, self.write)

            def write(self):
                self.publisher.publish(String(data=self.article))
    ''', handed='lambda: Reporter("sports", "What a match", 2.0)'),
    right("00b", "a namespace, and composition", '''
        class Desk:
            """Owns the publisher."""

            def __init__(self, node: Node) -> None:
                self._out = node.create_publisher(String, "sports", 10)

            def send(self, text: str) -> None:
                self._out.publish(String(data=text))

        class SportsReporter(Node):
            def __init__(self) -> None:
                super().__init__("sports_reporter", namespace="/")
                self.desk = Desk(self)
                self.timer = self.create_timer(2.0, lambda: self.desk.send("What a match"))
    '''),
    right("00b", "it subscribes to itself, too", '''
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.create_subscription(String, "sports", self.reread, 10)
                self.timer = self.create_timer(2.0, self.write)

            def write(self):
                self.publisher.publish(String(data="What a match"))

            def reread(self, msg):
                self.get_logger().info(f"I wrote: {msg.data}")
    '''),
    right("00b", "a period as a text, which rclpy takes", '''
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.timer = self.create_timer("2.0", self.write)

            def write(self):
                self.publisher.publish(String(data="What a match"))
    '''),
    right("00b", "the rate as a fraction, and a decorated callback", '''
        from functools import wraps

        def logged(method):
            @wraps(method)
            def call(self):
                self.get_logger().debug(method.__name__)
                return method(self)
            return call

        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.timer = self.create_timer(1 / 0.5, self.write)

            @logged
            def write(self):
                self.publisher.publish(String(data="What a match"))
    '''),
)  # fmt: skip
