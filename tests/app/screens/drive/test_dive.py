"""A swimmer before the app: its screen comes by itself, its hands make one order, its actions reach the robot."""

from __future__ import annotations

from typing import Any

import pytest

from app.layout.rects import Rect
from bridge.msgs.arrays import Float32Array
from bridge.msgs.pilothouse_msgs import LineSensor, Manoeuvre, RobotInfo, StartTaskRequest
from bridge.msgs.sensor_msgs import LaserScan
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.tasks.order_numbers import FormRow

AQUA = RobotInfo(
    name="Aqua-1",
    kind="hexapod",
    dives=True,
    model="aqua",
    max_speed=0.7,
    max_yaw_rate=0.8,
    max_climb=0.3,
    max_tilt=0.5,
    cameras=["front", "rear"],
    tasks=["hold", "surface", "go_home"],
    manoeuvres=["twist", "course", "tilt", "hover", "surface", "rest"],
)
TAB, ENTER = 9, 13
"""Key codes."""


@pytest.fixture
def diving(driving: Glass, robot: FakeRobot) -> Any:
    robot.publish("/robot/info", AQUA)
    driving.until(lambda: hasattr(driving.app.screens["drive"], "column"), "not in three columns")
    screen = driving.app.screens["drive"]
    driving.until(lambda: screen.column.actions and screen.column.actions[0].able, "no actions")
    return screen


def test_a_swimmer_has_three_columns_with_what_it_knows_and_nothing_is_half_seen(diving: Any) -> None:
    assert [action.name for action in diving.column.actions] == [
        *("task.surface", "task.hold", "lights", "record", "camera", "snapshot", "task.go_home")
    ]
    assert diving.instruments.places["motion"][0].under_water
    (depth,) = diving.places["corner"]
    diving.clear(Rect(depth.x + 5, depth.y + 5, 50, 50))
    assert (depth.opacity, depth.right < 0) == (0, True)
    diving.clear(None)
    assert (depth.opacity, depth.x > 0) == (1, True)


def test_its_hands_make_one_order_of_all_that_they_say(driving: Glass, robot: FakeRobot, diving: Any) -> None:
    driving.until(lambda: diving.stick.state == "live", "no stick")
    stick, lift, tilt = (one for one, _ in diving.sticks)
    said: list[Any] = []
    diving.session.link.drive = said.append
    stick.lean(1.0, 0.0)
    lift.lean(-1.0, 0.0)
    tilt.lean(0.0, -1.0)
    order = said[-1]
    assert isinstance(order, Manoeuvre)
    assert (order.kind, order.speed, order.twist.linear.z) == ("tilt", 0.7, -0.3)
    assert order.roll == pytest.approx(0.5)
    diving.rest()
    assert not any(part for part in (stick.forward, lift.forward, tilt.left))


def _reach(driving: Glass, words: str) -> None:
    """Step and go into groups by two keys until that is marked alone."""
    engine = driving.app.methods.get("switches").engine
    for _ in range(40):
        mark = engine.scan.mark
        if mark is not None and mark.kind == "item" and mark.words.startswith(words):
            return
        inside = mark is not None and any(one.words.startswith(words) for one in mark.targets)
        driving.stage.key(ENTER if inside else TAB)
    raise AssertionError(f"{words} is not reached")


def test_two_switches_and_fingers_reach_the_actions_and_the_robot_hears_of_it(
    driving: Glass, robot: FakeRobot, diving: Any
) -> None:
    assert diving.column.hint == "Tab next · Enter do it"
    driving.app.methods.get("switches").change(debounce=0.0, ignore_repeat=0.0)
    _reach(driving, "Hold depth")
    assert not any(name == "/task/start" for name, _ in robot.asked)
    driving.stage.key(ENTER)
    driving.until(lambda: any(name == "/task/start" for name, _ in robot.asked), "not asked")
    (request,) = (request for name, request in robot.asked if name == "/task/start")
    assert isinstance(request, StartTaskRequest)
    assert request.order.task == "hold"

    watched: list[Any] = []
    diving.session.link.watch = watched.append
    driving.tap(next(key for key in diving.column.grid.children if key.name == "Camera"))
    driving.until(lambda: watched == ["rear"], "not watched")


def test_its_tasks_screen_offers_what_it_knows_and_asks_for_a_depth(driving: Glass, diving: Any) -> None:
    driving.app.show("tasks")
    tasks = driving.app.screens["tasks"]
    driving.until(lambda: len(tasks.pane.chooser.tasks) == 3, "all tasks are offered")
    assert list(tasks.pane.chooser.tasks) == ["go_home", "hold", "surface"]
    tasks.begin("hold")
    driving.stage.frames(2)
    assert next(row.title for row in tasks.pane.form.walk() if isinstance(row, FormRow)) == "Depth"
    assert tasks.ids["go"].disabled


def test_what_a_swimmer_carries_is_on_a_strip_over_the_picture_that_unfolds(
    driving: Glass, robot: FakeRobot, diving: Any
) -> None:
    assert not diving.senses.shown
    top = diving.video.insets[3]
    robot.publish("/line_sensor", LineSensor(values=Float32Array([0.1, 0.8])))
    robot.publish("/scan", LaserScan(angle_increment=0.1, range_max=9.0, ranges=Float32Array([1.0, 2.0])))
    driving.until(lambda: len(diving.senses.shown) == 2, "it is nowhere to be seen")
    assert [type(one).__name__ for one in diving.senses.shown] == ["LineSensorView", "LaserScanView"]
    driving.stage.frames(2)
    assert diving.senses.folded
    assert diving.video.insets[3] > top, "the picture's own words keep clear of it"
    driving.tap(diving.senses)
    driving.stage.frames(2)
    (depth,) = diving.places["corner"]
    room = Rect(*diving.senses.pos, *diving.senses.size)
    assert not diving.senses.folded
    assert room.overlaps(diving.arranged["corner"]) == (depth.right < 0), "nothing is seen only in part"
    diving.clear(room)
    assert diving.senses.right < 0
    diving.clear(None)
    assert diving.senses.x > 0


@pytest.mark.parametrize(
    ("size", "form"), [((1204, 744), "wide"), ((824, 364), "short"), ((412, 776), "tall")]
)
def test_the_small_map_and_the_picture_swap_and_every_control_stays_where_it_is(
    diving: Any, size: tuple[int, int], form: str
) -> None:
    body = Rect(0, 0, *size)

    def places() -> tuple[Rect, Rect, list[Rect]]:
        diving.arrange(body, form, 1.0)
        hands = [Rect(*one.pos, *one.size) for one, _ in diving.sticks]
        map_, video = diving.inset.map, diving.video
        return Rect(*map_.pos, *map_.size), Rect(*video.pos, *video.size), hands

    small, large, hands = places()
    assert large.holds(small)
    assert large == diving.arranged["video"]
    assert not any(one.overlaps(small) for one in hands)
    diving.inset.swap(diving)
    assert places() == (large, small, hands)
    order = list(reversed(diving.children))
    assert order[:3] == [diving.inset.map, diving.video, diving.inset.frame], "every control lies above both"
    diving.inset.swap(diving)
    assert places() == (small, large, hands)
    diving.clear(small)
    assert diving.inset.frame.right < 0, "what is said takes it off the glass"
