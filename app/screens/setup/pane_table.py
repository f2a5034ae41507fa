"""The panes of the setup screen by name: icon, title, the class that each is made of, and how it stands in its row.

A pane is a widget in a module of its own, made as `Pane(app=app)` when it is first opened, with `enter()`, `leave()` and
`tick()`. A new one adds a line here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from app.core.hand import HANDS, hand
from app.core.optional_parts import is_included
from app.screens.parts.themes import TITLES as THEME_TITLES
from widgets.core.language import language, mark, tr, trn
from widgets.core.quantities import SYSTEMS, quantities
from widgets.core.theme import theme

__all__ = ["PANES", "Pane", "panes"]


def _nothing(_: Any) -> str:
    return ""


class Pane(NamedTuple):
    """One entry of the list."""

    icon: str
    """Name of its icon."""
    title: str
    """What it is called, in English."""
    where: str
    """Module and class, as in `app.screens.setup.panes.units_pane:UnitsPane`."""
    standing: Callable[[Any], str] = _nothing
    """What its row says of it, given the app; empty for nothing."""


def _looks(_: Any) -> str:
    return tr(THEME_TITLES[theme.name]) + (" · " + tr("gloves") if theme.gloves else "")


def _heard(app: Any) -> str:
    count = sum(app.sounds.on.values())
    return trn("{count} sound on", "{count} sounds on", count) if count else tr("off")


PANES: dict[str, Pane] = {
    "name": Pane(
        "computer",
        mark("Name of this handheld"),
        "app.screens.setup.panes.name_pane:NamePane",
        lambda app: str(app.client_name),
    ),
    "units": Pane(
        "straighten",
        mark("Units"),
        "app.screens.setup.panes.units_pane:UnitsPane",
        lambda _: tr(SYSTEMS[quantities.system]),
    ),
    "language": Pane(
        "text_fields",  # letters
        mark("Language"),
        "app.screens.setup.panes.language_pane:LanguagePane",
        lambda _: language.tongue.own_name,
    ),
    "looks": Pane(
        "light_mode", mark("Theme and gloves"), "app.screens.setup.panes.looks_pane:LooksPane", _looks
    ),
    "hand": Pane(
        "pan_tool",
        mark("Hand"),
        "app.screens.setup.panes.hand_pane:HandPane",
        lambda _: tr(HANDS[hand.chosen]),
    ),
    "text": Pane(
        "zoom_in",
        mark("Size of text"),
        "app.screens.setup.panes.text_pane:TextPane",
        lambda app: f"{app.preferences.text * 100:.0f} %",
    ),
    "maps": Pane("map", mark("Maps"), "app.screens.setup.panes.maps_pane:MapsPane"),
    "sounds": Pane(
        "volume_up", mark("Sounds and talk-back"), "app.screens.setup.panes.sounds_pane:SoundsPane", _heard
    ),
    "inputs": Pane(
        "sports_esports",
        mark("Inputs"),
        "app.screens.setup.panes.inputs_pane:InputsPane",
        lambda _: tr("Pad, keys, voice, tilt, switches"),
    ),
    "storage": Pane(
        "save", mark("Recordings and pictures"), "app.screens.setup.panes.storage_pane:StoragePane"
    ),
    "about": Pane("info", mark("About Pilothouse"), "app.screens.setup.panes.about_pane:AboutPane"),
}
"""By its name, in their order."""


def panes() -> dict[str, Pane]:
    """Those of `PANES` whose module is part of this build, in their order."""
    return {name: pane for name, pane in PANES.items() if is_included(pane.where)}
