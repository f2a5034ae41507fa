"""The pane of a gamepad: a live picture, what its sticks push, what its buttons do. Kept by its name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from kivy.uix.boxlayout import BoxLayout

from app.inputs.base.button_presses import Press
from app.inputs.binding_actions import meaning_icon, meaning_words
from app.inputs.gamepad.pad_map import AXES, BUTTONS, DEAD_ZONES, EXPOS, WAYS, Profile, button_words
from app.inputs.gamepad.sdl import PadState
from app.screens.inputs.parts.meaning_list import MeaningList
from app.screens.inputs.parts.pane_app import PaneApp
from app.screens.inputs.parts.setting_row import number_row
from widgets import PadPicture
from widgets.core.language import mark, tr
from widgets.parts.kit import Column, IconButton, ListRow, QuietButton, Roll, Segmented
from widgets.parts.labels import Remark
from widgets.parts.rows import group_label

__all__ = ["PadPane"]

LIVE_TIMEOUT = 1.0
"""A pushed gamepad that has measured nothing new for longer is said to be silent [s]."""
HINT = mark("Press a button to find it in the list. Here it does nothing else, but STOP stays STOP.")
REST = {"left": (0.0, 0.0), "right": (0.0, 0.0)}
ANY = "Gamepad"
"""What is set up while none is plugged in."""


class PadPane(BoxLayout):
    """A pane of the inputs screen."""

    def __init__(self, app: PaneApp, **kwargs: Any) -> None:
        super().__init__(orientation="vertical", spacing="8dp", **kwargs)
        self._inputs = app.inputs
        self._name = ""
        """Of the gamepad that is set up; empty before the first was seen."""
        self._asked: tuple[str, str] = ("", "")
        """`button` or `way`, and which one is being changed."""
        self.picture = PadPicture(size_hint_y=None, height="190dp")
        self.standing = Remark(font_size="15sp")
        self.names = Segmented()
        self.names.bind(on_choose=lambda _, name: self._take(name))
        self.meanings, self.sources = (
            MeaningList(),
            MeaningList({name: (tr(words), "tune") for name, words in AXES.items()}),
        )
        for choosing in (self.meanings, self.sources):
            choosing.bind(on_choose=lambda _, name: self._chosen(name), on_close=lambda _: self.back())
        self.buttons: dict[str, ListRow] = {}
        self.ways: dict[str, ListRow] = {}
        self.roll = Roll()
        self._column = Column(spacing="6dp")
        self._build()
        self.roll.add_widget(self._column)
        self.add_widget(self.roll)
        self._take("")

    def _build(self) -> None:
        column = self._column
        column.add_widget(self.picture)
        column.add_widget(self.standing)
        column.add_widget(group_label(tr("Sticks")))
        self._dead, self.dead = number_row(
            "tune", tr("Dead zone"), tr("Round the middle, where a stick commands nothing."),
            lambda value: self._keep(replace(self._profile, dead_zone=value / 100)),
            minimum=round(DEAD_ZONES[0] * 100), maximum=round(DEAD_ZONES[1] * 100), step=2, unit="%",
        )  # fmt: skip
        self._curve, self.expo = number_row(
            "timeline", tr("Finer in the middle"), tr("How much less a small push commands; the end is the same."),
            lambda value: self._keep(replace(self._profile, expo=value / 100)),
            minimum=round(EXPOS[0] * 100), maximum=round(EXPOS[1] * 100), step=10, unit="%",
        )  # fmt: skip
        column.add_widget(self._dead)
        column.add_widget(self._curve)
        self.turns: dict[str, IconButton] = {}
        for way, words in WAYS.items():
            row = self.ways[way] = ListRow(icon="joystick", title=tr(words), whole=True, end="2dp")
            turn = self.turns[way] = IconButton(icon="swap_vert", bare=True, pos_hint={"center_y": 0.5})
            turn.bind(on_release=lambda _, way=way: self._turn(way))
            row.bind(on_release=lambda _, way=way: self._ask("way", way))
            row.add_widget(turn)
            column.add_widget(row)
        column.add_widget(group_label(tr("Buttons")))
        column.add_widget(Remark(text=tr(HINT), font_size="15sp"))
        self._rows = Column(spacing="6dp")
        column.add_widget(self._rows)
        for button in BUTTONS:
            self._row(button)
        self.reset = QuietButton(text=tr("As it was at first"), icon="replay", size_hint_y=None)
        self.reset.bind(on_release=lambda _: self._reset())
        column.add_widget(self.reset)

    def _row(self, button: str) -> ListRow:
        row = self.buttons[button] = ListRow(title=button_words(button))
        row.bind(on_release=lambda _: self._ask("button", button))
        self._rows.add_widget(row)
        return row

    # what the screen calls

    def enter(self) -> None:
        """Come onto the glass: what is pressed is looked for here."""
        if self not in self._inputs.presses.takers:
            self._inputs.presses.takers.insert(0, self)
        self.tick()

    def leave(self) -> None:
        """Leave the glass."""
        if self in self._inputs.presses.takers:
            self._inputs.presses.takers.remove(self)
        self.back()

    def back(self) -> bool:
        """From a choice back to the lists; False where it is there."""
        if self.roll.parent is self:
            return False
        self._asked = ("", "")
        self.clear_widgets()
        self.add_widget(self.roll)
        return True

    def tick(self) -> None:
        """Show which there are, and what the one that is set up measures now."""
        pads = self._inputs.gamepads
        states = {state.name: state for state in pads.states}
        if list(states) != self.names.options:
            self.names.options = list(states)
            several = len(states) > 1
            if several != (self.names.parent is self._column):
                self._column.remove_widget(self.names)
                if several:
                    self._column.add_widget(self.names, index=len(self._column.children) - 1)
        if states and self._name not in states:
            self._take(next(iter(states)))
        state = states.get(self._name)
        self.standing.text = self._standing(state)
        if state is None:
            self.picture.clear()
        else:
            self._show(state)

    def _standing(self, state: PadState | None) -> str:
        if state is None:
            gone = (
                tr("{name} is not plugged in; its settings are kept.").format(name=self._name)
                if self._name
                else ""
            )
            return gone or tr("Plug one in, at any time. Each kind keeps its own set-up.")
        pads, wired = self._inputs.gamepads, state.name in self._inputs.gamepads.wired
        age = pads.age(state.number)
        still = self._profile.lean(state) == REST
        silent = (
            ""
            if age < LIVE_TIMEOUT or still
            else tr(" Nothing new for {age:.0f} s, on its cable.").format(age=age)
            if wired
            else tr(" Nothing new for {age:.0f} s.").format(age=age)
        )
        drives = "" if self._inputs.mapped.pads_on else tr(" Off: only its STOP counts.")
        return f"{state.name}.{drives}{silent}"

    def _show(self, state: PadState) -> None:
        profile = self._profile
        for button in state.buttons - set(self.buttons):
            self._row(button)
            self._write()
        self.picture.update(
            left=(state.forward, state.left),
            right=state.right,
            triggers=state.triggers,
            down=state.buttons,
            dead_zone=profile.dead_zone,
            stops=profile.stops,
        )
        for name, row in self.buttons.items():
            row.chosen = name in state.buttons

    # what is pressed on the gamepad

    def pressed(self, press: Press) -> bool:
        """A button is looked for in the list, or is the one that is meant while one is being changed."""
        if press.source != "pad":
            return False
        self._take(press.device)
        row = self.buttons.get(press.name) or self._row(press.name)
        self._write()
        if self.roll.parent is self:
            self.roll.scroll_to(row, animate=False)
        return True

    def released(self, press: Press) -> None:
        """Nothing ends with it."""

    # what fingers change

    @property
    def _profile(self) -> Profile:
        profile: Profile = self._inputs.mapped.profile(self._name or ANY)
        return profile

    def _keep(self, profile: Profile) -> None:
        self._inputs.mapped.set_profile(self._name or ANY, profile)
        self._inputs.rest()  # nothing that is pushed means something else all at once
        self._write()

    def _turn(self, way: str) -> None:
        self._keep(self._profile.turned(way))

    def _reset(self) -> None:
        self._inputs.mapped.reset_profile(self._name or ANY)
        self._inputs.rest()
        self._write()

    def _take(self, name: str) -> None:
        self._name = self.names.value = name
        self._write()

    def _write(self) -> None:
        """Say what everything means now."""
        profile = self._profile
        self.dead.value, self.expo.value = round(profile.dead_zone * 100), round(profile.expo * 100)
        for way, row in self.ways.items():
            turned = way in profile.inverted
            row.detail = tr(AXES[profile.axes.get(way, "none")]) + (tr(", turned round") if turned else "")
            self.turns[way].role = "accent" if turned else "muted"
        for button, row in self.buttons.items():
            meaning = profile.meaning(button)
            row.detail = tr("Pushes a control") if button in profile.driving else meaning_words(meaning)
            row.icon = "joystick" if button in profile.driving else meaning_icon(meaning)
            row.role = "danger" if meaning == "stop" else "accent" if meaning else "muted"
        self.reset.disabled = not self._inputs.mapped.changed(self._name or ANY)

    def _ask(self, what: str, which: str) -> None:
        self._asked = what, which
        profile = self._profile
        choosing = self.meanings if what == "button" else self.sources
        if what == "button":
            choosing.ask(button_words(which), tr("Choose a command"), profile.meaning(which))
        else:
            choosing.ask(tr(WAYS[which]), tr("What shall push it?"), profile.axes.get(which, "none"))
        self.clear_widgets()
        self.add_widget(choosing)

    def _chosen(self, name: str) -> None:
        what, which = self._asked
        profile = self._profile
        change: Callable[[str, str], Profile] = profile.with_button if what == "button" else profile.with_axis
        try:
            self._keep(change(which, name))
        except ValueError as refusal:
            (self.meanings if what == "button" else self.sources).refuse(str(refusal))
        else:
            self.back()
