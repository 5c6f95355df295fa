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


def test_something_is_left_out(meaning):
    output = "ros2 run: error: the following arguments are required: executable_name, argv"
    assert "executable name" in meaning("ros2 run sensor_simulator", output, 2)
    output = "ros2 pkg create: error: the following arguments are required: package_name"
    said = meaning("ros2 pkg create --dependencies rclpy sensor_simulator", output, 2)
    assert "`--dependencies` takes every word" in said


def test_a_program_of_one_s_own_may_say_the_like(meaning):
    assert meaning("./tool x", "tool: error: unrecognized arguments: x", 2) is None
