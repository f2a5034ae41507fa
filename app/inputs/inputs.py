"""Keys, gamepads and the window itself as inputs of the whole app.

Presses go to STOP, then to switches (who puts himself first into `presses.takers`), then to what drives, then to what
else they mean. What pushes a control is looked at in `app.inputs.stick_arbiter`.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import Any, Protocol

from kivy.core.window import Keyboard, Window

from app.core.command_origin import origins
from app.device import input_devices, rotation, sdl_library
from app.inputs.base.button_presses import Press, Presses
from app.inputs.base.method_app import MethodApp
from app.inputs.base.text_focus import is_typing
from app.inputs.binding_actions import BindingActions
from app.inputs.bindings import Bindings
from app.inputs.gamepad.gamepad import Gamepads, KivyPads, PadEvent
from app.inputs.gamepad.sdl import Sdl
from app.inputs.keys.key_drive import KeyDrive
from app.inputs.pad_news import PadNews
from app.inputs.shortcuts import Shortcuts
from app.inputs.stick_arbiter import StickArbiter
from app.intents.intents import Heard

__all__ = ["BACK", "Inputs"]

log = logging.getLogger(__name__)

RESTING = ("size", "on_hide", "on_minimize")
"""What happens to the window and brings every control to rest."""
BACK = 27
"""Key code of Android's Back, and of Escape."""
ESCAPE = 41
"""Scan code of Escape, which Back has not."""
SHIFTS = ("shift", "rshift")
KEYS = {code: name for name, code in Keyboard.keycodes.items()}
"""Names of Kivy's key codes."""


class InputsApp(MethodApp, Protocol):
    """The app whose window is listened to."""

    @property
    def corner(self) -> Any:
        """STOP ALL."""
        ...

    @property
    def leaving(self) -> Any:
        """The ways out."""
        ...

    def back(self) -> bool:
        """As Android's Back; False where the system decides."""
        ...


