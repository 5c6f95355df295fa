"""Name the word at which Python could not read a cell, and what to write instead.

Python's own message says what its parser met. These rules know what people type who know another
language, a word processor or a terminal better. The first rule that recognizes a line decides.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from rosbeat.diagnosis.mistakes import Diagnosis

#: Programs and commands of a shell that pages type into terminals, and others that people know.
COMMANDS = (
    *("ros2", "colcon", "source", "ls", "cd", "mkdir", "pwd", "cat", "rm", "cp", "mv", "sed"),
    *("grep", "python3", "python", "pip", "touch", "chmod", "echo", "export", "sudo", "apt"),
    *("git", "bash", "nano", "which", "rmdir", "clear", "roscore", "rosrun", "tree", "code"),
)
_ID = "syntax-error"
#: A command with nothing behind it, or with a word, an option or a path: no assignment or call.
_COMMAND = re.compile(
    rf"\s*(?:[$#]\s+)?(?P<name>{'|'.join(COMMANDS)}|cd\.\.)(?P<rest>\s+[^=(\s].*|\s*)$"
)
_UNITS = (
    r"(?:ms|us|ns|s|secs?|seconds?|min|minutes?|h|hours?|Hz|kHz|hz|mm|cm|m|km|kg|g|V|A|W"
    # A sign of percent with a value behind it is the operator.
    r"|%(?!\s*[\w(\[{.+-])|°|°?C|°?F|degrees?|deg|times|messages|readings)"
)
_ALREADY = "none of its lines ran"


@dataclass(frozen=True)
class Slip:
    """Recognize a mistake by the line, and by what Python says.

    Attributes:
        line: A regular expression that is looked for in the line.
        message: One that is looked for in Python's message.
        means: What the line says; `{1}` is the first group of `line`, or else of `message`.
        to_try: What to write, with groups as well.
    """

    line: str
    message: str
    means: str
    to_try: str

    def __call__(self, line: str, message: str) -> tuple[str, str] | None:
        """Return what it means and what to try, if it is this mistake; else None."""
        in_line, in_message = re.search(self.line, line), re.search(self.message, message)
        if not in_line or not in_message:
            return None
        groups = in_line.groups("") or in_message.groups("")
        return self.means.format("", *groups), self.to_try.format("", *groups)


_ANY = ""
#: Before all others: a unit may be a sign that Python does not know.
_UNIT = Slip(rf"(?<![\w.])((\d+(?:\.\d+)?)\s*{_UNITS})(?![\w\"'])", _ANY,
    "`{1}`: a number in Python has no unit behind it.",
    "Write only `{2}`. The name of the argument or variable tells what it counts.")  # fmt: skip
_ROWS = (
    _UNIT,
    # Words of other languages.
    Slip(r"\belse\s+if\b(?!.*\belse\b.*\belse\b)", r"expected ':'|invalid syntax",
        "`else if` is two words, which Python does not know together.",
        "In Python it is one word: `elif`."),
    Slip(r"^\s*(elseif|elsif|elsei|elf|elis)\b", _ANY,
        "Python does not know the word `{1}`.",
        "The word for another condition is `elif`."),
    Slip(r"^\s*(?:el)?if\b.*\bthen\s*:?\s*$|^\s*while\b.*\b(do)\s*:?\s*$", _ANY,
        "Python has no `then` or `do` behind a condition.",
        "End the line with a colon after the condition."),
    Slip(r"(&&|\|\|)", _ANY,
        "Python does not know the sign `{1}`.",
        "Write the words `and`, `or`, `not` instead of `&&`, `||`, `!`."),
    Slip(r"\b(?:if|while|elif)\s*\(?\s*!\w|\bnot\b.*!\w", _ANY,
        "`!` in front of a value means nothing in Python.",
        "Write `not` there."),
    Slip(r"(\w+)\s*(?:\+\+|--)\s*;?\s*$", _ANY,
        "Python has no `++` or `--`.",
        "Write `{1} += 1` or `{1} -= 1`."),
    Slip(r"^\s*(?://|/\*)", _ANY,
        "This line begins like a comment of another language.",
        "In Python, a comment begins with `#`."),
    Slip(r"^\s*(?:if|elif|else|for|while|def|class)\b.*\{\s*$|^\s*\}\s*(?:else.*)?$", _ANY,
        "Python has no braces around a block of lines.",
        "End the line above the block with a colon, and indent the block by four spaces."),
    Slip(r"^\s*import\s+([\w, ]+?)\s+from\s+([\w.]+)", _ANY,
        "In Python, `from` comes first.",
        "Write `from {2} import {1}`."),
    Slip(r"^\s*(?:function|func|fn|void)\s+(\w+)", _ANY,
        "Python does not know that word for a function.",
        "A function begins with `def {1}(...):`."),
    Slip(r"^\s*(int|float|double|string|bool|var|let|const|auto|char|String)\s+(\w+)\s*=", _ANY,
        "`{1}` in front of the name is of another language.",
        "A variable in Python is only assigned: `{2} = ...`."),
    Slip(r"\bnew\s+(\w+)\s*\(", _ANY,
        "Python has no word `new`.",
        "The class followed by parentheses makes an object: `{1}(...)`."),
    # Comparisons.
    Slip(r"\b(or|and)\s*([<>]=?|[!=]=)", _ANY,
        "Behind `{1}` a comparison begins without the value on its left side.",
        "Each side of `{1}` needs a comparison of its own: write the name again before `{2}`."),
    Slip(r"(=>|=<)", _ANY,
        "Python does not know the sign `{1}`.",
        "The equals sign comes last: `>=` or `<=`."),
    Slip(r"\b(greater|less|bigger|smaller|higher|lower|above|below)\s*(?:than\b|\d)", _ANY,
        "Python does not know the word `{1}`.",
        "Compare with `<`, `>`, `<=` or `>=`."),
    Slip(r"^\s*(?:if|elif|while)\b", r"Maybe you meant '=='",
        "A single `=` assigns a value, and a condition compares.",
        "Write `==` in the condition."),
    Slip(r"(\w+(?:-\w+)+)\s*=", r"cannot assign to expression",
        "In `{1}`, the `-` is a minus sign, so it is no name.",
        "Names are made of letters, digits and `_`: write `_` instead of `-`."),
    Slip(_ANY, r"cannot assign to (.+?)(?: here)?\.? Maybe you meant '=='",
        "What is on the left side of `=` (Python calls it: {1}) cannot get a value.",
        "To assign, put a name on the left. To compare, write `==`."),
    # Numbers.
    Slip(r"(?<!\w)(\d+[A-Za-z_]\w*)", "invalid decimal literal",
        "`{1}` begins with a digit, so Python reads it as a number, and it is none.",
        "A name begins with a letter or `_`."),
    Slip(r"(?<!\w)(0\d+)", "leading zeros",
        "`{1}` begins with a zero, which Python's whole numbers don't.",
        "Leave the zeros at the beginning out."),
    # Calls, strings, brackets.
    Slip(r"^\s*print\s+[^(\s]", _ANY,
        "`print` is a function, and a function needs parentheses.",
        "Write `print(...)`, with the text between the two."),
    Slip(_ANY, r"'([(\[{])' was never closed",
        "The bracket `{1}` is opened here and never closed.",
        "Count the brackets on this line and those below it: each needs its partner."),
    Slip(_ANY, r"unmatched '([)\]}])'",
        "The bracket `{1}` closes something that was not opened.",
        "Remove it, or add its partner before it."),
    Slip(_ANY, r"closing parenthesis '(.)' does not match opening parenthesis '(.)'",
        "`{2}` was opened last, and `{1}` cannot close it.",
        "Close brackets in the reverse order in which you opened them."),
    Slip(_ANY, r"unterminated triple-quoted",
        "A text that begins with three quotes does not end.",
        "Three quotes of the same kind end it."),
    Slip(_ANY, r"unterminated (?:f-)?string",
        "A text begins with a quote here, and the line ends before the text does.",
        "End the text with the same kind of quote with which it begins. An apostrophe ends a text "
        "in single quotes: put that text into double quotes."),
    Slip(r"^\s*(class|def|if|elif|else|for|while|try|except|finally|with)\b", r"expected ':'",
        "A colon is missing: a line that begins with `{1}` ends with one.",
        "Put `:` at the end of the line, before a comment."),
    Slip(r"^\s*def\s+(\w+)\s*:?\s*$", _ANY,
        "The parentheses behind `def {1}` are missing.",
        "Write `def {1}(self):` for a method, or `def {1}():` for a function."),
    Slip(_ANY, r"f-string: (?:expecting '}'|single '}'|valid expression)",
        "The braces of this f-string don't fit together.",
        "Each `{{` in it needs a `}}`, with a name or a calculation between the two."),
    Slip(_ANY, r"positional argument follows keyword argument",
        "In a call, values without a name come before those with one.",
        "Put the `name=value` pairs last."),
    Slip(_ANY, r"keyword argument repeated: (\w+)",
        "The call gives the argument `{1}` twice.",
        "Remove one of the two."),
    Slip(r"^\s*(else|elif|except|finally)\b", "invalid syntax",
        "There is no `if` or `try` above that this `{1}` could belong to.",
        "It begins with the same number of spaces as its `if` or `try`, and nothing of that "
        "indentation stands between the two."),
    Slip(r"^\s*(class|def|for|if|while|import|from|lambda|with|as|is|in|pass|global|return)\s*=[^=]",
        _ANY,
        "`{1}` is a word of Python itself, so it cannot be the name of a variable.",
        "Choose another name, such as `{1}_`."),
    Slip(_ANY, r"'(return|yield|await)' outside (?:async )?function",
        "`{1}` belongs in a function, and this line is in none.",
        "Indent it so that it is part of the function above."),
    Slip(_ANY, r"'(break|continue)' (?:outside loop|not properly in loop)",
        "`{1}` belongs in a loop, and this line is in none.",
        "Indent it so that it is part of the loop above."),
    Slip(r"^\s*(?:from|import)\b", _ANY,
        "This import is not complete, or has a word too many.",
        "An import is `import module` or `from module import Name`."),
)  # fmt: skip
#: Rules about the beginning of lines.
_INDENTATION = (
    Slip(_ANY,
        r"expected an indented block after '?([\w ]+?)'? (?:statement|definition) on line (\d+)",
        "Line {2} begins a block, and the line below it is not indented.",
        "Indent what belongs to that `{1}` by four spaces. A block that is still empty holds the "
        "word `pass`."),
    Slip(_ANY, "unexpected indent",
        "This line begins with more spaces than the line above it, which opens no block.",
        "Remove the spaces, or end the line above with a colon if a block is to begin."),
    Slip(_ANY, "unindent does not match",
        "This line begins with a number of spaces that no line above it has.",
        "Let it begin exactly below a line of the block that it belongs to."),
    Slip(_ANY, "inconsistent use of tabs",
        "Some of these lines begin with spaces, and others with the Tab character.",
        "Use spaces only: delete what is before the first word, and type four spaces."),
)  # fmt: skip
_QUOTES = "“”„‟«»‘’‚‹›`´"
_LOOKS_LIKE = {
    "–": "-",
    "—": "-",
    "−": "-",
    "×": "*",
    "÷": "/",
    "≤": "<=",
    "≥": ">=",
    "≠": "!=",
    "，": ",",
    "：": ":",
    "（": "(",
    "）": ")",
    "；": ";",
    "…": "...",
}


def about_syntax(error: SyntaxError, cell: str = "") -> tuple[str, str]:
    """Return what an error of syntax means, naming the word, and what to try.

    Args:
        error: What Python raised.
        cell: The whole cell, in which commands of a terminal may have been typed.
    """
    message, line = str(error.msg), (error.text or "").rstrip()
    if command := command_in(cell or line):
        return command
    if message == "incomplete input" and (sign := _open_bracket(cell or line)):  # as IPython has it
        message = f"'{sign}' was never closed"
    rules: tuple[Slip, ...] = _ROWS
    if isinstance(error, IndentationError):
        rules = _INDENTATION
        line = ""
    elif not _UNIT(line, message) and (foreign := _foreign_sign(line)):
        return foreign
    recognized = next(filter(None, (rule(_without_texts(line), message) for rule in rules)), None)
    place = f"Line {error.lineno}: " if error.lineno else ""
    if recognized:
        means, to_try = recognized
        place = "" if means.startswith("Line ") else place
        return f"{place}{means} Python can't read the cell, so {_ALREADY}.", to_try
    word = _word_at(error)
    at = f" at `{word}`" if word else ""
    return (
        f"Python can't read line {error.lineno}{at}, so {_ALREADY}.",
        "Look at that place, and at the end of the line above it: a quote, a bracket, a comma, an "
        "operator or a colon may be missing.",
    )


def diagnose_syntax(message: str, line: str) -> Diagnosis | None:
    """Return the mistake in a line of a file, if it is a known one.

    Args:
        message: What Python says of it.
        line: The line.
    """
    recognized = next(filter(None, (rule(_without_texts(line), message) for rule in _ROWS)), None)
    return None if recognized is None else Diagnosis(_ID, *recognized)


def command_in(cell: str) -> tuple[str, str] | None:
    """Return what to do about a cell that begins with a command of a terminal; else None.

    Args:
        cell: The cell.
    """
    lines = [line for line in cell.splitlines() if line.strip() and not line.startswith("# ")]
    command = _COMMAND.match(lines[0]) if lines else None
    if not command:
        return None
    rest = "".join(f" {word}" for word in command["rest"].split()[:2])
    return (
        f"`{command['name']}{rest}` is a command for a terminal, and this is a cell of Python.",
        "Begin the cell with `%%terminal look`, in a line of its own above the command. Then it is "
        "typed into a terminal called `look`.",
    )


def _foreign_sign(line: str) -> tuple[str, str] | None:
    """Recognize signs that only look like those of Python: of word processors and web pages."""
    plain = _without_texts(line)
    quote = next((sign for sign in plain if sign in _QUOTES), "")
    if quote:
        return (
            f"`{quote}` is a typographic quote or an accent, as word processors write it, so "
            f"{_ALREADY}.",
            "Type the quotes anew on the keyboard: Python's are straight, \" or '.",
        )
    sign = next((sign for sign in plain if not sign.isascii() and not sign.isalnum()), "")
    if not sign:
        return None
    if sign in _LOOKS_LIKE:
        hint = f"Type {_LOOKS_LIKE[sign]} on the keyboard."
    else:
        hint = "Delete it; for a space, press the space bar anew."
    named = unicodedata.name(sign, "a character that cannot be seen").lower()
    return f"Python does not know the sign {sign!r} ({named}), so {_ALREADY}.", hint


def _open_bracket(cell: str) -> str:
    """Return the last bracket of a cell that nothing closes."""
    waiting: list[str] = []
    partners = {")": "(", "]": "[", "}": "{"}
    for sign in "\n".join(map(_without_texts, cell.splitlines())):
        if sign in partners.values():
            waiting.append(sign)
        elif waiting and partners.get(sign) == waiting[-1]:
            waiting.pop()
    return waiting[-1] if waiting else ""


def _without_texts(line: str) -> str:
    """Return a line with nothing in its quotes, and without its comment."""
    plain = re.sub(r"\"[^\"\n]*\"|'[^'\n]*'", lambda quoted: quoted[0][0] * 2, line)
    return (
        re.sub(r"(?<![\"'])#.*", "", plain)
        if "#" in plain and not plain.strip().startswith("#")
        else plain
    )


def _word_at(error: SyntaxError) -> str:
    """Return the word that Python marks."""
    text, offset = error.text or "", error.offset or 0
    if not 0 < offset <= len(text):
        return ""
    word = re.match(r"\w+|[^\w\s]+", text[offset - 1 :])
    return word[0] if word else ""
