"""Floods: of memory, disk, output, messages and results."""

from hostile.deed import Deed, before, within

DEEDS = (
    Deed(
        "memory",
        before("kept = []\nwhile True:\n    kept.append(b'x' * 50_000_000)"),
        words="emory",
    ),
    Deed("one number that is too large", before("x = 10 ** 10 ** 10"), words=""),
    Deed("output", before("while True:\n    print('x' * 100_000)"), words=""),
    Deed("an exception of 100 MB", before("raise ValueError('x' * 100_000_000)"), words=""),
    Deed("an exception of 10 GB", before("raise ValueError('x' * 10_000_000_000)"), words="emory"),
    Deed(
        "an exception that cannot be told",
        before("class Odd(Exception):\n    def __str__(self):\n        raise self\n\nraise Odd"),
        words="Odd",
    ),
    Deed("recursion without end", before("def f():\n    return f()\n\nf()"), words="Recursion"),
    Deed("messages without end", within("while True:\n    self.publish_humidity()"), words=""),
    Deed(
        "log lines without end",
        within("while True:\n    self.get_logger().info('x' * 1000)"),
        words="",
    ),
    Deed(
        "nodes without end",
        before("while True:\n    Node('a')").replace("while", "rclpy.init()\nwhile"),
        words="",
    ),
    Deed("deep brackets", "HumiditySensor = " + "(" * 5000 + ")" * 5000, words=""),
    Deed("deep lists", "HumiditySensor = " + "-" * 20000 + "1", words=""),
)
