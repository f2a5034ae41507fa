"""The lattice planner for robots that cannot turn in place: drivable bends, and backwards where that is shorter.

A search over poses (hybrid A*): from each pose a bend to the left, to the right or straight on, ahead or back; what is
left of the way by the map shows where to search first, and a last bend and a straight line that reach the goal end it.
"""

from __future__ import annotations

import heapq
import itertools
import math
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import completed
from robotside.mapping.occupancy_grid import Grid
from robotside.mapping.wavefront import Wavefront, work_steps
from robotside.navigation.path_controller import Piece

__all__ = ["MAX_POSES", "LatticePlanner"]

STRIDE = 0.9
"""From a pose of the search to the next [m]."""

SAMPLES = 3
"""Places on that way at which the body must fit."""

CELL_SIZE, DIRECTIONS = 0.6, 48
"""Poses in one cell of this edge [m] and one of so many directions are one."""

BACK_COST, CHANGE_COST, BEND_COST = 2.0, 6.0, 1.05
"""A way back is as dear as one so many times as long; so much longer for changing over [m]; and so many times for a bend."""

MAX_BACK_SHOT = 8.0
"""The last part of a way, to the goal itself, is driven backwards no farther than this [m]."""

TIGHT_COST = 3.0
"""So many times as dear is a way where it is narrow."""

MAX_POSES = 5_000
"""Poses that are looked at before there is no way."""

FIELD_CELL = 0.4
"""Cells of the map by which the rest of the way is reckoned [m]."""

SHOT_STEPS = 2
"""Steps more that it counts to try the last part of a way."""

MAX_WALL_DEPTH = 1.0
"""So far from the surface of a wall no way is reckoned [m]."""

FINE_SPACING, ROUGH_SPACING = 0.1, 1.2
"""Between two points of a way, and where it is only seen whether it may be one [m]."""


@dataclass(frozen=True, slots=True)
class _Node:
    pose: Pose2
    cost: float
    parent: _Node | None
    bend: float
    """Of the way here [1/m], positive to the left."""
    length: float
    """Of that way [m], negative backwards."""


