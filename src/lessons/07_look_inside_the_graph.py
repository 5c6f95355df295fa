# ---
# title: Look inside the graph
# minutes: 45
# needs: ["00", "04", "06"]
# summary: Ask a running system what it is made of, with an instrument for each question: nodes, topics, rates, log lines, parameters.
# ---

# %% [markdown]
# # Look inside the graph
#
# **Goal:** you ask a running system that you did not write what it is made of, and find its fault.
#
# **Time:** 45 minutes. **You need:** [write a subscriber](04_write_a_subscriber.ipynb) and
# [build, source, run](06_build_source_run.ipynb).
#
# A greenhouse is running. Nobody shows you its code. But nodes hide little from those who ask, and there
# is an instrument for each question: *Who is there? What do they talk about, and how often? How are they
# set, and what do they say?*

# %%
import os

from rcl_interfaces.msg import Log
from rclpy.node import Node
from std_msgs.msg import Float32, String

from rosbeat import Session, check, hint, predict, progress, viz, workspace
from rosbeat.scenarios.stranger import greenhouse

# %%
ros = Session(domain_id=int(os.environ["ROS_DOMAIN_ID"]))
greenhouse(ros)
ros.start()
workspace.catch_up("07")

# %% [markdown]
# The session joins the domain of your terminals, `greenhouse` puts its nodes in, and `start` runs them in
# real time: from now on, terminals see them as they see any other nodes. The last line makes what earlier
# pages would have left in your workspace.
#
# ## Who is there?

# %% terminal="look"
# ros2 node list

# %% [markdown]
# Five nodes. Now start the sensor of your own package beside them. Its executable is called
# `temperature_publisher`. **Predict:** which name will the list show?

# %% terminal="sensor --until Publishing" tags=["nbval-ignore-output"]
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run sensor_simulator temperature_publisher

# %% terminal="look"
# ros2 node list
# ros2 topic list -t

# %% [markdown]
# `/temperature_sensor`: the name that the node gives itself. The graph knows nothing of executables or
# processes. Five of these nodes live in this page and one in a terminal, and the list does not tell.
#
# ## What do they talk about?
#
# `topic list -t` names the topics and their types. Every node brings two of them along: `/rosout`, which
# you meet below, and `/parameter_events`. A topic is in the list as soon as anybody *uses* it; a lonely
# subscriber is enough. So ask about one of them: `topic info` counts both sides, `interface show` prints
# what a type is made of, and `echo` shows real messages, with `--once` only one.

# %% terminal="look"
# ros2 topic info /temperature
# ros2 interface show std_msgs/msg/Float32
# ros2 topic echo --once /lights

# %% [markdown]
# Two publishers on `/temperature`! The weather station of the greenhouse uses that name, and so does your
# sensor. (`info --verbose` says who.) A message has one field, `data`, and the type carries a remark that
# it is for trying things out.
#
# ## How often?
#
# `hz` counts messages a second. It never ends by itself, so the cell watches until there are four lines.
# **Predict:** the weather station sends twice a second, your sensor once. What will it say?

# %% terminal="rate --until average --lines 4" tags=["nbval-ignore-output"]
# ros2 topic hz /temperature

# %% predict=true
rate = workspace.terminal("rate").text.split("average rate: ")[-1].split()[0]
for name in ("rate", "sensor"):
    workspace.terminal(name).ctrl_c(show=lambda line: None)

# --- answer
predict("3", round(float(rate)))
# --- blank
# predict("____", round(float(rate)))
# --- end

# %% [markdown]
# Three: `hz` measures what *arrives at its own ears*, from all publishers together. What was lost on the
# way is not counted, and on a silent topic `hz` is silent, too. The cell has also ended both programs.
#
# ## What does one node do?
#
# `node info` turns the question around: one node, and all that it has.

# %% terminal="look"
# ros2 node info /window

# %% [markdown]
# The window listens to `/temperature` and speaks on `/window_state`. A **service** answers questions;
# those in the list come with every node, and most of them are about parameters. (What clients and actions
# are stands on page 12.)
#
# ## How is it set?
#
# A **parameter** is a value of a node that has a name, and that others can read and change while the node
# runs.

# %% terminal="look"
# ros2 param list /window
# ros2 param get /window open_above
# ros2 topic echo --once /window_state

# %% [markdown]
# It opens above 25 degrees (*double* is a decimal number), and the weather station measures 23. (The other
# two parameters come with every node.) **Predict:** which of the next two commands counts, and what does
# the window say then?

# %% terminal="look"
# ros2 param set /window open_above 22
# ros2 param set /window open_above 22.0
# ros2 topic echo --once /window_state

# %% [markdown]
# A whole number is refused where a decimal one belongs. The second command counts at the next reading, and
# nobody has touched the code. The change lasts until the node ends.
#
# ## What do they say?
#
# Log lines are messages, too. Each node publishes its own on `/rosout`, with type `Log`: who speaks
# stands in the field `name`, what is said in `msg`, and how bad it is in `level`, a number: 10 `DEBUG`,
# 20 `INFO`, 30 `WARN`, 40 `ERROR`, 50 `FATAL`. So you can listen with `echo`: here only to warnings and
# worse (in the filter, `m` is the message), and of those only to one field.

