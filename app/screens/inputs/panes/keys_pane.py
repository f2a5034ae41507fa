"""The pane of the keyboard: what drives, what Space does, and which key does what."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from kivy.uix.boxlayout import BoxLayout

from app.inputs.base.button_presses import Press
from app.inputs.binding_actions import HOLDS, MEANINGS, meaning_words
from app.inputs.keys.key_table import RISES, SLOWS, KeyTable, key_words
from app.screens.inputs.parts.pane_app import PaneApp
from app.screens.inputs.parts.setting_row import number_row, switch_row
from app.screens.parts.pane_head import PaneHead
from widgets.core.language import tr
from widgets.inputs.key_help import KeyCap
from widgets.parts.kit import Column, ListRow, QuietButton, Roll
from widgets.parts.rows import group_label

__all__ = ["KeysPane"]

NOT_KEYS = ("stop",)
"""Meanings that no key is chosen for here."""


class KeysPane(BoxLayout):
    """A pane of the inputs screen."""

    def __init__(self, app: PaneApp, **kwargs: Any) -> None:
        super().__init__(orientation="vertical", spacing="8dp", **kwargs)
        self._inputs = app.inputs
        self._asked = ""
        """What a key is being chosen for; empty for nothing."""
        self.head = PaneHead(closable=True)
        self.head.bind(on_close=lambda _: self.back())
        self.none = QuietButton(text=tr("No key"), icon="block", size_hint_y=None)
        self.none.bind(on_release=lambda _: self._take(""))
        self.rows: dict[str, ListRow] = {}
        self._caps: dict[str, BoxLayout] = {}
        self.roll, self._column = Roll(), Column(spacing="6dp")
        self.roll.add_widget(self._column)
        self._build()
        self.add_widget(self.roll)
        self._write()

    def _build(self) -> None:
        column = self._column
        column.add_widget(group_label(tr("Driving")))
        self._drive_row, self.drives = switch_row(
            "keyboard", tr("Keys drive while held"),
            tr("W A S D push the left control, the arrows the right one; where there is one control, both push it."),
            lambda on: self._keep(replace(self._table, drives=on)),
        )  # fmt: skip
        self._rise_row, self.rise = number_row(
            "timeline", tr("From rest to full"), tr("A key let go rests at once."),
            lambda value: self._keep(replace(self._table, rise=value)),
            minimum=RISES[0], maximum=RISES[1], step=0.1, unit="s",
        )  # fmt: skip
        self._slow_row, self.slow = number_row(
            "speed", tr("With Shift"), tr("How far the control is pushed while Shift is held as well."),
            lambda value: self._keep(replace(self._table, slow=value / 100)),
            minimum=round(SLOWS[0] * 100), maximum=round(SLOWS[1] * 100), step=5, unit="%",
        )  # fmt: skip
        column.add_widget(self._drive_row)
        column.add_widget(self._rise_row)
        column.add_widget(self._slow_row)
        column.add_widget(group_label("STOP"))
        self._space_row, self.space = switch_row(
            "front_hand", tr("Space is STOP"), tr("Escape is STOP always. Without this Space can be a switch."),
            lambda on: self._keep(replace(self._table, space_stops=on)),
        )  # fmt: skip
        column.add_widget(self._space_row)
        column.add_widget(group_label(tr("Shortcuts")))
        for name, (words, icon) in MEANINGS.items():
            if name not in NOT_KEYS:
                column.add_widget(self._row(name, words, icon))
        self.reset = QuietButton(text=tr("As it was at first"), icon="replay", size_hint_y=None)
        self.reset.bind(on_release=lambda _: self._keep(KeyTable()))
        column.add_widget(self.reset)

    def _row(self, name: str, words: str, icon: str) -> ListRow:
        row = self.rows[name] = ListRow(icon=icon, title=tr(words))
        caps = self._caps[name] = BoxLayout(size_hint=(None, 1), spacing="4dp")
        caps.bind(minimum_width=caps.setter("width"))
        row.add_widget(caps)
        row.bind(on_release=lambda _: self._ask(name))
        return row

    # what the screen calls

    def enter(self) -> None:
        """Come onto the glass."""
        self._write()

    def leave(self) -> None:
        """Leave the glass."""
        self.back()

    def tick(self) -> None:
        """Nothing here changes with time."""

    def back(self) -> bool:
        """From the choice of a key back to the list; False where it is there."""
        self._listen(False)
        if self.roll.parent is self:
            return False
        self._asked = ""
        self.clear_widgets()
        self.add_widget(self.roll)
        return True

    # the next key

    def pressed(self, press: Press) -> bool:
        """The key that is chosen."""
        if press.source != "key":
            return False
        self._take(press.name)
        return True

    def released(self, press: Press) -> None:
        """Nothing ends with it."""

    def _listen(self, on: bool) -> None:
        takers = self._inputs.presses.takers
        if on and self not in takers:
            takers.insert(0, self)
        elif not on and self in takers:
            takers.remove(self)

    def _ask(self, name: str) -> None:
        self._asked = name
        words = meaning_words(name)
        held = tr(" It is on for as long as the key is held.") if name.partition(".")[2] in HOLDS else ""
        self.head.title, self.head.refused = words, False
        self.head.sentence = tr("Press the key for it.{held} Escape stays STOP.").format(held=held)
        self.clear_widgets()
        self.add_widget(self.head)
        self.add_widget(self.none)
        self.add_widget(BoxLayout())
        self._listen(True)

    def _take(self, key: str) -> None:
        before = self._table.meaning(key) if key else ""
        try:
            table = self._table.with_key(key, self._asked)
        except ValueError as refusal:
            self.head.sentence, self.head.refused = str(refusal), True
            return
        self._keep(table)
        if before and before != self._asked:
            self.rows[before].detail = tr("{key} was taken from it.").format(key=key_words(key))
        self.back()

    # what is kept

    @property
    def _table(self) -> KeyTable:
        table: KeyTable = self._inputs.mapped.keys
        return table

    def _keep(self, table: KeyTable) -> None:
        self._inputs.mapped.set_keys(table)
        self._inputs.rest()
        self._write()

    def _write(self) -> None:
        table = self._table
        self.drives.active, self.space.active = table.drives, table.space_stops
        self.rise.value, self.slow.value = table.rise, round(table.slow * 100)
        self._rise_row.disabled = self._slow_row.disabled = not table.drives
        for name, row in self.rows.items():
            keys = table.keys_of(name)
            row.detail, row.role = "", "accent" if keys and table.on else "muted"
            self._caps[name].clear_widgets()
            for key in keys:
                self._caps[name].add_widget(KeyCap(text=key_words(key)))
        self.reset.disabled = table == replace(KeyTable(), on=table.on)
