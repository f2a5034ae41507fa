from __future__ import annotations

import pytest

from app.maps.map_source import URL, Source
from app.maps.sources import NO_MAP
from bridge.msgs.geometry_msgs import Point32, Polygon
from bridge.msgs.pilothouse_msgs import Limits, Place, RobotInfo
from tests.app.glass import Glass
from tests.app.maps.faulty import DATUM, FaultyServer
from widgets.map.ground import TileGround

LOT = RobotInfo(name="Fake-1", latitude=DATUM.latitude, longitude=DATUM.longitude, radius=0.2)


@pytest.fixture
def mission(driving: Glass, robot):
    """The mission screen of a robot that stands on the lot of which pictures are shipped, whatever its world is called."""
    robot.publish("/robot/info", LOT)
    driving.app.show("mission")
    screen = driving.app.screens["mission"]
    driving.until(lambda: screen.map.ground is not None, "no pictures beneath the map")
    return screen


def streets(driving: Glass, town: FaultyServer) -> None:
    driving.app.maps.sources.put(Source("t", URL, "Streets", town.url, "© Town"))


def test_a_robots_place_and_not_the_name_of_its_world_decides_what_lies_beneath_its_map(
    mission, driving: Glass
):
    assert isinstance(mission.map.ground, TileGround)
    assert mission.map.ground.attribution == "Drawn from the simulated world"
    datum = mission.map.ground.datum
    assert (datum.latitude, datum.longitude) == (DATUM.latitude, DATUM.longitude)


def test_what_is_drawn_on_the_map_stays_when_another_is_laid_beneath(mission, driving: Glass, robot):
    corners = [Point32(x, y) for x, y in ((0, 0), (10, 0), (10, 10), (0, 10))]
    robot.publish("/limits", Limits(keep_in=[Polygon(corners)]))
    driving.until(lambda: mission.map.fence, "no fence")
    view = mission.map.view
    driving.tap(mission.ids["layers"])
    card = mission.card.shown
    driving.tap(card.rows[NO_MAP])
    assert mission.map.ground is None
    assert len(mission.map.fence.keep_in) == 1
    driving.tap(card.rows["parking_lot"])
    assert isinstance(mission.map.ground, TileGround)
    driving.tap(mission.ids["layers"])
    assert mission.card.shown is None
    assert mission.map.view.scale == pytest.approx(view.scale)


def test_tiles_of_a_server_come_onto_the_map_with_the_word_of_their_origin(mission, driving: Glass):
    with FaultyServer() as town:
        streets(driving, town)
        driving.until(lambda: town.asked, "no tile was asked for")
        source = mission.map.ground.source
        driving.until(lambda: source._textures and not source._waiting, "no tiles")
        assert mission.map.ground.attribution == "© Town"
        driving.app.leave()


def test_a_server_that_answers_nonsense_is_said_once_and_the_map_can_be_used(mission, driving: Glass):
    said = []
    driving.app.shell.say = lambda text, *_, **__: said.append(text)
    with FaultyServer() as town:
        town.fault = "html"
        streets(driving, town)
        driving.until(lambda: said, "nothing was said")
        asked = len(town.asked)
        mission._maps.keeper._reader.retry()
        driving.until(lambda: len(town.asked) > asked, "no other try")
        driving.stage.frames(20)
        assert said == ["The map server 127.0.0.1 sends what is no picture (text/html)."]
        scale = mission.map.view.scale
        driving.tap(mission.ids["zoom_in"])
        assert mission.map.view.scale > scale
        driving.tap(mission.ids["layers"])
        assert mission.card.shown.trouble.text == said[0], "the card goes on to say it"
        driving.app.leave()


def test_how_plainly_it_is_seen_is_chosen_on_the_card_and_kept(mission, driving: Glass):
    driving.tap(mission.ids["layers"])
    card = mission.card.shown
    before = mission.map.ground_opacity
    card.plainness.count(1)
    driving.stage.frames(10)
    driving.until(lambda: mission.map.ground_opacity > before, "it is seen as before")
    assert driving.app.settings.get("maps")["opacity"] == pytest.approx(before + 0.1)


def test_leaving_the_robot_ends_the_reading_of_what_lies_beneath_its_map(mission, driving: Glass):
    reader = mission.map.ground.source.reader
    driving.app.leave()
    assert reader._closed
    assert mission.map.ground is None


def test_the_area_in_sight_is_kept_offline_from_the_card(mission, driving: Glass):
    with FaultyServer() as town:
        streets(driving, town)
        driving.until(lambda: mission._maps.keeper.source.id == "t", "not the streets")
        driving.tap(mission.ids["layers"])
        card = mission.card.shown
        card.offline.dispatch("on_release")
        form = card.region
        assert "tiles, about" in form.size_said.text
        form.most.value = form.least.value
        form._say()
        form.name.text = "Harbour"
        form.begin.dispatch("on_release")
        (region,) = driving.app.maps.regions.all
        region.wait()
        assert (region.name, region.state, region.done) == ("Harbour", "done", region.total)
        driving.app.leave()


def test_back_shuts_the_card_and_then_leaves_what_a_finger_would_do_before_it_leaves_the_robot(
    mission, driving: Glass
):
    driving.tap(mission.ids["layers"])
    mission.mode = "points"
    assert mission.card.open
    assert driving.app.back()
    assert (mission.card.open, mission.mode) == (False, "points")
    assert driving.app.back()
    assert (mission.mode, driving.app.session is None) == ("view", False)


def test_back_gives_up_the_place_that_is_made(mission, driving: Glass):
    mission._pointing.places.card.edit(Place(x=1.0, y=2.0))
    mission.show_card(mission._pointing.places.card)
    assert driving.app.back()
    assert not mission.card.open
