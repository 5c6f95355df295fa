# ---
# title: Write a publisher
# minutes: 40
# needs: ["00", "02"]
# summary: Build the temperature sensor line by line: imports, node, publisher, timer, random walk, clamp, log and the script entry point.
# ---

# %% [markdown]
# # Write a publisher
#
# **Goal:** you write a node that plays a temperature sensor and publishes a new reading every
# second, and save it in your package.
#
# **Time:** 40 minutes. **You need:** [hear the heartbeat](00_hear_the_heartbeat.ipynb); a package
# to put the node into comes from [create a package](02_create_a_package.ipynb).
#
# On the way you meet every line of a real sensor node, from the imports to the last line that starts
# the program.

# %% [markdown]
# ## Import what you need
#
# A few imports do it:
#
# - `rclpy` is the ROS client library for Python: everything that talks to ROS goes through it;
# - `Node` is the class that every node builds on;
# - `Float32` is the message type: it carries one decimal number;
# - `random` comes with Python and will make the temperature wander;
# - `signal` does, too: further down it presses `Ctrl` + `C` for you.
#
# The last line brings the session, the pictures and the checks of this course, and the workspace, into
# which the node goes at the end. The file on a robot does not need them.

# %%
import random
import signal

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat import Session, check, hint, predict, progress, viz, workspace

# %% [markdown]
# ## Name the node
#
# A node is a class that inherits from `Node`. Its constructor, `__init__`, first calls the
# constructor of `Node` and gives it the node's name. Without that call the object is not a working
# node. `get_logger().info(...)` writes a line to the log; on a robot it appears in the terminal.

# %%
class QuietSensor(Node):
    def __init__(self):
        super().__init__("temperature_sensor")
        self.get_logger().info("Temperature Sensor Node Started")

# %% [markdown]
# **Predict:** what does this node say in ten seconds? (`with` closes the session at the end of the
# block.)

# %%
with Session() as ros:
    ros.add(QuietSensor)
    ros.run(seconds=10)

# %% [markdown]
# One line, and it comes from the constructor. A node does nothing by itself. It needs something that
# calls it. For a sensor, that is a timer.
#
# ## Publish on every tick
#
# Two lines in the constructor give the node a voice and a beat:
#
# - `create_publisher(Float32, "temperature", 10)` makes a publisher for one topic. The arguments are
#   the message type, the topic's name, and the **queue depth**: how many of its newest messages the
#   publisher keeps for delivery. The underscore in `publisher_` is only part of the name.
# - `create_timer(1.0, self.publish_temperature)` calls a method every 1.0 seconds. Notice that there
#   are no brackets after the method's name: you hand it over, and the timer calls it.

# %%
class SteadySensor(Node):
    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher_ = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(1.0, self.publish_temperature)
        self.temperature = 22.0

    def publish_temperature(self):
        msg = Float32()
        msg.data = self.temperature
        self.publisher_.publish(msg)

# %% [markdown]
# `self.temperature = 22.0` is where it starts: room temperature, in degrees Celsius. The method makes
# a new message, whose `data` is 0.0, puts the temperature in, and publishes it. The named parts of a
# message are its **fields**; `Float32` has just this one. `Float32(data=22.0)` makes and fills a
# message in one step.
#
# **Predict:** the timer starts at zero seconds. At which second does the first message come?

# %% predict=true
with Session() as ros:
    ros.add(SteadySensor)
    ros.run(seconds=4)
    readings = ros.messages("temperature")

print([(reading.time, reading.value) for reading in readings])
# --- answer
predict("1", readings[0].time)
# --- blank
# predict("____", readings[0].time)
# --- end

# %% [markdown]
# The first one comes after one full period, not at once. A timer waits first and calls then.
#
# ## Let the temperature wander
#
# A real sensor does not say the same thing every time. `random.uniform(-0.5, 0.5)` is a random number
# between -0.5 and +0.5, and `+=` adds it to the old value. A value that changes by small random steps
# makes a **random walk**.
#
# A random walk can go anywhere. So the tutorial that this course follows keeps it in a range with
# `max(10.2, min(28.0, ...))`. Read it from the inside out: `min` cuts off what is above 28, `max` cuts
# off what is below 10.2. This is called **clamping**.

# %%
class TemperatureSensor(Node):
    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher_ = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(1.0, self.publish_temperature)
        self.temperature = 22.0
        self.get_logger().info("Temperature Sensor Node Started")

    def publish_temperature(self):
        self.temperature += random.uniform(-0.5, 0.5)
        self.temperature = max(10.2, min(28.0, self.temperature))

        msg = Float32()
        msg.data = self.temperature
        self.publisher_.publish(msg)
        self.get_logger().info(f"Publishing: {self.temperature:.2f}C")

