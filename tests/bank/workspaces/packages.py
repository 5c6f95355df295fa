"""Answers to 02a, fill in a manifest, and 02b, a second package: files, and lines of a shell."""

from bank.answer import edited
from bank.workspaces.answer import Answer, right, untried, wrong
from rosbeat.workspace.catching_up import finished

_XML = finished("package.xml")
_DESCRIPTION = "A simulated temperature sensor and a monitor that judges its readings."
_LICENSE = "<license>Apache-2.0</license>"
_MAINTAINER = '<maintainer email="you@example.com">you</maintainer>'
_OPEN = ("<description>TODO: Package description<", "<license>TODO: License declaration<")
_RCLPY, _STD = "<depend>rclpy</depend>", "<depend>std_msgs</depend>"


def _with(*edits: tuple[str, str]) -> str:
    return edited(_XML, *edits)


def _described(text: str) -> str:
    return _with((_DESCRIPTION, text))


def _licensed(text: str) -> str:
    return _with((_LICENSE, f"<license>{text}</license>"))


MANIFESTS = (
    right("02a", "as on the page", _XML),
    right("02a", "another licence", _licensed("MIT")),
    right("02a", "one or the other", _licensed("MIT OR Apache-2.0")),
    right("02a", "small letters", _licensed("bsd-3-clause")),
    right("02a", "one of one's own", _licensed("LicenseRef-Mine")),
    right("02a", "two licences", _with((_LICENSE, f"{_LICENSE}<license>CC-BY-4.0</license>"))),
    right("02a", "no short name", _licensed("Apache 2.0")),
    right("02a", "format 2", _with(('format="3"', 'format="2"'))),
    right("02a", "a list of things to do", _described("Keeps the TODO list of a room.")),
    right("02a", "French", _described("Mesure la température &amp; la publie.")),
    right("02a", "several lines", _described("\n    Measures.\n    Publishes.\n  ")),
    right("02a", "by hand", _with((_RCLPY, "<exec_depend>rclpy</exec_depend>"))),
    right("02a", "another order", _with((_RCLPY, ""), (_STD, _STD + _RCLPY))),
    right("02a", "no comment lines, tabs", _with(("  <", "\t<"), ('<?xml version="1.0"?>\n', ""))),
    right(
        "02a", "a person", _with((_MAINTAINER, '<maintainer email="a.b@c.org">A B</maintainer>'))
    ),
    right("02a", "characters as they are", _described("<![CDATA[Below 20 & above 26.]]>")),
    right("02a", "bold", _described("A <b>sensor</b> of a room.")),
    right("02a", "another version", _with(("0.0.0", "12.3.4"))),
    right("02a", "two maintainers", _with((_MAINTAINER, _MAINTAINER * 2))),
    right("02a", "a comment", _with((_LICENSE, f"<!-- mine -->{_LICENSE}"))),
    right(
        "02a",
        "more tags",
        _with((_LICENSE, f"{_LICENSE}<url>https://example.com</url><author>me</author>")),
    ),
    right("02a", "Chinese", _described("模拟温度传感器")),
    right("02a", "a licence with blanks around", _licensed(" MIT ")),
    right("02a", "a licence file", _with(("<license>", '<license file="LICENSE">'))),
    right("02a", "one word", _described("Sensor")),
    wrong("02a", "todo with words", "manifest-open", _described("TODO: write this")),
    wrong("02a", "no licence tag", "manifest-open", _with((_LICENSE, ""))),
    wrong("02a", "dashes", "manifest-open", _licensed("---")),
    wrong(
        "02a",
        "two dependencies in one tag",
        "dependency-misspelled",
        _with((_RCLPY, "<depend>rclpy std_msgs</depend>"), (_STD, "")),
    ),
    wrong(
        "02a", "closed by another tag", "manifest-unreadable", _with(("</license>", "</licence>"))
    ),
    wrong("02a", "a capital name", "package-renamed", _with(("<name>sensor", "<name>Sensor"))),
    wrong("02a", "cmake alone", "build-type", _with(("ament_python", "cmake"))),
    wrong(
        "02a",
        "no export",
        "build-type",
        _with(("<export>\n    <build_type>ament_python</build_type>\n  </export>", "")),
    ),
    wrong(
        "02a",
        "an address without a dot",
        "manifest-value",
        _with(("you@example.com", "you@example")),
    ),
    untried(
        "02a",
        "as it was made",
        _with((f"<description>{_DESCRIPTION}<", _OPEN[0]), ("<license>Apache-2.0<", _OPEN[1])),
    ),
    untried("02a", "blanks", _with((_DESCRIPTION, "____"), ("Apache-2.0", "____"))),
    wrong("02a", "a description alone", "manifest-open", _licensed("TODO: License declaration")),
    wrong("02a", "a licence alone", "manifest-open", _described("TODO: Package description")),
    wrong("02a", "a blank left", "manifest-open", _described("____")),
    wrong("02a", "an empty licence", "manifest-open", _licensed("")),
    wrong("02a", "signs only", "manifest-open", _described("...")),
    wrong("02a", "todo", "manifest-open", _licensed("todo")),
    wrong(
        "02a",
        "British spelling",
        "tag-misspelled",
        _with((_LICENSE, "<licence>Apache-2.0</licence>")),
    ),
    wrong("02a", "a capital tag", "tag-misspelled", _with(("description>", "Description>"))),
    wrong("02a", "a letter in a tag", "tag-misspelled", _with(("description>", "discription>"))),
    wrong("02a", "not closed", "manifest-unreadable", _with(("</license>", ""))),
    wrong("02a", "a bare sign", "manifest-unreadable", _described("readings < 20 & > 26")),
    wrong("02a", "closed as opened", "manifest-unreadable", _with(("</license>", "<license>"))),
    wrong("02a", "a quote", "manifest-unreadable", _with(('format="3"', 'format="3'))),
    wrong("02a", "a line before the first", "manifest-unreadable", f"\n{_XML}"),
    right("02a", "a letter in the licence", _licensed("Apahce-2.0")),
    wrong(
        "02a", "another name", "package-renamed", _with(("<name>sensor_simulator", "<name>sensor"))
    ),
    wrong(
        "02a",
        "a dash in the name",
        "package-renamed",
        _with(("<name>sensor_simulator", "<name>sensor-simulator")),
    ),
    wrong("02a", "a dependency gone", "dependency-missing", _with((_STD, ""))),
    wrong("02a", "both gone", "dependency-missing", _with((_STD, ""), (_RCLPY, ""))),
    wrong(
        "02a", "a letter in a dependency", "dependency-misspelled", _with(("std_msgs", "std_msg"))
    ),
    wrong(
        "02a",
        "for tests only",
        "dependency-missing",
        _with((_STD, "<test_depend>std_msgs</test_depend>")),
    ),
    wrong("02a", "for C++", "build-type", _with(("ament_python", "ament_cmake"))),
    wrong(
        "02a", "no build type", "build-type", _with(("<build_type>ament_python</build_type>", ""))
    ),
    wrong(
        "02a", "a letter in the build type", "build-type", _with(("ament_python", "ament_pyhton"))
    ),
    wrong("02a", "a version of words", "manifest-value", _with(("0.0.0", "first"))),
    wrong("02a", "a short version", "manifest-value", _with(("0.0.0", "1.0"))),
    wrong("02a", "a format there is not", "manifest-value", _with(('format="3"', 'format="9"'))),
    wrong(
        "02a", "no address", "manifest-value", _with((_MAINTAINER, "<maintainer>me</maintainer>"))
    ),
    wrong(
        "02a",
        "for C++, and a dependency gone",
        "build-type dependency-missing",
        _with(("ament_python", "ament_cmake"), (_STD, "")),
    ),
    wrong(
        "02a",
        "British, and the other open",
        "tag-misspelled manifest-open",
        _with((_LICENSE, "<licence>MIT</licence>"), (_DESCRIPTION, "TODO")),
    ),
)

