from __future__ import annotations

import subprocess
import sys

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


def run(seed, camera="none", hash_seed="0"):
    command = [sys.executable, "-c", PROGRAM, str(seed), camera]
    environment = {"PATH": "/usr/bin:/bin", "PYTHONPATH": ":".join(sys.path), "PYTHONHASHSEED": hash_seed}
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True, env=environment)
    return done.stdout


def test_the_same_seed_gives_the_same_run_bit_for_bit_with_and_without_camera():
    plain = run(5, hash_seed="1")
    assert len(plain) == 65
    assert run(5, "camera", hash_seed="2") == plain
    assert run(6) != plain
