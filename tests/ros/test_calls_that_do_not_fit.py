"""Calls on a page with arguments that a function does not take end in three parts."""

from inspect import signature

import pytest

import rosbeat
from nodes import Talker
from rosbeat import (
    Session,
    bags,
    check,
    clinic,
    hint,
    predict,
    progress,
    quiz,
    viz,
    workspace,
)
from rosbeat.errors import CallError, PictureError, called_as

CALLS = [
    ("ros.run()", "was called without `seconds`", "ros.run(seconds=60)"),
    ("ros.run(0,5)", "was given 2 positional arguments, but takes 1", "`0.5`"),
    ("ros.run(5, True)", "was given 2 positional arguments, but takes 1", "ros.run(seconds=60)"),
    ("ros.run(second=5)", "has no argument `second`", "Did you mean `seconds`?"),
    ("ros.run(5, seconds=5)", "was given `seconds` twice", "ros.run(seconds=60)"),
    ("ros.add(Talker, nam='a')", "has no argument `nam`", "Did you mean `name`?"),
    ("ros.messages()", "was called without `topic`", 'ros.messages("temperature")'),
    ("ros.start(5)", "was given 1 positional argument, but takes none", "ros.start()"),
    ("Session(7)", "was given 1 positional argument, but takes none", "Session(seed=7)"),
    ("Session(sead=7)", "has no argument `sead`", "Did you mean `seed`?"),
    ("check('03a', 1, 2)", "was given 3 positional arguments, but takes 2", 'check("03a", '),
    ("predict()", "was called without `guess` and `happened`", 'predict("20-30", reading)'),
    ("viz.graph()", "was called without `source`", "viz.graph(ros)"),
    ("bags.drift(0,5)", "was given 2 positional arguments", "`0.5`"),
    ("clinic.Ward().patient()", "was called without `number`", "ward.patient(1)"),
    ("workspace.terminal()", "was called without `name`", 'workspace.terminal("sensor")'),
]
PAGE = {
    **{"Session": Session, "bags": bags, "check": check, "clinic": clinic, "hint": hint},
    **{"predict": predict, "progress": progress, "quiz": quiz, "viz": viz, "workspace": workspace},
    "Talker": Talker,
}


@pytest.mark.parametrize(("call", "what", "to_try"), CALLS, ids=[one[0] for one in CALLS])
def test_a_call_that_does_not_fit_says_how_it_is_written(ros, call, what, to_try):
    with pytest.raises(CallError) as told:
        eval(call, {**PAGE, "ros": ros})
    name = call.replace("clinic.Ward().", "ward.").partition("(")[0]
    assert told.value.what.startswith(f"`{name}` {what}")
    assert told.value.means
    assert to_try in told.value.to_try
    shown = "\n".join(told.value._render_traceback_())
    assert "__init__" not in shown
    assert "Traceback" not in shown


def test_every_public_function_answers_a_call_that_does_not_fit():
    functions = [
        getattr(module, name)
        for module in (rosbeat, bags, clinic, viz, workspace)
        for name in module.__all__
        if hasattr(getattr(module, name), "__code__") and name != "register"  # not for learners
    ]
    methods = [getattr(Session, name) for name in dir(Session)
                if not name.startswith("_") and callable(getattr(Session, name))]  # fmt: skip
    for function in (*functions, *methods):
        with pytest.raises(CallError):
            function(no_such_argument=1)


def test_the_second_part_lists_the_arguments():
    with pytest.raises(CallError) as told:
        viz.graph()
    assert told.value.means == "It needs `source`. It also takes `highlight` and `infrastructure`."
    with Session() as ros, pytest.raises(CallError) as told:
        ros.run()
    assert told.value.means == "It needs `seconds`. It also takes `quiet`."
    with pytest.raises(CallError) as told:
        progress("00")
    assert told.value.means == "It takes no arguments."


def test_a_type_error_of_the_function_itself_passes():
    @called_as("f(1)")
    def f(one):
        return one + "text"

    with pytest.raises(TypeError, match="unsupported operand"):
        f(1)
    assert list(signature(f).parameters) == ["one"]


@pytest.mark.parametrize("call", [
    "viz.timeline(ros, 0)", "viz.values(ros, 5)", "viz.graph(ros, 5)", "viz.values(ros, [5])",
])  # fmt: skip
def test_a_number_in_the_place_of_a_topic_is_no_name(ros, call):
    ros.add(Talker)
    ros.run(seconds=2, quiet=True)
    with pytest.raises(PictureError, match=r"is not the name of a topic") as told:
        eval(call, {**PAGE, "ros": ros})
    assert told.value.means
    assert told.value.to_try


def test_bands_that_are_no_dictionary_are_refused(ros):
    ros.add(Talker)
    ros.run(seconds=2, quiet=True)
    with pytest.raises(PictureError, match="`bands` was given 0"):
        viz.values(ros, None, 0)
