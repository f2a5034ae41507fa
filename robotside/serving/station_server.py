"""The station behind its sockets: bridge, web site, beacon."""

from __future__ import annotations

import socket
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager, contextmanager
from functools import partial

import uvicorn

from bridge.core import camera_frames as frames
from bridge.core.errors import BridgeError
from bridge.core.topics import camera_topics
from bridge.discovery.beacon import Beacon, Hello
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.server.server import BridgeServer
from robotside.core.clock import RobotClock
from robotside.door.station_door import StationDoor
from robotside.gateways.http.browser_connection import Visit
from robotside.gateways.http.camera_streams import Streams
from robotside.gateways.http.web_site import site
from robotside.gateways.scaling.message_reduction import reduce
from robotside.gateways.scaling.picture_scaling import Pictures
from robotside.perception.intruder_watch import jpeg_size
from robotside.serving.fleet_server import Served, Together
from robotside.station.station import Station

__all__ = ["Addresses", "Serving"]

_EVERYWHERE = ("0.0.0.0", "::", "")  # noqa: S104 - compared with, not bound to


class Addresses:
    """Where it listens."""

    def __init__(self, host: str, port: int, http_port: int) -> None:
        self.host, self.port, self.http_port = host, port, http_port

    @property
    def shown(self) -> str:
        """The host as others may type it."""
        if self.host in _EVERYWHERE:
            return _own_address()
        return f"[{self.host}]" if ":" in self.host else self.host

    @property
    def bridge(self) -> str:
        """Of the rosbridge socket."""
        return f"ws://{self.shown}:{self.port}"

    @property
    def http(self) -> str:
        """Of the web site."""
        return f"http://{self.shown}:{self.http_port}"


class Serving:
    """Serves one station until told to end: alone by `run`, or with others as part of a `Together`."""

    def __init__(
        self,
        station: Station,
        clock: RobotClock,
        wall: Callable[[], float],
        addresses: Addresses,
        *,
        wanted: Callable[[], bool] = lambda: True,
    ) -> None:
        """`wanted` is asked once a second and ends the serving when it says no."""
        self.addresses = addresses
        self.station = station
        """What is served."""
        self._clock = clock
        self._alone = Together([self], clock, wall, wanted=wanted)
        self._pictures = Pictures()
        self.door = StationDoor(station)
        self.server = BridgeServer(
            self.door,
            offers=self.door.offers,
            now=station.clock,
            cameras=station.info.cameras,
            shrink=self._pictures.shrink,
            reduce=reduce,
        )
        self._site = site(self.door, lambda: addresses.bridge, Streams(self.door, self._pictures))
        self._cameras = {topic: name for name, topic in camera_topics(station.info.cameras).items()}
        """Name of each camera by the topic of its pictures."""
        self._frames: dict[str, int] = {}
        """So many pictures of each camera were taken."""

    async def run(self, ready: Callable[[Addresses], None]) -> None:
        """Serve until `end`; `ready` is called once everything listens. BridgeError when a port is taken."""
        await self._alone.run(lambda _: ready(self.addresses))

    def end(self) -> None:
        """Have `run` come to its end."""
        self._alone.end()

    @asynccontextmanager
    async def listening(self) -> AsyncIterator[Served]:
        """Hold its ports for as long as this is open. BridgeError when one is taken."""
        where = self.addresses
        web_socket = _listen(where.host, where.http_port)
        try:
            where.http_port = web_socket.getsockname()[1]
            await self.server.start(where.host, where.port)
            where.port = self.server.port
            web = _Web(
                uvicorn.Config(self._site, http=Visit, log_level="warning", lifespan="off", access_log=False)
            )
            beacon = Beacon(self._hello)
            for topic in self._cameras:
                self.door.subscribe(self, topic, self._publish_frame, wanted=False)
            yield Served((lambda: web.serve([web_socket]), beacon.run), partial(_leave, web, beacon))
        finally:
            self.station.robot.stop()
            await self.server.close()
            await self._pictures.close()
            self.door.close()
            web_socket.close()

    def _publish_frame(self, topic: str, msg: Msg) -> None:
        if isinstance(msg, CompressedImage):
            camera = self._cameras[topic]
            width, height = jpeg_size(msg.data)
            self._frames[camera] = number = self._frames.get(camera, 0) + 1
            # real time, so that a handheld can tell the picture's age whatever the robot's clock does
            stamp = self._clock.real(msg.header.stamp.seconds)
            frame = frames.pack(number, stamp, msg.data, width, height)
            self.server.publish_frame(camera, frame)

    def _hello(self) -> Hello:
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
            driver_id=driver.client_id if driver else "",
            boot=self.station.events.boot,
        )


class _Web(uvicorn.Server):
    """A web server in somebody else's loop, who also minds the signals."""

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Leave the process's signals alone."""
        yield


async def _leave(web: uvicorn.Server, beacon: Beacon) -> None:
    """Take leave of everybody."""
    web.should_exit = True
    await beacon.close()


def _listen(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen()
    except OSError as error:
        listener.close()
        why = error.strerror or str(error)
        raise BridgeError(
            f"Cannot serve HTTP on {host}:{port}: {why.lower()}; --http-port names another port."
        ) from error
    return listener


def _own_address() -> str:
    """The address that this machine has towards others; nothing is sent to find it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))
        except OSError:
            return "127.0.0.1"
        return str(probe.getsockname()[0])
