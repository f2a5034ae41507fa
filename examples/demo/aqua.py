"""The aqua's story: a swimmer in a tank, by tilt and by two switches."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from kivy.app import App
from kivy.core.window import Window

from examples.demo.fingers import Finger
from examples.demo.scene import Scene, Wait
from examples.demo.vehicle import keep_pushing, on_phone, push, release, stop

__all__ = ["TOPICS", "play"]

TOPICS = ("/motors", "/depth")
GLIDES, GLIDES_OUT = 0.12, 3.0
"""Slower it only glides [m/s]; the water takes its way within this [s]."""
TAB, ENTER = 9, 13
"""Keys that two switches send: on to the next one, and do it."""
PRESS_PERIOD = 0.5
"""Between two presses [s]: sooner the second is taken for a trembling hand's."""
MAX_PRESSES = 60
"""Presses after which something is not to be found."""
DEPTH_TOLERANCE = 0.12
"""A depth is held to this [m]."""
AT_THE_SURFACE = -0.3
"""Higher it has surfaced [m]."""


def play(scene: Scene) -> Wait:
    """Swim, STOP, hold the depth, surface."""
    yield from scene.glass.until(lambda: scene.witness["/motors"], 5, "the temperatures of its legs")
    cold = _hot(scene)
    yield from _swim(scene)
    yield from release(scene, GLIDES)
    yield from on_phone(scene, lambda: _hands(scene, 0.8, 0.0, 0.4), 3.0)
    yield from _hold(scene)
    _warm(scene, cold)
    yield from _surface(scene)


def _hands(scene: Scene, ahead: float, left: float, down: float) -> list[Finger]:
    """The stick ahead, and the tilt circle `down` (nose down) and to the `left`."""
    stick: Any = scene.glass.all("Joystick")[0]
    circle: Any = scene.glass.all("TiltCircle")[0]
    return [push(scene, stick, 0.0, ahead), push(scene, circle, left, down)]


def _hot(scene: Scene) -> float:
    """Of the warmest leg [degC]; NaN before it is known."""
    told = scene.witness["/motors"]
    return max(map(float, told.temperatures), default=math.nan) if told is not None else math.nan


def _swim(scene: Scene) -> Wait:
    glass, witness = scene.glass, scene.witness
    with scene.step("driven") as check:
        before, since = witness.heights()[-1], witness.now
        fingers = yield from keep_pushing(
            scene, lambda: _hands(scene, 0.9, 0.0, 0.6), lambda: witness.heights()[-1] < before - 0.8
        )
        scene.report.snapshot("driving")
        check("it swims ahead [m]", witness.driven(since), witness.driven(since) > 0.8)
        deeper = before - witness.heights()[-1]
        check("nose down by the circle, it goes deeper [m]", deeper, deeper > 0.5)
        for finger in fingers:
            scene.hand.up(finger)
    stick: Any = glass.all("Joystick")[0]
    fingers = yield from keep_pushing(
        scene, lambda: [push(scene, stick, 0.0, 1.0)], lambda: witness.fast(0.5) > 0.4
    )
    yield from stop(scene, fingers, GLIDES, GLIDES_OUT, drifts=True)


def _switch(scene: Scene, words: str) -> Wait:
    """Go to what says `words` by two switches, into the groups that it is in, and do it; returns how often they were pressed."""
    scan: Any = App.get_running_app().methods.get("switches").engine.scan

    def there(targets: Iterable[Any]) -> bool:
        return any(target.words.startswith(words) for target in targets)

    for presses in range(1, MAX_PRESSES + 1):
        mark = scan.mark
        marked = mark is not None and there(mark.targets)
        if marked and mark.kind == "item":
            scene.report.snapshot("at-" + words.lower().replace(" ", "-"))
            yield from _key(scene, ENTER)
            return presses
        if scan.depth and not there(scan.inside):
            yield from _up(scene, scan)
        else:
            yield from _key(scene, ENTER if marked else TAB)
    raise RuntimeError(f"the switches do not come to {words!r}.")


def _key(scene: Scene, key: int) -> Wait:
    Window.dispatch("on_key_down", key, 0, "", [])
    yield from scene.glass.pause(0.1)
    Window.dispatch("on_key_up", key, 0)
    yield from scene.glass.pause(PRESS_PERIOD)


def _up(scene: Scene, scan: Any) -> Wait:
    """Hold the first switch until the mark has left the group."""
    depth = scan.depth
    Window.dispatch("on_key_down", TAB, 0, "", [])
    yield from scene.glass.soon(lambda: scan.depth != depth, 3)
    Window.dispatch("on_key_up", TAB, 0)
    yield from scene.glass.pause(PRESS_PERIOD)


def _hold(scene: Scene) -> Wait:
    witness, glass = scene.witness, scene.glass
    with scene.step("switches") as check:
        presses = yield from _switch(scene, "Hold depth")
        holds = yield from glass.soon(lambda: scene.task("hold"), 5)
        check("two switches come to Hold depth and do it [presses]", presses, bool(holds))
    with scene.step("depth-held") as check:
        yield from scene.robot_time(3)
        since = witness.now
        yield from scene.robot_time(6)
        heights = witness.heights(since)
        span = max(heights) - min(heights)
        check(
            f"for 6 s it keeps its depth of {-heights[-1]:.1f} m [m off, at most {DEPTH_TOLERANCE:g}]",
            span,
            span <= DEPTH_TOLERANCE,
        )


def _warm(scene: Scene, cold: float) -> None:
    with scene.step("warm") as check:
        hot = _hot(scene)
        warmer = hot - cold
        check(f"its legs have warmed up to {hot:.1f} °C [K, at least 0.5]", warmer, warmer >= 0.5)


def _surface(scene: Scene) -> Wait:
    witness, glass = scene.witness, scene.glass
    with scene.step("surfaced") as check:
        yield from _switch(scene, "Surface")
        up = yield from glass.soon(lambda: scene.task("surface"), 5)
        check("two switches have it surface", bool(up), bool(up))
        yield from glass.soon(lambda: scene.task("surface", "SUCCEEDED"), 30)
        high = witness.heights()[-1]
        check("it is at the surface [m, above -0.3]", high, high > AT_THE_SURFACE)
        check("and says so", witness["/task/status"].reason, scene.task("surface", "SUCCEEDED"))
        check("no contacts", witness.contacts, witness.contacts == 0)
        yield from glass.pause(0.5)
