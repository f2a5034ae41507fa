"""Steps that the stories of all vehicles share: the robot's own drive screen, pushing its controls, STOP and release, a phone in the sun."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from kivy.core.window import Window
from kivy.uix.widget import Widget

from app.layout.layout import SLIDER, load
from examples.demo.connecting import LIVE, waiting
from examples.demo.fingers import Finger, Point
from examples.demo.glass import middle
from examples.demo.scene import Scene, Wait
from widgets import CATALOGUE
from widgets.core.theme import theme

__all__ = [
    "act",
    "keep_pushing",
    "on_phone",
    "open_profile",
    "push",
    "release",
    "send_and_start",
    "slide_speed",
    "stop",
]

AT_REST = 0.5
"""So soon after STOP the robot is at rest, or follows nothing but what brings it there [s, robot clock]."""
PHONE = (412, 892)
PUSHED = ("twist", "steer", "tilt")
"""Manoeuvres of a robot that is driven by hand."""
PUSH_TIMEOUT = 1.5
"""A push that does nothing for so long is tried anew [s]."""
FOLDED = "senses"
"""Widgets of this slot are behind a handle until they are unfolded."""
RESTING = ("rest", "hover")
"""Manoeuvres of a robot that was stopped: what flies stays where it is."""


def open_profile(scene: Scene, robot: str) -> Wait:
    """Go to the drive screen, which is the one of this robot."""
    glass, layout = scene.glass, load(robot, CATALOGUE)
    wanted = {one.widget for one in layout.instruments if one.slot != FOLDED}
    wanted |= {"SpeedCard" if one.widget == SLIDER else one.widget for one in layout.controls}
    # of two controls in one place one is visible
    slots = [one.slot for one in layout.controls if one.slot == "stick"]
    wanted -= {one.widget for one in layout.controls if one.slot == "stick"} if len(slots) > 1 else set()
    with scene.step("profile") as check:
        started = time.monotonic()
        yield from glass.press("Drive", kind="NavButton")
        live = yield from glass.soon(lambda: glass.all("Video") and not waiting(scene), 10)
        seconds = time.monotonic() - started
        check("every widget of the screen lives", waiting(scene), bool(live))
        check(f"it does within {LIVE:g} s", seconds, seconds <= LIVE, timed=True)
        lacking = sorted(name for name in wanted if not glass.all(name))
        check(f"the screen is that of {robot}, nothing lacks", lacking, not lacking)
        yield from glass.pause(1.0)


def push(scene: Scene, stick: Any, left: float, forward: float) -> Finger:
    """A finger on a control's middle that goes out to `left` and `forward`, each a share of its way, -1 to 1."""
    (x, y), (across, up) = stick.to_window(*stick.middle), stick.travel
    finger = scene.hand.down((x, y))
    for share in (0.3, 0.6, 1.0):
        scene.hand.move(finger, (x - left * across * share, y + forward * up * share))
    return finger


def slide_speed(scene: Scene, share: float) -> Wait:
    """Put the slider of the greatest speed to `share` of its way and return what it says then [m/s]."""
    card: Any = yield from scene.glass.one("SpeedCard")
    fader = card.ids.fader
    x, now = fader.to_window(fader.center_x, fader.knob_y)
    _, there = fader.to_window(fader.center_x, fader.low + share * (fader.high - fader.low))
    yield from scene.hand.drag([(x, now), (x, there)], hold=4)
    return float(card.maximum_speed)


def keep_pushing(
    scene: Scene, pushing: Callable[[], list[Finger]], until: Callable[[], bool], seconds: float = 20.0
) -> Wait:
    """Push until `until` holds, at most `seconds`; returns the fingers, which stay.

    On a machine that is busy elsewhere a push may run out, and then counts no more: the fingers let go and push anew.
    """
    glass, end = scene.glass, time.monotonic() + seconds
    fingers, heard = pushing(), time.monotonic()
    while not until() and time.monotonic() < end:
        if _follows(scene) in PUSHED:
            heard = time.monotonic()
        elif time.monotonic() - heard > PUSH_TIMEOUT:
            for finger in fingers:
                scene.hand.up(finger)
            yield from glass.pause(0.4)
            fingers, heard = pushing(), time.monotonic()
        yield
    return fingers


