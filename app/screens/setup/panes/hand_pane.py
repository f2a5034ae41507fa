"""Which hand holds STOP."""

from __future__ import annotations

from collections.abc import Iterable

from kivy.uix.widget import Widget

from app.core.hand import HANDS, hand
from app.screens.setup.panes.settings_pane import Choices, SettingsPane
from widgets.core.language import mark, tr

__all__ = ["HandPane"]

ABOUT = {
    "right": mark("STOP is in the lower right corner, the stick that drives at the left."),
    "left": mark("STOP is in the lower left corner, the stick that drives at the right."),
}


class HandPane(SettingsPane):
    """The two hands; everything on the glass is mirrored with the next frame, once every control has let go."""

    def fill(self) -> Iterable[Widget]:
        """The hands, and what is not mirrored."""
        told = {name: (tr(title), tr(ABOUT[name])) for name, title in HANDS.items()}
        self.choices = Choices(told, hand.chosen)
        self.choices.bind(on_choose=lambda _, name: self.app.preferences.choose("hand", name))
        yield self.remark(tr("The hand that holds STOP."))
        yield self.choices
        yield self.remark(tr("Of two sticks the left one stays under the left thumb."))
