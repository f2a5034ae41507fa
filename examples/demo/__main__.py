"""The demo, `python -m examples.demo`: an operator's work with each kind of robot, by script, in the real app, with simulated robots.

Every tap and drag is a touch in Kivy's own input loop; every command goes over a real socket; what the robot did is
measured by a second client that knows the simulation's truth. Pictures, summary.json and run.mcap go to `--out`.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from app.__main__ import quieten
from bridge.discovery.domain import VARIABLE
from examples.demo.options import options


def _prepare(size: str, *, window: bool) -> None:
    """Set Kivy up before anything of it is imported."""
    os.environ.update(KIVY_NO_ARGS="1", KIVY_NO_CONFIG="1", KIVY_NO_FILELOG="1", KIVY_LOG_MODE="PYTHON")
    os.environ.update(KIVY_METRICS_DENSITY="1", KIVY_METRICS_FONTSCALE="1", KIVY_DPI="96")
    if not window:
        os.environ.pop("DISPLAY", None)
        os.environ.pop("WAYLAND_DISPLAY", None)
        os.environ.update(SDL_VIDEODRIVER="offscreen", SDL_AUDIODRIVER="dummy", LIBGL_ALWAYS_SOFTWARE="1")
        os.environ.setdefault("LP_NUM_THREADS", "1")
    os.environ["KIVY_CLOCK"] = "free_all"
    # robots of others on the network are neither listed nor stopped
    os.environ[VARIABLE] = f"demo-{os.getpid()}"
    from kivy.config import Config

    width, height = map(int, size.split("x"))
    if not window:
        # a window without a display never grows beyond its first size
        width, height = max(width, MAX_SIDE), max(height, MAX_SIDE)
    for key, value in {
        "width": str(width),
        "height": str(height),
        "multisamples": "0",
        "maxfps": "30",
    }.items():
        Config.set("graphics", key, value)
    for key, _ in Config.items("input"):
        Config.remove_option("input", key)
    quieten()


MAX_SIDE = 900
"""Either side of the sizes that a story changes to is at most this [px]."""
GUIDE = {
    "patrol": {"connect-screen": "connect", "watching": "mission", "driving": "drive"},
    "aqua": {"driving": "dive"},
    "ardrone": {"driving": "drone"},
}
"""Pictures of each robot's demo that the guide shows, and their names there."""


def _keep_pictures(out: Path, robot: str, folder: Path) -> None:
    """Copy what the guide shows of this robot's demo."""
    folder.mkdir(parents=True, exist_ok=True)
    for step, name in GUIDE.get(robot, {}).items():
        for picture in out.glob(f"[0-9][0-9]-{step}.png"):
            shutil.copyfile(picture, folder / f"{name}-tablet.png")


def _play(arguments: argparse.Namespace, robot: Any, settings: Path) -> int:
    """Run the app with the story in it; returns the exit code."""
    from kivy.base import EventLoop
    from kivy.clock import Clock
    from kivy.core.window import Window

    from app.application import PilothouseApp
    from examples.demo.fingers import Hand
    from examples.demo.frames import seldom_drawn
    from examples.demo.glass import Glass
    from examples.demo.report import Report
    from examples.demo.scene import Scene
    from examples.demo.stories import play, topics
    from examples.demo.witness import Witness

    Window.size = tuple(map(int, arguments.size.split("x")))
    report, hand = Report(arguments.out), Hand()
    app = PilothouseApp(settings_dir=settings, theme=arguments.theme)
    witness = Witness(robot.url, topics(arguments.story))
    scene = Scene(Glass(hand), witness, report, robot.url, arguments.speed, arguments.until, robot.power_cut)
    record = arguments.out / "run.mcap"
    story = play(arguments.story, scene, lambda: app.records.start(record, app.session))
    record.unlink(missing_ok=True)
    EventLoop.add_input_provider(hand)
    Clock.schedule_interval(lambda _: _turn(story, report, app), 0)
    started = time.monotonic()
    try:
        with seldom_drawn(arguments.drawn):
            app.run()
    finally:
        witness.close()
    recording = {"file": record.name, "bytes": record.stat().st_size} if record.exists() else None
    given = {name: getattr(arguments, name) for name in ("robot", "world", "speed")}
    seconds = round(time.monotonic() - started, 1)
    return report.write(**given, url=robot.url, seconds=seconds, recording=recording)


def _turn(story: Iterator[None], report: Any, app: Any) -> None:
    """Go on with the story; its end, or what went wrong in it, ends the app."""
    from examples.demo.glass import Unseen
    from examples.demo.scene import Enough

    try:
        next(story)
    except (StopIteration, Enough):
        app.stop()
    except (Unseen, RuntimeError) as problem:
        report.fault = f"{report.steps[-1].name if report.steps else 'start'}: {problem}"
        app.stop()


def main(argv: list[str] | None = None) -> int:
    """Run the demo; 0 when every expectation held, 1 when one did not, 2 for the user's mistake."""
    try:
        arguments = options(argv, __doc__)
    except ValueError as mistake:
        print(f"demo: {mistake}", file=sys.stderr)
        return 2
    _prepare(arguments.size, window=arguments.window)
    from examples.demo.robot import Restarting

    folder = Path(tempfile.mkdtemp(prefix="pilothouse-demo-"))
    command = ["--robot", f"sim:{arguments.robot}", "--world", arguments.world]
    command += ["--speed", str(arguments.speed)]
    if arguments.story == "errand":
        command += ["--config", str(Path(__file__).with_name("errand.toml"))]
    arguments.out.mkdir(parents=True, exist_ok=True)
    try:
        with Restarting(*command, "--state", str(folder / "robot"), log=arguments.out / "robot.log") as robot:
            code = _play(arguments, robot, folder / "handheld")
            left = robot.close()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    if left:
        print(
            f"demo: the robot side ended with exit code {left}; its words are in {arguments.out}/robot.log."
        )
    if arguments.pictures and not code:
        _keep_pictures(arguments.out, arguments.robot, arguments.pictures)
    print(
        f"demo: {'all held' if not code else 'NOT all held'}; pictures and summary.json are in {arguments.out}"
    )
    return code or bool(left)


if __name__ == "__main__":
    sys.exit(main())
