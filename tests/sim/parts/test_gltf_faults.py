"""What a glTF file has that cannot be shown as it is meant is refused in one sentence, by name."""

from __future__ import annotations

import json
import struct
from base64 import b64encode
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from sim.parts.errors import PartError
from sim.parts.part import part

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype="<f4")
FACES = np.array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3], dtype="<u2")
UV = np.zeros((4, 2), dtype="<f4")


def inline(data: bytes, kind: str = "application/octet-stream") -> str:
    return f"data:{kind};base64,{b64encode(data).decode()}"


def png() -> bytes:
    with BytesIO() as file:
        Image.new("RGB", (4, 4), (200, 0, 0)).save(file, "PNG")
        return file.getvalue()


def thing(**changes: Any) -> dict[str, Any]:
    """A corner of a box, 1 m long; its colour is in the picture red.png."""
    blob = CORNERS.tobytes() + UV.tobytes() + FACES.tobytes()
    views = [(0, 48), (48, 32), (80, 24)]
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "root", "children": [1]}, {"mesh": 0}],
        "meshes": [
            {"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}
        ],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": "red.png"}],
        "buffers": [{"byteLength": len(blob), "uri": inline(blob)}],
        "bufferViews": [{"buffer": 0, "byteOffset": start, "byteLength": length} for start, length in views],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": 4,
                "type": "VEC3",
                "min": [0, 0, 0],
                "max": [1] * 3,
            },
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 12, "type": "SCALAR"},
        ],
        **changes,
    }


def written(folder: Path, tree: dict[str, Any]) -> Path:
    (folder / "thing.gltf").write_text(json.dumps(tree))
    return folder / "thing.gltf"


def refused(path: Path) -> str:
    with pytest.raises(PartError) as fault:
        part(path)
    return str(fault.value)


@pytest.mark.parametrize("scale", [[0.001] * 3, [1, 1, -1], [1e-3, 1, 1]])
def test_a_thing_with_its_picture_beside_it_is_read_in_its_colour(tmp_path: Path, scale: list[float]) -> None:
    (tmp_path / "red.png").write_bytes(png())
    nodes = [{"name": "hidden", "scale": [0, 0, 0]}, {"mesh": 0, "scale": [each * 10 for each in scale]}]
    (seen,) = part(written(tmp_path, thing(nodes=nodes, scenes=[{"nodes": [0, 1]}]))).visuals
    assert seen.colour == pytest.approx((200 / 255, 0.0, 0.0), abs=0.01)


def test_a_picture_that_is_not_beside_it_is_named(tmp_path: Path) -> None:
    said = "thing.gltf has a picture 'red.png' for a surface, which is not beside it"
    assert refused(written(tmp_path, thing())) == said


@pytest.mark.parametrize("uri", ["red.png", inline(b"no picture", "image/png")])
def test_a_picture_that_is_none_is_named(tmp_path: Path, uri: str) -> None:
    (tmp_path / "red.png").write_bytes(png()[:40])
    called = "0" if uri.startswith("data:") else "'red.png'"
    said = f"thing.gltf has a picture {called} for a surface, which cannot be read as a picture"
    assert refused(written(tmp_path, thing(images=[{"uri": uri}]))) == said


def test_a_picture_of_no_surface_may_be_missing(tmp_path: Path) -> None:
    materials = [{"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 1, 1]}, "normalTexture": {"index": 0}}]
    assert part(written(tmp_path, thing(materials=materials))).visuals[0].colour == (0.0, 0.0, 1.0)


@pytest.mark.parametrize("node", [{"scale": [1, 0, 1]}, {"matrix": [0.0] * 15 + [1.0]}])
@pytest.mark.parametrize("number", [0, 1])
def test_a_node_that_makes_its_part_vanish_is_named(
    tmp_path: Path, node: dict[str, Any], number: int
) -> None:
    (tmp_path / "red.png").write_bytes(png())
    tree = thing()
    tree["nodes"][number].update(node)
    called = "'root'" if number == 0 else "number 1"
    said = f"thing.gltf has a node {called} whose scale of 0 makes it vanish"
    assert refused(written(tmp_path, tree)) == said


@pytest.mark.parametrize("required", [True, False])
def test_a_compressed_surface_is_refused(tmp_path: Path, required: bool) -> None:
    tree, name = thing(), "KHR_draco_mesh_compression"
    if required:
        tree["extensionsRequired"] = [name]
    else:
        tree["meshes"][0]["primitives"][0]["extensions"] = {name: {"bufferView": 0, "attributes": {}}}
    said = "thing.gltf is compressed with Draco (KHR_draco_mesh_compression), which is not read; export it without compression"
    assert refused(written(tmp_path, tree)) == said


def test_a_binary_file_is_looked_at_too(tmp_path: Path) -> None:
    tree = thing(images=[{"bufferView": 3, "mimeType": "image/png"}])
    blob = CORNERS.tobytes() + UV.tobytes() + FACES.tobytes()
    tree["buffers"] = [{"byteLength": len(blob) + len(png())}]
    tree["bufferViews"].append({"buffer": 0, "byteOffset": len(blob), "byteLength": len(png())})
    path = tmp_path / "thing.glb"
    path.write_bytes(binary(tree, blob + png()))
    assert part(path).visuals[0].colour == pytest.approx((200 / 255, 0.0, 0.0), abs=0.01)
    path.write_bytes(binary(tree, blob + b"x" * len(png())))
    assert refused(path) == "thing.glb has a picture 0 for a surface, which cannot be read as a picture"


def binary(tree: dict[str, Any], blob: bytes) -> bytes:
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    blob += b"\0" * (-len(blob) % 4)
    head = struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(blob))
    return (
        head
        + struct.pack("<II", len(text), 0x4E4F534A)
        + text
        + struct.pack("<II", len(blob), 0x004E4942)
        + blob
    )


@pytest.mark.parametrize(
    "wrong", [[], {"nodes": 3}, thing(nodes=[{"mesh": 0, "scale": "big"}]), thing(textures=[])]
)
def test_a_file_that_is_no_gltf_is_one_sentence(tmp_path: Path, wrong: Any) -> None:
    assert refused(written(tmp_path, wrong)) == "thing.gltf cannot be read as a gltf file"
