from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy import ndimage

from sim.world.occupancy import occupancy
from sim.world.world_files import WORLDS, WorldError, load, parse
from tests.sim.rooms import ROOM, room

TEXT = ROOM.format(length=20, width=10, x=0, y=0, yaw=0)


def test_the_parking_lot_is_as_large_and_as_full_as_its_task_needs():
    world = load("parking_lot")
    assert (world.ground.length, world.ground.width) == (40, 30)
    assert len(world.cones) == 6
    assert 10 <= len(world.cars) <= 14


def test_every_world_that_is_offered_loads():
    for name in WORLDS:
        assert load(name).name == name


def test_a_patrol_along_the_aisles_passes_every_cone_within_five_metres():
    ring = [(17.5, 7.5), (-17.5, 7.5), (-17.5, -7.5), (17.5, -7.5), (17.5, 7.5)]
    for cone in load("parking_lot").cones:
        distances = [
            math.dist((cone.x, cone.y), (ax + (bx - ax) * i / 50, ay + (by - ay) * i / 50))
            for (ax, ay), (bx, by) in pairwise(ring)
            for i in range(51)
        ]
        assert 0.3 < min(distances) < 5.0


def test_nothing_stands_in_the_robots_first_metre():
    world = load("parking_lot")
    for prop in world.props:
        if prop.kind in ("car", "cone", "lamp"):
            assert math.dist(prop.position[:2], (world.start.x, world.start.y)) > 1.5


def test_the_map_leaves_out_the_cones_and_only_them():
    world = load("parking_lot")
    assert len(world.solids) - len(world.mapped) == len(world.cones)


