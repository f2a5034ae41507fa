"""The second half of the patrol story: patrol, pause, resume, STOP, release, go home, drive by hand."""

from __future__ import annotations

import math
import time
from typing import Any

from examples.demo.fingers import Finger
from examples.demo.glass import middle
from examples.demo.ground import HOME, PATROL, cones
from examples.demo.scene import Scene, Wait
from examples.demo.witness import matches

__all__ = ["drive", "go_home", "pause_and_resume", "start", "stop_and_release", "watch"]

REACHED, PLACED, HELD, AT_HOME = 0.3, 1.0, 0.05, 0.3
"""A point counts as visited, an intruder as placed, a pause as held, home as reached within these [m]."""
MIN_FOUND = 5
"""So many of the cones are to be found at least."""
INTO_THE_LOT = 0.9
"""Heading when it is driven by hand [rad]: over the cars."""
MAX_PATROL_TIME = 400.0
"""Longest time of the patrol, by the robot's clock [s]."""


def start(scene: Scene) -> Wait:
    """Start the patrol."""
    with scene.step("started") as check:
        yield from scene.glass.reach("TaskButtons")
        started = time.monotonic()
        yield from scene.glass.press("Start")
        runs = yield from scene.glass.soon(lambda: scene.task("patrol"), 5)
        check("the robot has started its patrol [s]", time.monotonic() - started, bool(runs))
        shown = yield from scene.glass.soon(lambda: scene.glass.shows("AUTO"), 2)
        check("the app says AUTO", bool(shown), bool(shown))
        yield from scene.robot_time(6)


def pause_and_resume(scene: Scene) -> Wait:
    """Pause on the way, see that it stays, go on."""
    witness = scene.witness
    with scene.step("on-the-way") as check:
        seen = yield from scene.glass.soon(
            lambda: _found(scene) and _visited(scene) >= 2, MAX_PATROL_TIME / scene.speed
        )
        check(
            "two points visited and an intruder found on the way",
            (_visited(scene), len(_found(scene))),
            bool(seen),
        )
        yield from scene.robot_time(4)
    with scene.step("paused") as check:
        yield from scene.glass.press("Pause")
        paused = yield from scene.glass.soon(lambda: scene.task("patrol", "PAUSED"), 5)
        check("the robot says PAUSED", bool(paused), bool(paused))
        yield from scene.rest(5)
        since = witness.now
        yield from scene.robot_time(5)
        check(
            "it stays where it stands for 5 s [m, at most 0.05]",
            witness.spread(since),
            witness.spread(since) <= HELD,
        )
    with scene.step("resumed") as check:
        yield from scene.glass.press("Resume")
        runs = yield from scene.glass.soon(lambda: scene.task("patrol"), 5)
        check("the patrol goes on", bool(runs), bool(runs))
        moves = yield from scene.glass.soon(lambda: scene.witness.speed() > 0.1, 10)
        check("the robot moves again", bool(moves), bool(moves))


def _visited(scene: Scene) -> int:
    status = scene.witness["/task/status"]
    return status.visited if status is not None else 0


def _found(scene: Scene) -> list[tuple[float, float]]:
    intruders = scene.witness["/intruders"]
    return [(one.position.x, one.position.y) for one in intruders.intruders] if intruders is not None else []


def watch(scene: Scene, since: float) -> Wait:
    """Watch until every point was visited; judge what the robot did and reported since `since` [s, robot clock]."""
    witness = scene.witness
    with scene.step("patrolled") as check:
        yield from scene.glass.soon(lambda: _visited(scene) >= len(PATROL) - 2, MAX_PATROL_TIME / scene.speed)
        yield from scene.robot_time(15)
        scene.report.snapshot("watching")
        visited = yield from scene.glass.soon(
            lambda: _visited(scene) >= len(PATROL), MAX_PATROL_TIME / scene.speed
        )
        check(f"{len(PATROL)} points visited, as the robot says", _visited(scene), bool(visited))
        worst = max(witness.nearest(*point, since) for point in PATROL)
        check("every point was really passed [m off, at most 0.3]", worst, worst <= REACHED)
        check("no contacts", witness.contacts, witness.contacts == 0)
        yield from scene.robot_time(2)
        found = _found(scene)
        counts = matches(found, cones(), PLACED)
        check(
            f"cones found, at least {MIN_FOUND} of {len(counts)}",
            sum(map(bool, counts)),
            sum(map(bool, counts)) >= MIN_FOUND,
        )
        check("each reported once", counts, max(counts) <= 1)
        false = [place for place in found if min(math.dist(place, cone) for cone in cones()) > PLACED]
        check("none that is not there", false, not false)


