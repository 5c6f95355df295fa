# ---
# title: Hear the heartbeat
# minutes: 35
# needs: []
# summary: Run real ROS 2 nodes in a page, and see how publishers and subscribers talk without knowing each other.
# ---

# %% [markdown]
# # Hear the heartbeat
#
# **After this page, you can:**
#
# - run a ROS 2 node and read what it says (00.2);
# - explain what nodes, topics, messages, publishers and subscribers are (00.1);
# - subscribe to a topic (00a), and publish on one (00b);
# - find out why a node receives nothing (00.3).
#
# A robot is made of many small programs that talk to each other all the time: the driver of a camera, the motor
# controller, the planner that decides where to go. How they talk is the heartbeat of ROS 2, and you're about to
# hear it. This course follows a tutorial, *The Heartbeat of Robotics: Understanding ROS2's Publisher-Subscriber
# System*. You'll run every step of it, and test its claims.
#
# **Time:** 35 minutes. **You need:** a little Python: classes, methods, `self`.
#
# This page is a [**notebook**](../docs/glossary.md#notebook), made of [**cells**](../docs/glossary.md#cell). Click the
# first one with code and press `Shift` + `Enter` to run it, then the next, down to the end. While a cell is running, it
# shows `[*]`. What runs the cells is the page's [**kernel**](../docs/glossary.md#kernel). If you get lost, choose
# *Kernel, Restart Kernel* from the menu and start again at the top.
#
# Run the first cell. It loads what this page needs of ROS, and draws a map of the course. The part in color is where
# you are now.

# %%
from rclpy.node import Node
from std_msgs.msg import Float32, String

viz.diagram("00")

# %% [markdown]
# ## Feel the pulse
#
# Meet Rosie, a small robot that looks after a greenhouse. The first thing Rosie needs is a thermometer. Here is the
# whole program. You don't have to understand every line yet; page 03 explains them all. Run the next two cells.

# %%
class Thermometer(Node):
    def __init__(self):
        super().__init__("thermometer")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(1.0, self.publish_temperature)

    def publish_temperature(self):
        self.publisher.publish(Float32(data=22.5))
        self.get_logger().info("It is 22.5 degrees")

# %% shows=true
rosie = Session()
rosie.add(Thermometer)
rosie.start()
rosie.panel()

# %% [markdown]
# It's alive! Each dot that leaves the thermometer is a [**message**](../docs/glossary.md#message): data that one part
# of the robot sends to the others. The thermometer itself is a [**node**](../docs/glossary.md#node), which is what
# ROS 2 calls such a part. Play with it:
#
# - press *Pause* beside `/thermometer`, count to five, and let it go on;
# - drag the slider to 30 and publish that value yourself: who says that only thermometers may talk?
#
# When you've seen enough, run the next cell to switch Rosie off.

# %%
rosie.close()

# %% [markdown]
# ## Fast-forward
#
# That was real time. Most of this course doesn't have the patience. Here is the same node in a new session:

# %% shows=true
ros = Session()
ros.add(Thermometer)
ros.run(seconds=3)

# %% [markdown]
# Each line is a [**log**](../docs/glossary.md#log) line, which the node writes for people to read. The number after
# `INFO` is the time in seconds, and the name after it tells you which node wrote the line.
#
# You didn't have to wait three seconds, because a [**`Session`**](../docs/glossary.md#session) fast-forwards: when
# nothing is happening, its clock jumps to the next event. That's called [**virtual
# time**](../docs/glossary.md#virtual-time). The nodes are real, and everybody gets exactly the same result.
# `Session`, `viz` and `check` are this course's own names; all the rest is ROS and Python.
#
# **Predict:** the thermometer runs on, until a full minute is on the clock. How many messages will it have sent by
# then? Run the cell, type your guess into the box, and compare. A wrong guess costs nothing.

# %% predict=true
ros.run(seconds=57, quiet=True)
# --- answer
predict("60", len(ros.messages("temperature")))
# --- blank
# predict("____", len(ros.messages("temperature")))
# --- end

# %% [markdown] answers=true
# One every second. `quiet=True` hides the log lines, but not the messages: the session records them all, and
# `ros.messages` returns these records.

