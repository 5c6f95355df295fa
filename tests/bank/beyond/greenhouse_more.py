"""13b, a greenhouse: two more architectures, each right."""

#: Readings and signs of life on a bus, and one node that decides on a mode.
MODE = '''
import json, math
KEEP = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
class Bus(Node):
    """All readings that can be, as one JSON."""
    def __init__(self):
        super().__init__("bus")
        self.out = self.create_publisher(String, "readings", 10)
        self.seen = self.create_publisher(String, "sign_of_life", 10)
        for t, lo, hi in (("temperature",-20,60),("humidity",0,100)):
            hear = lambda m, t=t, lo=lo, hi=hi: self.got(t, lo, hi, m.data)
            self.create_subscription(Float32, t, hear, 10)
    def got(self, t, lo, hi, v):
        self.seen.publish(String(data=t))
        if not math.isnan(v) and lo <= v <= hi:
            self.out.publish(String(data=json.dumps({t: v})))
class Climate(Node):
    """Decides on a mode: airing, or not."""
    def __init__(self):
        super().__init__("climate")
        self.hi = self.declare_parameter("open_above", 28.0).value
        self.lo = self.declare_parameter("close_below", 26.0).value
        self.mode = self.create_publisher(String, "mode", KEEP)
        self.create_subscription(String, "readings", self.on, 10)
        self.is_airing = False
        self.mode.publish(String(data="closed"))
    def on(self, m):
        t = json.loads(m.data).get("temperature")
        if t is None: return
        if t > self.hi: self.is_airing = True
        if t < self.lo: self.is_airing = False
        self.mode.publish(String(data="airing" if self.is_airing else "closed"))
class Vent(Node):
    def __init__(self):
        super().__init__("vent_driver")
        self.out = self.create_publisher(Bool, "vent", KEEP)
        self.create_subscription(String, "mode", self.on, KEEP)
        self.now = None
    def on(self, m):
        if self.now != m.data:
            self.now = m.data
            self.out.publish(Bool(data=m.data == "airing"))
class Pump(Node):
    def __init__(self):
        super().__init__("pump_driver")
        self.limit = self.declare_parameter("dry_below", 40.0).value
        self.out = self.create_publisher(Bool, "pump", KEEP)
        self.create_subscription(String, "mode", self.on_mode, KEEP)
        self.create_subscription(String, "readings", self.on, 10)
        self.mode = "closed"; self.running = False; self.stopped = None; self.timer = None
    def on_mode(self, m):
        self.mode = m.data
        if self.mode == "airing": self.stop()
    def on(self, m):
        h = json.loads(m.data).get("humidity")
        now = self.get_clock().now().nanoseconds
        rested = self.stopped is None or now - self.stopped >= 20e9
        may = rested and not self.running and self.mode != "airing"
        if h is not None and h < self.limit and may:
            self.running = True
            self.out.publish(Bool(data=True))
            self.timer = self.create_timer(5.0, self.stop)
    def stop(self):
        if self.running:
            self.timer.cancel(); self.destroy_timer(self.timer)
            self.running = False
            self.stopped = self.get_clock().now().nanoseconds
            self.out.publish(Bool(data=False))
class Alarm(Node):
    def __init__(self):
        super().__init__("alarm")
        self.out = self.create_publisher(String, "alarm", 10)
        self.create_subscription(String, "sign_of_life", self.on, 10)
        self.age = {"temperature": 0, "humidity": 0}
        self.create_timer(1.0, self.tick)
    def on(self, m):
        if self.age[m.data] >= 6: self.out.publish(String(data=m.data + " back"))
        self.age[m.data] = 0
    def tick(self):
        for s in self.age:
            self.age[s] += 1
            if self.age[s] == 6: self.out.publish(String(data=s + " silent"))
class Report(Node):
    def __init__(self):
        super().__init__("rep")
        self.out = self.create_publisher(Float32, "report", 10)
        self.create_subscription(String, "readings", self.on, 10)
        self.create_timer(10.0, self.tick)
        self.window = []
    def on(self, m):
        t = json.loads(m.data).get("temperature")
        if t is not None: self.window.append((self.get_clock().now(), t))
    def tick(self):
        from rclpy.duration import Duration
        now = self.get_clock().now()
        self.window = [(s, v) for s, v in self.window if now - s < Duration(seconds=10)]
        m = sum(v for _, v in self.window) / len(self.window) if self.window else math.nan
        self.out.publish(Float32(data=m))
def greenhouse():
    return [Bus, Climate, Vent, Pump, Alarm, Report]
'''

