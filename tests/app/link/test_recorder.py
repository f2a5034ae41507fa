"""The recorder: what was put in comes out of the file, and what did not is said."""

from __future__ import annotations

import json
import math
import threading
from pathlib import Path

import pytest
from mcap.reader import make_reader

from app.link import recorder as recorder_module
from app.link.recorder import Recorder, schema
from bridge.msgs import TYPES, Msg
from bridge.msgs.arrays import Float32Array
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.sensor_msgs import LaserScan
from tests.looped import looped


def test_messages_come_back_with_topic_time_and_type(tmp_path: Path) -> None:
    times = iter([10.25, 11.5, 12.0])
    recorder = Recorder(tmp_path / "out" / "run.mcap", wall=lambda: next(times))
    recorder.put("/events", Event(id=1, text="First"))
    recorder.put("/scan", LaserScan(ranges=Float32Array([1.0, math.inf])))
    recorder.put("/events", Event(id=2, text="Second"))
    recorder.close()
    with recorder.path.open("rb") as file:
        read = [
            (s.name, c.topic, m.log_time, json.loads(m.data)) for s, c, m in make_reader(file).iter_messages()
        ]
    assert [(name, topic, at) for name, topic, at, _ in read] == [
        ("pilothouse_msgs/Event", "/events", 10_250_000_000),
        ("sensor_msgs/LaserScan", "/scan", 11_500_000_000),
        ("pilothouse_msgs/Event", "/events", 12_000_000_000),
    ]
    assert read[0][3]["text"] == "First"
    assert read[1][3]["ranges"] == [1.0, None]
    assert recorder.sentence == ""


def test_a_folder_that_cannot_be_made_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="Not a directory|File exists"):
        Recorder(tmp_path / "file" / "run.mcap")


def test_a_recording_that_is_there_is_not_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    path.write_bytes(b"yesterday")
    with pytest.raises(FileExistsError):
        Recorder(path)
    assert path.read_bytes() == b"yesterday"


class FullDisk:
    def add_message(self, *_: object) -> None:
        raise OSError(28, "No space left on device")


def test_a_full_disk_is_said_and_stops_nothing(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "run.mcap")
    recorder._writer.add_message = FullDisk().add_message  # type: ignore[method-assign]
    recorder.put("/odom", Odometry())
    recorder.put("/odom", Odometry())
    recorder.close()
    assert recorder.sentence == "The recording has ended: No space left on device."
    assert recorder.dropped == 2


def test_what_the_disk_is_too_slow_for_is_counted_and_said(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "run.mcap", waiting=2)
    busy, go_on = threading.Event(), threading.Event()
    write = recorder._write

    def slow(topic: str, message: Msg, at: float) -> None:
        busy.set()
        go_on.wait(5)
        write(topic, message, at)

    recorder._write = slow  # type: ignore[method-assign]
    recorder.put("/odom", Odometry())
    busy.wait(5)
    for _ in range(5):
        recorder.put("/odom", Odometry())
    go_on.set()
    recorder.close()
    assert recorder.dropped == 3
    assert recorder.sentence == "Not recorded because the disk is too slow: 3."


@looped("kind", [kind for name, kind in sorted(TYPES.items()) if "/" in name])
def test_every_message_type_has_a_schema(kind: type[Msg]) -> None:
    parsed = json.loads(schema(kind))
    assert parsed["type"] == "object"
    assert set(parsed["properties"]) == set(kind.__struct_fields__)


def test_a_message_that_cannot_be_written_is_counted_and_the_next_ones_are_recorded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """Were the thread to end, closing would wait for it for ever."""
    written = recorder_module.codec.to_json

    def to_json(message: Msg) -> bytes:
        if isinstance(message, LaserScan):
            raise OverflowError("odd")
        return written(message)

    monkeypatch.setattr(recorder_module.codec, "to_json", to_json)
    recorder = Recorder(tmp_path / "run.mcap", waiting=100)
    recorder.put("/scan", LaserScan())
    recorder.put("/events", Event(id=1))
    recorder.close()
    assert recorder.sentence == "Messages that could not be written: 1."
    with recorder.path.open("rb") as file:
        assert [c.topic for _, c, _ in make_reader(file).iter_messages()] == ["/events"]
