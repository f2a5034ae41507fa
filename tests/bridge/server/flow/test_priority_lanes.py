"""What waits for one client."""

from __future__ import annotations

import json

import pytest

from bridge.core.errors import ProtocolError
from bridge.msgs.std_msgs import Float64, String
from bridge.protocol import Subscribed
from bridge.server.flow.outgoing_messages import OutgoingMessage
from bridge.server.flow.priority_lanes import (
    MAX_BYTES,
    MAX_FRAMES,
    MAX_UNCOUNTED_BYTES,
    MAX_WAITING_BYTES,
    MESSAGE_COST,
    Lane,
    PriorityLanes,
    Stream,
)


def stream(topic="/odom", lane=Lane.TELEMETRY, keep=1, **wishes):
    return Stream(topic, lane, Subscribed(topic, **wishes), keep)


def number(value):
    return OutgoingMessage("/any", Float64(value))


def text(frame):
    """The JSON in one small text frame."""
    return json.loads(frame[2:])


def taken(lanes, now=0.0):
    frame = lanes.pop(now)
    return None if frame is None else text(frame)["msg"]["data"]


def test_of_a_topic_only_the_newest_message_waits():
    lanes, odom = PriorityLanes(), stream()
    for value in range(5):
        lanes.offer(odom, number(value))
    assert (taken(lanes), taken(lanes)) == (4.0, None)


def test_a_queue_length_keeps_as_many_of_the_newest_in_order():
    lanes, odom = PriorityLanes(), stream(queue=3)
    for value in range(5):
        lanes.offer(odom, number(value))
    assert [taken(lanes) for _ in range(4)] == [2.0, 3.0, 4.0, None]


@pytest.mark.parametrize(("lane", "most"), [(Lane.TELEMETRY, 100), (Lane.BULK, 4)])
def test_no_queue_length_is_too_long(lane, most):
    lanes, odom = PriorityLanes(), stream(lane=lane, queue=10**9)
    for value in range(200):
        lanes.offer(odom, number(value))
    assert [taken(lanes) for _ in range(most + 1)][-2:] == [199.0, None]


def test_topics_of_a_lane_take_turns():
    lanes, odom, scan = PriorityLanes(), stream(queue=2), stream("/scan")
    for each, value in ((odom, 1), (odom, 2), (scan, 3)):
        lanes.offer(each, number(value))
    assert [taken(lanes) for _ in range(3)] == [1.0, 3.0, 2.0]


def test_the_lanes_go_in_their_order():
    lanes = PriorityLanes()
    lanes.offer(stream(lane=Lane.BULK), number(5))
    lanes.offer(stream(), number(4))
    lanes.push(Lane.EVENT, b"event")
    lanes.push(Lane.REPLY, b"reply")
    lanes.push(Lane.CONTROL, b"stop")
    assert [lanes.pop(0.0) for _ in range(3)] == [b"stop", b"reply", b"event"]
    assert [taken(lanes), taken(lanes)] == [4.0, 5.0]


def test_samples_without_end_do_not_keep_a_map_away_for_ever():
    lanes, odom, grid = PriorityLanes(), stream(), stream("/map", Lane.BULK)
    lanes.offer(grid, number(-1))
    went = []
    while -1.0 not in went:
        lanes.offer(odom, number(len(went)))
        went.append(taken(lanes))
        assert len(went) < 20
    assert len(went) > 4


def test_there_is_an_end_to_what_can_wait_in_order():
    lanes = PriorityLanes()
    assert all(lanes.push(Lane.EVENT, b"x") for _ in range(MAX_FRAMES))
    assert not lanes.push(Lane.EVENT, b"x")
    assert lanes.push(Lane.CONTROL, b"stop")


def test_there_is_an_end_to_the_bytes_that_can_wait_in_order():
    lanes, large = PriorityLanes(), bytes(MAX_BYTES)
    assert lanes.push(Lane.EVENT, large + b"even larger")
    assert not lanes.push(Lane.EVENT, b"x")
    lanes.pop(0.0)
    assert lanes.push(Lane.EVENT, large)


def test_a_throttled_topic_waits_for_its_turn_and_then_sends_the_newest():
    lanes, odom = PriorityLanes(), stream(period=0.1)
    lanes.offer(odom, number(1))
    assert taken(lanes, now=5.0) == 1.0
    lanes.offer(odom, number(2))
    assert taken(lanes, now=5.04) is None
    assert lanes.delay(5.04) == pytest.approx(0.06)
    lanes.offer(odom, number(3))
    assert taken(lanes, now=5.11) == 3.0
    assert lanes.delay(5.11) is None


def test_a_throttled_topic_of_events_without_a_queue_length_has_no_backlog():
    """A backlog at a slow rate is all old: the last of twenty would come after 3.8 s."""
    lanes, chat = PriorityLanes(), stream("/chat", keep=100, period=0.2)
    came = []
    for value in range(20):
        lanes.offer(chat, number(value))
        came.append((value, taken(lanes, now=0.01 * value)))
    assert [found for _, found in came if found is not None] == [0.0]
    assert (taken(lanes, now=0.2), taken(lanes, now=9.0)) == (19.0, None)


