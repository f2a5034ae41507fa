"""Sources of the accelerometer's and of gravity's samples: the phone's own sensors, simulated ones, or none.

Axes are Android's, those of the device and not of the screen: x to the right and y up on a phone that is held upright, z out of
the glass. What lies still on its back reads (0, 0, 9.8) of either kind.
"""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Callable, Collection
from typing import Any, Final, Literal, Protocol

from app.device import is_android
from widgets.core.language import tr

__all__ = [
    "GRAVITY",
    "KINDS",
    "AndroidMotion",
    "Axes",
    "Hear",
    "Kind",
    "MotionError",
    "MotionSource",
    "NoMotion",
    "OurClock",
    "SimulatedMotion",
    "leaned",
    "motion_source",
    "up_of",
]

log = logging.getLogger(__name__)

Kind = Literal["acceleration", "gravity"]
"""`acceleration` has gravity in it; `gravity` is fused with the gyroscope, so that steps and shakes are taken out. [m/s²]"""
KINDS: Final[tuple[Kind, ...]] = ("acceleration", "gravity")
Axes = tuple[float, float, float]
Hear = Callable[[Kind, float, Axes], None]
"""Told the kind, when it was measured [s, the clock of `time.monotonic`], and x, y, z; from any thread."""

GRAVITY = 9.80665
"""[m/s²]"""
SENSOR_DELAY_GAME = 1
"""20 ms between two samples. NORMAL is 200 ms, at which a shake is not seen any more."""
TYPE_ACCELEROMETER, TYPE_GRAVITY, TYPE_GAME_ROTATION_VECTOR = 1, 9, 15
TYPES: dict[Kind, tuple[int, ...]] = {
    "acceleration": (TYPE_ACCELEROMETER,),
    "gravity": (TYPE_GRAVITY, TYPE_GAME_ROTATION_VECTOR),
}
"""Android's sensors that tell it, the better one first."""
SAMPLE_PERIOD, MAX_SAMPLES = 0.02, 25
"""Between two samples of a simulated one [s], and how many it tells at once."""
LATE = 1.0
"""A sample that is older than that [s] comes from a clock that was set anew."""


class MotionError(Exception):
    """The sensors cannot be listened to; the text is a sentence for the operator."""


class MotionSource(Protocol):
    """Tells how the device moves from `start` to `stop`."""

    @property
    def kinds(self) -> frozenset[Kind]:
        """What it can tell; empty where it has no sensor."""

    @property
    def possible(self) -> bool:
        """It can tell anything at all."""

    @property
    def sentence(self) -> str:
        """Why it cannot; empty where it can."""

    def start(self, kinds: Collection[Kind], hear: Hear) -> None:
        """Begin to tell those of `kinds` that it has, instead of those before. MotionError where the system refuses."""

    def stop(self) -> None:
        """Tell nothing more; nothing where it tells nothing."""


class NoMotion:
    """A device without sensors."""

    kinds: frozenset[Kind] = frozenset()
    possible = False

    def __init__(self, sentence: str = "") -> None:
        self.sentence = sentence or tr("This computer has no motion sensor.")

    def start(self, kinds: Collection[Kind], hear: Hear) -> None:
        """MotionError, always."""
        raise MotionError(self.sentence)

    def stop(self) -> None:
        """Nothing."""


class SimulatedMotion:
    """A device that somebody moves by `put` and `lean`: tests, and a desktop's sliders and arrow keys."""

    possible = True
    sentence = ""

    def __init__(self, kinds: Collection[Kind] = KINDS, now: Callable[[], float] = time.monotonic) -> None:
        self.kinds: frozenset[Kind] = frozenset(kinds)
        self._now = now
        self._hear: Hear | None = None
        self._told: frozenset[Kind] = frozenset()
        self._count, self._last = 0, math.nan
        self.roll, self.pitch = 0.0, 0.0
        """How it is leaned [rad], as in `leaned`."""

    @property
    def running(self) -> bool:
        """Somebody listens."""
        return self._hear is not None

    def start(self, kinds: Collection[Kind], hear: Hear) -> None:
        """Tell what is put from now on."""
        self._told, self._hear = self.kinds & frozenset(kinds), hear

    def stop(self) -> None:
        """Tell nothing more."""
        self._hear, self._told = None, frozenset()

    def put(self, kind: Kind, t: float, axes: Axes) -> None:
        """One sample [s, m/s²]; it is lost where nobody listens to that kind."""
        if self._hear is not None and kind in self._told:
            self._hear(kind, t, axes)

    def lean(self, roll: float, pitch: float) -> None:
        """Hold the device so from now on [rad]."""
        self.roll, self.pitch = roll, pitch

    def tell(self) -> None:
        """What a sensor would have told of how it is held, since this was called last; at most half a second of it."""
        now = self._now()
        due = 1 if math.isnan(self._last) else min(MAX_SAMPLES, int((now - self._last) / SAMPLE_PERIOD))
        for back in reversed(range(due)):
            self._tell(now - back * SAMPLE_PERIOD)
        if due:
            self._last = now

    def _tell(self, t: float) -> None:
        self._count += 1
        # a real sensor is never the same twice, and one that is counts as frozen
        x, y, z = leaned(self.roll, self.pitch)
        axes = x, y, z + (1e-4 if self._count % 2 else 0.0)
        for kind in KINDS:
            self.put(kind, t, axes)


