"""Three questions for the end of each page, with a reason for every choice.

Every wrong choice is something that learners really believe. Its reason says what is true instead,
and where the page shows it.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Choice:
    """Hold one answer that a question offers.

    Attributes:
        text: The answer; code stands between backticks.
        reason: Why it is right or wrong, in a sentence or two.
        right: Whether it is the right answer.
    """

    text: str
    reason: str
    right: bool = False


@dataclass(frozen=True)
class Question:
    """Hold a question with exactly one right answer.

    Attributes:
        id: Number of the page and of the question, such as `03.1`.
        text: The question; code stands between backticks.
        choices: The answers on offer, in the order in which they are shown.
    """

    id: str
    text: str
    choices: tuple[Choice, ...]

    @property
    def page(self) -> str:
        """Return the number of the page, such as `03`."""
        return self.id[:2]


def _ask(question: str, text: str, *choices: Choice) -> Question:
    return Question(question, text, choices)


def _yes(text: str, reason: str) -> Choice:
    return Choice(text, reason, right=True)


def _no(text: str, reason: str) -> Choice:
    return Choice(text, reason)


_QUESTIONS = (
    _ask(
        "00.1",
        "A publisher and a subscriber don't know about each other. What do they have to agree on?",
        _no(
            "The names of their nodes",
            "A node never names the node on the other side. Ben reads the weather without knowing "
            "which reporter wrote it.",
        ),
        _yes(
            "The topic's name and the message type",
            "If both match, messages flow, whatever the two nodes are called. Page 08 adds one "
            "more condition.",
        ),
        _no(
            "The time at which they start",
            "Cleo joined late and received everything that was published from then on. Nodes are "
            "decoupled in time, too.",
        ),
    ),
    _ask(
        "00.2",
        "When does a subscriber's callback run?",
        _yes(
            "Each time a message arrives on its topic",
            "ROS calls the function once for each message, and passes the message to it.",
        ),
        _no(
            "Once a second",
            "That's what the reporter's timer does. A reader has no timer; if nothing is "
            "published, its callback never runs.",
        ),
        _no(
            "When your own code calls it",
            "You only hand the function over. ROS calls it.",
        ),
    ),
    _ask(
        "00.3",
        "A reader subscribes to `sport`, but the reporter publishes on `sports`. What happens?",
        _no(
            "ROS reports that the topic does not exist",
            "Subscribing to a topic creates it. Somebody could start to publish on `sport` at any "
            "moment, so there is nothing to report.",
        ),
        _no(
            "ROS connects the two, because the names are almost the same",
            "Names have to match letter for letter. Only the course's `explain` compares names "
            "that are nearly equal.",
        ),
        _yes(
            "The reader receives nothing, and there is no error",
            "Two topics, each with only one side, are perfectly valid. That's why you look at the "
            "graph when a node stays silent.",
        ),
    ),
    _ask(
        "01.1",
        "Your current folder is `docs`, inside the workspace. Which command takes you to `src`, "
        "which is beside it?",
        _no(
            "`cd src`",
            "This path is relative: it looks for a folder `src` inside `docs`.",
        ),
        _yes(
            "`cd ../src`",
            "`..` goes one level up, to the workspace, and from there into `src`.",
        ),
        _no(
            "`cd /src`",
            "A path that begins with `/` starts at the top of the file system.",
        ),
    ),
    _ask(
        "01.2",
        "What does `-p` change about `mkdir resources/images`?",
        _no(
            "It moves into the new folder afterwards",
            "`mkdir` never changes the current folder; `cd` does.",
        ),
        _no(
            "It deletes an old folder of the same name first",
            "Nothing is deleted. With `-p`, a folder that exists is left as it is.",
        ),
        _yes(
            "It creates missing parent folders, and accepts a folder that exists",
            "`p` is short for parents. Without it, both cases are errors.",
        ),
    ),
    _ask(
        "01.3",
        "In terminal `one`, you type `export COLOR=blue`. What does `echo $COLOR` print in "
        "terminal `two`?",
        _yes(
            "An empty line",
            "Each terminal has its own environment, and a name that isn't set counts as empty.",
        ),
        _no(
            "`blue`",
            "`export` passes the value on to the commands of this terminal only.",
        ),
        _no(
            "An error: `COLOR` is not defined",
            "That's what Python would say. The shell replaces an unknown name with nothing.",
        ),
    ),
    _ask(
        "02.1",
        "What makes a folder a ROS package?",
        _no(
            "It is in the workspace's `src` folder",
            "colcon looks there, but it takes only folders with a manifest.",
        ),
        _no(
            "It contains an `__init__.py`",
            "That makes the inner folder a Python package. colcon doesn't look for it.",
        ),
        _yes(
            "It contains a `package.xml`",
            "The manifest names and describes the package, and colcon finds the package by this"
            " file.",
        ),
    ),
    _ask(
        "02.2",
        "You built the workspace in one terminal. In a new terminal, `ros2` says `Package not "
        "found`. What is missing?",
        _yes(
            "`source install/setup.bash` in the new terminal",
            "The package is built. Sourcing adds it to the environment of this terminal.",
        ),
        _no(
            "Another `colcon build`",
            "Building writes files, which all terminals can see. It doesn't change the environment "
            "of any terminal.",
        ),
        _no(
            "`ros2 pkg create` in the new terminal",
            "The package exists already. This command would refuse to create it again.",
        ),
    ),
    _ask(
        "02.3",
        "What does `--dependencies rclpy std_msgs` do?",
        _no(
            "It downloads and installs both packages",
            "Nothing is installed. Other tools read the list and can install what it names.",
        ),
        _yes(
            "It writes into the manifest that your package needs them",
            "Each name becomes a `<depend>` in `package.xml`.",
        ),
        _no(
            "It adds `import rclpy` to your code",
            "The command writes no nodes. You'll write their imports yourself.",
        ),
    ),
    _ask(
        "03.1",
        "`self.create_timer(0.5, self.beat)` is in the constructor. When does `beat` run for the "
        "first time?",
        _no(
            "At once, in the constructor",
            "`create_timer` only hands the method over. Parentheses after `self.beat` would call "
            "it at once, and that's a mistake.",
        ),
        _yes(
            "Half a second later, and then twice a second",
            "A timer waits for one full period first. The period is in seconds.",
        ),
        _no(
            "Half a second later, and then never again",
            "A timer repeats until it is cancelled or the node ends.",
        ),
    ),
    _ask(
        "03.2",
        "The node's `self.temperature` is 22.3, and a subscriber receives 22.299999237060547. Why?",
        _no(
            "The middleware lost part of the message",
            "A message arrives whole or not at all.",
        ),
        _no(
            "The clamp changed the value",
            "22.3 is inside the range, so the clamp leaves it as it is.",
        ),
        _yes(
            "`Float32` carries 32 bits, and Python calculates with 64",
            "The number is rounded to the nearest one that fits into 32 bits.",
        ),
    ),
    _ask(
        "03.3",
        "What does `rclpy.spin(node)` do?",
        _yes(
            "It waits for timers and messages, and calls the callbacks",
            "It keeps the program running until something stops it, such as `Ctrl` + `C`.",
        ),
        _no(
            "It calls the node's constructor again and again",
            "The constructor runs once, on the line that creates the node.",
        ),
        _no(
            "It publishes one message",
            "Only `publish` sends a message. `spin` calls the callback in which that happens.",
        ),
    ),
    _ask(
        "04.1",
        "With the settings of this page, a subscriber starts five seconds after its publisher. "
        "What does it receive?",
        _no(
            "The five messages that it missed, then the new ones",
            "With these settings, a publisher doesn't keep old messages for those who join late. "
            "Page 08 shows settings that do.",
        ),
        _yes(
            "Everything that is published from then on",
            "Neither side has to start first. What was published earlier is gone.",
        ),
        _no(
            "Nothing, because it wasn't there at the start",
            "Nodes find each other whenever they start.",
        ),
    ),
    _ask(
        "04.2",
        "The queue depth is 10. While the monitor is busy, 12 messages arrive. Which ones does it "
        "get?",
        _no(
            "The first ten",
            "The queue makes room for new messages: the oldest ones go.",
        ),
        _no(
            "All twelve: the publisher waits for the monitor",
            "A publisher never waits for a subscriber. It doesn't even know that one is busy.",
        ),
        _yes(
            "The last ten",
            "Each message that arrives at a full queue pushes out the oldest one.",
        ),
    ),
    _ask(
        "04.3",
        'What is wrong with `create_subscription(Float32, "temperature", self.listen(), 10)`?',
        _yes(
            "The parentheses call `listen` at once, and hand over its result",
            "Write `self.listen`, without parentheses, to hand over the method itself.",
        ),
        _no(
            'The topic needs a slash: `"/temperature"`',
            "In these nodes, `temperature` and `/temperature` are the same topic.",
        ),
        _no(
            "10 messages a second are too many for a `Float32`",
            "10 is the depth of the queue. It has nothing to do with the rate.",
        ),
    ),
    _ask(
        "05.1",
        "An entry point says `talk = rosie.voice:start`. What do you type to run it?",
        _no(
            "`ros2 run rosie voice`",
            "`voice` is the module. `ros2 run` takes the name of the executable, before the equals "
            "sign.",
        ),
        _yes(
            "`ros2 run rosie talk`",
            "First the package, then the executable.",
        ),
        _no(
            "`ros2 run rosie start`",
            "`start` is the function. The program `talk` calls it for you.",
        ),
    ),
    _ask(
        "05.2",
        "You run `chmod +x temperature_publisher.py` and nothing else. What can you do now that "
        "you couldn't do before?",
        _yes(
            "Start the file with `./temperature_publisher.py`",
            "The permission `x` lets the system run the file itself.",
        ),
        _no(
            "Start it with `ros2 run`",
            "`ros2 run` looks for installed programs, which come from entry points. It never looks "
            "at the permissions of your source files.",
        ),
        _no(
            "Start it with `python3 temperature_publisher.py`",
            "That worked before, too: Python only has to read the file.",
        ),
    ),
    _ask(
        "05.3",
        "You add an entry point to `setup.py`, and save. `ros2 run` says `No executable found`. "
        "Why?",
        _no(
            "The terminal has to be closed and opened again",
            "A terminal that has sourced the workspace once is fine.",
        ),
        _no(
            "The node's name must be the same as the executable's",
            "The node's name, the module and the executable are independent of each other.",
        ),
        _yes(
            "The package hasn't been built since",
            "colcon creates the programs in `install`, and `ros2 run` looks only there.",
        ),
    ),
    _ask(
        "06.1",
        "You have built with plain `colcon build`. You change a number in the sensor's file and"
        " run it again. The old number is still used. Why?",
        _no(
            "The sensor's terminal has to source the workspace again",
            "Sourcing tells a terminal where things are installed. They are still in the same "
            "place.",
        ),
        _yes(
            "`ros2 run` starts the copy in `install`",
            "Build again, or build once with `--symlink-install`, which links the file instead of "
            "copying it.",
        ),
        _no(
            "The monitor keeps the old number in its queue",
            "A queue holds messages. It can't change what the sensor publishes.",
        ),
    ),
    _ask(
        "06.2",
        "The sensor's program is stopped while the monitor runs. What does the monitor do?",
        _yes(
            "It keeps running and waits",
            "To a subscriber, a publisher that is gone looks just like one that is quiet. When the "
            "sensor is back, messages arrive again.",
        ),
        _no(
            "It stops with an error",
            "Nothing tells the callback about it. No message means no callback, and no error.",
        ),
        _no(
            "It repeats the last reading",
            "A callback runs only when a new message arrives.",
        ),
    ),
    _ask(
        "06.3",
        "How do two programs with ROS nodes find each other?",
        _no(
            "Through a central program that has to run first",
            "ROS 1 had such a program. ROS 2 needs none.",
        ),
        _no(
            "They have to be started from the same terminal",
            "They were started in two terminals, and could even be on two computers.",
        ),
        _yes(
            "Each process tells the others in its domain what it offers and needs",
            "This is discovery. Programs in different domains don't see each other.",
        ),
    ),
    _ask(
        "07.1",
        "`ros2 topic list` shows a topic. What do you know for sure?",
        _no(
            "A node publishes on it",
            "One subscription is enough for a topic to be listed.",
        ),
        _no(
            "Messages arrive on it",
            "The list says nothing about messages. `ros2 topic hz` measures them.",
        ),
        _yes(
            "Some node uses it, as a publisher or as a subscriber",
            "That's all. `ros2 topic info` counts both sides.",
        ),
    ),
    _ask(
        "07.2",
        "Two sensors publish on `/temperature`, one four times a second and one once a second. "
        "What does `ros2 topic hz` measure?",
        _yes(
            "About 5 messages a second",
            "It subscribes to the topic, and receives the messages of both.",
        ),
        _no(
            "About 4, the rate of the faster one",
            "A subscriber hears all publishers of a topic; it can't choose one.",
        ),
        _no(
            "Two rates, one for each sensor",
            "A message doesn't tell `hz` who sent it. `ros2 topic info --verbose` lists the "
            "publishers.",
        ),
    ),
    _ask(
        "07.3",
        "`ros2 param set` changes a limit, but the node still uses the old one. What is a likely "
        "cause?",
        _no(
            "The package has to be built again",
            "Parameters are values of the running node. They have nothing to do with building.",
        ),
        _yes(
            "The node gets the parameter only once, in its constructor",
            "The parameter has changed, but the copy in the node's variable hasn't. Get the value "
            "wherever you need it.",
        ),
        _no(
            "Parameters can be set only before a node starts",
            "They can be changed at any time; that's what `ros2 param set` is for.",
        ),
    ),
    _ask(
        "08.1",
        "A publisher offers `BEST_EFFORT`, and a subscription asks for `RELIABLE`. What happens?",
        _no(
            "The subscription gets most of the messages",
            "The two aren't connected, so the subscription gets no messages at all.",
        ),
        _no(
            "The publisher switches to `RELIABLE`",
            "Nobody changes a profile afterwards. The two sides fit, or they don't.",
        ),
        _yes(
            "No message arrives",
            "The publisher must offer at least what the subscription asks for. The other way "
            "round, the two would be connected.",
        ),
    ),
    _ask(
        "08.2",
        "A display starts late and should show the last value at once. What does it take?",
        _yes(
            "`TRANSIENT_LOCAL` on both sides",
            "The publisher stores its last messages, and the display asks for them.",
        ),
        _no(
            "A deeper queue at the display",
            "A queue holds what arrives after the subscription was created.",
        ),
        _no(
            "`TRANSIENT_LOCAL` at the display alone",
            "Then it asks for more than the publisher offers, and gets nothing at all.",
        ),
    ),
    _ask(
        "08.3",
        "A slow subscriber loses messages. Which setting helps?",
        _no(
            "A larger depth at the publisher",
            "Messages for a slow subscriber wait in the subscriber's own queue.",
        ),
        _yes(
            "A larger depth at the subscription",
            "Its queue then holds more messages while the callback is busy.",
        ),
        _no(
            "A lifespan at the subscription",
            "A lifespan drops messages that have waited too long.",
        ),
    ),
    _ask(
        "09.1",
        "A sensor that measures in Fahrenheit replaces one in Celsius. What does ROS do about it?",
        _yes(
            "Nothing: name, type and QoS fit, so the messages flow",
            "ROS doesn't know what a number means. The unit is an agreement between people.",
        ),
        _no(
            "It converts the values",
            "No part of ROS knows the unit of a `Float32`.",
        ),
        _no(
            "It refuses the connection",
            "Only topic, type and quality of service are compared.",
        ),
    ),
    _ask(
        "09.2",
        "A node's only subscription and its timer share the default callback group. The "
        "subscription's callback takes 3 seconds. What does the timer do meanwhile?",
        _no(
            "It calls its method in another thread",
            "The default group is mutually exclusive: it never runs two callbacks at once, with "
            "any executor.",
        ),
        _yes(
            "It waits until the callback returns",
            "The timer is due, but its callback may not start yet. Split the work, or use groups "
            "and threads.",
        ),
        _no(
            "It interrupts the callback",
            "Nothing interrupts a callback. It ends when it returns.",
        ),
    ),
    _ask(
        "09.3",
        "A node publishes on `/temperature` and is started in the namespace `/greenhouse`. Which "
        "topic does it use?",
        _no(
            "`/greenhouse/temperature`",
            "That would be true of `temperature`, without the slash.",
        ),
        _no(
            "Both topics",
            "A publisher has exactly one topic.",
        ),
        _yes(
            "`/temperature`",
            "A name that begins with a slash is absolute, and no namespace changes it.",
        ),
    ),
    _ask(
        "10.1",
        "A lamp stays dark. A guard feeds it, and a sensor feeds the guard. The guard "
        "turns out to publish a status every second. What have you ruled out?",
        _no(
            "Only the guard",
            "The guard can't publish a status without readings, so what comes before it works, "
            "too.",
        ),
        _yes(
            "The sensor, the topic between sensor and guard, and the guard",
            "Everything that the guard depends on must be working. The fault comes later.",
        ),
        _no(
            "The lamp",
            "The lamp comes after the guard, and is still a suspect.",
        ),
    ),
    _ask(
        "10.2",
        "`ros.explain` says that a guard has published nothing. Is the guard broken?",
        _yes(
            "Not necessarily: perhaps it receives nothing, or has nothing to report",
            "Silence further down can be a symptom of a fault further up.",
        ),
        _no(
            "Yes: a node that publishes nothing has a fault",
            "A guard that reports alarms is silent on a good day.",
        ),
        _no(
            "No: `ros.explain` would have named the fault",
            "It covers a single topic, and can't see into the guard's code.",
        ),
    ),
    _ask(
        "10.3",
        "You fix a fault, and the symptom is still there. What does that tell you?",
        _no(
            "The diagnosis was wrong: undo the fix",
            "The fix may be right, and a second fault may have been hidden behind the first.",
        ),
        _no(
            "The fix needs some time to take effect",
            "Waiting rules out nothing. Ask the four questions again.",
        ),
        _yes(
            "There may be a second fault: examine the whole system again",
            "The first fault can hide the second one. Start again from the sensor.",
        ),
    ),
    _ask(
        "11.1",
        "What does a bag contain?",
        _no(
            "The code of the nodes that were running",
            "A bag knows nothing of the code. That's why you can replay it to other nodes.",
        ),
        _no(
            "Only the last message of each topic",
            "It contains all of them.",
        ),
        _yes(
            "The messages of the recorded topics, each with its time and type",
            "With the QoS profiles of their publishers, that's enough to publish them again.",
        ),
    ),
    _ask(
        "11.2",
        "You change the monitor and want to know what is different now. Which input do you use?",
        _no(
            "A new run of the sensor",
            "Then the readings differ as well, and you can't tell what comes from your change.",
        ),
        _yes(
            "A replay of the old run",
            "The input is the same, so every difference comes from your change.",
        ),
        _no(
            "No input: compare the code of the two monitors",
            "That shows what you wrote, and not what it does.",
        ),
    ),
    _ask(
        "11.3",
        "A reading is NaN. Which of these is True?",
        _yes(
            "`math.isnan(reading)`",
            "That's the test to use.",
        ),
        _no(
            "`reading == math.nan`",
            "NaN isn't equal to anything, not even to itself.",
        ),
        _no(
            "`reading > 26.0 or reading <= 26.0`",
            "With NaN on one side, `>` and `<=` are both False.",
        ),
    ),
    _ask(
        "12.1",
        "What must the callback of a service return?",
        _no(
            "True or False",
            "Whether a request was granted is a field of the response, if its type has one.",
        ),
        _yes(
            "The response that it was given, filled in",
            "ROS sends it to the client.",
        ),
        _no(
            "Nothing: the client reads the fields of the node",
            "The client may be in another process. It sees only the response.",
        ),
    ),
    _ask(
        "12.2",
        "A robot arm needs ten seconds to reach a position, and the operator wants to see how far "
        "it is and may want to stop it. Which pattern fits?",
        _no(
            "A service",
            "A service answers once. It has no feedback, and a request can't be canceled.",
        ),
        _no(
            "A parameter",
            "A parameter is a setting. It doesn't report what became of it.",
        ),
        _yes(
            "An action",
            "Goal, feedback, result and cancel: an action is made for work that takes time.",
        ),
    ),
    _ask(
        "12.3",
        "A timer's callback uses `client.call(request)` in a node with a SingleThreadedExecutor. "
        "What happens?",
        _yes(
            "It waits forever",
            "Another callback would have to take the response, and the executor runs none until "
            "this one returns.",
        ),
        _no(
            "It gets the response, a little later",
            "Nothing can take the response while the callback waits. Use `call_async`.",
        ),
        _no(
            "It raises an exception at once",
            "There's no error, and that makes a deadlock hard to find.",
        ),
    ),
    _ask(
        "13.1",
        "Two nodes may open and close the same vent. How do you keep them from working against "
        "each other?",
        _no(
            "Both publish on `vent`, and the more important one publishes more often",
            "The vent obeys the last message, so it would open and close all the time.",
        ),
        _yes(
            "One node decides, and the others send it their wishes on topics of their own",
            "There's one decision, in one place.",
        ),
        _no(
            "A deeper queue at the vent",
            "All commands would still arrive, in the same order.",
        ),
    ),
    _ask(
        "13.2",
        "A node should notice that a sensor has been silent for 5 seconds. Where does the code for "
        "that go?",
        _no(
            "Into the sensor's callback",
            "During a silence, this callback never runs.",
        ),
        _no(
            "Into a loop that sleeps until a message comes",
            "While the loop runs, the node can't run any other callback.",
        ),
        _yes(
            "Into the callback of a timer",
            "A timer runs whether messages come or not, and can compare the node's clock with the "
            "time of the last message.",
        ),
    ),
    _ask(
        "13.3",
        "Your greenhouse fails one requirement. What is the best next step?",
        _yes(
            "Write a short day of weather that puts just this requirement to the test",
            "A small input has few causes. You see at once what your nodes do with it.",
        ),
        _no(
            "Change a limit, and run the check again",
            "That may hide the fault, and you still don't know the cause.",
        ),
        _no(
            "Start all over, with a new design",
            "The design may be fine. First find out which node doesn't do what you expect.",
        ),
    ),
)

QUESTIONS: dict[str, tuple[Question, ...]] = {
    page: tuple(one for one in _QUESTIONS if one.page == page)
    for page in sorted({one.page for one in _QUESTIONS})
}
"""The questions of each page, by its number."""
