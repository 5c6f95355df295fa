# ---
# title: Tune quality of service
# minutes: 45
# needs: ["04", "07"]
# summary: Decide what happens to messages that wait, get lost, come too late or never come.
# ---

# %% [markdown]
# # Tune quality of service
#
# **After this page, you can:**
#
# - choose the depth of a queue for a busy subscriber (08.3);
# - predict whether two endpoints fit (08b, 08.1);
# - keep the last message for late-joining subscriptions (08a, 08.2);
# - count missed deadlines (08c).
#
# **Time:** 45 minutes. **You need:** [write a subscriber](04_write_a_subscriber.ipynb) and
# [look inside the graph](07_look_inside_the_graph.ipynb).
#
# You can choose how ROS 2 delivers messages. These settings are called [**quality of
# service**](../docs/glossary.md#quality-of-service), or QoS for short. Each of them is a
# [**policy**](../docs/glossary.md#policy):
#
# | what can happen to a message | the policy that decides |
# |---|---|
# | it waits for a busy node | [**depth**](../docs/glossary.md#depth) |
# | it gets lost on the way | [**reliability**](../docs/glossary.md#reliability) |
# | a subscriber joins after it was sent | [**durability**](../docs/glossary.md#durability) |
# | it doesn't come in time | [**deadline**](../docs/glossary.md#deadline) |
# | it's too old when it's read | [**lifespan**](../docs/glossary.md#lifespan) |

# %%
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, QoSProfile, ReliabilityPolicy
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import Float32, Int32, String

viz.diagram("08")

# %% [markdown]
# Each publisher and each subscription is an [**endpoint**](../docs/glossary.md#endpoint) of its topic. Every
# endpoint has a [**QoS profile**](../docs/glossary.md#qos-profile), which holds one value for each policy. You've
# passed a profile every time: the `10` is short for `QoSProfile(depth=10)`. The policies that you leave out have
# default values: `RELIABLE`, `VOLATILE`, `KEEP_LAST`, and neither a deadline nor a lifespan.
#
# ## Create a source and a collector
#
# The source publishes one number a second, counting up, so you can see which number is missing. The collector
# stores what it receives in a list. Both take their QoS as an argument.

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

# %% [markdown]
# ## Depth: which queue drops messages?
#
# The tutorial says that the publisher's 10 "keeps last 10 messages if subscribers are slow", and it says nearly the
# same about the subscriber's 10. Is it true of both?
#
# The next function keeps a collector busy for 20 seconds while 20 numbers are published. `offers` is the
# publisher's QoS, and `asks` is the subscriber's. The function returns the session, and the numbers that arrived.
#
# **Predict:** the publisher's depth is 1, and the subscriber's is 20. How many of the 20 numbers arrive?

# %% predict=true
def busy(offers, asks):
    ros = Session()
    ros.add(Source(offers))
    collector = ros.add(Collector(asks))
    ros.pause(collector)
    ros.run(seconds=20)
    ros.resume(collector)
    ros.run(seconds=0)
    return ros, collector.got

ros, got = busy(1, 20)
# --- answer
predict(20, len(got))
# --- blank
# predict("____", len(got))
# --- end

# %% shows=true
ros, got = busy(20, 5)
print(got)
viz.queue(ros, "number")

# %% [markdown] answers=true
# This time, the publisher's depth was 20 and the subscriber's 5, and five numbers arrived. The tutorial is right about
# the subscriber, but not about the publisher: messages for a slow subscriber wait in the subscriber's own queue. The
# picture shows that queue. From 6 seconds on, each new number pushes the oldest one out: that's `KEEP_LAST`.

# %% [markdown]
# The publisher's depth matters to subscribers that join late and ask for stored messages. It also matters when the
# middleware can't deliver messages yet, because the network is slow or the subscriber's whole process is suspended.
# This page can't show that, because a session delivers every message at once.
#
# ## Reliability: offer and request
#
# If a message gets lost, a `RELIABLE` publisher sends it again, as long as it's still in the publisher's queue. A
# `BEST_EFFORT` publisher sends it only once. That's fine for a camera, where the next picture comes anyway.
#
# A publisher **offers** one of the two. A subscription **requests** one; this page also says that it *asks for* it.
#
# **Predict:** the publisher offers best effort, and the subscription asks for reliable. Both have a depth of 10.
# How many numbers does the busy collector get?

# %% predict=true
best_effort = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
reliable = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)
ros, got = busy(offers=best_effort, asks=reliable)
# --- answer
predict(0, len(got))
# --- blank
# predict("____", len(got))
# --- end

# %% shows=true
for offers in (reliable, best_effort):
    for asks in (reliable, best_effort):
        ros, got = busy(offers, asks)
        print(f"offers {offers.reliability.name:11}  asks {asks.reliability.name:11}", got)

