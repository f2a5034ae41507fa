"""A recording on the disk, read piece by piece: as far as it goes where the power was cut, and never more of it than a piece at once."""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

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
MESSAGE_HEAD = struct.Struct("<HIQQ")
"""Before what a message says: its channel, number, and times of coming and sending [ns]."""
MAX_PIECE = 64 * 2**20
"""Longest record, and longest chunk once unpacked, that is read [byte]: neither a damaged length nor a chunk that unpacks to more than it
claims is followed any further."""
MAX_RECORDS = 300_000
"""Of one piece; one with more is left out: it is made to fill the memory."""
MAX_MESSAGE = 16 * 2**20
"""Longest message that is read [byte]."""
MAX_TOPIC = 400
"""Letters of a topic's name, and of its type's."""
ASK_EVERY = 1000
"""Records that are passed over before it is asked whether to go on."""
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
        if kind is None or len(self.raw) > MAX_MESSAGE:
            return None
        try:
            return codec.from_json(self.raw, kind)
        except (ProtocolError, RecursionError):
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
            raise RecordingError(sentence.format(name=path.name))

    def close(self) -> None:
        """Let go of the file."""
        self._file.close()

    def _blame(self, sentence: str) -> None:
        if sentence not in self.problems:
            self.problems.append(sentence)

    def pieces(self, ends: Callable[[int], bool] = lambda _: False) -> Iterator[Piece]:
        """All pieces in their order, found by their lengths alone; ends where the file ends or makes no sense.

        `ends` is told every so many records how far it is [byte]; where it says True nothing more is looked for.
        """
        place, plain, count = len(MAGIC), 0, 0
        while True:
            count += 1
            if count % ASK_EVERY == 0 and ends(place):
                return
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
        """The messages of a piece, in the order of the file; none of one that is damaged, or larger than may be."""
        self._file.seek(piece.place)
        data = self._file.read(piece.size)
        try:
            return self._records(_unpacked(data) if piece.packed else data)
        except Exception:  # noqa: BLE001 - what unpacks has errors of its own, which the library hands on
            self._blame(tr(DAMAGED))
            return []

    def _records(self, data: bytes) -> list[Record]:
        """What stands in a piece; ValueError or struct.error where its lengths make no sense."""
        found: list[Record] = []
        at = count = 0
        while at < len(data):
            opcode, length = FRAME.unpack_from(data, at)
            at, count = at + FRAME.size, count + 1
            if at + length > len(data) or count > MAX_RECORDS:
                raise ValueError(f"{count} records, the last of {length} bytes")
            if opcode == MESSAGE:
                number, _, time, _ = MESSAGE_HEAD.unpack_from(data, at)
                if number in self.channels:
                    raw = data[at + MESSAGE_HEAD.size : at + length]
                    found.append(Record(self.channels[number], time / 1e9, raw))
            elif opcode in (SCHEMA, CHANNEL):
                self._learn(opcode, data[at : at + length])
            at += length
        return found

    def _learn(self, opcode: int, data: bytes) -> None:
        """Take in the name of a type, or a topic."""
        from mcap import records
        from mcap.data_stream import ReadDataStream

        stream = ReadDataStream(BytesIO(data))
        if opcode == SCHEMA:
            schema = records.Schema.read(stream)
            self._kinds[schema.id] = ros1_name(schema.name[:MAX_TOPIC])
            return
        channel = records.Channel.read(stream)
        if channel.id in self.channels:  # known from the index; its schema may stand in another piece
            return
        if len(channel.topic) > MAX_TOPIC:
            self._blame(tr(DAMAGED))
            return
        kind = self._kinds.get(channel.schema_id, "")
        self.channels[channel.id] = Channel(channel.topic, kind, channel.message_encoding)
        if channel.message_encoding != "json":
            self._blame(tr(FOREIGN).format(encoding=channel.message_encoding[:40]))


def _unpacked(data: bytes) -> bytes:
    """What a chunk holds; ValueError, or what its packing raises, where that is damaged or not as long as it claims."""
    from mcap.data_stream import ReadDataStream
    from mcap.records import Chunk

    size = CHUNK_HEAD.unpack_from(data)[2]
    if size > MAX_PIECE:
        raise ValueError(f"a chunk of {size} bytes")
    chunk = Chunk.read(ReadDataStream(BytesIO(data)))
    if chunk.compression == "zstd":
        import zstandard

        with zstandard.ZstdDecompressor(max_window_size=MAX_PIECE).stream_reader(chunk.data) as stream:
            plain = stream.read(size + 1)
    elif chunk.compression == "lz4":
        import lz4.frame

        plain = lz4.frame.LZ4FrameDecompressor().decompress(chunk.data, max_length=size + 1)
    else:
        plain = chunk.data
    if len(plain) != size:
        raise ValueError(f"a chunk that does not hold the {size} bytes that it claims")
    if chunk.uncompressed_crc not in (0, zlib.crc32(plain)):
        raise ValueError("a chunk that is damaged")
    return plain
