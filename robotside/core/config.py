"""The robot's own configuration, `robot.toml`: limits, fence, safe state, database, names, and what is brought up.

Any mistake in it is one sentence that names the file, the setting, its value and what is allowed; a robot whose
limits cannot be read does not start. docs/robot.toml.example has every setting.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

import msgspec

from bridge.core.toml_files import MAX_BYTES, FileFault, fault, read

__all__ = [
    "BadConfig",
    "ChargingSettings",
    "Config",
    "DEFAULT_CONFIG",
    "ControlSettings",
    "DatabaseSettings",
    "GatewaySettings",
    "LimitSettings",
    "RobotSettings",
    "Ring",
    "SafeStateSettings",
    "ServeSettings",
    "TrustSettings",
    "load",
    "parse",
]

MAX_CORNERS = 200
"""Of one area of the fence."""
MAX_CORNERS_TOTAL = 1000
"""Of the whole fence, which is looked at with every drive command."""
MAX_AREAS = 50
"""Of each kind."""

Ring: TypeAlias = tuple[tuple[float, float], ...]
"""Corners of an area in `map` [m], in either direction, the first one not repeated."""

_Above = Annotated[float, msgspec.Meta(gt=0.0)]
_NotBelow = Annotated[float, msgspec.Meta(ge=0.0)]
_Share = Annotated[float, msgspec.Meta(gt=0.0, le=1.0)]
_Clearance = Annotated[float, msgspec.Meta(ge=0.02, le=0.5)]
_Grip = Annotated[float, msgspec.Meta(ge=0.05, le=1.5)]
_Degrees = Annotated[float, msgspec.Meta(gt=0.0, le=90.0)]
_Port = Annotated[int, msgspec.Meta(ge=0, le=65535)]
_Rate = Annotated[float, msgspec.Meta(gt=0.0, le=50.0)]
_Name = Annotated[str, msgspec.Meta(min_length=1, max_length=40)]


_GATEWAY = re.compile("[a-z][a-z0-9_]{0,39}")


class BadConfig(Exception):
    """The configuration cannot be used; the text is one sentence."""


class _Section(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Settings that belong together."""


class RobotSettings(_Section, frozen=True):
    """`[robot]`: who it is."""

    name: _Name | None = None
    """What people call it; None for the robot's own."""


class LimitSettings(_Section, frozen=True):
    """`[limits]`: how fast and where it may go. None is no limit beside the robot's own."""

    max_speed: _Above | None = None
    """Along any direction [m/s]."""
    max_yaw_rate: _Above | None = None
    """Either way [rad/s]."""
    min_depth: _NotBelow | None = None
    """Positive down from the surface [m]."""
    max_depth: _Above | None = None
    """Positive down from the surface [m]."""
    max_height: _Above | None = None
    """Above the map's origin [m]."""
    max_slope_degrees: _Degrees | None = None
    """Of the ground, as the robot's own tilt measures it [deg]."""
    braking: _Above | None = None
    """Deceleration that can be counted on [m/s2]; None for that of the robot's kind."""
    grip: _Grip | None = None
    """Friction coefficient of the ground that a robot drives on; None for one that is not known: the kind's own braking and bends count."""
    clearance: _Clearance | None = None
    """Kept at least between the body and anything on ways of its own [m]; None for that of the robot's kind."""
    keep_in: tuple[Ring, ...] = ()
    """The robot stays in at least one of these; none for everywhere."""
    keep_out: tuple[Ring, ...] = ()
    """It never enters one of these; within one of `keep_in` it is a hole."""
    floor: float | None = None
    """Of the fence: it goes no deeper, above the map's origin, negative under water [m]. Taking off and landing pass it."""
    ceiling: float | None = None
    """Of the fence: it goes no higher [m]."""

    @property
    def lowest(self) -> float:
        """At which it may be, by all that is set, above the map's origin [m]; infinite for none."""
        deepest = -self.max_depth if self.max_depth is not None else -math.inf
        return max(deepest, self.floor if self.floor is not None else -math.inf)

    @property
    def highest(self) -> float:
        """Likewise; a least depth is a ceiling below the surface [m]."""
        told = (self.max_height, self.ceiling, None if self.min_depth is None else -self.min_depth)
        return min((end for end in told if end is not None), default=math.inf)


