"""What waits for one client."""

from __future__ import annotations

import json

import cbor2
import pytest

from bridge import outbox as module
from bridge.codec import to_json
from bridge.errors import ProtocolError
from bridge.msgs.std_msgs import Float64, String
from bridge.outbox import Frame, Outbox, Outgoing
from bridge.protocol import ServerSession, Subscribe, Subscribed, Unsubscribe

ODOM, SCAN = "/odom", "/scan"


def made(**wishes):
    session = ServerSession()
    for topic in (ODOM, SCAN):
        session.subscribe(Subscribe(topic=topic, id=topic, **wishes))
    return session, Outbox(session)


def number(topic, value):
    return Outgoing(topic, Float64(value))


def taken(outbox, now=0.0):
    frame = outbox.take(now)
    return None if frame is None else json.loads(frame.data)["msg"]["data"]


def test_of_a_stream_only_the_newest_message_waits():
    _, outbox = made()
    for value in range(5):
        outbox.put_latest(number(ODOM, value))
    assert (taken(outbox), taken(outbox)) == (4.0, None)


def test_streams_take_turns():
    _, outbox = made()
    outbox.put_latest(number(ODOM, 1))
    outbox.put_latest(number(SCAN, 2))
    outbox.put_latest(number(ODOM, 3))
    assert (taken(outbox), taken(outbox)) == (3.0, 2.0)


def test_what_must_not_be_lost_goes_first_and_in_order():
    _, outbox = made()
    outbox.put_latest(number(ODOM, 1))
    for text in (b"a", b"b"):
        assert outbox.put(Frame(text, text=True))
    assert [outbox.take(0.0).data for _ in range(2)] == [b"a", b"b"]
    assert taken(outbox) == 1.0


def test_there_is_an_end_to_what_can_wait_in_order():
    outbox = Outbox(ServerSession(), limit=2)
    assert [outbox.put(Frame(b"", text=True)) for _ in range(3)] == [True, True, False]


def test_a_throttled_stream_waits_for_its_turn_and_then_sends_the_newest():
    _, outbox = made(throttle_rate=100)
    outbox.put_latest(number(ODOM, 1))
    assert taken(outbox, now=5.0) == 1.0
    outbox.put_latest(number(ODOM, 2))
    assert taken(outbox, now=5.04) is None
    assert outbox.delay(5.04) == pytest.approx(0.06)
    outbox.put_latest(number(ODOM, 3))
    assert taken(outbox, now=5.1) == 3.0
    assert outbox.delay(5.1) is None


def test_what_waits_for_a_topic_is_forgotten_with_its_subscription():
    session, outbox = made()
    outbox.put_latest(number(ODOM, 1))
    session.unsubscribe(Unsubscribe(topic=ODOM))
    assert outbox.delay(0.0) is None
    assert taken(outbox) is None


def test_a_message_is_encoded_once_per_codec_and_only_when_wanted(monkeypatch):
    encoded = []
    monkeypatch.setattr(module, "to_json", lambda msg: encoded.append(msg) or to_json(msg))
    message = number(ODOM, 1)
    assert encoded == []
    frames = {id(message.frame(Subscribed(ODOM))) for _ in range(10)}
    assert (len(encoded), len(frames)) == (1, 1)


def test_a_message_in_cbor_is_a_binary_frame_with_the_topic_as_the_client_wrote_it():
    frame = number(ODOM, 1.5).frame(Subscribed("odom", compression="cbor"))
    assert not frame.text
    assert cbor2.loads(frame.data) == {"op": "publish", "topic": "odom", "msg": {"data": 1.5}}


def test_what_cannot_be_encoded_is_dropped_and_does_not_block_the_rest():
    _, outbox = made()
    outbox.put_latest(Outgoing(ODOM, String("\ud800")))
    outbox.put_latest(number(SCAN, 2))
    with pytest.raises(ProtocolError):
        outbox.take(0.0)
    assert taken(outbox) == 2.0
