"""The life of whatever pushes the controls on the glass: fingers, a gamepad, keys.

A resting finger sends no events and drives on. What ends it, since its end may never be told: Kivy or SDL know the touch
no longer, something came over the control, the window lost its focus or was turned, and the robot may not be driven.
Each control is looked at for itself; whatever takes one away from a gamepad or from the keys takes all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any, Protocol

from kivy.base import EventLoop
from kivy.core.window import Window

from app.core.command_origin import Origin, origins
from app.inputs.base.method_app import MethodApp
from app.inputs.gamepad.gamepad import Gamepads, KivyPads
from app.inputs.gamepad.sdl import Sdl
from app.inputs.keys.key_drive import KeyDrive
from widgets.controls.occlusion import covered

__all__ = ["StickArbiter"]

Controls = list[tuple[Any, str]]


class _Pusher(Protocol):
    """Pushes what no finger has."""

    def use(self, sticks: Collection[str]) -> None: ...

    def lean(self) -> dict[str, tuple[float, float]] | None: ...

    def forbid(self) -> None: ...


class StickArbiter:
    """`update` belongs to the heartbeat. Everything in the UI thread."""

    def __init__(
        self,
        app: MethodApp,
        gamepads: Gamepads,
        keys: KeyDrive,
        source: Sdl | KivyPads,
        devices: Callable[[], frozenset[int]],
        turned: Callable[[], int],
        now: Callable[[], float],
    ) -> None:
        """`app` is asked for its `shell` and its `session`."""
        self._app, self._gamepads, self._keys, self._source = app, gamepads, keys, source
        self._devices, self._turned, self._now = devices, turned, now
        self._pushers: dict[str, _Pusher] = {"gamepad": gamepads, "keyboard": keys}
        self._leader = ""
        """Which of them pushes the controls that have no finger; empty for none."""
        self._origin = Origin()
        self._felt = False
        """What it pushed has moved a control since."""
        self._hidden: set[Any] = set()
        """Controls that something was over at the last look."""
        self._voided = 0
        """As of the link, at the last look."""
        self._held_under: tuple[frozenset[int], int] | None = None
        """Devices and turn of the screen while any of them is pushed."""

    # the controls

    @property
    def sticks(self) -> Controls:
        """The controls that drive on the screen on the glass, each with the stick of a gamepad that pushes it too."""
        shell = self._app.shell
        return getattr(shell.screens.get(shell.screen), "sticks", []) if shell is not None else []

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold on that screen and does not drive."""
        shell = self._app.shell
        return getattr(shell.screens.get(shell.screen), "grips", []) if shell is not None else []

    @property
    def held(self) -> bool:
        """A hand is on one of them."""
        return any(_held(one) for one in (*self.grips, *(stick for stick, _ in self.sticks)))

    def update(self) -> None:
        """Whatever pushes a control is looked at: is it still there, may it still?"""
        sticks, grips = self.sticks, self.grips
        self._hidden &= {*grips, *(stick for stick, _ in sticks)}
        for grip in grips:
            if grip.finger is not None and (self._gone(grip.finger) or self._covered(grip)):
                grip.rest()
        for pusher in self._pushers.values():
            pusher.use({pad for _, pad in sticks if pad})
        if sticks:
            self._look_at(sticks)
        else:
            self.forbid()

    def _look_at(self, sticks: Controls) -> None:
        """Bring to rest what must not drive any longer, and let a gamepad or the keys push the others."""
        controls = [stick for stick, _ in sticks]
        ended = self._dropped() or not self._app.session.may_drive or self._moved_on(controls)
        hidden = [stick for stick in controls if self._covered(stick)]
        for stick in controls:
            if ended or stick in hidden or (stick.finger is not None and self._gone(stick.finger)):
                stick.rest()
        if ended or not Window.focus:
            self._let_go(controls)
        else:
            self._lead([(stick, pad) for stick, pad in sticks if stick not in hidden], sticks)
        for stick, pad in sticks:
            stick.gamepad = self._sign if pad else "none"

    @property
    def _sign(self) -> str:
        return "keys" if self._leader == "keyboard" else self._gamepads.standing

    def _let_go(self, controls: list[Any]) -> None:
        """No control may be pushed by anything but a finger, of whose loss the window tells."""
        for stick in controls:
            if stick.finger is None:
                stick.rest()
        self.forbid()

    def _covered(self, stick: Any) -> bool:
        """Something is over it, and was at the last look: what is being laid out is anywhere for a frame."""
        before, now = stick in self._hidden, covered(stick)
        (self._hidden.add if now else self._hidden.discard)(stick)
        return before and now

    # gamepads and keys

    def _lead(self, open_: Controls, all_: Controls) -> None:
        """A gamepad or the keys push what nobody holds; where something else brought it to rest, they must be let go first."""
        led = [(stick, pad) for stick, pad in all_ if pad]
        free = [(stick, pad) for stick, pad in open_ if pad and not _held(stick)]
        # whoever holds one of them takes them all: two hands on one robot would be two drivers
        rested = self._felt and not any(stick.forward or stick.left for stick, _ in led)
        if len(free) < len(led) or rested:
            self._end_lead(led)
            self.forbid()
            if len(free) < len(led):
                return
        lean = self._lean()
        if lean is None:
            self._end_lead(led)
            return
        with origins.during(self._origin):
            for stick, pad in led:
                stick.lean(*lean[pad])
        self._felt = any(stick.forward or stick.left for stick, _ in led)

    def _lean(self) -> dict[str, tuple[float, float]] | None:
        """What the one that leads says; of two that want to, the one that came second must be let go."""
        leans = {name: pusher.lean() for name, pusher in self._pushers.items()}
        wanting = [name for name, lean in leans.items() if lean is not None]
        if not wanting:
            return None
        leader = self._leader if self._leader in wanting else wanting[0]
        for name in wanting:
            if name != leader:
                self._pushers[name].forbid()
        if leader != self._leader:
            self._leader = leader
            self._origin = Origin(leader, began=self._now(), decided=self._now())
        return leans[leader]

    def _end_lead(self, led: Controls) -> None:
        """What a gamepad or a key has pushed springs back."""
        if not self._leader:
            return
        self._leader, self._felt = "", False
        with origins.during(self._origin):
            for stick, _ in led:
                if not _held(stick):
                    stick.rest()

    def forbid(self) -> None:
        """Nothing but a finger may drive until it was let go."""
        self._leader, self._felt = "", False
        for pusher in self._pushers.values():
            pusher.forbid()

    # fingers

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
        if self._leader and not before[0] <= now[0]:
            self._gamepads.lose()
            return True
        return before[1] != now[1]


def _held(stick: Any) -> bool:
    """A finger has it, or the clutch of the tablet's tilt, which a key or a trigger can hold as well."""
    return stick.finger is not None or getattr(stick, "clutched", False)
