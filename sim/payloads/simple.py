"""The payloads that measure or shine: laser, sonars, camera, lights, tag reader."""

from __future__ import annotations

import math
from collections.abc import Iterator

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import LightState, TagRead
from bridge.msgs.std_msgs import Header, Time
from sim.core.parameters import CameraParameters
from sim.core.shapes import Quat, Shape, Vec3, place
from sim.payloads.mounted import (
    CameraMount,
    LaserMount,
    LightsMount,
    LineMount,
    SonarMount,
    TagReaderMount,
    UltrasoundMount,
)
from sim.physics.backend_bullet import State
from sim.sensors.laser import Laser, LaserParameters
from sim.sensors.line import LineCells, LineParameters
from sim.sensors.sonar import Sonar, SonarParameters
from sim.sensors.suite import AFTER_WHEELS, Measurement
from sim.sensors.ultrasound import SIDES, UltrasoundParameters, Ultrasounds
from sim.vehicles.model import Vehicle
from sim.world.paint import Paint

__all__ = [
    "MountedCamera",
    "MountedLaser",
    "MountedLights",
    "MountedLine",
    "MountedSonar",
    "MountedTagReader",
    "MountedUltrasound",
]

_BLACK, _GLASS, _LIT, _DARK = (0.08, 0.08, 0.09), (0.10, 0.14, 0.19), (1.0, 0.97, 0.85), (0.55, 0.55, 0.50)
_AHEAD: Quat = (0.0, 0.7071067811865476, 0.0, 0.7071067811865476)
LIGHTS_RATE = 1.0


def on_deck(vehicle: Vehicle, at: Vec3) -> Vec3:
    """A place on the deck of `vehicle`, in its `base_link` [m]."""
    x, y, z = vehicle.parameters.deck
    return (x + at[0], y + at[1], z + at[2])


class _Plain:
    """A payload that takes no orders and always the same power."""

    accepts: type[Msg] | None = None

    def __init__(self, power: float, shapes: tuple[Shape, ...]) -> None:
        self.power = power
        self._shapes = shapes

    def command(self, order: Msg) -> None:
        """Refused."""
        raise ValueError("This payload takes no orders.")

    def hold(self) -> None:
        """It does not move."""

    def shapes(self) -> tuple[Shape, ...]:
        """Its visible shapes, in `base_link`."""
        return self._shapes


class MountedLaser(_Plain):
    """A laser under `/scan`."""

    def __init__(self, vehicle: Vehicle, figures: LaserMount) -> None:
        """On the deck of `vehicle`."""
        at = on_deck(vehicle, figures.at)
        super().__init__(
            figures.power, (Shape("cylinder", (0.075, 0.075, 0.05), at, colour=_BLACK, gloss=0.5),)
        )
        parameters = LaserParameters(
            rate=figures.rate,
            beams=figures.beams,
            height=at[2],
            range_min=figures.range_min,
            range_max=figures.range_max,
            noise=figures.noise,
            ahead=at[0],
        )
        scene, vehicle.laser_x = vehicle.scene, at[0]
        laser = Laser(parameters, scene.backend, vehicle.body, scene.generator("payload laser"))
        vehicle.suite.add(
            "laser", figures.rate, lambda _, stamp: [("/scan", laser.measure(stamp))], after=AFTER_WHEELS
        )


class MountedSonar(_Plain):
    """A ring of sonars under `/sonar`."""

    def __init__(self, vehicle: Vehicle, figures: SonarMount) -> None:
        """Round the deck of `vehicle`, as wide as it is."""
        at, radius = on_deck(vehicle, figures.at), vehicle.parameters.radius
        ring = Shape("cylinder", (2 * radius, 2 * radius, 0.05), (0.0, 0.0, at[2]), colour=_BLACK)
        super().__init__(figures.power, (ring,))
        parameters = SonarParameters(
            rate=figures.rate,
            count=figures.count,
            beams=figures.beams,
            height=at[2],
            radius=radius,
            range_min=figures.range_min,
            range_max=figures.range_max,
            field_of_view=figures.field_of_view,
            noise=figures.noise,
            step=figures.step,
        )
        scene = vehicle.scene
        sonar = Sonar(parameters, scene.backend, vehicle.body, scene.generator("payload sonar"))
        vehicle.suite.add("sonar", figures.rate, lambda _, stamp: [("/sonar", sonar.measure(stamp))])


class MountedUltrasound(_Plain):
    """Four rangers under `/range/SIDE`."""

    def __init__(self, vehicle: Vehicle, figures: UltrasoundMount) -> None:
        """At the edge of the deck of `vehicle`."""
        at, radius = on_deck(vehicle, figures.at), vehicle.parameters.radius
        eyes = ((radius * math.cos(yaw), radius * math.sin(yaw)) for yaw in SIDES.values())
        super().__init__(
            figures.power,
            tuple(Shape("box", (0.03, 0.03, 0.03), (x, y, at[2]), colour=_BLACK) for x, y in eyes),
        )
        parameters = UltrasoundParameters(
            rate=figures.rate,
            rays=figures.rays,
            offset=radius,
            height=at[2],
            field_of_view=figures.field_of_view,
            range_min=figures.range_min,
            range_max=figures.range_max,
            noise=figures.noise,
        )
        scene = vehicle.scene
        rangers = Ultrasounds(parameters, scene.backend, vehicle.body, scene.generator("payload ultrasound"))
        vehicle.suite.add(
            "ultrasound",
            figures.rate,
            lambda _, stamp: ((f"/range/{side}", echo) for side, echo in rangers.measure(stamp)),
        )


