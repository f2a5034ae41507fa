"""Owner of the gateways that a user asked for: brings them up and down while the robot runs."""

from __future__ import annotations

import asyncio
import errno
import importlib
import logging
import sys
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from bridge.core.codes import Code
from bridge.core.errors import BridgeError
from bridge.core.identity import Role
from robotside.core.notice import Notice
from robotside.gateways.adapter import Adapter, AdapterGateway, Surroundings
from robotside.gateways.usage_sheet.running import Running
from robotside.serving.garbage import loading

if TYPE_CHECKING:  # a robot that nobody asked a gateway of does not load it
    from robotside.gateways.gateway_url import GatewayUrl

__all__ = ["COMING_UP", "DOWN", "GOING_DOWN", "LOST", "START_TIMEOUT", "UP", "GatewayOwner", "Standing"]

log = logging.getLogger(__name__)

DOWN, COMING_UP, UP, LOST, GOING_DOWN = "down", "coming_up", "up", "lost", "going_down"
START_TIMEOUT = 30.0
"""A gateway that has not come up by then does not [s]."""


@dataclass(slots=True)
class Standing:
    """How one gateway is."""

    state: str = DOWN
    """`DOWN`, `COMING_UP`, `UP`, `LOST`, which is up without reaching its broker, or `GOING_DOWN`."""
    fault: str = ""
    """Why it is lost, or did not come up the last time; empty for none."""
    url: GatewayUrl | None = None
    """Where; None while it is down."""
    gateway: AdapterGateway | None = None
    """What runs; None while it is down or on its way."""
    says_open: bool = False
    """It told by itself that everybody has a role there."""


