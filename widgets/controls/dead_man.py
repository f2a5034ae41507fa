"""Dead man of a held control: it lets go when it is taken off the glass, hidden or covered while a finger is on it.

class Horn(DeadMan, Gauge):
    def spring(self): self.dispatch("on_command", Bool(False))
"""

from __future__ import annotations

from typing import Any

from kivy.clock import Clock
from kivy.uix.modalview import ModalView

from widgets.controls.finger_grip import Grip

__all__ = ["WATCH_PERIOD", "DeadMan"]

WATCH_PERIOD = 0.1
"""Between two looks whether a held control can still be seen [s]."""
MIN_OPACITY = 0.05
"""What is fainter cannot be seen."""


class DeadMan(Grip):
    """Rests, besides where every `Grip` does, as soon as it is removed with or without its parents, hidden or under a dialogue.

    The look is by the clock of the frames: where frames stop, nothing is sent either.
    """

    def __init__(self, **kwargs: Any) -> None:
        self._watch = Clock.schedule_interval(self._look, WATCH_PERIOD)
        self._watch.cancel()
        super().__init__(**kwargs)
        self.fbind("parent", self._look)
        self.fbind("opacity", self._look)

    def on_touch_down(self, touch: Any) -> bool:
        """Take the finger, where the control can be seen, and watch it from then on."""
        if self.visible_to_finger is False:
            return False
        taken = super().on_touch_down(touch)
        if self.finger is not None:
            self._watch()
        return taken

    def rest(self) -> None:
        """Let go."""
        self._watch.cancel()
        super().rest()

    def _look(self, *_: object) -> None:
        if self.finger is not None and not self.visible_to_finger:
            self.rest()

    @property
    def visible_to_finger(self) -> bool:
        """It is in the window, neither it nor what holds it is hidden or disabled, and no dialogue lies over it."""
        top: Any = self
        while True:
            if top.opacity < MIN_OPACITY or top.disabled:
                return False
            above = top.parent
            if above is None:
                return False
            if above is above.parent:
                break
            top = above
        over = above.children[: above.children.index(top)] if top in above.children else []
        return not any(isinstance(one, ModalView) for one in over)
