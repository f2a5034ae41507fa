"""What the operator's hands and the system do to the app as a whole: keys, gamepads, a window that goes away, and the
life of whatever pushes a control.

A resting finger sends no events and drives on. What ends it, since its end may never be told: Kivy or SDL know the touch
no longer, something came over the control, the window lost its focus or was turned, and the robot may not be driven.
Each control is looked at for itself; whatever takes one away from a gamepad takes all of them from it.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import Any

from kivy.base import EventLoop
from kivy.core.window import Keyboard, Window
from kivy.uix.behaviors import FocusBehavior

from app.covering import covered
from app.device import input_devices, rotation, sdl_library
from app.gamepad import Gamepads, Told
from app.pad_news import PadNews
from app.press import Press, Presses
from app.sdl import Sdl

__all__ = ["BACK", "Inputs", "typing"]

log = logging.getLogger(__name__)

RESTING = ("size", "on_hide", "on_minimize")
"""What happens to the window and brings every control to rest."""
BACK = 27
"""Key code of Android's Back, and of Escape."""
ESCAPE = 41
"""Scan code of Escape, which Back has not."""
SPACE = 32
SWITCHES = {9: "Tab", 13: "Enter"}
"""Key codes that two switches send, on to the next action and do it, by their names."""
KEYS = {code: name for name, code in Keyboard.keycodes.items()}
"""Names of Kivy's key codes."""


def typing() -> bool:
    """A field on the glass takes what is typed."""
    everything = (widget for root in Window.children for widget in root.walk())
    return any(isinstance(widget, FocusBehavior) and widget.focus for widget in everything)


