"""Callbacks: messages of a subscription sent to the client's own service, by the address that it asked from and by no other.

A robot that posts to any URL would be a way into networks that its client does not reach. So the URL names the client's own
address in figures (or `localhost` on the robot's own machine): nothing is resolved, no redirection is followed, and of the
answer its status counts alone.
"""

from __future__ import annotations

import asyncio
import ipaddress
import logging
import ssl
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from urllib.parse import urlsplit

import h11

from bridge.core.address import at_port
from bridge.core.async_tasks import cancel_all
from bridge.core.errors import BridgeError, Refused
from bridge.core.robot_catalogue import Operator
from robotside.gateways.soap.subscriptions import News, Subscribed

__all__ = ["LIFETIME", "MAX_TRIES", "POST_TIMEOUT", "Callbacks", "Target", "post", "target_of"]

log = logging.getLogger(__name__)

LIFETIME = 600.0
"""A subscription with a callback ends when it was not renewed for this long [s]."""
POST_TIMEOUT = 5.0
"""For the client to take one callback [s]."""
MAX_TRIES = 3
"""So often a callback is tried; then its subscription ends."""
RETRY_PERIOD = 1.0
"""Before the second try; twice as long before each further one [s]."""
_IDLE_WAIT = 60.0
"""Between two looks where nothing comes [s]."""

_Address = ipaddress.IPv4Address | ipaddress.IPv6Address


@dataclass(frozen=True, slots=True)
class Target:
    """Where a callback goes."""

    address: str
    """In figures; the only thing that is connected to."""
    port: int
    host: str
    """As the client wrote it, with the port."""
    path: str
    """With the query."""
    secure: bool


def target_of(url: str, operator: Operator) -> Target:
    """The target of a callback URL that `operator` gave; raises Refused for one that is not at its own address."""
    own = _figures(operator.address.rpartition(":")[0].strip("[]"))
    try:
        parts = urlsplit(url)
        port = parts.port or (443 if parts.scheme == "https" else 80)
    except ValueError as error:
        raise Refused(f"A callback URL is written as http://ADDRESS:PORT/PATH ({error}).") from error
    if (
        parts.scheme not in ("http", "https")
        or parts.username is not None
        or not parts.hostname
        or not _is_plain(url)
    ):
        raise Refused("A callback URL is written as http://ADDRESS:PORT/PATH, without credentials.")
    named = _figures(parts.hostname)
    is_own = named == own or (parts.hostname == "localhost" and own is not None and own.is_loopback)
    if own is None or not is_own:
        raise Refused(
            f"A callback goes to the address that the client asks from, {own or 'which is not known'}, not to {parts.hostname[:80]!r}."
        )
    path = (parts.path or "/") + (f"?{parts.query}" if parts.query else "")
    return Target(str(own), port, at_port(parts.hostname, port), path, parts.scheme == "https")


def _figures(host: str) -> _Address | None:
    """The address in figures; None for a name."""
    try:
        address = ipaddress.ip_address(host.partition("%")[0])
    except ValueError:
        return None
    return getattr(address, "ipv4_mapped", None) or address


def _is_plain(url: str) -> bool:
    return url.isascii() and all(" " < letter != "\x7f" for letter in url)


async def post(target: Target, body: bytes, action: str) -> None:
    """Send one callback. BridgeError with one sentence when it is not taken within `POST_TIMEOUT`."""
    try:
        async with asyncio.timeout(POST_TIMEOUT):
            status = await _status(target, body, action)
    except (OSError, TimeoutError, h11.ProtocolError) as error:
        why = getattr(error, "strerror", None) or str(error) or "no answer in time"
        raise BridgeError(f"The callback was not taken: {why}.") from error
    if not 200 <= status < 300:
        raise BridgeError(f"The callback was answered with HTTP status {status}.")


async def _status(target: Target, body: bytes, action: str) -> int:
    tls = ssl.create_default_context() if target.secure else None
    name = target.host.rpartition(":")[0].strip("[]") if target.secure else None
    reader, writer = await asyncio.open_connection(target.address, target.port, ssl=tls, server_hostname=name)
    try:
        talk = h11.Connection(h11.CLIENT)
        headers = [
            ("Host", target.host),
            ("Content-Type", "text/xml; charset=utf-8"),
            ("SOAPAction", f'"{action}"'),
            ("Content-Length", str(len(body))),
            ("Connection", "close"),
        ]
        head = h11.Request(method="POST", target=target.path, headers=headers)
        for event in (head, h11.Data(data=body), h11.EndOfMessage()):
            writer.write(talk.send(event) or b"")
        await writer.drain()
        while True:
            told = talk.next_event()
            if told is h11.NEED_DATA:
                talk.receive_data(await reader.read(4096))
            elif isinstance(told, h11.Response):
                return told.status_code
            elif not isinstance(told, h11.InformationalResponse):
                raise BridgeError("The callback was answered with nothing.")
    finally:
        writer.transport.abort()


class Callbacks:
    """The callbacks of all subscriptions that have one."""

    def __init__(
        self,
        written: Callable[[Subscribed, list[News]], tuple[bytes, str]],
        on_given_up: Callable[[Subscribed, str], None],
    ) -> None:
        """`written` makes the body and the SOAPAction of one; `on_given_up` is told of each that nobody takes, and why."""
        self._written, self._on_given_up = written, on_given_up
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self._ending: set[asyncio.Task[None]] = set()

    def begin(self, subscribed: Subscribed, target: Target) -> None:
        """Send what comes."""
        self._tasks[subscribed.id] = asyncio.create_task(self._run(subscribed, target))

    def end(self, subscribed: Subscribed) -> None:
        """Send nothing more."""
        task = self._tasks.pop(subscribed.id, None)
        if task is not None and task is not asyncio.current_task():
            self._ending.add(task)
            task.add_done_callback(self._ending.discard)
            task.cancel()

    async def close(self) -> None:
        """End all of them."""
        tasks = [*self._tasks.values(), *self._ending]
        self._tasks.clear()
        await cancel_all(tasks)

    async def _run(self, subscribed: Subscribed, target: Target) -> None:
        try:
            while True:
                news = await subscribed.news(_IDLE_WAIT)
                if news:
                    subscribed.check()
                    await self._send(target, *self._written(subscribed, news))
        except BridgeError as error:
            self._on_given_up(subscribed, str(error))
        except Exception as error:
            log.exception("A callback to %s failed", target.host)
            self._on_given_up(subscribed, str(error))

    async def _send(self, target: Target, body: bytes, action: str) -> None:
        for number in range(1, MAX_TRIES):
            with suppress(BridgeError):
                await post(target, body, action)
                return
            await asyncio.sleep(RETRY_PERIOD * 2 ** (number - 1))
        await post(target, body, action)
