"""The stories of the demo, each from its first step to its last."""

from __future__ import annotations

from collections.abc import Callable

from examples.demo import (
    aqua,
    ardrone,
    commander,
    errand,
    minnow,
    others,
    patrol,
    prepare,
    scout,
    streets,
    vehicle,
)
from examples.demo.connecting import connect
from examples.demo.scene import Scene, Wait

__all__ = ["play", "topics"]

VEHICLES = {"scout": scout, "commander": commander, "minnow": minnow, "aqua": aqua, "ardrone": ardrone}
"""Stories by hand and by task on the drive screen, each in its own file."""


def topics(story: str) -> tuple[str, ...]:
    """Topics that the story watches besides those of every robot."""
    return VEHICLES[story].TOPICS if story in VEHICLES else ()


def play(story: str, scene: Scene, record: Callable[[], object]) -> Wait:
    """Play the story of that name; `record` starts a recording, once there is a robot."""
    if story == "errand":
        yield from _errand(scene)
        return
    yield from connect(scene)
    record()
    if story == "patrol":
        yield from _patrol(scene)
        return
    yield from vehicle.open_profile(scene, story)
    yield from VEHICLES[story].play(scene)


def _patrol(scene: Scene) -> Wait:
    """The main job."""
    yield from prepare.initialise(scene)
    yield from prepare.tap_points(scene)
    yield from prepare.edit_points(scene)
    yield from prepare.set_home_and_motion(scene)
    yield from prepare.send(scene)
    yield from streets.lay_streets(scene)
    since = scene.witness.now
    yield from patrol.start(scene)
    yield from patrol.pause_and_resume(scene)
    yield from patrol.watch(scene, since)
    yield from patrol.stop_and_release(scene)
    yield from patrol.go_home(scene)
    yield from patrol.drive(scene)


def _errand(scene: Scene) -> Wait:
    """Places, a delivery, a queue, other people and a power cut."""
    yield from errand.arrive(scene)
    yield from errand.make_places(scene)
    yield from errand.deliver(scene)
    yield from others.hand_over(scene)
    yield from others.lose_power(scene)
