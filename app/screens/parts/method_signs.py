"""Icon and name of each input method, wherever one is shown or spoken of."""

from __future__ import annotations

from widgets.core.language import mark

__all__ = ["METHOD_SIGNS"]

METHOD_SIGNS = {
    "voice": ("mic", mark("Voice")),
    "shake": ("mobile_vibrate", mark("Shake")),
    "tilt": ("screen_rotation_alt", mark("Tilt")),
    "switches": ("radio_button_checked", mark("Switches")),
    "gamepad": ("gamepad", mark("Gamepad")),
    "keyboard": ("keyboard", mark("Keyboard")),
}
"""By the method's name in the settings, in the order in which they are listed."""
