"""A snapshot of how every method is set up, defaults included: a study is read long after its defaults have changed."""

from __future__ import annotations

from typing import Any

from app.inputs.base.method_app import MethodApp
from app.inputs.gamepad.pad_map import Profile
from app.intents.intents import INTENTS, METHODS

__all__ = ["set_up"]

METHODS_SET = ("shake", "voice", "tilt", "switches")
"""Methods that say themselves what they are set to, as `set_to`."""


def set_up(app: MethodApp) -> dict[str, Any]:
    """JSON-able values by the names of the settings; nothing of a method that could not be made, or is not there."""
    made = {name: app.methods.get(name) for name in METHODS_SET}
    found: dict[str, Any] = {name: method.set_to for name, method in made.items() if method is not None}
    table = app.intents.table
    found["intents"] = {
        method: {intent: table.allowed(method, intent) for intent in INTENTS} for method in METHODS
    }
    inputs = getattr(app, "inputs", None)
    if inputs is not None:
        mapped = inputs.mapped
        found["keys"] = mapped.keys.kept()
        found["gamepads"] = {
            "on": mapped.pads_on,
            "usual": Profile().kept(),
            "profiles": mapped.profiles_kept,
        }
    return found
