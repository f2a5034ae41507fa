"""Dead man of a held control: it lets go when it is taken off the glass, hidden, covered or scrolled away while a finger is on it.

class Horn(DeadMan, Gauge):
    def spring(self): self.dispatch("on_command", Bool(False))
"""

from __future__ import annotations

from typing import Any

from kivy.clock import Clock

from widgets.controls.finger_grip import Grip
from widgets.controls.occlusion import covering, cut_off

__all__ = ["WATCH_PERIOD", "DeadMan"]

WATCH_PERIOD = 0.1
"""Between two looks whether a held control can still be seen [s]."""
MIN_OPACITY = 0.05
"""What is fainter cannot be seen."""


class DeadMan(Grip):
    """Rests, besides where every `Grip` does, as soon as it is removed with or without its parents, hidden, covered or scrolled out of sight.

    Whatever comes over its middle counts, a dialogue or a drawer, seen through or not; but not what lay there when the finger
    came down and let that through. The look is by the clock of the frames: where frames stop, nothing is sent either.
    """

    def __init__(self, **kwargs: Any) -> None:
        self._watch = Clock.schedule_interval(self._look, WATCH_PERIOD)
        self._watch.cancel()
        self._look_soon = Clock.create_trigger(self._look, 0)
        self._over: set[Any] = set()
        """What lay over it when the finger came down."""
        self._doubted = -1
        """Frame since which it cannot be seen, -1 while it can: what is being laid out is anywhere for a frame."""
        super().__init__(**kwargs)
        self.fbind("parent", self._look)
        self.fbind("opacity", self._look)

    def on_touch_down(self, touch: Any) -> bool:
        """Take the finger, where the control can be seen, and watch it from then on."""
        if not self.visible_to_finger:
            return False
        held = self.finger is not None
        taken = super().on_touch_down(touch)
        if self.finger is not None and not held:
            self._over, self._doubted = set(covering(self)), -1
            self._watch()
        return taken

    def rest(self) -> None:
        """Let go."""
        self._watch.cancel()
        self._look_soon.cancel()
        super().rest()
        self._over = set()

    def _look(self, *_: object) -> None:
        if self.finger is None:
            return
        if not self.visible_to_finger:
            self.rest()
            return
        if not self.occluded:
            self._doubted = -1
        elif self._doubted < 0:
            self._doubted = Clock.frames
            self._look_soon()
        elif self._doubted != Clock.frames:
            self.rest()

    @property
    def occluded(self) -> bool:
        """Something has come over its middle since the finger came down, or that is scrolled out of sight."""
        return cut_off(self) or not self._over.issuperset(covering(self))

    @property
    def visible_to_finger(self) -> bool:
        """It is in the window, and neither it nor what holds it is hidden or disabled."""
        top: Any = self
        while True:
            if top.opacity < MIN_OPACITY or top.disabled:
                return False
            above = top.parent
            if above is None:
                return False
            if above is above.parent:
                return True
            top = above
