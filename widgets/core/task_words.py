"""Words of tasks: their names, what each needs, and the sentence about what will happen. Knows no Kivy.

will(TaskOrder(task="go_to", places=["Lab"]))  # 'Goes to Lab and stays there.'
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bridge.msgs.pilothouse_msgs import Mission, RobotInfo, ScheduledTask, TaskOrder

__all__ = [
    "KINDS",
    "STATES",
    "TASKS",
    "TaskWords",
    "distance_words",
    "fields",
    "heading_of",
    "known",
    "lacking",
    "rhythm",
    "span_words",
    "title",
    "will",
]


@dataclass(frozen=True, slots=True)
class TaskWords:
    """How a task looks and reads."""

    name: str
    """As on a button."""
    icon: str
    doing: str
    """As in `AUTO · patrol`."""
    fields: tuple[str, ...]
    """What the operator may say about it, in the order of the form."""
    about: str
    """What it is for, in a few words."""


TASKS: dict[str, TaskWords] = {
    "patrol": TaskWords(
        "Patrol", "route", "patrol", ("points", "reaction"), "Round the points, watching for intruders"
    ),
    "deliver": TaskWords(
        "Deliver",
        "local_shipping",
        "delivery",
        ("from", "to", "then", "message", "recipient"),
        "Fetch from one place, bring to another",
    ),
    "guide": TaskWords("Guide", "group", "guiding", ("stops", "message"), "Lead a person along places"),
    "go_to": TaskWords("Go to", "near_me", "going", ("to",), "Drive to a place and stay"),
    "go_home": TaskWords("Go home", "home", "going home", (), "Return to where it lives"),
    "hold": TaskWords("Hold", "pause_circle", "holding", ("height", "duration"), "Stay where it is"),
    "follow_heading": TaskWords(
        "Heading",
        "explore",
        "heading",
        ("heading", "speed", "throttle", "height", "duration"),
        "Straight in one direction",
    ),
    "dock": TaskWords("Dock", "battery_charging_full", "docking", ("dock",), "Onto the charger"),
    "take_off": TaskWords("Take off", "arrow_upward", "taking off", ("height",), "Up into the air"),
    "land": TaskWords("Land", "arrow_downward", "landing", (), "Down to the ground"),
    "surface": TaskWords("Surface", "water", "surfacing", (), "Up out of the water"),
}
"""Every task in the order of the chooser."""

KINDS: dict[str, tuple[str, str, str]] = {
    "place": ("place", "Place", "Places"),
    "office": ("door_front", "Office", "Offices"),
    "home": ("home", "Home", "Home"),
    "dock": ("battery_charging_full", "Dock", "Docks"),
    "reception": ("person", "Reception", "Reception"),
    "lab": ("build", "Lab", "Labs"),
    "hall": ("crop_free", "Hall", "Halls"),
}
"""Kind of a place to icon, word and word for several."""

STATES: dict[str, tuple[str, str, str]] = {
    "IDLE": ("info", "muted", "idle"),
    "RUNNING": ("play_arrow_fill", "accent", "runs"),
    "PAUSED": ("pause_fill", "warn", "paused"),
    "SUCCEEDED": ("check_circle", "ok", "done"),
    "CANCELED": ("cancel", "muted", "canceled"),
    "FAILED": ("error", "danger", "failed"),
    "INTERRUPTED": ("warning", "warn", "cut short"),
}
"""State of a task to icon, role and word."""

NEEDS = {
    "deliver": ((2, "Choose where to fetch it."), (1, "Choose where to bring it.")),
    "guide": ((1, "Choose at least one place to lead to."),),
    "go_to": ((1, "Choose where to go."),),
}
PECULIAR = ("take_off", "land", "surface")
"""Tasks of robots that fly or dive."""
MOVES, HOLDS = "Drives", "Stands still where it is"
"""Words for a robot that gives none of its own: how it moves, and how it keeps its place."""
FIGURES = ("speed", "throttle", "height")
"""Fields of an order that only some robots take, as `RobotInfo.order_fields` names them."""
DAYS = ("Mon", "Tue", "Wed", "Thu", "Fri", "Sat", "Sun")
REACTS = {
    "stop": "Stops when it finds an intruder.",
    "report": "Reports intruders and goes on.",
    "circle": "Goes once round each intruder, then on.",
}


def title(order: TaskOrder) -> str:
    """An order in a few words, as in `Deliver: Office 12 → Lab`."""
    words = TASKS.get(order.task)
    name = words.name if words else order.task or "No task"
    places = [place for place in order.places if place]
    if order.task == "follow_heading":
        return f"{name} {heading_of(order.heading)}"
    if order.task == "take_off" and math.isfinite(order.height):
        return f"{name} to {order.height:g} m"
    if order.task == "hold" and math.isfinite(order.duration):
        return f"{name} for {span_words(order.duration)}"
    if order.task == "go_to" and places:
        return f"{name} {places[0]}"
    if not places:
        return name
    shown = places if len(places) <= 3 else [places[0], f"{len(places) - 2} more", places[-1]]
    return f"{name}: {' → '.join(shown)}"


def lacking(order: TaskOrder, mission: Mission | None = None) -> str:
    """What is missing before the order can be given, as one sentence; empty when nothing is."""
    places = order.places
    if order.task == "patrol" and not places and mission is not None and not mission.waypoints:
        return "The mission has no points: set some on the map, or choose places here."
    if order.task == "deliver":
        start, end = [*places, "", ""][:2]
        if not start or not end:
            return NEEDS["deliver"][0 if not start else 1][1]
        if start == end:
            return f"It cannot bring from {start} to {end}: choose two places."
        return ""
    for least, sentence in NEEDS.get(order.task, ()):
        if len([place for place in places if place]) < least and not order.goals:
            return sentence
    return "" if order.task in TASKS else "Choose a task."


def fields(task: str, info: RobotInfo) -> tuple[str, ...]:
    """Fields of a task's order that make sense for that robot, in the order of the form."""
    taken = info.order_fields or ("speed", "height")
    left_out = {figure for figure in FIGURES if figure not in taken}
    if not info.max_climb > 0:
        left_out.add("height")
    return tuple(one for one in TASKS[task].fields if one not in left_out) if task in TASKS else ()


