"""The second part of the errand: another operator asks for control, and the robot's computer loses its power."""

from __future__ import annotations

import math
import uuid
from typing import Any

from bridge.client import RemoteRobot
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from examples.demo.scene import Scene, Wait

__all__ = ["Colleague", "hand_over", "lose_power"]


class Colleague:
    """Another operator with a handheld of her own."""

    NAME = "Anna's tablet"

    def __init__(self, url: str) -> None:
        self._robot = RemoteRobot(url)
        self._id = uuid.uuid4().hex
        self._robot.wait()

    def ask(self, service: str) -> CommandResponse:
        """Call one of the services that take a command."""
        request = CommandRequest(
            command_id=uuid.uuid4().hex,
            client_id=self._id,
            client_name=self.NAME,
            stamp=math.nan,
        )
        answer: CommandResponse = self._robot.call(service, request, CommandResponse)
        return answer

    def close(self) -> None:
        """Go."""
        self._robot.close()


def hand_over(scene: Scene) -> Wait:
    """She asks; the card says so; control is kept once and handed over the next time, and comes back."""
    glass = scene.glass
    colleague = Colleague(scene.url)
    try:
        with scene.step("asked-for-control") as check:
            answer = colleague.ask("/control/request")
            check("asking is accepted", answer.message, answer.success)
            card = yield from glass.until(lambda: glass.all("HandoverCard"), 3, "the card that says who asks")
            check("the card names who asks", Colleague.NAME, glass.shows(Colleague.NAME))
            yield from glass.pause(1.5)
            check("it is one card", len(card), len(card) == 1)
        with scene.step("control-handed-over") as check:
            yield from glass.press("Hand over", kind="PushButton")
            gone = yield from glass.soon(lambda: _driver(scene) == Colleague.NAME, 3)
            check("she has control", _driver(scene), bool(gone))
            yield from glass.pause(1.0)
        with scene.step("control-back") as check:
            colleague.ask("/control/release")
            yield from glass.soon(lambda: _driver(scene) != Colleague.NAME, 3)
            yield from _take_back(scene)
            back = yield from glass.soon(lambda: _driver(scene) not in ("", Colleague.NAME), 5)
            check("it is ours again", _driver(scene), bool(back))
    finally:
        colleague.close()


def _take_back(scene: Scene) -> Wait:
    """A handheld that handed control over takes it back by a tap when no one has it."""
    chips = yield from scene.glass.until(
        lambda: scene.glass.labelled("take control"), 5, "a chip that offers control"
    )
    yield from scene.glass.tap(chips[0])


def _driver(scene: Scene) -> str:
    status = scene.witness["/control/status"]
    return str(status.driver) if status is not None else ""


def lose_power(scene: Scene) -> Wait:
    """Its computer dies in the middle of a task, comes back, and offers to go on; nothing moves by itself."""
    glass, witness = scene.glass, scene.witness
    with scene.step("power-cut") as check:
        before = witness["/task/status"]
        check("a task runs", before.task, before.state == "RUNNING")
        scene.power_cut()
        told = yield from glass.soon(lambda: glass.shows("trying again"), 8)
        check("the loss is said", bool(told), bool(told))
        yield from glass.pause(0.3)
    with scene.step("offered") as check:
        offered = yield from glass.soon(lambda: _state(scene) == "INTERRUPTED", 60)
        check("the task is offered for resumption", _state(scene), bool(offered))
        card: Any = yield from glass.one("QuestionCard", 20)
        since = witness.now
        yield from scene.robot_time(3)
        moved = witness.driven(since)
        check("nothing moves by itself [m]", moved, moved < 0.05)
        places = witness["/places"]
        names = sorted(place.name for place in places.places) if places is not None else []
        check("the places are still there", names, "Gate" in names)
    with scene.step("discarded") as check:
        yield from glass.tap(card.ids.discard)
        done = yield from glass.soon(lambda: _state(scene) not in ("INTERRUPTED", "RUNNING"), 5)
        check("discarded, it is gone", _state(scene), bool(done))
        yield from glass.pause(0.5)


def _state(scene: Scene) -> str:
    status = scene.witness["/task/status"]
    return str(status.state) if status is not None else ""
