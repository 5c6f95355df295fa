# ---
# title: Test the five claims
# minutes: 50
# needs: ["04", "06"]
# summary: Put modularity, decentralization, scalability, concurrency and re-usability to the test.
# ---

# %% [markdown]
# # Test the five claims
#
# **After this page, you can:**
#
# - say how far each of the five claims is true (09.1);
# - write a node that notices when another one is gone (09a);
# - keep a node responsive while it works (09b, 09.2);
# - write a node that can be used anywhere (09c, 09.3).
#
# **Time:** 50 minutes. **You need:** [write a subscriber](04_write_a_subscriber.ipynb) and
# [build, source, run](06_build_source_run.ipynb).
#
# The tutorial claims that publish and subscribe has five benefits:
#
# - **modularity:** a large system is made of many small parts;
# - **decentralization:** there is no single point of failure;
# - **scalability:** you can add nodes without changing existing code;
# - **concurrency:** nodes run in parallel;
# - **re-usability:** the same node works elsewhere.
#
# Here is an experiment for each of them.

# %%
import math
import random
import threading
import time

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Float32, Int32, String

viz.diagram("09")

# %%
class TemperatureSensor(Node):
    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher_ = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(1.0, self.publish_temperature)
        self.temperature = self.declare_parameter("start", 22.0).value

    def publish_temperature(self):
        self.temperature += random.uniform(-0.5, 0.5)
        self.publisher_.publish(Float32(data=self.temperature))