# %% [markdown]
# This is the complete sensor. The last line logs what was published. The `f` before the quotes puts
# values where the braces are, and `:.2f` writes a number with two decimals. The log is for people,
# the message is for nodes.

# %%
ros = Session(seed=8)
sensor = ros.add(TemperatureSensor)
ros.run(seconds=5)

# %% [markdown]
# Each reading is at most half a degree from the one before. `seed=8` picks the random numbers: with
# the same seed you get the same walk, today and tomorrow.
#
# **Predict:** how does a quarter of an hour look? Will the walk reach a limit?

# %%
ros.run(seconds=895, quiet=True)
viz.values(ros.observation(), "temperature", bands={"allowed": (10.2, 28.0)}, unit="°C")

# %% [markdown]
# The band is what the clamp allows, and the circles mark some of the readings. The walk meets the
# upper limit several times, and goes along it until a step leads away. It never comes near the lower
# one.
#
# What you see came out of real messages. Look at the last one, and at the node's own variable beside
# it:

# %%
ros.messages("temperature")[-1].value, sensor.temperature

# %% [markdown]
# They differ in the last digits. Python calculates with 64 bits, and a `Float32` carries 32. A
# subscriber gets the rounded number. This is no mistake: it is what the message type promises.
#
# ## Look at it from outside
#
# A publisher needs nobody. Here is the graph: a sensor, a topic, and no one on the other side yet.

# %%
viz.graph(ros.graph())

# %% [markdown]
# ## Turn the class into a program
#
# On a robot, the class has a file of its own, with a function `main`. The next cell has the tutorial's `main`,
# letter by letter:
#
# - `rclpy.init()` starts ROS in this process; it must come before the first node. `args` may hold
#   arguments from the command line;
# - the next line makes the node: it runs `__init__`;
# - `rclpy.spin(node)` waits for timers and messages and calls the callbacks, until it is stopped;
# - `Ctrl` + `C` raises `KeyboardInterrupt`. `main` catches it; `pass` does nothing;
# - at the end, `main` destroys the node and shuts ROS down.
#
# `spawn` starts a whole program in a session, as a process of its own. **Predict:** what do you see?

# %%
def main(args=None):
    rclpy.init(args=args)
    node = TemperaturSensor()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass

    node.destroy_node()
    rclpy.shutdown()

with Session(seed=8) as robot:
    robot.spawn(main)

# %% [markdown]
# A `NameError`. The tutorial spells its class in two ways, `TemperatureSensor` and `TemperaturSensor`, and
# Python compares names letter by letter, as ROS does with topics.
#
# The next cell gives the class its second name, too. After three seconds it presses `Ctrl` + `C`.
#
# **Predict:** what is the exit code?

# %% predict=true
TemperaturSensor = TemperatureSensor

with Session(seed=8) as robot:
    program = robot.spawn(main)
    robot.run(seconds=3)
    program.send_signal(signal.SIGINT)

# --- answer
predict("1", program.returncode, because="Its last line failed.")
# --- blank
# predict("____", program.returncode, because="Its last line failed.")
# --- end

# %% [markdown]
# `main` caught the `KeyboardInterrupt`, and then its last line failed. rclpy shuts ROS down itself when you press
# `Ctrl` + `C`, and a second `shutdown` is an error. `try_shutdown` shuts ROS down only if it still runs.
#
# There is one more way to end. When the system asks a program to stop, it sends the signal `SIGTERM`, and
# `spin` raises an `ExternalShutdownException`. So your `main` catches both exceptions.
#
# Here is the whole file. `%%save` writes it into your package and runs it.

# %% save="src/sensor_simulator/sensor_simulator/temperature_publisher.py"
#!/usr/bin/env python3
import random

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float32


class TemperatureSensor(Node):
    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher_ = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(1.0, self.publish_temperature)
        self.temperature = 22.0
        self.get_logger().info("Temperature Sensor Node Started")

    def publish_temperature(self):
        self.temperature += random.uniform(-0.5, 0.5)
        self.temperature = max(10.2, min(28.0, self.temperature))

        msg = Float32()
        msg.data = self.temperature
        self.publisher_.publish(msg)
        self.get_logger().info(f"Publishing: {self.temperature:.2f}C")


def main(args=None):
    rclpy.init(args=args)
    node = TemperatureSensor()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()

# %% [markdown]
# The very first line tells the system to run the file with Python 3. The last two lines start it: they call `main` if the file is run as a program, and not if it is imported, nor here:
# `main` would spin until you interrupt it. On a page, `ros.run(...)` does its work.
#
# **Predict:** how does the program in your file end?

# %% predict=true
file = workspace.folder() / "src/sensor_simulator/sensor_simulator/temperature_publisher.py"

with Session(seed=8) as robot:
    program = robot.spawn(file)
    robot.run(seconds=3)
    program.send_signal(signal.SIGINT)

