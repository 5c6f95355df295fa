# ---
# title: Look inside the graph
# minutes: 45
# needs: ["00", "04", "06"]
# summary: Find out what a running system is made of, with a command for each question: nodes, topics, rates, log lines, parameters.
# ---

# %% [markdown]
# # Look inside the graph
#
# **After this page, you can:**
#
# - list the nodes, topics, types and rates of a running system (07a, 07.1, 07.2);
# - read and set parameters, and write a node that has them (07b, 07.3);
# - follow the log lines of all nodes (07c).
#
# **Time:** 45 minutes. **You need:** [write a subscriber](04_write_a_subscriber.ipynb) and
# [build, source, run](06_build_source_run.ipynb).
#
# A greenhouse is running, and you can't see its code. You don't need to: ROS 2 has a command for each question
# about a running system. *Which nodes are there? What do they publish, and how often? How are they configured, and
# what do they log?*

# %%
import os

from rcl_interfaces.msg import Log
from rclpy.node import Node
from std_msgs.msg import Float32, String

from rosbeat.ros.test_nodes import add_greenhouse

viz.diagram("07")

# %% shows=true
ros = Session(domain_id=int(os.environ["ROS_DOMAIN_ID"]))
add_greenhouse(ros)
ros.start()

# %% [markdown]
# The session joins the domain of your terminals. `add_greenhouse` adds its nodes to the session, and `start` runs them
# in real time. From now on, your terminals see these nodes like any others.
#
# ## Which nodes are running?
#
# First start the sensor from your own package as well. Its executable is called `temperature_publisher`. Which name
# will the list of nodes show for it?

# %% terminal="sensor --until Publishing" tags=["nbval-ignore-output"] shows=true
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run sensor_simulator temperature_publisher

# %% terminal="look" shows=true
# ros2 node list
# ros2 topic list -t

# %% [markdown]
# Six nodes, and yours is `/temperature_sensor`: the name that the node gives itself. The graph contains nodes, not
# executables or processes. Five of these nodes run on this page and one runs in a terminal, but the list doesn't tell
# you that. If the list shows more than six, something else is still running, such as a sensor that you left in a
# terminal on page 06: closing the tab of a terminal doesn't end it. The second icon on the left, *Running Terminals and
# Kernels*, does.
#
# ## Which topics do they use?
#
# `ros2 topic list -t` lists the topics with their types. Two of them come with every node: `/rosout`, which you'll
# meet below, and `/parameter_events`. A topic appears in the list as soon as any node *uses* it; a single
# subscriber is enough.
#
# To learn more about a topic, ask about it directly:
#
# - `ros2 topic info` counts its publishers and its subscriptions;
# - `ros2 interface show` prints the definition of its message type;
# - `ros2 topic echo` prints its messages. With `--once`, it prints one message and stops.

# %% terminal="look" shows=true
# ros2 topic info /temperature
# ros2 interface show std_msgs/msg/Float32
# ros2 topic echo --once /lights

# %% [markdown]
# Two publishers on `/temperature`! The weather station of the greenhouse publishes there, and so does your sensor.
# With `--verbose`, `ros2 topic info` names them both. The message has one field, `data`. The comments above it say
# that the type was only meant as an example.
#
# ## How often do messages arrive?
#
# `ros2 topic hz` measures how many messages arrive per second. It runs until you stop it, so the next cell only
# watches until it has printed four averages.
#
# The weather station publishes twice a second, and your sensor once. Which rate will it measure?

# %% terminal="rate --until average --lines 4" tags=["nbval-ignore-output"] shows=true
# ros2 topic hz /temperature

# %% [markdown]
# About three: the first averages come from few messages. `ros2 topic hz` measures the messages that *it* receives,
# from all publishers together. It doesn't count messages that were lost on the way, and while a topic is silent, it
# prints nothing. Stop both programs:

# %% terminal="rate --ctrl-c" tags=["nbval-ignore-output"] shows=true

# %% terminal="sensor --ctrl-c" tags=["nbval-ignore-output"] shows=true