class LatticePlanner:
    """Looks for ways on one map."""

    def __init__(self, grid: Grid, bend: float, discs: Sequence[float], radius: float, margin: float) -> None:
        """`bend` is the tightest [1/m]; the body is covered by discs of `radius` [m] so far ahead of `base_link` [m]."""
        self._grid, self._bend, self._discs = grid, bend, np.asarray(discs, dtype=np.float64)
        self._need, self._want = radius + margin, radius + 4 * margin
        self._distance = grid.distance
        self._moves = [(turn, way) for way in (STRIDE, -STRIDE) for turn in (0.0, bend, -bend)]
        still = Pose2(0.0, 0.0, 0.0)
        self._swept = self._covered(np.concatenate([_arc(still, *move, SAMPLES) for move in self._moves]))

    def way(self, start: Pose2, goal: tuple[float, float, float]) -> list[Piece]:
        """Pieces from `start` to `goal` (x, y [m], yaw [rad], NaN for any); none when there is no way."""
        return completed(self.search(start, goal))

    def search(self, start: Pose2, goal: tuple[float, float, float]) -> Generator[None, None, list[Piece]]:
        """The same, bit by bit: it yields at least once for each of at most `MAX_POSES` poses, and while it reckons before."""
        field = yield from self._field(goal)
        room = float(self._room(np.array([start])).min())
        first = _Node(start, 0.0, None, 0.0, 0.0)
        number = itertools.count()
        queue = [(field(start.x, start.y), next(number), first)]
        seen: set[tuple[int, int, int]] = set()
        while queue and len(seen) < MAX_POSES:
            node = heapq.heappop(queue)[2]
            key = _key(node.pose)
            if key in seen:
                continue
            yield
            seen.add(key)
            if self._tries(node, goal, len(seen)):
                yield from work_steps(SHOT_STEPS, 1)
                last = self._last(node, goal, min(self._need, room))
                if last is not None:
                    return _pieces(last)
            for child in self._children(node, start, room):
                if _key(child.pose) not in seen:
                    left = field(child.pose.x, child.pose.y)
                    if math.isfinite(left):
                        heapq.heappush(queue, (child.cost + 1.2 * left, next(number), child))
        return []

    def _field(
        self, goal: tuple[float, float, float]
    ) -> Generator[None, None, Callable[[float, float], float]]:
        """The way that is left to the goal for a disc [m], by place."""
        grid = self._grid
        factor = max(1, round(FIELD_CELL / grid.resolution))
        room = self._distance[::factor, ::factor]
        row, column = (index // factor for index in grid.cell(goal[0], goal[1]))
        row, column = min(max(row, 0), room.shape[0] - 1), min(max(column, 0), room.shape[1] - 1)
        wave = Wavefront(room.shape, (row, column))
        # what stands too close already has to come away, but not from deep in a wall
        inside = np.where(room > -MAX_WALL_DEPTH, 1e3, np.inf)
        wave.price[:] = np.where(room > self._need * 0.8, 1.0, np.where(room > 0, 8.0, inside))
        wave.price[row, column] = 1.0
        yield from work_steps(room.size)
        yield from wave.spread()
        left = wave.cost
        rows, columns = left.shape
        step = grid.resolution * factor

        def at(x: float, y: float) -> float:
            i, j = int((y - grid.y) / step), int((x - grid.x) / step)
            return left.item(i, j) * step if 0 <= i < rows and 0 <= j < columns else math.inf

        return at

    def _children(self, node: _Node, start: Pose2, room: float) -> list[_Node]:
        pose = node.pose
        c, s = math.cos(pose.yaw), math.sin(pose.yaw)
        dx, dy = self._swept
        rooms = self._room_at(pose.x + c * dx - s * dy, pose.y + s * dx + c * dy)
        free_of: list[float] = rooms.reshape(len(self._moves), -1).min(axis=1).tolist()
        # who stands too close at first may come away from there
        near = pose.distance(start.x, start.y) < 4.0
        need = min(self._need, room - 0.02) if near else self._need
        children = []
        for (bend, way), free in zip(self._moves, free_of, strict=True):
            if free < need:
                continue
            cost = STRIDE * (BEND_COST if bend else 1.0) * (1.0 if way > 0 else BACK_COST)
            cost *= 1.0 + TIGHT_COST * max(0.0, self._want - free) / self._want
            cost += CHANGE_COST if node.length * way < 0 else 0.0
            children.append(_Node(_after(pose, bend, way), node.cost + cost, node, bend, way))
        return children

    def _tries(self, node: _Node, goal: tuple[float, float, float], looked: int) -> bool:
        return node.pose.distance(goal[0], goal[1]) < 12.0 or looked % 8 == 1

    def _last(self, node: _Node, goal: tuple[float, float, float], need: float) -> _Node | None:
        """The goal's own pose, by at most two bends and a straight line between them; None when that cannot be."""
        ways: list[list[_Node]] = []
        for legs in _shots(node.pose, goal, self._bend):
            if sum(-way for _, way in legs if way < 0) > MAX_BACK_SHOT:
                continue
            ends = [node]
            for bend, way in legs:
                cost = abs(way) * (1.0 if way > 0 else BACK_COST) + (
                    CHANGE_COST if ends[-1].length * way < 0 else 0.0
                )
                end = _after(ends[-1].pose, bend, way)
                ends.append(_Node(end, ends[-1].cost + cost, ends[-1], bend, way))
            ways.append(ends)
        # a few places rule out most ways that do not fit
        for step in (ROUGH_SPACING, 2 * FINE_SPACING):
            rooms = self._rooms_along(ways, step)
            ways = [ends for ends, room in zip(ways, rooms, strict=True) if room >= need]
        return min((ends[-1] for ends in ways), key=lambda end: end.cost, default=None)

    def _rooms_along(self, ways: list[list[_Node]], step: float) -> list[float]:
        """The least room on each of `ways` [m], looked for after every `step` [m]."""
        least = np.full(len(ways), np.inf)
        tracks = [
            (*before.pose, after.bend, after.length, number)
            for number, ends in enumerate(ways)
            for before, after in itertools.pairwise(ends)
        ]
        if not tracks:
            return least.tolist()
        legs = np.array(tracks)
        steps = np.maximum(1, np.ceil(np.abs(legs[:, 4]) / step)).astype(np.intp)
        firsts = np.cumsum(steps) - steps
        x, y, yaw, bend, stride, way = np.repeat(legs, steps, axis=0).T
        along = stride * (np.arange(len(x)) - np.repeat(firsts, steps) + 1) / np.repeat(steps, steps)
        # the chord of an arc, straight on as well
        half = bend * along / 2
        chord = along * np.sinc(half / math.pi)
        poses = np.column_stack(
            [x + chord * np.cos(yaw + half), y + chord * np.sin(yaw + half), yaw + 2 * half]
        )
        np.minimum.at(least, way.astype(np.intp), self._room(poses).min(axis=1))
        return least.tolist()

    def _covered(self, poses: Points) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Where the middles of the discs are at these poses: x and y [m], each of shape (poses, discs)."""
        x = poses[:, 0, None] + np.cos(poses[:, 2, None]) * self._discs
        y = poses[:, 1, None] + np.sin(poses[:, 2, None]) * self._discs
        return x, y

    def _room(self, poses: Points) -> NDArray[np.float64]:
        """From the middles of the discs to the nearest obstacle [m], shape (poses, discs)."""
        return self._room_at(*self._covered(poses))

    def _room_at(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        """From these places to the nearest obstacle [m]; -1 off the map."""
        rows = np.floor((y - self._grid.y) / self._grid.resolution).astype(np.intp)
        columns = np.floor((x - self._grid.x) / self._grid.resolution).astype(np.intp)
        height, width = self._distance.shape
        inside = (rows >= 0) & (rows < height) & (columns >= 0) & (columns < width)
        found = self._distance[rows * inside, columns * inside]
        return np.where(inside, found, -1.0)


def _key(pose: Pose2) -> tuple[int, int, int]:
    return (
        round(pose.x / CELL_SIZE),
        round(pose.y / CELL_SIZE),
        round(pose.yaw / math.tau * DIRECTIONS) % DIRECTIONS,
    )


def _after(pose: Pose2, bend: float, way: float) -> Pose2:
    """Where a `way` [m] in a `bend` [1/m] ends."""
    half = bend * way / 2
    chord = way if abs(half) < 1e-9 else way * math.sin(half) / half
    towards = pose.yaw + half
    return Pose2(pose.x + chord * math.cos(towards), pose.y + chord * math.sin(towards), pose.yaw + 2 * half)


def _arc(pose: Pose2, bend: float, way: float, count: int) -> Points:
    """So many poses evenly on a `way` [m] in a `bend` [1/m], the start left out, shape (count, 3)."""
    along = np.linspace(way / count, way, count)
    yaw = pose.yaw + bend * along
    if abs(bend) < 1e-9:
        x, y = pose.x + along * math.cos(pose.yaw), pose.y + along * math.sin(pose.yaw)
    else:
        x = pose.x + (np.sin(yaw) - math.sin(pose.yaw)) / bend
        y = pose.y - (np.cos(yaw) - math.cos(pose.yaw)) / bend
    return np.column_stack([x, y, yaw])


def _shots(pose: Pose2, goal: tuple[float, float, float], bend: float) -> list[list[tuple[float, float]]]:
    """Ways of a bend, a straight line and a bend, as (bend [1/m], length [m], negative backwards), ahead and back.

    Without a last bend where any yaw will do.
    """
    turned = Pose2(pose.x, pose.y, pose.yaw + math.pi)
    back = _ahead(turned, (goal[0], goal[1], goal[2] + math.pi), bend)
    return _ahead(pose, goal, bend) + [[(-k, -way) for k, way in legs] for legs in back]


def _ahead(pose: Pose2, goal: tuple[float, float, float], bend: float) -> list[list[tuple[float, float]]]:
    """Those that are driven forwards."""
    radius, found = 1.0 / bend, []
    for first in (1.0, -1.0):
        cx = pose.x - first * radius * math.sin(pose.yaw)
        cy = pose.y + first * radius * math.cos(pose.yaw)
        if math.isnan(goal[2]):
            dx, dy = goal[0] - cx, goal[1] - cy
            far = math.hypot(dx, dy)
            if far < radius:
                continue
            yaw = math.atan2(dy, dx) + first * math.asin(radius / far)
            straight = math.sqrt(far * far - radius * radius)
            turn = (first * (yaw - pose.yaw)) % math.tau
            found.append([(first * bend, turn * radius), (0.0, straight)])
            continue
        for second in (1.0, -1.0):
            ex = goal[0] - second * radius * math.sin(goal[2])
            ey = goal[1] + second * radius * math.cos(goal[2])
            far, towards = math.hypot(ex - cx, ey - cy), math.atan2(ey - cy, ex - cx)
            if first == second:
                yaw, straight = towards, far
            elif far < 2 * radius:
                continue
            else:
                yaw = towards + first * math.asin(2 * radius / far)
                straight = math.sqrt(far * far - 4 * radius * radius)
            turn = (first * (yaw - pose.yaw)) % math.tau
            back = (second * (goal[2] - yaw)) % math.tau
            found.append([(first * bend, turn * radius), (0.0, straight), (second * bend, back * radius)])
    return [[(k, way) for k, way in legs if way > 1e-3 and (k == 0 or way * bend < 6.2)] for legs in found]


def _pieces(node: _Node) -> list[Piece]:
    """The way to `node`, cut where it changes over."""
    chain: list[_Node] = []
    at: _Node | None = node
    while at is not None:
        chain.append(at)
        at = at.parent
    chain.reverse()
    pieces: list[Piece] = []
    points = [np.array([[chain[0].pose.x, chain[0].pose.y]])]
    ahead: bool | None = None
    for before, after in itertools.pairwise(chain):
        if ahead is not None and (after.length > 0) != ahead:
            pieces.append(Piece(np.concatenate(points), ahead))
            points = [points[-1][-1:]]
        ahead = after.length > 0
        count = max(1, round(abs(after.length) / FINE_SPACING))
        points.append(_arc(before.pose, after.bend, after.length, count)[:, :2])
    if ahead is not None:
        pieces.append(Piece(np.concatenate(points), ahead))
    return pieces
