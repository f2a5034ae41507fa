"""A phone on its side: the picture is the screen, for every robot's layout and with larger text; no card lies over a button."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import msgspec
import numpy as np
import pytest
from kivy.metrics import Metrics, sp

from app.layout.rects import Rect
from bridge.msgs.geometry_msgs import Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Check, Checklist, FlightState, RobotInfo
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.app.screens.drive.test_dive import AQUA
from tests.app.test_profiles import BOAT, DRONE, SCOUT, TRUCK
from widgets.core.base import text_texture

INFO = RobotInfo(name="Patrol-1", kind="wheels", model="patrol", max_speed=1.0, max_yaw_rate=2.0)
LEAST_FREE = 0.6
"""Of the picture; on the larger phone of the whole glass too, with bar and navigation."""
PHONES = ((892, 412), (740, 360))
ROBOTS = {"patrol": INFO, "scout": SCOUT, "commander": TRUCK, "minnow": BOAT, "ardrone": DRONE, "aqua": AQUA}


@pytest.fixture
def phone(driving: Glass) -> Iterator[Callable[[tuple[int, int]], None]]:
    """Give the window a size."""
    window, root, scale = driving.stage.window, driving.app.root, Metrics.fontscale
    before = tuple(window.size)

    def turn(size: tuple[int, int]) -> None:
        window.size = root.size = size
        driving.stage.frames(3)

    yield turn
    Metrics.fontscale = scale
    turn(before)


def met(driving: Glass, robot: FakeRobot, info: RobotInfo) -> Any:
    """The drive screen of a robot, with something to show in every place."""
    driving.app.show("drive")
    robot.publish("/robot/info", msgspec.structs.replace(info, name=f"{info.model}-1"))
    driving.until(lambda: driving.app.session.robot.info.model == info.model, "not met")
    driving.app.shell.replace("drive")
    pose = PoseWithCovarianceStamped(pose=PoseWithCovariance(pose=Pose()))
    flight = FlightState(phase="flying", height=2.0)
    for topic, said in (("/odom", Odometry()), ("/pose", pose), ("/flight", flight)):
        robot.publish(topic, said)
    driving.stage.run_for(0.3)
    return driving.app.screens["drive"]


def seen(widget: Any) -> bool:
    return bool(widget.opacity) and widget.right > 0 and widget.width > 0 and widget.height > 0


def lids(driving: Glass, *, checks: bool = True) -> list[Rect]:
    """All that lies over the picture or beside it, sticks by what they hide: in the window's pixels."""
    app = driving.app
    shell, screen = app.shell, app.screens["drive"]
    found = [shell.bar, shell.nav, shell.stop, *shell.notices.children, app.corner.button]
    rects = [Rect(*one.pos, *one.size) for one in found if one.parent is not None and seen(one)]
    for child in screen.children:
        if child is screen.video or child is screen.low or not seen(child):
            continue
        hidden = getattr(child, "hides", [(*child.pos, *child.size)])
        rects += [Rect(*one) for one in hidden]
    rects += screen.checks_place if checks else []
    if screen.video.show_chip:
        video, (wide, high) = screen.video, text_texture("640×480 · 14 fps · 123 ms", round(sp(12.5), 1)).size
        left, up = video.x + video.insets[0] + video.chip_inset + 8, video.top - video.insets[3] - 8
        rects.append(Rect(left, up - high - 5, min(video.chip_room, wide + 14), high + 5))
    return rects


def free(driving: Glass, area: Rect, *, checks: bool = True) -> float:
    """Share of `area` over which nothing lies, 0 to 1; the folded `checks` are away as soon as the robot has moved."""
    mask = np.ones((int(area.height), int(area.width)), bool)
    for lid in lids(driving, checks=checks):
        left, low = int(max(lid.x - area.x, 0)), int(max(lid.y - area.y, 0))
        right, top = int(max(lid.right - area.x, 0)), int(max(lid.top - area.y, 0))
        mask[low:top, left:right] = False
    return float(mask.mean())


@pytest.mark.parametrize("size", PHONES, ids=str)
def test_three_fifths_of_the_glass_are_free_while_any_robot_is_driven(
    driving: Glass, robot: FakeRobot, phone: Callable[..., None], size: tuple[int, int]
) -> None:
    measured = {}
    checks = [Check(name="stop", state="unknown", text="STOP was not tested since the start; press it once.")]
    for scale in (1.0, 1.3):
        Metrics.fontscale = scale
        for name, info in ROBOTS.items():
            screen = met(driving, robot, info)
            phone(size)
            robot.publish("/checklist", Checklist(checks=checks))
            driving.stage.run_for(0.2)
            assert not screen.checks.open, "folded until a finger unfolds it"
            for stick, _ in screen.sticks:
                stick.lean(0.6, 0.3)
            driving.stage.run_for(0.2)
            video = screen.video
            assert (video.x, video.right, video.y) == (driving.app.shell.nav.right, size[0], 0), name
            measured[name, scale] = (
                free(driving, Rect(0, 0, *size)),
                free(driving, Rect(*video.pos, *video.size)),
            )
            screen.rest()
    if size == PHONES[0]:
        low = {name: glass for name, (glass, _) in measured.items() if glass < LEAST_FREE}
        assert not low
    assert min(picture for _, picture in measured.values()) >= LEAST_FREE, measured


