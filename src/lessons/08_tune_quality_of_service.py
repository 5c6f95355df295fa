# ---
# title: Tune quality of service
# minutes: 45
# needs: ["04", "07"]
# summary: Decide what happens to messages that wait, come late or never come.
# ---

# %% [markdown]
# # Tune quality of service
#
# **Goal:** you decide what happens to messages that wait, get lost, come late or never come.
#
# **Time:** 45 minutes. **You need:** [write a subscriber](04_write_a_subscriber.ipynb) and
# [look inside the graph](07_look_inside_the_graph.ipynb).
#
# | what may happen to a message | the policy that decides |
# |---|---|
# | it waits for a busy node | **depth** |
# | it gets lost on the way | **reliability** |
# | somebody comes after it | **durability** |
# | it does not come in time | **deadline** |
# | it is too old when it is read | **lifespan** |

# %%
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, QoSProfile, ReliabilityPolicy
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import Float32, Int32, String

from rosbeat import Session, check, hint, predict, progress, viz, workspace
from rosbeat.records import queue_steps

# %% [markdown]
# All of these together are the **quality of service**, QoS for short. Each end of a topic has one: each
# publisher, and each subscription. You have given it every time: the `10` is short for
# `QoSProfile(depth=10)`, and what you leave out has a default.
#
# ## Bring a source and a collector
#
# The source counts, one number a second, so that you see which one is missing. The collector keeps what
# it gets in a list. Both are handed their QoS. (Further down, `lambda: Source(10)` is a small function
# without a name: the session calls it to make the node.)

# %%
class Source(Node):
    def __init__(self, qos):
        super().__init__("source")
        self.publisher = self.create_publisher(Int32, "number", qos)
        self.create_timer(1.0, self.count)
        self.number = 0

    def count(self):
        self.number += 1
        self.publisher.publish(Int32(data=self.number))


class Collector(Node):
    def __init__(self, qos):
        super().__init__("collector")
        self.create_subscription(Int32, "number", self.collect, qos)
        self.got = []

    def collect(self, msg):
        self.got.append(msg.data)

# %%
with Session() as ros:
    ros.add(lambda: Source(10))
    ros.add(lambda: Collector(QoSProfile(depth=5)))
    for kind in ("publisher", "subscription"):
        for end in ros.graph().on("/number", kind):
            qos = end.qos
            print(f"{kind:13}", qos.reliability, qos.durability, qos.history, qos.depth)

# %% [markdown]
# This is the default: `RELIABLE`, `VOLATILE`, and `KEEP_LAST` with a depth. You meet these words one by
# one.
#
# ## Depth: which queue drops?
#
# The tutorial says of the publisher's 10 that it "keeps last 10 messages if subscribers are slow", and of
# the subscriber's 10 nearly the same. Is it true of both? The next function lets a collector be busy for
# 20 seconds while 20 numbers are published. `offers` is the publisher's QoS, `asks` the subscriber's.

# %%
def busy(offers, asks):
    with Session() as ros:
        ros.add(lambda: Source(offers))
        collector = ros.add(lambda: Collector(asks))
        ros.pause(collector)
        ros.run(seconds=20)
        ros.resume(collector)
        ros.run(seconds=0)
        return collector.got, ros.observation()

# %% [markdown]
# **Predict:** the publisher's depth is 1, the subscriber's is 20. How many of the 20 numbers arrive?

# %% predict=true
got, seen = busy(1, 20)
# --- answer
predict(20, len(got))
# --- blank
# predict("____", len(got))
# --- end

# %%
for offers, asks in ((1, 20), (1, 5), (20, 5), (20, 1)):
    got, seen = busy(offers, asks)
    print(f"publisher {offers:2}, subscriber {asks:2}: {len(got):2} arrive, from {got[0]} on")

got, seen = busy(20, 5)
arrivals = [sample.time_ns for sample in seen.samples]
takes = [call.time_ns for call in seen.callbacks if call.kind == "subscription"]
viz.queue(queue_steps(arrivals, takes, depth=5), depth=5)

