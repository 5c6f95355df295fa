"""04c, a calm monitor: wrong answers."""

from bank.answer import edited, either, wrong
from bank.nodes.hysteresis_right import BASE

_SUPER = 'super().__init__("calm_monitor")'
_CALL = 'self.create_subscription(Float32, "temperature", self.temperature_callback, 10)'
_MEANS = 'self.means = self.create_publisher(Float32, "mean", 10)'
_STATUSES = 'self.statuses = self.create_publisher(String, "status", 10)'
_KEEP = "self.readings.append(msg.data)"
_LAST = "last = self.readings[-5:]"
_MEAN = "self.means.publish(Float32(data=sum(last) / len(last)))"
_IF = "if new != self.status:"
_SAY = "self.statuses.publish(String(data=self.status))"
_HIGH_BACK = 'if self.status == "High" and value < 25.0:'
_LOW_BACK = 'if self.status == "Low" and value > 21.0:'


def _wrong(name, mistake, *edits):
    return wrong("04c", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("04c", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    # The mean.
    _wrong("the last four", "wrong-window", ("[-5:]", "[-4:]")),
    _wrong("the last six", "wrong-window", ("[-5:]", "[-6:]")),
    _wrong("all of them", "wrong-window", ("self.readings[-5:]", "self.readings")),
    _wrong("the first five", "wrong-window", ("[-5:]", "[:5]")),
    _wrong("the reading itself", "wrong-window", ("sum(last) / len(last)", "msg.data")),
    _wrong("always divided by five", "wrong-window", ("/ len(last)", "/ 5")),
    _wrong("the median", "wrong-window", ("class C", "from statistics import median\n\nclass C"),
           ("sum(last) / len(last)", "median(last)")),
    _wrong("the middle of the extremes", "wrong-window",
           ("sum(last) / len(last)", "(max(last) + min(last)) / 2")),
    _wrong("half old, half new", "wrong-window",
           (_KEEP, "self.readings = [(self.readings[-1] + msg.data) / 2 "
                   "if self.readings else msg.data]")),
    _wrong("without the newest", "wrong-window", (_LAST, "last = self.readings[-6:-1] or [0.0]")),
    _wrong("the mean goes into the window", "wrong-window",
           (_MEAN, f"{_MEAN}\n        self.readings[-1] = sum(last) / len(last)")),
    _wrong("a sum", "wrong-window", (" / len(last)", "")),
    _wrong("rounded", "wrong-window",
           ("sum(last) / len(last)", "float(round(sum(last) / len(last)))")),
    _wrong("a mean only of five", "wrong-window",
           (f"        {_MEAN}", f"        if len(last) == 5:\n            {_MEAN}")),
    _wrong("a mean for every fifth reading", "wrong-rate",
           (f"        {_MEAN}", f"        if len(self.readings) % 5 == 0:\n            {_MEAN}")),
    _wrong("a mean only with a change", "wrong-rate",
           (f"        {_MEAN}\n", ""), (_SAY, f"{_SAY}\n            {_MEAN}")),
    _wrong("two means for a reading", "wrong-rate", (_MEAN, f"{_MEAN}\n        {_MEAN}")),
    # The status.
    _wrong("no hysteresis", "no-hysteresis", ("value < 25.0", "True"), ("value > 21.0", "True")),
    _wrong("the page's three states", "no-hysteresis",
           (f'{_HIGH_BACK}\n            return "Normal"\n        {_LOW_BACK}\n'
            '            return "Normal"\n        return self.status', 'return "Normal"')),
    _wrong("no hysteresis at the top", "no-hysteresis", ("value < 25.0", "value <= 26.0")),
    _wrong("no hysteresis at the bottom", "no-hysteresis", ("value > 21.0", "value >= 20.0")),
    _wrong("25.0 is back already", "boundary", ("value < 25.0", "value <= 25.0")),
    _wrong("21.0 is back already", "boundary", ("value > 21.0", "value >= 21.0")),
    _wrong("26.0 is high", "boundary", ("value > 26.0", "value >= 26.0")),
    _wrong("20.0 is low", "boundary", ("value < 20.0", "value <= 20.0")),
    _wrong("it stays high", "hysteresis-lost", (_HIGH_BACK, "if False:")),
    _wrong("it stays low", "hysteresis-lost", (_LOW_BACK, "if False:")),
    _wrong("hysteresis on the other side", "hysteresis-lost",
           ("value < 25.0", "value < 21.0"), ("value > 21.0", "value > 25.0")),
    _wrong("back at 24", "hysteresis-lost", ("value < 25.0", "value < 24.0")),
    _either("it judges the mean", ("wrong-state", "hysteresis-lost", "never-published"),
            ("self.next_status(msg.data)", "self.next_status(sum(last) / len(last))")),
    _wrong("high and low swapped", "wrong-state",
           ('return "High"', 'return "X"'), ('return "Low"', 'return "High"'),
           ('return "X"', 'return "Low"'),
           ('== "High"', '== "Y"'), ('== "Low"', '== "High"'), ('== "Y"', '== "Low"')),
    _wrong("other words", "wrong-word", ('"High"', '"Hot"'), ('"Low"', '"Cold"')),
    _wrong("a whole sentence", "wrong-word",
           ("String(data=self.status)", 'String(data=f"Status: {self.status}")')),
    _either("from high never straight to low", ("wrong-state", "hysteresis-lost"),
            ("if value < 20.0:", 'if value < 20.0 and self.status != "High":')),
    _wrong("the status with every reading", "status-repeated", (_IF, "if True:")),
    _wrong("the first status, too", "status-repeated",
           ('self.status = "Normal"',
            'self.status = "Normal"\n        self.statuses.publish(String(data=self.status))')),
    _wrong("it begins with nothing", "status-repeated",
           ('self.status = "Normal"', 'self.status = ""'),
           ("return self.status", 'return self.status or "Normal"')),
    _either("the new status is not kept", ("status-repeated", "no-hysteresis", "wrong-state",
                                           "hysteresis-lost"),
            (f"self.status = new\n            {_SAY}", _SAY.replace("self.status)", "new)"))),
    _either("the old status is said", ("wrong-state", "status-repeated"),
            (f"self.status = new\n            {_SAY}", f"{_SAY}\n            self.status = new")),
    _wrong("twice", "status-repeated", (_SAY, f"{_SAY}\n            {_SAY}")),
    _either("it never says Normal", ("wrong-state", "hysteresis-lost"),
            (_IF, 'if new != self.status and new == "Normal":\n            self.status = new\n'
                  "        elif new != self.status:")),
    _either("it begins as Low", ("wrong-state", "hysteresis-lost", "status-repeated"),
            ('self.status = "Normal"', 'self.status = "Low"')),
    # The thirty.
    _wrong("a whole number in the field", "not-a-float", ("sum(last) / len(last)",
                                                         "round(sum(last) / len(last))")),
    _wrong("a number published", "number-published",
           ("Float32(data=sum(last) / len(last))", "sum(last) / len(last)")),
    _wrong("a text published", "number-published", ("String(data=self.status)", "self.status")),
    _wrong("the class published", "class-published",
           ("Float32(data=sum(last) / len(last))", "Float32")),
    _wrong("another keyword", "wrong-keyword", ("Float32(data=", "Float32(mean=")),
    _wrong("another field", "wrong-field", ("msg.data", "msg.value")),
    _wrong("no depth", "depth-missing", ('"mean", 10', '"mean"')),
    _wrong("no callback", "callback-missing", ("self.temperature_callback, 10", "10")),
    _wrong("topic first", "arguments-swapped", ('Float32, "mean"', '"mean", Float32')),
    _wrong("float for a type", "not-a-message-type", ('Float32, "mean"', 'float, "mean"')),
    _wrong("str for a type", "not-a-message-type", ('String, "status"', 'str, "status"')),
    _wrong("the callback called", "callback-called",
           ("_callback, 10", "_callback(), 10")),
    _wrong("a callback without msg", "callback-parameters",
           ("callback(self, msg)", "callback(self)")),
    _wrong("no super", "super-missing", (f"        {_SUPER}\n", "")),
    _wrong("no name", "node-name-missing", ('"calm_monitor"', "")),
    _wrong("a space in the node's name", "invalid-name", ("calm_monitor", "calm monitor")),
    _wrong("a slash at the topic's end", "invalid-name", ('"mean"', '"mean/"')),
    _wrong("a capital letter", "topic-misspelled", ('"mean"', '"Mean"')),
    _wrong("the plural", "topic-misspelled",
           ('"mean"', '"means"')),
    _wrong("a letter is missing", "topic-misspelled", ('"status"', '"staus"')),
    _wrong("a letter wrong where it listens", "topic-misspelled",
           ('"temperature"', '"temprature"')),
    _wrong("private names", "topic-misspelled", ('"mean"', '"~/mean"'), ('"status"', '"~/status"')),
    _wrong("another topic", "wrong-topic", ('"mean"', '"average"')),
    _either("the topics swapped", ("type-mismatch", "wrong-topic"),
            ('"mean"', '"x"'), ('"status"', '"mean"'), ('"x"', '"status"')),
    _wrong("a mean as a text", "type-mismatch",
           ('Float32, "mean"', 'String, "mean"'),
           ("Float32(data=sum(last) / len(last))", "String(data=str(sum(last) / len(last)))")),
    _wrong("it hears another type", "type-mismatch", ('Float32, "temperature"',
                                                     'String, "temperature"')),
    _wrong("stored readings wanted", "qos-mismatch",
           ("class C", "from rclpy.qos import DurabilityPolicy, QoSProfile\n\nclass C"),
           ("_callback, 10",
            "_callback, QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)")),
    _wrong("no self", "name-error", ("self.means.publish", "means.publish")),
    _wrong("no mean", "never-published", (_MEAN, "pass")),
    _wrong("no status", "never-published", (_SAY, "pass")),
    _wrong("no publisher for the mean", "no-publisher", (_MEANS, "pass"), (_MEAN, "pass")),
    _wrong("no publisher for the status", "no-publisher", (_STATUSES, "pass"), (_SAY, "pass")),
    _wrong("nothing that listens", "no-subscription", (_CALL, "pass")),
    _wrong("it waits for five readings", "callback-blocks",
           (_LAST, f"while len(self.readings) < 5:\n            pass\n        {_LAST}")),
    _wrong("it exits", "exits", (_SAY, f"{_SAY}\n            exit()")),
    _wrong("no node", "no-node", ("(Node)", ""), (_SUPER, "pass")),
    _wrong("no readings yet", "division-by-zero",
            (f"{_KEEP}\n        {_LAST}\n        {_MEAN}",
             f"{_LAST}\n        {_MEAN}\n        {_KEEP}")),
    _wrong("five readings are taken for granted", "index-error",
            ("sum(last) / len(last)", "sum(self.readings[-i] for i in range(1, 6)) / 5")),
    _wrong("an attribute that hides a method", "not-callable",
            ("next_status(self, value)", "status(self, value)"),
            ("self.next_status(", "self.status(")),
    # Pairs.
    _either("window and hysteresis", ("wrong-window", "no-hysteresis"),
            ("[-5:]", "[-4:]"), ("value < 25.0", "True")),
    _either("boundary and repeated", ("boundary", "status-repeated"),
            ("value > 26.0", "value >= 26.0"), (_IF, "if True:")),
    _either("topic and window", ("topic-misspelled", "wrong-window"),
            ('"mean"', '"means"'), ("[-5:]", "")),
    _either("a mean only of five, of all", ("wrong-rate", "wrong-window"),
            (f"        {_MEAN}", f"        if len(self.readings) >= 5:\n            {_MEAN}"),
            ("[-5:]", "")),
    _either("words and limits", ("wrong-word", "boundary"),
            ('"High"', '"HOT"'), ("value < 20.0", "value <= 20.0")),
    _either("no super, topic first", ("super-missing", "arguments-swapped"),
            (f"        {_SUPER}\n", ""), ('Float32, "mean"', '"mean", Float32')),
    # A window that is not empty at first, and one word too many.
    _wrong("five zeros to begin with", "wrong-window",
           ("self.readings = []", "self.readings = [0.0] * 5")),
    _wrong("five times 22 to begin with", "wrong-window",
           ("self.readings = []", "self.readings = [22.0] * 5")),
    _either("the mean is not put into the message", ("wrong-values", "wrong-window"),
            (_MEAN, "mean = Float32()\n        self.means.publish(mean)")),
    _either("Normal on the way from High to Low", ("status-repeated", "wrong-state"),
            (f"{_IF}\n", f"{_IF}\n            if self.status != 'Normal' != new:\n"
                          '                self.statuses.publish(String(data="Normal"))\n')),
    _wrong("the upper limit one too low", "wrong-state", ("26.0", "25.0")),
    _wrong("the lower limit one too high", "wrong-state", ("20.0", "21.0")),
)  # fmt: skip
