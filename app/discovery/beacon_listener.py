"""Listens for robots that say HELLO and measures how far they are, in the network thread."""

from __future__ import annotations

import asyncio
import concurrent.futures
import logging
import math
import socket
from collections.abc import Callable, Iterable, Iterator
from urllib.parse import urlsplit

from app.device import sees_broadcasts
from app.discovery.known_robots import Entry
from app.link.feeds import Mailbox
from bridge.core.network_thread import NetworkThread
from bridge.discovery.beacon import Hello, Listener

__all__ = ["HELLO", "LATENCY", "BeaconListener"]

log = logging.getLogger(__name__)

HELLO, LATENCY = "hello ", "latency "
"""Channels of the mailbox, each followed by the robot's url: a `Hello`; `(url, seconds)`."""
MEASURE_PERIOD = 3.0
"""Between two measurements of one robot [s]."""
MEASURE_TIMEOUT = 1.0
"""How long one measurement may take [s]."""


class BeaconListener:
    """Fills the mailbox with what is heard."""

    def __init__(self, mailbox: Mailbox, network: NetworkThread, *, now: Callable[[], float]) -> None:
        """`now` is our clock [s]."""
        self._mailbox, self._network, self._now = mailbox, network, now
        self._targets: dict[str, tuple[str, int]] = {}
        self._http: dict[str, str] = {}
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
        """Go on measuring these robots, where it is known how."""
        wanted = {entry.url for entry in entries if entry.state == "live"}
        self._targets = {url: place for url, place in self._places() if url in wanted}

    def _places(self) -> Iterator[tuple[str, tuple[str, int]]]:
        for url, http in list(self._http.items()):
            parts = urlsplit(http)
            if parts.hostname and parts.port:
                yield url, (parts.hostname, parts.port)

    async def _run(self) -> None:
        listener = Listener(self._hear)
        try:
            with sees_broadcasts():
                await listener.start()
                while True:
                    await asyncio.gather(
                        *(self._measure(url, *place) for url, place in self._targets.items())
                    )
                    await asyncio.sleep(MEASURE_PERIOD)
        except OSError as error:
            log.warning("cannot listen for robots: %s", error)
        finally:
            await listener.close()

    def _hear(self, hello: Hello, address: object) -> None:
        self._http[hello.url] = hello.http
        self._mailbox.post(f"{HELLO}{hello.url}", hello, self._now())

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
