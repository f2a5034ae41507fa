"""Work for idle frames: what will be needed soon is imported a little at a time, so that nobody waits for it later."""

from __future__ import annotations

import logging
import time
from collections import deque
from collections.abc import Callable, Iterable
from functools import partial
from importlib import import_module
from typing import Any, Protocol

from kivy.clock import Clock
from kivy.core.window import Window

from app.core.optional_parts import is_included
from app.frame_pacing import is_touched
from app.garbage_collector import Collector
from app.inputs.methods import Methods

__all__ = ["BUDGET", "METHODS", "SOON", "IdleWork", "get_ready", "imports"]

log = logging.getLogger(__name__)

BUDGET = 0.008
"""Time that a frame gives to it [s]; a step that has begun is not broken off."""
METHODS = (
    "app.inputs.switch_access.scan.plan",
    "app.inputs.switch_access.scan.settings",
    "app.inputs.switch_access.window.targets",
    "app.inputs.switch_access.switches",
    "app.study.response_timing",
    "app.study.drive_spans",
    "app.study.response_statistics",
    "app.study.response_recording",
)
"""Modules of the input methods that are made after the first frame."""
SOON = (
    "importlib.metadata",
    "websockets.frames",
    "websockets.client",
    "websockets.asyncio.client",
    "bridge.protocol.client_session",
    "bridge.protocol",
    "bridge.client.client",
    "app.link.link",
    "numpy",  # the one great step: a library is imported in one go
    "app.session.event_words",
    "app.session.session",
    "app.stop.stop_lane",
    "widgets.core.canvas_ink",
    "app.screens.shell.announcements",
    "app.screens.shell.control_cards",
    "app.screens.shell.task_question",
    "app.screens.shell.top_bar",
    "app.screens.trust.people_dialog",
    "app.screens.shell.shell",
    "app.screens.robot_screens",
    "app.session.layout_actions",
    "app.screens.drive.drive_controls",
    "app.screens.drive.drive",
    "widgets.map.map_overlay",
    "app.screens.mission.map_corner",
    "app.screens.mission.mission_panel",
    "app.screens.mission.mission",
    "widgets.map.ground",
    "widgets.map.tiles.tile_pictures",
)
"""Modules that a robot needs, in the order in which they are imported before there is one; a screen that is seldom shown
is not among them."""
MAX_WAIT = 30
"""So many turns of the loop without a frame on the glass, and it begins nevertheless: there is nothing to be drawn."""


def imports(modules: Iterable[str]) -> list[Callable[[], object]]:
    """A step for each module."""
    return [partial(_import, module) for module in modules]


def _import(module: str) -> None:
    if is_included(module):
        import_module(module)


class IdleWork:
    """Takes its steps in order, one after the other, until all are done or it is closed. Everything in the UI thread."""

    def __init__(
        self,
        steps: Iterable[Callable[[], object]],
        *,
        may: Callable[[], bool],
        spent: Callable[[], float] = time.perf_counter,
    ) -> None:
        """A frame in which `may` is false does nothing; `spent` is the clock that the budget is measured by [s]."""
        self._steps, self._may, self._spent = deque(steps), may, spent
        self._waits = MAX_WAIT
        """Turns of the loop that are still waited for a frame on the glass: nothing comes before that."""
        Window.bind(on_flip=self._begin)
        self._event = Clock.schedule_interval(lambda _: self._work(), 0)

    @property
    def left(self) -> int:
        """Steps that are still to be done."""
        return len(self._steps)

    def close(self) -> None:
        """Do no more of it."""
        Window.unbind(on_flip=self._begin)
        self._event.cancel()
        self._steps.clear()

    def _begin(self, *_: object) -> None:
        self._waits = 0

    def _work(self) -> None:
        if self._waits:
            self._waits -= 1
            return
        if not self._may():
            return
        end = self._spent() + BUDGET
        while self._steps and self._spent() < end:
            self._step(self._steps.popleft())
        if not self._steps:
            self.close()

    def _step(self, step: Callable[[], object]) -> None:
        try:
            step()
        except Exception:  # whoever needs it later gets the fault itself
            log.exception("Something could not be made ready")


class ReadyApp(Protocol):
    """The app, as far as what it will need soon is made ready."""

    methods: Methods
    collector: Collector

    @property
    def session(self) -> Any:
        """The session with the robot; None while none is wanted."""


def get_ready(app: ReadyApp) -> IdleWork:
    """Make the methods that waited for the first frame, and import what a robot needs."""

    def may() -> bool:
        """No finger is down and nothing is driven: a frame may take a little longer."""
        return not is_touched() and (app.session is None or not app.session.link.driving)

    def keep() -> None:
        """What was imported stays: the collector need not look at it."""
        if app.session is None:
            app.collector.keep()

    return IdleWork([*imports(METHODS), app.methods.open_rest, *imports(SOON), keep], may=may)
