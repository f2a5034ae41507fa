"""The app on the stage, with a finger."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.headless import Stage

__all__ = ["PATIENCE", "Glass", "running"]

PATIENCE = 30.0
"""A fault, not a delay, uses this up [s]."""


class Glass:
    """The app on the stage."""

    def __init__(self, app: Any, stage: Stage) -> None:
        self.app, self.stage = app, stage

    @classmethod
    def start(cls, stage: Stage, folder: Path, *, poll: bool = False) -> Glass:
        """Start the app with its settings in `folder`; `poll` as `PilothouseApp` has it. Whoever does so ends it."""
        # Kivy: the first import comes after tests/conftest.py prepared it
        from app.application import PilothouseApp

        app = PilothouseApp(settings_dir=folder, theme="dark", discover=False, poll=poll)
        app.root = app.build()
        stage.show(app.root, stage.window.size)
        app.on_start()
        return cls(app, stage)

    def end(self) -> None:
        from widgets.core.theme import theme

        self.app.on_stop()
        theme.name = "dark"

    def until(self, condition: Callable[[], Any], what: str) -> None:
        end = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < end, repr(what)
            self.stage.frames(1)

    def drives(self) -> None:
        """Go on to the drive screen once the robot has answered, and until its stick can be pushed."""
        self.until(lambda: self.app.shell is not None, "no screens")
        self.until(lambda: self.app.session.control == "mine", "no control")
        self.app.show("drive")
        self.until(lambda: self.app.screens["drive"].stick.state == "live", "no stick")

    def tap(self, widget: Any) -> None:
        self.stage.frames(3)
        self.stage.tap(*widget.to_window(*widget.center))

    def hold(self, widget: Any) -> Any:
        touch = self.stage.touch(*widget.to_window(*widget.center))
        touch.touch_down()
        self.stage.frames(2)
        return touch

    def banners(self) -> list[str]:
        """Sentences over the screen, whatever cards lie there."""
        return [child.text for child in self.app.shell.ids.notices.children if hasattr(child, "text")]


@contextmanager
def running(stage: Stage, folder: Path, *, poll: bool = False) -> Iterator[Glass]:
    """The app from its start to its end, with its settings in `folder`; `poll` as `PilothouseApp` has it."""
    glass = Glass.start(stage, folder, poll=poll)
    try:
        yield glass
    finally:
        glass.end()
