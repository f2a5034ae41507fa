"""What a glTF file has that cannot be shown as it is meant: told before it is read, for the library that reads it passes over it."""

from __future__ import annotations

import json
import struct
from base64 import b64decode
from collections.abc import Iterator, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
from PIL import Image

from sim.parts.errors import PartError

__all__ = ["check_gltf"]

_PACKED = {
    "KHR_draco_mesh_compression": "Draco",
    "EXT_meshopt_compression": "meshopt",
    "KHR_meshopt_compression": "meshopt",
}
"""Extensions that pack a surface, by what people call them."""
_MAGIC, _JSON = 0x46546C67, 0x4E4F534A
"""The first word of a binary file, and of the part of it that is JSON."""
_THINNEST = 1e-9
"""A node that makes its surface smaller than this part in a direction makes it vanish."""

Tree = Mapping[str, Any]


def check_gltf(path: Path) -> None:
    """PartError, with one sentence, for compressed surfaces, nodes that make theirs vanish, and pictures that are not to be had."""
    try:
        tree, binary = _contents(path)
        faults = list(_faults(path, tree, binary))
    except (OSError, ValueError, KeyError, IndexError, TypeError, AttributeError, struct.error) as fault:
        raise PartError(f"{path.name} cannot be read as a {path.suffix[1:]} file") from fault
    if faults:
        raise PartError(f"{path.name} {faults[0]}")


def _contents(path: Path) -> tuple[Tree, bytes]:
    """The JSON of a file, and the bytes that come behind it in a binary one."""
    found = path.read_bytes()
    if len(found) < 20 or struct.unpack_from("<I", found)[0] != _MAGIC:
        return json.loads(found), b""
    length, kind = struct.unpack_from("<II", found, 12)
    if kind != _JSON:
        raise ValueError("no JSON comes first")
    return json.loads(found[20 : 20 + length]), found[28 + length :]


def _faults(path: Path, tree: Tree, binary: bytes) -> Iterator[str]:
    yield from _packed(tree)
    shown = _shown(tree)
    for number, node in enumerate(tree.get("nodes", ())):
        if number in shown and _vanishes(node):
            called = repr(node["name"][:40]) if node.get("name") else f"number {number}"
            yield f"has a node {called} whose scale of 0 makes it vanish"
    for number in _needed(tree):
        fault = _picture_fault(path, tree, binary, number)
        if fault:
            yield fault


def _packed(tree: Tree) -> Iterator[str]:
    used = [
        *tree.get("extensionsRequired", ()),
        *(key for mesh in tree.get("meshes", ()) for each in mesh["primitives"] for key in _extensions(each)),
        *(key for view in tree.get("bufferViews", ()) for key in _extensions(view)),
    ]
    for key in used:
        if key in _PACKED:
            yield f"is compressed with {_PACKED[key]} ({key}), which is not read; export it without compression"


def _extensions(entry: Tree) -> list[str]:
    return list(entry.get("extensions", {}))


def _shown(tree: Tree) -> set[int]:
    """The nodes that carry a surface, by themselves or by what hangs on them."""
    nodes = tree.get("nodes", ())
    found = {number for number, node in enumerate(nodes) if "mesh" in node}
    while more := {n for n, node in enumerate(nodes) if found.intersection(node.get("children", ()))} - found:
        found |= more
    return found


def _vanishes(node: Tree) -> bool:
    """The node draws its part of the thing flat, or in a point."""
    matrix = np.array(node.get("matrix", np.eye(4).ravel()), dtype=np.float64).reshape(4, 4)[:3, :3]
    stretched = matrix * np.array(node.get("scale", (1.0, 1.0, 1.0)), dtype=np.float64)
    if not np.isfinite(stretched).all():
        raise ValueError("a node has a scale that is no number")
    return bool(np.linalg.svd(stretched, compute_uv=False).min() < _THINNEST)


def _needed(tree: Tree) -> list[int]:
    """The pictures that give surfaces their colours."""
    primitives = [each for mesh in tree.get("meshes", ()) for each in mesh["primitives"]]
    found: set[int] = set()
    for number in {each["material"] for each in primitives if "material" in each}:
        material = tree["materials"][number]
        glossy = material.get("extensions", {}).get("KHR_materials_pbrSpecularGlossiness", {})
        worn = material.get("pbrMetallicRoughness", {}).get("baseColorTexture") or glossy.get(
            "diffuseTexture"
        )
        if worn is not None:
            texture = tree["textures"][worn["index"]]
            sources = [texture, *texture.get("extensions", {}).values()]
            found.update([each["source"] for each in sources if "source" in each][:1])
    return sorted(found)


def _picture_fault(path: Path, tree: Tree, binary: bytes, number: int) -> str:
    """Why a picture is not to be had; empty when it is."""
    picture = tree["images"][number]
    uri: str = picture.get("uri", "")
    within = "bufferView" in picture or uri.startswith("data:")
    called = f"picture {number}" if within else f"picture {uri[:60]!r}"
    if not within and not (path.parent / unquote(uri)).is_file():
        return f"has a {called} for a surface, which is not beside it"
    try:
        with Image.open(BytesIO(_picture(path, tree, binary, picture))) as opened:
            opened.load()
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        return f"has a {called} for a surface, which cannot be read as a picture"
    return ""


def _picture(path: Path, tree: Tree, binary: bytes, picture: Tree) -> bytes:
    if "bufferView" not in picture:
        return _at(path, picture["uri"])
    view = tree["bufferViews"][picture["bufferView"]]
    buffer = tree["buffers"][view["buffer"]]
    whole = _at(path, buffer["uri"]) if "uri" in buffer else binary
    start = view.get("byteOffset", 0)
    return whole[start : start + view["byteLength"]]


def _at(path: Path, uri: str) -> bytes:
    if uri.startswith("data:"):
        return b64decode(uri.partition(",")[2])
    return (path.parent / unquote(uri)).read_bytes()
