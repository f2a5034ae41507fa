"""The beginning of every story: find the robot and connect to it."""

from __future__ import annotations

import time

from examples.demo.scene import Scene, Wait

__all__ = ["LIVE", "connect", "waiting"]

LISTED, LIVE = 3.0, 2.0
"""The robot is on the list, and every widget lives, within these [s]."""


def connect(scene: Scene) -> Wait:
    """Find the robot on the connect screen and connect to it."""
    glass, started = scene.glass, time.monotonic()
    with scene.step("connect-screen") as check:
        found = yield from glass.soon(scene.cards, 10)
        seconds = time.monotonic() - started
        check("the robot is on the list", len(found), bool(found))
        check(f"it is there within {LISTED:g} s", seconds, seconds <= LISTED, timed=True)
        yield from glass.pause(0.7)
    with scene.step("connected") as check:
        yield from glass.bring(scene.cards()[0])
        started = time.monotonic()
        yield from glass.tap(scene.cards()[0].ids.connect)
        yield from glass.one("MapOverlay", 10)
        yield from glass.soon(lambda: not waiting(scene), 10)
        seconds = time.monotonic() - started
        check(f"every widget lives within {LIVE:g} s of Connect", seconds, seconds <= LIVE, timed=True)
        check("no widget still waits for its first message", waiting(scene), not waiting(scene))
        yield from glass.pause(1.0)


def waiting(scene: Scene) -> list[str]:
    """Classes of the widgets on the screen that have had no message yet."""
    return [type(w).__name__ for w in scene.glass.all("RobotWidget") if getattr(w, "state", "") == "never"]
