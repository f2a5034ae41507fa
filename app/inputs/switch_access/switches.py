"""Switches as a way in: which keys and buttons they are, what a press of them comes to, and what is said of it.

Asleep they cost one look at each key that is pressed. The first press of one of them makes the engine and marks where the
scan begins; a finger on the glass takes the mark away again, and so does typing. For as long as somebody types into a field a
switch on a keyboard types as well; but B held, or A and B together, is STOP all the same.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from kivy.core.window import Window

from app.core.notifications import notify
from app.inputs.base.button_presses import Press
from app.inputs.base.text_focus import is_typing
from app.inputs.switch_access.learned_usage import LearnedUsage
from app.inputs.switch_access.scan.engine import Engine, Selection
from app.inputs.switch_access.scan.plan import Planner
from app.inputs.switch_access.scan.settings import Key, read
from app.inputs.switch_access.scan.target import Mark
from app.inputs.switch_access.step_feedback import StepFeedback
from app.inputs.switch_access.typing_guard import TypingGuard, types_letters
from app.inputs.switch_access.window.window_app import WindowApp
from app.intents.intents import Heard
from widgets.core.language import tr

__all__ = ["SwitchAccess"]

OTHERS = frozenset({"ctrl", "alt", "meta"})
"""With one of these held a key is a shortcut and no switch."""


class SwitchAccess:
    """A method as `app.inputs.methods` wants them. Everything in the UI thread."""

    name = "switches"

    def __init__(self, app: WindowApp) -> None:
        """`app` is asked for its `settings`, `inputs`, `intents`, `methods`, `shell`, `connect` and `now`."""
        self._app = app
        self.options, self._fault = read(app.settings.get(self.name))
        self._usage = LearnedUsage(app)
        self._feedback = StepFeedback(app)
        self._engine: Engine | None = None
        self._glass: Any = None
        self._stuck: list[str] = []
        self._doing = False
        """What is marked is being done: touches made for that are no fingers."""
        self._typing = TypingGuard()
        self._asked: Callable[[Key], object] | None = None
        """Takes the next key or button, instead of the scan."""
        self.on_selected: list[Callable[[Selection], object]] = []
        """Called with each thing that was chosen, before it is done."""

    # as a method

    @property
    def set_to(self) -> dict[str, Any]:
        """Everything that it goes by, as JSON."""
        return self.options.save()

    @property
    def on(self) -> bool:
        """The operator wants it."""
        return self.options.on

    @on.setter
    def on(self, on: bool) -> None:
        self.change(on=on)

    @property
    def standing(self) -> str:
        """How it stands, in a few words."""
        return self.options.standing

    @property
    def hint(self) -> str:
        """What the switches do, as in `Tab next · Enter do it`; empty while they are off or have no keys."""
        return self.options.hint

    @property
    def problem(self) -> str:
        """Why it does not work though it is on; empty when it is well."""
        if not self.on:
            return ""
        if self._stuck:
            return tr("Switch {stuck} is stuck down and is ignored until it comes up.").format(
                stuck=" and ".join(self._stuck)
            )
        return self.options.missing

    def start(self) -> None:
        """Listen to the keys and buttons that are switches."""
        if self._fault:
            self._say(self._fault)
            self._fault = ""
        inputs = self._app.inputs
        if self not in inputs.presses.takers:
            inputs.presses.takers.insert(0, self)
            inputs.is_switch = self.is_switch
            Window.bind(focus=self._focused, on_touch_down=self._touched, on_textinput=self._wrote)

    def stop(self) -> None:
        """Nothing is marked and nothing listened to."""
        inputs = self._app.inputs
        if self in inputs.presses.takers:
            inputs.presses.takers.remove(self)
            inputs.is_switch = lambda _: False
            Window.unbind(focus=self._focused, on_touch_down=self._touched, on_textinput=self._wrote)
        self._asked = None
        self._typing.clear()
        if self._engine is not None:
            self._engine.lost()
            self._engine.sleep()
        self._stuck = []
        self._usage.save()

    def close(self) -> None:
        """End whatever it owns."""
        self.stop()
        self._feedback.close()
        if self._glass is not None:
            self._glass.close()
        self._engine = self._glass = None

    def update(self, now: float) -> None:
        """With each heartbeat."""
        engine = self._engine
        if engine is None:
            return
        self._lift(now)
        awake = engine.awake
        engine.update(now)
        if awake and not engine.awake and is_typing():
            engine.wake(now)  # a field with the focus waits for an answer: there the mark goes round on

    # how it is set up

    def change(self, **values: Any) -> None:
        """Choose something else, as in `interval=1.2`, and remember it. ValueError for what is out of range."""
        fresh, fault = read(replace(self.options, **values).save())
        if fault:
            raise ValueError(fault)
        self.options = fresh
        self._app.settings.set(self.name, fresh.save())
        if self._engine is not None:
            self._engine.setup(fresh.timing, fresh.pace)

    def ask(self, take: Callable[[Key], object] | None) -> None:
        """Give the next key or button that is pressed to `take`, whatever it is now; None asks no longer."""
        self._asked = take

    @property
    def engine(self) -> Engine:
        """What turns presses into selections, made when it is first asked for."""
        if self._engine is None:
            from app.inputs.switch_access.window.targets import WindowTargets

            self._glass = WindowTargets(self._app)
            planner = Planner(self._usage.frozen)
            desk = _Desk(self)
            self._engine = Engine(self._glass, planner, desk, self.options.timing, self.options.pace)
        return self._engine

    @property
    def awake(self) -> bool:
        """Something is marked."""
        return self._engine is not None and self._engine.awake

    # what is pressed

    def is_switch(self, press: Press) -> bool:
        """That key or button is one of the switches."""
        return self.on and self.options.switch_of(press.source, press.name, press.device) is not None

    def pressed(self, press: Press) -> bool:
        """Take it, where it is a switch and nobody types with the keyboard that it is on."""
        if self._asked is not None:
            self._give(press)
            return True
        which = self.options.switch_of(press.source, press.name, press.device)
        if which is None:
            if types_letters(press) and is_typing():
                self._types()
            return False
        if press.modifiers & OTHERS:
            return False
        self._lift(press.at)
        types = not self.awake and is_typing() and self._typing.takes(press)
        self.engine.press(which, press.same, press.at, only_stop=types)
        return not types

    def released(self, press: Press) -> None:
        """It is up."""
        if self._engine is not None:
            self._engine.release(press.same, self._app.now())

    def _give(self, press: Press) -> None:
        """To whoever asked for a key; one that is a switch is STOP all the same when it is held."""
        which, take, self._asked = (
            self.options.switch_of(press.source, press.name, press.device),
            self._asked,
            None,
        )
        if which is not None:
            self.engine.press(which, press.same, press.at, only_stop=True)
        if take is not None:
            take(Key(press.source, press.name, press.device if press.source == "pad" else ""))

    def _lift(self, now: float) -> None:
        """Switches that typed and are up: who takes no press is not told of its end."""
        for same in self._typing.lifted(self._app.inputs.presses.down):
            self.engine.release(same, now)

    def _types(self) -> None:
        """Somebody types, or has a finger on the glass: nothing is marked."""
        self._typing.note(self._app.now())
        if self._engine is not None and self._engine.awake:
            self._engine.sleep()

    def _wrote(self, _: object, text: str) -> None:
        """Letters came, which a keyboard on the glass tells without keys; those of a switch are no typing."""
        down = self._app.inputs.presses.down
        if (
            text.strip()
            and not any(self.options.switch_of(press.source, press.name, press.device) for press in down)
            and is_typing()
        ):
            self._types()

    def _focused(self, _: object, focus: bool) -> None:
        if self._engine is not None:
            self._engine.found(self._app.now()) if focus else self._engine.lost()

    def _touched(self, *_: object) -> None:
        if not self._doing:
            self._types()

    # what the engine tells

    def halt(self, began: float) -> None:
        """STOP by switches; what they have begun goes on no longer."""
        if self._glass is not None:
            self._glass.openings.halt()
        verdict = self._app.intents.submit(Heard("stop", self.name, began=began, said="held"))
        if verdict.what != "acted":
            self._say(verdict.sentence)

    def do(self, chosen: Selection) -> None:
        """Do it, by the entry for what is chosen on the glass: `app.intents.intents` says what is barred."""
        target, now = chosen.target, self._app.now()
        for listener in list(self.on_selected):
            listener(chosen)
        self._usage.count(chosen)
        ended = chosen.ended if math.isfinite(chosen.ended) else now
        heard = Heard(target.intent, self.name, began=chosen.began, ended=ended, said=target.words)
        self._doing = True
        try:
            verdict = self._app.intents.choose(heard, target.act)
        finally:
            self._doing = False
        if verdict.what not in ("acted", "practised"):
            self._say(verdict.sentence)

    def stepped(self, sound: str, mark: Mark | None) -> None:
        """Let it be heard, felt and spoken."""
        self._feedback.step(sound, mark, self.options)

    def stuck(self, switch: str, stuck: bool) -> None:
        """Say it, once each."""
        if stuck and switch not in self._stuck:
            self._stuck.append(switch)
            self._say(
                tr("Switch {switch} is stuck down: it is ignored until it comes up.").format(switch=switch)
            )
        elif not stuck and switch in self._stuck:
            self._stuck.remove(switch)
            self._say(tr("Switch {switch} works again.").format(switch=switch), "info")

    def _say(self, text: str, level: str = "warn") -> None:
        notify(self._app, text, level, self.name)


class _Desk:
    """Switches as the engine knows them: there STOP is STOP."""

    def __init__(self, switches: SwitchAccess) -> None:
        self.stop = switches.halt
        self.do, self.stepped, self.stuck = switches.do, switches.stepped, switches.stuck
