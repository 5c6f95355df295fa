"""The monitor judges every reading, the limits themselves included."""

import pytest
from sensor_simulator.temperature_subscriber import TemperatureMonitor
from std_msgs.msg import Float32


class Log:
    """Stands in for a node's logger and keeps its lines."""

    def __init__(self):
        self.lines = []

    def info(self, text):
        """Keep a line."""
        self.lines.append(text)


@pytest.mark.parametrize(
    ('reading', 'status'),
    [
        (26.0, 'Normal'),
        (26.1, 'High'),
        (20.0, 'Normal'),
        (19.9, 'Low'),
        (22.5, 'Normal'),
    ],
)
def test_each_reading_gets_one_status(ros, monkeypatch, reading, status):
    node = TemperatureMonitor()
    log = Log()
    monkeypatch.setattr(node, 'get_logger', lambda: log)
    node.temperature_callback(Float32(data=reading))
    node.destroy_node()
    assert log.lines == [f'Temperature: {reading:.2f}C - Status:{status}']


def test_it_listens_to_the_topic_of_the_sensor(ros):
    node = TemperatureMonitor()
    assert node.subscription.topic_name == '/temperature'
    assert node.get_name() == 'temperature_monitor'
    node.destroy_node()
