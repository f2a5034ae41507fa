"""What this handheld keeps: recordings and pictures with their sizes, where they are, to open, share and delete."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.device.documents import open_file
from app.device.sharing import sharing
from app.screens.setup.panes.settings_pane import SettingsPane
from widgets.core.language import figure, tr, trn
from widgets.parts.kit import Column, IconButton, ListRow, QuietButton, Remark

__all__ = ["MAX_SHOWN", "StoragePane", "size_words"]

MAX_SHOWN = 60
"""So many files are listed, the newest first."""
ASIDE = ".deleted"
"""Ending of a file that can still be brought back."""
STEPS = (("GB", 1e9), ("MB", 1e6), ("kB", 1e3))


def size_words(count: float) -> str:
    """A number of bytes in words."""
    for unit, size in STEPS:
        if count >= size:
            return f"{figure(count / size, 1)} {unit}"
    return f"{figure(count)} B"


class StoragePane(SettingsPane):
    """What is deleted can be brought back until another is deleted or the pane is left."""

    def fill(self) -> Iterable[Widget]:
        """The sum, the place, the way back, and the list."""
        self._aside: tuple[Path, Path] | None = None
        self._sharing = sharing()
        self.record = QuietButton(size_hint_y=None, height="52dp")
        self.record.bind(on_release=lambda _: self._toggle())
        self.sum, self.where = self.remark(""), self.remark("")
        self.problem = Remark(role="danger", font_size="15sp")
        self.undo = QuietButton(text=tr("Undo"), icon="undo", size_hint_y=None, height="52dp")
        self.undo.bind(on_release=lambda _: self._bring_back())
        self.folder = QuietButton(
            text=tr("Show the folder"), icon="folder_open", size_hint_y=None, height="52dp"
        )
        self.folder.bind(on_release=lambda _: self._open(self.app.records.folders[0]))
        self.back = Column(spacing="8dp")
        self.list = Column(spacing="6dp")
        self.rows: dict[Path, ListRow] = {}
        if self.app.session is not None:
            yield self.record
        yield self.sum
        yield self.where
        if self._sharing is None:
            yield self.folder
        yield self.problem
        yield self.back
        yield self.list

    def enter(self) -> None:
        """Look what there is."""
        self._look()
        self.tick()

    def tick(self) -> None:
        """Say whether a recording runs, and how long it is."""
        runs = self.app.session is not None and self.app.records.recorder is not None
        self.record.text = (
            tr("Stop recording · {time}").format(time=self.app.records.clock) if runs else tr("Record")
        )
        self.record.icon = "fiber_manual_record_fill" if runs else "fiber_manual_record"
        self.record.ink = "danger" if runs else "text"

    def _toggle(self) -> None:
        self.app.visit.toggle_recording()
        self.tick()
        self._look()

    def leave(self) -> None:
        """What was deleted is gone for good."""
        self._forget()

    def _look(self) -> None:
        files = self.app.records.kept()
        sizes = {path: path.stat().st_size for path in files}
        self.sum.text = trn("{count} recording or picture", "{count} recordings and pictures", len(files))
        self.sum.text += f" · {size_words(sum(sizes.values()))}"
        self.where.text = str(self.app.records.folders[0])
        self.list.clear_widgets()
        self.rows = {path: self._row(path, sizes[path]) for path in files[:MAX_SHOWN]}
        for row in self.rows.values():
            self.list.add_widget(row)
        self.back.clear_widgets()
        if self._aside is not None:
            self.back.add_widget(
                Remark(text=tr("Deleted {name}.").format(name=self._aside[0].name), font_size="15sp")
            )
            self.back.add_widget(self.undo)

    def _row(self, path: Path, size: int) -> ListRow:
        film = path.suffix == ".mcap"
        row = ListRow(
            icon="fiber_manual_record" if film else "photo_camera",
            title=path.name,
            detail=size_words(size),
            end="2dp",
        )
        buttons = {"delete": (tr("Delete"), lambda: self._delete(path))}
        if self._sharing is not None:
            buttons = {"upload": (tr("Share"), lambda: self._share(path)), **buttons}
        else:
            buttons = {"folder_open": (tr("Open"), lambda: self._open(path)), **buttons}
        box = BoxLayout(size_hint=(None, None), spacing="2dp", pos_hint={"center_y": 0.5})
        box.bind(minimum_width=box.setter("width"), minimum_height=box.setter("height"))
        for icon, (words, act) in buttons.items():
            button = IconButton(icon=icon, role="muted", bare=True)
            setattr(button, "scan_words", words)  # noqa: B010 - read by the switches where it is there
            button.bind(on_release=lambda _, act=act: act())
            box.add_widget(button)
        row.add_widget(box)
        row.bind(on_release=lambda _: self._open(path) if self._sharing is None else self._share(path))
        return row

    def _open(self, path: Path) -> None:
        try:
            path.mkdir(parents=True, exist_ok=True) if not path.suffix else None
            open_file(path)
        except OSError as error:
            self.problem.text = tr("It cannot be opened: {why}.").format(why=error.strerror or error)
        else:
            self.problem.text = ""

    def _share(self, path: Path) -> None:
        try:
            if self._sharing is not None:
                self._sharing.share(path)
        except OSError as error:
            self.problem.text = str(error)
        else:
            self.problem.text = ""

    def _delete(self, path: Path) -> None:
        self._forget()
        recorder = self.app.records.recorder
        if recorder is not None and recorder.path == path:
            self.problem.text = tr("It is being recorded: stop the recording first.")
            return
        aside = path.with_name(f".{path.name}{ASIDE}")
        try:
            path.rename(aside)
        except OSError as error:
            self.problem.text = tr("It cannot be deleted: {why}.").format(why=error.strerror or error)
            return
        self.problem.text, self._aside = "", (path, aside)
        self._look()

    def _bring_back(self) -> None:
        if self._aside is not None:
            path, aside = self._aside
            try:
                aside.rename(path)
            except OSError as error:
                self.problem.text = tr("It cannot be brought back: {why}.").format(
                    why=error.strerror or error
                )
            self._aside = None
        self._look()

    def _forget(self) -> None:
        """Delete for good what was put aside, now and by an app that was cut."""
        self._aside = None
        for folder in self.app.records.folders:
            for left in folder.glob(f"*/.*{ASIDE}"):
                try:
                    left.unlink()
                except OSError as error:
                    self.problem.text = tr("It cannot be deleted: {why}.").format(why=error.strerror or error)
