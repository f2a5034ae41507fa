"""The robot's settings file: what it says, and one sentence for each way to get it wrong."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.toml_files import MAX_BYTES
from robotside.control.latency_speed_cap import UNMEASURED_SHARE
from robotside.core.config import (
    MAX_AREAS,
    MAX_CORNERS,
    BadConfig,
    Config,
    GatewaySettings,
    load,
    parse,
)

EXAMPLE = Path(__file__).parents[3] / "docs" / "robot.toml.example"
SECTIONS = {name: type(getattr(Config(), name)) for name in Config.__struct_fields__ if name != "gateways"}
SQUARE = "[[0, 0], [2, 0], [2, 2], [0, 2]]"


def test_an_empty_file_leaves_everything_to_the_robot() -> None:
    assert parse("") == Config()
    assert Config().limits.max_speed is None
    assert Config().control.follow_link
    assert not Config().control.lost_link_stops_task
    assert Config().control.unmeasured_link_speed == UNMEASURED_SHARE


def test_the_example_in_the_docs_can_be_used_as_it_is_and_shows_every_setting() -> None:
    config = load(EXAMPLE)
    assert (config.limits.max_speed, config.limits.max_slope_degrees) == (0.5, 12.0)
    assert config.limits.keep_out == (((5.0, 1.0), (7.0, 1.0), (7.0, 3.0), (5.0, 3.0)),)
    text = EXAMPLE.read_text()
    assert set(SECTIONS) | {"gateways"} == set(Config.__struct_fields__)
    for section, kind in (*SECTIONS.items(), ("gateways.mqtt", GatewaySettings)):
        assert f"\n[{section}]" in f"\n{text}"
        for setting in kind.__struct_fields__:
            assert f"\n{setting} = " in text.replace("\n# ", "\n"), setting


def test_whole_numbers_do_for_numbers() -> None:
    ring = parse(f"[limits]\nmax_speed = 1\nkeep_in = [{SQUARE}]").limits.keep_in[0]
    assert ring == ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "[limit]",
            "the file has no 'limit'; there are robot, limits, safe_state, control, charging, database, trust, serve, gateways.",
        ),
        ("[robot]\nnme = 'x'", "robot has no 'nme'; there are name."),
        ("limits = 3", "limits must be a table, not 3."),
        ("[limits]\nmax_speed = 'fast'", "limits.max_speed must be a number, not 'fast'."),
        ("[limits]\nmax_speed = -1", "limits.max_speed must be a number above 0, not -1."),
        ("[limits]\nmax_speed = inf", "limits.max_speed must be a number, not inf."),
        ("[limits]\nmax_speed = true", "limits.max_speed must be a number, not true."),
        ("[limits]\nclearance = 0.01", "limits.clearance must be a number at least 0.02, not 0.01."),
        ("[limits]\nclearance = 0.6", "limits.clearance must be a number at most 0.5, not 0.6."),
        ("[limits]\nclearance = 'wide'", "limits.clearance must be a number, not 'wide'."),
        ("[limits]\nmax_slope_degrees = 91", "limits.max_slope_degrees must be a number at most 90, not 91."),
        ("[limits]\nkeep_in = [[0, 0], [1, 0]]", "limits.keep_in[0][0] must be a list, not 0."),
        ("[limits]\nkeep_in = [[[0, 0], [1]]]", "limits.keep_in[0][1] must be a list of 2 numbers, not [1]."),
        ("[limits]\nkeep_in = [[[0, nan]]]", "limits.keep_in[0][0][1] must be a number, not nan."),
        ("[safe_state]\naction = 'fly'", "safe_state.action must be one of brake, brake_straight,"),
        (
            "[control]\nunmeasured_link_speed = 1.5",
            "control.unmeasured_link_speed must be a number at most 1, not 1.5.",
        ),
        (
            "[control]\nunmeasured_link_speed = 0.0",
            "control.unmeasured_link_speed must be a number above 0, not 0.0.",
        ),
        ("[control]\nfollow_link = 'yes'", "control.follow_link must be true or false, not 'yes'."),
        ("[database]\nbackups = 1.5", "database.backups must be a whole number, not 1.5."),
        ("[robot]\nname = ''", "robot.name must be a text of at least 1 character, not ''."),
    ],
)
def test_a_mistake_is_one_sentence_with_the_value_and_what_is_allowed(text: str, said: str) -> None:
    with pytest.raises(BadConfig) as problem:
        parse(text, "patrol.toml")
    assert str(problem.value).startswith(f"patrol.toml: {said}")
    assert "\n" not in str(problem.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x =", "line 1: is not TOML: invalid value where the file ends."),
        ("[limits]\nmax_speed = 1\nmax_speed = 2", "line 3: is not TOML: cannot overwrite a value"),
    ],
)
def test_what_is_no_toml_is_one_sentence_with_the_line(text: str, said: str) -> None:
    with pytest.raises(BadConfig) as problem:
        parse(text, "patrol.toml")
    assert str(problem.value).startswith(f"patrol.toml, {said}")


@pytest.mark.parametrize(
    ("corners", "said"),
    [
        ("[[0, 0], [1, 1]]", f"must have 3 to {MAX_CORNERS} corners, not 2."),
        ("[[0, 0], [1, 1], [2, 2]]", "has no inside: its corners lie on one line."),
        ("[[0, 0], [1, 1], [1, 0], [0, 1]]", "crosses itself: its side 1 and its side 3 meet."),
        ("[[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]]", "crosses itself: its side 1 and its side 3 meet."),
        ("[[0, 0], [1, 1], [1, 1], [0, 1]]", "has its corner 2, (1, 1), twice in a row."),
        ("[[0, 0], [1, 0], [1, 1], [0, 0]]", "has its corner 4, (0, 0), twice in a row."),
    ],
)
def test_an_area_that_encloses_nothing_clear_is_named(corners: str, said: str) -> None:
    with pytest.raises(BadConfig) as problem:
        parse(f"[limits]\nkeep_out = [{SQUARE}, {corners}]")
    assert str(problem.value) == f"robot.toml: area 2 of limits.keep_out {said}"


def test_a_fence_has_a_bounded_number_of_areas() -> None:
    areas = ", ".join([SQUARE] * (MAX_AREAS + 1))
    with pytest.raises(BadConfig, match=f"limits.keep_in has {MAX_AREAS + 1} areas; at most {MAX_AREAS} are"):
        parse(f"[limits]\nkeep_in = [{areas}]")


def test_a_least_depth_below_the_greatest_is_said() -> None:
    with pytest.raises(BadConfig, match=r"limits.min_depth must be less than max_depth, 2 m, not 3 m\."):
        parse("[limits]\nmin_depth = 3\nmax_depth = 2")


def test_the_tightest_of_height_depth_floor_and_ceiling_counts() -> None:
    told = parse("[limits]\nmin_depth = 1\nmax_depth = 9\nfloor = -6.5\nceiling = -0.5").limits
    assert (told.lowest, told.highest) == (-6.5, -1.0)
    told = parse("[limits]\nmax_height = 12\nfloor = 1.5\nceiling = 20").limits
    assert (told.lowest, told.highest) == (1.5, 12.0)
    told = parse("").limits
    assert (told.lowest, told.highest) == (-math.inf, math.inf)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            "floor = 3\nceiling = 2",
            "the fence's floor must be below its ceiling, 2 m, not at 3 m, depths included.",
        ),
        ("floor = 3\nmax_height = 3", "the fence's floor must be below its ceiling, 3 m, not at 3 m"),
        ("ceiling = -5\nmax_depth = 4", "the fence's floor must be below its ceiling, -5 m, not at -4 m"),
        ("floor = nan", "limits.floor must be a number, not nan."),
        ("ceiling = -inf", "limits.ceiling must be a number, not -inf."),
    ],
)
def test_a_fence_without_room_between_floor_and_ceiling_is_said(words: str, said: str) -> None:
    with pytest.raises(BadConfig, match=said):
        parse(f"[limits]\n{words}")


def test_a_file_that_cannot_be_read_is_said(tmp_path: Path) -> None:
    with pytest.raises(
        BadConfig, match=r"The settings cannot be read from '.*none': no such file or directory\."
    ):
        load(tmp_path / "none")
    with pytest.raises(BadConfig, match="is a directory"):
        load(tmp_path)
    there = tmp_path / "robot.toml"
    there.write_bytes(b"\xff\xfe")
    with pytest.raises(BadConfig, match="the file is no UTF-8 text"):
        load(there)
    there.write_bytes(b"#" * (MAX_BYTES + 1))
    with pytest.raises(BadConfig, match="a settings file has at most 1,000,000 bytes"):
        load(there)


VALUES = st.recursive(
    st.sampled_from(
        ["1", "-1", "nan", "-inf", "1e400", "9" * 400, "true", "'x'", "1979-05-27", "0x1F", "''"]
    ),
    lambda inner: st.lists(inner, max_size=4).map(lambda each: f"[{', '.join(each)}]"),
    max_leaves=12,
)
SETTINGS = [
    f"{section}.{name}"
    for section, kind in (*SECTIONS.items(), ("gateways.mqtt", GatewaySettings))
    for name in kind.__struct_fields__
]


def refusal(text: str) -> str:
    """Why `text` is refused; a good sentence when it is not."""
    try:
        parse(text)
    except BadConfig as problem:
        return str(problem)
    return "Taken."


@given(st.lists(st.tuples(st.sampled_from([*SETTINGS, "limits", "a.b"]), VALUES), max_size=4))
def test_whatever_stands_in_the_file_it_is_taken_or_refused_in_one_line(
    settings: list[tuple[str, str]],
) -> None:
    said = refusal("\n".join(f"{name} = {value}" for name, value in settings))
    assert said.endswith(".")
    assert "\n" not in said


def test_a_fence_has_a_bounded_number_of_corners() -> None:
    ring = "[" + ", ".join(f"[{x}, {x * x}]" for x in range(MAX_CORNERS)) + "]"
    with pytest.raises(BadConfig, match=r"the fence has 1200 corners; at most 1000 are allowed\."):
        parse(f"[limits]\nkeep_out = [{', '.join([ring] * 6)}]")
