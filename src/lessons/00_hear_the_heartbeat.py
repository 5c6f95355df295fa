# ---
# title: Hear the heartbeat
# minutes: 20
# needs: []
# summary: Run real ROS 2 nodes in a page, and see how publishers and subscribers talk without knowing each other.
# ---

# %% [markdown]
# # Hear the heartbeat
#
# **Goal:** you run your first ROS 2 nodes and see how they talk without knowing each other.
#
# **Time:** 20 minutes. **You need:** a little Python: classes, methods, `self`.
#
# A page is made of **cells**. Click into the first one and press `Shift` + `Enter` to run it; go on
# from top to bottom. A `[*]` beside a cell means that it is still running. If you get lost, choose
# *Kernel, Restart Kernel* from the menu and begin again at the top.

# %% [markdown]
# ## Send the first message
#
# A robot's software has many small parts that talk. In ROS 2 such a part is called a **node**. On a
# robot it is often a program of its own; here, several can share a page. What one node sends to
# others is a **message**. Here is a whole node. It plays a thermometer. Run the next three cells.

# %%
from rclpy.node import Node
from std_msgs.msg import Float32, String

from rosbeat import Session, check, hint, predict, progress, viz

# %%
class Thermometer(Node):
    def __init__(self):
        super().__init__("thermometer")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(1.0, self.publish_temperature)

    def publish_temperature(self):
        self.publisher.publish(Float32(data=22.5))
        self.get_logger().info("It is 22.5 degrees")

# %%
ros = Session()
ros.add(Thermometer)
ros.run(seconds=3)

# %% [markdown]
# That is a heartbeat: one message a second. Each line is a **log** line, a note for people. The
# number after `INFO` is the time in seconds, and the name after it is the node that speaks.
#
# You did not wait three seconds. A `Session` runs real ROS nodes in **virtual time**: its clock
# jumps from one event to the next. So a minute takes almost no time, and you get the same result as
# everybody else.
#
# **Predict:** a second session runs the same thermometer for a whole minute. How many messages does it
# send? Write a number in place of the blank, then run the cell. To be wrong costs nothing.

# %% predict=true
with Session() as minute:
    minute.add(Thermometer)
    minute.run(seconds=60, quiet=True)
    sent = len(minute.messages("temperature"))

# --- answer
predict("60", sent)
# --- blank
# predict("____", sent)
# --- end

# %% [markdown]
# One each second. `with` closes the session at the end of the block, and `quiet=True` only keeps the log lines
# off the page; the messages were sent, and a session records each of them. `ros.messages` gives them all. Here is
# the first one of the first session: when it was sent (in seconds), where, from whom, and its value.
#
# A session plays each node as a **process** of its own, which is a running program, and the messages go through
# real ROS software: [what is simulated, and how](../docs/architecture.md#what-is-simulated-and-how).

# %%
ros.messages("temperature")[0]

# %% [markdown]
# ## Meet the newsroom
#
# Think of a newsroom. Reporters write articles: one on sports, one on politics, one on the weather.
# Readers follow what interests them. A reader of sports does not care about politics, and a reporter
# need not know who reads.
#
# ROS 2 has a word for each of these:
#
# - a **topic** is a named channel, such as `weather`;
# - a **publisher** sends messages to a topic;
# - a **subscriber** receives the messages of a topic, each in a function called its **callback**.
#
# This is **publish and subscribe**, or pub/sub for short. On these pages the two sides need to agree
# on two things: the topic's name, and the **message type**, which says what kind of data a message
# carries.

# %% [markdown]
# Here is a reporter. It publishes text, which has the message type `String`, on a topic that you
# choose. `create_timer(1.0, self.write)` makes a **timer**: it calls `write` every 1.0 seconds. What
# the 10 means comes on a later page.

# %%
class Reporter(Node):
    def __init__(self, topic, article):
        super().__init__(topic + "_reporter")
        self.article = article
        self.publisher = self.create_publisher(String, topic, 10)
        self.timer = self.create_timer(1.0, self.write)

    def write(self):
        self.publisher.publish(String(data=self.article))

# %% [markdown]
# And a reader. It has no timer: it waits. ROS calls `read` whenever a message arrives.

# %%
class Reader(Node):
    def __init__(self, name, topic):
        super().__init__(name)
        self.subscription = self.create_subscription(String, topic, self.read, 10)

    def read(self, msg):
        self.get_logger().info(f"I read: {msg.data}")

# %% [markdown]
# `add` takes a class, as before, or a node that you make yourself, when its constructor needs
# arguments. `ros.close()` ends the first session.
#
# **Predict:** three reporters write, two readers read. Nobody reads politics. Which lines appear?

# %%
ros.close()
newsroom = Session()
newsroom.add(Reporter("sports", "Our team won"))
newsroom.add(Reporter("politics", "The council met"))
newsroom.add(Reporter("weather", "Sun all day"))
newsroom.add(Reader("ana", "sports"))
newsroom.add(Reader("ben", "weather"))
newsroom.run(seconds=2)

