from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Quaternion
from bridge.msgs.sensor_msgs import Imu
from widgets.core.theme import theme
from widgets.instruments.horizon import RUNG, ArtificialHorizon, samples

TEN = math.pi / 18


@pytest.fixture
def horizon(stage):
    return stage.show(ArtificialHorizon(), size=(206, 206))


def imu(roll: float, pitch: float) -> Imu:
    return Imu(orientation=Quaternion.from_rpy(roll, pitch, 1.0))


def test_roll_and_pitch_come_from_the_orientation(horizon):
    horizon.show(imu(0.3, -0.2))
    assert horizon.roll == pytest.approx(0.3)
    assert horizon.pitch == pytest.approx(-0.2)


def test_noise_that_is_not_seen_draws_nothing_anew(horizon, stage, monkeypatch):
    horizon.show(imu(0.3, -0.2))
    stage.frames()
    drawn: list[float] = []
    monkeypatch.setattr(ArtificialHorizon, "draw", lambda self: drawn.append(self.roll))
    for noise in (0.001, -0.001, 0.0015):
        horizon.show(imu(0.3 + noise, -0.2 - noise))
        stage.frames()
    assert drawn == []
    horizon.show(imu(0.302, -0.2))
    horizon.show(imu(0.302, -0.204))
    stage.frames()
    assert drawn == [pytest.approx(0.302)]
    assert horizon.pitch == pytest.approx(-0.204)


def test_with_the_right_side_down_the_world_turns_anticlockwise(horizon, stage):
    horizon.show(imu(TEN, 0.0))
    stage.frames()
    assert horizon._turn.angle == pytest.approx(10)
    assert horizon._world["roll"] == pytest.approx(TEN)


def test_with_the_nose_down_the_horizon_rises(horizon):
    horizon.show(imu(0.0, TEN))
    assert horizon.rise == pytest.approx(RUNG * horizon.radius)
    assert horizon.horizon == horizon.rise


def test_with_the_nose_up_the_horizon_sinks(horizon):
    horizon.show(imu(0.0, -TEN))
    assert horizon.rise == pytest.approx(-RUNG * horizon.radius)


def test_a_steep_pitch_leaves_some_sky(horizon):
    horizon.show(imu(0.0, 1.4))
    assert horizon.horizon == pytest.approx(0.8 * horizon.radius)


def ladder(horizon: ArtificialHorizon) -> list[tuple[str, float]]:
    return [(word.text, word.y) for word in horizon._ladder_texts()]


def test_the_ladder_moves_with_the_horizon_and_keeps_off_the_rim(horizon):
    horizon.show(imu(0.0, 0.0))
    level = ladder(horizon)
    assert [text for text, _ in level] == ["20", "10", "10", "20"]
    horizon.show(imu(0.0, TEN / 2))
    assert ladder(horizon)[0][1] == pytest.approx(level[0][1] + RUNG * horizon.radius / 2)


def test_far_from_level_no_rung_is_numbered_wrongly(horizon):
    horizon.show(imu(0.0, 1.4))
    assert ladder(horizon) == []


def test_an_imu_without_orientation_shows_a_dash_and_no_horizon(horizon, stage):
    horizon.show(imu(0.2, 0.1))
    horizon.show(Imu(orientation_covariance=[-1.0] + [0.0] * 8))
    stage.frames()
    assert not horizon.known
    assert horizon._words.texts == ["–"]
    assert horizon._world["rise"] > horizon.radius


def test_the_dash_goes_with_the_first_attitude(horizon, stage):
    assert horizon._words.texts == ["–"]
    horizon.show(imu(0.2, 0.1))
    stage.frames()
    assert horizon._words.texts == []


@pytest.mark.parametrize("name", samples())
def test_every_sample_can_be_shown(stage, name):
    assert stage.show(samples()[name]()).width == 194


def test_a_world_that_is_told_only_what_is_new_follows_theme_and_room(stage):
    horizon = stage.show(ArtificialHorizon(roll=0.2, pitch=0.1, state="live"), size=(200, 200))
    stage.frames()
    names = ("radius", "roll", "rise", "true_rise", "rung", "sky", "ground", "ink")
    before = [horizon._world[name] for name in names]
    theme.name = "sunlight"
    try:
        horizon.size = 150, 150
        stage.frames()
        fresh = ArtificialHorizon(roll=0.2, pitch=0.1, state="live", size=(150, 150))
        fresh.draw()
        after = [horizon._world[name] for name in names]
        assert after == [fresh._world[name] for name in names]
        assert [one == other for one, other in zip(before, after, strict=True)].count(True) == 1  # the roll
    finally:
        theme.name = "dark"
