"""Round corners, cameras and bars of a phone: nothing that is touched lies there, on any page, and it follows when they move."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from app.device.insets import NONE, Insets
from app.inputs.switch_access.window.finding import in_window
from app.inputs.switch_access.window.targets import WindowTargets
from app.layout import arrange
from app.layout.rects import Rect
from app.screens.parts.safe_area import safe_area
from tests.app.glass import Glass

EDGES = Insets(34.0, 28.0, 20.0, 24.0)
BAR = 3.0
"""The bar of a phone on its side is so much lower than the icon within it, which is as large as a finger needs [px]."""
SIZES = ((412, 892), (892, 412), (1280, 800))


@pytest.fixture
def edged(driving: Glass) -> Iterator[Any]:
    window, root = driving.stage.window, driving.app.root
    before = tuple(window.size)

    def turn(size: tuple[int, int]) -> Rect:
        window.size = root.size = size
        driving.stage.frames(2)
        safe_area.insets = EDGES
        driving.stage.run_for(0.3)  # the words of the bar are those of the shape at the next tick
        return safe_area.within(*size)

    yield turn
    safe_area.insets = NONE
    window.size = root.size = before


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_whatever_takes_a_finger_keeps_clear_of_them(
    driving: Glass, edged: Any, size: tuple[int, int]
) -> None:
    app, targets = driving.app, WindowTargets(driving.app)
    for screen in ("drive", "mission", "tasks", "more", "fleet", "connect"):
        if screen == "connect":
            app.leave()
        else:
            app.show(screen)
        room = edged(size)
        found = [target.key for target in targets.targets()]
        found += (
            [app.shell.stop, app.shell.bar, app.shell.nav] if app.shell is not None else [app.corner.button]
        )
        assert found
        for widget in (one for one in found if one.get_root_window() is not None):
            left, low, right, top = in_window(widget)
            across = left >= room.x - 1 and right <= room.right + 1
            assert across, (screen, type(widget).__name__, (left, right))
            seen = top > 0 and low < size[1] and not _scrolls(widget)
            assert not seen or (low >= room.y - 1 and top <= room.top + BAR), (screen, type(widget).__name__)


def _scrolls(widget: Any) -> bool:
    """It may be scrolled out of sight below what it is in."""
    from kivy.uix.scrollview import ScrollView

    return (
        widget.parent is not None
        and widget.parent is not widget
        and any(isinstance(one, ScrollView) for one in _above(widget))
    )


def _above(widget: Any) -> Iterator[Any]:
    while widget.parent is not None and widget.parent is not widget:
        widget = widget.parent
        yield widget


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_frame_fills_what_is_left(size: tuple[int, int]) -> None:
    left, top, right, bottom = EDGES
    inside = Rect(left, bottom, size[0] - left - right, size[1] - top - bottom)
    places = arrange.shell(*size, inside=inside)
    assert all(inside.holds(place) for place in places.values())
    area = sum(place.width * place.height for place in places.values())
    assert area == pytest.approx(inside.width * inside.height)


def test_a_question_is_asked_within_them(driving: Glass, edged: Any) -> None:
    edged(SIZES[1])
    driving.app.shell.toggle_control()
    driving.stage.frames(4)
    dialog = driving.app.shell.control.dialog
    room = safe_area.within(*SIZES[1])
    card = dialog.ids.card
    assert room.holds(Rect(*card.pos, *card.size))
