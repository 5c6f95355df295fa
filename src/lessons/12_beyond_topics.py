# ---
# title: Go beyond topics
# minutes: 50
# needs: ["04", "07"]
# summary: A thermostat with a service, a parameter and an action, and when to use which.
# ---

# %% [markdown]
# # Go beyond topics
#
# **After this page, you can:**
#
# - offer a service, and call one (12a, 12.1);
# - check new parameter values before they take effect (12b);
# - offer an action that accepts, reports, finishes and can be canceled (12c, 12d, 12e);
# - choose between a topic, a service, a parameter and an action (12.2);
# - explain why a callback must not wait (12.3).
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

viz.diagram("12")

# %% [markdown]
# A topic is a stream: the publisher never learns which nodes received a message. That's right for readings, but it
# isn't enough for a request ("set the limit to 24") or for work that takes time ("heat to 22 degrees"). Services
# and actions are the other two ways to communicate; parameters are settings, built on services:
#
# | | topic | service | parameter | action |
# |---|---|---|---|---|
# | for | a stream of data | a quick request | a setting | work that takes time |
# | direction | one way | there and back | there and back | there, reports, back |
# | answer | none | one | yes, or no with a reason | feedback, then a result |
# | can be canceled | | no | no | yes |
# | how many | any to any | any clients, one server | any clients, one node | any clients, one server |
#
# ## Ask: a service
#
# A [**service**](../docs/glossary.md#service) is a question with one answer. Like a topic, it has a name and a
# type. The type consists of two messages, a request and a response. One node offers the service, and other nodes
# are its [**clients**](../docs/glossary.md#client).
#
# Defining a type of your own takes a C compiler, so this page borrows existing types from the package
# `test_msgs`. From `BasicTypes`, it uses one number in the request, `float32_value`, and two fields of
# the response, `bool_value` and `string_value`. In a project of your own, define your own types.

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
# ROS passes the request and an empty response to the callback. The callback fills in the response and **returns** it.
#
# A client first waits for the service; `wait_for_service` returns whether it's available. `call_async` sends the
# request and returns a [**future**](../docs/glossary.md#future): an object that will hold the response once it arrives.
# `spin_until_future_complete` runs callbacks until then.

# %% shows=true
ros = Session(seed=8)
window = ros.add(Window)
guest = ros.add(Node("guest"))
client = guest.create_client(BasicTypes, "open_window")
while not client.wait_for_service(timeout_sec=1.0):
    guest.get_logger().info("service not available, waiting again...")
future = client.call_async(BasicTypes.Request(float32_value=30.0))
rclpy.spin_until_future_complete(guest, future)
future.result().bool_value, window.percent

# %% [markdown]
# The official tutorial on clients uses the same lines. `client.call` sends a request and waits for the response in
# a single step. In a cell that's convenient, because the session keeps running the nodes. In a callback, it can wait
# forever, as you'll see at the end of this page.
#
# **Predict:** the next requests are for 250 percent and for NaN, "not a number". How far open is the window
# after that?

# %% predict=true
client.call(BasicTypes.Request(float32_value=250.0))
client.call(BasicTypes.Request(float32_value=float("nan")))
# --- answer
predict("30", window.percent)
# --- blank
# predict("____", window.percent)
# --- end

# %% [markdown] answers=true
# Both requests were refused, and neither changed anything. With NaN, `<`, `>` and `==` are always
# false. The code asks whether a value is *valid*, so it refuses NaN. A test for invalid values, `value < 0 or value
# > 100`, would let it pass.

# %% [markdown]
# ## Try it: a threshold behind a service
#
# Offer a service `set_high` of the type `BasicTypes`. If the requested threshold is from 10 to 40, both included,
# keep it, and set `bool_value` to True. Refuse anything else: `bool_value` is False, `string_value` gives the
# reason, and nothing changes.

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
# ## Set: a parameter with a check
#
# A **parameter** is a setting that a node declares. Anybody can set it, so the node should check new values first.
# `add_on_set_parameters_callback` registers a callback that ROS calls before anything changes. It receives a
# list of the new values and returns a `SetParametersResult`.

# %%
class Lamp(Node):
    def __init__(self):
        super().__init__("lamp")
        self.declare_parameter("watts", 10.0)
        self.add_on_set_parameters_callback(self.look)

    def look(self, parameters):
        wrong = [one for one in parameters if one.name == "watts" and not 0.0 <= one.value <= 60.0]
        reason = "0 to 60 watts" if wrong else ""
        return SetParametersResult(successful=not wrong, reason=reason)

