# ---
# title: Write a subscriber
# minutes: 90
# needs: ["00", "03"]
# summary: Build the temperature monitor: a subscription, a callback with three states, and what sets subscriber and publisher apart.
# ---

# %% [markdown]
# # Write a subscriber
#
# **After this page, you can:**
#
# - subscribe to a topic and act on each message (04a, 04.3);
# - write a node that subscribes and publishes (04b);
# - smooth readings, and keep a status from flickering by using two limits (04c, 04d, 04e);
# - predict what a queue keeps, and what a late subscriber receives (04.1, 04.2).
#
# **Time:** 90 minutes. **You need:** [write a publisher](03_write_a_publisher.ipynb).

# %%
import random
import signal

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32, String

viz.diagram("04")

# %% [markdown]
# Most of the imports are the same as the publisher's. A subscriber has to use the publisher's message type;
# otherwise, no messages arrive. You'll use `signal` and `String` further down.
#
# ## Bring a sensor
#
# To give the monitor something to listen to, here is the sensor from the last page, without its log lines.

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

# %% [markdown]
# ## Listen to a topic
#
# To subscribe, the constructor makes a single call. `create_subscription` takes four arguments:
#
# - `Float32`, the message type to expect;
# - `"temperature"`, the name of the topic;
# - `self.temperature_callback`, the **callback**: the method to call when a message arrives;
# - `10`, the queue depth: how many messages are kept while the node is busy.
#
# You never call the callback yourself. ROS calls it once for each message, and passes the message as `msg`. That's
# why the method has two parameters: `self` and the message.
#
# **Predict:** the listener first runs alone for five seconds; then a sensor joins for three. How many lines does the
# listener log?

