"""One camera at a time, over a socket of its own or over the robot's topic."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from typing import Any

import pytest

from app.link import camera_watch
from app.link.camera_watch import CameraWatch
from app.link.task_set import TaskSet
from bridge.core.camera_frames import Frame
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header, Time


class Stream:
    """Stands for the socket of a camera."""

    open: list[str] = []

    def __init__(
        self, url: str, on_frame: Callable[[Frame, float], None], credentials: object = None
    ) -> None:
        self.url = url

    async def run(self) -> None:
        self.open.append(self.url)
        await asyncio.Event().wait()

    async def close(self) -> None:
        self.open.remove(self.url)


class Topic:
    """Stands for the robot's topics."""

    show: Any = None

    def camera(self, show: Callable[[CompressedImage, float], object]) -> Callable[[], None]:
        self.show = show
        return self.end

    def end(self) -> None:
        self.show = None


class Watched:
    def __init__(self) -> None:
        self.tasks, self.topic = TaskSet(), Topic()
        self.frames: list[tuple[bytes, float]] = []
        self.camera = CameraWatch(
            "ws://robot:9090/",
            self.topic,  # type: ignore[arg-type]
            self.tasks,
            lambda frame, received: self.frames.append((frame.jpeg, received)),
        )


@pytest.fixture
async def watched(monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[Watched]:
    monkeypatch.setattr(camera_watch, "CameraStream", Stream)
    watched = Watched()
    yield watched
    await watched.tasks.cancel()
    assert Stream.open == []


async def settle() -> None:
    for _ in range(3):
        await asyncio.sleep(0)


async def test_another_camera_takes_the_place_of_the_one_before(watched: Watched) -> None:
    for name in ("front", "rear"):
        watched.camera.show(name)
        await settle()
        assert Stream.open == [f"ws://robot:9090/camera/{name}"]
    watched.camera.show(None)
    await settle()
    assert Stream.open == []


async def test_pictures_of_a_topic_are_frames_too(watched: Watched) -> None:
    watched.camera.show("")
    watched.topic.show(CompressedImage(header=Header(Time.at(12.5)), format="jpeg", data=b"picture"), 99.0)
    assert watched.frames == [(b"picture", 99.0)]
    watched.camera.show(None)
    assert watched.topic.show is None
