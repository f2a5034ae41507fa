"""Which widgets fit a topic: made for the type first, then fields, and the tree of fields for every type."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

import widgets
from bridge.client.type_learning import learn
from bridge.core.topics import TOPICS
from bridge.msgs import TYPES
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped, Twist
from bridge.msgs.nav_msgs import OccupancyGrid, Odometry
from bridge.msgs.sensor_msgs import (
    BatteryState,
    CompressedImage,
    Imu,
    LaserScan,
    NavSatFix,
    Range,
    Temperature,
)
from bridge.msgs.std_msgs import Float32, String
from bridge.msgs.vision_msgs import Detection2DArray
from widgets import fitting
from widgets.core.base import Control, RobotWidget
from widgets.fields.field_kinds import ENUM, NUMBER, TEXT, TRUTH
from widgets.fitting import COMMAND, FIGURE, INSTRUMENT, PICTURE, PLOT, TREE, Offer, best, offers


def names(kind, topic="", **kwargs) -> list[str]:
    return list(dict.fromkeys(offer.widget for offer in offers(kind, topic, **kwargs)))


@pytest.mark.parametrize(
    ("kind", "widget"),
    [
        (Imu, "ArtificialHorizon"),
        (LaserScan, "LaserScanView"),
        (BatteryState, "Battery"),
        (OccupancyGrid, "GridMap"),
        (PoseWithCovarianceStamped, "GridMap"),
        (CompressedImage, "Video"),
        (Range, "UltrasoundView"),
    ],
)
def test_the_widget_that_is_made_for_a_type_comes_first(kind, widget):
    assert best(kind).widget == widget


def test_what_is_more_special_comes_before_what_takes_more_types():
    assert names(Imu)[:3] == ["ArtificialHorizon", "Compass", "HeadingTape"]


def test_what_a_widget_shows_beside_others_alone_is_not_offered():
    assert "Video" not in names(Detection2DArray)
    assert "GridMap" not in names(LaserScan)


def test_a_number_alone_is_a_figure_and_one_of_many_comes_behind_the_tree():
    assert (best(Float32, "/tank/level").kind, best(Float32, "/tank/level").title) == (FIGURE, "Level")
    kinds = [offer.kind for offer in offers(Odometry, "/odom")]
    assert kinds.index(TREE) < kinds.index(FIGURE)


def test_a_figure_has_its_unit():
    found = best(Temperature, "/outside")
    assert (found.widget, found.field, found.unit) == ("Readout", "temperature", "°C")


def test_the_first_field_of_odometry_is_its_speed():
    speed = next(offer for offer in offers(Odometry, "/odom") if offer.kind == FIGURE)
    assert (speed.field, speed.unit, speed.digits) == ("twist.twist.linear.x", "m/s", 2)


def test_a_text_is_shown_in_words():
    assert best(String, "/mode").widget == "Readout"


@pytest.mark.parametrize(("topic", "commanded"), [("/cmd_vel", None), ("/base", True)])
def test_what_takes_a_drive_command_is_driven_by_a_stick_first(topic, commanded):
    found = best(Twist, topic, commanded=commanded)
    assert (found.widget, found.kind) == ("Joystick", COMMAND)


def test_a_speed_that_is_told_is_not_driven_by():
    assert "Joystick" not in names(Twist, "/cmd_vel", commanded=False)
    assert names(Odometry, "/odom")[0] != "Joystick"


def test_what_is_commanded_is_not_shown_by_an_instrument():
    assert not [
        offer for offer in offers(Imu, "/imu/set", commanded=True) if offer.kind in (INSTRUMENT, PICTURE)
    ]


def test_a_topic_of_ours_goes_the_way_that_the_table_says():
    for entry in TOPICS:
        controls = [offer.widget for offer in offers(entry.type, entry.name) if offer.kind == COMMAND]
        assert not controls or entry.to == "robot", entry.name


def test_a_type_that_nobody_knows_is_read_as_a_tree():
    assert [offer.kind for offer in offers("acme_msgs/Unheard", "/x")] == [TREE]


def test_a_type_that_was_learned_offers_its_fields_and_the_names_of_its_values():
    kind = learn(
        [
            {
                "type": "acme_msgs/Winch",
                "fieldnames": ["mode", "length", "load", "name"],
                "fieldtypes": ["uint8", "float64", "float32", "string"],
                "fieldarraylen": [-1] * 4,
                "constnames": ["MODE_FREE", "MODE_BRAKED"],
                "constvalues": ["0", "1"],
            }
        ]
    )
    found = {offer.field: offer for offer in offers(kind, "/winch") if offer.kind == FIGURE}
    assert set(found) == {"mode", "length", "load", "name"}
    assert best(kind, "/winch").kind == TREE
    made = widgets.Readout(state="live", **found["mode"].options)
    made.show(kind(mode=1))
    assert made.text == "braked"
    made.show(kind(mode=9))
    assert made.text == "9"


def every_offer() -> Iterator[tuple[str, Offer]]:
    for name in TYPES:
        for offer in offers(name, "/topic"):
            yield name, offer


def test_every_type_has_an_offer_and_every_offer_a_widget_of_the_catalogue():
    found = list(every_offer())
    assert {name for name, _ in found} == set(TYPES)
    assert {offer.widget for _, offer in found} <= set(widgets.CATALOGUE)


def test_every_offer_of_a_field_can_be_made_and_shows_an_empty_message():
    tried = set()
    for name, offer in every_offer():
        if not offer.field or (offer.widget, offer.field) in tried:
            continue
        tried.add((offer.widget, offer.field))
        getattr(widgets, offer.widget)(**offer.options).show(TYPES[name]())
    assert len(tried) > 100


def test_a_fix_by_satellite_is_shown_on_a_map_first():
    assert names(NavSatFix)[0] == "GeoMap"
    assert "GridMap" not in names(NavSatFix), "whose frame no fix tells"


def test_a_new_widget_is_offered_by_what_it_accepts(monkeypatch):
    class Thermometer(RobotWidget):
        accepts = (Temperature,)

    monkeypatch.setattr(widgets, "Thermometer", Thermometer, raising=False)
    monkeypatch.setitem(widgets.CATALOGUE, "Thermometer", "nowhere")
    fitting.forget()
    try:
        assert best(Temperature).widget == "Thermometer"
    finally:
        monkeypatch.undo()
        fitting.forget()
    assert best(Temperature).widget == "Readout"


def test_the_size_of_every_widget_fits_the_grid():
    for name in widgets.CATALOGUE:
        kind = getattr(widgets, name)
        if issubclass(kind, RobotWidget):
            columns, rows = kind.grid_size
            assert 1 <= columns <= 12, name
            assert 1 <= rows <= 12, name


def test_what_is_for_a_topic_says_of_which_type():
    for name in widgets.CATALOGUE:
        kind = getattr(widgets, name)
        assert not (issubclass(kind, Control) and kind.to_topic) or kind.sends, name


def test_numbers_are_offered_over_time_behind_their_figure_and_other_fields_are_not():
    found = [(offer.widget, offer.kind) for offer in offers(Float32, "/tank/level")]
    assert found[:2] == [("Readout", FIGURE), ("Plot", PLOT)]
    assert PLOT not in {offer.kind for offer in offers(String, "/mode")}


def test_kinds_of_fields_that_widgets_show_are_those_that_fields_have():
    for name in widgets.CATALOGUE:
        kind = getattr(widgets, name)
        assert not issubclass(kind, RobotWidget) or set(kind.shows_fields) <= {NUMBER, TRUTH, ENUM, TEXT}, (
            name
        )