def test_an_unknown_world_is_refused_with_the_names_there_are():
    with pytest.raises(WorldError, match=r"There is no world 'moon'; there is .*parking_lot"):
        load("moon")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(WorldError, match=r"gone\.toml: cannot be read \(No such file"):
        load(tmp_path / "gone.toml")


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        (
            ("length = 20", "length = -20"),
            r"lot\.toml, line \d+: ground\.length: must be a number above 0, not -20",
        ),
        *(
            (
                ("length = 20", f"length = {size}"),
                r"lot\.toml, line \d+: ground\.length: must be a number at most 300, not",
            )
            for size in ("300.1", "2000", "1e6", "1e300", "inf")
        ),
        (
            ("length = 20\nwidth = 10", "length = 200\nwidth = 150"),
            r"lot\.toml, line 7: ground: 30000 m2 are too many, at most 20000 can be",
        ),
        (
            ("height = 0.5", "height = inf"),
            r"lot\.toml, line \d+: wall\.height: must be a number at most 300, not inf",
        ),
        (
            ('name = "room"', 'name = ""'),
            r"lot\.toml, line 2: name: must be a text of at least 1 character, not ''",
        ),
        (
            ('name = "room"', f'name = "{"x" * 61}"'),
            r"line 2: name: must be a text of at most 60 characters, not 'x",
        ),
        (
            ("length = 20", 'length = "long"'),
            r"lot\.toml, line \d+: ground\.length: must be a number, not 'long'",
        ),
        (("latitude = 45.0", ""), r"lot\.toml, line \d+: datum\.latitude: is missing"),
        (
            ("latitude = 45.0", "latitude = 91.0"),
            r"lot\.toml, line \d+: datum\.latitude: must be a number below 90, not 91",
        ),
        (
            ("height = 0.5", "height = 0.5\ncolour = 3"),
            r"lot\.toml, line \d+: wall\.colour: is not known here",
        ),
        (
            ("x = 0\n", "x = 11\n"),
            r"lot\.toml, line \d+: start: \(11, 0\) is off the ground, which ends at x = ±10",
        ),
        (("[wall]", "[wall"), r"lot\.toml, line \d+: is not TOML: expected ']'"),
        (
            ("yaw = 0", 'yaw = 0\n[[cars]]\nmodel = "tank"\nx = 1\ny = 1\ncolour = [0, 0, 0]'),
            r"lot\.toml, line \d+: cars\[0\]\.model: 'tank' is not one of sedan, hatchback, suv, van",
        ),
        (
            ("yaw = 0", "yaw = 0\n[[cones]]\nx = 1\ny = 9"),
            r"lot\.toml, line \d+: cones\[0\]: \(1, 9\) is off the ground",
        ),
        *(
            (
                ("yaw = 0", f'yaw = 0\n[[docks]]\nname = "a"\nx = 3\ny = 1\n{lines}'),
                rf"lot\.toml, line \d+: {fault}",
            )
            for lines, fault in [
                (
                    'kind = "socket"',
                    r"docks\[0\]\.kind: must be one of cage, contacts, jetty, pad, not 'socket'",
                ),
                ('kind = "jetty"', r"docks\[0\]\.kind: 'jetty' needs water, .*'contacts' or 'pad' can be"),
                ('kind = "contacts"\nz = 1', r"docks\[0\]\.z: .*'contacts' must be left out, not 1"),
                ('kind = "pad"\nz = 9', r"docks\[0\]\.z: .*'pad' must be 0 to 3 here, not 9"),
                ('kind = "pad"\ntag = 30', r"docks\[0\]\.tag: must be a whole number at most 29, not 30"),
                ('kind = "pad"\npower = 0', r"docks\[0\]\.power: must be a number above 0, not 0"),
                (
                    'kind = "pad"\n[[places]]\nname = "A"\nx = 1\ny = 1',
                    r"docks\[0\]\.name: there is a place 'a'",
                ),
                (
                    'kind = "pad"\n[[docks]]\nname = "b"\nkind = "pad"\nx = 1\ny = 1',
                    r"docks\[1\]\.tag: another dock has 0 already",
                ),
            ]
        ),
        (
            (
                "yaw = 0",
                'yaw = 0\n[water]\ndepth = 3\n[[docks]]\nname = "a"\nx = 3\ny = 1\nkind = "contacts"',
            ),
            r"docks\[0\]\.kind: 'contacts' are for wheels and need dry land",
        ),
        (
            ("yaw = 0", 'yaw = 0\n[water]\ndepth = 3\n[[docks]]\nname = "a"\nx = 3\ny = 1\nkind = "cage"'),
            r"docks\[0\]\.z: of a dock of the kind 'cage' must be -2\.4 to -0\.6 here, not 0",
        ),
    ],
)
def test_a_fault_is_named_with_file_key_and_reason(change, fault):
    assert change[0] in TEXT
    with pytest.raises(WorldError, match=fault):
        parse(TEXT.replace(*change), "lot.toml")


def test_a_world_without_wall_is_open():
    world = parse(TEXT.replace("[wall]\nheight = 0.5\nthickness = 0.2\n", ""), "open.toml")
    assert world.solids == ()


def test_angles_in_the_file_are_degrees():
    assert room(yaw=90).start.angle == pytest.approx(math.pi / 2)


def reached(world, radius):
    """Which of its places a robot of `radius` [m] can come to from the start, by the map."""
    told = occupancy(world, 0.0)
    info = told.info
    cells = np.frombuffer(told.data.tobytes(), dtype=np.int8).reshape(info.height, info.width)
    free = ndimage.distance_transform_edt(cells == 0) * info.resolution > radius
    areas, _ = ndimage.label(free)

    def area(spot):
        column = int((spot.x - info.origin.position.x) / info.resolution)
        return areas[int((spot.y - info.origin.position.y) / info.resolution), column]

    return [place.name for place in world.places if area(place) == area(world.start) != 0]


@pytest.mark.parametrize("name", ["office", "orchard"])
def test_every_place_that_has_a_name_can_be_come_to(name):
    world = load(name)
    assert world.places
    assert reached(world, 0.25) == [place.name for place in world.places]


