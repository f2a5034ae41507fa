"""Where the ways in are set up: a list of them, and beside it the pane of the one that is chosen.

A pane is a widget in a module of its own, made as `Pane(app=app)` when it is first looked at, with `enter()`, `leave()` and
`tick()`; it shows its own title where it needs one. Whoever brings a method adds a line to `PANES`.
"""

from __future__ import annotations

from importlib.util import find_spec

from app.screens.parts.method_signs import METHOD_SIGNS

__all__ = ["PANES", "panes"]

PANES: dict[str, tuple[str, str, str]] = {
    "voice": (*METHOD_SIGNS["voice"], "app.screens.inputs.panes.voice_pane:VoicePane"),
    "shake": (*METHOD_SIGNS["shake"], "app.screens.inputs.panes.shake_pane:ShakePane"),
    "tilt": (*METHOD_SIGNS["tilt"], "app.screens.inputs.panes.tilt_pane:TiltPane"),
    "switches": (*METHOD_SIGNS["switches"], "app.screens.inputs.panes.switch_pane:SwitchPane"),
    "gamepad": (*METHOD_SIGNS["gamepad"], "app.screens.inputs.panes.pad_pane:PadPane"),
    "keyboard": (*METHOD_SIGNS["keyboard"], "app.screens.inputs.panes.keys_pane:KeysPane"),
    "table": ("tune", "What each may do", "app.screens.inputs.panes.permit_table:TablePane"),
    "study": ("timeline", "Log and study", "app.screens.inputs.study.study_pane:StudyPane"),
}
"""Name, as of the method where it is one, to icon, title, and module and class of its pane."""


def panes() -> dict[str, tuple[str, str, str]]:
    """Those of `PANES` whose module there is, in their order."""
    return {name: pane for name, pane in PANES.items() if find_spec(pane[2].partition(":")[0]) is not None}
