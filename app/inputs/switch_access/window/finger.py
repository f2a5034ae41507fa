"""The finger of somebody who has none free: what a switch does reaches a widget as a touch would, on that widget alone.

So whatever a widget asks of a finger (that it may be pressed now, that it has not just changed its meaning, that it stays
long enough) it asks of a switch as well. What is done is done when the call returns, with whose order it is still known.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from kivy.clock import Clock
from kivy.core.window import Window
from kivy.input.motionevent import MotionEvent
from kivy.uix.widget import Widget

__all__ = ["Finger", "Place", "drag", "hold", "tap"]

Place = tuple[float, float]
STEPS = 6
"""Moves between two corners of a drag: some widgets take the first for a slip."""


class Finger(MotionEvent):
    """One touch, at places in the coordinates of the widget's parent, as Kivy hands them to it [px]."""

    _count = 0

    def __init__(self, place: Place) -> None:
        Finger._count += 1
        super().__init__("switches", Finger._count, place, is_touch=True, type_id="touch")
        self.put(place)
        self.ox, self.oy = place

    def depack(self, args: Place) -> None:
        """Take a place [px]."""
        width, height = Window.size
        self.profile = ["pos"]
        self.sx, self.sy = args[0] / max(width, 1), args[1] / max(height, 1)
        super().depack(args)

    def put(self, place: Place) -> None:
        """Be at a place [px]."""
        self.move(place)
        self.px, self.py = getattr(self, "x", place[0]), getattr(self, "y", place[1])
        self.x, self.y = place
        self.pos = place
        self.dx, self.dy = self.x - self.px, self.y - self.py


def tap(widget: Widget, place: Place | None = None) -> bool:
    """A finger down and up again in the widget's middle, or at `place` [px, as its parent has it]; False where it takes none."""
    return drag(widget, [place or _middle(widget)])


def drag(widget: Widget, way: Sequence[Place]) -> bool:
    """A finger down at the first place of `way`, straight on to the others, up at the last; False where it takes none."""
    finger = Finger(way[0])
    if not widget.dispatch("on_touch_down", finger) and not _takes_at_the_end(widget):
        return False
    for corner in way[1:]:
        (x0, y0), (x1, y1) = finger.pos, corner
        for step in range(1, STEPS + 1):
            share = step / STEPS
            finger.put((x0 + (x1 - x0) * share, y0 + (y1 - y0) * share))
            _tell(widget, finger, "on_touch_move")
    _lift(widget, finger)
    return True


def hold(
    widget: Widget, seconds: float, place: Place | None = None, *, until: str = ""
) -> Callable[[], None] | None:
    """A finger that stays for so long [s], or `until` the widget says so by that event; the answer lifts it before that.

    None where the widget takes none.
    """
    finger = Finger(place or _middle(widget))
    if not widget.dispatch("on_touch_down", finger):
        return None
    up = Clock.create_trigger(lambda _: end(), seconds)
    up()
    staying = [True]

    def end(*_: object) -> None:
        if staying:
            staying.clear()
            up.cancel()
            if until:
                widget.unbind(**{until: end})
            _lift(widget, finger)

    if until:
        widget.bind(**{until: end})
    return end


def _takes_at_the_end(widget: Widget) -> bool:
    """It asks for no more than that a finger is lifted over it."""
    return type(widget).on_touch_up is not Widget.on_touch_up


def _middle(widget: Widget) -> Place:
    x, y = widget.center
    return x, y


def _lift(widget: Widget, finger: Finger) -> None:
    finger.update_time_end()
    _tell(widget, finger, "on_touch_up")
    finger.grab_list.clear()


def _tell(widget: Widget, finger: Finger, what: str) -> None:
    """First as to everybody, then as to those that hold it, as Kivy does."""
    widget.dispatch(what, finger)
    finger.grab_state = True
    for known in list(finger.grab_list):
        holder: Any = known()
        if holder is None:
            finger.grab_list.remove(known)
            continue
        finger.grab_current = holder
        holder.dispatch(what, finger)
    finger.grab_current, finger.grab_state = None, False
