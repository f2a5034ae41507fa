"""The walk over the glass: sizes, sizes of text, languages, gloves and themes; the screens are made once for a language and size of text."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Container, Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from tests.app.glass import Glass
from tests.layout_lint.faults import Fault, contrasts, faults
from tests.layout_lint.scenes import Scene, feed, scenes
from widgets.core.theme import PALETTES, theme

__all__ = ["DAILY", "PHONE", "SIDE", "SIZES", "TABLET", "WHOLE", "Finding", "Walk", "Way", "counted"]

PHONE, SIDE, TABLET = (412, 892), (892, 412), (1280, 800)
SIZES = (PHONE, SIDE, (360, 740), TABLET, (1920, 1200))
"""Of the window [dp]."""


class Way(NamedTuple):
    """One way to look at every scene."""

    language: str
    text: float
    """Size of text, in times of the usual."""
    sizes: tuple[tuple[int, int], ...]
    gloves: tuple[bool, ...] = (False,)


WHOLE = (
    Way("en", 1.0, SIZES),
    Way("en", 1.0, (PHONE, TABLET), (True,)),
    Way("en", 2.0, (PHONE, SIDE, TABLET)),
    Way("en_XA", 1.0, (PHONE, SIDE, TABLET)),
    Way("zh_CN", 1.3, (PHONE,)),
    Way("de", 1.3, (PHONE, SIDE)),
)
"""Each size, language and size of text, and what is worst together: long words, large type, little glass."""
DAILY = (Way("en", 1.0, (PHONE, TABLET)),)


@dataclass(frozen=True, slots=True)
class Finding:
    """A fault, and where the walk came upon it first."""

    scene: str
    fault: Fault
    at: str

    def __str__(self) -> str:
        return f"[{self.scene}; {self.at}] {self.fault}"


class Walk:
    """Over the scenes of one app."""

    def __init__(self, glass: Glass) -> None:
        self.glass = glass
        self.looks = 0
        """So many scenes were looked at, each in each of its ways."""

    def over(
        self,
        ways: Iterable[Way],
        only: Container[str] | None = None,
    ) -> Iterator[Finding]:
        """All that is wrong anywhere, in all scenes or in `only` those of these names."""
        chosen = [scene for scene in scenes() if only is None or scene[0] in only]
        for way in ways:
            self._make(way)
            for scene in chosen:
                yield from self._scene(scene, way)

    def _make(self, way: Way) -> None:
        app = self.glass.app
        app.preferences.choose("language", way.language)
        app.preferences.choose("text", way.text)
        app.renewal.do()
        feed(self.glass)
        self.glass.stage.frames(2)

    def _scene(self, scene: Scene, way: Way) -> Iterator[Finding]:
        name, show, leave = scene
        feed(self.glass)
        show(self.glass)
        for size, gloved in itertools.product(way.sizes, way.gloves):
            theme.gloves = gloved
            self.resize(size)
            at = f"{size[0]}x{size[1]} {way.language} {way.text * 100:.0f} %{' gloves' if gloved else ''}"
            self.looks += 1
            for fault in faults(self.glass.app.root, size):
                yield Finding(name, fault, at)
        theme.gloves = False
        if (way.language, way.text) == ("en", 1.0):
            yield from self._colours(name, way.sizes[-1])
        leave(self.glass)

    def _colours(self, name: str, size: tuple[int, int]) -> Iterator[Finding]:
        for palette in PALETTES:
            theme.name = palette
            self.glass.stage.frames(1)
            for fault in contrasts(self.glass.app.root, size):
                yield Finding(name, fault, palette)
        theme.name = "dark"

    def resize(self, size: tuple[int, int]) -> None:
        """Have everything arranged in a window of that size [px]."""
        self.glass.stage.window.size = self.glass.app.root.size = size
        self.glass.stage.frames(2)
        if self.glass.app.shell is not None:
            self.glass.app.shell.tick()
        self.glass.stage.frames(2)


def counted(findings: Iterable[Finding]) -> Counter[str]:
    """How many there are of each kind."""
    return Counter(one.fault.kind for one in findings)
