"""A recording as it was written, cut off, damaged, foreign, and no recording at all."""

from __future__ import annotations

import math
import struct
import tracemalloc
from pathlib import Path

import lz4.frame
import pytest
import zstandard
from mcap.writer import CompressionType, Writer

from app.replay import recording_file, recording_index, recording_list
from app.replay.recording_file import (
    ASK_EVERY,
    CUT,
    DAMAGED,
    FRAME,
    MAGIC,
    MAX_PIECE,
    MAX_RECORDS,
    RecordingError,
    RecordingFile,
)
from app.replay.recording_index import TOO_LONG, index_of, series
from app.replay.recording_list import glimpse
from tests.app.replay.made import PERIOD, START, recorded

SMALL = 4000
"""Size of a chunk, so that a short recording has many [byte]."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return recorded(tmp_path_factory.mktemp("recordings") / "run.mcap", pieces=SMALL)


def cut(whole: Path, path: Path, part: float) -> Path:
    """What is left where the power is cut when that part of the messages is written."""
    file = RecordingFile(whole)
    last = list(file.pieces())[-1]
    file.close()
    path.write_bytes(whole.read_bytes()[: round((last.place + last.size) * part)])
    return path


def test_an_index_says_what_is_in_it_and_when(whole: Path) -> None:
    index = index_of(whole)
    assert index is not None
    assert (index.start, index.end) == (START, pytest.approx(START + 10.0))
    assert index.topics["/odom"].count == 101
    assert index.topics["/odom"].kind == "nav_msgs/Odometry"
    assert len(index.stretches) > 5
    assert [event.text for _, event in index.events] == ["At 10", "At 30", "At 50", "At 70", "At 90"]
    assert index.events[2][0] == pytest.approx(START + 50 * PERIOD)
    assert index.trail.shape == (101, 3)
    assert index.trail[-1, 1] == pytest.approx(10.0)
    assert index.info is not None
    assert index.info.name == "Patrol-1"
    assert index.problem == ""


def test_progress_rises_and_may_end_the_work(whole: Path) -> None:
    told: list[float] = []
    assert index_of(whole, lambda part: bool(told.append(part))) is not None
    assert told == sorted(told)
    assert 0.0 <= told[0] < told[-1] <= 1.0
    assert index_of(whole, lambda part: part > 0.5) is None


@pytest.mark.parametrize("part", [0.3, 0.5, 0.77, 0.95])
def test_a_file_that_was_cut_off_opens_as_far_as_it_goes(whole: Path, tmp_path: Path, part: float) -> None:
    index = index_of(cut(whole, tmp_path / "cut.mcap", part))
    assert index is not None
    assert index.problem == CUT
    assert START < index.end <= START + 10.0
    assert 0 < index.topics["/odom"].count <= 101
    assert glimpse(tmp_path / "cut.mcap").problem == CUT


def test_every_place_to_cut_it_gives_an_index_or_a_sentence(tmp_path: Path) -> None:
    short = recorded(tmp_path / "short.mcap", 0.5, pieces=1000).read_bytes()
    path, opened = tmp_path / "cut.mcap", 0
    for length in range(0, len(short), 97):
        path.write_bytes(short[:length])
        opened += sentence_of(path) == ""
    assert opened > 3


def sentence_of(path: Path) -> str:
    """Why it does not open; empty where it does."""
    try:
        return "" if index_of(path) is not None else "ended"
    except RecordingError as error:
        return str(error)


def test_a_damaged_part_is_left_out_and_said(whole: Path, tmp_path: Path) -> None:
    data = bytearray(whole.read_bytes())
    file = RecordingFile(whole)
    piece = list(file.pieces())[3]
    file.close()
    data[piece.place + 60 : piece.place + 80] = bytes(20)
    path = tmp_path / "damaged.mcap"
    path.write_bytes(data)
    index = index_of(path)
    assert index is not None
    assert index.problem == DAMAGED
    assert index.end == pytest.approx(START + 10.0)
    assert index.topics["/odom"].count < 101


@pytest.mark.parametrize(
    ("data", "sentence"),
    [
        (b"", "nonsense.mcap is empty: nothing was recorded."),
        (b"PK\x03\x04 not at all", "nonsense.mcap is no recording: it does not begin as an MCAP file."),
        (b"\x89MCAP0\r\n" + b"\xff" * 400, f"nonsense.mcap holds no messages that this app can show. {CUT}"),
    ],
)
def test_nonsense_gets_a_sentence(tmp_path: Path, data: bytes, sentence: str) -> None:
    path = tmp_path / "nonsense.mcap"
    path.write_bytes(data)
    with pytest.raises(RecordingError) as refused:
        index_of(path)
    assert str(refused.value) == sentence
    assert glimpse(path).problem


def test_a_length_that_no_chunk_has_is_not_believed(whole: Path, tmp_path: Path) -> None:
    file = RecordingFile(whole)
    piece = next(file.pieces())
    file.close()
    data = bytearray(whole.read_bytes())
    data[piece.place + 16 : piece.place + 24] = (MAX_PIECE * 1000).to_bytes(8, "little")
    path = tmp_path / "bomb.mcap"
    path.write_bytes(data)
    index = index_of(path)
    assert index is not None
    assert DAMAGED in index.problem


def record(opcode: int, body: bytes) -> bytes:
    return FRAME.pack(opcode, len(body)) + body


def chunk(packing: str, data: bytes, claimed: int) -> bytes:
    """A chunk that claims so many bytes once it is unpacked."""
    name = packing.encode()
    head = struct.pack("<QQQII", 0, 1, claimed, 0, len(name)) + name
    return record(6, head + struct.pack("<Q", len(data)) + data)


@pytest.mark.parametrize("packing", ["zstd", "lz4"])
def test_a_chunk_is_unpacked_no_further_than_it_claims(tmp_path: Path, packing: str) -> None:
    """40 MB of zeros in some kilobytes."""
    plain = bytes(40 * 2**20)
    packed = zstandard.compress(plain) if packing == "zstd" else lz4.frame.compress(plain)
    path = tmp_path / "bomb.mcap"
    path.write_bytes(MAGIC + chunk(packing, packed, claimed=1000))
    del plain
    file = RecordingFile(path)
    tracemalloc.start()
    try:
        assert file.read(next(file.pieces())) == []
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
        file.close()
    assert most < 5 * 2**20
    assert file.problems == [DAMAGED]


@pytest.mark.parametrize("packing", ["zstd", "lz4", ""])
def test_what_is_packed_in_either_way_is_read(whole: Path, tmp_path: Path, packing: str) -> None:
    file = RecordingFile(whole)
    piece = next(file.pieces())
    plain = recording_file._unpacked(whole.read_bytes()[piece.place : piece.place + piece.size])
    expected = file.read(piece)
    file.close()
    packed = {"zstd": zstandard.compress, "lz4": lz4.frame.compress, "": bytes}[packing](plain)
    path = tmp_path / "packed.mcap"
    path.write_bytes(MAGIC + chunk(packing, packed, claimed=len(plain)))
    other = RecordingFile(path)
    assert other.read(next(other.pieces())) == expected
    other.close()


def test_a_chunk_of_more_records_than_memory_has_room_for_is_left_out(tmp_path: Path) -> None:
    plain = record(
        4, struct.pack("<HHI", 1, 0, 2) + b"/a" + struct.pack("<I", 4) + b"json" + struct.pack("<I", 0)
    )
    plain += record(5, bytes(22)) * MAX_RECORDS
    path = tmp_path / "many.mcap"
    path.write_bytes(MAGIC + chunk("zstd", zstandard.compress(plain), claimed=len(plain)))
    with pytest.raises(RecordingError, match=r"A part of it is damaged and was left out\."):
        index_of(path)


def test_a_long_file_without_chunks_is_passed_over_only_so_far_and_only_as_long_as_wanted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "loose.mcap"
    path.write_bytes(MAGIC + record(12, b"") * (20 * ASK_EVERY))
    asked: list[int] = []
    file = RecordingFile(path)
    assert list(file.pieces(lambda place: len(asked.append(place) or asked) == 3)) == []  # type: ignore[func-returns-value]
    file.close()
    assert asked == [len(MAGIC) + (number * ASK_EVERY - 1) * FRAME.size for number in (1, 2, 3)]
    ended: list[bool] = []
    glimpse(path, lambda: bool(ended.append(True)) or True)
    assert len(ended) == 1, "looking ends when it is asked to"
    assert index_of(path, lambda _: True) is None, "reading too, where nothing is found for long"
    looks: list[int] = []
    monkeypatch.setattr(recording_list, "MAX_STEPS", 5 * ASK_EVERY)
    glimpse(path, lambda: bool(looks.append(1)))
    assert len(looks) == 5


def test_where_the_end_is_not_found_in_time_the_length_is_not_known(
    whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recording_list, "MAX_STEPS", 0)
    monkeypatch.setattr(recording_file, "ASK_EVERY", 3)
    seen = glimpse(whole)
    assert (seen.robot, seen.start, seen.problem) == ("Patrol-1", START, "")
    assert math.isnan(seen.duration)


def test_more_pieces_than_are_known_are_left_out_and_that_is_said(
    whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recording_index, "MAX_STRETCHES", 3)
    index = index_of(whole)
    assert index is not None
    assert (len(index.stretches), index.problem) == (3, TOO_LONG)


def test_a_message_that_fills_the_memory_is_not_read_and_an_event_of_that_size_not_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = recorded(tmp_path / "run.mcap", 2.0)
    monkeypatch.setattr(recording_index, "MAX_NOTED", 10)
    index = index_of(whole)
    assert index is not None
    assert (index.events, index.info, len(index.trail)) == ([], None, 0)
    monkeypatch.setattr(recording_file, "MAX_MESSAGE", 10)
    found = series(index, "/odom", "twist.twist.linear.x")
    assert found is not None
    assert all(math.isnan(value) for value in found[1])


def test_a_file_without_chunks_is_read_as_well(tmp_path: Path) -> None:
    path = tmp_path / "plain.mcap"
    with path.open("wb") as file:
        writer = Writer(file, use_chunking=False, compression=CompressionType.NONE)
        writer.start()
        kind = writer.register_schema("std_msgs/msg/Float64", "jsonschema", b"{}")
        channel = writer.register_channel("/level", "json", kind)
        for number in range(20):
            writer.add_message(channel, number * 10**9, b'{"data": %d}' % number, number * 10**9)
        writer.finish()
    index = index_of(path)
    assert index is not None
    found = series(index, "/level", "data")
    assert found is not None
    assert found[1].tolist() == list(range(20))


def test_messages_in_another_encoding_are_named(tmp_path: Path) -> None:
    path = tmp_path / "foreign.mcap"
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        kind = writer.register_schema("std_msgs/msg/Float64", "ros2msg", b"float64 data")
        writer.add_message(writer.register_channel("/level", "cdr", kind), 1, bytes(12), 1)
        writer.finish()
    with pytest.raises(RecordingError, match="Messages in cdr are left out"):
        index_of(path)


def test_a_series_has_each_message_and_its_spike(whole: Path) -> None:
    index = index_of(whole)
    assert index is not None
    found = series(index, "/odom", "twist.twist.linear.x")
    assert found is not None
    times, values = found
    assert times[0] == START
    assert len(times) == 101
    assert values[50] == 9.0


def test_a_field_that_is_not_there_is_a_hole(whole: Path) -> None:
    index = index_of(whole)
    assert index is not None
    found = series(index, "/odom", "speed")
    assert found is not None
    assert all(math.isnan(value) for value in found[1])
    nothing = series(index, "/nowhere", "data")
    assert nothing is not None
    assert len(nothing[0]) == 0


def test_a_glimpse_tells_robot_time_length_and_size(whole: Path) -> None:
    seen = glimpse(whole)
    assert (seen.robot, seen.start, seen.problem) == ("Patrol-1", START, "")
    assert seen.duration == pytest.approx(10.0)
    assert seen.size == whole.stat().st_size


def test_a_glimpse_of_what_is_gone_says_so(tmp_path: Path) -> None:
    assert "No such file" in glimpse(tmp_path / "gone.mcap").problem
