"""A robot whose simulation or whose loop lags: it says so, goes slower, rests at last, and goes on by itself."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from bridge.core.codes import Code
from bridge.msgs import Msg
from bridge.msgs.diagnostic_msgs import DiagnosticArray, DiagnosticStatus
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import ControlStatus, Event
from robotside.core.clock import RobotClock
from robotside.serving import fleet_server
from robotside.serving.fleet_server import FleetServer, RunningServer
from robotside.station.loop_watch import LATE_TIME, ON_TIME_TIME
from robotside.station.station import Station
from tests.fakes import FakeRobot, Pillar
from tests.robotside.scene import SQUARE, Scene

if TYPE_CHECKING:
    from collections.abc import AsyncIterator


class Simulated(FakeRobot):
    """One whose time can stand still."""

    skipped: float = 0.0

    def skip_to(self, now: float) -> None:
        self.skipped = now


@pytest.fixture
def simulated(tmp_path: Path) -> Scene:
    scene = Scene(Simulated(), tmp_path)
    scene.run(4.0)
    return scene


def lag(scene: Scene, seconds: float, *, factor: float = 1.0, late: float = 0.0) -> None:
    """Let time pass with a loop of that timing."""
    for _ in range(round(seconds / 0.1)):
        scene.station.loop.update(factor, late, scene.clock)
        scene.run(0.1)


def speed(scene: Scene) -> float:
    return scene.robot.twist.linear.x


def codes(scene: Scene) -> list[str]:
    events = [msg for _, msg in scene.said if isinstance(msg, Event)]
    return [
        event.code
        for event in events
        if event.code in (Code.SIMULATION_SLOW, Code.LOOP_LATE, Code.LOOP_ON_TIME)
    ]


def told(scene: Scene, name: str) -> DiagnosticStatus:
    last = scene.station.bus.last("/diagnostics") or scene.of("/diagnostics")[-1]
    assert isinstance(last, DiagnosticArray)
    return next(status for status in last.status if status.name == name)


def hold(scene: Scene, ahead: float, seconds: float, *, factor: float = 1.0, late: float = 0.0) -> None:
    for _ in range(round(seconds / 0.1)):
        scene.drive(Twist.planar(ahead, 0.0))
        lag(scene, 0.1, factor=factor, late=late)


def test_a_robot_in_a_simulation_at_a_seventh_of_real_time_rests_whoever_drives_it(simulated: Scene) -> None:
    hold(simulated, 0.5, 1.0, factor=0.14)
    assert speed(simulated) == 0.0
    assert simulated.robot.at_rest


@pytest.mark.parametrize("factor", [0.3, 0.5])
def test_its_speed_is_the_share_that_the_simulation_makes_of_real_time(
    simulated: Scene, factor: float
) -> None:
    most = simulated.station.info.max_speed
    hold(simulated, most, 1.0, factor=factor)
    assert speed(simulated) == pytest.approx(factor * most, abs=0.01)


@pytest.mark.parametrize(("late", "share"), [(0.1, 1.0), (0.6, 0.5), (1.2, 0.0)])
def test_a_real_robot_goes_the_slower_the_later_its_loop_is(scene: Scene, late: float, share: float) -> None:
    most = scene.station.info.max_speed
    hold(scene, most, 1.0, factor=0.1, late=late)
    assert speed(scene) == pytest.approx(share * most, abs=0.01)


def test_a_task_waits_while_the_robot_must_rest_and_goes_on_by_itself(simulated: Scene) -> None:
    simulated.set(*SQUARE, laps=1)
    simulated.start()
    lag(simulated, 3.0)
    lag(simulated, 3.0, factor=0.1)
    assert simulated.robot.at_rest
    assert (simulated.task.state, simulated.task.phase) == ("RUNNING", "waiting")
    assert simulated.task.code == Code.TASK_LOOP_LATE
    lag(simulated, 3.0)
    assert simulated.task.phase == "driving"
    assert not simulated.robot.at_rest
    assert simulated.run_task().state == "SUCCEEDED"


def test_it_is_told_in_diagnostics_and_to_operators(simulated: Scene) -> None:
    lag(simulated, 2.0)
    assert (told(simulated, "simulation").level, simulated.control.loop_cap) == (0, 1.0)
    lag(simulated, 3.0, factor=0.4, late=0.7)
    status = told(simulated, "simulation")
    assert (status.level, status.message) == (1, "0.4 of real time, 0.7 s behind")
    assert {pair.key: pair.value for pair in status.values} == {
        "real_time_factor": "0.40",
        "lag": "0.70",
        "speed_share": "0.40",
    }
    control = simulated.control
    assert (control.loop_cap, control.real_time_factor, control.loop_lag) == (pytest.approx(0.4), 0.4, 0.5)
    lag(simulated, 3.0, factor=0.1, late=1.0)
    assert told(simulated, "simulation").level == 2
    assert simulated.control.loop_cap == 0.0


def test_a_real_robot_tells_of_its_control_loop(scene: Scene) -> None:
    lag(scene, 3.0, late=0.6)
    status = told(scene, "control loop")
    assert (status.level, status.message) == (1, "0.6 s late")
    assert codes(scene) == [Code.LOOP_LATE]
    assert scene.control.real_time_factor == 1.0


def test_an_event_says_it_once_when_it_lasts_and_once_when_it_is_over(simulated: Scene) -> None:
    lag(simulated, LATE_TIME - 0.5, factor=0.4)
    assert codes(simulated) == [], "a moment is not worth an event"
    lag(simulated, 10.0, factor=0.4)
    assert codes(simulated) == [Code.SIMULATION_SLOW]
    assert simulated.events("robot")[-1].startswith("Simulation at 0.4 of real time")
    for _ in range(5):  # to and fro
        lag(simulated, 3.0, factor=1.0)
        lag(simulated, 1.0, factor=0.5)
    assert codes(simulated) == [Code.SIMULATION_SLOW]
    lag(simulated, ON_TIME_TIME + 3.0)
    assert codes(simulated) == [Code.SIMULATION_SLOW, Code.LOOP_ON_TIME]


def test_that_nothing_was_measured_while_the_clock_jumped_is_no_silence(simulated: Scene) -> None:
    simulated.set(*SQUARE, laps=1)
    simulated.start()
    simulated.run(1.0)
    simulated.now += 1.5
    simulated.station.loop.skip(simulated.now, 1.5)
    assert simulated.robot.skipped == simulated.now  # type: ignore[attr-defined]
    assert simulated.station.autonomy.silence(simulated.now) == ""
    assert simulated.station.readiness.sensor_health.silent(simulated.now) == []
    simulated.run(0.1)
    assert simulated.task.state == "RUNNING"


def jump(scene: Scene, seconds: float) -> None:
    """The robot's clock goes on by so much, in which nothing happens."""
    scene.now += seconds
    scene.robot._origin += seconds
    scene.station.loop.skip(scene.now, seconds)