class Inputs:
    """Listens to the window from `open` to `close`; `update` belongs to the heartbeat. Everything in the UI thread."""

    def __init__(
        self,
        app: InputsApp,
        now: Callable[[], float] = time.monotonic,
        source: Sdl | KivyPads | None = None,
        devices: Callable[[], frozenset[int]] = input_devices,
        turned: Callable[[], int] = rotation,
    ) -> None:
        """`app` is asked for its `shell`, `session`, `corner`, `settings` and `intents`. `source` tells of gamepads, fingers and keys,

        SDL where there is one; `devices` numbers what the system has plugged in, `turned` says how the screen is turned [quarters].
        """
        self._app, self._now = app, now
        self._source = source or _source()
        self.mapped = Bindings(app.settings)
        self._news = PadNews(app, lambda: self.gamepads)
        self.gamepads = Gamepads(
            now,
            on_news=self._news.notify,
            wired=self.mapped.wired,
            profile=self.mapped.profile,
        )
        self.keys = KeyDrive(now, lambda: self.mapped.keys, is_down=self._source.key, on_lost=self._say)
        self.keys.wanted = lambda: bool(self.sticks) and not is_typing()
        self.meanings = BindingActions(
            app, now, is_down=self._source.key, silent=self.gamepads.silent, on_lost=self._lost
        )
        self.presses = Presses(self._is_stop, self._stop_by)
        """Every key and every button of a gamepad; whoever wants them before all others puts himself first in `takers`."""
        shortcuts = Shortcuts(
            self.meanings,
            lambda: self.mapped.keys,
            self.mapped.profile,
            is_typing,
            lambda: self.mapped.pads_on,
        )
        self.presses.takers.extend((self.keys, shortcuts))
        self.is_switch: Callable[[Press], bool] = lambda _: False
        """A key or button is one of somebody's switches: Space is then no STOP."""
        self._devices = devices
        self._there: frozenset[int] | None = None
        """What was plugged in at the last look, while a button of a gamepad holds something."""
        self._pushing = StickArbiter(app, self.gamepads, self.keys, self._source, devices, turned, now)
        self._bound = self._bindings()

    def _bindings(self) -> dict[str, Callable[..., object]]:
        """What the window tells, to who takes it."""
        return {
            "on_key_down": self._key_down,
            "on_key_up": self._key_up,
            "on_keyboard": self._keyboard,
            "on_joy_button_down": self._button_down,
            "on_joy_button_up": self._button_up,
            "on_joy_axis": self._axis,
            "on_touch_down": self._touch_down,
            "on_request_close": lambda *_, **__: self._app.leaving.close_window(),
            "focus": self._focus,
            **dict.fromkeys(RESTING, self.rest),
        }

    def open(self) -> None:
        """Begin to listen."""
        Window.bind(**self._bound)

    def close(self) -> None:
        """Listen no longer."""
        Window.unbind(**self._bound)
        self.presses.forget()
        self._source.close()

    def stop(self) -> None:
        """STOP, as a finger on the button in its corner would: of the robot, else of all; nothing where none is known."""
        shell, session = self._app.shell, self._app.session
        if shell is not None:
            shell.stop.dispatch("on_command")
        elif session is not None:
            session.stop()
        elif self._app.corner.button.robots:
            self._app.corner.press()

    @property
    def sticks(self) -> list[tuple[Any, str]]:
        """The controls that drive on the screen on the glass, each with the stick of a gamepad that pushes it too."""
        return self._pushing.sticks

    @property
    def pushed(self) -> bool:
        """A control that drives is out of its middle, whatever pushes it."""
        return any(stick.forward or stick.left for stick, _ in self.sticks)

    @property
    def held(self) -> bool:
        """Something is pushed, or a finger rests on what could be: the will to move the robot, be it felt or not."""
        return self.pushed or self._pushing.held

    def update(self) -> None:
        """Whatever pushes a control is looked at, and what is pressed on the gamepads."""
        states = self._source.pads()
        self.gamepads.on = self.mapped.pads_on
        gone = {state.number for state in self.gamepads.states} - {state.number for state in states}
        self.gamepads.update(states)
        for state in states:
            self.presses.buttons(state.number, state.name, state.buttons, self._now())
        for number in gone:
            self.presses.forget("pad", number)
        self._look_for_pads()
        self.meanings.update()
        self._pushing.update()
        for problem in self._news.problems(self.mapped):
            self._say(problem)

    def _look_for_pads(self) -> None:
        """Where an input device is taken away and the system does not say which, no button of a gamepad is held any more."""
        before, self._there = self._there, self._devices() if self.meanings.holds("pad") else None
        if before is not None and self._there is not None and not before <= self._there:
            self.meanings.lose("pad")

    def rest(self, *_: object) -> None:
        """Every control lets go, and gamepad and keys must be let go before they drive again."""
        if self._app.shell is not None:
            self._app.shell.rest()
        self._pushing.forbid()

    # what the window tells

    def _focus(self, _: object, focus: bool) -> None:
        self.presses.forget("key")
        self.keys.shifted(down=False)
        if not focus:
            self.rest()

    def _touch_down(self, _: object, touch: Any) -> None:
        """A control's own touch comes down again: its end was lost, wherever it is now."""
        for stick, _ in self.sticks:
            if stick.finger is touch:
                stick.rest()

    def _key_down(
        self, _: object, key: int, scancode: int = 0, text: str | None = None, held: Any = (), *__: object
    ) -> bool:
        name = KEYS.get(key, f"key {key}")
        if name in SHIFTS:
            self.keys.shifted(down=True)
        self.keys.repeated(name)
        self.meanings.repeated(name)
        modifiers = frozenset(held or ())
        press = Press("key", key, name, self._now(), scancode=scancode, modifiers=modifiers, text=text or "")
        taken = self.presses.press(press)
        if not taken:
            origins.typed(press.at)
        return taken

    def _key_up(self, _: object, key: int, *__: object) -> None:
        name = KEYS.get(key, f"key {key}")
        if name in SHIFTS:
            self.keys.shifted(down=False)
        self.presses.release("key", 0, name)

    def _is_stop(self, press: Press) -> bool:
        """Escape everywhere, Space where nothing is being typed and it is no switch, where there is a robot to stop or a study asks; a gamepad's B."""
        if press.source == "pad":
            return self.gamepads.is_stop(press.number, press.name)
        known = self._app.session is not None or self._app.corner.button.robots
        if not (known or self._app.intents.practise(Heard("stop", "keyboard"))):
            return False
        if press.code == BACK:
            return press.scancode == ESCAPE
        if press.name != "spacebar" or not self.mapped.keys.space_stops or is_typing():
            return False
        return not self.is_switch(press)

    def _stop_by(self, press: Press) -> None:
        """As all that is wanted, and at once: what waits to be confirmed is forgotten, and a study hears of it."""
        method = "gamepad" if press.source == "pad" else "keyboard"
        self._app.intents.submit(Heard("stop", method, began=press.at, said=press.name))

    def _keyboard(self, _: object, key: int, *__: object) -> bool:
        return bool(self._app.back()) if key == BACK else False

    def _button_down(self, _: object, number: int, button: int) -> None:
        if isinstance(self._source, KivyPads):
            self._source.button(number, button, down=True)
        pads = self.gamepads
        self.presses.press(
            Press("pad", button, pads.button(number, button), self._now(), pads.name(number), number)
        )

    def _button_up(self, _: object, number: int, button: int) -> None:
        if isinstance(self._source, KivyPads):
            self._source.button(number, button, down=False)
        self.presses.release("pad", number, self.gamepads.button(number, button))

    def _axis(self, _: object, number: int, axis: int, value: int) -> None:
        if isinstance(self._source, KivyPads):
            self._source.axis(number, axis, value)

    def _lost(self, why: str, press: Press) -> None:
        """What a key or a button held has ended; of a silent gamepad with the way out that its sticks have."""
        if press.source == "pad" and self.gamepads.silent(press.number):
            self._news.notify(PadEvent("silent", self.gamepads.name(press.number)))
        else:
            self._say(why)

    def _say(self, text: str) -> None:
        if self._app.shell is not None:
            self._app.shell.say(text, "warn", about="keys")


def _source() -> Sdl | KivyPads:
    library = sdl_library()
    try:
        return Sdl(library) if library is not None else KivyPads()
    except OSError as problem:
        log.warning("Gamepads are known by Kivy's events alone: %s", problem)
        return KivyPads()