# %% [markdown]
# ## What belongs to one node?
#
# `ros2 node info` looks at the graph from the other side: it lists everything that belongs to one node.

# %% terminal="look" shows=true
# ros2 node info /window

# %% [markdown]
# The window subscribes to `/temperature` and publishes on `/window_state`. It also has several services. A
# **service** answers requests. The services in this list come with every node, and most of them are about
# parameters. Page 12 covers clients and actions.
#
# ## How is it configured?
#
# A [**parameter**](../docs/glossary.md#parameter) is a named value of a node that others can read and change while
# the node is running.

# %% terminal="look" shows=true
# ros2 param list /window
# ros2 param get /window open_above
# ros2 topic echo --once /window_state

# %% [markdown]
# The window opens above 25 degrees, and the weather station measures 23. *Double* is the type of a decimal number.
# The other two parameters come with every node.
#
# The next cell sets the parameter twice. Which of the two commands takes effect, and what does the window publish then?

# %% terminal="look" shows=true
# ros2 param set /window open_above 22
# ros2 param set /window open_above 22.0
# ros2 topic echo --once /window_state

# %% [markdown]
# A decimal parameter doesn't accept a whole number, so the first command fails. The second one takes effect at the
# next reading, and nobody has touched the code. The new value lasts until the node ends.
#
# ## What do they log?
#
# Log lines are messages, too. Every node publishes its own on `/rosout`, with the message type `Log`. The field
# `name` names the logger, which is usually the node, and `msg` holds the text. `level` is a number that says how
# serious it is: 10 is `DEBUG`, 20 is `INFO`, 30 is `WARN`, 40 is `ERROR`, and 50 is `FATAL`.
#
# So `ros2 topic echo` can print log lines. In the next cell, `--filter` lets only warnings and worse through; in it,
# `m` stands for the message. `grep msg:` keeps only the line with the text.

# %% terminal="look" shows=true
# ros2 topic echo --once /rosout --filter "m.level >= 30" | grep msg:

# %% [markdown]
# One of the nodes has a problem. You'll find out which.
#
# ## What a command can't show you
#
# The depth of a queue is known only in the process that has the queue, so no command can show it. The greenhouse's
# nodes run in the process of the session, so the session knows. The next cell shows the subscriptions on a topic.
# `qos` holds the settings that each was created with, including the depth.

# %% shows=true
ros.graph().on("/temperature", "subscription")

# %% [markdown]
# ## Try it: a system of strangers
#
# Now find out the rest. Type your commands into the terminal `look`, in new cells that begin with `%%terminal
# look`. Replace the blanks with what you find: names in quotes, numbers without. The topics that every node brings,
# such as `/rosout`, don't count. You can run the check after each answer.
#
# A command that doesn't end by itself needs a terminal of its own: `%%terminal rate --for 5` watches it for five
# seconds, and `%terminal rate --ctrl-c` ends it.

# %% exercise="07a"
def findings():
    return {
        # --- answer
        "publisher of /moisture": "/soil_probe",
        "type of /moisture": "std_msgs/msg/Int32",
        "messages a second on /moisture": 5,
        "queue depth of /gardener for /moisture": 3,
        "topic without a listener": "/lights",
        "topic without a publisher": "/light",
        "node that warns": "/lamp",
        "dry_below of /gardener": 35,
        # --- blank
        # "publisher of /moisture": "____",
        # "type of /moisture": "____",
        # "messages a second on /moisture": "____",
        # "queue depth of /gardener for /moisture": "____",
        # "topic without a listener": "____",
        # "topic without a publisher": "____",
        # "node that warns": "____",
        # "dry_below of /gardener": "____",
        # --- end
    }

# %% check="07a"
check("07a", findings)

# %% [markdown]
# ## What went wrong: the lamp gets no readings
#
# If you haven't found everything yet, this section gives some of the answers away.
#
# **Symptom:** the lamp warns that it doesn't know how bright it is. It has a subscription, but nothing arrives.
# **Where to look:** `explain` combines what all the other commands show. Here is its picture;
# `rosbeat explain light` prints its text in a terminal.