# %% [markdown]
# Ana gets sports, Ben gets the weather, and nobody gets anything else. The picture shows why:
# ellipses are nodes, boxes are topics, and messages follow the arrows. The slash belongs to the full
# name: `weather` and `/weather` are the same topic here.

# %%
viz.graph(newsroom.graph())

# %% [markdown]
# Together, the nodes and their topics are called the **ROS graph**. Notice that no arrow leads from
# a node to a node. All of them go through a topic.

# %%
viz.timeline(newsroom.observation())

# %% [markdown]
# Time runs from left to right. Squares are timer callbacks, circles are subscription callbacks. The
# messages on sports and weather arrive at the same instant of virtual time; on a robot it takes a
# moment. The short arrows are politics: nobody takes them.
#
# ## Take the newsroom apart
#
# Publishers and subscribers do not know each other. We say that they are **decoupled**. That is a
# claim, and you can test it.
#
# **Does a publisher need a subscriber?** Nobody reads politics. **Predict:** how many messages were
# published there?

# %% predict=true
# --- answer
predict("2", len(newsroom.messages("politics")))
# --- blank
# predict("____", len(newsroom.messages("politics")))
# --- end

# %% [markdown]
# The politics reporter published two messages. It does not need to know whether anybody listens.
#
# **Does a publisher notice when somebody comes?** Cleo joins late. No line of a reporter changes.

# %%
newsroom.add(Reader("cleo", "weather"))
newsroom.run(seconds=1)

# %% [markdown]
# Cleo reads what is published from now on. She does not get earlier messages.
#
# **Does a subscriber need a publisher?** Take the weather reporter out.

# %%
newsroom.remove("weather_reporter")
newsroom.run(seconds=2)

# %% [markdown]
# Ben and Cleo hear nothing, and nothing breaks. They go on waiting, and Ana still reads her sports.
# Nodes are decoupled in three ways:
#
# - **in name:** they know a topic, not each other;
# - **in number:** none, one or many can be on either side;
# - **in time:** each starts and stops by itself.
#
# So each part of a robot can be small, run beside the others, and be used again in another robot.

# %% [markdown]
# ## Try it: read the weather
#
# Replace the blank `____`, so that this reader gets the weather and nothing else. Run the cell, then
# the check below it. If you are stuck, make a new cell with the `+` above the page and write `hint("00a")`
# in it. Each time it tells you a little more.

# %% exercise="00a"
class WeatherReader(Node):
    def __init__(self):
        super().__init__("weather_reader")
        # --- answer
        self.create_subscription(String, "weather", self.read, 10)
        # --- blank
        # self.create_subscription(String, ____, self.read, 10)
        # --- end

    def read(self, msg):
        self.get_logger().info(f"I read: {msg.data}")

# %% check="00a"
check("00a", WeatherReader)

# %% [markdown]
# ## Try it: report on sports
#
# Now the other side. This reporter publishes an article on `sports` every two seconds. There are two
# blanks this time.

# %% exercise="00b"
class SportsReporter(Node):
    def __init__(self):
        super().__init__("sports_reporter")
        # --- answer
        self.publisher = self.create_publisher(String, "sports", 10)
        self.timer = self.create_timer(2.0, self.write)
        # --- blank
        # self.publisher = self.create_publisher(String, ____, 10)
        # self.timer = self.create_timer(____, self.write)
        # --- end

    def write(self):
        self.publisher.publish(String(data="What a match"))

# %% check="00b"
check("00b", SportsReporter)

# %% [markdown]
# ## What went wrong: one letter
#
# Dan wants to read sports, too. **Predict:** what does he read?

# %%
newsroom.add(Reader("dan", "sport"))
newsroom.run(seconds=1)

# %% [markdown]
# Nothing, and there is no error. That is the price of decoupling: a topic that nobody publishes on
# looks just like a topic where nobody has spoken *yet*. Whenever a node stays silent, ask the session
# why, and look at the graph:

# %%
why = newsroom.explain("sport")
print(why)
viz.graph(why)

# %% [markdown]
# Dan listens to `/sport`, and no one is there: the topic is called `/sports`. Dashed arrows touch a topic that has
# only one side, and the dashed line between the two boxes says that their names are almost the same. (What stands
# in brackets behind the type comes on later pages.) The cure is one letter.

# %%
newsroom.add(Reader("dan", "sports"))
newsroom.run(seconds=1)
newsroom.close()

# %% [markdown]
# In a session, a node replaces an older one of its name. On a robot both would run.
#
# ## Remember
#
# - A **node** is a small part of a robot's software, with one job.
# - A **publisher** sends messages to a **topic**; a **subscriber** gets them in its **callback**.
# - They agree on the topic's name and the message type, and need not know each other.
# - When nothing arrives, ask `explain`, and look at the graph.
#
# Only clock and data are made up. These classes are ordinary ROS 2 code, and the messages
# went through the **middleware** that robots use: the software that carries them.
#
# **Next:** [create a workspace](01_create_a_workspace.ipynb). The last cell draws how far you are; its last row
# is for the end.

# %%
progress()
