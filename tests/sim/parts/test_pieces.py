"""Triangles become boxes that fill what they enclose, and a surface that is where they are."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh

from sim.core.meshes import is_mesh, triangles
from sim.core.shapes import Shape
from sim.parts.errors import PartError
from sim.parts.pieces import MAX_BOXES, MIN_CELL, boxes, check, surface

GREY = (0.5, 0.5, 0.5)


def volume(solids: tuple[Shape, ...]) -> float:
    return sum(math.prod(each.size) for each in solids)


def reach(solids: tuple[Shape, ...]) -> np.ndarray:
    low = np.min([np.array(s.position) - np.array(s.size) / 2 for s in solids], axis=0)
    high = np.max([np.array(s.position) + np.array(s.size) / 2 for s in solids], axis=0)
    return np.array([low, high])


def corners(mesh: trimesh.Trimesh) -> np.ndarray:
    return np.asarray(mesh.triangles, dtype=np.float64)


def test_a_box_is_one_box() -> None:
    found = boxes(corners(trimesh.creation.box((1.0, 0.5, 0.25))), GREY)
    assert len(found) == 1
    assert reach(found) == pytest.approx(np.array([[-0.5, -0.25, -0.125], [0.5, 0.25, 0.125]]), abs=MIN_CELL)


@pytest.mark.parametrize(
    "mesh",
    [
        trimesh.creation.cylinder(0.6, 1.0),
        trimesh.creation.icosphere(3, 0.8),
        trimesh.creation.cone(0.5, 1.2),
        trimesh.creation.annulus(0.4, 0.8, 0.5),
    ],
    ids=["cylinder", "ball", "cone", "ring"],
)
def test_a_body_is_filled_to_half_a_cell_and_a_hole_stays_open(mesh: trimesh.Trimesh) -> None:
    found = boxes(corners(mesh), GREY)
    assert len(found) <= MAX_BOXES
    assert reach(found) == pytest.approx(mesh.bounds, abs=2 * MIN_CELL)
    # a cell counts as full when the surface touches it: too much by half a cell all round
    assert mesh.volume < volume(found) < mesh.volume + 1.2 * mesh.area * MIN_CELL


def test_boxes_do_not_overlap() -> None:
    found = boxes(corners(trimesh.creation.icosphere(3, 0.8)), GREY)
    for number, one in enumerate(found):
        for other in found[:number]:
            apart = np.abs(np.array(one.position) - np.array(other.position))
            assert (apart > (np.array(one.size) + np.array(other.size)) / 2 - 1e-6).any()


def test_a_surface_is_drawn_where_its_triangles_are() -> None:
    given = corners(trimesh.creation.cone(0.5, 1.2)) + np.array((3.0, 2.0, 1.0))
    shape = surface(given, GREY)
    assert is_mesh(shape.kind)
    drawn = triangles(shape.kind) * np.array(shape.size) + np.array(shape.position)
    assert drawn == pytest.approx(given, abs=1e-5)


def test_the_same_triangles_have_the_same_kind() -> None:
    given = corners(trimesh.creation.cone(0.5, 1.2))
    assert surface(given, GREY).kind == surface(2.0 * given, GREY).kind


def test_triangles_that_lie_over_each_other_are_felt_the_more_coarsely_the_more_there_are() -> None:
    """Each costs its area in steps: a small file could else keep a robot side from starting for minutes."""
    one = np.array([[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0]]])
    few, many = boxes(one, GREY), boxes(np.repeat(one, 2000, axis=0), GREY)
    assert min(few[0].size) < 0.2
    assert min(many[0].size) > 1.0


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (np.zeros((0, 3, 3)), "x.glb has no surface"),
        (np.full((1, 3, 3), np.nan), "x.glb has a corner that is no number"),
        (np.array([[[0, 0, 0], [400, 0, 0], [0, 1, 0]]]), "x.glb is 400 m long; 0.001 to 300 m can be"),
        (np.zeros((200_001, 3, 3)), "x.glb has 200001 triangles; at most 200000 can be"),
    ],
)
def test_triangles_that_cannot_be_a_part_are_refused_with_the_value(given: np.ndarray, said: str) -> None:
    with pytest.raises(PartError) as fault:
        check("x.glb", given)
    assert str(fault.value) == said