# %% shows=true
viz.graph(ros.explain("light"))

# %% [markdown]
# **Cause:** the two names differ in one letter. **Fix:** the author corrects the name of the topic. Until then, you
# can **remap** it: start the lamp with another topic name in place of the one in its code. With `ros2 run`, the
# options `--ros-args -r light:=lights` do that.
#
# ## Try it: limits that you can set
#
# In code, you **declare** a parameter in the constructor, with its name and its default value:
# `self.declare_parameter("open_above", 25.0)`. The default value also determines the type. Wherever you need the
# current value, `self.get_parameter("open_above").value` returns it.
#
# This monitor publishes `High`, `Low` or `Normal` for each reading. Give it the parameters `low` and `high`, with
# the default values 20.0 and 26.0. A value that is set while the node runs takes effect from the next reading on.

# %% exercise="07b"
class TunableMonitor(Node):
    def __init__(self):
        super().__init__("tunable_monitor")
        # --- answer
        self.declare_parameter("low", 20.0)
        self.declare_parameter("high", 26.0)
        # --- blank
        # ____
        # --- end
        self.statuses = self.create_publisher(String, "status", 10)
        self.create_subscription(Float32, "temperature", self.listen, 10)

    def listen(self, msg):
        # --- answer
        low = self.get_parameter("low").value
        high = self.get_parameter("high").value
        # --- blank
        # low = ____
        # high = ____
        # --- end
        status = "High" if msg.data > high else "Low" if msg.data < low else "Normal"
        self.statuses.publish(String(data=status))

# %% check="07b"
check("07b", TunableMonitor)

# %% [markdown]
# ## Try it: a log watcher
#
# Write a node that subscribes to `/rosout`. For each line that is a warning or worse, it publishes a `String` on
# the topic `warnings`: the message's field `name`, exactly as it is. Every such line counts, even if the same name has
# been published before. The type `Log` is imported above, and `Log.WARN` is the number 30.
#
# Be careful: your node's own log lines go to `/rosout`, too. If it logs every line that it hears, it hears itself
# and never stops.

# %% exercise="07c"
class LogWatcher(Node):
    def __init__(self):
        # --- answer
        super().__init__("log_watcher")
        self.names = self.create_publisher(String, "warnings", 10)
        self.create_subscription(Log, "/rosout", self.hear, 10)

    def hear(self, msg):
        if msg.level >= Log.WARN:
            self.names.publish(String(data=msg.name))
        # --- blank
        # ____
        # --- end

# %% check="07c"
check("07c", LogWatcher)

# %% [markdown]
# ## Watch everything at once
#
# In JupyterLab, the next cell opens the **instrument panel** of the session. It shows the graph, with a pulse on an
# arrow for each message, the values as curves, and the log lines. You can filter the log lines by node and by
# level.
#
# The panel also has controls: you can pause, stop and start a node, publish a value of your own, keep nodes busy,
# or lose messages on purpose. For example, publish 20 degrees on `/temperature`: the window shuts, until the weather
# station's next reading opens it again. Where no browser can show the panel, you see a still picture instead.

# %% shows=true
ros.panel()

# %% [markdown]
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("07")

# %% only="solution"
quiz("07", "c", "a", "b")

# %% [markdown]
# ## Remember
#
# - `ros2 node`, `ros2 topic`, `ros2 interface` and `ros2 param` examine any running system, not only your own.
# - A topic is listed as soon as any node uses it. `ros2 topic hz` measures the messages that it receives.
# - **Log lines** are messages on `/rosout`.
# - A **parameter** is declared once. Get its value wherever you need it.
# - When a topic stays silent, `explain` compares both sides.
#
# All `ros2` commands on this page work in any terminal of a robot, without a session. `rosbeat explain` comes with
# this course.
#
# **Next:** [tune quality of service](08_tune_quality_of_service.ipynb).

# %% shows=true
progress()
