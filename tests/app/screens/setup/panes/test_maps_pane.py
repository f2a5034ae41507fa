from __future__ import annotations

from pathlib import Path

import pytest
from kivy.uix.scrollview import ScrollView

from app.maps.map_source import URL, Source
from app.maps.regions import RegionPlan
from app.screens.setup.panes.maps_pane import MapsPane
from tests.app.glass import Glass
from tests.app.maps.faulty import FaultyServer
from tests.app.maps.test_floor_plan import write as write_plan


@pytest.fixture
def pane(driving: Glass) -> MapsPane:
    driving.app.show("setup")
    screen = driving.app.screens["setup"]
    screen.open("maps")
    driving.stage.frames(5)
    return screen.pane(("handheld", "maps"))


@pytest.fixture
def town():
    with FaultyServer() as server:
        yield server
        server.may.set()


def names(driving: Glass) -> list[str]:
    return [one.name for one in driving.app.maps.sources.all]


def test_a_server_is_added_after_a_tile_of_it_was_seen(pane, driving: Glass, town):
    pane.ask()
    form = pane.form
    form.fields["where"].text = town.url
    assert not town.asked, "not while it is being typed"
    driving.until(lambda: form.tile.texture is not None, "no tile")
    assert form.came.text == "This came from the server."
    form.fields["name"].text = "Town"
    form.fields["attribution"].text = "© Town"
    form.save.dispatch("on_release")
    assert names(driving)[0] == "Town"
    assert pane.listed.parent is not None, "the list is back"
    assert len(pane.rows) == 2


def test_before_an_address_is_typed_there_is_no_empty_tile_and_save_and_cancel_are_in_sight(
    pane, driving: Glass, town
):
    driving.stage.window.size = (412, 892)
    driving.stage.frames(10)
    pane.ask()
    driving.stage.frames(10)
    form = pane.form
    view = next(one for one in form.walk_reverse() if isinstance(one, ScrollView))
    low, high = view.to_window(view.x, view.y)[1], view.to_window(view.x, view.top)[1]
    for button in form.save.parent.children:
        y = button.to_window(button.x, button.y)[1]
        assert low <= y <= y + button.height <= high, button.text
    assert (form.tile.opacity, form.tile.parent.height) == (0, 0)
    form.fields["where"].text = town.url
    driving.until(lambda: form.tile.texture is not None, "no tile")
    assert form.tile.opacity == 1
    assert form.tile.parent.height == form.tile.height
    form.fields["where"].text = ""
    assert (form.tile.opacity, form.tile.parent.height) == (0, 0)


def test_an_address_that_names_no_tiles_says_why_while_it_is_typed_and_nothing_is_asked(
    pane, driving: Glass, town
):
    pane.ask()
    form = pane.form
    form.fields["where"].text = town.url.replace("{z}", "9")
    driving.stage.run_for(2.0)
    assert form.problem.text == "The address lacks {z}; tiles are asked for by {z}, {x} and {y}."
    assert form.save.disabled
    assert not town.asked


def test_a_server_that_sends_no_picture_is_told_before_it_is_kept(pane, driving: Glass, town):
    town.fault = "html"
    pane.ask()
    pane.form.fields["where"].text = town.url
    driving.until(lambda: "no picture" in pane.form.came.text, "not told")
    assert pane.form.tile.texture is None


def test_a_key_is_kept_and_nowhere_shown(pane, driving: Glass, town):
    pane.ask()
    pane.form.fields["where"].text = town.url + "?k={key}"
    assert pane.form.save.disabled
    pane.form.fields["key"].text = "geheim"
    pane.form.save.dispatch("on_release")
    (source, _) = driving.app.maps.sources.all
    assert source.key == "geheim"
    row = pane.rows[source.id]
    assert "geheim" not in row.title + row.detail
    assert pane.form.fields["key"].password


def test_a_server_on_the_list_is_changed_moved_deleted_and_brought_back(pane, driving: Glass):
    sources = driving.app.maps.sources
    for name in ("A", "B"):
        sources.put(Source(name, URL, name, "https://a.invalid/{z}/{x}/{y}"))
    pane.rows["A"].dispatch("on_release")
    assert pane.form.fields["name"].text == "A"
    pane.form.fields["name"].text = "First"
    pane.form.save.dispatch("on_release")
    up, delete = (child for child in reversed(pane.rows["A"].children) if hasattr(child, "scan_words"))
    up.dispatch("on_release")
    assert names(driving)[:2] == ["First", "B"]
    _, delete = (child for child in reversed(pane.rows["A"].children) if hasattr(child, "scan_words"))
    delete.dispatch("on_release")
    assert names(driving)[:1] == ["B"]
    pane.undo.dispatch("on_release")
    assert names(driving)[:2] == ["First", "B"]


def test_a_file_is_added_by_its_path_and_one_that_is_no_map_says_why(pane, driving: Glass, tmp_path):
    pane.path.text = str(write_plan(tmp_path))
    pane.path.dispatch("on_text_validate")
    driving.until(lambda: names(driving)[0] == "a", "not added")
    assert pane.path.text == ""
    pane.path.text = str(tmp_path / "a.pgm")
    pane.path.dispatch("on_text_validate")
    driving.until(lambda: "is no map" in pane.problem.text, "not refused")


def test_a_chosen_file_with_its_picture_is_the_floor_plan(pane, driving: Glass, tmp_path):
    asked: list[Path] = []

    class Picking:
        takes_paths = False

        def pick(self, into, done):
            asked.append(into)
            done([tmp_path / "a.pgm", write_plan(tmp_path)], "")

    pane.picking = Picking()
    pane.browse.dispatch("on_release")
    driving.until(lambda: names(driving)[0] == "a", "not added")
    assert asked == [driving.app.maps.folder / "files"]


def test_what_is_kept_is_bounded_said_and_deleted(pane, driving: Glass):
    pane.cache.count(1)
    assert driving.app.maps.sources.cache_megabytes == 220
    pane.clear.dispatch("on_release")
    driving.until(lambda: pane.used.text == "0.0 MB are kept now.", "not said")


def test_an_offline_region_shows_its_progress_and_is_paused_and_deleted(pane, driving: Glass, town):
    maps = driving.app.maps
    source = Source("t", URL, "Town", town.url)
    maps.sources.put(source)
    town.fault = "hangs"
    region = maps.regions.begin(source, "Harbour", RegionPlan((8.0, 47.0, 8.05, 47.05), 10, 12), maps.server)
    driving.until(lambda: region in pane.region_rows, "not listed")
    row = pane.region_rows[region]
    driving.until(lambda: "Downloading; a tap pauses it." in row.detail, "not downloading")
    assert f"0 of {region.total} tiles" in row.detail
    row.dispatch("on_release")
    assert "Paused; a tap goes on." in row.detail
    town.fault = ""
    town.may.set()
    row.dispatch("on_release")
    driving.until(lambda: region.state == "done", "not downloaded")
    delete = next(child for child in row.children if hasattr(child, "bare"))
    delete.dispatch("on_release")
    driving.until(lambda: region not in pane.region_rows, "still listed")
    assert not region.file.path.exists()
