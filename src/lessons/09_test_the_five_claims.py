# ---
# title: Test the five claims
# minutes: 50
# needs: ["04", "06"]
# summary: Put modularity, decentralization, scalability, concurrency and re-usability to the test.
# ---

# %% [markdown]
# # Test the five claims
#
# **Goal:** you put five claims about publish and subscribe to the test, and find where each one ends.
#
# **Time:** 50 minutes. **You need:** [write a subscriber](04_write_a_subscriber.ipynb) and
# [build, source, run](06_build_source_run.ipynb).
#
# The tutorial that this course follows claims: **modularity**, many small parts; **decentralization**, no
# single point of failure; **scalability**, more nodes without a change to old code; **concurrency**, nodes
# run in parallel; **re-usability**, the same node elsewhere. A claim is worth what an experiment says. Here
# are five, with the sensor and the monitor that you know.

# %%
import math
import random
import subprocess
import sys
import threading
import time

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Float32, Int32, String

from rosbeat import Session, check, hint, predict, progress, viz, workspace

workspace.catch_up("05")

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
        status = "High" if msg.data > 26.0 else "Low" if msg.data < 20.0 else "Normal"
        self.get_logger().info(f"Temperature: {msg.data:.2f}C - Status:{status}")

# %% [markdown]
# One thing is new: `declare_parameter("start", 22.0)`. The start is a **parameter**, which can be set from
# outside. You need it for the fifth claim.
#
# ## 1. Modularity: replace a part
#
# Somebody else writes a sensor. Nothing in it is like yours, except for the topic and the type. It can
# also count in Fahrenheit, where 22 °C are 71.6 °F.
#
# **Predict:** how many of the American sensor's three readings does your monitor call *High*?

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

def american():
    return Wave(scale=1.8, offset=32.0)

for sensor in (TemperatureSensor, Wave, american):
    with Session(seed=8) as ros:
        ros.add(sensor)
        ros.add(TemperatureMonitor)
        ros.run(seconds=3)
        print(str(ros.explain("temperature")).splitlines()[0])
        high = sum("High" in line.text for line in ros.logs("temperature_monitor"))

# --- answer
predict("3", high, because="Each of them is a number near 75, and 75 is more than 26.")
# --- blank
# predict("____", high, because="Each of them is a number near 75, and 75 is more than 26.")
# --- end

# %% [markdown]
# **Found: true, for what ROS compares:** topic, type, quality of service. What a number *means*, nobody
# compares: the last run is well in every respect, and wrong. The unit is a part of the contract that no
# type holds. Write it down where both sides read it.
#
# ## 2. Decentralization: take a part away
#
# *If one node crashes, the others can often continue operating.* **Predict:** the sensor is gone for five
# seconds and comes back. How many lines does the monitor write meanwhile, warnings included?

# %% predict=true
ros = Session(seed=8)
ros.add(TemperatureSensor)
ros.add(TemperatureMonitor)
ros.run(seconds=2)
ros.remove("temperature_sensor")
before = len(ros.logs())
ros.run(seconds=5)
meanwhile = len(ros.logs()) - before
ros.add(TemperatureSensor)
ros.run(seconds=2)
ros.remove("temperature_monitor")
ros.run(seconds=3)
print("the sensor published at", [reading.time for reading in ros.messages("temperature")])
# --- answer
predict("0", meanwhile)
# --- blank
# predict("____", meanwhile)
# --- end

# %% [markdown]
# Nobody had to connect the two again. And when the monitor goes, the sensor goes on: 10, 11, 12.
#
# Does it hold for a real crash, too? `kill -9` ends a process at once, in the middle of anything. Here are
# two of them. Python can run the files of your package directly, without a build.

# %% terminal="sensor --until Publishing --lines 2" tags=["nbval-ignore-output"]
# cd "$ROS2_WORKSPACE/src/sensor_simulator/sensor_simulator"
# python3 temperature_publisher.py

# %% terminal="monitor --until Status --lines 2" tags=["nbval-ignore-output"]
# cd "$ROS2_WORKSPACE/src/sensor_simulator/sensor_simulator"
# python3 temperature_subscriber.py

