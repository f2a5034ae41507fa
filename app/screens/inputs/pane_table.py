"""The panes of the inputs screen by name: icon, title, and the class that each is made of.

A pane is a widget in a module of its own, made as `Pane(app=app)` when it is first opened, with `enter()`, `leave()` and
`tick()`; it shows its own title where it needs one. A new method adds a line here and one to `app.screens.parts.method_signs`.
"""

from __future__ import annotations

from typing import NamedTuple

from app.core.optional_parts import is_included
from app.screens.parts.method_signs import METHOD_SIGNS
from widgets.core.language import mark

__all__ = ["PANES", "Pane", "panes"]


class Pane(NamedTuple):
    """One entry of the list."""

    icon: str
    """Name of its icon."""
    title: str
    """What it is called."""
    where: str
    """Module and class, as in `app.screens.inputs.panes.voice_pane:VoicePane`."""


PANES: dict[str, Pane] = {
    "voice": Pane(*METHOD_SIGNS["voice"], "app.screens.inputs.panes.voice_pane:VoicePane"),
    "shake": Pane(*METHOD_SIGNS["shake"], "app.screens.inputs.panes.shake_pane:ShakePane"),
    "tilt": Pane(*METHOD_SIGNS["tilt"], "app.screens.inputs.panes.tilt_pane:TiltPane"),
    "switches": Pane(*METHOD_SIGNS["switches"], "app.screens.inputs.panes.switch_pane:SwitchPane"),
    "gamepad": Pane(*METHOD_SIGNS["gamepad"], "app.screens.inputs.panes.pad_pane:PadPane"),
    "keyboard": Pane(*METHOD_SIGNS["keyboard"], "app.screens.inputs.panes.keys_pane:KeysPane"),
    "table": Pane("tune", mark("Permissions"), "app.screens.inputs.panes.permit_table:TablePane"),
    "study": Pane("timeline", mark("Log and study"), "app.screens.inputs.study.study_pane:StudyPane"),
}
"""By its name, which is that of the method where it sets up one."""


def panes() -> dict[str, Pane]:
    """Those of `PANES` whose module is part of this build, in their order."""
    return {name: pane for name, pane in PANES.items() if is_included(pane.where)}
