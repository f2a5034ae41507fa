"""A recording on the disk, read piece by piece: as far as it goes where the power was cut, and never more of it than a piece at once."""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

from bridge.core.errors import ProtocolError
from bridge.msgs import TYPES, Msg, ros1_name
from widgets.core.language import mark, tr

__all__ = ["Channel", "Piece", "Record", "RecordingError", "RecordingFile"]

MAGIC = b"\x89MCAP0\r\n"
FRAME = struct.Struct("<BQ")
"""Before each record: what it is, and how long."""
CHUNK_HEAD = struct.Struct("<QQQ")
"""Before a chunk: its first and last time [ns], and its size once unpacked."""
SCHEMA, CHANNEL, MESSAGE, CHUNK = 3, 4, 5, 6
ENDS = (2, 15)
"""The index of the whole file, which is not needed here, or its end."""
MAX_PIECE = 64 * 2**20
"""Longest record, and longest chunk once unpacked, that is read [byte]: a damaged length is not believed."""
PLAIN_PIECE = 2**20
"""So much of a file without chunks is one piece [byte]."""
NO_RECORDING = mark("{name} is no recording: it does not begin as an MCAP file.")
EMPTY = mark("{name} is empty: nothing was recorded.")
CUT = mark("It ends in the middle, as after a power cut: what was written before is here.")
DAMAGED = mark("A part of it is damaged and was left out.")
FOREIGN = mark("Messages in {encoding} are left out: this app reads those in JSON.")


class RecordingError(Exception):
    """A file that cannot be opened as a recording; its text is a sentence for people."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A stretch of the file."""

    place: int
    """Where it begins [byte]."""
    size: int
    """[byte]"""
    packed: bool
    """It is a chunk."""


@dataclass(frozen=True, slots=True)
class Channel:
    """One topic of the file."""

    topic: str
    kind: str
    """ROS 1 name of its type."""
    encoding: str

    @property
    def type(self) -> type[Msg] | None:
        """Class of its messages; None where this app does not know it."""
        return TYPES.get(self.kind) if self.encoding == "json" else None


@dataclass(frozen=True, slots=True)
class Record:
    """A message as it stands in the file."""

    channel: Channel
    time: float
    """When it came [s since 1970], by the clock of the handheld that recorded it."""
    raw: bytes

    def message(self) -> Msg | None:
        """What it says; None where that cannot be read."""
        from bridge import codec

        kind = self.channel.type
        try:
            return codec.from_json(self.raw, kind) if kind is not None else None
        except ProtocolError:
            return None


class RecordingFile:
    """An open file. Whoever opens it closes it; one thread at a time."""

    def __init__(self, path: Path) -> None:
        """RecordingError for a file that is no recording, OSError for one that cannot be read."""
        self.path = path
        self._file = path.open("rb")
        self.size = path.stat().st_size
        """[byte]"""
        self.channels: dict[int, Channel] = {}
        """What has been met so far, by the number that messages carry."""
        self._kinds: dict[int, str] = {}
        self.problems: list[str] = []
        """What is wrong with it, a sentence each."""
        begin = self._file.read(len(MAGIC))
        if begin != MAGIC:
            self._file.close()
            sentence = tr(NO_RECORDING) if begin else tr(EMPTY)
            raise RecordingError(tr(sentence).format(name=path.name))

    def close(self) -> None:
        """Let go of the file."""
        self._file.close()

    def _blame(self, sentence: str) -> None:
        if sentence not in self.problems:
            self.problems.append(sentence)

    def pieces(self) -> Iterator[Piece]:
        """All pieces in their order, found by their lengths alone; ends where the file ends or makes no sense."""
        place, plain = len(MAGIC), 0
        while True:
            self._file.seek(place)
            frame = self._file.read(FRAME.size)
            opcode, length = FRAME.unpack(frame) if len(frame) == FRAME.size else (0, 0)
            ended = opcode in ENDS
            cut = not ended and (
                len(frame) < FRAME.size or length > MAX_PIECE or place + FRAME.size + length > self.size
            )
            loose = not ended and not cut and opcode in (SCHEMA, CHANNEL, MESSAGE)
            if plain and (not loose or place - plain >= PLAIN_PIECE):
                yield Piece(plain, place - plain, packed=False)
                plain = 0
            if ended or cut:
                if cut:
                    self._blame(tr(CUT))
                return
            if loose and not plain:
                plain = place
            elif opcode == CHUNK:
                yield Piece(place + FRAME.size, length, packed=True)
            place += FRAME.size + length

    def span(self, piece: Piece) -> tuple[float, float]:
        """First and last time of a piece [s since 1970], as its head says; NaN for none."""
        if not piece.packed:
            times = [record.time for record in self.read(piece)]
            return (min(times), max(times)) if times else (math.nan, math.nan)
        self._file.seek(piece.place)
        head = self._file.read(CHUNK_HEAD.size)
        if len(head) < CHUNK_HEAD.size:
            return math.nan, math.nan
        first, last, _ = CHUNK_HEAD.unpack(head)
        return first / 1e9, last / 1e9

    def read(self, piece: Piece) -> list[Record]:
        """The messages of a piece, in the order of the file; none of one that is damaged."""
        from mcap.exceptions import McapError

        self._file.seek(piece.place)
        data = self._file.read(piece.size)
        try:
            parts = self._unpack(data) if piece.packed else self._split(data)
        except (McapError, ValueError, struct.error, EOFError, RuntimeError, OSError):
            self._blame(tr(DAMAGED))
            return []
        except Exception:  # noqa: BLE001 - what unpacks has errors of its own, which the library hands on
            self._blame(tr(DAMAGED))
            return []
        return self._records(parts)

    def _unpack(self, data: bytes) -> list[Any]:
        from mcap.data_stream import ReadDataStream
        from mcap.records import Chunk
        from mcap.stream_reader import breakup_chunk

        if CHUNK_HEAD.unpack_from(data)[2] > MAX_PIECE:
            raise ValueError(tr("a chunk that is too large"))
        return list(breakup_chunk(Chunk.read(ReadDataStream(BytesIO(data))), validate_crc=True))

    @staticmethod
    def _split(data: bytes) -> list[Any]:
        from mcap.records import Chunk
        from mcap.stream_reader import breakup_chunk

        return list(breakup_chunk(Chunk("", data, 0, 0, 0, len(data))))

    def _records(self, parts: list[Any]) -> list[Record]:
        from mcap import records

        found: list[Record] = []
        for part in parts:
            if isinstance(part, records.Schema):
                self._kinds[part.id] = ros1_name(part.name)
            elif isinstance(part, records.Channel):
                if part.id in self.channels:  # known from the index; its schema may stand in another piece
                    continue
                kind = self._kinds.get(part.schema_id, "")
                self.channels[part.id] = Channel(part.topic, kind, part.message_encoding)
                if part.message_encoding != "json":
                    self._blame(tr(FOREIGN).format(encoding=part.message_encoding))
            elif part.channel_id in self.channels:
                found.append(Record(self.channels[part.channel_id], part.log_time / 1e9, part.data))
        return found
