"""The client against a real server, a bad wire and things that are no robot."""

from __future__ import annotations

import asyncio
import math
import random
import socket

import pytest

from bridge.client import client as module
from bridge.client import heartbeat
from bridge.client.client import BridgeClient, Phase
from bridge.core.errors import NoReply, NotConnected, ProtocolError, Refused
from bridge.msgs import Msg
from bridge.msgs.arrays import Float32Array
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse, RobotInfo
from bridge.msgs.sensor_msgs import LaserScan
from tests.bridge.wires import Clock, Link, Record, link, server, service, url, wire


@pytest.fixture(autouse=True)
def quick_pings(monkeypatch):
    monkeypatch.setattr(heartbeat, "PING_PERIOD", 0.02)


async def settled(client):
    """The server has heard everything that was sent before."""
    await client.call("/rosapi/nodes", None, CommandResponse)


async def test_a_link_goes_from_connecting_to_connected_to_closed():
    async with server() as robot:
        async with link(url(robot)) as made:
            await made.states.until(lambda _: made.client.state.phase is Phase.CONNECTED)
        place = f"127.0.0.1:{robot.port}"
        assert [(state.phase, state.sentence, state.attempt) for state in made.states] == [
            (Phase.CONNECTING, f"Connecting to {place}.", 1),
            (Phase.CONNECTED, f"Connected to {place}.", 0),
            (Phase.CLOSED, "Not connected.", 0),
        ]


async def test_messages_arrive_typed_with_the_time_of_their_arrival():
    heard = Record()
    async with server() as robot, link(url(robot), now=Clock(5.0)) as made:
        made.client.subscribe("/odom", Odometry, heard)
        client = await made.connected()
        await settled(client)
        robot.publish("/odom", Odometry(child_frame_id="base_link"))
        assert await heard.reach(1) == [(Odometry(child_frame_id="base_link"), 5.0)]


async def test_what_comes_of_each_topic_is_counted_with_its_size():
    heard = Record()
    async with server() as robot, link(url(robot), now=Clock(5.0)) as made:
        made.client.subscribe("/odom", Odometry, heard)
        client = await made.connected()
        await settled(client)
        assert "/odom" not in client.traffic.read()
        robot.publish("/odom", Odometry(child_frame_id="base_link"))
        await heard.reach(1)
        first = client.traffic.read()["/odom"]
        robot.publish("/odom", Odometry(child_frame_id="x" * 1000))
        await heard.reach(2)
        second = client.traffic.read()["/odom"]
    assert (first.messages, second.messages, second.received) == (1, 2, 5.0)
    assert second.size - 2 * first.size == pytest.approx(1000 - len("base_link"))


async def test_infinities_survive_in_cbor():
    heard = Record()
    async with server() as robot, link(url(robot)) as made:
        client = await made.connected()
        client.subscribe("/scan", LaserScan, heard, compression="cbor")
        await settled(client)
        robot.publish("/scan", LaserScan(ranges=Float32Array([math.inf, 2.0])))
        await heard.reach(1)
        assert list(heard[0][0].ranges) == [math.inf, 2.0]


async def test_a_latched_topic_arrives_on_subscribing_and_after_unsubscribing_nothing():
    heard = Record()
    async with server() as robot, link(url(robot)) as made:
        robot.publish("/robot/info", RobotInfo(name="Patrol-1"))
        client = await made.connected()
        unsubscribe = client.subscribe("/robot/info", RobotInfo, heard)
        await heard.reach(1)
        unsubscribe()
        unsubscribe()
        await settled(client)
        robot.publish("/robot/info", RobotInfo(name="other"))
        await settled(client)
        assert [msg.name for msg, _ in heard] == ["Patrol-1"]


