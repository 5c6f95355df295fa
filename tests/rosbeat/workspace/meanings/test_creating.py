import shutil

CREATE = "ros2 pkg create --build-type ament_python sensor_simulator --dependencies rclpy std_msgs"
EXISTS = """
Aborted!
The directory already exists: ./sensor_simulator
Either remove the directory or choose a different destination directory or package name
"""
LEFT_OUT = """Build type 'ament_cmake' is left out here: this `ros2` makes Python packages.
Try:  ros2 pkg create --build-type ament_python sensor_simulator
"""


def cmake(package):
    path = package / "package.xml"
    path.write_text(path.read_text().replace("ament_python", "ament_cmake"))


def test_it_is_there_already(meaning, root, package):
    assert "Nothing was changed" in meaning(CREATE, EXISTS, 1, root / "src")
    assert meaning("cat log.txt", EXISTS, 0) is None


def test_the_build_type_is_forgotten(meaning, root):
    said = meaning("ros2 pkg create sensor_simulator", LEFT_OUT, 1, root / "src")
    assert "--build-type ament_python" in said


def test_the_build_type_is_forgotten_and_a_package_for_cpp_was_made(meaning, root, package):
    cmake(package)
    said = meaning("ros2 pkg create sensor_simulator", "going to create ...", 0, root / "src")
    assert "CMakeLists.txt" in said


def test_a_package_for_cpp_on_purpose(meaning, root, package):
    cmake(package)
    command = "ros2 pkg create --build-type ament_cmake sensor_simulator"
    assert meaning(command, "going to create ...", 0, root / "src") is None


def test_the_right_folder(meaning, root, package):
    assert meaning(CREATE, "going to create ...", 0, root / "src") is None
    assert meaning(f"cd src && {CREATE}", "going to create ...", 0, root) is None
    assert meaning(f"cd src\n{CREATE}", "going to create ...", 0, root / "src") is None


def test_the_wrong_folder(meaning, root, package):
    shutil.move(package, root)
    said = meaning(CREATE, "going to create ...", 0, root)
    assert "mv sensor_simulator src/" in said


def test_a_name_that_python_cannot_import(meaning, root):
    output = (
        "Aborted! 'sensor-simulator' cannot be the name of a package: Python reads '-' as minus."
    )
    command = "ros2 pkg create --build-type ament_python sensor-simulator"
    assert "small letters" in meaning(command, output, 1, root / "src")


def refused(rest):
    return f"usage: ros2 [-h]\nros2: error: unrecognized arguments: {rest}\n"


def test_the_options_themselves_are_left_out(meaning, root):
    def said(command, rest):
        return meaning(f"ros2 pkg create {command}", refused(rest), 2, root / "src")

    both = said("ament_python room_display rclpy sensor_msgs", "room_display rclpy sensor_msgs")
    assert both.startswith("The options --build-type and --dependencies are missing.")
    kind = said("ament_python room_display", "room_display")
    assert kind.startswith("The option --build-type is missing.")
    needs = said("--build-type ament_python room_display rclpy", "rclpy")
    assert needs.startswith("The option --dependencies is missing.")
    assert "--dependencies" not in said("--licence x a", "--licence")


def test_commas_between_dependencies(meaning, root):
    command = "ros2 pkg create --build-type ament_python a --dependencies rclpy, std_msgs"
    output = "Aborted! 'rclpy,' cannot be the name of a package to depend on.\n"
    said = meaning(command, output, 1, root / "src")
    assert said.endswith("Names are separated by blanks, not by commas.")


def test_a_dependency_with_a_bad_name_is_not_the_package_s_name(meaning, root):
    command = "ros2 pkg create --build-type ament_python a --dependencies rcl+py"
    output = "Aborted! 'rcl+py' cannot be the name of a package to depend on.\n"
    assert meaning(command, output, 1, root / "src") is None
