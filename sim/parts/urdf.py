"""Parts in URDF files: their links with all joints at zero."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import trimesh

from sim.core.shapes import Colour, Quat, Shape, Vec3, compose, rotate
from sim.parts.errors import PartError
from sim.parts.gltf import GREY, read_triangles
from sim.parts.pieces import MAX_SIZE, MIN_SIZE, Triangles, boxes, check, surface

__all__ = ["read_urdf"]

MAX_LINKS = 200
MAX_SHAPES, MAX_MADE = 400, 40
"""Of one part, those of its links, and those of them that are meshes or lean, of which boxes have to be made."""
_MESHES = (".glb", ".gltf", ".stl", ".obj", ".ply")
"""Endings of the meshes that links may have."""

Element = ET.Element


@dataclass(frozen=True, slots=True)
class _Frame:
    """A place in the part, and a turn there."""

    position: Vec3 = (0.0, 0.0, 0.0)
    rotation: Quat = (0.0, 0.0, 0.0, 1.0)

    def then(self, inner: _Frame) -> _Frame:
        """The frame `inner` of this one."""
        x, y, z = rotate(self.rotation, inner.position)
        here = self.position
        return _Frame((here[0] + x, here[1] + y, here[2] + z), compose(self.rotation, inner.rotation))


def read_urdf(path: Path, scale: float) -> tuple[tuple[Shape, ...], tuple[Shape, ...]]:
    """Solids and visuals of the thing in the file; PartError with the reason when it is none."""
    root = _root(path)
    colours = {name: _rgb(each) for each in root.findall("material") if (name := each.get("name"))}
    frames = _frames(root, path.name)
    _check_count(root, path.name)
    links = [(link, frames[link.get("name", "")]) for link in root.findall("link")]

    def shapes(kind: str, *, solid: bool) -> tuple[Shape, ...]:
        return tuple(
            shape
            for link, base in links
            for element in link.findall(kind)
            for shape in _shapes(
                element, base.then(_origin(element)), _colour(element, colours), path, scale, solid=solid
            )
        )

    # what has no collision of its own is as solid as it looks
    solids = shapes("collision", solid=True) or shapes("visual", solid=True)
    if not solids:
        raise PartError(f"{path.name} has no link with a shape")
    return solids, shapes("visual", solid=False) or solids


def _root(path: Path) -> Element:
    try:
        text = path.read_text("utf-8")
    except (OSError, UnicodeError) as fault:
        raise PartError(f"{path.name} is no text in UTF-8") from fault
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise PartError(f"{path.name} has a document type, which no URDF file needs")
    try:
        root = ET.fromstring(text)  # noqa: S314 - without a document type nothing in it grows
    except ET.ParseError as fault:
        raise PartError(f"{path.name} is no XML ({fault})") from fault
    if root.tag != "robot":
        raise PartError(f"{path.name} is no URDF: it begins with <{root.tag[:40]}>, not <robot>")
    count = len(root.findall("link"))
    if not 1 <= count <= MAX_LINKS:
        raise PartError(f"{path.name} has {count} links; 1 to {MAX_LINKS} can be")
    return root


def _check_count(root: Element, name: str) -> None:
    shapes = [*root.iterfind("link/visual"), *root.iterfind("link/collision")]
    if len(shapes) > MAX_SHAPES:
        raise PartError(f"{name} has {len(shapes)} visuals and collisions; at most {MAX_SHAPES} can be")
    made = [shape for shape in shapes if shape.find("geometry/mesh") is not None or _leans(shape)]
    if len(made) > MAX_MADE:
        raise PartError(f"{name} has {len(made)} meshes and shapes that lean; at most {MAX_MADE} can be")


def _leans(element: Element) -> bool:
    return not _is_upright(_origin(element).rotation)


def _frames(root: Element, name: str) -> dict[str, _Frame]:
    """The frame of each link by its name, from the one link that no joint carries."""
    links = [link.get("name", "") for link in root.findall("link")]
    if len(set(links)) < len(links) or "" in links:
        raise PartError(f"{name} has links without a name, or two of one name")
    carried: dict[str, tuple[str, _Frame]] = {}
    for joint in root.findall("joint"):
        parent, child = (_linked(joint, end) for end in ("parent", "child"))
        for link in (parent, child):
            if link not in links:
                raise PartError(f"{name} has a joint of the link {link[:40]!r}, which is not there")
        carried[child] = (parent, _origin(joint))
    return {link: _frame(link, carried, name) for link in links}


def _frame(link: str, carried: dict[str, tuple[str, _Frame]], name: str) -> _Frame:
    way: list[_Frame] = []
    while link in carried:
        link, step = carried[link]
        way.append(step)
        if len(way) > MAX_LINKS:
            raise PartError(f"{name} has joints in a circle")
    frame = _Frame()
    for step in reversed(way):
        frame = frame.then(step)
    return frame


def _linked(joint: Element, end: str) -> str:
    element = joint.find(end)
    return "" if element is None else element.get("link", "")


def _origin(element: Element) -> _Frame:
    origin = element.find("origin")
    if origin is None:
        return _Frame()
    x, y, z = _numbers(origin, "xyz", 3, (0.0, 0.0, 0.0))
    roll, pitch, yaw = _numbers(origin, "rpy", 3, (0.0, 0.0, 0.0))
    turn = (0.0, 0.0, 0.0, 1.0)
    for axis, angle in ((2, yaw), (1, pitch), (0, roll)):
        about = [0.0, 0.0, 0.0, math.cos(angle / 2)]
        about[axis] = math.sin(angle / 2)
        turn = compose(turn, (about[0], about[1], about[2], about[3]))
    return _Frame((x, y, z), turn)


def _numbers(element: Element, key: str, count: int, usual: tuple[float, ...]) -> tuple[float, ...]:
    text = element.get(key)
    if text is None:
        return usual
    try:
        found = tuple(float(word) for word in text.split())
    except ValueError:
        found = ()
    if len(found) != count or not all(map(math.isfinite, found)):
        raise PartError(f"{key} has {count} numbers, which {text[:40]!r} has not")
    return found


def _rgb(material: Element) -> Colour:
    colour = material.find("color")
    if colour is None:
        return GREY
    red, green, blue, _ = (min(max(part, 0.0), 1.0) for part in _numbers(colour, "rgba", 4, (*GREY, 1.0)))
    return red, green, blue


def _colour(element: Element, named: dict[str, Colour]) -> Colour:
    material = element.find("material")
    if material is None:
        return GREY
    return _rgb(material) if material.find("color") is not None else named.get(material.get("name", ""), GREY)


def _shapes(
    element: Element, frame: _Frame, colour: Colour, path: Path, scale: float, *, solid: bool
) -> Iterator[Shape]:
    """What bodies and lasers meet, when it is `solid`, of a visual or a collision; else what cameras see of it."""
    geometry = element.find("geometry")
    shape = geometry[0] if geometry is not None and len(geometry) else None
    if shape is None:
        raise PartError(f"{path.name} has a {element.tag} without a geometry")
    if shape.tag == "mesh":
        yield from _mesh(shape, frame, colour, path, scale, solid=solid)
        return
    size = _size(shape, path.name)
    scaled = _scaled(size, scale)
    if not MIN_SIZE <= min(scaled) <= max(scaled) <= MAX_SIZE:
        told = " x ".join(f"{extent:g}" for extent in scaled)
        raise PartError(f"{path.name} has a {shape.tag} of {told} m; {MIN_SIZE:g} to {MAX_SIZE:g} can be")
    plain = Shape(shape.tag, scaled, _scaled(frame.position, scale), frame.rotation, colour=colour)
    if solid and shape.tag != "sphere" and not _is_upright(frame.rotation):
        yield from boxes(_triangles(plain), colour)  # maps and lasers take nothing that leans
    else:
        yield plain


def _is_upright(rotation: Quat) -> bool:
    return rotate(rotation, (0.0, 0.0, 1.0))[2] > 1.0 - 1e-6


def _triangles(shape: Shape) -> Triangles:
    made = (
        trimesh.creation.box(shape.size)
        if shape.kind == "box"
        else trimesh.creation.cylinder(shape.size[0] / 2, shape.size[2])
    )
    return _placed(np.asarray(made.triangles, dtype=np.float64), _Frame(shape.position, shape.rotation))


def _size(shape: Element, name: str) -> Vec3:
    if shape.tag == "box":
        x, y, z = _numbers(shape, "size", 3, (0.0, 0.0, 0.0))
    elif shape.tag in ("cylinder", "sphere"):
        (radius,) = _numbers(shape, "radius", 1, (0.0,))
        (length,) = _numbers(shape, "length", 1, (0.0,)) if shape.tag == "cylinder" else (2 * radius,)
        x, y, z = 2 * radius, 2 * radius, length
    else:
        raise PartError(f"{name} has a {shape.tag[:40]!r}; box, cylinder, sphere and mesh can be")
    return x, y, z


def _scaled(size: Vec3, scale: float) -> Vec3:
    return size[0] * scale, size[1] * scale, size[2] * scale


def _mesh(
    shape: Element, frame: _Frame, colour: Colour, path: Path, scale: float, *, solid: bool
) -> Iterator[Shape]:
    named = shape.get("filename", "")
    file = path.parent / named.removeprefix("package://").removeprefix("file://")
    if file.suffix.lower() not in _MESHES:
        raise PartError(f"{path.name} has a mesh {named[:60]!r}; {', '.join(_MESHES)} can be")
    if not file.is_file():
        raise PartError(f"{path.name} has a mesh {named[:60]!r}, which is not beside it")
    stretch = np.array(_numbers(shape, "scale", 3, (1.0, 1.0, 1.0)))
    pieces = [(_placed(corners * stretch, frame) * scale, own) for corners, own in read_triangles(file)]
    every = np.concatenate([corners for corners, _ in pieces]) if pieces else np.zeros((0, 3, 3))
    check(file.name, every)
    if solid:
        yield from boxes(every, colour)
        return
    for corners, own in pieces:
        yield surface(corners, own if colour == GREY else colour)


def _placed(corners: Triangles, frame: _Frame) -> Triangles:
    axes = np.array(
        [rotate(frame.rotation, axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    )
    return np.asarray(corners @ axes + np.array(frame.position))
