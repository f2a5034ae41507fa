"""What a frame of text holds, and what is said of one that holds nothing."""

from __future__ import annotations

import contextlib
import json
import math
import sys

import cbor2
import msgspec
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from msgspec import Raw

from bridge import protocol
from bridge.core.errors import ProtocolError
from bridge.msgs.pilothouse_msgs import CommandRequest
from bridge.protocol import (
    Publish,
    Status,
    Unadvertise,
    Unsubscribe,
    arguments,
    complaint,
    dump,
    encode,
    parse,
    parse_binary,
    parse_each,
    too_deep,
)
from bridge.protocol.wire import MAX_ARGUMENT_BYTES, MAX_OPERATIONS, MAX_SHARED_BYTES

DEEP = 100_000


def refusal(text):
    with pytest.raises(ProtocolError) as caught:
        parse(text)
    return caught.value


def test_parsing_leaves_the_message_as_it_is():
    text = '{"op":"publish","topic":"/a","msg":{ "x" : 1.50 }}'
    assert bytes(parse(text).msg) == b'{ "x" : 1.50 }'
    assert msgspec.json.decode(parse(text.encode()).msg) == {"x": 1.5}


def test_a_bare_nan_as_python_writes_it_counts_as_null():
    text = json.dumps(
        {"op": "publish", "topic": "/cmd_vel", "msg": {"linear": {"x": math.nan, "y": -math.inf}}}
    )
    assert bytes(parse(text).msg) == b'{"linear": {"x": null, "y": null}}'


@pytest.mark.parametrize("told", ["NaN", 'a \\" NaN', "\\\\", "Infinity", "NaN\\\\\\"])
def test_a_text_that_says_nan_stays_a_text_beside_a_bare_one(told):
    text = json.dumps({"op": "publish", "topic": "/x", "msg": [math.nan, told, math.inf]})
    assert msgspec.json.decode(parse(text).msg) == [None, told, None]


@pytest.mark.parametrize(
    "text",
    [b'{"op":"publish","topic":"/a","msg":{"data":"\xff"}}', b'{"op":"publish","topic":"\xc3"}', b"\x80"],
)
def test_what_is_not_utf_8_is_refused_even_within_a_message_that_may_be_passed_on(text):
    assert str(refusal(text)).startswith("This is not UTF-8: ")


def test_of_a_field_that_comes_twice_the_last_counts():
    assert parse('{"op":"publish","topic":"/a","msg":1,"topic":"/b","msg":2}').topic == "/b"


SENTENCES = {
    "hello": "This is not JSON: 'hello'.",
    "": "This is not JSON: ''.",
    "[1]": "An operation must be an object, not '[1]'.",
    '{"op":"publish"}': 'publish needs the field topic: \'{"op":"publish"}\'.',
    '{"op":"publish","topic":5}': 'publish: topic must be str, not int: \'{"op":"publish","topic":5}\'.',
    '{"op":"publish","topic":"/a"': 'This is not JSON: \'{"op":"publish","topic":"/a"\'.',
    '{"op":"publish","topic":null}': 'publish needs the field topic: \'{"op":"publish","topic":null}\'.',
}


@pytest.mark.parametrize("text", SENTENCES)
def test_what_is_no_operation_is_named_with_its_beginning(text):
    assert str(refusal(text)) == SENTENCES[text]
    assert str(refusal(text.encode())) == SENTENCES[text]


def test_an_unknown_operation_is_told_which_ones_there_are():
    with pytest.raises(ProtocolError, match='op must be one of advertise, .*auth, not "dance"'):
        parse('{"op":"dance"}')


def test_at_most_eighty_characters_of_the_offender_are_repeated():
    assert str(refusal("x" * 10_000)) == f"This is not JSON: '{'x' * 80}'."


@pytest.mark.parametrize(
    ("text", "op", "id"),
    [
        ('{"op":"subscribe","id":"s:1","topic":5}', "subscribe", "s:1"),
        ('{"op":"call_service","id":7}', "call_service", 7),
        ('{"op":"dance","id":7}', None, 7),
        ('{"op":"call_service","id":[1]}', "call_service", None),
        ('{"op":"call_service","id":"' + "x" * 5000 + '"}', "call_service", None),
        ("{", None, None),
    ],
)
def test_an_error_knows_whose_it_is(text, op, id):
    error = refusal(text)
    assert (error.op, error.id) == (op, id)


def test_a_complaint_names_the_operation_and_its_id():
    told = complaint(ProtocolError("There is no such topic.", op="subscribe", id="s:1"))
    assert told == Status(level="error", msg='subscribe "s:1": There is no such topic.', id="s:1")
    assert complaint(ProtocolError("No.", op="publish")).msg == "publish: No."
    assert json.loads(dump(complaint(ProtocolError("No."), "warning"))) == {
        "op": "status",
        "level": "warning",
        "msg": "No.",
    }