def test_a_throttled_topic_keeps_as_many_as_its_queue_length_asks_for():
    lanes, chat = PriorityLanes(), stream("/chat", keep=100, period=0.2, queue=3)
    for value in range(20):
        lanes.offer(chat, number(value))
    assert [taken(lanes, now=float(value)) for value in range(4)] == [17.0, 18.0, 19.0, None]


def test_a_throttled_topic_does_not_keep_the_others_waiting():
    lanes, odom, scan = PriorityLanes(), stream(period=10.0), stream("/scan")
    for value in (1, 2):
        lanes.offer(odom, number(value))
        taken(lanes)
    lanes.offer(scan, number(3))
    assert taken(lanes) == 3.0


def test_what_waits_for_a_topic_is_forgotten_with_its_subscription():
    lanes, odom = PriorityLanes(), stream()
    lanes.offer(odom, number(1))
    lanes.remove(odom)
    assert lanes.delay(0.0) is None
    assert taken(lanes) is None


def test_what_cannot_be_encoded_is_dropped_and_does_not_block_the_rest():
    lanes = PriorityLanes()
    lanes.offer(stream(), OutgoingMessage("/odom", String("\ud800")))
    lanes.offer(stream("/scan"), number(2))
    with pytest.raises(ProtocolError):
        lanes.pop(0.0)
    assert taken(lanes) == 2.0


def large(data, topic="/any"):
    """A message of a third of what may wait."""
    return OutgoingMessage(topic, String(str(data) + "x" * (MAX_WAITING_BYTES // 3)))


def waits(*streams):
    return [[message.msg.data[0] for message in each.waiting] for each in streams]


def test_of_too_many_bytes_the_oldest_samples_are_forgotten_first_and_then_the_oldest_of_bulk():
    lanes = PriorityLanes()
    grid, odom, scan = stream("/map", Lane.BULK, queue=4), stream(queue=9), stream("/scan", queue=9)
    for each, data in ((grid, 1), (scan, 2), (odom, 3)):
        lanes.offer(each, large(data))
    assert waits(grid, scan, odom) == [["1"], [], ["3"]]
    lanes.offer(grid, large(4))
    assert waits(grid, scan, odom) == [["1", "4"], [], []]
    lanes.offer(grid, large(5))
    assert waits(grid) == [["4", "5"]]
    assert [len(lanes.pop(0.0)) > 1000 for _ in range(2)] == [True, True]
    assert lanes.pop(0.0) is None


def test_one_message_may_be_larger_than_all_that_may_wait():
    lanes, odom = PriorityLanes(), stream(queue=9)
    lanes.offer(odom, number(1))
    lanes.offer(odom, OutgoingMessage("/any", String("x" * (MAX_WAITING_BYTES + 1))))
    assert len(odom.waiting) == 1
    lanes.offer(odom, large(2))
    assert waits(odom) == [["2"]]


def test_many_small_messages_are_bounded_together_and_the_newest_of_each_topic_stays():
    lanes, streams = PriorityLanes(), [stream(f"/t{number}", queue=100) for number in range(50)]
    for value in range(100):
        for each in streams:
            lanes.offer(each, OutgoingMessage("/any", String(f"{value:02}" + "x" * 9500)))
            waiting = sum(len(each.waiting) for each in streams) * (9500 + MESSAGE_COST)
            assert waiting <= MAX_WAITING_BYTES + MAX_UNCOUNTED_BYTES
    assert waiting > MAX_WAITING_BYTES // 2
    left = [[message.msg.data[:2] for message in each.waiting] for each in streams]
    assert all(of[-1] == "99" and of == sorted(of) for of in left)
    assert max(map(len, left)) - min(map(len, left)) <= 1


def test_what_waits_is_counted_seldom(monkeypatch):
    counted = []
    lighten = PriorityLanes._lighten
    monkeypatch.setattr(PriorityLanes, "_lighten", lambda *told: (counted.append(0), lighten(*told)))
    lanes, odom = PriorityLanes(), stream(queue=9)
    for _ in range(100):
        lanes.offer(odom, OutgoingMessage("/any", String("x" * (MAX_UNCOUNTED_BYTES // 10))))
    assert counted == [0] * 10


@pytest.mark.parametrize("end", ["sent", "forgotten", "replaced", "shortened"])
def test_what_waits_no_longer_makes_room(end):
    lanes, odom, scan = PriorityLanes(), stream(queue=2), stream("/scan", queue=9)
    for data in range(2):
        lanes.offer(odom, large(data))
    if end == "sent":
        lanes.pop(0.0)
        lanes.pop(0.0)
    elif end == "forgotten":
        lanes.remove(odom)
    elif end == "replaced":
        for value in range(2):
            lanes.offer(odom, number(value))
    else:
        odom.want(Subscribed("/odom", queue=1))
    kept = 1 if end == "shortened" else 2
    for data in range(kept):
        lanes.offer(scan, large(data))
    assert len(scan.waiting) == kept
    assert len(odom.waiting) == {"replaced": 2, "shortened": 1}.get(end, 0)
