"""A robot by mDNS, found by the handheld's own browser and by another program's."""

from __future__ import annotations

import asyncio
import random
import uuid
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

import pytest
from zeroconf import IPVersion
from zeroconf.asyncio import AsyncServiceInfo, AsyncZeroconf

from app.discovery.mdns_browser import MdnsBrowser
from bridge.discovery.interfaces import LOOPBACK, Interface
from bridge.discovery.mdns import SERVICE_TYPE
from robotside.serving.mdns_advert import MdnsAdvert
from tests.bridge.wires import Record

pytestmark = pytest.mark.slow


def own(name: str) -> str:
    """A name that no other run on this network has."""
    return f"{name} {uuid.uuid4().hex[:12]}"


def own_port() -> int:
    """A port to announce, at which nothing need listen."""
    return random.randrange(1024, 65536)


@asynccontextmanager
async def announced(name: str, port: int) -> AsyncIterator[MdnsAdvert]:
    advert = MdnsAdvert(name, "127.0.0.1", lambda: port)
    running = asyncio.create_task(advert.run())
    async with asyncio.timeout(60):
        await advert.announced.wait()
    try:
        yield advert
    finally:
        await advert.close()
        await running


@asynccontextmanager
async def browsing(found: Record) -> AsyncIterator[None]:
    running = asyncio.create_task(MdnsBrowser(found).run())
    try:
        yield
    finally:
        running.cancel()
        await asyncio.wait({running})


async def test_a_robot_is_found_with_its_address_and_port():
    found, port = Record(), own_port()
    async with announced(own("Patrol 1 in the yard"), port), browsing(found):
        await found.until(lambda seen: f"ws://127.0.0.1:{port}" in seen)


async def test_two_robots_of_one_name_are_both_found():
    found, twin, port, other = Record(), own("Twin"), own_port(), own_port()
    async with announced(twin, port), announced(twin, other), browsing(found):
        await found.until(lambda seen: {f"ws://127.0.0.1:{port}", f"ws://127.0.0.1:{other}"} <= set(seen))


async def test_a_robot_that_ends_says_so():
    gone = own("Gone")
    zone = AsyncZeroconf(interfaces=["127.0.0.1"], ip_version=IPVersion.V4Only)
    try:
        async with announced(gone, own_port()):
            info = AsyncServiceInfo(SERVICE_TYPE, f"{gone}.{SERVICE_TYPE}")
            assert await info.async_request(zone.zeroconf, 10_000)
        again = AsyncServiceInfo(SERVICE_TYPE, f"{gone}.{SERVICE_TYPE}")
        assert not await again.async_request(zone.zeroconf, 300)
    finally:
        await zone.async_close()


async def test_without_a_network_the_robot_goes_on_and_nothing_is_left():
    before = asyncio.all_tasks()
    advert = MdnsAdvert(own("Lonely"), "192.0.2.1", lambda: 1)
    await asyncio.wait_for(advert.run(), 60)
    await advert.close()
    assert asyncio.all_tasks() <= before


def test_on_all_interfaces_it_is_announced_to_others_and_on_this_machine_where_there_are_none():
    net = Interface("10.1.2.3", "10.1.2.255")
    assert MdnsAdvert("A", "0.0.0.0", lambda: 1, networks=lambda: [LOOPBACK, net])._addresses() == [
        "10.1.2.3"
    ]
    assert MdnsAdvert("A", "0.0.0.0", lambda: 1, networks=lambda: [LOOPBACK])._addresses() == ["127.0.0.1"]
    assert MdnsAdvert("A", "localhost", lambda: 1)._addresses() == ["127.0.0.1"]


async def test_an_advert_that_is_closed_before_its_first_turn_ends():
    advert = MdnsAdvert(own("Early"), "127.0.0.1", own_port)
    running = asyncio.create_task(advert.run())
    await advert.close()
    async with asyncio.timeout(5.0):
        await running
    assert not advert.announced.is_set()
