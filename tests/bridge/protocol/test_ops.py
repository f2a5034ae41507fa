"""Every operation as its record and as its text."""

from __future__ import annotations

import json
import math

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec import UNSET, Raw

from bridge.protocol import (
    OPS,
    ActionResult,
    CallService,
    Fragment,
    Publish,
    SendActionGoal,
    ServiceResponse,
    SetLevel,
    Status,
    Subscribe,
    Unsubscribe,
    dump,
    encode,
    goal_status,
    parse,
)
from tests.bridge.protocol.spoken import EVERY_OP, FROM_CLIENTS, FROM_SERVERS

SINGLE = {said: text for said, text in (FROM_CLIENTS | FROM_SERVERS).items() if said != "two at once"}


def plain(op):
    """An operation with its raw JSON as bytes, which can be compared."""
    values = {name: getattr(op, name) for name in op.__struct_fields__}
    return type(op), {name: bytes(each) if isinstance(each, Raw) else each for name, each in values.items()}


@pytest.mark.parametrize("op", EVERY_OP, ids=lambda op: type(op).__name__)
def test_an_operation_comes_back_from_its_text(op):
    assert plain(parse(dump(op))) == plain(op)
    assert plain(parse(encode(op))) == plain(op)


def test_no_operation_is_left_out_of_these_tests():
    assert {type(op) for op in EVERY_OP} == set(OPS)


NAME = st.text(st.characters(exclude_categories=["Cs"]), max_size=8)
ID = NAME | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.none() | st.just(UNSET)
WHOLE = st.integers(0, 2**53)
JSON = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**63), 2**63) | NAME,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(NAME, inner, max_size=3),
    max_leaves=5,
).map(lambda value: Raw(msgspec.json.encode(value)))
FIELDS = {
    str: NAME,
    Raw: JSON,
    bool: st.booleans(),
    int: st.integers(0, 6),
}


def made(cls):
    def value(hint):
        return next((strategy for kind, strategy in FIELDS.items() if hint is kind), None)

    hints = {field.name: value(field.type) for field in msgspec.structs.fields(cls)}
    known = {name: strategy for name, strategy in hints.items() if strategy is not None}
    numbers = {name: WHOLE for name in ("num", "total") if name in cls.__struct_fields__}
    return st.builds(cls, id=ID, **(known | numbers))


@settings(max_examples=300, deadline=None)
@given(op=st.one_of([made(cls) for cls in OPS]))
def test_any_operation_comes_back_from_its_text(op):
    assert plain(parse(encode(op))) == plain(op)


@pytest.mark.parametrize("said", SINGLE)
def test_what_clients_and_servers_in_use_write_is_understood(said):
    op = parse(SINGLE[said])
    assert op.__struct_config__.tag == json.loads(SINGLE[said])["op"]
    again = parse(encode(op))
    assert plain(again) == plain(op)


def test_an_answer_always_says_whether_it_worked_and_echoes_an_id_only_if_there_was_one():
    assert json.loads(dump(ServiceResponse(service="/stop"))) == {
        "op": "service_response",
        "service": "/stop",
        "values": {},
        "result": True,
    }
    assert json.loads(dump(ServiceResponse(service="/stop", id=7)))["id"] == 7


@pytest.mark.parametrize("id", ['"a"', "7", "1.5", "null", "123456789012345678901234567890"])
def test_an_id_keeps_its_kind(id):
    op = parse(f'{{"op":"call_service","service":"/stop","id":{id}}}')
    assert f'"id":{id}' in dump(ServiceResponse(service="/stop", id=op.id))


def test_the_stamp_travels_beside_the_message():
    assert json.loads(dump(EVERY_OP[2])) == {
        "op": "publish",
        "topic": "/cmd_vel",
        "msg": {"linear": {"x": 1}},
        "stamp": 12.5,
    }
    assert parse('{"op":"publish","topic":"/x"}').stamp is None


def test_what_was_not_said_is_not_written():
    assert json.loads(dump(Subscribe(topic="/odom"))) == {"op": "subscribe", "topic": "/odom"}
    assert json.loads(dump(SendActionGoal(action="/dock", id="g"))) == {
        "op": "send_action_goal",
        "action": "/dock",
        "id": "g",
    }


def test_a_fragment_size_of_null_is_something_said():
    assert parse('{"op":"publish","topic":"/a"}').fragment_size is UNSET
    assert parse('{"op":"publish","topic":"/a","fragment_size":null}').fragment_size is None
    assert parse('{"op":"unsubscribe","topic":"/a","fragment_size":100}').fragment_size == 100


def test_what_other_libraries_add_is_passed_over():
    op = parse(
        '{"op":"subscribe","id":"subscribe:/odom:1","type":"nav_msgs/Odometry","topic":"/odom",'
        '"compression":null,"throttle_rate":null,"queue_length":0,"fragment_size":null,"latch":false}'
    )
    assert op == Subscribe(
        topic="/odom",
        type="nav_msgs/Odometry",
        id="subscribe:/odom:1",
        compression=None,
        throttle_rate=None,
        fragment_size=None,
    )


@pytest.mark.parametrize(
    ("text", "field", "value"),
    [
        ('{"op":"service_response","service":null,"result":null,"id":4}', "result", True),
        ('{"op":"action_result","action":"/a","status":null}', "status", 0),
        ('{"op":"action_result","action":"/a","status":4.0}', "status", 4),
        ('{"op":"advertise_service","service":"/a","type":null}', "type", ""),
        ('{"op":"set_level","level":null}', "level", "error"),
        ('{"op":"send_action_goal","action":"/a","action_type":null,"id":null}', "id", None),
    ],
)
def test_null_where_it_means_nothing_and_floats_for_whole_numbers_are_understood(text, field, value):
    assert getattr(parse(text), field) == value


def test_a_reduction_may_count_in_floats():
    op = parse(
        '{"op":"subscribe","topic":"/scan","reduce":{"beams":90.0,"quality":null,"resolution":1.0,"fields":["a"]}}'
    )
    assert (op.reduce.beams, op.reduce.quality, op.reduce.resolution) == (90, None, 1.0)
    assert op.reduce.fields == ("a",)


def test_the_values_of_a_failure_are_a_text():
    op = parse(SINGLE["the ROS 1 server fails"])
    assert (op.result, msgspec.json.decode(op.values)) == (False, "Service /nope does not exist")


@pytest.mark.parametrize(
    ("status", "values", "told"),
    [
        (4, b"{}", 4),
        (0, b'{"status":5}', 5),
        (6, b'{"status":5}', 6),
        (0, b'{"status":4.0}', 4),
        (0, b'{"status":"done"}', 0),
        (0, b'{"status":true}', 0),
        (0, b'{"status":7}', 0),
        (-1, b"{}", 0),
        (99, b"{}", 0),
        (0, b'"no such action"', 0),
        (0, b"[4]", 0),
    ],
)
def test_what_became_of_a_goal_stands_beside_its_values_or_among_them(status, values, told):
    assert goal_status(ActionResult(action="/dock", status=status, values=Raw(values))) == told


def test_numbers_that_json_cannot_say_become_null():
    assert json.loads(dump(Publish(topic="/a", stamp=math.nan)))["stamp"] is None


def test_records_of_operations_need_no_more_than_their_subject():
    assert Unsubscribe(topic="/a").id is UNSET
    assert CallService(service="/a").timeout is None
    assert (Status().level, SetLevel().level) == ("error", "error")
    assert Fragment(data="", num=0, total=1).total == 1
