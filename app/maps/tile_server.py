"""Asks a tile server for one tile: what it answers is a picture, or one sentence of what is wrong with it.

server = TileServer()
server.fetch(address, (17, 38740, 46860))
server.close()

The sentences name the host and never the address, which may hold a key.
"""

from __future__ import annotations

import contextlib
import logging
import socket
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from email.utils import parsedate_to_datetime
from typing import Any

from kivy.core.image import ImageData

from app.maps.tile_address import TileAddress
from app.maps.tile_store import Stored
from widgets.core.language import tr
from widgets.map.tiles.tile_reader import Key, decoded

__all__ = ["AGENT", "MAX_CONNECTIONS", "MAX_TILE_BYTES", "NoAnswer", "Tile", "TileServer"]

AGENT = "Pilothouse/0.1 (map of a robot's operator)"
"""By what tile servers know the app, as their terms ask."""
MAX_CONNECTIONS = 2
"""At a time, to one server: what public ones ask for."""
MAX_TILE_BYTES = 2_000_000
"""Of one tile's file."""
MAX_REDIRECTS = 4
CONNECT_TIMEOUT, READ_TIMEOUT, WHOLE_TIMEOUT = 5.0, 8.0, 15.0
"""To reach the server, to hear anything more from it, and for a tile in all [s]."""
PIECE = 16384
LEAST_LIFE, USUAL_LIFE, GREATEST_LIFE = 3600.0, 7 * 86400.0, 90 * 86400.0
"""How long a tile is good without asking again [s]: at least, where the server does not say, and at most."""
MAX_PAUSE = 600.0
"""Longest time that a server has itself left alone by Retry-After [s]."""
REFUSED_PAUSE = 300.0
"""How long a server that refuses is left alone [s]."""


class NoAnswer(Exception):
    """No tile came, for a reason that is one sentence for people."""

    def __init__(self, sentence: str, pause: float = 0.0) -> None:
        super().__init__(sentence)
        self.pause = pause
        """How long the server asks to be left alone [s]; 0 for as long as usual."""


@dataclass(frozen=True, slots=True)
class Tile:
    """What a server answered."""

    stored: Stored
    """To be kept."""
    picture: ImageData | None
    """Its pixels; None where the server has no such tile, or has it unchanged."""
    unchanged: bool = False
    """What was kept of it is still good."""


