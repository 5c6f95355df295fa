r"""Texts that a report shows: for terminals, browsers and tables, or too long for them."""

from hostile.deed import WRONG, Deed, before, within

_ODD = "'=1+1 <script>alert(1)</script>' + chr(0x202e) + chr(27) + '[2J' + chr(7) + chr(0)"

DEEDS = (
    Deed(
        "a log line for terminals and browsers",
        within(f"self.get_logger().info({_ODD})"),
        words="",
        passes=True,
    ),
    Deed(
        "an exception for terminals and browsers",
        before(f"raise ValueError({_ODD})"),
        words="ValueError",
    ),
    Deed(
        "an exception of half letters",
        before("raise ValueError(chr(0xd800) * 500)"),
        words="ValueError",
    ),
    Deed(
        "an exception by a strange name",
        before(f"raise type({_ODD}.replace(chr(0), ''), (Exception,), {{}})"),
        words="raised",
    ),
    Deed(
        "a node by a strange name",
        WRONG.replace('"humidity_sensor"', _ODD),
        words="",
    ),
    Deed(
        "a topic by a strange name",
        WRONG.replace('"humidity"', _ODD),
        words="",
    ),
    Deed(
        "a topic of 100,000 letters",
        WRONG.replace('"humidity"', "'a' * 100_000"),
        words="",
    ),
    Deed(
        "a log line of 10 MB",
        within("self.get_logger().info('x' * 10_000_000)"),
        words="",
    ),
    Deed("a line of a million letters", before(f"x = '{'x' * 90_000}'\n{'y' * 90_000}"), words=""),
    Deed(
        "a warning for terminals",
        before(f"import warnings\nwarnings.warn({_ODD})\nprint({_ODD})\nNONE = '\\d'", WRONG),
        words="readings",
    ),
    Deed(
        "readings that are no numbers",
        WRONG.replace("45.0", "float('nan')"),
        words="readings",
    ),
    Deed(
        "readings without end",
        WRONG.replace("45.0", "-float('inf')"),
        words="readings",
    ),
)  # fmt: skip
