# ---
# title: Build your own
# minutes: 100
# needs: ["04", "07", "08", "09"]
# summary: A greenhouse of at least four nodes, designed by you and judged by what it does.
# ---

# %% [markdown]
# # Build your own
#
# **After this page, you can:**
#
# - turn requirements into a design of small nodes (13b, 13.1);
# - write a controller with parameters, and with an output for late-joining subscriptions (13a);
# - measure a silence with the node's clock (13b, 13.2);
# - test a single requirement with an input made for it (13b, 13.3).
#
# **Time:** 100 minutes, in as many sittings as you like. **You need:**
# [write a subscriber](04_write_a_subscriber.ipynb), [look inside the graph](07_look_inside_the_graph.ipynb),
# [tune quality of service](08_tune_quality_of_service.ipynb) and
# [test the five claims](09_test_the_five_claims.ipynb).
#
# You'll design a greenhouse with at least four nodes, build it, and have it tested. The page begins with a first
# node to complete. For the others, it gives you no code, but requirements: sentences that have to be true when
# you're done.

# %%
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Bool, Float32, String

from rosbeat.exercises.greenhouse import requirements, weather

workspace.catch_up("02")

viz.diagram("13")

# %% [markdown]
# ## Agree on the interface
#
# A greenhouse has a thermometer and a hygrometer, which measures humidity. Both publish once a second. On the other
# side are a vent, a pump, a display for alarms and a display for reports. The names and types of these six topics
# are the **interface**: what both sides have agreed on.
#
# Here is the interface as a single node, an empty box. `weather()` returns the two sensors, as classes. They publish
# the same values in every run. Their plain day lasts 170 seconds.

# %%
class Box(Node):
    def __init__(self):
        super().__init__("your_greenhouse")
        for topic in ("temperature", "humidity"):
            self.create_subscription(Float32, topic, self.ignore, 10)
        self.create_publisher(Bool, "vent", 10)
        self.create_publisher(Bool, "pump", 10)
        self.create_publisher(String, "alarm", 10)
        self.create_publisher(Float32, "report", 10)

    def ignore(self, msg):
        pass

ros = Session()
for sensor in weather("plain day"):
    ros.add(sensor)
ros.add(Box)
ros.run(seconds=171)
viz.graph(ros)

# %% [markdown]
# Two topics go in, and four come out. You'll divide the box into at least four nodes.
#
# ## Read the requirements
#
# The check judges exactly this list, sentence by sentence, and gives these points.

# %% shows=true
requirements()

# %% [markdown]
# Seven more rules apply:
#
# - your nodes have two seconds to do whatever is required;
# - `True` on `vent` opens the vent, and `True` on `pump` starts the pump. Until the first command, the vent is
#   closed and the pump is off. A node may publish these two states when it starts;
# - a pump that the vent has stopped rests, too;
# - a limit itself doesn't count as crossed: at exactly 28, the vent doesn't open;
# - if there was no temperature in the last 10 s, there is no mean. The report may then stay silent, but its node
#   keeps running;
# - a sensor is silent when nothing arrives. Whether an impossible reading (R5) ends a silence is up to you;
# - an optional requirement earns its points, but you can pass without it.
#
# ## Look at the weather
#
# The plain day has a part for the vent, a part for the pump, and a part for both.

# %%
limits = {"stays as it is": (26.0, 28.0)}
viz.values(ros, "temperature", bands=limits, unit="°C")

# %% shows=true
viz.values(ros, "humidity", bands={"dry": (None, 40.0)}, unit="%")

# %% [markdown]
# The other day is for R4 and R5: its sensors send impossible readings, then one of them is silent for a while, and then
# both.
#
# **Predict:** a healthy thermometer would send 120 readings in two minutes. How many does this one send? You may
# answer with a range, such as `100-110`.

# %% predict=true
ros = Session()
for sensor in weather("broken sensors"):
    ros.add(sensor)
ros.run(seconds=120)
# --- answer
predict("70-90", len(ros.messages("temperature")))
# --- blank
# predict("____", len(ros.messages("temperature")))
# --- end

# %% [markdown] answers=true
# It sends 78. The rest is silence: long enough for an alarm, for a second alarm that R4 doesn't allow, and for a report
# without a single reading. Of the readings that come, two are outside -20 to 60 degrees, and four are NaN, "not a
# number": any comparison with `<`, `>` or `==` is False.

