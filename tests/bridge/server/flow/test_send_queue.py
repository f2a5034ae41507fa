"""The way out to one client, without a network."""

from __future__ import annotations

import asyncio
import json

import pytest

from bridge.msgs.std_msgs import Float64, String
from bridge.protocol import Subscribed
from bridge.server.flow.outgoing_messages import OutgoingMessage
from bridge.server.flow.priority_lanes import MAX_FRAMES, Lane, Stream
from bridge.server.flow.send_queue import SendQueue, WriteBatch
from bridge.server.flow.send_window import BUSY_PING_PERIOD, DEAD_TIMEOUT, START_WINDOW
from tests.bridge.wires import Clock
from tests.bridge.ws_frames import frames


class FrameWriter:
    """Keeps what is written; a client that answers pings unless told to be silent."""

    def __init__(self):
        self.paused = False
        self.is_open = True
        self.silent = False
        self.writes = []
        self.unanswered = []

    def write(self, data):
        self.writes.append(data)
        self.unanswered += [bytes(frame.data) for frame in frames(data) if frame.opcode == 9]

    def abort(self):
        self.is_open = False

    @property
    def heard(self):
        """The texts written so far, pings left out."""
        return [bytes(frame.data) for data in self.writes for frame in frames(data) if frame.opcode == 1]

    @property
    def numbers(self):
        return [json.loads(text)["msg"]["data"] for text in self.heard]

    def short(self):
        """The numbers among texts of all kinds."""
        found = [json.loads(text)["msg"]["data"] for text in self.heard if text.startswith(b"{")]
        return [data for data in found if not isinstance(data, str)]


class Bench:
    """A queue whose client answers when the test lets it."""

    def __init__(self):
        self.clock = Clock()
        self.writer = FrameWriter()
        self.soon = []
        self.batch = WriteBatch(self.soon.append)
        self.queue = SendQueue(self.writer, self.batch, "somebody", self.clock)

    def step(self):
        """The end of a step of the loop."""
        soon, self.soon[:] = list(self.soon), []
        for call in soon:
            call()

    def answer(self):
        """The client answers all pings, and what that lets go leaves."""
        while self.writer.unanswered:
            self.queue.on_pong(self.writer.unanswered.pop(0))
            self.step()

    def fill(self):
        """Send until there is no room any more."""
        self.queue.send(Lane.REPLY, text_of(self.queue.window.limit))
        self.step()
        self.writer.writes.clear()


def text_of(length):
    return bytes((0x81, 126)) + length.to_bytes(2, "big") + b"x" * length


def stream(topic="/odom", lane=Lane.TELEMETRY, keep=1, **wishes):
    return Stream(topic, lane, Subscribed(topic, **wishes), keep)


def number(value):
    return OutgoingMessage("/any", Float64(value))


@pytest.fixture
async def bench():
    made = Bench()
    yield made
    made.queue.close()


async def test_what_comes_in_one_step_leaves_in_one_write_with_the_urgent_first(bench):
    odom = stream(queue=5)
    for value in (1, 2):
        bench.queue.offer(odom, number(value))
    bench.queue.send(Lane.CONTROL, text_of(1000))
    assert bench.writer.writes == []
    bench.step()
    assert len(bench.writer.writes) == 1
    assert bench.writer.heard[0] == b"x" * 1000
    assert len(bench.writer.heard) == 3


async def test_a_step_in_which_the_connection_is_heard_ends_with_its_own_write(bench):
    bench.batch.held = True
    bench.queue.offer(stream(), number(1))
    assert bench.soon == []
    bench.batch.flush()
    assert bench.writer.numbers == [1.0]


async def test_without_room_the_newest_waits_and_goes_when_the_client_answers(bench):
    bench.fill()
    odom = stream()
    for value in (1, 2, 3):
        bench.queue.offer(odom, number(value))
    bench.step()
    assert bench.writer.writes == []
    bench.answer()
    assert bench.writer.numbers == [3.0]


async def test_stop_is_answered_even_without_room(bench):
    bench.fill()
    bench.queue.send(Lane.REPLY, text_of(200))
    bench.queue.send(Lane.CONTROL, text_of(300))
    bench.step()
    assert bench.writer.heard == [b"x" * 300]


