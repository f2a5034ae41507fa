"""Outages, changed networks and sleep: the client is back soon, and nothing of before is sent then."""

from __future__ import annotations

import asyncio
import math
import random
import socket
import struct

import pytest
from websockets.asyncio.server import serve
from websockets.utils import accept_key

from bridge.client import client as module
from bridge.client import connection, heartbeat
from bridge.client.client import BridgeClient, Phase
from bridge.driving import drive_rest
from bridge.msgs.geometry_msgs import Twist
from tests.bridge.client.foreign_server import foreign
from tests.bridge.wires import Clock, FakeNetwork, Record, arrived, link, server, until, url, wire


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    monkeypatch.setattr(heartbeat, "PING_PERIOD", 0.02)
    monkeypatch.setattr(module, "CHANGE_CHECK_PERIOD", 0.01)


def attempts(seed: int, until: float) -> list[float]:
    """When a client tries whose robot refuses at once, in virtual time from the cut on [s]."""
    client = BridgeClient("ws://127.0.0.1:1", rng=random.Random(seed))
    times = [0.0]
    while times[-1] < until:
        times.append(times[-1] + client.wait_before(len(times)))
    return times


@pytest.mark.parametrize("outage", [0.5, 1.0, 2.0, 3.0, 4.0])
def test_the_next_attempt_comes_within_two_seconds_of_the_end_of_an_outage_of_up_to_four(outage):
    late = [min(at for at in attempts(seed, outage) if at >= outage) - outage for seed in range(500)]
    assert max(late) < 1.8


def test_many_clients_do_not_come_at_once():
    assert len({attempts(seed, 2.0)[1] for seed in range(50)}) == 50


FOR_GOOD = (600.0, 600.0)
"""Waits between attempts [s], far longer than a test waits."""


async def test_a_new_way_to_the_robot_ends_the_wait():
    network = FakeNetwork()
    async with server() as robot:
        port = robot.port
    async with link(f"ws://127.0.0.1:{port}", backoff=FOR_GOOD, network=network) as made:
        await made.sentence(Phase.WAITING)
        async with server(port=port):
            network.address, looked = None, len(network.asked)
            await until(lambda: len(network.asked) > looked + 1)
            assert made.client.state.phase is Phase.WAITING
            network.address = "10.0.0.5"
            await made.connected()


async def test_waking_up_ends_the_wait():
    network = FakeNetwork()
    async with server() as robot:
        port = robot.port
    async with link(f"ws://127.0.0.1:{port}", backoff=FOR_GOOD, network=network) as made:
        await made.sentence(Phase.WAITING)
        async with server(port=port):
            network.sleep = 600.0
            assert await made.connected(), "and does not wait for ten minutes"


async def test_a_connection_from_an_address_that_is_gone_is_given_up_at_once():
    network = FakeNetwork()
    async with server() as robot, link(url(robot), network=network) as made:
        await made.connected()
        network.kept = False
        sentence = await made.sentence(Phase.WAITING)
        assert sentence == "The network changed: this device is no longer 127.0.0.1."
        network.kept = True
        await made.connected()


@pytest.mark.parametrize("change", ["address", "sleep"])
async def test_a_silent_link_is_lost_one_second_after_the_network_changed_or_the_device_woke(change):
    network, clock = FakeNetwork(), Clock()
    async with (
        server() as robot,
        wire(robot.port) as cable,
        link(url(cable), now=clock, network=network) as made,
    ):
        await made.connected()
        cable.freeze()
        await arrived()
        setattr(network, change, {"address": "10.0.0.5", "sleep": 600.0}[change])
        await until(lambda: made.client._heartbeat.liveness._alert < math.inf)
        clock.time += 1.1
        sentence = await made.sentence(Phase.WAITING)
        assert sentence == f"Nothing came from 127.0.0.1:{cable.port} after the network changed."


async def test_a_link_that_lives_on_survives_a_change_of_the_network():
    network, clock = FakeNetwork(), Clock()
    async with server() as robot, link(url(robot), now=clock, network=network) as made:
        await made.connected()
        network.address, looked = "10.0.0.5", len(network.asked)
        await until(lambda: len(network.asked) > looked + 1)
        for _ in range(8):
            clock.time += 0.5
            await made.heard_at(clock.time)
        assert made.client.state.phase is Phase.CONNECTED
        assert made.states == [], "nor was it lost in between"


