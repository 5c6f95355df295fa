"""Programs with a `main`, run unchanged as simulated processes."""

import importlib
import signal
import sys
import threading
from textwrap import dedent, indent

import pytest
import rclpy

from distributions import ALREADY_SHUT_DOWN, IS_KILTED
from rosbeat import Session
from rosbeat.errors import EndlessChainError, SessionError

pytestmark = pytest.mark.ros

SENSOR = """
import sys
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32

class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.pub = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(1.0, lambda: self.pub.publish(Float32(data=22.5)))
        self.get_logger().info("Started")

def main(args=None):
    rclpy.init(args=args)
    node = Sensor()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.{ending}()
"""


@pytest.fixture
def program(tmp_path):
    """Write a program and return its path."""

    def write(text, name="program.py"):
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(dedent(text), encoding="utf-8")
        return file

    return write


def test_it_runs_with_the_session_and_ctrl_c_ends_it(ros, program):
    sensor = ros.spawn(program(SENSOR.replace("{ending}", "try_shutdown")))
    assert [node.get_name() for node in sensor.nodes] == ["sensor"]
    ros.run(3)
    assert [one.time for one in ros.messages("temperature")] == [1, 2, 3]
    assert (sensor.returncode, sensor.poll()) == (None, None)
    sensor.send_signal(signal.SIGINT)
    assert (sensor.returncode, sensor.stderr) == (0, "")
    assert ros.nodes == ()
    ros.run(2)
    assert len(ros.messages("temperature")) == 3


def test_shutdown_after_ctrl_c_is_a_second_one_in_jazzy(ros, program, capsys):
    sensor = ros.spawn(program(SENSOR.replace("{ending}", "shutdown")))
    ros.run(1)
    sensor.send_signal(signal.SIGINT)
    assert sensor.stderr in capsys.readouterr().err
    if IS_KILTED:
        assert (sensor.returncode, sensor.stderr) == (0, "")
        return
    assert sensor.returncode == 1
    assert ALREADY_SHUT_DOWN in sensor.stderr
    assert "    rclpy.shutdown()" in sensor.stderr
    assert "rosbeat" not in sensor.stderr
    (fault,) = ros.observation().faults
    assert (fault.kind, fault.code) == ("RCLError", "rclpy.shutdown()")


TWICE = """
import rclpy

def main():
    rclpy.init()
    context = rclpy.get_default_context()
    context.{first}()
    context.shutdown()
"""


@pytest.mark.parametrize("first", ["shutdown", "try_shutdown"])
def test_a_second_shutdown_is_seen(ros, program, first):
    twice = ros.spawn(program(TWICE.replace("{first}", first)))
    assert twice.returncode == 1
    assert ALREADY_SHUT_DOWN in twice.stderr


def test_sigterm_and_sigkill(ros, program):
    file = program(SENSOR.replace("{ending}", "try_shutdown"))
    first = ros.spawn(file)
    first.terminate()
    assert first.returncode == 1
    assert "ExternalShutdownException" in first.stderr
    second = ros.spawn(file)
    second.kill()
    assert (second.returncode, second.stderr, ros.nodes) == (-9, "", ())


def test_a_module_is_imported_afresh_and_leaves_nothing_behind(ros, program, capsys):
    program("number = 1", "own_constants.py")
    file = program("""
        import sys
        import own_constants
        def main():
            print(own_constants.number, sys.argv)
    """)
    before = list(sys.path), sys.argv, signal.signal
    assert ros.spawn(file, "one", "two").returncode == 0
    program("number = 20", "own_constants.py")  # another size: Python's cache goes by that
    assert ros.spawn(file).returncode == 0
    assert capsys.readouterr().out == "1 ['program', 'one', 'two']\n20 ['program']\n"
    assert (sys.path, sys.argv, signal.signal) == before
    assert not {"program", "own_constants"} & set(sys.modules)


