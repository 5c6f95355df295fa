"""Answers to 06a, one more monitor, and 06b, link instead of copy: terminals, and workspaces."""

from bank.workspaces.answer import right, untried, wrong

_PLACE = "~/ROS2_and_RL_Tutorials"
_SUBSCRIBER = "ros2 run sensor_simulator temperature_subscriber"
_RUN = f"{_SUBSCRIBER} --ros-args -r __node:=second_monitor"
_HEARS = "[INFO] [second_monitor]: Temperature: 22.10C - Status:Normal"
_STARTED = "[INFO] [second_monitor]: Temperature Monitor Node Started"
_FIRST = "[INFO] [temperature_monitor]: Temperature: 22.10C - Status:Normal"
_NOT_FOUND = (
    "Package 'sensor_simulator' not found\n"
    "If you have built it in a workspace: run `source install/setup.bash` there, in this terminal."
)
_NO_EXECUTABLE = "No executable found"
_HAS = "Package 'sensor_simulator' has: temperature_publisher, temperature_subscriber"


def _shown(*commands_and_outputs: str) -> str:
    """What a terminal shows: a prompt before each command, and then what it has printed."""
    pairs = zip(commands_and_outputs[::2], commands_and_outputs[1::2], strict=True)
    return "".join(f"{_PLACE}$ {command}\n{output}\n" for command, output in pairs)


MONITORS = (
    right("06a", "as on the page", _shown("source install/setup.bash", "", _RUN, _HEARS)),
    right("06a", "the long option", _shown(_RUN.replace("-r", "--remap"), f"{_STARTED}\n{_HEARS}")),
    right(
        "06a", "of one node", _shown(_RUN.replace("__node", "temperature_monitor:__node"), _HEARS)
    ),
    right("06a", "in one line", _shown(f"source install/setup.bash && {_RUN}", _HEARS)),
    right("06a", "with a stamp", _shown(_RUN, _HEARS.replace("] [", "] [1732212345.12] ["))),
    right("06a", "words of one's own", _shown(_RUN, "[WARN] [second_monitor]: It is 22.1, Normal")),
    right("06a", "more remaps", _shown(f"{_RUN} -r temperature:=/temperature", _HEARS)),
    right("06a", "wrong first, then right", _shown(_SUBSCRIBER, _FIRST, _RUN, _HEARS)),
    right("06a", "the older name", _shown(_RUN.replace("__node", "__name"), _HEARS)),
    right(
        "06a",
        "quotes",
        _shown(_RUN.replace("__node:=second_monitor", "'__node:=second_monitor'"), _HEARS),
    ),
    right("06a", "with a setting", _shown(f"{_RUN} --log-level info", _HEARS)),
    right("06a", "no sign", _shown(_RUN, "[INFO] [second_monitor]: 22.1 degrees, all is well")),
    right(
        "06a",
        "in a namespace of none",
        _shown(_RUN.replace("-r __node", "-r __ns:=/ -r __node"), _HEARS),
    ),
    wrong(
        "06a",
        "a capital name",
        "wrong-node-name",
        _shown(_RUN.replace("second_m", "Second_m"), _FIRST.replace("temperature_m", "Second_m")),
    ),
    wrong("06a", "no name", "wrong-node-name", _shown(_RUN.replace("second_monitor", ""), _FIRST)),
    wrong(
        "06a",
        "three underscores",
        "option-misspelled wrong-node-name option-missing",
        _shown(_RUN.replace("__", "___"), _FIRST),
    ),
    wrong(
        "06a",
        "the topic renamed",
        "not-renamed option-misspelled",
        _shown(_RUN.replace("__node", "temperature"), _FIRST),
    ),
    untried("06a", "nothing run", _shown("source install/setup.bash", "")),
    untried("06a", "nothing typed", ""),
    wrong("06a", "not sourced", "not-sourced", _shown(_RUN, _NOT_FOUND)),
    wrong(
        "06a",
        "not sourced, and looked around",
        "not-sourced",
        _shown(_RUN, _NOT_FOUND, "ls", "install"),
    ),
    wrong(
        "06a",
        "a letter in the package",
        "package-misspelled",
        _shown(_RUN.replace("simulator ", "simulatr "), "Package 'sensor_simulatr' not found"),
    ),
    wrong(
        "06a",
        "a letter in the executable",
        "executable-misspelled",
        _shown(
            _RUN.replace("subscriber", "subsriber"),
            f"{_NO_EXECUTABLE}\nDid you mean 'temperature_subscriber'?",
        ),
    ),
    wrong(
        "06a",
        "the node's name",
        "executable-misspelled",
        _shown(
            _RUN.replace("temperature_subscriber", "temperature_monitor"),
            f"{_NO_EXECUTABLE}\n{_HAS}",
        ),
    ),
    wrong(
        "06a",
        "no executable",
        "word-missing",
        _shown(
            "ros2 run sensor_simulator --ros-args -r __node:=second_monitor",
            "usage: ros2 [-h]\nros2: error: unrecognized arguments: --ros-args -r",
        ),
    ),
    wrong(
        "06a",
        "a letter in the command",
        "word-misspelled command-misspelled",
        _shown(
            _RUN.replace("ros2 run", "ros2 rnu"),
            "ros2: error: argument x: invalid choice: 'rnu' (choose from 'node', 'run')",
        ),
    ),
    wrong(
        "06a",
        "a letter in ros2",
        "command-misspelled",
        _shown(_RUN.replace("ros2", "rso2"), "bash: rso2: command not found"),
    ),
    wrong("06a", "not renamed", "not-renamed", _shown(_SUBSCRIBER, _FIRST)),
    wrong("06a", "one underscore", "option-misspelled", _shown(_RUN.replace("__", "_"), _FIRST)),
    wrong(
        "06a", "an equals sign alone", "option-misspelled", _shown(_RUN.replace(":=", "="), _FIRST)
    ),
    wrong("06a", "no -r", "option-missing", _shown(_RUN.replace(" -r", ""), _FIRST)),
    wrong(
        "06a", "no --ros-args", "option-missing", _shown(_RUN.replace(" --ros-args", ""), _FIRST)
    ),
    wrong(
        "06a",
        "another name",
        "wrong-node-name",
        _shown(_RUN.replace("second", "secund"), _FIRST.replace("temperature_", "secund_")),
    ),
    wrong(
        "06a",
        "the sensor",
        "other-executable",
        _shown(
            _RUN.replace("subscriber", "publisher"), "[INFO] [second_monitor]: Publishing: 22.1C"
        ),
    ),
    wrong("06a", "nobody publishes", "nobody-publishes", _shown(_RUN, _STARTED)),
    wrong(
        "06a",
        "the sensor, not renamed",
        "not-renamed other-executable",
        _shown(
            _SUBSCRIBER.replace("subscriber", "publisher"),
            "[INFO] [temperature_sensor]: Publishing: 22.1C",
        ),
    ),
    wrong("06a", "the program ended", "new-to-me", _shown(_RUN, "Killed")),
)

