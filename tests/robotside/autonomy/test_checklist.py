"""The list before the first motion: green, or named with what to do about it."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from bridge.codec.text import from_json, to_json
from bridge.msgs.pilothouse_msgs import Checklist
from robotside.autonomy.checklist import CheckInputs, checks

WELL = CheckInputs(
    battery=0.8, low_below=0.15, silent=(), placed=True, sure=True, stop_tested=True, offset=-0.02
)


def test_when_all_is_well_every_line_is_green() -> None:
    found = checks(WELL)
    assert [check.name for check in found] == ["battery", "sensors", "position", "stop", "clock"]
    assert {check.state for check in found} == {"ok"}


def test_it_can_be_sent_as_json() -> None:
    told = Checklist(checks=checks(replace(WELL, battery=0.1)))
    assert from_json(to_json(told), Checklist) == told


@pytest.mark.parametrize(
    ("change", "name", "state", "text"),
    [
        ({"battery": 0.1}, "battery", "bad", "The battery is below 15%; charge it first."),
        ({"battery": math.nan}, "battery", "unknown", "The battery has not reported its charge yet."),
        ({"silent": ["laser", "IMU"]}, "sensors", "bad", "No data from: laser, IMU."),
        ({"trouble": "The robot is gone."}, "sensors", "bad", "The robot is gone."),
        (
            {"placed": False},
            "position",
            "unknown",
            "The robot's position is unknown; place the robot on the map.",
        ),
        (
            {"sure": False},
            "position",
            "bad",
            "The robot is not sure of its place: choose where it is, or place it on the map.",
        ),
        ({"stop_tested": False}, "stop", "unknown", "STOP was not tested since the start; press it once."),
        ({"offset": math.nan}, "clock", "unknown", "No handheld has sent its clock yet."),
        (
            {"offset": 3600.0},
            "clock",
            "bad",
            "The handheld's clock is 3600.0 s ahead of the robot's; connect it anew, or check the link.",
        ),
        (
            {"offset": -12.0},
            "clock",
            "bad",
            "The handheld's clock is 12.0 s behind the robot's; connect it anew, or check the link.",
        ),
    ],
)
def test_what_is_not_well_is_named_and_nothing_else(
    change: dict[str, object], name: str, state: str, text: str
) -> None:
    found = checks(replace(WELL, **change))  # type: ignore[arg-type]
    assert [(each.name, each.state, each.text) for each in found if each.state != "ok"] == [
        (name, state, text)
    ]