lamp = ros.add(Lamp)
lamp.set_parameters([Parameter("watts", value=40.0), Parameter("watts", value=900.0)])

# %% [markdown]
# The lamp accepts 40 watts, and refuses 900 with its reason. `set_parameters` calls the callback for each parameter
# on its own. `set_parameters_atomically` passes all of them in one list, and sets all or none.
#
# ## Try it: two limits that belong together
#
# `high` must be above `low`, whichever of them changes. Both may be in the same list. In that case, only the new
# values count, so that 20 and 26 can become 28 and 30 in one step. Refuse everything else, including NaN, with a
# reason.

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
# ## Give a task: an action
#
# An [**action**](../docs/glossary.md#action) is for work that takes time. A client sends a
# [**goal**](../docs/glossary.md#goal), and the server accepts or rejects it. While it works, the server sends
# [**feedback**](../docs/glossary.md#feedback); at the end, it sends a [**result**](../docs/glossary.md#result). In
# between, the client can **cancel**.
#
# `Fibonacci`, another borrowed type, has an integer `order` in its goal, and a list of integers, `sequence`,
# in its feedback and its result. Here, `order` says for how many seconds to air the room.

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
# `decide` accepts or rejects a goal. `agree` accepts a request to cancel; without it, every such request is rejected.
# `tick` is a future that the timer completes every second. The work itself is done in `air`, which is added to the
# class afterwards, because a single cell would be too long. `goal_handle` is the server's view of one goal:

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
# `async` and `await` are the key: at `await`, the work pauses until the future has its result, and meanwhile the node
# runs its other callbacks. With `time.sleep` instead, nothing else would run, not even a request to cancel. This
# works in an action server. An `async` callback of a subscription would hold up the other subscriptions and timers,
# because they share a callback group.
#
# A client receives everything through callbacks. **Predict:** it cancels after 2.5 seconds. How many
# seconds are in the result?

# %%
def told(future):
    guest.result = list(future.result().result.sequence)
    print(ros.time, "result", guest.result)

def taken(future):
    guest.goal = future.result()
    print(ros.time, "accepted", guest.goal.accepted)
    guest.goal.get_result_async().add_done_callback(told)

def heard(message):
    print(ros.time, "feedback", list(message.feedback.sequence))

# %% predict=true
actions = ActionClient(guest, Fibonacci, "air")
actions.send_goal_async(Fibonacci.Goal(order=5), heard).add_done_callback(taken)
ros.run(seconds=2.5)
guest.goal.cancel_goal_async()
ros.run(seconds=5)
# --- answer
predict("3", len(guest.result))
# --- blank
# predict("____", len(guest.result))
# --- end

# %% [markdown] answers=true
# The work continues at 3 seconds, counts that second, and only then sees the request to cancel.

# %% [markdown]
# ## Look underneath
#
# The tutorial says that services and actions *build upon* topics. Is that true? Underneath ROS is a middleware, DDS,
# with topics of its own. `no_demangle` shows the names that DDS uses:

# %% shows=true
names = [name for name, _ in guest.get_topic_names_and_types(no_demangle=True)]
[name for name in names if "open_window" in name or "/air/" in name]

# %% [markdown]
# A ROS topic is one DDS topic (`rt`). A service is two: one for requests (`rq`) and one for responses (`rr`). So the
# claim is half true: an action consists of two ROS topics and three services, and a service isn't a ROS topic, but
# both are built on DDS topics.
#
# ## Try it: a thermostat, in three steps
#
# The goal's `order` is the temperature to heat to. In the first step, the thermostat only decides: it accepts goals
# from 10 to 26, both included, and rejects all others. Its work, `heat`, ends at once.

# %% exercise="12c"
class DecidingThermostat(Node):
    def __init__(self):
        super().__init__("thermostat")
        self.server = ActionServer(self, Fibonacci, "heat", self.heat, goal_callback=self.decide)

    def decide(self, goal):
        # --- answer
        return GoalResponse.ACCEPT if 10 <= goal.order <= 26 else GoalResponse.REJECT
        # --- blank
        # return ____
        # --- end

    async def heat(self, goal_handle):
        goal_handle.succeed()
        return Fibonacci.Result()

