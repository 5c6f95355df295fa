# ---
# title: Write a subscriber
# minutes: 40
# needs: ["00", "03"]
# summary: Build the temperature monitor: a subscription, a callback with three states, and what sets subscriber and publisher apart.
# ---

# %% [markdown]
# # Write a subscriber
#
# **Goal:** you write a node that listens to the temperature sensor and says whether the room is too
# hot, too cold or just right.
#
# **Time:** 40 minutes. **You need:** [write a publisher](03_write_a_publisher.ipynb).

# %%
import random
import signal

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32, String

from rosbeat import Session, check, hint, predict, progress, viz, workspace
from rosbeat.records import queue_steps

# %% [markdown]
# The first lines are the publisher's. A subscriber must use the message type that the publisher uses,
# or the two sides do not understand each other. In a file of its own the monitor needs no `random`;
# here the sensor does. `signal`, `String` and `queue_steps` are used further down.
#
# ## Bring a sensor
#
# To have something to listen to, here is the sensor of the last page, without its log lines.

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
# One call in the constructor does it. `create_subscription` takes four arguments:
#
# - `Float32`, the type of message to expect;
# - `"temperature"`, the name of the topic;
# - `self.temperature_callback`, the **callback**: the method to call when a message arrives;
# - `10`, the queue depth: how many messages are kept while the node is busy.
#
# You never call the callback yourself. ROS calls it, once for each message, and hands the message
# over as `msg`. So this method has two parameters: `self` and the message.