# %% [markdown]
# On a robot, each node usually runs as a separate [**process**](../docs/glossary.md#process), the operating system's
# word for a running program. A session gives each node a simulated one. Curious? Read [what is simulated, and
# how](../docs/architecture.md#what-is-simulated-and-how).
#
# ## Visit the newsroom
#
# Picture a newsroom. Reporters write about sports, politics or the weather, and readers follow the subjects that
# interest them. A sports reader doesn't care about politics, and a reporter doesn't need to know who is reading.
#
# ROS 2 has a word for each part of this picture:
#
# - a [**topic**](../docs/glossary.md#topic) is a named channel, such as `weather`;
# - a [**publisher**](../docs/glossary.md#publisher) generates messages and sends them to a topic;
# - a [**subscriber**](../docs/glossary.md#subscriber) receives the messages of a topic. ROS passes each one to a
#   function called a [**callback**](../docs/glossary.md#callback).
#
# This model is called [**publish and subscribe**](../docs/glossary.md#publish-and-subscribe), or pub/sub for short.
# The two sides only have to agree on the name of the topic and on the [**message
# type**](../docs/glossary.md#message-type), which defines what kind of data a message carries.
#
# Here is a reporter. It publishes text, which has the message type `String`, on a topic of your choice. Its
# [**timer**](../docs/glossary.md#timer) calls `write` every 1.0 seconds. Page 03 explains the number 10.

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
# And here is a reader. It has no timer; it simply waits. ROS calls `read` whenever a message arrives.

# %%
class Reader(Node):
    def __init__(self, name, topic):
        super().__init__(name)
        self.subscription = self.create_subscription(String, topic, self.read, 10)

    def read(self, msg):
        self.get_logger().info(f"I read: {msg.data}")

# %% [markdown]
# A `Reporter` has to be told its topic and its article, so this time you create the nodes yourself, and add them to a
# new, empty session.
#
# **Predict:** there are three reporters and two readers, and nobody reads politics. A reader logs a line for each
# message it receives. How many lines appear in two seconds?

# %% predict=true
newsroom = Session()
newsroom.add(Reporter("sports", "Our team won"))
newsroom.add(Reporter("politics", "The council met"))
weather = newsroom.add(Reporter("weather", "Sun all day"))
newsroom.add(Reader("ana", "sports"))
newsroom.add(Reader("ben", "weather"))
newsroom.run(seconds=2)
# --- answer
predict("4", len(newsroom.logs()))
# --- blank
# predict("____", len(newsroom.logs()))
# --- end

# %% [markdown] answers=true
# Ana gets sports, Ben gets the weather, and neither gets anything else.

# %% [markdown]
# The picture shows why: ellipses are nodes, boxes are topics, and messages follow the arrows. The slash is part of a
# topic's full name: here, `weather` and `/weather` are the same topic.

# %% shows=true
viz.graph(newsroom)

# %% [markdown]
# Together, the nodes and their topics form the [**ROS graph**](../docs/glossary.md#ros-graph). Notice that no arrow
# goes directly from one node to another. Every message goes through a topic.
#
# ## Take the newsroom apart
#
# Publishers and subscribers don't know about each other: we say they are
# [**decoupled**](../docs/glossary.md#decoupled). That's a claim you can test.
#
# **Does a publisher need a subscriber?** Nobody reads politics. **Predict:** how many messages were
# published on that topic?

# %% predict=true
# --- answer
predict("2", len(newsroom.messages("politics")))
# --- blank
# predict("____", len(newsroom.messages("politics")))
# --- end

# %% [markdown] answers=true
# The politics reporter published two messages. It doesn't matter to a publisher whether anyone is listening.

# %% [markdown]
# **Does a publisher notice a new subscriber?** Cleo joins late, and not a line of any reporter's code changes.

# %% shows=true
newsroom.add(Reader("cleo", "weather"))
newsroom.run(seconds=1)

# %% [markdown]
# Cleo reads what is published after she joins. She doesn't get earlier messages.
#
# **Does a subscriber need a publisher?** End the weather reporter.

# %% shows=true
weather.destroy_node()
newsroom.run(seconds=2)