def stop_and_release(scene: Scene) -> Wait:
    """STOP while it drives, and release by holding."""
    glass, witness = scene.glass, scene.witness
    yield from glass.soon(lambda: witness.speed() > 0.1, 15)
    with scene.step("stop") as check:
        button: Any = yield from glass.one("StopButton")
        started = witness.now
        yield from glass.tap(button)
        yield from scene.rest(5)
        check("at rest after STOP [s, robot clock]", witness.now - started, witness.speed() < 0.01)
        shown = yield from glass.soon(lambda: button.phase == "stopped", 3)
        check("the button says STOPPED because the robot does", button.phase, bool(shown) and scene.stopped)
        yield from glass.pause(0.3)
    with scene.step("released") as check:
        finger = scene.hand.down(middle(button))
        free = yield from glass.soon(lambda: not scene.stopped, 6)  # frames that take long count less
        scene.hand.up(finger)
        check("a hold releases it", bool(free), bool(free))
        yield from scene.robot_time(2)
        check("nothing moves by that alone [m/s]", witness.speed(), witness.speed() < 0.01)


def go_home(scene: Scene) -> Wait:
    """Send it home."""
    with scene.step("going-home") as check:
        yield from scene.glass.press(
            "Home" if not scene.glass.labelled("Go home") else "Go home", kind="PushButton"
        )
        runs = yield from scene.glass.soon(lambda: scene.task("go_home"), 5)
        check("it is on its way home", bool(runs), bool(runs))
        yield from scene.robot_time(5)
    with scene.step("at-home") as check:
        done = yield from scene.glass.soon(
            lambda: scene.task("go_home", "SUCCEEDED"), MAX_PATROL_TIME / scene.speed
        )
        yield from scene.rest(5)
        check("it says that it is home", bool(done), bool(done))
        check(
            "and it is [m off, at most 0.3]",
            scene.witness.distance(*HOME),
            scene.witness.distance(*HOME) <= AT_HOME,
        )
        check("no contacts on the whole way", scene.witness.contacts, scene.witness.contacts == 0)


def drive(scene: Scene) -> Wait:
    """Drive by hand under the video; STOP with the stick pushed."""
    glass, witness = scene.glass, scene.witness
    with scene.step("drive-screen") as check:
        yield from glass.press("Drive", kind="NavButton")
        stick: Any = yield from glass.one("Joystick")
        live = yield from glass.soon(lambda: _alive(scene), 5)
        check("video and instruments are live", _states(scene), bool(live))
        yield from glass.pause(1.0)
    with scene.step("driven") as check:
        before = witness.truth
        yield from _face(scene, stick, INTO_THE_LOT)
        off = abs(math.remainder(witness.truth[3] - INTO_THE_LOT, math.tau))
        check("the stick turns the robot to where it should look [rad off, at most 0.5]", off, off <= 0.5)
        since = witness.now
        finger = _push(scene, stick, 0.1, 0.85)
        yield from glass.soon(lambda: witness.driven(since) > 1.0, 8)
        scene.report.snapshot("driving")
        moved = math.dist(witness.truth[1:3], before[1:3])
        check("and drives it [m, at least 0.8]", moved, moved >= 0.8)
        scene.hand.up(finger)
        still = yield from scene.rest(1.0 + 1.0 / scene.speed)
        check("let go, it comes to rest", bool(still), bool(still))
    with scene.step("stop-while-driving") as check:
        finger = _push(scene, stick, 0.0, 0.9)
        yield from glass.soon(lambda: witness.speed() > 0.2, 5)
        yield from glass.tap((yield from glass.one("StopButton")))
        still = yield from scene.rest(3)
        check("at rest, with the stick still pushed", bool(still), bool(still))
        stopped = yield from glass.soon(
            lambda: scene.stopped and glass.all("StopButton")[0].phase == "stopped", 3
        )
        check("STOP by a second finger wins over the stick", bool(stopped), bool(stopped))
        scene.hand.up(finger)


def _face(scene: Scene, stick: Any, yaw: float) -> Wait:
    """Turn on the spot by the stick until the robot faces `yaw` [rad]."""
    side = math.copysign(0.4, math.remainder(yaw - scene.witness.truth[3], math.tau))
    finger = _push(scene, stick, side, 0.0)

    def facing() -> bool:
        return math.copysign(1.0, side) * math.remainder(yaw - scene.witness.truth[3], math.tau) < 0.25

    yield from scene.glass.soon(facing, 8)
    scene.hand.up(finger)
    yield from scene.rest(3)


def _push(scene: Scene, stick: Any, left: float, forward: float) -> Finger:
    """A finger on the stick's middle that goes out to `left` and `forward`, each a share of the stick's reach."""
    x, y = middle(stick)
    finger = scene.hand.down((x, y))
    for share in (0.3, 0.6, 1.0):
        scene.hand.move(finger, (x - left * stick.reach * share, y + forward * stick.reach * share))
    return finger


def _states(scene: Scene) -> dict[str, str]:
    return {type(w).__name__: str(getattr(w, "state", "")) for w in scene.glass.all("RobotWidget")}


def _alive(scene: Scene) -> bool:
    states = _states(scene)
    return "Video" in states and not {"never", "stale"} & set(states.values())
