"""The minnow's story: a boat on a lake with waves, by rudder and throttle, by a course, by waypoints."""

from __future__ import annotations

import math
from typing import Any

from bridge.core.units import yaw_from_heading
from examples.demo.scene import Scene, Wait
from examples.demo.vehicle import (
    act,
    at,
    keep_pushing,
    on_phone,
    push,
    release,
    send_and_start,
    slide_speed,
    stop,
    turned,
)

__all__ = ["TOPICS", "play"]

TOPICS = ("/rudder", "/compass")
DRIFTS, RUNS_OUT = 0.35, 5.0
"""Current and waves take a boat along that fast [m/s]; the water takes the way off it within this [s]."""
COURSE = 65.0
"""That is set on the dial [deg], 0 north, clockwise: past the pier, south of the buoys."""
HELD = math.radians(6)
"""A course is held so well [rad], waves and wind and all."""
POINTS = ((-4.0, -20.0), (-8.0, -14.0))
"""Off the first buoys, (x, y) in `map` [m]."""
HOME = (-14.0, -20.0)
PASSED = 3.0
"""A point counts as passed within this [m]: waves and current take a boat past it."""


def play(scene: Scene) -> Wait:
    """Drive, STOP, keep a course, go round points and home."""
    yield from _drive(scene)
    yield from release(scene, DRIFTS)
    helm: Any = scene.glass.all("RudderThrottle")[0]
    yield from on_phone(scene, lambda: [push(scene, helm, 0.4, 0.9)], 3.0)
    yield from _course(scene)
    yield from _points(scene)


def _drive(scene: Scene) -> Wait:
    glass, witness = scene.glass, scene.witness
    helm: Any = yield from glass.one("RudderThrottle")
    with scene.step("driven") as check:
        before = witness.truth[3]
        fingers = yield from keep_pushing(
            scene,
            lambda: [push(scene, helm, -0.8, 0.9)],
            lambda: math.remainder(before - witness.truth[3], math.tau) > 0.4,
        )
        told = witness["/rudder"]
        check("the rudder is laid to the right [rad]", told.angle, told.angle < -0.2)
        angle = math.remainder(before - witness.truth[3], math.tau)
        check("and the boat turns to the right [rad]", angle, angle > 0.3)
        scene.report.snapshot("driving")
        scene.hand.up(fingers[0])
        yield from glass.pause(0.3)
        yield from slide_speed(scene, 1.0)
        fingers = yield from keep_pushing(
            scene, lambda: [push(scene, helm, 0.0, 1.0)], lambda: witness.speed() > 1.2
        )
        check("throttle gives way [m/s, at least 1]", witness.speed(), witness.speed() >= 1.0)
    yield from stop(scene, fingers, DRIFTS, RUNS_OUT, drifts=True)


def _course(scene: Scene) -> Wait:
    """Set on the dial by a finger that rests on its rim and goes along it, and held."""
    glass, witness = scene.glass, scene.witness
    wanted = yaw_from_heading(COURSE)
    with scene.step("course") as check:
        dial: Any = yield from glass.one("CourseDial")
        x, y, radius = dial.place
        ways = [COURSE - 60.0, COURSE - 30.0, COURSE]
        rim = [
            (x + 0.86 * radius * math.sin(math.radians(one)), y + 0.86 * radius * math.cos(math.radians(one)))
            for one in ways
        ]
        finger = scene.hand.down(at(dial, *rim[0]))
        held = yield from glass.soon(lambda: dial.dragged, 5)
        check("a finger that rests on the rim takes hold of a course", bool(held), bool(held))
        for point in rim[1:]:
            scene.hand.move(finger, at(dial, *point))
            yield from glass.pause(0.1)
        scene.hand.up(finger)
        runs = yield from glass.soon(lambda: scene.task("follow_heading"), 5)
        check("let go, the dial sets the course and the boat follows it", bool(runs), bool(runs))
        order = yield from glass.soon(lambda: _course_of(scene, wanted), 5)
        check(f"which is {COURSE:g}°", bool(order), bool(order))
    with scene.step("on-course") as check:
        yield from glass.soon(lambda: turned(witness.truth[3], wanted) < HELD / 2, 25)
        yield from glass.soon(lambda: witness.speed() > 0.5, 10)
        yield from scene.robot_time(1)
        since = witness.now
        yield from scene.robot_time(5)
        headings = [turned(pose[3], wanted) for pose in witness.since(since)]
        worst, mean = max(headings), sum(headings) / len(headings)
        check("for 5 s it is held [deg off at most, at most 6]", math.degrees(worst), worst <= HELD)
        check("on the whole [deg off]", math.degrees(mean), mean <= HELD / 2)
        check("with way on it [m/s]", witness.fast(3.0), witness.fast(3.0) > 0.5)


def _course_of(scene: Scene, yaw: float) -> bool:
    order = scene.witness["/manoeuvre"]
    return order is not None and order.kind == "course" and turned(order.yaw, yaw) < 0.05


def _points(scene: Scene) -> Wait:
    """Two waypoints and home, set on the map."""
    glass, witness = scene.glass, scene.witness
    with scene.step("points") as check:
        yield from glass.press("Mission", kind="NavButton")
        chart: Any = yield from glass.one("MapOverlay")
        if scene.task("follow_heading"):
            yield from glass.press("End", kind="PushButton")
            yield from glass.soon(lambda: not scene.task("follow_heading"), 5)
        yield from glass.press("Points", kind="Segment")
        for point in POINTS:
            yield from scene.hand.tap(scene.on_map(*point))
            yield from glass.pause(0.15)
        yield from glass.press("Home", kind="Segment")
        yield from scene.hand.tap(scene.on_map(*HOME))
        off = max(map(math.dist, chart.waypoints, POINTS), default=math.inf)
        check(
            "each tap is a point where the finger was [m off]", off, len(chart.waypoints) == 2 and off <= 0.25
        )
        yield from glass.press("View", kind="Segment")
    with scene.step("patrolled") as check:
        since = witness.now
        runs = yield from send_and_start(scene, POINTS)
        check("the boat goes round its points", runs, runs)
        yield from glass.soon(lambda: witness.nearest(*POINTS[1], since) <= PASSED, 50)
        worst = max(witness.nearest(*point, since) for point in POINTS)
        check(f"every point was passed [m off, at most {PASSED:g}]", worst, worst <= PASSED)
        check("no contacts", witness.contacts, witness.contacts == 0)
    with scene.step("home") as check:
        yield from act(scene, "Home" if not glass.labelled("Go home") else "Go home")
        runs = yield from glass.soon(lambda: scene.task("go_home"), 5)
        check("sent home it turns back", bool(runs), bool(runs))
        done = yield from glass.soon(lambda: scene.task("go_home", "SUCCEEDED"), 40)
        off = witness.distance(*HOME)
        check("it says that it is home", bool(done), bool(done))
        check(f"and it is [m off, at most {PASSED:g}]", off, off <= PASSED)
