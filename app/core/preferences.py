"""What an operator chose for this handheld: units, language, gloves, hand, size of text; read with a check, applied at once.

preferences = Preferences(settings)
preferences.choose("units", "nautical")     # on the glass now, in the settings, and so the next time
preferences.sentence                        # "In the settings of this handheld units is one of the known, not 'miles': …"
"""

from __future__ import annotations

import gc
import logging
import math
from collections.abc import Callable
from typing import Any

from kivy.metrics import Metrics

from app.core.checked_settings import CheckedSettings
from app.core.hand import HANDS, hand
from app.core.settings_store import Settings
from widgets.core.language import LANGUAGES, language, mark
from widgets.core.quantities import SYSTEMS, quantities
from widgets.core.theme import theme

__all__ = ["MAKES_ANEW", "MAX_TEXT", "MIN_TEXT", "Preferences"]

log = logging.getLogger(__name__)

MAX_ATTEMPTS = 20
"""So often sizes are told of another scale until none makes new ones."""
MIN_TEXT, MAX_TEXT = 1.0, 2.0
"""Size of text, in times of the device's own."""
MAKES_ANEW = ("units", "language", "text", "hand")
"""What everything on the glass is made anew for: words, figures, sizes of type and places are taken when it is made, and every
control lets go before it is elsewhere."""


class Preferences:
    """One for the process: it changes the theme, the units and the language that all widgets look at."""

    def __init__(self, settings: Settings) -> None:
        """Read, check and apply what was kept; what is no good says so in `sentence`, and the default holds."""
        self._settings, self._own_text = settings, float(Metrics.fontscale)
        names = ("units", "language", "gloves", "text", "hand")
        kept = {name: settings.get(name) for name in names if settings.get(name) is not None}
        checked = CheckedSettings(kept or None, mark("this handheld", "settings"))
        language.name = checked.word(
            "language", LANGUAGES, usual="en"
        )  # first: what is no good is said in it
        self.text = checked.number("text", MIN_TEXT, MAX_TEXT, usual=1.0)
        """Size of text, `MIN_TEXT` to `MAX_TEXT`."""
        self.on_anew: Callable[[], object] = lambda: None
        """Called when everything on the glass is to be made anew."""
        quantities.system = checked.word("units", SYSTEMS, usual="metric")
        theme.gloves = checked.flag("gloves", usual=False)
        hand.chosen = checked.word("hand", HANDS, usual="right")
        hand.take_up()
        self._apply_text()
        self.sentence = checked.sentence
        """What was no good in the settings, as one sentence; empty when all is well."""

    def choose(self, name: str, value: Any) -> None:
        """Take `value` for `units`, `language`, `gloves`, `hand` or `text`, and remember it; KeyError for another name.

        ValueError, or Kivy's own, for a value that there is not.
        """
        takes: dict[str, Callable[[Any], object]] = {
            "units": lambda value: setattr(quantities, "system", value),
            "language": lambda value: setattr(language, "name", value),
            "gloves": lambda value: setattr(theme, "gloves", value),
            "text": self._take_text,
            "hand": _take_hand,
        }
        takes[name](value)
        self._settings.set(name, value)
        if name in MAKES_ANEW:
            self.on_anew()

    def close(self) -> None:
        """Give the process its own size of text back, and its hand."""
        self.text, hand.chosen = 1.0, "right"
        hand.take_up()
        self._apply_text()

    def _take_text(self, value: float) -> None:
        if not MIN_TEXT <= value <= MAX_TEXT:
            raise ValueError(f"The size of text is {MIN_TEXT:g} to {MAX_TEXT:g} times, not {value!r}.")
        self.text = float(value)
        self._apply_text()

    def _apply_text(self) -> None:
        wanted = self._own_text * self.text
        if math.isclose(Metrics.fontscale, wanted):
            return  # Kivy would tell every size all the same
        collecting = gc.isenabled()
        gc.disable()  # as when the theme changes: nothing may vanish while it is told
        try:
            _rescale(wanted)
        finally:
            if collecting:
                gc.enable()


def _take_hand(value: str) -> None:
    if value not in HANDS:
        raise ValueError(f"The hand is one of {', '.join(HANDS)}, not {value!r}.")
    hand.chosen = value


def _rescale(scale: float) -> None:
    """Have every size follow; where one that follows makes new ones, Kivy stops in the middle of them and is asked again."""
    for _ in range(MAX_ATTEMPTS):
        try:
            Metrics.fontscale = scale
        except RuntimeError:  # what followed already does not follow twice, so that this ends
            continue
        return
    log.warning("Some sizes of text did not follow.")
