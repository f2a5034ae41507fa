"""Names of the ways in which an input can be lost; `bench.support.losses` performs them. Needs no Kivy."""

from __future__ import annotations

__all__ = ["FINGER", "PAD"]

FINGER = {
    "lifted": "lifted",
    "end_never_told": "its end never told, as of a touch that the system cancels",
    "out_of_focus": "the window out of focus",
    "hidden": "the window hidden",
    "turned": "the device turned",
    "dialog": "a dialog over the stick",
    "other_screen": "another screen",
    "frozen": "the glass frozen for 1.2 s",
    "paused": "the app paused",
    "given_up": "control given up",
    "stop_key": "STOP by Escape",
}
PAD = {
    "centred": "let go",
    "silent": "silent, as one whose radio is lost",
    "out_of_focus": "the window out of focus",
    "dialog": "a dialog over the stick",
    "frozen": "the glass frozen for 1.2 s",
    "stop_button": "STOP by its button",
    "unplugged": "unplugged",
}
