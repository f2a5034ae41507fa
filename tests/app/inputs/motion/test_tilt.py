"""From a tablet that is tilted to shares of full command: shape, clutch, and what opens it."""

from __future__ import annotations

import math
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.device.motion import GRAVITY, Axes, leaned
from app.inputs.motion.tilt import Level, OneEuro, Tilt, TiltSettings, between, shaped, turned

FLAT: Axes = (0.0, 0.0, GRAVITY)
DEGREES = st.floats(-60, 60)
TICK = 0.03


def lean(roll: float, pitch: float) -> Axes:
    return leaned(math.radians(roll), math.radians(pitch))


class Hand:
    """Holds a tablet: samples at 50 Hz and heartbeats, by a clock of its own."""

    def __init__(self, **settings: object) -> None:
        self.tilt, self.now, self.axes = Tilt(TiltSettings(**settings)), 0.0, FLAT  # type: ignore[arg-type]

    def hold(self, seconds: float, axes: Axes | None = None) -> tuple[float, float]:
        self.axes = axes or self.axes
        for _ in range(round(seconds / 0.02)):
            self.now += 0.02
            self.tilt.feed(self.now, self.axes)
            self.tilt.feel(self.now, self.axes)
            self.said = self.tilt.update(self.now)
        return self.said

    def pressed(self, axes: Axes = FLAT) -> Hand:
        self.hold(0.4, axes)
        self.tilt.press(self.now)
        return self


# what a tilt means


def test_right_side_down_is_to_the_right_and_upper_edge_down_is_ahead() -> None:
    assert between(FLAT, lean(20, 0)) == (pytest.approx(20), pytest.approx(0))
    assert between(FLAT, lean(0, 20)) == (pytest.approx(0), pytest.approx(20))


@given(st.floats(-70, 70), st.floats(-70, 70), st.floats(0, 40), st.floats(-3, 3))
def test_however_it_is_held_a_turn_of_so_many_degrees_is_that_many(
    roll: float, pitch: float, angle: float, way: float
) -> None:
    neutral = lean(roll, pitch)
    right, ahead = _axes_at(neutral)
    c, s, to = math.cos(math.radians(angle)), math.sin(math.radians(angle)), (math.cos(way), math.sin(way))
    side = [-(to[0] * r + to[1] * a) * GRAVITY for r, a in zip(right, ahead, strict=True)]
    now = tuple(c * n + s * o for n, o in zip(neutral, side, strict=True))
    found = between(neutral, now)  # type: ignore[arg-type]
    assert found == (pytest.approx(angle * to[0], abs=1e-6), pytest.approx(angle * to[1], abs=1e-6))


def _axes_at(up: Axes) -> tuple[list[float], list[float]]:
    x, y, z = (value / GRAVITY for value in up)
    along = math.sqrt(1 - x * x)
    right = [(1 - x * x) / along, -x * y / along, -x * z / along]
    ahead = [y * right[2] - z * right[1], z * right[0] - x * right[2], x * right[1] - y * right[0]]
    return right, ahead


def test_a_screen_on_its_side_is_steered_by_too() -> None:
    upright = (GRAVITY, 0.0, 0.0)
    assert all(math.isfinite(value) for value in between(upright, (GRAVITY, 2.0, 1.0)))


@pytest.mark.parametrize("quarters", range(4))
def test_a_turned_screen_steers_by_its_own_edges(quarters: int) -> None:
    x, y, z = lean(10, 25)
    device = ((x, y, z), (y, -x, z), (-x, -y, z), (-y, x, z))[quarters]
    assert turned(device, quarters) == pytest.approx((x, y, z))


# the curve


@given(st.floats(0, 60), st.floats(0, 60), st.floats(-math.pi, math.pi), st.floats(0, 0.8))
def test_more_tilt_is_never_less_command(less: float, more: float, way: float, expo: float) -> None:
    less, more = sorted((less, more))
    settings = TiltSettings(expo=expo)
    small, large = (math.hypot(*shaped(t * math.cos(way), t * math.sin(way), settings)) for t in (less, more))
    assert 0.0 <= small <= large + 1e-12 <= 1.0 + 2e-12


@given(DEGREES, DEGREES)
def test_the_other_way_is_the_same_the_other_way(roll: float, pitch: float) -> None:
    right, ahead = shaped(roll, pitch, TiltSettings())
    assert shaped(-roll, -pitch, TiltSettings()) == (pytest.approx(-right), pytest.approx(-ahead))


