"""One message in the forms in which clients want it."""

from __future__ import annotations

import json

import cbor2
import pytest
from msgspec import Raw
from websockets.frames import Opcode

from bridge.codec import Unread, to_cbor, to_json
from bridge.core.errors import ProtocolError
from bridge.msgs.arrays import Float32Array
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import LaserScan
from bridge.msgs.std_msgs import Float64, Header, String, Time
from bridge.protocol import Png, Reduction, Status, pixels
from bridge.rosbytes import serialize
from bridge.server.flow import outgoing_messages as module
from bridge.server.flow.outgoing_messages import MAX_FORMS, Form, OutgoingMessage, op_frames, ping_frame
from tests.bridge.ws_frames import frames


def received(data):
    """The messages in WebSocket frames, as a client's library reads them."""
    return [
        json.loads(bytes(frame.data)) if frame.opcode is Opcode.TEXT else cbor2.loads(bytes(frame.data))
        for frame in frames(data)
    ]


def test_a_message_is_encoded_once_per_form_and_only_when_wanted(monkeypatch):
    encoded = []
    monkeypatch.setattr(module, "to_json", lambda *args: encoded.append(args) or to_json(*args))
    message = OutgoingMessage("/odom", Float64(1))
    assert encoded == []
    frames = {id(message.frame(Form("/odom"))) for _ in range(10)}
    assert (len(encoded), len(frames)) == (1, 1)


@pytest.mark.parametrize("length", [1, 100, 70_000])
def test_a_message_is_a_text_frame_of_any_length(length):
    frame = OutgoingMessage("/names", String("ä" * length)).frame(Form("names"))
    assert received(frame) == [{"op": "publish", "topic": "names", "msg": {"data": "ä" * length}}]


def test_in_cbor_it_is_a_binary_frame():
    frame = OutgoingMessage("/odom", Float64(1.5)).frame(Form("odom", "cbor"))
    assert received(frame) == [{"op": "publish", "topic": "odom", "msg": {"data": 1.5}}]


def test_in_cbor_raw_it_holds_the_bytes_of_ros_and_the_time():
    msg = Float64(1.5)
    (heard,) = received(OutgoingMessage("/n", msg, now=lambda: 12.5).frame(Form("/n", "cbor-raw")))
    assert heard["msg"] == {"secs": 12, "nsecs": 500_000_000, "bytes": serialize(msg)}


def test_as_a_picture_it_holds_the_same_text():
    (heard,) = received(OutgoingMessage("/n", Float64(1.5)).frame(Form("/n", "png")))
    assert json.loads(pixels(Png(data=heard["data"]), 1000)[0])["msg"] == {"data": 1.5}


@pytest.mark.parametrize("compression", ["none", "png"])
def test_it_comes_in_fragments_that_make_the_whole(compression):
    pieces = received(OutgoingMessage("/n", String("x" * 500)).frame(Form("/n", compression, 100)))
    assert len(pieces) > 1
    assert {piece["op"] for piece in pieces} == {"fragment"}
    assert len({piece["id"] for piece in pieces}) == 1
    assert all(len(piece["data"]) <= 100 for piece in pieces)
    whole = json.loads("".join(piece["data"] for piece in pieces))
    assert whole["op"] == ("publish" if compression == "none" else "png")


def test_ros_2_names_its_times_otherwise():
    stamped = OutgoingMessage("/odom", Odometry(header=Header(stamp=Time(5, 7))))
    (heard,) = received(stamped.frame(Form("/odom", ros2=True)))
    assert heard["msg"]["header"]["stamp"] == {"sec": 5, "nanosec": 7}


def test_only_the_fields_that_were_asked_for_travel():
    (heard,) = received(
        OutgoingMessage("/odom", Odometry()).frame(
            Form("/odom", reduction=Reduction(fields=("child_frame_id",)))
        )
    )
    assert heard["msg"] == {"child_frame_id": ""}


def test_less_is_made_once_for_all_who_want_it():
    made = []

    def reduce(msg, wanted):
        made.append(wanted)
        return LaserScan(ranges=msg.ranges[: wanted.beams])

    message = OutgoingMessage("/scan", LaserScan(ranges=Float32Array([1, 2, 3])), reduce)
    for name in ("/scan", "scan"):
        (heard,) = received(message.frame(Form(name, reduction=Reduction(beams=2))))
        assert heard["msg"]["ranges"] == [1, 2]
    assert made == [Reduction(beams=2)]


def test_a_message_of_an_unknown_type_is_passed_on_as_it_is():
    message = OutgoingMessage("/own", Raw(b'{"a":[1,2]}'))
    assert received(message.frame(Form("/own")))[0]["msg"] == {"a": [1, 2]}
    assert received(message.frame(Form("/own", "cbor")))[0]["msg"] == {"a": [1, 2]}
    with pytest.raises(ProtocolError, match="type of /own is not known here"):
        message.frame(Form("/own", "cbor-raw"))


def test_operations_are_cut_as_messages_are():
    assert received(op_frames(Status(msg="x")))[0]["msg"] == "x"
    assert len(received(op_frames(Status(msg="x" * 100), 30))) > 3


def test_no_client_makes_the_robot_cut_a_message_into_its_letters():
    message = OutgoingMessage("/a", String("x" * 3000))
    assert len(received(message.frame(Form("/a", fragment_size=1)))) < 3500 / module.MIN_SLICE


def test_a_ping_is_one_for_the_library():
    (frame,) = frames(ping_frame(b"12345678"))
    assert (frame.opcode, bytes(frame.data)) == (Opcode.PING, b"12345678")


def test_a_message_is_kept_in_so_many_forms_and_no_more():
    message = OutgoingMessage("/a", Float64(1.5))
    for size in range(100, 100 + 2 * MAX_FORMS):
        message.frame(Form("/a", fragment_size=size))
    assert len(message._frames) == MAX_FORMS
    last = Form("/a", fragment_size=99 + 2 * MAX_FORMS)
    assert message.frame(last) is message.frame(last)


def test_of_a_large_message_few_forms_are_kept_and_few_ways_to_make_less_of_it(monkeypatch):
    encoded = []
    monkeypatch.setattr(module, "to_cbor", lambda *args: encoded.append(1) or to_cbor(*args))
    large = OutgoingMessage("/n", String("x" * module.LARGE_BYTES))
    names = [f"/n{number}" for number in range(3)]
    for name in names * 2:
        large.frame(Form(name, "cbor"))
    assert len(large._frames) == module.MAX_LARGE_FORMS
    for beams in range(2 * MAX_FORMS):
        large.frame(Form("/n", reduction=Reduction(beams=beams + 1)))
    assert len(large._reduced) == MAX_FORMS
    assert len(large._bodies) == module.MAX_LARGE_FORMS


def test_a_message_knows_what_it_takes_and_which_is_older():
    first, second = (
        OutgoingMessage("/n", Raw(b"{}" + b" " * 98)),
        OutgoingMessage("/n", Unread(b"x" * 200, String)),
    )
    assert (first.size, second.size, first.number < second.number) == (100, 200, True)
    assert 1000 < OutgoingMessage("/n", String("x" * 1000)).size < 1100
