"""The cameras of one robot, each under its topic."""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet

from bridge.msgs import Msg
from sim.rendering.camera import Camera
from sim.simulation.simulation import Simulation

__all__ = ["CAMERA_TOPIC", "Cameras"]

CAMERA_TOPIC = "/camera/image/compressed"
"""Of a robot's main camera."""


class Cameras:
    """Each is made when its pictures are first wanted, and kept."""

    def __init__(self, simulation: Simulation, number: int) -> None:
        """Of the vehicle of this number."""
        self._simulation, self._number = simulation, number
        every = simulation.vehicles[number].cameras
        names = [CAMERA_TOPIC, *(f"/camera/{camera.name}/image/compressed" for camera in every[1:])]
        self._parameters = dict(zip(names, every, strict=False))
        self._made: dict[str, Camera] = {}
        if every:
            # now, because the first picture would otherwise hold up a robot that is being driven
            simulation.renderer.prepare()

    def are_idle(self, wanted: AbstractSet[str]) -> bool:
        """`shoot` would have nothing to do, nor to count."""
        return not self._made and wanted.isdisjoint(self._parameters)

    def shoot(self, wanted: AbstractSet[str], stamp: float) -> Iterator[tuple[str, Msg]]:
        """Pictures that are due after this step of those that are `wanted`, taken at `stamp` [s]."""
        simulation = self._simulation
        for topic, parameters in self._parameters.items():
            if topic in wanted and topic not in self._made:
                self._made[topic] = Camera(
                    simulation.renderer.for_camera(), parameters, first=simulation.steps
                )
        for topic, camera in self._made.items():
            if camera.is_due(simulation.steps) and topic in wanted:
                others = simulation.looks(but=self._number)
                state = simulation.vehicles[self._number].state()
                for image in camera.shoot(state, stamp, others):
                    yield topic, image

    def collect(self) -> Iterator[tuple[str, Msg]]:
        """Pictures taken earlier that have become ready."""
        for topic, camera in self._made.items():
            for image in camera.collect():
                yield topic, image

    def close(self) -> None:
        """Free everything; closing twice does nothing."""
        for camera in self._made.values():
            camera.close()