def act(scene: Scene, words: str) -> Wait:
    """Press the action that says `words`."""
    yield from scene.glass.press(words, kind="PushButton")


def stop(
    scene: Scene, fingers: Iterable[Finger], slow: float, within: float = AT_REST, drifts: bool = False
) -> Wait:
    """STOP by another finger while `fingers` push: slower than `slow` [m/s] `within` so long [s, robot clock].

    What `drifts` with the water is never at rest, and may say so.
    """
    glass, witness = scene.glass, scene.witness
    with scene.step("stop") as check:
        button: Any = yield from glass.one("StopButton")
        fast, pressed = witness.speed(), witness.now
        yield from glass.tap(button)
        held = yield from glass.soon(lambda: _follows(scene) in RESTING, 3)
        seconds = witness.now - pressed
        check(
            f"{AT_REST:g} s after STOP it follows nothing else [s]",
            seconds,
            bool(held) and seconds <= AT_REST,
        )
        yield from glass.soon(
            lambda: witness.rested(pressed, slow) == witness.rested(pressed, slow), within + 1
        )
        yield from scene.robot_time(1)
        rested = witness.rested(pressed, slow)
        check(
            f"from {fast:.2f} m/s it is at rest, the controls still pushed [s, at most {within:g}]",
            rested,
            rested <= within,
        )
        phases = ("stopped", "moves") if drifts else ("stopped",)
        shown = yield from glass.soon(lambda: scene.stopped and button.phase in phases, 3)
        check("the button says so because the robot does", button.phase, bool(shown))
        for finger in fingers:
            scene.hand.up(finger)
        yield from glass.pause(0.3)


def _follows(scene: Scene) -> str:
    order = scene.witness["/manoeuvre"]
    return str(order.kind) if order is not None else ""


def release(scene: Scene, slow: float) -> Wait:
    """Let go of STOP by holding; nothing moves faster than `slow` [m/s] by that."""
    glass, witness = scene.glass, scene.witness
    with scene.step("released") as check:
        button: Any = yield from glass.one("StopButton")
        finger = scene.hand.down(middle(button))
        free = yield from glass.soon(lambda: not scene.stopped, 12)  # frames that take long count less
        scene.hand.up(finger)
        check("a hold releases it", bool(free), bool(free))
        yield from scene.robot_time(1)
        check("nothing moves by that alone [m/s]", witness.speed(), witness.speed() <= slow)


def on_phone(scene: Scene, pushing: Callable[[], list[Finger]], seconds: float = 2.0) -> Wait:
    """The driving moment on a phone in the sun: `pushing` puts the fingers on the controls."""
    glass, witness = scene.glass, scene.witness
    size, name = Window.size, theme.name
    with scene.step("phone") as check:
        Window.size = PHONE
        theme.name = "sunlight"
        yield from glass.pause(0.7)
        check("the window is a phone's", list(Window.size), tuple(Window.size) == PHONE)
        since = witness.now
        fingers = yield from keep_pushing(
            scene, pushing, lambda: witness.now - since > seconds and witness.driven(since) > 0.2
        )
        moved = witness.driven(since)
        check("it is driven there too [m]", moved, moved >= 0.1)
        scene.report.snapshot("driving-phone")
        for finger in fingers:
            scene.hand.up(finger)
        yield from glass.pause(0.3)
    Window.size, theme.name = size, name
    yield from glass.pause(0.7)


def send_and_start(scene: Scene, points: Sequence[Point]) -> Wait:
    """Send the points on the map to the robot, which has them then, and start it."""
    glass, witness = scene.glass, scene.witness

    def stored() -> bool:
        mission = witness["/mission"]
        return mission is not None and len(mission.waypoints) == len(points)

    yield from glass.press("Send")
    yield from glass.until(stored, 8, "the robot to store its points")
    yield from glass.press("Start")
    runs = yield from glass.soon(lambda: scene.task("patrol"), 8)
    return bool(runs)


def at(widget: Widget, x: float, y: float) -> Point:
    """A place of a widget [px, its own] on the screen [px, window]."""
    return tuple(widget.to_window(x, y))  # type: ignore[return-value]


def turned(one: float, other: float) -> float:
    """From one angle to another [rad], the shorter way, no sign."""
    return abs(math.remainder(one - other, math.tau))
