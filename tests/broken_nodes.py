"""Nodes with one mistake each, as learners write them: what rclpy and Python say of it is real.

A sensor is the tutorial's publisher, a monitor its subscriber; `init` and `act` replace the body of
the constructor and of the callback.
"""

from dataclasses import dataclass
from textwrap import indent

IMPORTS = """\
import random
import rclpy
import std_msgs.msg
import sys
from rclpy.node import Node
from std_msgs.msg import Float32, String
"""
S = "super().__init__('sensor')\n"
P = "self.publisher_ = self.create_publisher(Float32, 'temperature', 10)\n"
V = "self.temperature = 22.0\n"
T = "self.timer = self.create_timer(1.0, self.tick)"
L = "self.subscription = self.create_subscription(Float32, 'temperature', self.listen, 10)"


@dataclass(frozen=True)
class Broken:
    """A cell that defines `Answer`.

    Attributes:
        name: What it is about.
        mistake: The id that it must get; empty if it must stay unnamed.
        text: The cell.
        hears: Whether readings are published beside it.
    """

    name: str
    mistake: str
    text: str
    hears: bool = False


def _cell(init, method, act):
    body = f"def __init__(self):\n{indent(init, '    ')}\n\n{method}\n{indent(act, '    ')}\n"
    return f"class Answer(Node):\n{indent(body, '    ')}"


def sensor(name, mistake, init=S + P + V + T, act=None, method="def tick(self):"):
    act = act or "msg = Float32()\nmsg.data = self.temperature\nself.publisher_.publish(msg)"
    return Broken(name, mistake, _cell(init, method, act))


def tick(name, mistake, act, init=S + P + V + T):
    return sensor(name, mistake, init, act)


def publisher(name, mistake, call):
    return sensor(name, mistake, f"{S}self.publisher_ = self.create_publisher({call})\n{V}{T}")


def timer(name, mistake, call):
    return sensor(name, mistake, f"{S}{P}{V}self.create_timer({call})")


def topic(name):
    return publisher(f"topic {name!r}", "invalid-name", f"Float32, {name!r}, 10")


def node(name):
    return sensor(f"node {name!r}", "invalid-name", f"super().__init__({name!r})\n{P}{V}{T}")


def monitor(name, mistake, act="pass", init=S + L, method="def listen(self, msg):"):
    return Broken(name, mistake, _cell(init, method, act), hears=True)


def listener(name, mistake, call, method="def listen(self, msg):"):
    return monitor(name, mistake, "pass", f"{S}self.create_subscription({call})", method)


MESSAGES = (
    tick("an int", "not-a-float", "self.publisher_.publish(Float32(data=25))"),
    tick("a calculated int", "not-a-float", "self.publisher_.publish(Float32(data=9 * 2))"),
    tick("a text", "not-a-float", "msg = Float32()\nmsg.data = '25'"),
    tick("None", "not-a-float", "msg = Float32()\nmsg.data = None"),
    tick("a number for a text", "not-a-float", "String(data=25.0)"),
    tick("too large", "wrong-values", "Float32(data=1e300)"),
    tick("a number published", "number-published", "self.publisher_.publish(25.0)"),
    tick("None published", "number-published", "self.publisher_.publish(None)"),
    tick("nothing published", "number-published", "self.publisher_.publish()"),
    tick("bytes published", "number-published", "self.publisher_.publish(b'25')"),
    tick("two published", "number-published", "self.publisher_.publish(Float32, 25.0)"),
    tick("published by name", "number-published", "self.publisher_.publish(data=25.0)"),
    tick("the class", "class-published", "self.publisher_.publish(Float32)"),
    tick("the class, written into", "class-published",
         "msg = Float32\nmsg.data = 25.0\nself.publisher_.publish(msg)"),
    tick("the class, then a message", "class-changed", "Float32.data = 25.0\nFloat32()"),
    tick("another message", "type-mismatch", "self.publisher_.publish(String(data='x'))"),
    tick("another keyword", "wrong-keyword", "Float32(dat=25.0)"),
    tick("no keyword", "field-without-name", "Float32(25.0)"),
    tick("another field", "wrong-field", "msg = Float32()\nmsg.value = 25.0"),
    monitor("a field that is read", "wrong-field", "msg.temperature"),
    monitor("msg compared", "message-for-value", "msg > 26.0"),
    monitor("msg between", "message-for-value", "20.0 < msg < 26.0"),
    monitor("msg formatted", "message-for-value", "f'{msg:.2f}'"),
    monitor("msg by percent", "message-for-value", "'%.1f' % msg"),
    monitor("msg joined", "message-for-value", "'Temperature ' + msg"),
    monitor("msg added", "message-for-value", "msg + 1.0"),
    monitor("msg added to", "message-for-value", "1.0 + msg"),
    monitor("msg as a float", "message-for-value", "float(msg)"),
    monitor("msg rounded", "message-for-value", "round(msg, 1)"),
    monitor("the most of msg", "message-for-value", "max(10.2, msg)"),
    monitor("msg with an index", "message-for-value", "msg[0]"),
)  # fmt: skip

