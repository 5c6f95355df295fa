import pytest

RUN = "ros2 run sensor_simulator temperature_publisher"


@pytest.mark.parametrize(
    ("last", "text"),
    [
        ("AssertionError: The 'data' field must be of type 'float'", "a float"),
        ("TypeError: Expected <class 'std_msgs.msg._float32.Float32'>, got <class 'float'>",
         "a bare value, a float"),
        ("TypeError: Expected <class 'std_msgs.msg._float32.Float32'>, got "
         "<class 'std_msgs.msg._float32.Metaclass_Float32'>", "the class Float32 itself"),
        ("AttributeError: 'Float32' object has no attribute 'value'", "value"),
        ("TypeError: Node.create_publisher() missing 1 required positional argument: "
         "'qos_profile'", "queue depth"),
        ("TypeError: rclpy_resolve_name(): incompatible function arguments. The ...", "order"),
        ("AttributeError: type object 'type' has no attribute '_TYPE_SUPPORT' This might be a "
         "ROS 1 message type", "place of the message type"),
        ("RuntimeError: Subscription.__init__(): callback should be either be callable with one "
         "argument", "A callback takes self and the message"),
        ("AttributeError: 'TemperatureSensor' object has no attribute '_default_callback_group'",
         "super().__init__ has not been called"),
        ("TypeError: Node.__init__() missing 1 required positional argument: 'node_name'", "name"),
        ("rclpy.exceptions.InvalidNodeNameException: Invalid node name: ...", "digits"),
        ("rclpy.exceptions.NotInitializedException: ('rclpy.init() has not been called', ...)",
         "first node"),
        ("RuntimeError: Context.init() must only be called once", "twice"),
        ("NameError: name 'TemperaturSensor' is not defined. Did you mean: 'TemperatureSensor'?",
         "does not know the name TemperaturSensor"),
    ],
)  # fmt: skip
def test_the_texts_of_rclpy(meaning, last, text):
    output = f"Traceback (most recent call last):\n  File x\n{last}\n[ros2run]: Process exited\n"
    assert text in meaning(RUN, output)


def test_init_in_a_with_statement(meaning):
    last = "TypeError: 'NoneType' object does not support the context manager protocol"
    frame = '  File "/home/you/src/a.py", line 3, in main\n    with {}:\n'
    output = f"Traceback (most recent call last):\n{frame}{last}\n"
    assert "nothing to work with" in meaning(RUN, output.format("rclpy.init(args=args)"))
    assert meaning(RUN, output.format("self.lock")) is None


def test_the_line_tells_which_argument_is_missing(meaning):
    last = "TypeError: Node.create_subscription() missing 1 required positional argument: " \
        "'qos_profile'"  # fmt: skip
    frame = '  File "/home/you/src/a.py", line 3, in __init__\n    self.create_subscription({})\n'
    output = f"Traceback (most recent call last):\n{frame}{last}\n"
    assert "for the callback" in meaning(RUN, output.format("Float32, 'temperature', 10"))
    assert "queue depth" in meaning(RUN, output.format("Float32, 'temperature', self.listen"))


def test_the_wrong_python(meaning):
    output = "Traceback (most recent call last):\nModuleNotFoundError: No module named 'rclpy'\n"
    assert "which python3" in meaning("python3 a.py", output)


@pytest.mark.parametrize(
    "last", ["ValueError: invalid literal", "TypeError: 'NoneType' object is not iterable", ""]
)
def test_others_are_left_alone(meaning, last):
    assert meaning(RUN, f"Traceback (most recent call last):\n{last}\n") is None


def test_without_a_traceback_nothing_is_meant(meaning):
    assert meaning(RUN, "[INFO] [a]: NameError: name 'x' is not defined\n", 0) is None


def test_of_a_script_without_ros_nothing_is_said_about_ros(meaning):
    last = "TypeError: create_view() missing 1 required positional argument: 'qos_profile'"
    output = f"Traceback (most recent call last):\n  File x\n{last}\n"
    assert meaning("python3 a.py", output) is None
    assert meaning("python3 a.py", output.replace("File x", "rclpy.spin(node)"))
    last = "NameError: name 'x' is not defined"
    assert "does not know the name x" in meaning("./a.py", output.splitlines()[0] + f"\n{last}\n")


def test_a_traceback_that_is_only_read(meaning):
    output = "Traceback (most recent call last):\nNameError: name 'x' is not defined\n"
    assert meaning("cat log.txt", output, 0) is None
    output = "Traceback (most recent call last):\nModuleNotFoundError: No module named 'rclpy'\n"
    assert meaning("cat log.txt", output, 0) is None
