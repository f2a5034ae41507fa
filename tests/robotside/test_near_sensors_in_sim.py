"""The small sensors on their whole way from the simulated ground to whoever subscribes, in virtual time."""

from __future__ import annotations

from pathlib import Path

import pytest

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import LineSensor
from bridge.msgs.sensor_msgs import JointState, Range
from sim.robot import SimRobot
from sim.simulation.simulation import Simulation
from sim.vehicles.patrol import PATROL
from sim.world.world_files import parse
from tests.robotside.sim_run import Run
from tests.sim.rooms import ROOM

pytestmark = pytest.mark.slow

ACROSS = "[[lines]]\nfrom = [1.0, -3.0]\nto = [1.0, 3.0]\nwidth = 0.12\n"
"""A painted line 1 m ahead."""


def test_who_drives_over_a_line_towards_a_wall_sees_it_pass_and_the_wall_come_near(tmp_path: Path) -> None:
    world = parse(ROOM.format(length=8.0, width=6.0, x=0.0, y=0.0, yaw=0.0) + ACROSS, "room.toml")
    run = Run(SimRobot(Simulation(world, PATROL, noise=False), camera=False), tmp_path)
    heard: dict[str, list[Msg]] = {"/line_sensor": [], "/range/front": [], "/joint_states": []}
    for topic in heard:
        run.station.bus.subscribe(topic, lambda name, message: heard[name].append(message))
    for _ in range(80):
        run.station.on_message(run.anna, "/cmd_vel", Twist.planar(0.6, 0.0), run.now)
        run.wait(0.05)
    run.station.close()
    bright = [message.values[3] > 0.5 for message in heard["/line_sensor"] if isinstance(message, LineSensor)]
    away = [message.range for message in heard["/range/front"] if isinstance(message, Range)]
    wheels = [message.velocity[0] for message in heard["/joint_states"] if isinstance(message, JointState)]
    assert (bright[0], any(bright), bright[-1]) == (False, True, False)
    assert away[0] > 3.7
    assert away[-1] < away[0] - 1.5
    assert max(wheels) > 10.0
