from __future__ import annotations

import json
import math

import pytest

from app.core.settings_store import Settings
from app.maps.map_source import MAP_SERVER, MBTILES, URL, Source
from app.maps.sources import AUTOMATIC, MAX_SOURCES, NO_MAP, Sources

STREETS = Source("s", URL, "Streets", "https://a.org/{z}/{x}/{y}.png?key={key}", "© A", key="geheim")
TOWN = Source("t", MBTILES, "Town", "/maps/town.mbtiles", box=(8.0, 47.0, 9.0, 48.0))
PLAN = Source("p", MAP_SERVER, "Hall", "/maps/hall.yaml")
SHIPPED = Source("lot", MBTILES, "Lot", "/app/lot.mbtiles", box=(-74.0, 45.0, -73.0, 46.0), shipped=True)


@pytest.fixture
def settings(tmp_path):
    made = Settings(tmp_path)
    yield made
    made.close()


def ids(sources):
    return [one.id for one in sources]


def test_the_newest_comes_first_and_all_of_it_is_there_after_a_restart(settings, tmp_path):
    sources = Sources(settings, [SHIPPED])
    for one in (TOWN, STREETS):
        sources.put(one)
    sources.choose("t")
    sources.set_opacity(0.5)
    sources.set_cache(99.0)
    settings.close()
    again = Sources(Settings(tmp_path), [SHIPPED])
    assert again.all == [STREETS, TOWN, SHIPPED]
    assert (again.chosen, again.opacity, again.cache_megabytes, again.problem) == ("t", 0.5, 99.0, "")


def test_the_first_that_covers_the_robot_is_looked_at_unless_another_is_chosen(settings):
    sources = Sources(settings, [SHIPPED])
    sources.put(STREETS)
    sources.put(TOWN)
    assert sources.pick(47.5, 8.5) == TOWN
    assert sources.pick(45.5, -73.5) == STREETS, "the town does not cover it"
    sources.choose("lot")
    assert sources.pick(45.5, -73.5) == SHIPPED
    assert sources.pick(47.5, 8.5) == TOWN, "what is chosen does not cover that place"
    sources.choose(NO_MAP)
    assert sources.pick(47.5, 8.5) is None
    sources.choose(AUTOMATIC)
    assert sources.pick(47.5, 8.5) == TOWN


def test_where_the_place_is_not_known_only_a_floor_plan_is_offered(settings):
    sources = Sources(settings, [SHIPPED])
    for one in (PLAN, TOWN, STREETS):
        sources.put(one)
    assert ids(sources.covering(math.nan, math.nan)) == ["p"]


def test_a_box_may_cross_the_date_line():
    fiji = Source("f", MBTILES, "Fiji", "/f.mbtiles", box=(176.0, -20.0, -178.0, -12.0))
    assert fiji.covers(-17.0, 179.0)
    assert fiji.covers(-17.0, -179.0)
    assert not fiji.covers(-17.0, 0.0)


def test_what_is_removed_comes_back_to_its_place(settings):
    sources = Sources(settings)
    for one in (PLAN, TOWN, STREETS):
        sources.put(one)
    assert sources.remove("t") == TOWN
    assert ids(sources.all) == ["s", "p"]
    assert sources.can_undo
    sources.undo()
    assert ids(sources.all) == ["s", "t", "p"]
    assert not sources.can_undo
    assert sources.remove("unknown") is None


def test_the_order_is_the_operators_and_what_was_shipped_stays_last(settings):
    sources = Sources(settings, [SHIPPED])
    for one in (PLAN, TOWN, STREETS):
        sources.put(one)
    sources.move("p", -1)
    assert ids(sources.all) == ["s", "p", "t", "lot"]
    sources.move("s", -1)
    sources.move("t", 1)
    sources.move("lot", -1)
    assert ids(sources.all) == ["s", "p", "t", "lot"]


def test_a_change_is_told_and_a_source_is_changed_in_its_place(settings):
    sources, told = Sources(settings), []
    sources.put(TOWN)
    sources.put(STREETS)
    unbind = sources.bind(lambda: told.append(1))
    sources.put(TOWN.called("City"))
    assert [one.name for one in sources.all] == ["Streets", "City"]
    unbind()
    sources.choose("t")
    assert told == [1]


def test_there_are_only_so_many(settings):
    sources = Sources(settings)
    for index in range(MAX_SOURCES):
        sources.put(Source(f"{index}", MBTILES, "Town", "/t.mbtiles"))
    with pytest.raises(ValueError, match=f"There are {MAX_SOURCES} maps already; delete one first"):
        sources.put(TOWN)


def test_what_is_shown_of_a_source_holds_no_key():
    assert "geheim" not in STREETS.detail
    assert "key" not in STREETS.detail
    assert TOWN.detail == "town.mbtiles"


@pytest.mark.parametrize(
    "kept",
    [
        "no table",
        {"sources": "none"},
        {"sources": [17]},
        {"sources": [{"id": "x"}]},
        {"sources": [TOWN.kept() | {"kind": "globe"}]},
        {"sources": [TOWN.kept() | {"box": [1, 2, 3]}]},
        {"sources": [TOWN.kept() | {"box": [1, 50, 3, 40]}]},
        {"sources": [TOWN.kept() | {"max_zoom": 99}]},
        {"sources": [TOWN.kept() | {"min_zoom": 2.5}]},
        {"sources": [TOWN.kept() | {"name": ["a"]}]},
        {"sources": [STREETS.kept() | {"where": "https://a.org"}]},
        {"opacity": "much"},
        {"cache_mb": math.nan},
    ],
)
def test_whatever_the_settings_hold_it_is_said_and_the_rest_goes_on(tmp_path, kept):
    (tmp_path / "settings.json").write_text(json.dumps({"maps": kept}))
    settings = Settings(tmp_path)
    sources = Sources(settings, [SHIPPED])
    assert sources.all == [SHIPPED]
    assert sources.problem.startswith("In the settings of maps")
    settings.close()
