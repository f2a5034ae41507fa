"""The web server of one robot."""

from __future__ import annotations

import asyncio
import logging
import socket
import ssl
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import uvicorn
from starlette.routing import Route

from bridge.core.errors import BridgeError
from bridge.server.reception.log_limit import STRANGERS
from bridge.server.reception.pages import PagePolicy
from bridge.server.reception.reception import Reception, anyone
from robotside.door.station_door import StationDoor
from robotside.gateways.addresses import listening_socket, url
from robotside.gateways.http.browser_connection import LIMITS, BrowserConnection
from robotside.gateways.http.camera_streams import CameraStreams
from robotside.gateways.http.doorkeeper import Doorkeeper
from robotside.gateways.http.mounts import Mounts
from robotside.gateways.http.sessions import Sessions
from robotside.gateways.http.usage_pages import NOTHING_BESIDE, Usage
from robotside.gateways.http.web_site import site
from robotside.gateways.plain.standstills import Standstills
from robotside.gateways.scaling.picture_scaling import PictureScaler
from robotside.trust.pairing import Pairing

__all__ = ["HttpGateway"]

log = logging.getLogger(__name__)


class HttpGateway:
    """A `Gateway`: the robot's page, STOP, health and camera pictures at `http://HOST:PORT`."""

    def __init__(
        self,
        door: StationDoor,
        host: str,
        port: int,
        pictures: PictureScaler,
        rosbridge_url: Callable[[], str],
        *,
        stamps: Callable[[], float] | None = None,
        tls: ssl.SSLContext | None = None,
        plain_from: Callable[[str], bool] = anyone,
        pages: PagePolicy | None = None,
        stop_from_pages: bool = True,
        pairing: Pairing | None = None,
        mounts: Mounts | None = None,
        usage: Usage = NOTHING_BESIDE,
    ) -> None:
        """Port 0 takes a free one. The page names `rosbridge_url` to programs. `stamps` is the clock of the pictures' stamps [s],
        the door's when left out.

        With `tls` browsers may come encrypted, on the same port; `plain_from(host)` says who may come without, for more than
        STOP.
        `pages` may speak to the robot, by default its own; `stop_from_pages` as of `Doorkeeper`, `pairing` and `usage` as of `site`.
        `mounts` are the applications of others on the site.
        """
        self._host, self._is_secure = host, tls is not None
        self.port = port
        """Where it listens; 0 until one was taken."""
        allowed = pages or PagePolicy(web_port=lambda: self.port)
        self.cameras = CameraStreams(door, pictures, stamps or door.now)
        """Who looks, and how late the pictures are."""
        own = site(door, rosbridge_url, self.cameras, Sessions(door, allowed), pairing, usage)
        self.mounts = mounts or Mounts(lambda: self.endpoints()["http"])
        """The applications of others on the site."""
        self.mounts.reserve(route.path for route in own.routes if isinstance(route, Route))
        self._standstills = Standstills()
        self.site = Doorkeeper(
            own,
            door,
            allowed,
            self.mounts,
            stop_from_pages=stop_from_pages,
            plain_from=plain_from,
            standstills=self._standstills,
        )
        """The ASGI application."""
        self._reception = Reception(LIMITS, tls=tls)
        self._socket: socket.socket | None = None
        self._server: uvicorn.Server | None = None
        self._serving: asyncio.Task[None] | None = None

    async def start(self) -> None:
        """Begin to listen. BridgeError with one sentence when that is not possible."""
        try:
            self._socket = listening_socket(self._host, self.port)
        except OSError as error:
            why = (error.strerror or str(error)).lower()
            where = f"{self._host}:{self.port}"
            raise BridgeError(
                f"Cannot serve HTTP on {where}: {why}; --http-port names another port."
            ) from error
        self.port = self._socket.getsockname()[1]
        config = uvicorn.Config(
            self.site,
            http=self._connection,  # type: ignore[arg-type]  # it is only called
            ws="none",
            log_level="warning",
            lifespan="off",
            access_log=False,
        )
        logging.getLogger("uvicorn.error").addFilter(STRANGERS)  # a line for each request that is none
        self._server = _WebServer(config)
        self._serving = asyncio.create_task(self._server.serve([self._socket]))
        self._serving.add_done_callback(_log_fault)
        self._standstills.start()

    async def stop(self) -> None:
        """End all connections and stop listening; nothing is left running."""
        self.mounts.close()
        self._standstills.stop()
        if self._server is not None and self._serving is not None:
            self._server.should_exit = True
            await self._reception.close()
            await asyncio.wait({self._serving})
        await self.cameras.close()
        if self._socket is not None:
            self._socket.close()

    def _connection(self, *args: Any, **options: Any) -> asyncio.Protocol:
        return self._reception.front(BrowserConnection(*args, **options))

    def endpoints(self) -> Mapping[str, str]:
        """The URL of the page; `https` where others reach it and it speaks TLS."""
        return {"http": url("http", self._host, self.port, tls=self._is_secure)}


class _WebServer(uvicorn.Server):
    """A web server in a loop whose owner handles the signals."""

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Leave the process's signals alone."""
        yield


def _log_fault(serving: asyncio.Task[None]) -> None:
    """A web server that fails leaves the robot to the other gateways."""
    if not serving.cancelled() and serving.exception() is not None:
        log.error("The web server failed", exc_info=serving.exception())
