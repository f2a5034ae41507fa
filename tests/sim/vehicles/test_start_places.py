"""Where robots stand that nobody placed."""

from __future__ import annotations

import math
from itertools import combinations

import pytest

from sim.robot import ROBOTS, WORLDS, home_of, make, make_several
from sim.vehicles.model import Model, numbered, suits
from sim.vehicles.start_places import starts
from sim.world.tables import Start
from sim.world.world_files import load, parse

NARROW = """
name = "narrow"
description = "A corridor 2 m wide"
ground = {length = 9.0, width = 2.0}
start = {x = 0.0, y = 0.0}
datum = {latitude = 45.0, longitude = 9.0}
wall = {height = 1.0, thickness = 0.2}
"""


def fitting(world: str) -> list[Model]:
    loaded = load(world)
    fits = [model for model in ROBOTS.values() if suits(model, loaded)]
    return [model for model in fits if world != "office" or model.parameters.radius < 1.0]  # no truck indoors


@pytest.mark.parametrize("world", WORLDS)
def test_ten_robots_have_room_in_every_world_and_touch_nothing(world: str) -> None:
    loaded = load(world)
    models = (fitting(world) * 10)[:10]
    found = starts(loaded, models, [None] * 10)
    assert found[0] == loaded.start
    for (one, first), (other, second) in combinations(zip(found, models, strict=True), 2):
        apart = math.dist((one.x, one.y), (other.x, other.y))
        assert apart > first.parameters.radius + second.parameters.radius
    assert all(
        abs(start.x) < loaded.ground.length / 2 and abs(start.y) < loaded.ground.width / 2 for start in found
    )


@pytest.mark.parametrize(("world", "names"), [("office", ["patrol", "scout"]), ("tank", ["aqua", "minnow"])])
def test_none_of_them_begins_with_a_bump(world: str, names: list[str]) -> None:
    robots = make_several(names * 3, world, camera=False, noise=False)
    simulation = robots[0].simulation
    for robot in robots:
        list(robot.read(0.0))
    robots[0].read(0.5)
    bumps = [vehicle.bumper.bumps for vehicle in simulation.vehicles]
    for robot in robots:
        robot.close()
    assert bumps == [0] * 6


def test_where_there_is_no_room_to_the_sides_they_stand_in_a_row() -> None:
    models = [ROBOTS["patrol"]] * 3
    found = starts(parse(NARROW, "narrow.toml"), models, [None] * 3)
    assert sorted(start.x for start in found) == [-2.0, 0.0, 2.0]


def test_one_too_many_is_refused_in_one_sentence() -> None:
    models = [ROBOTS["patrol"]] * 20
    with pytest.raises(ValueError, match="There is no room for one more robot at the start of narrow"):
        starts(parse(NARROW, "narrow.toml"), models, [None] * 20)


def test_nobody_is_put_where_another_one_is_said_to_start() -> None:
    world = load("parking_lot")
    first, second = starts(world, [ROBOTS["patrol"]] * 2, [None, world.start])
    assert second == world.start
    assert math.dist((first.x, first.y), (second.x, second.y)) == pytest.approx(2.0)


def test_nobody_stands_behind_a_wall() -> None:
    text = NARROW.replace("width = 2.0", "width = 8.0") + (
        "[[partitions]]\nfrom = [-4.5, 1.0]\nto = [4.5, 1.0]\n[[partitions]]\nfrom = [-4.5, -1.0]\nto = [4.5, -1.0]\n"
    )
    found = starts(parse(text, "walled.toml"), [ROBOTS["patrol"]] * 4, [None] * 4)
    assert {start.y for start in found} == {0.0}


def test_the_second_of_a_kind_has_a_name_of_its_own() -> None:
    names = [
        model.parameters.info.name for model in numbered([ROBOTS[n] for n in ("patrol", "scout", "patrol")])
    ]
    assert names == ["Patrol-1", "Scout-1", "Patrol-2"]
    robots = make_several(["scout", "scout"], "office", camera=False)
    said = [robot.info.name for robot in robots]
    for robot in robots:
        robot.close()
    assert said == ["Scout-1", "Scout-2"]


def test_each_carries_what_it_was_given() -> None:
    robots = make_several(["patrol", "scout"], "office", camera=False, payloads=[["arm"], []])
    carried = [robot.info.payloads for robot in robots]
    for robot in robots:
        robot.close()
    assert carried == [["arm"], []]


def test_what_cannot_be_carried_is_said_and_nothing_stays_open() -> None:
    with pytest.raises(ValueError, match="Scout-1 has a sonar already"):
        make_several(["patrol", "scout"], "office", camera=False, payloads=[[], ["sonar"]])


@pytest.mark.parametrize("name", ROBOTS)
def test_each_robot_has_a_home_that_suits_it(name: str) -> None:
    robot = make(name, home_of([name]), camera=False)
    robot.close()


def test_robots_together_are_put_where_all_of_them_can_be() -> None:
    assert home_of(["patrol", "scout"]) == "parking_lot"
    assert home_of(["ardrone", "minnow"]) == "lake"
    with pytest.raises(ValueError, match="There is no world for patrol and minnow together"):
        home_of(["patrol", "minnow"])


def test_a_start_that_was_given_is_kept() -> None:
    given = Start(1.0, 2.0)
    assert starts(load("parking_lot"), [ROBOTS["patrol"]], [given]) == [given]


@pytest.mark.parametrize(
    ("robots", "said"),
    [
        (
            [("scout", Start(3.0, 0.9))],
            r"Scout-1 has no room at \(3, 0\.9\) in narrow: something stands there\.",
        ),
        (
            [("scout", Start(3.0, 0.0)), ("patrol", Start(3.1, 0.0))],
            r"Scout-1 has no room at \(3, 0\) in narrow: something stands there\.",
        ),
    ],
)
def test_a_robot_that_is_put_into_something_is_refused(tmp_path, robots, said) -> None:
    (tmp_path / "narrow.toml").write_text(NARROW, encoding="utf-8")
    with pytest.raises(ValueError, match=said):
        make_several(robots, str(tmp_path / "narrow.toml"), camera=False)
