"""The way out to one client, without a network."""

from __future__ import annotations

import asyncio
import json

import pytest

from bridge.msgs.std_msgs import Float64, String
from bridge.protocol import Subscribed
from bridge.server.flow.outgoing_messages import Outgoing
from bridge.server.flow.priority_lanes import MOST_FRAMES, Lane, Stream
from bridge.server.flow.send_queue import Outlet, Round
from bridge.server.flow.send_window import DEAD, PAUSE, START
from tests.bridge.wires import Clock
from tests.bridge.ws_frames import frames


class Line:
    """Keeps what is written; a client that answers pings unless told to be silent."""

    def __init__(self):
        self.paused = False
        self.open = True
        self.silent = False
        self.writes = []
        self.unanswered = []

    def write(self, data):
        self.writes.append(data)
        self.unanswered += [bytes(frame.data) for frame in frames(data) if frame.opcode == 9]

    def cut(self):
        self.open = False

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
    """An outlet whose client answers when the test lets it."""

    def __init__(self):
        self.clock = Clock()
        self.line = Line()
        self.soon = []
        self.round = Round(self.soon.append)
        self.outlet = Outlet(self.line, self.round, "somebody", self.clock)

    def step(self):
        """The end of a step of the loop."""
        soon, self.soon[:] = list(self.soon), []
        for call in soon:
            call()

    def answer(self):
        """The client answers all pings, and what that lets go leaves."""
        while self.line.unanswered:
            self.outlet.answered(self.line.unanswered.pop(0))
            self.step()

    def fill(self):
        """Send until there is no room any more."""
        self.outlet.send(Lane.REPLY, text_of(self.outlet.window.limit))
        self.step()
        self.line.writes.clear()


def text_of(length):
    return bytes((0x81, 126)) + length.to_bytes(2, "big") + b"x" * length


def stream(topic="/odom", lane=Lane.TELEMETRY, keep=1, **wishes):
    return Stream(topic, lane, Subscribed(topic, **wishes), keep)


def number(value):
    return Outgoing("/any", Float64(value))


@pytest.fixture
async def bench():
    made = Bench()
    yield made
    made.outlet.close()


async def test_what_comes_in_one_step_leaves_in_one_write_with_the_urgent_first(bench):
    odom = stream(queue=5)
    for value in (1, 2):
        bench.outlet.offer(odom, number(value))
    bench.outlet.send(Lane.CONTROL, text_of(1000))
    assert bench.line.writes == []
    bench.step()
    assert len(bench.line.writes) == 1
    assert bench.line.heard[0] == b"x" * 1000
    assert len(bench.line.heard) == 3


async def test_a_step_in_which_the_connection_is_heard_ends_with_its_own_write(bench):
    bench.round.held = True
    bench.outlet.offer(stream(), number(1))
    assert bench.soon == []
    bench.round.flush()
    assert bench.line.numbers == [1.0]


async def test_without_room_the_newest_waits_and_goes_when_the_client_answers(bench):
    bench.fill()
    odom = stream()
    for value in (1, 2, 3):
        bench.outlet.offer(odom, number(value))
    bench.step()
    assert bench.line.writes == []
    bench.answer()
    assert bench.line.numbers == [3.0]


async def test_stop_is_answered_even_without_room(bench):
    bench.fill()
    bench.outlet.send(Lane.REPLY, text_of(200))
    bench.outlet.send(Lane.CONTROL, text_of(300))
    bench.step()
    assert bench.line.heard == [b"x" * 300]


async def test_while_the_kernel_takes_nothing_nothing_is_written(bench):
    bench.line.paused = True
    bench.outlet.send(Lane.CONTROL, text_of(300))
    bench.outlet.send(Lane.EVENT, text_of(400))
    bench.outlet.offer(stream(), number(1))
    bench.step()
    assert bench.line.heard == []
    bench.line.paused = False
    bench.outlet.pump()
    bench.step()
    assert [len(text) for text in bench.line.heard[:2]] == [300, 400]
    assert len(bench.line.heard) == 3


def beside(bench):
    """Another client of the same server."""
    line = Line()
    return line, Outlet(line, bench.round, "somebody else", bench.clock)


