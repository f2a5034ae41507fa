"""Degrees to metres and back."""

from __future__ import annotations

import math

import pymap3d
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.geo import Datum

METRES = st.floats(-2000, 2000)


@given(latitude=st.floats(-70, 70), longitude=st.floats(-180, 180), east=METRES, north=METRES)
def test_a_place_comes_back_from_its_degrees(latitude, longitude, east, north):
    datum = Datum(latitude, longitude)
    assert datum.to_local(*datum.to_geographic(east, north)) == pytest.approx((east, north), abs=1e-6)


@pytest.mark.parametrize(("away", "tolerance"), [(10, 0.0001), (100, 0.005), (1000, 0.5)])
@pytest.mark.parametrize("latitude", [-60, -33.9, 0, 48.1, 65])
def test_metres_agree_with_the_exact_tangent_plane(latitude, away, tolerance):
    datum = Datum(latitude, 11.6)
    for turn in range(8):
        east, north = away * math.cos(turn), away * math.sin(turn)
        exact = pymap3d.geodetic2enu(*datum.to_geographic(east, north), 0, latitude, 11.6, 0)
        assert (east, north) == pytest.approx(exact[:2], abs=tolerance)


def test_north_is_positive_y_and_east_is_positive_x():
    east, north = Datum(48.0, 11.0).to_local(48.001, 11.001)
    assert east == pytest.approx(74.6, abs=0.1)
    assert north == pytest.approx(111.2, abs=0.1)


def test_the_way_across_the_date_line_is_the_short_one():
    datum = Datum(0.0, 179.9999)
    assert datum.to_local(0.0, -179.9999)[0] == pytest.approx(22.26, abs=0.01)
    assert datum.to_geographic(22.26, 0.0)[1] == pytest.approx(-179.9999, abs=1e-6)


def test_an_unknown_place_stays_unknown():
    assert all(map(math.isnan, Datum(48.0, 11.0).to_local(math.nan, math.nan)))


@pytest.mark.parametrize("place", [(90, 0), (0, 181), (math.nan, 0)])
def test_what_is_no_place_is_refused(place):
    with pytest.raises(ValueError, match="A datum lies between"):
        Datum(*place)
