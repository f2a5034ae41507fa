"""The ways in beside fingers: one object for each, made when the app starts or when it is first asked for, at rest while the glass is away, ended with it.

Whoever brings a method adds a line to `MADE_BY` and touches the application no more. One that is off costs nothing.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable
from contextlib import suppress
from typing import Any, Protocol

from kivy.core.window import Window

from app.core.command_origin import origins
from app.core.optional_parts import bring, is_included
from app.device.motion import motion_source
from app.inputs.base.method_app import MethodApp
from app.inputs.input_problems import MethodProblems
from app.inputs.motion.motion_sensing import MotionSensing
from app.inputs.voice.process.ending import wait_for_ends
from app.intents.intents import METHODS, Heard, Verdict
from widgets.core.language import tr

__all__ = ["MADE_BY", "Method", "Methods"]

log = logging.getLogger(__name__)

MADE_BY: dict[str, str] = {
    "log": "app.study.response_recording:ResponseRecording",
    "talk": "app.inputs.voice.talkback:Talkback",
    "voice": "app.inputs.voice.voice_input:VoiceInput",
    "shake": "app.inputs.motion.shake_input:ShakeInput",
    "tilt": "app.inputs.motion.tilt_input:TiltInput",
    "switches": "app.inputs.switch_access.switches:SwitchAccess",
    "gamepad": "app.inputs.hand_methods:GamepadMethod",
    "keyboard": "app.inputs.hand_methods:KeyboardMethod",
}
"""Name of each to its module and class, as in `"shake": "app.inputs.motion.shake_input:ShakeInput"`; the class is called with the app.

A method whose module is left out of the build is not offered, and nothing is said of it.
"""
ON_DEMAND = ("talk", "voice", "shake", "tilt")
"""Off unless somebody switches them on: without settings of its own each is made when it is first asked for."""
AFTERWARDS = ("switches", "log")
"""On unless somebody switches them off: without settings of its own each is made after the first frame, and before a robot's screens are shown."""


class Method(Protocol):
    """One way in."""

    name: str
    """As in `MADE_BY`."""
    on: bool
    """The operator wants it; kept in the settings by the method itself when it is assigned."""

    @property
    def standing(self) -> str:
        """How it stands, in a word or a short sentence: `off`, `listening`, `5 Hz: too slow`."""

    @property
    def problem(self) -> str:
        """Why it does not work though it is on, as one sentence; empty when it is well."""

    def start(self) -> None:
        """Begin, or begin again after a pause; nothing where it has begun."""

    def stop(self) -> None:
        """Rest: nothing is listened to any more, and nothing costs anything."""

    def close(self) -> None:
        """End whatever it owns."""

    # `update(now)`, where there is one, is called with each heartbeat while it is on, or says that it is `busy`


class MethodsApp(MethodApp, Protocol):
    """The app that owns the methods."""

    sensing: MotionSensing
    """The motion sensors, which the methods make."""


