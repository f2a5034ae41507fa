"""Sends a robot to the orange tree, drives up to each orange that the detector reports, and touches it with the arm.

python -m robotside serve --robot sim:patrol --world orchard --payloads arm
python -m examples.smart_farm.detector
python -m examples.smart_farm --at=-12.5,0,0
"""

from __future__ import annotations

import argparse

from bridge.client import RemoteRobot
from bridge.core.errors import BridgeError
from examples.poses import pose
from examples.smart_farm.operator import Farmer, NotDone


def main() -> int:
    """One tree."""
    parser = argparse.ArgumentParser(
        prog="python -m examples.smart_farm",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--robot", default="ws://127.0.0.1:9090", metavar="URL", help="the robot's socket")
    parser.add_argument("--place", default="orange tree", metavar="NAME", help="where the tree is")
    parser.add_argument(
        "--at", type=pose, metavar="X,Y,YAW", help="where the robot stands, if it does not know"
    )
    chosen = parser.parse_args()
    with RemoteRobot(chosen.robot) as robot:
        try:
            robot.wait()
            farmer = Farmer(robot)
            if chosen.at is not None:
                farmer.place(*chosen.at)
            farmer.go_to(chosen.place)
            found = farmer.look()
            touched = sum(map(farmer.touch, found))
        except (BridgeError, NotDone) as problem:
            print(problem)
            return 1
    print(f"Touched {touched} of {len(found)} oranges.")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
