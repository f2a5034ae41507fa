"""What the app knows of a camera: a good picture is believed for a second, and a refused one is said beside the last good one."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.link.camera_decoder import Picture
from app.session.picture_feed import PictureFeed

SENTENCE = "The picture is neither JPEG nor PNG."


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def shell() -> Any:
    """A screen with a camera's picture."""
    video = SimpleNamespace(age=0.0, state="never", refusal="")
    return SimpleNamespace(shown=SimpleNamespace(picture=video, show_picture=lambda *_: None))


def test_a_refused_picture_is_said_and_the_last_good_one_grows_old(clock: Clock, shell: Any) -> None:
    feed, video = PictureFeed(clock), shell.shown.picture
    feed.show(Picture(1, 0.0, 1, 1, bytes(4)), 100.0, shell, None)
    feed.refuse(SENTENCE)
    clock.now = 100.5
    feed.judge(shell)
    assert (video.state, video.refusal) == ("live", ""), "one bad picture among good ones is no news"
    clock.now = 105.0
    feed.judge(shell)
    assert (video.state, video.age, video.refusal) == ("stale", 5.0, SENTENCE)
    feed.show(Picture(2, 0.0, 1, 1, bytes(4)), 105.0, shell, None)
    clock.now = 107.0
    feed.judge(shell)
    assert (video.state, video.refusal) == ("stale", ""), "it is silent, and was not refused"


def test_a_camera_of_which_every_picture_is_refused_says_so(clock: Clock, shell: Any) -> None:
    feed, video = PictureFeed(clock), shell.shown.picture
    feed.refuse(SENTENCE)
    feed.judge(shell)
    assert (video.state, video.refusal) == ("never", SENTENCE)
    feed.forget()
    feed.judge(shell)
    assert video.refusal == "", "the next robot's pictures were not refused"


def test_a_frozen_camera_that_gives_the_same_exposure_again_grows_old(clock: Clock, shell: Any) -> None:
    feed, video = PictureFeed(clock), shell.shown.picture
    for number in range(20):
        clock.now = 100.0 + number * 0.1
        feed.show(Picture(number, 7.0, 1, 1, bytes(4)), clock.now, shell, None)
        feed.judge(shell)
    assert video.state == "stale"
    assert video.age >= 1.0


def test_the_same_pixels_with_a_later_stamp_are_fresh(clock: Clock, shell: Any) -> None:
    feed, video, pixels = PictureFeed(clock), shell.shown.picture, bytes(4)
    for number in range(20):
        clock.now = 100.0 + number * 0.1
        feed.show(Picture(number, 7.0 + number * 0.1, 1, 1, pixels), clock.now, shell, None)
        feed.judge(shell)
    assert (video.state, video.age) == ("live", 0.0)
