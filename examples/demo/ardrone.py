"""The drone's story: a slide to take off, two thumbs to fly, a slide to land."""

from __future__ import annotations

from typing import Any

from examples.demo.fingers import Finger
from examples.demo.scene import Scene, Wait
from examples.demo.vehicle import at, keep_pushing, on_phone, push, release, slide_speed, stop

__all__ = ["TOPICS", "play"]

TOPICS = ("/flight", "/motors")
DRIFTS = 0.15
"""One that hovers drifts no faster [m/s]."""
COMES_TO_REST = 2.5
"""It comes to rest by leaning back, no farther than it may [s]."""
STAYS = 0.3
"""A hover keeps place and height to this [m]."""


def play(scene: Scene) -> Wait:
    """Take off, fly, hover, STOP, land."""
    yield from _take_off(scene)
    yield from _fly(scene)
    yield from release(scene, DRIFTS)
    yield from on_phone(scene, lambda: _lean(scene, 0.0, 0.5, 0.0), 3.0)
    yield from _land(scene)


def _slide(scene: Scene, words: str, share: float) -> Wait:
    """Slide the knob of what says `words` along `share` of its way and let go."""
    slides = [one for one in scene.glass.all("SlideToConfirm") if words in getattr(one, "text", "")]
    if not slides:
        raise RuntimeError(f"there is no slide that says {words!r}.")
    slide: Any = slides[0]
    (x, y, _), (_, _, width, high) = slide.knob, slide.track
    way = [at(slide, x, y), at(slide, x + share * (width - high), y)]
    yield from scene.hand.drag(way, hold=12)


def _phase(scene: Scene) -> str:
    told = scene.witness["/flight"]
    return str(told.phase) if told is not None else ""


def _take_off(scene: Scene) -> Wait:
    glass, witness = scene.glass, scene.witness
    with scene.step("let-go") as check:
        yield from _slide(scene, "take off", 0.6)
        yield from scene.robot_time(2)
        check("a slide that is let go early does nothing", _phase(scene), _phase(scene) == "landed")
        check("not even the rotors turn [rad/s]", _rotors(scene), _rotors(scene) < 1)
    with scene.step("taken-off") as check:
        yield from _slide(scene, "take off", 1.1)
        flies = yield from glass.soon(lambda: _phase(scene) == "flying", 15)
        check("slid to its end, it takes off", _phase(scene), bool(flies))
        yield from glass.soon(lambda: scene.task("take_off", "SUCCEEDED"), 10)
        high = witness.heights()[-1]
        check("it is in the air [m]", high, high > 0.7)
        check("the rotors turn [rad/s]", _rotors(scene), _rotors(scene) > 100)
        yield from glass.pause(0.5)


def _rotors(scene: Scene) -> float:
    told = scene.witness["/motors"]
    return max(map(abs, told.speeds), default=0.0) if told is not None else 0.0


def _lean(scene: Scene, left: float, forward: float, climb: float) -> list[Finger]:
    """Both thumbs: the tilt circle, and the stick that climbs."""
    tilt: Any = scene.glass.all("TiltCircle")[0]
    fingers = [push(scene, tilt, left, forward)]
    if climb:
        stick: Any = scene.glass.all("Joystick")[0]
        fingers.append(push(scene, stick, 0.0, climb))
    return fingers


def _fly(scene: Scene) -> Wait:
    glass, witness = scene.glass, scene.witness
    with scene.step("driven") as check:
        fastest = yield from slide_speed(scene, 0.55)
        before, since = witness.heights()[-1], witness.now
        fingers = yield from keep_pushing(
            scene,
            lambda: _lean(scene, 0.0, 0.9, 0.8),
            lambda: witness.driven(since) > 2.0 and witness.heights()[-1] > before + 0.6,
        )
        scene.report.snapshot("driving")
        check("the circle tilts it and it goes [m]", witness.driven(since), witness.driven(since) > 2.0)
        check(
            "the stick makes it climb [m]",
            witness.heights()[-1] - before,
            witness.heights()[-1] > before + 0.5,
        )
        check(f"the slider stands at {fastest:.1f} m/s [m/s]", witness.speed(), witness.speed() > 0.3)
        for finger in fingers:
            scene.hand.up(finger)
    with scene.step("hover") as check:
        yield from glass.soon(lambda: witness.speed() < DRIFTS, 8)
        yield from scene.robot_time(1)
        since = witness.now
        yield from scene.robot_time(3)
        check(
            "the fingers lifted, it stays where it is [m]",
            witness.spread(since),
            witness.spread(since) <= STAYS,
        )
        heights = witness.heights(since)
        span = max(heights) - min(heights)
        check("and as high [m]", span, span <= STAYS)
    fingers = yield from keep_pushing(
        scene, lambda: _lean(scene, 0.3, -1.0, 0.0), lambda: witness.speed() > 1.2
    )
    yield from stop(scene, fingers, DRIFTS, COMES_TO_REST)


def _land(scene: Scene) -> Wait:
    glass, witness = scene.glass, scene.witness
    with scene.step("landed") as check:
        yield from glass.soon(lambda: witness.speed() < DRIFTS, 5)
        yield from _slide(scene, "land", 1.1)
        down = yield from glass.soon(lambda: _phase(scene) == "landed", 30)
        check("it lands", _phase(scene), bool(down))
        yield from glass.soon(lambda: _rotors(scene) < 1, 5)
        check("and the rotors stand [rad/s]", _rotors(scene), _rotors(scene) < 1)
        check("no contacts", witness.contacts, witness.contacts == 0)
        yield from glass.pause(0.5)
