"""13b, a greenhouse: right answers of several architectures."""

from bank.answer import edited, right
from bank.beyond.greenhouse_more import DESK, MODE
from bank.pages import references_of

#: The greenhouse of the page.
BASE = references_of("13b")

#: Four nodes, nothing optional.
FOUR = """
    from math import isfinite

    def sane(value, low, high):
        return isfinite(value) and low <= value <= high

    class Vent(Node):
        def __init__(self):
            super().__init__("vent")
            self.out = self.create_publisher(Bool, "vent", 10)
            self.create_subscription(Float32, "temperature", self.hear, 10)
            self.open = False

        def hear(self, msg):
            if sane(msg.data, -20, 60):
                wanted = msg.data > 28 or (self.open and msg.data >= 26)
                if wanted != self.open:
                    self.out.publish(Bool(data=wanted))
                self.open = wanted

    class Pump(Node):
        def __init__(self):
            super().__init__("pump")
            self.out = self.create_publisher(Bool, "pump", 10)
            self.create_subscription(Float32, "humidity", self.hear, 10)
            self.create_subscription(Bool, "vent", self.hear_vent, 10)
            self.create_timer(0.5, self.think)
            self.on = self.airing = False
            self.humidity, self.since = 100.0, -1000.0

        def now(self):
            return self.get_clock().now().nanoseconds / 1e9

        def hear(self, msg):
            if sane(msg.data, 0, 100):
                self.humidity = msg.data

        def hear_vent(self, msg):
            self.airing = msg.data
            self.think()

        def think(self):
            passed = self.now() - self.since
            if self.on and (self.airing or passed >= 5):
                self.turn(False)
            elif not self.on and not self.airing and self.humidity < 40 and passed >= 20:
                self.turn(True)

        def turn(self, on):
            self.on, self.since = on, self.now()
            self.out.publish(Bool(data=on))

    class Alarm(Node):
        def __init__(self):
            super().__init__("alarm")
            self.out = self.create_publisher(String, "alarm", 10)
            self.watchdogs = {name: self.guard(name) for name in ("temperature", "humidity")}
            self.quiet = set()

        def guard(self, name):
            self.create_subscription(Float32, name, lambda msg: self.heard(name), 10)
            return self.create_timer(5.0, lambda: self.missed(name))

        def heard(self, name):
            self.watchdogs[name].reset()
            if name in self.quiet:
                self.quiet.discard(name)
                self.out.publish(String(data=f"The {name} is BACK."))

        def missed(self, name):
            if name not in self.quiet:
                self.quiet.add(name)
                self.out.publish(String(data=f"Sensor of {name}: silent!"))

    class Report(Node):
        def __init__(self):
            super().__init__("report")
            self.out = self.create_publisher(Float32, "report", 10)
            self.create_subscription(Float32, "temperature", self.hear, 10)
            self.create_timer(10.0, self.send)
            self.kept = []

        def hear(self, msg):
            if sane(msg.data, -20, 60):
                self.kept.append(msg.data)

        def send(self):
            kept, self.kept = self.kept, []
            if kept:
                self.out.publish(Float32(data=sum(kept) / len(kept)))

    def greenhouse():
        return Vent, Pump, Alarm, Report
"""

_SEVEN = (
    edited(FOUR)
    .split("def greenhouse")[0]
    .replace('create_publisher(Bool, "vent", 10)', 'create_publisher(Bool, "wish/vent", 10)')
    .replace('create_publisher(Bool, "pump", 10)', 'create_publisher(Bool, "wish/pump", 10)')
    + '''
class Driver(Node):
    """Drives one actuator, whatever it is called."""

    def __init__(self):
        super().__init__("driver")
        kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.state = False
        self.out = self.create_publisher(Bool, "actuator", kept)
        self.out.publish(Bool(data=False))
        self.create_subscription(Bool, "wish", self.hear, 10)

    def hear(self, msg):
        if msg.data != self.state:
            self.state = msg.data
            self.out.publish(Bool(data=self.state))


class Log(Node):
    def __init__(self):
        super().__init__("log")
        self.create_subscription(String, "alarm", lambda m: self.get_logger().warn(m.data), 10)


def drive(name):
    return (Driver, {"name": f"{name}_driver",
                     "remappings": {"actuator": name, "wish": f"wish/{name}"}})


def greenhouse():
    rename = {"name": "vent_control"}
    return [(Vent, rename), (Pump, {"name": "pump_control"}), Alarm, Report,
            drive("vent"), drive("pump"), Log]
'''
)

