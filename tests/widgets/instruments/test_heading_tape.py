from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Quaternion
from bridge.msgs.sensor_msgs import Imu
from widgets.core.base import text_texture
from widgets.core.shapes import Shapes
from widgets.instruments.heading_tape import HeadingTape, samples


@pytest.fixture
def tape(stage):
    return stage.show(HeadingTape(span=75), size=(450, 52))


def labels(tape: HeadingTape) -> dict[str, float]:
    return {word.text: word.x for word in tape._strip(Shapes())}


def test_the_own_heading_is_in_the_middle(tape):
    tape.heading = 90
    assert labels(tape)["E"] == pytest.approx(tape.center_x)


def test_a_heading_is_taken_before_there_is_any_room(stage):
    tape = HeadingTape(size=(0, 0))
    tape.show(Imu(orientation=Quaternion.from_yaw(0.0)))
    assert tape.heading == pytest.approx(90.0)


def test_larger_headings_are_to_the_right(tape):
    tape.heading = 95
    assert labels(tape)["E"] == pytest.approx(225 - 5 * 6)
    assert labels(tape)["105"] == pytest.approx(225 + 10 * 6)


def test_the_strip_goes_on_over_north(tape):
    tape.heading = 358
    assert list(labels(tape)) == ["330", "345", "N", "15", "30"]


@pytest.mark.parametrize(("own", "other", "place"), [(358, 2, 24), (2, 358, -24), (90, 90, 0)])
def test_a_heading_lies_the_short_way_from_the_middle(tape, own, other, place):
    tape.heading = own
    assert tape.place_of(other) == pytest.approx(place)


@pytest.mark.parametrize("state", ["stale", "alarm"])
def test_the_strip_ends_before_the_sign_of_a_state(tape, state):
    tape.heading, tape.age = 95, 5.0
    assert "120" in labels(tape)
    tape.heading = 90
    assert tape.place_of(120) < 200
    tape.state = state
    sign = tape.badge_pos[0] if state == "stale" else tape.right - tape.alarm_texture.width - 6
    shapes = Shapes()
    words = list(tape._strip(shapes))
    vertices = shapes.arrays()[0].reshape(-1, 12)
    assert vertices[:, 0].max() < sign
    assert all(word.x + text_texture(word.text, word.size).width / 2 < sign for word in words)


def test_noise_that_is_not_seen_draws_nothing_anew(tape, stage, monkeypatch):
    def imu(heading: float) -> Imu:
        return Imu(orientation=Quaternion.from_yaw(math.radians(90 - heading)))

    tape.show(imu(90.0))
    stage.frames()
    drawn: list[float] = []
    monkeypatch.setattr(HeadingTape, "draw", lambda self: drawn.append(self.heading))
    for heading in (90.02, 89.97, 90.03):  # a sixth of a pixel
        tape.show(imu(heading))
        stage.frames()
    assert drawn == []
    tape.show(imu(90.05))
    stage.frames()
    assert drawn == [pytest.approx(90.05)]


def test_an_imu_sets_the_heading(tape):
    tape.show(Imu(orientation=Quaternion.from_yaw(math.pi)))
    assert tape.heading == pytest.approx(270)


def test_an_unknown_heading_is_a_dash(tape, stage):
    tape.show(Imu(orientation_covariance=[-1.0] + [0.0] * 8))
    stage.frames()
    assert math.isnan(tape.heading)
    assert tape._words.texts == ["–"]


@pytest.mark.parametrize("name", samples())
def test_every_sample_can_be_shown(stage, name):
    assert stage.show(samples()[name]()).width == 420