# %%
sensor, monitor = workspace.terminal("sensor"), workspace.terminal("monitor")
killed, lines = sensor.kill(show=lambda line: None), len(monitor.wait_for("Status"))
print("killed:", killed, " the monitor runs:", monitor.busy)
sensor.type("python3 temperature_publisher.py", until="Publishing", show=lambda line: None)
print("it hears again:", len(monitor.wait_for("Status", lines + 2, 30)) > lines)
for terminal in (sensor, monitor):
    terminal.close()

# %% [markdown]
# **Found: partly true.** No program in the middle had to be alive, and the others went on. But the monitor
# went on *without work*, and said nothing: silence is no message. A single point of failure is left wherever
# only one node knows something. So somebody has to notice.
#
# ## Try it: notice the silence
#
# Write a node that listens to `temperature` and publishes on `status`, as a `String`:
#
# - `lost`, once, when no reading has come for 3 seconds;
# - `back`, once, when one comes again.
#
# Either may come up to a second late. Before the first reading it says nothing. Count by the node's own
# clock, `self.get_clock().now().nanoseconds`, or with timers; `reset()` begins a timer's period anew,
# `cancel()` stops it.

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
# **Predict:** a sensor runs for 60 seconds with 50 monitors. How many messages does it publish, and how many
# arrive in all? (Write two numbers: `[..., ...]`.) Then comes what it costs: the time that the processor is
# busy.

# %% predict=true
class Counter(Node):
    def __init__(self):
        super().__init__("counter")
        self.create_subscription(Float32, "temperature", self.count, 10)
        self.heard = 0

    def count(self, msg):
        self.heard += 1

def crowd(size, seconds):
    with Session(seed=8) as ros:
        ros.add(TemperatureSensor)
        counters = [ros.add(Counter, name=f"counter_{n}") for n in range(size)]
        begin = time.process_time()
        ros.run(seconds)
        cost = time.process_time() - begin
        return len(ros.messages("temperature")), sum(one.heard for one in counters), cost

published, arrived, _ = crowd(50, seconds=60)
# --- answer
predict("[60, 3000]", [published, arrived])
# --- blank
# predict("____", [published, arrived])
# --- end

# %% tags=["nbval-ignore-output"]
costs = {size: crowd(size, seconds=300)[2] for size in (1, 5, 10, 20, 50)}
for size, cost in costs.items():
    print(f"{size:3} monitors {1000 * cost:5.0f} ms {'=' * round(50 * cost / costs[50])}")

# %%
costs[50] > 2 * costs[1]

# %% [markdown]
# **Found: true for the code**, which nobody touched. **Not for the cost:** it grows with the number of
# listeners, for each takes and unpacks each message. Large messages, such as pictures, make you feel it.
#
# ## 4. Concurrency: do two things at once
#
# *Nodes run independently, often in parallel.* Within a process, an **executor** calls the callbacks. The usual
# one, the **SingleThreadedExecutor**, calls one at a time.
#
# A heart beats once a second. A worker needs 3 seconds for an order: it sleeps, which takes virtual time
# here. `ros.add(BusyWorker, Heart)` starts both nodes in *one* process, with one executor.
#
# **Predict:** an order comes at 2.5 s. When does the beat come that follows the one at 2 s?

# %% predict=true
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
        self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))

ros = Session(seed=8)
ros.add(Boss)
ros.add(BusyWorker, Heart)
ros.run(seconds=8)
display(viz.timeline(ros.observation()))
# --- answer
predict("5.5", ros.messages("beat")[2].time)
# --- blank
# predict("____", ros.messages("beat")[2].time)
# --- end

# %% [markdown]
# The bar is the callback that sleeps, and the frame is the process. The heart's timer is due at 3 s, but it
# has to wait until the other node's callback returns.
#
# Now each node gets a process of its own, as if you had typed `ros2 run` three times. **Predict:** when does
# that beat come?

# %% predict=true
ros = Session(seed=8)
for node in (Boss, BusyWorker, Heart):
    ros.add(node)
ros.run(seconds=8)
display(viz.timeline(ros.observation()))
# --- answer
predict("3", ros.messages("beat")[2].time)
# --- blank
# predict("____", ros.messages("beat")[2].time)
# --- end

