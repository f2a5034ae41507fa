"""The buttons beside the map: what is seen of it, which map it is, and editing taken back."""

from __future__ import annotations

from collections.abc import Callable

from kivy.uix.floatlayout import FloatLayout
from kivy.uix.widget import Widget

from app.layout.arrange import Rect
from app.screens.parts.placing import put
from app.session.session import Session
from widgets.map.map_overlay import MapOverlay
from widgets.parts.kit import IconButton

__all__ = ["MapTools", "float_over"]

SPARE = (("zoom_in", "zoom_out"), ("measure",), ("fit",), ("redo",))
"""What is left out where there is no room for all, the first first: two fingers enlarge as well."""


def float_over(floats: FloatLayout, widget: Widget, rect: Rect | None) -> None:
    """Put a widget over the map, or away where there is no room for it."""
    if rect is None:
        if widget.parent is floats:
            floats.remove_widget(widget)
        return
    if widget.parent is None:
        floats.add_widget(widget)
    put(widget, rect)


class MapTools:
    """One column of buttons, as many as there is room for."""

    def __init__(
        self,
        session: Session,
        look: Callable[[str], object],
        show_layers: Callable[[], object],
        measure: Callable[[], object],
    ) -> None:
        """`look` calls the method of that name of the map on the glass, `show_layers` asks what lies beneath it, and
        `measure` begins or ends measuring."""
        self._session = session
        self.buttons: dict[str, IconButton] = {}
        """By name, in the order of the column."""
        for name, icon, act in (
            ("zoom_in", "add", lambda: look("zoom_in")),
            ("zoom_out", "remove", lambda: look("zoom_out")),
            ("centre", "my_location", lambda: look("follow_or_turn")),
            ("measure", "straighten", measure),
            ("fit", "fit_screen", lambda: look("fit")),
            ("layers", "layers", show_layers),
            ("undo", "undo", session.mission.undo),
            ("redo", "redo", session.mission.redo),
        ):
            button = self.buttons[name] = IconButton(icon=icon)
            button.bind(on_release=lambda _, act=act: act())

    def tick(self, map_: MapOverlay, mode: str) -> None:
        """What cannot be taken back cannot be pressed; what is on is lit, and which way is up is seen on its button."""
        centre = self.buttons["centre"]
        centre.icon = "navigation" if map_.follow and map_.heading_up else "my_location"
        centre.role = "accent" if map_.follow else "text"
        self.buttons["measure"].role = "accent" if mode == "measure" else "text"
        self.buttons["undo"].disabled = not self._session.mission.can_undo
        self.buttons["redo"].disabled = not self._session.mission.can_redo

    def arrange(self, floats: FloatLayout, rect: Rect, dp: float, *, tall: bool, has_layers: bool) -> None:
        """Put them into `rect`; on a phone there are fewer, and the layers only where `has_layers`."""
        names = self._wanted(tall=tall, has_layers=has_layers)
        side = rect.width
        fit = max(1, int((rect.height + 8 * dp) // (side + 6 * dp)))
        for spare in SPARE:
            if len(names) > fit:
                names = [name for name in names if name not in spare]
        names = names[-fit:]
        for name, button in self.buttons.items():
            float_over(floats, button, None)
            if name in names:
                index = names.index(name)
                step = (rect.height - side) / max(1, min(fit, len(names)) - 1)
                float_over(floats, button, Rect(rect.x, rect.top - side - index * step, side, side))

    def clear(self, floats: FloatLayout, card: Rect | None) -> None:
        """Take away what would lie under a card over the map; None where there is none."""
        for button in self.buttons.values():
            if card is not None and card.overlaps(Rect(*button.pos, *button.size)):
                float_over(floats, button, None)

    def _wanted(self, *, tall: bool, has_layers: bool) -> list[str]:
        names = ["centre", "measure", "layers", "undo", "redo"] if tall else list(self.buttons)
        if self._session.robot.lacks_tasks:
            names = [name for name in names if name not in ("undo", "redo")]
        if not has_layers:
            names = ["fit" if name == "layers" else name for name in names if name != "layers" or tall]
        return names