# %% [markdown] answers=true
# In a session, nothing gets lost on the way, so three of the rows are alike: the collector's queue of 10 drops the
# rest. In the third row, the two endpoints aren't connected, because their QoS is
# [**incompatible**](../docs/glossary.md#incompatible). The rule is: **the publisher must offer at least what the
# subscription asks for.** If it doesn't, no messages arrive. There's no error, only a warning: each side logs one line
# when it discovers the other, and nothing after that. (The collector's line came late because it was paused.)

# %% [markdown]
# ## Durability: what a late subscriber gets
#
# A subscription is [**late-joining**](../docs/glossary.md#late-joining) if it's created after messages have been
# published. A `VOLATILE` publisher stores nothing for late-joining subscriptions. A `TRANSIENT_LOCAL` publisher
# stores as many messages as its depth.
#
# The next collector joins after 8 seconds and stays for 2.

# %%
def late(offers, asks):
    ros = Session()
    ros.add(Source(offers))
    ros.run(seconds=8)
    collector = ros.add(Collector(asks))
    ros.run(seconds=2)
    return collector.got

def stored(depth):
    return QoSProfile(depth=depth, durability=DurabilityPolicy.TRANSIENT_LOCAL)

# %% [markdown]
# **Predict:** both sides use `TRANSIENT_LOCAL`, with a depth of 5. Which is the first number that the collector
# gets?

# %% predict=true
got = late(stored(5), stored(5))
# --- answer
predict(4, got[0])
# --- blank
# predict("____", got[0])
# --- end

# %% shows=true
for offers in (stored(5), QoSProfile(depth=5)):
    for asks in (stored(5), QoSProfile(depth=5)):
        names = f"offers {offers.durability.name:15}  asks {asks.durability.name:15}"
        print(names, late(offers, asks))
for offers, asks in ((5, 10), (1, 10), (10, 1)):
    got = late(stored(offers), stored(asks))
    print(f"publisher's depth {offers:2}, subscription's {asks:2}", got)

# %% [markdown] answers=true
# When the collector joins, the publisher has stored its last five numbers, 4 to 8. The first four rows show that
# stored messages arrive only if *both* sides use `TRANSIENT_LOCAL`. The same rule applies: a subscription that asks
# for more than the publisher offers gets nothing at all, not even new messages. In the last three rows, the smaller of
# the two depths decides.

# %% [markdown]
# ## Try it: the current mode
#
# A robot has a mode. The first one is `idle`; after that, each message on `command` sets it. Displays come and go.
# Complete the node so that:
#
# - it publishes the mode on `mode`, at once when it starts and at each change, but not if the mode stays as it is;
# - a late-joining display that asks for stored messages gets the current mode, and no older one.

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
# An archive copies each reading from `reading` to `archive`. Two sensors publish on `reading`, each of them once a
# second. The old sensor offers reliable, and the new one offers best effort. Now and then, the archive is busy for
# 8 seconds. Choose its QoS so that it hears both sensors and loses nothing.

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
# ## Deadline: notice a silence
#
# How does a subscriber notice that no messages are coming? With a **deadline**: the longest time allowed between one
# message and the next. The publisher offers one, which is a promise, and the subscription asks for one. The rule is the
# same: a promise of 1.5 seconds is good enough for a subscription that asks for 2.
#
# When a deadline is missed, the middleware reports an [**event**](../docs/glossary.md#event), and ROS calls a
# method of yours. `event_callbacks` says which one.

# %%
class Guard(Node):
    def __init__(self, qos):
        super().__init__("guard")
        events = SubscriptionEventCallbacks(deadline=self.on_missed)
        self.create_subscription(Int32, "number", self.on_number, qos, event_callbacks=events)
        self.missed = 0

    def on_number(self, msg):
        self.get_logger().info(f"number {msg.data}")

    def on_missed(self, event):
        self.missed = event.total_count
        self.get_logger().warning(f"missed {event.total_count}")

# %% [markdown]
# **Predict:** the source is paused from 3 seconds to 9.5. How often is the deadline of 2 seconds missed?

# %% predict=true
ros = Session()
source = ros.add(Source(QoSProfile(depth=10, deadline=Duration(seconds=1.5))))
guard = ros.add(Guard(QoSProfile(depth=10, deadline=Duration(seconds=2))))
ros.run(seconds=3)
ros.pause(source)
ros.run(seconds=6.5)
ros.resume(source)
ros.run(seconds=1)
# --- answer
predict(3, guard.missed)
# --- blank
# predict("____", guard.missed)
# --- end

# %% [markdown] answers=true
# The last number came at 3 seconds, so the deadline is missed at 5, 7 and 9. The event repeats after each further
# period of silence.

# %% [markdown]
# ## Lifespan: drop old messages
#
# A **lifespan** says how long a message is valid. Each endpoint with a lifespan drops older messages from its own
# queue. Here is the busy collector again, with room for all 20 numbers.
#
# **Predict:** the subscription has a lifespan of 3.5 seconds. How many of the 20 numbers does it get?

