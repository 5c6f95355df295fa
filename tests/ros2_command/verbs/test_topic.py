import re
import subprocess

import pytest
from as_typed import Ros2, interrupted
from ros2_command.verbs.topic import Bandwidth, Delays, Rates

pytestmark = pytest.mark.ros

LIST = ["/ns_two/in", "/one/in", "/parameter_events", "/rosout", "/slow", "/temperature"]


def test_list(graph):
    assert graph.out("topic", "list").split() == LIST
    assert "/slow [std_msgs/msg/Float32]\n" in graph.out("topic", "list", "-t")
    assert graph.out("topic", "list", "-tc") == "6\n"
    verbose = graph.out("topic", "list", "-v")
    assert verbose.startswith("Published topics:\n * /parameter_events ")
    assert " * /temperature [std_msgs/msg/Float32] 1 publisher\n" in verbose
    assert "\n\nSubscribed topics:\n * /ns_two/in [std_msgs/msg/Float32] 1 subscriber\n" in verbose


def test_type_and_find(graph):
    assert graph.out("topic", "type", "/temperature") == "std_msgs/msg/Float32\n"
    for name in ("/temprature", "temperature"):  # the original wants the slash, and is silent
        done = graph("topic", "type", name, code=1)
        said = f"# Unknown topic '{name}'\n# Did you mean '/temperature'?\n"
        assert (done.stdout, done.stderr) == ("", said)
    found = graph.out("topic", "find", "std_msgs/msg/Float32").split()
    assert found == ["/ns_two/in", "/one/in", "/slow", "/temperature"]
    assert graph.out("topic", "find", "-c", "std_msgs/Float32") == "0\n"


def test_info(graph):
    three = "Type: std_msgs/msg/Float32\nPublisher count: 1\nSubscription count: 0\n"
    assert graph.out("topic", "info", "/temperature") == three
    verbose = graph.out("topic", "info", "-v", "/temperature")
    pattern = (
        r"Type: std_msgs/msg/Float32\n\nPublisher count: 1\n\nNode name: one\nNode namespace: /\n"
        r"Topic type: std_msgs/msg/Float32\nTopic type hash: RIHS01_[0-9a-f]{64}\n"
        r"Endpoint type: PUBLISHER\nGID: ([0-9a-f]{2}\.){15}[0-9a-f]{2}\nQoS profile:\n"
        r"  Reliability: RELIABLE\n  History \(Depth\): UNKNOWN\n  Durability: VOLATILE\n"
        r"  Lifespan: Infinite\n  Deadline: Infinite\n  Liveliness: AUTOMATIC\n"
        r"  Liveliness lease duration: Infinite\n\nSubscription count: 0\n\n"
    )
    assert re.fullmatch(pattern, verbose)
    assert graph.error("topic", "info", "slw") == "Unknown topic 'slw'\n# Did you mean '/slow'?\n"


def test_echo(graph):
    assert graph.out("topic", "echo", "--once", "temperature") == "data: 25.5\n---\n"
    once = ("topic", "echo", "--once", "/temperature", "std_msgs/msg/Float32")
    assert graph.out(*once, "--csv") == "25.5\n"
    assert graph.out(*once, "--field", "data") == "25.5\n---\n"
    # As upstream does, the filter looks at the field.
    assert graph.out(*once, "--field", "data", "--filter", "m > 20") == "25.5\n---\n"
    assert graph.out(*once, "--raw") == r"b'\x00\x01\x00\x00\x00\x00\xccA'" + "\n---\n"
    assert re.match(r"publication_sequence_number: \d+\nreceived_timestamp: \d+\n"
                    r"reception_sequence_number: null\nsource_timestamp: \d+\n---\ndata: 25.5",
                    graph.out(*once, "-i"))  # fmt: skip


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ("/temprature",),
            "Could not determine the type for the passed topic\n# Did you mean '/temp",
        ),
        (
            ("/temperature", "std_msgs/msg/String"),
            "# The topic '/temperature' carries [std_msgs/msg/Float32]",
        ),
        (("/temperature", "Float32"), "The passed message type is invalid\n# Did you mean"),
        (
            ("/temperature", "--field", "dat"),
            "object has no attribute 'dat'\n# Did you mean 'data'?",
        ),
        (("/temperature", "--filter", "m.("), "is not a Python expression"),
        (("/temperature", "--filter", "m.nope"), "has no attribute 'nope'"),
        (
            ("/temperature", "--field", "data", "--filter", "m.data > 20"),
            "'float' object has no attribute 'data'",
        ),
        (("bad name!",), "topic name 'bad name!' is invalid"),
    ],
)
def test_echo_of_what_cannot_be_heard(graph, words, said):
    assert said in graph.error("topic", "echo", *words)