# %% [markdown]
# Only the subscriber's depth counts. The tutorial is right about the subscriber, and about the publisher
# it is not: a slow subscriber fills a queue of its own. The picture shows that queue with depth 5. From 6
# seconds on, each number pushes the oldest one out: that is `KEEP_LAST`.
#
# What is the publisher's depth good for, then? For those who come late; you see that in a moment. And for
# messages that the middleware cannot deliver yet: the network is slow, or the subscriber's whole process stands
# still. In a session every message is delivered at once, so this page cannot show that.

# %% [markdown]
# ## Reliability: offer and ask
#
# A `RELIABLE` publisher sends a message again if it gets lost. A `BEST_EFFORT` one sends it once: good
# for a camera, where the next picture comes anyway. The publisher **offers** one, the subscription
# **asks** for one.
#
# **Predict:** the publisher offers best effort, and the subscription asks for reliable. Both have depth 10. How
# many numbers does the busy collector get?

# %% predict=true
RELIABLE, BEST_EFFORT = ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT
once, again = (QoSProfile(depth=10, reliability=one) for one in (BEST_EFFORT, RELIABLE))
got, seen = busy(once, again)
# --- answer
predict(0, len(got))
# --- blank
# predict("____", len(got))
# --- end

# %%
for offers in (again, once):
    for asks in (again, once):
        names = f"offers {offers.reliability.name:11}  asks {asks.reliability.name:11}"
        print(names, f"{len(busy(offers, asks)[0]):2} arrive")

# %% [markdown]
# Nothing gets lost in one process, so three rows are alike. In the third, the two are not connected. The rule
# is: **the publisher must offer at least what the subscriber asks for.** If it does not, there is silence, and
# no error.
#
# ## Durability: who comes late
#
# A `VOLATILE` publisher keeps nothing for those who come late. A `TRANSIENT_LOCAL` one does: as many
# messages as its depth. The next collector comes after 8 seconds and stays for 2.
#
# **Predict:** both sides say `TRANSIENT_LOCAL`, with depth 5. Which is the first number that it gets?

# %% predict=true
def late(offers, asks):
    with Session() as ros:
        ros.add(lambda: Source(offers))
        ros.run(seconds=8)
        collector = ros.add(lambda: Collector(asks))
        ros.run(seconds=2)
        return collector.got

KEPT = DurabilityPolicy.TRANSIENT_LOCAL
got = late(QoSProfile(depth=5, durability=KEPT), QoSProfile(depth=5, durability=KEPT))
# --- answer
predict(4, got[0], because=f"It got {got}.")
# --- blank
# predict("____", got[0], because=f"It got {got}.")
# --- end

# %%
kept, volatile = QoSProfile(depth=5, durability=KEPT), QoSProfile(depth=5)
for offers in (kept, volatile):
    for asks in (kept, volatile):
        names = f"offers {offers.durability.name:15}  asks {asks.durability.name:15}"
        print(names, late(offers, asks))
for offers, asks in ((5, 10), (1, 10), (10, 1)):
    got = late(*(QoSProfile(depth=depth, durability=KEPT) for depth in (offers, asks)))
    print(f"publisher's depth {offers:2}, subscription's {asks:2}", got)

# %% [markdown]
# Upper part: only if *both* say so does anything old arrive. And the same rule again: who asks for more
# than is offered gets nothing at all, not even what is new.
#
# Lower part: here the publisher's depth counts, and the subscription's, too. The smaller one wins.
#
# ## Try it: the last word waits
#
# A robot has a mode: first `idle`, then whatever comes on `command`. Displays come and go. Write the node
# so that
#
# - it publishes the mode on `mode` at once and at each change, and not if the mode stays as it is;
# - a display that comes late and asks for it gets the mode of that moment, and no older one.

# %% exercise="08a"
class ModeKeeper(Node):
    def __init__(self):
        super().__init__("mode_keeper")
        # --- answer
        qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        # --- blank
        # qos = ____
        # --- end
        self.modes = self.create_publisher(String, "mode", qos)
        self.create_subscription(String, "command", self.obey, 10)
        self.change("idle")

    def obey(self, msg):
        # --- answer
        if msg.data != self.mode:
            self.change(msg.data)
        # --- blank
        # ____
        # --- end

    def change(self, mode):
        self.mode = mode
        self.modes.publish(String(data=mode))

# %% check="08a"
check("08a", ModeKeeper)