CALLS = (
    publisher("no depth", "depth-missing", "Float32, 'temperature'"),
    publisher("no topic", "argument-missing", "Float32, 10"),
    publisher("no type", "argument-missing", "'temperature', 10"),
    publisher("nothing", "argument-missing", ""),
    publisher("too many", "wrong-argument", "Float32, 'temperature', 10, 10"),
    publisher("depth by another name", "wrong-argument", "Float32, 'temperature', depth=10"),
    publisher("depth as a text", "wrong-depth", "Float32, 'temperature', '10'"),
    publisher("depth with a point", "wrong-depth", "Float32, 'temperature', 10.0"),
    publisher("depth below zero", "wrong-depth", "Float32, 'temperature', -1"),
    publisher("depth None", "wrong-depth", "Float32, 'temperature', qos_profile=None"),
    publisher("topic first", "arguments-swapped", "'temperature', Float32, 10"),
    publisher("depth second", "arguments-swapped", "Float32, 10, 'temperature'"),
    publisher("depth first", "arguments-swapped", "10, Float32, 'temperature'"),
    publisher("topic as a number", "wrong-argument", "Float32, 5, 10"),
    publisher("float", "not-a-message-type", "float, 'temperature', 10"),
    publisher("a module", "not-a-message-type", "std_msgs.msg, 'temperature', 10"),
    publisher("a message", "not-a-message-type", "Float32(), 'temperature', 10"),
    publisher("the type as a text", "not-a-message-type", "'Float32', 'temperature', 10"),
    publisher("None for a type", "not-a-message-type", "None, 'temperature', 10"),
    listener("listener: float", "not-a-message-type", "float, 'temperature', self.listen, 10"),
    listener("listener: a message", "not-a-message-type",
             "Float32(), 'temperature', self.listen, 10"),
    listener("listener: topic first", "arguments-swapped",
             "'temperature', Float32, self.listen, 10"),
    listener("listener: callback last", "arguments-swapped",
             "Float32, 'temperature', 10, self.listen"),
    listener("listener: no depth", "depth-missing", "Float32, 'temperature', self.listen"),
    listener("listener: no callback", "callback-missing", "Float32, 'temperature', 10"),
    listener("listener: no topic", "argument-missing", "Float32, self.listen, 10"),
    listener("listener: neither", "argument-missing", "Float32, 'temperature'"),
    listener("called", "callback-called", "Float32, 'temperature', self.listen(), 10"),
    listener("called with msg", "callback-called", "Float32, 'temperature', self.listen(msg), 10"),
    listener("called in lines", "callback-called",
             "\n    Float32,\n    'temperature',\n    self.listen(),\n    10,\n"),
    listener("called, without msg", "callback-called",
             "Float32, 'temperature', self.listen(), 10", "def listen(self):"),
    listener("called by name", "callback-called",
             "Float32, 'temperature', callback=self.listen(), qos_profile=10"),
    listener("a text to call", "wrong-argument", "Float32, 'temperature', 'listen', 10"),
    monitor("no msg", "callback-parameters", method="def listen(self):"),
    monitor("no self", "callback-parameters", method="def listen(msg):"),
    monitor("no parameter", "callback-parameters", method="def listen():"),
    timer("a timer's called", "callback-called", "1.0, self.tick()"),
    sensor("called too early", "callback-called",
           f"{S}{P}self.create_timer(1.0, self.tick())\n{V}"),
    timer("a text for the timer", "wrong-argument", "1.0, 'tick'"),
    timer("callback first", "arguments-swapped", "self.tick, 1.0"),
    timer("no callback", "callback-missing", "1.0"),
    timer("no period", "argument-missing", "self.tick"),
    timer("a depth for the timer", "wrong-argument", "1.0, self.tick, 10"),
    timer("below zero", "wrong-rate", "-1.0, self.tick"),
    timer("zero", "wrong-rate", "0, self.tick"),
    timer("None for a period", "wrong-rate", "None, self.tick"),
    timer("endless period", "wrong-rate", "float('inf'), self.tick"),
    timer("no number", "wrong-rate", "float('nan'), self.tick"),
    sensor("tick without self", "callback-parameters", act="pass", method="def tick():"),
    sensor("tick with msg", "callback-parameters", act="pass", method="def tick(self, msg):"),
    timer("None in a lambda", "not-callable", "1.0, lambda: self.tick()()"),
    sensor("a timer that shoots a helper", "self-missing", act="self.help()",
           method="def help():\n    pass\n\ndef tick(self):"),
    tick("spin in a callback", "callback-blocks", "rclpy.spin(self)"),
    tick("spin_once in a callback", "callback-blocks", "rclpy.spin_once(self)"),
    sensor("spin in the constructor", "callback-blocks", f"{S}{P}{V}{T}\nrclpy.spin(self)"),
    tick("calls itself", "calls-itself", "self.tick()"),
)  # fmt: skip

