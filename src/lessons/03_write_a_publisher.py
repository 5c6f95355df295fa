# ---
# title: Write a publisher
# minutes: 60
# needs: ["00", "02"]
# summary: Build the temperature sensor line by line: imports, node, publisher, timer, random walk, clamp, log and the script entry point.
# ---

# %% [markdown]
# # Write a publisher
#
# **After this page, you can:**
#
# - publish readings at a steady rate with a timer (03a, 03.1);
# - simulate a sensor with a clamped random walk (03b);
# - write a whole publisher, and turn it into a program (03c, 03.3);
# - explain why a subscriber sees slightly different digits from the publisher (03.2).
#
# **Time:** 60 minutes. **You need:** [hear the heartbeat](00_hear_the_heartbeat.ipynb). To save the node into a
# package, you also need [create a package](02_create_a_package.ipynb).
#
# ## Import what you need
#
# The imports come first:
#
# - `rclpy` is the ROS client library for Python. It connects your code to ROS;
# - `Node` is the base class of every node;
# - `Float32` is the message type: it carries one decimal number;
# - `random` is part of Python. It makes the temperature fluctuate;
# - `signal` is part of Python, too. Further down, you'll use it to interrupt a program.
#
# A robot's file begins with the same imports: nothing here belongs to the course.

# %%
import random
import signal

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32

viz.diagram("03")

# %% [markdown]
# ## Name the node
#
# A node is a class that inherits from `Node`. Its constructor, `__init__`, starts by calling the
# constructor of `Node` with the node's name. Without that call, the object isn't a working
# node. `get_logger().info(...)` writes a line to the log; on a robot, it appears in the terminal.

# %%
class QuietSensor(Node):
    def __init__(self):
        super().__init__("temperature_sensor")
        self.get_logger().info("Temperature Sensor Node Started")

# %% [markdown]
# **Predict:** how many lines does this node log in ten seconds?

# %% predict=true
ros = Session()
ros.add(QuietSensor)
ros.run(seconds=10)
# --- answer
predict("1", len(ros.logs()))
# --- blank
# predict("____", len(ros.logs()))
# --- end

# %% [markdown] answers=true
# One line, and it comes from the constructor. A node does nothing on its own: something has to call its methods. For
# a sensor, that's a timer.

# %% [markdown]
# ## Publish on every tick
#
# Two calls in the constructor turn the node into a sensor that publishes regularly. Strictly speaking, a node *has*
# publishers, but people often call a node with one a publisher, too.
#
# - `create_publisher(Float32, "temperature", 10)` creates a publisher for one topic. The arguments are
#   the message type, the topic's name, and the **queue depth**: how many of the newest messages the
#   publisher keeps for delivery. The underscore in `publisher_` is just part of the name;
# - `create_timer(1.0, self.publish_temperature)` calls a method every 1.0 seconds. Notice that there
#   are no parentheses after the method's name: you hand over the method itself, and the timer calls it.

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
# `self.temperature = 22.0` is the initial value: room temperature, in degrees Celsius. The method creates a new
# message, whose `data` is 0.0 at first, sets `data` to the temperature, and publishes the message. The named parts
# of a message are its [**fields**](../docs/glossary.md#field); `Float32` has only this one. `Float32(data=22.0)`
# creates and fills a message in one step.
#
# **Predict:** the timer starts at zero seconds. How many messages are published in the first half second?

# %% predict=true
ros = Session()
ros.add(SteadySensor)
ros.run(seconds=0.5)
# --- answer
predict("0", len(ros.messages("temperature")))
# --- blank
# predict("____", len(ros.messages("temperature")))
# --- end

# %% [markdown] answers=true
# None. A timer waits for one full period first, and then calls: the first message comes at 1 second.

# %% [markdown]
# ## Let the temperature fluctuate
#
# A real sensor doesn't report the same value every time. `random.uniform(-0.5, 0.5)` returns a random number
# between -0.5 and +0.5, and `+=` adds it to the old value. A value that changes by small random steps is called
# a [**random walk**](../docs/glossary.md#random-walk).
#
# A random walk can drift anywhere, so the tutorial that this course follows limits it to a range:
# `max(10.2, min(28.0, ...))`. Read it from the inside out: `min` returns 28 for anything above 28, and `max` returns
# 10.2 for anything below 10.2. This is called [**clamping**](../docs/glossary.md#clamping).

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
# This is the complete sensor. Its last line logs what it published. The `f` before the quotes inserts
# values where the braces are, and `:.2f` formats a number with two decimals.
#
# Run it for five seconds with its log lines, and then without them, until a quarter of an hour has passed. `seed=8`
# is the [**seed**](../docs/glossary.md#seed): it selects the sequence of random numbers, and the same seed always gives
# the same walk.

# %% shows=true
ros = Session(seed=8)
sensor = ros.add(TemperatureSensor)
ros.run(seconds=5)
ros.run(seconds=895, quiet=True)
viz.values(ros, "temperature", bands={"allowed": (10.2, 28.0)}, unit="°C")

# %% [markdown]
# Each reading is at most half a degree away from the one before. The band shows the range that the clamp allows, and
# the line connects the readings. The walk reaches the upper limit several times, and follows it until a step leads
# back down. It never comes close to the lower limit.
#
# A session keeps a record of each message: when it was sent, on which topic, by which node, and its value. Compare the
# last record with the node's own variable:

# %% shows=true
ros.messages("temperature")[-1], sensor.temperature