# %% [markdown]
# ## Try it: listen to everybody
#
# An archive copies each reading from `reading` to `archive`. There are two sensors on that topic, and each
# publishes once a second. The old one offers reliable, the new one best effort. Now and then the
# archive is busy for 8 seconds. Choose its QoS so that it hears both and loses nothing.

# %% exercise="08b"
class Archive(Node):
    def __init__(self):
        super().__init__("archive")
        # --- answer
        qos = QoSProfile(depth=16, reliability=ReliabilityPolicy.BEST_EFFORT)
        # --- blank
        # qos = ____
        # --- end
        self.create_subscription(Float32, "reading", self.copy, qos)
        self.copies = self.create_publisher(Float32, "archive", 10)

    def copy(self, msg):
        self.copies.publish(msg)

# %% check="08b"
check("08b", Archive)

# %% [markdown]
# ## Deadline: silence is news
#
# A subscriber reacts to messages. So how does it notice that none come? With a **deadline**: the longest
# time from one message to the next. The publisher promises one, the subscription asks for one, and the
# rule is the same: a promise of 1.5 seconds is good enough for 2. If time runs out, the
# middleware calls a method of yours. Such a call is an **event**, and `event_callbacks` says what to call.

# %%
class Guard(Node):
    def __init__(self, qos):
        super().__init__("guard")
        told = SubscriptionEventCallbacks(deadline=self.on_missed)
        self.create_subscription(Int32, "number", self.on_number, qos, event_callbacks=told)

    def on_number(self, msg):
        self.get_logger().info(f"number {msg.data}")

    def on_missed(self, event):
        self.get_logger().warning(f"missed {event.total_count}")

# %% [markdown]
# **Predict:** the source rests from 3 seconds to 9.5. How often is the deadline of 2 seconds missed?

# %% predict=true
with Session() as ros:
    ros.add(lambda: Source(QoSProfile(depth=10, deadline=Duration(seconds=1.5))))
    ros.add(lambda: Guard(QoSProfile(depth=10, deadline=Duration(seconds=2))))
    ros.run(seconds=3)
    ros.pause("source")
    ros.run(seconds=6.5)
    ros.resume("source")
    ros.run(seconds=1)
    missed = [line.time for line in ros.logs("guard") if line.level == "WARN"]

# --- answer
predict(3, len(missed), because=f"The events came at {missed} s.")
# --- blank
# predict("____", len(missed), because=f"The events came at {missed} s.")
# --- end

# %% [markdown]
# The event comes in each further period, so a node that wants to say it once has to remember. The
# publisher can be told, too, when it breaks its own promise: with `PublisherEventCallbacks(deadline=...)`.
#
# ## Lifespan: too old to be read
#
# A **lifespan** says how long a message is good. Whatever is older is dropped from the queue of the end
# that has one. Here is the busy collector again, with room for all 20 numbers.
#
# **Predict:** the subscription has a lifespan of 3.5 seconds. How many of the 20 numbers does it get?

# %% predict=true
short = Duration(seconds=3.5)
got, seen = busy(20, QoSProfile(depth=20, lifespan=short))
# --- answer
predict(4, len(got), because=f"It got {got}.")
# --- blank
# predict("____", len(got), because=f"It got {got}.")
# --- end

# %%
kept_shortly = QoSProfile(depth=20, durability=KEPT, lifespan=short)
print(len(busy(kept_shortly, 20)[0]), "arrive if the publisher has the lifespan")
print(late(kept_shortly, QoSProfile(depth=20, durability=KEPT)), "for a late collector")

# %% [markdown]
# The others were too old. And it is two queues again: the publisher's lifespan is for what it keeps for
# those who come late, and what has reached a subscription stays there. (That is what Fast DDS does, the
# middleware that runs here. Others may differ.)
#
# The session's clock counts deadlines and lifespans. Liveliness, one more policy, is watched by the middleware
# itself, in real time: [what is simulated, and how](../docs/architecture.md#what-is-simulated-and-how).
#
# ## Try it: silence is news
#
# A sensor on `temperature` promises a reading every 2 seconds, and does not always keep its promise. Write
# a watchdog that publishes on `health`
#
# - `lost`, once, when nothing has come for 2 seconds;
# - `back`, once, when readings come again.

