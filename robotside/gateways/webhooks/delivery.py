"""One delivery: a POST to a web server, its answer's status, nothing followed and nothing kept."""

from __future__ import annotations

import asyncio
import hashlib
import hmac
import ssl
from collections.abc import Mapping

import h11

from bridge.core.address import look_up
from bridge.core.errors import BridgeError
from robotside.gateways.webhooks.targets import Asker, Target, check_address

__all__ = ["TIMEOUT", "Undelivered", "deliver", "signature"]

TIMEOUT = 5.0
"""For one try, from the name's address to the answer's status [s]."""
MAX_ANSWER = 16384
"""Bytes of an answer that are read to find its status."""


class Undelivered(Exception):
    """It did not arrive, or was not taken; the text says why, as part of a sentence."""


def signature(secret: str, time: str, body: bytes) -> str:
    """Proves the sender and the time: HMAC-SHA256, by the secret, of the time, a dot and the body, in hexadecimal."""
    return hmac.new(secret.encode(), time.encode() + b"." + body, hashlib.sha256).hexdigest()


async def deliver(target: Target, asker: Asker, headers: Mapping[str, str], body: bytes) -> None:
    """Post `body`; raises Undelivered unless the server took it (2xx)."""
    try:
        async with asyncio.timeout(TIMEOUT):
            status = await _post(target, asker, headers, body)
    except TimeoutError as error:
        raise Undelivered(f"no answer within {TIMEOUT:g} s") from error
    except (OSError, h11.ProtocolError, BridgeError, ValueError) as error:
        raise Undelivered(
            (getattr(error, "strerror", None) or str(error)).rstrip(".") or type(error).__name__
        ) from error
    if not 200 <= status < 300:
        raise Undelivered(f"its answer was {status}")


async def _post(target: Target, asker: Asker, headers: Mapping[str, str], body: bytes) -> int:
    """The status of the answer."""
    address = await look_up(target.host, TIMEOUT)
    check_address(address, asker)  # of this moment: a name may lead elsewhere than when it was given
    context = ssl.create_default_context() if target.secure else None
    name = target.host if target.secure else None
    reader, writer = await asyncio.open_connection(address, target.port, ssl=context, server_hostname=name)
    try:
        connection = h11.Connection(h11.CLIENT, max_incomplete_event_size=MAX_ANSWER)
        host = target.shown.partition("://")[2]
        found = {"Host": host, "Content-Length": str(len(body)), "Connection": "close", **headers}
        request = h11.Request(method="POST", target=target.path, headers=list(found.items()))
        for event in (request, h11.Data(data=body), h11.EndOfMessage()):
            writer.write(connection.send(event) or b"")
        await writer.drain()
        return await _status(connection, reader)
    finally:
        writer.transport.abort()


async def _status(connection: h11.Connection, reader: asyncio.StreamReader) -> int:
    while True:
        event = connection.next_event()
        if isinstance(event, h11.Response):
            return event.status_code
        if event is h11.NEED_DATA:
            connection.receive_data(await reader.read(4096))
        elif isinstance(event, h11.ConnectionClosed):
            raise Undelivered("it closed the connection without an answer")
