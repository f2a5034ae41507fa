"""The newest message of every topic at any moment, and never one of later."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.replay import playback
from app.replay.playback import MAX_PIECES, Playback
from app.replay.recording_file import RecordingError
from app.replay.recording_index import Index, index_of
from bridge.msgs import Msg
from tests.app.glass import PATIENCE
from tests.app.replay.made import PERIOD, START, recorded


@pytest.fixture(scope="module")
def index(tmp_path_factory: pytest.TempPathFactory) -> Index:
    found = index_of(recorded(tmp_path_factory.mktemp("recordings") / "run.mcap", pieces=4000))
    assert found is not None
    return found


class Told:
    def __init__(self, index: Index) -> None:
        self.newest: dict[str, tuple[float, Any]] = {}
        self.count = 0
        self.playback = Playback(index, self.take)

    def take(self, topic: str, message: Msg, at: float) -> None:
        self.newest[topic] = at, message
        self.count += 1


def test_a_moment_has_the_newest_of_each_topic(index: Index) -> None:
    told = Told(index)
    told.playback.tell(START + 3.04)
    assert told.newest["/odom"][0] == pytest.approx(START + 3.0)
    assert told.newest["/odom"][1].twist.twist.linear.x == pytest.approx(0.3)
    assert told.newest["/events"][1].text == "At 30"
    assert told.newest["/robot/info"][1].name == "Patrol-1"
    told.playback.close()


def test_what_has_not_changed_is_not_told_again(index: Index) -> None:
    told = Told(index)
    told.playback.tell(START + 3.04)
    count = told.count
    told.playback.tell(START + 3.06)
    assert told.count == count
    told.playback.tell(START + 3.04 + PERIOD)
    assert told.count == count + 2  # odometry and pose
    told.playback.close()


@given(st.lists(st.floats(-1.0, 12.0), min_size=1, max_size=12))
def test_whatever_way_leads_to_a_moment_it_is_the_same(index: Index, moments: list[float]) -> None:
    wandering, straight = Told(index), Told(index)
    for moment in moments:
        wandering.newest.clear()
        wandering.playback._held.clear()
        wandering.playback.tell(START + moment)
    straight.playback.tell(START + moments[-1])
    assert {name: at for name, (at, _) in wandering.newest.items()} == {
        name: at for name, (at, _) in straight.newest.items()
    }
    assert all(at <= START + moments[-1] for at, _ in wandering.newest.values())
    wandering.playback.close()
    straight.playback.close()


def test_few_pieces_are_kept_however_long_it_is(index: Index) -> None:
    told = Told(index)
    for number in range(100):
        told.playback.tell(START + number * PERIOD)
        assert len(told.playback._pieces) <= MAX_PIECES
    assert len(index.stretches) > MAX_PIECES
    told.playback.close()


def test_what_is_kept_is_bounded_in_bytes_too(index: Index, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(playback, "MAX_KEPT", 1)
    told = Told(index)
    for second in range(10):
        told.playback.tell(START + second)
        assert len(told.playback._pieces) == len(told.playback._sizes) == 1
    assert told.newest["/odom"][0] == pytest.approx(START + 9.0)
    told.playback.close()


def test_closing_waits_for_nothing_and_who_reads_lets_go_of_the_file(index: Index) -> None:
    reads, may_go_on = threading.Event(), threading.Event()

    def deliver(*_: object) -> None:
        reads.set()
        assert may_go_on.wait(PATIENCE)

    played = Playback(index, deliver)
    played.ask(START + 3.0)
    assert reads.wait(PATIENCE)
    file = played._file
    assert file is not None
    played.close()
    assert not file._file.closed, "it is still being read"
    may_go_on.set()
    thread = played._worker._thread
    assert thread is not None
    thread.join(PATIENCE)
    assert file._file.closed
    assert played._file is None


@pytest.mark.parametrize("content", [b"another file", None])
def test_a_file_that_became_another_one_is_told(tmp_path: Path, content: bytes | None) -> None:
    path = recorded(tmp_path / "run.mcap", pieces=4000)
    found = index_of(path)
    assert found is not None
    if content is None:
        path.unlink()
    else:
        path.write_bytes(content)
    failed: list[Exception] = []
    played = Playback(found, lambda *_: None, failed.append)
    played.ask(START)
    thread = played._worker._thread
    played._worker.close()
    assert thread is not None
    assert not thread.is_alive()
    assert isinstance(failed[0], RecordingError if content else OSError)
    played.close()
