# ---
# title: Find the fault
# minutes: 60
# needs: ["04", "07", "08"]
# summary: A clinic for broken systems: instruments, a patient, and a diagnosis to give.
# ---

# %% [markdown]
# # Find the fault
#
# **After this page, you can:**
#
# - find a fault step by step, by halving the system (10a, 10.1);
# - choose the instrument that answers your question (10a, 10b);
# - tell a symptom from its cause (10.2);
# - find a second fault that hides behind the first (10c, 10.3).
#
# **Time:** 60 minutes. **You need:** [write a subscriber](04_write_a_subscriber.ipynb),
# [look inside the graph](07_look_inside_the_graph.ipynb) and
# [tune quality of service](08_tune_quality_of_service.ipynb).
#
# On this page, you examine systems that somebody else wrote, without looking at their code.

# %%
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float32, String

viz.diagram("10")

# %% [markdown]
# ## Meet a patient
#
# You already know most of the mistakes. The hard part is finding out which one you're looking at. A **symptom** is
# what somebody notices: the lamp stays dark. A **cause** is what has to be fixed. A **diagnosis** names the cause
# and its place. On this page, a **patient** is a system with a fault.
#
# The first patient has three nodes. A sensor publishes readings, a guard turns each reading into a status, and
# a lamp shows the status. You can see the code here, because you'll fix it later. Try not to search it for the fault.

# %%
class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(1.0, self.measure)

    def measure(self):
        self.publisher.publish(Float32(data=27.0))

class Guard(Node):
    def __init__(self):
        super().__init__("guard")
        self.create_subscription(Float32, "temperature", self.judge, 10)
        self.publisher = self.create_publisher(String, "status", 10)

    def judge(self, msg):
        status = "High" if msg.data > 26.0 else "Normal"
        self.publisher.publish(String(data=status))

# %%
class Lamp(Node):
    def __init__(self):
        super().__init__("lamp")
        keep = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(String, "status", self.shine, keep)

    def shine(self, msg):
        self.get_logger().info(f"The lamp says {msg.data}")

ros = Session(seed=8)
for part in (Sensor, Guard, Lamp):
    ros.add(part)
ros.run(seconds=20)
ros.logs("lamp")

# %% [markdown]
# Twenty seconds, and the lamp hasn't lit once. **The complaint:** "The lamp stays dark."
#
# The two warnings are rclpy's. They tell you the cause, if you happen to see them: each side logs its warning once, at
# the start, and among thousands of other lines it's soon out of sight. So find the fault without them.
#
# ## Halve the system
#
# It's tempting to change something and hope for the best. Instead, follow the data from the sensor to the lamp and
# ask four questions. Each answer rules out part of the system:
#
# 1. Is it **published**? `ros.messages(topic)`
# 2. Is it **matched**? `ros.graph()`, `ros.explain(topic)`
# 3. Is it **taken**? `ros.logs(node)`, `viz.timeline`
# 4. Is the **value right**? `viz.values`, and the messages themselves
#
# Start in the middle. **Predict:** how many messages has the guard published on `status`?

# %% predict=true
# --- answer
predict("20", len(ros.messages("status")))
# --- blank
# predict("____", len(ros.messages("status")))
# --- end

# %% [markdown] answers=true
# All 20 are published. With one question, you know that everything up to the guard's `publish` works: whatever the
# guard needs must be working, too. The fault is somewhere between the guard and the lamp.

# %% [markdown]
# Do these two match?

# %% shows=true
ros.explain("status")

# %% [markdown]
# The names aren't the problem: both sides use the same topic. But the lamp asks for stored messages, and the guard
# doesn't store any.
#
# **Diagnosis:** `qos-mismatch` at `/status`. **Fix:** give both sides the same QoS profile. A diagnosis is only a
# guess until the fix works. To prove it, correct the class, add it again, and run.

# %%
class Lamp(Node):
    def __init__(self):
        super().__init__("lamp")
        self.create_subscription(String, "status", self.shine, 10)

    def shine(self, msg):
        self.get_logger().info(f"The lamp says {msg.data}")

ros.add(Lamp)
ros.run(seconds=2)