# %% [markdown]
# ## Draw before you write
#
# Take a sheet of paper. Draw the six topics at the edges and your nodes in the middle. For each node, write down
# three things: what it subscribes to, what it publishes, and its one task. These questions help:
#
# - Which requirement belongs to which node? R8 wants each output to have a node of its own.
# - Which node has to know what another node decided? On which topic does it find out?
# - Which node checks that a reading is plausible? One for all, or each for itself?
# - If this node ends, which others stop working? That's R9.
#
# A table says the same as a drawing. This one describes pages 03 and 04; make one for your greenhouse.
#
# | node | subscribes to | publishes | task |
# |---|---|---|---|
# | `temperature_sensor` | | `temperature` | measures once a second |
# | `temperature_monitor` | `temperature` | | reports whether it's too hot |

# %% [markdown]
# ## Try it: the vent alone
#
# Begin with a single node. It has to meet R1 and R7, and two details prepare it for more:
#
# - its limits are **parameters**, as on page 07: values that can be set from outside, when the node starts or
#   later. `declare_parameter` sets the name and the default, and `get_parameter(...).value` returns the value;
# - `LATCHED` is a QoS profile that keeps the last message for late-joining subscribers that ask for it (page 08).
#
# Write the rest of the callback. Keep both details: a limit that is set later counts from the next reading on, and
# a late-joining subscriber gets the last command.

# %%
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

# %% exercise="13a"
class VentControl(Node):
    def __init__(self):
        super().__init__("vent_control")
        self.declare_parameter("open_above", 28.0)
        self.declare_parameter("close_below", 26.0)
        self.publisher_ = self.create_publisher(Bool, "vent", LATCHED)
        self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
        self.is_open = False

    def temperature_callback(self, msg):
        above = self.get_parameter("open_above").value
        below = self.get_parameter("close_below").value
        # --- answer
        if msg.data > above:
            wanted = True
        elif msg.data < below:
            wanted = False
        else:
            wanted = self.is_open
        if wanted != self.is_open:
            self.is_open = wanted
            self.publisher_.publish(Bool(data=wanted))
        # --- blank
        # ____
        # --- end

# %% check="13a"
check("13a", VentControl)

# %% [markdown]
# You can also define the weather yourself. That's how you test one requirement at a time: with a short day that asks
# a single question. None means a second of silence. **Predict:** how many commands does the vent get?

# %% predict=true
ros = Session()
for sensor in weather(temperature=[25.0, 29.0, 27.0, None, 25.0]):
    ros.add(sensor)
ros.add(VentControl)
ros.run(seconds=6)
# --- answer
predict("2", len(ros.messages("vent")))
# --- blank
# predict("____", len(ros.messages("vent")))
# --- end

# %% [markdown] answers=true
# The vent opens at 29 degrees. At 27, it stays as it is, and at the second 25, it closes.

# %% [markdown]
# ## Measure a silence
#
# When a sensor is silent, no callback runs, so something else has to check from time to time: a timer. Every node
# has a clock, `get_clock()`. Subtracting one of its times from another gives a duration.

# %%
class Stopwatch(Node):
    def __init__(self):
        super().__init__("stopwatch")
        self.create_subscription(Float32, "humidity", self.note_time, 10)
        self.create_timer(4.0, self.tell)
        self.heard_at = self.get_clock().now()

    def note_time(self, msg):
        self.heard_at = self.get_clock().now()

    def tell(self):
        age = self.get_clock().now() - self.heard_at
        self.get_logger().info(f"{age.nanoseconds / 1e9:.0f} s since the last one")

ros = Session()
for sensor in weather(humidity=[50.0, 51.0, 52.0]):
    ros.add(sensor)
ros.add(Stopwatch)
ros.run(seconds=12)

# %% [markdown]
# The sensor stopped after three seconds, and the timer noticed. Use the node's clock rather than `time.time()`: when
# a recording is replayed, only the node's clock can follow it. A timer can also measure the silence itself: its `reset()` starts
# the period again at each message. It repeats until you call `cancel()`.
#
# ## Try it: the whole greenhouse
#
# Write your nodes in the next cells, or add cells of your own. The function `greenhouse` at the end returns the list
# of what to start, like a launch file. Each item is a class, or a pair of a class and the options for starting it.
# The options are those of `ros.add`: `name`, `namespace`, `remappings`, `parameters`. For example:
# `(Monitor, {"remappings": {"temperature": "checked/temperature"}})`.
#
# Check early: even a greenhouse with one node earns some points. If you're stuck, `hint("13b")` helps.