# %%
class Listener(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.subscription = self.create_subscription(
            Float32, "temperature", self.temperature_callback, 10
        )

    def temperature_callback(self, msg):
        self.get_logger().info(f"I heard {msg.data:.2f}")

# %% [markdown]
# **Predict:** first the listener runs alone for five seconds, then a sensor joins for three. What
# is logged, and when?

# %%
with Session(seed=8) as ros:
    ros.add(Listener)
    ros.run(seconds=5)
    ros.add(TemperatureSensor)
    ros.run(seconds=3)

# %% [markdown]
# Nothing for five seconds, then one line a second. A publisher acts: its timer drives it. A
# subscriber is passive: it **reacts**, and only a message wakes it. It does not ask whether there is
# something new, and it does not mind that the sensor came after it. Waiting costs almost nothing.
#
# ## Judge what you hear
#
# The monitor says *High* above 26 degrees, *Low* below 20, and *Normal* in between.

# %%
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

# %% [markdown]
# This is the complete monitor. Read the callback from top to bottom:
#
# - `temp = msg.data` takes the number out of the message;
# - `if`, `elif` and `else` are tried in this order, and the first that fits wins, so every number
#   gets exactly one status;
# - `>` and `<` leave the limits themselves out: exactly 26.0 is *Normal*, and so is exactly 20.0;
# - the last line reports what was found, with two decimals.

# %%
ros = Session(seed=8)
ros.add(TemperatureSensor)
ros.add(TemperatureMonitor)
ros.run(seconds=4)

# %% [markdown]
# Four readings, four times *Normal*. Now count the words over ten minutes, and draw the readings with
# the three states as bands. `status_of` cuts the word out of a log line; you need not read it closely.

# %%
ros.run(seconds=596, quiet=True)

def status_of(line):
    return line.text.split("Status:")[-1]

lines = ros.logs("temperature_monitor")[1:]
statuses = [status_of(line) for line in lines]
{word: statuses.count(word) for word in ("Low", "Normal", "High")}

# %%
limits = {"Low": (None, 20.0), "Normal": (20.0, 26.0), "High": (26.0, None)}
viz.values(ros.observation(), "temperature", bands=limits, unit="°C")

# %% [markdown]
# Near a border, a small step is enough to change the status. *Low* would happen too if the sensor's
# lower limit were 18.0, as was probably meant: it begins below 20.
#
# **Predict:** how often does the status change in these ten minutes? Roughly is good enough.

# %% predict=true
changes = sum(a != b for a, b in zip(statuses, statuses[1:]))
# --- answer
predict("26", changes, tolerance=5)
# --- blank
# predict("____", changes, tolerance=5)
# --- end

# %% [markdown]
# 26 changes, for a line that crosses a border only a few times for good. Most of them come in groups:
# the status flickers.
#
# ## See the two together
#
# In the graph, sensor and monitor stand on the two sides of one topic. A second monitor would be one
# more ellipse on the right, and the sensor would not change.

# %%
viz.graph(ros.graph())

# %%
viz.timeline(ros.observation(), until=3)

# %% [markdown]
# Each tick of the sensor's timer sends a message, and the message starts the monitor's callback.
# Neither node's code mentions the other. Any node that publishes a `Float32` on `temperature` would do.
#
# ## Let messages wait
#
# What if the monitor is busy for a while? Its messages wait in a **queue**. The 10 in
# `create_subscription` is the length of that queue. (The publisher's 10 is another queue; a busy
# callback fills the subscriber's.) `ros.pause` plays the busy node: it takes no messages until
# `ros.resume`. The last lines of the cell only count.
#
# **Predict:** the monitor is paused for 15 seconds while the sensor publishes once a second. How
# many readings does it get when it comes back?

# %% predict=true
with Session(seed=8) as ros:
    ros.add(TemperatureSensor)
    ros.add(TemperatureMonitor)
    ros.pause("temperature_monitor")
    ros.run(seconds=15)
    ros.resume("temperature_monitor")
    ros.run(seconds=0, quiet=True)
    waited = len(ros.logs("temperature_monitor")) - 1
    seen = ros.observation()

# --- answer
predict("10", waited)
# --- blank
# predict("____", waited)
# --- end

# %% [markdown]
# Ten. The picture shows the queue. The numbers are readings, and time runs to the right: up to 15
# seconds, each column is one second. Then the monitor is back and takes ten readings at once, one
# column each.

# %%
arrivals = [sample.time_ns for sample in seen.samples]
takes = [call.time_ns for call in seen.callbacks if call.kind == "subscription"]
viz.queue(queue_steps(arrivals, takes, depth=10), depth=10)

# %% [markdown]
# When the queue is full, each new reading pushes the oldest one out. So the depth has nothing to do
# with ten messages per second, and the sensor never waits for anybody. It does not even know that
# five readings were lost. For a temperature that is fine: the newest readings matter most.
#
# ## Turn the class into a program
#
# The monitor's `main` is the sensor's, with another class in it. `rclpy.init` starts ROS,
# `TemperatureMonitor()` makes the node, and `rclpy.spin` keeps the program alive and calls the
# callback whenever a message has arrived. The whole file goes into your package:

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
# The tutorial's own `main` leaves out two lines: it neither destroys the node nor shuts ROS down. Here it is,
# beside a sensor.
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

with Session(seed=8) as robot:
    robot.add(TemperatureSensor)
    program = robot.spawn(main)
    robot.run(seconds=3)
    program.send_signal(signal.SIGINT)

# --- answer
predict("0", program.returncode)
# --- blank
# predict("____", program.returncode)
# --- end

# %% [markdown]
# The program ends, and the system takes back what it held. Tidy up all the same: sometimes it matters.
#
# **How the data flows:** `main` makes the node, and the node its subscription. `rclpy.spin` waits.
# A message arrives, the callback judges its number and logs the status, and the waiting goes on until
# `Ctrl` + `C`.
#
# ## Compare the two
#
# | | publisher | subscriber |
# |---|---|---|
# | what it does | sends data | receives data |
# | made with | `create_publisher()` | `create_subscription()` |
# | driven by | a timer: it acts | a message: it reacts |
# | its method | is called by the timer and calls `publish()` | is called by ROS with a message |
# | the data | is made here | is used here |
#
# A node may do both, as in the last two exercises.
#
# ## Try it: watch a fridge
#
# A fridge has limits of its own. Above 8 degrees it is *Warm*, below 2 degrees it is *Frost*, and in
# between all is *Fine*. Exactly 8.0 and exactly 2.0 are still *Fine*. Write the decision; it may
# take more lines than the blank.

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
# This node sits in the middle: it listens to `temperature` and publishes a `String` on the topic
# `alert`, but only if a reading is above 26 or below 20. What the text says is up to you. Other nodes
# can listen to `alert` and need not know any limit.

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
# ## Try it: a calm monitor, alone
#
# Near a border, the status flickers. So real monitors have two borders: one to go over, and another to come
# back. This is called **hysteresis**. Write a node that listens to `temperature` and publishes
#
# - on `mean`, for each reading, the mean of the last five readings, as a `Float32` (of those that there are,
#   while there are fewer);
# - on `status`, as a `String`, the status, but only when it changes. It begins as `Normal`.
#
# A reading above 26 is `High` and one below 20 is `Low`, whatever was before. From `High` it goes back to
# `Normal` only below 25, from `Low` only above 21.

# %% exercise="04c"
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
        # ____
        # --- end

# %% check="04c"
check("04c", CalmMonitor)

# %% [markdown]
# ## What went wrong: the callback is called too early
#
# Two small brackets too many, in the line that subscribes. **Predict:** when does this fail: at the
# first message, or before?

# %%
class EagerMonitor(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.create_subscription(Float32, "temperature", self.temperature_callback(), 10)

    def temperature_callback(self, msg):
        self.get_logger().info(f"I heard {msg.data:.2f}")

# %% tags=["raises-exception"]
with Session() as ros:
    ros.add(EagerMonitor)

# %% [markdown]
# **Symptom:** the constructor fails, before any message. **Instrument:** the line that the error
# names. **Cause:** the brackets call the method at once, without a message, so Python misses `msg`.
# **Cure:** hand over the method itself, without brackets.
#
# ## Remember
#
# - `create_subscription(type, topic, callback, depth)` listens; ROS calls the callback.
# - `msg.data` takes the value out of the message.
# - A queue keeps the newest messages for a slow subscriber, as many as its depth.
# - A publisher acts, a subscriber reacts, and a node may do both.
#
# The file `temperature_subscriber.py` in your package holds this class, unchanged. You now have both
# halves of a system, and neither knows the other.
#
# **Next:** [set the entry points](05_set_the_entry_points.ipynb), so that `ros2 run` finds them.

# %%
progress()