def test_packages_installed_below_its_folder_are_those_of_the_kernel(
    ros, program, capsys, monkeypatch
):
    installed = program("number = 1", ".venv/site-packages/installed_library.py").parent
    monkeypatch.syspath_prepend(installed)
    library = importlib.import_module("installed_library")
    library.number = 2
    ros.spawn(
        program("import installed_library as lib\ndef main():\n    print(lib.number)", "a.b.py")
    )
    assert capsys.readouterr().out == "2\n"
    assert sys.modules.pop("installed_library") is library
    assert "a.b" not in sys.modules


# Measured with `python -c "import sys; sys.exit(...)"`.


def test_what_a_program_prints_and_returns(ros, program, capsys):
    assert ros.spawn(program("def main():\n    return 3")).returncode == 3
    assert ros.spawn(program("import sys\ndef main():\n    sys.exit('gone')")).returncode == 1
    assert capsys.readouterr().err == "gone\n"
    wrong = ros.spawn(program("def main():\n    return nobody"))
    assert wrong.returncode == 1
    assert wrong.stderr.endswith("NameError: name 'nobody' is not defined\n")
    broken = ros.spawn(program("def main(:"))
    assert "SyntaxError" in broken.stderr
    without = ros.spawn(program("x = 1"))
    assert "has no attribute 'main'" in without.stderr


def test_a_function_of_the_page_is_a_program_too(ros, capsys):
    def main():
        rclpy.init()
        print(rclpy.ok())
        rclpy.shutdown()
        print(rclpy.ok())

    assert ros.spawn(main).returncode == 0
    assert capsys.readouterr().out == "True\nFalse\n"
    assert rclpy.ok()  # that of the session


# Spinning in a thread, and spinning for ever.

THREADED = """
import threading, time
import rclpy
from rclpy.executors import SingleThreadedExecutor

def main():
    rclpy.init()
    node = rclpy.create_node("threaded")
    node.create_timer(0.5, lambda: node.get_logger().info("beat"))
    {rest}
"""
SPINS = {
    "rate": ("""
        threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
        rate = node.create_rate(2)
        while rclpy.ok():
            rate.sleep()
            print("tick")
    """, [0.5, 1.0, 1.5], None),
    "executor": ("""
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        thread = threading.Thread(target=lambda: executor.spin())
        thread.start()
        thread.join()
    """, [0.5, 1.0, 1.5], None),
    "once": ("""
        thread = threading.Thread(target=lambda: rclpy.spin_once(node))
        thread.start()
        time.sleep(1)
    """, [0.5], 0),
    "many": ("""
        done = threading.Event()
        node.create_timer(1.2, done.set)
        threading.Thread(target=rclpy.spin, args=(node,)).start()
        print(done.wait(1.0), done.wait(1.0), threading.current_thread().name)
        rclpy.shutdown()
    """, [0.5, 1.0], 0),
}  # fmt: skip


def real_threads():
    """The threads of this process that are no simulated ones, whose numbers are small."""
    return [thread for thread in threading.enumerate() if thread.ident > 2**16]


@pytest.mark.parametrize("name", SPINS)
def test_a_program_that_spins_in_a_thread_runs(ros, program, capsys, name):
    rest, beats, code = SPINS[name]
    before = real_threads()
    text = THREADED.replace("    {rest}", indent(dedent(rest), "    "))
    threaded = ros.spawn(program(text))
    ros.run(1.6)
    assert [line.time for line in ros.logs()] == beats
    assert threaded.returncode == code
    assert ("tick" in capsys.readouterr().out) == (name == "rate")
    assert real_threads() == before


STUBBORN = """
import signal
import rclpy
from rclpy.task import Future

presses = iter([signal.SIGINT])

def press_once():
    for number in presses:
        signal.raise_signal(number)

def main():
    rclpy.init()
    node, done = rclpy.create_node("stubborn"), Future()
    done.set_result(True)
    node.create_timer(0.5, {callback})
    while True:
        try:
            {spin}
        except KeyboardInterrupt:
            pass
"""


def spawn_and_run(ros, file):
    ros.spawn(file)
    ros.run(1)


POLLING = """
import time
import rclpy

def main():
    rclpy.init()
    node = rclpy.create_node("polling")
    node.create_timer(0.5, lambda: node.get_logger().info("beat"))
    begin = time.monotonic()
    while time.monotonic() - begin < 2.1:
        {look}
    rclpy.shutdown()
"""