# %% [markdown]
# They differ in the last digits. Python calculates with 64 bits, but a `Float32` carries only 32, so subscribers
# receive a rounded number.
#
# ## Turn the class into a program
#
# On a robot, the class is in a file of its own, together with a function called `main`. The next cell contains the
# tutorial's `main`, letter for letter:
#
# - `rclpy.init()` initializes ROS in this process. It has to run before you create the first node. `args` can hold
#   arguments from the command line;
# - the next line creates the node, which runs `__init__`;
# - `rclpy.spin(node)` waits for timers and messages and calls the callbacks, until the program is stopped;
# - `Ctrl` + `C` raises `KeyboardInterrupt`. `main` catches it, and `pass` does nothing;
# - finally, `main` destroys the node and shuts ROS down.
#
# `spawn` starts a whole program in a session, as a process of its own.

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

robot = Session(seed=8)
robot.spawn(main)

# %% [markdown]
# A `NameError`. The tutorial spells its class in two ways, `TemperatureSensor` and `TemperaturSensor`. Python
# compares names letter by letter, just as ROS compares topics.
#
# The next cell gives the class its second name as well. After three seconds, it sends the program the signal `SIGINT`,
# as the terminal does when you press `Ctrl` + `C`.
#
# **Predict:** what is the exit code?

# %% predict=true
TemperaturSensor = TemperatureSensor

program = robot.spawn(main)
robot.run(seconds=3)
program.send_signal(signal.SIGINT)
# --- answer
predict("1", program.returncode)
# --- blank
# predict("____", program.returncode)
# --- end

# %% [markdown] answers=true
# `main` caught the `KeyboardInterrupt`, but then its last line failed. When you press `Ctrl` + `C`, rclpy shuts ROS
# down itself, and a second `shutdown` is an error. `try_shutdown` shuts ROS down only if it's still running.

# %% [markdown]
# The operating system can also stop a program with the signal `SIGTERM`. In that case, `spin` raises an
# `ExternalShutdownException`. Your own `main` catches both exceptions.
#
# Here is the whole file. `%%save` writes it into your package, and also runs its code here.

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
# The very first line tells the system to run the file with Python 3. The last two lines call `main` if the file is
# run as a program, but not if it's imported. On this page, `%%save` leaves that call out, because `main` would spin
# until you interrupt it.
#
# On this page, `main` is now the one from your file. **Predict:** what is the exit code of the program this time?

# %% predict=true
robot = Session(seed=8)
program = robot.spawn(main)
robot.run(seconds=3)
program.send_signal(signal.SIGINT)
# --- answer
predict("0", program.returncode)
# --- blank
# predict("____", program.returncode)
# --- end

# %% [markdown] answers=true
# The numbers are the same as before, and the exit code is 0. The tutorial edits the file with `nano`, an editor;
# here, you can double-click the file in the file browser.

# %% [markdown]
# **How the data flows:** `main` initializes ROS and creates the node. The node creates its publisher and its
# timer. Every second, the timer calls `publish_temperature`, which takes a random step, clamps the temperature,
# publishes a message and logs a line. This continues until you press `Ctrl` + `C`.
#
# ## Try it: another sensor
#
# Complete the constructor of a humidity sensor. It publishes `Float32` messages on the topic
# `humidity` with a queue depth of 5, and calls `publish_humidity` twice a second.

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
# 10.2 degrees is cold for a room; the tutorial notes that it probably meant 18.0. In a room with thick walls, the
# temperature also changes slowly. Complete the method: take a random step of at most 0.3 degrees up or down, keep
# the temperature between 18.0 and 28.0, and publish it. Write the numbers with decimal points: a
# `Float32` needs a float, and 18 is an int. You may replace the last blank with several lines.

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
# Now write a node of your own, from the first line to the last: a sensor for a greenhouse. The node
#
# - follows a random walk, like the sensor on this page: it starts at 22.0 degrees Celsius, each step is at most 0.5
#   up or down, and it stays between 10.2 and 28.0;
# - publishes the temperature in degrees Fahrenheit, as a `Float32`: `c` degrees Celsius are `c * 9 / 5 + 32`
#   degrees Fahrenheit;
# - publishes on the topic `greenhouse/temperature`, four times a second.
#
# Keep the name of the class; all other names are up to you. The timer needs a method of yours.

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
# ## Publish a plain number
#
# **Predict:** this sensor publishes the number itself. How many messages does it publish in three seconds?

# %% predict=true
class HastySensor(SteadySensor):
    def publish_temperature(self):
        self.publisher_.publish(self.temperature)

ros = Session()
ros.add(HastySensor)
ros.run(seconds=3)
# --- answer
predict("0", len(ros.messages("temperature")))
# --- blank
# predict("____", len(ros.messages("temperature")))
# --- end

# %% [markdown] answers=true
# None. **Symptom:** a `TypeError`, and the node stops. **Where to look:** the error itself. It names the line,
# what was expected, and what it got. **Cause:** a publisher sends messages of its type, and `22.0` is
# a plain Python number. **Fix:** create a `Float32` and assign the number to its field `data`.

# %% [markdown]
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("03")

# %% only="solution"
quiz("03", "b", "c", "a")

# %% [markdown]
# ## Remember
#
# - `super().__init__("name")` makes the object a node.
# - `create_publisher(type, topic, depth)` creates a publisher; `publish(msg)` sends a message.
# - `create_timer(period, method)` calls the method once per period, for the first time after one full period.
# - `rclpy.init`, `rclpy.spin` and `try_shutdown` belong to the program around the node.
#
# **Next:** [write a subscriber](04_write_a_subscriber.ipynb) that listens to this sensor.

# %% shows=true
progress()
