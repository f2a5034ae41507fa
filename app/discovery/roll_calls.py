"""Asks who is there at saved addresses, and at those found by mDNS: across subnets and past some switches no HELLO comes."""

from __future__ import annotations

import asyncio
import math
import ssl
from collections.abc import Callable, Iterable
from functools import partial
from urllib.parse import urlsplit

import msgspec

from app.discovery.known_robots import Entry
from bridge.core.address import LinkLost, at_port, host_and_port, look_up
from bridge.core.async_tasks import cancel_all
from bridge.core.errors import ProtocolError
from bridge.discovery.hello import Hello
from bridge.discovery.roll import MAX_ROLL, PATH, read_roll
from widgets.core.language import tr

__all__ = ["ASK_PERIOD", "FOUND_TIME", "HEARD_TIME", "MAX_AT_ONCE", "MAX_FOUND", "RollCalls"]

ASK_PERIOD = 1.0
"""Between two questions at one address [s]."""
ASK_TIMEOUT = 1.0
"""How long one may take, from the connection to the last byte [s]."""
UNKNOWN_PERIOD = 10.0
"""Between two questions for the address of a host that is unknown [s]."""
HEARD_TIME = 2.0
"""A robot of which a HELLO came by itself is not asked for so long [s]."""
FOUND_TIME = 60.0
"""An address that somebody announced is asked for so long without an answer [s]."""
MAX_FOUND = 32
"""So many of them are asked."""
MAX_AT_ONCE = 8
"""So many addresses are asked at the same time."""
_STEP = 0.25
"""Between two looks whose turn it is [s]."""
_MAX_ANSWER = MAX_ROLL + 4096


class _NeedsTls(Exception):
    """Whoever answers speaks by TLS only."""


class RollCalls:
    """The addresses to ask, whose turn it is, and what they answer."""

    def __init__(
        self, hear: Callable[[Hello, tuple[str, int]], None], now: Callable[[], float], domain: str = ""
    ) -> None:
        """`hear(hello, (host, port))` is called for each robot that is there; `now` is our clock [s].

        At addresses that were only found, robots of other discovery domains than `domain` are left out; who is at an
        address that somebody saved is wanted.
        """
        self._hear, self._now, self._domain = hear, now, domain
        self._saved: tuple[str, ...] = ()
        self._found: dict[str, float] = {}
        """Addresses that were found, with when each answered last, or was found [s]."""
        self._asked: dict[str, float] = {}
        """When each address was asked last [s]."""
        self._heard: dict[str, float] = {}
        """When each robot said HELLO by itself [s]."""
        self._asking: dict[str, asyncio.Task[None]] = {}
        self._numeric: dict[str, str] = {}
        """Address of each host, by the URL."""
        self._by_tls: set[str] = set()
        self._tls: ssl.SSLContext | None = None

    def wants(self, entries: Iterable[Entry]) -> None:
        """Ask at the addresses of `entries` that are saved, and no others. Any thread may call it."""
        self._saved = tuple(one.url for one in entries if one.saved)

    def add(self, url: str) -> None:
        """Somebody announced this address: ask there too, until nobody has answered for `FOUND_TIME`. No room, no asking."""
        if url not in self._found and len(self._found) < MAX_FOUND:
            self._found[url] = self._now()

    def note(self, url: str) -> None:
        """The robot at `url` has said HELLO by itself."""
        if url in self._saved or url in self._found:
            self._heard[url] = self._now()

    async def run(self) -> None:
        """Ask, until it is cancelled."""
        try:
            while True:
                for url in self.due():
                    self._asking[url] = task = asyncio.create_task(self._ask(url))
                    task.add_done_callback(partial(self._answered, url))
                await asyncio.sleep(_STEP)
        finally:
            await cancel_all(list(self._asking.values()))

    def due(self) -> list[str]:
        """The addresses to be asked now; they count as asked from then on."""
        now = self._now()
        self._found = {url: at for url, at in self._found.items() if now - at < FOUND_TIME}
        saved = dict.fromkeys((*self._saved, *self._found))
        for kept in (self._asked, self._heard, self._numeric):
            for url in set(kept) - set(saved):
                del kept[url]
        self._by_tls &= set(saved)
        waiting = [
            url
            for url in sorted(saved, key=lambda url: self._asked.get(url, -math.inf))
            if url not in self._asking
            and now - self._asked.get(url, -math.inf) >= ASK_PERIOD
            and now - self._heard.get(url, -math.inf) >= HEARD_TIME
        ]
        chosen = waiting[: MAX_AT_ONCE - len(self._asking)]
        self._asked.update(dict.fromkeys(chosen, now))
        return chosen

    def _answered(self, url: str, _: asyncio.Task[None]) -> None:
        del self._asking[url]

    async def _ask(self, url: str) -> None:
        """Ask at one address; silence, and anything that is no answer, is silence."""
        try:
            host, port = host_and_port(url)
            async with asyncio.timeout(ASK_TIMEOUT):
                where = await self._look_up(url, host)
                hellos = read_roll(await self._fetch(url, where, port), host)
        except _NeedsTls:
            self._by_tls.add(url)
            return
        except (LinkLost, OSError, TimeoutError, ProtocolError):
            self._by_tls.discard(url)  # another robot may be there by now
            self._numeric.pop(url, None)
            return
        if url in self._found:
            self._found[url] = self._now()
        for hello in hellos:
            if url not in self._saved and hello.domain != self._domain:
                continue
            is_asked = urlsplit(hello.url).port == port
            # as it is saved
            self._hear(msgspec.structs.replace(hello, url=url) if is_asked else hello, (where, port))

    async def _look_up(self, url: str, host: str) -> str:
        """The numeric address of a host; one that has none now is asked for seldom, as each question may hold a thread for long."""
        if url not in self._numeric:
            self._asked[url] = self._now() + UNKNOWN_PERIOD - ASK_PERIOD
            self._numeric[url] = await look_up(host, ASK_TIMEOUT)
            self._asked[url] -= UNKNOWN_PERIOD - ASK_PERIOD
        return self._numeric[url]

    async def _fetch(self, url: str, host: str, port: int) -> bytes:
        """What is answered to a GET. It tells nothing that a HELLO does not tell to all, so nobody has to prove who he is."""
        secure = url.startswith("wss:") or url in self._by_tls
        reader, writer = await asyncio.open_connection(host, port, ssl=self._unproven() if secure else None)
        try:
            writer.write(
                f"GET {PATH} HTTP/1.1\r\nHost: {at_port(host, port)}\r\nConnection: close\r\n\r\n".encode()
            )
            answer = b""
            while len(answer) <= _MAX_ANSWER and (more := await reader.read(_MAX_ANSWER)):
                answer += more
        finally:
            writer.transport.abort()
        head, _, body = answer.partition(b"\r\n\r\n")
        status = head.split(b" ", 2)[1:2]
        if status == [b"426"] and not secure:
            raise _NeedsTls
        if status != [b"200"]:
            raise ProtocolError(tr("No list of robots is there."))
        return body

    def _unproven(self) -> ssl.SSLContext:
        if self._tls is None:
            self._tls = ssl.create_default_context()
            self._tls.check_hostname = False
            self._tls.verify_mode = ssl.CERT_NONE
        return self._tls
