"""Has a robot deliver something from one named place to another, ordered by any protocol, and tells how it goes.

python -m robotside serve --robot sim:scout --world office
python -m examples.courier coffee --start reception --goal room_3 --by ws://127.0.0.1:9090 --confirm --at=-11.6,-1.2,0

The robot asks at both ends whether it was picked up and taken: who stands there confirms it on a handheld, or --confirm does.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Callable

from examples.poses import pose
from examples.protocols.ways import FAULTS, PROTOCOLS, Answer, Way, sentence, way_to

__all__ = ["NotDelivered", "deliver", "place"]

LOOK_PERIOD = 0.5
"""How often is looked how the delivery goes [s]."""
DELIVERY_TIMEOUT = 3600.0
"""Who watches a delivery gives up after this time; the robot goes on [s]."""
FAILED = ("CANCELED", "FAILED", "INTERRUPTED")


class NotDelivered(Exception):
    """Why not, as one sentence."""


def deliver(
    way: Way,
    what: str,
    places: tuple[str, str],
    *,
    say: Callable[[str], object] = print,
    confirm: bool = False,
) -> Answer:
    """Order the delivery of `what` between two named `places` and see it through; the run as the robot keeps it.

    With `confirm` what the robot asks is answered from here. NotDelivered with the robot's reason.
    """
    order = {"task": "deliver", "places": [*places], "message": what}
    begun = way.call("/task/start", {"order": order})
    if not begun["success"]:
        raise NotDelivered(begun["message"])
    say(begun["message"])
    number, visited = _runs(way)[0]["id"], 0
    end = time.monotonic() + DELIVERY_TIMEOUT
    while time.monotonic() < end:
        run = next(each for each in _runs(way) if each["id"] == number)
        if run["visited"] > visited:
            visited = run["visited"]
            say(f"It has been at {places[visited - 1]}.")
        if run["state"] == "SUCCEEDED":
            return run
        if run["state"] in FAILED:
            raise NotDelivered(run["reason"])
        if confirm:
            way.call("/task/confirm", {})  # refused while the robot asks nothing
        time.sleep(LOOK_PERIOD)
    raise NotDelivered(f"The delivery took more than {DELIVERY_TIMEOUT:g} s.")


def _runs(way: Way) -> list[Answer]:
    """The newest tasks of the robot, newest first."""
    runs: list[Answer] = way.call("/history/get", {"limit": 5})["runs"]
    return runs


def place(way: Way, x: float, y: float, yaw: float) -> None:
    """Tell the robot where it stands on its map [m, rad], which it does not know after its first start."""
    turned = {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    here = {"position": {"x": x, "y": y}, "orientation": turned}
    way.publish("/initialpose", {"header": {"frame_id": "map"}, "pose": {"pose": here}})


def main() -> int:
    """One delivery."""
    parser = argparse.ArgumentParser(
        prog="python -m examples.courier",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("what", help="as coffee")
    parser.add_argument("--start", default="reception", metavar="PLACE", help="where it is fetched")
    parser.add_argument("--goal", default="room_3", metavar="PLACE", help="where it is brought")
    parser.add_argument(
        "--by",
        default="ws://127.0.0.1:9090",
        metavar="URL",
        help=f"after one of {', '.join(PROTOCOLS)} and =",
    )
    parser.add_argument("--confirm", action="store_true", help="answer what the robot asks")
    parser.add_argument(
        "--at", type=pose, metavar="X,Y,YAW", help="where the robot stands, if it does not know"
    )
    chosen = parser.parse_args()
    try:
        with way_to(chosen.by, "courier") as way:
            if chosen.at is not None:
                place(way, *chosen.at)
            run = deliver(way, chosen.what, (chosen.start, chosen.goal), confirm=chosen.confirm)
    except NotDelivered as problem:
        print(problem)
        return 1
    except FAULTS as problem:
        print(sentence(chosen.by, problem), file=sys.stderr)
        return 1
    print(run["reason"])
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