# %% check="12c"
check("12c", DecidingThermostat)

# %% [markdown]
# In the second step, the thermostat heats. After `True` on `heater`, the room gets one degree warmer every second,
# until the heater receives `False`. `await self.reading` returns the next temperature, an integer. After each
# reading, publish feedback with all temperatures read since the goal was accepted. When the target is reached, turn
# the heater off. In a room that is warm enough already, that's after one reading, or at once. The last two lines
# report success, and return the same temperatures as the result.

# %% exercise="12d"
class HeatingThermostat(Node):
    def __init__(self):
        super().__init__("thermostat")
        self.heater = self.create_publisher(Bool, "heater", 10)
        self.create_subscription(Float32, "temperature", self.listen, 10)
        self.reading = Future()
        self.server = ActionServer(self, Fibonacci, "heat", self.heat, goal_callback=self.decide)

    def listen(self, msg):
        self.reading.set_result(int(msg.data))
        self.reading = Future()

    def decide(self, goal):
        # --- answer
        return GoalResponse.ACCEPT if 10 <= goal.order <= 26 else GoalResponse.REJECT
        # --- blank
        # # Copy your line from DecidingThermostat.
        # return ____
        # --- end

    async def heat(self, goal_handle):
        degrees = []
        # --- answer
        self.heater.publish(Bool(data=True))
        while not degrees or degrees[-1] < goal_handle.request.order:
            degrees.append(await self.reading)
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
        self.heater.publish(Bool(data=False))
        # --- blank
        # ____
        # --- end
        goal_handle.succeed()
        return Fibonacci.Result(sequence=degrees)

# %% check="12d"
check("12d", HeatingThermostat)

# %% [markdown]
# The last step adds `agree`, which accepts every request to cancel. Now the work has to notice the request: turn the
# heater off within a second, report the goal as canceled, and return the temperatures read so far.

# %% exercise="12e"
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
        # # Copy your line from DecidingThermostat.
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
        # --- blank
        # # Copy your lines from HeatingThermostat, and let them notice a cancel.
        # ____
        # --- end
        return Fibonacci.Result(sequence=degrees)

# %% check="12e"
check("12e", Thermostat)

# %% [markdown]
# ## What went wrong: a call in a callback
#
# This node calls a service in a timer's callback, and waits there for the response. What does it log in
# three seconds?

# %% terminal="asker" shows=true
# mkdir -p "$ROS2_WORKSPACE/scripts"
# cd "$ROS2_WORKSPACE/scripts"
# cat > deadlock.py <<'EOF'
# import rclpy
# from rclpy.node import Node
# from std_srvs.srv import Trigger
#
# rclpy.init()
# node = Node("asker")
# client = node.create_client(Trigger, "ask")
#
# def answer(request, response):
#     return response
#
# def ask():
#     node.get_logger().info("I ask")
#     client.call(Trigger.Request())
#     node.get_logger().info("I know")
#
# node.create_service(Trigger, "ask", answer)
# node.create_timer(0.2, ask)
# rclpy.spin(node)
# EOF
# timeout --signal=KILL 3 python3 deadlock.py

# %% [markdown]
# **Symptom:** it logs "I ask" once, and then nothing more happens. **Where to look:** run it with a time limit
# (`timeout`); exit code 137 means that the program had to be killed. **Cause:** a
# [**deadlock**](../docs/glossary.md#deadlock). `call` waits for the response, and for that, the executor would have
# to run `answer`. But it can't run another callback until this one returns. **Fix:** `call_async` with a done
# callback. With `await`, the client and the service also need a callback group of their own.
#
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("12")

# %% only="solution"
quiz("12", "b", "c", "a")

# %% [markdown]
# ## Remember
#
# - A topic streams, a service answers once, a parameter holds a setting, and an action works, reports and can be
#   canceled.
# - A service's callback fills in the response and returns it.
# - Check a value before you keep it, and give a reason when you refuse it.
# - Never wait inside a callback: use a done callback.
#
# If these nodes ran as programs, you would type in a terminal:
#
# ```bash
# ros2 service call /open_window test_msgs/srv/BasicTypes "{float32_value: 30.0}"
# ros2 param set /lamp watts 40.0
# ros2 topic list --include-hidden-topics
# ```
#
# **Next:** [build your own](13_build_your_own.ipynb).

# %% shows=true
progress()
