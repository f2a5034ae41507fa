from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import ControlStatus, Manoeuvre
from bridge.msgs.sensor_msgs import FluidPressure
from widgets.instruments.depth_gauge import DepthGauge

AIR = 101_325.0


@pytest.fixture
def gauge(stage):
    return stage.show(DepthGauge(state="live"), size=(176, 176))


def at(depth: float) -> FluidPressure:
    return FluidPressure(fluid_pressure=AIR + 9806.65 * depth)


def test_the_pressure_of_the_water_alone_is_depth(stage, gauge):
    gauge.show(at(4.2))
    stage.frames(2)
    assert gauge.depth == pytest.approx(4.2)
    assert gauge.texts[-3:] == ["4.2", "m", "no target"]


def test_salt_water_presses_more(gauge):
    gauge.density = 1025.0
    gauge.show(at(4.1))
    assert gauge.depth == pytest.approx(4.0)


def test_above_the_water_it_is_not_less_than_nothing(gauge):
    gauge.show(at(-0.3))
    assert (gauge.depth, gauge.words) == (0.0, "0.0")


@pytest.mark.parametrize("pressure", [math.nan, math.inf])
def test_what_is_not_measured_is_a_dash(stage, gauge, pressure):
    gauge.show(at(4.2))
    gauge.show(FluidPressure(fluid_pressure=pressure))
    stage.frames(2)
    assert "–" in gauge.texts
    assert "0.0" not in gauge.texts


@pytest.mark.parametrize(
    ("order", "wanted"),
    [
        (Manoeuvre(kind="hover", height=-4.5), 4.5),
        (Manoeuvre(kind="course", height=-2.0), 2.0),
        (Manoeuvre(kind="hover", height=1.0), 0.0),
        (Manoeuvre(kind="surface"), 0.0),
        (Manoeuvre(kind="hover"), math.nan),
        (Manoeuvre(kind="twist", height=-4.5), math.nan),
    ],
)
def test_the_depth_to_hold_is_that_of_the_order_it_follows(gauge, order, wanted):
    gauge.wanted = 9.0
    gauge.show(order)
    assert gauge.wanted == pytest.approx(wanted, nan_ok=True)


def test_the_target_is_written_under_the_depth(stage, gauge):
    gauge.show(at(4.2))
    gauge.wanted = 4.5
    stage.frames(2)
    assert gauge.texts[-5:] == ["4.2", "m", "TARGET", "4.5", "m"]


def test_the_scale_grows_at_once_and_shrinks_late(gauge):
    assert gauge.reach == 5.0
    gauge.show(at(4.8))
    assert gauge.reach == 10.0
    gauge.show(at(3.5))
    assert gauge.reach == 10.0
    gauge.show(at(2.0))
    assert gauge.reach == 5.0
    gauge.wanted = 60.0
    assert gauge.reach == 100.0


def test_where_it_is_low_it_is_a_line(stage):
    gauge = stage.show(DepthGauge(state="live"), size=(128, 40))
    gauge.show(at(4.2))
    stage.frames(2)
    assert gauge.texts == ["4.2", " m depth"]


def test_a_depth_held_where_the_robot_is_does_not_read_as_if_nothing_were_held(stage, gauge):
    gauge.show(at(4.2))
    gauge.show(Manoeuvre(kind="hover", height=math.nan))
    stage.frames(2)
    assert gauge.texts[-1] == "held"
    gauge.show(Manoeuvre(kind="rest"))
    stage.frames(2)
    assert gauge.texts[-1] == "no target"


@pytest.mark.parametrize(
    ("size", "words"),
    [
        ((326, 228), {"stopped, floats up"}),
        ((176, 176), {"floats up"}),
        ((128, 40), {" m, floats up", " m, rises"}),
    ],
)
def test_what_is_stopped_below_the_surface_floats_up(stage, size, words):
    gauge = stage.show(DepthGauge(state="live"), size=size)
    gauge.show(at(1.2))
    gauge.show(ControlStatus(stopped=True))
    stage.frames(2)
    assert words & set(gauge.texts)
    gauge.show(at(0.1))
    stage.frames(2)
    assert not words & set(gauge.texts)
    gauge.show(at(1.2))
    gauge.show(ControlStatus())
    stage.frames(2)
    assert not words & set(gauge.texts)


@pytest.mark.parametrize(
    ("order", "tail"),
    [
        (Manoeuvre(kind="hover", height=-1.2), " m, holds 1.2"),
        (Manoeuvre(kind="hover"), " m, held"),
        (Manoeuvre(kind="twist"), " m depth"),
        (Manoeuvre(kind="surface"), " m depth"),
    ],
)
def test_in_a_line_it_is_said_as_well_which_depth_is_held(stage, order, tail):
    gauge = stage.show(DepthGauge(state="live"), size=(128, 40))
    gauge.show(at(0.3))
    gauge.show(order)
    stage.frames(2)
    assert gauge.texts == ["0.3", tail]
    if math.isfinite(order.height):
        gauge.width = 112
        stage.frames(2)
        assert gauge.texts == ["0.3", " m → 1.2"]