async def test_clients_that_get_the_same_in_one_step_share_the_bytes(bench):
    other, outlet = beside(bench)
    mine, theirs = stream(queue=9), stream(queue=9)
    for value in range(4):
        message = number(value)
        bench.outlet.offer(mine, message)
        outlet.offer(theirs, message)
        if value % 2:
            bench.step()
    assert bench.line.numbers == [0.0, 1.0, 2.0, 3.0]
    assert other.writes[1] is bench.line.writes[1]  # behind the first there is a ping, each client's own


async def test_clients_that_get_different_messages_in_one_step_get_each_their_own(bench):
    other, outlet = beside(bench)
    mine, theirs = stream(queue=9), stream(queue=9)
    for value in range(3):
        bench.outlet.offer(mine, number(value))
        outlet.offer(theirs, number(10 + value))
    bench.step()
    found = [json.loads(text)["msg"]["data"] for text in other.heard]
    assert (bench.line.numbers, found) == ([0.0, 1.0, 2.0], [10.0, 11.0, 12.0])


async def test_events_keep_their_order_when_they_had_to_wait(bench):
    bench.fill()
    events = stream("/events", Lane.EVENT, 0)
    for value in range(5):
        bench.outlet.offer(events, number(value))
    bench.answer()
    bench.outlet.offer(events, number(5))
    bench.step()
    assert bench.line.numbers == [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]


async def test_a_client_for_whom_too_much_waits_in_order_is_cut_off(bench, caplog):
    bench.fill()
    for _ in range(MOST_FRAMES):
        bench.outlet.send(Lane.EVENT, text_of(200))
    assert bench.line.open
    bench.outlet.send(Lane.EVENT, text_of(200))
    assert not bench.line.open
    assert "does not read what it asked for" in caplog.text


async def test_all_answers_that_a_client_waits_for_may_come_in_one_step(bench):
    bench.fill()
    for _ in range(4 * MOST_FRAMES):
        bench.outlet.send(Lane.REPLY, text_of(200))
    assert bench.line.open


async def test_an_outlet_that_is_closed_keeps_nothing(bench):
    bench.outlet.send(Lane.REPLY, text_of(1000))
    bench.outlet.send(Lane.CONTROL, text_of(1000))
    bench.step()
    bench.line.paused = True
    odom = stream(queue=9)
    for value in range(3):
        bench.outlet.offer(odom, number(value))
        bench.outlet.send(Lane.EVENT, text_of(200))
    bench.outlet.close()
    assert (list(odom.waiting), odom.gone) == ([], True)
    bench.line.paused = False
    bench.line.writes.clear()
    bench.outlet.pump()
    bench.step()
    assert bench.line.heard == []


async def test_samples_never_cut_anybody_off(bench):
    bench.fill()
    for topic in range(20):
        odom = stream(f"/odom{topic}", queue=1000)
        for value in range(200):
            bench.outlet.offer(odom, number(value))
    assert bench.line.open


async def test_what_is_under_way_stays_within_the_window(bench):
    odom = stream(queue=100)
    for value in range(2000):
        bench.outlet.offer(odom, number(value))
        bench.step()
    assert bench.outlet.window.under_way < START + 200


async def test_a_throttled_topic_comes_with_its_newest_message_by_itself(bench):
    odom = stream(period=0.01)
    for value in (1, 2, 3):
        bench.outlet.offer(odom, number(value))
    bench.step()
    assert bench.line.numbers == [1.0]
    bench.clock.time += 0.011
    async with asyncio.timeout(5):
        while len(bench.line.numbers) < 2:
            await asyncio.sleep(0.001)
            bench.step()
    assert bench.line.numbers == [1.0, 3.0]


async def test_what_cannot_be_encoded_is_logged_and_the_rest_goes(bench, caplog):
    for value in ("\ud800", "fine"):
        bench.outlet.offer(stream(queue=5), Outgoing("/names", String(value)))
    bench.fill()
    names = stream(queue=5)
    for value in ("\ud800", "later"):
        bench.outlet.offer(names, Outgoing("/names", String(value)))
    bench.answer()
    assert bench.line.numbers == ["later"]
    assert caplog.text.count("not sent") == 2


