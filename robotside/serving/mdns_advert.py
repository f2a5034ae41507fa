"""A robot by mDNS (DNS-SD), for networks that pass on no broadcast: where it is, to be asked there who it is.

A robot that is killed stays in the caches of others until its entry is too old, so nobody should tell by this that it is there.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import re
import socket
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from bridge.core.async_tasks import UntilClosed
from bridge.discovery.beacon import EVERYWHERE
from bridge.discovery.hello import is_loopback
from bridge.discovery.interfaces import LOOPBACK, Interface, interfaces
from bridge.discovery.mdns import SERVICE_TYPE
from bridge.discovery.network_changes import SystemNetwork

if TYPE_CHECKING:
    from zeroconf.asyncio import AsyncServiceInfo, AsyncZeroconf

__all__ = ["MAX_NAMESAKES", "MdnsAdvert"]

log = logging.getLogger(__name__)

MAX_NAMESAKES = 9
"""So many robots of one name are told apart by a number behind it."""
GOODBYE_TIMEOUT = 1.0
"""For saying that it is gone [s]."""


class MdnsAdvert:
    """Announces one robot until it is closed; the library is loaded when it begins."""

    def __init__(
        self,
        name: str,
        host: str,
        port: Callable[[], int],
        *,
        networks: Callable[[], Iterable[Interface]] = interfaces,
    ) -> None:
        """`host` is what the robot listens on; `port` of its socket is known once it listens."""
        self._name, self._host, self._port, self._networks = name, host, port, networks
        self._work = UntilClosed(self._announce)
        self.announced = asyncio.Event()
        """It can be found."""

    async def run(self) -> None:
        """Announce it until `close()`. A network on which that cannot be done is logged; the robot goes on."""
        await self._work.run()

    async def close(self) -> None:
        """Say that it is gone, if it was announced; `run` returns."""
        await self._work.close()

    async def _announce(self) -> None:
        from zeroconf import IPVersion
        from zeroconf.asyncio import AsyncZeroconf

        addresses = [address for address in self._addresses() if SystemNetwork().has(address)]
        if not addresses:  # the library would leave a socket open
            log.warning("cannot be announced by mDNS: this machine has no address %s", self._host)
            return
        try:
            zone = AsyncZeroconf(interfaces=addresses, ip_version=IPVersion.V4Only)
        except OSError as fault:
            log.warning("cannot be announced by mDNS: %s", fault.strerror or fault)
            return
        try:
            said = await self._register(zone, addresses)
            if said is not None:
                self.announced.set()
                try:
                    await asyncio.Event().wait()
                finally:
                    await _goodbye(zone, said)
        except OSError as fault:
            log.warning("cannot be announced by mDNS: %s", fault.strerror or fault)
        finally:
            await asyncio.shield(zone.async_close())

    def _addresses(self) -> list[str]:
        if self._host in EVERYWHERE:
            others = [each.address for each in self._networks() if each.address != LOOPBACK.address]
            return others or [LOOPBACK.address]
        return [LOOPBACK.address if is_loopback(self._host) else self._host]

    async def _register(self, zone: AsyncZeroconf, addresses: list[str]) -> AsyncServiceInfo | None:
        """Announce it by its name, or by the name and a number where another robot has that; None where all are taken."""
        from zeroconf import NonUniqueNameException
        from zeroconf.asyncio import AsyncServiceInfo

        label = re.sub(r"[^\w -]+", " ", self._name).strip()[:50] or "robot"
        for number in range(1, MAX_NAMESAKES + 1):
            called = label if number == 1 else f"{label} {number}"
            said = AsyncServiceInfo(
                SERVICE_TYPE,
                f"{called}.{SERVICE_TYPE}",
                port=self._port(),
                addresses=[socket.inet_aton(address) for address in addresses],
                properties={"v": "1"},
                server=f"{re.sub(r'[^a-zA-Z0-9]+', '-', called)}.local.",
            )
            with contextlib.suppress(NonUniqueNameException):
                await (await zone.async_register_service(said))
                return said
        log.warning("cannot be announced by mDNS: %d robots are called %s already", MAX_NAMESAKES, label)
        return None


async def _goodbye(zone: AsyncZeroconf, said: AsyncServiceInfo) -> None:
    with contextlib.suppress(TimeoutError, OSError):
        async with asyncio.timeout(GOODBYE_TIMEOUT):
            await (await zone.async_unregister_service(said))
