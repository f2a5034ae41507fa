"""The rosbridge server of one robot, with its camera frames."""

from __future__ import annotations

import ssl
from collections.abc import Callable, Iterable, Mapping

from bridge.core import camera_frames
from bridge.core.camera_frames import picture_size
from bridge.core.errors import ProtocolError
from bridge.core.topics import camera_topics
from bridge.discovery.hello import Hello
from bridge.discovery.roll import PATH, write_roll
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.server.reception.pages import PagePolicy
from bridge.server.reception.reception import anyone
from bridge.server.server import BridgeServer
from robotside.door.station_door import StationDoor
from robotside.gateways.addresses import url
from robotside.gateways.scaling.message_reduction import reduce
from robotside.gateways.scaling.picture_scaling import PictureScaler

__all__ = ["RosbridgeGateway"]


class RosbridgeGateway:
    """A `Gateway`: rosbridge v2 at `ws://HOST:PORT`, camera frames at `/camera/NAME` there."""

    def __init__(
        self,
        door: StationDoor,
        host: str,
        port: int,
        pictures: PictureScaler,
        real_time: Callable[[float], float],
        *,
        tls: ssl.SSLContext | None = None,
        plain_from: Callable[[str], bool] = anyone,
        pages: PagePolicy | None = None,
        roll: Callable[[], Iterable[Hello]] = tuple,
    ) -> None:
        """Port 0 takes a free one. `real_time` makes of the robot's time real time [s], by which frames are stamped.

        Handhelds tell a picture's age by that, at any speed of the robot's clock. With `tls` clients may come encrypted, on
        the same port; `plain_from(host)` says who may come without. `pages` are the web pages that may
        connect, by default none. `roll` are the robots of this robot side, for who asks at `/robots`.
        """
        self._tls, self._plain_from, self._pages = tls, plain_from, pages
        self._door, self._host, self._real_time = door, host, real_time
        self.port = port
        """Where it listens; 0 until one was taken."""
        self.server = BridgeServer(
            door,
            offers=door.offers,
            now=door.now,
            cameras=door.info.cameras,
            shrink=pictures.shrink,
            reduce=reduce,
            documents={PATH: lambda: write_roll(roll())},
        )
        self._cameras = {topic: name for name, topic in camera_topics(door.info.cameras).items()}
        """Name of each camera by the topic of its pictures."""
        self._taken: dict[str, int] = {}
        """Pictures that each camera has taken."""

    async def start(self) -> None:
        """Begin to listen. BridgeError with one sentence when that is not possible."""
        await self.server.start(
            self._host, self.port, tls=self._tls, plain_from=self._plain_from, pages=self._pages
        )
        self.port = self.server.port
        for topic in self._cameras:
            self._door.subscribe(self, topic, self._publish_frame, wanted=False)

    async def stop(self) -> None:
        """End all connections and stop listening; nothing is left running."""
        self._door.leave(self)
        await self.server.close()

    def endpoints(self) -> Mapping[str, str]:
        """The URL of the WebSocket; `wss` where others reach it and it speaks TLS."""
        return {"rosbridge": url("ws", self._host, self.port, tls=self._tls is not None)}

    def _publish_frame(self, topic: str, msg: Msg) -> None:
        if not isinstance(msg, CompressedImage):
            return
        camera = self._cameras[topic]
        width, height = _size(msg.data)
        self._taken[camera] = number = self._taken.get(camera, 0) + 1
        stamp = self._real_time(msg.header.stamp.seconds)
        self.server.publish_frame(camera, camera_frames.pack(number, stamp, msg.data, width, height))


def _size(picture: bytes) -> tuple[int, int]:
    """Columns and rows of a picture; 0 of one that cannot be read, which is the receiver's to say."""
    try:
        return picture_size(picture)[1:]
    except ProtocolError:
        return 0, 0
