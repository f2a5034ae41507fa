"""Command line of the simulator, `python -m sim`: views a simulated world without the rest of the system."""

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

from bridge.core.toml_files import FileFault
from sim.core.shapes import Shape, from_yaw
from sim.rendering.renderer import NoRendererError, Renderer
from sim.rendering.view import View
from sim.vehicles.model import Model, numbered
from sim.vehicles.start_places import starts
from sim.world.world import World
from sim.world.world_files import load

try:
    from sim.robot import ROBOTS, WORLDS, home_of, make_several, model_of
except FileFault as wrong:  # in the file of a vehicle, which is read with its module
    if __name__ != "__main__":
        raise
    print(f"sim: {wrong}", file=sys.stderr)
    raise SystemExit(2) from None

MARGIN = 3.0
"""Shown round the ground [m]."""
PICTURE_WIDTH = 1600
"""Breadth of the picture."""
FRAME_PERIOD = 1 / 60
"""Between two readings of the clock while the window is open [s]."""
MAX_CATCH_UP = 0.1
"""Longest time simulated between two readings of the clock [s]: a window that is drawn slowly shows slow motion and no jumps."""


def main(argv: Sequence[str] | None = None) -> int:
    """Do what the arguments ask; 0 done, 2 the user's mistake, 1 a fault."""
    try:
        arguments = _parser().parse_args(argv)
        names = [name.strip() for name in arguments.robot.split(",")]
        world = arguments.world or home_of(names)
        models = numbered([model_of(name) for name in names])
        if arguments.gui:
            show(world, names, clock=time.monotonic, wait=time.sleep)
        elif arguments.picture:
            print(picture(load(world), models, Path(arguments.picture)))
        else:
            print(summary(load(world)))
    except (ValueError, OSError) as fault:
        print(f"sim: {fault}", file=sys.stderr)
        return 2
    except (NoRendererError, RuntimeError) as fault:
        print(f"sim: {fault}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 0
    return 0


class _Parser(argparse.ArgumentParser):
    """Reports a mistake in one sentence."""

    def error(self, message: str) -> NoReturn:
        raise ValueError(f"{message[:1].upper()}{message[1:]}.")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser("python -m sim", description="View a simulated world.")
    parser.add_argument(
        "--world", default="", help=f"{', '.join(WORLDS)} or a TOML file; default: the robot's home"
    )
    parser.add_argument(
        "--robot", default="patrol", help=f"{', '.join(ROBOTS)}, or several separated by commas"
    )
    parser.add_argument("--picture", metavar="FILE", help="draw the world from above into a PNG or JPEG file")
    parser.add_argument("--gui", action="store_true", help="show the world in the physics engine's window")
    return parser


_NAMES = {
    "car": ("car", "cars"),
    "cone": ("cone", "cones"),
    "barrel": ("barrel", "barrels"),
    "lamp": ("lamp post", "lamp posts"),
    "tree": ("tree", "trees"),
    "fruit_tree": ("fruit tree", "fruit trees"),
    "table": ("table", "tables"),
    "door": ("door", "doors"),
    "shelf": ("shelf", "shelves"),
    "chair": ("chair", "chairs"),
    "sofa": ("sofa", "sofas"),
    "person": ("person", "people"),
    "buoy": ("buoy", "buoys"),
    "coral": ("coral", "corals"),
    "diver": ("diver", "divers"),
    "block": ("block or wall", "blocks and walls"),
    "model": ("model", "models"),
    "dock": ("dock", "docks"),
}
"""What one thing of a kind is called, and what several are."""
_KINDS = {"loose_model": "model", "jetty": "dock", "pad": "dock", "cage": "dock"}
"""Kinds of props that are counted together with another one."""


def summary(world: World) -> str:
    """Things that stand in the world, in one sentence."""
    ground, counts = world.ground, Counter(_KINDS.get(prop.kind, prop.kind) for prop in world.props)
    named = [f"{count} {names[count > 1]}" for kind, names in _NAMES.items() if (count := counts[kind])]
    things = ", ".join(named)
    water = f"{world.water.depth:g} m of water; " if world.water else ""
    return f"{world.name}: {ground.length:g} x {ground.width:g} m; {water}{things or 'empty'}."


def picture(world: World, models: Sequence[Model], path: Path) -> str:
    """Draw `world` from above, north up, with robots of `models` at their starts, into `path`; a sentence about it."""
    if path.suffix.lower() not in Image.registered_extensions():
        raise ValueError(f"{path.name} has no ending of a picture; use .png or .jpg.")
    length, width = world.ground.length + 2 * MARGIN, world.ground.width + 2 * MARGIN
    view = View.from_above(length, width, PICTURE_WIDTH)
    robots: list[Shape] = []
    for model, start in zip(models, starts(world, models, [None] * len(models)), strict=True):
        depth = start.z if model.element == "water" else 0.0
        robots += model.looks(model.parameters, (start.x, start.y, depth), from_yaw(start.angle))
    renderer = Renderer(world, samples=4)
    try:
        Image.fromarray(renderer.render(view, tuple(robots))).save(path)
    finally:
        renderer.close()
    return f"{path}: {world.name} from above, {PICTURE_WIDTH / length:.1f} pixels a metre, north up."


def show(
    world: str, robots: Sequence[str], *, clock: Callable[[], float], wait: Callable[[float], None]
) -> None:
    """Run in real time in the engine's window until interrupted."""
    if not os.environ.get("DISPLAY"):
        raise ValueError("--gui needs a display, and DISPLAY is not set.")
    simulated = make_several(robots, world, gui=True, camera=False)
    try:
        print("The window is open; Ctrl-C closes it.", flush=True)
        now, last = 0.0, clock()
        while True:
            before, last = last, clock()
            now += min(last - before, MAX_CATCH_UP)
            for robot in simulated:
                robot.read(now)
            wait(FRAME_PERIOD)
    finally:
        for robot in simulated:
            robot.close()


if __name__ == "__main__":
    raise SystemExit(main())
