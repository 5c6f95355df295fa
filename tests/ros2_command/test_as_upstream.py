"""What the original does, as its own black-box tests and its recorded runs have it, in a table.

Only the original's words are compared: the notes, which this command adds, are left out, as anybody
can who sets ROS2_COMMAND_NO_NOTES to `all`.
"""

import re
import shlex

import pytest

pytestmark = pytest.mark.ros

ONE, RICH = "graph", "rich"  # the fixtures: `/one` and `/ns_two`; `/house/rich`
SERVICES = (
    *("describe_parameters", "get_parameter_types", "get_parameters", "get_type_description"),
    *("list_parameters", "set_parameters", "set_parameters_atomically"),
)
FLOAT, SET_BOOL = "std_msgs/msg/Float32", "std_srvs/srv/SetBool"
FIBONACCI = "test_msgs/action/Fibonacci"
BEGIN = "publisher: beginning loop\npublishing #1: "
GOAL = ("action", "send_goal", "/house/fibonacci", FIBONACCI)
WAITING = "Waiting for an action server to become available...\n"
SENT = f"{WAITING}Sending goal:\n     order: 1\n\nGoal accepted with ID: [0-9a-f]{{32}}\n\n"
DONE = "Result:\n    sequence:\n- 0\n- 1\n\nGoal finished with status: SUCCEEDED\n"
ASK = (
    "(waiting for service to become available...\n)?requester: making request: "
    "std_srvs.srv.SetBool_Request"
)
ANSWER = "\n\nresponse:\nstd_srvs.srv.SetBool_Response"
NOT_SET = "Setting parameter failed: "