def known(info: RobotInfo) -> list[str]:
    """The tasks that a robot can be asked for, in the order of the chooser; one that does not say knows those that every
    robot does that drives."""
    return [task for task in TASKS if (task in info.tasks if info.tasks else task not in PECULIAR)]


def will(
    order: TaskOrder, mission: Mission | None = None, *, follows: bool = True, robot: RobotInfo | None = None
) -> str:
    """What will happen when the order is given, as a sentence or two; what is lacking when it cannot be given.

    `follows`: the robot detects whether a person follows it. `robot` has words of its own; None for the generic ones.
    """
    missing, robot = lacking(order, mission), robot or RobotInfo()
    if missing:
        return missing
    says = {"patrol": lambda: _patrols(order, mission or Mission())}
    says |= {
        "deliver": lambda: _delivers(order),
        "guide": lambda: _guides(order, follows),
        "dock": lambda: _docks(order),
    }
    says |= {
        "hold": lambda: _holds(order, robot),
        "follow_heading": lambda: _follows(order, robot),
        "take_off": lambda: _takes_off(order),
        "land": lambda: "Lands on the ground below.",
        "surface": lambda: "Swims up to the surface and stays there.",
        "go_home": lambda: "Goes home and stays there.",
    }
    if order.task in says:
        return says[order.task]()
    goal = order.places[0] if order.places else "the goal"
    return f"Goes to {goal} and stays there."


def _how_long(order: TaskOrder) -> str:
    return f"for {span_words(order.duration)}" if math.isfinite(order.duration) else "until you stop it"


def _holds(order: TaskOrder, robot: RobotInfo) -> str:
    return f"{robot.holds or HOLDS}{_at_height(order, robot)} {_how_long(order)}."


