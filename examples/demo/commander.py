"""The commander's story: a truck that turns only by driving, in a car park."""

from __future__ import annotations

import math
import time
from typing import Any

from examples.demo.scene import Scene, Wait
from examples.demo.vehicle import (
    act,
    keep_pushing,
    on_phone,
    push,
    release,
    send_and_start,
    slide_speed,
    stop,
)

__all__ = ["TOPICS", "play"]

TOPICS = ("/ackermann",)
STANDING_SPEED = 0.03
"""A robot on wheels that is slower stands [m/s]."""
CRAWL, WALK = 0.0, 0.12
"""Where the slider is put, a share of its way."""
POINTS = ((-4.0, -7.4), (6.0, -6.6))
"""On ahead along the southern aisle, (x, y) in `map` [m]."""
BEHIND = (-9.0, -8.2)
"""Where it comes to only by a turn as wide as its circle, (x, y) in `map` [m]."""
PASSED = 0.7
"""A point counts as passed within this [m]."""


def play(scene: Scene) -> Wait:
    """Drive, STOP, and have it patrol points."""
    yield from _crawl(scene)
    yield from _bend(scene)
    yield from _back(scene)
    yield from _stop(scene)
    yield from release(scene, STANDING_SPEED)
    stick: Any = scene.glass.all("Joystick")[0]
    yield from on_phone(scene, lambda: [push(scene, stick, 0.0, 0.9)], 2.5)
    yield from _patrol(scene)


def _crawl(scene: Scene) -> Wait:
    """As slow as the slider goes."""
    glass, witness = scene.glass, scene.witness
    stick: Any = yield from glass.one("Joystick")
    with scene.step("slow") as check:
        slowest = yield from slide_speed(scene, CRAWL)
        fingers = yield from keep_pushing(
            scene, lambda: [push(scene, stick, 0.0, 1.0)], lambda: witness.fast(1.0) >= 0.95 * slowest
        )
        off = abs(witness.fast(1.0) - slowest)
        check(f"as fast as the slider says, {slowest:.2f} m/s [m/s off, at most 0.05]", off, off <= 0.05)
        scene.hand.up(fingers[0])
        yield from scene.rest(3)


def _bend(scene: Scene) -> Wait:
    """Round to the right, faster."""
    glass, witness = scene.glass, scene.witness
    stick: Any = yield from glass.one("Joystick")
    with scene.step("driven") as check:
        yield from slide_speed(scene, WALK)
        fingers = yield from keep_pushing(
            scene,
            lambda: [push(scene, stick, -0.6, 0.8)],
            lambda: _steered(scene) < -0.15 and witness.speed() > 0.3,
        )
        yield from scene.robot_time(1)
        since, before = witness.now, witness.truth[3]
        bends = yield from _bends(scene, since)
        scene.report.snapshot("driving")
        way, angle = witness.driven(since), math.remainder(witness.truth[3] - before, math.tau)
        check("it turns to the right [rad]", angle, angle < -0.2)
        real, told = way / angle if angle else math.inf, 1 / (sum(bends) / len(bends))
        off = abs(told / real - 1)
        check(f"its radius is {real:.2f} m, as the statistics say [part off, at most 0.15]", off, off <= 0.15)
        check("the front wheels are steered [deg]", math.degrees(_steered(scene)), _steered(scene) < -0.1)
        scene.hand.up(fingers[0])
        yield from scene.rest(3)


def _back(scene: Scene) -> Wait:
    """Backwards, by what the rear camera sees."""
    glass, witness = scene.glass, scene.witness
    stick: Any = yield from glass.one("Joystick")
    with scene.step("rear") as check:
        yield from act(scene, "Camera")
        shown = yield from glass.soon(lambda: glass.shows("rear"), 5)
        check("the rear camera is on the glass", bool(shown), bool(shown))
        fingers = yield from keep_pushing(
            scene, lambda: [push(scene, stick, 0.0, -0.8)], lambda: witness.speed() > 0.5
        )
        scene.report.snapshot("backwards")
        check("it drives backwards [m/s]", witness.speed(), witness.speed() > 0.3)
        scene.hand.up(fingers[0])
        yield from scene.rest(3)
        yield from act(scene, "Camera")
        yield from glass.pause(0.5)


def _stop(scene: Scene) -> Wait:
    """STOP with the stick pushed all the way."""
    stick: Any = yield from scene.glass.one("Joystick")
    card: Any = scene.glass.all("SpeedCard")[0]
    fingers = yield from keep_pushing(
        scene,
        lambda: [push(scene, stick, 0.0, 1.0)],
        lambda: scene.witness.speed() >= 0.9 * card.maximum_speed,
    )
    yield from stop(scene, fingers, STANDING_SPEED)


def _bends(scene: Scene, since: float) -> Wait:
    """Drive on for three metres; returns how the way was bent, as the statistics had it [1/m], positive to the left."""
    bends, end = [], time.monotonic() + 20
    while scene.witness.driven(since) < 3.0 and time.monotonic() < end:
        bends.append(1 / scene.witness["/ackermann"].turning_radius)
        yield
    return bends


def _steered(scene: Scene) -> float:
    """Of the front wheels [rad]; 0 before it is known."""
    told = scene.witness["/ackermann"]
    return float(told.steering) if told is not None else 0.0


def _patrol(scene: Scene) -> Wait:
    """Points on the map, the last one where it can only come by a wide turn."""
    glass, witness = scene.glass, scene.witness
    wanted = [*POINTS, BEHIND]
    with scene.step("points") as check:
        yield from glass.press("Mission", kind="NavButton")
        chart: Any = yield from glass.one("MapOverlay")
        yield from glass.press("Points", kind="Segment")
        for point in wanted:
            yield from scene.hand.tap(scene.on_map(*point))
            yield from glass.pause(0.15)
        off = max(map(math.dist, chart.waypoints, wanted), default=math.inf)
        check(
            "each tap is a point where the finger was [m off]", off, len(chart.waypoints) == 3 and off <= 0.12
        )
    with scene.step("patrolling") as check:
        since = witness.now
        runs = yield from send_and_start(scene, wanted)
        check("the truck patrols", runs, runs)
        yield from scene.robot_time(6)
    with scene.step("patrolled") as check:
        passed = yield from glass.soon(lambda: witness.nearest(*BEHIND, since) <= PASSED, 60)
        worst = max(witness.nearest(*point, since) for point in wanted)
        check(f"every point was passed [m off, at most {PASSED:g}]", worst, bool(passed) and worst <= PASSED)
        tight = _tightest(scene, since)
        check(
            "and no turn was tighter than it can drive [m, at least its least radius 2.4]",
            tight,
            tight >= 2.4,
        )
        check("no contacts", witness.contacts, witness.contacts == 0)


def _tightest(scene: Scene, since: float) -> float:
    """Least radius of a turn over ways of a metre [m]."""
    poses, least = scene.witness.since(since), math.inf
    first, way = 0, 0.0
    for number in range(1, len(poses)):
        way += math.dist(poses[number][1:3], poses[number - 1][1:3])
        if way >= 1.0:
            angle = abs(math.remainder(poses[number][3] - poses[first][3], math.tau))
            least = min(least, way / angle if angle else math.inf)
            first, way = number, 0.0
    return least
