"""Words of tasks: their names, what each needs, and the sentence about what will happen. Knows no Kivy.

will(TaskOrder(task="go_to", places=["Lab"]))  # 'Goes to Lab and stays there.'
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Mission, RobotInfo, ScheduledTask, TaskOrder
from widgets.core.language import mark, tr, trn
from widgets.core.quantities import quantities, said

__all__ = [
    "KINDS",
    "PHASES",
    "STATES",
    "TASKS",
    "TaskWords",
    "distance_words",
    "fields",
    "heading_of",
    "known",
    "lacking",
    "outcome_words",
    "phase_words",
    "rhythm",
    "span_words",
    "title",
    "will",
]


@dataclass(frozen=True, slots=True)
class TaskWords:
    """How a task looks and reads."""

    english: str
    """As on a button."""
    icon: str
    act: str
    """As in `AUTO · patrol`."""
    fields: tuple[str, ...]
    """What the operator may say about it, in the order of the form."""
    aim: str
    """What it is for, in a few words."""

    @property
    def name(self) -> str:
        """As on a button, in the language of the glass."""
        return tr(self.english)

    @property
    def doing(self) -> str:
        """As in `AUTO · patrol`, in the language of the glass."""
        return tr(self.act)

    @property
    def about(self) -> str:
        """What it is for, in the language of the glass."""
        return tr(self.aim)


TASKS: dict[str, TaskWords] = {
    "patrol": TaskWords(
        mark("Patrol"),
        "route",
        mark("patrol"),
        ("points", "reaction"),
        mark("Round the points, watching for intruders"),
    ),
    "deliver": TaskWords(
        mark("Deliver"),
        "local_shipping",
        mark("delivery"),
        ("from", "to", "then", "message", "recipient"),
        mark("Fetch from one place, bring to another"),
    ),
    "guide": TaskWords(
        mark("Guide"), "group", mark("guiding"), ("stops", "message"), mark("Lead a person along places")
    ),
    "go_to": TaskWords(mark("Go to"), "near_me", mark("going"), ("to",), mark("To a place, and stay there")),
    "go_home": TaskWords(mark("Go home"), "home", mark("going home"), (), mark("Return to where it lives")),
    "hold": TaskWords(
        mark("Hold"), "pause_circle", mark("holding"), ("height", "duration"), mark("Stay where it is")
    ),
    "follow_heading": TaskWords(
        mark("Heading"),
        "explore",
        mark("heading"),
        ("heading", "speed", "throttle", "height", "duration"),
        mark("Straight in one direction"),
    ),
    "dock": TaskWords(
        mark("Dock", "task"),
        "battery_charging_full",
        mark("docking"),
        ("dock", "charge"),
        mark("Onto the charger"),
    ),
    "undock": TaskWords(
        mark("Undock"), "undo", mark("leaving the dock"), (), mark("Back out of the charger")
    ),
    "take_off": TaskWords(
        mark("Take off"), "arrow_upward", mark("taking off"), ("height",), mark("Up into the air")
    ),
    "land": TaskWords(mark("Land"), "arrow_downward", mark("landing"), (), mark("Down to the ground")),
    "surface": TaskWords(mark("Surface"), "water", mark("surfacing"), (), mark("Up out of the water")),
}
"""Every task in the order of the chooser."""

KINDS: dict[str, tuple[str, str, str]] = {
    "place": ("place", mark("Place"), mark("Places")),
    "office": ("door_front", mark("Office"), mark("Offices")),
    "home": ("home", mark("Home"), mark("Home")),
    "dock": ("battery_charging_full", mark("Dock"), mark("Docks")),
    "reception": ("person", mark("Reception"), mark("Reception")),
    "lab": ("build", mark("Lab"), mark("Labs")),
    "hall": ("crop_free", mark("Hall"), mark("Halls")),
}
"""Kind of a place to icon, word and word for several."""

STATES: dict[str, tuple[str, str, str]] = {
    "IDLE": ("info", "muted", mark("idle")),
    "RUNNING": ("play_arrow_fill", "accent", mark("runs")),
    "PAUSED": ("pause_fill", "warn", mark("paused")),
    "SUCCEEDED": ("check_circle", "ok", mark("done")),
    "CANCELED": ("cancel", "muted", mark("canceled")),
    "FAILED": ("error", "danger", mark("failed")),
    "INTERRUPTED": ("warning", "warn", mark("cut short")),
}
"""State of a task to icon, role and word."""

PHASES: dict[str, str] = {
    "driving": mark("under way"),
    "waiting": mark("waiting"),
    "dwelling": mark("dwelling"),
    "holding": mark("holding"),
    "turning": mark("turning"),
    "planning": mark("planning"),
    "docking": mark("docking"),
    "undocking": mark("leaving the dock"),
    "charging": mark("charging"),
    "circling": mark("circling"),
    "taking off": mark("taking off"),
    "landing": mark("landing"),
    "surfacing": mark("surfacing"),
    "unsure": mark("unsure"),
}
"""Phase of a task that runs to what it does, as in `Point 1 of 3 · waiting`."""

UNSURE_THERE = ("help", "warn", mark("there, unsure"))
"""The same of a task that ended where the robot is unsure of its place: neither done nor failed on the way."""

NEEDS = {
    "deliver": ((2, mark("Choose where to fetch it.")), (1, mark("Choose where to bring it."))),
    "guide": ((1, mark("Choose at least one place to lead to.")),),
    "go_to": ((1, mark("Choose where to go.")),),
}
PECULIAR = ("undock", "take_off", "land", "surface")
"""Tasks of robots that fly or dive, or that say that they know them."""
MOVES, HOLDS = mark("Drives"), mark("Stands still where it is")
"""Words for a robot that gives none of its own: how it moves, and how it keeps its place."""
WORDS_OF_KINDS = (
    *(mark("Flies"), mark("Sails"), mark("Swims"), mark("Hovers where it is")),
    *(mark("Keeps its place on the water"), mark("Keeps its place in the water")),
)
"""The same of robots that give their own, as far as they are known in other languages; others stay as the robot has them."""
DRIVES_AND_CHARGES = (
    mark("Drives onto {places} and charges."),
    mark("Drives onto {places} and charges there until {share:.0f} %."),
)
LANDS_AND_CHARGES = (
    mark("Flies to {places}, lands on it and charges."),
    mark("Flies to {places}, lands on it and charges there until {share:.0f} %."),
)
GOES_AND_CHARGES = (
    mark("{moves} to {places} and charges."),
    mark("{moves} to {places} and charges there until {share:.0f} %."),
)
"""How a robot comes to its charger, without and with the charge that it stays for; `moves` is its own verb."""
FIGURES = ("speed", "throttle", "height")
"""Fields of an order that only some robots take, as `RobotInfo.order_fields` names them."""
DAYS = (mark("Mon"), mark("Tue"), mark("Wed"), mark("Thu"), mark("Fri"), mark("Sat"), mark("Sun"))
MONTHS = (
    *(mark("Jan"), mark("Feb"), mark("Mar"), mark("Apr"), mark("May"), mark("Jun")),
    *(mark("Jul"), mark("Aug"), mark("Sep"), mark("Oct"), mark("Nov"), mark("Dec")),
)
"""Short names of the months, January first."""
REACTS = {
    "stop": mark("Stops when it finds an intruder."),
    "report": mark("Reports intruders and goes on."),
    "circle": mark("Goes once round each intruder, then on."),
}


def outcome_words(state: str, code: str) -> tuple[str, str, str]:
    """Icon, role and word, in English, of a task or run in `state` whose reason has the `code`."""
    if state == "FAILED" and code == Code.TASK_PLACE_UNSURE:
        return UNSURE_THERE
    return STATES.get(state, STATES["IDLE"])


def phase_words(phase: str) -> str:
    """What a task does in that phase of `TaskStatus`, in the language of the glass; one that is not known stays as the robot has it."""
    return tr(PHASES[phase]) if phase in PHASES else phase


def title(order: TaskOrder) -> str:
    """An order in a few words, as in `Deliver: Office 12 → Lab`."""
    words = TASKS.get(order.task)
    name = words.name if words else order.task or tr("No task")
    places = [place for place in order.places if place]
    if order.task == "follow_heading":
        return f"{name} {heading_of(order.heading)}"
    if order.task == "take_off" and math.isfinite(order.height):
        return tr("{task} to {height}").format(task=name, height=_metres(order.height))
    if order.task == "hold" and math.isfinite(order.duration):
        return tr("{task} for {span}").format(task=name, span=span_words(order.duration))
    if order.task == "go_to" and places:
        return f"{name} {places[0]}"
    if not places:
        return name
    shown = (
        places
        if len(places) <= 3
        else [places[0], tr("{count} more").format(count=len(places) - 2), places[-1]]
    )
    return f"{name}: {' → '.join(shown)}"


def lacking(order: TaskOrder, mission: Mission | None = None) -> str:
    """What is missing before the order can be given, as one sentence; empty when nothing is."""
    places = order.places
    if order.task == "patrol" and not places and mission is not None and not mission.waypoints:
        return tr("The mission has no points: set some on the map, or choose places here.")
    if order.task == "deliver":
        start, end = [*places, "", ""][:2]
        if not start or not end:
            return tr(NEEDS["deliver"][0 if not start else 1][1])
        if start == end:
            return tr("It cannot bring from {start} to {end}: choose two places.").format(
                start=start, end=end
            )
        return ""
    for least, sentence in NEEDS.get(order.task, ()):
        if len([place for place in places if place]) < least and not order.goals:
            return tr(sentence)
    return "" if order.task in TASKS else tr("Choose a task.")


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
        "dock": lambda: _docks(order, robot),
        "undock": lambda: tr("Backs out of its dock and stands before it."),
    }
    says |= {
        "hold": lambda: _holds(order, robot),
        "follow_heading": lambda: _follows(order, robot),
        "take_off": lambda: _takes_off(order),
        "land": lambda: tr("Lands on the ground below."),
        "surface": lambda: tr("Swims up to the surface and stays there."),
        "go_home": lambda: tr("Goes home and stays there."),
    }
    if order.task in says:
        return says[order.task]()
    goal = order.places[0] if order.places else tr("the goal")
    return tr("Goes to {goal} and stays there.").format(goal=goal)


def _how_long(order: TaskOrder) -> str:
    return (
        tr("for {span}").format(span=span_words(order.duration))
        if math.isfinite(order.duration)
        else tr("until you stop it")
    )


def _holds(order: TaskOrder, robot: RobotInfo) -> str:
    return f"{tr(robot.holds or HOLDS)}{_at_height(order, robot)} {_how_long(order)}."


def _follows(order: TaskOrder, robot: RobotInfo) -> str:
    towards = tr("where it points now") if math.isnan(order.heading) else heading_of(order.heading)
    pace = tr(" at {speed}").format(speed=_pace(order.speed)) if math.isfinite(order.speed) else ""
    if math.isfinite(order.throttle):
        pace = tr(" with {throttle:.0f} % throttle").format(throttle=order.throttle * 100)
    return tr("{moves} straight towards {towards}{pace}{height} {time}.").format(
        moves=tr(robot.moves or MOVES),
        towards=towards,
        pace=pace,
        height=_at_height(order, robot),
        time=_how_long(order),
    )


def _takes_off(order: TaskOrder) -> str:
    if math.isfinite(order.height):
        return tr("Takes off to {height} and hovers there.").format(height=_metres(order.height))
    return tr("Takes off and hovers there.")


def _metres(height: float) -> str:
    """A height that was ordered, to the centimetre, in the operator's unit."""
    if quantities.system != "imperial":
        return f"{height:g} m"
    told = said(height, "height", 2)
    return f"{told.text} {told.unit}"


