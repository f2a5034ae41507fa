"""The recordings that there are, each a row to open it by."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from app.replay.recording_list import Glimpse
from app.screens.replay.no_recordings import NoRecordings
from widgets.core.language import tr
from widgets.fields.message_fields import size_text
from widgets.parts.kit import Column, ListRow, Roll
from widgets.plots.time_line import length_text

__all__ = ["RecordingRows"]


class RecordingRows(Roll):
    """Dispatches `on_open(path)`."""

    __events__ = ("on_open",)

    def __init__(self, **kwargs: Any) -> None:
        self.column, self.nothing = Column(spacing="6dp"), NoRecordings()
        self.rows: dict[str, ListRow] = {}
        """By the name of the file."""
        super().__init__(**kwargs)
        self.add_widget(self.column)
        self.bind(height=lambda _, height: setattr(self.nothing, "room", height))

    def show(self, glimpses: Iterable[Glimpse]) -> None:
        """Show these in place of what was before."""
        self.column.clear_widgets()
        self.rows = {}
        for seen in glimpses:
            row = self.rows[seen.path.name] = self._row(seen)
            self.column.add_widget(row)
        if not self.rows:
            self.column.add_widget(self.nothing)

    def _row(self, seen: Glimpse) -> ListRow:
        when = (
            time.strftime("%Y-%m-%d %H:%M", time.localtime(seen.start))
            if math.isfinite(seen.start)
            else seen.path.stem
        )
        broken = bool(seen.problem) and not math.isfinite(seen.start)
        row = ListRow(
            icon="error" if broken else "warning" if seen.problem else "history",
            role="danger" if broken else "warn" if seen.problem else "accent",
            title=f"{seen.robot or tr('Unknown robot')} · {when}",
            detail=seen.problem or seen.path.name,
            aside=f"{length_text(seen.duration)} · {size_text(seen.size)}",
            whole=True,
        )
        row.bind(on_release=lambda _: self.dispatch("on_open", seen.path))
        return row

    def on_open(self, path: Path) -> None:
        """A finger wants to see that recording."""