# %% exercise="13b"
# --- answer
class Guard(Node):
    """Publishes the possible readings again, on topics of its own."""

    def __init__(self):
        super().__init__("guard")
        self.pass_on("temperature", -20.0, 60.0)
        self.pass_on("humidity", 0.0, 100.0)

    def pass_on(self, topic, low, high):
        out = self.create_publisher(Float32, f"checked/{topic}", 10)

        def listen(msg):
            if low <= msg.data <= high:
                out.publish(msg)

        self.create_subscription(Float32, topic, listen, 10)


class Reporter(Node):
    def __init__(self):
        super().__init__("reporter")
        self.means = self.create_publisher(Float32, "report", 10)
        self.create_subscription(Float32, "temperature", self.collect, 10)
        self.create_timer(10.0, self.report)
        self.values = []

    def collect(self, msg):
        self.values.append(msg.data)

    def report(self):
        if self.values:
            self.means.publish(Float32(data=sum(self.values) / len(self.values)))
        self.values = []
# --- blank
# # class ____(Node):
# --- end

# %% exercise="13b"
# --- answer
class PumpControl(Node):
    """Is ready, runs, or rests; a timer leads from one to the next."""

    def __init__(self):
        super().__init__("pump_control")
        self.declare_parameter("dry_below", 40.0)
        self.pump = self.create_publisher(Bool, "pump", LATCHED)
        self.create_subscription(Float32, "humidity", self.hear_humidity, 10)
        self.create_subscription(Bool, "vent", self.hear_vent, LATCHED)
        self.run_time = self.create_timer(5.0, self.stop)
        self.rest_time = self.create_timer(20.0, self.be_ready)
        self.state, self.vent_is_open = "ready", False

    def hear_humidity(self, msg):
        is_dry = msg.data < self.get_parameter("dry_below").value
        if self.state == "ready" and is_dry and not self.vent_is_open:
            self.state = "running"
            self.run_time.reset()
            self.pump.publish(Bool(data=True))

    def hear_vent(self, msg):
        self.vent_is_open = msg.data
        if msg.data:
            self.stop()

    def stop(self):
        if self.state == "running":
            self.state = "resting"
            self.rest_time.reset()
            self.pump.publish(Bool(data=False))

    def be_ready(self):
        if self.state == "resting":
            self.state = "ready"
# --- blank
# # class ____(Node):
# --- end

# %% exercise="13b"
# --- answer
class Watch(Node):
    """Says when a sensor falls silent, and when it is back."""

    def __init__(self):
        super().__init__("watch")
        self.alarms = self.create_publisher(String, "alarm", 10)
        self.last, self.silent = {}, set()
        for topic in ("humidity", "temperature"):
            self.last[topic] = self.get_clock().now()
            self.create_subscription(Float32, topic, self.hearing(topic), 10)
        self.create_timer(0.5, self.look)

    def hearing(self, topic):
        def hear(msg):
            self.last[topic] = self.get_clock().now()
            if topic in self.silent:
                self.silent.remove(topic)
                self.alarms.publish(String(data=f"{topic} back"))

        return hear

    def look(self):
        now = self.get_clock().now()
        for topic in sorted(set(self.last) - self.silent):
            if (now - self.last[topic]).nanoseconds >= 5e9:
                self.silent.add(topic)
                self.alarms.publish(String(data=f"{topic} silent"))
# --- blank
# # class ____(Node):
# --- end

# %% exercise="13b"
def greenhouse():
    # --- answer
    checked = {topic: f"checked/{topic}" for topic in ("temperature", "humidity")}
    start = {"remappings": checked}
    return [Guard, (VentControl, start), (PumpControl, start), (Reporter, start), Watch]
    # --- blank
    # return [____]
    # --- end

# %% check="13b"
check("13b", greenhouse)

# %% [markdown] only="solution"
# This is one greenhouse of many. It uses five nodes. `guard` keeps impossible readings away from three others, which
# don't need to know about it: their topics are remapped when they are started. `watch` subscribes to the sensors
# directly, because a sensor that sends an impossible reading isn't silent.

# %% only="solution"
ros = Session()
for sensor in weather("plain day"):
    ros.add(sensor)
for member in greenhouse():
    node, start = member if isinstance(member, tuple) else (member, {})
    ros.add(node, **start)
ros.run(seconds=171, quiet=True)
viz.graph(ros)

