"""A world with parts of other programs: bodies, lasers, maps and cameras meet them where the file puts them."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from bridge.msgs.nav_msgs import OccupancyGrid
from bridge.msgs.sensor_msgs import LaserScan
from sim.core.meshes import is_mesh
from sim.core.shapes import from_yaw
from sim.rendering.renderer import Renderer
from sim.rendering.tiny_renderer import scene
from sim.rendering.view import View
from sim.robot import make
from sim.world.world_files import WorldError, load

YARD = Path(__file__).parents[3] / "examples" / "yard"


@pytest.fixture
def yard(tmp_path: Path) -> Path:
    """A copy of the yard, with one sign 2 m ahead of the robot and nothing else."""
    for name in ("sign.urdf", "skip.gltf"):
        shutil.copy(YARD / name, tmp_path / name)
    text = (YARD / "yard.toml").read_text().split("[[models]]")[0]
    file = tmp_path / "yard.toml"
    file.write_text(text + '[[models]]\nfile = "sign.urdf"\nx = -6.0\ny = 0.0\nyaw = 180.0\n')
    return file


def test_a_laser_meets_a_part_and_the_map_has_it(yard: Path) -> None:
    robot = make("patrol", str(yard), camera=False, noise=False)
    measured = dict(robot.read(0.0))
    robot.close()
    scan, grid = measured["/scan"], measured["/map"]
    assert isinstance(scan, LaserScan)
    assert isinstance(grid, OccupancyGrid)
    ahead = np.asarray(scan.ranges)[len(scan.ranges) // 2]
    # its post of 4 cm radius, or its foot of 25 cm, by the height of the beams
    assert 1.7 < ahead < 2.0
    cells = np.asarray(grid.data).reshape(grid.info.height, grid.info.width)
    column = int((-6.0 - grid.info.origin.position.x) / grid.info.resolution)
    row = int((0.0 - grid.info.origin.position.y) / grid.info.resolution)
    assert cells[row, column] == 100


def test_what_moves_about_is_on_no_map_and_met_all_the_same(yard: Path) -> None:
    yard.write_text(yard.read_text() + "loose = true\n")
    world = load(yard)
    sign = world.props[-1]
    assert not set(sign.solids) & set(world.mapped)
    assert set(sign.solids) <= set(world.solids)


def test_a_robot_bumps_into_a_part(yard: Path) -> None:
    from bridge.msgs.geometry_msgs import Twist

    robot = make("patrol", str(yard), camera=False, noise=False)
    robot.read(0.0)
    robot.drive(Twist.planar(0.6, 0.0))
    robot.read(5.0)
    assert robot.simulation.contacts == 1
    assert -6.6 < robot.simulation.pose()[0] < -6.0
    robot.close()


def test_a_camera_sees_a_surface_in_its_colour(yard: Path) -> None:
    yard.write_text(yard.read_text().replace("sign.urdf", "skip.gltf"))
    renderer = Renderer(load(yard))
    picture = renderer.render(View((-11.0, 0.0, 0.8), from_yaw(0.0), (64, 48), 0.6))
    renderer.close()
    red, green, blue = picture[24, 32].astype(int)
    assert red > 1.4 * green > 2 * blue


def test_without_opengl_a_part_is_drawn_as_what_bodies_hit() -> None:
    world = load(YARD / "yard.toml")
    assert any(is_mesh(shape.kind) for shape in world.visuals)
    assert not any(is_mesh(shape.kind) for shape in scene(world))


def test_a_fault_of_a_part_names_the_file_of_the_world_and_the_line(yard: Path) -> None:
    yard.write_text(yard.read_text().replace("sign.urdf", "chair.glb"))
    line = next(n for n, text in enumerate(yard.read_text().splitlines(), 1) if "chair.glb" in text)
    with pytest.raises(WorldError) as fault:
        load(yard)
    assert str(fault.value) == (
        f"yard.toml, line {line}: models[0].file: chair.glb cannot be read (No such file or directory)."
    )


def test_a_part_off_the_ground_is_refused(yard: Path) -> None:
    yard.write_text(yard.read_text().replace("x = -6.0", "x = 900.0"))
    with pytest.raises(WorldError, match=r"models\[0\]: \(900, 0\) is off the ground"):
        load(yard)


def test_so_many_parts_that_no_robot_side_would_start_are_refused(yard: Path) -> None:
    entry = '[[models]]\nfile = "sign.urdf"\nx = 0.0\ny = 4.0\n'
    yard.write_text(yard.read_text() + 100 * entry)
    with pytest.raises(WorldError, match="models: 101 are too many, at most 100 can be"):
        load(yard)