# %% predict=true
class Listener(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.subscription = self.create_subscription(
            Float32, "temperature", self.temperature_callback, 10
        )

    def temperature_callback(self, msg):
        self.get_logger().info(f"I heard {msg.data:.2f}")

ros = Session(seed=8)
ros.add(Listener)
ros.run(seconds=5)
ros.add(TemperatureSensor)
ros.run(seconds=3)
# --- answer
predict("3", len(ros.logs()))
# --- blank
# predict("____", len(ros.logs()))
# --- end

# %% [markdown] answers=true
# Nothing for five seconds, then one line per second. A publisher is active: its timer drives it. A
# subscriber is passive: it **reacts**, and only a message makes it run. It doesn't keep asking whether there's
# anything new, and it doesn't matter that the sensor started later. Waiting costs almost nothing.

# %% [markdown]
# ## Judge the temperature
#
# The monitor reports *High* above 26 degrees, *Low* below 20, and *Normal* in between. This is the whole file, which
# `%%save` writes into your package. Its `main` is the sensor's `main` with another class in it: `rclpy.init`
# initializes ROS, `TemperatureMonitor()` creates the node, and `rclpy.spin` keeps the program running and calls the
# callback whenever a message arrives.

# %% save="src/sensor_simulator/sensor_simulator/temperature_subscriber.py"
#!/usr/bin/env python3
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float32


class TemperatureMonitor(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.subscription = self.create_subscription(
            Float32, "temperature", self.temperature_callback, 10
        )
        self.get_logger().info("Temperature Monitor Node Started")

    def temperature_callback(self, msg):
        temp = msg.data
        if temp > 26.0:
            status = "High"
        elif temp < 20.0:
            status = "Low"
        else:
            status = "Normal"
        self.get_logger().info(f"Temperature: {temp:.2f}C - Status:{status}")


def main(args=None):
    rclpy.init(args=args)
    node = TemperatureMonitor()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()

# %% [markdown]
# Read the callback from top to bottom:
#
# - `temp = msg.data` gets the number from the message;
# - Python tries `if`, `elif` and `else` in this order and takes the first branch that fits, so every number
#   gets exactly one status;
# - `>` and `<` exclude the limits themselves: exactly 26.0 is *Normal*, and so is exactly 20.0;
# - the last line logs the temperature with two decimals, and the status.
#
# Run the two nodes for four seconds with their log lines, and then without them, until ten minutes have passed. The
# picture shows the readings, with the three states as bands.

# %%
ros = Session(seed=8)
ros.add(TemperatureSensor)
ros.add(TemperatureMonitor)
ros.run(seconds=4)
ros.run(seconds=596, quiet=True)
limits = {"Low": (None, 20.0), "Normal": (20.0, 26.0), "High": (26.0, None)}
viz.values(ros, "temperature", bands=limits, unit="°C")

# %% [markdown]
# The first four readings are *Normal*. Near a limit, a small step is enough to change the status. When the
# temperature wanders around a limit, the status changes again and again: it flickers. *Low* begins below 20, so it
# would occur even with 18.0 as the sensor's lower limit.
#
# ## See the two together
#
# Here are the first three seconds on a timeline:

# %% shows=true
viz.timeline(ros, until=3)

# %% [markdown]
# Each tick of the sensor's timer sends a message, and the message triggers the monitor's callback. Neither node's code
# mentions the other. Any node that publishes a `Float32` on `temperature` would do, and a second monitor could join
# without any change to the sensor.
#
# ## Let messages wait
#
# What if the monitor is busy for a while? Its messages wait in a [**queue**](../docs/glossary.md#queue), and the 10
# in `create_subscription` is the length of that queue. The publisher's 10 belongs to another queue, at the
# publisher; messages for a busy callback wait in the subscriber's queue. `ros.pause` simulates the busy node: it
# takes no messages until `ros.resume`. Here is the listener again, which logs one line for each reading.
# `run(seconds=0)` handles what is waiting, without moving the clock.
#
# **Predict:** the listener is paused for 15 seconds while the sensor publishes once a second. How many readings does
# it get when it resumes?

# %% predict=true
ros = Session(seed=8)
ros.add(TemperatureSensor)
listener = ros.add(Listener)
ros.pause(listener)
ros.run(seconds=15)
ros.resume(listener)
ros.run(seconds=0)
# --- answer
predict("10", len(ros.logs()))
# --- blank
# predict("____", len(ros.logs()))
# --- end

# %% [markdown] answers=true
# Ten. In the picture of the queue, the numbers are readings, and time runs from left to right. In the first 15
# seconds, each column is one second. Then the listener resumes and takes ten readings at the same instant, one per
# column.

# %% shows=true
viz.queue(ros, "temperature")

# %% [markdown]
# When the queue is full, each new reading pushes out the oldest one. The depth is a number of messages, not a rate.
# The sensor never waits for anyone. It doesn't even notice that five readings were lost. For a temperature, that's
# fine: the newest readings matter most.
#
# ## Run the class as a program
#
# The tutorial's own `main` is shorter than yours: it doesn't destroy the node, doesn't shut ROS down, and handles
# only `KeyboardInterrupt`. Here it runs beside a sensor.
#
# **Predict:** what is its exit code after `Ctrl` + `C`?

# %% predict=true
def main(args=None):
    rclpy.init(args=args)
    node = TemperatureMonitor()

    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass

robot = Session(seed=8)
robot.add(TemperatureSensor)
program = robot.spawn(main)
robot.run(seconds=3)
program.send_signal(signal.SIGINT)
# --- answer
predict("0", program.returncode)
# --- blank
# predict("____", program.returncode)
# --- end

# %% [markdown] answers=true
# 0 means success: the program ends, and the operating system releases everything it used. Clean up all the same: in
# larger programs, it matters.

# %% [markdown]
# **How the data flows:** `main` creates the node, and the node creates its subscription. `rclpy.spin` waits.
# When a message arrives, the callback evaluates the temperature and logs the status. Then `spin` waits again, until
# you press `Ctrl` + `C`.
#
# ## Compare the two
#
# | | publisher | subscriber |
# |---|---|---|
# | what it does | sends data | receives data |
# | created with | `create_publisher()` | `create_subscription()` |
# | driven by | a timer: it's proactive | messages: it's reactive |
# | its method | is called by the timer, and calls `publish()` | is called by ROS with a message |
# | the data | is generated here | is processed here |
#
# A node can do both, as in most of the exercises on this page.
#
# ## Try it: watch a fridge
#
# A fridge has limits of its own. Above 8 degrees it's *Warm*, below 2 degrees it's *Frost*, and in between it's
# *Fine*. Exactly 8.0 and exactly 2.0 are still *Fine*. Write the decision: replace the whole line that has the
# blank with several lines of your own.

# %% exercise="04a"
class FridgeMonitor(Node):
    def __init__(self):
        super().__init__("fridge_monitor")
        self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

    def temperature_callback(self, msg):
        temp = msg.data
        # --- answer
        if temp > 8.0:
            status = "Warm"
        elif temp < 2.0:
            status = "Frost"
        else:
            status = "Fine"
        # --- blank
        # status = ____
        # --- end
        self.get_logger().info(f"Fridge: {temp:.2f}C - Status:{status}")

# %% check="04a"
check("04a", FridgeMonitor)

# %% [markdown]
# ## Try it: raise the alarm
#
# This node is in the middle: it subscribes to `temperature`, and for each reading above 26 or below 20 it publishes
# one `String` on the topic `alert`. The text is up to you. Other nodes can subscribe to `alert` without knowing any
# limits.

# %% exercise="04b"
class Alarm(Node):
    def __init__(self):
        super().__init__("alarm")
        self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
        # --- answer
        self.alerts = self.create_publisher(String, "alert", 10)
        # --- blank
        # self.alerts = ____
        # --- end

    def temperature_callback(self, msg):
        # --- answer
        if msg.data > 26.0 or msg.data < 20.0:
            self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))
        # --- blank
        # if ____:
        #     self.alerts.publish(____)
        # --- end

