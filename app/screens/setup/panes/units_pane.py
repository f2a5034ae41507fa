"""Units of the figures on the glass."""

from __future__ import annotations

from collections.abc import Iterable

from kivy.uix.widget import Widget

from app.screens.setup.panes.settings_pane import Choices, SettingsPane
from widgets.core.language import tr
from widgets.core.quantities import KINDS, SYSTEMS, quantities

__all__ = ["UnitsPane"]

EXAMPLES = ("speed", "height", "distance", "temperature")
"""Kinds whose units a row names."""


class UnitsPane(SettingsPane):
    """Metric, imperial or nautical."""

    def fill(self) -> Iterable[Widget]:
        """The choice, and that no robot notices it."""
        options = {name: (tr(words).partition(":")[0], _signs(name)) for name, words in SYSTEMS.items()}
        self.choices = Choices(options, quantities.system)
        self.choices.bind(on_choose=lambda _, name: self.app.preferences.choose("units", name))
        yield self.choices
        yield self.remark(tr("Only what you read and type changes. Robots are always told SI units."))


def _signs(system: str) -> str:
    """As in `m/s · m · m, km · °C`."""
    told = (dict.fromkeys(unit.sign for unit in KINDS[kind][system]) for kind in EXAMPLES)
    return " · ".join(", ".join(signs) for signs in told)