# %% [markdown]
# On time: processes do not wait for each other. Nobody listens to the beats here, so their arrows end in
# nothing.
#
# ## Try it: work, and go on beating
#
# Write a worker that listens to `order` (`Int32`), works on each for 3 seconds, and then publishes its number
# on `done` (`Int32`). On `beat` it publishes any `String` each second, whatever it does. Orders that come
# meanwhile wait, and are done in order, one after the other. Do not sleep: the beat would wait. And start no
# threads: they count real time.

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
# There is another way: a **MultiThreadedExecutor** runs callbacks in several threads. But all callbacks of a node
# are in one **callback group** by default, and that is *mutually exclusive*: it runs one callback at a time. You
# have to ask for other groups. In a *reentrant* group, callbacks may overlap, even a callback with itself.
#
# Here one node works and beats. `threads=4` gives its process such an executor, and two orders come at 2.5 s.
#
# **Predict:** when does the third beat come with the default group, with two exclusive groups, and with a
# reentrant one? Write three numbers.

# %% predict=true
class Worker(Node):
    def __init__(self, beating, working):
        super().__init__("worker")
        self.beats = self.create_publisher(String, "beat", 10)
        self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")), beating)
        self.create_subscription(Int32, "order", self.work, 10, callback_group=working)

    def work(self, msg):
        time.sleep(3.0)
        self.get_logger().info(f"order {msg.data} is done")

def third_beat(beating, working):
    with Session(seed=8) as ros:
        ros.add(Boss)
        ros.add(Boss, name="second_boss")
        ros.add(lambda: Worker(beating, working), threads=4)
        ros.run(seconds=9)
        return ros.messages("beat")[2].time

Exclusive, Reentrant = MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
both = Reentrant()
beats = [third_beat(None, None), third_beat(Exclusive(), Exclusive()), third_beat(both, both)]
# --- answer
predict("[5.5, 3, 3]", beats)
# --- blank
# predict("____", beats)
# --- end

# %% [markdown]
# With two groups, the beat is on time. In the reentrant group, the two orders overlap as well: both are done at
# 5.5 s.
#
# Do real programs do the same? `pulse.py` starts the nodes that you name, with one `SingleThreadedExecutor`, and
# ends after 4.8 seconds. First it runs both nodes in one process, then each in a process of its own.
#
# **Predict:** is the heart silent while the worker sleeps? Write two words, `yes` or `no`.

# %% terminal="pulse --timeout 60" tags=["nbval-ignore-output"]
# cd "$ROS2_WORKSPACE/scripts" && cat > pulse.py <<'EOF'
# import sys, time
# import rclpy
# from rclpy.executors import SingleThreadedExecutor
# from rclpy.node import Node
#
# class Heart(Node):
#     def __init__(self):
#         super().__init__("heart")
#         self.create_timer(1.0, lambda: self.get_logger().info("beat"))
#
# class Worker(Node):
#     def __init__(self):
#         super().__init__("worker")
#         self.create_timer(2.5, self.work)
#     def work(self):
#         self.get_logger().info("begins")
#         time.sleep(2.0)
#         self.get_logger().info("done")
#
# rclpy.init()
# executor = SingleThreadedExecutor()
# for name in sys.argv[1:]:
#     executor.add_node(globals()[name]())
# executor.spin_until_future_complete(rclpy.task.Future(), timeout_sec=4.8)
# EOF
# python3 pulse.py Heart Worker
# (python3 pulse.py Heart & python3 pulse.py Worker; wait)

# %% predict=true
said = [line.text for line in workspace.terminal("pulse").logs()]
begins, ends = ([n for n, text in enumerate(said) if text == word] for word in ("begins", "done"))
silent = ["yes" if end - begin == 1 else "no" for begin, end in zip(begins, ends)]
workspace.terminal("pulse").close()
# --- answer
predict("yes, no", ", ".join(silent))
# --- blank
# predict("____", ", ".join(silent))
# --- end

# %% [markdown]
# They do. So threads can *wait* at the same time. Can they *calculate* at the same time, on two cores? Here is
# the same sum, twice; of three tries, the fastest counts:

