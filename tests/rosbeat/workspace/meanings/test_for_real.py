"""The mistakes of a build, made with the real `colcon` and `ros2`; nothing that starts a node."""

import pytest

from rosbeat.workspace import catch_up
from rosbeat.workspace.commands import run_command
from rosbeat.workspace.meanings import explain
from rosbeat.workspace.stages import PACKAGE

RUN = f"ros2 run {PACKAGE} temperature_publisher"


@pytest.mark.timeout(300)  # two builds, while other tests keep the machine busy
def test_from_one_mistake_to_the_next(root):
    assert catch_up("06").complete
    setup = root / "src" / PACKAGE / "setup.py"
    right = setup.read_text()

    def after(command):
        words = ["colcon" if command.startswith("colcon") else "ros2", *command.split()[1:]]
        code, output = run_command(words, root, 250)
        return code, explain(command, output, code, root, root)

    code, said = after(RUN)
    assert code
    assert "has not been built yet" in said

    setup.write_text(right.replace(":main',", ":main'", 1))
    code, said = after("colcon build")
    assert code
    assert "A comma is missing" in said

    setup.write_text(right.replace("publisher:main", "publishr:main", 1))
    code, said = after("colcon build --symlink-install")
    assert code == 0
    assert f"Did you mean {PACKAGE}.temperature_publisher?" in said

    code, said = after(RUN)
    assert code
    assert "Every new terminal" in said

    code, said = after("colcon biuld")
    assert code
    assert "Did you mean `build`?" in said