# %% [markdown]
# The lamp shines: the patient is cured.
#
# ## Choose an instrument
#
# | symptom | instrument | what it shows |
# |---|---|---|
# | silence | `ros.explain(topic)` | which nodes are on each side, whether they match, and which have ended |
# | silence, though everything seems fine | `ros.graph()` | each name, letter by letter, and which node subscribes to what |
# | it stopped | `ros.messages(topic)[-1]` | when the last message came, and from which node |
# | something is missing | `ros.logs(node)` | what a node received, and since when |
# | too many or too few | `ros.explain(topic)` | messages per second, for each publisher |
# | strange numbers | `viz.values(ros, topic)` | each reading, with its limits as bands |
# | strange order | `viz.timeline(ros)` | what caused what |
#
# Here are the four questions again, with the causes that each of them can reveal:
#
# | question | causes that make the answer "no" |
# |---|---|
# | published? | `never-published`, `gone-quiet`, `node-ended`, `not-spun`, `callback-blocks` |
# | matched? | `topic-misspelled`, `wrong-namespace`, `wrong-topic`, `qos-mismatch`, `type-mismatch` |
# | taken? | `not-spun`, `depth-too-small`, `first-messages-lost` |
# | right? | `wrong-unit`, `never-changes`, `no-clamp`, `clamped-too-early`, `boundary`, `two-sources`, `run-twice`, `wrong-rate` |
#
# `clinic.names()`, further down, explains each of these names.
#
# ## Walk through the ward
#
# Eleven patients are waiting. They are all real nodes that have run for a minute. You can't see their code.

# %% shows=true
ward = clinic.Ward(seed=7)
patient = ward.patient(1)
patient

# %% [markdown]
# First come the words of the system's owner. They don't name a cause, but you can trust them: whatever they call
# *fine* is fine.
# `Ordered` describes how the system should be: which node publishes on which topic, which nodes subscribe to it, and
# what the numbers mean. `patient.ros` is an ordinary session, so you can use every instrument on it.

# %% shows=true
viz.graph(patient.ros)

# %% [markdown]
# Go through the order line by line, and look for each name in the picture. Is every node there? Is
# each one connected to the topic that was ordered?
#
# Be careful with `ros.explain`: it covers a single topic. Follow the data from the sensor, and ask first about the
# first topic that is silent. About a later topic, it may say that the guard has published nothing. That's true, but
# the node that publishes there may be healthy and simply have nothing to report. What looks like a fault there is
# only a symptom.
#
# A diagnosis is a name and a place. The place is the full name of the node or of the topic that has the fault,
# which isn't always where you notice the symptom. If the fault is between two nodes, name the topic. Where more
# than one place fits, each of them counts. The clinic knows twenty causes, and not all of them occur here:

# %% shows=true
clinic.names()

# %% [markdown]
# ## Try it: something is silent
#
# Patients 1 to 4 have one fault each. You've met patient 1; here are the other three.

# %% shows=true
for number in (2, 3, 4):
    print(ward.patient(number))

# %% [markdown]
# Examine one patient after the other: change the number below, add cells, use any instrument. Write down what each
# answer rules out. `hint("10a")` costs nothing; hints are only counted. Your diagnoses go into
# the function `diagnoses`.

# %% shows=true
patient = ward.patient(2)
viz.timeline(patient.ros, until=3)

# %% exercise="10a"
def diagnoses():
    return {
        # --- answer
        1: ("topic-misspelled", "/hall_Temperature"),
        2: ("first-messages-lost", "/cellar_rule"),
        3: ("node-ended", "/shelf_sensor"),
        4: ("not-spun", "/booth_probe"),
        # --- blank
        # 1: ("____", "____"),
        # 2: ("____", "____"),
        # 3: ("____", "____"),
        # 4: ("____", "____"),
        # --- end
    }

# %% check="10a"
check("10a", diagnoses)

# %% [markdown]
# If a diagnosis is wrong, the check says what speaks against it. Check as often as you like, even while some
# patients are still blank.
#
# ## Try it: nothing is silent
#
# Patients 5 to 8 are harder. Every message arrives, and `ros.explain` finds no fault. Something is
# wrong all the same.

# %%
for number in (5, 6, 7, 8):
    print(ward.patient(number))

patient = ward.patient(8)
limits = {"as ordered": (23, 31)}
viz.values(patient.ros, "pool_temperature", bands=limits, unit="°C")

# %% [markdown]
# The band shows what was ordered, and the line shows the readings. For these patients, the last of the four questions
# counts: is the value right? Compare what you see with the order, number by number: limits, steps, the rate, and which
# nodes publish. `ros.graph()` is still useful, because a node that subscribes to the wrong topic receives messages,
# too.

