"""Addresses, names and reasons."""

from __future__ import annotations

import errno
import socket

import pytest

from bridge.core import address
from bridge.core.address import BadAddress, at_port, cause, host_and_port, look_up


@pytest.mark.parametrize(
    ("url", "found"),
    [
        ("ws://10.0.0.3:9090", ("10.0.0.3", 9090)),
        ("ws://robot.local:9090/camera/front", ("robot.local", 9090)),
        ("ws://robot", ("robot", 80)),
        ("wss://robot", ("robot", 443)),
        ("ws://[::1]:9090", ("::1", 9090)),
    ],
)
def test_an_address_is_taken_apart(url, found):
    assert host_and_port(url) == found


@pytest.mark.parametrize(
    "url", ["", "robot", "http://robot:9090", "ws://", "ws://robot:70000", "ws://robot:0", "ws://[::1:9090"]
)
def test_what_is_no_address_is_told_how_one_looks(url):
    with pytest.raises(BadAddress, match="The address must be like ws://192.168.1.7:9090, not"):
        host_and_port(url)


async def test_a_numeric_address_needs_no_lookup(monkeypatch):
    monkeypatch.setattr(address, "_resolved", None)
    assert await look_up("10.0.0.3", 1.0) == "10.0.0.3"
    assert await look_up("::1", 1.0) == "::1"


async def test_the_older_kind_of_address_comes_first_where_a_name_has_both(monkeypatch):
    both = [
        (socket.AF_INET6, socket.SOCK_STREAM, 6, "", ("::1", 0, 0, 0)),
        (socket.AF_INET, socket.SOCK_STREAM, 6, "", ("127.0.0.1", 0)),
    ]
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_, **__: both)
    assert await look_up("robot.local", 1.0) == "127.0.0.1"


async def test_a_name_that_nobody_knows_is_an_error(monkeypatch):
    def fail(*_, **__):
        raise socket.gaierror(socket.EAI_NONAME, "unknown")

    monkeypatch.setattr(socket, "getaddrinfo", fail)
    with pytest.raises(socket.gaierror):
        await look_up("nobody.invalid", 1.0)


async def test_a_name_that_no_name_can_be_is_an_error():
    with pytest.raises(socket.gaierror):
        await look_up("x" * 70 + ".local", 5.0)


async def test_a_lookup_that_hangs_is_given_up(monkeypatch):
    import threading

    release = threading.Event()
    monkeypatch.setattr(address, "_resolved", lambda _: release.wait(5.0) and "10.0.0.1")
    with pytest.raises(socket.gaierror, match="no answer"):
        await look_up("slow.local", 0.01)
    release.set()


def test_reasons_are_plain_words():
    assert cause(ConnectionRefusedError(errno.ECONNREFUSED, "x")) == "connection refused"
    assert cause(OSError(errno.EHOSTUNREACH, "x")) == "no route to host"
    assert cause(OSError("strange")) == "strange"


@pytest.mark.parametrize(("host", "said"), [("10.0.0.7", "10.0.0.7:9090"), ("fe80::1", "[fe80::1]:9090")])
def test_a_host_and_its_port_are_written_as_they_are_read(host, said):
    assert at_port(host, 9090) == said
    assert host_and_port(f"ws://{said}") == (host, 9090)
