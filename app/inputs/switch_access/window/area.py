"""A cross that steps over a map, or over whatever else is touched at a place: coarse, fine, touch, hold, carry from here to there."""

from __future__ import annotations

from typing import Any

from kivy.metrics import dp

from app.inputs.switch_access.window import finger
from app.inputs.switch_access.window.finding import in_window
from widgets.controls.crosshair import Crosshair
from widgets.core.language import tr
from widgets.inputs.scan_pad import PadKey, ScanPad
from widgets.map.map_gestures import HOLD_DURATION, MapGestures

__all__ = ["Area"]

COARSE, FINE = 48.0, 8.0
"""One step of the cross [dp]."""
MIN_COARSE_STEPS = 12
"""So many coarse steps at least lead across what is small."""
EDGE_MARGIN = 6.0
"""The cross stays so far from the edge [dp]."""
STEPS = {"up": (0, 1), "down": (0, -1), "left": (-1, 0), "right": (1, 0)}
EXTRA_HOLD = 0.2
"""A hold lasts longer than it must, for slow frames [s]."""


class Area:
    """The cross over one widget, and what its keys do there."""

    def __init__(self, root: Any, widget: Any, *, moves: bool) -> None:
        """`moves`: what lies under the cross is moved where the cross would leave it, as a map is."""
        self._root, self._widget, self.moves = root, widget, moves
        self._fine = False
        self._taken: tuple[float, float] | None = None
        """Where it has taken hold of something [px]."""
        self._pad: ScanPad | None = None
        self._lift: Any = None
        left, low, right, top = self._free()
        self.cross = Crosshair(at=[(left + right) / 2, (low + top) / 2])
        root.add_widget(self.cross)

    def beside(self, pad: ScanPad | None) -> None:
        """The keys are on this one: the cross keeps clear of it."""
        self._pad = pad
        left, low, right, top = self._free()
        if not (left <= self.cross.at[0] <= right and low <= self.cross.at[1] <= top) or self.moves:
            self.cross.at = [(left + right) / 2, (low + top) / 2]

    def close(self) -> None:
        """Take the cross away."""
        if self._lift is not None:
            self._lift()
        if self.cross.parent is not None:
            self.cross.parent.remove_widget(self.cross)

    def rows(self) -> list[list[PadKey]]:
        """Its keys, as they stand now."""
        arrows = {
            "left": (tr("Left"), "arrow_back"),
            "up": (tr("Up"), "arrow_upward"),
            "down": (tr("Down"), "arrow_downward"),
            "right": (tr("Right"), "arrow_forward"),
        }
        steps = [PadKey(name, words, icon, repeats=True) for name, (words, icon) in arrows.items()]
        touch = PadKey("touch", tr("Set"), "touch_app", tr("Set or choose here"))
        fine = PadKey(
            "fine",
            tr("Fine"),
            "filter_center_focus",
            tr("Coarse steps") if self._fine else tr("Fine steps"),
            on=self._fine,
        )
        taken = self._taken is not None
        carry = PadKey(
            "carry",
            tr("Drop") if taken else tr("Take"),
            "open_with",
            tr("Drop here") if taken else tr("Take this to move it"),
            on=taken,
        )
        done = PadKey("done", tr("Done"), "check")
        if not self.moves:
            return [steps, [touch, fine, carry, done]]
        here = PadKey("hold", tr("Place"), "add_location_alt", tr("New place here"))
        out, in_ = (
            PadKey("zoom_out", tr("Out"), "zoom_out", repeats=True),
            PadKey("zoom_in", tr("In"), "zoom_in", repeats=True),
        )
        acts = self._acts()
        return [
            [touch, *steps[:1], *steps[3:], done],
            [steps[1], steps[2], fine, carry],
            [*acts, here, out, in_],
        ]

    def _acts(self) -> list[PadKey]:
        """What belongs to what is chosen on the map, at hand while the pad covers its buttons."""
        return [
            PadKey("delete", tr("Delete"), "delete", tr("Delete the chosen point")),
            PadKey("undo", tr("Undo"), "undo"),
        ]

    def press(self, name: str) -> None:
        """Do what that key says."""
        if name in STEPS:
            self._step(*STEPS[name])
        elif name == "fine":
            self._fine = not self._fine
        elif name == "touch":
            finger.tap(self._widget, self._place(self.cross.at))
        elif name == "hold":
            self._lift = finger.hold(self._widget, HOLD_DURATION + EXTRA_HOLD, self._place(self.cross.at))
        elif name == "carry":
            self._carry()
        elif name in ("zoom_in", "zoom_out"):
            self._zoom(1.4 if name == "zoom_in" else 1 / 1.4)
        elif name in ("delete", "undo"):
            self._ask(name)
        if self._pad is not None:
            self._pad.rows = self.rows()

    def _ask(self, name: str) -> None:
        """Press the button that the screen round the map has for it."""
        screen: Any = self._widget
        while screen is not None and screen.parent is not screen:
            button = getattr(screen, "ids", {}).get(name)
            if button is not None:
                if not button.disabled:
                    finger.tap(button)
                return
            screen = screen.parent

    def _carry(self) -> None:
        """Take what is under the cross; the next time bring it to where the cross is by then."""
        if self._taken is None:
            self._taken = (self.cross.at[0], self.cross.at[1])
        else:
            finger.drag(self._widget, [self._place(self._taken), self._place(self.cross.at)])
            self._taken = None
        self.cross.holds = self._taken is not None

    def _place(self, at: Any) -> tuple[float, float]:
        """As the widget's parent has it."""
        x, y = self._widget.parent.to_widget(*at)
        return float(x), float(y)

    def _step(self, across: int, up: int) -> None:
        left, low, right, top = self._free()
        least = min(right - left, top - low) / MIN_COARSE_STEPS
        step = dp(FINE) if self._fine else dp(COARSE)
        if not self.moves:
            step = min(step, max(least / (4 if self._fine else 1), 1.0))
        x, y = self.cross.at[0] + across * step, self.cross.at[1] + up * step
        stay = min(max(x, left), right), min(max(y, low), top)
        self.cross.at = list(stay)
        if self.moves and stay != (x, y) and isinstance(self._widget, MapGestures):
            by = stay[0] - x, stay[1] - y
            before = self._widget.view
            self._widget.set_view(before.moved(*by))
            if self._taken is not None:
                moved = self._widget.view.to_screen(*before.to_world(*self._place(self._taken)))
                place = self._widget.to_window(*moved)
                self._taken = place[0], place[1]

    def _zoom(self, factor: float) -> None:
        if isinstance(self._widget, MapGestures):
            self._widget.set_view(self._widget.view.zoomed(factor, *self._place(self.cross.at)))

    def _free(self) -> tuple[float, float, float, float]:
        """Where the cross may be: on the widget, within the glass, clear of the keys [px]."""
        left, low, right, top = in_window(self._widget)
        edge = dp(EDGE_MARGIN)
        left, low = max(left, 0) + edge, max(low, 0) + edge
        right, top = min(right, self._root.width) - edge, min(top, self._root.height) - edge
        if self._pad is not None:
            pad = in_window(self._pad)
            above, below = top - pad[3], pad[1] - low
            beside = max(pad[0] - left, right - pad[2])
            if pad[2] > left and pad[0] < right and max(above, below) >= beside:
                low, top = (pad[3] + edge, top) if above >= below else (low, pad[1] - edge)
            elif pad[3] > low and pad[1] < top:
                left, right = (
                    (left, pad[0] - edge) if pad[0] - left >= right - pad[2] else (pad[2] + edge, right)
                )
        return left, low, max(right, left), max(top, low)
