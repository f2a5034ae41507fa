"""The pane of permits: one method at a time, with a switch for everything that it can ask for."""

from __future__ import annotations

from typing import Any

from kivy.properties import ObjectProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout

from app.intents.intents import INTENTS, METHODS, PRESSED, Intent
from app.intents.method_permits import ALWAYS, SAYS
from app.screens.parts.method_signs import METHOD_SIGNS
from widgets.core.language import tr
from widgets.parts.kit import Column, ListRow, QuietButton, Remark, Roll, Segmented, Toggle

__all__ = ["TablePane", "how"]

TELLS = tuple(method for method in METHODS if SAYS.get(method))
"""Methods that can say anything that may be forbidden."""


def how(intent: Intent, method: str) -> str:
    """How soon it acts when that method says it."""
    if intent.risk == "confirm" and method != "switches":
        return tr("asks first")
    if intent.risk == "cancel" and method not in PRESSED:
        return tr("after 2 s, unless cancelled")
    return tr("at once")


class TablePane(BoxLayout):
    """Every method is told what it may trigger; STOP is never taken from one that can say it."""

    app = ObjectProperty()
    method = StringProperty(TELLS[0])
    """Whose switches are shown."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(orientation="vertical", spacing="8dp", **kwargs)
        self.choice = Segmented(
            options=[(method, tr(METHOD_SIGNS[method][1])) for method in TELLS], value=self.method
        )
        self.choice.bind(on_choose=lambda _, method: setattr(self, "method", method))
        self.remark = Remark(text="")
        self.rows: dict[str, Permission] = {}
        self._column = Column(spacing="6dp")
        roll = Roll()
        roll.add_widget(self._column)
        self.usual = QuietButton(icon="undo")
        self.usual.bind(on_release=lambda _: self._reset())
        for widget in (self.choice, roll):
            self.add_widget(widget)
        self.bind(method=self._fill)
        self._fill()

    def enter(self) -> None:
        """Come onto the glass."""
        self.tick()

    def leave(self) -> None:
        """Leave the glass."""

    def tick(self) -> None:
        """Bring up to date what is allowed."""
        table = self.app.intents.table
        for intent, row in self.rows.items():
            row.switch.active = table.allowed(self.method, intent)
            row.faded = not row.switch.active
        self.usual.disabled = table.usual(self.method)
        self.usual.text = tr("{method}: reset to default").format(method=tr(METHOD_SIGNS[self.method][1]))
        self.remark.text = table.problem or tr("A forbidden command is refused with a sentence.")

    def _fill(self, *_: object) -> None:
        self._column.clear_widgets()
        self.rows = {}
        for name in INTENTS:
            if name not in SAYS[self.method]:
                continue
            intent = INTENTS[name]
            row = self.rows[name] = Permission(
                icon=intent.icon, title=intent.words, detail=how(intent, self.method), fixed=name in ALWAYS
            )
            row.switch.bind(on_change=lambda _, on, name=name: self._allow(name, on))
            self._column.add_widget(row)
        for widget in (self.remark, self.usual):
            self._column.add_widget(widget)
        self.tick()

    def _allow(self, intent: str, allowed: bool) -> None:
        self.app.intents.table.allow(self.method, intent, allowed)
        self.tick()

    def _reset(self) -> None:
        self.app.intents.table.reset(self.method)
        self.tick()


class Permission(ListRow):
    """One thing that a method may do or not; a finger anywhere on it turns the switch."""

    def __init__(self, *, fixed: bool, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.switch = Toggle(pos_hint={"center_y": 0.5}, disabled=fixed)
        self.role = "danger" if fixed else "accent"
        self.aside = tr("always") if fixed else ""
        if not fixed:
            self.bind(on_release=lambda _: self.switch.dispatch("on_release"))
        self.add_widget(self.switch)