class SafeStateSettings(_Section, frozen=True):
    """`[safe_state]`: what it does when the link or the driver is lost. None is what its kind does."""

    action: Literal["brake", "brake_straight", "hold_heading", "hold_depth", "hover"] | None = None
    """At once."""
    hold_for: _NotBelow | None = None
    """How long it holds depth, heading or place before `then` [s]."""
    then: Literal["stay", "surface", "land", "return"] | None = None
    """Afterwards."""


class ControlSettings(_Section, frozen=True):
    """`[control]`: what the settings are until an operator changes them."""

    follow_link: bool = True
    """The speed falls with the driver's link."""
    lost_link_stops_task: bool = False
    """A task is paused when the handheld of who has control is lost."""
    unmeasured_link_speed: _Share = 0.5
    """Share of the full speed at most for a driver over a link whose round trip is not known; operators cannot change it."""


class ChargingSettings(_Section, frozen=True):
    """`[charging]`: when the robot charges by itself."""

    by_itself: bool = True
    """With a low battery a task goes to a dock first, where there is one, and then goes on."""
    until: Annotated[float, msgspec.Meta(ge=0.2, le=1.0)] = 0.8
    """It goes on with this share of a full battery."""


class DatabaseSettings(_Section, frozen=True):
    """`[database]`: where places, missions, history and settings are kept."""

    url: str | None = None
    """As SQLAlchemy writes it, as in `postgresql+psycopg://robot@db/patrol`; None for a SQLite file beside the state."""
    backups: Annotated[int, msgspec.Meta(ge=0, le=100)] = 5
    """Of a SQLite file, as many are kept."""


class TrustSettings(_Section, frozen=True):
    """`[trust]`: who may do what without having been paired."""

    local_role: Literal["none", "watch", "drive", "manage"] = "manage"
    """Of programs on the robot's own computer that show no key."""
    stop_role: Literal["none", "watch", "drive", "manage"] = "none"
    """Who may press STOP."""
    stop_from_pages: bool = True
    """Every web page that a browser in the network shows may press STOP."""


class ServeSettings(_Section, frozen=True):
    """`[serve]`: which robot is brought up, and where. None is what `serve` does by itself."""

    robot: str | None = None
    """As `--robot` has it, as in `sim:patrol` or `ros:ws://192.168.1.7:9090`."""
    world: str | None = None
    """Of simulated robots; a name or a file."""
    payloads: tuple[str, ...] = ()
    """Extra payloads of the only simulated robot."""
    without: tuple[str, ...] = ()
    """Payloads that are off from the start, by the keys of the table of payloads."""
    host: str | None = None
    """Address to listen on."""
    port: _Port | None = None
    """Of the rosbridge socket."""
    http_port: _Port | None = None
    """Of the web site."""
    pair: bool = False
    """A start with nobody paired opens pairing."""


class GatewaySettings(_Section, frozen=True):
    """`[gateways.NAME]`: one gateway and how it is reached."""

    on: bool = True
    """It is brought up; one that is not keeps what is said about it."""
    url: str = ""
    """As `--gateway` has it; empty for its usual one."""
    user: str = ""
    """At a broker; in place of one in the URL."""
    password: str = ""
    role: Literal["none", "watch", "drive"] | None = None
    """Of who shows no token; in place of one in the URL."""
    payloads: tuple[str, ...] = ()
    """What is carried; empty for what the URL says."""
    rate: _Rate | None = None
    """Most messages a second of each topic [Hz]; in place of one in the URL."""


class Config(_Section, frozen=True):
    """All that the file says; without a file, all that it leaves out."""

    robot: RobotSettings = RobotSettings()
    limits: LimitSettings = LimitSettings()
    safe_state: SafeStateSettings = SafeStateSettings()
    control: ControlSettings = ControlSettings()
    charging: ChargingSettings = ChargingSettings()
    database: DatabaseSettings = DatabaseSettings()
    trust: TrustSettings = TrustSettings()
    serve: ServeSettings = ServeSettings()
    gateways: dict[str, GatewaySettings] = {}


class _Named(msgspec.Struct, frozen=True):
    """The gateways of a file, whatever is said of them."""

    gateways: dict[str, Any] = {}


DEFAULT_CONFIG = Config()
"""The configuration without a file."""


def load(path: Path) -> Config:
    """The configuration of a file; BadConfig when it cannot be read or used."""
    try:
        if path.stat().st_size > MAX_BYTES:
            raise BadConfig(f"{path}: a settings file has at most {MAX_BYTES:,} bytes.")
        return parse(path.read_bytes().decode(), str(path))
    except OSError as error:
        why = (error.strerror or str(error)).lower()
        raise BadConfig(f"The settings cannot be read from {str(path)!r}: {why}.") from error
    except UnicodeDecodeError as error:
        raise BadConfig(f"{path}: the file is no UTF-8 text.") from error


