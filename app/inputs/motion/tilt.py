"""From how a tablet is tilted to what it commands: neutral where the clutch closed, a dead zone, a curve, no wobble, no leaps.

tilt = Tilt(TiltSettings())
tilt.feed(t, gravity)              # as it comes, in axes of the screen
tilt.press(now)                    # the thumb comes down; tilt.release() when it goes
right, ahead = tilt.update(now)      # shares of full command, with each heartbeat

Nothing here knows of screens or clocks. The 1 € filter is Casiez, Roussel and Vogel's (CHI 2012).
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Self

from app.core.checked_settings import number, shown
from app.device.motion import GRAVITY, Axes
from widgets.core.language import tr

__all__ = ["Level", "OneEuro", "Tilt", "TiltSettings", "between", "shaped", "turned"]

Pair = tuple[float, float]
"""To the right and ahead: right side down, upper edge down."""

RANGES: Mapping[str, tuple[float, float]] = {
    "full": (15.0, 40.0),
    "dead": (2.0, 10.0),
    "walking_dead": (6.0, 14.0),
    "expo": (0.0, 0.8),
}
"""What may be set, least and most."""

MIN_CUT, BETA = 1.0, 0.007
"""Of the 1 € filter, on degrees [Hz]."""
SPAN, ENOUGH = 0.3, 3
"""Neutral is the mean of that [s], of at least so many samples."""
SILENCE_TIMEOUT = 0.3
"""Without a sample for so long the clutch opens [s]."""
OVER, TOO_LONG = 50.0, 0.5
"""Tilted by more than that [deg] for so long [s] it is no steering any more."""
ODD, FALL = 0.6 * GRAVITY, 0.3
"""That far from 1 g [m/s²] for so long [s] nobody holds it."""
RISES, FALLS = 1.0 / 0.4, 1.0 / 0.1
"""How fast a command grows and goes [1/s]."""
MAX_ACROSS = 0.75
"""The dead zone across a tilt is no more than so much of it, so that aslant is steered from the first degree on."""
CREEP_TIME = 5.0
"""So slowly [s] neutral follows the hand of one who walks, as long as that commands nothing."""


@dataclass(frozen=True, slots=True)
class TiltSettings:
    """What the operator chooses; angles in degrees, as they are told."""

    full: float = 25.0
    """At this tilt the command is full [deg]."""
    dead: float = 4.0
    """Below this tilt nothing is commanded [deg]."""
    walking_dead: float = 8.0
    """The same for one who walks [deg]."""
    walking: bool = False
    """The operator walks: the larger dead zone, and a neutral that follows the hand slowly."""
    expo: float = 0.4
    """How flat the curve is in its middle, 0 for straight."""
    invert_roll: bool = False
    invert_pitch: bool = False

    @property
    def zone(self) -> float:
        """The dead zone that counts [deg]."""
        return self.walking_dead if self.walking else self.dead

    @property
    def share(self) -> float:
        """The dead zone as a share of the way to full."""
        return self.zone / self.full

    @classmethod
    def of(cls, kept: object) -> tuple[Self, list[str]]:
        """Settings as they were kept, and a sentence for each that was no good and is as at first again."""
        known, faults = asdict(cls()), []
        given = kept if isinstance(kept, dict) else {}
        for name, usual in known.items():
            value = given.get(name, usual)
            if isinstance(usual, bool):
                good = isinstance(value, bool)
                allowed = tr("true or false")
            else:
                low, high = RANGES[name]
                good = number(value, low, high) is not None
                allowed = f"{low:g} to {high:g}"
            if good:
                known[name] = value
            else:
                faults.append(f"Tilt: {name} is {shown(value)} and must be {allowed}; it is {usual} now.")
        return cls(**known), faults

    def save(self) -> dict[str, Any]:
        """To keep."""
        return asdict(self)


def turned(axes: Axes, quarters: int) -> Axes:
    """From the device's axes to those of a screen that is turned by so many quarters, as `app.device.rotation` tells."""
    x, y, z = axes
    return ((x, y, z), (-y, x, z), (-x, -y, z), (y, -x, z))[quarters % 4]


def between(neutral: Axes, now: Axes) -> Pair:
    """How far the screen has been turned from `neutral` to `now`, both the up of gravity in its axes: roll and pitch [deg].

    They are the two parts of the one shortest turn, so that 30° are 30° whatever way the screen was held. Turning it round
    the vertical is not seen. NaN for what has no length.
    """
    up, seen = _unit(neutral), _unit(now)
    # what is to the right is the screen's x laid level; on a screen that stands on its side, its y tells
    right = _across((1.0, 0.0, 0.0), up)
    if math.hypot(*right) < 0.3:
        right = _cross(_across((0.0, 1.0, 0.0), up), up)
    right = _unit(right)
    ahead = _cross(up, right)
    aside, forth = -_dot(seen, right), -_dot(seen, ahead)
    length = math.hypot(aside, forth)
    angle = math.degrees(math.atan2(length, _dot(seen, up)))
    scale = angle / length if length > 1e-12 else 0.0
    return aside * scale, forth * scale


