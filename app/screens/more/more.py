"""The page of everything that the navigation of this window has no room for: other screens, and what no screen does."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import sp
from kivy.properties import ObjectProperty
from kivy.uix.gridlayout import GridLayout

from app.layout import arrange
from app.layout.arrange import Body, Rect
from app.screens.more.tile import Tile
from app.screens.parts.placing import Area, above, put  # noqa: F401 - a rule names the area
from app.screens.parts.robot_screen import RobotScreen
from app.screens.parts.screen_table import Entry, beyond
from app.screens.parts.themes import THEMES
from app.screens.shell import status_text
from app.screens.shell.key_help import toggle_help
from app.session.session import Session
from widgets.core.language import mark, tr
from widgets.core.theme import theme
from widgets.parts.kit import Roll

__all__ = ["MoreScreen"]

Builder.load_string("""
<MoreScreen>:
    Area:
        id: listed
""")

TILE_WIDTH, TILE_HEIGHT = 170, 84
"""The least that a tile is read in [dp]; where text is enlarged it is as much wider, and as high as its words."""
ACTS = {
    "control": ("person", mark("Control")),
    "record": ("fiber_manual_record", mark("Record")),
    "theme": ("light_mode", mark("Theme")),
    "people": ("lock", mark("Who has a key")),
    "help": ("keyboard", mark("Keys and gamepad")),
    "leave": ("arrow_back", mark("Leave the robot")),
}
"""What no screen does, by its name, to its icon and words."""


class MoreScreen(RobotScreen):
    """Each tile leads to a screen, or does at one tap what used to be a button of the navigation."""

    app = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.ids.listed = self.ids.listed.__self__  # kv holds ids weakly
        self.grid = GridLayout(spacing="10dp", size_hint_y=None)
        self.grid.bind(minimum_height=self.grid.setter("height"))
        roll = Roll()
        roll.add_widget(self.grid)
        self.ids.listed.add_widget(roll)
        self.tiles: dict[str, Tile] = {}
        """By the name of the screen, or of the act."""
        self._listed, self._whole = tuple[Entry, ...](), Rect(0, 0, 1, 1)
        self._cover: Rect | None = None
        self.notice = Rect(0, 0, 1, 1)

    def arrange(self, body: Body, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        places = arrange.more(body, form, dp)
        self.notice, self._whole = places["notice"], places["list"]
        self._fill(beyond(form))
        columns = max(1, int(self._whole.width // max(TILE_WIDTH * dp, sp(TILE_WIDTH))))
        self.grid.cols = min(columns, 4)
        self.grid.row_default_height = max(TILE_HEIGHT * dp, theme.target)
        put(self.ids.listed, above(self._whole, self._cover, dp))
        return places["stop"]

    def _fill(self, entries: tuple[Entry, ...]) -> None:
        """A tile for each of these screens, and one for each act."""
        if entries == self._listed and self.tiles:
            return
        self._listed, self.tiles = entries, {}
        self.grid.clear_widgets()
        for entry in entries:
            self._add(entry.name, self._to(entry.name), entry.icon, entry.words).about = tr(entry.about)
        for name, (icon, words) in ACTS.items():
            self._add(name, self._does(name), icon, words)
        self.tick()

    def _add(self, name: str, act: Callable[[], object], icon: str, words: str) -> Tile:
        tile = self.tiles[name] = Tile(icon=icon, words=tr(words))
        tile.bind(on_release=lambda _: act())
        self.grid.add_widget(tile)
        return tile

    def _to(self, screen: str) -> Callable[[], object]:
        return lambda: self.app.show(screen)

    def _does(self, name: str) -> Callable[[], object]:
        return lambda: self._do(name)

    def _do(self, name: str) -> None:
        app = self.app
        acts: dict[str, Callable[[], object]] = {
            "control": app.shell.toggle_control,
            "record": app.visit.toggle_recording,
            "theme": app.themes.choose_next,
            "people": app.shell.show_people,
            "help": lambda: toggle_help(app),
            "leave": app.leaving.leave,
        }
        acts[name]()

    def clear(self, cover: Rect | None) -> None:
        """End above what is said over the screen."""
        self._cover = cover
        put(self.ids.listed, above(self._whole, cover, 1.0))

    def enter(self) -> None:
        """Come onto the glass."""
        self.tick()

    def tick(self) -> None:
        """Say how control, the recording and the theme stand."""
        if not self.tiles:
            return
        words, icon, role = status_text.control(self.session, brief=False)
        control, record, tint = (self.tiles[name] for name in ("control", "record", "theme"))
        control.icon, control.role, control.about = icon, role, words
        running = self.app.records.recorder is not None
        record.words = tr("Stop recording") if running else tr("Record")
        record.about = self.app.records.clock if running else tr("Everything that comes, into a file")
        record.icon = "fiber_manual_record_fill" if running else "fiber_manual_record"
        record.role = "danger" if running else "accent"
        (tint.icon, title, following) = THEMES[theme.name]
        tint.words = tr("Theme: {theme}").format(theme=tr(title))
        tint.about = tr("A tap changes it to: {theme}").format(theme=tr(THEMES[following][1]))
        people = self.tiles["people"]
        people.icon, people.role = ("lock", "ok") if self.session.protected else ("lock_open", "warn")
        people.about = tr("Protected") if self.session.protected else tr("Not protected")