async def test_while_the_kernel_takes_nothing_nothing_is_written(bench):
    bench.writer.paused = True
    bench.queue.send(Lane.CONTROL, text_of(300))
    bench.queue.send(Lane.EVENT, text_of(400))
    bench.queue.offer(stream(), number(1))
    bench.step()
    assert bench.writer.heard == []
    bench.writer.paused = False
    bench.queue.send_waiting()
    bench.step()
    assert [len(text) for text in bench.writer.heard[:2]] == [300, 400]
    assert len(bench.writer.heard) == 3


def beside(bench):
    """Another client of the same server."""
    writer = FrameWriter()
    return writer, SendQueue(writer, bench.batch, "somebody else", bench.clock)


async def test_clients_that_get_the_same_in_one_step_share_the_bytes(bench):
    other, queue = beside(bench)
    mine, theirs = stream(queue=9), stream(queue=9)
    for value in range(4):
        message = number(value)
        bench.queue.offer(mine, message)
        queue.offer(theirs, message)
        if value % 2:
            bench.step()
    assert bench.writer.numbers == [0.0, 1.0, 2.0, 3.0]
    assert other.writes[1] is bench.writer.writes[1]  # behind the first there is a ping, each client's own


async def test_clients_that_get_different_messages_in_one_step_get_each_their_own(bench):
    other, queue = beside(bench)
    mine, theirs = stream(queue=9), stream(queue=9)
    for value in range(3):
        bench.queue.offer(mine, number(value))
        queue.offer(theirs, number(10 + value))
    bench.step()
    found = [json.loads(text)["msg"]["data"] for text in other.heard]
    assert (bench.writer.numbers, found) == ([0.0, 1.0, 2.0], [10.0, 11.0, 12.0])


async def test_events_keep_their_order_when_they_had_to_wait(bench):
    bench.fill()
    events = stream("/events", Lane.EVENT, 0)
    for value in range(5):
        bench.queue.offer(events, number(value))
    bench.answer()
    bench.queue.offer(events, number(5))
    bench.step()
    assert bench.writer.numbers == [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]


async def test_a_client_for_whom_too_much_waits_in_order_is_cut_off(bench, caplog):
    bench.fill()
    for _ in range(MAX_FRAMES):
        bench.queue.send(Lane.EVENT, text_of(200))
    assert bench.writer.is_open
    bench.queue.send(Lane.EVENT, text_of(200))
    assert not bench.writer.is_open
    assert "does not read what it asked for" in caplog.text


async def test_all_answers_that_a_client_waits_for_may_come_in_one_step(bench):
    bench.fill()
    for _ in range(4 * MAX_FRAMES):
        bench.queue.send(Lane.REPLY, text_of(200))
    assert bench.writer.is_open


async def test_an_outlet_that_is_closed_keeps_nothing(bench):
    bench.queue.send(Lane.REPLY, text_of(1000))
    bench.queue.send(Lane.CONTROL, text_of(1000))
    bench.step()
    bench.writer.paused = True
    odom = stream(queue=9)
    for value in range(3):
        bench.queue.offer(odom, number(value))
        bench.queue.send(Lane.EVENT, text_of(200))
    bench.queue.close()
    assert (list(odom.waiting), odom.gone) == ([], True)
    bench.writer.paused = False
    bench.writer.writes.clear()
    bench.queue.send_waiting()
    bench.step()
    assert bench.writer.heard == []


async def test_samples_never_cut_anybody_off(bench):
    bench.fill()
    for topic in range(20):
        odom = stream(f"/odom{topic}", queue=1000)
        for value in range(200):
            bench.queue.offer(odom, number(value))
    assert bench.writer.is_open


async def test_what_is_under_way_stays_within_the_window(bench):
    odom = stream(queue=100)
    for value in range(2000):
        bench.queue.offer(odom, number(value))
        bench.step()
    assert bench.queue.window.under_way < START_WINDOW + 200


async def test_a_throttled_topic_comes_with_its_newest_message_by_itself(bench):
    odom = stream(period=0.01)
    for value in (1, 2, 3):
        bench.queue.offer(odom, number(value))
    bench.step()
    assert bench.writer.numbers == [1.0]
    bench.clock.time += 0.011
    async with asyncio.timeout(5):
        while len(bench.writer.numbers) < 2:
            await asyncio.sleep(0.001)
            bench.step()
    assert bench.writer.numbers == [1.0, 3.0]


