"""Gamepad and keyboard as ways in that can be switched on and off: how each stands, in a word. STOP works all the same."""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol

from app.inputs.inputs import Inputs
from widgets.core.language import mark, tr

__all__ = ["GamepadMethod", "KeyboardMethod"]

STANDING = {
    "ready": "ready",
    "drives": "drives",
    "silent": mark("silent: drives nothing"),
    "let go": mark("Release the stick first, then push it again."),
}


class HandsApp(Protocol):
    """An app with keys and gamepads."""

    @property
    def inputs(self) -> Inputs:
        """Keys and gamepads."""
        ...


class GamepadMethod:
    """All gamepads that are plugged in."""

    name = "gamepad"

    def __init__(self, app: HandsApp) -> None:
        """`app` is asked for its `inputs`."""
        self._inputs = app.inputs

    @property
    def on(self) -> bool:
        """They drive, and their buttons mean something."""
        return bool(self._inputs.mapped.pads_on)

    @on.setter
    def on(self, wanted: bool) -> None:
        self._inputs.mapped.use_pads(wanted)

    @property
    def standing(self) -> str:
        """Which are plugged in, and what they do."""
        pads = self._inputs.gamepads
        names = ", ".join(dict.fromkeys(state.name for state in pads.states))
        if not names:
            return tr("none plugged in") if self.on else tr("off")
        return f"{names}: {tr(STANDING[pads.standing]) if self.on else tr('off, but for STOP')}"

    @property
    def idle(self) -> bool:
        """None is plugged in."""
        return not self._inputs.gamepads.states

    @property
    def problem(self) -> str:
        """Nothing that it could not tell by how it stands."""
        return ""

    def start(self) -> None:
        """They are looked at with each heartbeat anyway, for STOP."""

    def stop(self) -> None:
        """Let go of what they push."""
        self._inputs.rest()

    def close(self) -> None:
        """The inputs own what there is."""


class KeyboardMethod:
    """The keys of a keyboard."""

    name = "keyboard"

    def __init__(self, app: HandsApp) -> None:
        """`app` is asked for its `inputs`."""
        self._inputs = app.inputs

    @property
    def on(self) -> bool:
        """Shortcuts, and keys that drive."""
        return bool(self._inputs.mapped.keys.on)

    @on.setter
    def on(self, wanted: bool) -> None:
        self._inputs.mapped.set_keys(replace(self._inputs.mapped.keys, on=wanted))

    @property
    def standing(self) -> str:
        """What the keys do."""
        table = self._inputs.mapped.keys
        if not table.on:
            return tr("off, but for STOP")
        return tr("shortcuts and driving") if table.drives else "shortcuts"

    @property
    def problem(self) -> str:
        """Nothing that it could not tell by how it stands."""
        return ""

    def start(self) -> None:
        """The window tells of keys anyway, for STOP."""

    def stop(self) -> None:
        """Let go of what they push."""
        self._inputs.rest()

    def close(self) -> None:
        """The inputs own what there is."""
