"""The card over the map that asks what lies beneath it: which map, how plainly it is seen, and what of it is kept offline."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.uix.boxlayout import BoxLayout

from app.maps.ground_keeper import GroundKeeper
from app.maps.map_source import KINDS, URL, Source
from app.maps.maps import Maps
from app.maps.sources import AUTOMATIC, NO_MAP
from app.screens.mission.region_form import RegionForm
from app.screens.parts.pane_head import PaneHead
from widgets.core.language import tr
from widgets.core.theme import theme
from widgets.map.map_overlay import MapOverlay
from widgets.parts.kit import Card, Column, ListRow, QuietButton, Remark, Roll, Stepper, Text

__all__ = ["LayersCard"]

Builder.load_string("""
<LayersCard>:
    size_hint: None, None
    outline: 'accent'
    padding: dp(12), dp(4), dp(12), dp(12)
    spacing: dp(8)
""")

CHOSEN, OTHER = "radio_button_checked", "radio_button_unchecked"
STEP = 10
"""Of the opacity [%]."""


class LayersCard(Card):
    """Dispatches `on_shut` when it has been left, and `on_setup` when the list of maps is wanted."""

    __events__ = ("on_shut", "on_setup")

    def __init__(
        self, maps: Maps, keeper: GroundKeeper, map_: Callable[[], MapOverlay], **kwargs: Any
    ) -> None:
        """`map_` is the map on the glass, whose visible part can be kept."""
        super().__init__(**kwargs)
        self._maps, self._keeper, self._map = maps, keeper, map_
        self.head = PaneHead(title=tr("Map"), closable=True)
        self.head.bind(on_close=lambda _: self.leave())
        self.rows: dict[str, ListRow] = {}
        self.trouble = Remark(role="warn")
        self.region = RegionForm(maps)
        self.region.bind(on_shut=lambda _: self._fill())
        self.column = Column(spacing="6dp", padding=(0, 0, "8dp", 0))
        roll = Roll()
        roll.add_widget(self.column)
        self.add_widget(self.head)
        self.add_widget(roll)
        self.plainness = Stepper(minimum=STEP, maximum=100, step=STEP, unit="%", pos_hint={"center_y": 0.5})
        self.plainness.bind(on_change=lambda _, value: maps.sources.set_opacity(value / 100))
        self.offline = QuietButton(text=tr("Keep this area offline"), icon="download")
        self.offline.bind(on_release=lambda _: self._ask_region())
        self.setup = QuietButton(text=tr("Maps in Setup"), icon="settings")
        self.setup.bind(on_release=lambda _: self.dispatch("on_setup"))
        self._shown: tuple[Any, ...] = ()

    def open(self) -> None:
        """Show what there is now."""
        self._fill()
        self.tick()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self.trouble.text = self._keeper.trouble
        now = (self._keeper.source, tuple(self._keeper.covering()), self._maps.sources.chosen)
        if now != self._shown and self.region.parent is None:
            self._fill()
        self.region.tick()

    def _fill(self) -> None:
        sources, keeper = self._maps.sources, self._keeper
        covering = keeper.covering()
        self._shown = keeper.source, tuple(covering), sources.chosen
        self.column.clear_widgets()
        self.rows.clear()
        for source in covering:
            self._row(source.id, source.name, self._detail(source), chosen=keeper.source == source)
        self._row(NO_MAP, tr("The robot's map alone"), "", chosen=keeper.source is None)
        if not covering:
            self.column.add_widget(Remark(text=self._why_none(), role="muted"))
        self.column.add_widget(self.trouble)
        if keeper.source is not None:
            self._add_opacity()
            if keeper.source.kind == URL:
                self.column.add_widget(self.offline)
        self.column.add_widget(self.setup)

    def _row(self, id_: str, title: str, detail: str, *, chosen: bool) -> None:
        icon, role = (CHOSEN, "accent") if chosen else (OTHER, "muted")
        row = self.rows[id_] = ListRow(
            icon=icon, role=role, title=title, detail=detail, chosen=chosen, whole=True
        )
        row.bind(on_release=lambda _: self._choose(id_))
        self.column.add_widget(row)

    def _add_opacity(self) -> None:
        line = BoxLayout(size_hint_y=None, height=max(self.plainness.height, theme.target), spacing="8dp")
        line.add_widget(Text(text=tr("Seen through the grid"), pos_hint={"center_y": 0.5}))
        if self.plainness.parent is not None:
            self.plainness.parent.remove_widget(self.plainness)
        self.plainness.value = round(100 * self._maps.sources.opacity / STEP) * STEP
        line.add_widget(self.plainness)
        self.column.add_widget(line)

    @staticmethod
    def _detail(source: Source) -> str:
        return " · ".join(part for part in (tr(KINDS[source.kind]), tr(source.attribution)) if part)

    def _why_none(self) -> str:
        if self._keeper.place.datum is None:
            return tr(
                "The robot does not say where on earth it is; only a floor plan can be laid beneath its map."
            )
        return tr("None of your maps covers the robot's place.")

    def _choose(self, id_: str) -> None:
        covering = self._keeper.covering()
        first = covering[0].id if covering else ""
        self._maps.sources.choose(AUTOMATIC if id_ == first else id_)
        self._keeper.look()
        self._fill()
        self.tick()

    def _ask_region(self) -> None:
        source, datum = self._keeper.source, self._keeper.place.datum
        if source is None or datum is None:
            return
        self.region.ask(source, datum, self._map())
        self.column.clear_widgets()
        self.column.add_widget(self.region)

    def on_touch_down(self, touch: Any) -> bool:
        """The map behind the card gets no finger that comes down on it."""
        return bool(super().on_touch_down(touch)) or bool(self.collide_point(*touch.pos))

    def leave(self) -> None:
        """Away with it."""
        self.dispatch("on_shut")

    def on_shut(self) -> None:
        """It has nothing more to ask."""

    def on_setup(self) -> None:
        """The list of maps is wanted."""
