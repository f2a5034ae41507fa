"""Mounting of payloads on a vehicle, beside its own sensors.

mount(vehicle, ["arm", "lights"])

A payload that is not mounted is not made: it costs nothing and says nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from bridge.core.toml_files import read, text_of
from sim.core.parameters import Table
from sim.payloads.arm import ArmParameters, MountedArm
from sim.payloads.mounted import (
    CameraMount,
    LaserMount,
    LightsMount,
    LineMount,
    Mounted,
    SonarMount,
    TagReaderMount,
    UltrasoundMount,
)
from sim.payloads.simple import (
    MountedCamera,
    MountedLaser,
    MountedLights,
    MountedLine,
    MountedSonar,
    MountedTagReader,
    MountedUltrasound,
)
from sim.vehicles.model import Model, Vehicle

__all__ = ["PAYLOADS", "PayloadParameters", "laden", "load", "mount", "reach"]


class PayloadParameters(Table, frozen=True, kw_only=True):
    """The whole file."""

    laser: LaserMount
    sonar: SonarMount
    ultrasound: UltrasoundMount
    line_sensor: LineMount
    camera: CameraMount
    lights: LightsMount
    tag_reader: TagReaderMount
    arm: ArmParameters


PAYLOADS: tuple[str, ...] = PayloadParameters.__struct_fields__
"""The payloads there are, by name."""


def load(path: Path = Path(__file__).parent / "payloads.toml") -> PayloadParameters:
    """The figures in a file; ValueError names the file, the line, the key and the reason."""
    return read(text_of(path), PayloadParameters, path.name)


def laden(model: Model, names: Iterable[str], figures: PayloadParameters | None = None) -> Model:
    """`model` with the weight of these payloads; names that there are not are left to `mount`.

    ValueError with one sentence when that is more than it can carry.
    """
    carried = [name for name in names if name in PAYLOADS]
    if not carried:
        return model
    figures = figures or load()
    loads = [getattr(figures, name).load(model.parameters) for name in carried]
    return replace(model, parameters=model.parameters.laden(loads))


def mount(
    vehicle: Vehicle, names: Iterable[str], figures: PayloadParameters | None = None
) -> dict[str, Mounted]:
    """Put these payloads on `vehicle`, before it first measures; ValueError with one sentence when one cannot be.

    They weigh what its model was made `laden` with: a body in the physics does not change its mass.
    """
    figures = figures or load()
    mounted: dict[str, Mounted] = {}
    for name in names:
        if name not in PAYLOADS:
            raise ValueError(f"There is no payload {name!r}; there is {', '.join(PAYLOADS)}.")
        if name in mounted or name in vehicle.suite:
            article = "an" if name[0] in "aeiou" else "a"
            raise ValueError(
                f"{vehicle.parameters.info.name} has {article} {name.replace('_', ' ')} already."
            )
        mounted[name] = _make(name, vehicle, figures)
    vehicle.battery.others = lambda: sum(payload.power for payload in mounted.values())
    vehicle.attached.extend(payload.shapes for payload in mounted.values())
    return mounted


def reach(vehicle: Vehicle) -> float:
    """How far what is mounted reaches from `base_link`, whichever way, as it is folded now [m]; 0 for nothing."""
    shapes = [shape for attached in vehicle.attached for shape in attached()]
    return max((math.hypot(x, y) for shape in shapes for x, y, _ in shape.corners()), default=0.0)


def _make(name: str, vehicle: Vehicle, figures: PayloadParameters) -> Mounted:
    match name:
        case "laser":
            return MountedLaser(vehicle, figures.laser)
        case "sonar":
            return MountedSonar(vehicle, figures.sonar)
        case "ultrasound":
            return MountedUltrasound(vehicle, figures.ultrasound)
        case "line_sensor":
            return MountedLine(vehicle, figures.line_sensor)
        case "camera":
            return MountedCamera(vehicle, figures.camera)
        case "lights":
            return MountedLights(vehicle, figures.lights)
        case "tag_reader":
            return MountedTagReader(vehicle, figures.tag_reader)
        case _:
            return MountedArm(vehicle, figures.arm)
