"""A message in words: rows of a tree, figures, arrays in short."""

from __future__ import annotations

import math
import time
from typing import ClassVar

import pytest
from msgspec import defstruct

from bridge.msgs import Msg
from bridge.msgs.arrays import Float32Array
from bridge.msgs.geometry_msgs import Point, Pose, Twist, Vector3
from bridge.msgs.nav_msgs import GridCells
from bridge.msgs.sensor_msgs import LaserEcho, MultiEchoLaserScan
from bridge.msgs.std_msgs import Duration, Header, Time
from widgets.fields.field_samples import battery, cells, diagnostics, imu, log, scan
from widgets.fields.message_fields import (
    ARRAY,
    BRANCH,
    LEAF,
    MORE,
    clock,
    describe,
    number,
    rows,
    size_text,
    spelled,
    unit,
)


class Texts(Msg, frozen=True, gc=False):
    MSGTYPE: ClassVar[str] = "x/Texts"
    text: str = ""


class DetectionPose(Msg, frozen=True, gc=False):
    MSGTYPE: ClassVar[str] = "x/DetectionPose"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Pose", "geometry_msgs/Pose")
    UNITS: ClassVar[dict[str, str]] = {"one": "pixel"}
    one: Pose = Pose()
    other: Pose = Pose()


class Notes(Msg, frozen=True, gc=False):
    MSGTYPE: ClassVar[str] = "x/Notes"
    texts: list[str] = []
    flags: list[bool] = []
    left: Duration = Duration()


def texts(message, now=math.nan, folds=None):
    return {".".join(map(str, row.path)): describe(row, now) for row in rows(message, folds or {})}


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (math.nan, "—"),
        (math.inf, "inf"),
        (-math.inf, "−inf"),
        (0.0, "0.0000"),
        (-0.0, "0.0000"),
        (-9.80665, "−9.8066"),
        (1e-9, "1.000e−09"),
        (123456789.0, "1.235e+08"),
        (7, "7"),
        (-18204, "−18 204"),
        (True, "true"),
    ],
)
def test_a_number_has_always_as_many_decimals(value, words):
    assert number(value) == words


def test_figures_of_one_size_have_one_width():
    assert len({len(number(value)) for value in (0.1, 9.99996e-1, 7.123456, 3.0)}) == 1


@pytest.mark.parametrize(("count", "words"), [(0, "0 B"), (45_100, "45.1 kB"), (2_500_000, "2.5 MB")])
def test_bytes_are_told_by_their_number(count, words):
    assert size_text(count) == words


def test_a_time_is_told_by_the_clock_and_by_its_age():
    stamp = 1763719271.12
    told = time.strftime("%H:%M:%S", time.localtime(stamp)) + ".120"
    assert clock(stamp) == told
    assert clock(stamp, stamp + 0.08) == f"{told} · 0.1 s ago"
    assert clock(stamp, stamp - 3.0) == f"{told} · 3.0 s ahead"
    assert clock(stamp, stamp + 1e6) == told, "another clock's time has no age"


def test_a_simulation_begins_at_midnight_and_an_unset_stamp_is_a_dash():
    assert clock(3725.5) == "01:02:05.500"
    assert clock(0.0) == clock(math.nan) == "—"


def test_the_rows_of_a_small_message_are_unfolded_but_its_header():
    found = rows(imu(), {})
    assert [row.name for row in found if row.depth == 0][:2] == ["header", "orientation"]
    assert not next(row for row in found if row.name == "header").open
    assert [row.name for row in found if row.depth == 1][:4] == ["x", "y", "z", "w"]


def test_folds_are_obeyed():
    twist = Twist(linear=Vector3(0.5, 0.0, -0.25))
    opened = [row.path for row in rows(twist, {("linear",): False})]
    assert ("linear", "x") not in opened
    assert ("angular", "x") in opened
    assert texts(twist, folds={("linear",): False})["linear"] == ("0.50  0.00  −0.25", "")


def test_parts_of_a_list_are_rows_and_folded_they_say_their_first_text():
    told = texts(diagnostics())
    assert told["status"] == ("3", "")
    assert [told[f"status.{index}"][0] for index in range(3)] == ["Battery", "Laser", "Motors"]
    assert "status.0.name" not in told
    opened = texts(diagnostics(), folds={("status", 0): True, ("status", 0, "values"): True})
    assert opened["status.0.message"] == ("", "24.1 V, all cells within 20 mV of each other")
    assert opened["status.0.values.0"] == ("Voltage · 24.1", "")


def test_a_list_without_end_has_bounded_rows():
    notes = Notes(texts=[str(index) for index in range(5000)])
    found = rows(notes, {("texts",): True})
    assert len(found) < 60
    more = next(row for row in found if row.kind == MORE)
    assert more.name == "and 4950 more"
    assert describe(more) == ("", "")


def test_an_array_says_how_many_the_least_the_greatest_and_the_first():
    told = texts(scan())
    assert told["ranges"] == ("360 values", "1.00 to 3.00 m   (inf  inf  inf  inf  inf  inf …)")
    assert told["intensities"] == ("empty", "")
    unknown = texts(type(cells())(voltages=Float32Array([math.nan] * 2)))
    assert unknown["voltages"] == ("2 values", "—  —")


def test_the_figures_of_an_array_are_written_alike():
    cells_type = type(cells())

    def second(values: list[float]) -> str:
        return texts(cells_type(voltages=Float32Array(values)))["voltages"][1]

    assert second([0.0, 0.001, 0.01]) == "0.0000 to 0.0100   (0.0000  0.0010  0.0100)"
    assert second([0.0, 0.001, 24.0]) == "0.00 to 24.00   (0.00  0.00  24.00)"
    assert second([0.0, 2e-9]) == "0e+00 to 2e−09   (0e+00  2e−09)"
    assert texts(cells_type(voltages=Float32Array([1.0] * 20000)))["voltages"][0] == "20 000 values"


