from __future__ import annotations

import subprocess
import sys

import pytest

pytestmark = pytest.mark.slow

PROGRAM = """
import hashlib, sys
import msgspec
from bridge.msgs.geometry_msgs import Twist
from sim.robot import make

seed, camera = int(sys.argv[1]), sys.argv[2] == "camera"
robot = make("patrol", "parking_lot", seed=seed, camera=camera)
robot.want("/camera/image/compressed", camera)
robot.want("/sim/ground_truth", True)
digest = hashlib.sha256()
for i in range(120):
    robot.drive(Twist.planar(0.5, 0.6 if i % 40 < 20 else -0.6))
    for topic, message in robot.read(100.0 + i * 0.05):
        if not topic.startswith("/camera"):
            digest.update(topic.encode() + repr(message).encode())
robot.close()
print(digest.hexdigest())
"""


EVERY = """
import hashlib, sys
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.robot import ROBOTS, make

for seed, (name, model) in [(int(seed), each) for seed in sys.argv[1].split(",") for each in ROBOTS.items()]:
    robot = make(name, "parking_lot" if model.element == "land" else "lake", seed=seed, camera=False)
    robot.want("/sim/ground_truth", True)
    digest = hashlib.sha256()
    if "take_off" in robot.info.manoeuvres:
        robot.manoeuvre(Manoeuvre(kind="take_off"))
    for i in range(24):
        if i == 12:
            robot.drive(Twist(Vector3(0.5, 0.0, -0.1), Vector3(0.0, 0.0, 0.4)))
        for topic, message in robot.read(100.0 + i * 0.1):
            digest.update(topic.encode() + repr(message).encode())
    robot.close()
    print(name, digest.hexdigest())
"""


def run(seed, camera="none", hash_seed="0", program=PROGRAM):
    command = [sys.executable, "-c", program, str(seed), camera]
    environment = {"PATH": "/usr/bin:/bin", "PYTHONPATH": ":".join(sys.path), "PYTHONHASHSEED": hash_seed}
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True, env=environment)
    return done.stdout


def test_the_same_seed_gives_the_same_run_bit_for_bit_with_and_without_camera():
    plain = run(5, hash_seed="1")
    assert len(plain) == 65
    assert run(5, "camera", hash_seed="2") == plain


def test_every_kind_of_robot_goes_the_same_way_in_two_processes_and_another_with_another_seed():
    first = run(3, hash_seed="1", program=EVERY).splitlines()
    assert len(first) == 6
    both = run("4,3", hash_seed="2", program=EVERY).splitlines()
    assert both[6:] == first, "whatever was simulated in that process before"
    assert all(a != b for a, b in zip(first, both[:6], strict=True))