@pytest.mark.parametrize("scale", [1.0, 1.3])
def test_upright_65_percent_of_any_robots_picture_are_free_and_a_map_lies_on_it(
    driving: Glass, robot: FakeRobot, phone: Callable[..., None], scale: float
) -> None:
    Metrics.fontscale = scale
    for name, info in ROBOTS.items():
        screen = met(driving, robot, info)
        phone((412, 892))
        small, video = Rect(*screen.inset.frame.pos, *screen.inset.frame.size), screen.arranged["video"]
        assert min(small.width, small.height) >= 63, (name, "a finger hits it")
        assert video.holds(small), name
        assert free(driving, video, checks=False) >= 0.65, name
        screen.inset.frame.dispatch("on_release")
        driving.stage.frames(3)
        assert Rect(*screen.inset.map.pos, *screen.inset.map.size) == video, name
        screen.rest()


def test_three_figures_are_seen_while_driving_on_a_phones_side(
    driving: Glass, robot: FakeRobot, phone: Callable[..., None]
) -> None:
    screen = met(driving, robot, INFO)
    for size in PHONES:
        phone(size)
        assert len(screen.readouts.children) == 3, size
        card = screen._figures_card
        assert all(figure.x >= card.x and figure.right <= card.right for figure in screen.readouts.children)


@pytest.mark.parametrize("left", [False, True])
def test_for_either_hand_nothing_lies_over_a_stick_or_over_stop(
    driving: Glass, robot: FakeRobot, phone: Callable[..., None], left: bool
) -> None:
    driving.app.preferences.choose("hand", "left" if left else "right")
    driving.stage.frames(3)
    try:
        for name in ("patrol", "ardrone", "aqua"):
            screen = met(driving, robot, ROBOTS[name])
            for size in (*PHONES, (412, 892), (1280, 800)):
                phone(size)
                stop = Rect(*driving.app.shell.stop.pos, *driving.app.shell.stop.size)
                sticks = [Rect(*stick.pos, *stick.size) for stick, _ in screen.sticks]
                hands = [stop, *sticks]
                inset = getattr(screen, "inset", None)
                lids = [*screen.checks_place, *([Rect(*inset.frame.pos, *inset.frame.size)] if inset else [])]
                lids += [Rect(*screen.handle.pos, *screen.handle.size)]
                assert not any(lid.overlaps(hand) for lid in lids for hand in hands), (name, size)
                assert not any(stick.overlaps(stop) for stick in sticks), (name, size)
    finally:
        driving.app.preferences.choose("hand", "right")
        driving.stage.frames(3)


def test_the_drawer_comes_out_by_a_tap_and_a_pull_and_the_stick_stays_under_the_thumb(
    driving: Glass, robot: FakeRobot, phone: Callable[..., None]
) -> None:
    screen = met(driving, robot, INFO)
    phone(PHONES[0])
    pushed, fader = screen.stick, screen.speed.ids.fader
    assert fader.right < 0, "in the drawer"
    driving.tap(screen.handle)
    driving.until(lambda: screen.handle.pulled, "stays shut")
    driving.stage.frames(3)
    assert fader.x > 0
    assert not Rect(*screen.sheet.pos, *screen.sheet.size).overlaps(Rect(*pushed.pos, *pushed.size))
    finger = driving.stage.touch(*screen.handle.center)
    finger.touch_down()
    finger.touch_move(screen.handle.center_x, screen.handle.center_y + 60)
    driving.stage.frames(1)
    finger.touch_up()
    driving.until(lambda: not screen.handle.pulled, "stays out")
    assert driving.app.pages.back() is False, "nothing is left to go back from"


def test_back_pushes_the_drawer_in_first_and_what_is_in_it_lets_go(
    driving: Glass, robot: FakeRobot, phone: Callable[..., None]
) -> None:
    screen = met(driving, robot, BOAT)
    phone(PHONES[0])
    screen.pull(out=True)
    driving.stage.frames(3)
    dial = next(widget for widget in screen.places["top_right"] if widget in screen.hands.grips)
    spots = [(dial.x + across, dial.y + up) for across in range(4, 140, 8) for up in range(4, 140, 8)]
    held = driving.stage.touch(*next(spot for spot in spots if dial.holds(*spot)))
    held.touch_down()
    assert dial.finger is not None
    assert driving.app.back()
    driving.stage.frames(3)
    assert not screen.handle.pulled
    assert dial.finger is None
    held.touch_up()


@pytest.mark.parametrize("size", [*PHONES, (412, 892), (360, 740)], ids=str)
@pytest.mark.parametrize("name", ["patrol", "ardrone", "aqua"])
def test_no_card_lies_over_anything_that_is_touched_to_drive(
    driving: Glass, robot: FakeRobot, phone: Callable[..., None], size: tuple[int, int], name: str
) -> None:
    screen = met(driving, robot, ROBOTS[name])
    phone(size)
    checks = [Check(name="stop", state="unknown", text="STOP was not tested since the start; press it once.")]
    robot.publish("/checklist", Checklist(checks=checks))
    shell = driving.app.shell
    cards = {
        "checks": lambda: None,
        "toast": lambda: shell.say("The camera sends nothing, and has sent nothing for 12 s.", "warn"),
        "offer": lambda: shell.notices.offer("Deleted: the mission of the yard.", "Undo", lambda: None),
        "mode": shell.cards.ask_mode,
    }
    for card, show in cards.items():
        show()
        driving.stage.run_for(0.3)
        places = [Rect(*one.pos, *one.size) for one in shell.notices.children] + screen.checks_place
        hands = [screen.handle, shell.stop, *(stick for stick, _ in screen.sticks), *screen.grips]
        for widget in (one for one in hands if seen(one)):
            there = Rect(*widget.pos, *widget.size)
            assert not any(place.overlaps(there) for place in places), (card, type(widget).__name__)
    assert len(shell.notices.children) >= 2
