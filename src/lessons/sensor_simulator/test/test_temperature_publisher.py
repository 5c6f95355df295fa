"""The sensor publishes a random walk that stays within its limits."""

import random

from sensor_simulator.temperature_publisher import TemperatureSensor


def published(node, count):
    """Let the timer's callback run and return what was published."""
    values = []
    node.publisher_.publish = lambda msg: values.append(msg.data)
    for _ in range(count):
        node.publish_temperature()
    return values


def test_it_starts_at_room_temperature_and_takes_small_steps(ros):
    random.seed(1)
    node = TemperatureSensor()
    values = [22.0, *published(node, 100)]
    node.destroy_node()
    assert all(abs(b - a) <= 0.5 + 1e-6 for a, b in zip(values, values[1:]))
    assert len(set(values)) > 50


def test_it_stays_within_its_limits(ros, monkeypatch):
    node = TemperatureSensor()
    monkeypatch.setattr(random, 'uniform', lambda low, high: high)
    assert max(published(node, 50)) == 28.0
    monkeypatch.setattr(random, 'uniform', lambda low, high: low)
    assert min(published(node, 50)) >= 10.1
    node.destroy_node()


def test_it_has_one_publisher_and_one_timer_of_a_second(ros):
    node = TemperatureSensor()
    assert node.publisher_.topic_name == '/temperature'
    assert node.timer.timer_period_ns == 1_000_000_000
    assert node.get_name() == 'temperature_sensor'
    node.destroy_node()