#: One class started twice, and a desk that speaks for both; without a reading the mean is 0.
DESK = '''
class Watch(Node):
    """One per sensor; tells the desk, which owns the alarm."""
    def __init__(self):
        super().__init__("watch")
        self.what = self.declare_parameter("what", "temperature").value
        self.create_subscription(Float32, "sensor", self.hear, 10)
        self.out = self.create_publisher(String, "note", 10)
        self.egg = self.create_timer(5.0, self.over)
        self.away = False
    def hear(self, msg):
        self.egg.reset()
        if self.away:
            self.away = False
            self.out.publish(String(data=self.what + " back"))
    def over(self):
        self.egg.cancel()
        self.away = True
        self.out.publish(String(data=self.what + " silent"))
class Desk(Node):
    def __init__(self):
        super().__init__("desk")
        self.out = self.create_publisher(String, "alarm", 10)
        self.create_subscription(String, "note", self.out.publish, 10)
class Vent(Node):
    def __init__(self):
        super().__init__("vent")
        self.out = self.create_publisher(Bool, "vent", 10)
        self.create_subscription(Float32, "temperature", self.hear, 10)
        self.state = "closed"
    def hear(self, msg):
        t = msg.data
        if t != t or not -20 <= t <= 60:
            return
        if self.state == "closed" and t > 28:
            self.state = "open"; self.out.publish(Bool(data=True))
        elif self.state == "open" and t < 26:
            self.state = "closed"; self.out.publish(Bool(data=False))
class Pump(Node):
    def __init__(self):
        super().__init__("pump")
        self.out = self.create_publisher(Bool, "pump", 10)
        self.create_subscription(Float32, "humidity", self.hear, 10)
        self.create_subscription(Bool, "vent", self.vent, 10)
        self.create_timer(1.0, self.second)
        self.left, self.rest, self.open, self.h = 0, 0, False, 100
    def hear(self, msg):
        if 0 <= msg.data <= 100: self.h = msg.data
    def vent(self, msg):
        self.open = msg.data
    def second(self):
        if self.left:
            self.left -= 1
            if self.left == 0 or self.open:
                self.left, self.rest = 0, 20
                self.out.publish(Bool(data=False))
        elif self.rest:
            self.rest -= 1
        elif self.h < 40 and not self.open:
            self.left = 5
            self.out.publish(Bool(data=True))
class Report(Node):
    def __init__(self):
        super().__init__("report")
        self.out = self.create_publisher(Float32, "report", 10)
        self.create_subscription(Float32, "temperature", self.hear, 10)
        self.create_timer(1.0, self.tick)
        self.n = 0; self.sum = 0.0; self.k = 0
    def hear(self, msg):
        if -20 <= msg.data <= 60:
            self.sum += msg.data; self.k += 1
    def tick(self):
        self.n += 1
        if self.n % 10 == 0:
            mean = self.sum / self.k if self.k else 0.0
            self.sum, self.k = 0.0, 0
            self.out.publish(Float32(data=mean))
def watch(topic):
    return (Watch, {"name": f"watch_{topic}", "remappings": {"sensor": topic},
                    "parameters": {"what": topic}})
def greenhouse():
    return [Vent, Pump, Report, Desk, watch("temperature"), watch("humidity")]
'''