def _follows(order: TaskOrder, robot: RobotInfo) -> str:
    towards = "where it points now" if math.isnan(order.heading) else heading_of(order.heading)
    pace = f" at {order.speed:.1f} m/s" if math.isfinite(order.speed) else ""
    if math.isfinite(order.throttle):
        pace = f" with {order.throttle * 100:.0f} % throttle"
    return f"{robot.moves or MOVES} straight towards {towards}{pace}{_at_height(order, robot)} {_how_long(order)}."


def _takes_off(order: TaskOrder) -> str:
    height = f" to {order.height:g} m" if math.isfinite(order.height) else ""
    return f"Takes off{height} and hovers there."


def _at_height(order: TaskOrder, robot: RobotInfo) -> str:
    if not math.isfinite(order.height):
        return ""
    return f", {abs(order.height):g} m {'deep' if robot.dives else 'high'},"


def _patrols(order: TaskOrder, mission: Mission) -> str:
    count = len(order.places) or len(mission.waypoints)
    what = _listed(order.places) if order.places else f"{count} point{'' if count == 1 else 's'}"
    laps = (
        f", {mission.laps} lap{'' if mission.laps == 1 else 's'}" if mission.laps else ", until you stop it"
    )
    how = {"loop": "in order", "random": "in any order", "intermittent": f"with {mission.dwell:g} s at each"}
    react = "stop" if mission.stop_on_intruder else mission.on_intruder or "report"
    return f"Visits {what} {how.get(mission.motion, mission.motion)}{laps}. {REACTS.get(react, '')}"


def _delivers(order: TaskOrder) -> str:
    start, end, then = [*order.places, "", "", ""][:3]
    who = "a tap here or the addressee's tag" if order.recipient_tag else "a tap here or the tag of the place"
    after = f" Then goes on to {then}." if then else ""
    return f"Fetches at {start}, brings it to {end}; waits at each for {who}.{after}"


def _guides(order: TaskOrder, follows: bool) -> str:
    names = [place for place in order.places if place]
    if not follows:
        blind = "Does not wait: it has no sensor for followers."
        return f"Leads a person to {_listed(names)} and reads out the notes. {blind}"
    return f"Leads a person to {_listed(names)}, waits when no one follows, and reads out the notes."


def _docks(order: TaskOrder) -> str:
    return f"Drives onto {order.places[0] if order.places else 'its dock'} and charges."


def _listed(names: Sequence[str]) -> str:
    """As in `A, B and C`."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def heading_of(yaw: float) -> str:
    """A yaw [rad] as the heading that people steer by, as in `090°`; `ahead` for NaN."""
    if not math.isfinite(yaw):
        return "ahead"
    return f"{round(90 - math.degrees(yaw)) % 360:03d}°"


def span_words(seconds: float) -> str:
    """A length of time [s] in words, as in `1 h 30 min`; a dash for NaN."""
    if not math.isfinite(seconds):
        return "—"
    if seconds < 60:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    if minutes < 60:
        return f"{minutes} min"
    hours, minutes = divmod(minutes, 60)
    if hours < 24:
        return f"{hours} h {minutes} min" if minutes else f"{hours} h"
    days, hours = divmod(hours, 24)
    return f"{days} d {hours} h" if hours else f"{days} d"


def distance_words(metres: float) -> str:
    """A distance [m] in words; a dash for NaN."""
    if not math.isfinite(metres):
        return "—"
    return f"{metres / 1000:.1f} km" if metres >= 1000 else f"{metres:.0f} m"


def rhythm(task: ScheduledTask) -> str:
    """When a scheduled task starts, as in `22:00, Mon to Fri`."""
    if not task.at:
        return f"every {span_words(task.every)}"
    days = [index for index, on in enumerate(task.days) if on]
    if len(days) == 7:
        return f"{task.at}, every day"
    if not days:
        return f"{task.at}, on no day"
    if len(days) > 2 and days == list(range(days[0], days[-1] + 1)):
        return f"{task.at}, {DAYS[days[0]]} to {DAYS[days[-1]]}"
    return f"{task.at}, {', '.join(DAYS[day] for day in days)}"