async def test_two_who_subscribe_to_one_topic_both_hear_it_once():
    first, second = Record(), Record()
    async with server() as robot, link(url(robot)) as made:
        client = await made.connected()
        client.subscribe("/odom", Odometry, first)
        unsubscribe = client.subscribe("/odom", Odometry, second)
        await settled(client)
        robot.publish("/odom", Odometry())
        await second.reach(1)
        unsubscribe()
        await settled(client)
        robot.publish("/odom", Odometry())
        await first.reach(2)
        await settled(client)
        assert (len(first), len(second)) == (2, 1)


async def test_a_callback_that_fails_costs_neither_the_link_nor_the_others(caplog):
    heard = Record()

    def broken(*_):
        raise ZeroDivisionError

    async with server() as robot, link(url(robot)) as made:
        client = await made.connected()
        client.subscribe("/odom", Odometry, broken)
        client.subscribe("/odom", Odometry, heard)
        await settled(client)
        robot.publish("/odom", Odometry())
        await heard.reach(1)
    assert "ZeroDivisionError" in caplog.text


async def test_a_command_arrives_with_its_stamp():
    heard = Record()
    async with server(on_message=heard) as robot, link(url(robot)) as made:
        client = await made.connected()
        client.advertise("/cmd_vel", Twist)
        assert client.publish("/cmd_vel", Twist.planar(0.5, 0.1), stamp=12.5)
        assert (await heard.reach(1))[0][1:] == ("/cmd_vel", Twist.planar(0.5, 0.1), 12.5)


async def test_what_is_published_without_a_connection_is_dropped_and_never_sent_later():
    heard = Record()
    async with server(on_message=heard) as robot:
        made = Link(url(robot))
        assert not made.client.publish("/cmd_vel", Twist.planar(1.0, 0.0))
        await made.states.reach(1)
        assert not made.client.publish("/cmd_vel", Twist.planar(2.0, 0.0))
        client = await made.connected()
        assert client.publish("/cmd_vel", Twist.planar(3.0, 0.0))
        await heard.reach(1)
        await client.close()
        await made.running
        assert not client.publish("/cmd_vel", Twist.planar(4.0, 0.0))
        assert [msg.linear.x for _, _, msg, _ in heard] == [3.0]


async def test_what_is_published_into_a_stuck_socket_is_dropped():
    heard = Record()
    async with server(on_message=heard) as robot, wire(robot.port) as cable, link(url(cable)) as made:
        client = await made.connected()
        cable.freeze()
        sent = [client.publish("/cmd_vel", Twist()) for _ in range(200_000)]
        assert sent[0]
        assert not sent[-1]


async def test_a_call_is_answered():
    async with server() as robot, link(url(robot)) as made:
        client = await made.connected()
        answer = await client.call("/stop", CommandRequest(command_id="c1"), CommandResponse)
        assert answer == CommandResponse(success=True, message="Accepted c1.")


async def test_a_refusal_is_raised_with_the_robots_sentence():
    async def refuse(session, request):
        raise Refused("The battery is too low.")

    async with server(services=[service("/stop", refuse)]) as robot, link(url(robot)) as made:
        client = await made.connected()
        with pytest.raises(Refused, match="^The battery is too low.$"):
            await client.call("/stop", None, CommandResponse)
        with pytest.raises(Refused, match='This robot has no service "/dance"'):
            await client.call("/dance", None, CommandResponse)


async def test_no_answer_in_time_is_no_reply():
    async def never(session, request):
        await asyncio.Event().wait()

    async with server(services=[service("/stop", never)]) as robot, link(url(robot)) as made:
        client = await made.connected()
        with pytest.raises(NoReply, match=r"The robot did not answer /stop within 0.01 s\."):
            await client.call("/stop", None, CommandResponse, timeout=0.01)


async def test_an_answer_of_another_kind_is_a_protocol_error():
    async with server() as robot, link(url(robot)) as made:
        client = await made.connected()
        with pytest.raises(ProtocolError, match="message must be true or false, not"):
            await client.call("/stop", None, Otherwise)


class Otherwise(Msg, frozen=True, gc=False):
    message: bool = False


