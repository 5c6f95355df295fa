# ---
# title: Go beyond topics
# minutes: 50
# needs: ["04", "07"]
# summary: A thermostat with a service, a parameter and an action, and when to use which.
# ---

# %% [markdown]
# # Go beyond topics
#
# **Goal:** you make a thermostat that can be asked, set and sent to work, and you see what such
# conversations have in common with topics.
#
# **Time:** 50 minutes. **You need:** [write a subscriber](04_write_a_subscriber.ipynb) and
# [look inside the graph](07_look_inside_the_graph.ipynb).

# %%
import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.task import Future
from std_msgs.msg import Bool, Float32, String
from test_msgs.action import Fibonacci
from test_msgs.srv import BasicTypes

from rosbeat import Session, check, hint, predict, progress, viz, workspace

# %% [markdown]
# A topic is a stream: whoever publishes never learns who heard it. That is right for readings. It is
# not enough for a request ("set the limit to 24"), nor for work that takes time ("heat to 22
# degrees"). ROS has three more ways to talk:
#
# | | topic | service | parameter | action |
# |---|---|---|---|---|
# | for | a stream of data | a quick request | a setting | work that takes time |
# | direction | one way | there and back | there and back | there, reports, back |
# | answer | none | one | yes, or no and why | feedback, then a result |
# | can be stopped | | no | no | yes |
# | how many | any to any | any clients, one server | any clients, one node | any clients, one server |

# %% [markdown]
# ## Ask: a service
#
# A **service** is a question with one answer. It has a name and a type, as a topic has. Its type holds
# two messages: a request and a response. One node offers the service, others are its **clients**.
#
# Types of your own have to be compiled, which takes a C compiler. So this page borrows ready ones
# from `test_msgs`: of `BasicTypes` it uses a number in the request, `float32_value`, and two fields of
# the response, `bool_value` and `string_value`. In a project of your own, define your own: names that
# say what they mean are worth it.

# %%
class Window(Node):
    def __init__(self):
        super().__init__("window")
        self.percent = 0.0
        self.create_service(BasicTypes, "open_window", self.open_window)

    def open_window(self, request, response):
        if 0.0 <= request.float32_value <= 100.0:
            self.percent = request.float32_value
            response.bool_value = True
        else:
            response.string_value = "0 to 100 percent"
        return response

# %% [markdown]
# ROS hands the callback the request and an empty response. The callback fills it and **returns** it.
#
# A client first waits until the service is there; `wait_for_service` says whether it is. `call_async` sends the
# request and gives you a **future**: a response that is still to come. `spin_until_future_complete` runs callbacks
# until it has come.

# %%
ros = Session(seed=8)
window = ros.add(Window)
guest = ros.add(lambda: Node("guest"))
client = guest.create_client(BasicTypes, "open_window")
while not client.wait_for_service(timeout_sec=1.0):
    guest.get_logger().info("service not available, waiting again...")
future = client.call_async(BasicTypes.Request(float32_value=30.0))
rclpy.spin_until_future_complete(guest, future)
future.result().bool_value, window.percent

# %% [markdown]
# The official tutorial on clients has the same lines. `client.call` sends a request and waits for the response in
# one step. In a cell that is handy, because the session runs the nodes meanwhile. In a callback it can wait for
# ever, as you see at the end of this page.
#
# **Predict:** the next requests are for 250 percent and for NaN, "not a number". How far is the window open
# after that?

# %% predict=true
answers = [client.call(BasicTypes.Request(float32_value=value)) for value in (250.0, float("nan"))]
print([(answer.bool_value, answer.string_value) for answer in answers])
# --- answer
predict("30", window.percent)
# --- blank
# predict("____", window.percent)
# --- end

# %% [markdown]
# Both were refused, with a reason, and changed nothing. Every comparison with NaN is False, and the code asks
# whether a value is *good*. A test for what is bad, `value < 0 or value > 100`, lets NaN pass.
#
# ## Try it: a threshold behind a service
#
# Offer a service `set_high` of the type `BasicTypes`. A threshold from 10 to 40 is kept, and `bool_value`
# says so. Anything else is refused: `bool_value` is False, `string_value` says why, nothing changes.

