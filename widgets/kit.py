"""The kit that screens are built of, in one place: `from widgets.kit import Card, Chip, PrimaryButton`."""

from __future__ import annotations

from widgets.amounts import Fader, Progress
from widgets.buttons import IconButton, NavButton, PrimaryButton, PushButton, QuietButton
from widgets.cards import ActionToast, Banner, Card, Sheet, Toast
from widgets.choices import Segmented, Toggle
from widgets.column import Column, Grid
from widgets.labels import Chip, Icon, Remark, SectionLabel, Text, ValueUnit, spaced
from widgets.rows import DragHandle, ListRow, Roll, TwoLines
from widgets.stepper import Stepper
from widgets.text_field import TextField

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