def _pace(speed: float) -> str:
    """A speed in the operator's unit."""
    told = said(speed, "speed", 1)
    return f"{told.text} {told.unit}"


def _at_height(order: TaskOrder, robot: RobotInfo) -> str:
    if not math.isfinite(order.height):
        return ""
    words = tr(", {height} deep,") if robot.dives else tr(", {height} high,")
    return words.format(height=_metres(abs(order.height)))


def _patrols(order: TaskOrder, mission: Mission) -> str:
    count = len(order.places) or len(mission.waypoints)
    what = _listed(order.places) if order.places else trn("{count} point", "{count} points", count)
    laps = trn(", {count} lap", ", {count} laps", mission.laps) if mission.laps else tr(", until you stop it")
    how = {
        "loop": tr("in order"),
        "random": tr("in any order"),
        "intermittent": tr("with {dwell:g} s at each").format(dwell=mission.dwell),
    }
    react = "stop" if mission.stop_on_intruder else mission.on_intruder or "report"
    return tr("Visits {what} {motion}{laps}. {react}").format(
        what=what, motion=how.get(mission.motion, mission.motion), laps=laps, react=tr(REACTS.get(react, ""))
    )


def _delivers(order: TaskOrder) -> str:
    start, end, then = [*order.places, "", "", ""][:3]
    who = (
        tr("a tap here or the addressee's tag")
        if order.recipient_tag
        else tr("a tap here or the tag of the place")
    )
    after = tr(" Then goes on to {then}.").format(then=then) if then else ""
    sentence = tr("Fetches at {start}, brings it to {end}; waits at each for {who}.")
    return sentence.format(start=start, end=end, who=who) + after


