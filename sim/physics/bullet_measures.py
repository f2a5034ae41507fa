"""What rays meet and what bodies touch in one world of the engine; measured once while nothing moves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from sim.core.shapes import Vec3
from sim.physics.bodies import Contact
from sim.physics.quiet_pybullet import p

__all__ = ["Measures"]

_MAX_KEPT = 32
"""Sweeps that are kept."""
_ALL_GROUPS = -1

Reach = NDArray[np.float64]


class Measures:
    """Of one world; who moves something calls `forget`."""

    def __init__(self, client: int, groups: Mapping[int, int]) -> None:
        """Of the world `client`; `groups` are the collision groups of its vehicles, which their own rays look through."""
        self._client, self._groups = client, groups
        self._swept: dict[tuple[int, int, int], tuple[Sequence[Vec3], Sequence[Vec3], Reach]] = {}
        """By body and the very lists of a sweep's ends; the lists too, so that their ids stay theirs."""
        self._touched: dict[int, list[Contact]] = {}

    def forget(self) -> None:
        """Something moved."""
        if self._swept or self._touched:
            self._swept.clear()
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

    def _sweep(self, body: int, start: Sequence[Vec3], end: Sequence[Vec3]) -> Reach:
        hits = p.rayTestBatch(
            start,
            end,
            numThreads=1,
            parentObjectUniqueId=body,
            parentLinkIndex=-1,
            collisionFilterMask=_ALL_GROUPS ^ self._groups.get(body, 0),
            physicsClientId=self._client,
        )
        reach = np.fromiter((hit[2] for hit in hits), dtype=np.float64, count=len(hits))
        reach.setflags(write=False)
        return reach
