"""The tablet's tilt as a way in: it leads the red circle on the glass while a thumb, a key or a switch holds the clutch."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from app.core.command_origin import Origin, origins
from app.core.notifications import notify
from app.device import rotation
from app.inputs.base.button_presses import Press
from app.inputs.base.text_focus import is_typing
from app.inputs.motion.motion_app import MotionApp
from app.inputs.motion.simulated_tablet import ARROWS, SimulatedTablet
from app.inputs.motion.tilt_options import TiltOptions
from app.inputs.motion.tilt_sensor import TiltSensor
from widgets.controls.sticks.tilt_circle import TiltCircle
from widgets.core.language import tr

__all__ = ["TiltInput"]


class TiltInput(TiltOptions):
    """Made once for the app, which is asked for its `settings`, `now`, `shell`, `session` and `sensing`. Everything in the UI thread."""

    def __init__(self, app: MotionApp, quarters: Callable[[], int] = rotation) -> None:
        """`quarters` tells how the screen is turned."""
        super().__init__(app)
        self._quarters = quarters
        self._sensor, self._tablet = TiltSensor(app, self.tilt), SimulatedTablet(app)
        self._circle: TiltCircle | None = None
        self._lent: TiltCircle | None = None
        self._clutched = False
        self._began, self._said = math.nan, ""

    # as every method

    @property
    def standing(self) -> str:
        """How it stands, in a few words."""
        if not self.on:
            return tr("off")
        if self.tilt.closed:
            return tr("drives")
        if self._circle is None:
            return tr("ready: choose Tilt on the drive screen")
        return tr("hold the circle to drive") if not self.simulated else tr("simulated: arrow keys lean it")

    @property
    def fault(self) -> str:
        """Why no circle can be led by leaning this device, on or off; empty where one can."""
        return self._sensor.fault

    @property
    def problem(self) -> str:
        """Why it does not work though it is on; empty when it is well."""
        if not self.on:
            return ""
        return self.fault or (self._sensor.trouble if self._sensor.is_listening else "")

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

    def update(self, now: float) -> None:
        """With each heartbeat: lead the circle that is on the glass, if there is one."""
        self._offer(on=self.others and bool(self._app.sensing.possible))
        self._lead(self._found())
        self._fit()
        if self._circle is None:
            return
        self._tablet.update(now)
        if self._quarters() != self._sensor.turn and self.tilt.pressed:
            self.let_go()
        self._sensor.turn = self._quarters()
        self._clutch(now)
        if self.tilt.pressed and (fault := self._sensor.trouble):
            self.tilt.fail(fault)
        self._steer(self._circle, now)

    # the tablet of a desktop

    @property
    def simulated(self) -> bool:
        """The arrow keys lean it."""
        return self._tablet.on

    @property
    def can_simulate(self) -> bool:
        """There is no tablet here to be tilted."""
        return self.simulated or not self._app.sensing.possible

    def simulate(self, *, on: bool) -> None:
        """Take arrow keys for a tablet, or the device's own sensors again."""
        if on == self.simulated:
            return
        self.let_go()
        self._tablet.switch(on=on)
        self._sensor.close()

    def lean(self, right: float, ahead: float) -> None:
        """Hold the simulated tablet so [rad]; nothing for a real one."""
        self._tablet.lean(right, ahead)

    def pressed(self, press: Press) -> bool:
        """A key went down: an arrow leans a simulated tablet while the clutch is held."""
        leans = press.source == "key" and press.name in ARROWS and self.simulated and self.tilt.pressed
        if not leans or is_typing():
            return False
        self._tablet.press(press.name)
        return True

    def released(self, press: Press) -> None:
        """It went up, or was lost."""
        self._tablet.release(press.name)

    # the clutch

    def clutch(self, *, down: bool) -> None:
        """A key or a switch holds the clutch, or lets go of it."""
        able = self.on and self._circle is not None and not self._circle.disabled
        self._clutched = down and able
        if not down:
            self.let_go()
        elif self.on and self._circle is None:
            self._say(tr("Nothing is tilted yet: choose Tilt on the drive screen first."))

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
        if self._lent is not None:
            return self._lent
        controls = _drive_controls(_screen(self._app))
        return controls.circle if controls is not None else None

    def _offer(self, *, on: bool) -> None:
        """A drive screen whose robot has no circle gets one beside its stick, or loses it."""
        screen = _screen(self._app)
        controls = _drive_controls(screen)
        if controls is not None and controls.tablet != on and hasattr(screen, "meet"):
            controls.tablet = on
            screen.meet()

    def _lead(self, circle: TiltCircle | None) -> None:
        before = self._circle
        if circle is before:
            return
        if before is not None:
            self.let_go()
            before.unbind(on_let_go=self._let_go)
            _give_back(before)
        self._circle = circle
        if circle is not None:
            circle.rest()
            circle.needs_hold = True
            circle.bind(on_let_go=self._let_go)

    def _steer(self, circle: TiltCircle, now: float) -> None:
        command = self.tilt.update(now)
        if self.tilt.why and self.tilt.why != self._said:
            self._say(self.tilt.why)
        self._said = self.tilt.why
        circle.missing = self.fault
        circle.dead = self.settings.share
        circle.clutched = self._clutched
        circle.opened = self.tilt.why.partition(":")[0]
        with origins.during(Origin(self.name, 1.0, self._began, math.nan, now)):
            circle.steer(self.tilt.at, command)

    def _fit(self) -> None:
        """The sensor runs exactly while there is something to lead."""
        self._sensor.listen(on=self.on and self._circle is not None)

    def _say(self, text: str) -> None:
        notify(self._app, text, about=self.name)


def _screen(app: MotionApp) -> Any:
    """The screen of the robot that is shown; None without one."""
    return app.shell.screens.get(app.shell.screen) if app.shell is not None else None


def _drive_controls(screen: Any) -> Any:
    """What `screen` is driven with; None where it is not for driving."""
    return getattr(screen, "hands", None)


def _give_back(circle: TiltCircle) -> None:
    """It works by fingers alone again."""
    circle.rest()
    circle.needs_hold, circle.clutched, circle.opened, circle.missing = False, False, "", ""
    circle.dead = TiltCircle.dead.defaultvalue
