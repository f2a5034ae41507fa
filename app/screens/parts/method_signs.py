"""Icon and name of each input method, wherever one is shown or spoken of."""

from __future__ import annotations

__all__ = ["METHOD_SIGNS"]

METHOD_SIGNS = {
    "voice": ("mic", "Voice"),
    "shake": ("mobile_vibrate", "Shake"),
    "tilt": ("screen_rotation_alt", "Tilt"),
    "switches": ("radio_button_checked", "Switches"),
    "gamepad": ("gamepad", "Gamepad"),
    "keyboard": ("keyboard", "Keyboard"),
}
"""By the method's name in the settings, in the order in which they are listed."""
