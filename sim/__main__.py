"""`python -m sim`: look at a simulated world without the rest of the system."""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NoReturn

from PIL import Image

from sim.renderer import NoRendererError, Renderer
from sim.robot import ROBOTS, WORLDS, make, model_of
from sim.shapes import from_yaw
from sim.vehicles.model import Model
from sim.view import View
from sim.world import World, load

MARGIN = 3.0
"""Shown round the ground [m]."""
PIXELS = 1600
"""Breadth of the picture."""
FRAME = 1 / 60
"""Between two looks at the clock while the window is open [s]."""


def main(argv: Sequence[str] | None = None) -> int:
    """Do what the arguments ask; 0 done, 2 the user's mistake, 1 a fault."""
    try:
        arguments = _parser().parse_args(argv)
        world, model = load(arguments.world), model_of(arguments.robot)
        if arguments.picture:
            print(picture(world, model, Path(arguments.picture)))
        elif arguments.gui:
            show(arguments.world, arguments.robot, clock=time.monotonic, wait=time.sleep)
        else:
            print(summary(world))
    except (ValueError, OSError) as fault:
        print(f"sim: {fault}", file=sys.stderr)
        return 2
    except NoRendererError as fault:
        print(f"sim: {fault}", file=sys.stderr)
        return 1
    return 0


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one sentence."""

    def error(self, message: str) -> NoReturn:
        raise ValueError(f"{message[:1].upper()}{message[1:]}.")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser("python -m sim", description="Look at a simulated world.")
    parser.add_argument("--world", default="parking_lot", help=f"{', '.join(WORLDS)} or a TOML file")
    parser.add_argument("--robot", default="patrol", help=", ".join(ROBOTS))
    parser.add_argument("--picture", metavar="FILE", help="draw the world from above into a PNG or JPEG file")
    parser.add_argument("--gui", action="store_true", help="watch it in the physics engine's window")
    return parser


_NAMES = {
    "car": "cars",
    "cone": "cones",
    "lamp": "lamp posts",
    "tree": "trees",
    "fruit_tree": "fruit trees",
    "table": "tables",
    "person": "people",
    "buoy": "buoys",
    "coral": "corals",
    "diver": "divers",
    "block": "blocks and walls",
}


def summary(world: World) -> str:
    """What stands in the world, in one sentence."""
    ground, counts = world.ground, Counter(prop.kind for prop in world.props)
    things = ", ".join(f"{counts[kind]} {name}" for kind, name in _NAMES.items() if counts[kind])
    water = f"{world.water.depth:g} m of water; " if world.water else ""
    return f"{world.name}: {ground.length:g} x {ground.width:g} m; {water}{things or 'empty'}."


def picture(world: World, model: Model, path: Path) -> str:
    """Draw `world` from above, north up, with a robot of `model` at its start, into `path`; a sentence about it."""
    if path.suffix.lower() not in Image.registered_extensions():
        raise ValueError(f"{path.name} has no ending of a picture; use .png or .jpg.")
    length, width = world.ground.length + 2 * MARGIN, world.ground.width + 2 * MARGIN
    view = View.from_above(length, width, PIXELS)
    start = world.start
    robot = model.looks(model.parameters, (start.x, start.y, 0.0), from_yaw(start.angle))
    renderer = Renderer(world, samples=4)
    try:
        Image.fromarray(renderer.render(view, robot)).save(path)
    finally:
        renderer.close()
    return f"{path}: {world.name} from above, {PIXELS / length:.1f} pixels a metre, north up."


def show(world: str, robot: str, *, clock: Callable[[], float], wait: Callable[[float], None]) -> None:
    """Run in real time in the engine's window until interrupted."""
    if not os.environ.get("DISPLAY"):
        raise ValueError("--gui needs a display, and DISPLAY is not set.")
    simulated = make(robot, world, gui=True, camera=False)
    try:
        while True:
            simulated.read(clock())
            wait(FRAME)
    except KeyboardInterrupt:
        return
    finally:
        simulated.close()


if __name__ == "__main__":
    raise SystemExit(main())