def leaned(roll: float, pitch: float) -> Axes:
    """What a phone on its back reads once it is leaned: `roll` its right side down, `pitch` its upper edge down [rad]; in m/s²."""
    return (
        -GRAVITY * math.sin(roll) * math.cos(pitch),
        -GRAVITY * math.sin(pitch),
        GRAVITY * math.cos(roll) * math.cos(pitch),
    )


def up_of(rotation: Collection[float]) -> Axes:
    """Gravity as TYPE_GRAVITY tells it [m/s²] from a rotation vector, x, y, z and maybe w of a unit quaternion.

    It turns the device's axes into the world's, whose z is up: its last row is the world's up seen from the device.
    """
    x, y, z, *more = rotation
    w = more[0] if more else math.sqrt(max(0.0, 1.0 - x * x - y * y - z * z))
    up = 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)
    return up[0] * GRAVITY, up[1] * GRAVITY, up[2] * GRAVITY


class OurClock:
    """Turns the times of a sensor, which count from anywhere, into ours: the shortest way here was the quickest sample's."""

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self._now = now
        self._offset = math.nan

    def of(self, stamp: float) -> float:
        """When that was [s]; never later than now."""
        late = self._now() - stamp - self._offset
        if not 0.0 <= late <= LATE:  # the first, a quicker one, or a clock that was set
            self._offset = self._now() - stamp
        return stamp + self._offset


class AndroidMotion:
    """The phone's own sensors, 50 times a second, heard in Android's main thread."""

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        """Looks which sensors there are; opens none."""
        from jnius import autoclass

        self._now = now
        context = autoclass("android.content.Context")
        activity = autoclass("org.kivy.android.PythonActivity").mActivity
        self._service = activity.getSystemService(context.SENSOR_SERVICE)
        found = {kind: self._first(types) for kind, types in TYPES.items()}
        self._sensors: dict[Kind, Any] = {kind: one for kind, one in found.items() if one is not None}
        self._listeners: list[Any] = []

    def _first(self, types: Collection[int]) -> Any:
        if self._service is None:
            return None
        every = (self._service.getDefaultSensor(kind) for kind in types)
        return next((sensor for sensor in every if sensor is not None), None)

    @property
    def kinds(self) -> frozenset[Kind]:
        """Those that this phone has a sensor for."""
        return frozenset(self._sensors)

    @property
    def possible(self) -> bool:
        """It has any."""
        return bool(self._sensors)

    @property
    def sentence(self) -> str:
        """That it has none."""
        return "" if self._sensors else tr("This device has no motion sensor.")

    def start(self, kinds: Collection[Kind], hear: Hear) -> None:
        """One listener each; MotionError where the system takes one of them not."""
        self.stop()
        if not self._sensors:
            raise MotionError(self.sentence)
        for kind in KINDS:
            sensor = self._sensors.get(kind) if kind in kinds else None
            if sensor is None:
                continue
            turned = sensor.getType() == TYPE_GAME_ROTATION_VECTOR
            listener = _listener(self._heard(kind, turned, hear))
            if not self._service.registerListener(listener, sensor, SENSOR_DELAY_GAME):
                self.stop()
                raise MotionError(tr("Android does not hand out its {kind} sensor.").format(kind=kind))
            self._listeners.append(listener)

    def _heard(self, kind: Kind, turned: bool, hear: Hear) -> Callable[[Any], None]:
        clock = OurClock(self._now)

        def heard(event: Any) -> None:
            values = [float(value) for value in event.values]
            axes = up_of(values[:4]) if turned else (values[0], values[1], values[2])
            hear(kind, clock.of(event.timestamp * 1e-9), axes)

        return heard

    def stop(self) -> None:
        """Every listener is taken back: one that is left keeps the sensor on, and empties the battery."""
        listeners, self._listeners = self._listeners, []
        for listener in listeners:
            self._service.unregisterListener(listener)


def _listener(heard: Callable[[Any], None]) -> Any:
    """An `android.hardware.SensorEventListener`; the class is made here because its base is only on a phone."""
    from jnius import PythonJavaClass, java_method

    class Listener(PythonJavaClass):  # type: ignore[misc]
        __javainterfaces__ = ("android/hardware/SensorEventListener",)

        @java_method("(Landroid/hardware/SensorEvent;)V")  # type: ignore[untyped-decorator]
        def onSensorChanged(self, event: Any) -> None:  # noqa: N802 - Android's name
            try:
                heard(event)
            except (ArithmeticError, LookupError, TypeError, ValueError) as problem:
                # an error that leaves here ends the whole app
                log.warning("A sample of the sensors was not understood: %s", problem)

        @java_method("(Landroid/hardware/Sensor;I)V")  # type: ignore[untyped-decorator]
        def onAccuracyChanged(self, sensor: Any, accuracy: int) -> None:  # noqa: N802 - Android's name
            return

    return Listener()


def motion_source(now: Callable[[], float] = time.monotonic) -> MotionSource:
    """The sensors of the device that this runs on; a `NoMotion`, with the reason, where there are none."""
    if not is_android():
        return NoMotion()
    from jnius import JavaException

    try:
        return AndroidMotion(now)
    except JavaException as problem:
        log.warning("The motion sensors cannot be reached: %s", problem)
        return NoMotion(tr("The motion sensors cannot be reached: {problem}.").format(problem=problem))