async def test_a_call_without_a_connection_fails_at_once():
    with pytest.raises(NotConnected, match="There is no connection to 127.0.0.1:1"):
        await BridgeClient("ws://127.0.0.1:1").call("/stop", None, CommandResponse)


async def test_a_call_whose_connection_is_cut_fails_at_once():
    begun = Record()

    async def never(session, request):
        begun(session)
        await asyncio.Event().wait()

    async with (
        server(services=[service("/stop", never)]) as robot,
        wire(robot.port) as cable,
        link(url(cable)) as made,
    ):
        client = await made.connected()
        calling = asyncio.create_task(client.call("/stop", None, CommandResponse, timeout=60))
        await begun.reach(1)
        cable.cut()
        with pytest.raises(NotConnected, match="The connection was cut before the robot answered /stop"):
            await calling


async def test_the_robots_clock_is_known_from_the_first_answer_on():
    ours, robots = Clock(5.0), Clock(1_700_000_000.0)
    async with server(now=robots) as robot, link(url(robot), now=ours) as made:
        assert math.isnan(made.client.robot_time())
        client = await made.connected()
        assert (client.rtt, client.lost) == (0.0, 0)
        assert client.offset == pytest.approx(1_700_000_000.0 - 5.0)
        ours.time = 6.0
        assert client.robot_time() == pytest.approx(1_700_000_001.0)


async def test_a_cut_link_is_told_and_taken_up_again_with_all_subscriptions():
    heard, gone = Record(), Record()
    async with server(on_gone=gone) as robot, wire(robot.port) as cable, link(url(cable)) as made:
        robot.publish("/robot/info", RobotInfo(name="Patrol-1"))
        made.client.subscribe("/robot/info", RobotInfo, heard)
        await made.connected()
        await heard.reach(1)
        cable.cut()
        await made.states.reach(1)
        sentence = f"The connection to 127.0.0.1:{cable.port} was cut."
        assert (made.states[0].phase, made.states[0].sentence) == (Phase.WAITING, sentence)
        assert made.states[0].attempt == 0
        assert made.states[0].retry_in <= 0.01
        await made.connected()
        await heard.reach(2)
        assert len(await gone.reach(1)) == 1
        assert len(robot.operators) == 1


async def test_a_robot_that_starts_again_is_found_again():
    heard = Record()
    async with server() as robot:
        port = robot.port
        made = Link(url(robot))
        made.client.subscribe("/robot/info", RobotInfo, heard)
        await made.connected()
    sentence = await made.sentence(Phase.WAITING)
    assert sentence == f"The connection to 127.0.0.1:{port} was cut."
    async with server(port=port) as robot:
        robot.publish("/robot/info", RobotInfo(name="again"))
        await heard.reach(1)
        await made.client.close()
        await made.running


async def test_a_frozen_link_is_lost_after_three_seconds_of_silence():
    clock = Clock()
    async with server() as robot, wire(robot.port) as cable, link(url(cable), now=clock) as made:
        await made.connected()
        cable.freeze()
        clock.time += 3.1
        assert await made.sentence(Phase.WAITING) == f"Nothing came from 127.0.0.1:{cable.port} for 3 s."


async def test_a_link_that_never_stays_waits_longer_each_time():
    async with link("ws://127.0.0.1:1", backoff=(0.001, 0.004), rng=random.Random(1)) as made:
        states = await made.states.until(lambda seen: sum(s.phase is Phase.WAITING for s in seen) >= 6)
    waits = [state for state in states if state.phase is Phase.WAITING]
    longest = [min(0.004, 0.001 * 1.25**n) for n in range(6)]
    assert [state.attempt for state in waits][:6] == [1, 2, 3, 4, 5, 6]
    assert all(0.8 * top <= state.retry_in <= top for state, top in zip(waits, longest, strict=False))