_P = "install/sensor_simulator"
_LIBRARY = f"{_P}/lib/python3.11/site-packages"
COPY = (
    f"mkdir -p {_LIBRARY} {_P}/share/sensor_simulator {_P}/lib/sensor_simulator\n"
    f"touch install/COLCON_IGNORE install/setup.bash {_P}/share/sensor_simulator/package.xml\n"
    f"cp -r src/sensor_simulator/sensor_simulator {_LIBRARY}/\n"
    f"cp /bin/true {_P}/lib/sensor_simulator/temperature_publisher\n"
    f"cp /bin/true {_P}/lib/sensor_simulator/temperature_subscriber\n"
)
_LINK = f"echo x > {_LIBRARY}/sensor-simulator.egg-link\n"
_SETUP = "src/sensor_simulator/setup.py"
_NEW = (
    "ros2 pkg create --build-type ament_python other --destination-directory src >/dev/null\n"
    "mkdir -p install/other/lib/python3.11/site-packages install/other/share/other\n"
    "touch install/other/share/other/package.xml\n"
    "echo x > install/other/lib/python3.11/site-packages/other.egg-link\n"
)
_IN_THE_PACKAGE = COPY.replace("cp -r src/sensor_simulator/", "cp -r ")
_IN_SRC = COPY.replace("cp -r src/", "cp -r ")

LINKS = (
    right("06b", "as on the page", COPY + _LINK),
    right("06b", "the newer name", COPY + _LINK.replace("sensor-s", "sensor_s")),
    right(
        "06b", "all in one folder", (COPY + _LINK).replace("install/sensor_simulator/", "install/")
    ),
    right("06b", "with another Python", (COPY + _LINK).replace("3.11", "3.12")),
    right("06b", "with another package", COPY + _LINK + _NEW),
    right(
        "06b",
        "edited since",
        COPY + _LINK + "echo >> src/sensor_simulator/sensor_simulator/__init__.py",
    ),
    right("06b", "built twice", COPY + COPY + _LINK),
    right(
        "06b", "with folders of one's own", COPY + _LINK + "mkdir -p docs/install resources/build\n"
    ),
    wrong("06b", "in docs", "wrong-folder", f"{COPY}mkdir -p docs/install/sensor_simulator/lib\n"),
    wrong("06b", "no setup call", "no-setup-call", f"{COPY}echo 'x = 1' > {_SETUP}\n"),
    untried("06b", "a copy", COPY),
    untried("06b", "not built", "ls"),
    untried("06b", "no package", "rm -r src/sensor_simulator"),
    wrong("06b", "in src", "wrong-folder", f"{COPY}cd src\n{_IN_SRC}{_LINK}"),
    wrong(
        "06b",
        "in the package",
        "wrong-folder",
        f"{COPY}cd src/sensor_simulator\n{_IN_THE_PACKAGE}{_LINK}",
    ),
    wrong("06b", "another package", "other-package", COPY + _NEW),
    wrong(
        "06b",
        "a comma missing",
        "comma-missing",
        f"{COPY}sed -i \"s/publisher:main',/publisher:main'/\" {_SETUP}",
    ),
    wrong("06b", "a slash", "slash-in-module", f"{COPY}sed -i 's/or.temp/or\\/temp/' {_SETUP}"),
    wrong("06b", "a bracket missing", "syntax-error", f"{COPY}sed -i 's/],$//' {_SETUP}"),
    wrong("06b", "setup.py removed", "marker-missing", f"{COPY}rm {_SETUP}"),
    wrong(
        "06b",
        "in src, a comma missing",
        "wrong-folder comma-missing",
        f"{COPY}sed -i \"s/publisher:main',/publisher:main'/\" {_SETUP}\ncd src\n{_IN_SRC}",
    ),
)

ANSWERS = (*MONITORS, *LINKS)