async def test_what_the_system_could_not_deliver_of_a_lost_connection_is_thrown_away():
    ended = asyncio.get_running_loop().create_future()
    lost = asyncio.Event()

    async def deaf(reader, writer):
        key = (
            (await reader.readuntil(b"\r\n\r\n")).split(b"Sec-WebSocket-Key: ")[1].split(b"\r\n")[0].decode()
        )
        writer.write(
            b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            b"Sec-WebSocket-Accept: " + accept_key(key).encode() + b"\r\n\r\n"
        )
        await lost.wait()
        try:
            while await reader.read(2**20):
                pass
            ended.set_result("everything came, late")
        except ConnectionResetError:
            ended.set_result("thrown away")
        writer.close()

    async with await asyncio.start_server(deaf, "127.0.0.1", 0) as listening:
        place = f"ws://127.0.0.1:{listening.sockets[0].getsockname()[1]}"
        made = await connection.open_connection(place, 5.0)
        while not made.stuck:
            made.send("x" * 10_000)
        await made.close(lost=True)
        lost.set()
        assert await ended == "thrown away"


async def test_a_drive_command_without_a_known_clock_goes_unstamped_to_a_foreign_server():
    heard = Record()

    async def bare(ws):
        async for text in ws:
            heard(text)

    async with serve(bare, "127.0.0.1", 0) as listening:
        clock, place = Clock(), f"ws://127.0.0.1:{listening.sockets[0].getsockname()[1]}"
        async with link(place, now=clock) as made:
            await heard.reach(1)
            for _ in range(4):
                clock.time += 0.9
                await made.heard_at(clock.time)
            client = await made.connected()
            assert client.foreign
            assert math.isnan(client.robot_time())
            assert client.publish("/cmd_vel", Twist(), stamp=client.robot_time())
            await heard.until(lambda seen: any('"publish"' in text for text in seen))
            assert not any('"stamp"' in text for text in heard)


async def test_a_drive_command_without_a_known_clock_never_goes_to_one_of_ours():
    heard = Record()
    async with server(on_message=heard) as robot, link(url(robot)) as made:
        client = await made.connected()
        assert not client.foreign
        assert not client.publish("/cmd_vel", Twist.planar(0.5, 0.0), stamp=math.nan)
        assert client.publish("/cmd_vel", Twist(), stamp=1.0)
        assert [msg for _, _, msg, _ in await heard.reach(1)] == [Twist()]


async def test_while_nothing_comes_from_the_robot_no_drive_command_is_sent():
    clock = Clock()
    async with server() as robot, wire(robot.port) as cable, link(url(cable), now=clock) as made:
        client = await made.connected()
        cable.freeze()
        await arrived()
        clock.time += 1.1
        assert not client.publish("/cmd_vel", Twist(), stamp=1.0)


async def test_a_foreign_server_that_leaves_commands_unread_gets_no_more_of_them_but_rest():
    clock = Clock()
    async with (
        foreign() as robot,
        wire(robot.port) as cable,
        link(f"ws://127.0.0.1:{cable.port}", now=clock) as made,
    ):
        client = await made.connected()
        client.advertise("/cmd_vel", Twist)
        await until(lambda: client._heartbeat.liveness.answers_pings)
        cable.freeze()
        sent = []
        for _ in range(20):
            sent.append(client.publish("/cmd_vel", Twist.planar(0.3, 0.0), stamp=math.nan))
            clock.time += 0.05
        assert (sum(sent), sent[:6], sent[6:]) == (6, [True] * 6, [False] * 14)
        assert client.publish("/cmd_vel", Twist(), even_late=True)
        cable.thaw()
        await until(lambda: robot.robot.heard == 7)
        assert robot.robot.speed == 0.0
        await until(lambda: client.publish("/cmd_vel", Twist.planar(0.3, 0.0), stamp=math.nan))


