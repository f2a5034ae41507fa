"""The newest picture of a camera."""

from __future__ import annotations

import asyncio

import pytest

from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header
from robotside.gateways.video import newest_picture
from robotside.gateways.video.newest_picture import MAX_AGE, NewestPicture, Pace


def taken(stamp: float, data: bytes = b"x") -> CompressedImage:
    return CompressedImage(Header(Time.at(stamp)), data=data)


async def test_only_the_newest_is_given_and_only_once() -> None:
    newest = NewestPicture(lambda: 100.0)
    for data in (b"1", b"2"):
        newest.on_picture("", taken(99.0, data))
    assert (await newest.next()).data == b"2"
    waiting = asyncio.create_task(newest.next())
    await asyncio.sleep(0)
    assert not waiting.done()
    newest.on_picture("", taken(99.5, b"3"))
    assert (await waiting).data == b"3"


@pytest.mark.parametrize(
    ("stamp", "age"), [(99.75, 0.25), (100.0, 0.0), (0.0, 0.0), (101.0, 0.0), (99.0 - MAX_AGE, 0.0)]
)
async def test_its_age_is_its_stamps_unless_that_is_of_another_clock(stamp: float, age: float) -> None:
    newest = NewestPicture(lambda: 100.0)
    before = asyncio.get_running_loop().time()
    newest.on_picture("", taken(stamp))
    after = asyncio.get_running_loop().time()
    assert before - age - 1e-6 <= (await newest.next()).taken <= after - age + 1e-6


async def test_one_that_does_not_come_is_not_waited_for_for_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(newest_picture, "PICTURE_TIMEOUT", 0.01)
    with pytest.raises(TimeoutError):
        await NewestPicture(float).soon()


async def test_a_pace_without_a_limit_never_waits() -> None:
    pace = Pace(float("inf"))
    async with asyncio.timeout(60):
        for _ in range(100):
            await pace.wait()
