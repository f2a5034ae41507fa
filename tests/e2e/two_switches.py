"""Somebody who has two keys and eyes: steps to what is wanted and does it, and reads on the glass where the mark is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from kivy.base import EventLoop
from kivy.core.window import Window

from app.inputs.switch_access.scan.target import Mark, Target
from app.inputs.switch_access.window.area import COARSE, FINE
from tests.e2e.handheld import Handheld

__all__ = ["TwoSwitches"]

A, B = 9, 13
"""Key codes of Tab and Enter."""
UP = 0.2
"""A held so long leads up a level [s]: less than a hand would, for a test that need not wait."""
FRAMES = 2
"""After what may change the screen; a step of the mark is seen at once."""
MOST = 120
"""Presses after which something is not to be found."""


class TwoSwitches:
    """The two keys of one handheld, pressed one after the other."""

    def __init__(self, glass: Handheld) -> None:
        self.glass, self.presses = glass, 0
        self.switches: Any = glass.app.methods.get("switches")
        self.switches.change(ignore_repeat=0.0, debounce=0.0, tones=False)
        options = self.switches.options
        self.switches.engine.setup(replace(options.timing, back=UP), options.pace)

    @property
    def mark(self) -> Mark | None:
        """What stands out."""
        return self.switches.engine._glass.marked

    def press(self, key: int) -> None:
        """One key down, and up again at once."""
        self.presses += 1
        Window.dispatch("on_key_down", key, 0, None, [])
        Window.dispatch("on_key_up", key, 0)
        for _ in range(FRAMES if key == B else 0):
            EventLoop.idle()

    def up(self) -> None:
        """A held until the mark has gone up a level, as somebody does who looks."""
        depth = self.switches.engine.scan.depth
        self.presses += 1
        Window.dispatch("on_key_down", A, 0, None, [])
        self.glass.until(lambda: self.switches.engine.scan.depth != depth, "the mark to go up a level")
        Window.dispatch("on_key_up", A, 0)

    def update(self) -> None:
        """Look what became of it: a button that has just changed its meaning takes no press for half a second."""
        self.glass.run(0.8)

    def both(self) -> None:
        """Both keys at once."""
        for key in (A, B):
            Window.dispatch("on_key_down", key, 0, None, [])
        self.glass.run(0.1)
        for key in (A, B):
            Window.dispatch("on_key_up", key, 0)
        self.glass.run(0.05)

    def choose(self, words: str, times: int = 1, within: str = "") -> Target:
        """Step to what says `words`, in the container `within` where there are several, and press."""

        def wanted(target: Target) -> bool:
            return target.words == words and (not within or within in target.group)

        return self.find(wanted, f"{words!r} {within}".strip(), times)

    def point(self, x: float, y: float) -> None:
        """Step the cross to that place on the map [m], first coarsely, then finely, and set it there."""
        area = self.glass.app.screens["mission"].map
        cross = self.switches.engine._glass.openings._area.cross
        for step, change in ((COARSE, ""), (FINE, "Fine steps")):
            if change:
                self.choose(change)
            for axis, ways in ((0, ("Left", "Right")), (1, ("Down", "Up"))):
                seen = area.to_window(*area.view.to_screen(x, y))
                off = round((seen[axis] - cross.at[axis]) / step)
                if off:
                    self.choose(ways[off > 0], times=abs(off))
        self.choose("Coarse steps")
        self.choose("Set or choose here")

    def find(self, wanted: Callable[[Target], bool], what: str, times: int = 1) -> Target:
        """Step to what is wanted and press it so many times."""
        stepped: list[str] = []
        for _ in range(MOST):
            mark = self.mark
            here = mark is not None and any(wanted(target) for target in mark.targets)
            stepped.append(f"{mark.kind}: {mark.words}" if mark is not None else "nothing")
            if mark is not None and mark.kind == "item" and here:
                target = mark.targets[0]
                for _ in range(times):
                    self.press(B)
                return target
            inside = mark is not None and mark.kind == "group" and here
            scan = self.switches.engine.scan
            if scan.depth and not any(wanted(target) for target in scan.inside):
                self.up()  # it is not in this group
            else:
                self.press(B if inside else A)
        raise AssertionError(
            f"no {what} among {list(dict.fromkeys(stepped))}; the glass says {self.glass.words()}"
        )
