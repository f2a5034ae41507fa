"""The first half of the patrol story: set the robot's pose, set points and home, send them."""

from __future__ import annotations

import math
from typing import Any

from bridge.core.codes import Code
from examples.demo.ground import EXTRA, HOME, MISPLACED, PATROL
from examples.demo.scene import Scene, Wait

__all__ = ["edit_points", "initialise", "send", "set_home_and_motion", "tap_points"]

WRONG = (2.0, -1.0, 0.7)
"""Error of the first pose that the robot is given: x, y [m], yaw [rad]."""
NEAR = 0.12
"""A finger puts a thing on the map to this [m]."""


def initialise(scene: Scene) -> Wait:
    """Give the robot a wrong pose, which it does not believe for long, and then its own."""
    _, x, y, yaw = scene.witness.truth
    with scene.step("misplaced") as check:
        yield from _place(scene, x + WRONG[0], y + WRONG[1], yaw + WRONG[2])
        yield from scene.glass.soon(lambda: _found(scene), 60)
        check("told wrongly, the robot says that it is elsewhere", _found(scene), _found(scene))
        # the event comes before the next pose
        yield from scene.glass.soon(lambda: scene.off()[0] <= 0.3, 4)
        check("which is where it is [m off, at most 0.3]", scene.off()[0], scene.off()[0] <= 0.3)
    with scene.step("initialised") as check:
        yield from _place(scene, x, y, yaw)
        yield from scene.glass.soon(lambda: scene.off()[0] < 0.15, 4)
        yield from scene.robot_time(2)
        metres, radians = scene.off()
        check("the robot knows where it is [m off, at most 0.3]", metres, metres <= 0.3)
        check("and how it is turned [deg off, at most 5]", math.degrees(radians), radians <= math.radians(5))


def _found(scene: Scene) -> bool:
    return any(event.code == Code.POSITION_FOUND for event in scene.witness.events)


def _place(scene: Scene, x: float, y: float, yaw: float) -> Wait:
    yield from scene.glass.press("Robot", kind="Segment")
    chart: Any = scene.map()
    placed = yield from scene.glass.until(lambda: list(chart.placed), 3, "the robot to be placed")
    yield from scene.hand.drag([scene.on_map(*placed[:2]), scene.on_map(x, y)])
    handle = chart.handle_place()
    reach = math.dist(handle, chart.placed[:2])
    turned = scene.on_map(x + reach * math.cos(yaw), y + reach * math.sin(yaw))
    yield from scene.hand.drag([scene.on_map(*handle), turned])
    scene.report.snapshot("placing")
    yield from scene.glass.press("Set here")
    yield from scene.glass.pause(0.3)


def tap_points(scene: Scene) -> Wait:
    """Tap the patrol points; one lands in a wrong place, one is too many, two are in the wrong order."""
    with scene.step("points") as check:
        yield from scene.glass.press("Points", kind="Segment")
        index, wrong = MISPLACED
        wanted = [*PATROL, EXTRA]
        wanted[index] = wrong
        wanted[3], wanted[4] = wanted[4], wanted[3]
        for point in wanted:
            yield from scene.hand.tap(scene.on_map(*point))
            yield from scene.glass.pause(0.1)
        check(
            "each tap is a point where the finger was [m off]",
            _worst(scene, wanted),
            _worst(scene, wanted) <= NEAR,
        )