def parse(text: str, name: str = "robot.toml") -> Config:
    """The configuration of a `text`; BadConfig, whose sentence begins with `name`, when it cannot be used."""
    try:
        _check_gateways(text, name)
        config = read(text, Config, name, largest=math.inf)
    except FileFault as found:
        raise BadConfig(_sentence(found, name)) from found
    problem = _limits_problem(config.limits)
    if problem:
        raise BadConfig(f"{name}: {problem}")
    return config


def _check_gateways(text: str, name: str) -> None:
    """FileFault for a mistake in the table of a gateway; the words of its name are lost to who reads the file as a whole."""
    for key in read(text, _Named, name, largest=math.inf).gateways:
        if not _GATEWAY.fullmatch(key):
            raise fault(text, name, f"gateways.{key}", "is no name of a gateway")
        one = msgspec.defstruct("One", [("table", GatewaySettings)], rename={"table": key})
        read(text, msgspec.defstruct("All", [("gateways", one)]), name, largest=math.inf)


def _sentence(found: FileFault, name: str) -> str:
    """The mistake in the file of that `name`, in the words of its sections."""
    section, _, key = found.where.rpartition(".")
    if found.known:
        return f"{name}: {section or 'the file'} has no {key!r}; there are {', '.join(found.known)}."
    return f"{name}: {found.where} {found.reason}." if found.where else str(found)


def _limits_problem(limits: LimitSettings) -> str:
    least, most = limits.min_depth, limits.max_depth
    if least is not None and most is not None and least >= most:
        return f"limits.min_depth must be less than max_depth, {most:g} m, not {least:g} m."
    if not limits.lowest < limits.highest:
        low, high = limits.lowest, limits.highest
        return f"the fence's floor must be below its ceiling, {high:g} m, not at {low:g} m, depths included."
    for name, rings in (("keep_in", limits.keep_in), ("keep_out", limits.keep_out)):
        if len(rings) > MAX_AREAS:
            return f"limits.{name} has {len(rings)} areas; at most {MAX_AREAS} are allowed."
        for number, ring in enumerate(rings, 1):
            problem = _ring_problem(ring)
            if problem:
                return f"area {number} of limits.{name} {problem}."
    corners = sum(map(len, (*limits.keep_in, *limits.keep_out)))
    if corners > MAX_CORNERS_TOTAL:
        return f"the fence has {corners} corners; at most {MAX_CORNERS_TOTAL} are allowed."
    return ""


def _ring_problem(ring: Ring) -> str:
    """Why `ring` encloses nothing that could be kept to, as the end of a sentence; empty when it does."""
    if not 3 <= len(ring) <= MAX_CORNERS:
        return f"must have 3 to {MAX_CORNERS} corners, not {len(ring)}"
    sides = list(zip(ring, (*ring[1:], ring[0]), strict=True))
    for number, (start, end) in enumerate(sides, 1):
        if start == end:
            return f"has its corner {number}, ({start[0]:g}, {start[1]:g}), twice in a row"
    for first, one in enumerate(sides):
        for second in range(first + 2, len(sides)):
            if (first, second) != (0, len(sides) - 1) and _cross(one, sides[second]):
                return f"crosses itself: its side {first + 1} and its side {second + 1} meet"
    if abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in sides)) < 1e-6:
        return "has no inside: its corners lie on one line"
    return ""


_Point: TypeAlias = tuple[float, float]
_Side: TypeAlias = tuple[_Point, _Point]


def _cross(one: _Side, other: _Side) -> bool:
    """Two sides have a point in common."""
    (a, b), (c, d) = one, other
    turns = _turn(a, b, c), _turn(a, b, d), _turn(c, d, a), _turn(c, d, b)
    if turns[0] != turns[1] and turns[2] != turns[3]:
        return True
    return any(
        turn == 0
        and min(p[0], q[0]) <= r[0] <= max(p[0], q[0])
        and min(p[1], q[1]) <= r[1] <= max(p[1], q[1])
        for turn, (p, q, r) in zip(turns, ((a, b, c), (a, b, d), (c, d, a), (c, d, b)), strict=True)
    )


def _turn(a: _Point, b: _Point, c: _Point) -> int:
    """1 when a, b, c turn to the left, -1 to the right, 0 on one line."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (area > 0) - (area < 0)