def test_the_office_has_rooms_a_lab_a_hall_a_reception_and_a_dock_and_people():
    world = load("office")
    kinds = [place.kind for place in world.places]
    assert kinds.count("office") == 8
    assert {"lab", "hall", "reception"} <= set(kinds)
    assert [dock.kind for dock in world.docks] == ["contacts", "pad"]
    assert len(world.people) >= 3
    assert not any(
        prop.kind == "person" and shape in world.mapped for prop in world.props for shape in prop.solids
    )


def test_some_oranges_hang_where_an_arm_reaches_them():
    world = load("orchard")
    oranges = [
        shape
        for prop in world.props
        if prop.kind == "fruit_tree"
        for shape in prop.solids
        if shape.kind == "sphere"
    ]
    near = [shape for shape in oranges if math.dist(shape.position[:2], (3.0, 0.0)) < 1.0]
    assert len(near) == 18
    assert sum(shape.position[2] < 0.75 for shape in near) >= 4
    assert all(shape.position[0] < 3.1 for shape in near)


def test_the_tank_stands_in_water_up_to_its_edge_and_things_lie_in_it():
    world = load("tank")
    assert world.bottom == -5.0
    kinds = {prop.kind: prop for prop in world.props}
    assert {"diver", "coral", "wall", "block"} <= set(kinds)
    lowest = min(shape.position[2] - shape.size[2] / 2 for shape in kinds["wall"].solids)
    assert lowest == pytest.approx(-5.0)
    assert kinds["coral"].position[2] == -5.0


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("[water]\ndepth = -2.0\n", r"water\.depth: must be a number at least 0\.5, not -2"),
        ("[water]\ndepth = inf\n", r"water\.depth: must be a number at most 300, not inf"),
        (
            "[water]\ndepth = 9.0\n[[water.waves]]\nheight = 1.0\nperiod = 0.01\n",
            r"water\.waves\[0\]\.period: must be a number at least 0\.5, not 0\.01",
        ),
        (
            "[water]\ndepth = 9.0\n[[water.waves]]\nheight = 1.0\nperiod = 1.5\n",
            r"water\.waves\[0\]\.height: must be at most 0\.5 m where the period is 1\.5 s, or it breaks, not 1",
        ),
        ("[water]\ndepth = 2.0\n[[water.waves]]\nheight = 0.1\n", r"water\.waves\[0\]\.period: is missing"),
        ("[wind]\nspeed = nan\n", r"wind\.speed: must be a number at least 0, not nan"),
        ("[[buoys]]\nx = 99.0\ny = 0.0\n", r"buoys\[0\]: \(99, 0\) is off the ground"),
        (
            '[[places]]\nname = "a"\nkind = "castle"\nx = 0.0\ny = 0.0\n',
            r"places\[0\]\.kind: 'castle' is not one of place",
        ),
        (
            '[[places]]\nname = "Lab"\nx = 0.0\ny = 0.0\n[[places]]\nname = "LAB"\nx = 1.0\ny = 0.0\n',
            r"places\[1\]\.name: there is a place 'LAB' already",
        ),
        ('[[places]]\nname = " "\nx = 0.0\ny = 0.0\n', r"places\[0\]\.name: must have 1 to 60 characters"),
        (
            "[[trees]]\nx = 500.0\ny = 0.0\n",
            r"trees\[0\]: \(500, 0\) is off the ground, which ends at x = ±10",
        ),
        ('[[tags]]\ntag = "a"\nx = 0.0\ny = -6.0\n', r"line \d+: tags\[0\]: \(0, -6\) is off the ground"),
        (
            "[[partitions]]\nfrom = [1.0, 1.0]\nto = [1.0, 500.0]\n",
            r"line 19: partitions\[0\]\.to: \(1, 500\) is off",
        ),
        (
            "[[lines]]\nfrom = [-11.0, 1.0]\nto = [1.0, 1.0]\n",
            r"lines\[0\]\.from: \(-11, 1\) is off the ground",
        ),
        ("[[arrows]]\nx = 11.0\ny = 1.0\n", r"arrows\[0\]: \(11, 1\) is off the ground"),
        (
            "[[bays]]\nx = 1.0\ny = 1.0\ncount = 4\nwidth = 2.5\ndepth = 3.0\n",
            r"bays\[0\]: \(11, 4\) is off the ground",
        ),
        (
            '[[cars]]\nmodel = "van"\nx = 1.0\ny = 0.5\ncolour = [0.0, 0.0, 0.0]\n',
            r"own\.toml, line 13: start: \(0, 0\) is inside the car at \(1, 0\.5\)",
        ),
        (
            "[[blocks]]\nx = 0.5\ny = 0.0\nlength = 2.0\nwidth = 2.0\nheight = 1.0\n",
            r"start: \(0, 0\) is inside the block at \(0\.5, 0\)",
        ),
        ("[[partitions]]\nfrom = [1.0, 1.0]\nto = [1.0, 1.0]\n", r"partitions\[0\]: begins where it ends"),
    ],
)
def test_a_fault_in_the_new_parts_is_named_with_key_and_reason(text, reason):
    with pytest.raises(WorldError, match=reason):
        parse(TEXT + text, "own.toml")


