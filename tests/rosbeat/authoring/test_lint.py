"""Every rule with samples that keep it and samples that break it."""

from __future__ import annotations

import pytest

from rosbeat.authoring.lint import LINTS, answer_markers, check_lessons

EXERCISE = """
# %% exercise="00a"
class Sensor(Node):
    def __init__(self):
        # --- answer
        self.timer = self.create_timer(1.0, self.publish_temperature)
        # --- blank
        # self.timer = self.create_timer(____, ____)
        # --- end

# %% check="00a"
print("not attempted yet")
"""
PREDICTION = """
# %% predict=true
beats = [0.0, 0.8]
# --- answer
predict(2, len(beats))
# --- blank
# predict("____", len(beats))
# --- end
"""
ANSWER = "# --- answer\n{}\n# --- blank\n{}\n# --- end\n"

BROKEN = {
    "leaked-answer": [
        EXERCISE + "# %%\nself.timer = self.create_timer(1.0,  self.publish_temperature)",
        EXERCISE + "# %% [markdown]\n# Write `self.timer=self.create_timer(1.0, "
        "self.publish_temperature)`.",
        EXERCISE + "# %% [markdown]\n# ```\n# self.timer = self.create_timer(\n#     1.0,\n"
        "#     self.publish_temperature)\n# ```",
        EXERCISE + "# %% [markdown]\n# ![it says self.timer = self.create_timer(1.0, "
        "self.publish_temperature)](x.svg)",
        EXERCISE.replace("# self.timer = self.create_timer(____, ____)",
                         "# # self.timer = self.create_timer(1.0, self.publish_temperature)\n"
                         "        # self.timer = ____"),
    ],
    "syntax": ["# %%\nThis is prose.", "# %%\nx = (1",
               '# %% save="src/p/p/node.py"\nThis is prose.'],
    "blank-outside-function": [
        '# %% exercise="00a"\n' + ANSWER.format("period = 1.0", "# period = ____"),
        '# %% exercise="00a"\nclass A:\n    # --- answer\n    x = 1\n    # --- blank\n'
        "    # x = ____\n    # --- end",
        '# %% exercise="00a"\n' + ANSWER.format("def f(x=1): pass", "# def f(x=____): pass"),
        '# %% exercise="00a"\n' + ANSWER.format("class A(Node): pass", "# class A(____): pass"),
    ],
    "stray-blank": ["# %%\ndef f():\n    return ____"],
    "answer-outside-exercise": [
        "# %%\n" + ANSWER.format("x = 1", "# def f(): ____"),
        '# %% exercise="00a"\nx = 1\n# %% check="00a"\nx',
        '# %% exercise="00a" only="notebook"\n' + ANSWER.format("x = 1", "# def f(): ____"),
    ],
    "exercise-pairs": [EXERCISE.split("# %% check")[0], '# %% check="00a"\nx = 1',
                       EXERCISE + EXERCISE, EXERCISE + '# %% check="00a"\nx = 1'],
    "predictions": [
        PREDICTION.replace(" predict=true", ""),
        "# %%\npredict(2, len(beats))",
        "# %% predict=true\npredict(2, len(beats))",
        PREDICTION.replace('"____"', '"__"').replace("len(beats))\n# --- end", "____)\n# --- end"),
        PREDICTION.replace('# predict("____", len(beats))', '# "____"'),
        PREDICTION.replace("predict(2, ", 'predict("____", '),
        PREDICTION.replace("predict=true", 'predict=true only="solution"'),
        PREDICTION.replace("predict=true", 'predict=true save="src/a.py"'),
        PREDICTION.replace("predict=true", 'predict=true exercise="00a"'),
        PREDICTION.replace("predict=true", 'predict=true check="00a"'),
    ],
    "unfolded-answer": [
        PREDICTION + "# %% [markdown]\n# Two.",
        PREDICTION + "# %%\nlen(beats)\n# %% [markdown]\n# Two.",
        PREDICTION + "# %% [markdown]\n# ## Next\n#\n# Two.",
        PREDICTION + "# %% [markdown] answers=true\n# Two.\n#\n# ## Next",
        PREDICTION + "# %% answers=true\nlen(beats)",
        "# %% [markdown] answers=true\n# Two.",
        PREDICTION + "# %% [markdown] answers=true\n# Two.\n# %% [markdown] answers=true\n# Two.",
        "# %% [markdown]\n# ## What went wrong: two\n" + PREDICTION,
    ],
    "needless-import": ["# %%\nimport random\n\nfrom rosbeat import Session, check",
                        "# %%\ndef f():\n    from rosbeat import viz as v"],
    "broken-link": [
        "# %% [markdown]\n# [next](01_nothing.ipynb)",
        "# %% [markdown]\n# [up](#no-such-heading)",
        "# %% [markdown]\n# [page](00_hear_it.ipynb#Hear-what)",
        "# %% [markdown]\n# ![a drawing](pictures/none.svg)",
    ],
    "alt-text": ["# %% [markdown]\n# ![](https://example.org/x.svg)",
                 '# %% [markdown]\n# <img alt="" src="https://example.org/x.png">'],
    "title": ["# %% [markdown]\n# # Another title"],
    "answer-markers": ["# %%\n# --- answer\nx = 1", "# %% [markdown]\n# # --- blank"],
}  # fmt: skip