def edit_points(scene: Scene) -> Wait:
    """Drag, reorder, delete, undo."""
    index, wrong = MISPLACED
    swapped = [*PATROL, EXTRA]
    swapped[3], swapped[4] = swapped[4], swapped[3]
    with scene.step("dragged") as check:
        yield from scene.hand.drag([scene.on_map(*wrong), scene.on_map(*PATROL[index])])
        check(
            "a dragged point is where it was let go [m off]",
            _worst(scene, swapped),
            _worst(scene, swapped) <= NEAR,
        )
    with scene.step("reordered") as check:
        yield from scene.hand.tap(scene.on_map(*PATROL[3]))
        yield from scene.glass.press_icon("arrow_upward")
        yield from scene.glass.pause(0.2)
        ordered = [*PATROL, EXTRA]
        check(
            "the order is the one of the patrol [m off]",
            _worst(scene, ordered),
            _worst(scene, ordered) <= NEAR,
        )
    with scene.step("deleted") as check:
        yield from _delete(scene, EXTRA)
        yield from _delete(scene, PATROL[5])
        check("two points are gone", _points(scene), _points(scene) == len(PATROL) - 1)
    with scene.step("undone") as check:
        yield from scene.glass.press_icon("undo")
        yield from scene.glass.pause(0.2)
        check("undo brings the last one back [m off]", _worst(scene, PATROL), _worst(scene, PATROL) <= NEAR)


def _delete(scene: Scene, point: tuple[float, float]) -> Wait:
    yield from scene.hand.tap(scene.on_map(*point))
    yield from scene.glass.press_icon("delete")
    yield from scene.glass.pause(0.2)


def set_home_and_motion(scene: Scene) -> Wait:
    """Set home, and look at each motion before choosing."""
    glass = scene.glass
    with scene.step("home") as check:
        yield from glass.press("Home", kind="Segment")
        yield from scene.hand.tap(scene.on_map(*HOME))
        yield from glass.pause(0.2)
        off = math.dist(list(_chart(scene).home) or (math.inf, math.inf), HOME)
        check("home is where the finger was [m off]", off, off <= NEAR)
    with scene.step("motion") as check:
        yield from glass.sheet(1)
        selector: Any = yield from glass.reach("MotionSelector")
        for words in ("Random", "Intermittent"):
            yield from glass.press(words, kind="Segment")
            yield from glass.pause(0.15)
        check("the motion chosen", selector.motion_name, selector.motion_name == "intermittent")
        dwell = selector.dwell
        minus = yield from glass.until(lambda: _minus(scene), 2, "the dwell's minus")
        for _ in range(4):
            yield from glass.tap(minus[0])
        check("the dwell is 4 s shorter [s]", selector.dwell, selector.dwell == dwell - 4)
        yield from glass.sheet(0)
        yield from glass.press("View", kind="Segment")


def _minus(scene: Scene) -> list[Any]:
    ends: list[Any] = scene.glass.all("StepperEnd")
    return sorted(
        (end for end in ends if end.step < 0 and not end.disabled),
        key=lambda end: -end.to_window(*end.pos)[1],
    )


def send(scene: Scene) -> Wait:
    """Send the mission; the robot stores it."""
    with scene.step("sent") as check:
        yield from scene.glass.sheet(1)
        yield from scene.glass.reach("SendRow")
        yield from scene.glass.press("Send")
        yield from scene.glass.soon(lambda: len(_stored(scene)) == len(PATROL), 5)
        off = max(map(math.dist, _stored(scene), PATROL), default=math.inf)
        check(
            "the robot has stored these points [m off]",
            off,
            len(_stored(scene)) == len(PATROL) and off <= NEAR,
        )
        told = yield from scene.glass.soon(lambda: scene.glass.shows("Stored on the robot"), 3)
        check("the app says that they are stored", bool(told), bool(told))
        yield from scene.glass.sheet(0)


def _stored(scene: Scene) -> list[tuple[float, float]]:
    mission = scene.witness["/mission"]
    return [(point.x, point.y) for point in mission.waypoints] if mission is not None else []


def _chart(scene: Scene) -> Any:
    return scene.map()


def _points(scene: Scene) -> int:
    return len(_chart(scene).waypoints)


def _worst(scene: Scene, wanted: Any) -> float:
    got = list(_chart(scene).waypoints)
    return max(map(math.dist, got, wanted), default=math.inf) if len(got) == len(wanted) else math.inf