def _guides(order: TaskOrder, follows: bool) -> str:
    names = [place for place in order.places if place]
    if not follows:
        blind = tr("Does not wait: it has no sensor for followers.")
        return tr("Leads a person to {names} and reads out the notes. {blind}").format(
            names=_listed(names), blind=blind
        )
    return tr("Leads a person to {names}, waits when no one follows, and reads out the notes.").format(
        names=_listed(names)
    )


def _docks(order: TaskOrder, robot: RobotInfo) -> str:
    dock = order.places[0] if order.places else tr("its dock")
    limited = math.isfinite(order.charge_to)
    if robot.flies:
        words = LANDS_AND_CHARGES
    elif (robot.moves or MOVES) == MOVES:
        words = DRIVES_AND_CHARGES
    else:
        words = GOES_AND_CHARGES
    verb, share = tr(robot.moves or MOVES), order.charge_to * 100
    return tr(words[limited]).format(moves=verb, places=dock, share=share)


def _listed(names: Sequence[str]) -> str:
    """As in `A, B and C`."""
    if len(names) == 1:
        return names[0]
    return tr("{names} and {last}").format(names=", ".join(names[:-1]), last=names[-1])


def heading_of(yaw: float) -> str:
    """A yaw [rad] as the heading that people steer by, as in `090°`; `ahead` for NaN."""
    if not math.isfinite(yaw):
        return tr("ahead")
    return f"{round(90 - math.degrees(yaw)) % 360:03d}°"


