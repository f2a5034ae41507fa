"""Sheet of questions, none answered beforehand: the answers, their order, and the time they took.

class Sheet(AnswerSheet): ...
sheet = Sheet({"effort": Scale("effort")}, now)
sheet.answers  # {"effort": 35}
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import BooleanProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from widgets.core.base import Control
from widgets.core.surfaces import Outlined
from widgets.core.theme import theme  # noqa: F401 - the rule names it
from widgets.parts.column import Column

__all__ = ["AnswerRow", "AnswerSheet"]

Builder.load_string("""
<AnswerRow>:
    ground: 'surface'
    rim: 'warn' if root.lacking else 'line'
    corner: theme.radius
""")


class AnswerRow(Outlined, Column):
    """One question."""

    name = StringProperty("")
    """What it is called where its answer lacks."""
    value = NumericProperty(math.nan)
    """The answer; NaN before a hand gave one."""
    lacking = BooleanProperty(False)
    """It was asked for and has no answer."""

    def answer(self, value: int) -> None:
        """Give an answer, or another one."""
        self.lacking, self.value = False, float(value)


class AnswerSheet(Control, Column):
    """Dispatches `on_command(key, value)` with each answer, as a whole number."""

    veiled = False

    def __init__(self, rows: Mapping[str, AnswerRow], now: Callable[[], float], **kwargs: Any) -> None:
        """`rows` are the questions in the order of the sheet; `now` times the answers [s]."""
        super().__init__(**{"spacing": dp(8), **kwargs})
        self._now, self._shown, self._away = now, now(), math.nan
        self.rows = rows
        self.order: list[str] = []
        """The questions in the order in which they were answered first."""
        self.seconds: dict[str, float] = {}
        """Question to the time of its last answer since the sheet was shown, without what passed while it was put away [s]."""
        for key, row in rows.items():
            row.fbind("value", self._answered, key)
            self.add_widget(row)

    @property
    def answers(self) -> dict[str, int]:
        """Question to answer, of those that have one."""
        return {key: int(row.value) for key, row in self.rows.items() if math.isfinite(row.value)}

    def pause(self) -> None:
        """It is hidden until `resume`."""
        if math.isnan(self._away):
            self._away = self._now()

    def resume(self) -> None:
        """Continue it; nothing where it was not paused."""
        if not math.isnan(self._away):
            self._shown += self._now() - self._away
            self._away = math.nan

    def _answered(self, key: str, _: Widget, value: float) -> None:
        if key not in self.order:
            self.order.append(key)
        self.seconds[key] = round(self._now() - self._shown, 3)
        self.dispatch("on_command", key, int(value))

    def mark_unanswered(self) -> list[str]:
        """Mark the questions without an answer, and name them in words."""
        for row in self.rows.values():
            row.lacking = math.isnan(row.value)
        return [row.name for row in self.rows.values() if row.lacking]
