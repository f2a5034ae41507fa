from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from kivy.metrics import Metrics

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import JointState
from widgets.core.language import figure, language
from widgets.core.quantities import quantities
from widgets.instruments.readout import Readout, ReadoutGrid, clock_figure


@pytest.mark.parametrize(
    ("value", "decimals", "text"),
    [(0.624, 2, "0.62"), (-12.0, 0, "−12"), (-0.04, 1, "0.0"), (math.nan, 1, "—"), (-math.inf, 1, "—")],
)
def test_a_figure_is_written_for_people(value, decimals, text):
    assert figure(value, decimals) == text


def test_a_signed_figure_has_a_plus_but_zero_has_none():
    assert [figure(value, 1, signed=True) for value in (1.0, 0.0, -1.0)] == ["+1.0", "0.0", "−1.0"]


@given(st.floats(allow_nan=True, allow_infinity=True))
def test_no_figure_says_nan_or_minus_zero(value):
    text = figure(value, 1)
    assert "n" not in text
    assert text not in {"−0.0", "-0.0"}


@pytest.mark.parametrize(
    ("seconds", "text"), [(0, "0:00"), (190, "3:10"), (3700, "1:01"), (math.nan, "—"), (-5, "0:00")]
)
def test_a_length_of_time_is_minutes_and_seconds(seconds, text):
    assert clock_figure(seconds) == text


def test_before_the_first_message_it_shows_a_dash():
    assert Readout(name="Speed", unit="m/s", value=0.0).text == "—"


def test_it_takes_the_field_at_its_path():
    speed = Readout(path="twist.twist.linear.x", decimals=2, state="live")
    speed.show(Odometry())
    assert speed.text == "0.00"
    wheel = Readout(path="velocity.1", state="live")
    wheel.show(JointState(name=["left", "right"], velocity=[1.0, 2.5]))
    assert wheel.text == "2.5"


def test_it_converts_to_its_unit():
    turn = Readout(path="angular.z", scale=math.degrees(1.0), unit="°/s", decimals=0, state="live")
    turn.show(Twist.planar(0.0, math.pi))
    assert turn.text == "180"


def test_a_field_that_is_not_there_is_an_error():
    with pytest.raises(AttributeError):
        Readout(path="no.such").show(Twist())


def test_nan_is_a_dash():
    readout = Readout(state="live", unit="m", value=math.nan)
    assert readout.text == "—"


def test_a_degree_sign_belongs_to_the_figure():
    readout = Readout(state="live", unit="°", decimals=0, value=-12.0)
    assert (readout.text, readout.unit_after) == ("−12°", "")


def test_stale_it_fades_and_says_how_old_it_is():
    readout = Readout(name="Speed", value=1.0, state="stale", age=3.2)
    assert (readout.heading, readout.role, readout.text) == ("Speed · 3 s old", "muted", "1.0")


def test_an_alarm_is_not_colour_alone(stage):
    readout = stage.show(Readout(name="Speed", value=1.0, state="live"))
    width = readout.width
    readout.state = "alarm"
    stage.frames(3)
    assert readout.role == "danger"
    assert readout.width > width


def test_its_figures_do_not_dance(stage):
    readout = stage.show(Readout(name="v", decimals=2, state="live", value=1.11))
    widths = set()
    for value in (1.11, 8.88, 4.07):
        readout.value = value
        stage.frames(3)
        widths.add(readout.width)
    assert len(widths) == 1


@pytest.mark.parametrize(
    ("width", "said", "behind"),
    [(300, "Speed · 34 s old", ""), (110, "Speed 34 s", ""), (76, "Speed 34 s", ""), (40, "Speed", "34 s")],
)
def test_the_name_stays_and_the_age_goes_where_there_is_room(width: int, said: str, behind: str) -> None:
    readout = Readout(name="Speed", fitted=False, state="stale", age=34.0, width=width)
    assert (readout.heading, readout.aged) == (said, behind)


@pytest.mark.parametrize(
    ("path", "text"), [("linear.x", "0.03"), ("linear.xy", "2.75"), ("linear.xyz", "3.41")]
)
def test_letters_of_a_vector_are_its_length_that_way(path, text):
    speed = Readout(path=path, decimals=2, state="live")
    speed.show(Twist(Vector3(0.03, -2.75, 2.02), Vector3()))
    assert speed.text == text