def span_words(seconds: float) -> str:
    """A length of time [s] in words, as in `1 h 30 min`; a dash for NaN."""
    if not math.isfinite(seconds):
        return "—"
    if seconds < 60:
        return tr("{seconds:.0f} s").format(seconds=seconds)
    minutes = round(seconds / 60)
    if minutes < 60:
        return tr("{minutes} min").format(minutes=minutes)
    hours, minutes = divmod(minutes, 60)
    if hours < 24:
        return tr("{hours} h {minutes} min" if minutes else "{hours} h").format(hours=hours, minutes=minutes)
    days, hours = divmod(hours, 24)
    return tr("{days} d {hours} h" if hours else "{days} d").format(days=days, hours=hours)


def distance_words(metres: float) -> str:
    """A distance [m] in words; a dash for NaN."""
    if not math.isfinite(metres):
        return "—"
    told = said(metres, "distance")
    return f"{told.text} {told.unit}"


def rhythm(task: ScheduledTask) -> str:
    """When a scheduled task starts, as in `22:00, Mon to Fri`."""
    if not task.at:
        return tr("every {span}").format(span=span_words(task.every))
    days = [index for index, on in enumerate(task.days) if on]
    if len(days) == 7:
        return tr("{at}, every day").format(at=task.at)
    if not days:
        return tr("{at}, on no day").format(at=task.at)
    if len(days) > 2 and days == list(range(days[0], days[-1] + 1)):
        words = tr("{at}, {first} to {last}")
        return words.format(at=task.at, first=tr(DAYS[days[0]]), last=tr(DAYS[days[-1]]))
    return f"{task.at}, {', '.join(tr(DAYS[day]) for day in days)}"
