"""rosbridge v2 as text in and operations out."""

from __future__ import annotations

import contextlib
import json
import math

import cbor2
import msgspec
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from msgspec import UNSET, Raw

from bridge import protocol
from bridge.errors import ProtocolError
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import CommandRequest
from bridge.protocol import (
    Advertise,
    CallService,
    ClientSession,
    Publish,
    ServerSession,
    ServiceResponse,
    SetLevel,
    Status,
    Subscribe,
    Unadvertise,
    Unsubscribe,
    absolute,
    arguments,
    dump,
    parse,
    parse_binary,
)

OPS = [
    Advertise(topic="/cmd_vel", type="geometry_msgs/Twist", id="a"),
    Unadvertise(topic="/cmd_vel", id=7),
    Publish(topic="/cmd_vel", msg=Raw(b'{"linear":{"x":1}}'), stamp=12.5),
    Subscribe(topic="/odom", throttle_rate=100, queue_length=1, compression="cbor", id="s"),
    Unsubscribe(topic="/odom"),
    CallService(service="/stop", args=Raw(b"{}"), id=1.5),
    ServiceResponse(service="/stop", values=Raw(b'"no"'), result=False, id="c"),
    Status(level="warning", msg="hm"),
    SetLevel(level="info"),
]


@pytest.mark.parametrize("op", OPS, ids=lambda op: type(op).__name__)
def test_an_operation_comes_back_from_its_text(op):
    assert dump(parse(dump(op))) == dump(op)


def test_an_answer_always_says_whether_it_worked_and_echoes_an_id_only_if_there_was_one():
    assert json.loads(dump(ServiceResponse(service="/stop"))) == {
        "op": "service_response",
        "service": "/stop",
        "values": {},
        "result": True,
    }
    assert json.loads(dump(ServiceResponse(service="/stop", id=7)))["id"] == 7


def test_the_stamp_travels_beside_the_message():
    assert json.loads(dump(OPS[2])) == {
        "op": "publish",
        "topic": "/cmd_vel",
        "msg": {"linear": {"x": 1}},
        "stamp": 12.5,
    }
    assert parse('{"op":"publish","topic":"/x"}').stamp is None


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


def test_a_bare_nan_as_python_writes_it_counts_as_null():
    text = json.dumps(
        {"op": "publish", "topic": "/cmd_vel", "msg": {"linear": {"x": math.nan, "y": -math.inf}}}
    )
    assert bytes(parse(text).msg) == b'{"linear": {"x": null, "y": null}}'


def test_a_text_that_says_nan_stays_a_text_beside_a_bare_one():
    op = parse('{"op":"publish","topic":"/x","msg":[NaN,"NaN"]}')
    assert bytes(op.msg) == b'[null,"NaN"]'


SENTENCES = {
    "hello": "This is not JSON: 'hello'.",
    "[1]": "An operation must be an object, not '[1]'.",
    '{"op":"publish"}': 'publish needs the field topic: \'{"op":"publish"}\'.',
    '{"op":"publish","topic":5}': 'publish: topic must be str, not int: \'{"op":"publish","topic":5}\'.',
}


@pytest.mark.parametrize("text", SENTENCES)
def test_what_is_no_operation_is_named_with_its_beginning(text):
    with pytest.raises(ProtocolError) as caught:
        parse(text)
    assert str(caught.value) == SENTENCES[text]


def test_an_unknown_operation_is_told_which_ones_there_are():
    with pytest.raises(ProtocolError, match='op must be one of advertise, .*auth, not "dance"'):
        parse('{"op":"dance"}')


def test_at_most_eighty_characters_of_the_offender_are_repeated():
    with pytest.raises(ProtocolError) as caught:
        parse("x" * 10_000)
    assert str(caught.value) == f"This is not JSON: '{'x' * 80}'."


ANY = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=6),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3),
    max_leaves=6,
)
FIELDS = ("op", "topic", "msg", "type", "id", "service", "args", "values", "result", "throttle_rate", "level")
ALMOST = st.fixed_dictionaries(
    {"op": st.sampled_from([op.__struct_config__.tag for op in protocol.OPS]) | ANY},
    optional=dict.fromkeys(FIELDS[1:], ANY),
)


@settings(max_examples=400, deadline=None)
@given(text=st.text(max_size=80) | st.binary(max_size=80))
@example(text="[" * 100_000)
@example(text='{"op":"publish","topic":"/a","msg":' + '{"a":' * 5_000 + "1" + "}" * 5_002)
@example(text=b'{"op":"publish","topic":"\xff"}')
@example(text='{"op":"publish","topic":"\ud800"}')
@example(text='{"op":"subscribe","topic":"/a","throttle_rate":' + "9" * 400 + "}")
@example(text='{"op":"publish","topic":5,"msg":[NaN,"NaN"]}')
def test_nothing_but_a_protocol_error_leaves_the_parser(text):
    with contextlib.suppress(ProtocolError):
        assert isinstance(parse(text), protocol.Op)


@settings(max_examples=400, deadline=None)
@given(obj=ALMOST)
def test_nothing_but_a_protocol_error_leaves_the_parser_for_what_is_almost_an_operation(obj):
    with contextlib.suppress(ProtocolError):
        assert isinstance(parse(json.dumps(obj)), protocol.Op)