async def test_waiting_is_half_a_second_at_first_and_five_at_most():
    client = BridgeClient("ws://127.0.0.1:1", rng=random.Random(3))
    waits = [client.wait_before(attempt) for attempt in range(1, 2000)]
    assert 0.4 <= waits[0] <= 0.5
    assert all(4.0 <= wait <= 5.0 for wait in waits[11:])


async def test_nobody_listening_is_one_sentence():
    async with link("ws://127.0.0.1:1") as made:
        expected = "No robot answers at 127.0.0.1:1 (connection refused)."
        assert await made.sentence(Phase.WAITING) == expected
        again = await made.sentence(Phase.CONNECTING)
        assert again == f"{expected} Trying again."


@pytest.mark.parametrize("address", ["robot", "http://10.0.0.3", "ws://10.0.0.3:99999", ""])
async def test_an_address_that_can_never_work_ends_the_link_with_its_sentence(address):
    states = Record()
    client = BridgeClient(address, on_state=states)
    await client.run()
    assert client.state.phase is Phase.CLOSED
    assert client.state.sentence.startswith("The address must be like ws://192.168.1.7:9090, not")
    await client.close()


async def test_an_unknown_name_is_one_sentence(monkeypatch):
    def unknown(*_, **__):
        raise socket.gaierror(socket.EAI_NONAME, "unknown")

    monkeypatch.setattr(socket, "getaddrinfo", unknown)
    async with link("ws://patrol.invalid:9090") as made:
        sentence = await made.sentence(Phase.WAITING)
        assert sentence == "No machine called patrol.invalid is known on this network."


async def test_a_machine_that_does_not_reply_is_one_sentence(monkeypatch):
    monkeypatch.setattr(module, "OPEN_TIMEOUT", 0.02)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        port = silent.getsockname()[1]
        async with link(f"ws://127.0.0.1:{port}") as made:
            sentence = await made.sentence(Phase.WAITING)
            assert sentence == f"No robot answers at 127.0.0.1:{port} (no reply within 0.02 s)."


async def test_closing_is_quick_while_connecting():
    with socket.create_server(("127.0.0.1", 0)) as silent:
        made = Link(f"ws://127.0.0.1:{silent.getsockname()[1]}")
        await made.states.reach(1)
        await closes_quickly(made)


async def test_closing_is_quick_while_waiting():
    made = Link("ws://127.0.0.1:1", backoff=(60.0, 60.0))
    await made.sentence(Phase.WAITING)
    await closes_quickly(made)


async def test_closing_is_quick_on_a_frozen_link_with_a_full_socket():
    async with server() as robot, wire(robot.port) as cable:
        made = Link(url(cable))
        client = await made.connected()
        cable.freeze()
        for _ in range(100):  # until the kernel takes no more either
            while client.publish("/cmd_vel", Twist()):
                pass
            await asyncio.sleep(0)
        await closes_quickly(made)


async def closes_quickly(made):
    clock = asyncio.get_running_loop().time
    began = clock()
    await made.client.close()
    await made.running
    assert clock() - began < 0.3
    assert made.client.state.phase is Phase.CLOSED


async def test_a_client_whose_owner_is_cancelled_ends_with_it():
    async with server() as robot:
        made = Link(url(robot))
        await made.connected()
        made.running.cancel()
        with pytest.raises(asyncio.CancelledError):
            await made.running
        assert not made.client.publish("/cmd_vel", Twist())


async def test_a_closed_client_does_not_run():
    client = BridgeClient("ws://127.0.0.1:1")
    await client.close()
    await client.run()
    assert client.state.phase is Phase.CLOSED


async def test_a_fault_in_who_is_told_the_state_does_not_stop_the_link(caplog):
    phases = Record()

    def broken(state):
        phases(state.phase)
        raise ZeroDivisionError

    async with server() as robot:
        client = BridgeClient(url(robot), on_state=broken)
        running = asyncio.create_task(client.run())
        await phases.until(lambda seen: Phase.CONNECTED in seen)
        await client.close()
        await running
    assert "ZeroDivisionError" in caplog.text
