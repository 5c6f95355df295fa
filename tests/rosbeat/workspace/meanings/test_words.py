COLCON = """usage: colcon [-h] [--log-base LOG_BASE] [--log-level LOG_LEVEL]
              {build,extension-points,extensions,graph,info,list,metadata,test,test-result}
              ...
colcon: error: """
CHOICES = "(choose from 'build', 'extension-points', 'info', 'list', 'test', 'test-result')"


def test_a_misspelt_verb(meaning):
    output = f"{COLCON}argument verb_name: invalid choice: 'biuld' {CHOICES}"
    assert "Did you mean `build`?" in meaning("colcon biuld", output, 2)


def test_a_misspelt_verb_as_newer_pythons_say_it(meaning):
    output = "ros2: error: argument x: invalid choice: rnu (choose from doctor, node, run, topic)"
    assert "Did you mean `run`?" in meaning("ros2 rnu a b", output, 2)


def test_a_verb_like_no_other(meaning):
    output = f"{COLCON}argument verb_name: invalid choice: 'xyzzy' {CHOICES}"
    assert "It knows: build, " in meaning("colcon xyzzy", output, 2)


def test_a_misspelt_option(meaning):
    output = f"{COLCON}unrecognized arguments: --package-select sensor_simulator"
    said = meaning("colcon build --package-select sensor_simulator", output, 2)
    assert "Did you mean `--packages-select`?" in said
    output = f"{COLCON}unrecognized arguments: --symlink_install"
    assert "`--symlink-install`" in meaning("colcon build --symlink_install", output, 2)
    output = f"{COLCON}unrecognized arguments: symlink-install"
    assert "`--symlink-install`" in meaning("colcon build symlink-install", output, 2)
    output = f"{COLCON}unrecognized arguments: -symlink-install"
    assert "`--symlink-install`" in meaning("colcon build -symlink-install", output, 2)
    output = f"{COLCON}unrecognized arguments: --paralel-workers 2"
    assert "`--parallel-workers`" in meaning("colcon build --paralel-workers 2", output, 2)


def test_something_is_left_out(meaning):
    output = "ros2 run: error: the following arguments are required: executable_name, argv"
    assert "come two names" in meaning("ros2 run sensor_simulator", output, 2)
    output = "ros2 pkg create: error: the following arguments are required: package_name"
    said = meaning("ros2 pkg create --dependencies rclpy sensor_simulator", output, 2)
    assert "`--dependencies` takes every word" in said


def test_a_program_of_one_s_own_may_say_the_like(meaning):
    assert meaning("./tool x", "tool: error: unrecognized arguments: x", 2) is None


def test_an_option_in_the_place_of_the_executable(meaning):
    output = "usage: ros2 [-h]\nros2: error: unrecognized arguments: --ros-args -r"
    said = meaning("ros2 run second --ros-args -r __node:=second", output, 2)
    assert said.endswith("After `ros2 run` come two names: the package and the executable.")


def test_what_ros2_asks_itself_is_not_asked_again(meaning):
    output = (
        "ros2: error: argument x: invalid choice: 'rnu' (choose from 'node', 'run')\n"
        "Did you mean 'run'?"
    )
    assert meaning("ros2 rnu a b", output, 2) is None


def test_words_that_are_only_read(meaning):
    output = f"{COLCON}argument verb_name: invalid choice: 'biuld' {CHOICES}"
    assert meaning("cat log.txt", output, 0) is None
    output = "ros2 pkg create: error: the following arguments are required: package_name"
    assert meaning("cat log.txt", output, 0) is None
    output = f"{COLCON}unrecognized arguments: --symlink_install"
    assert meaning("cat log.txt", output, 0) is None