_BUS = """
    import json

    class Gate(Node):
        '''Puts all that can be on one bus.'''

        def __init__(self):
            super().__init__("gate")
            self.bus = self.create_publisher(String, "inside/bus", 20)
            for kind, low, high in (("temperature", -20, 60), ("humidity", 0, 100)):
                def listen(msg, kind=kind, low=low, high=high):
                    if low <= msg.data <= high:
                        self.bus.publish(String(data=json.dumps([kind, msg.data])))
                    else:
                        self.bus.publish(String(data=json.dumps([kind, None])))
                self.create_subscription(Float32, kind, listen, 10)

    class OnBus(Node):
        def __init__(self, name, kind, topic):
            super().__init__(name)
            self.out = self.create_publisher(kind, topic, QoSProfile(
                depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))
            self.create_subscription(String, "inside/bus", self._read, 20)
            self.kind = kind

        def _read(self, msg):
            what, value = json.loads(msg.data)
            self.any(what)
            if value is not None:
                getattr(self, what)(value)

        def any(self, what): pass
        def temperature(self, value): pass
        def humidity(self, value): pass

        def say(self, value):
            self.out.publish(self.kind(data=value))

    class Vent(OnBus):
        def __init__(self):
            super().__init__("v", Bool, "vent")
            self.hi = self.declare_parameter("open_above", 28.0).value
            self.lo = self.declare_parameter("close_below", 26.0).value
            self.state = False

        def temperature(self, value):
            new = True if value > self.hi else False if value < self.lo else self.state
            if new is not self.state:
                self.state = new
                self.say(new)

    class Pump(OnBus):
        def __init__(self):
            super().__init__("p", Bool, "pump")
            self.dry = self.declare_parameter("dry_below", 40.0).value
            self.create_subscription(Bool, "vent", self.vent, QoSProfile(
                depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))
            self.machine = self.ready
            self.aired = False
            self.clockwork = None

        def vent(self, msg):
            self.aired = msg.data
            if self.aired and self.machine == self.running:
                self.stop()

        def humidity(self, value):
            self.machine(value)

        def ready(self, value):
            if value < self.dry and not self.aired:
                self.machine = self.running
                self.say(True)
                self.after(5.0, self.stop)

        def running(self, value): pass
        def resting(self, value): pass

        def stop(self):
            self.machine = self.resting
            self.say(False)
            self.after(20.0, self.rested)

        def rested(self):
            self.machine = self.ready

        def after(self, seconds, call):
            if self.clockwork:
                self.destroy_timer(self.clockwork)
            def once():
                self.clockwork.cancel()
                call()
            self.clockwork = self.create_timer(seconds, once)

    class Alarm(OnBus):
        def __init__(self):
            super().__init__("a", String, "alarm")
            self.age = {"temperature": 0, "humidity": 0}
            self.create_timer(1.0, self.older)

        def any(self, what):
            if self.age[what] > 5:
                self.say(what + " back")
            self.age[what] = 0

        def older(self):
            for what in self.age:
                self.age[what] += 1
                if self.age[what] == 6:
                    self.say(what + " silent")

    class Report(OnBus):
        def __init__(self):
            super().__init__("r", Float32, "report")
            self.last = []
            self.create_timer(10.0, self.mean)

        def temperature(self, value):
            self.last.append((self.get_clock().now(), value))

        def mean(self):
            now = self.get_clock().now()
            last = [value for at, value in self.last if (now - at).nanoseconds < 10e9]
            if last:
                self.say(sum(last) / len(last))

    greenhouse = [Gate, Vent, Pump, Alarm, Report]
"""

_BRAIN = (
    edited(FOUR).replace("class Pump(Node):", "class OldPump(Node):").split("def greenhouse")[0]
    + '''
class Brain(Node):
    """Decides; hands and feet obey."""

    def __init__(self):
        super().__init__("brain")
        self.mode = self.create_publisher(String, "mode", 10)
        self.create_subscription(Float32, "temperature", self.warmth, 10)
        self.create_subscription(Float32, "humidity", self.wetness, 10)
        self.create_timer(0.25, self.decide)
        self.airing, self.wet, self.said, self.until, self.free = False, 100.0, "idle", 0.0, 0.0

    def warmth(self, msg):
        if sane(msg.data, -20, 60):
            self.airing = msg.data > 28 or (self.airing and msg.data >= 26)

    def wetness(self, msg):
        if sane(msg.data, 0, 100):
            self.wet = msg.data

    def decide(self):
        now = self.get_clock().now().nanoseconds / 1e9
        mode = "airing" if self.airing else "idle"
        if mode == "idle" and self.said == "pumping" and now < self.until:
            mode = "pumping"
        elif mode == "idle" and self.said == "idle" and self.wet < 40 and now >= self.free:
            mode, self.until = "pumping", now + 5
        if self.said == "pumping" and mode != "pumping":
            self.free = now + 20
        if mode != self.said:
            self.said = mode
            self.mode.publish(String(data=mode))


class Hand(Node):
    def __init__(self):
        super().__init__("hand")
        self.word = self.declare_parameter("word", "airing").value
        self.out = self.create_publisher(Bool, self.word.replace("airing", "vent")
                                         .replace("pumping", "pump"), 10)
        self.create_subscription(String, "mode", self.obey, 10)
        self.on = False

    def obey(self, msg):
        if (msg.data == self.word) != self.on:
            self.on = not self.on
            self.out.publish(Bool(data=self.on))


def greenhouse():
    hand = lambda word: (Hand, {"name": f"hand_{word}", "parameters": {"word": word}})
    return [Brain, hand("airing"), hand("pumping"), Alarm, Report]
'''
)