_CREATE = "ros2 pkg create --build-type ament_python room_display --dependencies rclpy sensor_msgs"
_BY_HAND = """
mkdir -p src/room_display/room_display src/room_display/resource
touch src/room_display/room_display/__init__.py src/room_display/resource/room_display
cp src/sensor_simulator/setup.cfg src/sensor_simulator/setup.py src/room_display/
sed -i s/sensor_simulator/room_display/ src/room_display/setup.*
cp src/sensor_simulator/package.xml src/room_display/
sed -i 's/sensor_simulator/room_display/; s/std_msgs/sensor_msgs/' src/room_display/package.xml
"""
_IN_SRC = f"cd src\n{_CREATE}\n"


def _after(name: str, mistakes: str, change: str) -> Answer:
    """The right package, and then something more is done to it."""
    return wrong("02b", name, mistakes, f"{_IN_SRC}cd room_display\n{change}")


def _created(name: str, mistakes: str, *edits: tuple[str, str]) -> Answer:
    """A package made with another command."""
    return wrong("02b", name, mistakes, edited(_IN_SRC, *edits))


SECOND = (
    right("02b", "as on the page", _IN_SRC),
    right(
        "02b",
        "another order",
        "cd src\nros2 pkg create room_display --dependencies sensor_msgs "
        "rclpy --build-type ament_python",
    ),
    right("02b", "into src from outside", f"{_CREATE} --destination-directory src"),
    right(
        "02b",
        "with a licence and more needs",
        f"cd src\n{_CREATE} std_msgs --license MIT --description 'Shows a room.'",
    ),
    right("02b", "format 2, a node", f"cd src\n{_CREATE} --package-format 2 --node-name show"),
    right("02b", "by hand", _BY_HAND),
    right("02b", "made elsewhere and moved", f"{_CREATE}\nmv room_display src/"),
    right(
        "02b",
        "a copy of the first",
        "cp -r src/sensor_simulator src/room_display\n"
        "cd src/room_display\nmv sensor_simulator room_display\n"
        "mv resource/sensor_simulator resource/room_display\n"
        "sed -i 's/sensor_simulator/room_display/; s/std_msgs/sensor_msgs/' package.xml setup.*",
    ),
    right("02b", "pushd", f"pushd src; {_CREATE}; popd"),
    right("02b", "an equals sign", f"cd src\n{_CREATE.replace('type ', 'type=')}"),
    right("02b", "made twice", f"cd src\n{_CREATE}\n{_CREATE}"),
    right(
        "02b",
        "wrong first, removed, then right",
        f"{_CREATE}\nrm -r room_display\ncd src\n{_CREATE}",
    ),
    right(
        "02b",
        "on two lines",
        "cd src\n" + _CREATE.replace(" --dep", " \\\n --dep").replace("\\\n", ""),
    ),
    right("02b", "a full path", f'cd "$ROS2_WORKSPACE/src" && {_CREATE}'),
    untried(
        "02b",
        "both in quotes, which ros2 refuses",
        f"cd src\n{_CREATE.replace('rclpy sensor_msgs', chr(34) + 'rclpy sensor_msgs' + chr(34))}",
    ),
    wrong("02b", "in resources", "wrong-folder", f"cd resources\n{_CREATE}"),
    wrong("02b", "in a folder of src", "wrong-folder", f"mkdir src/more\ncd src/more\n{_CREATE}"),
    wrong("02b", "a folder of the name in the workspace", "no-manifest", "mkdir room_display"),
    untried("02b", "nothing made", "cd src"),
    untried(
        "02b",
        "a name Python cannot have",
        "cd src\nros2 pkg create --build-type ament_python "
        "room-display --dependencies rclpy sensor_msgs",
    ),
    untried("02b", "no build type", "cd src\nros2 pkg create room_display"),
    untried("02b", "no options", "cd src\nros2 pkg create ament_python room_display rclpy"),
    wrong("02b", "in the workspace itself", "wrong-folder", _CREATE),
    wrong("02b", "in docs", "wrong-folder", f"cd docs\n{_CREATE}"),
    untried(
        "02b", "in the other package, which ros2 refuses", f"cd src/sensor_simulator\n{_CREATE}"
    ),
    wrong(
        "02b",
        "moved into the other package",
        "wrong-folder",
        f"{_IN_SRC}mv room_display sensor_simulator/",
    ),
    wrong(
        "02b",
        "moved into the other package's code",
        "wrong-folder",
        f"{_IN_SRC}mv room_display sensor_simulator/sensor_simulator/",
    ),
    _created("no dependencies", "dependency-missing", (" --dependencies rclpy sensor_msgs", "")),
    _created("one dependency", "dependency-missing", (" sensor_msgs", "")),
    _created(
        "those of the first",
        "dependency-misspelled dependency-missing",
        ("sensor_msgs", "std_msgs"),
    ),
    _created("a letter in a dependency", "dependency-misspelled", ("sensor_msgs", "sensor_msg")),
    _created("a letter in the other", "dependency-misspelled", ("rclpy", "rclpi")),
    _created("a letter in the name", "package-misspelled", ("room_display", "room_diplay")),
    _created("no underscore", "package-misspelled", ("room_display", "roomdisplay")),
    _after("for C++", "build-type", "sed -i s/ament_python/ament_cmake/ package.xml"),
    _after("no setup.py", "marker-missing", "rm setup.py"),
    _after("no marker", "marker-missing", "rm -r resource"),
    _after("no __init__", "marker-missing", "rm room_display/__init__.py"),
    _after(
        "a broken manifest",
        "manifest-unreadable no-manifest package-misspelled",
        "sed -i s/.package.// package.xml",
    ),
    wrong("02b", "a folder alone", "no-manifest", "mkdir -p src/room_display"),
    wrong(
        "02b",
        "elsewhere, for C++",
        "wrong-folder build-type",
        f"{_CREATE}\nsed -i s/ament_python/ament_cmake/ room_display/package.xml",
    ),
    _created(
        "a letter here and there",
        "package-misspelled dependency-misspelled",
        ("room_display", "room_diplay"),
        ("sensor_msgs", "sensor_msg"),
    ),
)

ANSWERS = (*MANIFESTS, *SECOND)