def test_the_dead_zone_ends_without_a_step_and_full_is_full() -> None:
    settings = TiltSettings(dead=4.0, full=25.0)
    assert shaped(0.0, 4.0, settings) == (0.0, 0.0)
    assert 0.0 < shaped(0.0, 4.01, settings)[1] < 0.001
    assert shaped(0.0, 25.0, settings)[1] == shaped(0.0, 50.0, settings)[1] == pytest.approx(1.0)


@pytest.mark.parametrize("walking", [False, True])
def test_who_tilts_ahead_does_not_turn_by_a_wobble_nor_the_other_way_round(walking: bool) -> None:
    settings = TiltSettings(walking=walking)
    within, beyond = settings.zone - 0.1, settings.zone + 2.0
    assert shaped(within, 16.0, settings)[0] == shaped(-within, 16.0, settings)[0] == 0.0
    assert shaped(16.0, within, settings)[1] == 0.0
    assert shaped(within, 16.0, settings)[1] > 0.3
    assert 0.0 < shaped(beyond, 16.0, settings)[0] < shaped(beyond + 2.0, 16.0, settings)[0]


@pytest.mark.parametrize("tilt", [8.5, 12.0, 25.0])
def test_aslant_is_steered_aslant_however_little(tilt: float) -> None:
    right, ahead = shaped(tilt * math.sqrt(0.5), -tilt * math.sqrt(0.5), TiltSettings(walking=True))
    assert right == pytest.approx(-ahead)
    assert right > 0.0


@given(st.floats(9, 40), st.floats(-math.pi, math.pi))
def test_the_dead_zone_across_takes_nothing_off_the_command_and_has_no_step(tilt: float, way: float) -> None:
    settings = TiltSettings(walking=True)
    told = shaped(tilt * math.sin(way), tilt * math.cos(way), settings)
    near = shaped(tilt * math.sin(way + 1e-6), tilt * math.cos(way + 1e-6), settings)
    assert math.hypot(*told) == pytest.approx(math.hypot(*shaped(0.0, tilt, settings)))
    assert math.dist(told, near) < 1e-4


def test_what_is_no_number_commands_nothing() -> None:
    assert shaped(math.nan, 20.0, TiltSettings()) == (0.0, 0.0)


def test_each_way_can_be_inverted() -> None:
    right, ahead = shaped(15, 15, TiltSettings())
    assert shaped(15, 15, TiltSettings(invert_roll=True)) == (-right, ahead)
    assert shaped(15, 15, TiltSettings(invert_pitch=True)) == (right, -ahead)


# the clutch


def test_nothing_is_commanded_before_the_clutch_is_pressed() -> None:
    hand = Hand()
    assert hand.hold(1.0, lean(0, 30)) == (0.0, 0.0)


def test_neutral_is_however_it_was_held_when_the_clutch_was_pressed() -> None:
    hand = Hand().pressed(lean(10, -40))
    assert hand.hold(0.5) == (0.0, 0.0)
    assert hand.hold(1.0, lean(10, -10))[1] == pytest.approx(1.0, abs=0.02)


def test_released_it_is_zero_at_the_next_look() -> None:
    hand = Hand().pressed()
    assert hand.hold(1.0, lean(0, 30))[1] == pytest.approx(1.0)
    hand.tilt.release()
    assert hand.tilt.update(hand.now) == (0.0, 0.0)


def test_a_command_grows_slowly_and_goes_fast() -> None:
    hand = Hand().pressed()
    assert 0.1 < hand.hold(0.1, lean(0, 35))[1] < 0.3
    assert hand.hold(1.0)[1] == pytest.approx(1.0)
    assert hand.hold(0.4, FLAT)[1] < 0.1


def test_pressed_before_a_sample_came_it_closes_when_they_do() -> None:
    hand = Hand()
    hand.tilt.press(hand.now)
    assert not hand.tilt.closed
    hand.hold(0.1)
    assert hand.tilt.closed


def test_silence_opens_it_and_only_a_new_press_closes_it() -> None:
    hand = Hand().pressed()
    hand.hold(1.0, lean(0, 30))
    assert hand.tilt.update(hand.now + 0.29)[1] > 0.9
    assert hand.tilt.update(hand.now + 0.31) == (0.0, 0.0)
    assert "silent" in hand.tilt.why
    hand.now += 0.31
    assert hand.hold(1.0, lean(0, 40)) == (0.0, 0.0)
    hand.tilt.release()
    hand.tilt.press(hand.now)
    hand.hold(0.1)
    assert hand.tilt.closed
    assert hand.tilt.why == ""


