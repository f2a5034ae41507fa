"""The record of a kind of vehicle: how it goes, brakes, drifts and is made safe, and its words and icon.

    KIND = VehicleKind(name="hovercraft", description="Hovercraft", moves="Hovers", handling=Handling(0.3, 0.5, drifts=True))

Plain data, read by every room that treats kinds differently; none of them asks for the name of a kind.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

__all__ = ["Handling", "PursuitParameters", "SafeStateDefaults", "VehicleKind"]


@dataclass(frozen=True, slots=True)
class Handling:
    """The dynamics of a kind of robot, as its limits reckon with them."""

    braking: float
    """Deceleration that can be counted on, wet or dry, with any command [m/s2]."""
    turning: float
    """Angular deceleration likewise [rad/s2]."""
    sideways: bool = False
    """It can go in any direction, so that it may slide along a fence."""
    steers: bool = False
    """It turns only by going, in proportion to its speed."""
    drifts: bool = False
    """Nothing holds it where it stands: water carries it along, and so does its own way aside."""
    glide: float = 0.0
    """Distance in which drag alone reduces its way aside to 1/e [m]; 0 for one that brakes in all directions."""
    levelling: float = 1.0
    """Deceleration up and down that can be counted on [m/s2]."""


@dataclass(frozen=True, slots=True)
class PursuitParameters:
    """Parameters of pure pursuit along a path; the defaults are those of a robot that turns where it stands."""

    goal_tolerance: float = 0.1
    """A goal is reached within this distance [m]; the rest up to the promised 0.3 m is for the position's own error."""
    passed_tolerance: float = 0.22
    """A goal that gets farther away again within this distance is passed [m]."""
    lookahead: float = 0.5
    """Distance of the pursued point at rest [m]; it grows with the speed."""
    lookahead_time: float = 0.6
    """By so much time of the speed [s]."""
    deceleration: float = 0.5
    """Planned towards the goal [m/s2]."""
    min_speed: float = 0.12
    """On the way [m/s]."""
    lateral_acceleration: float = 0.5
    """Allowed in a bend [m/s2]."""


@dataclass(frozen=True, slots=True)
class SafeStateDefaults:
    """The safe state of a kind, unless the robot's configuration sets another one."""

    action: Literal["brake", "brake_straight", "hold_heading", "hold_depth", "hover"] = "brake"
    hold_for: float = math.inf
    """After so long without a driver `then` follows [s]."""
    then: Literal["stay", "surface", "land", "return"] = "stay"


@dataclass(frozen=True, slots=True, kw_only=True)
class VehicleKind:
    """All that differs between kinds of vehicles; each default is that of a robot on wheels that turns where it stands."""

    name: str
    """`kind` of `/robot/info`."""
    description: str
    """In plain words, as in `Surface boat`."""
    icon: str = "smart_toy_fill"
    """A name of `widgets.core.icons`."""
    moves: str = "Drives"
    """Verb that begins a sentence about its way."""
    holds: str = "Stands still where it is"
    """Words that begin a sentence about how it keeps its place."""
    order_fields: tuple[str, ...] = ("speed", "height")
    """Fields of a task's order that make sense for it, of speed, throttle and height. A height needs a `max_climb` too."""
    path_controller: Literal["differential", "lattice", "course"] = "differential"
    """How it follows a path: a key of `robotside.navigation.navigator.PATH_CONTROLLERS`."""
    pursuit: PursuitParameters = PursuitParameters()
    handling: Handling = Handling(braking=0.8, turning=2.5)
    """Its braking can be configured, since floors and loads differ."""
    safe_state: SafeStateDefaults = SafeStateDefaults()
    on_the_ground: bool = False
    """It drives by itself only while it sees its surroundings."""
    docks: Literal["", "front", "jetty", "pad", "cage"] = ""
    """How it comes to a charger: with its front up to it, with its bow afloat, down onto it, or swimming into it; empty for one that does not."""
    dives: bool = False
    """It keeps a depth, and may lie any way up."""
    flies: bool = False
    """It keeps a height, goes where it leans to, and has to be kept where it is."""
    comes_about: bool = False
    """It turns only by going, however slowly."""
    at_rest: tuple[float, float] = (0.01, 0.03)
    """Measured speeds below which it stands still [m/s, rad/s]: one that current, waves or wind carry never quite does."""
    astray: float = math.inf
    """Where it holds its place it comes back from farther away than this [m]."""
