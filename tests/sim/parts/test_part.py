"""Parts from files of other programs: the right size, the right way up, in their colours; and each fault in one sentence."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import trimesh

from sim.parts.errors import PartError
from sim.parts.part import part
from sim.parts.urdf import MAX_LINKS

STAND = """<robot name="stand">
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="foot">
    <visual><geometry><box size="0.4 0.2 0.1"/></geometry><material name="red"/></visual>
    <collision><geometry><box size="0.4 0.2 0.1"/></geometry></collision>
  </link>
  <link name="post">
    <visual><geometry><cylinder radius="0.05" length="1"/></geometry></visual>
    <collision><origin xyz="0 0 0.5"/><geometry><cylinder radius="0.05" length="1"/></geometry></collision>
  </link>
  <joint name="turn" type="revolute">
    <parent link="foot"/><child link="post"/><origin xyz="0.1 0 0.05" rpy="0 0 1.5707963"/>
  </joint>
</robot>"""


def written(tmp_path: Path, text: str, name: str = "stand.urdf") -> Path:
    (tmp_path / name).write_text(text)
    return tmp_path / name


def glb(tmp_path: Path) -> Path:
    """In glTF's frame: 1 wide along x, 2 high along y, 3 long along z; red, and a blue ball above it."""
    body = trimesh.creation.box((1.0, 2.0, 3.0))
    body.visual = trimesh.visual.TextureVisuals(
        material=trimesh.visual.material.PBRMaterial(baseColorFactor=[255, 0, 0, 255])
    )
    ball = trimesh.creation.icosphere(2, 0.5)
    ball.visual = trimesh.visual.TextureVisuals(
        material=trimesh.visual.material.PBRMaterial(baseColorFactor=[0, 0, 255, 255])
    )
    scene = trimesh.Scene([body])
    scene.add_geometry(ball, transform=trimesh.transformations.translation_matrix((0.0, 1.5, 0.0)))
    path = tmp_path / "crate.glb"
    path.write_bytes(scene.export(file_type="glb"))
    return path


def test_a_gltf_thing_stands_upright_and_faces_ahead(tmp_path: Path) -> None:
    found = part(glb(tmp_path))
    red = next(shape for shape in found.visuals if shape.colour == pytest.approx((1.0, 0.0, 0.0)))
    blue = next(shape for shape in found.visuals if shape.colour == pytest.approx((0.0, 0.0, 1.0)))
    assert red.size == pytest.approx((3.0, 1.0, 2.0), abs=1e-5)  # long ahead, wide to the left, high up
    assert blue.position == pytest.approx((0.0, 0.0, 1.5), abs=1e-5)
    top = max(solid.position[2] + solid.size[2] / 2 for solid in found.solids)
    assert top == pytest.approx(2.0, abs=0.1)


def test_a_scale_makes_all_of_it_larger(tmp_path: Path) -> None:
    small, large = part(glb(tmp_path)), part(glb(tmp_path), 2.0)
    for one, other in zip(small.visuals, large.visuals, strict=True):
        assert other.size == pytest.approx([2 * extent for extent in one.size])
        assert other.position == pytest.approx([2 * extent for extent in one.position])


def test_the_links_of_a_urdf_stand_where_joints_at_zero_put_them(tmp_path: Path) -> None:
    found = part(written(tmp_path, STAND))
    foot, post = found.solids
    assert (foot.kind, foot.size) == ("box", (0.4, 0.2, 0.1))
    assert post.kind == "cylinder"
    assert post.size == pytest.approx((0.1, 0.1, 1.0))
    assert post.position == pytest.approx((0.1, 0.0, 0.55))
    assert found.visuals[0].colour == (1.0, 0.0, 0.0)
    assert found.visuals[1].position == pytest.approx((0.1, 0.0, 0.05))


def test_what_leans_is_met_as_upright_boxes(tmp_path: Path) -> None:
    leaning = STAND.replace('<origin xyz="0 0 0.5"/>', '<origin xyz="0 0 0.5" rpy="0 0.7853981 0"/>')
    solids = part(written(tmp_path, leaning)).solids[1:]
    assert len(solids) > 3
    assert all(solid.rotation == (0.0, 0.0, 0.0, 1.0) for solid in solids)
    # the post's frame is turned by 90°: it leans towards y, half of its length each way
    farthest = max(abs(solid.position[1]) + solid.size[1] / 2 for solid in solids)
    assert farthest == pytest.approx(0.5 * math.sin(math.pi / 4) + 0.05 * math.cos(math.pi / 4), abs=0.06)


def test_a_urdf_without_collisions_is_as_solid_as_it_looks(tmp_path: Path) -> None:
    text = STAND.replace("<collision>", "<!--").replace("</collision>", "-->")
    assert [solid.kind for solid in part(written(tmp_path, text)).solids] == ["box", "cylinder"]