# %% exercise="12a"
class AdjustableMonitor(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.high = 26.0
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.statuses = self.create_publisher(String, "status", 10)
        # --- answer
        self.create_service(BasicTypes, "set_high", self.set_high)
        # --- blank
        # self.create_service(____, ____, ____)
        # --- end

    def listen(self, msg):
        status = "High" if msg.data > self.high else "Normal"
        self.statuses.publish(String(data=status))

    def set_high(self, request, response):
        # --- answer
        response.bool_value = 10.0 <= request.float32_value <= 40.0
        if response.bool_value:
            self.high = request.float32_value
        else:
            response.string_value = "a threshold is from 10 to 40 degrees"
        # --- blank
        # response.bool_value = ____
        # --- end
        return response

# %% check="12a"
check("12a", AdjustableMonitor)

# %% [markdown]
# ## Set: a parameter that is checked
#
# A **parameter** is a setting that a node declares. Anybody can set it, so the node should look first.
# `add_on_set_parameters_callback` registers a callback that is asked before anything changes. It gets a
# list of the new values, and returns a `SetParametersResult`.

# %%
class Lamp(Node):
    def __init__(self):
        super().__init__("lamp")
        self.declare_parameter("watts", 10.0)
        self.add_on_set_parameters_callback(self.look)

    def look(self, parameters):
        bright = [one for one in parameters if one.name == "watts" and one.value > 60.0]
        reason = "60 watts at most" if bright else ""
        return SetParametersResult(successful=not bright, reason=reason)

lamp = ros.add(Lamp)
results = [lamp.set_parameters([Parameter("watts", value=watts)])[0] for watts in (40.0, 900.0)]
[(result.successful, result.reason) for result in results], lamp.get_parameter("watts").value

# %% [markdown]
# ## Try it: two limits that belong together
#
# `high` must be above `low`, whoever changes what. Both may be in one list: then only the new values
# count, so that 20 and 26 can become 28 and 30 at once. Refuse the rest, NaN too, with a reason.

# %% exercise="12b"
class CarefulMonitor(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.declare_parameter("low", 20.0)
        self.declare_parameter("high", 26.0)
        self.add_on_set_parameters_callback(self.look)
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.statuses = self.create_publisher(String, "status", 10)

    def limits(self):
        return {name: self.get_parameter(name).value for name in ("low", "high")}

    def listen(self, msg):
        now = self.limits()
        status = "High" if msg.data > now["high"] else "Low" if msg.data < now["low"] else "Normal"
        self.statuses.publish(String(data=status))

    def look(self, parameters):
        new = self.limits()
        # --- answer
        new.update({parameter.name: parameter.value for parameter in parameters})
        good = new["high"] > new["low"]
        return SetParametersResult(successful=good, reason="" if good else "high is not above low")
        # --- blank
        # for parameter in parameters:
        #     new[____] = ____
        # return SetParametersResult(successful=____, reason=____)
        # --- end

# %% check="12b"
check("12b", CarefulMonitor)

# %% [markdown]
# ## Send to work: an action
#
# An **action** is for work that takes time. A client sends a **goal**; the server accepts or rejects it. While it
# works, it sends **feedback**, and in the end a **result**. Meanwhile the client may **cancel**.
#
# `Fibonacci`, borrowed again, has a whole number `order` in its goal, and a list `sequence` of whole numbers
# in feedback and result. Here `order` says for how many seconds the room is aired.

# %%
class Airing(Node):
    def __init__(self):
        super().__init__("airing")
        self.tick = Future()
        self.create_timer(1.0, self.next_tick)
        self.server = ActionServer(
            self, Fibonacci, "air", self.air, goal_callback=self.decide, cancel_callback=self.agree
        )

    def next_tick(self):
        self.tick.set_result("a second is over")
        self.tick = Future()

    def decide(self, goal):
        return GoalResponse.ACCEPT if 1 <= goal.order <= 60 else GoalResponse.REJECT

    def agree(self, goal_handle):
        return CancelResponse.ACCEPT

# %% [markdown]
# `decide` judges a goal, `agree` a wish to cancel; without it, every cancel is refused. `tick`
# is a future that the timer fulfils each second. The work is in `air`, which joins the class afterwards (one cell
# would be too long). Its `goal_handle` is the server's end of one goal:

# %%
async def air(self, goal_handle):
    seconds = []
    while len(seconds) < goal_handle.request.order and not goal_handle.is_cancel_requested:
        await self.tick
        seconds.append(len(seconds) + 1)
        goal_handle.publish_feedback(Fibonacci.Feedback(sequence=seconds))
    if goal_handle.is_cancel_requested:
        goal_handle.canceled()
    else:
        goal_handle.succeed()
    return Fibonacci.Result(sequence=seconds)

Airing.air = air
airing = ros.add(Airing)

# %% [markdown]
# `async` and `await` are the trick: at `await` the work rests until the future has its result, and the node's
# callbacks run (an `async` callback of a subscription would hold the others up: they share a group). With
# `time.sleep` there, nothing else would run, no cancel either.
#
# A client takes everything by callbacks. **Predict:** it cancels after 2.5 seconds. How many
# seconds are in the result?

# %% predict=true
def told(future):
    guest.result = list(future.result().result.sequence)
    print(ros.time, "result", guest.result)

def taken(future):
    guest.goal = future.result()
    print(ros.time, "accepted", guest.goal.accepted)
    guest.goal.get_result_async().add_done_callback(told)

def heard(message):
    print(ros.time, "feedback", list(message.feedback.sequence))

actions = ActionClient(guest, Fibonacci, "air")
actions.send_goal_async(Fibonacci.Goal(order=5), heard).add_done_callback(taken)
ros.run(seconds=2.5)
guest.goal.cancel_goal_async()
ros.run(seconds=5)
# --- answer
predict("3", len(guest.result), because="The work looks whether it was canceled when it next wakes up.")
# --- blank
# predict("____", len(guest.result), because="The work looks whether it was canceled when it next wakes up.")
# --- end

# %% [markdown]
# ## Look underneath
#
# The tutorial says that services and actions *build upon* topics. Is that so? Ask the graph what the
# action `air` is made of.

# %%
[(end.kind, end.name) for end in ros.graph().endpoints if end.node == "/airing" and "/air/" in end.name]

# %% [markdown]
# Three services and two topics. Their names are hidden: a part of them begins with `_`. So an action **is** built
# on topics, and an ordinary subscription hears the feedback:

# %%
feedback = []
guest.create_subscription(
    Fibonacci.Impl.FeedbackMessage, "air/_action/feedback", feedback.append, 10
)
actions.send_goal_async(Fibonacci.Goal(order=3))
ros.run(seconds=4)
[list(message.feedback.sequence) for message in feedback]

# %% [markdown]
# And services? No ROS topic carries them: you cannot subscribe to `/open_window`. But go one level
# down, to DDS, on which ROS stands. With `no_demangle` you see its names as they are:

# %%
names = [name for name, _ in guest.get_topic_names_and_types(no_demangle=True)]
[name for name in names if "open_window" in name or "/air/" in name]

# %% [markdown]
# A ROS topic is one DDS topic (`rt`). A service is two: one for requests (`rq`), one for responses (`rr`).
#
# So the claim is half true. Actions are built on ROS topics and services. Services are no ROS topics, but both
# stand on the same DDS topics. And parameters? They are services. Each node offers six for its
# parameters, and one that describes types:

# %%
[end.name for end in ros.graph().endpoints if end.node == "/lamp" and end.kind == "server"]

# %% [markdown]
# Pictures leave these out, and the parts of an action, too. An arrow leads from who asks to who answers:

# %%
viz.graph(ros.graph())

# %% [markdown]
# ## Try it: heat to a target
#
# After `True` on `heater` the room gets a degree warmer each second, until `False` comes. The goal's `order` is the target, and goals
# from 10 to 26 make sense. Each second, feedback holds the temperatures read so far; so does the
# result. Whether reached or canceled, the heater is off within a second.
#
# `await self.reading` gives the next temperature, a whole number.

# %% exercise="12c"
class Thermostat(Node):
    def __init__(self):
        super().__init__("thermostat")
        self.heater = self.create_publisher(Bool, "heater", 10)
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.reading = Future()
        self.server = ActionServer(
            self, Fibonacci, "heat", self.heat, goal_callback=self.decide, cancel_callback=self.agree
        )

    def listen(self, msg):
        self.reading.set_result(int(msg.data))
        self.reading = Future()

    def agree(self, goal_handle):
        return CancelResponse.ACCEPT

    def decide(self, goal):
        # --- answer
        return GoalResponse.ACCEPT if 10 <= goal.order <= 26 else GoalResponse.REJECT
        # --- blank
        # return ____
        # --- end

    async def heat(self, goal_handle):
        # --- answer
        degrees, canceled = [], False
        self.heater.publish(Bool(data=True))
        while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
            canceled = goal_handle.is_cancel_requested
        self.heater.publish(Bool(data=False))
        goal_handle.canceled() if canceled else goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)
        # --- blank
        # ____
        # --- end

# %% check="12c"
check("12c", Thermostat)

# %% [markdown]
# ## What went wrong: everybody waits
#
# This node asks in a callback, and waits there for the answer. **Predict:** what does it say after
# three seconds?

# %% terminal="asker"
# mkdir -p "$ROS2_WORKSPACE/scripts"
# cd "$ROS2_WORKSPACE/scripts"
# cat > deadlock.py <<'EOF'
# import rclpy
# from rclpy.node import Node
# from std_srvs.srv import Trigger
#
# rclpy.init()
# node = Node("asker")
# node.create_service(Trigger, "ask", lambda request, response: response)
# client = node.create_client(Trigger, "ask")
#
# def ask():
#     node.get_logger().info("I ask")
#     client.call(Trigger.Request())
#     node.get_logger().info("I know")
#
# node.create_timer(0.2, ask)
# rclpy.spin(node)
# EOF
# timeout --signal=KILL 3 python3 deadlock.py

# %% [markdown]
# **Symptom:** it asks once, and nothing comes any more. **Instrument:** a deadline, here `timeout`, and exit code
# 137. **Cause:** a **deadlock**. `call` waits until another callback takes the response, and the executor runs no
# other callback until this one returns. **Cure:** `call_async`, and a done callback or an `await`.
#
# A session says so once, and then does what a robot does: the callback waits for ever, and its node is silent.

# %%
class Asker(Node):
    def __init__(self):
        super().__init__("asker")
        self.client = self.create_client(BasicTypes, "open_window")
        self.create_timer(1.0, self.ask)

    def ask(self):
        self.get_logger().info("I ask")
        self.client.call(BasicTypes.Request())
        self.get_logger().info("I know")

ros.add(Asker)
ros.run(seconds=3)

# %% [markdown]
# ## Remember
#
# - A topic streams, a service answers once, a parameter keeps a setting, an action works, reports and
#   can be stopped.
# - A service's callback fills the response and returns it.
# - Look first, keep afterwards, and give a reason when you refuse.
# - Never wait inside a callback: await, or be called back.
#
# In a terminal:
#
# ```bash
# ros2 service call /open_window test_msgs/srv/BasicTypes "{float32_value: 30.0}"
# ros2 param set /lamp watts 40.0
# ros2 topic list --include-hidden-topics
# ```
#
# **Next:** [build your own](13_build_your_own.ipynb).

# %%
progress()