class Inputs:
    """Listens to the window from `open` to `close`; `look` belongs to the heartbeat. Everything in the UI thread."""

    def __init__(
        self,
        app: Any,
        now: Callable[[], float] = time.monotonic,
        source: Sdl | Told | None = None,
        devices: Callable[[], frozenset[int]] = input_devices,
        turned: Callable[[], int] = rotation,
    ) -> None:
        """`app` is asked for its `shell`, `session` and `corner`. `source` tells of gamepads and fingers, SDL where there is one;

        `devices` numbers what the system has plugged in, `turned` says how the screen is turned [quarters].
        """
        self._app, self._devices, self._turned = app, devices, turned
        self._now, self._source = now, source or _source()
        self._news = PadNews(app, lambda: self.gamepads)
        self.gamepads = Gamepads(
            now, on_stop=self.stop, on_news=self._news.tell, wired=app.settings.get("wired_gamepads") or ()
        )
        self.presses = Presses(self._is_stop, lambda _: self.stop())
        """Every key and every button of a gamepad; whoever wants them before all others puts himself first in `takers`."""
        self.presses.takers.append(_Column(app))
        self._led = False
        """A gamepad pushes the controls that have no finger."""
        self._hidden: set[Any] = set()
        """Controls that something was over at the last look."""
        self._voided = 0
        """As of the link, at the last look."""
        self._held_under: tuple[frozenset[int], int] | None = None
        """Devices and turn of the screen while any of them is pushed."""
        self._bound = {
            "on_key_down": self._key_down,
            "on_key_up": self._key_up,
            "on_keyboard": self._keyboard,
            "on_joy_button_down": self._button_down,
            "on_joy_button_up": self._button_up,
            "on_joy_axis": self._axis,
            "on_touch_down": self._touch_down,
            "focus": self._focus,
            **dict.fromkeys(RESTING, self.rest),
        }

    def open(self) -> None:
        """Begin to listen."""
        Window.bind(**self._bound)

    def close(self) -> None:
        """Listen no longer."""
        Window.unbind(**self._bound)
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

    # the controls

    @property
    def sticks(self) -> list[tuple[Any, str]]:
        """The controls that drive on the screen on the glass, each with the stick of a gamepad that pushes it too."""
        shell = self._app.shell
        return getattr(shell.screens.get(shell.screen), "sticks", []) if shell is not None else []

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold on that screen and does not drive."""
        shell = self._app.shell
        return getattr(shell.screens.get(shell.screen), "grips", []) if shell is not None else []

    def look(self) -> None:
        """Whatever pushes a control is looked at: is it still there, may it still?"""
        sticks, grips = self.sticks, self.grips
        self._hidden &= {*grips, *(stick for stick, _ in sticks)}
        for grip in grips:
            if grip.finger is not None and (self._gone(grip.finger) or self._covered(grip)):
                grip.rest()
        self.gamepads.use({pad for _, pad in sticks if pad})
        self.gamepads.hear(self._source.pads())
        controls = [stick for stick, _ in sticks]
        if not sticks:
            self._forbid()
            return
        ended = self._dropped() or not self._app.session.may_drive or self._moved_on(controls)
        covered_ = [stick for stick in controls if self._covered(stick)]
        for stick in controls:
            if ended or stick in covered_ or (stick.finger is not None and self._gone(stick.finger)):
                stick.rest()
        if ended or not Window.focus:
            self._let_go(controls)
        else:
            self._lead([(stick, pad) for stick, pad in sticks if stick not in covered_], sticks)
        for stick, pad in sticks:
            stick.gamepad = self.gamepads.standing if pad else "none"

    def _let_go(self, controls: list[Any]) -> None:
        """No control may be pushed by anything but a finger, of whose loss the window tells."""
        for stick in controls:
            if stick.finger is None:
                stick.rest()
        self._forbid()

    def _covered(self, stick: Any) -> bool:
        """Something is over it, and was at the last look: what is being laid out is anywhere for a frame."""
        before, now = stick in self._hidden, covered(stick)
        (self._hidden.add if now else self._hidden.discard)(stick)
        return before and now

    def _lead(self, open_: list[tuple[Any, str]], all_: list[tuple[Any, str]]) -> None:
        """A gamepad pushes what no finger has; where something else brought it to rest, it must be let go first."""
        led = [(stick, pad) for stick, pad in all_ if pad]
        free = [(stick, pad) for stick, pad in open_ if pad and stick.finger is None]
        # a finger on one of them takes them all: two hands on one robot would be two drivers
        if len(free) < len(led) or (self._led and not any(stick.forward or stick.left for stick, _ in led)):
            self._end_lead(led)
            self._forbid()
            if len(free) < len(led):
                return
        lean = self.gamepads.lean()
        if lean is not None:
            self._led = True
            for stick, pad in led:
                stick.lean(*lean[pad])
        elif self._led:
            self._end_lead(led)

    def _end_lead(self, led: list[tuple[Any, str]]) -> None:
        """What a gamepad has pushed springs back."""
        if self._led:
            self._led = False
            for stick, _ in led:
                if stick.finger is None:
                    stick.rest()

    def _forbid(self) -> None:
        self._led = False
        self.gamepads.forbid()

    def _gone(self, touch: Any) -> bool:
        """The touch is over though its end was not told."""
        known = any(touch is other for other in EventLoop.touches)
        return not known or touch.time_end >= 0 or self._source.lifted(touch.device, touch.id)

    def _dropped(self) -> bool:
        """The network has dropped a push that nobody let go of, as after a freeze: what is not driven is not shown as pushed."""
        before, self._voided = self._voided, self._app.session.link.voided
        return before != self._voided

    def _moved_on(self, controls: list[Any]) -> bool:
        """The screen was turned, or an input device was taken away, while a control is pushed."""
        if not any(stick.forward or stick.left for stick in controls):
            self._held_under = None
            return False
        before, now = self._held_under, (self._devices(), self._turned())
        self._held_under = now
        if before is None or before == now:
            return False
        if self._led and not before[0] <= now[0]:
            self.gamepads.lose()
            return True
        return before[1] != now[1]

    # what the window tells

    def rest(self, *_: object) -> None:
        """Every control lets go, and a gamepad must be let go before it drives again."""
        if self._app.shell is not None:
            self._app.shell.rest()
        self._forbid()

    def _focus(self, _: object, focus: bool) -> None:
        self.presses.forget()
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
        press = Press(
            "key", key, name, self._now(), scancode=scancode, modifiers=frozenset(held), text=text or ""
        )
        return self.presses.press(press)

    def _key_up(self, _: object, key: int, *__: object) -> None:
        self.presses.release("key", 0, key)

    def _is_stop(self, press: Press) -> bool:
        """Escape everywhere, Space where nothing is being typed, where there is a robot to stop; a gamepad's B."""
        if press.source == "pad":
            return self.gamepads.is_stop(press.number, press.code)
        if self._app.session is None and not self._app.corner.button.robots:
            return False
        return (press.code == BACK and press.scancode == ESCAPE) or (press.code == SPACE and not typing())

    def _keyboard(self, _: object, key: int, *__: object) -> bool:
        return bool(self._app.back()) if key == BACK else False

    def _button_down(self, _: object, number: int, button: int) -> None:
        name, device = f"button {button}", self.gamepads.name(number)
        self.presses.press(Press("pad", button, name, self._now(), device, number))

    def _button_up(self, _: object, number: int, button: int) -> None:
        self.presses.release("pad", number, button)

    def _axis(self, _: object, number: int, axis: int, value: int) -> None:
        if isinstance(self._source, Told):
            self._source.axis(number, axis, value)


class _Column:
    """Two switches on the column of actions, where the screen on the glass has one."""

    def __init__(self, app: Any) -> None:
        self._app = app

    def pressed(self, press: Press) -> bool:
        """On to the next action, or do it."""
        shell = self._app.shell
        if press.source != "key" or press.code not in SWITCHES or shell is None or typing():
            return False
        act = getattr(shell.screens.get(shell.screen), "press_switch", None)
        if act is not None:
            act(SWITCHES[press.code])
        return act is not None

    def released(self, press: Press) -> None:
        """Nothing ends with it."""


def _source() -> Sdl | Told:
    library = sdl_library()
    try:
        return Sdl(library) if library is not None else Told()
    except OSError as problem:
        log.warning("Gamepads are known by Kivy's events alone: %s", problem)
        return Told()
