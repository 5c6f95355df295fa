# ---
# title: Find the fault
# minutes: 60
# needs: ["04", "07", "08"]
# summary: A clinic for broken systems: instruments, a patient, and a diagnosis to give.
# ---

# %% [markdown]
# # Find the fault
#
# **Goal:** you find out what is wrong with systems that you have not written, with instruments and
# without a look at their code.
#
# **Time:** 60 minutes. **You need:** [write a subscriber](04_write_a_subscriber.ipynb),
# [look inside the graph](07_look_inside_the_graph.ipynb) and
# [tune quality of service](08_tune_quality_of_service.ipynb).

# %%
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float32, String

from rosbeat import Session, check, clinic, hint, predict, progress, viz

# %% [markdown]
# ## Meet a patient
#
# You know most mistakes already. What is hard is to see which one it is. A **symptom** is what
# somebody notices: the lamp stays dark. A **cause** is what has to be mended. A **diagnosis** says
# what the cause is, and where.
#
# The first patient has three nodes. A sensor publishes readings, a guard makes a status of each, and
# a lamp shows the status. Here you see the code, so that you can mend it later. Try not to search it
# for the fault.

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
# Twenty seconds, and not one line. **The complaint:** "The lamp stays dark."
#
# ## Halve the system
#
# It is tempting to change something and hope. Ask instead, from the sensor on, and let each answer cross
# out half of what is left:
#
# 1. Is it **published**? `ros.messages(topic)`
# 2. Is it **matched**? `ros.graph()`, `ros.explain(topic)`
# 3. Is it **taken**? `ros.logs(node)`, `viz.timeline`
# 4. Is the **value right**? `viz.values`, and the messages themselves
#
# Begin in the middle. **Predict:** how many messages has the guard published on `status`?

# %% predict=true
said = ros.messages("status")
# --- answer
predict("20", len(said), because="One reading a second reaches the guard, and each gets a status.")
# --- blank
# predict("____", len(said), because="One reading a second reaches the guard, and each gets a status.")
# --- end

# %% [markdown]
# They are published. One question, and the sensor, the topic `temperature` and the guard are all crossed
# out: whatever the guard needs must be fine too. The fault lies between the guard and the lamp.
#
# Are these two matched?

# %%
ros.explain("status")

# %%
viz.graph(ros.explain("status"))

# %% [markdown]
# That rules the names out, too: both sides use one topic. The line to the lamp is broken, since the lamp
# asks for stored messages, and the guard keeps none.
#
# **Diagnosis:** `qos-mismatch` at `/status`. **Cure:** both sides get the same QoS. A diagnosis is a guess
# until the cure works. So prove it: mend the class, add it again, run.

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
# | silence | `ros.explain(topic)` | who is on both sides, whether they fit, who has ended |
# | silence, and all seems well | `ros.graph()` | each name, letter by letter; who listens where |
# | it stopped | `ros.messages(topic)[-1]` | when the last message came, and from whom |
# | something is missing | `ros.logs(node)` | what a node has heard, and when it began |
# | too many, too few | `ros.explain(topic)` | messages a second, for each publisher |
# | odd numbers | `viz.values(ros.observation(), topic)` | each reading, with its limits as bands |
# | odd order | `viz.timeline(ros.observation())` | what caused what |
#
# And where does which cause show? The four questions again, with the names of the causes:
#
# | question | causes that answer it with no |
# |---|---|
# | published? | `never-published`, `gone-quiet`, `node-ended`, `not-spun`, `callback-blocks` |
# | matched? | `topic-misspelled`, `wrong-namespace`, `wrong-topic`, `qos-mismatch`, `type-mismatch` |
# | taken? | `not-spun`, `depth-too-small`, `first-messages-lost` |
# | right? | `wrong-unit`, `never-changes`, `no-clamp`, `clamped-too-early`, `boundary`, `two-sources`, `run-twice`, `wrong-rate` |
#
# `clinic.names()`, further down, explains each of these ids.

# %% [markdown]
# ## Walk through the ward
#
# Eleven patients wait. All are real nodes that have run for a minute. Their code stays closed.

# %%
ward = clinic.Ward(seed=7)
patient = ward.patient(1)
patient

