"""Visible shapes of the commander: bonnet, cabin, load bed, four wheels, laser and cameras."""

from __future__ import annotations

from sim.core.shapes import Quat, Shape, Vec3
from sim.vehicles.commander.parameters import CommanderParameters

__all__ = ["looks"]

_BODY, _TRIM, _GLASS, _RUBBER = (0.27, 0.33, 0.22), (0.12, 0.12, 0.13), (0.10, 0.14, 0.19), (0.06, 0.06, 0.07)
_LYING: Quat = (0.7071067811865476, 0.0, 0.0, 0.7071067811865476)


def looks(parameters: CommanderParameters, position: Vec3, rotation: Quat) -> tuple[Shape, ...]:
    """The shapes to draw of one at `position`, turned by `rotation`."""
    shapes = (*_superstructure(parameters), *_wheels(parameters), *_sensors(parameters))
    return tuple(shape.at(position, rotation) for shape in shapes)


def _superstructure(parameters: CommanderParameters) -> tuple[Shape, ...]:
    body = parameters.body
    length, width = body.length, body.width
    height, deck = body.height - body.clearance, body.clearance + (body.height - body.clearance) * 0.55
    chassis = Shape(
        "box",
        (length, width, height * 0.55),
        (body.ahead, 0.0, body.clearance + height * 0.275),
        colour=_BODY,
        gloss=0.3,
    )
    cabin = Shape(
        "box",
        (length * 0.42, width * 0.94, 0.85),
        (body.ahead + 0.25, 0.0, deck + 0.42),
        colour=_GLASS,
        taper=(0.72, 0.86),
        gloss=0.8,
    )
    roof = Shape(
        "box", (length * 0.30, width * 0.80, 0.05), (body.ahead + 0.25, 0.0, deck + 0.87), colour=_BODY
    )
    bed = Shape(
        "box",
        (length * 0.32, width * 0.96, 0.34),
        (body.ahead - length * 0.33, 0.0, deck + 0.17),
        colour=_BODY,
    )
    return chassis, cabin, roof, bed


def _wheels(parameters: CommanderParameters) -> tuple[Shape, ...]:
    axles = parameters.axles
    across = 2 * axles.radius
    places = [(x, side * axles.track / 2) for x in (0.0, axles.base) for side in (-1, 1)]
    return tuple(
        Shape("cylinder", (across, across, 0.22), (x, y, axles.radius), _LYING, _RUBBER) for x, y in places
    )


def _sensors(parameters: CommanderParameters) -> tuple[Shape, ...]:
    laser = Shape(
        "box", (0.14, 0.14, 0.10), (parameters.laser.ahead, 0.0, parameters.laser.height), colour=_TRIM
    )
    cameras = (
        Shape("box", (0.06, 0.12, 0.06), camera.position, colour=_TRIM, gloss=0.6)
        for camera in parameters.cameras
    )
    return (laser, *cameras)