#: Where, what is typed, the exit code, and patterns for the whole of stdout and of stderr.
TABLE = [
    # node
    (ONE, "node list", 0, "/ns_two\n/one\n", ""),
    (ONE, "node list -c", 0, "2\n", ""),
    (ONE, "node list --all", 0, "/ns_two\n/one\n", ""),
    (ONE, "node info /nosuch", 1, "", "Unable to find node '/nosuch'\n"),
    (ONE, "node info one", 1, "", "Unable to find node 'one'\n"),
    # topic list, type, find, info
    (ONE, "topic list", 0, "/ns_two/in\n/one/in\n/parameter_events\n/rosout\n/slow\n/temperature\n",
     ""),
    (ONE, "topic list -c", 0, "6\n", ""),
    (ONE, "topic list --count-topics -t", 0, "6\n", ""),
    (ONE, "topic type /temperature", 0, f"{FLOAT}\n", ""),
    (ONE, "topic type temperature", 1, "", ""),
    (ONE, "topic type /nosuch", 1, "", ""),
    (RICH, "topic type /house/_hidden", 1, "", ""),
    (RICH, "topic --include-hidden-topics type /house/_hidden", 0, "std_msgs/msg/String\n", ""),
    (ONE, f"topic find {FLOAT}", 0, "/ns_two/in\n/one/in\n/slow\n/temperature\n", ""),
    (ONE, f"topic find -c {FLOAT}", 0, "4\n", ""),
    (ONE, "topic find std_msgs/Float32", 0, "", ""),
    (ONE, "topic find rcl_interfaces/msg/NotAMessage", 0, "", ""),
    (RICH, "topic find std_msgs/msg/String", 0, "", ""),
    (RICH, "topic find --include-hidden-topics std_msgs/msg/String", 0, "/house/_hidden\n", ""),
    (ONE, "topic info /temperature", 0,
     f"Type: {FLOAT}\nPublisher count: 1\nSubscription count: 0\n", ""),
    (ONE, "topic info temperature", 1, "", "Unknown topic 'temperature'\n"),
    (ONE, "topic info /nosuch", 1, "", "Unknown topic '/nosuch'\n"),
    (RICH, "topic info /house/_hidden", 0,
     "Type: std_msgs/msg/String\nPublisher count: 1\nSubscription count: 0\n", ""),
    # topic echo
    (ONE, "topic echo --once /temperature", 0, "data: 25.5\n---\n", ""),
    (ONE, "topic echo --once temperature", 0, "data: 25.5\n---\n", ""),
    (ONE, f"topic echo --once /temperature {FLOAT}", 0, "data: 25.5\n---\n", ""),
    (ONE, "topic echo --once --csv /temperature", 0, "25.5\n", ""),
    (ONE, "topic echo --once --field data /temperature", 0, "25.5\n---\n", ""),
    (ONE, "topic echo --once --field .data /temperature", 0, "25.5\n---\n", ""),
    (ONE, "topic echo --once --field . /temperature", 1, "", "Invalid field value '.'\n"),
    (ONE, "topic echo --once --field not_member /temperature", 1, "",
     "Invalid field 'not_member': 'Float32' object has no attribute 'not_member'\n"),
    (ONE, "topic echo --once --filter 'm.data > 3' /temperature", 0, "data: 25.5\n---\n", ""),
    (ONE, "topic echo --timeout 0.5 --filter 'm.data > 30' /temperature", 0, "", ""),
    (ONE, "topic echo --timeout 0.5 /one/in", 0, "", ""),
    (ONE, "topic echo /nosuch", 1,
     "WARNING: topic \\[/nosuch\\] does not appear to be published yet\n",
     "Could not determine the type for the passed topic\n"),
    (ONE, "topic echo /temperature Float32", 1, "", "The passed message type is invalid\n"),
    (ONE, "topic echo /temperature nosuch/msg/Foo", 1, "", "The passed message type is invalid\n"),
    (RICH, "topic echo --timeout 0.5 /house/fibonacci/_action/feedback", 0, "", ""),
    (RICH, "topic echo --once --no-str --field header /house/point", 0,
     "stamp:\n  sec: \\d+\n  nanosec: \\d+\nframe_id: '<string length: <0>>'\n---\n", ""),
    (RICH, "topic echo --once --csv --field header /house/point", 0, "\\d+,\\d+,\n", ""),
    # topic pub
    (ONE, f"topic pub -1 -w 0 /x {FLOAT} '{{data: 1.5}}'", 0,
     f"{BEGIN}std_msgs.msg.Float32\\(data=1.5\\)\n\n", ""),
    (ONE, f"topic pub -1 -w 0 /x {FLOAT}", 0, f"{BEGIN}std_msgs.msg.Float32\\(data=0.0\\)\n\n", ""),
    (ONE, "topic pub -1 -w 0 /x std_msgs/String 'data: hi'", 0,
     f"{BEGIN}std_msgs.msg.String\\(data='hi'\\)\n\n", ""),
    (ONE, "topic pub -1 -w 0 /x std_msgs/msg/String '{data: 12}'", 0,
     f"{BEGIN}std_msgs.msg.String\\(data='12'\\)\n\n", ""),
    (ONE, "topic pub -1 -w 0 /x std_msgs/msg/Int32 '{data: 2.5}'", 0,
     f"{BEGIN}std_msgs.msg.Int32\\(data=2\\)\n\n", ""),
    (ONE, "topic pub -t 4 -p 2 -r 50 -w 0 /x std_msgs/msg/Bool", 0,
     "publisher: beginning loop\npublishing #2: std_msgs.msg.Bool\\(data=False\\)\n\n"
     "publishing #4: std_msgs.msg.Bool\\(data=False\\)\n\n", ""),
    (ONE, "topic pub -1 -w 0 /x nosuch/msg/Foo", 1, "", "The passed message type is invalid\n"),
    (ONE, f"topic pub -1 -w 0 /x {FLOAT} 25", 1, "",
     "The passed value needs to be a dictionary in YAML format\n"),
    (ONE, f"topic pub -1 -w 0 /x {FLOAT} ''", 1, "",
     "The passed value needs to be a dictionary in YAML format\n"),
    (ONE, f"topic pub -1 -w 0 /x {FLOAT} '{{nope: 1}}'", 1, "",
     "Failed to populate field: 'Float32' object has no attribute 'nope'\n"),
    (ONE, "topic pub -1 -w 0 /x std_msgs/msg/Int32 '{data: hello}'", 1, "",
     "Failed to populate field: invalid literal for int\\(\\) with base 10: 'hello'\n"),
    (ONE, "topic pub -1 -w 0 /x geometry_msgs/msg/PoseStamped '{header: {stamp: 5}}'", 1, "",
     "Failed to populate field: Value '5' is expected to be a dictionary but is a int\n"),
    (ONE, f"topic pub -1 --max-wait-time-secs 1 /x {FLOAT}", 1,
     "(Waiting for at least 1 matching subscription\\(s\\)...\n){2}",
     "Timed out waiting for subscribers: Expected 1 subcribers but only got 0 subscribers\n"),
    (ONE, f"topic pub --max-wait-time-secs 1 /x {FLOAT}", 1, "",
     "--max-wait-time-secs option is only effective with --wait-matching-subscriptions, --once or "
     "--times\n"),
    (ONE, f"topic pub -r x /x {FLOAT}", 2, "",
     "(?s)usage: .*argument -r/--rate: Expects a floating point number\n"),
    (ONE, f"topic pub -1 -t 3 /x {FLOAT}", 2, "",
     "(?s)usage: .*argument -t/--times: not allowed with argument -1/--once\n"),
    # service
    (ONE, "service list", 0,
     "".join(f"/{node}/{name}\n" for node in ("ns_two", "one")
             for name in sorted([*SERVICES, "enable"])), ""),
    (ONE, "service list -c", 0, "16\n", ""),
    (ONE, "service type /one/enable", 0, f"{SET_BOOL}\n", ""),
    (ONE, "service type /not_a_service", 1, "", ""),
    (ONE, "service type one/enable", 1, "", ""),
    (ONE, f"service find {SET_BOOL}", 0, "/ns_two/enable\n/one/enable\n", ""),
    (ONE, f"service find -c {SET_BOOL}", 0, "2\n", ""),
    (ONE, "service find not_a_type", 0, "", ""),
    (ONE, "service info /one/enable", 0,
     f"Type: {SET_BOOL}\nClients count: 0\nServices count: 1\n", ""),
    (ONE, "service info /nosuch", 1, "", "Unknown service '/nosuch'\n"),
    (ONE, f"service call /one/enable {SET_BOOL} '{{data: true}}'", 0,
     f"{ASK}\\(data=True\\){ANSWER}\\(success=True, message='on'\\)\n\n", ""),
    (ONE, f"service call one/enable {SET_BOOL}", 0,
     f"{ASK}\\(data=False\\){ANSWER}\\(success=False, message='on'\\)\n\n", ""),
    (ONE, "service call /one/enable std_srvs/SetBool", 0,
     f"{ASK}\\(data=False\\){ANSWER}\\(success=False, message='on'\\)\n\n", ""),
    (ONE, "service call /one/enable std_srvs/srv/Nope", 1, "",
     "The passed service type is invalid\n"),
    (ONE, "service call /one/enable std_msgs/msg/Bool", 1, "",
     "The passed type is not a service\n"),
    (ONE, f"service call /one/enable {SET_BOOL} '{{nope: 1}}'", 1, "",
     "Failed to populate field: 'SetBool_Request' object has no attribute 'nope'\n"),
    (ONE, f"service call -r 0 /one/enable {SET_BOOL}", 1, "", "rate must be greater than zero\n"),
    (ONE, "service echo /nosuch", 1, "", "Cannot find type for '/nosuch'\n"),
    (ONE, "service echo /one/enable std_srvs/srv/Nope", 1, "",
     "The service type 'std_srvs/srv/Nope' is invalid\n"),
    # param
    (ONE, "param list /nosuch", 1, "", "Node not found\n"),
    (ONE, "param list one --filter r", 0, "  rate\n", ""),
    (ONE, "param list one --filter ate", 0, "", ""),
    (ONE, "param list one --param-prefixes limits", 0, "  limits.max\n", ""),
    (RICH, "param list /house/rich --param-type --filter [cmn]", 0,
     "  count \\(type: integer\\)\n  maybe \\(type: integer\\)\n"
     "  names \\(type: string array\\)\n", ""),
    (ONE, "param get /ns_two rate", 0, "Integer value is: 3\n", ""),
    (ONE, "param get ns_two rate --hide-type", 0, "3\n", ""),
    (ONE, "param get /ns_two nope", 1, "", "Parameter not set\n"),
    (ONE, "param get /nosuch rate", 1, "", "Node not found\n"),
    (ONE, "param set /ns_two rate 3", 0, "Set parameter successful\n", ""),
    (ONE, "param set /ns_two rate 2.5", 0, "",
     f"{NOT_SET}Wrong parameter type, expected 'Type.INTEGER' got 'Type.DOUBLE'\n"),
    (ONE, "param set /ns_two nope 1", 0, "",
     f"{NOT_SET}Invalid access to undeclared parameter\\(s\\): \\[\\]\n"),
    (RICH, "param set /house/rich limit 1000.0", 0, "",
     f"{NOT_SET}Parameter limit out of range.*\n"),
    (RICH, "param set /house/rich fixed y", 0, "",
     f"{NOT_SET}Trying to set a read-only parameter: fixed.\n"),
    (ONE, "param delete /ns_two rate", 0, "",
     "Deleting parameter failed: Static parameter cannot be undeclared\n"),
    (ONE, "param describe /ns_two nope", 0, "", ""),
    (ONE, "param describe /ns_two rate nope", 0, "", ""),
    (ONE, "param describe ns_two rate", 0,
     "Parameter name: rate\n  Type: integer\n  Constraints:\n", ""),
    (ONE, "param dump /nosuch", 1, "", "Node not found\n"),
    (ONE, "param load /nosuch file.yaml", 1, "", "Node not found\n"),
    (ONE, "param load /ns_two wild.yaml", 0, "Set parameter rate successful\n", ""),
    (ONE, "param load /ns_two wild.yaml --no-use-wildcard", 1, "",
     "Param file does not contain selected parameters\n"),
    # action
    (RICH, "action list", 0, "/house/fibonacci\n", ""),
    (RICH, "action list -t", 0, f"/house/fibonacci \\[{FIBONACCI}\\]\n", ""),
    (RICH, "action list -c", 0, "1\n", ""),
    (RICH, "action type /house/fibonacci", 0, f"{FIBONACCI}\n", ""),
    (RICH, "action type /nosuch", 1, "", ""),
    (RICH, "action info -c /house/fibonacci", 0,
     "Action: /house/fibonacci\nAction clients: 0\nAction servers: 1\n", ""),
    (RICH, "action info /nosuch", 0, "Action: /nosuch\nAction clients: 0\nAction servers: 0\n", ""),
    (RICH, " ".join(GOAL) + " '{order: 1}'", 0, SENT + DONE, ""),
    (RICH, " ".join(GOAL) + " '{order: -1}'", 0,
     f"{WAITING}Sending goal:\n     order: -1\n\nGoal was rejected.\n", ""),
    (RICH, " ".join(GOAL) + " '{nope: 1}'", 1, "",
     "Failed to populate message fields: "
     "AttributeError\\(\"'Fibonacci_Goal' object has no attribute 'nope'\"\\)\n"),
    (RICH, "action send_goal /house/fibonacci test_msgs/action/Nope", 1, "",
     "The passed action type is invalid\n"),
    # pkg, interface, run, daemon: without a graph
    (ONE, "pkg prefix nosuch", 1, "", "Package not found\n"),
    (ONE, "pkg executables nosuch", 1, "", "Package 'nosuch' not found\n"),
    (ONE, "pkg xml nosuch", 1, "", "Package not found\n"),
    (ONE, "pkg xml rclpy -t nope", 1, "", "XML tag not found\n"),
    (ONE, "pkg xml std_srvs -t name", 0, "std_srvs\n", ""),
    (ONE, "run nosuch x", 1, "", "Package 'nosuch' not found\n"),
    (ONE, "run rclpy nosuch", 1, "", "No executable found\n"),
    (ONE, "run rclpy", 2, "",
     "(?s)usage: .*the following arguments are required: executable_name, argv\n"),
    (ONE, "interface show --no-comments sensor_msgs/msg/Temperature", 0,
     "std_msgs/Header header #\n\tbuiltin_interfaces/Time stamp\n"
     "\t\tint32 sec\n\t\tuint32 nanosec\n"
     "\tstring frame_id\n {29}# frame_id is the location of the temperature reading\n"
     "float64 temperature          #\nfloat64 variance             #\n", ""),
    (ONE, "interface show --no-comments unique_identifier_msgs/msg/UUID", 0,
     "#\nuint8\\[16\\] uuid\n", ""),
    (ONE, "interface show -", 2, "", "(?s)usage: .*: error: the passed value is empty\n"),
    (RICH, "service info /house/fibonacci/_action/send_goal", 1, "",
     "Unknown service '/house/fibonacci/_action/send_goal'\n"),
    (ONE, "interface show std_msgs/msg/String", 0, "(?s).*string data\n", ""),
    (ONE, "interface show std_srvs/srv/Empty.srv", 0, "---\n", ""),
    (ONE, "interface show std_msgs/String", 1, "",
     "Invalid name 'std_msgs/String'. Expected three parts separated by '/'\n"),
    (ONE, "interface show std_msgs/msg/NotAMessage", 1, "",
     "Could not find the interface '.*/share/std_msgs/msg/NotAMessage.idl'\n"),
    (ONE, "interface show not_a_package/msg/String", 1, "", "Unknown package 'not_a_package'\n"),
    (ONE, "interface package not_a_package", 1, "", "Unknown package 'not_a_package'\n"),
    (ONE, f"interface proto {SET_BOOL}", 0, '"data: false\n"\n', ""),
    (ONE, f"interface proto --no-quotes {SET_BOOL}", 0, "data: false\n\n", ""),
    (ONE, "daemon stop", 0, "The daemon is not running\n", ""),
    (ONE, "daemon status", 0, "The daemon is not running\n", ""),
]  # fmt: skip


@pytest.mark.parametrize(
    ("where", "typed", "code", "out", "error"), TABLE, ids=[f"{row[0]}: {row[1]}" for row in TABLE]
)
def test_a_command(request, tmp_path, where, typed, code, out, error):
    (tmp_path / "wild.yaml").write_text("/**:\n  ros__parameters:\n    rate: 3\n")
    ros2 = request.getfixturevalue(where)
    done = ros2(*shlex.split(typed), cwd=tmp_path, code=None, ROS2_COMMAND_NO_NOTES="all")
    assert re.fullmatch(error, done.stderr), done.stderr
    assert re.fullmatch(out, done.stdout), done.stdout
    assert done.returncode == code
