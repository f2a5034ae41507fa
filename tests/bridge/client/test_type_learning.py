"""A class is made of what rosapi tells of a type."""

from __future__ import annotations

import contextlib
import copy
import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bridge.client.type_learning import _class, _learned, learn
from bridge.codec import from_builtins, from_cbor, from_json, to_cbor, to_json
from bridge.core.errors import ProtocolError
from bridge.msgs import TYPES
from bridge.msgs.arrays import Float32Array, UInt16Array
from bridge.msgs.geometry_msgs import Pose, Twist
from bridge.msgs.std_msgs import Time
from bridge.server.rosapi.type_descriptions import typedefs
from tests.bridge.strategies import messages
from tests.looped import looped


def told(type="boat_msgs/Boat", constants=(), **fields):
    """One entry: each field as `name=(type, length)`."""
    return {
        "type": type,
        "fieldnames": list(fields),
        "fieldtypes": [kind for kind, _ in fields.values()],
        "fieldarraylen": [length for _, length in fields.values()],
        "examples": [],
        "constnames": [name for name, _ in constants],
        "constvalues": [value for _, value in constants],
    }


def test_a_learned_class_has_the_fields_and_types_that_were_told():
    Boat = learn(
        [told(name=("string", -1), depth=("float32", -1), echoes=("uint16", 0), cells=("float64", 3))]
    )
    assert Boat.__name__ == "Boat"
    assert Boat.MSGTYPE == "boat_msgs/Boat"
    assert Boat.ROSTYPES == ("string", "float32", "uint16[]", "float64[3]")
    assert Boat() == Boat("", 0.0, UInt16Array(), [0.0, 0.0, 0.0])


def test_it_decodes_and_encodes_like_any_other():
    Boat = learn([told(depth=("float32", -1), ranges=("float32", 0), picture=("uint8", 0))])
    boat = from_json(b'{"depth":null,"ranges":[1,null],"picture":"/9g="}', Boat)
    assert boat.ranges[0] == 1.0
    assert isinstance(boat.ranges, Float32Array)
    assert boat.picture == b"\xff\xd8"
    assert repr(from_builtins(from_cbor(to_cbor(boat)), Boat)) == repr(boat)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (b'{"id":256}', "id must be a whole number from 0 to 255, not 256."),
        (b'{"cells":[1]}', "cells must hold 2, not 1."),
    ],
)
def test_ranges_and_lengths_are_checked(text, sentence):
    Boat = learn([told(id=("uint8", -1), cells=("float64", 2))])
    with pytest.raises(ProtocolError) as caught:
        from_json(text, Boat)
    assert str(caught.value) == sentence


def test_what_it_is_made_of_is_learned_with_it():
    Boat = learn(
        [
            told(sails=("boat_msgs/Sail", 0), mast=("boat_msgs/Sail", -1), at=("time", -1)),
            told("boat_msgs/Sail", area=("float64", -1)),
        ]
    )
    boat = from_json(b'{"sails":[{"area":2}],"at":{"sec":3,"nanosec":4}}', Boat)
    assert (boat.sails[0].area, boat.mast.area, boat.at) == (2.0, 0.0, Time(3, 4))


def test_a_type_that_is_told_as_we_know_it_is_ours():
    assert learn(typedefs("geometry_msgs/Twist")) is Twist
    Boat = learn([told(pose=("geometry_msgs/Pose", -1)), *typedefs("geometry_msgs/Pose")])
    assert type(Boat().pose) is Pose


def test_a_type_that_is_told_otherwise_is_made_anew():
    Vector = learn([told("geometry_msgs/Vector3", x=("float64", -1), w=("float64", -1))])
    assert Vector is not TYPES["geometry_msgs/Vector3"]
    assert from_json(b'{"w":7}', Vector).w == 7


@pytest.mark.parametrize("ros2", [False, True])
def test_a_header_is_ours_whether_it_counts_or_not(ros2):
    assert learn(typedefs("std_msgs/Header", ros2=ros2)) is TYPES["std_msgs/Header"]


def test_a_type_that_is_only_named_must_be_one_of_ours():
    assert type(learn([told(pose=("geometry_msgs/Pose", -1))])().pose) is Pose
    with pytest.raises(ProtocolError, match=r"boat_msgs/Boat needs boat_msgs/Sail, which is not described\."):
        learn([told(sail=("boat_msgs/Sail", -1))])


@pytest.mark.parametrize(
    "name",
    ["boat_msgs/Go_Request", "boat_msgs/srv/Go_Request", "boat_msgs/GoRequest", "boat_msgs/srv/GoRequest"],
)
def test_the_names_of_ros_1_and_ros_2_mean_the_same(name):
    assert learn([told(name)]).MSGTYPE == "boat_msgs/GoRequest"


@pytest.mark.parametrize(
    ("kind", "length", "rostype"),
    [
        ("boolean", -1, "bool"),
        ("double", 36, "float64[36]"),
        ("double[36]", -1, "float64[36]"),
        ("octet", -1, "byte"),
        ("float", 0, "float32[]"),
        ("float, 8", 0, "float32[]"),
        ("sequence<double, 8>", -1, "float64[]"),
        ("sequence<string<20>>", -1, "string[]"),
        ("string<20>", -1, "string"),
        ("builtins/str", -1, "string"),
        ("builtin_interfaces/Time", -1, "time"),
        ("builtin_interfaces/msg/Duration", 0, "duration[]"),
        ("geometry_msgs/msg/Pose", -1, "geometry_msgs/Pose"),
    ],
)
def test_the_words_of_idl_are_understood(kind, length, rostype):
    (found,) = learn([told(x=(kind, length))]).ROSTYPES
    assert found == rostype


