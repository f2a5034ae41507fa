from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Quaternion
from bridge.msgs.sensor_msgs import Imu
from widgets.core.shapes import FLOATS
from widgets.core.theme import theme
from widgets.instruments.heading_tape import HeadingTape, samples

PIXEL = 0.5
"""Words lie on whole pixels."""


@pytest.fixture
def tape(stage):
    return stage.show(HeadingTape(span=75), size=(450, 52))


def words(tape: HeadingTape) -> list[tuple[str, float, float, float]]:
    """Of each word that is seen: text, middle, right end [px], opacity."""
    tape.draw()
    slots = zip(tape._words.texts, tape._words._slots, strict=False)
    seen = [(text, one.pos[0], one.size[0], colour.a) for text, (colour, one) in slots if colour.a]
    return [(text, left + wide / 2, left + wide, strength) for text, left, wide, strength in seen]


def labels(tape: HeadingTape) -> dict[str, float]:
    return {text: middle for text, middle, *_ in words(tape)}


def ticks(tape: HeadingTape) -> np.ndarray:
    """Vertices of the ticks that are seen, shape (n, 12)."""
    tape.draw()
    made = np.asarray(tape._ticks.vertices).reshape(-1, FLOATS)
    return made[made[:, 11] > 0]


def test_the_own_heading_is_in_the_middle(tape):
    tape.heading = 90
    assert labels(tape)["E"] == pytest.approx(tape.center_x, abs=PIXEL)


def test_a_heading_is_taken_before_there_is_any_room(stage):
    tape = HeadingTape(size=(0, 0))
    tape.show(Imu(orientation=Quaternion.from_yaw(0.0)))
    assert tape.heading == pytest.approx(90.0)


def test_larger_headings_are_to_the_right(tape):
    tape.heading = 95
    assert labels(tape)["E"] == pytest.approx(225 - 5 * 6, abs=PIXEL)
    assert labels(tape)["105"] == pytest.approx(225 + 10 * 6, abs=PIXEL)


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
    assert ticks(tape)[:, 0].max() < sign
    assert max(right for _, _, right, _ in words(tape)) < sign


def looks(tape: HeadingTape) -> tuple[object, ...]:
    pointers = np.asarray(tape._pointers.vertices).tolist()
    return ticks(tape).tolist(), pointers, words(tape)


@pytest.mark.parametrize("heading", [0.0, 7.4, 14.999, 15.0, 96.2, 359.99, 15.0 - 1e-13])
@pytest.mark.parametrize("wanted", [math.nan, 30.0])
def test_a_strip_that_slid_looks_like_one_that_is_new(tape, stage, heading, wanted):
    tape.state = "live"
    for before in (350.0, 42.0, math.nan, 3.0, heading):
        tape.heading, tape.wanted = before, wanted
        stage.frames()
    fresh = HeadingTape(size=tape.size, pos=tape.pos, heading=heading, wanted=wanted, state="live")
    fresh.draw()
    assert looks(tape) == looks(fresh)


@pytest.mark.parametrize(
    "change",
    [
        {"size": (250, 52)},
        {"size": (450, 90)},
        {"pos": (40, 30)},
        {"span": 40.0},
        {"state": "alarm"},
        {"state": "stale", "age": 70.0},
        {"size": (12, 30)},
    ],
    ids=str,
)
def test_a_strip_follows_its_room_and_its_state(tape, stage, change):
    tape.heading, tape.state = 95.0, "live"
    stage.frames()
    before = looks(tape)
    for name, value in change.items():
        setattr(tape, name, value)
    stage.frames()
    assert looks(tape) != before
    fresh = HeadingTape(
        size=tape.size, pos=tape.pos, span=tape.span, heading=95.0, state=tape.state, age=tape.age
    )
    fresh.draw()
    assert looks(tape) == looks(fresh)


def test_a_strip_follows_the_theme(tape, stage):
    tape.heading, tape.state = 95.0, "live"
    stage.frames()
    dark = ticks(tape)[:, 8:11]
    theme.name = "sunlight"
    try:
        stage.frames()
        assert np.abs(ticks(tape)[:, 8:11] - np.array(theme.text[:3])).max() < 1e-6
        assert (ticks(tape)[:, 8:11] != dark).any()
    finally:
        theme.name = "dark"


def test_ticks_pale_to_the_sides_by_less_than_a_shade_at_once(tape, stage):
    tape.heading = 90.0
    strengths = dict(zip(*ticks(tape)[::4].T[[0, 11]], strict=True))
    assert max(strengths.values()) == 1.0
    assert min(strengths.values()) < 0.5
    tape.heading = 90.1
    stage.frames()
    after = ticks(tape)[::4].T[[0, 11]]
    assert len(after[0]) == len(strengths)
    for x, strength in zip(*after, strict=True):
        assert min(abs(strength - was) for place, was in strengths.items() if abs(place - x) < 1) < 1 / 128


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
