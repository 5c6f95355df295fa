"""Messages of any type, drawn by hypothesis from the definitions that the library brings."""

from hypothesis import strategies as st
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_typestore

STORE = get_typestore(Stores.ROS2_JAZZY)
TYPES = sorted(name for name in STORE.fielddefs if name.startswith(("std_msgs/", "sensor_msgs/")))
FILLER = "structure_needs_at_least_one_member"
TEXT = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=20)


def whole(bits, signed):
    low = -(2 ** (bits - 1)) if signed else 0
    return st.integers(low, low + 2**bits - 1)


SCALARS = {
    "bool": st.booleans(),
    "string": TEXT,
    "char": whole(8, False),
    "byte": whole(8, False).map(lambda value: [value]),
    "float32": st.floats(width=32),
    "float64": st.floats(),
    **{f"int{bits}": whole(bits, True) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": whole(bits, False) for bits in (8, 16, 32, 64)},
}


def value(holds):
    kind, detail = holds
    if kind == Nodetype.BASE:
        return SCALARS[detail[0]]
    if kind == Nodetype.NAME:
        return message(detail)
    inner, limit = detail
    sizes = (limit, limit) if kind == Nodetype.ARRAY else (0, min(limit or 3, 3))
    return st.lists(value(inner), min_size=sizes[0], max_size=sizes[1])


def message(type_name):
    """Plain data of one type."""
    fields = {name: value(holds) for name, holds in STORE.fielddefs[type_name][1]
              if name != FILLER}  # fmt: skip
    return st.fixed_dictionaries(fields)


#: A type's name and plain data of that type.
ANY = st.sampled_from(TYPES).flatmap(lambda name: st.tuples(st.just(name), message(name)))