def test_constants_come_with_it_and_what_is_none_is_left_out():
    constants = [
        ("DEEP", "3"),
        ("NAME", "Minnow"),
        ("SLOPE", "0.5"),
        ("SLOT_TYPES", "(<object>,)"),
        ("depth", "0.0"),
        ("MSGTYPE", "nonsense"),
    ]
    Boat = learn([told(constants=constants, depth=("float32", -1))])
    assert (Boat.DEEP, Boat.NAME, Boat.SLOPE, Boat.MSGTYPE) == (3, "Minnow", 0.5, "boat_msgs/Boat")
    assert not hasattr(Boat, "SLOT_TYPES")


@pytest.mark.parametrize("name", ["class", "MSGTYPE", "ROSTYPES", "lambda"])
def test_a_field_that_python_cannot_name_is_reached_with_an_underscore(name):
    Boat = learn([told(**{name: ("int32", -1)})])
    boat = from_json(f'{{"{name}":5}}'.encode(), Boat)
    assert getattr(boat, f"{name}_") == 5
    assert to_json(boat) == f'{{"{name}":5}}'.encode()
    assert typedefs(Boat)[0]["fieldnames"] == [name]


def test_the_same_answer_gives_the_same_class_and_the_memory_is_bounded():
    assert learn([told(depth=("float32", -1))]) is learn([told(depth=("float32", -1))])
    assert _learned.cache_info().maxsize
    assert _class.cache_info().maxsize


WRONG = [
    ([], "The robot does not describe this type."),
    ([{}], "This is no description of a message type: "),
    (5, "This is no description of a message type: "),
    (object(), "This is no description of a message type: "),
    ([told("Boat")], "'Boat' is no type; one is called as in sensor_msgs/Imu."),
    ([told(x=("int33", -1))], "'int33' is no type"),
    ([told(x=("", -1))], "boat_msgs/Boat.x is described as '' with array length -1, which is no type."),
    ([told(x=("int32", -2))], "with array length -2"),
    ([told(x=("int32", 10**9))], "with array length 1000000000"),
    ([told(**{"a b": ("int32", -1)})], "a field called 'a b'"),
    ([told(__init__=("int32", -1))], "a field called '__init__'"),
    ([told(x=("int32", -1)) | {"fieldtypes": []}], "1 fields, 0 types and 1 lengths"),
    ([told(x=("int32", -1)) | {"fieldnames": "x"}], "This is no description of a message type: "),
    ([told(x=("boat_msgs/Boat", 0))], "which holds itself"),
    ([told(**{f"x{n}": ("int32", -1) for n in range(1001)})], "has 1001 fields; at most 1000"),
    ([told(f"a/B{n}") for n in range(501)], "is made of 501 types; at most 500"),
    (
        [told(x=("boat_msgs/A", 1000)), told("boat_msgs/A", y=("float64[1001]", -1))],
        "boat_msgs/Boat holds more than 1000000 values when it is empty.",
    ),
]


@pytest.mark.parametrize(("answer", "sentence"), WRONG)
def test_nonsense_is_named(answer, sentence):
    with pytest.raises(ProtocolError) as caught:
        learn(answer)
    assert sentence in str(caught.value)
    assert len(str(caught.value)) < 300


def test_types_that_branch_at_every_level_take_no_time():
    levels = [told(f"a/B{n}", x=(f"a/B{n + 1}", 0), y=(f"a/B{n + 1}", 0)) for n in range(49)]
    assert learn([*levels, told("a/B49")]).MSGTYPE == "a/B0"


JUNK = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=3),
    max_leaves=5,
)
KEYS = ["type", "fieldnames", "fieldtypes", "fieldarraylen", "constnames", "constvalues"]


@settings(max_examples=200, deadline=None)
@given(st.lists(st.dictionaries(st.sampled_from(KEYS), JUNK, max_size=6), max_size=3))
def test_nothing_but_a_protocol_error_leaves_it(answer):
    with contextlib.suppress(ProtocolError):
        learn(answer)


@settings(max_examples=100, deadline=None)
@given(st.data())
def test_one_wrong_word_in_a_right_answer_is_a_protocol_error_or_a_class(data):
    answer = copy.deepcopy(typedefs(data.draw(st.sampled_from(["sensor_msgs/Imu", "nav_msgs/Path"]))))
    entry = data.draw(st.sampled_from(answer))
    key = data.draw(st.sampled_from(KEYS))
    entry[key] = data.draw(JUNK | st.lists(st.text(max_size=12), max_size=4))
    with contextlib.suppress(ProtocolError):
        learn(answer)


def strange(answer):
    """The same types under names that nobody knows."""
    text = copy.deepcopy(answer)
    for entry in text:
        entry["type"] = f"far_{entry['type']}"
        entry["fieldtypes"] = [f"far_{kind}" if "/" in kind else kind for kind in entry["fieldtypes"]]
    return text


@looped("name", sorted(set(TYPES) - {"time", "duration"}))
@settings(max_examples=5, deadline=None)
@given(data=st.data())
def test_a_class_learned_from_what_is_told_decodes_all_that_the_original_encodes(name, data):
    msg = data.draw(messages(TYPES[name]))
    learned = learn(strange(typedefs(name)))
    assert learned is not TYPES[name]
    said = json.loads(to_json(msg))
    assert json.loads(to_json(from_json(to_json(msg), learned))) == said
    assert json.loads(to_json(from_builtins(from_cbor(to_cbor(msg)), learned))) == said
