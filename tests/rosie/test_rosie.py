"""Rosie drives, answers and reports as her README says: plain rclpy nodes, in virtual time."""

import math

import pytest
from geometry_msgs.msg import Twist
from nav_msgs.msg import OccupancyGrid
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosie.computer_thermometer import ComputerThermometer
from rosie.rover import Rover
from rosie.thermometer import Thermometer
from std_srvs.srv import Empty, SetBool, Trigger
from test_msgs.action import Fibonacci

from rosbeat import Session
from rosie import greenhouse

pytestmark = pytest.mark.ros


@pytest.fixture
def ros():
    with Session() as session:
        yield session


@pytest.fixture
def rover(ros):
    return ros.add(Rover)


@pytest.fixture
def driver(ros):
    return ros.add(lambda: Node("driver"))


def drive(ros, driver, ahead=0.0, turn=0.0, seconds=1.0):
    """Send a command twice a second for so many seconds."""
    publisher = driver.create_publisher(Twist, "/rosie/cmd_vel", 10)
    command = Twist()
    command.linear.x, command.angular.z = float(ahead), float(turn)
    for _ in range(round(seconds * 2)):
        publisher.publish(command)
        ros.run(seconds=0.5, quiet=True)


def call(ros, driver, kind, name, request=None):
    future = driver.create_client(kind, name).call_async(request or kind.Request())
    ros.run(seconds=0.5, quiet=True)
    return future.result()


def warnings_of(ros):
    return [record.text for record in ros.logs("/rosie/rover") if record.level == "WARN"]


def test_a_command_holds_for_a_second(ros, rover, driver):
    publisher = driver.create_publisher(Twist, "/rosie/cmd_vel", 10)
    command = Twist()
    command.linear.x = 0.4
    ros.run(seconds=0.05)
    publisher.publish(command)
    ros.run(seconds=5)
    assert rover.pose.x == pytest.approx(0.5 + 0.4, abs=0.05)
    assert rover.pose.y == 0.7


def test_she_is_never_faster_than_her_limit(ros, rover, driver):
    drive(ros, driver, ahead=9.0, seconds=2)
    assert rover.pose.x == pytest.approx(0.5 + 2 * 0.5, abs=0.06)
    drive(ros, driver, ahead=math.nan, turn=math.nan, seconds=2)
    assert all(map(math.isfinite, rover.pose))
    (result,) = rover.set_parameters([Parameter("speed_limit", value=7.0)])
    assert not result.successful


def test_a_turn_while_driving_is_a_circle(ros, rover, driver):
    drive(ros, driver, ahead=0.2, turn=1.0, seconds=round(math.tau * 2) / 2)
    ros.run(seconds=2)
    points = [(m.data["x"], m.data["y"]) for m in ros.messages("/rosie/pose")]
    assert max(y for _, y in points) == pytest.approx(0.7 + 2 * 0.2, abs=0.01)


def test_a_wall_stops_her_and_she_says_so_once(ros, rover, driver):
    drive(ros, driver, ahead=-0.5, seconds=3)
    assert greenhouse.is_free(*rover.pose[:2], 0.17)
    assert len(warnings_of(ros)) == 1
    drive(ros, driver, ahead=0.5, seconds=1)
    assert rover.pose.x > 0.5
    drive(ros, driver, ahead=-0.5, seconds=3)
    assert len(warnings_of(ros)) == 2


def test_services(ros, rover, driver):
    answer = call(ros, driver, Trigger, "/rosie/step")
    assert (answer.success, answer.message) == (True, "now at (0.75, 0.70)")
    drive(ros, driver, turn=math.pi / 2, seconds=1)
    assert call(ros, driver, Empty, "/rosie/reset") is not None
    assert rover.pose == greenhouse.START
    rover.pose = greenhouse.Pose(0.2, 0.7, math.pi)
    assert call(ros, driver, Trigger, "/rosie/step").message == "something is in the way"
    answer = call(ros, driver, SetBool, "/rosie/set_lamp", SetBool.Request(data=True))
    assert answer.message == "the lamp is on"
    assert [m.data["data"] for m in ros.messages("/rosie/lamp")] == [False, True]


def test_whoever_joins_late_gets_the_map(ros, rover, driver):
    ros.run(seconds=30)
    heard = []
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    driver.create_subscription(OccupancyGrid, "/rosie/map", heard.append, latched)
    ros.run(seconds=1)
    (grid,) = heard
    assert grid.info.width * grid.info.height == len(grid.data)


def test_the_scan_begins_straight_ahead_and_turns_with_her(ros, rover, driver):
    rover.pose = greenhouse.Pose(3.0, 0.7, math.pi / 2)
    ros.run(seconds=1)
    ranges = ros.messages("/rosie/scan")[-1].data["ranges"]
    assert ranges[0] == pytest.approx(0.7, abs=0.001)  # the bed
    assert ranges[36] == pytest.approx(0.7, abs=0.001)  # the wall behind
    assert ranges[18] == pytest.approx(3.0, abs=0.001)  # to her left, which is west


