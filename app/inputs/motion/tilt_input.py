"""The tablet's tilt as a way in: it leads the red circle on the glass while a thumb, a key or a switch holds the clutch."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Iterator
from dataclasses import fields, replace
from typing import Any

from app.core.checked_settings import Kept, number
from app.core.command_origin import Origin, origins
from app.core.notifications import tell
from app.device import rotation
from app.device.motion import Axes, SimulatedMotion, motion_source
from app.inputs.base.button_presses import Press
from app.inputs.base.text_focus import is_typing
from app.inputs.base.toggleable_method import Switched
from app.inputs.motion.tilt import Level, Tilt, TiltSettings, turned
from widgets.controls.tilt_circle import TiltCircle

__all__ = ["LEAST", "Tilting"]

LEAST = 10.0
"""Below this rate [Hz] a hand is ahead of what the sensor tells."""
LEANS = {"up": (0.0, 1.0), "down": (0.0, -1.0), "right": (1.0, 0.0), "left": (-1.0, 0.0)}
"""Keys that lean a simulated tablet, to the right and ahead."""
LEAN = math.radians(20.0)
"""How far they do."""
NAMES = frozenset(field.name for field in fields(TiltSettings))


class Tilting(Switched):
    """Made once for the app, which is asked for its `settings`, `now`, `shell`, `session` and `sensing`. Everything in the UI thread."""

    name = "tilt"

    def __init__(self, app: Any, quarters: Callable[[], int] = rotation) -> None:
        """`quarters` tells how the screen is turned."""
        self._app, self._quarters = app, quarters
        read = Kept(app.settings.get("tilt"), "the tilt")
        kept = read.values
        self._on = read.flag("on", usual=False)
        self.others = read.flag("others", usual=True)
        """Robots that are driven by sticks alone can be driven by it as well."""
        settings, self.faults = TiltSettings.of({name: kept[name] for name in kept if name in NAMES})
        """What was kept and is no good, as sentences."""
        self.tilt = Tilt(settings)
        self.tilt.neutral = _axes(kept.get("neutral"))
        if kept.get("neutral") is not None and self.tilt.neutral is None:
            read.mistaken("neutral", "three numbers")
        self.faults += [read.sentence] if read.sentence else []
        self._level: Level | None = None
        """Makes gravity of the acceleration, where the device does not tell it."""
        self._forgets: list[Callable[[], None]] = []
        self._circle: TiltCircle | None = None
        self._lent: TiltCircle | None = None
        self._keys: set[str] = set()
        self._clutched = False
        self._began, self._turn, self._said = math.nan, 0, ""
        self._simulated: SimulatedMotion | None = None

    # as every method

    @property
    def standing(self) -> str:
        """How it stands, in a few words."""
        if not self.on:
            return "off"
        if self.tilt.closed:
            return "drives"
        if self._circle is None:
            return "ready: choose Tilt on the drive screen"
        return "hold the circle to drive" if not self.simulated else "simulated: arrow keys lean it"

    @property
    def fault(self) -> str:
        """Why no circle can be led by leaning this device, on or off; empty where one can."""
        sensing = self._app.sensing
        return "" if sensing.possible else str(sensing.sentence)

    @property
    def problem(self) -> str:
        """Why it does not work though it is on; empty when it is well."""
        if not self.on:
            return ""
        if self.fault:
            return self.fault
        return self._unwell() if self._forgets else ""

    def start(self) -> None:
        """Lead whatever circle comes onto the glass; the sensor begins with it."""
        for fault in self.faults:
            self._say(fault)
        self.faults = []
        inputs = self._app.inputs
        if self not in inputs.presses.takers:
            inputs.presses.takers.insert(0, self)
            inputs.meanings.held["tilt"].append(self._hold)

    def stop(self) -> None:
        """Zero at once, and no sensor."""
        self._lead(None)
        self._offer(on=False)
        self._fit()
        inputs = self._app.inputs
        if self in inputs.presses.takers:
            inputs.presses.takers.remove(self)
            inputs.meanings.held["tilt"].remove(self._hold)

    def close(self) -> None:
        """Nothing is left running."""
        self.stop()
        self.simulate(on=False)

    def look(self, now: float) -> None:
        """With each heartbeat: lead the circle that is on the glass, if there is one."""
        self._offer(on=self.others and bool(self._app.sensing.possible))
        self._lead(self._found())
        self._fit()
        if self._circle is None:
            return
        if self._simulated is not None:
            self._simulated.tell()
            self._app.sensing.look(now)
        if self._quarters() != self._turn and self.tilt.pressed:
            self.let_go()
        self._turn = self._quarters()
        self._clutch(now)
        if self.tilt.pressed and (fault := self._unwell()):
            self.tilt.fail(fault)
        self._steer(self._circle, now)

    # what is set

    @property
    def settings(self) -> TiltSettings:
        """What the operator has chosen."""
        return self.tilt.settings

    def change(self, **values: Any) -> None:
        """Choose something else, as in `full=20.0`; the clutch opens. ValueError for what is not allowed."""
        fresh, faults = TiltSettings.of(replace(self.settings, **values).save())
        if faults:
            raise ValueError(" ".join(faults))
        self.let_go()
        self.tilt.settings = fresh
        self._keep()

    def change_others(self, others: bool) -> None:
        """Whether it may drive what has sticks alone."""
        self.others = others
        self._keep()

    def set_neutral(self, *, fixed: bool) -> bool:
        """Neutral is how the tablet is held now, or again wherever the clutch closes; False where that is not known."""
        up = self.tilt.up if fixed else None
        if fixed and up is None:
            return False
        self.let_go()
        self.tilt.neutral = up
        self._keep()
        return True

    def _kept(self) -> dict[str, Any]:
        more = {
            "on": self._on,
            "others": self.others,
            "neutral": self.tilt.neutral and list(self.tilt.neutral),
        }
        return self.settings.save() | more

    # the tablet of a desktop

    @property
    def simulated(self) -> bool:
        """The arrow keys lean it."""
        return self._simulated is not None

    @property
    def can_simulate(self) -> bool:
        """There is no tablet here to be tilted."""
        return self.simulated or not self._app.sensing.possible

    def simulate(self, *, on: bool) -> None:
        """Take arrow keys for a tablet, or the device's own sensors again."""
        if on == self.simulated:
            return
        self.let_go()
        self._simulated = SimulatedMotion(now=self._app.now) if on else None
        self._app.sensing.use(self._simulated or motion_source(self._app.now))
        self._unlisten()

    def lean(self, right: float, ahead: float) -> None:
        """Hold the simulated tablet so [rad]; nothing for a real one."""
        if self._simulated is not None:
            self._simulated.lean(right, ahead)

    def pressed(self, press: Press) -> bool:
        """A key went down: an arrow leans a simulated tablet while the clutch is held."""
        leans = press.source == "key" and press.name in LEANS and self.simulated and self.tilt.pressed
        if not leans or is_typing():
            return False
        self._keys.add(press.name)
        self._lean_by_keys()
        return True

    def released(self, press: Press) -> None:
        """It went up, or was lost."""
        self._keys.discard(press.name)
        self._lean_by_keys()

    def _lean_by_keys(self) -> None:
        right, ahead = (sum(LEANS[key][axis] for key in self._keys) for axis in (0, 1))
        self.lean(right * LEAN, ahead * LEAN)

    # the clutch

    def clutch(self, *, down: bool) -> None:
        """A key or a switch holds the clutch, or lets go of it."""
        able = self.on and self._circle is not None and not self._circle.disabled
        self._clutched = down and able
        if not down:
            self.let_go()
        elif self.on and self._circle is None:
            self._say("Nothing is tilted yet: choose Tilt on the drive screen first.")

    def _hold(self, down: bool) -> None:
        """The key or the button that means it was pressed, or let go."""
        self.clutch(down=down)

    def let_go(self) -> None:
        """Zero now; whoever holds it has to let go and press anew."""
        self._clutched = False
        self.tilt.release()
        circle = self._circle
        if circle is not None and (circle.held or circle.forward or circle.left):
            circle.rest()

    def _clutch(self, now: float) -> None:
        circle = self._circle
        held = circle is not None and (self._clutched or circle.finger is not None)
        if held and not self.tilt.pressed:
            self._began = now
            self.tilt.press(now)
        elif not held and self.tilt.pressed:
            self.tilt.release()

    def _let_go(self, circle: TiltCircle) -> None:
        """The circle was put to rest: by a lifted finger, or by whatever takes it away from the hand."""
        self._clutched = False
        self.tilt.release()
        circle.clutched, circle.opened = False, ""

    # what it leads

    def lend(self, circle: TiltCircle | None) -> None:
        """Lead this circle instead of one that drives, to try it out; None for the robot's again."""
        self._lent = circle
        self._lead(self._found())
        self._fit()

    def _found(self) -> TiltCircle | None:
        shell = self._app.shell
        if self._lent is not None or shell is None:
            return self._lent
        hands = getattr(shell.screens.get(shell.screen), "hands", None)
        return hands.circle if hands is not None else None

    def _offer(self, *, on: bool) -> None:
        """A drive screen whose robot has no circle gets one beside its stick, or loses it."""
        shell = self._app.shell
        screen: Any = shell.screens.get(shell.screen) if shell is not None else None
        hands = getattr(screen, "hands", None)
        if hands is not None and hands.tablet != on and hasattr(screen, "meet"):
            hands.tablet = on
            screen.meet()

    def _lead(self, circle: TiltCircle | None) -> None:
        before = self._circle
        if circle is before:
            return
        if before is not None:
            self.let_go()
            before.unbind(on_let_go=self._let_go)
            before.rest()
            before.needs_hold, before.clutched, before.opened, before.missing = False, False, "", ""
            before.dead = TiltCircle.dead.defaultvalue
        self._circle = circle
        if circle is not None:
            circle.rest()
            circle.needs_hold = True
            circle.bind(on_let_go=self._let_go)

    def _steer(self, circle: TiltCircle, now: float) -> None:
        command = self.tilt.look(now)
        if self.tilt.why and self.tilt.why != self._said:
            self._say(self.tilt.why)
        self._said = self.tilt.why
        circle.missing = self.fault
        circle.dead = self.settings.share
        circle.clutched = self._clutched
        circle.opened = self.tilt.why.partition(":")[0]
        with self._originating(now):
            circle.steer(self.tilt.at, command)

    @contextlib.contextmanager
    def _originating(self, now: float) -> Iterator[None]:
        with origins.during(Origin("tilt", 1.0, self._began, math.nan, now)):
            yield

    # the sensor

    def _fit(self) -> None:
        """It runs exactly while there is something to lead."""
        wanted = self.on and self._circle is not None and self._app.sensing.possible
        if wanted and not self._forgets:
            self._listen()
        elif not wanted:
            self._unlisten()

    def _listen(self) -> None:
        sensing = self._app.sensing
        fused = sensing.has("gravity")
        self._level = None if fused else Level()
        self._forgets = [sensing.listen("acceleration", self._feel)] if sensing.has("acceleration") else []
        if fused:
            self._forgets.append(sensing.listen("gravity", self._feed))
            self._do_without_fusion()

    def _do_without_fusion(self) -> None:
        """Gravity that the system refuses is made of the acceleration, where there is that."""
        if self._app.sensing.health("gravity").fault == "refused" and len(self._forgets) > 1:
            self._forgets.pop()()
            self._level = Level()

    def _unlisten(self) -> None:
        for forget in self._forgets:
            forget()
        self._forgets = []

    def _feed(self, t: float, up: Axes) -> None:
        self.tilt.feed(t, turned(up, self._turn))

    def _feel(self, t: float, a: Axes) -> None:
        self.tilt.feel(t, a)
        if self._level is not None:
            self._feed(t, self._level(t, a))

    def _unwell(self) -> str:
        """What is wrong with the samples, as a sentence; empty while all is well, or too early to tell."""
        kind = "gravity" if self._level is None else "acceleration"
        health = self._app.sensing.health(kind, LEAST)
        return "" if health.fault in ("", "waiting", "paused") else str(health.sentence)

    def _say(self, text: str) -> None:
        tell(self._app, text, about=self.name)


def _axes(kept: object) -> Axes | None:
    """Three finite numbers that are no zeros, or None."""
    if not isinstance(kept, list) or len(kept) != 3:
        return None
    x, y, z = (number(one, -1e3, 1e3) for one in kept)
    if x is None or y is None or z is None:
        return None
    return (x, y, z) if any((x, y, z)) else None