NODES = (
    sensor("no super", "super-missing", P + T),
    sensor("super too late", "super-missing", P + S + T),
    sensor("logger before super", "super-missing", "self.get_logger().info('x')\n" + S),
    sensor("nothing but pass", "super-missing", "pass"),
    sensor("super without brackets", "super-missing", f"super.__init__('sensor')\n{P}{T}"),
    sensor("init misspelt", "super-missing", f"super().init('sensor')\n{P}{T}"),
    sensor("the parent without self", "super-missing", f"Node.__init__('sensor')\n{P}{T}"),
    sensor("no name", "node-name-missing", f"super().__init__()\n{P}{T}"),
    Broken("_init_", "node-name-missing",
           "class Answer(Node):\n    def _init_(self):\n        pass"),
    sensor("a number for a name", "wrong-argument", f"super().__init__(5)\n{P}{T}"),
    sensor("self twice", "wrong-argument", f"super().__init__(self, 'sensor')\n{P}{T}"),
    *map(node, ("temperature-sensor", "room temperature", "1temp", "", "a/b", "tür")),
    *map(topic, ("room temperature", "temperature/", "1temp", "", "a-b", "a//b", "a/1b", "{x}")),
    sensor("two types", "type-mismatch", f"{S}{P}self.create_publisher(String, 'temperature', 1)"),
    sensor("two types, heard", "type-mismatch",
           f"{S}{P}self.create_subscription(String, 'temperature', print, 1)"),
    sensor("init in with", "init-in-with", f"with rclpy.init():\n    {S}"),
    sensor("sys.exit", "exits", S + "sys.exit()"),
    tick("SystemExit", "exits", "raise SystemExit(1)"),
    Broken("no parent", "no-node", "class Answer:\n    pass"),
    Broken("nothing returned", "no-node", "def Answer():\n    pass"),
    Broken("no self in init", "self-missing",
           "class Answer(Node):\n    def __init__():\n        pass"),
    Broken("init wants a name", "constructor-parameters",
           "class Answer(Node):\n    def __init__(self, name):\n        super().__init__(name)"),
    tick("round and round", "endless-chain", "self.publisher_.publish(msg)",
         f"{S}{P}self.create_subscription(Float32, 'temperature', self.publisher_.publish, 10)\n"
         "self.create_timer(1.0, lambda: self.publisher_.publish(Float32()))"),
)  # fmt: skip

