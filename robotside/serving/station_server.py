"""One station behind its gateways and its beacon."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable, Collection, Iterable, Mapping
from contextlib import AsyncExitStack, asynccontextmanager
from typing import TYPE_CHECKING, Protocol
from urllib.parse import urlsplit

from bridge.core.codes import Code
from bridge.core.errors import BridgeError
from bridge.discovery.beacon import Beacon, Hello
from bridge.discovery.domain import discovery_domain
from bridge.server.reception.pages import PagePolicy
from bridge.server.reception.reception import anyone
from robotside.core.clock import RobotClock
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Adapter, Surroundings
from robotside.gateways.gateway import Gateway
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.http.mounts import Mounts
from robotside.gateways.http.usage_pages import Usage
from robotside.gateways.rosbridge.gateway import RosbridgeGateway
from robotside.gateways.scaling.picture_scaling import PictureScaler
from robotside.gateways.usage_sheet.pasted import PLAIN
from robotside.gateways.usage_sheet.running import Running
from robotside.serving.fleet_server import FleetServer, RunningServer
from robotside.serving.gateway_board import GatewayBoard, Keep
from robotside.serving.gateway_owner import GatewayOwner
from robotside.serving.payload_switches import PayloadSwitches
from robotside.serving.payloads_left_out import PayloadsLeftOut
from robotside.serving.prompt_pictures import prompt_pictures
from robotside.serving.station_keys import StationKeys
from robotside.station.station import Station

if TYPE_CHECKING:  # a robot that nobody asked a gateway of does not load it
    from robotside.gateways.gateway_url import GatewayUrl

__all__ = ["Addresses", "StationServer"]


class Announcer(Protocol):
    """What tells others of a robot until it is closed."""

    async def run(self) -> None:
        """Tell of it."""

    async def close(self) -> None:
        """Have `run` return."""


class Addresses:
    """Where a station listens, and the URLs by which clients reach it."""

    def __init__(self, host: str, port: int, http_port: int) -> None:
        """Ports of the rosbridge socket and of the web site; 0 takes a free one."""
        self.host, self.port, self.http_port = host, port, http_port
        self.bridge = ""
        """URL of the rosbridge socket; empty until it listens."""
        self.http = ""
        """URL of the web site; empty until it listens."""

    def note(self, endpoints: Mapping[str, str]) -> None:
        """All gateways listen, at these URLs by protocol."""
        self.bridge, self.http = endpoints["rosbridge"], endpoints["http"]
        self.port, self.http_port = (urlsplit(each).port or 0 for each in (self.bridge, self.http))


class StationServer:
    """Serves one station until told to end: alone by `run`, or with others as part of a `FleetServer`."""

    def __init__(
        self,
        station: Station,
        clock: RobotClock,
        wall: Callable[[], float],
        addresses: Addresses,
        *,
        keys: StationKeys | None = None,
        origins: Iterable[str] = (),
        wanted: Callable[[], bool] = lambda: True,
        gateways: Iterable[tuple[Adapter, GatewayUrl]] = (),
        required: Collection[str] = (),
        mdns: bool = False,
        without: Collection[str] = (),
        keep: Keep | None = None,
    ) -> None:
        """`keys` know who may do what; without them everybody may do everything, and nothing is encrypted.

        Web pages of `origins`, beside its own, may speak to it. `wanted` is asked once a second and ends the serving when it says no.
        `gateways` are brought up beside rosbridge and HTTP; it is served without one that cannot come up, unless `required`
        names it. With `mdns` it is announced by mDNS as well as by HELLO.
        The payloads `without` which it is brought up go off once it has told of them.
        `keep` keeps for the next start which gateways clients bring up and down.
        """
        self.addresses = addresses
        self.station = station
        """The station that is served."""
        self.keys = keys
        """Its certificate, its people and pairing."""
        self.door = self._door()
        """The door that all its gateways stand behind."""
        self._together: tuple[StationServer, ...] = (self,)
        self._now = lambda: clock.at(wall())
        self._alone = FleetServer([self], clock, wall, wanted=wanted)
        self._pictures = PictureScaler()
        mounts = Mounts(lambda: addresses.http)
        around = self._around(
            PagePolicy(origins, keys.names if keys else (), web_port=lambda: self._http.port), mounts
        )
        self._rosbridge = RosbridgeGateway(
            self.door,
            addresses.host,
            addresses.port,
            self._pictures,
            clock.real,
            tls=around.tls,
            plain_from=around.plain_from,
            pages=around.pages,
            roll=lambda: [each.hello() for each in self._together],
        )
        self.server = self._rosbridge.server
        """The rosbridge server."""
        self._http = self._web_site(around, mounts)
        self._gateways: tuple[Gateway, ...] = (self._http, self._rosbridge)
        """In the order in which they start."""
        self._wished, self._required, self._mdns = tuple(gateways), frozenset(required), mdns
        self.gateways = GatewayOwner(around)
        """The gateways beside those two, which come and go while it runs."""
        self._board = GatewayBoard(self.door, station, self.gateways, self._endpoints, keep)
        self.payloads = PayloadSwitches(self.door, station, self._board.update)
        """Which payloads are on."""
        self._left_out = PayloadsLeftOut(self.payloads, station, without)

    def _around(self, pages: PagePolicy, mounts: Mounts) -> Surroundings:
        """What gateways are given of the robot."""
        keys = self.keys
        return Surroundings(
            self.door,
            self.station.events.say,
            tls=keys.context if keys else None,
            plain_from=keys.plain_from if keys else anyone,
            pages=pages,
            key=keys.key if keys else PLAIN,
            site=mounts,
        )

    def _web_site(self, around: Surroundings, mounts: Mounts) -> HttpGateway:
        keys, addresses = self.keys, self.addresses
        return HttpGateway(
            self.door,
            addresses.host,
            addresses.http_port,
            self._pictures,
            lambda: addresses.bridge,
            stamps=self._now,
            tls=around.tls,
            plain_from=around.plain_from,
            pages=around.pages,
            stop_from_pages=keys.stop_from_pages if keys else True,
            pairing=keys.pairing if keys else None,
            mounts=mounts,
            usage=Usage(self._running, keys.pin if keys else ""),
        )

    def _running(self) -> list[Running]:
        return self.gateways.usage()

    def _door(self) -> StationDoor:
        if self.keys is None:
            return StationDoor(self.station)
        services = self.keys.services(lambda: self.door.connected)
        door = StationDoor(self.station, self.keys.trust, services)
        self.keys.trust.on_lost = door.expel
        return door

    def _endpoints(self) -> Mapping[str, str]:
        return {"rosbridge": self.addresses.bridge, "http": self.addresses.http}

    async def run(self, ready: Callable[[Addresses], None]) -> None:
        """Serve until `end`; `ready` is called once everything listens. BridgeError when a port is taken."""
        await self._alone.run(lambda _: ready(self.addresses))

    def end(self) -> None:
        """Have `run` come to its end."""
        self._alone.end()

    def belong(self, together: Iterable[StationServer]) -> None:
        """Name all of these, itself among them, to who asks which robots are here."""
        self._together = tuple(together)

    @asynccontextmanager
    async def listening(self) -> AsyncIterator[RunningServer]:
        """Hold its ports for as long as this is open. BridgeError when one is taken, or a required gateway does not come up."""
        async with AsyncExitStack() as opened:
            if self.keys is not None:
                opened.callback(self.keys.close)
            opened.callback(self.door.close)
            opened.push_async_callback(self._pictures.close)
            for gateway in self._gateways:
                opened.push_async_callback(gateway.stop)
            opened.push_async_callback(self.gateways.close)
            opened.push_async_callback(self._board.close)
            opened.enter_context(prompt_pictures(self.station, self._now))
            opened.callback(self.station.robot.stop)  # before all else
            endpoints: dict[str, str] = {}
            for gateway in self._gateways:
                await gateway.start()
                endpoints.update(gateway.endpoints())
            self.addresses.note(endpoints)
            for adapter, url in self._wished:
                await self._bring_up(adapter, url)
            announcers: list[Announcer] = [Beacon(self.hello, host=self.addresses.host)]
            if self._mdns:
                announcers.append(self._advert())
            work = tuple(each.run for each in announcers)
            keys = self.keys
            if keys is not None:
                keys.reached_at(self.addresses.bridge)
                work += (keys.run,)

            async def leave() -> None:
                if keys is not None:
                    keys.end()
                for each in announcers:
                    await each.close()

            yield RunningServer(work, leave)

    async def _bring_up(self, adapter: Adapter, url: GatewayUrl) -> None:
        """Bring up a gateway that was wished for. One that cannot come up is told of and stands as down; the robot runs."""
        try:
            await self.gateways.bring_up(adapter, url)
        except BridgeError as error:
            why, said = error.args[0], f"The gateway {adapter.name} is not up: {error}"
            unable = Code.GATEWAY_UNABLE
            told = (
                why.reworded(said) if isinstance(why, Notice) else Notice(unable, said, gateway=adapter.name)
            )
            if adapter.name in self._required:
                raise BridgeError(told) from error
            self.station.events.say("control", told, "warn")

    def _advert(self) -> Announcer:
        from robotside.serving.mdns_advert import MdnsAdvert

        return MdnsAdvert(self.station.info.name, self.addresses.host, lambda: self.addresses.port)

    def hello(self) -> Hello:
        """What it announces of itself."""
        info, driver = self.station.info, self.station.controls.driver
        return Hello(
            name=info.name,
            kind=info.kind,
            model=info.model,
            description=info.description,
            icon=info.icon,
            url=self.addresses.bridge,
            http=self.addresses.http,
            battery=self.station.autonomy.battery,
            driver=driver.name if driver else "",
            boot=self.station.events.boot,
            key=self.keys.claim if self.keys else "",
            reached=self.station.robot.reached,
            domain=discovery_domain(),
        )
