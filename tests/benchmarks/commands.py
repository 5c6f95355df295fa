"""The `ros2` command and `colcon build`: whole processes, against a bare `import rclpy`."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from importlib.util import find_spec
from pathlib import Path
from statistics import median

from measuring import Row
from processes import Cost, at_95_percent, cost, seconds_in_imports, shown

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "ros2_command"))

from as_typed import Ros2, own_graph  # noqa: E402

NODES = (("n1", "t1", 0.01), ("n2", "t2", 1.0), ("n3", "t3", 1.0), ("n4", "t4", 1.0))
TOPICS = {f"/{topic}" for _, topic, _ in NODES} | {f"/{name}/in" for name, _, _ in NODES}
CREATE = (
    *("pkg", "create", "--build-type", "ament_python", "sensor_simulator"),
    *("--dependencies", "rclpy", "std_msgs"),
)
#: What is asked of four nodes, whether an answer is right, and the target: of the median, or
#: where a learner waits for another node, of 95 calls in 100.
QUESTIONS: tuple[tuple[tuple[str, ...], Callable[[str], bool], str, float], ...] = (
    (("node", "list"), lambda out: out == "/n1\n/n2\n/n3\n/n4\n", "median", 0.7),
    (("topic", "list"), lambda out: set(out.split()) >= TOPICS, "median", 0.7),
    (("topic", "echo", "--once", "/t1"), lambda out: out == "data: 25.5\n---\n", "95 %", 1.0),
    (("param", "get", "/n2", "rate"), lambda out: out == "Integer value is: 3\n", "95 %", 1.0),
    (("service", "call", "/n3/enable", "std_srvs/srv/SetBool", "{data: true}"),
     lambda out: "success=True" in out, "95 %", 1.0),
)  # fmt: skip
BARE = [sys.executable, "-c", "import rclpy, rclpy.node"]


def measure(quick: bool) -> list[Row]:
    """All of it, in an empty folder and a domain of its own."""
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        ros2 = stack.enter_context(own_graph(*NODES))
        bare = [cost(BARE, ros2.environment, folder) for _ in range(5 if quick else 20)]
        limit = median(one.wall for one in bare)
        imports = seconds_in_imports(BARE, ros2.environment, folder)
        rows = [Row("python -c 'import rclpy'", shown(bare, imports))]
        for question in QUESTIONS:
            rows.append(_ask(ros2, folder, question, 10 if quick else 100, limit))
        rows.append(_create(ros2, folder, 3 if quick else 10, limit))
        rows += _run(ros2, folder, 3 if quick else 20)
        rows += _build(ros2.environment, folder, 1 if quick else 5, limit)
    return rows


def _ask(
    ros2: Ros2, folder: Path, question: tuple[tuple[str, ...], Callable[[str], bool], str, float],
    count: int, limit: float,
) -> Row:  # fmt: skip
    words, is_right, which, target = question
    line = ros2.words(*words)
    costs = [cost(line, ros2.environment, folder) for _ in range(count)]
    right = sum(is_right(one.out) for one in costs)
    walls = [one.wall for one in costs]
    value = median(walls) if which == "median" else at_95_percent(walls)
    imports = seconds_in_imports(line, ros2.environment, folder)
    text = f"{shown(costs, imports)}, 95 % {at_95_percent(walls):.2f}, right {right}/{count}"
    ratio = f"{median(walls) / limit:.1f} x import"
    met = value < target and right == count
    return Row(f"ros2 {' '.join(words[:3])}", text, ratio, f"{which} < {target:g} s", met)


def _create(ros2: Ros2, folder: Path, count: int, limit: float) -> Row:
    costs = []
    for _ in range(count):
        shutil.rmtree(folder / "sensor_simulator", ignore_errors=True)
        costs.append(cost(ros2.words(*CREATE), ros2.environment, folder))
        assert costs[-1].code == 0, costs[-1].error
    shutil.rmtree(folder / "sensor_simulator")
    imports = seconds_in_imports(ros2.words(*CREATE), ros2.environment, folder)
    ratio = median(one.wall for one in costs) / limit
    return Row("ros2 pkg create", shown(costs, imports), f"{ratio:.1f} x import")


def _run(ros2: Ros2, folder: Path, count: int) -> list[Row]:
    """Until a node's first message, through `ros2 run` and without it, in turns."""
    program = offer(folder / "offered")
    environ = ros2.environment | {"AMENT_PREFIX_PATH": str(folder / "offered")}
    ways = {
        "ros2 run": ros2.words("run", "demo", "node"),
        "python node.py": [sys.executable, str(program)],
    }
    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(count):
        for name, words in ways.items():
            times[name].append(_until_first_line(words, environ))
    run, bare = (median(spans) for spans in times.values())
    text = f"{run:.2f} s wall against {bare:.2f} s without it"
    return [Row("ros2 run, until the first message", text, f"{run / bare:.2f} x")]


def offer(prefix: Path) -> Path:
    """Make a folder in which `ros2 run demo node` finds a finished node, and return its file."""
    index = prefix / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / "demo").touch()
    program = prefix / "lib" / "demo" / "node"
    program.parent.mkdir(parents=True)
    source = (HERE.parent / "ros2_command" / "finished_node.py").read_text(encoding="utf-8")
    program.write_text(f"#!{sys.executable}\n{source}", encoding="utf-8")
    program.chmod(0o755)
    return program


def _until_first_line(words: list[str], environ: Mapping[str, str]) -> float:
    begin = time.perf_counter()
    with subprocess.Popen(words, env=environ, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        line = process.stdout.readline()
        seconds = time.perf_counter() - begin
        process.terminate()
        process.communicate(timeout=30)
    assert line == "published\n", line
    return seconds


def _build(environ: Mapping[str, str], folder: Path, count: int, limit: float) -> list[Row]:
    """One package, from nothing each time."""
    if find_spec("colcon_core") is None:
        return [Row("colcon build", "colcon is not installed")]
    workspace = folder / "workspace"
    (workspace / "src").mkdir(parents=True)
    shutil.move(folder / "sensor_simulator", workspace / "src")
    words = [sys.executable, "-m", "colcon", "build"]
    costs = [_fresh_build(words, environ, workspace) for _ in range(count)]
    imports = seconds_in_imports(words, environ, workspace)
    ratio = median(one.wall for one in costs) / limit
    return [Row("colcon build, one package", shown(costs, imports), f"{ratio:.1f} x import")]


def _fresh_build(words: list[str], environ: Mapping[str, str], workspace: Path) -> Cost:
    for name in ("build", "install", "log"):
        shutil.rmtree(workspace / name, ignore_errors=True)
    done = cost(words, environ, workspace)
    assert done.code == 0, done.error
    return done
