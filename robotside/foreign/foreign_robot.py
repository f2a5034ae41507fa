"""A robot behind somebody else's rosbridge server, as the robot side sees it: the same verbs as one of ours."""

from __future__ import annotations

import math
import threading
from collections import deque
from collections.abc import Callable
from typing import Protocol
from urllib.parse import urlsplit

import msgspec

from bridge.core.address import host_and_port
from bridge.core.codes import Code
from bridge.core.topics import CAMERA
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Event, RobotInfo
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Time
from robotside.core.notice import Notice, coded
from robotside.core.text import plain
from robotside.foreign.foreign_link import ForeignLink, Listener
from robotside.foreign.foreign_topics import Found

__all__ = ["ForeignRobot", "Link"]

START_TIMEOUT = 3.0
"""How long the start waits for the robot, so that its limits and its map are known from the beginning [s]."""

REPEAT_PERIOD = 0.1
"""A command is said again so often [s]: many drives stop by themselves without one, and some never do."""

REST_REPEATS = 10
"""How often rest is sent; one of them gets through."""

MAX_AGE = 1.0
"""A message that claims to be older than this when it comes was stamped by another clock [s]."""

JPEG_START = b"\xff\xd8"
"""How a JPEG file begins."""

ASSUMED_INFO = RobotInfo(kind="wheels", model="ros", max_speed=0.5, max_yaw_rate=1.0, radius=0.3)
"""What is supposed of a robot that does not tell: slow enough for most."""

SILENCE_TIME = 0.2
"""A silence must be seen for this long [s]: when this machine was busy, what came is only read late."""

SILENT_SENTENCE = "The robot cannot be reached: it has sent nothing for a second."


class Link(Protocol):
    """The line to the robot."""

    @property
    def silent(self) -> bool:
        """Nothing has come for a second, though it still stands: what is sent now may arrive late."""

    @property
    def dropped(self) -> bool:
        """The last command did not leave this machine."""

    def robot_time(self) -> float:
        """Its clock now [s]; NaN while not known."""

    def drive(self, twist: Twist) -> None:
        """Send a drive command at once, or never; rest even when it may arrive late."""

    def press_stop(self) -> None:
        """Press the robot's own STOP, if it has one, until `release_stop`."""

    def release_stop(self) -> None:
        """Release it if it was pressed from here."""

    def want(self, topic: str, wanted: bool) -> None:
        """Have the messages of an on-demand topic sent from now on, or no longer."""

    def close(self) -> None:
        """End it."""


