"""The drive screen under what is said over it: what can be read beside that stays."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from app.layout.rects import Rect
from bridge.msgs.pilothouse_msgs import RobotInfo
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.app.test_profiles import DRONE, SCOUT

PHONE = Rect(0, 60, 412, 774)
CARD, TWO, LIST = 77.0, 134.0, 216.0
"""Heights of one card, of a card and a sentence, and of the list that stays after STOP ALL [dp]."""


@pytest.fixture
def phone(driving: Glass, robot: FakeRobot) -> Callable[[RobotInfo], Any]:
    """The screen of a robot on a phone that is held upright."""

    def phone(info: RobotInfo) -> Any:
        before = driving.app.screens["drive"]
        robot.publish("/robot/info", info)
        driving.until(lambda: driving.app.screens["drive"] is not before, "the screen of before")
        screen = driving.app.screens["drive"]
        screen.arrange(PHONE, "tall", 1.0)
        return screen

    return phone


def seen(widget: Any) -> Rect | None:
    """Where it is on the glass; None where it is not."""
    return Rect(*widget.pos, *widget.size) if widget.opacity and widget.right > 0 else None


def cards(screen: Any) -> dict[str, Rect | None]:
    return {slot: seen(screen.places[slot][0]) for slot in ("top_left", "top_right", "readouts")}


def said(screen: Any, height: float) -> Rect:
    """Something is said in the uppermost part of the room for that."""
    room = screen.notice
    cover = Rect(room.x, room.top - height, room.width, height)
    screen.clear(cover)
    return cover


def test_what_is_said_takes_the_figures_from_no_robot(phone: Callable[..., Any]) -> None:
    for info in (DRONE, SCOUT):
        screen = phone(info)
        whole = cards(screen)
        for height in (CARD, TWO, LIST):
            assert_figures_stay(screen, height)
            screen.clear(None)
            assert cards(screen) == whole, (info.name, height)


def assert_figures_stay(screen: Any, height: float) -> None:
    cover = said(screen, height)
    now = cards(screen)
    assert now["readouts"] is not None, height
    for slot, place in now.items():
        assert place is None or (not place.overlaps(cover) and place.height >= 52.0), (height, slot)
    for name in ("stop", "stick", "actions", "top"):
        assert not now["readouts"].overlaps(screen.arranged[name]), (height, name)
    shown = [child for child in screen.readouts.children if child.parent is screen.readouts]
    assert len(shown) >= 2, height


def test_one_card_leaves_what_is_not_under_it_and_where_no_room_is_left_nothing_is_seen_only_in_part(
    phone: Callable[..., Any],
) -> None:
    screen = phone(DRONE)
    cover = said(screen, CARD)
    for slot, place in cards(screen).items():
        assert place is not None, slot
        whole = screen.arranged[slot]
        assert (place.y, place.top) == (whole.y, min(whole.top, cover.y - 8)), slot
    screen.clear(Rect(0, PHONE.y, 412, PHONE.height))
    assert set(cards(screen).values()) == {None}