# %% check="04b"
check("04b", Alarm)

# %% [markdown]
# ## Try it: a calm monitor, in three steps
#
# Near a limit, the status flickers. In three steps, you'll write a monitor that stays calm. In the first step,
# write a node that listens to `temperature`. For each reading, it publishes the mean of the last five readings on
# the topic `mean`, as a `Float32`. While there are fewer than five, it's the mean of all of them. You'll need a
# callback, and a list that keeps the readings.

# %% exercise="04c"
class MeanMonitor(Node):
    def __init__(self):
        # --- answer
        super().__init__("calm_monitor")
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.means = self.create_publisher(Float32, "mean", 10)
        self.values = []

    def listen(self, msg):
        self.values = [*self.values, msg.data][-5:]
        self.means.publish(Float32(data=sum(self.values) / len(self.values)))
        # --- blank
        # ____
        # --- end

# %% check="04c"
check("04c", MeanMonitor)

# %% [markdown]
# Real monitors use two limits: one to enter a state, and another to leave it. This is called
# [**hysteresis**](../docs/glossary.md#hysteresis). In the second step, also publish the status on `status`, for each
# reading, as a `String`. The status begins as `Normal`, and follows the reading itself, not the mean: above 26 it is
# `High`, and below 20 it is `Low`, whatever it was before. From `High`, the status returns to `Normal` only below 25;
# from `Low`, only above 21.

# %% exercise="04d"
class StatusMonitor(Node):
    def __init__(self):
        # --- answer
        super().__init__("calm_monitor")
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.means = self.create_publisher(Float32, "mean", 10)
        self.statuses = self.create_publisher(String, "status", 10)
        self.values = []
        self.status = "Normal"

    def listen(self, msg):
        self.values = [*self.values, msg.data][-5:]
        self.means.publish(Float32(data=sum(self.values) / len(self.values)))

        self.status = self.judge(msg.data)
        self.statuses.publish(String(data=self.status))

    def judge(self, value):
        if value > 26.0:
            return "High"
        if value < 20.0:
            return "Low"
        still_high = self.status == "High" and value >= 25.0
        still_low = self.status == "Low" and value <= 21.0
        return self.status if still_high or still_low else "Normal"
        # --- blank
        # # Copy your lines from MeanMonitor, and add the status.
        # ____
        # --- end

# %% check="04d"
check("04d", StatusMonitor)

# %% [markdown]
# The status still comes once a second, although it rarely changes. In the last step, publish it only when it
# changes; the `Normal` that it begins with isn't a change. Keep publishing the mean for each reading.

# %% exercise="04e"
class CalmMonitor(Node):
    def __init__(self):
        # --- answer
        super().__init__("calm_monitor")
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.means = self.create_publisher(Float32, "mean", 10)
        self.statuses = self.create_publisher(String, "status", 10)
        self.values = []
        self.status = "Normal"

    def listen(self, msg):
        self.values = [*self.values, msg.data][-5:]
        self.means.publish(Float32(data=sum(self.values) / len(self.values)))

        status = self.judge(msg.data)
        if status != self.status:
            self.status = status
            self.statuses.publish(String(data=status))

    def judge(self, value):
        if value > 26.0:
            return "High"
        if value < 20.0:
            return "Low"
        still_high = self.status == "High" and value >= 25.0
        still_low = self.status == "Low" and value <= 21.0
        return self.status if still_high or still_low else "Normal"
        # --- blank
        # # Copy your lines from StatusMonitor, and publish changes only.
        # ____
        # --- end

# %% check="04e"
check("04e", CalmMonitor)

# %% [markdown]
# ## What went wrong: one pair of parentheses
#
# The line that subscribes has one pair of parentheses too many. When does this fail: at the first message, or before?

# %% tags=["raises-exception"]
class EagerMonitor(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.create_subscription(Float32, "temperature", self.temperature_callback(), 10)

    def temperature_callback(self, msg):
        self.get_logger().info(f"I heard {msg.data:.2f}")

ros.add(EagerMonitor)

# %% [markdown]
# **Symptom:** the constructor fails, before any message. **Where to look:** the line that the error
# names. **Cause:** the parentheses call the method at once, without a message, so Python reports that `msg` is
# missing. **Fix:** hand over the method itself, without parentheses.
#
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("04")

# %% only="solution"
quiz("04", "b", "c", "a")

# %% [markdown]
# ## Remember
#
# - `create_subscription(type, topic, callback, depth)` subscribes; ROS calls the callback.
# - `msg.data` gets the value from the message.
# - A queue keeps the newest messages for a slow subscriber, up to its depth.
# - A publisher acts, a subscriber reacts, and a node can do both.
#
# You now have both halves of a system, and neither knows about the other.
#
# **Next:** [set the entry points](05_set_the_entry_points.ipynb), so that `ros2 run` finds the two programs.

# %% shows=true
progress()
