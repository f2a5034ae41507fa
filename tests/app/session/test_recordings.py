"""Records: what was kept is said by its name, and what was not is said as well."""

from __future__ import annotations

import io
import threading
import time
from pathlib import Path

import pytest

from app.session.recordings import Recordings
from bridge.core.camera_frames import Frame
from bridge.msgs import Msg
from bridge.msgs.nav_msgs import Odometry


class Kept:
    """Records below one folder, with what was said and clocks that stand still."""

    def __init__(self, folder: Path) -> None:
        self.said: list[tuple[str, str]] = []
        self.wall, self.now = 1_700_000_000.0, 50.0
        self.records = Recordings(
            folder, lambda *said: self.said.append(said), lambda: self.wall, lambda: self.now
        )
        self.name = time.strftime("%Y-%m-%d_%H-%M-%S", time.localtime(self.wall))


@pytest.fixture
def kept(tmp_path: Path) -> Kept:
    return Kept(tmp_path)


@pytest.fixture
def full(monkeypatch: pytest.MonkeyPatch) -> None:
    """A disk on which a file can be made, and nothing written into it."""

    def opened(path: Path, mode: str) -> io.BufferedWriter:
        path.touch()
        return io.open("/dev/full", "wb")  # noqa: UP020 - Path.open is what is replaced

    monkeypatch.setattr(Path, "open", opened)


def files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.rglob("*") if path.is_file())


def test_a_recording_is_said_with_its_name(kept: Kept, tmp_path: Path) -> None:
    kept.records.toggle(None)
    kept.records.put("/odom", Odometry())
    kept.records.toggle(None)
    assert kept.said == [(f"Recording saved as {kept.name}.mcap.", "ok")]
    assert files(tmp_path) == [f"{kept.name}.mcap"]


@pytest.mark.usefixtures("full")
def test_a_recording_of_which_nothing_was_saved_is_said_and_leaves_no_file(
    kept: Kept, tmp_path: Path
) -> None:
    kept.records.toggle(None)
    kept.records.put("/odom", Odometry())
    kept.records.toggle(None)
    assert kept.said == [("Nothing was recorded: No space left on device.", "warn")]
    assert files(tmp_path) == []


@pytest.mark.usefixtures("full")
def test_a_failed_recording_is_said_when_the_next_one_starts(kept: Kept, tmp_path: Path) -> None:
    kept.records.start(tmp_path / "one.mcap", None)
    kept.records.start(tmp_path / "two.mcap", None)
    assert kept.said == [("Nothing was recorded: No space left on device.", "warn")]
    kept.records.stop()


def test_what_the_disk_was_too_slow_for_is_said_with_the_name(kept: Kept) -> None:
    kept.records.toggle(None)
    recorder = kept.records.recorder
    assert recorder is not None
    recorder.dropped = 3
    kept.records.toggle(None)
    assert kept.said == [
        (f"Recording saved as {kept.name}.mcap. Not recorded because the disk is too slow: 3.", "warn")
    ]


def test_a_recording_that_the_disk_has_ended_is_said_once(kept: Kept) -> None:
    kept.records.toggle(None)
    recorder, failed = kept.records.recorder, threading.Event()
    assert recorder is not None
    fail = recorder._fail

    def write(topic: str, message: Msg, at: float) -> None:
        raise OSError(28, "No space left on device")

    def noted(error: OSError) -> None:
        fail(error)
        failed.set()

    recorder._write, recorder._fail = write, noted  # type: ignore[method-assign]
    kept.records.put("/odom", Odometry())
    assert failed.wait(5)
    kept.records.check()
    kept.records.check()
    assert kept.said == [("The recording has ended: No space left on device.", "warn")]
    assert kept.records.clock == "Record"


@pytest.mark.usefixtures("full")
def test_a_snapshot_that_cannot_be_written_is_said_and_leaves_no_file(kept: Kept, tmp_path: Path) -> None:
    kept.records.frame = Frame(1, 0.0, 1, 1, b"picture")
    assert kept.records.snapshot() is None
    assert kept.said == [("The snapshot could not be saved: No space left on device.", "warn")]
    assert files(tmp_path) == []


def test_two_snapshots_of_the_same_second_are_both_kept(kept: Kept, tmp_path: Path) -> None:
    kept.records.frame = Frame(1, 0.0, 1, 1, b"first")
    first = kept.records.snapshot()
    kept.records.frame = Frame(2, 0.1, 1, 1, b"second")
    second = kept.records.snapshot()
    assert first is not None
    assert second is not None
    assert (first.name, first.read_bytes()) == (f"{kept.name}.jpg", b"first")
    assert (second.name, second.read_bytes()) == (f"{kept.name}_2.jpg", b"second")


def test_two_recordings_of_the_same_second_are_both_kept(kept: Kept, tmp_path: Path) -> None:
    for _ in range(6):
        kept.records.toggle(None)
    names = [f"{kept.name}.mcap", f"{kept.name}_2.mcap", f"{kept.name}_3.mcap"]
    assert files(tmp_path) == names


def test_a_file_that_is_there_is_not_recorded_over(kept: Kept, tmp_path: Path) -> None:
    (tmp_path / "run.mcap").write_text("before")
    assert kept.records.start(tmp_path / "run.mcap", None) is False
    assert kept.said == [("The recording could not start: File exists.", "warn")]
    assert (tmp_path / "run.mcap").read_text() == "before"


def test_the_clock_of_a_recording_goes_on_while_the_time_of_day_is_set_back(kept: Kept) -> None:
    kept.records.toggle(None)
    kept.wall -= 3600.0
    kept.now += 271.0
    assert kept.records.clock == "04:31"
    kept.records.stop()


def test_what_was_recorded_into_the_old_folder_is_still_found(tmp_path: Path) -> None:
    new, old = tmp_path / "Documents", tmp_path / "own"
    records = Recordings(new, lambda *_: None, old=old)
    for place, name in ((old, "2025-01-01_10-00-00"), (new, "2026-01-01_10-00-00")):
        for folder, ending in (("recordings", "mcap"), ("pictures", "jpg")):
            (place / folder).mkdir(parents=True, exist_ok=True)
            (place / folder / f"{name}.{ending}").write_bytes(b"x")
    assert [path.parents[1] for path in records.files] == [new, old]
    assert len(records.kept()) == 4
    assert records.folders == (new, old)