_CLOSURES = (
    edited(FOUR).split("class Vent")[0]
    + """
def vent():
    node, state = Node("vent_node"), {"open": False}
    for name, value in (("open_above", 28.0), ("close_below", 26.0)):
        node.declare_parameter(name, value)
    out = node.create_publisher(Bool, "vent", 10)

    def hear(msg):
        if not sane(msg.data, -20, 60):
            return
        high, low = (node.get_parameter(n).value for n in ("open_above", "close_below"))
        wanted = msg.data > high or (state["open"] and msg.data >= low)
        if wanted != state["open"]:
            state["open"] = wanted
            out.publish(Bool(data=wanted))

    node.create_subscription(Float32, "temperature", hear, 10)
    return node


def pump(dry_below=40.0, run=5, rest=20):
    def make():
        node = Node("pump_node")
        out = node.create_publisher(Bool, "pump", 10)
        box = {"left": 0, "rest": 0, "open": False}

        def tick():
            if box["left"]:
                box["left"] -= 1
                if not box["left"]:
                    off()
            elif box["rest"]:
                box["rest"] -= 1

        def off():
            box["left"], box["rest"] = 0, rest + 1
            out.publish(Bool(data=False))

        def hear(msg):
            dry = sane(msg.data, 0, 100) and msg.data < dry_below
            if dry and not (box["left"] or box["rest"] or box["open"]):
                box["left"] = run
                out.publish(Bool(data=True))

        def aired(msg):
            box["open"] = msg.data
            if msg.data and box["left"]:
                off()

        node.create_timer(1.0, tick)
        node.create_subscription(Float32, "humidity", hear, 10)
        node.create_subscription(Bool, "vent", aired, 10)
        return node

    return make


"""
    + "class Alarm"
    + edited(FOUR)
    .split("class Alarm")[1]
    .replace("return Vent, Pump, Alarm, Report", "return [vent, pump(), Alarm, Report]")
)

_SERVICE = edited(
    BASE,
    ("class VentControl(Node):", "from std_srvs.srv import Trigger\n\nclass VentControl(Node):"),
    (
        "        self.is_open = False",
        '        self.create_service(Trigger, "is_vent_open", self.answer)\n'
        "        self.is_open = False",
    ),
    (
        "    def temperature_callback",
        "    def answer(self, request, response):\n"
        "        response.success = self.is_open\n        return response\n\n"
        "    def temperature_callback",
    ),
    (
        'self.create_subscription(Bool, "vent", self.hear_vent, LATCHED)',
        'self.vent = self.create_client(Trigger, "is_vent_open")\n'
        "        self.create_timer(0.5, self.ask)",
    ),
    (
        "    def hear_vent(self, msg):\n        self.vent_is_open = msg.data\n"
        "        if msg.data:\n",
        "    def ask(self):\n        if self.vent.service_is_ready():\n"
        "            self.vent.call_async(Trigger.Request()).add_done_callback(self.told)\n\n"
        "    def told(self, future):\n        self.vent_is_open = future.result().success\n"
        "        if self.vent_is_open:\n",
    ),
)

ANSWERS = (
    right("13b", "five nodes with a guard", BASE, "greenhouse"),
    right("13b", "the list itself, made by the call", BASE, "greenhouse()"),
    right("13b", "four nodes, nothing optional, a tuple", FOUR, "greenhouse"),
    right("13b", "seven nodes, with drivers for the actuators", _SEVEN, "greenhouse"),
    right("13b", "one bus, a list, timers that run once", _BUS, "greenhouse"),
    right("13b", "a brain and two hands", _BRAIN, "greenhouse"),
    right("13b", "a mode, and drivers that follow it", MODE, "greenhouse"),
    right("13b", "one class twice, and a desk", DESK, "greenhouse"),
    right("13b", "functions and closures", _CLOSURES, "greenhouse"),
    right("13b", "a service in the place of a topic", _SERVICE, "greenhouse"),
    right("13b", "commands at the beginning", edited(
        BASE, ("        self.is_open = False",
               "        self.is_open = False\n        self.publisher_.publish(Bool(data=False))"),
    ), "greenhouse"),
    right("13b", "nodes that are made already", edited(
        FOUR, ("return Vent, Pump, Alarm, Report", "return [Vent(), Pump(), Alarm(), Report()]"),
    ), "greenhouse"),
    right("13b", "a generator, and a node that nobody needs", edited(
        FOUR, ("return Vent, Pump, Alarm, Report",
                'yield from (Vent, Pump, Alarm, Report)\n    yield lambda: Node("idle")'),
    ), "greenhouse"),
)  # fmt: skip