class Methods:
    """All of them. Everything in the UI thread."""

    def __init__(self, app: MethodsApp) -> None:
        self._app = app
        self._all: dict[str, Any] = {}
        self._waiting: dict[str, str] = {}
        """What is not made yet, as in `MADE_BY`."""
        self._said: list[str] = []
        """What was said when they were made last."""
        self._is_open = False
        self._updates: list[Any] = []
        self._paused = False
        self.faults: dict[str, str] = {}
        """Name of each that could not be made to one sentence why; everything else goes on without it."""
        self._problems = MethodProblems(app)
        app.sensing = self.sensing = MotionSensing(motion_source(app.now), app.now)
        """The motion sensors of all of them."""

    def open(self) -> None:
        """Make each but those that can wait, and begin with those that are on; what cannot be made is said, and there is none of it."""
        Window.bind(on_touch_down=self._touched, on_touch_up=self._lifted)
        self._app.intents.on_taken.append(self._told)
        self._waiting, self._is_open = dict(MADE_BY), True
        self._make_those(
            [name for name in MADE_BY if not self._can_wait(name)], self._app.intents.table.problem
        )

    def open_rest(self) -> None:
        """Make what waited for the first frame, and have it look at a robot that is there already; nothing where it is made."""
        late = [name for name in AFTERWARDS if name in self._waiting]
        self._make_those(late, *self._said)
        for method in filter(None, map(self.made, late)):
            if method.on and hasattr(method, "update"):
                method.update(self._app.now())

    def _can_wait(self, name: str) -> bool:
        return name in (*ON_DEMAND, *AFTERWARDS) and self._app.settings.get(name) is None

    def _make_those(self, names: Iterable[str], *said: str) -> None:
        """Make them and say what is wrong with them, after what is `said` of others."""
        faults = [self._made_or_fault(name) for name in names]
        mistaken = [getattr(self._all.get(name), "mistaken", "") for name in names]
        sentences = [one for one in (*faults, *said, *mistaken) if one]
        if sentences and sentences != self._said:
            self._app.connect.say(" ".join(sentences), "warn")
        self._said = sentences

    def _made_or_fault(self, name: str) -> str:
        """Make one; returns why it could not be made, empty where it is well."""
        where = self._waiting.pop(name)
        if not is_included(where):  # as the study may be left out of a build
            return ""
        try:
            self._make(name, where)
        except Exception as problem:
            log.exception("%s cannot be used", name)
            self._leave_out(name, problem)
        return self.faults.get(name, "")

    def _make(self, name: str, where: str) -> None:
        self._all[name] = method = bring(where)(self._app)
        self._all = {one: self._all[one] for one in MADE_BY if one in self._all}
        if method.on and not self._paused:
            method.start()
        self._updates = [one for one in self._all.values() if hasattr(one, "update")]

    def _leave_out(self, name: str, problem: Exception) -> None:
        method = self._all.pop(name, None)
        if method is not None:
            with suppress(Exception):  # what failed to begin may fail to end as well
                method.close()
        self.faults[name] = tr("{name} cannot be used: {problem}.").format(
            name=name.capitalize(), problem=problem or type(problem).__name__
        )

    def close(self) -> None:
        """End each."""
        Window.unbind(on_touch_down=self._touched, on_touch_up=self._lifted)
        for method in self._all.values():
            method.stop()
            method.close()
        wait_for_ends()
        origins.forget()
        self.sensing.close()
        self._is_open = False
        self._waiting.clear()
        self._all.clear()
        self._updates.clear()

    def pause(self) -> None:
        """The glass is taken away: nothing listens."""
        self._paused = True
        self._app.intents.rest()
        origins.forget()
        self.sensing.pause()
        for method in self._all.values():
            method.stop()

    def resume(self) -> None:
        """It is back: those that are on begin again."""
        self._paused = False
        self.sensing.resume()
        for method in self._all.values():
            if method.on:
                method.start()

    def update(self, now: float) -> None:
        """With each heartbeat of the user interface, every 30 ms; `now` is our clock [s]."""
        origins.update(now)
        self._app.intents.update(now)
        if self._app.shell is not None:
            self._app.shell.wishes.update(now)
        self.sensing.update(now)
        for method in self._updates:
            if method.on or getattr(method, "busy", False):
                method.update(now)
        if not self._paused:
            self._problems.update(now)

    def get(self, name: str) -> Any:
        """The method of that name, made now where it waited for that; None where there is none."""
        if self._is_open and name in self._waiting and name not in self._all:
            self._make_those([name])
        return self._all.get(name)

    def made(self, name: str) -> Any:
        """The same, None where nobody needed it yet, so that it is off."""
        return self._all.get(name)

    def turn(self, name: str, on: bool) -> None:
        """Switch one on or off, and remember it; nothing for one that there is not."""
        method = self.get(name)
        if method is None:
            return
        method.on = on
        if on and not self._paused:
            method.start()
        elif not on:
            method.stop()

    @property
    def armed(self) -> list[str]:
        """Names of those that are on, and are a way to give commands."""
        return [name for name, method in self._all.items() if method.on and name in METHODS]

    @property
    def hearing(self) -> list[str]:
        """Names of those that a command could come from now: they are on and well, and have something to work with."""
        idle = self.idle()
        return [name for name, well in self.standing() if well and name not in idle]

    def standing(self) -> list[tuple[str, bool]]:
        """Name of each that is on, and whether it is well."""
        return [(name, not self.get(name).problem) for name in self.armed]

    def idle(self) -> list[str]:
        """Names of those that are on and well, and have nothing to work with: no gamepad is plugged in."""
        return [name for name in self.armed if getattr(self.get(name), "idle", False)]

    def _told(self, heard: Heard, verdict: Verdict) -> None:
        """Without a robot there is nothing that waits: only why nothing was done is said."""
        method = self._all.get(heard.method)
        if (
            method is not None and hasattr(method, "said") and verdict.done
        ):  # what it asked was answered, or lapsed
            method.said = verdict.sentence
        if self._app.shell is None and verdict.what in ("not allowed", "not now"):
            self._app.connect.say(verdict.sentence, "warn")

    def _touched(self, *_: object) -> None:
        origins.touched(self._app.now())

    def _lifted(self, *_: object) -> None:
        origins.lifted(self._app.now())
