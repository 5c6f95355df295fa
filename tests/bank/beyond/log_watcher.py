"""07c, a log watcher: right and wrong answers."""

from bank.answer import edited, either, right, wrong

BASE = """
    class LogWatcher(Node):
        def __init__(self):
            super().__init__("log_watcher")
            self.names = self.create_publisher(String, "warnings", 10)
            self.create_subscription(Log, "/rosout", self.hear, 10)

        def hear(self, msg):
            if msg.level >= Log.WARN:
                self.names.publish(String(data=msg.name))
"""
_SUPER = 'super().__init__("log_watcher")'
_MAKE = 'self.names = self.create_publisher(String, "warnings", 10)'
_LISTEN = 'self.create_subscription(Log, "/rosout", self.hear, 10)'
_IF = "if msg.level >= Log.WARN:"
_SEND = "self.names.publish(String(data=msg.name))"

SECRETS = ('Log,"/rosout"', "msg.level>=", "msg.name", 'String,"warnings"', ">=30")


def _right(name, *edits):
    return right("07c", name, edited(BASE, *edits))


def _wrong(name, mistake, *edits):
    return wrong("07c", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("07c", name, mistakes, edited(BASE, *edits))


_QOS = "from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy\n\nclass L"

RIGHT = (
    _right("as on the page"),
    _right("a number", (_IF, "if msg.level >= 30:")),
    _right("above INFO", (_IF, "if msg.level > Log.INFO:")),
    _right("one of three", (_IF, "if msg.level in (Log.WARN, Log.ERROR, Log.FATAL):")),
    _right("three cases",
           (_IF, "if msg.level == 30 or msg.level == 40 or msg.level == 50:")),
    _right("a relative name", ('"/rosout"', '"rosout"')),
    _right("an early return",
           (f"{_IF}\n            {_SEND}",
            f"if msg.level < Log.WARN:\n            return\n        {_SEND}")),
    _right("the severities of rclpy",
           ("class L", "from rclpy.logging import LoggingSeverity\n\nclass L"),
           (_IF, "if msg.level >= LoggingSeverity.WARN:")),
    _right("best effort", ("class L", _QOS),
           ("self.hear, 10", "self.hear, QoSProfile(\n"
                             "            depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)")),
    _right("stored lines, too", ("class L", _QOS),
           ("self.hear, 10",
            "self.hear, QoSProfile(\n"
            "            depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)")),
    _right("it also says what it does",
           (_SEND, f'{_SEND}\n            self.get_logger().debug("heard")')),
    _right("it says hello",
           (_SUPER, f'{_SUPER}\n        self.get_logger().info("I listen")')),
    _right("it warns, and does not listen to itself",
           (_IF, "if msg.level >= Log.WARN and msg.name != self.get_name():"),
           (_SEND, f'{_SEND}\n            self.get_logger().warning("heard one")')),
    right("07c", "a lambda", '''
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("watcher")
                out = self.create_publisher(String, "/warnings", 1)
                self.create_subscription(
                    Log, "/rosout",
                    lambda msg: out.publish(String(data=msg.name)) if msg.level > 29 else None, 10,
                )
    '''),
    right("07c", "match", '''
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("watcher")
                self.out = self.create_publisher(String, "warnings", 10)
                self.sub = self.create_subscription(
                    msg_type=Log, topic="/rosout", callback=self.hear, qos_profile=10
                )

            def hear(self, msg):
                match msg.level:
                    case Log.DEBUG | Log.INFO:
                        pass
                    case _:
                        out = String()
                        out.data = msg.name
                        self.out.publish(out)
    '''),
    right("07c", "composition, async and a table", '''
        class Judge:
            serious = {"WARN": Log.WARN, "ERROR": Log.ERROR, "FATAL": Log.FATAL}

            def is_serious(self, level: int) -> bool:
                return level in self.serious.values()

        class LogWatcher(Node):
            def __init__(self) -> None:
                super().__init__("watcher")
                self.judge = Judge()
                self.out = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, 50)

            async def hear(self, msg: Log) -> None:
                if self.judge.is_serious(msg.level):
                    self.out.publish(String(data=f"{msg.name}"))
    '''),
)  # fmt: skip

WRONG = (
    _wrong("every line", "level-too-low", (_IF, "if True:")),
    _wrong("from INFO on", "level-too-low", (_IF, "if msg.level >= Log.INFO:")),
    _wrong("above DEBUG", "level-too-low", (_IF, "if msg.level > Log.DEBUG:")),
    _wrong("below a warning", "level-too-low", (_IF, "if msg.level <= Log.WARN:")),
    _wrong("the level as a condition", "level-too-low", (_IF, "if msg.level:")),
    _wrong("or ERROR", "level-too-low", (_IF, "if msg.level == 30 or 40 or 50:")),
    _wrong("warnings only", "level-missed", (_IF, "if msg.level == Log.WARN:")),
    _wrong("no FATAL", "level-missed", (_IF, "if msg.level in (Log.WARN, Log.ERROR):")),
    _wrong("no ERROR", "level-missed", (_IF, "if msg.level in (Log.WARN, Log.FATAL):")),
    _wrong("worse than a warning", "boundary", (_IF, "if msg.level > Log.WARN:")),
    _wrong("errors only", "boundary", (_IF, "if msg.level >= Log.ERROR:")),
    _wrong("the text is searched", "level-too-low",
           (_IF, 'if "warn" in msg.msg.lower() or "error" in msg.msg.lower():')),
    _wrong("the text published", "text-for-name", ("data=msg.name", "data=msg.msg")),
    _wrong("name and text", "stray-characters", ("data=msg.name", 'data=f"{msg.name}: {msg.msg}"')),
    _wrong("a slash before it", "stray-characters", ("data=msg.name", 'data="/" + msg.name')),
    _wrong("the level as a text", "wrong-values", ("data=msg.name", "data=str(msg.level)")),
    _wrong("the word WARN", "wrong-values", ("data=msg.name", 'data="WARN"')),
    _wrong("the file", "wrong-values", ("data=msg.name", "data=msg.file")),
    _wrong("the last part of the name", "wrong-values",
           ("data=msg.name", 'data=msg.name.rpartition(".")[2]')),
    _wrong("a capital letter", "wrong-values", ("data=msg.name", "data=msg.name.upper()")),
    _wrong("its own name", "own-name", ("data=msg.name", "data=self.get_name()")),
    _wrong("its own full name", "own-name",
           ("data=msg.name", "data=self.get_fully_qualified_name()")),
    _wrong("its logger's name", "own-name", ("data=msg.name", "data=self.get_logger().name")),
    _wrong("each name once", "said-once",
           (_SUPER, f"{_SUPER}\n        self.known = set()"),
           (_SEND, f"if msg.name not in self.known:\n                self.known.add(msg.name)\n"
                   f"                {_SEND}")),
    _wrong("not the same twice in a row", "said-once",
           (_SUPER, f"{_SUPER}\n        self.last = None"),
           (_IF, f"{_IF}\n            if msg.name == self.last:\n                return\n"
                 "            self.last = msg.name")),
    _wrong("twice", "alert-too-many", (_SEND, f"{_SEND}\n            {_SEND}")),
    _wrong("it warns of warnings", "endless-chain",
           (_SEND, f'{_SEND}\n            self.get_logger().warning("heard one")')),
    _wrong("it logs what it hears", "endless-chain",
           (_IF, f"self.get_logger().info(msg.msg)\n        {_IF}")),
    _wrong("a timer tells later", "alert-too-many",
           (_SUPER, f"{_SUPER}\n        self.found = []\n"
                    "        self.create_timer(0.7, self.tell)"),
           (_SEND, "self.found.append(msg.name)\n\n    def tell(self):\n"
                   "        for name in self.found:\n"
                   "            self.names.publish(String(data=name))\n        self.found = []")),
    _wrong("another topic on its ear", "wrong-topic", ('"/rosout"', '"/log"')),
    _wrong("a letter wrong on its ear", "topic-misspelled", ('"/rosout"', '"/rosuot"')),
    _wrong("the topic's name with a capital", "topic-misspelled", ('"/rosout"', '"/Rosout"')),
    _wrong("the singular", "topic-misspelled", ('"warnings"', '"warning"')),
    _wrong("another topic to speak on", "wrong-topic", ('"warnings"', '"alert"')),
    _wrong("a String on its ear", "type-mismatch", ("(Log, ", "(String, ")),
    _wrong("a Log published", "type-mismatch",
           ("(String, ", "(Log, "), ("String(data=msg.name)", "msg")),
    _wrong("the name published bare", "number-published", ("String(data=msg.name)", "msg.name")),
    _wrong("the number in the field", "not-a-float", ("data=msg.name", "data=msg.level")),
    _wrong("a field that is not there", "wrong-attribute", ("msg.level", "msg.severity")),
    _wrong("data of a log line", "wrong-attribute", ("msg.name", "msg.data")),
    _wrong("the level as a word", "text-and-number", (_IF, 'if msg.level >= "WARN":')),
    _wrong("WARN without Log", "name-error", ("Log.WARN", "WARN")),
    _wrong("no publish", "never-published", (_SEND, "pass")),
    _wrong("never true", "never-published", (_IF, 'if msg.level == "WARN":')),
    _wrong("no publisher", "no-publisher", (_MAKE, "pass"), (_SEND, "pass")),
    _wrong("no subscription", "no-subscription", (_LISTEN, "pass")),
    _wrong("no depth", "depth-missing", ("self.hear, 10", "self.hear")),
    _wrong("the callback called", "callback-called", ("self.hear, 10", "self.hear(), 10")),
    _wrong("no msg", "callback-parameters", ("(self, msg)", "(self)")),
    _wrong("no super", "super-missing", (f"        {_SUPER}\n", "")),
    _wrong("no self", "name-error", (_SEND, _SEND.removeprefix("self."))),
    _either("INFO too, and the text", ("level-too-low", "text-for-name"),
            (_IF, "if msg.level >= 20:"), ("data=msg.name", "data=msg.msg")),
    _either("warnings only, twice", ("level-missed", "alert-too-many"),
            ("level >=", "level =="), (_SEND, f"{_SEND}\n            {_SEND}")),
    _either("its own name, for everything", ("own-name", "level-too-low"),
            (_IF, "if True:"), ("data=msg.name", "data=self.get_name()")),
    _either("a wrong ear and a wrong mouth", ("topic-misspelled",),
            ('"/rosout"', '"/rosut"'), ('"warnings"', '"warning"')),
)  # fmt: skip

#: Written from the page alone.
FRESH = (
    right("07c", "an object that is called, and a range", """
        class Teller:
            def __init__(self, publisher):
                self.publisher = publisher

            def __call__(self, line):
                if line.level in range(Log.WARN, Log.FATAL + 1):
                    self.publisher.publish(String(data=line.name))

        class LogWatcher(Node):
            def __init__(self):
                super().__init__("watcher", namespace="/tools")
                publisher = self.create_publisher(String, "/warnings", 10)
                self.create_subscription(Log, "/rosout", Teller(publisher), 100)
    """),
    right("07c", "inheritance and a hook", """
        class Watcher(Node):
            source, kind = "/rosout", Log

            def __init__(self, name):
                super().__init__(name)
                self.subscription = self.create_subscription(
                    self.kind, self.source, self._heard, 10)
                self.publisher = self.create_publisher(String, "warnings", 10)

            def _heard(self, msg):
                for text in filter(None, (self.answer(msg),)):
                    self.publisher.publish(String(data=text))

            def answer(self, msg):
                raise NotImplementedError

        class LogWatcher(Watcher):
            def __init__(self):
                super().__init__("watcher")

            def answer(self, msg):
                return msg.name if not msg.level < Log.WARN else None
    """),
    right("07c", "partial, numpy and a walrus", """
        from functools import partial

        import numpy as np

        LEVELS = np.array([Log.WARN, Log.ERROR, Log.FATAL])

        def hear(node, msg):
            if np.isin(msg.level, LEVELS) and (name := msg.name):
                node.out.publish(String(data=name))

        class LogWatcher(Node):
            def __init__(self):
                super().__init__("watcher")
                self.out = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", partial(hear, self), 10)
    """),
    right("07c", "a dict of levels and a counter", """
        from collections import Counter

        class LogWatcher(Node):
            WORDS = dict(zip((10, 20, 30, 40, 50), ("DEBUG", "INFO", "WARN", "ERROR", "FATAL")))

            def __init__(self):
                super().__init__("watcher")
                self.seen = Counter()
                self.out = self.create_publisher(String, "warnings", 10)
                self.create_subscription(Log, "/rosout", self.hear, 10)

            def hear(self, msg):
                word = self.WORDS[msg.level]
                self.seen[word] += 1
                if word[0] in "WEF":
                    self.out.publish(String(data=str(msg.name)))
    """),
    right("07c", "a queue and a guard condition", """
        class LogWatcher(Node):
            def __init__(self):
                super().__init__("watcher")
                self.names = []
                self.out = self.create_publisher(String, "warnings", 10)
                self.bell = self.create_guard_condition(self.tell)
                self.create_subscription(Log, "/rosout", self.hear, 10)

            def hear(self, msg):
                if msg.level >= Log.WARN:
                    self.names.append(msg.name)
                    self.bell.trigger()

            def tell(self):
                while self.names:
                    self.out.publish(String(data=self.names.pop(0)))
    """),
    _right("a bit of each level", (_IF, "if msg.level // 10 >= 3:")),
    _right("a publisher made when it is needed", (_MAKE, "self.names = None"),
           (_IF, f"if self.names is None:\n            {_MAKE}\n        {_IF}")),
    _wrong("a level compared by its bits", "level-too-low", (_IF, "if msg.level & Log.WARN:")),
    _wrong("up to ERROR", "level-missed", (_IF, "if Log.WARN <= msg.level <= Log.ERROR:")),
    _wrong("identical with a warning", "level-missed", (_IF, "if msg.level is Log.WARN:")),
    _wrong("each text once", "said-once",
           (_SUPER, f"{_SUPER}\n        self.known = set()"),
           (_SEND, f"if msg.msg not in self.known:\n                self.known.add(msg.msg)\n"
                   f"                {_SEND}")),
    _wrong("not the same line twice in a row", "said-once",
           (_SUPER, f'{_SUPER}\n        self.last = ""'),
           (_IF, f"{_IF}\n            if msg.msg == self.last:\n                return\n"
                 "            self.last = msg.msg")),
    _wrong("every second one", "new-to-me",
           (_SUPER, f"{_SUPER}\n        self.count = 0"),
           (_IF, f"{_IF}\n            self.count += 1\n            if self.count % 2:\n"
                 "                return")),
    _wrong("all names so far", "stray-characters",
           (_SUPER, f"{_SUPER}\n        self.all = []"),
           (_SEND, "self.all.append(msg.name)\n"
                   '            self.names.publish(String(data=", ".join(self.all)))')),
    _wrong("a number before it", "stray-characters",
           (_SUPER, f"{_SUPER}\n        self.count = 0"),
           (_SEND, "self.count += 1\n"
                   '            self.names.publish(String(data=f"{self.count} {msg.name}"))')),
    _wrong("in brackets", "stray-characters", ("data=msg.name", 'data=f"[{msg.name}]"')),
    _wrong("the name before", "wrong-values",
           (_SUPER, f'{_SUPER}\n        self.last = ""'),
           (_SEND, "self.names.publish(String(data=self.last))\n"
                   "            self.last = msg.name")),
    _wrong("the first part of the name", "wrong-values",
           ("data=msg.name", 'data=msg.name.split(".")[0]')),
    _wrong("slashes for dots", "wrong-values",
           ("data=msg.name", 'data=msg.name.replace(".", "/")')),
    _wrong("every level of its own once", "said-once",
           (_SUPER, f"{_SUPER}\n        self.known = set()"),
           (_SEND, f"if msg.level not in self.known:\n                self.known.add(msg.level)\n"
                   f"                {_SEND}")),
    _wrong("a timer of one second tells", "alert-too-many",
           (_SUPER, f"{_SUPER}\n        self.found = []\n"
                    "        self.create_timer(1.0, self.tell)"),
           (_SEND, "self.found.append(msg.name)\n\n    def tell(self):\n"
                   "        for name in self.found:\n"
                   "            self.names.publish(String(data=name))\n        self.found = []")),
    _wrong("the lamp only", "one-name-only",
           (_IF, 'if msg.level >= Log.WARN and msg.name == "lamp":')),
    _wrong("a String without its field", "field-without-name", ("data=msg.name", "msg.name")),
    _wrong("a method without self", "callback-parameters", ("(self, msg)", "(msg)"),
           ("self.names.publish", "names.publish")),
)  # fmt: skip

ANSWERS = (*RIGHT, *WRONG, *FRESH)
