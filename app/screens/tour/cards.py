"""The cards of the tour in their order: what each says, and what it points at."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from widgets.core.language import mark

__all__ = ["CARDS", "TourStep"]


class TourStep(NamedTuple):
    """One card."""

    icon: str
    title: str
    words: str
    target: Callable[[Any], Any]
    """The widget that it points at, given the app; None where that is not on the glass."""


def _stop(app: Any) -> Any:
    return app.shell.stop if app.shell is not None else _on_glass(app.corner.button)


def _of_shell(*names: str) -> Callable[[Any], Any]:
    """The first of these parts of the frame that is on the glass."""

    def find(app: Any) -> Any:
        if app.shell is None:
            return None
        return next((found for name in names if (found := _on_glass(app.shell.ids.get(name)))), None)

    return find


def _on_glass(widget: Any) -> Any:
    return widget if widget is not None and widget.get_root_window() is not None else None


def _setup(app: Any) -> Any:
    return _of_shell("setup", "more")(app) if app.shell is not None else _on_glass(app.connect.ids.setup)


CARDS = (
    TourStep(
        "front_hand",
        mark("STOP is always there"),
        mark(
            "The red button stops the robot at once. It is in the same corner of every screen, and this tour never covers it."
            " Hold it to let the robot go again."
        ),
        _stop,
    ),
    TourStep(
        "person",
        mark("One handheld drives"),
        mark("Here you see who has control. A tap asks for it; to give it back, a question comes first."),
        _of_shell("control", "mode"),
    ),
    TourStep(
        "sports_esports",
        mark("Drive by hand"),
        mark("Over the camera's picture, by stick, gamepad, keys or tilt. Let go, and the robot rests."),
        _of_shell("drive"),
    ),
    TourStep(
        "map",
        mark("Or send it on its way"),
        mark(
            "Draw points on the map; one button sends and starts them. The card beside it tells how far it is."
        ),
        _of_shell("mission"),
    ),
    TourStep(
        "tune",
        mark("Make it yours"),
        mark(
            "Units, language, size of text, gloves and colours are in Setup. There, under About, is this tour as well."
        ),
        _setup,
    ),
)
"""STOP first."""
