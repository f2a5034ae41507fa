"""Map and camera's picture of the mission screen change places by a tap on the picture, and back by one on the small map."""

from __future__ import annotations

from typing import Any

from app.layout.arrange import Rect
from app.screens.parts.inset_frame import InsetFrame
from app.screens.parts.placing import put
from widgets.core.geometry import View
from widgets.core.language import tr
from widgets.map.map_overlay import MapOverlay

__all__ = ["PictureSwap"]


class PictureSwap:
    """While the picture is large the map takes no finger: what is edited on it is edited while it is large."""

    def __init__(self, screen: Any) -> None:
        """`screen` is the MissionScreen, built."""
        self._screen = screen
        self.large = False
        """The picture is where the map was."""
        self.frame = InsetFrame()
        self.frame.bind(on_release=lambda _: self.swap())
        self._corner = screen.video.corner
        self._before: tuple[float, float, View, bool] | None = None
        """The place in the middle of the map that was large [m], how it was seen, and whether it followed the robot."""
        screen.ids.floats.add_widget(self.frame)
        screen.bind(mode=lambda *_: self.swap() if self.large and screen.mode != "view" else None)

    def swap(self) -> None:
        """Have the other one large."""
        screen = self._screen
        self._change()
        screen.arrange(screen._body, screen._form, screen._dp)  # noqa: SLF001 - part of that screen

    def _change(self) -> None:
        screen, map_ = self._screen, self._screen.map
        self.large = not self.large
        map_.let_go()
        ground, floats = screen.ids.ground, screen.ids.floats
        small, large = (map_, screen.video) if self.large else (screen.video, map_)
        for widget in (small, large):
            widget.parent.remove_widget(widget)
        ground.add_widget(large)
        floats.add_widget(small, len(floats.children))
        if self.large:
            self._before = *map_.view.to_world(*_middle(map_)), map_.view, map_.follow
            screen.mode = "view"

    def arrange(self, places: dict[str, Rect]) -> None:
        """Put both, and what belongs to a large map, where they are among the places of `arrange.mission`."""
        screen, video = self._screen, self._screen.video
        if self.large and screen.card.open:
            self._change()
            put(screen.map, places["map"])
            put(video, places["video"])
        floats = screen.ids.floats
        floats.remove_widget(self.frame)
        floats.add_widget(self.frame)  # above what was put there since
        put(self.frame, places["video"])
        self.frame.scan_words = tr("Show the map large") if self.large else tr("Show the picture large")
        video.corner = 0 if self.large else self._corner
        if not self.large:
            self._look_again()
            return
        put(video, places["map"])
        put(screen.map, places["video"])
        video.show_chip = True
        screen.map.insets = [0, 0, 0, 0]
        screen.map.centre_on_robot()
        screen.ids.modes.disabled, screen.ids.modes.opacity = True, 0
        for button in screen._tools.buttons.values():  # noqa: SLF001 - part of that screen
            if button.parent is floats:
                floats.remove_widget(button)

    def _look_again(self) -> None:
        """Have the map that is large again seen as it was."""
        if self._before is not None:
            x, y, seen, follow = self._before
            self._before, map_ = None, self._screen.map
            map_.set_view(View.centred(x, y, at=_middle(map_), scale=seen.scale, turn=seen.turn))
            map_.follow = follow


def _middle(map_: MapOverlay) -> tuple[float, float]:
    x, y, wide, high = map_.free_box
    return x + wide / 2, y + high / 2
