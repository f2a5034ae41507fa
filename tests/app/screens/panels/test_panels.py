"""The panels screen: what is on it drives by the drive screen's own path and by no other, and lets go of itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import pytest

from app.layout.panel_grid import Place
from app.layout.views import Panel, View
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import PlaceCandidate, PlaceCandidates
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass, running
from tests.headless import Stage

VIEWS = (
    View(
        "Drive",
        (
            Panel("Joystick", wide=(0, 0, 4, 6), tall=(0, 0, 6, 6), short=(0, 0, 4, 4)),
            Panel("Compass", "/pose", stack="s"),
            Panel("LiftLever", forward="climb", left="", pad="", stack="s"),
        ),
    ),
    View("Other", (Panel("Battery", "/battery_state"),)),
)


@pytest.fixture
def panels(driving: Glass) -> Any:
    """The panels screen with a stick, and a lever behind a compass."""
    app = driving.app
    app.profiles.save(app.session.robot.info, replace(app.profiles.of(app.session.robot.info), views=VIEWS))
    app.show("panels")
    screen = app.screens["panels"]
    driving.until(lambda: screen.sticks and screen.sticks[0][0].state == "live", "no stick")
    driving.stage.frames(3)
    return screen


def stick_of(screen: Any) -> Any:
    return screen.shows.card_of(0).widget


def pushed(driving: Glass, robot: FakeRobot, screen: Any) -> Any:
    """A finger that has pushed the stick ahead, of which the robot has heard."""
    stick = stick_of(screen)
    x, y = stick.to_window(*stick.center)
    touch = driving.stage.touch(x, y)
    touch.touch_down()
    driving.stage.frames(2)
    touch.touch_move(x, y + stick.height * 0.3)
    driving.until(lambda: any(twist.linear.x > 0 for twist in robot.twists()), "the robot was not driven")
    return touch


def test_a_stick_on_a_view_drives_as_that_of_the_drive_screen_does(
    driving: Glass, robot: FakeRobot, panels: Any
) -> None:
    touch = pushed(driving, robot, panels)
    assert all(abs(twist.linear.x) <= 0.8 for twist in robot.twists()), "the robot's own limit"
    touch.touch_up()
    driving.until(lambda: robot.twists()[-1] == Twist(), "it was not told to rest")


def hidden(glass: Glass, screen: Any) -> None:
    first, *others = VIEWS[0].panels
    views = (View("Drive", (Panel("Joystick", hidden=True, wide=first.wide), *others)),)
    info = glass.app.session.robot.info
    glass.app.profiles.save(info, replace(glass.app.profiles.of(info), views=views))
    screen.reload()


def stacked(_: Glass, screen: Any) -> None:
    card = screen.shows.card_of(0)
    card.indices = [0, 1]
    card.dispatch("on_tab", 1)


def scrolled(_: Glass, screen: Any) -> None:
    board = screen.board
    card = screen.shows.card_of(0)
    others = [one for one in board.cards if one is not card]
    board.arrange([(card, board.place_of(card)), *((one, Place(0, 40, 3, 4)) for one in others)])
    board.scroll_y = 0.0


LETS_GO: dict[str, Callable[[Glass, Any], object]] = {
    "it is edited": lambda glass, screen: screen.editor.begin(),
    "another view comes": lambda glass, screen: screen.choose(1),
    "another screen comes": lambda glass, screen: glass.app.show("mission"),
    "it is hidden": hidden,
    "another profile is chosen": lambda glass, screen: (
        glass.app.profiles.choose(glass.app.session.robot.info, "") or screen.reload()
    ),
    "it lies behind another of its stack": stacked,
    "it is scrolled out of sight": scrolled,
    "its view is taken off the board": lambda _, screen: screen.shows.clear(),
}


@pytest.mark.parametrize("why", LETS_GO)
def test_a_stick_that_is_held_lets_go_and_its_finger_drives_no_longer_when(
    driving: Glass, robot: FakeRobot, panels: Any, why: str
) -> None:
    stick = stick_of(panels)
    touch = pushed(driving, robot, panels)
    LETS_GO[why](driving, panels)
    assert (stick.forward, stick.left) == (0.0, 0.0)
    driving.until(lambda: robot.twists()[-1] == Twist(), "it was not told to rest")
    heard = len(robot.twists())
    touch.touch_move(touch.x + 10, touch.y + 20)
    driving.stage.frames(30)
    assert all(twist == Twist() for twist in robot.twists()[heard:])
    assert (stick.forward, stick.left) == (0.0, 0.0)
    touch.touch_up()


def test_while_panels_are_edited_nothing_drives_by_finger_pad_or_key(
    driving: Glass, robot: FakeRobot, panels: Any
) -> None:
    panels.editor.begin()
    driving.stage.frames(3)
    assert (panels.sticks, panels.grips) == ([], [])
    stick = stick_of(panels)
    x, y = stick.to_window(*stick.center)
    touch = driving.stage.touch(x, y)
    touch.touch_down()
    driving.stage.frames(2)
    touch.touch_move(x, y + stick.height * 0.3)
    driving.stage.frames(20)
    assert (stick.forward, stick.left) == (0.0, 0.0)
    touch.touch_up()
    driving.stage.frames(5)
    assert all(twist == Twist() for twist in robot.twists())


def test_what_lies_behind_another_of_its_stack_drives_nothing(driving: Glass, panels: Any) -> None:
    kinds = [type(stick).__name__ for stick, _ in panels.sticks]
    assert kinds == ["Joystick"]
    panels.shows.card_of(1).dispatch("on_tab", 1)
    driving.stage.frames(2)
    assert [type(stick).__name__ for stick, _ in panels.sticks] == ["Joystick", "LiftLever"]


def test_messages_are_drawn_where_they_are_in_sight_alone(
    driving: Glass, robot: FakeRobot, panels: Any
) -> None:
    compass = panels.shows.card_of(1).widget
    robot.publish("/odom", Odometry())
    panels.shows.card_of(1).dispatch("on_tab", 1)
    shown: list[object] = []
    compass.show = shown.append
    driving.stage.frames(10)
    assert shown == []


def test_a_panel_of_a_camera_shows_no_other_cameras_pictures(
    driving: Glass, robot: FakeRobot, panels: Any
) -> None:
    session, profiles = driving.app.session, driving.app.profiles
    info = session.robot.info
    of = [Panel("Video", f"/camera/{camera}image/compressed") for camera in ("", "down/")]
    profiles.save(info, replace(profiles.of(info), views=(View("Cameras", tuple(of)),)))
    robot.publish("/robot/info", msgspec.structs.replace(info, cameras=["front", "down"]))
    driving.until(lambda: session.robot.info.cameras == ["front", "down"], "its cameras")
    panels.reload()
    first, second = (panels.shows.card_of(number) for number in range(2))
    for chosen, (shows, other) in (("/camera/", (first, second)), ("/camera/down/", (second, first))):
        driving.stage.frames(10)
        panels.shows.tick()
        assert panels.shows.videos == [shows.widget]
        assert panels.picture is shows.widget
        assert shows.problem == ""
        assert other.problem == f"Another camera is chosen: {chosen}image/compressed."
        assert other.ids.place.opacity == 0, "nor an old picture"
        session.cameras.choose_next()


def test_a_map_draws_a_robot_that_may_be_at_two_places_as_unsure(
    driving: Glass, robot: FakeRobot, panels: Any
) -> None:
    session, profiles = driving.app.session, driving.app.profiles
    info = session.robot.info
    view = View("Map", (Panel("GridMap", "/map", ("/pose",)),))
    profiles.save(info, replace(profiles.of(info), views=(view,)))
    panels.reload()
    shown = panels.shows.card_of(0).widget
    assert not shown.unsure
    asked = PlaceCandidates(
        candidates=[PlaceCandidate(1, 0.0, 0.0, 0.0, 0.6, 0.1), PlaceCandidate(2, 4.0, 0.0, 0.0, 0.4, 0.1)]
    )
    robot.publish("/localisation/candidates", asked)
    driving.until(lambda: shown.unsure, "it was drawn as sure")
    robot.publish("/localisation/candidates", PlaceCandidates())
    driving.until(lambda: not shown.unsure, "it was drawn as unsure")


def test_a_second_stick_for_the_same_is_refused_in_a_sentence(driving: Glass, panels: Any) -> None:
    panels.editor.begin()
    panels.editor.add_control("Joystick")
    driving.stage.frames(2)
    assert any("two controls for ahead" in text for text in driving.banners())
    assert len(panels.views[0].panels) == 3


@pytest.mark.slow
def test_a_panel_is_added_moved_and_resized_by_a_finger_undone_and_found_again_after_a_restart(
    stage: Stage, robot: FakeRobot, tmp_path: Path, fresh: None
) -> None:
    stage.window.size = (1280, 800)
    with running(stage, tmp_path) as glass:
        glass.app.open(robot.url)
        glass.drives()
        glass.app.show("panels")
        screen = glass.app.screens["panels"]
        glass.until(lambda: screen.acts.buttons["edit"].disabled is False, "nothing to edit")
        glass.tap(screen.acts.buttons["edit"])
        assert screen.editing
        count = len(screen.views[0].panels)
        screen.editor.add_control("LiftLever")
        card = screen.board.cards[-1]
        stage.frames(3)
        place = screen.board.place_of(card)
        across, up = screen.board.cell
        x, y = card.to_window(card.center_x, card.top - 60)
        stage.drag([(x, y), (x + 5, y - 5), (x + across * 2, y - up * 2)], frames=2)
        moved = screen.board.place_of(screen.board.cards[-1])
        assert (moved.left - place.left, moved.top - place.top) == (2, 2)
        corner = screen.board.corner
        x, y = corner.to_window(*corner.center)
        stage.drag([(x, y), (x + 5, y - 5), (x + across, y - up)], frames=2)
        sized = screen.board.place_of(screen.board.cards[-1])
        assert (sized.width, sized.height) == (moved.width + 1, moved.height + 1)
        glass.tap(screen.acts.buttons["undo"])
        assert screen.board.place_of(screen.board.cards[-1]) == moved
        glass.tap(screen.acts.buttons["redo"])
        glass.tap(screen.acts.buttons["done"])
        assert not screen.editing
    with running(stage, tmp_path) as glass:
        glass.app.open(robot.url)
        glass.drives()
        glass.app.show("panels")
        screen = glass.app.screens["panels"]
        stage.frames(3)
        assert len(screen.views[0].panels) == count + 1
        assert screen.board.place_of(screen.shows.card_of(count)) == sized
