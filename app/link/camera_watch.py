"""The camera stream that is watched: a socket of its own, or pictures on a topic of rosbridge.

Everything here lives in the network thread.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from app.link.subscriptions import Sources
from app.link.task_set import TaskSet
from bridge.client.client import CameraStream
from bridge.client.credentials import Credentials
from bridge.core.camera_frames import Frame
from bridge.msgs.sensor_msgs import CompressedImage

__all__ = ["CameraWatch"]


class CameraWatch:
    """At most one stream at a time."""

    def __init__(
        self,
        url: str,
        sources: Sources,
        tasks: TaskSet,
        on_frame: Callable[[Frame, float], None],
        credentials: Credentials | None = None,
    ) -> None:
        """`url` is the robot's; `on_frame` takes each frame and when it came [s], our clock.

        With `credentials` pictures are taken from the robot with that key only.
        """
        self._credentials = credentials
        self._url, self._sources, self._tasks, self._on_frame = url.rstrip("/"), sources, tasks, on_frame
        self._stream: asyncio.Task[None] | None = None
        self._unsubscribe: Callable[[], None] | None = None

    def show(self, camera: str | None) -> None:
        """Watch a camera by its name; empty for the one of the rosbridge topic, None for none."""
        if self._stream is not None:
            self._stream.cancel()
            self._stream = None
        if self._unsubscribe is not None:
            self._unsubscribe()
            self._unsubscribe = None
        if camera:
            self._stream = self._tasks.start(self._run(camera))
        elif camera == "":
            self._unsubscribe = self._sources.camera(self._on_image)

    async def _run(self, camera: str) -> None:
        stream = CameraStream(f"{self._url}/camera/{camera}", self._on_frame, credentials=self._credentials)
        try:
            await stream.run()
        finally:
            await stream.close()

    def _on_image(self, image: CompressedImage, received: float) -> None:
        self._on_frame(Frame(0, image.header.stamp.seconds, 0, 0, image.data), received)
