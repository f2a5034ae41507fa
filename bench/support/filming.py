"""The robot side with a robot that weighs nothing and films a painted clock, `python -m bench.support.filming serve …`.

Its camera is a process of its own; the robot side gets each picture as soon as it is there.
"""

from __future__ import annotations

import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import sim.robot
from bridge.core.topics import CAMERA
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.__main__ import main
from robotside.core.robot import Robot
from tests.fakes import FakeRobot

__all__ = ["Filming"]


class Filming(FakeRobot):
    """Has one camera, which films while somebody looks."""

    def __init__(self) -> None:
        super().__init__(beams=4)
        self.info.cameras.append("front")
        self._looked_at = False
        self._camera = subprocess.Popen(
            [sys.executable, "-m", "bench.support.painted"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE
        )
        self._made: list[bytes] = []
        self._ready: Callable[[], None] | None = None
        threading.Thread(target=self._film, daemon=True).start()

    def want(self, topic: str, wanted: bool) -> None:
        """Somebody looks, or nobody any more."""
        if topic == CAMERA:
            self._looked_at = wanted

    def read(self, now: float) -> Iterator[tuple[str, Msg]]:
        """All else, and the newest picture."""
        yield from super().read(now)
        self.commands.clear()
        yield from self.pictures(now)

    def on_pictures(self, ready: Callable[[], None] | None) -> None:
        """Call it when there is a picture."""
        self._ready = ready

    def pictures(self, now: float) -> Iterator[tuple[str, Msg]]:
        """What was painted since."""
        made, self._made = self._made, []
        for picture in made:
            yield CAMERA, CompressedImage(data=picture)

    def close(self) -> None:
        """End the camera."""
        self._camera.kill()
        self._camera.wait()

    def _film(self) -> None:
        made = self._camera.stdout
        while made is not None and (length := made.read(4)):
            picture = made.read(int.from_bytes(length, "big"))
            if self._looked_at:
                self._made.append(picture)
                if self._ready is not None:
                    self._ready()


def make(robots: Sequence[str], *_: Any, **__: Any) -> list[Robot]:
    """One for each name."""
    return [Filming() for _ in robots]


if __name__ == "__main__":
    sim.robot.make_several = make  # type: ignore[assignment]
    sys.exit(main())
