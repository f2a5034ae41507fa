"""The dock over many sweeps of a robot that goes towards it."""

from __future__ import annotations

import numpy as np

from bridge.core.units import wrap
from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import Pose2
from robotside.perception.dock_finder import DockFinder, DockSighting
from robotside.perception.dock_track import MAX_MISSED, MIN_SIGHTINGS, DockTrack
from tests.robotside.perception.dock_scans import Line, dock, leg, sweep

AT = Pose2(2.0, 0.1, 0.05)
MAP_ERROR = Pose2(0.25, 0.17, 0.17)
"""0.3 m and 10 degrees."""
WHEELS = Pose2(7.0, -3.0, 1.0)
"""Where the odometry began, as the world has it: its frame is another one."""


def on(robot: Pose2) -> Pose2:
    return WHEELS.inverse().then(robot)


def way(count: int, end: float = 1.6) -> list[Pose2]:
    return [Pose2(x, 0.0, 0.0) for x in np.linspace(0.0, end, count)]


def follow(track: DockTrack, lines: list[Line], robots: list[Pose2], seed: int = 2) -> list[float]:
    """Errors of the place with each sweep, as far as it is known [m]."""
    rng, errors = np.random.default_rng(seed), []
    for robot in robots:
        guess = AT.since(robot.then(MAP_ERROR))
        track.look(sweep(lines, robot, rng), on(robot), guess)
        known = track.pose(on(robot))
        if known is not None:
            truth = AT.since(robot)
            errors.append(known.distance(truth.x, truth.y))
    return errors


def test_it_comes_to_the_truth_though_the_map_is_wrong_and_knows_how_well() -> None:
    track = DockTrack(DockFinder())
    errors = follow(track, dock(AT), way(60))
    assert len(errors) == 60 - MIN_SIGHTINGS + 1
    assert max(errors[-20:]) < 0.02
    assert 0.003 < track.spread < 0.012
    end = track.pose(on(way(60)[-1]))
    assert end is not None
    assert abs(wrap(end.yaw - AT.yaw)) < 0.03


def test_one_look_is_not_enough() -> None:
    track = DockTrack(DockFinder())
    assert follow(track, dock(AT), way(MIN_SIGHTINGS - 1)) == []
    assert not track.known


def test_who_walks_through_does_not_shift_it() -> None:
    track = DockTrack(DockFinder())
    follow(track, dock(AT), way(20, 0.5))
    still = [Pose2(0.5, 0.0, 0.0)]
    for y in np.linspace(-0.4, 0.4, 17):
        assert max(follow(track, [*dock(AT), *leg(1.4, y)], still)) < 0.05, y


def test_between_two_sweeps_it_goes_by_the_wheels() -> None:
    track = DockTrack(DockFinder())
    follow(track, dock(AT), way(20, 0.5))
    ahead = Pose2(0.9, 0.05, 0.1)
    seen, truth = track.pose(on(ahead)), AT.since(ahead)
    assert seen is not None
    assert seen.distance(truth.x, truth.y) < 0.03


def test_what_is_not_seen_for_long_is_lost() -> None:
    track = DockTrack(DockFinder())
    follow(track, dock(AT), way(20, 0.5))
    here = [Pose2(0.5, 0.0, 0.0)]
    follow(track, [], here * (MAX_MISSED - 1))
    assert track.known
    follow(track, [], here)
    assert not track.known
    assert track.seen == 0


class Turned:
    """A finder that sees the dock where it is, its direction off by what it is told."""

    off = 0.2

    def find(self, scan: object, expected: object) -> DockSighting:
        return DockSighting(Pose2(2.0, 0.0, self.off), 0.01, 0.2, "reflectors")


def test_what_many_looks_from_afar_had_wrong_a_few_from_near_put_right() -> None:
    finder = Turned()
    track = DockTrack(finder)  # type: ignore[arg-type]  # what it calls of one
    for _ in range(300):
        track.look(LaserScan(), Pose2(0.0, 0.0, 0.0), Pose2(2.0, 0.0, 0.0))
    finder.off = 0.0
    for _ in range(60):
        track.look(LaserScan(), Pose2(0.0, 0.0, 0.0), Pose2(2.0, 0.0, 0.0))
    dock = track.pose(Pose2(0.0, 0.0, 0.0))
    assert dock is not None
    assert abs(dock.yaw) < 0.03
