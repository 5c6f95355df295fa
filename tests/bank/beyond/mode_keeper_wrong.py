"""08a, the last word waits: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.mode_keeper_right import BASE

_QOS = "qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"
_CALL = 'self.create_subscription(String, "command", self.obey, 10)'
_MAKE = 'self.modes = self.create_publisher(String, "mode", qos)'
_IF = "if msg.data != self.mode:\n            self.change(msg.data)"


def _wrong(name, mistake, *edits):
    return wrong("08a", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("08a", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    # Quality of service.
    _wrong("a depth alone", "not-kept", (_QOS, "qos = 1")),
    _wrong("ten, as ever", "not-kept", (_QOS, "qos = 10")),
    _wrong("a profile with a depth alone", "not-kept", (_QOS, "qos = QoSProfile(depth=1)")),
    _wrong("volatile", "not-kept", ("TRANSIENT_LOCAL", "VOLATILE")),
    _wrong("kept, but ten of them", "old-words-too", ("depth=1", "depth=10")),
    _wrong("kept, but two of them", "old-words-too", ("depth=1", "depth=2")),
    _wrong("everything kept", "old-words-too",
           ("class M", "from rclpy.qos import HistoryPolicy\n\nclass M"),
           ("depth=1", "history=HistoryPolicy.KEEP_ALL")),
    _wrong("kept, by best effort", "qos-mismatch",
           ("depth=1,", "depth=1, reliability=ReliabilityPolicy.BEST_EFFORT,")),
    _wrong("kept commands wanted as well", "qos-mismatch", ("self.obey, 10", "self.obey, qos")),
    _wrong("no depth", "depth-missing", ("depth=1, ", "")),
    _wrong("a depth without its name", "wrong-argument", ("depth=1,", "1,")),
    _wrong("a letter too few", "wrong-argument", ("durability=", "durabilty=")),
    _wrong("the policy as a text", "wrong-argument",
           ("DurabilityPolicy.TRANSIENT_LOCAL", '"TRANSIENT_LOCAL"')),
    # When it publishes.
    _wrong("each command is passed on", "status-repeated",
           (_IF, "self.change(msg.data)")),
    _wrong("nothing at the start", "wrong-start", ('self.change("idle")', 'self.mode = "idle"')),
    _wrong("another word at the start", "wrong-start", ('self.change("idle")',
                                                        'self.change("ready")')),
    _wrong("an empty word at the start", "wrong-start", ('self.change("idle")',
                                                         'self.change("")')),
    _wrong("the first mode after a second", "wrong-start",
           ('self.change("idle")',
            'self.mode = "idle"\n        self.once = self.create_timer(0.9, self.begin)\n\n'
            '    def begin(self):\n        self.once.cancel()\n        self.change("idle")')),
    _wrong("the first mode after a tenth of a second", "wrong-start",
           ('self.change("idle")',
            'self.mode = ""\n        self.once = self.create_timer(0.1, self.begin)\n\n'
            '    def begin(self):\n        self.once.cancel()\n        self.change("idle")')),
    _wrong("once a second", "status-repeated",
           ('self.change("idle")',
            'self.change("idle")\n'
            '        self.create_timer(1.0, lambda: self.change(self.mode))')),
    _wrong("the mode is not remembered", "status-repeated",
           ("self.mode = mode", 'self.mode = "idle"'),
           ("if msg.data !=", "if True or msg.data !=")),
    # One mistake, two things that it does.
    _either("compared with the first mode for ever", ("status-repeated", "change-missing"),
            ("!= self.mode", '!= "idle"')),
    _either("only the first change", ("change-missing", "status-repeated"),
            ("if msg.data != self.mode:", 'if self.mode == "idle":')),
    _wrong("remembered and not published", "change-missing",
           (_IF, "if msg.data != self.mode:\n            self.mode = msg.data")),
    _wrong("commands are ignored", "change-missing", (_IF, "pass")),
    _wrong("in capitals", "wrong-values", (_IF, _IF.replace("change(msg.data)",
                                                            "change(msg.data.upper())"))),
    _wrong("a sentence", "wrong-values",
           ("String(data=mode)", 'String(data=mode if mode == "idle" else f"mode: {mode}")')),
    _wrong("the old mode is published", "wrong-values",
           ("self.mode = mode\n        self.modes.publish(String(data=mode))",
            'old, self.mode = getattr(self, "mode", "idle"), mode\n'
            "        self.modes.publish(String(data=old + '!' * (old != 'idle')))")),
    _wrong("said twice", "status-repeated",
           ("self.modes.publish(String(data=mode))",
            "self.modes.publish(String(data=mode))\n"
            "        self.modes.publish(String(data=mode))")),
    # The thirty.
    _wrong("the plural", "topic-misspelled", ('"mode", qos', '"modes", qos')),
    _wrong("commands, in the plural", "topic-misspelled", ('"command"', '"commands"')),
    _wrong("no depth for the commands", "depth-missing", ("self.obey, 10", "self.obey")),
    _wrong("no callback", "callback-missing", ("self.obey, 10", "10")),
    _wrong("a text published", "number-published", ("String(data=mode)", "mode")),
    _wrong("no subscription", "no-subscription", (_CALL, "pass")),
    _wrong("the callback called", "callback-called", ("self.obey, 10", "self.obey(), 10")),
    _wrong("no node name", "node-name-missing", ('"mode_keeper"', "")),
    _wrong("a node's name with a blank", "invalid-name", ('"mode_keeper"', '"mode keeper"')),
    _wrong("no super", "super-missing", ('        super().__init__("mode_keeper")\n', "")),
    _wrong("a policy that there is not", "wrong-attribute", ("TRANSIENT_LOCAL", "TRANSIENT")),
    _wrong("numbers for commands", "type-mismatch", ('(String, "command"', '(Int32, "command"')),
    _wrong("a callback without msg", "callback-parameters",
           ("def obey(self, msg):", "def obey(self):"), (_IF, "pass")),
    _wrong("the message is compared", "status-repeated",
           ("if msg.data != self.mode:", "if msg != self.mode:")),
    _wrong("compared with the last command", "status-repeated",
           ("if msg.data != self.mode:",
            "last, self.last = getattr(self, 'last', None), msg.data\n"
            "        if msg.data != last:")),
    _wrong("a policy and no profile", "not-kept",
           (_QOS, "qos = DurabilityPolicy.TRANSIENT_LOCAL")),
    _wrong("kept for a while only", "lifespan-too-short",
           ("depth=1,", "depth=1, lifespan=Duration(seconds=3.5),")),
    _wrong("the message for its text", "message-for-value",
           ("self.change(msg.data)", "self.change(msg)")),
    _wrong("changed to nothing", "argument-missing",
           ("self.change(msg.data)", "self.change()")),
    # Pairs.
    _either("volatile, and no first mode", ("not-kept", "wrong-start"),
            (_QOS, "qos = 1"), ('self.change("idle")', 'self.mode = "idle"')),
    _either("ten kept, and all passed on", ("old-words-too", "status-repeated"),
            ("depth=1", "depth=10"), (_IF, "self.change(msg.data)")),
    _either("best effort, ten kept", ("qos-mismatch", "old-words-too"),
            ("depth=1,", "depth=10, reliability=ReliabilityPolicy.BEST_EFFORT,")),
    _either("best effort, volatile", ("qos-mismatch", "not-kept"),
            (_QOS, "qos = qos_profile_sensor_data")),
    _either("the two profiles swapped", ("not-kept", "qos-mismatch"),
            ("self.obey, 10", "self.obey, qos"), ('"mode", qos', '"mode", 10')),
)  # fmt: skip
