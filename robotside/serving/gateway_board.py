"""The board of gateways: which protocols there are and how each is, and commands that bring one up or down."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import TYPE_CHECKING

from bridge.core.async_tasks import cancel_all
from bridge.core.codes import Code
from bridge.core.errors import BridgeError
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import (
    BringDownGatewayRequest,
    BringDownGatewayResponse,
    BringUpGatewayRequest,
    BringUpGatewayResponse,
    Gateway,
    GatewayArray,
)
from bridge.msgs.std_msgs import Time
from robotside.core.installing import how_to_install
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.core.text import plain
from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Adapter
from robotside.services.lasting_commands import LastingCommands
from robotside.serving.gateway_owner import DOWN, LOST, UP, GatewayOwner
from robotside.station.station import Station

if TYPE_CHECKING:  # a robot that nobody asked a gateway of does not load it
    from robotside.gateways.gateway_url import GatewayUrl

__all__ = ["ALWAYS", "FAREWELL_TIME", "TOPIC", "GatewayBoard", "Keep"]

TOPIC = "/gateways"
ALWAYS = {
    "rosbridge": "the app and programs of ROS, by WebSocket",
    "http": "web pages, pictures and STOP by HTTP",
}
"""What every robot has, with what it is."""
Keep = Callable[[str, str | None], str]
"""Keeps the URL of a gateway that is brought up at the next start, empty for the usual one, None for one that is not; why that
cannot be as one sentence, empty when it is done. Called in a thread of its own."""
FAREWELL_TIME = 0.5
"""A client that brings down its own gateway is answered so long before [s]."""
MAX_URL = 2000
"""Characters of a URL."""


class GatewayBoard:
    """The protocols of one robot, for clients."""

    def __init__(
        self,
        door: StationDoor,
        station: Station,
        owner: GatewayOwner,
        fixed: Callable[[], Mapping[str, str]],
        keep: Keep | None = None,
        pause: Callable[[float], Awaitable[object]] = asyncio.sleep,
    ) -> None:
        """`fixed` gives the URLs of those that always run, by name; `keep` keeps for the next start which of the others
        were brought up here, None for nowhere to keep it. `pause` waits so long [s].
        """
        self._keep, self._pause = keep, pause
        self._keeping = asyncio.Lock()
        self._station, self._owner, self._fixed = station, owner, fixed
        self._lasting = LastingCommands(station, door.trail)
        self._farewells: set[asyncio.Task[None]] = set()
        self._wanted = False
        owner.on_change = self.update
        door.make(TOPIC, self._want)
        door.also(self._services())

    def update(self) -> None:
        """Publish how all of them are, if somebody listens."""
        if self._wanted:
            self._station.bus.publish(TOPIC, self._message())

    async def close(self) -> None:
        """End what is under way; those that are up stay so."""
        await self._lasting.close()
        await cancel_all(self._farewells)

    def _services(self) -> Iterable[Service]:
        yield self._lasting.service(
            "/gateways/bring_up",
            self._bring_up,
            "BringUpGateway",
            BringUpGatewayRequest,
            BringUpGatewayResponse,
        )
        yield self._lasting.service(
            "/gateways/bring_down",
            self._bring_down,
            "BringDownGateway",
            BringDownGatewayRequest,
            BringDownGatewayResponse,
        )

    def _want(self, wanted: bool) -> None:
        self._wanted = wanted
        self.update()

    def _message(self) -> GatewayArray:
        from robotside.gateways.discovery import adapters, missing_package

        fixed = self._fixed()
        entries = [
            Gateway(name, doc, fixed=True, state=UP, endpoint=fixed.get(name, ""))
            for name, doc in ALWAYS.items()
        ]
        for name, adapter in adapters().items():
            entries.append(self._entry(name, adapter, missing_package(adapter)))
        return GatewayArray(Time.at(self._station.clock()), entries)

    def _entry(self, name: str, adapter: Adapter, package: str) -> Gateway:
        standing = self._owner.standing(name)
        gateway = standing.gateway if standing.state in (UP, LOST) else None
        endpoint = next(iter(gateway.endpoints().values()), "") if gateway else ""
        return Gateway(
            name,
            adapter.doc,
            package,
            state=standing.state,
            endpoint=endpoint,
            options=_options(standing.url) if standing.url else [],
            fault=standing.fault,
            qr_rows=_qr(endpoint),
            guide=gateway.guide() if gateway else "",
            usual=adapter.default,
            schemes=[f"{scheme}:{port}" for scheme, port in adapter.schemes.items()],
            listens=sorted(adapter.listens),
        )

    def _bring_up(self, client: Operator, asked: BringUpGatewayRequest) -> Callable[[], Awaitable[str]]:
        adapter, url = _read(asked.name, asked.url)
        name = adapter.name
        if self._owner.standing(name).state != DOWN:
            raise Refusal(
                Notice(Code.GATEWAY_RUNS, f"{name} is up already; bring it down first.", gateway=name)
            )
        return partial(self._up, adapter, url, asked.url, *self._who(client))

    async def _up(self, adapter: Adapter, url: GatewayUrl, typed: str, id: str, who: str) -> str:
        name = adapter.name
        try:
            await self._owner.bring_up(adapter, url)
        except BridgeError as error:
            raise _refusal(name, error) from error
        gateway = self._owner.standing(name).gateway
        where = next(iter(gateway.endpoints().values()), "") if gateway else ""
        said = f"{who} brought {name} up at {where}."
        self._station.events.say(
            "control",
            Notice(Code.GATEWAY_BROUGHT_UP, said, actor_id=id, name=who, gateway=name, endpoint=where),
        )
        kept = await self._kept(name, typed)
        return f"{name} is up at {where}.{kept}"

    def _bring_down(self, client: Operator, asked: BringDownGatewayRequest) -> Callable[[], Awaitable[str]]:
        name = plain(asked.name, 50)
        if name in ALWAYS:
            said = f"{name} always runs: without it nobody would reach the robot."
            raise Refusal(Notice(Code.GATEWAY_FIXED, said, gateway=name))
        if self._owner.standing(name).gateway is None:
            raise Refusal(
                Notice(Code.GATEWAY_DOWN, f"There is no gateway {name!r} that is up.", gateway=name)
            )
        who = self._who(client)
        if client.way != name:
            return partial(self._down, name, *who)
        stays = self._fixed().get("rosbridge", "")
        if not asked.own:
            said = (
                f"You are connected by {name} yourself: set own to bring it down all the same; {stays} stays."
            )
            raise Refusal(Notice(Code.GATEWAY_OWN, said, gateway=name))
        return partial(self._down_soon, name, *who, stays)

    async def _down(self, name: str, id: str, who: str) -> str:
        try:
            await self._owner.bring_down(name)
        except BridgeError as error:
            raise _refusal(name, error) from error
        said = f"{who} brought {name} down."
        self._station.events.say(
            "control", Notice(Code.GATEWAY_BROUGHT_DOWN, said, actor_id=id, name=who, gateway=name)
        )
        kept = await self._kept(name, None)
        return f"{name} is down.{kept}"

    async def _kept(self, name: str, url: str | None) -> str:
        """Keep for the next start that it is up at `url`, or None for down; what is to be said of that."""
        if self._keep is None:
            return ""
        async with self._keeping:
            disk = ThreadPoolExecutor(1, "robot.toml")  # which may be slow, and the robot goes on
            try:
                problem = await asyncio.get_running_loop().run_in_executor(disk, self._keep, name, url)
            finally:
                disk.shutdown(wait=False)
        if problem:
            return f" The next start does not know of it: {problem}"
        return "" if url is None else " So it is after the next start."

    async def _down_soon(self, name: str, id: str, who: str, stays: str) -> str:
        """Who asks is answered before its connection ends."""

        async def farewell() -> None:
            await self._pause(FAREWELL_TIME)
            await self._down(name, id, who)

        task = asyncio.create_task(farewell())
        self._farewells.add(task)
        task.add_done_callback(self._said)
        return f"{name} goes down in {FAREWELL_TIME:g} s; {stays} stays."

    def _said(self, task: asyncio.Task[None]) -> None:
        self._farewells.discard(task)
        if not task.cancelled():
            task.exception()  # somebody else brought it down meanwhile

    def _who(self, client: Operator) -> tuple[str, str]:
        return self._station.controls.id(client), self._station.controls.name(client)


def _read(name: str, url: str) -> tuple[Adapter, GatewayUrl]:
    """The adapter and the URL that are asked for; raises Refusal."""
    from robotside.gateways.discovery import adapters, missing_package, read_wish

    name, known = plain(name, 50), adapters()
    if name in ALWAYS:
        raise Refusal(Notice(Code.GATEWAY_FIXED, f"{name} always runs.", gateway=name))
    if name not in known:
        said = f"There is no protocol {name!r}; there are {', '.join((*ALWAYS, *known))}."
        raise Refusal(Notice(Code.GATEWAY_UNKNOWN, said, gateway=name))
    package = missing_package(known[name])
    if package:
        said = f"{name} needs {package}, which is not installed: {how_to_install('gateways')} brings it."
        raise Refusal(Notice(Code.GATEWAY_LACKING, said, gateway=name, package=package))
    if len(url) > MAX_URL:
        said = f"A URL has at most {MAX_URL} characters, not {len(url)}."
        raise Refusal(Notice(Code.GATEWAY_URL_INVALID, said, gateway=name))
    try:
        return read_wish(f"{name}={url}" if url else name)
    except ValueError as problem:
        raise Refusal(Notice(Code.GATEWAY_URL_INVALID, str(problem), gateway=name)) from problem


def _refusal(name: str, error: BridgeError) -> Refusal:
    notice = error.args[0] if error.args else ""
    if isinstance(notice, Notice):
        return Refusal(notice)
    return Refusal(Notice(Code.GATEWAY_UNABLE, str(error), gateway=name))


def _qr(endpoint: str) -> list[str]:
    if not endpoint:
        return []
    from robotside.trust.qr import as_rows  # takes a library that only who looks needs

    return as_rows(endpoint)


def _options(url: GatewayUrl) -> list[str]:
    """What the URL says beside where, without what is secret."""
    from robotside.gateways.payloads.table import ALWAYS as ROBOT
    from robotside.gateways.payloads.table import KEYS, PAYLOADS

    found = [f"role={url.role.word}"] if url.role is not None else []
    if url.keys != KEYS:
        chosen = [each.key for each in PAYLOADS if each.key in url.keys and each.key != ROBOT]
        found.append(f"payloads={','.join(chosen)}")
    return [*found, f"rate={url.rate:g}"]
