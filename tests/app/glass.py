"""The app on the stage, with a finger."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from tests.headless import Stage

__all__ = ["Glass"]

PATIENCE = 30.0
"""A fault, not a delay, uses this up [s]."""


class Glass:
    """The app on the stage."""

    def __init__(self, app: Any, stage: Stage) -> None:
        self.app, self.stage = app, stage

    def until(self, condition: Callable[[], Any], what: str) -> None:
        end = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < end, repr(what)
            self.stage.frames(1)

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
