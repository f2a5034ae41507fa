"""Robots say hello, handhelds hear it."""

from __future__ import annotations

import asyncio
import socket

import pytest

from bridge.codec import from_json, to_json
from bridge.core.errors import BridgeError
from bridge.discovery.beacon import Beacon, Hello, Listener, named
from bridge.discovery.interfaces import LOOPBACK as THIS_MACHINE
from bridge.discovery.interfaces import Interface, broadcast_addresses
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
    heard, batteries = Record(), iter(n / 1024 for n in range(1000))
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
    assert [hello.battery for hello, _ in heard[:3]] == [0 / 1024, 1 / 1024, 2 / 1024]
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


async def test_what_was_closed_before_its_first_turn_says_nothing_and_ends():
    asked = []
    beacon = Beacon(lambda: asked.append(1) or PATROL, addresses=lambda: LOOPBACK)
    running = asyncio.create_task(beacon.run())
    await beacon.close()
    async with asyncio.timeout(5.0):
        await running
    assert asked == []


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


# where it is announced


class Wire:
    """What leaves this machine: by which interface, to whom, and what it says."""

    def __init__(self, monkeypatch):
        self.sent = []
        wire = self

        class Sock:
            def __enter__(self):
                return self

            def __exit__(self, *_):
                return None

            def setblocking(self, _):
                pass

            def setsockopt(self, *_):
                pass

            def bind(self, address):
                self.bound = address[0]

            def sendto(self, datagram, to):
                wire.sent.append((self.bound, to[0], from_json(datagram, Hello)))

        monkeypatch.setattr("bridge.discovery.beacon.socket.socket", lambda *_: Sock())


LAN, VPN = Interface("10.0.0.3", "10.0.0.255"), Interface("172.16.0.9", "172.16.0.255")
SECURE = Hello(name="Patrol-1", url="wss://10.0.0.3:9090", http="https://10.0.0.3:8080")


async def announced(monkeypatch, host, hello=SECURE):
    """(interface, to, url, http) of one round."""
    wire = Wire(monkeypatch)
    beacon = Beacon(lambda: hello, host=host, networks=lambda: [THIS_MACHINE, LAN, VPN])
    beacon._send(hello, await beacon._ways())
    return [(bound, to, said.url, said.http) for bound, to, said in wire.sent]


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "127.0.0.2", "::1"])
async def test_a_robot_of_this_machine_alone_is_announced_on_loopback_only(monkeypatch, host):
    hello = Hello(name="Patrol-1", url=f"ws://{host}:9090")
    assert await announced(monkeypatch, host, hello) == [("", "127.255.255.255", f"ws://{host}:9090", "")]


async def test_a_robot_at_one_address_is_announced_by_that_interface_under_that_address(monkeypatch):
    assert await announced(monkeypatch, "172.16.0.9") == [
        ("172.16.0.9", "172.16.0.255", "wss://172.16.0.9:9090", "https://172.16.0.9:8080")
    ]


async def test_an_address_that_no_interface_is_known_for_is_announced_from_there(monkeypatch):
    assert [way[:3] for way in await announced(monkeypatch, "10.9.9.9")] == [
        ("10.9.9.9", "255.255.255.255", "wss://10.9.9.9:9090")
    ]


@pytest.mark.parametrize("host", ["", "0.0.0.0", "::"])
async def test_a_robot_on_every_interface_names_its_address_of_each_and_is_plain_on_loopback(
    monkeypatch, host
):
    assert await announced(monkeypatch, host) == [
        ("127.0.0.1", "127.255.255.255", "ws://127.0.0.1:9090", "http://127.0.0.1:8080"),
        ("10.0.0.3", "10.0.0.255", "wss://10.0.0.3:9090", "https://10.0.0.3:8080"),
        ("172.16.0.9", "172.16.0.255", "wss://172.16.0.9:9090", "https://172.16.0.9:8080"),
    ]


def test_a_robot_without_a_web_page_names_none():
    assert named(PATROL, "10.0.0.9") == Hello(
        name="Patrol-1", kind="wheels", url="ws://10.0.0.9:9090", battery=0.75, boot="b1"
    )


async def test_datagrams_of_strangers_are_counted_and_make_one_log_line(caplog):
    caplog.set_level("INFO", "bridge.discovery.beacon")
    heard = Record()
    listener = Listener(heard, port=0, host="127.0.0.1")
    await listener.start()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        for datagram in (b'{"name":"a","url":"ws://[x"}', b"no hello", b"x" * 5000, to_json(PATROL)):
            sock.sendto(datagram, ("127.0.0.1", listener.port))
    await heard.reach(1)
    assert (listener.refused, [hello for hello, _ in heard]) == (3, [PATROL])
    lines = [record.getMessage() for record in caplog.records if record.name == "bridge.discovery.beacon"]
    assert len(lines) == 1
    assert lines[0].startswith("1 datagrams were no HELLO; the last, from 127.0.0.1: url is as in")
    await listener.close()
