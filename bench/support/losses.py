"""A driver who loses the finger or the gamepad, in every way an input can fail. Everything runs in the UI thread."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from kivy.base import EventLoop
from kivy.clock import Clock
from kivy.core.window import Window

from bench.support.virtual_pad import EAST, VirtualPad, kivys_sdl
from examples.demo.fingers import Finger, Hand
from widgets.controls.stop.stop_button import RELEASE_DURATION

__all__ = ["LOSSES", "Grip", "Loss"]

OUT = 0.9
"""How far the stick is pushed."""
GESTURE = (0.0, 0.0, 0.0, 0.0, 0.3, 0.6)
"""How far in each frame; the last is held."""
FREEZE = 1.2
"""After a longer one than 1 s the stick must be pushed anew [s]."""
ESCAPE = (27, 41)
"""Key code and scan code."""


class Grip:
    """A hand on the stick of the drive screen, or on a gamepad."""

    def __init__(self, app: Any, hand: Hand) -> None:
        """`hand` is one of Kivy's input providers already."""
        self.app, self._hand = app, hand
        self.finger: Finger | None = None
        self.pad: VirtualPad | None = None
        self.freeze: Callable[[], object] = lambda: time.sleep(FREEZE)
        """Holds up the user interface for a while."""
        self.undo: list[Callable[[], object]] = []
        """What makes good again what happened."""
        self.stops = False
        """STOP was pressed."""
        self._way, self._frame, self._holds = 1.0, 0, False

    @property
    def stick(self) -> Any:
        """The one on the drive screen."""
        return self.app.screens["drive"].stick

    @property
    def ready(self) -> bool:
        """Connected, in control, on the drive screen, with a live stick."""
        app = self.app
        if app.shell is None or app.session.robot_stop.phase != "ready":
            return False
        if app.shell.screen != "drive":
            app.show("drive")
        if app.session.control == "free":
            app.session.take_control()
        plugged = self.pad is None or self.stick.gamepad == "ready"
        return bool(app.session.control == "mine" and self.stick.state == "live" and plugged)

    @property
    def settled(self) -> bool:
        """What happened may be made good: a STOP is released once it is known that the robot rests."""
        return not self.stops or self.app.session.robot_stop.phase == "stopped"

    def take(self, kind: str) -> None:
        """Drive by `finger` or by `pad` from now on, each time the other way."""
        if kind == "pad":
            self.plug_in()
        else:
            self.drop()
        self._way, self._frame, self._holds = -self._way, 0, True

    def plug_in(self) -> None:
        """Have a gamepad, not pushed."""
        if self.pad is None:
            self.pad = VirtualPad(kivys_sdl())
            self.pad.push(0.0)

    def frame(self) -> None:
        """Push out and hold, as a hand that is never quite still."""
        if not self._holds:
            return
        share = GESTURE[self._frame] if self._frame < len(GESTURE) else OUT
        place = share * self._way
        if self.pad is not None:
            self.pad.push(place + (0.01 * self._way * (self._frame % 2) if share else 0.0))
        elif self._frame == 0:
            self.finger = self._hand.down(self.stick.to_window(*self.stick.center))
        elif self._frame <= len(GESTURE):
            x, y = self.stick.to_window(*self.stick.center)
            self._hand.move(self.finger, (x, y + place * self.stick.reach))
        self._frame += 1

    def hold_still(self) -> None:
        """The hand does nothing any more, and does not let go either."""
        self._holds = False

    def again(self) -> None:
        """Let go, and make good again what happened."""
        self._holds = self.stops = False
        if self.finger is not None:
            self._hand.up(self.finger)
            self.finger = None
        if self.pad is not None:
            self.pad.push(0.0)
        while self.undo:
            self.undo.pop()()

    def drop(self) -> None:
        """Have no gamepad any longer."""
        if self.pad is not None:
            self.pad.unplug()
            self.pad = None

    def lose(self, way: str) -> float:
        """Lose it that way, one of `LOSSES`; gives just when [s]. KeyError for another way."""
        loss = LOSSES[way]
        if not loss.hand_goes_on:
            self.hold_still()
        at = time.monotonic()
        loss.happens(self)
        return at


@dataclass(frozen=True, slots=True)
class Loss:
    """One way of `bench.support.ways`."""

    happens: Callable[[Grip], object]
    hand_goes_on: bool = True
    """The hand trembles on afterwards."""


def _lift(grip: Grip) -> None:
    if grip.finger is not None:
        grip._hand.up(grip.finger)  # noqa: SLF001 - a part of it
        grip.finger = None


def _forget(grip: Grip) -> None:
    EventLoop.touches.remove(grip.finger)


def _blur(grip: Grip) -> None:
    Window._focus = False  # noqa: SLF001 - as Kivy's own window does
    grip.undo.append(lambda: setattr(Window, "_focus", True))


def _turn(grip: Grip) -> None:
    size = tuple(Window.size)
    Window.size = size[::-1]
    grip.undo.append(lambda: setattr(Window, "size", size))


def _cover(grip: Grip) -> None:
    from app.screens.parts.dialogs import AddressDialog

    dialog = AddressDialog(lambda _: None)
    grip.app.root.add_widget(dialog)
    grip.undo.append(dialog.close)


def _pause(grip: Grip) -> None:
    grip.app.on_pause()
    grip.undo.append(grip.app.on_resume)


def _give_up(grip: Grip) -> None:
    grip.app.session.authority.release()
    grip.undo.append(grip.app.session.take_control)


def release(session: Any) -> None:
    """Hold Release, and again when the robot had to wait since the release before."""

    def hold(_: float) -> bool:
        if session.robot_stop.phase != "stopped":
            return False
        session.hold_stop()
        Clock.schedule_once(lambda _: session.release_stop(), RELEASE_DURATION)
        return True

    hold(0.0)
    Clock.schedule_interval(hold, 2 * RELEASE_DURATION)


def _escape(grip: Grip) -> None:
    Window.dispatch("on_key_down", *ESCAPE, None, [])
    Window.dispatch("on_key_up", *ESCAPE)
    grip.stops = True
    grip.undo.append(lambda: release(grip.app.session))


def _press_east(grip: Grip) -> None:
    pad = grip.pad
    if pad is not None:
        pad.button(EAST, down=True)
        grip.stops = True
        grip.undo += [lambda: release(grip.app.session), lambda: pad.button(EAST, down=False)]


LOSSES: dict[str, Loss] = {
    "lifted": Loss(_lift, hand_goes_on=False),
    "end_never_told": Loss(_forget, hand_goes_on=False),
    "centred": Loss(lambda grip: grip.pad and grip.pad.push(0.0), hand_goes_on=False),
    "silent": Loss(lambda _: None, hand_goes_on=False),
    "unplugged": Loss(Grip.drop, hand_goes_on=False),
    "out_of_focus": Loss(_blur),
    "hidden": Loss(lambda _: Window.dispatch("on_hide")),
    "turned": Loss(_turn),
    "dialog": Loss(_cover),
    "other_screen": Loss(lambda grip: grip.app.show("mission")),
    "frozen": Loss(lambda grip: grip.freeze()),
    "paused": Loss(_pause),
    "given_up": Loss(_give_up),
    "stop_key": Loss(_escape),
    "stop_button": Loss(_press_east),
}
