"""Settings of the log and the study, as the handheld remembers them under `study`."""

from __future__ import annotations

from typing import Any

from app.core.checked_settings import CheckedSettings
from app.inputs.base.method_app import SettingsApp
from app.intents.intents import INTENTS, METHODS
from app.study.study import Plan, plan_of
from widgets.core.language import mark

__all__ = ["FLAGS", "StudySettings"]

FLAGS = {"log": True, "snippets": False, "remind": False}
"""Name and default of each switch."""


class StudySettings:
    """Read and kept value by value."""

    def __init__(self, app: SettingsApp) -> None:
        """`app` is asked for its `settings`."""
        self._app = app
        kept = CheckedSettings(app.settings.get("study"), mark("the study", "settings"))
        for name, usual in FLAGS.items():
            kept.flag(name, usual=usual)
        self.left: tuple[Plan, int, int] | None = plan_of(kept.values.get("plan"), METHODS, tuple(INTENTS))
        """The study that was left in the middle, with its block and trial; None for none."""
        if self.left is None and kept.values.get("plan") is not None:
            kept.mistaken("plan", "what was saved of a study")
        self.mistaken = kept.sentence
        """One sentence about settings that mean nothing; empty when all is well."""

    def _values(self) -> dict[str, Any]:
        values = self._app.settings.get("study")
        return values if isinstance(values, dict) else {}

    def flag(self, name: str) -> bool:
        """The switch of that name in `FLAGS`."""
        value = self._values().get(name, FLAGS[name])
        return value if isinstance(value, bool) else FLAGS[name]

    def keep(self, name: str, value: Any) -> None:
        """Remember one of them."""
        self._app.settings.set("study", {**self._values(), name: value})

    def save(self) -> dict[str, Any]:
        """All of them as JSON, those that nobody changed included."""
        return self._values() | {name: self.flag(name) for name in FLAGS}
