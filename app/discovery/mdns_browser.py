"""Finds the addresses of robots by mDNS, where the library for it is installed; who is there is then asked at them."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Callable
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from bridge.core.address import at_port
from bridge.core.async_tasks import cancel_all
from bridge.discovery.interfaces import interfaces
from bridge.discovery.mdns import SERVICE_TYPE

if TYPE_CHECKING:
    from zeroconf.asyncio import AsyncZeroconf

__all__ = ["MAX_LOOKING", "MdnsBrowser"]

log = logging.getLogger(__name__)

MAX_LOOKING = 16
"""So many robots are looked up at a time; of more nothing is taken in."""
LOOK_UP_TIMEOUT = 2.0
"""For the address of one of them [s]."""


class MdnsBrowser:
    """Looks for robots until it is cancelled. Anybody can announce anything, so it finds addresses to ask at, and no more."""

    def __init__(self, found: Callable[[str], None]) -> None:
        """`found(url)` is called with `ws://ADDRESS:PORT` of each."""
        self._found = found
        self._looking: set[asyncio.Task[None]] = set()

    async def run(self) -> None:
        """Look; returns at once where the library is not installed, or the network cannot do it."""
        if find_spec("zeroconf") is None:
            return
        from zeroconf import IPVersion
        from zeroconf.asyncio import AsyncServiceBrowser, AsyncZeroconf

        try:
            zone = AsyncZeroconf(
                interfaces=[each.address for each in interfaces()], ip_version=IPVersion.V4Only
            )
        except OSError as fault:
            log.info("no mDNS here: %s", fault.strerror or fault)
            return
        browser = AsyncServiceBrowser(zone.zeroconf, SERVICE_TYPE, handlers=[self._handler(zone)])
        try:
            await asyncio.Event().wait()
        finally:
            await cancel_all(self._looking)
            await asyncio.shield(browser.async_cancel())
            await asyncio.shield(zone.async_close())

    def _handler(self, zone: AsyncZeroconf) -> Callable[..., None]:
        from zeroconf import ServiceStateChange

        def on_change(name: str, state_change: ServiceStateChange, **_: Any) -> None:
            if state_change is not ServiceStateChange.Removed and len(self._looking) < MAX_LOOKING:
                task = asyncio.create_task(self._look_up(zone, name))
                self._looking.add(task)
                task.add_done_callback(self._looking.discard)

        return on_change

    async def _look_up(self, zone: AsyncZeroconf, name: str) -> None:
        from zeroconf.asyncio import AsyncServiceInfo

        with contextlib.suppress(OSError, ValueError):
            info = AsyncServiceInfo(SERVICE_TYPE, name)
            if await info.async_request(zone.zeroconf, LOOK_UP_TIMEOUT * 1000) and info.port:
                for address in info.parsed_addresses()[:4]:
                    self._found(f"ws://{at_port(address, info.port)}")