# %% exercise="08c"
class Watchdog(Node):
    def __init__(self):
        super().__init__("watchdog")
        self.health = self.create_publisher(String, "health", 10)
        self.word = "back"
        # --- answer
        qos = QoSProfile(depth=10, deadline=Duration(seconds=2))
        events = SubscriptionEventCallbacks(deadline=self.on_silence)
        # --- blank
        # qos = ____
        # events = ____
        # --- end
        self.create_subscription(
            Float32, "temperature", self.on_reading, qos, event_callbacks=events
        )

    def on_silence(self, event):
        self.say("lost")

    def on_reading(self, msg):
        self.say("back")

    def say(self, word):
        # --- answer
        if word != self.word:
            self.word = word
            self.health.publish(String(data=word))
        # --- blank
        # ____
        # --- end

# %% check="08c"
check("08c", Watchdog)

# %% [markdown]
# ## What went wrong: two defaults that do not fit
#
# rclpy brings ready-made profiles. `SENSOR_DATA` is made for cameras, laser scanners and the like. A monitor
# that is written with `10`, as ever, is to listen to one of these.

# %%
for name in ("SENSOR_DATA", "SERVICES_DEFAULT", "PARAMETER_EVENTS"):
    qos = QoSPresetProfiles[name].value
    print(f"{name:16} {qos.reliability.name:11} {qos.durability.name}, depth {qos.depth}")

with Session() as ros:
    ros.add(lambda: Source(qos_profile_sensor_data))
    ros.add(lambda: Collector(10))
    ros.run(seconds=5)
    for kind in ("publisher", "subscription"):
        for end in ros.graph().on("/number", kind):
            print(end.node, "is connected to", end.matched)
    why = ros.explain("number")
why

# %% [markdown]
# **Symptom:** silence, and no error. **Instruments:** both nodes are in the graph, on the same topic, and
# `matched` is 0; `ros.explain` says which policy. **Cause:** the subscription asks for more than is
# offered. **Cure:** ask for less.
#
# Between two processes there is one more sign. There is an event for this, too, `incompatible_qos`, and if
# you give it no callback, rclpy writes a warning:

# %% terminal="sensor --until publishing" tags=["nbval-ignore-output"]
# ros2 topic pub --rate 5 --qos-profile sensor_data /number std_msgs/msg/Int32 "{data: 1}"

# %% terminal="listener --until incompatible" tags=["nbval-ignore-output"]
# ros2 topic echo --qos-reliability reliable /number std_msgs/msg/Int32

# %%
listener = workspace.terminal("listener")
listener.wait_for("incompatible", timeout=30)
warning = listener.logs()[0]
for name in ("sensor", "listener"):
    workspace.terminal(name).close()
print(warning.level, warning.text)

# %% [markdown]
# Among many lines, this one is soon out of sight. (Without an option, `ros2 topic echo` looks at the
# publisher first, and asks for what it offers.)
#
# ## Choose
#
# | what you want | policy | what it costs |
# |---|---|---|
# | nothing lost while I am busy | a deeper queue at the **subscription** | memory, and old news when I am back |
# | nothing lost on the way | reliable on both sides | some messages are sent twice |
# | to hear everybody | ask for best effort | what gets lost is lost |
# | the last word for those who come late | transient local on both sides, depth 1 at the publisher | the publisher keeps it as long as it lives |
# | to notice silence | a deadline on both sides, and an event | a promise that has to be kept |
# | no old news | a lifespan, where they would wait | what nobody reads in time is gone |
#
# ## Remember
#
# - The publisher must offer at least what the subscription asks for, or there is silence.
# - A slow subscriber has a queue of its own. The publisher's depth is for those who come late.
# - `TRANSIENT_LOCAL` on both sides gives them the last messages.
# - A deadline makes silence an event.
#
# **Outside of the notebook**, `ros2 topic info --verbose` shows what each end offers or asks for, and
# `ros2 topic echo` can ask for what you like:
#
# ```bash
# ros2 topic info --verbose /temperature
# ros2 topic echo --qos-reliability best_effort /temperature
# ros2 topic echo --qos-durability transient_local --qos-reliability reliable /mode
# ```
#
# **Next:** [test the five claims](09_test_the_five_claims.ipynb) of the tutorial.

# %%
progress()