def test_a_start_has_a_depth_only_where_there_is_water():
    dry = TEXT.replace("[start]", "[start]\nz = 5.0")
    with pytest.raises(
        WorldError, match=r"line 14: start\.z: must be left out or 0 where there is no water, not 5"
    ):
        parse(dry, "own.toml")
    with pytest.raises(WorldError, match=r"start\.z: must be at most 0, the water's surface, not 5"):
        parse(dry + "[water]\ndepth = 9.0\n", "own.toml")


def test_a_start_may_be_under_what_hangs_and_above_what_lies_deep():
    arch = "[[blocks]]\nx = 0.0\ny = 0.0\nz = {z}\nlength = 2.0\nwidth = 2.0\nheight = 1.0\n"
    assert parse(TEXT + arch.format(z=2.0), "own.toml").blocks
    assert parse(TEXT + arch.format(z=-4.0) + "[water]\ndepth = 4.0\n", "own.toml").blocks


def test_a_directory_is_no_world_and_that_is_said(tmp_path):
    (tmp_path / "dunes.toml").mkdir()
    for world in (tmp_path, tmp_path / "dunes.toml"):
        with pytest.raises(WorldError, match=f"{world} is a directory; a world is one file"):
            load(world)


@pytest.mark.parametrize(
    ("height", "posture", "tall"),
    [(1.75, "standing", 1.75), (1.5, "walking", 1.5), (1.75, "crouching", 1.35)],
)
def test_a_person_is_as_tall_as_the_file_says_in_each_posture(
    height: float, posture: str, tall: float
) -> None:
    world = parse(
        f"{TEXT}\n[[people]]\nx = 3.0\ny = 1.0\nheight = {height}\nposture = '{posture}'\n", "people.toml"
    )
    person = next(prop for prop in world.props if prop.kind == "person")
    assert person.solids[0].size[2] == pytest.approx(tall, abs=0.01)
    corners = [corner for shape in person.visuals for corner in shape.corners()]
    assert max(z for _, _, z in corners) == pytest.approx(tall, abs=0.12)
    assert -0.05 < min(z for _, _, z in corners) < 0.12
    assert max(math.dist(corner[:2], (3.0, 1.0)) for corner in corners) < 0.75


def test_a_posture_that_nobody_knows_is_refused() -> None:
    with pytest.raises(WorldError, match="posture"):
        parse(f"{TEXT}\n[[people]]\nx = 3.0\ny = 1.0\nposture = 'flying'\n", "people.toml")


def test_a_barrel_stands_in_the_way_and_is_not_on_the_map() -> None:
    world = parse(f"{TEXT}\n[[barrels]]\nx = 3.0\ny = 1.0\n", "barrel.toml")
    assert len(world.solids) == len(world.mapped) + 1
