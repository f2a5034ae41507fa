"""What rays meet and what bodies touch in one world of the engine; measured once while nothing moves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from sim.core.shapes import Quat, Vec3, rotate, rotate_back
from sim.physics.bodies import Contact
from sim.physics.echoes import MOVING
from sim.physics.fans import Echoes, Fan, FixedSolids
from sim.physics.quiet_pybullet import p

__all__ = ["Measures"]

_MAX_KEPT = 32
"""Sweeps that are kept."""
_ALL_GROUPS = -1
_FIXED_GROUP = 2
"""Collision group that the engine puts everything into that nothing moves."""

Reach = NDArray[np.float64]
_Hit = tuple[int, int, float, Vec3, Vec3]
"""Body and its part, how far along the ray, where, and the surface's normal there."""


class Measures:
    """Of one world; who moves something calls `forget`."""

    def __init__(self, client: int, groups: Mapping[int, int], radii: Mapping[int, float]) -> None:
        """Of the world `client`; `groups` are the collision groups of its vehicles, which their own rays look through.

        `radii` are those of spheres round all that can move, about its centre of mass [m].
        """
        self._client, self._groups, self._radii = client, groups, radii
        self.fixed = FixedSolids()
        """What nothing moves, as fans meet it."""
        self._fanned: dict[tuple[int, int], tuple[Fan, Echoes]] = {}
        """By body and the very fan; the fan too, so that its id stays its own."""
        self._swept: dict[tuple[int, int, int], tuple[Sequence[Vec3], Sequence[Vec3], Reach]] = {}
        """By body and the very lists of a sweep's ends; the lists too, so that their ids stay theirs."""
        self._touched: dict[int, list[Contact]] = {}

    def forget(self) -> None:
        """Something moved."""
        if self._swept or self._touched or self._fanned:
            self._swept.clear()
            self._fanned.clear()
            self._touched.clear()

    def rays(self, body: int, start: Sequence[Vec3], end: Sequence[Vec3]) -> Reach:
        """As `Bullet.rays` has it; the array is not to be changed."""
        key = body, id(start), id(end)
        if key not in self._swept:
            if len(self._swept) >= _MAX_KEPT:
                self._swept.clear()
            self._swept[key] = start, end, self._sweep(body, start, end)
        return self._swept[key][2]

    def touching(self, body: int) -> list[Contact]:
        """As `Bullet.touching` has it; the list is not to be changed."""
        if body not in self._touched:
            points = p.getContactPoints(bodyA=body, linkIndexA=-1, physicsClientId=self._client)
            self._touched[body] = [Contact(point[2], point[6]) for point in points or () if point[8] <= 0.0]
        return self._touched[body]

    def sweep(self, body: int, fan: Fan) -> Echoes:
        """As `Bullet.echoes` has it; the arrays are not to be changed."""
        key = body, id(fan)
        if key not in self._fanned:
            if len(self._fanned) >= _MAX_KEPT:
                self._fanned.clear()
            position, rotation = p.getBasePositionAndOrientation(body, physicsClientId=self._client)
            echoes = self.fixed.sweep(fan, position, rotation)
            self._meet_movers(body, fan, position, rotation, echoes)
            for array in echoes:
                array.setflags(write=False)
            self._fanned[key] = fan, echoes
        return self._fanned[key][1]

    def _meet_movers(self, body: int, fan: Fan, position: Vec3, rotation: Quat, echoes: Echoes) -> None:
        """Shorten the beams that may meet something that moves, as the engine says."""
        beams: set[int] = set()
        for other, radius in self._radii.items():
            if other != body:
                there, _ = p.getBasePositionAndOrientation(other, physicsClientId=self._client)
                apart = rotate_back(
                    rotation, (there[0] - position[0], there[1] - position[1], there[2] - position[2])
                )
                beams.update(fan.towards(apart, radius))
        if beams:
            few = sorted(beams)
            start, ends = [fan.start] * len(few), [fan.end(number) for number in few]
            hits = self._ask(body, start, ends, _ALL_GROUPS ^ _FIXED_GROUP)
            for number, hit in zip(few, hits, strict=True):
                if hit[2] < echoes.reach[number]:
                    echoes.reach[number] = hit[2]
                    way = rotate(rotation, (fan.cosines[number], fan.sines[number], 0.0))
                    straight = sum(part * normal for part, normal in zip(way, hit[4], strict=True))
                    echoes.facing[number], echoes.reflection[number] = min(abs(straight), 1.0), MOVING

    def _sweep(self, body: int, start: Sequence[Vec3], end: Sequence[Vec3]) -> Reach:
        hits = self._ask(body, start, end, _ALL_GROUPS)
        reach = np.fromiter((hit[2] for hit in hits), dtype=np.float64, count=len(hits))
        reach.setflags(write=False)
        return reach

    def _ask(self, body: int, start: Sequence[Vec3], end: Sequence[Vec3], groups: int) -> Sequence[_Hit]:
        """The engine's own answers for these rays."""
        hits: Sequence[_Hit] = p.rayTestBatch(
            start,
            end,
            numThreads=1,
            parentObjectUniqueId=body,
            parentLinkIndex=-1,
            collisionFilterMask=groups & ~self._groups.get(body, 0),
            physicsClientId=self._client,
        )
        return hits