def test_a_mesh_of_a_urdf_is_beside_it(tmp_path: Path) -> None:
    (tmp_path / "meshes").mkdir()
    trimesh.creation.icosphere(2, 0.5).export(tmp_path / "meshes" / "ball.stl")
    mesh = '<mesh filename="package://meshes/ball.stl" scale="2 2 2"/>'
    text = STAND.replace('<box size="0.4 0.2 0.1"/>', mesh)
    found = part(written(tmp_path, text))
    assert found.visuals[0].size == pytest.approx((2.0, 2.0, 2.0), abs=0.02)
    assert np.max([s.position[0] + s.size[0] / 2 for s in found.solids]) == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("<robot", "stand.urdf is no XML (unclosed token: line 1, column 0)"),
        ("<world/>", "stand.urdf is no URDF: it begins with <world>, not <robot>"),
        (
            '<!DOCTYPE a [<!ENTITY b "c">]><robot/>',
            "stand.urdf has a document type, which no URDF file needs",
        ),
        ("<robot/>", f"stand.urdf has 0 links; 1 to {MAX_LINKS} can be"),
        ('<robot><link name="a"/></robot>', "stand.urdf has no link with a shape"),
        (
            '<robot><link name="a"/><link name="a"/></robot>',
            "stand.urdf has links without a name, or two of one name",
        ),
        (
            STAND.replace('size="0.4 0.2 0.1"', 'size="0.4 0.2"'),
            "size has 3 numbers, which '0.4 0.2' has not",
        ),
        (
            STAND.replace('size="0.4', 'size="-1'),
            "stand.urdf has a box of -1 x 0.2 x 0.1 m; 0.001 to 300 can be",
        ),
        (
            STAND.replace('xyz="0.1 0 0.05"', 'xyz="0.1 nan 0"'),
            "xyz has 3 numbers, which '0.1 nan 0' has not",
        ),
        (
            STAND.replace('child link="post"', 'child link="arm"'),
            "stand.urdf has a joint of the link 'arm', which is not there",
        ),
        (
            STAND.replace('<parent link="foot"/>', '<parent link="post"/>'),
            "stand.urdf has joints in a circle",
        ),
        (
            STAND.replace('<box size="0.4 0.2 0.1"/>', '<mesh filename="ball.stl"/>'),
            "stand.urdf has a mesh 'ball.stl', which is not beside it",
        ),
        (
            STAND.replace('<box size="0.4 0.2 0.1"/>', '<mesh filename="ball.dae"/>'),
            "stand.urdf has a mesh 'ball.dae'; .glb, .gltf, .stl, .obj, .ply can be",
        ),
        (
            STAND.replace('<box size="0.4 0.2 0.1"/>', "<capsule/>"),
            "stand.urdf has a 'capsule'; box, cylinder, sphere and mesh can be",
        ),
    ],
)
def test_a_faulty_urdf_is_refused_in_one_sentence(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(PartError) as fault:
        part(written(tmp_path, text))
    assert str(fault.value) == said


def test_a_file_that_is_no_part_is_refused(tmp_path: Path) -> None:
    with pytest.raises(
        PartError, match=r"^a part is a file that ends with \.glb, \.gltf, \.urdf, not 'chair\.fbx'$"
    ):
        part(tmp_path / "chair.fbx")
    with pytest.raises(PartError, match=r"^chair\.glb cannot be read \(No such file or directory\)$"):
        part(tmp_path / "chair.glb")
    with pytest.raises(PartError, match=r"^chair\.glb cannot be read as a glb file$"):
        part(written(tmp_path, "no glTF at all", "chair.glb"))


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("<visual/>" * 401, "stand.urdf has 403 visuals and collisions; at most 400 can be"),
        (
            '<collision><origin rpy="1 0 0"/><geometry><box size="1 1 1"/></geometry></collision>' * 41,
            "stand.urdf has 41 meshes and shapes that lean; at most 40 can be",
        ),
        (
            '<visual><geometry><sphere radius="1e-300"/></geometry></visual>',
            "stand.urdf has a sphere of 2e-300 x 2e-300 x 2e-300 m; 0.001 to 300 can be",
        ),
    ],
)
def test_a_urdf_that_would_take_for_ever_is_refused(tmp_path: Path, more: str, said: str) -> None:
    text = (
        STAND.split('<link name="post">', maxsplit=1)[0].replace("</collision>", "</collision>" + more, 1)
        + "</robot>"
    )
    with pytest.raises(PartError) as fault:
        part(written(tmp_path, text))
    assert str(fault.value) == said


def test_a_name_that_no_file_can_have_is_refused(tmp_path: Path) -> None:
    with pytest.raises(PartError, match="is no name of a file$"):
        part(tmp_path / "g\0k.gltf")


def test_a_file_that_changed_is_read_again(tmp_path: Path) -> None:
    import os

    path = written(tmp_path, STAND)
    assert part(path).solids[0].size == (0.4, 0.2, 0.1)
    path.write_text(STAND.replace("0.4 0.2 0.1", "0.8 0.2 0.1"))
    os.utime(path, ns=(1, 1))
    assert part(path).solids[0].size == (0.8, 0.2, 0.1)