class TileServer:
    """Connections to servers, all of which `close` ends, whatever they wait for. `fetch` may be called from any thread."""

    def __init__(
        self,
        decode: Callable[[object], ImageData] = decoded,
        now: Callable[[], float] = time.time,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """`now` is the system's clock, by which tiles expire; `clock` the one that measures how long an answer takes."""
        self._decode, self._now, self._clock = decode, now, clock
        self._lock = threading.Lock()
        self._pool: Any = None
        self._sockets: set[socket.socket] = set()
        self._closed = False

    def fetch(self, address: TileAddress, tile: Key, kept: Stored | None = None) -> Tile:
        """Ask for one tile, with `kept` only for one that is newer; NoAnswer where none comes. Blocks for up to 20 s."""
        import urllib3

        headers = {"User-Agent": AGENT, "Accept": "image/webp,image/png,image/jpeg"}
        if kept is not None and kept.etag:
            headers["If-None-Match"] = kept.etag
        if kept is not None and kept.modified:
            headers["If-Modified-Since"] = kept.modified
        host = address.host
        try:
            answer = self._connections().request(
                "GET", address.url(tile), headers=headers, preload_content=False, redirect=True
            )
            try:
                return self._judge(answer, kept, host)
            finally:
                answer.drain_conn() if answer.status in (204, 304) else answer.close()
        except urllib3.exceptions.HTTPError as fault:
            raise NoAnswer(_why(fault, host)) from None  # its own words hold the address
        except (OSError, ValueError):
            raise NoAnswer(tr("The map server {host} does not answer.").format(host=host)) from None

    def close(self) -> None:
        """End every connection; who waits for one gets NoAnswer at once."""
        with self._lock:
            self._closed = True
            sockets, self._sockets = self._sockets, set()
            pool, self._pool = self._pool, None
        for each in sockets:
            with contextlib.suppress(OSError):
                each.shutdown(socket.SHUT_RDWR)
        if pool is not None:
            pool.clear()

    def _connections(self) -> Any:
        with self._lock:
            if self._closed:
                raise NoAnswer(tr("The map is closed."))
            if self._pool is None:
                self._pool = _pool(self._own)
            return self._pool

    def _own(self, opened: socket.socket) -> None:
        with self._lock:
            self._sockets = {one for one in self._sockets if one.fileno() >= 0}
            if not self._closed:
                self._sockets.add(opened)
                return
        opened.close()

    def _judge(self, answer: Any, kept: Stored | None, host: str) -> Tile:
        status, headers = answer.status, answer.headers
        if status == 304 and kept is not None:
            return Tile(
                Stored(kept.data, kept.etag, kept.modified, self._expiry(headers)), None, unchanged=True
            )
        if status in (204, 404, 410):
            return Tile(Stored(None, expires=self._expiry(headers)), None)
        if status in (429, 503):
            raise NoAnswer(
                tr("The map server {host} asks to be left alone for a while ({status}).").format(
                    host=host, status=status
                ),
                _retry_after(headers, self._now()),
            )
        if status in (401, 403):
            raise NoAnswer(
                tr("The map server {host} refuses ({status}): its key or its terms.").format(
                    host=host, status=status
                ),
                REFUSED_PAUSE,
            )
        if status != 200:
            raise NoAnswer(
                tr("The map server {host} has a fault ({status}).").format(host=host, status=status)
            )
        data = self._body(answer, host)
        try:
            picture = self._decode(data)
        except Exception:  # noqa: BLE001 - decoders raise what they like at a damaged picture
            kind = headers.get("Content-Type", "").split(";")[0][:40] or "?"
            raise NoAnswer(
                tr("The map server {host} sends what is no picture ({kind}).").format(host=host, kind=kind)
            ) from None
        stored = Stored(
            data, headers.get("ETag", "")[:200], headers.get("Last-Modified", "")[:60], self._expiry(headers)
        )
        return Tile(stored, picture)

    def _body(self, answer: Any, host: str) -> bytes:
        """Everything, unless it is too much or comes too slowly."""
        end, pieces, size = self._clock() + WHOLE_TIMEOUT, list[bytes](), 0
        while piece := answer.read1(PIECE, decode_content=True):
            pieces.append(piece)
            size += len(piece)
            if size > MAX_TILE_BYTES:
                raise NoAnswer(
                    tr("The map server {host} sends tiles of more than {size} MB.").format(
                        host=host, size=MAX_TILE_BYTES // 1_000_000
                    )
                )
            if self._clock() > end:
                raise NoAnswer(tr("The map server {host} is too slow.").format(host=host))
        return b"".join(pieces)

    def _expiry(self, headers: Mapping[str, str]) -> float:
        now = self._now()
        life = USUAL_LIFE
        for part in headers.get("Cache-Control", "").lower().split(","):
            name, _, value = part.strip().partition("=")
            if name == "max-age" and value.isdecimal() and len(value) < 12:
                return now + min(max(float(value), LEAST_LIFE), GREATEST_LIFE)
            if name in ("no-cache", "no-store"):
                return now + LEAST_LIFE
        with contextlib.suppress(ValueError, TypeError, OverflowError):
            life = parsedate_to_datetime(headers.get("Expires", "")).timestamp() - now
        return now + min(max(life, LEAST_LIFE), GREATEST_LIFE)


def _pool(own: Callable[[socket.socket], None]) -> Any:
    """urllib3's, whose every socket is told to `own`."""
    import certifi
    import urllib3

    logging.getLogger("urllib3").setLevel(logging.ERROR)  # its words hold whole addresses
    pool = urllib3.PoolManager(
        num_pools=4,
        maxsize=MAX_CONNECTIONS,
        block=True,
        timeout=urllib3.Timeout(connect=CONNECT_TIMEOUT, read=READ_TIMEOUT),
        retries=urllib3.Retry(
            MAX_REDIRECTS, connect=0, read=0, status=0, other=0, redirect=MAX_REDIRECTS,
            respect_retry_after_header=False,
        ),
        ca_certs=certifi.where(),
    )  # fmt: skip
    pool.pool_classes_by_scheme = _pools(own)
    return pool


def _pools(own: Callable[[socket.socket], None]) -> dict[str, Any]:
    from urllib3.connection import HTTPConnection, HTTPSConnection
    from urllib3.connectionpool import HTTPConnectionPool, HTTPSConnectionPool

    class Plain(HTTPConnection):
        def connect(self) -> None:
            super().connect()
            own(self.sock)

    class Secure(HTTPSConnection):
        def connect(self) -> None:
            super().connect()
            own(self.sock)

    class PlainPool(HTTPConnectionPool):
        ConnectionCls = Plain

    class SecurePool(HTTPSConnectionPool):
        ConnectionCls = Secure

    return {"http": PlainPool, "https": SecurePool}


def _why(fault: Exception, host: str) -> str:
    """A sentence about what went wrong, without the words of the fault, which hold the address."""
    import urllib3

    reason = getattr(fault, "reason", None)
    kinds = (fault, reason)
    if isinstance(reason, urllib3.exceptions.ResponseError):
        return tr("The map server {host} sends one from address to address without end.").format(host=host)
    if any(isinstance(one, urllib3.exceptions.SSLError) for one in kinds):
        return tr("The map server {host} has no certificate that this device trusts.").format(host=host)
    if any(isinstance(one, urllib3.exceptions.NameResolutionError) for one in kinds):
        return tr("There is no map server {host}, or no way to it.").format(host=host)
    if any(isinstance(one, urllib3.exceptions.ReadTimeoutError) for one in kinds):
        return tr("The map server {host} is too slow.").format(host=host)
    if any(
        isinstance(one, urllib3.exceptions.ProtocolError | urllib3.exceptions.DecodeError) for one in kinds
    ):
        return tr("The map server {host} breaks off in the middle of a tile.").format(host=host)
    return tr("The map server {host} does not answer.").format(host=host)


def _retry_after(headers: Mapping[str, str], now: float) -> float:
    text = headers.get("Retry-After", "")
    if text.isdecimal() and len(text) < 12:
        return min(float(text), MAX_PAUSE)
    with contextlib.suppress(ValueError, TypeError, OverflowError):
        return min(max(parsedate_to_datetime(text).timestamp() - now, 0.0), MAX_PAUSE)
    return 0.0