# %% tags=["nbval-ignore-output"]
task = "sum(n * n for n in range(3_000_000))"

def one_after_the_other():
    eval(task)
    eval(task)

def two_threads():
    threads = [threading.Thread(target=eval, args=(task,)) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

def two_processes():
    command = [sys.executable, "-c", f"import os; print(os.getpid(), {task})"]
    programs = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in "12"]
    return [program.communicate()[0].split() for program in programs]

def seconds(way):
    begin = time.perf_counter()
    way()
    return time.perf_counter() - begin

for way in (one_after_the_other, two_threads, two_processes):
    print(f"{way.__name__:20} {min(seconds(way) for _ in range(3)):.2f} s")

# %%
(one, first), (other, second) = two_processes()
one != other, first == second == str(eval(task))

# %% [markdown]
# **Found: partly true.** Two processes have two numbers and two cores, and take about half the time if both
# are free. (A busy machine blurs it; run the cell again.) Two threads gain nothing: in one process, one thread
# at a time runs Python. So give heavy work a process of its own: another `ros2 run`.
#
# ## 5. Re-usability: take a node elsewhere
#
# In the greenhouse, the same two classes shall measure humidity, 40 to 70 percent. The session starts
# them as `ros2 run` would: with another name, a namespace, **remapped** topics and parameters.
#
# (`**here` hands over each entry of a dict as an argument.)
#
# **Predict:** what does the monitor say of 55 percent: *High*, *Low* or *Normal*?

# %% predict=true
with Session(seed=8) as ros:
    here = {"namespace": "greenhouse", "remappings": {"temperature": "humidity"}}
    ros.add(TemperatureSensor, name="hygrometer", parameters={"start": 55.0}, **here)
    ros.add(TemperatureMonitor, name="humidity_monitor", **here)
    ros.run(seconds=1)
    said = ros.logs("greenhouse/humidity_monitor")[0].text.split("Status:")[-1]
    display(viz.graph(ros.graph()))
# --- answer
predict("High", said)
# --- blank
# predict("____", said)
# --- end

# %% [markdown]
# **Found: partly true.** The names moved, and the sensor's start. The monitor's limits and its *C* stand in its
# code. A node is as re-usable as its author made it: names without a slash in front, called **relative**,
# parameters, and no unit in the code. In a terminal, the same start is
#
# ```bash
# ros2 run sensor_simulator temperature_subscriber --ros-args -r __node:=humidity_monitor \
#     -r __ns:=/greenhouse -r temperature:=humidity
# ```
#
# and `-p low:=40.0` sets a parameter, if the node has declared it.
#
# ## Try it: a monitor for any place
#
# It listens to `reading` (`Float32`) and declares `low` (20.0), `high` (26.0) and `unit` (`"C"`). For each reading
# it publishes a `String` on `status`: `High`, `Low` or `Normal`, then the reading with a decimal or more and
# the unit, as in `High 27.5 C`.

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
# ## What went wrong: a name that stays behind
#
# The stranger's sensor moves into the greenhouse, too. Its monitor there hears nothing.

# %%
with Session(seed=8) as ros:
    ros.add(Wave, namespace="greenhouse")
    ros.add(TemperatureMonitor, namespace="greenhouse")
    ros.run(seconds=3)
    print(ros.explain("greenhouse/temperature"))

# %% [markdown]
# **Symptom:** silence. **Instrument:** `explain`, which sees two topics. **Cause:** the slash in `"/temperature"`:
# a name that begins with one is **absolute**, and no namespace moves it. **Cure:** leave the slash out, or
# remap the whole name: `-r /temperature:=/greenhouse/temperature`.
#
# ## Remember
#
# | claim | found |
# |---|---|
# | modularity | true for topic, type and QoS; the meaning is yours to keep |
# | decentralization | the others go on; somebody has to notice |
# | scalability | no code changes; the cost grows with the listeners |
# | concurrency | processes do; one executor does one thing at a time; threads share one Python |
# | re-usability | as far as names are relative and values are parameters |
#
# **Next:** [find the fault](10_find_the_fault.ipynb), with what you know of all this.

# %%
progress()