class MountedLine(_Plain):
    """Cells that look at the ground, under `/line_sensor`."""

    def __init__(self, vehicle: Vehicle, figures: LineMount) -> None:
        """Under the bow of `vehicle`; ValueError for one that does not drive on the ground."""
        info = vehicle.parameters.info
        if not info.on_the_ground:
            raise ValueError(f"{info.name} does not drive on the ground, which a line sensor looks at.")
        super().__init__(figures.power, ())
        parameters = LineParameters(
            rate=figures.rate,
            cells=figures.cells,
            spacing=figures.spacing,
            ahead=vehicle.parameters.radius,
            spot=figures.spot,
            dark=figures.dark,
            bright=figures.bright,
            mismatch=figures.mismatch,
            noise=figures.noise,
        )
        scene = vehicle.scene
        cells = LineCells(parameters, Paint(scene.world), scene.generator("payload line"))
        vehicle.suite.add(
            "line_sensor", figures.rate, lambda state, stamp: [("/line_sensor", cells.measure(state, stamp))]
        )


class MountedCamera(_Plain):
    """A camera more, under `/camera/NAME/image/compressed`."""

    def __init__(self, vehicle: Vehicle, figures: CameraMount) -> None:
        """On the deck of `vehicle`; ValueError when it has one of that name."""
        at = on_deck(vehicle, figures.at)
        super().__init__(figures.power, (Shape("box", (0.04, 0.05, 0.04), at, colour=_BLACK, gloss=0.6),))
        if any(camera.name == figures.name for camera in vehicle.cameras):
            name = vehicle.parameters.info.name
            raise ValueError(f"{name} has a camera {figures.name!r} already.")
        vehicle.cameras.append(
            CameraParameters(
                name=figures.name,
                rate=figures.rate,
                width=figures.width,
                height=figures.height,
                field_of_view=figures.field_of_view,
                position=at,
                yaw=figures.yaw,
                pitch=figures.pitch,
            )
        )


class MountedLights:
    """Two lamps, which publish their brightness under `/lights`."""

    accepts: type[Msg] | None = LightState

    def __init__(self, vehicle: Vehicle, figures: LightsMount) -> None:
        """On the deck of `vehicle`, off."""
        self._full = figures.power
        self._at = on_deck(vehicle, figures.at)
        self._brightness = 0.0
        vehicle.suite.add("lights", LIGHTS_RATE, self._measure)

    @property
    def power(self) -> float:
        """Power that they take now [W]."""
        return self._full * self._brightness

    def command(self, order: Msg) -> None:
        """Set the brightness of a LightState, 0 to 1; ValueError for anything else."""
        if not isinstance(order, LightState) or not 0.0 <= order.brightness <= 1.0:
            raise ValueError("The brightness of the lights must be a number from 0 to 1.")
        self._brightness = order.brightness

    def hold(self) -> None:
        """It does not move."""

    def shapes(self) -> tuple[Shape, ...]:
        """Their visible shapes, in `base_link`."""
        x, y, z = self._at
        colour = _LIT if self._brightness else _DARK
        return tuple(
            Shape("cylinder", (0.05, 0.05, 0.03), (x, y + side, z), _AHEAD, colour, glow=self._brightness)
            for side in (-0.06, 0.06)
        )

    def _measure(self, _: State, stamp: float) -> Iterator[Measurement]:
        yield "/lights", LightState(Header(Time.at(stamp), "base_link"), self._brightness)


class MountedTagReader(_Plain):
    """Reader of the nearest tag of the world in reach, which it publishes under `/tag` when it changes."""

    def __init__(self, vehicle: Vehicle, figures: TagReaderMount) -> None:
        """On the deck of `vehicle`."""
        self._at = on_deck(vehicle, figures.at)
        super().__init__(figures.power, (Shape("box", (0.05, 0.08, 0.02), self._at, colour=_GLASS),))
        self._tags = vehicle.scene.world.tags
        self._reach = figures.reach
        self._last: str | None = None
        vehicle.suite.add("tag_reader", figures.rate, self._read)

    def _read(self, state: State, stamp: float) -> Iterator[Measurement]:
        reader = place(self._at, state.position, state.rotation)
        away = {tag.tag: math.dist(reader, (tag.x, tag.y, tag.z)) for tag in self._tags}
        nearest = min(away, key=lambda tag: away[tag], default="")
        found = nearest if nearest and away[nearest] <= self._reach else ""
        if found != self._last:
            self._last = found
            yield "/tag", TagRead(Header(Time.at(stamp), "base_link"), found)
