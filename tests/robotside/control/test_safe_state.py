"""What robots of each kind do when nobody drives them: on simple bodies of that kind, in virtual time."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import pytest
from msgspec.structs import replace

from bridge.msgs.geometry_msgs import Twist
from robotside.control.safe_state import GROUND, MAX_ENDING_TIME, SURFACE, Act, SafeState
from robotside.core.config import DEFAULT_CONFIG, SafeStateSettings
from robotside.core.pose2 import Pose2
from robotside.motion.measured import MeasuredState
from robotside.motion.stopping_path import PlanarVelocity

TICK = 1 / 20


@dataclass
class Body:
    """Moves as told with some lag; what pushes it, pushes it all the time."""

    kind: str
    settings: SafeStateSettings = DEFAULT_CONFIG.safe_state
    height: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    speed: float = 0.0
    yaw: float = 0.5
    turning: float = 0.0
    """What pushes it round [rad/s]."""
    falling: float = 0.0
    """What pushes it down [m/s]."""
    now: float = 100.0
    blind: bool = False
    acts: list[Act] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.safe = SafeState(self.kind, self.settings)

    @property
    def measured(self) -> MeasuredState:
        seen = MeasuredState(
            Pose2(0.0, 0.0, self.yaw),
            PlanarVelocity(self.speed, 0.0, 0.0),
            self.height,
            self.roll,
            self.pitch,
        )
        return (
            replace(seen, pose=None, height=math.nan, moving=PlanarVelocity(0.3, 0.0, 0.0))
            if self.blind
            else seen
        )

    def lose(self, seconds: float, *, lost: bool = True) -> Act:
        self.safe.enter(self.now, self.measured)
        for _ in range(round(seconds / TICK)):
            act = self.safe.step(self.now, self.measured, lost=lost)
            self.acts.append(act)
            self._move(act.twist or Twist())
            self.now += TICK
        return self.acts[-1]

    def _move(self, twist: Twist) -> None:
        self.speed = max(0.0, self.speed - 1.5 * TICK) if twist.linear.x == 0 else twist.linear.x
        self.yaw += (twist.angular.z + self.turning) * TICK
        self.roll += twist.angular.x * TICK
        self.pitch += twist.angular.y * TICK
        self.height += (twist.linear.z - self.falling) * TICK

    @property
    def phases(self) -> list[str]:
        return list(dict.fromkeys(act.phase for act in self.acts))


def test_wheels_brake_and_stay() -> None:
    body = Body("wheels", speed=0.7)
    body.lose(60.0)
    assert {act.twist for act in body.acts} == {None}
    assert body.safe.brakes


def test_a_truck_brakes_with_its_wheels_straight_and_then_stays() -> None:
    body = Body("ackermann", speed=2.0)
    body.lose(0.5)
    assert {act.twist for act in body.acts} == {Twist()}
    body.lose(3.0)
    assert body.phases == ["brakes straight", "is at rest"]
    assert body.acts[-1].twist is None


def test_a_truck_that_does_not_tell_its_speed_stops_in_the_end() -> None:
    body = Body("ackermann", blind=True)
    assert body.lose(9.0).twist == Twist()
    assert body.lose(2.0).twist is None


def test_a_boat_idles_and_holds_its_heading_against_the_wind() -> None:
    body = Body("boat", yaw=3.0, turning=0.1)
    body.lose(60.0)
    assert abs(body.yaw - 3.0) < 0.15
    assert {act.twist.linear.x for act in body.acts if act.twist} == {0.0}
    assert body.phases == ["idles and holds its heading"]


def test_a_heading_is_held_the_short_way_round() -> None:
    body = Body("boat", yaw=math.pi - 0.1)
    body.safe.enter(100.0, body.measured)
    body.yaw = -math.pi + 0.1
    twist = body.safe.step(101.0, body.measured, lost=True).twist
    assert twist is not None
    assert -0.2 < twist.angular.z < 0


def test_a_hexapod_levels_holds_its_depth_for_a_time_and_then_surfaces() -> None:
    body = Body("hexapod", height=-3.0, roll=0.3, pitch=-0.2, falling=0.05)
    body.lose(50.0)
    assert abs(body.height + 3.0) < 0.1
    assert max(abs(body.roll), abs(body.pitch)) < 0.01
    body.lose(9.9)
    assert body.phases == ["holds its depth"]
    body.lose(30.0)
    assert body.phases == ["holds its depth", "surfaces", "has surfaced"]
    assert body.height >= SURFACE
    assert body.acts[-1].twist is None


def test_a_hexapod_that_does_not_measure_its_depth_rises_for_a_bounded_time() -> None:
    body = Body("hexapod", SafeStateSettings(hold_for=1.0), height=-3.0, blind=True)
    body.lose(MAX_ENDING_TIME)
    assert body.acts[-1].phase == "surfaces"
    assert body.lose(2.0).twist is None


def test_a_quadrotor_hovers_and_then_lands_without_turning() -> None:
    body = Body("quadrotor", height=4.0, turning=0.02)
    body.lose(9.9)
    assert body.phases == ["hovers"]
    assert abs(body.height - 4.0) < 0.05
    body.lose(12.0)
    assert abs(body.yaw - 0.5) < 0.1
    body.lose(10.0)
    assert body.phases == ["hovers", "lands", "has landed"]
    assert body.height <= GROUND


def test_a_quadrotor_that_is_told_to_return_goes_home_and_lands_when_it_cannot() -> None:
    body = Body("quadrotor", SafeStateSettings(then="return", hold_for=2.0), height=4.0)
    assert body.lose(2.5).home
    body.safe.cannot_return()
    assert body.lose(1.0).phase == "lands"
    body.safe.leave()
    body.lose(2.5)
    assert body.acts[-1].home


def test_while_somebody_is_there_who_could_drive_it_goes_on_holding() -> None:
    body = Body("quadrotor", height=4.0)
    body.lose(60.0, lost=False)
    assert body.phases == ["hovers"]


def test_somebody_who_comes_while_it_lands_finds_it_hovering_where_it_is() -> None:
    body = Body("quadrotor", height=6.0)
    body.lose(14.0)
    assert body.phases == ["hovers", "lands"]
    height = body.height
    body.lose(20.0, lost=False)
    assert abs(body.height - height) < 0.05
    body.lose(9.0)
    assert body.acts[-1].phase == "hovers"
    body.lose(2.0)
    assert body.acts[-1].phase == "lands"


def test_it_is_left_as_soon_as_it_is_driven_and_begins_anew_afterwards() -> None:
    body = Body("quadrotor", height=4.0)
    body.lose(12.0)
    body.safe.leave()
    assert not body.safe.active
    assert body.lose(5.0).phase == "hovers"


@pytest.mark.parametrize("action", ["brake", "hold_heading", "hover"])
def test_the_configuration_goes_before_the_kind(action: str) -> None:
    settings = SafeStateSettings(action=action)  # type: ignore[arg-type]
    body = Body("hexapod", settings, height=-2.0)
    phase = {"brake": "brakes", "hold_heading": "idles and holds its heading", "hover": "hovers"}[action]
    assert body.lose(1.0).phase == phase


def test_wheels_may_be_told_to_come_home_after_a_while() -> None:
    body = Body("wheels", SafeStateSettings(then="return"))
    assert not body.safe.brakes
    assert not body.lose(29.9).home
    assert body.lose(0.2).home


def test_an_unknown_kind_brakes() -> None:
    assert Body("balloon").lose(1.0).twist is None


@pytest.mark.parametrize("kind", ["quadrotor", "hexapod"])
def test_one_that_does_not_know_its_height_neither_climbs_nor_sinks_while_it_holds(kind: str) -> None:
    body = Body(kind, blind=True)
    body.lose(5.0, lost=False)
    assert {act.twist.linear.z for act in body.acts if act.twist} == {0.0}


def test_one_that_lands_without_knowing_its_height_stops_landing_after_a_while() -> None:
    body = Body("quadrotor", blind=True, height=2.0)
    assert body.lose(MAX_ENDING_TIME).phase == "lands"
    assert body.lose(15.0).phase == "has landed"
    assert body.acts[-1].twist is None


def test_a_swimmer_that_charges_does_not_surface_out_of_its_cage_until_the_charge_is_lost() -> None:
    safe = SafeState("hexapod", DEFAULT_CONFIG.safe_state)
    docked = MeasuredState(height=-1.5, charging=True)
    safe.enter(0.0, docked)
    assert {safe.step(10.0 * n, docked, lost=True).phase for n in range(100)} == {"holds its depth"}
    loose = replace(docked, charging=False)
    safe.step(1000.0, loose, lost=True)
    assert safe.step(1061.0, loose, lost=True).phase == "surfaces"