def shaped(roll: float, pitch: float, settings: TiltSettings) -> Pair:
    """What a tilt [deg] commands, to the right and ahead, together at most 1: nothing in the dead zone, flat behind it, full at `full`.

    Straight ahead and straight to the side have a dead zone of the same width across.
    """
    tilt = math.hypot(roll, pitch)
    x = (tilt - settings.zone) / (settings.full - settings.zone)
    if not x > 0.0:  # NaN too
        return 0.0, 0.0
    x = min(1.0, x)
    share = (1.0 - settings.expo) * x + settings.expo * x**3
    roll, pitch = _straightened(roll, pitch, settings.zone)
    tilt = math.hypot(roll, pitch)
    right = share * roll / tilt * (-1.0 if settings.invert_roll else 1.0)
    ahead = share * pitch / tilt * (-1.0 if settings.invert_pitch else 1.0)
    return right, ahead


def _straightened(roll: float, pitch: float, zone: float) -> Pair:
    """The same tilt [deg] with the dead zone across it too: the lesser part is nothing within `zone`, and whole where both are alike.

    A hand that walks and tilts ahead wobbles to the sides by as much as one that rests.
    """
    if abs(roll) > abs(pitch):
        pitch, roll = _straightened(pitch, roll, zone)
        return roll, pitch
    main = abs(pitch)
    dead = min(zone, MAX_ACROSS * main)
    left = main * max(0.0, abs(roll) - dead) / (main - dead)
    return math.copysign(left, roll), pitch


class Tilt:
    """One tablet. It commands nothing while its clutch is open, and a clutch that opened by itself stays open until it is let go.

    Everything in one thread; times are those of one clock [s].
    """

    def __init__(self, settings: TiltSettings | None = None) -> None:
        self.settings = settings or TiltSettings()
        """May be changed while it is open; a change opens it."""
        self.neutral: Axes | None = None
        """Where it is neutral, if that is set; None for wherever the clutch closes."""
        self.why = ""
        """Why the clutch opened by itself, as a sentence; empty once it is let go."""
        self._pressed = self._closed = False
        self._recent: deque[tuple[float, Axes]] = deque(maxlen=64)
        self._roll, self._pitch = OneEuro(MIN_CUT, BETA), OneEuro(MIN_CUT, BETA)
        self._heard = -math.inf
        self._open()

    def _open(self, why: str = "") -> None:
        self._closed = False
        self.why = why or self.why
        self._from: Axes | None = None
        self._tilt: Pair = 0.0, 0.0
        self._said: Pair = 0.0, 0.0
        self._far = self._odd = self._looked = self._turned = math.nan
        self._met = False

    # what is read

    @property
    def pressed(self) -> bool:
        """The thumb, the key or the switch is down."""
        return self._pressed

    @property
    def closed(self) -> bool:
        """It commands."""
        return self._closed

    @property
    def tilt(self) -> Pair:
        """Roll and pitch from neutral [deg], right side down and upper edge down; 0 while the clutch is open."""
        return self._tilt

    @property
    def at(self) -> Pair:
        """The same as shares of full command, together at most 1: where the circle is."""
        roll, pitch = self._tilt
        scale = max(self.settings.full, math.hypot(roll, pitch))
        return roll / scale, pitch / scale

    @property
    def up(self) -> Axes | None:
        """The mean of the last 0.3 s of gravity; None while there is none."""
        if not self._recent:
            return None
        x, y, z = (sum(one) / len(self._recent) for one in zip(*(up for _, up in self._recent), strict=True))
        return x, y, z

    # what comes in

    def feed(self, t: float, up: Axes) -> None:
        """Gravity, in axes of the screen, was that at `t`. What is no number is left out, and silence then opens the clutch."""
        if not all(math.isfinite(value) for value in (t, *up)) or not any(up):
            return
        self._heard = t
        self._recent.append((t, up))
        while self._recent[0][0] < t - SPAN:
            self._recent.popleft()
        if not self._closed:
            self._close()
        if self._from is not None:
            self._turn(t, up, self._from)

    def feel(self, t: float, a: Axes) -> None:
        """The acceleration, gravity included, was that: a tablet that falls weighs nothing."""
        if abs(math.hypot(*a) - GRAVITY) < ODD:
            self._odd = math.nan
        elif math.isnan(self._odd):
            self._odd = t
        elif self._closed and t - self._odd > FALL:
            self._open(tr("The tablet falls or is thrown about: it does not steer."))

    def press(self, now: float) -> None:
        """The clutch is pressed; it closes as soon as it is known where gravity is."""
        if self._pressed:
            return
        self._pressed, self.why = True, ""
        if now - self._heard <= SILENCE_TIMEOUT:
            self._close()

    def release(self) -> None:
        """It is let go: what `update` tells is zero from now on."""
        self._pressed = False
        self._open()
        self.why = ""

    def fail(self, why: str) -> None:
        """Something else opens the clutch, for a reason that is a sentence."""
        if self._pressed and not self.why:
            self._open(why)

    def update(self, now: float) -> Pair:
        """What it commands at `now`, to the right and ahead, shares of full command, together at most 1."""
        if self._pressed and not self.why and now - self._heard > SILENCE_TIMEOUT and self._closed:
            self._open(tr("The sensor is silent: the tablet does not steer."))
        if not self._closed:
            return 0.0, 0.0
        dt = now - self._looked
        self._looked = now
        wanted = shaped(*self._tilt, self.settings) if self._met else (0.0, 0.0)
        if dt > 0.0:
            self._said = _slew(self._said, wanted, dt)
        return self._said

    # how it is turned

    def _close(self) -> None:
        up = self.up
        if not self._pressed or self.why or up is None or len(self._recent) < ENOUGH:
            return
        self._closed, self._looked = True, self._recent[-1][0]
        self._turned = self._looked
        self._from = self.neutral or up
        self._met = self.neutral is None
        self._roll.reset()
        self._pitch.reset()

    def _turn(self, t: float, up: Axes, neutral: Axes) -> None:
        roll, pitch = between(neutral, up)
        dt, self._turned = max(0.0, t - self._turned), t
        self._tilt = self._roll(t, roll), self._pitch(t, pitch)
        tilt = math.hypot(*self._tilt)
        if tilt < self.settings.zone:
            self._met = True
            if self.settings.walking and self.neutral is None:
                self._from = _towards(neutral, up, min(1.0, dt / CREEP_TIME))
        if tilt < OVER:
            self._far = math.nan
        elif math.isnan(self._far):
            self._far = t
        elif t - self._far > TOO_LONG:
            self._open(tr("Tilted by more than {over:.0f}°: it does not steer.").format(over=OVER))