def test_echo_until_a_time_is_silent_if_nothing_comes(graph):
    done = graph("topic", "echo", "/one/in", "--timeout", "0.3")
    assert (done.stdout, done.stderr) == ("", "")


def test_ctrl_c_ends_without_a_word(graph):
    with graph.running("topic", "echo", "/temperature") as process:
        assert process.stdout.readline() == "data: 25.5\n"
        assert interrupted(process)[1] == ""


def test_an_ended_command_leaves_the_graph(graph):
    with graph.running("topic", "echo", "/temperature") as process:
        assert process.stdout.readline() == "data: 25.5\n"
        assert f"/_ros2cli_{process.pid}\n" in graph.out("node", "list", "--all")
        process.terminate()
        _, error = process.communicate(timeout=30)
        assert (process.returncode, error) == (143, "")
        assert f"/_ros2cli_{process.pid}\n" not in graph.out("node", "list", "--all")


@pytest.mark.parametrize(
    ("verb", "lines"),
    [
        ("hz", [r"average rate: \d+\.\d{3}", r"\tmin: .*s max: .*s std dev: .*s window: \d+"]),
        ("bw", [r"Subscribed to \[temperature\]", r"\d+ B/s from \d+ messages",
                r"\tMessage size mean: 8 B min: 8 B max: 8 B"]),
    ],
)  # fmt: skip
def test_rates(graph, verb, lines):
    with graph.running("topic", verb, "temperature") as process:
        for pattern in lines:
            assert re.fullmatch(pattern + "\n", process.stdout.readline())
        interrupted(process)


def test_delay(rich):
    with rich.running("topic", "delay", "/house/point") as process:
        assert re.fullmatch(r"average delay: \d\.\d{3}\n", process.stdout.readline())
        pattern = r"\tmin: .*s max: .*s std dev: .*s window: \d+\n"
        assert re.fullmatch(pattern, process.stdout.readline())
        interrupted(process)
    error = rich.error("topic", "delay", "/house/number")
    assert error.startswith("msg does not have header\n")
    with rich.running("topic", "delay", "/house/poin") as process:
        assert process.stdout.readline().startswith("WARNING: topic [/house/poin] does not appear")
        assert "Did you mean '/house/point'?" in process.stderr.readline()


def test_a_hidden_topic(rich):
    done = rich("topic", "type", "/house/_hidden", code=1)
    assert done.stdout == ""
    assert done.stderr.startswith("# The topic '/house/_hidden' is hidden")
    assert "ros2 topic --include-hidden-topics type /house/_hidden" in done.stderr
    out = rich.out("topic", "--include-hidden-topics", "type", "/house/_hidden")
    assert out == "std_msgs/msg/String\n"
    assert "/house/_hidden\n" in rich.out("topic", "--include-hidden-topics", "list")
    assert "/house/_hidden\n" in rich.out("topic", "list", "--include-hidden-topics")
    assert "/house/_hidden\n" not in rich.out("topic", "list")


def test_arrays_keep_their_bound(rich):
    shown = rich.out("topic", "echo", "--once", "--no-arr", "/house/bounded")
    assert "bool_values: '<sequence type: boolean[3], length: 0>'\n" in shown
    assert "defaults_values: '<sequence type: test_msgs/msg/Defaults[3], length: 0>'\n" in shown


def test_pub_follows_simulated_time(rich):
    """`/clock` of the node runs ten times as fast as the wall's: 10 s there are 1 s here."""
    point = ("geometry_msgs/msg/PointStamped", "{header: auto}")
    out = rich.out("topic", "pub", "-s", "-w", "0", "-t", "7", "/x", *point)
    found = re.findall(r"Time\(sec=(\d+), nanosec=(\d+)\)", out)
    stamps = [int(seconds) + int(nanoseconds) / 1e9 for seconds, nanoseconds in found]
    assert len(stamps) == 7
    known = [one for one in stamps if one]  # the first message may be older than the first time
    assert 3.5 < known[-1] - known[0] < 30.0  # at 1 Hz by the wall, it would be 50 s at least


def test_rates_follow_simulated_time(rich):
    """The node publishes at 20 Hz; in simulated time that is a tenth of it."""
    with rich.running("topic", "hz", "-s", "-w", "20", "/house/number") as process:
        lines = (re.match(r"average rate: ([\d.]+)", line) for line in process.stdout)
        rates = [float(found[1]) for found, _ in zip(filter(None, lines), range(4), strict=False)]
    assert rates[-1] < 11


