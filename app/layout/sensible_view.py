"""View of a robot that nobody made a layout for, from its topics alone: what one drives by first, then what else it tells.

Which widget a topic gets is for `widgets.fitting` to say; here is only what comes first, and where it goes.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from app.layout.panel_grid import COLUMNS, FORMS, ROWS, Place, clamped, free_place, height_of
from app.layout.views import Panel, View
from app.link.capabilities import Capabilities
from bridge.core.topics import TOPICS
from bridge.msgs import TYPES, Msg
from widgets.core.language import mark
from widgets.fitting import COMMAND, FIGURE, INSTRUMENT, PICTURE, PLOT, TREE, Offer, offers

__all__ = ["MAX_PANELS", "TITLE", "panel_of", "sensible_view", "tiled"]

TITLE = mark("Overview")
"""Of the view."""
MAX_PANELS = 12
"""More than these are no overview; the others can be added by hand."""
MAX_OF_A_TYPE = 2
"""Panels for topics of one type, as of two cameras."""
_MACHINERY = (
    *("rosgraph_msgs/Log", "rosgraph_msgs/Clock", "rcl_interfaces/Log", "rcl_interfaces/ParameterEvent"),
    *("tf2_msgs/TFMessage", "tf/tfMessage", "sensor_msgs/CameraInfo", "sensor_msgs/PointCloud2"),
    *("sensor_msgs/Image", "dynamic_reconfigure/Config", "dynamic_reconfigure/ConfigDescription"),
    *("bond/Status", "std_msgs/Header", "theora_image_transport/Packet", "statistics_msgs/MetricsMessage"),
)
"""Types by which programs talk to each other, or that no widget draws."""
_MACHINERY_NAMES = ("rosout", "robot_description", "client_count", "connected_clients", "parameter_events")
"""Last names of topics by which programs talk to each other, whatever their types."""
_FIRST = (
    *("sensor_msgs/CompressedImage", "nav_msgs/OccupancyGrid", "sensor_msgs/LaserScan", "sensor_msgs/Imu"),
    *("sensor_msgs/BatteryState", "nav_msgs/Odometry", "sensor_msgs/NavSatFix"),
    *("geometry_msgs/PoseWithCovarianceStamped", "diagnostic_msgs/DiagnosticArray"),
)
"""What one steers and watches a robot by, in the order in which it is looked for."""
_BY_HAND: Mapping[str, tuple[Offer, ...]] = {
    "nav_msgs/Odometry": (
        Offer("Readout", FIGURE, "twist.twist.linear.xy", mark("Speed"), "m/s", digits=2, size=(2, 2)),
        # no heading: wheels know no north
        Offer("TurnTape", INSTRUMENT, title=mark("Turn"), size=(4, 3)),
    ),
    # the map says it better than two long figures
    "sensor_msgs/NavSatFix": (),
}
"""Types of which a robot's driver wants other than what fits best."""
_WITH_MAP = ("/pose", "/scan", "/plan")
"""Our names of what a map shows beside its cells."""
_INPUTS = ("cmd", "command", "set", "goal", "initialpose", "teleop", "joy")
"""Parts of the names of topics that a robot listens to; they tell nothing."""
_GROWS = (PICTURE, TREE, PLOT)
_STICK = Offer("Joystick", COMMAND, size=(3, 5))


@dataclass(frozen=True)
class _Choice:
    topic: str
    offer: Offer
    also: tuple[str, ...] = ()


def sensible_view(capabilities: Capabilities, learned: Mapping[str, type[Msg]] | None = None) -> View:
    """Panels for a robot that offers this; `learned` are classes of types that this app did not know, by their ROS 1 names.

    A stick is among them where the robot takes drive commands. Without any topic the view is empty.
    """
    chosen: list[_Choice] = []
    for topic in _ordered(capabilities):
        kind = capabilities.topics[topic]
        if sum(capabilities.topics[one.topic] == kind for one in chosen if one.topic) >= MAX_OF_A_TYPE:
            continue
        also = _beside(capabilities, topic) if kind == "nav_msgs/OccupancyGrid" else ()
        chosen += [_Choice(topic, offer, also) for offer in _offers(topic, kind, learned or {})]
    room = MAX_PANELS - (capabilities.drive is not None)
    chosen = chosen[:room]
    if capabilities.drive is not None and chosen:
        chosen.insert(min(2, len(chosen)), _Choice("", _STICK))
    placed = {form: tiled([(one.offer.size, _growth(one.offer)) for one in chosen], form) for form in FORMS}
    return View(
        TITLE,
        tuple(
            panel_of(one.topic, one.offer, one.also, {form: placed[form][place] for form in FORMS})
            for place, one in enumerate(chosen)
        ),
    )


