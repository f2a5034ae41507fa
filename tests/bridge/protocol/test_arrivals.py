"""From frames to operations, whatever they are wrapped in."""

from __future__ import annotations

import base64
import io
import json

import cbor2
import pytest
from PIL import Image

from bridge.core.errors import ProtocolError
from bridge.protocol import (
    Arrivals,
    BinaryPublish,
    Png,
    Publish,
    Unadvertise,
    Unsubscribe,
    dump,
    encode,
    split,
    to_png,
)

LIMIT = 100_000
A, B = Unsubscribe(topic="/a"), Unadvertise(topic="/b", id=2)
BOTH = encode(A) + b" " + encode(B)


def frames(op, size=10, id="f"):
    return split(op if isinstance(op, bytes) else encode(op), size, id)


def taken(arrivals, *frames, now=0.0):
    return [each for frame in frames for each in arrivals.receive(frame, now)]


def only(arrivals, frame, now=0.0):
    (found,) = arrivals.receive(frame, now)
    return found


@pytest.mark.parametrize("frame", [dump(A), encode(A), f" \n{dump(A)}"])
def test_text_is_text_in_either_kind_of_frame(frame):
    assert Arrivals(LIMIT).receive(frame, 0.0) == [A]


def test_cbor_is_told_by_its_first_byte():
    frame = cbor2.dumps({"op": "publish", "topic": "/a", "msg": {"data": 1}})
    assert Arrivals(LIMIT).receive(frame, 0.0) == [BinaryPublish("/a", {"data": 1})]
    assert isinstance(only(Arrivals(LIMIT), b"\xa1\xff"), ProtocolError)


def test_several_operations_come_in_their_order():
    assert Arrivals(LIMIT).receive(BOTH, 0.0) == [A, B]


def test_fragments_give_what_they_held_once_whole():
    *first, last = frames(BOTH)
    arrivals = Arrivals(LIMIT)
    assert taken(arrivals, *first) == []
    assert taken(arrivals, last) == [A, B]
    assert arrivals.expire(100.0) == []


def test_a_picture_gives_what_it_held():
    assert Arrivals(LIMIT).receive(encode(to_png(BOTH)), 0.0) == [A, B]


def test_a_picture_may_come_in_fragments():
    assert taken(Arrivals(LIMIT), *frames(to_png(encode(A)), 50)) == [A]


def test_several_fragments_may_share_a_frame():
    assert Arrivals(LIMIT).receive(b"".join(frames(A)), 0.0) == [A]


@pytest.mark.parametrize(
    ("frame", "reason"),
    [
        (encode(to_png(encode(to_png(encode(A))))), "A png cannot stand in a png."),
        (encode(to_png(frames(A)[0])), "A fragment cannot stand in a fragment or a png."),
        (b"".join(frames(frames(A)[0])), "A fragment cannot stand in a fragment or a png."),
    ],
)
def test_nothing_is_unpacked_without_end(frame, reason):
    assert str(only(Arrivals(LIMIT), frame)) == reason


def test_what_is_no_operation_comes_as_its_error():
    error = only(Arrivals(LIMIT), '{"op":"unsubscribe","id":"u"}')
    assert (type(error), error.op, error.id) == (ProtocolError, "unsubscribe", "u")
    assert isinstance(only(Arrivals(LIMIT), b"\xa1" * 10), ProtocolError)
    assert isinstance(only(Arrivals(LIMIT), ""), ProtocolError)


def test_what_is_no_operation_in_fragments_or_a_picture_comes_as_its_error_too():
    assert str(taken(Arrivals(LIMIT), *frames(b"no operation"))[0]).startswith(
        "This is not JSON: 'no operation'"
    )
    assert str(only(Arrivals(LIMIT), encode(to_png(b"[]")))).startswith("An operation must be an object")


def test_a_bad_fragment_hinders_no_other():
    arrivals = Arrivals(LIMIT)
    good, rest = frames(A, 20)[0], frames(A, 20)[1:]
    bad = b'{"op":"fragment","id":"x","data":"","num":9,"total":2}'
    (error,) = taken(arrivals, good + bad)
    assert "num must be a whole number from 0 to 1, not 9" in str(error)
    assert taken(arrivals, *rest) == [A]


def test_a_frame_over_the_limit_is_not_looked_at():
    arrivals = Arrivals(100)
    assert str(only(arrivals, "x" * 101)) == "A frame may have at most 100 bytes, not 101."
    assert "at most" not in str(only(arrivals, "x" * 100))


def test_the_pictures_of_one_frame_unpack_to_the_limit_together():
    bomb = dump(to_png(b'{"op":"unsubscribe","topic":"/a"}' + b"\n" * 40_000))
    good = [each for each in Arrivals(LIMIT).receive(bomb * 5, 0.0) if each == A]
    assert len(good) == 2


def test_the_filtered_rows_of_all_pictures_of_one_frame_are_counted_together():
    picture = Image.frombytes("RGB", (100, 100), encode(A).ljust(30_000, b"\n"))
    file = io.BytesIO()
    picture.save(file, "png")
    filtered = encode(Png(data=base64.b64encode(file.getvalue()).decode()))
    found = Arrivals(LIMIT, filtered=50_000).receive(filtered * 3, 0.0)
    assert [each == A for each in found] == [True, False, False]
    assert "filtered rows" in str(found[-1])


@pytest.mark.parametrize(
    "msg",
    [
        [[]] * 100,
        cbor2.CBORTag(35, "(a|b)*" * 100),
        cbor2.CBORTag(4, [2**31, 2**9000]),
        cbor2.CBORTag(28, [cbor2.CBORTag(29, 0)]),
    ],
)
def test_cbor_that_takes_long_to_read_is_refused_before_it_is_read(msg):
    frame = cbor2.dumps({"op": "publish", "topic": "/a", "msg": msg})
    assert "A binary frame may hold" in str(only(Arrivals(LIMIT, most_values=100), frame))
    arrays = {"op": "publish", "topic": "/a", "msg": {"data": cbor2.CBORTag(85, bytes(4000))}}
    assert isinstance(only(Arrivals(LIMIT, most_values=100), cbor2.dumps(arrays)), BinaryPublish)


def test_who_sends_texts_without_end_is_told():
    arrivals = Arrivals(LIMIT, most=2, lifetime=10.0)
    taken(arrivals, *(frames(A, id=id)[0] for id in "ab"))
    (error,) = arrivals.receive(frames(A, id="c")[0], 1.0)
    assert (error.op, error.id) == ("fragment", "a")
    assert [each.id for each in taken(arrivals, encode(A), now=10.5) if each != A] == ["b"]
    assert [each.id for each in arrivals.expire(11.0)] == ["c"]
    assert arrivals.expire(12.0) == []


def test_a_message_is_left_as_it_is_through_all_of_it():
    message = json.dumps({"op": "publish", "topic": "/a", "msg": {"data": 'é"\\ 😀'}}).encode()
    for sent in ([message], frames(message, 7), [encode(to_png(message))], frames(to_png(message), 33)):
        (op,) = taken(Arrivals(LIMIT), *sent)
        assert isinstance(op, Publish)
        assert json.loads(bytes(op.msg)) == {"data": 'é"\\ 😀'}