class TemperatureMonitor(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

    def temperature_callback(self, msg):
        self.status = "High" if msg.data > 26.0 else "Low" if msg.data < 20.0 else "Normal"
        self.get_logger().info(f"Temperature: {msg.data:.2f}C - Status:{self.status}")

# %% [markdown]
# One thing is new: `declare_parameter("start", 22.0)`. The initial temperature is a **parameter**, a named value
# that can be set from outside. The fifth experiment uses it.
#
# ## 1. Modularity: replace a part
#
# Somebody else has written a sensor. It shares only the topic and the message type with yours. It can also measure
# in Fahrenheit, where 22 °C is 71.6 °F.
#
# **Predict:** a Fahrenheit sensor takes the place of yours. Which status does the monitor report: `High`, `Low` or
# `Normal`?

# %% predict=true
class Wave(Node):
    def __init__(self, scale=1.0, offset=0.0):
        super().__init__("wave")
        self.out = self.create_publisher(Float32, "/temperature", 1)
        self.scale, self.offset = scale, offset
        self.create_timer(1.0, self.tick)

    def tick(self):
        celsius = 22.0 + 3.0 * math.sin(self.get_clock().now().nanoseconds / 1e9)
        self.out.publish(Float32(data=celsius * self.scale + self.offset))

ros = Session(seed=8)
ros.add(Wave(scale=1.8, offset=32.0))
monitor = ros.add(TemperatureMonitor)
ros.run(seconds=3)
# --- answer
predict("High", monitor.status)
# --- blank
# predict("____", monitor.status)
# --- end

# %% [markdown] answers=true
# **Result: true for what ROS compares:** topic, type and quality of service. ROS doesn't compare what a number
# *means*: `ros.explain` would find nothing wrong, but every status is wrong. The message type doesn't hold the unit.
# Write it down where the authors of both sides will read it.

# %% [markdown]
# ## 2. Decentralization: take a part away
#
# *If one node crashes, the others can often continue operating.*
#
# **Predict:** the sensor runs for two seconds, is gone for five, and comes back for two. How many lines does the
# monitor log in these nine seconds, including warnings?

# %% predict=true
ros = Session(seed=8)
sensor = ros.add(TemperatureSensor)
ros.add(TemperatureMonitor)
ros.run(seconds=2)
sensor.destroy_node()
ros.run(seconds=5)
ros.add(TemperatureSensor)
ros.run(seconds=2)
# --- answer
predict("4", len(ros.logs()))
# --- blank
# predict("____", len(ros.logs()))
# --- end

# %% [markdown] answers=true
# One for each reading, and none while the sensor was gone. Nobody had to connect the two again.

# %% [markdown]
# Does this also hold for a real crash? The next two cells start a process each, running the files of your package
# directly, without a build. The third cell does to the sensor what `kill -9` does: it ends the process immediately.
#
# **Predict:** is the monitor still running after that? Answer `yes` or `no`.

# %% terminal="sensor --until Publishing --lines 2" tags=["nbval-ignore-output"] shows=true
# cd "$ROS2_WORKSPACE/src/sensor_simulator/sensor_simulator"
# python3 temperature_publisher.py

# %% terminal="monitor --until Status --lines 2" tags=["nbval-ignore-output"] shows=true
# cd "$ROS2_WORKSPACE/src/sensor_simulator/sensor_simulator"
# python3 temperature_subscriber.py

# %% terminal="sensor --kill" tags=["nbval-ignore-output"] shows=true

# %% predict=true
# --- answer
predict("yes", workspace.terminal("monitor").busy)
# --- blank
# predict("____", workspace.terminal("monitor").busy)
# --- end

# %% [markdown] answers=true
# **Result: partly true.** There is no central program that has to stay alive, and the monitor kept running. But it
# ran *without readings*, and it didn't say so, because silence isn't a message. Wherever only one node knows
# something, that node is still a single point of failure, and another node has to notice when it's gone.

# %% [markdown]
# ## Try it: notice the silence
#
# Write a node that subscribes to `temperature` and publishes on `status`, as a `String`:
#
# - `lost`, once in each silence, when no reading has come for 3 seconds;
# - `back`, once after each silence, when a reading comes again.
#
# Either may come up to a second late, so a silence of 3 to 4 seconds may go unreported. Before the first reading,
# the node publishes nothing. Measure time with the node's own clock, `self.get_clock().now().nanoseconds`, or with
# timers. A timer's `reset()` starts its period again, and `cancel()` stops the timer.

# %% exercise="09a"
class Watchman(Node):
    def __init__(self):
        super().__init__("watchman")
        self.create_subscription(Float32, "temperature", self.hear, 10)
        self.statuses = self.create_publisher(String, "status", 10)
        # --- answer
        self.lost = False
        self.silence = self.create_timer(3.0, self.miss)
        self.silence.cancel()
        # --- blank
        # ____
        # --- end

    def hear(self, msg):
        # --- answer
        self.silence.reset()
        if self.lost:
            self.lost = False
            self.statuses.publish(String(data="back"))
        # --- blank
        # ____
        # --- end

    # --- answer
    def miss(self):
        self.silence.cancel()
        self.lost = True
        self.statuses.publish(String(data="lost"))
    # --- blank
    # # ____
    # --- end

# %% check="09a"
check("09a", Watchman)

# %% [markdown]
# ## 3. Scalability: add nodes
#
# **Predict:** a sensor runs for 60 seconds with 50 monitors. How many messages does it publish?

# %% predict=true
ros = Session(seed=8)
ros.add(TemperatureSensor)
for number in range(50):
    ros.add(TemperatureMonitor, name=f"monitor_{number}")
ros.run(seconds=60, quiet=True)
# --- answer
predict("60", len(ros.messages("temperature")))
# --- blank
# predict("____", len(ros.messages("temperature")))
# --- end

# %% [markdown] answers=true
# The sensor publishes each message once, and all 50 monitors receive it. The next cell measures how long that keeps
# the processor busy.

# %% tags=["nbval-ignore-output"]
def cost(size):
    ros = Session(seed=8)
    ros.add(TemperatureSensor)
    for number in range(size):
        ros.add(TemperatureMonitor, name=f"monitor_{number}")
    begin = time.process_time()
    ros.run(seconds=60, quiet=True)
    return time.process_time() - begin

print(f"1 monitor: {cost(1):.3f} s, 50 monitors: {cost(50):.3f} s")

# %% [markdown]
# **Result: true for the code**, which nobody had to change. **Not for the cost:** it grows with the number of
# subscribers, because each of them takes and unpacks every message.
#
# ## 4. Concurrency: do two things at once
#
# *Nodes run independently, often in parallel.* Within a process, an [**executor**](../docs/glossary.md#executor)
# calls the callbacks. The usual one, the **SingleThreadedExecutor**, calls one callback at a time.
#
# The heart publishes a beat once a second. The worker needs 3 seconds for an order: it sleeps, which takes virtual
# time here. `ros.add(BusyWorker, Heart)` starts both nodes in *one* process, with one executor.
#
# **Predict:** there's a beat at 2 s, and an order arrives at 2.5 s. At what time does the next beat come?

# %%
class Boss(Node):
    def __init__(self):
        super().__init__("boss")
        self.orders = self.create_publisher(Int32, "order", 10)
        self.timer = self.create_timer(2.5, self.give_order)

    def give_order(self):
        self.timer.cancel()
        self.orders.publish(Int32(data=1))

class BusyWorker(Node):
    def __init__(self):
        super().__init__("busy_worker")
        self.create_subscription(Int32, "order", self.work, 10)

    def work(self, msg):
        time.sleep(3.0)

class Heart(Node):
    def __init__(self):
        super().__init__("heart")
        self.beats = self.create_publisher(String, "beat", 10)
        self.create_timer(1.0, self.beat)

    def beat(self):
        self.beats.publish(String(data="alive"))

# %% predict=true
ros = Session(seed=8)
ros.add(Boss)
ros.add(BusyWorker, Heart)
ros.run(seconds=8)
# --- answer
predict("5.5", ros.messages("beat")[2].time)
# --- blank
# predict("____", ros.messages("beat")[2].time)
# --- end

# %% shows=true
viz.timeline(ros)

# %% [markdown] answers=true
# The bar is the sleeping callback, and the frame is the process. The heart's timer is due at 3 s, but its callback
# has to wait until the other node's callback returns.

# %% [markdown]
# Now each node gets a process of its own, as if you had typed `ros2 run` three times.
#
# **Predict:** at what time does that beat come now?

# %% predict=true
ros = Session(seed=8)
ros.add(Boss)
ros.add(BusyWorker)
ros.add(Heart)
ros.run(seconds=8)
# --- answer
predict("3", ros.messages("beat")[2].time)
# --- blank
# predict("____", ros.messages("beat")[2].time)
# --- end

# %% [markdown] answers=true
# On time: processes don't wait for each other.

# %% [markdown]
# ## Try it: work, and keep beating
#
# Complete the worker. It subscribes to `order` (`Int32`), works on each order for 3 seconds, and then publishes the
# order's number on `done` (`Int32`). Every second, it publishes any `String` on `beat`, whatever else it's doing.
# Orders that arrive in the meantime wait, and are done one after the other, in the sequence in which they came. Two
# orders can have the same number; the worker does both.
#
# Don't sleep, because the beat would have to wait. You don't need a thread either: a timer is enough.

# %% exercise="09b"
class SteadyWorker(Node):
    def __init__(self):
        super().__init__("steady_worker")
        self.beats = self.create_publisher(String, "beat", 10)
        self.dones = self.create_publisher(Int32, "done", 10)
        self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
        self.create_subscription(Int32, "order", self.take, 10)
        self.waiting = []
        # --- answer
        self.work = self.create_timer(3.0, self.finish)
        self.work.cancel()
        # --- blank
        # ____
        # --- end

    def take(self, msg):
        self.waiting.append(msg.data)
        # --- answer
        if self.work.is_canceled():
            self.work.reset()
        # --- blank
        # ____
        # --- end

    # --- answer
    def finish(self):
        self.dones.publish(Int32(data=self.waiting.pop(0)))
        if not self.waiting:
            self.work.cancel()
    # --- blank
    # # ____
    # --- end

# %% check="09b"
check("09b", SteadyWorker)

# %% [markdown]
# There's another way: a **MultiThreadedExecutor** runs callbacks in several threads. That alone isn't enough:
# by default, all callbacks of a node belong to one [**callback group**](../docs/glossary.md#callback-group), which
# decides whether they may run at the same time. The default group is **mutually exclusive**: it runs one callback
# at a time. You can create other groups. In a **reentrant** group, callbacks may overlap, and a callback may even
# overlap with itself.
#
# Here, a single node works and beats. `threads=4` gives its process a MultiThreadedExecutor, and two orders arrive
# at 2.5 s.
#
# **Predict:** at what time does the third beat come with the default group, with two mutually exclusive groups, and
# with a reentrant one? Write three numbers: `[..., ..., ...]`.

# %%
class Worker(Node):
    def __init__(self, beating, working):
        super().__init__("worker")
        self.beats = self.create_publisher(String, "beat", 10)
        self.create_timer(1.0, self.beat, beating)
        self.create_subscription(Int32, "order", self.work, 10, callback_group=working)

    def beat(self):
        self.beats.publish(String(data="alive"))

    def work(self, msg):
        time.sleep(3.0)
        self.get_logger().info(f"order {msg.data} is done")

def third_beat(beating, working):
    ros = Session(seed=8)
    ros.add(Boss)
    ros.add(Boss, name="second_boss")
    ros.add(Worker(beating, working), threads=4)
    ros.run(seconds=9)
    return ros.messages("beat")[2].time

# %% predict=true
default = third_beat(None, None)
two = third_beat(MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup())
group = ReentrantCallbackGroup()
reentrant = third_beat(group, group)
# --- answer
predict("[5.5, 3, 3]", [default, two, reentrant])
# --- blank
# predict("____", [default, two, reentrant])
# --- end

# %% [markdown] answers=true
# With two groups, the beat is on time. In the reentrant group, the two orders overlap as well: both are done at 5.5
# seconds.

# %% [markdown]
# So threads can *wait* at the same time. Can they also *calculate* at the same time, on two cores? The next cell runs
# the same two sums, first in two threads of one process, and then in two processes. `real` is the time on the clock.

# %% terminal="cores" tags=["nbval-ignore-output"] shows=true
# cd "$ROS2_WORKSPACE/scripts" && cat > cores.py <<'EOF'
# import sys, threading
#
# def work():
#     sum(n * n for n in range(5_000_000))
#
# for _ in range(int(sys.argv[1])):
#     threading.Thread(target=work).start()
# EOF
# time python3 cores.py 2
# time (python3 cores.py 1 & python3 cores.py 1; wait)

# %% [markdown]
# **Result: partly true.** Two processes can use two cores. If both cores are free, they take about half the time;
# on a busy computer, you may see no difference. Two threads in one process gain nothing, because Python's [**global
# interpreter lock**](../docs/glossary.md#global-interpreter-lock) lets only one thread at a time run Python code.
# So give heavy work a process of its own.
#
# ## 5. Re-usability: take a node elsewhere
#
# In the greenhouse, the same two classes should measure humidity, where 40 to 70 percent is normal. The session
# starts them as `ros2 run` would:
#
# - with another name;
# - in a [**namespace**](../docs/glossary.md#namespace), a prefix for the names of its nodes and topics;
# - with [**remapped**](../docs/glossary.md#remapping) topics: another name takes the place of the one in the code;
# - with parameters.
#
# **Predict:** what does the monitor say about 55 percent: *High*, *Low* or *Normal*?

# %% predict=true
ros = Session(seed=8)
ros.add(
    TemperatureSensor,
    name="hygrometer",
    namespace="greenhouse",
    remappings={"temperature": "humidity"},
    parameters={"start": 55.0},
)
monitor = ros.add(
    TemperatureMonitor,
    name="humidity_monitor",
    namespace="greenhouse",
    remappings={"temperature": "humidity"},
)
ros.run(seconds=1)
# --- answer
predict("High", monitor.status)
# --- blank
# predict("____", monitor.status)
# --- end

# %% [markdown] answers=true
# **Result: partly true.** You could change the names from outside, and the sensor's initial value. But the
# monitor's limits and its *C* are fixed in its code. A node is as re-usable as its author makes it: with
# parameters, without a unit in the code, and with [**relative**](../docs/glossary.md#relative-name) names, which
# don't begin with a slash. In a terminal, you would start the monitor like this:

# %% [markdown]
# ```bash
# ros2 run sensor_simulator temperature_subscriber --ros-args -r __node:=humidity_monitor \
#     -r __ns:=/greenhouse -r temperature:=humidity
# ```
#
# Adding `-p low:=40.0` sets a parameter, if the node has declared it.
#
# ## Try it: a monitor for any place
#
# Write a monitor that subscribes to `reading` (`Float32`) and declares the parameters `low` (20.0), `high` (26.0)
# and `unit` (`"C"`). For each reading, it publishes a `String` on `status`, such as `High 27.5 C`. This text has
# three parts, with a space between them:
#
# - `High` above the upper limit, `Low` below the lower one, and `Normal` otherwise;
# - the reading, with at least one decimal;
# - the unit.

# %% exercise="09c"
class AnyMonitor(Node):
    def __init__(self):
        super().__init__("any_monitor")
        self.statuses = self.create_publisher(String, "status", 10)
        # --- answer
        self.low = self.declare_parameter("low", 20.0).value
        self.high = self.declare_parameter("high", 26.0).value
        self.unit = self.declare_parameter("unit", "C").value
        self.create_subscription(Float32, "reading", self.hear, 10)
        # --- blank
        # ____
        # --- end

    def hear(self, msg):
        # --- answer
        word = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
        self.statuses.publish(String(data=f"{word} {msg.data:.1f} {self.unit}"))
        # --- blank
        # ____
        # --- end

# %% check="09c"
check("09c", AnyMonitor)

# %% [markdown]
# ## What went wrong: a name that ignores the namespace
#
# This time, the other author's sensor runs in the greenhouse, and the monitor there hears nothing.

# %% shows=true
ros = Session(seed=8)
ros.add(Wave, namespace="greenhouse")
ros.add(TemperatureMonitor, namespace="greenhouse")
ros.run(seconds=3)
ros.explain("greenhouse/temperature")

# %% [markdown]
# **Symptom:** silence. **Where to look:** `explain`, which finds two topics. **Cause:** the slash in
# `"/temperature"`. A name that begins with a slash is [**absolute**](../docs/glossary.md#absolute-name), and no
# namespace changes it. **Fix:** leave the slash out, or remap the whole name: `-r
# /temperature:=/greenhouse/temperature`.
#
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("09")

# %% only="solution"
quiz("09", "a", "b", "c")

# %% [markdown]
# ## Remember
#
# | claim | result |
# |---|---|
# | modularity | true for topic, type and QoS; both sides must agree on the meaning |
# | decentralization | the other nodes continue; one of them has to notice the silence |
# | scalability | no code changes; the cost grows with the number of subscribers |
# | concurrency | processes run in parallel; a SingleThreadedExecutor runs one callback at a time; threads share one Python interpreter |
# | re-usability | true as far as names are relative and values are parameters |
#
# **Next:** [find the fault](10_find_the_fault.ipynb).

# %% shows=true
progress()