def test_pub_repeats_that_it_waits_and_says_who_may_be_meant(graph):
    words = ("/on/in", "std_msgs/msg/Float32", "-1", "--max-wait-time-secs", "1.2")
    done = graph("topic", "pub", *words, code=1)
    # As the original, which looks each 0.1 s: it says so once more just before it gives up.
    assert done.stdout == 2 * "Waiting for at least 1 matching subscription(s)...\n"
    assert done.stderr.startswith("Timed out waiting for subscribers: Expected 1 subcribers but")
    assert "Did you mean '/one/in'?" in done.stderr


def test_pub_reaches_the_node(graph):
    words = ("topic", "pub", "--once", "one/in", "std_msgs/msg/Float32", "{data: 25.5}")
    out = graph.out(*words)
    lines = out.replace("Waiting for at least 1 matching subscription(s)...\n", "")
    expected = "publisher: beginning loop\npublishing #1: std_msgs.msg.Float32(data=25.5)\n\n"
    assert lines == expected
    assert graph.out(*words[:2], "-w", "0", *words[2:-1], "--stdin", stdin="data: 25.5") == expected


def test_pub_several_times(graph):
    words = ("pub", "-w", "0", "-r", "50", "-p", "2", "-t", "4", "x", "std_msgs/Float32")
    out = graph.out("topic", *words)
    assert re.findall(r"#\d", out) == ["#2", "#4"]


@pytest.mark.parametrize(
    ("words", "said", "code"),
    [
        (("/x", "std_msgs/msg/Float32", "25"), "needs to be a dictionary in YAML format", 1),
        (("/x", "std_msgs/msg/Float32", "{data: ["), "not valid YAML", 1),
        (("/x", "std_msgs/msg/Flot32"), "The passed message type is invalid\n# Did you mean", 1),
        (("/x", "std_msgs/msg/Float32", "-r", "0"), "-r/--rate: Value must be positive", 2),
        (("/x", "std_msgs/msg/Float32", "-n", "a b"), "cannot be the name of a node", 1),
        (("/x y", "std_msgs/msg/Float32"), "topic name '/x y' is invalid", 1),
    ],
)  # fmt: skip
def test_pub_of_what_cannot_be_sent(graph, words, said, code):
    assert said in graph.error("topic", "pub", *words, code=code)


def test_intervals():
    rates = Rates(window=100)
    assert rates.report() is None
    for now in (0.0, 1.0, 2.0):
        rates.arrived(now)
    text = "average rate: 1.000\n\tmin: 1.000s max: 1.000s std dev: 0.00000s window: 3"
    assert rates.report() == text
    assert rates.report() is None


def test_bandwidth():
    bandwidth = Bandwidth(window=100)
    bandwidth.arrived(0.0, 8)
    assert bandwidth.report(1.0) is None
    bandwidth.arrived(0.5, 8)
    text = "16 B/s from 2 messages\n\tMessage size mean: 8 B min: 8 B max: 8 B"
    assert bandwidth.report(1.0) == text
    large = Bandwidth(window=2)
    for now in (-1.0, 0.0, 0.5):
        large.arrived(now, 5080)
    assert large.report(1.0).splitlines()[0] == "10.16 KB/s from 2 messages"
    assert large.report(-2.0) is None


def test_delays():
    delays = Delays(window=100)
    delays.arrived(10.0, 1.0)  # starts the clock
    assert delays.report() is None
    delays.arrived(11.0, 10.9)
    delays.arrived(12.0, 11.7)
    text = "average delay: 0.200\n\tmin: 0.100s max: 0.300s std dev: 0.10000s window: 2"
    assert delays.report() == text
    assert delays.report() is None


HIDDEN = {
    "/house/fibonacci/_action/feedback": "test_msgs/action/Fibonacci_FeedbackMessage",
    "/house/fibonacci/_action/status": "action_msgs/msg/GoalStatusArray",
    "/house/enable/_service_event": "std_srvs/srv/SetBool_Event",
}


def test_topics_of_actions_and_services_have_their_types(rich):
    known = rich.out("topic", "list", "-t", "--include-hidden-topics")
    for topic, name in HIDDEN.items():
        assert f"{topic} [{name}]\n" in known
        done = rich("topic", "echo", topic, "--timeout", "0.2")
        assert (done.stdout, done.stderr) == ("", "")
        done = rich("topic", "echo", topic, name, "--timeout", "0.2")
        assert (done.stdout, done.stderr) == ("", "")


