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
# To run a cell, click into it and press `Shift` + `Enter`.

# %% [markdown]
# ## Send the first message
#
# A robot is many small programs that talk. In ROS 2 such a program is called a **node**. Here is a
# whole one. It plays a thermometer. Run the next three cells.

# %%
from rclpy.node import Node
from std_msgs.msg import Float32, String

from rosbeat import Session, check, viz

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
# That is a heartbeat: one message a second. The number after `INFO` is the time in seconds, and
# the name after it is the node that speaks.
#
# You did not wait three seconds. A `Session` runs real ROS nodes in **virtual time**: its clock
# jumps from one event to the next. So a minute takes no time, and you get the same result as
# everybody else.
#
# **Predict:** how many messages are there after one more minute? Say a number, then run the cell.

# %%
ros.run(seconds=60, quiet=True)
len(ros.messages("temperature"))

# %% [markdown]
# Three before and sixty now. `quiet=True` only keeps the log lines off the page; the messages were
# sent, and the session has recorded each of them. Here is the first: when it was published (in
# nanoseconds, so a billion is one second), on which topic, of which type, by which node, and the data.

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
# Two sides need to agree on two things only: the topic's name and the type of its messages.

# %% [markdown]
# Here is a reporter. It publishes text, which has the message type `String`, on a topic that you
# choose.

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
# ellipses are nodes, boxes are topics, and messages follow the arrows.

# %%
viz.graph(newsroom.graph())

# %% [markdown]
# Together, the nodes and their topics are called the **ROS graph**. Notice that no arrow leads from
# a node to a node. All of them go through a topic.

# %%
viz.timeline(newsroom.observation())

# %% [markdown]
# Time runs from left to right here. Each message leaves a reporter's timer and arrives in a
# reader's callback at the same instant.
#
# ## Take the newsroom apart
#
# Publishers and subscribers do not know each other. We say that they are **decoupled**. That is a
# claim, and you can test it.
#
# **Does a publisher need a subscriber?** Nobody reads politics. **Predict:** was anything published
# there?

# %%
len(newsroom.messages("politics"))

# %% [markdown]
# The politics reporter published all the same. It cannot tell whether anybody listens.
#
# **Does a publisher notice when somebody comes?** Cleo joins late. No line of a reporter changes.

# %%
newsroom.add(Reader("cleo", "weather"))
newsroom.run(seconds=1)

# %% [markdown]
# Cleo reads what is published from now on. What came before she was there has passed her by.
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
# - **in life:** each comes and goes by itself.

# %% [markdown]
# ## Try it: read the weather
#
# Replace the blank `____`, so that this reader gets the weather and nothing else. Run the cell, then
# the check below it.

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
# Now the other side. This reporter shall publish an article on `sports` every two seconds. Two
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
# looks just like a topic where nobody has spoken *yet*. Whenever a node stays silent, look at the
# graph:

# %%
viz.graph(newsroom.graph())

# %% [markdown]
# The dashed lines lead to topics that have only one side. Dan listens to `/sport`, and no one is
# there: the topic is called `/sports`. The cure is one letter.

# %%
newsroom.add(Reader("dan", "sports"))
newsroom.run(seconds=1)
newsroom.close()

# %% [markdown]
# A node of the same name takes the place of the old one, so there was only one Dan at any time.
#
# ## Remember
#
# - A **node** is a small program with one job.
# - A **publisher** sends messages to a **topic**; a **subscriber** gets them in its **callback**.
# - They agree on the topic's name and the message type, and on nothing else.
# - When nothing arrives, look at the graph first: compare the names.
#
# Nothing here was pretended. These classes are ordinary ROS 2 code, the messages went through the
# same middleware that robots use, and the files of a robot look just like these cells.
#
# **Next:** [write a publisher](03_write_a_publisher.ipynb), a sensor whose temperature changes.