# --- answer
predict("0", program.returncode)
# --- blank
# predict("____", program.returncode)
# --- end

# %% [markdown]
# The same numbers as before, and exit code 0. What you tried is what you will build. (The tutorial opens the
# file with `nano`, an editor. Here, a double click in the file browser does.)
#
# **How the data flows:** `main` starts ROS and makes the node. The node makes its publisher and its
# timer. Every second the timer calls `publish_temperature`, which takes a step, clamps it, publishes
# a message and logs a line. This goes on until `Ctrl` + `C`.
#
# ## Try it: another sensor
#
# Complete the constructor of a humidity sensor: it publishes `Float32` messages on the topic
# `humidity`, with a queue depth of 5, and calls `publish_humidity` twice a second.

# %% exercise="03a"
class HumiditySensor(Node):
    def __init__(self):
        super().__init__("humidity_sensor")
        # --- answer
        self.publisher_ = self.create_publisher(Float32, "humidity", 5)
        self.timer = self.create_timer(0.5, self.publish_humidity)
        # --- blank
        # self.publisher_ = self.create_publisher(____, ____, ____)
        # self.timer = self.create_timer(____, ____)
        # --- end

    def publish_humidity(self):
        self.publisher_.publish(Float32(data=45.0))

# %% check="03a"
check("03a", HumiditySensor)

# %% [markdown]
# ## Try it: a living room
#
# 10.2 degrees is cold for a room. It is probably a slip in the tutorial: 18.0 was meant. And in a
# room with thick walls the temperature moves slowly. Write the method yourself: take a random step
# of at most 0.3 degrees up or down, keep the temperature between 18.0 and 28.0, and publish it. Write
# the decimal points: a `Float32` wants a float, and 18 is an int. The last blank may become several
# lines.

# %% exercise="03b"
class RoomSensor(Node):
    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher_ = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(1.0, self.publish_temperature)
        self.temperature = 22.0

    def publish_temperature(self):
        # --- answer
        self.temperature += random.uniform(-0.3, 0.3)
        self.temperature = max(18.0, min(28.0, self.temperature))
        self.publisher_.publish(Float32(data=self.temperature))
        # --- blank
        # self.temperature += ____
        # self.temperature = ____
        # ____
        # --- end

# %% check="03b"
check("03b", RoomSensor)

# %% [markdown]
# ## Try it: a greenhouse, alone
#
# Now a node of your own, from the first line to the last. It is a sensor for a greenhouse where people
# count in degrees Fahrenheit. It
#
# - walks like the sensor of this page: it starts at 22.0 degrees Celsius, a step is at most 0.5 up or down,
#   and it stays between 10.2 and 28.0;
# - publishes in Fahrenheit, as a `Float32`: a number `c` in Celsius is `c * 9 / 5 + 32`;
# - uses the topic `greenhouse/temperature`, four times a second.
#
# All names inside are up to you, and you may add methods. If you are stuck, `hint("03c")` in a new cell helps.

# %% exercise="03c"
class GreenhouseSensor(Node):
    def __init__(self):
        # --- answer
        super().__init__("greenhouse_sensor")
        self.readings = self.create_publisher(Float32, "greenhouse/temperature", 10)
        self.create_timer(0.25, self.measure)
        self.celsius = 22.0

    def measure(self):
        step = random.uniform(-0.5, 0.5)
        self.celsius = min(28.0, max(10.2, self.celsius + step))
        self.readings.publish(Float32(data=self.celsius * 9 / 5 + 32))
        # --- blank
        # ____
        # --- end

# %% check="03c"
check("03c", GreenhouseSensor)

# %% [markdown]
# ## What went wrong: a number is not a message
#
# **Predict:** this sensor publishes the number itself. What happens at the first tick?

# %%
class HastySensor(SteadySensor):
    def publish_temperature(self):
        self.publisher_.publish(self.temperature)

with Session() as ros:
    ros.add(HastySensor)
    ros.run(seconds=3)

# %% [markdown]
# **Symptom:** a `TypeError`, and the node stops. **Instrument:** the error itself; it names the line,
# what was expected and what it got. **Cause:** a publisher sends messages of its type, and `22.0` is
# a plain Python number. **Cure:** make a `Float32` and put the number into its field `data`.
#
# ## Remember
#
# - `super().__init__("name")` makes the class a node.
# - `create_publisher(type, topic, depth)` makes a publisher; `publish(msg)` sends.
# - `create_timer(period, method)` calls the method once a period, first after one period.
# - `rclpy.init`, `rclpy.spin` and `try_shutdown` belong to the program around the node.
#
# The file `temperature_publisher.py` in your package holds this class, unchanged.
#
# **Next:** [write a subscriber](04_write_a_subscriber.ipynb) that listens to this sensor.

# %%
progress()