# %% [markdown]
# The owner's words come first: they tell no cause, and what they call *fine* is fine. `Ordered` is how the
# system should be: who publishes on which topic, who listens, and what the numbers mean. `patient.ros` is
# an ordinary session, so every instrument fits.

# %%
viz.graph(patient.ros.graph())

# %% [markdown]
# Go along the order with a finger, and look for each name in the picture. Is every node there? Does
# each stand at the topic that was ordered?
#
# One caution about `ros.explain`: it speaks of one topic only. Ask it first about the topic where the
# silence begins, seen from the sensor. Of a topic further down it may say that the guard has published
# nothing. That is true, and yet the guard may be healthy, with nothing to talk about. What looks like a
# fault there is a symptom.

# %% [markdown]
# A diagnosis is an id and a place. The place is the full name of the node or of the topic where the
# fault is, not where it hurts. If a fault lies between two nodes, the topic is a good answer. The clinic
# knows twenty ids, and not all of them occur:

# %%
clinic.names()

# %% [markdown]
# ## Try it: something is silent
#
# Patients 1 to 4 have one fault each. Here are the other three.

# %%
for number in (2, 3, 4):
    print(ward.patient(number))

# %% [markdown]
# Examine one after the other: change the number below, add cells, use any instrument. Write down what each
# of them rules out. `hint("10a")` costs nothing. It is only counted.

# %%
patient = ward.patient(2)
viz.timeline(patient.ros.observation(), until=3)

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
# A wrong diagnosis is told what speaks against it. You may check as often as you like, and with some
# patients left blank.
#
# ## Try it: nothing is silent
#
# Patients 5 to 8 are harder. Every message arrives, and `ros.explain` says that all is well. Something is
# wrong all the same.

# %%
for number in (5, 6, 7, 8):
    print(ward.patient(number))

# %%
patient = ward.patient(8)
limits = {"as ordered": (23, 31)}
viz.values(patient.ros.observation(), "pool_temperature", bands=limits, unit="°C")

# %% [markdown]
# The picture tells more than a hundred log lines: the band is what was ordered, and the readings are what
# came. The last question of the four is the one that counts here: is the value right? Compare what you
# see with what was ordered, number by number: limits, steps, rate, and who speaks. `ros.graph()` is still
# of use, for a node that listens to the wrong topic hears something, too.

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
# ## What went wrong: cured, and still dark
#
# The first patient again, with its mended lamp and another guard. Its owner has found a fault, the topic's
# name, and is sure: mend it, and the lamp shines. **Predict:** does it?

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

# %%
ros.remove("guard")
ros.add(Guard, remappings={"temprature": "temperature"})
ros.run(seconds=10)
ros.explain("status")

# %% [markdown]
# **Symptom:** the cure is right, and nothing changes. **Instrument:** the same questions once more, from
# the sensor on. **Cause:** a second fault hid behind the first. A deaf guard cannot show that it is also
# mute: no number is above 28 *and* below 20. **Cure:** after each cure, look at the whole system again.
#
# ## Try it: two faults
#
# Patients 9 to 11 have two faults each, at different places. The order does not matter.

# %%
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
# **How it can be found.** In the stable, the logger listens to a name that nobody else uses, and the lamp
# asks for stored messages: both show in `viz.graph`. In the server room the diary has taken two of every
# five readings, `ros.logs` says, and 290 degrees are Kelvin. In the beehive the sensor publishes every two
# seconds instead of one, and the logger has ended: `ros.explain` says both.

# %% [markdown]
# ## Remember
#
# - A symptom is where it hurts; the cause may be elsewhere. Do not mend where it hurts.
# - Halve the system: published, matched, taken, value right?
# - What works is a clue too: it crosses out all that it needs.
# - A diagnosis is proved by its cure. Then look again: faults hide behind faults.
#
# **The same outside of the notebook:** `ros2 node list`, `ros2 topic info -v /status` (both sides and their
# QoS), `ros2 topic hz /status`, `ros2 topic echo /status`, and `rosbeat explain status`.
#
# More to examine: `clinic.Ward(seed=8)` is another ward. Begin your dict with `"ward": 8`, and the
# checks judge that one.
#
# **Next:** [record and replay](11_record_and_replay.ipynb), to look at one run as often as you like.

# %%
progress()
