"""The kit that screens are built of, in one place: `from widgets.kit import Card, Chip, PrimaryButton`."""

from __future__ import annotations

from widgets.amounts import Fader, Progress
from widgets.buttons import IconButton, NavButton, PrimaryButton, PushButton, QuietButton
from widgets.cards import ActionToast, Banner, Card, Sheet, Toast
from widgets.choices import Segmented, Toggle
from widgets.labels import Chip, Icon, SectionLabel, Text, ValueUnit, spaced
from widgets.rows import DragHandle, ListRow, Roll
from widgets.stepper import Stepper
from widgets.text_field import TextField

__all__ = [
    "ActionToast",
    "Banner",
    "Card",
    "Chip",
    "DragHandle",
    "Fader",
    "Icon",
    "IconButton",
    "ListRow",
    "NavButton",
    "PrimaryButton",
    "Progress",
    "PushButton",
    "QuietButton",
    "Roll",
    "SectionLabel",
    "Segmented",
    "Sheet",
    "Stepper",
    "Toggle",
    "Text",
    "TextField",
    "Toast",
    "ValueUnit",
    "spaced",
]
