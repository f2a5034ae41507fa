"""The pictures of intruders that a robot keeps, fetched by the events that report them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Protocol

from kivy.graphics.texture import Texture

from app.link.camera_decoder import Decoder, best_decoder
from app.link.channels import ANSWER, Answer
from app.link.feeds import Post
from bridge.core.camera_frames import picture_size
from bridge.core.codes import Code
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import Event, GetIntruderPictureRequest, GetIntruderPictureResponse

__all__ = ["NEWEST", "SERVICE", "IntruderPictures"]

SERVICE = "/events/picture"
MAX_KEPT = 40
"""Pictures that are kept; the one that came first makes room."""
NEWEST = 12
"""Events of a list, the newest ones, whose pictures are fetched."""
RETRY_PERIOD = 3.0
"""After a call without an answer a picture is asked for again [s]."""
MAX_EDGE = 512
"""A picture that is longer [px] is none that a robot keeps with an event, and is not decoded."""

Key = tuple[str, int]
"""An event's log and number."""


class Link(Protocol):
    """The link, as far as pictures need it."""

    def ask(self, service: str, request: Msg, answer: type[Msg], /) -> object:
        """Call a service, whose answer comes to `IntruderPictures.on_post`."""


class Robot(Protocol):
    """The robot, as far as pictures need it."""

    def offers(self, service: str) -> bool:
        """Whether it has the service."""


class Log(Protocol):
    """The robot's events."""

    @property
    def events(self) -> Iterable[Event]:
        """Those that are known."""


class Session(Protocol):
    """The session with the robot, as far as pictures need it."""

    @property
    def link(self) -> Link:
        """Another one may come."""

    @property
    def connected(self) -> bool:
        """The robot can be asked."""

    @property
    def robot(self) -> Robot:
        """What is known of it."""

    @property
    def logbook(self) -> Log:
        """Its events."""

    @property
    def boot(self) -> str:
        """Identity of the robot's log."""


class IntruderPictures:
    """By the event. Everything here happens in the UI thread."""

    def __init__(self, session: Session, now: Callable[[], float]) -> None:
        """`now` is our clock [s]."""
        self._session, self._now = session, now
        self._next: dict[Key, float] = {}
        """When a picture may be asked for again [s]; infinite where there is an answer to come, or was one."""
        self._kept: dict[Key, Texture] = {}
        self._decode: Decoder | None = None
        self.listeners: list[Callable[[], object]] = []
        """Called when another picture is there."""

    def of(self, event: Event) -> Texture | None:
        """The picture of the intruder that `event` reports, None while there is none; the robot is asked for it once."""
        key = (event.boot, event.id)
        if event.code != Code.INTRUDER_FOUND:
            return None
        if key not in self._kept and self._now() >= self._next.get(key, -math.inf) and self._is_able():
            self._ask(key)
        return self._kept.get(key)

    def newest(self) -> dict[Key, Texture]:
        """The pictures of the newest intruders of the log, as far as they are there; the robot is asked for the others."""
        told = [event for event in self._session.logbook.events if event.code == Code.INTRUDER_FOUND]
        told.sort(key=lambda event: event.stamp.seconds)
        found = {(event.boot, event.id): self.of(event) for event in told[-NEWEST:]}
        return {key: texture for key, texture in found.items() if texture is not None}

    def found(self, intruder: int) -> Event | None:
        """The newest event of the robot's log that reports the intruder of that number."""
        return self._newest_of(intruder, Code.INTRUDER_FOUND)

    def circled(self, intruder: int) -> Event | None:
        """The newest event that says from which sides it was seen; None while it was not gone round."""
        return self._newest_of(intruder, Code.INTRUDER_CIRCLED)

    def _newest_of(self, intruder: int, code: str) -> Event | None:
        boot = self._session.boot
        told = [
            event
            for event in self._session.logbook.events
            if event.code == code and (not boot or event.boot == boot)
        ]
        named = [
            event
            for event in told
            if {pair.key: pair.value for pair in event.parameters}.get("id") == str(intruder)
        ]
        return max(named, key=lambda event: event.id, default=None)

    def _is_able(self) -> bool:
        return self._session.connected and self._session.robot.offers(SERVICE)

    def _ask(self, key: Key) -> None:
        self._next[key] = math.inf
        boot, number = key
        request = GetIntruderPictureRequest(stamp=math.nan, event=number, boot=boot)
        self._session.link.ask(SERVICE, request, GetIntruderPictureResponse)

    def on_post(self, channel: str, post: Post) -> None:
        """Something came: the picture that was asked for, or something else."""
        answer = post.value
        if channel != ANSWER or not isinstance(answer, Answer) or answer.service != SERVICE:
            return
        asked, message = answer.request, answer.message
        if not isinstance(asked, GetIntruderPictureRequest):
            return
        key = (asked.boot, asked.event)
        if not isinstance(message, GetIntruderPictureResponse):
            self._next[key] = self._now() + RETRY_PERIOD  # the link broke, or it took too long
            return
        texture = self._decoded(message.picture.data) if message.success else None
        if texture is not None:
            self._kept[key] = texture
            while len(self._kept) > MAX_KEPT:
                del self._kept[next(iter(self._kept))]
            for tell in self.listeners:
                tell()

    def _decoded(self, jpeg: bytes) -> Texture | None:
        try:
            _, wide, high = picture_size(jpeg)
            if max(wide, high) > MAX_EDGE:
                return None
            self._decode = self._decode or best_decoder()
            wide, high, rgba = self._decode(bytes(jpeg))
        except (ProtocolError, ValueError, OSError):
            return None
        texture = Texture.create(size=(wide, high), colorfmt="rgba")
        texture.blit_buffer(rgba, colorfmt="rgba", bufferfmt="ubyte")
        texture.flip_vertical()
        return texture