@pytest.mark.parametrize(
    ("value", "text", "side"),
    [(28.0, "28°", "port"), (-28.0, "28°", "stbd"), (0.2, "0°", ""), (-0.2, "0°", ""), (math.nan, "—", "")],
)
def test_a_value_to_a_side_has_the_word_for_it_and_no_sign(value, text, side):
    rudder = Readout(unit="°", decimals=0, plus="port", minus="stbd", state="live", value=value)
    assert (rudder.text, rudder.unit_after) == (text, side)


def test_value_and_unit_stay_within_the_room_that_they_are_given(stage):
    speed = stage.show(
        Readout(
            name="Speed", unit="m/s", decimals=2, fitted=False, font_size="21sp", state="live", value=-12.34
        )
    )
    speed.size_hint, speed.width = (None, None), 70
    stage.frames(4)
    assert speed.ids.row.width <= 71  # letters are whole pixels wide
    for speed.state, speed.age in (("stale", 3.2), ("alarm", 0.0)):
        stage.frames(4)
        assert speed.ids.row.width <= 71  # letters are whole pixels wide


@pytest.fixture
def metric_afterwards():
    yield
    quantities.system, language.name = "metric", "en"


@pytest.mark.usefixtures("metric_afterwards")
def test_a_speed_and_a_height_follow_the_operators_units_at_once():
    speed = Readout(unit="m/s", decimals=2, value=0.5144444, state="live")
    height = Readout(unit="m", decimals=1, value=-3.048, plus="up", minus="down", state="live")
    turn = Readout(unit="°/s", value=9.0, decimals=0, state="live")
    quantities.system = "nautical"
    assert (speed.text, speed.unit_after, height.text, height.unit_after) == ("1.00", "kn", "3.0", "m down")
    quantities.system = "imperial"
    assert (speed.text, speed.unit_after, height.text, height.unit_after) == ("1.15", "mph", "10", "ft down")
    assert (turn.text, turn.unit_after) == ("9", "°/s")


@pytest.mark.usefixtures("metric_afterwards")
def test_a_new_readout_begins_with_the_operators_units_and_the_languages_point():
    quantities.system, language.name = "imperial", "de"
    speed = Readout(unit="m/s", decimals=2, value=0.44704, state="live")
    assert (speed.text, speed.unit_after, speed.value) == ("1,00", "mph", 0.44704)


@pytest.mark.parametrize("fontscale", [1.0, 1.3, 2.0])
@pytest.mark.parametrize(("cols", "height"), [(3, 50), (2, 110), (1, 200)])
def test_figures_keep_to_the_height_of_their_grid_in_every_size_of_text(stage, fontscale, cols, height):
    Metrics.fontscale = fontscale
    try:
        grid = ReadoutGrid(cols=cols, size_hint=(None, None))
        for name in ("Speed", "Höchsttempo", "Turn"):
            grid.add_widget(
                Readout(
                    name=name,
                    unit="m/s",
                    value=0.42,
                    fitted=False,
                    size_hint_x=1,
                    state="live",
                    font_size="21sp",
                )
            )
        stage.show(grid, size=(90 * cols, height))
        stage.frames(4)
        assert all(one.y >= grid.y and one.top <= grid.top + 1 for one in grid.children)
        assert not any(one.ids.heading.is_shortened for one in grid.children)
        grid.width -= 20 * cols
        stage.frames(4)
        assert all(one.ids.heading.font_size == pytest.approx(one.headed[1]) for one in grid.children)
    finally:
        Metrics.fontscale = 1.0


def test_a_name_without_room_gives_way_to_its_brief_one(stage):
    readout = Readout(name="Nächster Punkt", brief_name="Nächster", fitted=False, size_hint_x=None, width=200)
    stage.show(readout)
    names = []
    for width in (200, 80):
        readout.width = width
        stage.frames(2)
        names.append((readout.heading, readout.ids.heading.is_shortened))
    assert names == [("Nächster Punkt", False), ("Nächster", False)]
