"""Which mistake an exception comes from.

One mistake, one small pure function; the first that recognises a fault speaks. They go by the
exception, by the call of rclpy that failed, and by the learner's line only where nothing else does.
What none of them recognises stays unnamed.
"""

from __future__ import annotations

from rosbeat.diagnosis import (
    answers,
    callbacks,
    entities,
    fields,
    names,
    nodes,
    parameters,
    profiles,
    values,
)
from rosbeat.diagnosis.meaning import Meaning, Recogniser, called_by_ros, matched
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.records import Fault

_RECOGNISERS: tuple[Recogniser, ...] = (
    nodes.no_node,
    nodes.exits,
    nodes.parent_not_called,
    nodes.name_missing,
    nodes.wrong_name_argument,
    nodes.invalid_name,
    nodes.two_types,
    nodes.not_initialised,
    nodes.init_in_with,
    callbacks.blocks,
    callbacks.endless,
    callbacks.called_at_once,
    entities.wrong_call,
    callbacks.refused_callback,
    entities.not_a_message_type,
    entities.bad_depth,
    entities.by_text,
    callbacks.wrong_timer,
    callbacks.called_with_others,
    callbacks.nothing_to_call,
    answers.no_response,
    answers.no_result,
    answers.not_feedback,
    answers.bad_transition,
    answers.not_whole,
    answers.called_with_more,
    parameters.of_another_type,
    parameters.no_value,
    parameters.name_last,
    parameters.asked_with_more,
    parameters.not_declared,
    parameters.declared_twice,
    parameters.taken_for_its_value,
    profiles.no_depth,
    profiles.without_a_name,
    profiles.of_another_name,
    profiles.of_another_kind,
    profiles.no_such_policy,
    profiles.event_callback_called,
    profiles.no_events,
    profiles.events_of_the_other_side,
    fields.of_another_type,
    fields.out_of_range,
    fields.of_another_name,
    fields.without_a_name,
    fields.not_there,
    fields.class_changed,
    fields.published,
    fields.message_for_value,
    names.not_assigned_yet,
    names.name_error,
    names.method_not_called,
    names.name_taken,
    names.nothing_there,
    names.no_such_attribute,
    names.not_importable,
    values.text_and_number,
    values.nothing_compared,
    values.bad_format,
    values.logged,
    values.too_much_given,
    values.not_callable,
    values.by_zero,
    values.no_such_place,
    values.without_self,
    values.method_wants_more,
    values.constructor_wants_more,
    values.too_deep,
)


def meaning_of(fault: Fault) -> Meaning | None:
    """What an exception means, if it comes from a known mistake; else None."""
    found = (recognise(fault) for recognise in _RECOGNISERS)
    return next((meaning for meaning in found if meaning is not None), None)


def diagnose_fault(fault: Fault) -> Diagnosis | None:
    """Name the mistake that an exception comes from.

    Args:
        fault: The exception.

    Returns:
        The mistake with the learner's own line as evidence; None if it is not a known one.
    """
    meaning = meaning_of(fault)
    return None if meaning is None else diagnosed(fault, meaning)


def diagnosed(fault: Fault, meaning: Meaning) -> Diagnosis:
    """A meaning as a diagnosis: with who raised, and the learner's own line, as evidence."""
    if fault.text == meaning.means:  # the session itself refused; its sentence is complete
        return Diagnosis(meaning.mistake, meaning.means, meaning.to_try)
    raised = _raised(fault) if fault.callback else ""
    return Diagnosis(meaning.mistake, f"{raised}{meaning.means}{line_of(fault)}", meaning.to_try)


def _raised(fault: Fault) -> str:
    if fault.kind == "DeadlinePassed":  # no exception of the learner's
        return ""
    ticks = matched(fault, r"object is not callable") and called_by_ros(fault)
    by = "" if ticks else fault.callback
    return f"{by or 'The first tick'} raised {fault.kind}. "


def line_of(fault: Fault) -> str:
    """The learner's line as the end of a sentence before it, or an empty text."""
    return f" Line {fault.line}: `{fault.code}`." if fault.line and fault.code else ""


def first_sentence(text: str) -> str:
    """The part of an error's text that says something.

    Errors of the middleware go on for lines, with addresses of objects and places in its own
    source files.
    """
    return text.split(", at /")[0].split("\n")[0].rstrip(".: ")