@pytest.mark.parametrize("look", ["rclpy.spin_once(node, timeout_sec=0)", "pass"])
def test_a_loop_that_looks_without_waiting_lets_time_pass(ros, program, look):
    beside = ros.spawn(program(SENSOR.replace("{ending}", "shutdown"), "beside.py"))
    polling = ros.spawn(program(POLLING.replace("{look}", look)))
    ros.run(3)
    assert (polling.returncode, beside.returncode) == (0, None)
    beats = [round(line.time, 2) for line in ros.logs("polling")]
    assert beats == ([] if look == "pass" else [0.5, 1.0, 1.5, 2.0])


def test_a_program_that_spins_for_ever_and_no_time_passes(ros, program, says, monkeypatch):
    monkeypatch.setattr("rosbeat.ros.schedule.MOST_FIRINGS", 200)
    text = STUBBORN.replace("{spin}", "rclpy.spin_until_future_complete(node, done)")
    file = program(text.replace("{callback}", "bool"))
    beside = ros.spawn(program(SENSOR.replace("{ending}", "shutdown"), "beside.py"))
    with pytest.raises(EndlessChainError) as caught:
        spawn_and_run(ros, file)
    says(caught.value, "no time passed")
    ros.run(3)
    assert [node.get_name() for node in ros.nodes] == ["sensor"]
    assert beside.returncode is None


@pytest.mark.parametrize(
    "spin",
    [
        "rclpy.spin(node)",
        "press_once(); rclpy.spin(node)",
    ],
)
def test_interrupt_reaches_the_cell_whatever_a_program_catches(ros, program, spin):
    text = STUBBORN.replace("{spin}", spin)
    stubborn = program(text.replace("{callback}", "lambda: signal.raise_signal(2)"))
    for _ in range(2):
        with pytest.raises(KeyboardInterrupt):
            spawn_and_run(ros, stubborn)


def test_closing_the_session_ends_a_program_that_sleeps(program, capsys):
    file = program("""
        import time
        def main():
            try:
                time.sleep(100)
            finally:
                print("tidied")
    """)
    with Session() as ros:
        sleeper = ros.spawn(file)
        ros.run(1)
    assert capsys.readouterr().out == "tidied\n"
    assert sleeper.returncode == -9


@pytest.mark.parametrize("target", ["no_such_file.py", "no\0file.py", ".", 3, Session])
def test_what_is_no_program(ros, says, target):
    with pytest.raises(SessionError) as caught:
        ros.spawn(target)
    says(caught.value, "Python file")


def test_arguments_are_texts_and_signals_are_known(ros, says, program):
    file = program("def main():\n    import time; time.sleep(9)")
    with pytest.raises(SessionError):
        ros.spawn(file, 3)
    running = ros.spawn(file)
    with pytest.raises(SessionError) as caught:
        running.send_signal(signal.SIGHUP)
    says(caught.value, "SIGINT")


def test_a_program_that_is_started_again_replaces_the_first(ros, program):
    file = program(SENSOR.replace("{ending}", "try_shutdown"))
    first = ros.spawn(file)
    second = ros.spawn(file)
    assert (first.returncode, second.returncode) == (-9, None)
    ros.run(2)
    assert len(ros.messages("temperature")) == 2


def test_sigterm_before_init_ends_it_with_that_signal(ros, program):
    sleeper = ros.spawn(program("import time\ndef main():\n    time.sleep(100)"))
    ros.run(1)
    sleeper.terminate()
    assert (sleeper.returncode, sleeper.stderr) == (-15, "")


def test_a_program_that_catches_everything_leaves_nothing_patched(program):
    file = program("""
        import time
        def main():
            while True:
                try:
                    time.sleep(0.5)
                except BaseException:
                    pass
    """)
    before = sys.argv, signal.signal, rclpy.utilities.Context
    with Session() as ros:
        ros.spawn(file)
        ros.run(1)
    assert (sys.argv, signal.signal, rclpy.utilities.Context) == before
