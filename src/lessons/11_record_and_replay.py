# ---
# title: Record and replay
# minutes: 45
# needs: ["04", "07"]
# summary: Keep a run in a bag, play it again, break it on purpose, and write nodes that notice.
# ---

# %% [markdown]
# # Record and replay
#
# **After this page, you can:**
#
# - record a run in a bag, and read the messages in it (11a, 11.1);
# - replay a run to a node that you changed, and compare (11.2);
# - put faults into a replay, and write nodes that notice them (11b);
# - write a test that faulty nodes fail (11c);
# - handle NaN correctly (11.3).
#
# **Time:** 45 minutes. **You need:** [write a subscriber](04_write_a_subscriber.ipynb) and
# [look inside the graph](07_look_inside_the_graph.ipynb).
#
# A fault that occurred once, yesterday, on a robot, is hard to find. A fault that you can replay is much easier. This
# is what you'll build:
#
# ```text
# sensor ---> bag ---> replay ---> monitor
#                        ^
#                        faults, added by you
# ```

# %%
import math
import random

from rclpy.node import Node
from std_msgs.msg import Float32, String

viz.diagram("11")

# %% [markdown]
# ## Define both nodes
#
# The sensor comes from page 03 and the monitor from page 04. This time, the sensor doesn't log.

# %%
class TemperatureSensor(Node):
    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher_ = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(1.0, self.publish_temperature)
        self.temperature = 22.0

    def publish_temperature(self):
        self.temperature += random.uniform(-0.5, 0.5)
        self.temperature = max(10.2, min(28.0, self.temperature))
        self.publisher_.publish(Float32(data=self.temperature))

