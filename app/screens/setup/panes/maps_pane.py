"""Maps that lie beneath a robot's own: servers and files, their order, what is kept of them, and offline regions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from kivy.properties import StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.device.file_picking import FilePicking, file_picking
from app.maps.file_check import FileCheck
from app.maps.map_source import URL, Source
from app.maps.maps import SUFFIXES, Maps
from app.maps.regions import Region
from app.screens.setup.panes.map_form import MapForm
from app.screens.setup.panes.settings_pane import SettingsPane
from widgets.core.language import figure, tr
from widgets.core.theme import theme
from widgets.parts.kit import Column, IconButton, ListRow, QuietButton, Remark, Stepper, Text, TextField

__all__ = ["MapsPane"]

MEGABYTE = 1_000_000
CACHE_STEP = 20
"""Of what is kept [MB]."""


class RowButton(IconButton):
    """One at the end of a row, which has no room for its words."""

    scan_words = StringProperty("")
    """What it does, for a switch that steps over it."""


class MapsPane(SettingsPane):
    """A list, or in its place the form of one server."""

    def fill(self) -> Iterable[Widget]:
        """Everything; the lists are filled when it comes onto the glass."""
        self.maps: Maps = self.app.maps
        self.picking: FilePicking | None = file_picking()
        self._check: FileCheck | None = None
        self._unbind: Callable[[], None] | None = None
        self.listed, self.kept = Column(spacing="6dp"), Column(spacing="6dp")
        self.rows: dict[str, ListRow] = {}
        self.region_rows: dict[Region, ListRow] = {}
        self.form = MapForm(self.maps)
        self.form.bind(on_shut=lambda _: self._show_list())
        self.problem = Remark(role="danger", font_size="15sp")
        self.undo = self._button(tr("Undo"), "undo", self.maps.sources.undo)
        self.add = self._button(tr("Add a tile server"), "add", self.ask)
        self.browse = self._button(tr("Add a file"), "folder_open", self._pick)
        self.path = TextField(label=tr("Path of a file"), hint_text=tr("Path of a file"), write_tab=False)
        self.path.bind(on_text_validate=lambda _: self._take([Path(self.path.text.strip())], ""))
        self.cache = Stepper(minimum=20, maximum=4000, step=CACHE_STEP, unit="MB", pos_hint={"center_y": 0.5})
        self.cache.bind(on_change=lambda _, value: self.maps.sources.set_cache(value))
        self.used = self.remark("")
        self.clear = self._button(tr("Delete what is kept"), "delete", self._clear)
        self._content = list(self._all())
        return self._content

    def _all(self) -> Iterable[Widget]:
        yield self.remark(tr("They lie beneath the robot's map where they cover its place. Nothing is fetched from a server that is not on this list; one that is sees which places you look at."))  # fmt: skip
        yield self.listed
        yield self.problem
        yield self.add
        if self.picking is not None:
            yield self.browse
        if self.picking is None or self.picking.takes_paths:
            yield self.path
        yield self.remark(tr("Files: {suffixes}").format(suffixes=", ".join(SUFFIXES)))
        yield self.heading(tr("Kept of servers"))
        line = BoxLayout(size_hint_y=None, height=max(self.cache.height, theme.target), spacing="8dp")
        line.add_widget(Text(text=tr("At most"), pos_hint={"center_y": 0.5}))
        line.add_widget(self.cache)
        yield line
        yield self.used
        yield self.clear
        yield self.heading(tr("Offline regions"))
        yield self.remark(tr("On the map choose the layers, then Keep this area offline."))
        yield self.kept

    def _button(self, words: str, icon: str, act: Callable[[], object]) -> QuietButton:
        button = QuietButton(text=words, icon=icon)
        button.bind(on_release=lambda _: act())
        return button

    def enter(self) -> None:
        """Show what there is."""
        self._unbind = self.maps.sources.bind(self._list)
        self.cache.value = self.maps.sources.cache_megabytes
        self._list()
        self.tick()

    def leave(self) -> None:
        """Listen no more."""
        if self._unbind is not None:
            self._unbind()
            self._unbind = None
        if self.form.parent is not None:
            self.form.leave()

    def tick(self) -> None:
        """Downloads go on, tiles are forgotten, and a file that was chosen has been looked at."""
        self._say_used()
        if list(self.region_rows) != self.maps.regions.all:
            self._list_regions()
        for region in self.maps.regions.all:
            self._show_region(region)
        check = self._check
        if check is not None and check.over:
            self._check = None
            self.problem.role, self.problem.text = "danger", check.problem
            if check.source is not None:
                self._put(check.source)

    # sources

    def _list(self) -> None:
        sources = self.maps.sources
        self.listed.clear_widgets()
        self.rows.clear()
        for source in sources.all:
            self.rows[source.id] = self._row(source)
            self.listed.add_widget(self.rows[source.id])
        if sources.can_undo:
            if self.undo.parent is not None:
                self.undo.parent.remove_widget(self.undo)
            self.listed.add_widget(self.undo)

    def _row(self, source: Source) -> ListRow:
        row = ListRow(
            icon="link" if source.kind == URL else "map",
            title=tr(source.name),
            detail=source.detail,
            whole=True,
        )
        if source.shipped:
            return row
        if source.kind == URL:
            row.bind(on_release=lambda _: self.ask(source))
        sources = self.maps.sources
        for icon, words, act in (
            ("arrow_upward", tr("Prefer it more"), lambda: sources.move(source.id, -1)),
            ("delete", tr("Delete"), lambda: sources.remove(source.id)),
        ):
            button = RowButton(icon=icon, bare=True, scan_words=words, pos_hint={"center_y": 0.5})
            button.bind(on_release=lambda _, act=act: act())
            row.add_widget(button)
        return row

    def ask(self, source: Source | None = None) -> None:
        """Ask for a new server, or for changes of one."""
        session = self.app.session
        info = session.robot.info if session is not None else None
        self.form.ask(source, (info.latitude, info.longitude) if info is not None else (math.nan, math.nan))
        self._show([self.form])

    def _show_list(self) -> None:
        self._show(self._content)

    def _show(self, widgets: Iterable[Widget]) -> None:
        self.column.clear_widgets()
        for widget in widgets:
            self.column.add_widget(widget)
        self.scroll_y = 1.0

    # files

    def _pick(self) -> None:
        if self.picking is not None:
            self.picking.pick(self.maps.folder / "files", self._take)

    def _take(self, paths: list[Path], problem: str) -> None:
        """These were chosen; a floor plan's picture comes with its YAML file."""
        known = [path for path in paths if path.suffix.lower() in SUFFIXES]
        self.problem.role, self.problem.text = "danger", problem
        if paths:
            self._check = FileCheck((known or paths)[0])
            self.problem.role, self.problem.text = (
                "muted",
                tr("Reading {file} …").format(file=(known or paths)[0].name),
            )

    def _put(self, source: Source) -> None:
        try:
            self.maps.sources.put(source)
        except ValueError as wrong:
            self.problem.text = str(wrong)
            return
        self.path.text = ""

    # what is kept

    def _say_used(self) -> None:
        """How much is kept, which is counted, and made less, while this is looked at."""
        size = tr("{size} MB are kept now.").format(size=figure(self.maps.size(), 1))
        self.used.text = " ".join(part for part in (size, self.maps.store.problem) if part)

    def _clear(self) -> None:
        self.maps.store.clear()
        self._say_used()

    def _list_regions(self) -> None:
        self.kept.clear_widgets()
        self.region_rows.clear()
        for region in self.maps.regions.all:
            row = self.region_rows[region] = ListRow(icon="download", title=region.name, whole=True)
            row.bind(on_release=lambda _, region=region: self._turn(region))
            button = RowButton(icon="delete", bare=True, scan_words=tr("Delete"), pos_hint={"center_y": 0.5})
            button.bind(on_release=lambda _, region=region: self.maps.regions.delete(region))
            row.add_widget(button)
            self.kept.add_widget(row)

    def _show_region(self, region: Region) -> None:
        row = self.region_rows[region]
        done = tr("{done} of {total} tiles, {size} MB").format(
            done=region.done, total=region.total, size=figure(region.size / MEGABYTE, 1)
        )
        words = {
            "done": "",
            "loading": tr("Downloading; a tap pauses it."),
            "paused": tr("Paused; a tap goes on."),
            "failed": tr("{problem} A tap tries again.").format(problem=region.problem),
        }[region.state]
        row.detail = f"{done}. {words}".rstrip()
        row.icon, row.role = _REGION_LOOKS[region.state]

    def _turn(self, region: Region) -> None:
        """Pause its download, or go on with it."""
        source = self.maps.sources.get(region.source)
        if region.state == "loading":
            region.pause()
        elif region.state != "done" and source is not None:
            region.resume(source, self.maps.server)
        elif source is None:
            self.problem.text = tr("The server of this region is not on the list any more.")
        self.tick()


_REGION_LOOKS: dict[str, tuple[str, Any]] = {
    "done": ("check_circle", "ok"),
    "loading": ("download", "accent"),
    "paused": ("pause", "muted"),
    "failed": ("warning", "warn"),
}
"""Icon and role of a region by its state."""