# %% [markdown]
# ## Two controllers, one vent
#
# It rains into the greenhouse, so somebody adds a node that closes the vent when the air is very humid, and changes
# nothing else. **Predict:** how many commands does the vent get in ten hot and humid seconds?

# %%
class HeatVent(Node):
    def __init__(self):
        super().__init__("heat_vent")
        self.vent = self.create_publisher(Bool, "vent", 10)
        self.create_subscription(Float32, "temperature", self.decide, 10)

    def decide(self, msg):
        self.vent.publish(Bool(data=msg.data > 28.0))

class RainVent(HeatVent):
    def __init__(self):
        Node.__init__(self, "rain_vent")
        self.vent = self.create_publisher(Bool, "vent", 10)
        self.create_subscription(Float32, "humidity", self.decide, 10)

    def decide(self, msg):
        if msg.data > 90.0:
            self.vent.publish(Bool(data=False))

# %% predict=true
ros = Session()
for sensor in weather(temperature=[31.0] * 10, humidity=[97.0] * 10):
    ros.add(sensor)
ros.add(HeatVent)
ros.add(RainVent)
ros.run(seconds=10)
# --- answer
predict("20", len(ros.messages("vent")))
# --- blank
# predict("____", len(ros.messages("vent")))
# --- end

# %% shows=true
viz.graph(ros)

# %% [markdown] answers=true
# **Symptom:** the vent opens and closes every second, and ends up closed on a hot day. Neither node has a fault of
# its own. **Where to look:** the graph, where two nodes publish on `vent`. **Cause:** a topic can have many
# publishers, and the vent obeys the last message; nothing decides between them. **Fix:** let one node decide. The
# others tell it what they want, on topics of their own.

# %% [markdown]
# ## Make it a package
#
# Nothing in your nodes depends on this page, so they can become programs, as on pages 02 to 06. Begin with a
# package of their own:

# %% terminal="build" shows=true
# cd "$ROS2_WORKSPACE/src"
# ros2 pkg create greenhouse --build-type ament_python --dependencies rclpy std_msgs

# %% [markdown] only="notebook"
# `--with` copies what you name from the cells above, and puts it below the imports. A file may contain several
# nodes; each of them needs a function that starts it. If your greenhouse has more nodes than `VentControl`, add
# their names to the first line, with those of your constants and helper functions, and a function for each node at
# the end. Add the imports that they need.

# %% [markdown] only="solution"
# `--with` copies what you name from the cells above, and puts it below the imports. A file may contain several nodes;
# each of them needs a function that starts it.

# %% save="src/greenhouse/greenhouse/nodes.py --with LATCHED VentControl" only="notebook"
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Bool, Float32, String


def run(node_class):
    rclpy.init()
    node = node_class()
    node.get_logger().info("ready")
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    node.destroy_node()
    rclpy.try_shutdown()


def vent_control():
    run(VentControl)

# %% save="src/greenhouse/greenhouse/nodes.py --with LATCHED VentControl Guard Reporter PumpControl Watch" only="solution"
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Bool, Float32, String


def run(node_class):
    rclpy.init()
    node = node_class()
    node.get_logger().info("ready")
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    node.destroy_node()
    rclpy.try_shutdown()


def vent_control():
    run(VentControl)


def guard():
    run(Guard)


def reporter():
    run(Reporter)


def pump_control():
    run(PumpControl)


def watch():
    run(Watch)

# %% [markdown]
# Each of these functions becomes a program through an entry point. The last line of `data_files` installs a launch
# file, which you'll write next. Do you have more functions? Then add a line for each, here and in the launch file.

# %% save="src/greenhouse/setup.py" only="notebook"
from setuptools import find_packages, setup

setup(
    name='greenhouse',
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/greenhouse']),
        ('share/greenhouse', ['package.xml']),
        ('share/greenhouse/launch', ['launch/greenhouse.launch.py']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='you',
    maintainer_email='you@example.com',
    description='Keeps a greenhouse neither too hot nor too dry.',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'vent_control = greenhouse.nodes:vent_control',
        ],
    },
)

# %% save="src/greenhouse/setup.py" only="solution"
from setuptools import find_packages, setup

