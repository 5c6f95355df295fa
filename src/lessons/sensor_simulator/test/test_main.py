"""Two processes talk, and both end in good order when they are asked to."""

import signal
import subprocess
import sys
import time

import pytest


class Program:
    """A module of the package, running in a process of its own."""

    def __init__(self, module, folder):
        self.said = folder / module
        with self.said.open('w') as output:
            self.process = subprocess.Popen(
                [sys.executable, '-m', f'sensor_simulator.{module}'],
                stdout=output,
                stderr=subprocess.STDOUT,
            )

    def wait_for(self, text, seconds=30):
        """Wait until it has said something."""
        deadline = time.monotonic() + seconds
        while text not in self.said.read_text():
            assert time.monotonic() < deadline, self.said.read_text()
            time.sleep(0.02)


@pytest.fixture
def system(tmp_path):
    """Start the monitor and the sensor, and end what is left of them."""
    modules = ('temperature_subscriber', 'temperature_publisher')
    programs = [Program(module, tmp_path) for module in modules]
    yield programs
    for program in programs:
        program.process.kill()
        program.process.wait()


@pytest.mark.parametrize('request_to_end', [signal.SIGINT, signal.SIGTERM])
def test_readings_cross_and_both_end_with_0(system, request_to_end):
    monitor, sensor = system
    sensor.wait_for('Publishing: ')
    monitor.wait_for('Status:')
    for program in system:
        program.process.send_signal(request_to_end)
        code = program.process.wait(timeout=30)
        assert code == 0, program.said.read_text()
        assert 'Traceback' not in program.said.read_text()
