"""Owner of the gateways that a user asked for: brings them up and down while the robot runs."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Mapping
from typing import TYPE_CHECKING

from bridge.core.errors import BridgeError
from robotside.gateways.adapter import Adapter, AdapterGateway, Surroundings

if TYPE_CHECKING:  # a robot that nobody asked a gateway of does not load it
    from robotside.gateways.gateway_url import GatewayUrl

__all__ = ["GatewayOwner"]

log = logging.getLogger(__name__)


class GatewayOwner:
    """The gateways of one robot beside those that every robot has, one of each name at most."""

    def __init__(self, robot: Surroundings) -> None:
        self._robot = robot
        self._running: dict[str, AdapterGateway] = {}
        self._lock = asyncio.Lock()

    @property
    def running(self) -> tuple[str, ...]:
        """Names of those that are up."""
        return tuple(self._running)

    @property
    def endpoints(self) -> Mapping[str, str]:
        """The URLs that clients use, by protocol."""
        return {name: url for gateway in self._running.values() for name, url in gateway.endpoints().items()}

    def guide(self) -> str:
        """How all that are up are used; empty when there are none."""
        return "\n\n".join(gateway.guide() for gateway in self._running.values())

    async def bring_up(self, adapter: Adapter, url: GatewayUrl) -> None:
        """Start a gateway. BridgeError with one sentence when that cannot be, or one of that name is up; nothing is left then."""
        async with self._lock:
            if adapter.name in self._running:
                raise BridgeError(f"The gateway {adapter.name} is up already.")
            gateway = adapter.make(self._robot, url)
            try:
                await gateway.start()
            except BaseException:
                await gateway.stop()
                raise
            self._running[adapter.name] = gateway

    async def bring_down(self, name: str) -> None:
        """Stop a gateway and all that came by it. BridgeError when none of that name is up."""
        async with self._lock:
            gateway = self._running.pop(name, None)
            if gateway is None:
                raise BridgeError(f"There is no gateway {name!r} that is up.")
            await gateway.stop()

    async def close(self) -> None:
        """Stop all of them, whatever one of them raises."""
        async with self._lock:
            while self._running:
                name, gateway = self._running.popitem()
                try:
                    await gateway.stop()
                except Exception:
                    log.exception("The gateway %s did not end as it should", name)