NESTED = {
    "lists": "[" * DEEP,
    "objects": '{"a":' * DEEP,
    "operations": '{"op":' * DEEP,
    "closed": '{"op":"publish","topic":"/a","msg":' + "[" * DEEP + "]" * DEEP + "}",
    "after NaN": '{"op":"publish","topic":"/a","msg":[NaN,' + "[" * DEEP,
    "after another": '{"op":"unsubscribe","topic":"/a"}' + '{"op":"publish","msg":' + "[" * DEEP,
}


@pytest.mark.parametrize("kind", NESTED)
def test_what_is_nested_without_end_is_refused(kind):
    refusal(NESTED[kind])
    assert isinstance(parse_each(NESTED[kind])[-1], ProtocolError)


def test_depth_is_told_as_the_reason():
    assert str(refusal(NESTED["closed"])).startswith("This is nested too deeply: ")


@pytest.mark.parametrize(
    ("text", "deep"),
    [
        (b"[" * 101 + b"]" * 101, True),
        (b"[" * 100 + b"]" * 100, False),
        (b"[" + b"[]," * 500 + b"1]", False),
        (b'["' + b"[" * 500 + b'"]', False),
        (b'["\\"' + b"{" * 500 + b'"]', False),
        (b'{"a":' * 150 + b"1" + b"}" * 150, True),
        (b'["' + b"[" * 500, False),
    ],
)
def test_how_deep_a_text_is_can_be_asked_before_it_is_passed_on(text, deep):
    assert too_deep(text) is deep


def test_several_operations_may_share_a_frame():
    text = ' {"op":"unsubscribe","topic":"/a"}{"op":"unadvertise","topic":"}{","id":1} \n{"op":"unsubscribe","topic":"/c"}\n'
    expected = [Unsubscribe(topic="/a"), Unadvertise(topic="}{", id=1), Unsubscribe(topic="/c")]
    assert parse_each(text) == expected
    assert parse_each(text.encode()) == expected


def test_of_several_operations_the_good_ones_count():
    good, bad, last = parse_each(
        '{"op":"unsubscribe","topic":"/a"} {"op":"dance","id":3} {"op":"unsubscribe","top'
    )
    assert good == Unsubscribe(topic="/a")
    assert (bad.id, str(bad).startswith("op must be one of")) == (3, True)
    assert str(last) == 'This is not JSON: \'{"op":"unsubscribe","top\'.'


def test_one_frame_holds_a_thousand_operations_at_most():
    found = parse_each('{"op":"unsubscribe","topic":"/a"}' * (MAX_OPERATIONS + 5))
    assert len(found) == MAX_OPERATIONS + 1
    assert str(found[-1]) == "A frame may hold at most 1000 operations."
    assert len(parse_each('{"op":"unsubscribe","topic":"/a"}' * MAX_OPERATIONS)) == MAX_OPERATIONS


@pytest.mark.parametrize(
    "text",
    [
        '"\\' * 200_000,
        '{"a":"' + '\\"' * 300_000 + "NaN",
        "{}" * 300_000,
        "NaN " * 200_000,
        '{"a":[' * 200 + "0," * 300_000,
    ],
)
def test_a_long_text_that_is_nothing_is_read_in_one_go(text):
    """Each of these takes minutes where a scan begins anew at every character."""
    assert isinstance(parse_each(text)[-1], ProtocolError)


ANY = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=6),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3),
    max_leaves=6,
)
FIELDS = [
    "op",
    "topic",
    "msg",
    "type",
    "id",
    "service",
    "args",
    "values",
    "result",
    "throttle_rate",
    "level",
    "status",
    "action",
    "action_type",
    "feedback",
    "data",
    "num",
    "total",
    "fragment_size",
    "reduce",
    "compression",
    "timeout",
    "latch",
]
ALMOST = st.fixed_dictionaries(
    {"op": st.sampled_from([op.__struct_config__.tag for op in protocol.OPS]) | ANY},
    optional=dict.fromkeys(FIELDS[1:], ANY),
)


@settings(max_examples=300, deadline=None)
@given(text=st.text(max_size=80) | st.binary(max_size=80))
@example(text='{"op":"publish","topic":"/a","msg":' + '{"a":' * 5_000 + "1" + "}" * 5_002)
@example(text=b'{"op":"publish","topic":"\xff"}')
@example(text='{"op":"publish","topic":"\ud800"}')
@example(text='{"op":"publish","topic":"\\ud800"}')
@example(text='{"op":"subscribe","topic":"/a","throttle_rate":' + "9" * 400 + "}")
@example(text='{"op":"subscribe","topic":"/a","throttle_rate":1e999}')
@example(text='{"op":"subscribe","topic":"/a","throttle_rate":' + "9" * 10_000 + "}")
@example(text='{"op":"publish","topic":5,"msg":[NaN,"NaN"]}')
def test_nothing_but_a_protocol_error_leaves_the_parser(text):
    with contextlib.suppress(ProtocolError):
        assert isinstance(parse(text), protocol.Op)
    assert all(isinstance(each, (protocol.Op, ProtocolError)) for each in parse_each(text))


