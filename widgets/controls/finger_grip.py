"""Base of controls that one finger holds: they follow the finger that came down on them and no other.

class Slider(Grip, Drawing):
    def holds(self, x, y): return True
    def follow(self, touch): self.share = …
    def spring(self): self.share = 0.0
"""

from __future__ import annotations

from typing import Any

from widgets.core.base import Control

__all__ = ["Grip"]


class Grip(Control):
    """Follows one finger from where it comes down until it is lifted, or the control is moved, disabled or put to rest."""

    __events__ = ("on_in_vain",)

    drags = True
    """A finger that comes down here does not scroll."""

    def __init__(self, **kwargs: Any) -> None:
        self._finger: Any = None
        super().__init__(**kwargs)
        self.fbind("size", self._rest_under_finger)
        self.fbind("pos", self._rest_under_finger)

    @property
    def finger(self) -> Any:
        """The touch that it follows; None without one."""
        return self._finger

    def holds(self, x: float, y: float) -> bool:
        """Whether a finger that comes down at (x, y) [px] takes hold of it."""
        return bool(self.collide_point(x, y))

    def follow(self, touch: Any) -> None:
        """Go where the finger is."""
        raise NotImplementedError(f"{type(self).__name__} does not say how it follows a finger")

    def spring(self) -> None:
        """Go back to rest; commands that if it was not there already."""
        raise NotImplementedError(f"{type(self).__name__} does not say where it rests")

    def rest(self) -> None:
        """Let the finger go and spring back."""
        if self._finger is not None:
            self._finger.ungrab(self)
            self._finger = None
        self.spring()

    def _rest_under_finger(self, *_: object) -> None:
        """It was moved: where the finger is now says nothing of where it was to be pushed."""
        if self._finger is not None:
            self.rest()

    def on_touch_down(self, touch: Any) -> bool:
        """Take the first finger on it; one that comes down again has been away, unseen."""
        if touch is self._finger:
            self.rest()
        gripped = self.holds(*touch.pos)
        if self.disabled and gripped:
            self.dispatch("on_in_vain")
        if self.disabled or self._finger is not None or not gripped:
            return bool(super().on_touch_down(touch))
        touch.grab(self)
        self._finger = touch
        self.follow(touch)
        return True

    def on_touch_move(self, touch: Any) -> bool:
        """Follow it, beyond the edge as well."""
        if touch.grab_current is not self:
            return bool(super().on_touch_move(touch))
        self.follow(touch)
        return True

    def on_touch_up(self, touch: Any) -> bool:
        """Spring back."""
        if touch.grab_current is not self:
            return bool(super().on_touch_up(touch))
        self.rest()
        return True

    def on_in_vain(self) -> None:
        """A finger came down on it while it is disabled."""