class ForeignRobot:
    """Fits `robotside.core.robot.Robot`, and is told by its link in that one's thread."""

    def __init__(
        self,
        url: str,
        *,
        patience: float = START_TIMEOUT,
        connect: Callable[[str, Listener], Link] = ForeignLink,
    ) -> None:
        """`url` is `ws://HOST:PORT`, BadAddress when it is none; waits `patience` [s] at most for who answers there."""
        self._lock = threading.Condition()
        self._newest: dict[str, Msg] = {}
        self._said: deque[Notice] = deque(maxlen=32)
        self._found: Found | None = None
        self._remarks: tuple[str, ...] = ()
        self._refused = False
        self._stamps: dict[str, float] = {}
        self._ready: Callable[[], None] | None = None
        self._twist: Twist | None = None
        self._rests, self._due = 0, -math.inf
        host_and_port(url)
        place = urlsplit(url).netloc.rpartition("@")[2]  # a password is nobody's business
        self._unreached = f"The robot cannot be reached: no answer yet from {place}."
        self._held = ""
        self._silent, self._silent_since = False, math.inf
        self._told = False
        self._link = connect(url, self)
        self._wait(patience)
        self.info = self._introduced(place)
        """Who it is, as it tells itself by the time that the waiting is over."""

    @property
    def trouble(self) -> str:
        """Why it cannot be driven, as one sentence: not reached, or in others' hands; empty when all is well."""
        return self._unreached or (SILENT_SENTENCE if self._silent else self._held)

    @property
    def reached(self) -> bool:
        """It is heard; one in the hands of others is, too."""
        return not (self._unreached or self._silent)

    def drive(self, twist: Twist) -> None:
        """Move with `twist` until the next `drive` or `stop`; dropped while there is `trouble`."""
        with self._lock:
            if self.trouble:
                return
            self._twist, self._rests, self._due = twist, 0, -math.inf
        self._link.drive(twist)

    def stop(self) -> None:
        """Send zero speed, several times."""
        with self._lock:
            self._twist, self._rests, self._due = None, REST_REPEATS, -math.inf
        self._link.drive(Twist())

    def press_stop(self) -> None:
        """Press the STOP of a robot side of ours that is behind, now or as soon as it is reached."""
        self._link.press_stop()

    def release_stop(self) -> None:
        """Release it if it was pressed from here."""
        self._link.release_stop()

    def read(self, now: float) -> list[tuple[str, Msg]]:
        """What came since the last call, of each topic the newest, by our clock; says the command in force again."""
        silent = self._link.silent
        with self._lock:
            self._mind_silence(silent, now)
            newest, self._newest = self._newest, {}
            said = [*self._said]
            self._said.clear()
        newest.pop("/robot/info", None)
        self._repeat(now)
        events: list[tuple[str, Msg]] = [
            ("/events", Event(level="warn", kind="robot", text=str(notice), **coded(notice)))
            for notice in said
        ]
        return [*events, *((topic, self._dated(topic, msg, now)) for topic, msg in newest.items())]

    def on_pictures(self, ready: Callable[[], None] | None) -> None:
        """Call `ready`, in the link's thread, when a picture came; None for no longer."""
        with self._lock:
            self._ready = ready

    def pictures(self, now: float) -> list[tuple[str, Msg]]:
        """The newest picture of each camera that no call has given yet, by our clock."""
        with self._lock:
            topics = [topic for topic, msg in self._newest.items() if isinstance(msg, CompressedImage)]
            newest = [(topic, self._newest.pop(topic)) for topic in topics]
        return [(topic, self._dated(topic, msg, now)) for topic, msg in newest]

    def want(self, topic: str, wanted: bool) -> None:
        """Ask for the messages of an on-demand topic from now on, or no longer."""
        self._link.want(topic, wanted)

    def close(self) -> None:
        """Bring it to rest and let go of it."""
        self._link.close()

    def on_found(self, found: Found) -> None:
        """The link: the robot is reached, stands still, and offers this."""
        with self._lock:
            self._twist, self._rests = None, 0 if self._held else REST_REPEATS
            self._found, self._unreached, self._told = found, "", True
            if tuple(found.remarks) != self._remarks:
                self._remarks = tuple(found.remarks)
                self._said.extend(Notice(Code.FOREIGN_REMARK, remark) for remark in found.remarks)
            self._lock.notify_all()

    def on_lost(self, sentence: str) -> None:
        """The link: the robot is not reached, for this reason."""
        with self._lock:
            self._twist, self._rests = None, 0
            self._held = ""
            self._unreached = f"The robot cannot be reached: {sentence[:1].lower()}{sentence[1:]}"
            self._told = True
            self._newest = {topic: msg for topic, msg in self._newest.items() if topic == "/map"}
            self._lock.notify_all()

    def on_message(self, topic: str, msg: Msg) -> None:
        """The link: a message came."""
        if isinstance(msg, CompressedImage) and not msg.data.startswith(JPEG_START):
            self._refuse(msg)
            return
        with self._lock:
            self._newest.pop(topic, None)
            self._newest[topic] = msg
            self._lock.notify_all()
            if self._ready is not None and isinstance(msg, CompressedImage):
                self._ready()

    def on_held(self, sentence: str) -> None:
        """The link: the robot obeys others, for this reason; empty when it obeys us."""
        with self._lock:
            if sentence:
                self._twist, self._rests = None, 0
            self._held = sentence

    def _mind_silence(self, silent: bool, now: float) -> None:
        """What was sent into a silence may still arrive: rest is said from its beginning on, and again after its end."""
        self._silent_since = min(self._silent_since, now) if silent else math.inf
        silent = now - self._silent_since >= SILENCE_TIME
        if silent or self._silent:
            self._twist, self._rests = None, 0 if self._held else REST_REPEATS
        self._silent = silent

    def _refuse(self, image: CompressedImage) -> None:
        """Say once that such pictures cannot be shown."""
        kind = plain(image.format, 20) or "of no known kind"
        said = f"The camera's pictures are {kind}, not JPEG: they are left out."
        with self._lock:
            if not self._refused:
                self._said.append(Notice(Code.CAMERA_UNREADABLE, said, format=kind))
            self._refused = True

    def _wait(self, patience: float) -> None:
        """Until it is known whether anybody is there, and then for what such a robot sends once."""
        with self._lock:
            self._lock.wait_for(lambda: self._told, patience)
            if self._found is not None:
                once = {"/robot/info", "/map"} & set(self._found.topics)
                self._lock.wait_for(lambda: once <= set(self._newest), patience / 3)

    def _introduced(self, place: str) -> RobotInfo:
        told = self._newest.get("/robot/info")
        info = told if isinstance(told, RobotInfo) else ASSUMED_INFO
        # one that has not come yet may have a camera
        sees = self._found is None or CAMERA in self._found.topics
        return msgspec.structs.replace(
            info,
            name=info.name or f"Robot at {place}",
            description=info.description or "ROS robot",
            cameras=(info.cameras[:1] or ["front"]) if sees else [],
            max_speed=info.max_speed if info.max_speed > 0 else ASSUMED_INFO.max_speed,
            max_yaw_rate=info.max_yaw_rate if info.max_yaw_rate > 0 else ASSUMED_INFO.max_yaw_rate,
            radius=info.radius if info.radius > 0 else ASSUMED_INFO.radius,
        )

    def _repeat(self, now: float) -> None:
        if self._due == -math.inf:
            self._due = now + REPEAT_PERIOD
        if now < self._due:
            return
        self._due = now + REPEAT_PERIOD
        if self._twist is not None:
            self._link.drive(self._twist)
        elif self._rests > 0:
            if not self._link.dropped:
                self._rests -= 1
            self._link.drive(Twist())

    def _dated(self, topic: str, msg: Msg, now: float) -> Msg:
        """The message with its header's stamp by our clock, never before the last one of its topic."""
        header = getattr(msg, "header", None)
        if header is None:
            return msg
        age = self._link.robot_time() - header.stamp.seconds
        if not -REPEAT_PERIOD <= age <= MAX_AGE:  # NaN too
            age = 0.0
        stamp = max(now - max(age, 0.0), self._stamps.get(topic, -math.inf))
        self._stamps[topic] = stamp
        return msgspec.structs.replace(msg, header=msgspec.structs.replace(header, stamp=Time.at(stamp)))
