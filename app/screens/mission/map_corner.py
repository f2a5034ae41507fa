"""The corner over the map: the bar of what is selected and the check list, one above the other."""

from __future__ import annotations

import math

from kivy.clock import Clock
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.core.hand import hand
from app.layout.arrange import Rect
from app.screens.mission.intruder_card import IntruderCard
from app.screens.mission.selection_bar import SelectionBar
from app.screens.shell.check_card import CheckCard
from widgets.map.map_overlay import MapOverlay

__all__ = ["MapCorner"]

SCALE_HEIGHT = 64.0
"""Height that scale and legend take up at the foot of the map [dp]."""


class MapCorner:
    """Hangs from the modes, or on a phone stands on its lower edge and lifts scale and legend."""

    def __init__(self, selection: SelectionBar, checks: CheckCard, intruder: IntruderCard) -> None:
        self._selection, self._checks, self._intruder = selection, checks, intruder
        self.box = BoxLayout(orientation="vertical", spacing="8dp", size_hint=(None, None))
        """What is over the map."""
        self.cover: Rect | None = None
        """Where something is said over the map; None where nothing is."""
        self._map: MapOverlay | None = None
        self._bar = self._notice = Rect(0, 0, 1, 1)
        self._form, self._dp, self._sheet_up = "wide", 1.0, False
        self.settle_soon = Clock.create_trigger(self._settle, -1)
        for listed in (selection, checks, intruder):
            listed.bind(height=self.settle_soon)
        self._asked = False, True, False
        intruder.bind(intruder=lambda *_: self._tell(), on_show=lambda *_: self._centre())

    def show(self, *, selection: bool, looks: bool, covered: bool) -> None:
        """Have on the glass what there is to say: what is `selection`, and where the map is only looked at, which `looks` says,
        the check list, whose place an intruder takes; nothing where a card has `covered` the map."""
        self._asked = selection, looks, covered
        alarm = self._intruder.intruder is not None and (looks or self._form == "wide")
        wanted: list[Widget] = [self._selection] if selection else []
        wanted += [self._intruder] if alarm else [self._checks] if looks else []
        if covered:
            wanted = []
        if list(reversed(self.box.children)) != wanted:
            self.box.clear_widgets()
            for widget in wanted:
                self.box.add_widget(widget)
        self.settle_soon()

    def _tell(self) -> None:
        selection, looks, covered = self._asked
        self.show(selection=selection, looks=looks, covered=covered)

    def _centre(self) -> None:
        place = self._intruder.place
        if self._map is not None and place is not None:
            self._map.centre_on(*place)

    def arrange(
        self, area: MapOverlay, bar: Rect, notice: Rect, form: str, dp: float, *, sheet_up: bool
    ) -> None:
        """Put it over the map `area` into the place `bar`; a sheet that is up covers it."""
        self._map, self._bar, self._notice = area, bar, notice
        self._form, self._dp, self._sheet_up = form, dp, sheet_up
        self._settle()

    def clear(self, cover: Rect | None) -> None:
        """Take away what would be seen only in part behind what is said over the map."""
        self.cover = cover
        self._settle()

    def _settle(self, *_: object) -> None:
        area = self._map
        if area is None:
            return
        box, bar, wide, cover = self.box, self._bar, self._form == "wide", self.cover
        low = area.y + area.insets[1]
        self._selection.width = self._checks.wide = box.width = bar.width
        self._checks.brief = (
            self._checks.tight
        ) = not wide  # on a phone the map is seen until a finger unfolds them
        self._checks.pos_hint = {"right": 1} if hand.left else {"x": 0}
        box.height = box.minimum_height
        box.pos = bar.x, bar.top - box.height if wide else bar.y
        self._checks.room = bar.top - low if wide else self._notice.top - bar.y
        area.foot = 0.0 if wide or not box.height else math.nan if self._covers else max(0.0, box.top - low)
        begins = low + (area.foot if math.isfinite(area.foot) else 0)
        if cover is not None and cover.overlaps(Rect(area.x, begins, area.width, SCALE_HEIGHT * self._dp)):
            area.foot = math.nan
        age = Rect(*area.badge_pos, *area.badge_size)
        area.says_age = cover is None or not cover.overlaps(age)
        hidden = cover is not None and cover.overlaps(Rect(*box.pos, *box.size))
        box.disabled = self._sheet_up or hidden
        box.opacity = float(not box.disabled)

    @property
    def _covers(self) -> bool:
        """What is in the corner has more to say than fits beside scale and legend."""
        unfolded = self._checks.unfolded and self._checks.parent is self.box
        unfolded = unfolded or self._intruder.parent is self.box
        return unfolded or (bool(self._selection.trouble) and self._selection.parent is self.box)
