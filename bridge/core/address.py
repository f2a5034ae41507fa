"""Addresses of robots: parsing, name look-up, and plain reasons for failed connections."""

from __future__ import annotations

import asyncio
import contextlib
import errno
import ipaddress
import os
import socket
import threading
from urllib.parse import urlsplit

from bridge.core.link_state import LinkFault

__all__ = [
    "BadAddress",
    "LinkLost",
    "NotAccepted",
    "NotProtected",
    "WrongKey",
    "cause",
    "at_port",
    "host_and_port",
    "look_up",
]


class LinkLost(Exception):
    """There is no usable connection; the text gives the reason."""

    fault = LinkFault.NONE
    """What programs decide by."""


class BadAddress(LinkLost):
    """The address can never work, so that another attempt makes no sense."""


class WrongKey(LinkLost):
    """The machine that answers does not have the robot's key; nothing was sent to it."""

    fault = LinkFault.WRONG_KEY


class NotAccepted(LinkLost):
    """The robot does not know this client's token any more."""

    fault = LinkFault.NOT_ACCEPTED


class NotProtected(LinkLost):
    """The robot is reached by TLS only; another attempt without it makes no sense."""

    fault = LinkFault.NOT_PROTECTED


def at_port(host: str, port: int) -> str:
    """Both as a URL has them: an IPv6 address stands in brackets."""
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"


def host_and_port(url: str) -> tuple[str, int]:
    """The two parts of `ws://HOST:PORT/...`, port 80 (wss: 443) by default; BadAddress for anything else."""
    try:
        parts = urlsplit(url)
        port = (443 if parts.scheme == "wss" else 80) if parts.port is None else parts.port
    except ValueError as error:
        raise BadAddress(f"The address must be like ws://192.168.1.7:9090, not {url!r} ({error}).") from error
    if parts.scheme not in ("ws", "wss") or not parts.hostname or not port:
        raise BadAddress(f"The address must be like ws://192.168.1.7:9090, not {url!r}.")
    return parts.hostname, port


async def look_up(host: str, timeout: float) -> str:
    """The numeric address of `host`, IPv4 where it has both; OSError when it is unknown within `timeout` [s].

    The look-up runs in a thread that is not waited for, because it cannot be cancelled.
    """
    with contextlib.suppress(ValueError):
        return str(ipaddress.ip_address(host))
    loop = asyncio.get_running_loop()
    found: asyncio.Future[str] = loop.create_future()

    def ask() -> None:
        try:
            answer: str | OSError = _resolved(host)
        except OSError as error:
            answer = error
        with contextlib.suppress(RuntimeError):  # the loop is closed: the answer is no longer needed
            loop.call_soon_threadsafe(_settle, found, answer)

    threading.Thread(target=ask, name=f"look up {host}", daemon=True).start()
    try:
        async with asyncio.timeout(timeout):
            return await found
    except TimeoutError as error:
        raise socket.gaierror(socket.EAI_AGAIN, "no answer") from error


def cause(error: OSError) -> str:
    """The reason of a failed connection in a few plain words."""
    if error.errno == errno.ECONNREFUSED:
        return "connection refused"
    return os.strerror(error.errno).lower() if error.errno else str(error)


def _resolved(host: str) -> str:
    try:
        found = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)
    except UnicodeError as error:
        raise socket.gaierror(socket.EAI_NONAME, str(error)) from error
    return str(min(found, key=lambda entry: entry[0] != socket.AF_INET)[4][0])


def _settle(found: asyncio.Future[str], answer: str | OSError) -> None:
    if found.done():
        return
    if isinstance(answer, OSError):
        found.set_exception(answer)
    else:
        found.set_result(answer)
