"""A recording that is played: its moment, its speed, its feeds."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.link.feeds import Post
from app.replay import player
from app.replay.player import Player
from tests.app.glass import PATIENCE
from tests.app.replay.made import START, recorded


class Played:
    """A player on a clock of the test's own."""

    def __init__(self, path: Path) -> None:
        self.now = 100.0
        self.heard: list[tuple[str, Any]] = []
        self.player = Player(path, lambda: self.now)
        self.player.listeners.append(self._hear)

    def _hear(self, channel: str, post: Post) -> None:
        self.heard.append((channel, post.value))

    def until(self, condition: Callable[[], Any]) -> None:
        end = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < end
            self.player.drain()
            time.sleep(0.001)

    def speed(self) -> float:
        return float(self.player.feeds.latest("/odom").twist.twist.linear.x)

    def heard_at(self, seconds: float) -> Callable[[], bool]:
        """The odometry of that moment has come."""

        def came() -> bool:
            feed = self.player.feeds["/odom"]
            return feed.message is not None and abs(feed.received - START - seconds) < 0.01

        return came

    def pass_(self, seconds: float) -> None:
        self.now += seconds
        self.player.tick()


@pytest.fixture
def played(tmp_path: Path, stage: Any) -> Iterator[Played]:
    made = Played(recorded(tmp_path / "run.mcap", pieces=4000))
    made.until(lambda: made.player.index is not None)
    yield made
    made.player.close()


def test_it_opens_at_its_beginning_and_stands_still(played: Played) -> None:
    assert played.player.position == START
    played.until(played.heard_at(0.0))
    played.pass_(0.5)
    assert played.player.position == START


def test_it_plays_as_fast_as_it_is_told(played: Played) -> None:
    played.player.play()
    played.pass_(0.5)
    assert played.player.position == pytest.approx(START + 0.5)
    played.player.speed = 10.0
    played.pass_(0.25)
    assert played.player.position == pytest.approx(START + 3.0)
    played.until(played.heard_at(3.0))
    assert played.speed() == pytest.approx(0.3)
    played.player.pause()
    played.pass_(0.5)
    assert played.player.position == pytest.approx(START + 3.0)


def test_an_app_that_was_away_skips_nothing(played: Played) -> None:
    played.player.play()
    played.pass_(3600.0)
    assert played.player.position <= START + 1.0


def test_at_its_end_it_stands_and_plays_again_from_the_beginning(played: Played) -> None:
    played.player.seek(START + 9.8)
    played.player.play()
    played.pass_(0.9)
    assert played.player.position == pytest.approx(START + 10.0)
    assert not played.player.playing
    played.player.play()
    assert played.player.position == START


def test_going_back_leaves_nothing_of_later(played: Played) -> None:
    played.player.seek(START + 9.0)
    played.until(played.heard_at(9.0))
    played.player.seek(START + 2.0)
    assert played.player.feeds.latest("/odom") is None
    played.until(played.heard_at(2.0))
    assert played.speed() == pytest.approx(0.2)


@pytest.mark.parametrize(("at", "comes_to"), [(-5.0, 0.0), (50.0, 10.0)])
def test_nobody_leaves_the_recording(played: Played, at: float, comes_to: float) -> None:
    played.player.seek(START + at)
    assert played.player.position == pytest.approx(START + comes_to)


def test_ages_are_those_of_the_moment(played: Played) -> None:
    played.player.seek(START + 5.04)
    played.until(played.heard_at(5.0))
    assert played.player.feeds.age("/odom") == pytest.approx(0.04)
    assert played.player.feeds.state("/odom") == "live"


def test_it_steps_from_event_to_event(played: Played) -> None:
    player = played.player
    player.step_event(1)
    assert player.position == pytest.approx(START + 1.0)
    player.step_event(1)
    assert player.position == pytest.approx(START + 3.0)
    player.step_event(-1)
    assert player.position == pytest.approx(START + 1.0)
    player.step_event(-1)
    assert player.position == pytest.approx(START + 1.0)


def test_a_field_is_read_over_the_whole_recording(played: Played) -> None:
    found: list[Any] = []
    played.player.series("/odom", "twist.twist.linear.x", found.append)
    played.until(lambda: found)
    times, values = found[0]
    assert len(times) == 101
    assert np.nanmax(values) == 9.0


def test_a_file_that_is_none_is_said(tmp_path: Path, stage: Any) -> None:
    path = tmp_path / "notes.mcap"
    path.write_text("Tuesday")
    played = Played(path)
    played.until(lambda: played.player.problem)
    assert played.player.problem == "notes.mcap is no recording: it does not begin as an MCAP file."
    played.player.play()
    played.player.seek(START)
    played.player.close()


@pytest.mark.parametrize("fault", [MemoryError(), RecursionError(), KeyError("x")])
def test_whatever_goes_wrong_while_it_is_opened_is_a_sentence(
    tmp_path: Path, stage: Any, monkeypatch: pytest.MonkeyPatch, fault: Exception, caplog: Any
) -> None:
    def fails(*_: object) -> None:
        raise fault

    monkeypatch.setattr(player, "index_of", fails)
    played = Played(tmp_path / "run.mcap")
    played.until(lambda: played.player.problem)
    assert played.player.problem == f"run.mcap cannot be read ({type(fault).__name__})."
    played.player.close()


def test_whatever_goes_wrong_while_it_is_played_is_a_sentence_and_it_stands(
    played: Played, caplog: Any
) -> None:
    played.until(played.heard_at(0.0))
    playback = played.player._playback
    assert playback is not None
    played.until(lambda: not playback._lock.locked())
    playback._let_go()
    played.player.path.write_bytes(b"another file")
    played.player.play()
    played.pass_(0.5)
    played.until(lambda: played.player.problem)
    assert "is no recording" in played.player.problem
    assert not played.player.playing


def test_a_number_that_cannot_be_gathered_is_said(
    played: Played, monkeypatch: pytest.MonkeyPatch, caplog: Any
) -> None:
    def fails(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr(player, "series", fails)
    played.player.series("/odom", "twist.twist.linear.x", lambda _: None)
    played.until(lambda: played.player.problem)
    assert played.player.problem == "run.mcap cannot be read (MemoryError)."