@settings(max_examples=300, deadline=None)
@given(obj=ALMOST)
def test_nothing_but_a_protocol_error_leaves_the_parser_for_what_is_almost_an_operation(obj):
    with contextlib.suppress(ProtocolError):
        assert isinstance(parse(json.dumps(obj)), protocol.Op)


@settings(max_examples=300, deadline=None)
@given(raw=st.binary(max_size=40) | ANY.map(cbor2.dumps))
@example(raw=b"\x81" * 399 + b"\x01")
@example(raw=b"\xd8\x1c\x81\xd8\x1d\x00")
def test_nothing_but_a_protocol_error_leaves_the_binary_parser(raw):
    with contextlib.suppress(ProtocolError):
        parse_binary(raw)


def test_a_binary_frame_holds_a_publish_operation():
    assert parse_binary(cbor2.dumps({"op": "publish", "topic": "/odom", "msg": {"a": 1}})).msg == {"a": 1}
    with pytest.raises(ProtocolError, match="must hold a publish operation"):
        parse_binary(cbor2.dumps({"op": "subscribe", "topic": "/odom"}))


@pytest.mark.parametrize("topic", ["\ud800", "/a\udfff"])
def test_what_json_cannot_say_is_not_sent(topic):
    with pytest.raises(ProtocolError, match="publish cannot be sent"):
        encode(Publish(topic=topic))


@pytest.mark.parametrize("args", [b'{"command_id":"7"}', b'["7"]', b' {"command_id":"7"}'])
def test_a_request_is_an_object_or_a_list_of_its_fields(args):
    assert arguments(Raw(args), CommandRequest).command_id == "7"


@pytest.mark.parametrize("args", [b"{}", b"[]", b"null"])
def test_an_empty_request_has_its_defaults(args):
    assert repr(arguments(Raw(args), CommandRequest)) == repr(CommandRequest())


@pytest.mark.parametrize("args", [b"5", b'"a"', b"true"])
def test_a_request_that_is_neither_is_refused(args):
    with pytest.raises(ProtocolError, match=f"args must be an object or a list, not {args.decode()}"):
        arguments(Raw(args), CommandRequest)


def test_a_request_too_deep_to_read_is_refused():
    with pytest.raises(ProtocolError, match="cannot be read"):
        arguments(Raw(b"[" * 5000 + b"]" * 5000), CommandRequest)


def steps(work, *about):
    """How many lines of Python are executed: what is to stay small however long a text is."""
    count = 0

    def trace(frame, event, arg):
        nonlocal count
        count += event == "line"
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        work(*about)
    finally:
        sys.settrace(before)
    return count


MANY = 20_000
COSTLY = {
    "lists of an unknown message": b'{"op":"publish","topic":"/a","msg":{"a":[%s]}}',
    "lists in the place of the op": b'{"op":[%s]}',
    "lists in the place of a topic": b'{"op":"publish","topic":[%s]}',
    "lists in a reduction": b'{"op":"subscribe","topic":"/a","reduce":{"beams":1.5,"x":[%s]},"queue_length":null}',
    "lists where a whole number belongs": b'{"op":"action_result","action":"a","status":[%s]}',
    "texts after a bare NaN": b'{"op":"publish","topic":"/a","msg":[NaN,[%s]]}',
}


@pytest.mark.parametrize("what", COSTLY)
@pytest.mark.parametrize("each", [b"[]", b'""', b'{"a":1}'])
def test_a_long_text_is_read_by_no_loop_of_python(what, each):
    text = COSTLY[what] % b",".join([each] * MANY)
    assert steps(parse_each, text) < 500
    assert steps(too_deep, text) < 5000


def test_bare_nans_are_not_looked_for_in_too_many_places():
    text = b'{"op":"publish","topic":"/a","msg":[%s]}'
    few = text % b",".join([b'NaN,"x"'] * 1000)
    assert isinstance(parse_each(few)[0], Publish)
    assert isinstance(parse_each(text % b",".join([b'NaN,"x"'] * 100_001))[0], ProtocolError)


def test_a_large_frame_is_not_looked_through_for_several_operations():
    one = b'{"op":"unsubscribe","topic":"/a"}'
    assert len(parse_each(one * 2 + b" " * (MAX_SHARED_BYTES - 2 * len(one)))) == 2
    assert len(parse_each(one * 2 + b" " * (MAX_SHARED_BYTES - 2 * len(one) + 1))) == 1


def test_arguments_are_bounded_and_a_list_may_be_longer_than_the_fields():
    fields = msgspec.structs.astuple(CommandRequest(command_id="7"))
    assert arguments(Raw(msgspec.json.encode([*fields, [], {}])), CommandRequest).command_id == "7"
    text = b'["%s"]' % (b"x" * MAX_ARGUMENT_BYTES)
    with pytest.raises(ProtocolError, match=f"may have at most {MAX_ARGUMENT_BYTES} bytes, not {len(text)}"):
        arguments(Raw(text), CommandRequest)
    with pytest.raises(ProtocolError, match="may have at most"):
        arguments(Raw(b'{"a":%s}' % text), CommandRequest)