def test_nothing_is_less_than_nothing():
    twist = Twist(linear=Vector3(-0.001, -0.0, -0.5))
    assert texts(twist, folds={("linear",): False})["linear"] == ("0.00  0.00  −0.50", "")
    assert texts(type(cells())(voltages=Float32Array([-0.001, 1.0])))["voltages"][1].startswith(
        "0.00 to 1.00"
    )


def test_truths_are_counted():
    assert texts(Notes(flags=[True, False, True]))["flags"] == ("3 values", "2 true")


def test_bytes_unknown_numbers_and_durations_have_words():
    told = texts(cells())
    assert told["log"] == ("45.1 kB", "")
    assert told["leak_rate"] == ("—", "")
    assert told["cycles"] == ("18 204", "")
    assert texts(Notes(left=Duration(-2, 500_000_000)))["left"] == ("−1.500 s", "")


def test_the_type_is_the_one_that_the_class_tells_or_none():
    assert [row.type for row in rows(cells(), {})] == ["uint32", "float64", "bool", "float32[]", "uint8[]"]
    assert {row.type for row in rows(Notes(), {})} == {""}


def test_a_header_in_short_is_its_time():
    header = next(row for row in rows(battery(), {}) if row.name == "header")
    assert describe(header)[0] == clock(1763719271.12)
    assert header.kind == BRANCH
    stamp = rows(Header(Time(5)), {})[0]
    assert (stamp.kind, describe(stamp)[0]) == (LEAF, "00:00:05.000")


def test_a_long_text_has_a_line_of_its_own():
    row = rows(Header(frame_id="a frame whose name is very long\nand broken"), {})[1]
    assert row.kind == ARRAY
    assert describe(row) == ("", "a frame whose name is very long and broken")


@pytest.mark.parametrize(("ahead", "words"), [(0.2, "0.0 s ago"), (0.6, "0.6 s ahead")])
def test_what_is_hardly_ahead_of_a_clock_that_is_hardly_known_is_from_now(ahead: float, words: str) -> None:
    assert clock(1763719271.0, 1763719271.0 - ahead).endswith(words)


# units


def units(message, folds=None):
    return {".".join(map(str, row.path)): unit(row) for row in rows(message, folds or {}) if unit(row)}


def test_a_number_has_the_unit_that_its_definition_names():
    found = units(battery())
    assert (found["voltage"], found["temperature"]) == ("V", "°C")
    assert not {"percentage", "present"} & set(found)


def test_what_is_in_a_message_has_the_unit_that_is_told_of_the_whole():
    found = units(imu())
    assert (found["angular_velocity.x"], found["linear_acceleration.z"]) == ("rad/s", "m/s²")
    assert not [path for path in found if path.startswith(("orientation", "header"))]


def test_a_message_of_its_own_units_keeps_them():
    pose = DetectionPose(Pose(), Pose())
    found = units(pose)
    assert (found["one.position.x"], found["other.position.x"]) == ("m", "m")
    assert not [path for path in found if "orientation" in path]


def test_a_folded_message_of_numbers_has_their_unit_and_an_open_one_leaves_it_to_them():
    folded = units(Twist(), {("linear",): False})
    assert folded["linear"] == "m/s"
    assert (folded.get("angular"), folded["angular.z"]) == (None, "rad/s")
    assert units(Pose(), {("position",): False})["position"] == "m"


def test_parts_of_a_list_have_the_unit_of_the_list():
    cells = GridCells(cells=[Point(1.0, 2.0, 0.0)])
    assert units(cells, {("cells", 0): False})["cells.0"] == "m"
    echoes = MultiEchoLaserScan(ranges=[LaserEcho(Float32Array([1.0, 2.0]))])
    folds = {("ranges",): True, ("ranges", 0): True}
    assert texts(echoes, folds=folds)["ranges.0.echoes"] == ("2 values", "1.00 to 2.00 m   (1.00  2.00)")


def test_learned_types_have_no_units_and_may_call_a_constant_so():
    Odd = defstruct(
        "Odd", [("x", float, 0.0)], bases=(Msg,), namespace={"UNITS": "SI", "ROSTYPES": ("float64",)}
    )
    assert units(Odd()) == units(cells()) == {}


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ("m/s", "m/s"),
        ("m/s2", "m/s²"),
        ("m/s^2", "m/s²"),
        ("(rad/s)2", "(rad/s)²"),
        ("m3", "m³"),
        ("kg m2", "kg m²"),
        ("N*m", "N·m"),
        ("deg", "°"),
        ("deg/s", "°/s"),
        ("degC", "°C"),
        ("degC2", "°C²"),
        ("degree", "degree"),
        ("m25", "m25"),
    ],
)
def test_a_unit_is_written_as_people_do(told, words):
    assert spelled(told) == words


# long texts


def test_a_long_text_is_one_line_until_it_is_opened():
    assert "\n" not in texts(log())["msg"][1]
    assert texts(log(), folds={("msg",): True})["msg"] == ("", log().msg)


@pytest.mark.parametrize(
    ("text", "shown", "more"),
    [("x" * 1000, "x" * 1000, ""), ("x" * 3000, "x" * 1000, "2000"), ("a\n" * 45, "a\n" * 39 + "a", "10")],
)
def test_of_an_endless_text_the_beginning_is_shown(text, shown, more):
    said = texts(Texts(text), folds={("text",): True})["text"][1]
    assert said == (f"{shown}\n… and {more} more letters" if more else shown)