setup(
    name='greenhouse',
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/greenhouse']),
        ('share/greenhouse', ['package.xml']),
        ('share/greenhouse/launch', ['launch/greenhouse.launch.py']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='you',
    maintainer_email='you@example.com',
    description='Keeps a greenhouse neither too hot nor too dry.',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'vent_control = greenhouse.nodes:vent_control',
            'guard = greenhouse.nodes:guard',
            'reporter = greenhouse.nodes:reporter',
            'pump_control = greenhouse.nodes:pump_control',
            'watch = greenhouse.nodes:watch',
        ],
    },
)

# %% [markdown]
# A [**launch file**](../docs/glossary.md#launch-file) says which programs to start, and how, in XML, YAML or, as here, in
# Python. The function `generate_launch_description` returns a `LaunchDescription`, which holds a list, as your function
# `greenhouse` does. Each item names a package and an executable, and can have the options from before, partly in
# another form: `parameters` is a list of dictionaries, and `remappings` a list of pairs. `Node` is another class
# here: it stands for a program to start.

# %% save="src/greenhouse/launch/greenhouse.launch.py" only="notebook"
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="greenhouse", executable="vent_control",
             parameters=[{"open_above": 27.0}]),
    ])

# %% save="src/greenhouse/launch/greenhouse.launch.py" only="solution"
from launch import LaunchDescription
from launch_ros.actions import Node

CHECKED = [(topic, f"checked/{topic}") for topic in ("temperature", "humidity")]


def generate_launch_description():
    return LaunchDescription([
        Node(package="greenhouse", executable="guard"),
        Node(package="greenhouse", executable="vent_control",
             parameters=[{"open_above": 27.0}], remappings=CHECKED),
        Node(package="greenhouse", executable="pump_control", remappings=CHECKED),
        Node(package="greenhouse", executable="reporter", remappings=CHECKED),
        Node(package="greenhouse", executable="watch"),
    ])

# %% terminal="build" shows=true
# cd "$ROS2_WORKSPACE"
# colcon build --packages-select greenhouse
# source install/setup.bash
# ros2 pkg executables greenhouse
# ls install/greenhouse/share/greenhouse/launch

# %% [markdown]
# The programs and the launch file are installed. In one terminal, `ros2 launch greenhouse greenhouse.launch.py` now
# starts the whole system, and `Ctrl` + `C` ends it. To watch one program at a time, you start each in a terminal of its
# own. The launch file's options become options of the command, after `--ros-args`: `-p` sets a parameter, and `-r`
# remaps a topic.

# %% terminal="vent --until ready" only="notebook"
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run greenhouse vent_control --ros-args -p open_above:=27.0

# %% terminal="guard --until ready" only="solution"
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run greenhouse guard

# %% terminal="vent --until ready" only="solution"
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run greenhouse vent_control --ros-args -p open_above:=27.0 -r temperature:=checked/temperature

# %% [markdown]
# Now for a sensor. `ros2 topic pub` publishes 27.5 degrees once a second. Does the vent open?

# %% terminal="sensor --until publishing" tags=["nbval-ignore-output"] shows=true
# ros2 topic pub --rate 1 /temperature std_msgs/msg/Float32 "{data: 27.5}"

# %% terminal="look" shows=true
# ros2 topic echo --once --qos-reliability reliable --qos-durability transient_local /vent

# %% [markdown]
# It does, because the parameter moved the limit to 27. `echo` asked for the last message that the publisher stores, so
# it doesn't matter which of them started first. Only the sensor is simulated now: if a driver publishes a `Float32` on
# `temperature` instead, no other node notices the difference.

# %% tags=["nbval-ignore-output"] shows=true
for name in ("sensor", "vent"):
    workspace.terminal(name).ctrl_c()

# %% terminal="guard --ctrl-c" only="solution" tags=["nbval-ignore-output"]

# %% [markdown]
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("13")

# %% only="solution"
quiz("13", "b", "c", "a")

# %% [markdown]
# ## Remember
#
# - First the interface, then the requirements, then the drawing, then the code.
# - One task per node, and for each device, such as the vent, one node that decides.
# - A silence doesn't trigger a callback: use a timer to detect it.
# - Check a reading before you believe it.
# - Test one requirement at a time, with a day made for it.
#
# **Next:** your own robot. The [documentation of ROS 2](https://docs.ros.org/en/jazzy/) continues where this course
# ends: with [launch files](https://docs.ros.org/en/jazzy/Tutorials/Intermediate/Launch/Launch-Main.html), and with
# [simulated robots](https://docs.ros.org/en/jazzy/Tutorials/Advanced/Simulators/Simulation-Main.html).

# %% shows=true
progress()