def _slew(said: Pair, wanted: Pair, dt: float) -> Pair:
    """As far towards what is wanted as it may go in `dt` [s]: back to the middle fast, away from it slowly."""
    right, ahead = (_near(old, new, dt) for old, new in zip(said, wanted, strict=True))
    return right, ahead


def _near(old: float, new: float, dt: float) -> float:
    if old * new < 0.0:  # through the middle: there and on
        back = abs(old) / FALLS
        return math.copysign(abs(old) - FALLS * dt, old) if dt < back else _near(0.0, new, dt - back)
    step = (FALLS if abs(new) < abs(old) else RISES) * dt
    return new if abs(new - old) <= step else old + math.copysign(step, new - old)


def _towards(neutral: Axes, up: Axes, share: float) -> Axes:
    x, y, z = (old + share * (new - old) for old, new in zip(neutral, up, strict=True))
    return x, y, z


class OneEuro:
    """The 1 € filter of one number: steady while it rests, quick while it moves."""

    def __init__(self, least: float, beta: float, slope: float = 1.0) -> None:
        """`least` is its cut-off at rest [Hz], `beta` how much that rises with speed [Hz per unit/s], `slope` the speed's own cut-off [Hz]."""
        self._least, self._beta, self._slope = least, beta, slope
        self.reset()

    def reset(self) -> None:
        """Begin anew with the next number."""
        self._t, self._x, self._speed = math.nan, math.nan, 0.0

    def __call__(self, t: float, x: float) -> float:
        """The number, filtered, at `t` [s]."""
        dt = t - self._t
        self._t = t
        if not dt > 0.0:
            self._x = x if math.isnan(self._x) else self._x
            return self._x
        self._speed += _weight(self._slope, dt) * ((x - self._x) / dt - self._speed)
        self._x += _weight(self._least + self._beta * abs(self._speed), dt) * (x - self._x)
        return self._x


def _weight(cut: float, dt: float) -> float:
    """Of a new number, by a low pass at `cut` [Hz]."""
    return 1.0 / (1.0 + 1.0 / (2.0 * math.pi * cut * dt))


class Level:
    """Gravity out of an accelerometer alone, for devices that have no gyroscope: slow, and slower while it is shaken."""

    LAG = 1.2
    """[s]"""

    def __init__(self) -> None:
        self._t = math.nan
        self._g: Axes | None = None

    def __call__(self, t: float, a: Axes) -> Axes:
        """Gravity at `t` [s], after the acceleration `a` [m/s²]."""
        dt, self._t = t - self._t, t
        if self._g is None:
            self._g = a
        if dt > 0.0:
            off = (math.hypot(*a) - GRAVITY) / 2.0
            weight = min(1.0, dt / (self.LAG * (1.0 + off * off) + dt))
            x, y, z = (old + weight * (new - old) for old, new in zip(self._g, a, strict=True))
            self._g = x, y, z
        return self._g


def _dot(a: Axes, b: Axes) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Axes, b: Axes) -> Axes:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _across(a: Axes, up: Axes) -> Axes:
    """What of `a` is level."""
    along = _dot(a, up)
    return a[0] - along * up[0], a[1] - along * up[1], a[2] - along * up[2]


def _unit(a: Axes) -> Axes:
    length = math.hypot(*a) or math.nan
    return a[0] / length, a[1] / length, a[2] / length