@pytest.mark.parametrize("sample", [(math.nan, 0.0, 9.8), (math.inf, 0.0, 0.0), (0.0, 0.0, 0.0)])
def test_samples_that_are_no_numbers_are_silence(sample: Axes) -> None:
    hand = Hand().pressed()
    hand.hold(1.0, lean(0, 30))
    assert hand.hold(0.4, sample) == (0.0, 0.0)
    assert "silent" in hand.tilt.why


def test_tilted_too_far_for_half_a_second_opens_it() -> None:
    hand = Hand().pressed()
    assert hand.hold(0.5, lean(0, 70))[1] > 0.9
    assert hand.hold(0.3) == (0.0, 0.0)
    assert "50°" in hand.tilt.why


def test_a_fall_opens_it_and_steps_do_not() -> None:
    hand = Hand().pressed()
    hand.hold(1.0, lean(0, 30))
    for n in range(50):  # a walker's steps, 0.5 s each
        hand.now += 0.02
        hand.tilt.feel(hand.now, (0.0, 0.0, GRAVITY + 8 * math.sin(n * 0.02 * 4 * math.pi)))
        hand.tilt.feed(hand.now, hand.axes)
    assert hand.tilt.closed
    for _ in range(17):
        hand.now += 0.02
        hand.tilt.feel(hand.now, (0.1, 0.0, 0.2))
        hand.tilt.feed(hand.now, hand.axes)
    assert hand.tilt.update(hand.now) == (0.0, 0.0)
    assert "falls" in hand.tilt.why


def test_where_neutral_is_set_it_drives_once_the_tablet_has_been_there() -> None:
    hand = Hand()
    hand.tilt.neutral = lean(0, 20)
    hand.pressed(FLAT)
    assert hand.hold(1.0) == (0.0, 0.0)
    hand.hold(1.0, lean(0, 20))
    assert hand.hold(1.0, FLAT)[1] < -0.5


def test_one_who_walks_drifts_and_commands_nothing_but_what_is_meant_stays() -> None:
    hand = Hand(walking=True).pressed()
    for n in range(300):
        assert hand.hold(0.1, lean(0, n * 0.06)) == (0.0, 0.0)
    before = hand.hold(2.0, lean(0, 40))[1]
    assert hand.hold(10.0)[1] == pytest.approx(before)


def test_a_walkers_steps_on_the_accelerometer_alone_command_next_to_nothing() -> None:
    random.seed(4)
    hand, level, told = Hand(walking=True), Level(), []
    hand.pressed()
    for n in range(1500):
        hand.now += 0.02
        step = math.sin(n * 0.02 * 2 * math.pi * 1.85)
        a = (2 * step + random.gauss(0, 1), 1.5 * step + random.gauss(0, 1), 9.8 + 3 * step)
        hand.tilt.feed(hand.now, level(hand.now, a))
        told.append(math.hypot(*hand.tilt.update(hand.now)))
    assert sum(told) / len(told) < 0.02
    assert sum(one > 0 for one in told) < 0.05 * len(told)


def test_the_circle_is_where_the_tablet_is_and_never_beyond_the_rim() -> None:
    hand = Hand().pressed()
    hand.hold(0.4, lean(-45, 0))
    assert hand.tilt.at == (pytest.approx(-1.0, abs=0.1), pytest.approx(0.0, abs=1e-6))


# the filter, and what is kept


def test_the_filter_is_quick_where_it_moves_and_steady_where_it_rests() -> None:
    steady, quick = OneEuro(1.0, 0.0), OneEuro(1.0, 0.1)
    for one in (steady, quick):
        one(0.0, 0.0)
    assert quick(0.02, 20.0) > 2 * steady(0.02, 20.0) > 0.0
    assert quick(0.02, 500.0) == quick(0.02, -500.0), "no time has gone by"


def test_settings_that_are_no_good_are_said_and_as_at_first() -> None:
    settings, faults = TiltSettings.of({"full": 90, "dead": "wide", "walking": 1, "expo": 0.2, "odd": 3})
    assert settings == TiltSettings(expo=0.2)
    assert [fault.split()[1] for fault in faults] == ["full", "dead", "walking"]
    assert "90 and must be 15 to 40" in faults[0]
    assert TiltSettings.of(settings.save()) == (settings, [])
    assert TiltSettings.of("nonsense") == (TiltSettings(), [])