def test_a_tour_of_all_beds(ros, rover, driver):
    feedback, client = [], ActionClient(driver, Fibonacci, "/rosie/visit_beds")
    accepted = client.send_goal_async(
        Fibonacci.Goal(order=6), lambda told: feedback.append(list(told.feedback.sequence))
    )
    ros.run(seconds=2)
    result = accepted.result().get_result_async()
    ros.run(seconds=60)
    expected = [round(greenhouse.temperature(*stop)) for stop in greenhouse.STOPS]
    assert list(result.result().result.sequence) == expected
    assert feedback == [expected[:count] for count in range(1, 7)]
    assert rover.pose[:2] == pytest.approx(greenhouse.STOPS[-1], abs=0.02)
    assert warnings_of(ros) == []


@pytest.mark.parametrize("order", [0, 7, -1])
def test_a_tour_that_makes_no_sense_is_refused(ros, rover, driver, order):
    client = ActionClient(driver, Fibonacci, "/rosie/visit_beds")
    accepted = client.send_goal_async(Fibonacci.Goal(order=order))
    ros.run(seconds=1)
    assert not accepted.result().accepted
    assert len(warnings_of(ros)) == 1


def felt(ros, folder):
    """What the computer's thermometer logs first, and its readings in three seconds."""
    ros.add(ComputerThermometer, parameters={"folder": str(folder)})
    ros.run(seconds=3)
    readings = [m.data["data"] for m in ros.messages("/rosie/computer_temperature")]
    return ros.logs()[0].text, readings


def sensor(folder, number, kind, temperature):
    zone = folder / f"thermal_zone{number}"
    zone.mkdir()
    (zone / "type").write_text(f"{kind}\n")
    (zone / "temp").write_text(f"{temperature}\n")


def test_the_computers_own_sensor_is_read_and_named(ros, tmp_path):
    sensor(tmp_path, 0, "acpitz", 27800)
    sensor(tmp_path, 1, "x86_pkg_temp", 48500)
    said, readings = felt(ros, tmp_path)
    assert said == f"Reading a real sensor: x86_pkg_temp, {tmp_path / 'thermal_zone1'}"
    assert readings == [48.5] * 3


def test_any_sensor_is_better_than_none(ros, tmp_path):
    sensor(tmp_path, 0, "cpu", "broken")
    sensor(tmp_path, 1, "acpitz", 27800)
    said, readings = felt(ros, tmp_path)
    assert "Reading a real sensor: acpitz" in said
    assert readings == pytest.approx([27.8] * 3)


def test_a_reading_that_fails_is_left_out(ros, tmp_path):
    sensor(tmp_path, 0, "cpu", 40000)
    felt(ros, tmp_path)
    (tmp_path / "thermal_zone0" / "temp").unlink()
    ros.run(seconds=2)
    assert len(ros.messages("/rosie/computer_temperature")) == 3
    assert [one.level for one in ros.logs()][-2:] == ["WARN", "WARN"]
    (tmp_path / "thermal_zone0" / "temp").write_text("41000")
    ros.run(seconds=1)
    assert ros.messages("/rosie/computer_temperature")[-1].value == 41.0


def test_without_a_sensor_it_says_that_it_simulates_one(ros, tmp_path, monkeypatch):
    monkeypatch.setattr("os.getloadavg", lambda: (0.0, 0.0, 0.0))
    said, idle = felt(ros, tmp_path)
    assert said.startswith(f"Simulating: there is no sensor in {tmp_path}")
    monkeypatch.setattr("os.getloadavg", lambda: (1000.0, 0.0, 0.0))
    ros.run(seconds=3)
    busy = [m.value for m in ros.messages("/rosie/computer_temperature")][3:]
    assert max(idle) < 45 < 65 < min(busy)


@pytest.mark.parametrize(
    ("disturb", "status"),
    [
        (lambda goal, ros, driver: goal.cancel_goal_async(), 5),
        (lambda goal, ros, driver: drive(ros, driver, ahead=0.1, seconds=0.5), 6),
        (lambda goal, ros, driver: call(ros, driver, Empty, "/rosie/reset"), 6),
    ],
    ids=["canceled", "driven by hand", "reset"],
)
def test_a_tour_can_be_ended(ros, rover, driver, disturb, status):
    client = ActionClient(driver, Fibonacci, "/rosie/visit_beds")
    accepted = client.send_goal_async(Fibonacci.Goal(order=6))
    ros.run(seconds=5)
    result = accepted.result().get_result_async()
    disturb(accepted.result(), ros, driver)
    ros.run(seconds=3)
    assert result.result().status == status
    assert list(result.result().result.sequence) == [17]
    again = client.send_goal_async(Fibonacci.Goal(order=1))
    ros.run(seconds=1)
    assert again.result().accepted


def test_the_thermometer_feels_where_she_is(ros, rover):
    thermometer = ros.add(Thermometer)
    ros.run(seconds=3)
    cold = [m.data["data"] for m in ros.messages("/rosie/temperature")]
    rover.pose = greenhouse.Pose(5.4, 3.6, 0.0)
    ros.run(seconds=3)
    warm = [m.data["data"] for m in ros.messages("/rosie/temperature")][-2:]
    assert max(cold) < 20.0
    assert min(warm) > 26.0
    thermometer.set_parameters([Parameter("period", value=0.5)])
    count = len(ros.messages("/rosie/temperature"))
    ros.run(seconds=5)
    assert len(ros.messages("/rosie/temperature")) == count + 10
