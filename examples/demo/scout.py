"""The scout's story: an office, sixteen sonars, a stick or a goal that is set in steps."""

from __future__ import annotations

import math
from typing import Any

from examples.demo.scene import Scene, Wait
from examples.demo.vehicle import at, keep_pushing, on_phone, push, release, slide_speed, stop, turned

__all__ = ["TOPICS", "play"]

TOPICS = ("/sonar",)
GOAL = (-9.9, 4.9, math.pi / 2)
"""Behind a person who is on no map: x, y [m], yaw [rad]."""
STEP = 0.25
"""Of the pad [m]."""
STEPS = 60
"""So many taps are enough for any goal in the room."""
PERSON = (-9.9, 3.4)
OFF_THE_WALL = math.radians(27)
"""Heading when it is driven by hand [rad]: into the corridor."""
STANDING_SPEED = 0.03
"""A robot on wheels that is slower stands [m/s]."""
REACHED = 0.3


def play(scene: Scene) -> Wait:
    """Drive, STOP, and send it somewhere."""
    yield from _drive(scene)
    yield from release(scene, STANDING_SPEED)
    stick: Any = scene.glass.all("Joystick")[0]
    yield from on_phone(scene, lambda: [push(scene, stick, 0.7, 0.4)])
    yield from _go(scene)


def _drive(scene: Scene) -> Wait:
    glass, witness = scene.glass, scene.witness
    stick: Any = yield from glass.one("Joystick")
    with scene.step("driven") as check:
        fingers = yield from keep_pushing(
            scene, lambda: [push(scene, stick, 0.5, 0.0)], lambda: witness.truth[3] > OFF_THE_WALL - 0.3
        )
        scene.hand.up(fingers[0])
        yield from scene.rest(3)
        off = turned(witness.truth[3], OFF_THE_WALL)
        check("the stick turns it to where it should look [rad off, at most 0.3]", off, off <= 0.3)
        fastest = yield from slide_speed(scene, 1.0)
        fingers = yield from keep_pushing(
            scene, lambda: [push(scene, stick, 0.0, 1.0)], lambda: witness.speed() >= 0.9 * fastest
        )
        fast = witness.speed()
        check(f"it is as fast as the slider says, {fastest:.2f} [m/s]", fast, fast >= 0.85 * fastest)
        scene.report.snapshot("driving")
    yield from stop(scene, fingers, STANDING_SPEED)


def _go(scene: Scene) -> Wait:
    """A goal in steps, and the way there."""
    glass, witness = scene.glass, scene.witness
    with scene.step("goal") as check:
        yield from glass.press("Goal", kind="Segment")
        pad: Any = yield from glass.one("GoalPad")
        yield from glass.until(lambda: pad.actual, 3, "the pad to know where the robot is")
        yield from _tap(scene, pad, "here")
        for _ in range(STEPS):
            if (name := _next(pad.wanted)) is None:
                break
            yield from _tap(scene, pad, name)
        wanted = list(pad.wanted)
        off = math.dist(wanted[:2], GOAL[:2])
        check(f"steps of {STEP:g} m and 15° lead to the goal [m off]", off, off <= STEP * 0.71)
        check("and to its direction [rad off]", turned(wanted[2], GOAL[2]), turned(wanted[2], GOAL[2]) < 0.14)
        yield from glass.pause(0.3)
    with scene.step("on-the-way") as check:
        since = witness.now
        yield from _tap(scene, pad, "go")
        going = yield from glass.soon(lambda: scene.task("go_to"), 5)
        check("Go sends it, and the robot goes", pad.outcome, bool(going))
        yield from glass.soon(lambda: witness.distance(*PERSON) < 1.4, 20)
        yield from glass.pause(0.2)
    with scene.step("at-goal") as check:
        done = yield from glass.soon(lambda: scene.task("go_to", "SUCCEEDED"), 60)
        check("it says that it has arrived", scene.witness["/task/status"].reason, bool(done))
        off = witness.distance(*wanted[:2])
        check(f"and it has [m off, at most {REACHED:g}]", off, off <= REACHED)
        check(
            "turned as wanted [rad off, at most 0.35]",
            turned(witness.truth[3], wanted[2]),
            turned(witness.truth[3], wanted[2]) <= 0.35,
        )
        near = witness.nearest(*PERSON, since)
        check("its sonars kept it off the person on the way [m to the middle]", near, near > 0.4)
        check("no contacts", witness.contacts, witness.contacts == 0)
        yield from glass.pause(0.5)


def _next(wanted: list[float]) -> str | None:
    """The button that brings the pad's goal nearer to GOAL; None when it is there."""
    (east, north), turn = (
        (there - here for here, there in zip(wanted[:2], GOAL[:2], strict=True)),
        math.remainder(GOAL[2] - wanted[2], math.tau),
    )
    if max(abs(east), abs(north)) > STEP * 0.51:
        if abs(east) > abs(north):
            return "east" if east > 0 else "west"
        return "north" if north > 0 else "south"
    if abs(turn) > math.radians(8):
        return "turn left" if turn > 0 else "turn right"
    return None


def _tap(scene: Scene, pad: Any, name: str) -> Wait:
    left, low, width, height = pad.button(name)
    yield from scene.hand.tap(at(pad, left + width / 2, low + height / 2))