# %% terminal="look"
# ros2 topic echo --once /rosout --filter "m.level >= 30" --field msg

# %% [markdown]
# Somebody has a problem. You will find out who.
#
# ## What an instrument cannot see
#
# | instrument | shows | does not show |
# |---|---|---|
# | `ros2 node list` | names | executables, processes, whether a node still does anything |
# | `ros2 topic list -t` | names, types | whether anybody publishes |
# | `ros2 topic info --verbose` | both sides | how long their queues are |
# | `ros2 topic echo` | values | who has sent them |
# | `ros2 topic hz` | what arrives here | what was lost |
# | `ros2 node info` | all that a node has | whether its callbacks run |
# | `ros2 param get` | a value | what the code does with it |
#
# The depth of a queue, for example, stays in the process that has the queue. A terminal is told nothing
# (`grep -E "a|b"` keeps the lines with either text); the session, in whose process these nodes live, knows.
# Each `end` is one subscription, and `qos` holds how it was made, with its depth:

# %% terminal="look"
# ros2 topic info --verbose /temperature | grep -E "name:|Depth"

# %%
for end in ros.graph().on("/temperature", "subscription"):
    print(end.node, "keeps", end.qos.depth)

# %% [markdown]
# ## Try it: a system of strangers
#
# Find out the rest. Type your questions into the terminal `look`, in new cells that begin with
# `%%terminal look`, and write what you find in place of the blanks: names in quotes, numbers without. You
# may check after each one. What does not end by itself gets a terminal of its own: `%%terminal rate --for 5`
# watches for five seconds, and `%terminal rate --ctrl-c` ends it.

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
# ## What went wrong: the lamp is in the dark
#
# If you have not found all of it, here it comes. **Symptom:** the lamp warns that it does not know how
# bright it is. It has a subscription, and nothing arrives. **Instrument:** `explain` puts all the others
# together. The whole text is long: `print(why)` shows it, and so does `rosbeat explain light` in a
# terminal.

# %%
why = ros.explain("light", seconds=1)
print(why.title)
print(why.diagnoses[0].evidence)
viz.graph(why)

# %% [markdown]
# **Cause:** one letter. **Cure:** the author mends the name of the topic. Until then, you can start the
# lamp with another name in its place, as `ros2 run` does with `-r light:=lights`. The code stays as it is.
# The new lamp takes the place of the old one. The cell shows what was logged, and waits until `explain` is
# content.

# %% tags=["nbval-ignore-output"]
(lamp,) = [node for node in ros.nodes if node.get_name() == "lamp"]
ros.add(type(lamp), remappings={"light": "lights"})
ros.wait(20, until=lambda: ros.explain("lights", seconds=1).is_well)

# %%
ros.explain("lights", seconds=1).is_well, [sample.value for sample in ros.messages("lights")[-3:]]

# %% [markdown]
# The lamp is not in the dark any more. (07a asks for the greenhouse as you found it; now somebody listens
# to `/lights`.)
#
# ## Try it: limits to turn
#
# In code, a parameter is **declared** in the constructor, with its name and its first value:
# `self.declare_parameter("open_above", 25.0)`. That value also decides about the type. Wherever the value
# is needed, `self.get_parameter("open_above").value` asks for it.
#
# This monitor publishes `High`, `Low` or `Normal` for each reading. Give it the parameters `low` and
# `high`, at first 20.0 and 26.0. What is set while it runs counts from the next reading on.

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
# Write a node that listens to `/rosout`. For each line that is a warning or worse, it publishes the name
# of whoever said it on the topic `warnings`, as a `String`. Each line counts, also of a name that was
# there before. The type `Log` is imported above, and `Log.WARN` is the number 30.
#
# Take care: your node's own log lines go over `/rosout`, too. If it logs each line that it hears, it hears
# itself, and never stops.

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
# ## See it all at once
#
# In JupyterLab, the next cell opens the **instrument panel** of the session: the graph, with a pulse on an
# arrow for each message, the values as curves, and the log lines of a node or from a level on. It also has
# controls: pause, stop and start a node, publish a value of your own, keep nodes busy, or lose messages on
# purpose. What does the window do when you publish 20 degrees? Where no browser can show the panel, it is a still picture.

# %%
ros.panel()

# %% [markdown]
# ## Remember
#
# - `ros2 node`, `ros2 topic`, `ros2 interface` and `ros2 param` ask a running system; it need not be yours.
# - A topic is listed as soon as anybody uses it, and `hz` counts what arrives here.
# - **Log lines** are messages on `/rosout`.
# - A **parameter** is declared once, and its value asked for wherever it is needed.
# - When a topic stays silent, `explain` compares both sides.
#
# All commands of this page work in any terminal of a robot, without a session. `rosbeat explain` comes
# with this course.
#
# **Next:** [tune quality of service](08_tune_quality_of_service.ipynb).

# %%
ros.close()
progress()
