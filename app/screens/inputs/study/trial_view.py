"""The study while it is led: what comes next, the prompt, the pause, and buttons for the methods that press."""

from __future__ import annotations

from typing import Any

from kivy.properties import BooleanProperty
from kivy.uix.boxlayout import BoxLayout

from app.core.command_origin import origins
from app.intents.intents import INTENTS, Heard
from app.screens.inputs.parts.pane_app import PaneApp
from app.screens.inputs.study.log_view import look_of
from app.study.study import Trials
from widgets.parts.kit import Column, Grid, PrimaryButton, QuietButton, Remark, SectionLabel
from widgets.study.prompt_card import PromptCard

__all__ = ["TrialView"]

HOW = {
    "button": "Buttons: press it among these",
    "voice": "Voice: say it",
    "shake": "Shake the device",
    "switches": "Switches: choose it among these",
    "gamepad": "Gamepad: press its button",
    "keyboard": "Keyboard: press its key",
}
PRACTICE = "Practice, moves nothing"
PRESSING = ("button", "switches")
"""Methods that need something to press on the glass."""


class TrialView(Column):
    """Dispatches `on_leave` when the study shall be left."""

    __events__ = ("on_leave",)

    low = BooleanProperty(False)
    """There is too little height for prompt and buttons one below the other."""

    def __init__(self, app: PaneApp, trials: Trials, **kwargs: Any) -> None:
        super().__init__(spacing="10dp", **kwargs)
        self._app, self._trials, self._laid = app, trials, ""
        self.card, self.remark = PromptCard(), Remark(role="text", font_size="16sp")
        self.go = PrimaryButton(text="Begin", icon="play_arrow")
        self.go.bind(on_release=lambda _: self._go())
        self.wait = QuietButton(text="Take a break", icon="hourglass_empty")
        self.wait.bind(on_release=lambda _: self._pause())
        self.end = QuietButton(text="Leave the study", icon="close")
        self.end.bind(on_release=lambda _: self.dispatch("on_leave"))
        self.buttons = Grid(cols=2, spacing="10dp")
        self.pad = Column(spacing="4dp")
        """The buttons under a name that tells their STOP from the one that stops the robot."""
        self.pad.add_widget(SectionLabel(title=PRACTICE))
        self.pad.add_widget(self.buttons)
        self.tick()

    def tick(self) -> None:
        """Bring prompt and buttons up to date."""
        trials, block = self._trials, self._trials.now_block
        laid = f"{trials.stage in ('gap', 'prompt')} {trials.stage == 'done'} {trials.block} {self.low}"
        if laid != self._laid:
            self._laid = laid
            self._lay()
        prompt, card = trials.prompt, self.card
        card.asking = prompt is not None
        if prompt is not None:
            intent = INTENTS[prompt.intent]
            card.icon, card.words = intent.icon, intent.words
        card.how = HOW.get(block.method, block.method) if prompt else "Wait for the next one."
        card.last = trials.last
        card.counted = f"{min(trials.trial + 1, len(block.prompts))} of {len(block.prompts)}"
        card.share = trials.trial / max(len(block.prompts), 1)
        self.remark.text = self._sentence()
        self.go.text = "Go on" if trials.stage == "paused" else "Begin"

    def _sentence(self) -> str:
        trials, block = self._trials, self._trials.now_block
        if trials.stage == "done":
            return "That is all of it. Thank you! The log holds every answer, and the zip is under Log."
        part = f"Part {trials.block + 1} of {len(trials.blocks)}: {look_of(block.method)[1]}, {block.posture}"
        made = self._app.methods.get(block.method)
        off = made is not None and not made.on
        hint = " It is off: switch it on in the list of inputs first." if off else ""
        left = len(block.prompts) - trials.trial
        return f"{part}. {left} prompts are left.{hint}"

    def _lay(self) -> None:
        running = self._trials.running
        self.clear_widgets()
        self.buttons.clear_widgets()
        if self._trials.stage == "done":
            self.end.text, self.end.icon = "Done", "check"
            shown: list[Any] = [self.remark, self.end]
        elif running:
            shown = self._asking()
        else:
            shown = [self.remark, self.go, self.end]
        for widget in shown:
            self.add_widget(widget)

    def _asking(self) -> list[Any]:
        """The prompt, what is pressed, and the break; side by side where it is low."""
        for widget in (self.card, self.wait, self.pad):
            if widget.parent is not None:
                widget.parent.remove_widget(widget)
        if self._trials.now_block.method not in PRESSING:
            return [self.card, self.wait]
        self._fill_buttons()
        if not self.low:
            return [self.card, self.pad, self.wait]
        left, both = Column(spacing="10dp"), BoxLayout(spacing="10dp", size_hint_y=None)
        left.add_widget(self.card)
        left.add_widget(self.wait)
        both.bind(minimum_height=both.setter("height"))
        for part in (left, self.pad):
            part.pos_hint = {"top": 1}
            both.add_widget(part)
        return [both]

    def _fill_buttons(self) -> None:
        """In the order of the intents, not in that of the prompts."""
        prompts, high = set(self._trials.now_block.prompts), "64dp" if self.low else "72dp"
        for name in (name for name in INTENTS if name in prompts):
            button = QuietButton(text=INTENTS[name].words, icon=INTENTS[name].icon, height=high)
            button.bind(on_release=lambda _, name=name: self._press(name))
            self.buttons.add_widget(button)

    def _press(self, name: str) -> None:
        """As if a button of the app did that: the study takes it as an answer."""
        origin, now = origins.current(), self._app.now()
        ended = origin.ended if origin.ended >= origin.began else now
        self._app.intents.submit(Heard(name, origin.method or "button", 1.0, origin.began, ended))
        self.tick()

    def _go(self) -> None:
        self._trials.begin()
        self.tick()

    def _pause(self) -> None:
        self._trials.pause()
        self.tick()

    def on_leave(self) -> None:
        """A finger asked to leave the study."""
