import pytest

from rosbeat.grading.inside.careful import careful_functions

careful = careful_functions()


class Thing:
    context = "somebody"

    def __init__(self):
        self.speed = 1
        self._own = 2


Thing.__module__ = "__main__"  # as of a class in a cell


def test_attributes_by_name():
    thing = Thing()
    careful["setattr"](thing, "speed", 3)
    assert careful["getattr"](thing, "speed") == 3
    assert careful["getattr"](thing, "_own") == 2
    assert careful["getattr"](thing, "nothing", "else") == "else"
    assert careful["getattr"](Thing, "__name__") == "Thing"
    careful["delattr"](thing, "speed")
    assert not hasattr(thing, "speed")


@pytest.mark.parametrize(
    "name", ["__dict__", "__globals__", "f_back", "tb_frame", "_Thing__x", "context", "executor"]
)
def test_inner_parts_are_not_there(name):
    thing = Thing()
    assert careful["getattr"](thing, name, "no") == "no"
    for attempt in (
        ("getattr", thing, name),
        ("setattr", thing, name, 1),
        ("delattr", thing, name),
    ):
        with pytest.raises(AttributeError, match=name):
            careful[attempt[0]](*attempt[1:])


def test_private_parts_of_others_are_not_there():
    assert careful["getattr"](pytest, "_pytest", None) is None


def test_a_name_that_is_no_text_is_pythons_own_error():
    with pytest.raises(TypeError):
        careful["getattr"](Thing(), 3)
