"""How old pictures are when they are written."""

from __future__ import annotations

from robotside.gateways.video.delays import MAX_SAMPLES, Delay, Delays


def test_nothing_is_said_before_somebody_looked() -> None:
    delays = Delays()
    delays.note("/camera", "mp4", 0.01)
    assert delays.of("/camera", "webm") is None
    assert delays.of("/rear", "mp4") is None


def test_the_median_and_the_tail_are_those_of_the_newest_pictures() -> None:
    delays = Delays()
    for _ in range(50):
        delays.note("/camera", "mjpeg", 9.0)
    for number in range(MAX_SAMPLES):
        delays.note("/camera", "mjpeg", number / 1000)
    assert delays.of("/camera", "mjpeg") == Delay(0.150, 0.297, MAX_SAMPLES)


def test_one_picture_is_a_measurement() -> None:
    delays = Delays()
    delays.note("/camera", "mjpeg", 0.005)
    assert delays.of("/camera", "mjpeg") == Delay(0.005, 0.005, 1)