def test_time_that_is_given_up_is_none_in_which_the_robot_got_nowhere(simulated: Scene) -> None:
    """As at ten times real time on a busy computer: of some minutes it has as many seconds to drive in."""
    simulated.set(*SQUARE, laps=1)
    simulated.start()
    for _ in range(60):
        simulated.run(0.05)
        jump(simulated, 4.0)
    assert "way to" not in simulated.task.reason
    assert simulated.run_task().state == "SUCCEEDED"


def test_nor_one_in_which_a_blocked_way_was_waited_for(simulated: Scene) -> None:
    simulated.run(2.0)  # until it is sure of its place
    simulated.robot.pillars = [Pillar(2.0, 0.2 * number) for number in range(-31, 32)]
    simulated.go_to(4.0, 0.0)
    simulated.until(lambda: simulated.task.phase == "waiting", 20.0)
    for _ in range(20):
        simulated.run(0.3)
        jump(simulated, 4.0)
    assert (simulated.task.state, simulated.task.phase) == ("RUNNING", "waiting")


class Slow(Simulated):
    """A simulation of which a second takes seven."""

    def __init__(self, wall: list[float]) -> None:
        super().__init__()
        self._wall, self._read_at = wall, wall[0]

    def skip_to(self, now: float) -> None:
        super().skip_to(now)
        if self._origin is not None:
            self._origin += now - self._read_at

    def read(self, now: float) -> Iterator[tuple[str, Msg]]:
        self._wall[0] += 7.0 * max(0.0, now - max(self._read_at, self.skipped))
        self._read_at = now
        return super().read(now)


class Quiet:
    """A station that listens nowhere."""

    def __init__(self, station: Station) -> None:
        self.station = station

    @asynccontextmanager
    async def listening(self) -> AsyncIterator[RunningServer]:
        async def leave() -> None:
            """It has nothing to end."""

        yield RunningServer((), leave)


async def test_the_data_of_a_simulation_at_a_seventh_of_real_time_are_fresh_and_it_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fleet_server, "WANTED_PERIOD", 0.0)
    monkeypatch.setattr(fleet_server, "TICK_PERIOD", 1e-3)
    wall = [1000.0]

    def passes() -> float:
        wall[0] += 1e-3
        return wall[0]

    scene = Scene(Slow(wall), tmp_path)
    ages: list[float] = []
    scene.station.bus.subscribe(
        "/odom",
        lambda _, msg: ages.append(wall[0] - msg.header.stamp.seconds) if isinstance(msg, Odometry) else None,
        replay=False,
    )
    server = FleetServer([Quiet(scene.station)], RobotClock(1000.0), passes, wanted=lambda: wall[0] < 1030.0)
    scene.station.loop.update(1.0, 0.0, 0.0)
    await server.run(lambda _: None)
    assert wall[0] > 1030.0
    assert max(ages) < 1.5, "with all of it made good they are 26 s old after half a minute"
    assert scene.control.loop_cap == 0.0
    assert isinstance(scene.control, ControlStatus)
    assert told(scene, "simulation").level == 2
    assert Code.SIMULATION_SLOW in codes(scene)
