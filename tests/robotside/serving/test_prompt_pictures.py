"""Pictures that do not wait for the tick."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from bridge.core.topics import CAMERA
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.core.robot import Prompt
from robotside.serving import prompt_pictures as prompt
from robotside.serving.prompt_pictures import prompt_pictures
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene


class Filming(FakeRobot):
    """Takes pictures when the test says so."""

    def __init__(self) -> None:
        super().__init__()
        self.taken: list[tuple[str, Msg]] = []
        self.ready: Callable[[], None] | None = None
        self.asked: list[float] = []

    def on_pictures(self, ready: Callable[[], None] | None) -> None:
        self.ready = ready

    def pictures(self, now: float) -> list[tuple[str, Msg]]:
        self.asked.append(now)
        taken, self.taken = self.taken, []
        return taken

    def shoot(self, data: bytes) -> None:
        self.taken.append((CAMERA, CompressedImage(data=data)))
        if self.ready:
            self.ready()


class Seen:
    """Who looks."""

    def __init__(self, scene: Scene) -> None:
        self.pictures: list[bytes] = []
        scene.station.bus.subscribe(CAMERA, self._on_picture)

    def _on_picture(self, _: str, msg: Msg) -> None:
        assert isinstance(msg, CompressedImage)
        self.pictures.append(msg.data)


async def turn() -> None:
    """What the loop was given is done."""
    for _ in range(3):
        await asyncio.sleep(0)


async def test_a_picture_of_a_drivers_thread_is_seen_without_a_tick(tmp_path: Path) -> None:
    robot = Filming()
    assert isinstance(robot, Prompt)
    scene = Scene(robot, tmp_path)
    seen = Seen(scene)
    with prompt_pictures(scene.station, lambda: 7.0):
        driver = threading.Thread(target=robot.shoot, args=(b"first",))
        driver.start()
        driver.join()
        assert seen.pictures == []  # never in the driver's thread
        await turn()
        assert (seen.pictures, robot.asked) == ([b"first"], [7.0])
    assert robot.ready is None


async def test_pictures_that_follow_each_other_too_fast_wait_for_the_tick(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(prompt, "MIN_PERIOD", 3600.0)
    robot = Filming()
    scene = Scene(robot, tmp_path)
    seen = Seen(scene)
    with prompt_pictures(scene.station, float):
        robot.shoot(b"1")
        robot.shoot(b"2")  # asks once for both
        await turn()
        robot.shoot(b"3")
        await turn()
        assert seen.pictures == [b"1", b"2"]
    assert [msg.data for _, msg in robot.taken if isinstance(msg, CompressedImage)] == [b"3"]


def test_a_picture_at_the_very_end_harms_nobody(tmp_path: Path) -> None:
    robot = Filming()
    scene = Scene(robot, tmp_path)
    kept: list[Callable[[], None]] = []

    async def serve() -> None:
        with prompt_pictures(scene.station, float):
            assert robot.ready is not None
            kept.append(robot.ready)  # as a driver's thread has it that is about to call

    asyncio.run(serve())
    kept[0]()


async def test_a_robot_that_never_says_so_is_read_at_the_tick_as_ever(tmp_path: Path) -> None:
    scene = Scene(FakeRobot(), tmp_path)
    with prompt_pictures(scene.station, float):
        assert scene.station.robot.pictures(0.0) == ()
