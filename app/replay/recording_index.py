"""What is in a recording and where: found in one pass over the file, piece by piece."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from app.replay.recording_file import Channel, Piece, Record, RecordingError, RecordingFile
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Event, RobotInfo
from widgets.core.field_paths import number_at
from widgets.core.language import mark, tr

__all__ = ["Index", "Stretch", "Topic", "index_of", "series"]

EVENTS, POSE, INFO = "/events", "/pose", "/robot/info"
MAX_STRETCHES = 200_000
"""Pieces of a recording that are known; the app's own are of a megabyte."""
MAX_NOTED = 256 * 2**10
"""Longest event or description of a robot that is kept [byte]."""
MAX_EVENTS = 5000
"""Events that are kept; later ones are in the file alone."""
MAX_TRAIL = 20_000
"""Places of the trail that are kept; of more every second one is given up."""
MAX_SERIES = 200_000
"""Samples that are gathered before they are thinned."""
NOTHING = mark("{name} holds no messages that this app can show.")

TOO_LONG = mark("Its end is left out: it is too long.")

Progress = Callable[[float], bool]
"""Is told which part is done, 0 to 1; True ends the work."""


@dataclass(slots=True)
class Stretch:
    """A piece of the file with the times that it holds."""

    piece: Piece
    first: float
    """[s since 1970]"""
    last: float


@dataclass(slots=True)
class Topic:
    """One topic of the recording."""

    name: str
    kind: str
    """ROS 1 name of its type."""
    type: type[Msg] | None
    """None where this app does not know it."""
    count: int = 0
    stretches: list[int] = field(default_factory=list)
    """Numbers of those that hold messages of it, rising."""


@dataclass(slots=True)
class Index:
    """A whole recording, without its messages."""

    path: Path
    size: int
    """[byte]"""
    start: float = math.inf
    """[s since 1970]"""
    end: float = -math.inf
    stretches: list[Stretch] = field(default_factory=list)
    topics: dict[str, Topic] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    events: list[tuple[float, Event]] = field(default_factory=list)
    """When each came [s since 1970]."""
    trail: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 3)))
    """Time [s since 1970], x and y in `map` [m]."""
    info: RobotInfo | None = None
    """Who it was; None where it did not say."""
    problem: str = ""
    """What is wrong with the file, in sentences; empty when all is well."""

    @property
    def duration(self) -> float:
        """[s]"""
        return max(0.0, self.end - self.start)


def index_of(path: Path, progress: Progress = lambda _: False) -> Index | None:
    """The index of a recording; None where `progress` ended the work.

    RecordingError for a file that holds nothing to be shown, OSError for one that cannot be read.
    """
    file = RecordingFile(path)
    ended = False

    def ends(place: int) -> bool:
        nonlocal ended
        ended = ended or progress(place / max(file.size, 1))
        return ended

    try:
        index, trail = Index(path, file.size), _Trail()
        for piece in file.pieces(ends):
            if ends(piece.place):
                break
            if len(index.stretches) >= MAX_STRETCHES:
                file.problems.append(tr(TOO_LONG))
                break
            _take(index, piece, file.read(piece), trail)
    finally:
        file.close()
    if ended:
        return None
    if not index.stretches or not any(topic.type for topic in index.topics.values()):
        foreign = " ".join(file.problems)
        raise RecordingError(f"{tr(NOTHING).format(name=path.name)} {foreign}".strip())
    index.channels, index.trail = file.channels, trail.places()
    index.problem = " ".join(file.problems)
    return index


def _take(index: Index, piece: Piece, records: list[Record], trail: _Trail) -> None:
    if not records:
        return
    times = [record.time for record in records]
    number = len(index.stretches)
    index.stretches.append(Stretch(piece, min(times), max(times)))
    index.start, index.end = min(index.start, *times), max(index.end, *times)
    for record in records:
        channel = record.channel
        topic = index.topics.setdefault(channel.topic, Topic(channel.topic, channel.kind, channel.type))
        topic.count += 1
        if not topic.stretches or topic.stretches[-1] != number:
            topic.stretches.append(number)
        if channel.topic in (EVENTS, POSE, INFO):
            _note(index, record, trail)


def _note(index: Index, record: Record, trail: _Trail) -> None:
    if len(record.raw) > MAX_NOTED:
        return
    message = record.message()
    if isinstance(message, Event) and len(index.events) < MAX_EVENTS:
        index.events.append((record.time, message))
    elif isinstance(message, RobotInfo):
        index.info = message
    elif isinstance(message, PoseWithCovarianceStamped):
        place = message.pose.pose.position
        trail.add(record.time, place.x, place.y)


class _Trail:
    """Where the robot was, in ever larger steps where there are too many."""

    def __init__(self) -> None:
        self._places: list[tuple[float, float, float]] = []
        self._every, self._left = 1, 0

    def add(self, time: float, x: float, y: float) -> None:
        """Keep a place, or pass it over."""
        self._left -= 1
        if self._left > 0 or not (math.isfinite(x) and math.isfinite(y)):
            return
        self._left = self._every
        self._places.append((time, x, y))
        if len(self._places) > MAX_TRAIL:
            self._places, self._every = self._places[::2], self._every * 2

    def places(self) -> NDArray[np.float64]:
        """All of them, shape (n, 3)."""
        return np.array(self._places).reshape(-1, 3)


def series(
    index: Index, topic: str, path: str, progress: Progress = lambda _: False
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Times [s since 1970] and values of a field over the whole recording; NaN where it told nothing. None where it was ended.

    Thinned where there are too many, spikes kept. OSError for a file that cannot be read any more.
    """
    from widgets.plots.history import MAX_SAMPLES, thinned

    file = RecordingFile(index.path)
    file.channels = dict(index.channels)
    times, values = np.empty(0), np.empty(0)
    fresh: list[tuple[float, float]] = []
    numbers = index.topics[topic].stretches if topic in index.topics else []
    try:
        for done, number in enumerate(numbers):
            if progress(done / len(numbers)):
                return None
            records = file.read(index.stretches[number].piece)
            fresh += [(one.time, _value(one, path)) for one in records if one.channel.topic == topic]
            if len(fresh) + len(times) > MAX_SERIES:
                times, values = thinned(*_joined(times, values, fresh), MAX_SAMPLES)
                fresh = []
    finally:
        file.close()
    return thinned(*_joined(times, values, fresh), MAX_SAMPLES)


def _joined(
    times: NDArray[np.float64], values: NDArray[np.float64], fresh: list[tuple[float, float]]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    more = np.array(sorted(fresh, key=lambda one: one[0])).reshape(-1, 2)
    return np.concatenate([times, more[:, 0]]), np.concatenate([values, more[:, 1]])


def _value(record: Record, path: str) -> float:
    message = record.message()
    try:
        return number_at(message, path) if message is not None else math.nan
    except (AttributeError, IndexError, TypeError, ValueError):
        return math.nan