def panel_of(
    topic: str, offer: Offer, also: tuple[str, ...] = (), places: Mapping[str, Place] | None = None
) -> Panel:
    """The panel that shows a topic as offered; `places` by the form of the window, without which it is arranged automatically."""
    cells = {form: tuple(place) for form, place in (places or {}).items()}
    return Panel(
        offer.widget,
        topic,
        also,
        offer.field,
        offer.title,
        offer.unit,
        offer.factor,
        min(offer.digits, 6),
        **cells,  # type: ignore[arg-type]  # the keys are the forms
    )


def _ordered(capabilities: Capabilities) -> list[str]:
    """Topics that are shown, those that one steers by first; of several of a type what stands for ours, then by name."""
    known = {capabilities.source(entry.name) for entry in TOPICS if entry.to == "handheld"}

    def rank(topic: str) -> tuple[int, bool, str]:
        kind = capabilities.topics[topic]
        return (_FIRST.index(kind) if kind in _FIRST else len(_FIRST), topic not in known, topic)

    shown = [
        topic
        for topic, kind in capabilities.topics.items()
        if kind not in _MACHINERY
        and topic != capabilities.drive
        and not _is_machinery(topic)
        and not _is_input(topic)
    ]
    return sorted(shown, key=rank)


def _is_machinery(topic: str) -> bool:
    """It is by its name for programs: one of the usual ones, or hidden as ROS 2 hides them."""
    names = topic.split("/")
    return names[-1] in _MACHINERY_NAMES or any(name.startswith("_") for name in names)


def _is_input(topic: str) -> bool:
    """The robot listens to it: by our table, or by its name."""
    known = next((entry for entry in TOPICS if entry.name == topic), None)
    if known is not None:
        return known.to == "robot"
    return any(part in _INPUTS for part in topic.replace("_", "/").split("/"))


def _offers(topic: str, kind: str, learned: Mapping[str, type[Msg]]) -> Sequence[Offer]:
    if kind in _BY_HAND:
        return _BY_HAND[kind]
    made = learned.get(kind) or TYPES.get(kind)
    found = offers(made or kind, topic, commanded=False)
    return [next(one for one in found if one.kind != COMMAND)]


def _beside(capabilities: Capabilities, topic: str) -> tuple[str, ...]:
    """What a map shows with its cells."""
    found = (capabilities.source(name) for name in _WITH_MAP)
    return tuple(name for name in found if name and name != topic and name in capabilities.topics)


def _growth(offer: Offer) -> bool | None:
    """It is worth more room before others are, True, or none at all, None: one figure in a tall box looks empty."""
    return None if offer.kind == FIGURE else offer.kind in _GROWS


def tiled(sizes: Iterable[tuple[tuple[int, int], bool | None]], form: str) -> list[Place]:
    """A place for each size on the grid of that form, row by row, without overlap; what is left free, they grow into.

    `sizes` are for a tablet, each with whether it is worth more room before others are; None for one that keeps its size.
    """
    wanted = list(sizes)
    places: list[Place] = []
    for size, _ in wanted:
        places.append(free_place(_sized(size, form), places, form))
    for favoured in (True, False):
        grown = [
            number for number, (_, grows) in enumerate(wanted) if grows or (grows is False and not favoured)
        ]
        turns = [True]
        while any(turns):
            turns = [_grow(places, number, form) for number in grown]
    return places


def _sized(size: tuple[int, int], form: str) -> tuple[int, int]:
    """A tablet's size on the grid of another form: a phone's columns are as many for half the width, its rows fewer."""
    width, height = size
    if form == "tall":
        width, height = (COLUMNS[form] if width >= 4 else 3 if width == 3 else 2), min(height, 4)
    if form == "short":
        height = max(2, min(height, ROWS[form], round(height * 0.75)))
    return width, height


def _grow(places: list[Place], number: int, form: str) -> bool:
    """Make a place one row higher, or one column wider, where nothing is; whether it was."""
    place = places[number]
    bottom = max(ROWS[form], height_of(places))
    for more in (place._replace(height=place.height + 1), place._replace(width=place.width + 1)):
        if more.bottom > bottom or clamped(more, form) != more:
            continue
        if not any(more.overlaps(other) for index, other in enumerate(places) if index != number):
            places[number] = more
            return True
    return False
