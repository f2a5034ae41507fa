"""The hand that holds STOP: every screen has it in the same corner, and no control moves under a finger."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from app.core.hand import HANDS, hand
from app.layout.arrange import form
from app.layout.arrange import shell as shell_of
from app.layout.rects import Body, Rect, mirrored, right_handed, stop_place
from app.screens.parts.screen_table import names
from bridge.msgs.geometry_msgs import Twist
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

SIZES = ((412, 892), (892, 412), (1280, 800), (1920, 1200))


@pytest.fixture
def turned(driving: Glass) -> Iterator[Glass]:
    """The window as large as before, and the right hand, in the end."""
    before = tuple(driving.stage.window.size)
    yield driving
    turn(driving, before)
    hand.chosen = "right"
    hand.take_up()


def rounded(place: Rect) -> tuple[float, ...]:
    return tuple(round(value, 3) for value in (place.x, place.y, place.width, place.height))


def turn(glass: Glass, size: tuple[int, int]) -> None:
    glass.stage.window.size = glass.app.root.size = size
    glass.stage.frames(2)


def choose(glass: Glass, name: str) -> None:
    glass.app.preferences.choose("hand", name)
    glass.stage.frames(3)


def test_every_screen_has_stop_in_the_one_place_that_there_is_for_a_window_and_a_hand(turned: Glass) -> None:
    app, edited = turned.app, turned.app.screens["panels"]
    for name in HANDS:
        hand.chosen = name
        hand.take_up()
        for size in SIZES:
            room, shape = shell_of(*size, left_hand=hand.left)["body"], form(*size)
            body = Body(
                room.x, room.y, room.width, room.height, hand.left, hand.left
            )  # STOP ALL for one of them
            there = stop_place(right_handed(body), shape, 1.0)
            place = mirrored(there, body) if hand.left else there
            for screen in names():
                found = app.screens[screen].arrange(body, shape, 1.0)
                assert rounded(found) == rounded(place), (name, size, screen)
            edited.editor.begin()
            assert rounded(edited.arrange(body, shape, 1.0)) == rounded(place), "while panels are edited"
            edited.editor.done()


def test_the_frame_puts_stop_there_and_the_navigation_at_the_other_side(turned: Glass) -> None:
    for name in HANDS:
        choose(turned, name)
        for size in SIZES:
            turn(turned, size)
            shell = turned.app.shell
            for screen in ("drive", "mission", "panels", "tasks"):
                shell.go(screen)
                stop, room, body = shell.stop, shell.nav, shell.ids.body
                assert (stop.center_x < body.center_x) == (name == "left"), (size, screen)
                edge = stop.x - body.x if name == "left" else body.right - stop.right
                assert (round(edge, 3), stop.y - body.y) == (12, 12), (size, screen)
                assert shell.form == "tall" or (room.x > body.center_x) == (name == "left"), size
                assert not Rect(*room.pos, *room.size).overlaps(Rect(*stop.pos, *stop.size))


def test_a_choice_moves_nothing_before_every_control_has_let_go(turned: Glass, robot: FakeRobot) -> None:
    screen, shell = turned.app.screens["drive"], turned.app.shell
    finger = turned.hold(screen.stick)
    finger.touch_move(screen.stick.center_x, screen.stick.top - 10)
    turned.until(lambda: any(twist.linear.x > 0.05 for twist in robot.twists()), "does not drive")
    place = tuple(screen.stick.pos)
    turned.app.preferences.choose("hand", "left")
    shell.settle()
    assert tuple(screen.stick.pos) == place, "it moved under the finger"
    turned.stage.frames(3)
    moved = turned.app.screens["drive"].stick
    assert moved is not screen.stick
    assert moved.x > turned.app.shell.stop.right
    assert (moved.finger, moved.twist) == (None, Twist())
    turned.until(lambda: robot.twists()[-1].linear.x == 0.0, "goes on driving")
    finger.touch_move(finger.x + 5, finger.y)
    turned.stage.frames(3)
    assert robot.twists()[-1].linear.x == 0.0, "a finger that was there before drives nothing"
    finger.touch_up()


def test_a_stop_that_is_pressed_while_the_hand_changes_is_not_lost(turned: Glass, robot: FakeRobot) -> None:
    turned.app.preferences.choose("hand", "left")
    finger = turned.stage.touch(*turned.app.shell.stop.center)
    finger.touch_down()
    turned.stage.frames(3)
    turned.until(lambda: "/stop" in robot.services(), "not stopped")
    turned.until(lambda: turned.app.shell.stop.phase == "stopped", "the new button does not say so")
    finger.touch_up()
    turned.stage.run_for(2.0)
    assert "/stop/release" not in robot.services(), "a finger that pressed STOP has let nothing go"
    assert turned.app.shell.stop.phase == "stopped"


def test_a_hold_to_release_that_is_interrupted_releases_nothing(turned: Glass, robot: FakeRobot) -> None:
    turned.tap(turned.app.shell.stop)
    turned.until(lambda: turned.app.shell.stop.phase == "stopped", "not stopped")
    finger = turned.hold(turned.app.shell.stop)
    turned.stage.run_for(0.5)
    choose(turned, "left")
    turned.stage.run_for(2.0)
    assert turned.app.shell.stop.phase == "stopped"
    finger.touch_up()


def test_stop_stops_in_its_new_corner(turned: Glass, robot: FakeRobot) -> None:
    choose(turned, "left")
    turned.tap(turned.app.shell.stop)
    turned.until(lambda: "/stop" in robot.services(), "not stopped")
