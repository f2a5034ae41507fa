"""Kit that screens are built of, in one place: `from widgets.parts.kit import Card, Chip, PrimaryButton`."""

from __future__ import annotations

from widgets.parts.buttons import IconButton, NavButton, PrimaryButton, PushButton, QuietButton
from widgets.parts.cards import ActionToast, Banner, Card, Sheet, Toast
from widgets.parts.choices import Segmented, Toggle
from widgets.parts.column import Column, Grid
from widgets.parts.labels import Chip, Icon, Remark, SectionLabel, Text, ValueUnit, spaced
from widgets.parts.rows import DragHandle, ListRow, Roll, TwoLines
from widgets.parts.sliders import Fader, Progress
from widgets.parts.stepper import Stepper
from widgets.parts.text_field import TextField

__all__ = [
    "ActionToast",
    "Banner",
    "Card",
    "Chip",
    "Column",
    "DragHandle",
    "Fader",
    "Grid",
    "Icon",
    "IconButton",
    "ListRow",
    "NavButton",
    "PrimaryButton",
    "Progress",
    "PushButton",
    "QuietButton",
    "Remark",
    "Roll",
    "SectionLabel",
    "Segmented",
    "Sheet",
    "Stepper",
    "Toggle",
    "Text",
    "TextField",
    "Toast",
    "TwoLines",
    "ValueUnit",
    "spaced",
]