class GatewayOwner:
    """The gateways of one robot beside those that every robot has, one of each name at most."""

    def __init__(self, robot: Surroundings) -> None:
        self._robot = robot
        self._known: dict[str, Standing] = {}
        self._running: list[str] = []
        self._lock, self._closed = asyncio.Lock(), False
        self.on_change: Callable[[], None] = lambda: None
        """Called whenever one of them is otherwise than before."""

    @property
    def running(self) -> tuple[str, ...]:
        """Names of those that are up, in the order in which they came."""
        return tuple(self._running)

    @property
    def endpoints(self) -> Mapping[str, str]:
        """The URLs that clients use, by protocol."""
        return {name: url for gateway in self._gateways() for name, url in gateway.endpoints().items()}

    def guide(self) -> str:
        """How all that are up are used; empty when there are none."""
        return "\n\n".join(gateway.guide() for gateway in self._gateways())

    def standing(self, name: str) -> Standing:
        """How the gateway of that name is; down where there never was one."""
        return self._known.get(name, Standing())

    def usage(self) -> list[Running]:
        """How each that is up is used, for the usage sheet."""
        from robotside.gateways.discovery import (
            adapters,
        )  # somebody looks: a robot of which nobody asks has not loaded it

        known = adapters() if self._running else {}
        found = []
        for name in self._running:
            standing = self._known[name]
            if standing.gateway is not None:
                doc = known[name].doc if name in known else ""
                url = " ".join(standing.gateway.endpoints().values())
                found.append(Running(name, doc, url, standing.gateway.guide(), standing.fault))
        return found

    async def bring_up(self, adapter: Adapter, url: GatewayUrl) -> None:
        """Start a gateway. BridgeError with one sentence when that cannot be, or one of that name is up; nothing is left then."""
        async with self._lock:
            name = adapter.name
            if name in self._running:
                raise BridgeError(
                    Notice(Code.GATEWAY_RUNS, f"The gateway {name} is up already.", gateway=name)
                )
            if self._closed:
                raise BridgeError(
                    Notice(Code.GATEWAY_UNABLE, "The robot's program is about to end.", gateway=name)
                )
            standing = self._known[name] = Standing(COMING_UP, url=url)
            self.on_change()
            try:
                gateway = await self._start(adapter, url)
            except BaseException as error:
                fault = str(error) if isinstance(error, BridgeError) else ""
                self._known[name] = Standing(fault=fault)
                self.on_change()
                raise
            standing.gateway = gateway
            standing.state = UP if standing.state == COMING_UP else standing.state
            self._running.append(name)
            self._tell_open(name, url, standing)
            self.on_change()

    async def bring_down(self, name: str) -> None:
        """Stop a gateway and all that came by it. BridgeError when none of that name is up."""
        async with self._lock:
            gateway = self.standing(name).gateway
            if gateway is None:
                raise BridgeError(
                    Notice(Code.GATEWAY_DOWN, f"There is no gateway {name[:50]!r} that is up.", gateway=name)
                )
            self._running.remove(name)
            self._known[name].state = GOING_DOWN
            self.on_change()
            try:
                await gateway.stop()
            finally:
                self._known[name] = Standing()
                self.on_change()

    async def close(self) -> None:
        """Stop all of them, whatever one of them raises, and start none any more."""
        async with self._lock:
            self._closed = True
            while self._running:
                name = self._running.pop()
                gateway = self._known.pop(name).gateway
                try:
                    if gateway is not None:
                        await gateway.stop()
                except Exception:
                    log.exception("The gateway %s did not end as it should", name)

    def _gateways(self) -> list[AdapterGateway]:
        found = [self._known[name].gateway for name in self._running]
        return [gateway for gateway in found if gateway is not None]

    async def _start(self, adapter: Adapter, url: GatewayUrl) -> AdapterGateway:
        """A gateway that runs; BridgeError with one sentence when it does not, and nothing is left of it."""
        gateway = None
        try:
            async with asyncio.timeout(START_TIMEOUT):
                await _load(adapter)
                gateway = adapter.make(replace(self._robot, say=partial(self._say, adapter.name)), url)
                await gateway.start()
        except BaseException as error:
            if gateway is not None:
                await gateway.stop()
            said = _sentence(adapter.name, url, error)
            if not said:
                raise
            code = Code.GATEWAY_PORT_TAKEN if _port_taken(error) else Code.GATEWAY_UNABLE
            raise BridgeError(Notice(code, said, gateway=adapter.name)) from error
        return gateway

    def _say(
        self,
        gateway: str,
        kind: str,
        notice: Notice,
        level: str = "info",
        *,
        at: tuple[float, float] | None = None,
    ) -> object:
        """A gateway says something; what it says of itself is how it stands."""
        standing = self._known.get(gateway)
        if standing is not None and notice.code == Code.GATEWAY_LOST:
            standing.state, standing.fault = LOST, str(notice)
            self.on_change()
        elif standing is not None and notice.code == Code.GATEWAY_UP:
            standing.state, standing.fault = UP, ""
            self.on_change()
        elif standing is not None and notice.code == Code.GATEWAY_OPEN:
            standing.says_open = True
        return self._robot.say(kind, notice, level, at=at)

    def _tell_open(self, name: str, url: GatewayUrl, standing: Standing) -> None:
        """That everybody may drive there is an event, whether the gateway tells of it or not."""
        if url.role is None or url.role <= Role.WATCH or standing.says_open:
            return
        said = f"Everybody who reaches {name} at {url.shown} may {url.role.word} without a key."
        self._robot.say("control", Notice(Code.GATEWAY_OPEN, said, gateway=name, role=url.role.word), "warn")


async def _load(adapter: Adapter) -> None:
    """Import what a gateway needs beside the loop, which drives the robot meanwhile: some libraries take more than a second."""
    package, _, module = adapter.make.__module__.rpartition(".")
    if module != "adapter":
        return
    wanted = f"{package}.gateway"
    if wanted in sys.modules:
        return
    loader = ThreadPoolExecutor(1, f"import {adapter.name}")
    try:
        with loading():
            await asyncio.get_running_loop().run_in_executor(loader, importlib.import_module, wanted)
    finally:
        loader.shutdown(wait=False)


def _sentence(name: str, url: GatewayUrl, error: BaseException) -> str:
    """Why a gateway did not come up, as one sentence; empty for what is no answer to that."""
    if isinstance(error, BridgeError):
        return str(error)
    if isinstance(error, TimeoutError):
        return f"{name} is not up after {START_TIMEOUT:g} s."
    if isinstance(error, OSError):
        return f"{name} cannot use {url.shown}: {error.strerror or error}."
    return f"{name} cannot be loaded: {error}." if isinstance(error, ImportError) else ""


def _port_taken(error: BaseException) -> bool:
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, OSError) and cause.errno == errno.EADDRINUSE:
            return True
        cause = cause.__cause__
    return False