# %%
class TemperatureMonitor(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

    def temperature_callback(self, msg):
        temp = msg.data
        if temp > 26.0:
            status = "High"
        elif temp < 20.0:
            status = "Low"
        else:
            status = "Normal"
        self.get_logger().info(f"Temperature: {temp:.2f}C - Status:{status}")

# %% [markdown]
# ## Record a run
#
# In ROS, a recording is called a [**bag**](../docs/glossary.md#bag). It contains the messages of the recorded
# topics, each with its time. `bags.record` writes the messages of a session to a bag in your workspace.

# %%
first = Session(seed=8)
first.add(TemperatureSensor)
first.add(TemperatureMonitor)
first.run(seconds=300, quiet=True)

bag = bags.record(first, workspace.folder() / "resources/bags/first_run", keep_old=True)
bag

# %% [markdown]
# 300 messages on one topic, with their type, their publisher and its QoS profile. If you run the
# cell again, `keep_old=True` renames the older bag. The monitor's log lines aren't in the bag: by default, it contains
# only the topics that your own nodes use.
#
# A bag is a folder with two files. `ros2 bag info` reads it, too:

# %% terminal="bag" shows=true
# cd "$ROS2_WORKSPACE/resources/bags"
# ls first_run
# ros2 bag info first_run

# %% [markdown]
# `metadata.yaml` is a text file that describes what's in the bag. The messages are in the other file, in a format
# called **MCAP**, the default format of ROS 2 Jazzy. This file also contains the definition of `Float32`, so even a
# program that doesn't know this type can read it.
#
# `messages` returns the messages. Here is the first one, with its time in seconds and its value:

# %% shows=true
bag.messages("temperature")[0]

# %% [markdown]
# ## Replay it
#
# `bags.replay` creates a node that publishes a recording again, each message at its original time. The function below
# plays the bag to a monitor and returns the session.

# %%
def play(monitor, *faults):
    ros = Session()
    ros.add(bags.replay(bag, faults=faults))
    ros.add(monitor)
    ros.run(seconds=300, quiet=True)
    return ros

again = play(TemperatureMonitor)
viz.graph(again)

# %% [markdown]
# Another node has taken the sensor's place, and nothing in this session is random. **Predict:** does the
# monitor log the same 300 lines as in the first run?

# %% predict=true
# --- answer
predict("yes", again.logs() == first.logs())
# --- blank
# predict("____", again.logs() == first.logs())
# --- end

# %% [markdown] answers=true
# It does. A monitor can't tell the difference, because a subscriber knows the topic, but not its publishers.

# %% [markdown]
# ## Compare two runs
#
# `bags.compare` compares two runs message by message: first the bag with its replay, and then the bag with a new run
# that uses other random numbers.

# %% shows=true
bags.compare(bag, again, "temperature", names=("the bag", "the replay"))

# %%
other = Session(seed=9)
other.add(TemperatureSensor)
other.run(seconds=300)
seeds = bags.compare(bag, other, "temperature", names=("seed 8", "seed 9"))
viz.comparison(seeds, unit="°C")

# %% [markdown]
# A new run is a different experiment. If you change the *monitor*, replay the old run instead: then every difference
# comes from your change. Here, *High* begins at 25 degrees instead of 26. How many lines does that change?

# %%
class StrictMonitor(TemperatureMonitor):
    def temperature_callback(self, msg):
        status = "High" if msg.data > 25.0 else "Low" if msg.data < 20.0 else "Normal"
        self.get_logger().info(f"Temperature: {msg.data:.2f}C - Status:{status}")

strict = play(StrictMonitor)
sum(old.text != new.text for old, new in zip(first.logs(), strict.logs()))

# %% [markdown]
# Twelve: the readings between 25 and 26 degrees.
#
# ## Break it on purpose
#
# Sensors fail. You can add faults to the replay; the bag itself doesn't change. All times are in seconds:
#
# - `stuck`: the sensor hangs and repeats its last reading;
# - `dropouts`: messages get lost on the way, either some at random or all within a time span;
# - `drift`: the readings move away from the true value, by a fixed number of degrees per second;
# - `with_nan`: the reading is [**NaN**](../docs/glossary.md#nan), "not a number". NaN is the floating-point value
#   for an undefined result, and many drivers send it when a measurement fails.

# %%
sick = play(
    TemperatureMonitor,
    bags.stuck(at=60, seconds=50),
    bags.dropouts(spans=[(140, 170)]),
    bags.with_nan(at=200, seconds=20),
    bags.drift(0.05, at=230),
)
broken = bags.compare(bag, sick, "temperature", names=("the bag", "with faults"))
viz.comparison(broken, unit="°C")

# %% [markdown]
# From left to right, you see a flat line, rings where messages are missing, crosses for NaN, and a line that drifts
# away from the other one.
#
# Now the sensor sends nothing but NaN. **Predict:** which status does the monitor log: `High`, `Low` or `Normal`?

# %% predict=true
dead = play(TemperatureMonitor, bags.with_nan(at=0, seconds=None))
# --- answer
predict("Normal", dead.logs()[-1].text.split("Status:")[1])
# --- blank
# predict("____", dead.logs()[-1].text.split("Status:")[1])
# --- end

# %% [markdown] answers=true
# The monitor never complains. A hanging sensor looks perfectly healthy. A drift looks like weather. A lost
# message doesn't call any callback. And a dead sensor, which sends NaN for five minutes, is *Normal* all the time:
# `nan > 26.0` is false, `nan < 20.0` is false, and `else` gets everything that remains.

# %% [markdown]
# ## What went wrong: looking for NaN
#
# Somebody writes a monitor that only looks for NaN. How many of the 300 NaN readings does it notice?

# %%
class HopefulMonitor(TemperatureMonitor):
    def temperature_callback(self, msg):
        if msg.data == math.nan:
            self.get_logger().error("The sensor is broken.")

len(play(HopefulMonitor, bags.with_nan(at=0, seconds=None)).logs())

# %% [markdown]
# None of them. **Symptom:** a condition that is never true. **Where to look:** a replay with `with_nan`. **Cause:**
# `<`, `>` and `==` are false if either side is NaN, or both. **Fix:** `math.isnan(value)`.
#
# ## Try it: look into a bag
#
# Complete a function that receives a bag. It returns three facts about the topic `temperature`:
#
# - `messages`: how many messages there are, including NaN;
# - `gap`: the longest time between two consecutive messages, in seconds;
# - `mean`: the mean of all readings that are numbers.
#
# The check uses bags that you haven't seen.

# %% exercise="11a"
def look_into(bag):
    readings = bag.messages("temperature")
    # --- answer
    gaps = [later.time - one.time for one, later in zip(readings, readings[1:])]
    numbers = [one.value for one in readings if not math.isnan(one.value)]
    mean = sum(numbers) / len(numbers)
    return {"messages": len(readings), "gap": max(gaps), "mean": mean}
    # --- blank
    # return {"messages": ____, "gap": ____, "mean": ____}
    # --- end

# %% check="11a"
check("11a", look_into)

# %% [markdown]
# ## Try it: notice a faulty sensor
#
# This node publishes one word on `fault` for each of these events:
#
# - `nan`: for each reading that is NaN;
# - `jump`: for each reading that differs by more than 5 degrees from the last number before it;
# - `stuck`: when five readings in a row are exactly equal, at the fifth of them. It isn't published again until the
#   reading has changed.
#
# The very first reading is never a fault, unless it's NaN. After a NaN, the next reading is compared with the last
# number before it.

# %% exercise="11b"
class Watchdog(Node):
    def __init__(self):
        super().__init__("watchdog")
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.faults = self.create_publisher(String, "fault", 10)
        self.last = None  # the last number
        self.equal = 1  # how many in a row were equal to it

    def say(self, word):
        self.faults.publish(String(data=word))

    def listen(self, msg):
        # --- answer
        if math.isnan(msg.data):
            self.say("nan")
            return
        if self.last is not None and abs(msg.data - self.last) > 5.0:
            self.say("jump")
        self.equal = self.equal + 1 if msg.data == self.last else 1
        if self.equal == 5:
            self.say("stuck")
        self.last = msg.data
        # --- blank
        # ____
        # --- end

# %% check="11b"
check("11b", Watchdog)

# %% [markdown]
# ## Try it: test a watchdog
#
# These three watchdogs each have one fault. In everything else, they do what 11b asks for:
#
# | watchdog | its fault |
# |---|---|
# | A | it reports only jumps upwards |
# | B | it keeps NaN as the last number, so it compares the next reading with NaN |
# | C | once it has reported `stuck`, it does so again at each further equal reading |
#
# A list of readings is a test. A watchdog fails the test if it publishes anything other than a correct one does.
# Write a list of at most 12 readings, one a second, that all three watchdogs fail. For NaN, write `math.nan`.

# %% exercise="11c"
def readings():
    # --- answer
    return [22.0, 15.0, math.nan, 30.0, 30.0, 30.0, 30.0, 30.0, 30.0]
    # --- blank
    # return [____]
    # --- end

# %% check="11c"
check("11c", readings)

# %% [markdown]
# In a bag, such readings are a test that you can replay to every new version of a node. One fault remains: with a
# single sensor, no watchdog can recognize a drift. With a second sensor, it can compare the two.
#
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("11")

# %% only="solution"
quiz("11", "c", "b", "a")

# %% [markdown]
# ## Remember
#
# - A bag contains every message with its time; a replay publishes the messages again.
# - With the same recording, every difference comes from your change.
# - A recording with added faults is a test that you can keep.
# - NaN is neither above nor below nor equal to anything. Test for it with `math.isnan`.
#
# ## Outside this notebook
#
# In a terminal, these commands do the same, both in this course and in a full ROS 2 installation:
#
# ```bash
# ros2 bag record -o first_run --topics /temperature
# ros2 bag info first_run
# ros2 bag play first_run --rate 10
# ```
#
# Your bag has the format that these commands use: version 9 of rosbag2, as in Jazzy.
#
# **Next:** [beyond topics](12_beyond_topics.ipynb), where nodes ask questions and get answers.

# %% shows=true
progress()