async def test_a_robot_of_another_maker_gets_zero_when_its_driver_falls_silent_on_a_living_link():
    clock = Clock()
    async with foreign() as robot, link(f"ws://127.0.0.1:{robot.port}", now=clock) as made:
        robot.robot.command = heard = Record()
        client = await made.connected()
        client.advertise("/cmd_vel", Twist)
        assert client.publish("/cmd_vel", Twist.planar(0.3, 0.0), stamp=math.nan)
        await heard.reach(1)
        clock.time += drive_rest.SILENCE_TIMEOUT
        assert [twist["linear"]["x"] for twist in await heard.reach(2)] == [0.3, 0.0]


async def test_after_a_cut_no_old_zero_follows_to_a_robot_that_somebody_else_may_drive_by_then(monkeypatch):
    monkeypatch.setattr(drive_rest, "CHECK_PERIOD", 0.0)
    clock = Clock()
    async with (
        foreign() as robot,
        wire(robot.port) as cable,
        link(f"ws://127.0.0.1:{cable.port}", now=clock) as made,
    ):
        robot.robot.command = heard = Record()
        client = await made.connected()
        client.advertise("/cmd_vel", Twist)
        assert client.publish("/cmd_vel", Twist.planar(0.3, 0.0), stamp=math.nan)
        await heard.reach(1)
        cable.cut()
        await made.sentence(Phase.WAITING)
        clock.time += drive_rest.SILENCE_TIMEOUT
        await made.connected()
        await arrived()
        assert client.publish("/cmd_vel", Twist.planar(0.2, 0.0), stamp=math.nan)
        assert [twist["linear"]["x"] for twist in (await heard.reach(2))[:2]] == [0.3, 0.2]


async def test_rest_is_sent_into_a_socket_that_is_stuck_but_not_into_one_that_is_full():
    async with server() as robot, wire(robot.port) as cable, link(url(cable)) as made:
        client = await made.connected()
        cable.freeze()
        sent = [client.publish("/cmd_vel", Twist(), even_late=True) for _ in range(200_000)]
        assert sent[0]
        assert not sent[-1]


async def test_a_link_on_which_nothing_came_for_a_second_says_so():
    clock = Clock()
    async with server() as robot, wire(robot.port) as cable, link(url(cable), now=clock) as made:
        client = await made.connected()
        assert not client.late
        cable.freeze()
        await arrived()
        clock.time += 1.1
        assert client.late
        cable.thaw()
        await until(lambda: not client.late)


async def test_a_link_that_is_given_up_is_late_until_its_state_says_so():
    clock, seen = Clock(), []
    async with server() as robot, wire(robot.port) as cable, link(url(cable), now=clock) as made:
        client = await made.connected()
        cable.freeze()
        await arrived()
        clock.time += 3.1
        while client.state.phase is Phase.CONNECTED:
            seen.append(client.late)
            await asyncio.sleep(0)
        assert set(seen) == {True}
        assert not client.late


class Socket:
    """A socket whose system tells how often it sent something again."""

    def __init__(self, retransmits: int) -> None:
        self.info = struct.pack("8B", 1, 0, retransmits, 0, 0, 0, 0, 0)

    def getsockopt(self, level: int, option: int, size: int) -> bytes:
        assert (level, option, size) == (socket.IPPROTO_TCP, socket.TCP_INFO, 8)
        return self.info


@pytest.mark.skipif(not hasattr(socket, "TCP_INFO"), reason="this system does not tell")
async def test_nothing_is_published_while_the_system_sends_again_what_was_not_acknowledged():
    async with server() as robot, link(url(robot)) as made:
        client = await made.connected()
        connected = client._connection
        for retransmits, sent in ((0, True), (1, False), (7, False)):
            connected._socket, real = Socket(retransmits), connected._socket
            assert client.publish("/cmd_vel", Twist()) is sent
            assert client.publish("/cmd_vel", Twist(), even_late=True)
            connected._socket = real


@pytest.mark.skipif(not hasattr(socket, "TCP_INFO"), reason="this system does not tell")
def test_a_healthy_socket_sends_nothing_again():
    with socket.create_server(("127.0.0.1", 0)) as listening:
        with socket.create_connection(listening.getsockname()) as sock:
            assert not connection._sent_again(sock)
        assert not connection._sent_again(sock)  # closed: nobody can tell
