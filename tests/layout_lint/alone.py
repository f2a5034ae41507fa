"""What the walk looks at where no robot is connected: the connect page, its questions, the pages without a robot, the tour."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from app.discovery.simulator_options import SimulatorOptions
from app.screens.parts.dialogs import Question
from bridge.discovery.hello import Hello
from tests.app.glass import Glass
from tests.app.replay.made import recorded

__all__ = [
    "NAME",
    "Scene",
    "close",
    "kept_recording",
    "lone_scenes",
    "nothing",
    "opened_recording",
    "tour_cards",
]

Scene = tuple[str, Callable[[Glass], object], Callable[[Glass], object]]
"""Its name, what puts it on the glass, and what takes away again what the next one does not replace."""
NAME = "2025-11-21_10-01-11.mcap"
"""Of the recording that is opened."""
HELLOS = (
    Hello(name="Patrol-1", kind="wheels", description="Differential drive", url="ws://192.168.1.7:9090", battery=0.92),
    Hello(name="Patrol-1", kind="wheels", description="Differential drive", url="ws://192.168.1.8:9090", battery=0.12, driver="tablet-B"),
    Hello(name="Pool swimmer 12", kind="dives", description="Amphibious hexapod", url="wss://192.168.1.9:9090", battery=0.4),
)  # fmt: skip
TROUBLE = "No answer from 192.168.1.7 within 5 s. Is the robot switched on and on this network?"
SIMULATED = {
    "patrol": "differential drive, for rounds",
    "commander": "truck with Ackermann steering",
    "aqua": "amphibious hexapod",
}
WORLDS = {"office": "corridors and rooms", "orchard": "rows of trees", "tank": "water, 12 m deep"}
OFFERED = {
    "robots": [
        {"name": name, "title": name.title(), "kind": "wheels", "description": what, "home": "office"}
        for name, what in SIMULATED.items()
    ],
    "worlds": [
        {"name": name, "description": what, "robots": list(SIMULATED)} for name, what in WORLDS.items()
    ],
}


def nothing(_: Glass) -> None:
    """The next one replaces it."""


def close(glass: Glass) -> None:
    """Take every question off the glass."""
    while any(isinstance(child, Question) for child in glass.app.root.children):
        glass.app.pages.close_question()


def lone_scenes() -> Iterator[Scene]:
    """All of them, in an order in which none is in another's way."""
    yield "connect empty", nothing, nothing
    yield "connect address", lambda glass: glass.app.robot_list.ask_address(), close
    yield "connect pair", lambda glass: glass.app.robot_list.trust.ask(), close
    yield "connect simulator", _simulator, close
    yield "connect robots", _robots, nothing
    yield "connect pair one", lambda glass: glass.app.robot_list.trust.ask(HELLOS[2].url), close
    yield "connect trouble", _trouble, lambda glass: glass.app.connect.say("")
    yield "connect keys", lambda glass: glass.app.toggle_help(), lambda glass: glass.app.toggle_help()
    yield from tour_cards("connect tour", 1)
    for name in ("inputs", "setup", "replay"):
        yield f"alone {name}", lambda glass, name=name: glass.app.pages.show_lone(name), _connect
    yield "alone setup name", lambda glass: glass.app.show_setup("name"), _connect
    yield "alone recording", _recording, _connect


def tour_cards(name: str, count: int) -> Iterator[Scene]:
    """Of the look round, one after the other."""
    for number in range(count):
        yield f"{name} {number + 1}", lambda glass, number=number: _tour(glass, number), _end_tour


def _tour(glass: Glass, number: int) -> None:
    glass.app.tour.begin()
    for _ in range(number):
        glass.app.tour.go_on()


def _end_tour(glass: Glass) -> None:
    glass.app.tour.leave()


def _robots(glass: Glass) -> None:
    for hello in HELLOS:
        glass.app.robots.heard(hello, glass.app.now())
    glass.app.robot_list.refresh()


def _trouble(glass: Glass) -> None:
    _robots(glass)
    glass.app.connect.say(TROUBLE, "warn")


def _simulator(glass: Glass) -> None:
    glass.app.simulating._offered = SimulatorOptions.read(json.dumps(OFFERED))
    glass.app.simulating.ask()


def _connect(glass: Glass) -> None:
    for name in ("inputs", "setup", "replay"):
        if page := glass.app.pages.lone(name):
            while page.back():
                pass
    glass.app.pages.show_connect()


def kept_recording(glass: Glass) -> Path:
    """One where the app has its own."""
    path = Path(glass.app.records._folder / "recordings" / NAME)
    return path if path.exists() else recorded(path, pieces=4000)


def opened_recording(glass: Glass, screen: Any) -> None:
    """Have `screen`, which is on the glass, play a recording."""
    rows = screen.list
    glass.until(lambda: NAME in rows.rows and "Patrol-1" in rows.rows[NAME].title, "nobody looked into it")
    if screen.player is None:
        rows.rows[NAME].dispatch("on_release")
    glass.until(lambda: screen.view.parent is screen, "it does not open")


def _recording(glass: Glass) -> None:
    kept_recording(glass)
    glass.app.pages.show_lone("replay")
    opened_recording(glass, glass.app.pages.lone("replay").screen)