NAMES = (
    tick("randm", "name-error", "randm.uniform(0.0, 1.0)"),
    tick("no import", "name-error", "Float64()"),
    tick("true", "name-error", "true"),
    tick("no self.", "name-error", "publisher_.publish(Float32())"),
    sensor("no quotes", "name-error", f"{S}self.create_publisher(Float32, temperature, 10)"),
    sensor("no self. before a method", "name-error", f"{S}create_timer(1.0, self.tick)"),
    tick("unifrom", "wrong-attribute", "random.unifrom(0.0, 1.0)"),
    tick("publsh", "wrong-attribute", "self.publisher_.publsh(Float32())"),
    tick("send", "wrong-attribute", "self.publisher_.send(Float32())"),
    tick("publisher", "wrong-attribute", "self.publisher.publish(Float32())"),
    tick("temprature", "wrong-attribute", "self.temprature += 1.0"),
    sensor("create_publisherr", "wrong-attribute", S + P.replace("er(", "err(")),
    sensor("createPublisher", "wrong-attribute", S + P.replace("create_p", "createP")),
    sensor("create_subscriber", "wrong-attribute", S + "self.create_subscriber"),
    sensor("get_loger", "wrong-attribute", S + "self.get_loger()"),
    sensor("a local publisher", "wrong-attribute", S + P.replace("self.pub", "pub") + V + T),
    sensor("used before it is set", "wrong-attribute", S + "print(self.temperature)\n" + V),
    sensor("a method in the constructor", "wrong-attribute",
           f"{S}{T}\n\ndef tick(self):\n    pass", method="def other(self):"),
    tick("logger without brackets", "brackets-missing", "self.get_logger.info('x')"),
    tick("get_logger of a name", "wrong-argument", "self.get_logger('x')"),
    sensor("publishers", "name-taken", S + P.replace("publisher_", "publishers")),
    tick("None has nothing", "none-used", "self.thing.publish()", S + "self.thing = None\n" + T),
    tick("from std_msgs.msg import Float", "not-importable", "from std_msgs.msg import Float"),
    tick("import std_msg", "not-importable", "import std_msg"),
    monitor("status in no branch", "no-value-yet",
            "if msg.data > 100.0:\n    status = 'High'\nprint(status)"),
    monitor("count without self", "no-value-yet", "count += 1"),
)  # fmt: skip

VALUES = (
    monitor("text plus number", "text-and-number", "'Temperature ' + msg.data"),
    monitor("number plus text", "text-and-number", "msg.data + ' degrees'"),
    monitor("compared with a text", "text-and-number", "msg.data > '26.0'"),
    monitor("d for a float", "format-code", "f'{msg.data:d}'"),
    monitor("f for a text", "format-code", "f'{str(msg.data):.2f}'"),
    monitor("a number logged", "logged-no-text", "self.get_logger().info(msg.data)"),
    monitor("two things logged", "logged-no-text", "self.get_logger().info('It is', msg.data)"),
    tick("a module called", "not-callable", "random(0.0, 1.0)"),
    tick("a publisher called", "not-callable", "self.publisher_(Float32())"),
    monitor("a value called", "not-callable", "msg.data()"),
    monitor("a mean of nothing", "division-by-zero", "sum([]) / len([])"),
    monitor("statistics of nothing", "division-by-zero",
            "from statistics import mean\nmean([])"),
    monitor("the fifth of one", "index-error", "[msg.data][4]"),
)  # fmt: skip

#: Errors that nobody knows: they must stay unnamed.
UNKNOWN = (
    tick("of the learner's own", "", "raise ValueError('The sensor is on fire')"),
    tick("an assertion", "", "assert False, 'never'"),
    tick("a word for a number", "", "float('warm')"),
    tick("a key", "", "{}['temperature']"),
    tick("None is not iterable", "", "list(None)"),
    tick("an assertion about a field", "", "assert False, 'The field must be warm'"),
    tick("in a with", "", "with None:\n    pass"),
)
BROKEN = (*MESSAGES, *CALLS, *NODES, *NAMES, *VALUES)