async def test_what_is_forgotten_is_not_sent(bench):
    bench.fill()
    odom = stream()
    bench.outlet.offer(odom, number(1))
    bench.outlet.forget(odom)
    bench.answer()
    assert bench.line.heard == []
    assert odom.gone


async def test_who_gives_no_sign_of_life_is_cut_off(bench):
    bench.outlet.beat()
    assert len(bench.line.unanswered) == 1
    bench.clock.time += DEAD - 1
    bench.outlet.beat()
    assert bench.line.open
    bench.clock.time += 2
    bench.outlet.beat()
    assert not bench.line.open


async def test_who_answers_is_asked_again_later(bench):
    for _ in range(10):
        bench.outlet.beat()
        bench.answer()
        bench.clock.time += 6
    assert bench.line.open
    assert len(bench.line.writes) == 10


async def test_a_connection_that_is_closing_and_does_not_end_is_cut(bench):
    cuts = []
    bench.line.cut = lambda: cuts.append(1)
    bench.line.open = False
    bench.outlet.beat()
    assert cuts == []
    bench.outlet.beat()
    assert cuts == [1]


async def test_what_no_longer_fits_when_the_window_falls_is_pinged_for(bench):
    bench.outlet.send(Lane.REPLY, text_of(100))
    bench.step()
    bench.clock.time += 0.001
    bench.answer()  # a quick way
    bench.outlet.window.limit = 40_000
    bench.clock.time += PAUSE
    for length in (6000, 7000):
        bench.outlet.send(Lane.REPLY, text_of(length))
        bench.step()
    bench.clock.time += 0.2
    assert len(bench.line.unanswered) == 1
    bench.outlet.answered(bench.line.unanswered.pop())
    assert bench.outlet.window.limit < 7000 == bench.outlet.window.under_way - 4
    bench.outlet.offer(stream(), number(1))
    bench.step()
    assert bench.line.unanswered
    bench.line.writes.clear()
    bench.answer()
    assert bench.line.numbers == [1.0]


async def test_what_does_not_fit_waits_until_the_way_is_nearly_empty_and_is_pinged_for(bench):
    for _ in range(3):
        bench.outlet.send(Lane.REPLY, text_of(1000))
    grid, odom = stream("/map", Lane.BULK), stream(queue=9)
    bench.outlet.offer(grid, Outgoing("/map", String("x" * 2 * START)))
    bench.step()
    assert len(bench.line.heard) == 3
    bench.outlet.send(Lane.REPLY, text_of(300))
    bench.step()
    assert len(bench.line.heard) == 4
    assert bench.line.unanswered
    bench.answer()
    assert len(bench.line.heard) == 5
    bench.outlet.offer(odom, number(1))
    bench.step()
    assert len(bench.line.heard) == 6


async def test_a_sample_passes_a_map_that_waits_for_room_and_other_maps_do_not(bench):
    for length in (2000, 2000):
        bench.outlet.send(Lane.REPLY, text_of(length))
    first, second = stream("/map", Lane.BULK), stream("/costs", Lane.BULK)
    bench.outlet.offer(first, Outgoing("/map", String("x" * 2 * START)))
    bench.outlet.offer(second, number(1))
    bench.outlet.offer(stream(), number(2))
    bench.step()
    assert bench.line.short() == [2.0]
    bench.answer()
    assert bench.line.short() == [2.0, 1.0]


async def test_a_map_gets_its_turn_among_samples_without_end(bench):
    grid, odom = stream("/map", Lane.BULK), stream()
    bench.outlet.offer(odom, number(0))
    bench.outlet.send(Lane.REPLY, text_of(4000))
    bench.outlet.offer(grid, Outgoing("/map", String("x" * 2 * START)))
    for value in range(40):
        bench.outlet.offer(odom, number(value))
        bench.step()
        if bench.line.unanswered:
            bench.outlet.answered(bench.line.unanswered.pop(0))
            bench.step()
    assert max(map(len, bench.line.heard)) > START
