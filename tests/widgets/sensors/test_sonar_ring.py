from __future__ import annotations

import math

import pytest

from bridge.msgs.arrays import Float32Array, Float64Array
from bridge.msgs.pilothouse_msgs import Bumper, SonarRing
from widgets.sensors.sonar_ring import MAX_SONARS, SonarRingView

BEARINGS = [0.0, math.pi / 2, math.pi, -math.pi / 2]


@pytest.fixture
def view(stage):
    return stage.show(SonarRingView(state="live"), size=(190, 206))


def ring(*ranges: float, bearings: list[float] = BEARINGS) -> SonarRing:
    return SonarRing(
        bearings=Float64Array(bearings),
        field_of_view=0.384,
        radius=0.2,
        range_min=0.15,
        range_max=6.5,
        ranges=Float32Array(ranges),
    )


def test_the_nearest_echo_is_told_and_which_way_it_is(stage, view):
    view.show(ring(2.0, 0.33, 1.4, math.inf))
    stage.frames(2)
    assert view.texts[-2:] == ["SONARS", "0.33 m 90° left"]
    assert view.nearest_role == "danger"


@pytest.mark.parametrize(
    ("away", "figure", "role"),
    [
        (2.0, "2.0 m", "text"),
        (0.7, "0.70 m", "warn"),
        (0.3, "0.30 m", "danger"),
        (-math.inf, "<15 cm", "danger"),
        (math.inf, "clear", "text"),
        (math.nan, "–", "muted"),
    ],
)
def test_how_near_is_said_in_figure_and_colour(view, away, figure, role):
    view.show(ring(away, away, away, away))
    assert (view.figure, view.nearest_role) == (figure, role)


def test_before_the_first_ring_there_is_a_dash_and_nothing_is_said_of_the_bumper(stage, view):
    stage.frames(2)
    assert view.texts[-2:] == ["SONARS", "–"]
    assert (view.where, view.bump) == ("", "")


def test_a_contact_is_said_before_any_distance(stage, view):
    view.show(ring(2.0, 0.33, 1.4, 3.0))
    view.show(Bumper(pressed=True, bearing=-math.pi / 2))
    stage.frames(2)
    assert view.texts[-1] == "bump 90° right"
    view.show(Bumper(bearing=1.0))
    stage.frames(2)
    assert view.texts[-1] == "0.33 m 90° left"
    assert view.bump == "no contact"
    assert math.isnan(view.contact)


def test_a_contact_of_which_nobody_knows_where_is_said_all_the_same(view):
    view.show(Bumper(pressed=True))
    assert view.touched
    assert view.bump == "bump"
    assert math.isnan(view.contact)


def test_where_it_is_wide_all_stands_in_a_column_beside_the_ring(stage):
    view = stage.show(SonarRingView(state="live"), size=(326, 228))
    view.show(ring(2.0, 0.33, 1.4, 3.0))
    view.show(Bumper())
    stage.frames(2)
    assert {"0.33 m", "90° left", "no contact"} < set(view.texts)


def test_where_it_is_low_the_contact_or_the_nearest_is_told(stage):
    view = stage.show(SonarRingView(state="live", card=False), size=(72, 54))
    view.show(ring(2.0, 0.33, 1.4, 3.0))
    stage.frames(2)
    assert view.texts == ["0.33 m", "90° left"]
    view.show(Bumper(pressed=True, bearing=0.0))
    stage.frames(2)
    assert view.texts == ["bump", "ahead"]


def test_the_same_ring_again_is_not_drawn_anew(view):
    drawn = []
    view.bind(ring=lambda *_: drawn.append(1))
    for away in (1.0, 1.0, 1.1):
        view.show(ring(away, 2.0, 2.0, 2.0))
    assert len(drawn) == 2


@pytest.mark.parametrize("count", [0, 1, 3, MAX_SONARS + 40])
def test_a_ring_of_any_number_of_sonars_is_drawn(stage, view, count):
    view.show(ring(*[1.0] * count, bearings=[0.1 * i for i in range(count + 2)]))
    stage.frames(2)
    assert len(view.echoes[0]) == min(count, MAX_SONARS)


def test_a_sonar_without_a_bearing_is_left_out(stage, view):
    view.show(ring(0.2, 1.0, bearings=[math.nan, 0.5]))
    stage.frames(2)
    assert view.figure == "1.0 m"


def test_where_it_is_wide_and_low_a_contact_takes_the_place_of_the_direction(stage):
    view = stage.show(SonarRingView(state="live"), size=(174, 96))
    view.show(ring(2.0, 0.33, 1.4, 3.0))
    view.show(Bumper())
    stage.frames(2)
    assert view.texts[-1] == "90° left"
    view.show(Bumper(pressed=True, bearing=0.0))
    stage.frames(2)
    assert view.texts[-1] == "bump"
