"""Every screen of a connected robot, one line each: how it is called, what makes it, and where the navigation has it."""

from __future__ import annotations

from dataclasses import dataclass

from widgets.core.language import mark

__all__ = ["MAX_TABS", "MORE", "SCREENS", "Entry", "beyond", "names", "tabs"]

MAX_TABS = 5
"""So many stand side by side on a phone, the one to all others included."""
MORE = "more"
"""Name of the screen that leads to all others."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One screen."""

    name: str
    icon: str
    words: str
    """On its button."""
    maker: str = ""
    """Module and class, as in `app.screens.tasks.tasks:TasksScreen`; empty where the layout of the robot says it."""
    needs: tuple[str, ...] = ("app", "session")
    """What the class is given by name."""
    edge: bool = True
    """It has a button of its own at the left edge of a tablet; without one it is found under More."""
    about: str = ""
    """What it is for, in a few words, where there is room for them."""


SCREENS = (
    Entry("drive", "sports_esports", mark("Drive"), about=mark("By hand, over its camera")),
    Entry(
        "mission",
        "map",
        mark("Mission"),
        "app.screens.mission.mission:MissionScreen",
        about=mark("Map, points, progress"),
    ),
    Entry(
        "tasks",
        "list",
        mark("Tasks"),
        "app.screens.tasks.tasks:TasksScreen",
        about=mark("Orders, queue, events"),
    ),
    Entry(
        "panels",
        "dashboard",
        mark("Panels"),
        "app.screens.panels.panels:PanelsScreen",
        ("app", "session", "profiles"),
        about=mark("Screens of your own"),
    ),
    Entry(
        "topics",
        "data_object",
        mark("Topics"),
        "app.screens.topics.topics:TopicsScreen",
        about=mark("All that it publishes"),
    ),
    Entry(
        "fleet",
        "smart_toy",
        mark("Fleet"),
        "app.screens.fleet.fleet:FleetScreen",
        about=mark("All robots, STOP ALL"),
    ),
    Entry(
        "replay",
        "history",
        mark("Replay"),
        "app.screens.replay.screen:ReplayScreen",
        ("app",),
        about=mark("Recordings, moment by moment"),
    ),
    Entry(
        "setup",
        "tune",
        mark("Setup"),
        "app.screens.setup.screen:SetupScreen",
        about=mark("This handheld, this robot"),
    ),
    Entry(
        "inputs",
        "sports_esports",
        mark("Inputs"),
        "app.screens.inputs.screen:InputsScreen",
        ("app",),
        edge=False,
        about=mark("Pad, keys, voice, tilt, switches"),
    ),
    Entry(MORE, "more_horiz", mark("More"), "app.screens.more.more:MoreScreen", edge=False),
)
"""In the order of the navigation: a phone's bar has the first of them and More."""


def names() -> tuple[str, ...]:
    """Of every screen."""
    return tuple(entry.name for entry in SCREENS)


def tabs(form: str, screens: tuple[Entry, ...] = SCREENS) -> tuple[Entry, ...]:
    """Those with a button of their own in a window of this `form`, as of `app.layout.arrange.form`, in their order."""
    edge = tuple(entry for entry in screens if entry.edge)
    if form == "wide":
        return edge
    return (*edge[: MAX_TABS - 1], *(entry for entry in screens if entry.name == MORE))


def beyond(form: str, screens: tuple[Entry, ...] = SCREENS) -> tuple[Entry, ...]:
    """Those that More leads to in a window of this `form`."""
    shown = tabs(form, screens)
    return tuple(entry for entry in screens if entry not in shown and entry.name != MORE)
