"""Form of one tile server: its address, judged while it is typed, and a tile that shows what comes from it."""

from __future__ import annotations

import math
from typing import Any

from kivy.clock import Clock
from kivy.graphics.texture import Texture
from kivy.metrics import dp
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.image import Image

from app.maps.map_source import URL, Source
from app.maps.maps import Maps
from app.maps.sources import new_id
from app.maps.tile_trial import TileTrial, tile_at
from widgets.core.language import mark, tr
from widgets.core.theme import theme
from widgets.parts.kit import Column, PrimaryButton, QuietButton, Remark, Stepper, Text, TextField, Toggle

__all__ = ["MapForm"]

QUIET = 0.8
"""How long nothing is typed before a tile is asked for [s]."""
LOOK_PERIOD = 0.1
"""How often it is looked whether one came [s]."""
TILE = 160
"""Side of the tile that is shown [dp]."""
USUAL_NAME = mark("Streets")


class MapForm(Column):
    """Dispatches `on_shut` once it has been kept or given up."""

    __events__ = ("on_shut",)

    def __init__(self, maps: Maps, **kwargs: Any) -> None:
        super().__init__(spacing="8dp", **kwargs)
        self._maps = maps
        self._source: Source | None = None
        self._place = math.nan, math.nan
        self._trial: TileTrial | None = None
        self._try = Clock.create_trigger(lambda _: self._begin_trial(), QUIET)
        self._look = Clock.create_trigger(lambda _: self._end_trial(), LOOK_PERIOD)
        self._make_fields()
        self.tile = Image(size_hint=(None, None), size=(dp(TILE), dp(TILE)), fit_mode="contain", opacity=0)
        # without a texture it would be a white square
        self.tile.bind(texture=lambda tile, texture: setattr(tile, "opacity", 0 if texture is None else 1))
        self.problem, self.came = Remark(role="danger"), Remark()
        self.save = PrimaryButton(text=tr("Save"), icon="check")
        self.save.bind(on_release=lambda _: self._keep())
        cancel = QuietButton(text=tr("Cancel"))
        cancel.bind(on_release=lambda _: self.leave())
        buttons = BoxLayout(size_hint_y=None, height=self.save.height, spacing="8dp")
        self.save.bind(height=buttons.setter("height"))
        for button in (cancel, self.save):
            buttons.add_widget(button)
        shown = BoxLayout(size_hint_y=None, height=0, spacing="12dp")
        self.came.bind(text=lambda _, words: setattr(shown, "height", dp(TILE) if words else 0))
        shown.add_widget(self.tile)
        shown.add_widget(self.came)
        self.came.pos_hint = {"center_y": 0.5}
        words = tr("{z}, {x} and {y} stand for the tile; {-y} counts from the south, {s} is a, b or c, {r} is @2x, {key} the key. The server sees which places you look at.")  # fmt: skip
        for widget in (*self.fields.values(), self.problem, buttons, shown):
            self.add_widget(widget)
        for widget in (Remark(text=words, role="muted"), *self._lines):
            self.add_widget(widget)

    def _make_fields(self) -> None:
        labels = {
            "where": tr("Address"), "key": tr("Key, if the server asks for one"), "name": tr("Name"),
            "attribution": tr("Whom the map is of, as its terms ask"),
        }  # fmt: skip
        self.fields = {
            name: TextField(label=label, hint_text=label, write_tab=False, password=name == "key")
            for name, label in labels.items()
        }
        for field in self.fields.values():
            field.bind(text=lambda *_: self._judge())
        self.least, self.most = (Stepper(maximum=24, pos_hint={"center_y": 0.5}) for _ in range(2))
        self.from_south = Toggle(pos_hint={"center_y": 0.5})
        self._lines = []
        for words, widget in (
            (tr("From zoom level"), self.least),
            (tr("To zoom level"), self.most),
            (tr("Rows count from the south (TMS)"), self.from_south),
        ):
            line = BoxLayout(size_hint_y=None, height=max(widget.height, theme.target), spacing="8dp")
            line.add_widget(Text(text=words, pos_hint={"center_y": 0.5}))
            line.add_widget(widget)
            widget.bind(on_change=lambda *_: self._judge())
            self._lines.append(line)

    def ask(self, source: Source | None, place: tuple[float, float]) -> None:
        """Ask for a new server, or for changes of one; `place` is where the robot is [deg], NaN where that is not known."""
        self._source, self._place = source, place
        for name, field in self.fields.items():
            field.text = getattr(source, name) if source is not None else ""
        self.least.value, self.most.value = (
            (source.min_zoom, source.max_zoom) if source is not None else (0, 19)
        )
        self.from_south.active = source is not None and source.from_south
        self._judge()

    def source(self) -> Source:
        """What is typed; ValueError, in one sentence, where it is no map."""
        typed = {name: field.text.strip() for name, field in self.fields.items()}
        return Source(
            self._source.id if self._source is not None else new_id(), URL, typed["name"] or tr(USUAL_NAME),
            typed["where"], typed["attribution"], int(self.least.value), int(self.most.value), typed["key"],
            self.from_south.active,
        )  # fmt: skip

    def _judge(self) -> None:
        self._try.cancel()
        self._trial, self.came.text, self.tile.texture = None, "", None
        if not self.fields["where"].text.strip():
            self.problem.text, self.save.disabled = "", True
            return
        try:
            self.source()
        except ValueError as wrong:
            self.problem.text, self.save.disabled = str(wrong), True
            return
        self.problem.text, self.save.disabled = "", False
        self._try()

    def _begin_trial(self) -> None:
        source = self.source()
        tile = tile_at(*self._place, source.min_zoom, source.max_zoom)
        self._trial = TileTrial(self._maps.server, source.address(), tile)
        self.came.text = tr("Asking {host} …").format(host=source.address().host)
        self._look()

    def _end_trial(self) -> None:
        trial = self._trial
        if trial is None:
            return
        if not trial.over:
            self._look()
            return
        self._trial = None
        if trial.picture is None:
            self.came.text = trial.problem
            return
        self.tile.texture = Texture.create_from_data(trial.picture)
        if trial.picture.flip_vertical:
            self.tile.texture.flip_vertical()
        self.came.text = tr("This came from the server.")

    def _keep(self) -> None:
        try:
            self._maps.sources.put(self.source())
        except ValueError as wrong:
            self.problem.text = str(wrong)
            return
        self.leave()

    def leave(self) -> None:
        """Ask no more."""
        self._try.cancel()
        self._look.cancel()
        self._trial = None
        self.fields["key"].text = ""
        self._try.cancel()
        self.dispatch("on_shut")

    def on_shut(self) -> None:
        """It has nothing more to ask."""