async def test_what_cannot_be_encoded_is_logged_and_the_rest_goes(bench, caplog):
    for value in ("\ud800", "fine"):
        bench.queue.offer(stream(queue=5), OutgoingMessage("/names", String(value)))
    bench.fill()
    names = stream(queue=5)
    for value in ("\ud800", "later"):
        bench.queue.offer(names, OutgoingMessage("/names", String(value)))
    bench.answer()
    assert bench.writer.numbers == ["later"]
    assert caplog.text.count("not sent") == 2


async def test_what_is_forgotten_is_not_sent(bench):
    bench.fill()
    odom = stream()
    bench.queue.offer(odom, number(1))
    bench.queue.remove(odom)
    bench.answer()
    assert bench.writer.heard == []
    assert odom.gone


async def test_who_gives_no_sign_of_life_is_cut_off(bench):
    bench.queue.check_alive()
    assert len(bench.writer.unanswered) == 1
    bench.clock.time += DEAD_TIMEOUT - 1
    bench.queue.check_alive()
    assert bench.writer.is_open
    bench.clock.time += 2
    bench.queue.check_alive()
    assert not bench.writer.is_open


async def test_who_answers_is_asked_again_later(bench):
    for _ in range(10):
        bench.queue.check_alive()
        bench.answer()
        bench.clock.time += 6
    assert bench.writer.is_open
    assert len(bench.writer.writes) == 10


async def test_a_connection_that_is_closing_and_does_not_end_is_cut(bench):
    cuts = []
    bench.writer.abort = lambda: cuts.append(1)
    bench.writer.is_open = False
    bench.queue.check_alive()
    assert cuts == []
    bench.queue.check_alive()
    assert cuts == [1]


async def test_what_no_longer_fits_when_the_window_falls_is_pinged_for(bench):
    bench.queue.send(Lane.REPLY, text_of(100))
    bench.step()
    bench.clock.time += 0.001
    bench.answer()  # a quick way
    bench.queue.window.limit = 40_000
    bench.clock.time += BUSY_PING_PERIOD
    for length in (6000, 7000):
        bench.queue.send(Lane.REPLY, text_of(length))
        bench.step()
    bench.clock.time += 0.2
    assert len(bench.writer.unanswered) == 1
    bench.queue.on_pong(bench.writer.unanswered.pop())
    assert bench.queue.window.limit < 7000 == bench.queue.window.under_way - 4
    bench.queue.offer(stream(), number(1))
    bench.step()
    assert bench.writer.unanswered
    bench.writer.writes.clear()
    bench.answer()
    assert bench.writer.numbers == [1.0]


async def test_what_does_not_fit_waits_until_the_way_is_nearly_empty_and_is_pinged_for(bench):
    for _ in range(3):
        bench.queue.send(Lane.REPLY, text_of(1000))
    grid, odom = stream("/map", Lane.BULK), stream(queue=9)
    bench.queue.offer(grid, OutgoingMessage("/map", String("x" * 2 * START_WINDOW)))
    bench.step()
    assert len(bench.writer.heard) == 3
    bench.queue.send(Lane.REPLY, text_of(300))
    bench.step()
    assert len(bench.writer.heard) == 4
    assert bench.writer.unanswered
    bench.answer()
    assert len(bench.writer.heard) == 5
    bench.queue.offer(odom, number(1))
    bench.step()
    assert len(bench.writer.heard) == 6


async def test_a_sample_passes_a_map_that_waits_for_room_and_other_maps_do_not(bench):
    for length in (2000, 2000):
        bench.queue.send(Lane.REPLY, text_of(length))
    first, second = stream("/map", Lane.BULK), stream("/costs", Lane.BULK)
    bench.queue.offer(first, OutgoingMessage("/map", String("x" * 2 * START_WINDOW)))
    bench.queue.offer(second, number(1))
    bench.queue.offer(stream(), number(2))
    bench.step()
    assert bench.writer.short() == [2.0]
    bench.answer()
    assert bench.writer.short() == [2.0, 1.0]


async def test_a_map_gets_its_turn_among_samples_without_end(bench):
    grid, odom = stream("/map", Lane.BULK), stream()
    bench.queue.offer(odom, number(0))
    bench.queue.send(Lane.REPLY, text_of(4000))
    bench.queue.offer(grid, OutgoingMessage("/map", String("x" * 2 * START_WINDOW)))
    for value in range(40):
        bench.queue.offer(odom, number(value))
        bench.step()
        if bench.writer.unanswered:
            bench.queue.on_pong(bench.writer.unanswered.pop(0))
            bench.step()
    assert max(map(len, bench.writer.heard)) > START_WINDOW