KEPT = [
    "# %%\nfrom rosbeat.ros.test_nodes import add_greenhouse",
    '# %% save="src/p/p/node.py"\nfrom rosbeat import Session',
    EXERCISE,
    EXERCISE + '# %% [markdown] only="solution"\n# It is `self.timer = self.create_timer(1.0, '
    "self.publish_temperature)`.",
    '# %% exercise="00a"\n# Short lines are everybody\'s.\ndef f():\n'
    "    # --- answer\n    pass\n    # --- blank\n    # ____\n    # --- end\n"
    '# %%\ndef g():\n    pass\n# %% check="00a"\nf',
    '# %% exercise="00a"\nf = 1\n'
    + ANSWER.format("g = lambda x: x + 1", "# g = lambda x: ____")
    + '# %% check="00a"\nf',
    '# %% exercise="00a"\n'
    + ANSWER.format("class A:\n    def __init__(self):\n        pass", "# # class ____:")
    + '# %% check="00a"\nf\n# %%\nclass B:\n    def __init__(self):\n        self.x = 1',
    EXERCISE.split("# %% check")[0] * 4 + '# %% check="00a"\nf',
    PREDICTION,
    PREDICTION + "# %% [markdown] answers=true\n# Two.\n# %% [markdown]\n# ## Next",
    PREDICTION + "# %%\nbeats\n# %% [markdown] answers=true\n# Two.\n" + PREDICTION,
    '# %% save="src/p/setup.py" exercise="00a"\n'
    + ANSWER.format('setup(entry="p.sensor:main")', "# setup(entry=____)")
    + '# %% check="00a"\nf',
    '# %% terminal="a" exercise="00a"\n'
    + ANSWER.format("# ls", "# # ____")
    + '# %% check="00a"\nf',
    "# %%\n%matplotlib inline\n!ls\nx = 1",
    "# %%\n%%bash\nls -l | head",
    "# %% [markdown]\n# ```python\n# import rclpy\n# rclpy.spin(node)\n# ```",
    "# %% [markdown]\n# for the first time:\n# - `self.timer = None` makes no timer.",
    "# %% [markdown]\n# [here](#Hear-it) [page](00_hear_it.ipynb#Hear-it) "
    "[solution](../solutions/00_hear_it.ipynb) [web](https://docs.ros.org/en/jazzy/)",
    "# %% [markdown]\n# ![a drawing](../src/lessons/00_hear_it.py)",
    "# %% [markdown]\n# ```\n# # not a heading\n# ```",
]


def names_of(checkout, body, **options):
    lesson = checkout.lesson(body, **options)
    return {finding.lint for finding in check_lessons(checkout.course, [lesson], [lesson])}


@pytest.mark.parametrize(
    ("name", "body"), [(name, body) for name, bodies in BROKEN.items() for body in bodies]
)
def test_a_sample_that_breaks_the_rule_is_found(checkout, name, body):
    assert name in names_of(checkout, body)


@pytest.mark.parametrize("body", KEPT)
def test_a_sample_that_keeps_the_rules_is_left_alone(checkout, body):
    assert names_of(checkout, body) == set()


def test_every_rule_has_a_broken_sample():
    rules = {lint.__name__.replace("_", "-") for lint in (*LINTS, answer_markers)}
    assert rules == set(BROKEN)


def test_an_answer_that_a_drawing_shows_is_found(checkout):
    drawing = checkout.course.notebooks / "x.svg"
    drawing.write_text("<text>self.timer = self.create_timer(1.0, self.publish_temperature)</text>")
    body = EXERCISE + "# %% [markdown]\n# ![a drawing](x.svg)"
    assert names_of(checkout, body) == {"leaked-answer"}


def test_links_to_other_pages_know_their_headings(checkout):
    other = checkout.lesson("# %% [markdown]\n# ## Look closer", name="01_say_it", title="Say it")
    body = "# %% [markdown]\n# [good](01_say_it.ipynb#Look-closer) [bad](01_say_it.ipynb#Look)"
    lesson = checkout.lesson(body)
    found = check_lessons(checkout.course, [lesson, other], [lesson])
    assert ["#Look'" in finding.what for finding in found] == [True]


def test_a_finding_names_file_line_rule_and_cure(checkout):
    lesson = checkout.lesson("# %%\nx = 1\nprint(____)")
    (finding,) = [
        f for f in check_lessons(checkout.course, [lesson], [lesson]) if f.lint == "stray-blank"
    ]
    line = lesson.path.read_text().split("\n").index("print(____)") + 1
    assert str(finding).startswith(f"src/lessons/00_hear_it.py:{line}: stray-blank: ____ stands")
