"""The picture of a robot from above: its room, its way, what its scanner sees."""

import math

import pytest

from pictures import is_tidy, lines, words_in
from record_builders import at, sample
from rosbeat.errors import PictureError
from rosbeat.records import Observation
from rosbeat.viz import robot

POSE, SCAN, MAP = "/rosie/pose", "/rosie/scan", "/rosie/map"


def pose(seconds, x, y, theta=0.0, topic=POSE):
    data = {"x": x, "y": y, "theta": theta}
    return sample(seconds, data, topic, "/rosie/rover", "geometry_msgs/msg/Pose2D")


def scan(*ranges):
    data = {
        "angle_min": 0.0, "angle_increment": math.pi / 2,
        "range_min": 0.05, "range_max": 5.0, "ranges": list(ranges),
    }  # fmt: skip
    return sample(1, data, SCAN, "/rosie/rover", "sensor_msgs/msg/LaserScan")


def room(*cells, width):
    info = {
        "width": width, "height": len(cells) // width, "resolution": 1.0,
        "origin": {"position": {"x": 0.0, "y": 0.0}},
    }  # fmt: skip
    data = {"info": info, "data": list(cells)}
    return sample(0, data, MAP, "/rosie/rover", "nav_msgs/msg/OccupancyGrid")


def seen(*samples):
    return Observation(at(100), 0, samples=samples)


def test_a_drive_is_measured_and_its_seconds_are_marked():
    places = [pose(k / 10, 1.0 + k / 20, 1.0, math.pi / 2) for k in range(41)]
    picture = robot(seen(*places))
    assert picture.description == (
        "Rosie from above. In 4 s Rosie drove 2.0 m, from (1.0, 1.0) to (3.0, 1.0), and looks "
        "along 90 degrees now."
    )
    assert "its way, with a mark every second" in words_in(picture)
    assert len(lines(picture, "o")) == 5
    assert is_tidy(picture)


def test_a_long_drive_has_a_mark_every_ten_seconds():
    picture = robot(seen(*(pose(k, k / 100, 1.0) for k in range(61))))
    assert "its way, with a mark every 10 seconds" in words_in(picture)
    assert len(lines(picture, "o")) == 7


def test_a_robot_that_stands_still_has_no_way():
    picture = robot(seen(pose(0, 1, 1, -math.pi / 2), pose(5, 1, 1, -math.pi / 2)))
    assert picture.description == (
        "Rosie from above. Rosie stands at (1.0, 1.0), looks along 270 degrees, and has not moved."
    )
    assert words_in(picture) == []


def test_what_the_scanner_does_not_see_is_not_drawn():
    picture = robot(seen(pose(0, 2, 2), scan(1.0, 5.0, math.inf, 0.01)))
    assert picture.description.endswith("The scanner sees 1 point; the nearest is 1.0 m away.")
    assert len(lines(picture, "x")) == 1 + 1  # and the key


def test_a_room_is_drawn_from_its_map():
    picture = robot(seen(room(0, 0, 100, 0, 100, 100, width=3), pose(0, 0.5, 0.5)))
    assert picture.description.startswith("Rosie from above, in a room 3 m wide and 2 m deep.")
    rectangles = [one for one in picture.figure.axes[0].patches if hasattr(one, "get_xy")]
    # The floor, one run in each row, and the robot's nose.
    assert len([one for one in rectangles if hasattr(one, "get_width")]) == 1 + 2
    assert "walls and beds" in words_in(picture)


def test_another_robot_is_chosen_by_name():
    picture = robot(seen(pose(0, 1, 1), pose(0, 3, 3, topic="/mole/pose")), "/mole")
    assert picture.description.startswith("Mole from above. Mole stands at (3.0, 3.0)")


@pytest.mark.parametrize(
    "samples",
    [(), (sample(0, 5.0, POSE),), (pose(0, 1, 1, topic="/other/pose"),)],
    ids=["nothing", "of another type", "of another robot"],
)
def test_without_a_pose_there_is_no_picture(samples):
    with pytest.raises(PictureError, match=r"Nothing was published on /rosie/pose"):
        robot(seen(*samples))
