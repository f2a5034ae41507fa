"""Offers of the panels screen: which widgets fit each topic of the robot, which controls there are, and how a panel is called."""

from __future__ import annotations

from app.layout.layout_tables import SLIDER
from app.layout.sensible_view import panel_of
from app.layout.view_checks import is_signal
from app.layout.views import Panel
from app.link.capabilities import Capabilities
from bridge.core.topics import TOPICS
from widgets.core.language import mark, tr, within
from widgets.fitting import COMMAND, Offer, offers

__all__ = [
    "CONTROLS",
    "Offer",
    "control_panel",
    "offer_name",
    "offers_for",
    "panel_of",
    "shown_topics",
    "title_of",
    "widget_name",
]

MAX_OFFERS = 12
"""Ways to show one topic; any other field is set in the inspector."""
CONTROLS = (
    ("Joystick", mark("Stick")),
    ("LiftLever", mark("Lever")),
    ("DPad", mark("Arrow pad")),
    ("TiltCircle", mark("Tilt")),
    (SLIDER, mark("Speed limit")),
)
"""Controls that drive, with their names."""
_NAMES = {
    **dict(CONTROLS),
    "AckermannView": mark("Steering"),
    "ActionColumn": mark("Action buttons"),
    "ArmPanel": mark("Arm"),
    "ArtificialHorizon": mark("Horizon"),
    "Battery": mark("Battery"),
    "CheckList": mark("Check list"),
    "CommandedMotion": mark("Commanded motion"),
    "Compass": mark("Compass"),
    "CourseDial": mark("Course dial"),
    "DepthGauge": mark("Depth gauge"),
    "DiagnosticsTree": mark("Diagnostics tree"),
    "EncodersView": mark("Encoders"),
    "EventLog": mark("Event log"),
    "FieldView": mark("Message"),
    "GeoMap": mark("Geographic map"),
    "GoalPad": mark("Goal pad"),
    "GridMap": mark("Grid map"),
    "HeadingTape": mark("Heading tape"),
    "HeightTape": mark("Height tape"),
    "IntruderBadge": mark("Intruder badge"),
    "Lamp": mark("Lamp"),
    "LaserScanView": mark("Laser scan"),
    "LegPanel": mark("Leg panel"),
    "LineSensorView": mark("Line sensor"),
    "LinkQuality": mark("Link quality"),
    "MomentaryButton": mark("Momentary button"),
    "Plot": mark("Plot"),
    "Readout": mark("Figure"),
    "RollPitch": mark("Roll and pitch"),
    "RotorSpeeds": mark("Rotor speeds"),
    "RudderThrottle": mark("Rudder and throttle"),
    "SonarRingView": mark("Sonar ring"),
    "TaskCard": mark("Task card"),
    "TickBox": mark("Tick box"),
    "ToggleSwitch": mark("Toggle switch"),
    "TurnTape": mark("Turn tape"),
    "UltrasoundView": mark("Ultrasound"),
    "Video": mark("Video"),
}
"""Widgets of panels to what people call them."""
_COMMANDS = frozenset(entry.name for entry in TOPICS if entry.to != "handheld")
"""Topics that the robot listens to."""


def offers_for(topic: str, kind: str, *, sends: bool = False) -> list[Offer]:
    """Widgets for a topic of that type (its ROS 1 name), best first, at least one.

    What commands is no panel of a topic, but where it `sends`: then its switches and buttons come first.
    """
    told = (
        [one for one in offers(kind, topic, commanded=True) if one.kind == COMMAND and is_signal(one.widget)]
        if sends
        else []
    )
    shown = [one for one in offers(kind, topic, commanded=False) if one.kind != COMMAND]
    return [*told, *shown][:MAX_OFFERS]


def shown_topics(offer: Capabilities) -> list[tuple[str, str]]:
    """Names and types of the topics that a robot has and may publish, by name."""
    return sorted((name, kind) for name, kind in offer.topics.items() if name not in _COMMANDS)


def control_panel(widget: str) -> Panel:
    """The panel with that control."""
    if widget == "LiftLever":
        return Panel(widget, forward="climb", left="", pad="")
    return Panel(widget, pad="right" if widget == "TiltCircle" else "left")


FIELDS = (mark("Pressed"),)
"""Titles that our own robots' fields give a panel."""


def widget_name(widget: str) -> str:
    """A widget as people call it: `LaserScanView` is `Laser scan`."""
    if widget in _NAMES:
        return tr(_NAMES[widget])
    spaced = "".join(f" {letter.lower()}" if letter.isupper() else letter for letter in widget).strip()
    return spaced.removesuffix(" view").capitalize()


def offer_name(offer: Offer) -> str:
    """What an offer shows and how, as in `Linear x · plot`."""
    name = widget_name(offer.widget)
    return f"{tr(offer.title)} · {within(name)}" if offer.field and offer.title else name


def title_of(panel: Panel, *, brief: bool = False) -> str:
    """What stands over a panel: its title or its widget's name, and unless it shall be `brief` the topic."""
    own = tr(panel.title) if panel.title else widget_name(panel.widget)
    return own if brief or not panel.topic else f"{own} · {panel.topic}"
