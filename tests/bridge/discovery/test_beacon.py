"""Robots say hello, handhelds hear it."""

from __future__ import annotations

import asyncio
import socket

import pytest

from bridge.codec import to_json
from bridge.core.errors import BridgeError
from bridge.discovery.beacon import Beacon, Hello, Listener, broadcast_addresses
from tests.bridge.wires import Record

PATROL = Hello(name="Patrol-1", kind="wheels", url="ws://10.0.0.3:9090", battery=0.75, boot="b1")
LOOPBACK = ("127.255.255.255",)


async def test_a_hello_reaches_every_listener_of_the_machine():
    first, second = Record(), Record()
    one = Listener(first)
    one.port = 0
    await one.start()
    other = Listener(second, port=one.port)
    await other.start()
    beacon = Beacon(lambda: PATROL, port=one.port, addresses=lambda: LOOPBACK, period=0.01)
    running = asyncio.create_task(beacon.run())
    for record in (first, second):
        hello, (host, port) = (await record.reach(2))[0]
        assert hello == PATROL
        assert host.startswith("127.")
        assert port > 0
    await beacon.close()
    await running
    await one.close()
    await other.close()


async def test_a_hello_is_asked_for_anew_each_time():
    heard, batteries = Record(), iter(range(1000))
    listener = Listener(heard, port=0)
    await listener.start()
    beacon = Beacon(
        lambda: Hello(name="a", url="ws://b", battery=next(batteries)),
        port=listener.port,
        addresses=lambda: LOOPBACK,
        period=0.001,
    )
    running = asyncio.create_task(beacon.run())
    await heard.reach(3)
    assert [hello.battery for hello, _ in heard[:3]] == [0.0, 1.0, 2.0]
    await beacon.close()
    await running
    await listener.close()


@pytest.mark.parametrize(
    "bad", [b"", b"hello", b"\xff" * 100, b"[]", b'{"name":5}', b"{}", b'{"name":"no url"}']
)
async def test_a_bad_datagram_is_passed_over(bad):
    heard = Record()
    listener = Listener(heard, port=0, host="127.0.0.1")
    await listener.start()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        for datagram in (bad, to_json(PATROL)):
            sock.sendto(datagram, ("127.0.0.1", listener.port))
    await heard.reach(1)
    assert [hello for hello, _ in heard] == [PATROL]
    await listener.close()


async def test_a_network_that_is_down_does_not_stop_the_beacon():
    heard = Record()
    listener = Listener(heard, port=0)
    await listener.start()
    beacon = Beacon(
        lambda: PATROL, port=listener.port, addresses=lambda: ("256.0.0.1", *LOOPBACK), period=0.001
    )
    running = asyncio.create_task(beacon.run())
    await heard.reach(2)
    running.cancel()
    with pytest.raises(asyncio.CancelledError):
        await running
    await listener.close()


async def test_a_port_that_may_not_be_used_is_one_sentence():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        sock.bind(("", 0))
        with pytest.raises(BridgeError, match="Cannot listen for robots on port"):
            await Listener(print, port=sock.getsockname()[1]).start()


async def test_what_was_never_started_closes_too():
    await Listener(print).close()
    await Beacon(lambda: PATROL).close()


def test_loopback_is_always_among_the_addresses_and_none_is_empty():
    found = broadcast_addresses()
    assert "127.255.255.255" in found
    assert "0.0.0.0" not in found


async def test_a_network_that_fails_silences_the_beacon_for_a_while_and_ends_nothing(caplog):
    heard, answers = Record(), iter([OSError(24, "Too many open files"), OSError(24, "again"), LOOPBACK])

    def addresses():
        answer = next(answers, LOOPBACK)
        if isinstance(answer, OSError):
            raise answer
        return answer

    listener = Listener(heard, port=0)
    await listener.start()
    beacon = Beacon(lambda: PATROL, port=listener.port, addresses=addresses, period=0.001)
    running = asyncio.create_task(beacon.run())
    await heard.reach(1)
    assert [record.message for record in caplog.records if record.name == "bridge.discovery.beacon"] == [
        "cannot say hello on the network: Too many open files"
    ]
    await beacon.close()
    await running
    await listener.close()
