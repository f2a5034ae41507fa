"""Listens for robots that say HELLO, asks at saved addresses, and measures how far they are, in the network thread."""

from __future__ import annotations

import asyncio
import concurrent.futures
import logging
import math
import socket
from collections.abc import Callable, Iterable

from app.device.wifi import sees_broadcasts
from app.discovery.hello_inbox import HeardHello, HelloInbox
from app.discovery.known_robots import Entry
from app.discovery.mdns_browser import MdnsBrowser
from app.discovery.probes import ADDRESS_PERIOD, ProbeSchedule
from app.discovery.roll_calls import RollCalls
from app.link.feeds import Mailbox
from bridge.core.errors import BridgeError
from bridge.core.network_thread import NetworkThread
from bridge.discovery.beacon import Listener
from bridge.discovery.domain import discovery_domain
from bridge.discovery.hello import Hello

__all__ = ["HELLO", "LATENCY", "BeaconListener"]

log = logging.getLogger(__name__)

HELLO, LATENCY = "hello", "latency "
"""Channels of the mailbox: the `HelloInbox` in which some wait; followed by the robot's url, `(url, seconds)`."""
BROWSE_DELAY = 4.0
"""Without any robot for so long, mDNS is tried [s]."""
MEASURE_TIMEOUT = 1.0
"""How long one measurement may take [s]."""


class BeaconListener:
    """Fills the mailbox with what is heard."""

    def __init__(self, mailbox: Mailbox, network: NetworkThread, *, now: Callable[[], float]) -> None:
        """`now` is our clock [s]."""
        self._mailbox, self._network, self._now = mailbox, network, now
        self._inbox, self._probes = HelloInbox(), ProbeSchedule()
        self._domain = discovery_domain()
        self._calls = RollCalls(self._take, now, self._domain)
        self._last = now()
        """When the last robot was heard [s]."""
        self._running: concurrent.futures.Future[None] | None = None

    def start(self) -> None:
        """Begin to listen and to measure."""
        self._running = self._network.start(self._run())

    def close(self) -> None:
        """Stop listening; returns when the port is free."""
        if self._running is not None:
            self._running.cancel()
            concurrent.futures.wait([self._running], 1.0)
            self._running = None

    def measure(self, entries: Iterable[Entry]) -> None:
        """These robots are listed: go on hearing them and, where it is known how, measuring."""
        listed = list(entries)
        self._inbox.expect(entry.url for entry in listed)
        self._probes.wants(listed)
        self._calls.wants(listed)

    async def _run(self) -> None:
        listener = Listener(self._hear, domain=self._domain)
        try:
            with sees_broadcasts():
                await self._listen(listener)
                await asyncio.gather(self._calls.run(), self._measure_all(), self._browse())
        finally:
            await listener.close()

    async def _listen(self, listener: Listener) -> None:
        try:
            await listener.start()
        except (OSError, BridgeError) as error:
            log.warning("cannot listen for robots: %s", error)

    async def _browse(self) -> None:
        """Look by mDNS too, once no robot was heard for so long that broadcasts may not come through; it costs memory."""
        left = BROWSE_DELAY
        while left > 0:
            await asyncio.sleep(left)
            left = BROWSE_DELAY - (self._now() - self._last)
        await MdnsBrowser(self._calls.add).run()

    async def _measure_all(self) -> None:
        while True:
            await asyncio.gather(*(self._measure(*one) for one in self._probes.due(self._now())))
            await asyncio.sleep(ADDRESS_PERIOD)

    def _hear(self, hello: Hello, address: tuple[str, int]) -> None:
        self._calls.note(hello.url)
        self._take(hello, address)

    def _take(self, hello: Hello, address: tuple[str, int]) -> None:
        now = self._last = self._now()
        self._inbox.put(HeardHello(hello, address[0], now))
        self._mailbox.post(HELLO, self._inbox, now)

    async def _measure(self, url: str, host: str, port: int) -> None:
        """The time that a connection to its web server takes is one round trip."""
        loop = asyncio.get_running_loop()
        before, latency = self._now(), math.nan
        with socket.socket() as plug:
            plug.setblocking(False)
            try:
                async with asyncio.timeout(MEASURE_TIMEOUT):
                    await loop.sock_connect(plug, (host, port))
                latency = self._now() - before
            except (OSError, TimeoutError):
                pass
        self._mailbox.post(f"{LATENCY}{url}", (url, latency), self._now())