# %% exercise="10b"
def diagnoses():
    return {
        # --- answer
        5: ("wrong-unit", "/leaf_sensor"),
        6: ("wrong-topic", "/water_guard"),
        7: ("two-sources", "/milk_temperature"),
        8: ("no-clamp", "/pool_sensor"),
        # --- blank
        # 5: ("____", "____"),
        # 6: ("____", "____"),
        # 7: ("____", "____"),
        # 8: ("____", "____"),
        # --- end
    }

# %% check="10b"
check("10b", diagnoses)

# %% [markdown]
# ## Repair it, and run it again
#
# Here are the sensor and the repaired lamp again, with a different guard. The owner of this system has found a fault in
# a topic's name, and is sure: fix it, and the lamp will shine.

# %%
class Guard(Node):
    def __init__(self):
        super().__init__("guard")
        self.create_subscription(Float32, "temprature", self.judge, 10)
        self.publisher = self.create_publisher(String, "status", 10)

    def judge(self, msg):
        if msg.data > 28.0 and msg.data < 20.0:
            self.publisher.publish(String(data="Alarm"))

ros = Session(seed=8)
for part in (Sensor, Guard, Lamp):
    ros.add(part)
ros.run(seconds=10)
ros.explain("temperature")

# %% [markdown]
# **Predict:** the next cell remaps the name. How many lines does the lamp log in the next ten seconds?

# %% predict=true
ros.add(Guard, remappings={"temprature": "temperature"})
ros.run(seconds=10)
# --- answer
predict("0", len(ros.logs("lamp")))
# --- blank
# predict("____", len(ros.logs("lamp")))
# --- end

# %% shows=true
ros.explain("status")

# %% [markdown] answers=true
# **Symptom:** the fix is right, but nothing changes. **Where to look:** ask the same questions once more, from
# the sensor on. **Cause:** a second fault was hidden behind the first. While the guard received nothing, you couldn't
# see that it would never publish: no number is above 28 *and* below 20. **Fix:** after each repair, examine the whole
# system again.

# %% [markdown]
# ## Try it: two faults
#
# Patients 9 to 11 have two faults each, at different places. The order doesn't matter.

# %% shows=true
for number in (9, 10, 11):
    print(ward.patient(number))

# %% exercise="10c"
def diagnoses():
    return {
        # --- answer
        9: [("depth-too-small", "/rack_diary"), ("wrong-unit", "/rack_probe")],
        10: [("topic-misspelled", "/stall_logger"), ("qos-mismatch", "/stall_status")],
        11: [("wrong-rate", "/comb_thermometer"), ("node-ended", "/comb_logger")],
        # --- blank
        # 9: [("____", "____"), ("____", "____")],
        # 10: [("____", "____"), ("____", "____")],
        # 11: [("____", "____"), ("____", "____")],
        # --- end
    }

# %% check="10c"
check("10c", diagnoses)

# %% [markdown] only="solution"
# **How you can find them.** In the stable, the logger subscribes to a name that nobody else uses, and the lamp
# asks for stored messages: `viz.graph` shows both. In the server room, `ros.logs` shows that the diary has taken two
# of every five readings, and 290 degrees must be Kelvin. In the beehive, the sensor publishes every two
# seconds instead of every second, and the logger has ended: `ros.explain` says both.

# %% [markdown]
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("10")

# %% only="solution"
quiz("10", "b", "a", "c")

# %% [markdown]
# ## Remember
#
# - The symptom is where you notice a fault; the cause may be elsewhere. Fix the cause.
# - Halve the system: published, matched, taken, value right?
# - What works is a clue, too: everything it depends on must be working.
# - Only a fix that works proves a diagnosis. Then look again, because one fault can hide another.
#
# **The same tools outside this notebook:** `ros2 node list`, `ros2 topic info -v /status` (which shows both sides and
# their QoS), `ros2 topic hz /status`, `ros2 topic echo /status`, and `rosbeat explain status`.
#
# Would you like more patients? `clinic.Ward(seed=8)` is another ward. If your dictionary begins with `"ward": 8`, the
# checks judge that ward.
#
# **Next:** [record and replay](11_record_and_replay.ipynb), to look at the same run as often as you like.

# %% shows=true
progress()
