"""Where a line is, which way a ranger looks, and how a place is told in words."""

from __future__ import annotations

import math

import pytest

from widgets.core.sensor_geometry import ago_text, aim, away_text, line_offset, side_text, wheel_name

DARK, BRIGHT, DEAD = 0.1, 0.8, math.nan


@pytest.mark.parametrize(
    ("cells", "where"),
    [
        ([DARK, BRIGHT, DARK, DARK, DARK], 0.02),
        ([DARK, DARK, DARK, DARK, BRIGHT], -0.04),
        ([DARK, DARK, BRIGHT, DARK, DARK], 0.0),
        ([BRIGHT, BRIGHT, BRIGHT, DARK, BRIGHT], -0.02),
        ([DEAD, DARK, BRIGHT, BRIGHT, DARK], -0.01),
    ],
)
def test_the_line_is_what_fewer_cells_see(cells: list[float], where: float) -> None:
    assert line_offset(cells, 0.02) == pytest.approx(where)


@pytest.mark.parametrize("cells", [[], [DEAD, DEAD], [DARK] * 5, [BRIGHT] * 5, [0.1, 0.3, 0.2]])
def test_where_all_cells_see_the_same_is_no_line(cells: list[float]) -> None:
    assert math.isnan(line_offset(cells, 0.02))


@pytest.mark.parametrize(
    ("frame", "degrees"),
    [
        ("ultrasound_front", 0),
        ("robot1/sonar_left", 90),
        ("right_sonar", -90),
        ("range_rear", 180),
        ("front_left_range", 45),
        ("range_rear_right", -135),
        ("us3", 0),
    ],
)
def test_the_name_of_its_frame_says_which_way_a_ranger_looks(frame: str, degrees: float) -> None:
    assert math.degrees(aim(frame)) == pytest.approx(degrees)


@pytest.mark.parametrize(
    ("metres", "text"),
    [
        (0.423, "0.42 m"),
        (0.996, "1.0 m"),
        (4.24, "4.2 m"),
        (120.4, "120 m"),
        (math.nan, "–"),
        (math.inf, "–"),
    ],
)
def test_a_distance_is_as_fine_as_it_is_read(metres: float, text: str) -> None:
    assert away_text(metres) == text


@pytest.mark.parametrize(
    ("degrees", "text"),
    [(0, "ahead"), (-9, "ahead"), (35, "35° left"), (-90, "90° right"), (181, "behind"), (325, "35° right")],
)
def test_a_direction_in_words(degrees: float, text: str) -> None:
    assert side_text(math.radians(degrees)) == text


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0.4, "now"), (12, "12 s ago"), (59.8, "1 min ago"), (7300, "2 h ago"), (math.nan, "")],
)
def test_how_long_ago_in_words(seconds: float, text: str) -> None:
    assert ago_text(seconds) == text


@pytest.mark.parametrize(
    ("joint", "name"),
    [("wheel_left_joint", "left"), ("front_right_wheel", "front right"), ("wheel_joint", "wheel_joint")],
)
def test_a_wheel_is_called_by_its_place(joint: str, name: str) -> None:
    assert wheel_name(joint) == name