# %% predict=true
short = Duration(seconds=3.5)
ros, got = busy(20, QoSProfile(depth=20, lifespan=short))
# --- answer
predict(4, len(got))
# --- blank
# predict("____", len(got))
# --- end

# %% [markdown] answers=true
# The other numbers were too old. A publisher's lifespan applies to the messages that it stores for late-joining
# subscriptions, and not to messages that have already reached a subscription. That's how Fast DDS, the middleware
# that runs here, does it.

# %% [markdown]
# In a session, deadlines and lifespans are measured by the session's clock. One more policy, liveliness, is about
# whether a publisher is still alive; see
# [what is simulated, and how](../docs/architecture.md#what-is-simulated-and-how).
#
# ## Try it: count missed deadlines
#
# A sensor on `temperature` offers a deadline of 2 seconds, but it doesn't always keep this promise. Complete the
# watchdog: each time a deadline of 2 seconds is missed, it publishes on `missed` how many have been missed in a row,
# as an `Int32`. In a long silence, that's 1, then 2, then 3. The next reading starts the count again; at a reading,
# the node publishes nothing.

# %% exercise="08c"
class Watchdog(Node):
    def __init__(self):
        super().__init__("watchdog")
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
        self.missed = self.create_publisher(Int32, "missed", 10)
        self.count = 0

    def on_silence(self, event):
        # --- answer
        self.count += 1
        self.missed.publish(Int32(data=self.count))
        # --- blank
        # ____
        # --- end

    def on_reading(self, msg):
        self.count = 0

# %% check="08c"
check("08c", Watchdog)

# %% [markdown]
# ## What went wrong: two defaults that don't fit
#
# `QoSPresetProfiles` holds ready-made profiles. `SENSOR_DATA`, or `qos_profile_sensor_data` for short, is made for
# cameras and similar sensors. Here, a collector with the usual `10` subscribes to a source that uses it.

# %% shows=true
ros = Session()
ros.add(Source(qos_profile_sensor_data))
ros.add(Collector(10))
ros.run(seconds=5)
ros.explain("number")

# %% [markdown]
# **Symptom:** silence, and no error; only one warning on each side, when the endpoints discovered each other.
# **Where to look:** both nodes are in the graph, on the same topic, but they aren't connected. `ros.explain` tells
# you which policy doesn't fit. **Cause:** the subscription asks for more than the publisher offers. **Fix:** ask for
# less.
#
# The warnings come from an event. Incompatible QoS is one, called `incompatible_qos`, and if you don't pass a
# callback for it, rclpy logs the warning. A command in a terminal does the same:

# %% terminal="sensor --until publishing" tags=["nbval-ignore-output"] shows=true
# timeout 60 ros2 topic pub --rate 5 --qos-profile sensor_data /number std_msgs/msg/Int32 "{data: 1}"

# %% terminal="listener --until incompatible" tags=["nbval-ignore-output"] shows=true
# timeout 60 ros2 topic echo --qos-reliability reliable /number std_msgs/msg/Int32

# %% [markdown]
# Among many other lines, the warning is easy to miss. `timeout` ends both commands after a minute. Without
# `--qos-reliability`, `ros2 topic echo` first looks at what the publisher offers, and asks for that.
#
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("08")

# %% only="solution"
quiz("08", "c", "a", "b")

# %% [markdown]
# ## Remember
#
# The publisher must offer at least what the subscription asks for. If it doesn't, nothing arrives. Choose your policies
# by what you need:
#
# | what you want | policy | what it costs |
# |---|---|---|
# | nothing is lost while a subscriber is busy | a deeper queue at the [**subscription**](../docs/glossary.md#subscription) | memory, and old messages afterwards |
# | nothing is lost on the way | reliable on both sides | some messages are sent twice |
# | every publisher is heard | ask for best effort | a lost message stays lost |
# | late-joining subscriptions get the last message | transient local on both sides, depth 1 at the publisher | the publisher stores it as long as it lives |
# | silence is noticed | a deadline on both sides, and an event callback | a promise that has to be kept |
# | no old messages | a lifespan at the endpoint where they would wait | messages that nobody reads in time are gone |
#
# **Outside the notebook**, `ros2 topic info --verbose` shows what each endpoint offers or asks for, and
# `ros2 topic echo` can ask for the QoS that you choose. If you choose nothing, it follows the publishers. If you
# choose one policy, it takes the others from its defaults, best effort and volatile, so choose both:
#
# ```bash
# ros2 topic info --verbose /temperature
# ros2 topic echo --qos-reliability best_effort /temperature
# ros2 topic echo --qos-durability transient_local --qos-reliability reliable /mode
# ```
#
# **Next:** [test the five claims](09_test_the_five_claims.ipynb) of the tutorial.

# %% shows=true
progress()