@settings(max_examples=300, deadline=None)
@given(raw=st.binary(max_size=40) | ANY.map(cbor2.dumps))
def test_nothing_but_a_protocol_error_leaves_the_binary_parser(raw):
    with contextlib.suppress(ProtocolError):
        parse_binary(raw)


def test_a_binary_frame_holds_a_publish_operation():
    assert parse_binary(cbor2.dumps({"op": "publish", "topic": "/odom", "msg": {"a": 1}})).msg == {"a": 1}
    with pytest.raises(ProtocolError, match="must hold a publish operation"):
        parse_binary(cbor2.dumps({"op": "subscribe", "topic": "/odom"}))


@pytest.mark.parametrize("args", [b'{"command_id":"7"}', b'["7"]', b' {"command_id":"7"}'])
def test_a_request_is_an_object_or_a_list_of_its_fields(args):
    assert arguments(Raw(args), CommandRequest).command_id == "7"


@pytest.mark.parametrize("args", [b"{}", b"[]", b"null"])
def test_an_empty_request_has_its_defaults(args):
    assert repr(arguments(Raw(args), CommandRequest)) == repr(CommandRequest())


def test_a_request_that_is_neither_is_refused():
    with pytest.raises(ProtocolError, match="args must be an object or a list, not 5"):
        arguments(Raw(b"5"), CommandRequest)


def test_a_relative_name_is_resolved():
    assert (absolute("rosapi/topics"), absolute("/odom")) == ("/rosapi/topics", "/odom")


def test_two_subscriptions_of_one_client_are_one_delivery_at_the_faster_rate():
    session = ServerSession()
    session.subscribe(Subscribe(topic="/odom", id="a", throttle_rate=200))
    session.subscribe(Subscribe(topic="odom", id="b", throttle_rate=50, compression="cbor"))
    wanted = session.subscriptions["/odom"]
    assert (wanted.name, wanted.period, wanted.compression) == ("/odom", 0.05, "cbor")
    session.unsubscribe(Unsubscribe(topic="/odom", id="b"))
    wanted = session.subscriptions["/odom"]
    assert (wanted.period, wanted.compression) == (0.2, "none")


@pytest.mark.parametrize("id", [UNSET, None])
def test_unsubscribing_without_an_id_ends_all_subscriptions_of_the_topic(id):
    session = ServerSession()
    session.subscribe(Subscribe(topic="/odom", id="a"))
    session.subscribe(Subscribe(topic="/odom", id="b"))
    session.unsubscribe(Unsubscribe(topic="/odom", id=id))
    assert session.subscriptions == {}


def test_unsubscribing_from_what_was_never_asked_for_is_no_error():
    session = ServerSession()
    session.subscribe(Subscribe(topic="/odom", id="a"))
    session.unsubscribe(Unsubscribe(topic="/odom", id="z"))
    session.unsubscribe(Unsubscribe(topic="/scan"))
    assert list(session.subscriptions) == ["/odom"]


def test_advertisements_are_counted_by_id():
    session = ServerSession()
    session.advertise(Advertise(topic="/cmd_vel", id="a"))
    session.advertise(Advertise(topic="/cmd_vel", id="b"))
    session.unadvertise(Unadvertise(topic="/cmd_vel", id="a"))
    assert {topic: set(ids) for topic, ids in session.advertised.items()} == {"/cmd_vel": {"b"}}
    session.unadvertise(Unadvertise(topic="/cmd_vel"))
    assert session.advertised == {}


def test_remarks_are_sent_only_to_who_asked_for_them():
    session = ServerSession()
    assert not session.wants("error")
    session.set_level(SetLevel(level="warning"))
    assert [session.wants(level) for level in ("info", "warning", "error")] == [False, True, True]
    with pytest.raises(ProtocolError, match="level must be one of info, warning, error, none"):
        session.set_level(SetLevel(level="loud"))


def test_a_client_says_again_everything_it_said_when_it_connects_again():
    session = ClientSession()
    session.advertise("/cmd_vel", Twist)
    kept, _ = session.subscribe(Subscribe(topic="/odom"), Twist, print)
    _, ended = session.subscribe(Subscribe(topic="/scan"), Twist, print)
    assert session.unsubscribe(ended)
    assert not session.unsubscribe(ended)
    assert [(type(op).__name__, op.topic) for op in session.opening()] == [
        ("Advertise", "/cmd_vel"),
        ("Subscribe", "/odom"),
    ]
    assert list(session.opening())[1].id == kept.id


def test_an_answer_reaches_the_call_that_it_belongs_to_once():
    session = ClientSession()
    answers = []
    first = session.call("/stop", b"{}", lambda op: answers.append(("first", op.result)))
    session.call("/stop", b"{}", lambda op: answers.append(("second", op)))
    answer = ServiceResponse(id=first.id, values=Raw(b"{}"), result=True)
    assert session.answered(answer)
    assert not session.answered(answer)
    session.lose()
    assert answers == [("first", True), ("second", None)]


def test_calls_have_ids_of_their_own():
    session = ClientSession()
    assert len({session.call("/stop", b"{}", print).id for _ in range(50)}) == 50


def test_parsing_leaves_the_message_as_it_is():
    text = '{"op":"publish","topic":"/a","msg":{ "x" : 1.50 }}'
    assert bytes(parse(text).msg) == b'{ "x" : 1.50 }'
    assert msgspec.json.decode(parse(text.encode()).msg) == {"x": 1.5}