def test_feedback_can_be_heard(rich):
    topic = "/house/fibonacci/_action/feedback"
    with (
        rich.running("topic", "echo", "--once", topic) as echo,
        rich.running("topic", "bw", topic) as bandwidth,
    ):
        assert bandwidth.stdout.readline() == f"Subscribed to [{topic}]\n"
        while rich.out("topic", "info", topic).splitlines()[-1] != "Subscription count: 2":
            pass
        rich.out("action", "send_goal", "/house/fibonacci", "test_msgs/action/Fibonacci",
                 "{order: 5}")  # fmt: skip
        out, error = echo.communicate(timeout=60)
    assert (echo.returncode, error) == (0, "")
    assert out.startswith("goal_id:\n  uuid:\n  - ")
    assert "feedback:\n  sequence:\n  - 0\n  - 1\n" in out


def test_a_type_that_this_terminal_cannot_load(graph, another_node, tmp_path):
    """The type's workspace is sourced in the node's terminal, and not here."""
    (tmp_path / "std_msgs").mkdir()
    (tmp_path / "std_msgs" / "__init__.py").write_text("raise ImportError('not here')\n")
    path = f"{tmp_path}:{graph.environment['PYTHONPATH']}"
    here = Ros2(**(graph.environment | {"PYTHONPATH": path}))
    for words in (("echo",), ("hz",), ("bw",), ("delay",), ("echo", "--raw")):
        lines = here.error("topic", *words, "/temperature").splitlines()
        assert lines[0] == "The message type 'std_msgs/msg/Float32' is invalid"
        assert lines[1].startswith("# The topic '/temperature' carries that type")
        assert "source install/setup.bash" in lines[2]
    with here.running("bag", "record", "-o", tmp_path / "run", "/temperature") as process:
        while "cannot be recorded" not in (line := process.stderr.readline()):
            assert line
        assert "std_msgs/msg/Float32" in line
        assert "not sourced" in line
    error = graph.error("topic", "pub", "/x", "tutorial_interfaces/msg/Num")
    assert error.startswith("The passed message type is invalid\n# This terminal knows no package")


PAIRS = [
    # what was asked for, and what reaches a subscription that came late to `/latched`
    ([], "data: 25.5"),
    (["--qos-profile", "sensor_data"], "data: 25.5"),
    (["--qos-durability", "transient_local"], ""),
    (["--qos-depth", "1"], ""),
    (["--qos-reliability", "reliable"], ""),
    (["--qos-reliability", "reliable", "--qos-durability", "transient_local"], "data: 25.5"),
]


@pytest.mark.parametrize(("options", "heard"), PAIRS)
def test_one_policy_that_is_asked_for_switches_the_choice_off(latched, options, heard):
    """The original chooses what fits the publishers only if no single policy is given."""
    wait = ["--timeout", "20"] if heard else ["--timeout", "1.5"]
    out = latched.out("topic", "echo", "--once", *wait, *options, "/latched")
    assert out == (f"{heard}\n---\n" if heard else "")


def test_publishers_that_differ_are_heard_as_best_effort(latched, another_node):
    with another_node(latched, "weak", "/latched", "best_effort", file="latched_node.py"):
        out = latched.out("topic", "echo", "--timeout", "0.5", "/latched")
    for policy, weak in (("Reliability", "BEST_EFFORT"), ("Durability", "VOLATILE")):
        assert f"Falling back to QoS{policy}Policy.{weak} as it will connect to all" in out


def test_output_without_the_streams_that_it_needs(graph):
    """Closed by the shell, or of an encoding that lacks a character."""
    for tail, shown in (("topic list >&-", ""), ("topic list 2>&-", "/temperature\n")):
        done = subprocess.run(
            ["bash", "-c", f"{' '.join(graph.words())} {tail}"], env=graph.environment,
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert (done.returncode, done.stderr) == (0, "")
        assert shown in done.stdout
    value = ("topic", "pub", "-w", "0", "-1", "/x", "std_msgs/msg/String", "{data: ä}")
    out = Ros2(**graph.environment).out(*value, PYTHONIOENCODING="ascii:strict")
    assert r"data='\xe4'" in out
    home = {name: text for name, text in graph.environment.items() if name != "HOME"}
    done = subprocess.run(
        graph.words("node", "list"), env=home, capture_output=True, text=True, check=False
    )
    assert (done.stdout, done.stderr) == ("/ns_two\n/one\n", "")
