"""The second story: places with names, a delivery that asks, a queue that is changed while it runs."""

from __future__ import annotations

import math
from typing import Any

from examples.demo.glass import middle
from examples.demo.scene import Scene, Wait

__all__ = ["arrive", "deliver", "make_places", "plan_ahead"]

GATE = (-17.5, -6.5)
"""Where the place is pointed at, in `map` [m]."""
DOCK = "Charging bay"
"""The place where the robot stands when the story begins."""
MESSAGE = "For Ms. Weber, 2nd floor"
REACHED_DISTANCE = 0.5
"""A place counts as reached within this [m]."""
MAX_TRIP_TIME = 90.0
"""Longest time of one trip, by the robot's clock [s]."""


def arrive(scene: Scene) -> Wait:
    """Connect, and set the robot's pose."""
    glass = scene.glass
    _, x, y, yaw = yield from glass.until(lambda: _truth(scene), 10, "the robot's truth")
    with scene.step("fenced") as check:
        cards = yield from glass.until(scene.cards, 10, "the robot on the list")
        yield from glass.tap(cards[0].ids.connect)
        yield from glass.one("MapOverlay", 10)
        yield from glass.press("Robot", kind="Segment")
        chart: Any = scene.map()
        placed = yield from glass.until(lambda: list(chart.placed), 3, "the robot to be placed")
        yield from scene.hand.drag([scene.on_map(*placed[:2]), scene.on_map(x, y)])
        handle = chart.handle_place()
        reach = math.dist(handle, chart.placed[:2])
        turned = scene.on_map(x + reach * math.cos(yaw), y + reach * math.sin(yaw))
        yield from scene.hand.drag([scene.on_map(*handle), turned])
        yield from glass.press("Set here")
        yield from glass.press("View", kind="Segment")
        yield from scene.robot_time(3)
        check("the robot knows where it is [m off, at most 0.3]", scene.off()[0], scene.off()[0] <= 0.3)


def _truth(scene: Scene) -> Any:
    return scene.witness.truth if math.isfinite(scene.witness.now) else None


def make_places(scene: Scene) -> Wait:
    """One place by a long tap on the map, one where the robot stands; no coordinate is typed."""
    glass = scene.glass
    with scene.step("place-made") as check:
        finger = scene.hand.down(scene.on_map(*GATE))
        yield from glass.pause(1.0)
        scene.hand.up(finger)
        yield from glass.one("PlaceForm")
        yield from glass.write("Name", "Gate")
        scene.report.snapshot("naming")
        yield from glass.press("Save", kind="PushButton")
        kept = yield from glass.soon(lambda: "Gate" in _places(scene), 5)
        check("the robot keeps the place", list(_places(scene)), bool(kept))
    with scene.step("place-here") as check:
        yield from glass.press("Tasks", kind="NavButton")
        yield from glass.press("Places", kind="Segment")
        yield from glass.press("New here", kind="PushButton")
        yield from glass.write("Name", DOCK)
        yield from glass.press("Save", kind="PushButton")
        kept = yield from glass.soon(lambda: DOCK in _places(scene), 5)
        check("and the one where it stands", list(_places(scene)), bool(kept))
        off = max(
            math.dist(_places(scene)[name], at)
            for name, at in (("Gate", GATE), (DOCK, scene.witness.truth[1:3]))
        )
        check("both are where they were meant to be [m off, at most 0.3]", off, off <= 0.3)


def _places(scene: Scene) -> dict[str, tuple[float, float]]:
    told = scene.witness["/places"]
    return {place.name: (place.x, place.y) for place in told.places} if told is not None else {}


def deliver(scene: Scene) -> Wait:
    """From the gate to the charging bay, with a message; each end is confirmed by one tap."""
    glass = scene.glass
    with scene.step("ordered") as check:
        yield from glass.press("Now", kind="Segment")
        yield from glass.press("Deliver", kind="TaskTile")
        for name in ("Gate", DOCK):
            yield from _choose(scene, name)
        yield from glass.write("Message for the person", MESSAGE)
        told = glass.shows("Fetches at Gate, brings it to")
        check("a sentence says what will happen", told, told)
        yield from glass.pause(0.3)
        scene.report.snapshot("order")
        yield from glass.press("Start", kind="PushButton")
        runs = yield from glass.soon(lambda: scene.task("deliver"), 5)
        check("the robot delivers", bool(runs), bool(runs))
        yield from scene.robot_time(2)
    for step, place in (("picked-up", GATE), ("handed-over", _places(scene)[DOCK])):
        with scene.step(step) as check:
            asked = yield from glass.soon(lambda: _asks(scene), MAX_TRIP_TIME / scene.speed)
            check("it asks", scene.witness["/task/status"].asks, bool(asked))
            check(
                "where it should [m off, at most 0.5]",
                scene.witness.distance(*place),
                scene.witness.distance(*place) <= REACHED_DISTANCE,
            )
            card = yield from glass.one("QuestionCard")
            yield from glass.pause(1.0)
            scene.report.snapshot(f"asks-{step}")
            yield from glass.tap(card.ids.answer)
            answered = yield from glass.soon(lambda: not _asks(scene), 5)
            check("one tap answers it", bool(answered), bool(answered))
            if step == "picked-up":
                yield from plan_ahead(scene)
    with scene.step("delivered") as check:
        done = yield from glass.soon(lambda: scene.task("hold"), MAX_TRIP_TIME / scene.speed)
        check("then it does what is next in the queue", bool(done), bool(done))
        yield from glass.press("Log", kind="Segment")
        yield from glass.press("Tasks", kind="Segment")
        told = yield from glass.soon(lambda: glass.shows("Deliver"), 5)
        check("the history has the delivery", bool(told), bool(told))
        yield from glass.pause(0.5)


def plan_ahead(scene: Scene) -> Wait:
    """Two tasks for afterwards, while the first runs; one is taken out and brought back, one goes before the other."""
    glass = scene.glass
    for task, place in (("Go to", "Gate"), ("Hold", "")):
        yield from glass.press(task, kind="TaskTile")
        if place:
            yield from _choose(scene, place)
        yield from glass.press("Add to queue", kind="PushButton")
        yield from glass.soon(lambda task=task: _queue(scene)[-1:] == [_NAMES[task]], 5)
    handles = yield from glass.until(lambda: glass.all("DragHandle"), 5, "a handle to drag a row by")
    (x, y), (_, high) = middle(handles[-1]), middle(handles[0])
    if y > high:
        y, high = high, y
    yield from scene.hand.drag([(x, y), (x, high + 24)], hold=10)
    yield from glass.soon(lambda: _queue(scene) == ["hold", "go_to"], 5)
    scene.report.snapshot("queue")


def _choose(scene: Scene, name: str) -> Wait:
    """Take a place for the highest field that has none yet, when the form has come to rest."""
    yield from scene.glass.pause(0.5)
    empty = yield from scene.glass.until(
        lambda: scene.glass.labelled("Choose a place"), 5, "a field for a place"
    )
    yield from scene.glass.tap(max(empty, key=lambda field: middle(field)[1]))
    yield from scene.glass.press(name)


_NAMES = {"Go to": "go_to", "Hold": "hold"}


def _queue(scene: Scene) -> list[str]:
    told = scene.witness["/task/queue"]
    return [order.task for order in told.orders] if told is not None else []


def _asks(scene: Scene) -> bool:
    status = scene.witness["/task/status"]
    return bool(status is not None and status.asks)
