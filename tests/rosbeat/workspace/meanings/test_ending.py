import pytest

RUN = "ros2 run sensor_simulator temperature_publisher"
TWICE = """^CTraceback (most recent call last):
  File "/home/you/x.py", line 40, in main
    rclpy.shutdown()
rclpy._rclpy_pybind11.RCLError: failed to shutdown: rcl_shutdown already called on the given context
[ros2run]: Process exited with failure 1
"""
EXTERNAL = """Traceback (most recent call last):
    raise ExternalShutdownException()
rclpy.executors.ExternalShutdownException
"""
INTERRUPT = "^CTraceback (most recent call last):\nKeyboardInterrupt\n[ros2run]: Interrupt\n"


def test_shutdown_after_ctrl_c(meaning):
    assert "try_shutdown" in meaning(RUN, TWICE)


def test_an_end_that_is_not_expected(meaning):
    assert "ExternalShutdownException" in meaning(RUN, EXTERNAL)
    assert meaning(RUN, INTERRUPT, 254).startswith("Ctrl+C")


def test_a_clean_end(meaning):
    assert meaning(RUN, "[INFO] [temperature_sensor]: Publishing: 22.00C\n^C\n", 0) is None


def test_the_word_in_a_log_line_is_no_traceback(meaning):
    assert meaning(RUN, "[INFO] [a]: waiting for KeyboardInterrupt\n", 0) is None


@pytest.mark.parametrize("output", [TWICE, EXTERNAL, INTERRUPT])
def test_the_end_of_another_program_is_not_this_one_s(meaning, output):
    assert meaning("cat log.txt", output, 0) is None
    assert meaning("cat log.txt; false", output, 1) is None
    assert meaning("python3 show.py", output, 0) is None


def test_ctrl_c_on_a_script_without_ros(meaning):
    output = """^CTraceback (most recent call last):
  File "/home/you/wait.py", line 2, in <module>
    time.sleep(30)
KeyboardInterrupt
"""
    assert meaning("python3 wait.py", output, 130) is None
    node = output.replace("time.sleep(30)", "rclpy.spin(node)")
    assert meaning("python3 wait.py", node, 130).startswith("Ctrl+C ended the node")
