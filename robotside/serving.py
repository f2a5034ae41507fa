"""The station behind its sockets: bridge, web site, beacon, and the tick that drives all of it."""

from __future__ import annotations

import asyncio
import errno
import logging
import math
import socket
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import uvicorn

from bridge import frames
from bridge.beacon import Beacon, Hello
from bridge.errors import BridgeError
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.server import BridgeServer
from bridge.topics import TOPICS
from robotside.autonomy import CAMERA
from robotside.clock import RobotClock
from robotside.goals import actions
from robotside.http import site
from robotside.orders import listener, services
from robotside.pictures import Pictures
from robotside.reduce import reduce
from robotside.station import Station
from robotside.streams import Streams
from robotside.visit import Visit
from robotside.watch import jpeg_size

__all__ = ["Addresses", "Serving"]

log = logging.getLogger(__name__)

_EVERYWHERE = ("0.0.0.0", "::", "")  # noqa: S104 - compared with, not bound to

_SHORT = (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM)
"""How the system says that it has no more of something."""

_TABLE = frozenset(entry.name for entry in TOPICS)

TICK = 1 / 60
"""Real time between two ticks [s]."""
LOOK = 1.0
"""Real time between two questions whether it is still wanted [s]."""


SHORTAGE = 60.0
"""That no connection can be taken is said at most this often [s]."""

BRAKING = 2.0
"""How long the robot may take to come to rest at the end [s]."""


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
    """Serves one station until told to end."""

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
        self._clock, self._wall, self._wanted = clock, wall, wanted
        self._pictures = Pictures()
        offered = list(services(station))
        self.server = BridgeServer(
            services=offered,
            on_message=listener(station),
            now=station.clock,
            on_gone=station.gone,
            on_demand=lambda topic, wanted: station.demand.set(topic, "clients", wanted),
            cameras=station.info.cameras,
            shrink=self._pictures.shrink,
            reduce=reduce,
            actions=actions(station),
        )
        kinds = {service.name: service.type for service in offered}
        streams = Streams(station.bus, station.demand, self._pictures)
        self._site = site(station, lambda: addresses.bridge, kinds, streams)
        self._frames = 0
        self._patience = math.inf

    async def run(self, ready: Callable[[Addresses], None]) -> None:
        """Serve until `end`; `ready` is called once everything listens. BridgeError when a port is taken."""
        where = self.addresses
        web_socket = _listen(where.host, where.http_port)
        where.http_port = web_socket.getsockname()[1]
        web = _Web(
            uvicorn.Config(self._site, http=Visit, log_level="warning", lifespan="off", access_log=False)
        )
        beacon = Beacon(self._hello)
        loop = asyncio.get_running_loop()
        before = loop.get_exception_handler()
        loop.set_exception_handler(_Faults())
        try:
            await self.server.start(where.host, where.port)
            where.port = self.server.port
            leave = self.station.bus.subscribe(None, self._publish)
            async with asyncio.TaskGroup() as group:
                group.create_task(web.serve([web_socket]))
                group.create_task(beacon.run())
                ready(where)
                await self._tick()
                leave()
                web.should_exit = True
                await beacon.close()
        finally:
            self.station.robot.stop()
            await self.server.close()
            await self._pictures.close()
            web_socket.close()
            loop.set_exception_handler(before)

    def end(self) -> None:
        """Have `run` come to its end."""
        self.station.end()
        self._patience = self._wall() + BRAKING

    async def _tick(self) -> None:
        """Drive the station until it was told to end and stands still."""
        loop = asyncio.get_running_loop()
        due = look = loop.time()
        while self._wall() < self._patience and not (self._patience < math.inf and self.station.at_rest):
            for now in self._clock.steps(self._wall()):
                self.station.step(now)
                await asyncio.sleep(0)
            if self._patience == math.inf and loop.time() >= look:
                look = loop.time() + LOOK
                if not self._wanted():
                    self.end()
            due = max(due + TICK, loop.time() - TICK)
            await asyncio.sleep(max(0.0, due - loop.time()))

    def _publish(self, topic: str, msg: Msg) -> None:
        if topic in _TABLE:
            self.server.publish(topic, msg)
        if topic == CAMERA and isinstance(msg, CompressedImage) and self.station.info.cameras:
            width, height = jpeg_size(msg.data)
            self._frames += 1
            # real time, so that a handheld can tell the picture's age whatever the robot's clock does
            stamp = self._clock.real(msg.header.stamp.seconds)
            frame = frames.pack(self._frames, stamp, msg.data, width, height)
            self.server.publish_frame(self.station.info.cameras[0], frame)

    def _hello(self) -> Hello:
        info, driver = self.station.info, self.station.controls.driver
        return Hello(
            name=info.name,
            kind=info.kind,
            model=info.model,
            description=info.description,
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


class _Faults:
    """What goes wrong in the loop itself, in the log: that connections cannot be taken, seldom; all else as ever."""

    def __init__(self) -> None:
        self._next = -math.inf

    def __call__(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        """Log one of them."""
        fault = context.get("exception")
        # a listening socket tells a hundred times a second that there are no more file descriptors
        if "socket" not in context or not isinstance(fault, OSError) or fault.errno not in _SHORT:
            loop.default_exception_handler(context)
        elif loop.time() >= self._next:
            self._next = loop.time() + SHORTAGE
            log.error("No further connection can be taken at the moment: %s.", fault.strerror)


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
        raise BridgeError(f"Cannot serve HTTP on {host}:{port}: {why.lower()}.") from error
    return listener


def _own_address() -> str:
    """The address that this machine has towards others; nothing is sent to find it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))
        except OSError:
            return "127.0.0.1"
        return str(probe.getsockname()[0])
