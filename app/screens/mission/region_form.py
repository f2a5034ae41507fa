"""Asks which zoom levels of the map in sight are to be kept offline, and says beforehand how much that is."""

from __future__ import annotations

from typing import Any

from kivy.uix.boxlayout import BoxLayout

from app.maps.map_source import Box, Source
from app.maps.maps import Maps
from app.maps.regions import RegionPlan
from bridge.core.geo import Datum
from widgets.core.language import figure, tr, trn
from widgets.core.theme import theme
from widgets.map.map_overlay import MapOverlay
from widgets.parts.kit import Column, PrimaryButton, QuietButton, Remark, Stepper, Text, TextField

__all__ = ["RegionForm", "visible_box"]

LEVELS = 4
"""Zoom levels that are offered below the one in sight."""
MEGABYTE = 1_000_000


def visible_box(map_: MapOverlay, datum: Datum) -> Box:
    """West, south, east and north of what the map shows [deg]."""
    x, y, wide, high = *map_.pos, *map_.size
    corners = [map_.view.to_world(px, py) for px in (x, x + wide) for py in (y, y + high)]
    places = [datum.to_geographic(*corner) for corner in corners]
    north, east = [place[0] for place in places], [place[1] for place in places]
    return min(east), min(north), max(east), max(north)


class RegionForm(Column):
    """Dispatches `on_shut` once the download has begun, or was given up."""

    __events__ = ("on_shut",)

    def __init__(self, maps: Maps, **kwargs: Any) -> None:
        super().__init__(spacing="8dp", **kwargs)
        self._maps = maps
        self._source: Source | None = None
        self._box: Box = (0.0, 0.0, 0.0, 0.0)
        self.name = TextField(label=tr("Name"), hint_text=tr("Name"), write_tab=False)
        self.least, self.most = (Stepper(maximum=24, pos_hint={"center_y": 0.5}) for _ in range(2))
        for one in (self.least, self.most):
            one.bind(on_change=lambda *_: self._say())
        self.size_said, self.problem = Remark(), Remark(role="danger")
        self.begin = PrimaryButton(text=tr("Download"), icon="download")
        self.begin.bind(on_release=lambda _: self._begin())
        cancel = QuietButton(text=tr("Cancel"))
        cancel.bind(on_release=lambda _: self.dispatch("on_shut"))
        buttons = BoxLayout(size_hint_y=None, height=self.begin.height, spacing="8dp")
        self.begin.bind(height=buttons.setter("height"))
        for button in (cancel, self.begin):
            buttons.add_widget(button)
        self.add_widget(self.name)
        for words, stepper in ((tr("From zoom level"), self.least), (tr("To zoom level"), self.most)):
            line = BoxLayout(size_hint_y=None, height=max(stepper.height, theme.target), spacing="8dp")
            line.add_widget(Text(text=words, pos_hint={"center_y": 0.5}))
            line.add_widget(stepper)
            self.add_widget(line)
        for widget in (self.size_said, self.problem, buttons):
            self.add_widget(widget)

    def ask(self, source: Source, datum: Datum, map_: MapOverlay) -> None:
        """Ask about what `map_` shows now of `source`."""
        self._source, self._box = source, visible_box(map_, datum)
        ground = getattr(map_, "ground", None)
        zoom = ground.pictures.zoom if ground is not None and hasattr(ground, "pictures") else source.max_zoom
        for one in (self.least, self.most):
            one.minimum, one.maximum = source.min_zoom, source.max_zoom
        self.least.value, self.most.value = max(zoom - LEVELS, source.min_zoom), source.max_zoom
        while self.plan.refusal and self.most.value > zoom:
            self.most.value -= 1
        self.name.text = tr("{map} {count}").format(map=source.name, count=len(self._maps.regions.all) + 1)
        self._say()

    @property
    def plan(self) -> RegionPlan:
        """What is asked for."""
        least, most = sorted((int(self.least.value), int(self.most.value)))
        return RegionPlan(self._box, least, most)

    def tick(self) -> None:
        """Nothing of it changes by itself."""

    def _say(self) -> None:
        plan = self.plan
        self.problem.text = plan.refusal
        self.begin.disabled = bool(plan.refusal)
        self.size_said.text = trn(
            "{count} tile, about {size} MB. Ask the server's terms whether it may be kept.",
            "{count} tiles, about {size} MB. Ask the server's terms whether they may be kept.",
            plan.count,
        ).format(count=plan.count, size=figure(plan.size / MEGABYTE, 1))

    def _begin(self) -> None:
        if self._source is None:
            return
        try:
            self._maps.regions.begin(
                self._source, self.name.text.strip() or self._source.name, self.plan, self._maps.server
            )
        except ValueError as fault:
            self.problem.text = str(fault)
            return
        self.dispatch("on_shut")

    def on_shut(self) -> None:
        """It has nothing more to ask."""
