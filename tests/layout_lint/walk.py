"""The walk over the glass of one app: each of its scenes in each size, with and without gloves, in one language and size of text.

Sizes are in dp on a glass of 160 dpi, where one dp is one pixel: what is 10 mm there is 10 mm on every phone, whose density
grows with its dpi.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Container, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from kivy.metrics import Metrics

from app.garbage_collector import Collector
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass, running
from tests.headless import Stage
from tests.layout_lint.alone import Scene, lone_scenes
from tests.layout_lint.faults import Fault, contrasts, faults
from tests.layout_lint.scenes import feed, fill, scenes
from tests.layout_lint.ways import Way
from widgets.core.language import language
from widgets.core.theme import PALETTES, theme

__all__ = ["DPI", "Finding", "Walk"]

DPI = 160.0
"""Of the glass: at this one a dp is a pixel on Android, and a phone of 412 dp is 65 mm across."""
USUAL_DPI = 96.0


@dataclass(frozen=True, slots=True)
class Finding:
    """A fault, and where the walk came upon it."""

    scene: str
    fault: Fault
    at: str

    @property
    def name(self) -> str:
        """What it is known by."""
        return f"{self.fault.kind}: {self.fault.where}"

    def __str__(self) -> str:
        return f"[{self.scene}; {self.at}] {self.fault}"


@contextmanager
def _glass_of(dpi: float) -> Iterator[None]:
    Metrics.dpi = dpi
    try:
        yield
    finally:
        Metrics.dpi = USUAL_DPI


class Walk:
    """Over one app, from its start to its end."""

    def __init__(self, stage: Stage, folder: Path, tell: Callable[[str], object] = lambda _: None) -> None:
        """`folder` is for the app's settings; `tell` hears of each scene as it is begun."""
        self._stage, self._folder, self._tell = stage, folder, tell
        self.looks = 0
        """So many scenes were looked at, each in each of its ways."""

    def over(self, way: Way, only: Container[str] | None = None) -> Iterator[Finding]:
        """All that is wrong anywhere, in all scenes or in `only` those of these names."""
        robot, before, step = FakeRobot(), tuple(self._stage.window.size), Collector.step
        Collector.step = lambda *_, **__: None  # type: ignore[method-assign]  # longer than a look is
        try:
            with _glass_of(DPI), running(self._stage, self._folder) as glass:
                self._choose(glass, way)
                yield from self._all(glass, way, lone_scenes(), only)
                glass.app.open(robot.url)
                glass.drives()
                fill(robot, glass)
                yield from self._all(glass, way, scenes(), only)
        finally:
            Collector.step = step  # type: ignore[method-assign]
            robot.close()
            theme.gloves, language.name, Metrics.fontscale = False, "en", 1.0
            self._stage.window.size = before

    @staticmethod
    def _choose(glass: Glass, way: Way) -> None:
        glass.app.preferences.choose("language", way.language)
        glass.app.preferences.choose("text", way.text)
        glass.app.renewal.do()
        glass.stage.frames(2)

    def _all(
        self, glass: Glass, way: Way, every: Iterable[Scene], only: Container[str] | None
    ) -> Iterator[Finding]:
        for name, show, leave in every:
            if only is None or name in only:
                self._tell(name)
                if glass.app.shell is not None:
                    feed(glass)
                show(glass)
                yield from self._look(glass, name, way)
                leave(glass)

    def _look(self, glass: Glass, name: str, way: Way) -> Iterator[Finding]:
        for gloved, size in itertools.product(way.gloves, way.sizes):
            theme.gloves = gloved
            resize(glass, size)
            at = f"{size[0]}x{size[1]} {way.name}{' gloves' if gloved else ''}"
            self.looks += 1
            for fault in faults(glass.app.root, size):
                yield Finding(name, fault, at)
        theme.gloves = False
        if way.text == 1.0:
            yield from self._colours(glass, name, way)

    def _colours(self, glass: Glass, name: str, way: Way) -> Iterator[Finding]:
        for palette in PALETTES:
            theme.name = palette
            glass.stage.frames(1)
            self.looks += 1
            for fault in contrasts(glass.app.root, way.sizes[-1]):
                yield Finding(name, fault, f"{palette} {way.name}")
        theme.name = "dark"


def resize(glass: Glass, size: tuple[int, int]) -> None:
    """Have everything arranged in a window of that size [px]."""
    glass.stage.window.size = glass.app.root.size = size
    glass.stage.frames(2)
    if glass.app.shell is not None:
        glass.app.shell.tick()
    glass.stage.frames(2 if glass.app.shell is not None else 4)
