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
    errors,
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
    ("ros.messages('a', 'b')", "was given 2 positional arguments", 'ros.messages("temperature")'),
    ("ros.logs('a', 'b')", "was given 2 positional arguments", "ros.logs("),
    ("ros.explain()", "was called without `topic`", 'ros.explain("temperature")'),
    ("ros.explain('a', 3)", "was given 2 positional arguments", "ros.explain("),
    ("ros.pause()", "was called without `node`", "ros.pause("),
    ("ros.resume()", "was called without `node`", "ros.resume("),
    ("ros.remove()", "was called without `node`", "ros.remove("),
    ("ros.spawn()", "was called without `program`", "ros.spawn("),
    ("ros.start(5)", "was given 1 positional argument, but takes none", "ros.start()"),
    ("ros.stop(5)", "was given 1 positional argument, but takes none", "ros.stop()"),
    ("ros.wait(1, 2, 3)", "was given 3 positional arguments, but takes 1", "ros.wait("),
    ("ros.wait_for_nodes(names='a')", "has no argument `names`", "ros.wait_for_nodes("),
    ("ros.close(1)", "was given 1 positional argument", "ros.close()"),
    ("ros.graph(1)", "was given 1 positional argument", "ros.graph()"),
    ("ros.observation(1)", "was given 1 positional argument", "ros.observation()"),
    ("ros.panel(1)", "was given 1 positional argument", "ros.panel()"),
    ("Session(7)", "was given 1 positional argument, but takes none", "Session(seed=7)"),
    ("Session(sead=7)", "has no argument `sead`", "Did you mean `seed`?"),
    ("check('03a', 1, 2)", "was given 3 positional arguments, but takes 2", 'check("03a", '),
    ("hint('03a', 2)", "was given 2 positional arguments, but takes 1", 'hint("03a")'),
    ("progress('00')", "was given 1 positional argument, but takes none", "progress()"),
    ("quiz(number=1)", "has no argument `number`", 'quiz("03", '),
    ("predict()", "was called without `guess` and `happened`", 'predict("20-30", reading)'),
    ("predict('1')", "was called without `happened`", 'predict("20-30", reading)'),
    ("predict('1', actual=1)", "has no argument `actual`", "predict("),
    ("predict(0,5, 0.5)", "was given 3 positional arguments", "`0.5`"),
    ("viz.graph()", "was called without `source`", "viz.graph(ros)"),
    ("viz.timeline()", "was called without `source`", "viz.timeline(ros)"),
    ("viz.timeline(ros, start=0)", "has no argument `start`", "viz.timeline(ros)"),
    ("viz.values()", "was called without `source`", "viz.values(ros, "),
    ("viz.queue()", "was called without `source`", 'viz.queue(ros, "temperature")'),
    ("viz.message_flow(1)", "was called without `received`", "viz.message_flow(sensor, monitor)"),
    ("viz.diagram()", "was called without `name`", 'viz.diagram("03")'),
    ("viz.comparison()", "was called without `compared`", "viz.comparison(compared)"),
    ("bags.Bag()", "was called without `folder`", 'bags.Bag("first_run")'),
    ("bags.record(ros)", "was called without `folder`", "bags.record(ros, "),
    ("bags.replay()", "was called without `source`", "bags.replay(bag)"),
    ("bags.inject()", "was called without `source`", "bags.inject(bag, "),
    ("bags.compare(ros, ros)", "was called without `topic`", "bags.compare(one, other, "),
    ("bags.drift()", "was called without `rate`", "bags.drift(rate=0.1)"),
    ("bags.drift(0,5)", "was given 2 positional arguments", "`0.5`"),
    ("bags.dropouts(shar=1)", "has no argument `shar`", "Did you mean `share`?"),
    ("bags.stuck(1, 2, 3)", "was given 3 positional arguments", "bags.stuck("),
    ("bags.with_nan(a=1)", "has no argument `a`", "bags.with_nan("),
    ("clinic.names(5)", "was given 1 positional argument", "clinic.names()"),
    ("clinic.Ward(1, 2)", "was given 2 positional arguments", "clinic.Ward(seed=7)"),
    ("clinic.Ward().patient()", "was called without `number`", "ward.patient(1)"),
    ("workspace.terminal()", "was called without `name`", 'workspace.terminal("sensor")'),
    ("workspace.catch_up()", "was called without `page`", 'workspace.catch_up("05")'),
    ("workspace.folder(3)", "was given 1 positional argument", "workspace.folder()"),
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


def test_every_public_function_is_called_in_one_of_these_cases():
    called = {call.partition("(")[0] for call, _, _ in CALLS}
    functions = {
        name if module is rosbeat else f"{module.__name__.rpartition('.')[2]}.{name}"
        for module in (rosbeat, bags, clinic, viz, workspace)
        for name in module.__all__
        if hasattr(getattr(module, name), "__code__")
    }
    methods = {f"ros.{name}" for name in dir(Session)
               if not name.startswith("_") and callable(getattr(Session, name))}  # fmt: skip
    # For the page's first line, and not for learners.
    assert functions | methods <= called | {"workspace.register"}


def test_the_second_part_lists_the_arguments():
    with pytest.raises(CallError) as told:
        viz.graph()
    assert told.value.means == "It needs `source`. It also takes `highlight` and `infrastructure`."
    with pytest.raises(CallError) as told:
        Session().run()
    assert told.value.means == "It needs `seconds`. It also takes `quiet`."
    with pytest.raises(CallError) as told:
        progress("00")
    assert told.value.means == "It takes no arguments."


def test_two_whole_numbers_where_none_is_a_time_are_not_one_decimal_number():
    with pytest.raises(CallError) as told:
        clinic.Ward().patient(1, 2)
    assert "decimal" not in told.value.to_try


def test_a_type_error_of_the_function_itself_passes():
    @called_as("f(1)")
    def f(one):
        return one + "text"

    with pytest.raises(TypeError, match="unsupported operand"):
        f(1)
    assert list(signature(f).parameters) == ["one"]


def test_a_node_class_that_calls_wrongly_in_its_constructor_is_told_so(ros):
    def nothing():
        return len()

    with pytest.raises(errors.RosbeatError, match="len"):
        ros.add(nothing)


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