# %% [markdown]
# Ben and Cleo hear nothing more, but nothing breaks. They keep waiting, and Ana still reads her sports.
# Nodes are decoupled in three ways:
#
# - **in name:** a node knows the topic, not the nodes on the other side;
# - **in number:** either side can have no nodes, one, or many;
# - **in time:** every node starts and stops on its own, but a late reader misses what was sent before.
#
# ## See what this is good for
#
# In most programming languages, the first program prints *Hello World*. In ROS 2, a publisher and a subscriber play
# that role: the smallest system that introduces how ROS programs communicate. It shows how you create nodes and how
# data flows through the graph. It also needs the two things that every ROS program needs: message types, and a
# [**client library**](../docs/glossary.md#client-library), which connects your language to ROS. For Python, that's
# `rclpy`. Services and actions, the other two ways in which nodes talk, build upon this; page 12 is about them.
#
# The tutorial names five benefits of publish and subscribe. Page 09 puts each of them to the test:
#
# - **modularity:** a large system is made of small nodes, each with a single task, such as a camera driver, a motor
#   controller or a planner;
# - **decentralization:** there is no single point of failure, so if one node crashes, the others can often carry on;
# - **scalability:** you can add nodes without changing existing code;
# - **concurrency:** nodes run independently, often at the same time, and on several cores of a computer;
# - **reusability:** the same node can work in another robot.
#
# ## Try it: read the weather
#
# Replace the blank `____` so that this reader gets the weather and nothing else. Run the cell, and then the check
# below it. If you're stuck, press *Hint* below the check. Each time, it tells you a little more.

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
# Now for the other side. This reporter should publish an article on `sports` every two seconds. This time there
# are two blanks.

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
# ## Add one more reader
#
# Dan wants to read sports, too. **Predict:** how many lines does he log in the next second?

# %% predict=true
newsroom.add(Reader("dan", "sport"))
newsroom.run(seconds=1)
# --- answer
predict("0", len(newsroom.logs("dan")))
# --- blank
# predict("____", len(newsroom.logs("dan")))
# --- end

# %% [markdown] answers=true
# None, and there's no error message either. That's the price of decoupling: to a subscriber, a topic that nobody
# publishes on looks exactly like one on which nothing has been published *yet*.

# %% [markdown]
# Whenever a node stays silent, ask the session to explain, and look at the graph:

# %% shows=true
newsroom.explain("sport")

# %% shows=true
viz.graph(newsroom.explain("sport"))

# %% [markdown]
# Dan subscribes to `/sport`, but the reporter publishes on `/sports`. A dashed arrow means that its topic has only
# one side, and the dashed line between the two boxes says that their names are almost the same. Never mind the words in
# brackets after the message type: they are delivery settings, and page 08 is about them.
#
# To fix it, add the missing letter.

# %% shows=true
newsroom.add(Reader("dan", "sports"))
newsroom.run(seconds=1)

# %% [markdown]
# Here, the new Dan replaces the old one. On a robot, both would run.
#
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("00")

# %% only="solution"
quiz("00", "b", "a", "c")

# %% [markdown]
# ## Remember
#
# - A **node** is a small part of a robot's software, with a single job.
# - A **publisher** sends messages to a **topic**; a **subscriber** receives them in its **callback**.
# - The two sides agree on the topic's name and the message type. They don't need to know about each other.
# - When nothing arrives, ask `explain`, and look at the graph.
#
# What was real today? Your classes are ordinary ROS 2 code, and their messages went through real
# [**middleware**](../docs/glossary.md#middleware), the software that delivers messages on robots, too. Only the clock,
# the processes and the temperature were simulated.
#
# | here | on a robot |
# |---|---|
# | `ros.add(Thermometer)` | `ros2 run PACKAGE thermometer`, in a terminal |
# | `viz.graph(ros)` | `rqt_graph` |
# | the log lines below a cell | the same lines, in the terminal |
#
# **Rosie can now** tell everybody how warm it is.
#
# **Next:** [create a workspace](01_create_a_workspace.ipynb). The cell with `progress()` at the end of each page
# shows how far you've come.

# %% shows=true
progress()
