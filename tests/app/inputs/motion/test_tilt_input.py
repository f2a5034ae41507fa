"""The tablet's tilt leads the circle on the glass while a thumb, a key or a switch holds the clutch."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from app.core.command_origin import origins
from app.device.motion import NoMotion, SimulatedMotion, leaned
from app.inputs.base.button_presses import Press
from app.inputs.motion.motion_sensing import MotionSensing
from app.inputs.motion.tilt_input import TiltInput
from tests.app.inputs.motion.test_motion_sensing import WithoutGravity
from widgets import TiltCircle


class Kept(dict[str, Any]):
    """Settings that forget with the test."""

    def set(self, name: str, value: Any) -> None:
        self[name] = value


class Handheld:
    """What the app is to a method: settings, a clock, sensors, and a drive screen with a circle."""

    def __init__(self, kept: Any = None, kinds: Any = ("acceleration", "gravity")) -> None:
        self.time, self.quarters, self.said = 100.0, 0, []
        self.settings = Kept({"tilt": kept} if kept is not None else {})
        self.source = SimulatedMotion(kinds, self.now)
        self.sensing = MotionSensing(self.source, self.now)
        self.inputs = SimpleNamespace(
            presses=SimpleNamespace(takers=[]), meanings=SimpleNamespace(held={"tilt": []})
        )
        self.circle = TiltCircle(size=(200, 200))
        self.told: list[tuple[float, float]] = []
        self.circle.bind(on_command=self._tell)
        self.methods_of: list[str] = []
        self.hands = SimpleNamespace(circle=self.circle, tablet=False)
        self.met = 0
        screen = SimpleNamespace(hands=self.hands, meet=self._meet)
        self.shell = SimpleNamespace(screen="drive", screens={"drive": screen}, say=self._say)
        self.tilting = TiltInput(self, lambda: self.quarters)

    def now(self) -> float:
        return self.time

    def _tell(self, circle: TiltCircle, _: Any) -> None:
        self.told.append((-circle.left, circle.forward))
        self.methods_of.append(origins.current().method)

    def _meet(self) -> None:
        self.met += 1

    def _say(self, text: str, *_: Any, **__: Any) -> None:
        self.said.append(text)

    def on(self) -> Handheld:
        self.tilting.on = True
        self.tilting.start()
        return self

    def run(self, seconds: float, roll: float = 0.0, pitch: float = 0.0) -> None:
        self.source.lean(math.radians(roll), math.radians(pitch))
        for _ in range(round(seconds / 0.03)):
            self.time += 0.03
            self.source.tell()
            self.sensing.update()
            self.tilting.update(self.time)

    def key(self, name: str) -> Press:
        return Press("key", 0, name, self.time)

    @property
    def last(self) -> tuple[float, float]:
        return self.told[-1] if self.told else (0.0, 0.0)


@pytest.fixture
def handheld() -> Handheld:
    return Handheld().on()


def hold(handheld: Handheld) -> Any:
    x, y, _ = handheld.circle.round
    touch = SimpleNamespace(pos=(x, y), x=x, y=y, grab_current=handheld.circle)
    touch.grab = touch.ungrab = lambda _: None
    handheld.circle.on_touch_down(touch)
    return touch


def test_off_it_costs_nothing_and_leads_nothing() -> None:
    handheld = Handheld()
    assert handheld.tilting.standing == "off"
    assert not handheld.source.running
    assert not handheld.circle.needs_hold


def test_without_a_thumb_the_tablet_commands_nothing(handheld: Handheld) -> None:
    handheld.run(2.0, pitch=30)
    assert handheld.told == []
    assert handheld.circle.needs_hold
    assert handheld.tilting.standing == "hold the circle to drive"


def test_under_a_thumb_it_drives_from_where_it_was_held_and_lifted_it_is_zero_at_once(
    handheld: Handheld,
) -> None:
    handheld.run(0.5, pitch=20)
    finger = hold(handheld)
    handheld.run(0.5, pitch=20)
    assert handheld.told == []
    handheld.run(1.0, pitch=50)
    assert handheld.last[1] == pytest.approx(1.0)
    assert handheld.tilting.standing == "drives"
    handheld.circle.on_touch_up(finger)
    assert handheld.last == (0.0, 0.0)
    handheld.run(1.0, pitch=60)
    assert handheld.last == (0.0, 0.0)


def test_what_it_commands_comes_from_the_tilt(handheld: Handheld) -> None:
    handheld.run(0.5)
    hold(handheld)
    handheld.run(1.0, roll=20)
    assert handheld.last[0] > 0.4
    assert set(handheld.methods_of) == {"tilt"}


def test_what_means_it_is_a_clutch_too_a_key_or_a_trigger(handheld: Handheld) -> None:
    (held,) = handheld.inputs.meanings.held["tilt"]
    handheld.run(0.5)
    held(True)
    handheld.run(1.0, pitch=30)
    assert handheld.last[1] == pytest.approx(1.0)
    held(False)
    assert handheld.last == (0.0, 0.0)


def test_a_clutch_that_has_nothing_to_lead_says_what_to_do(handheld: Handheld) -> None:
    handheld.hands.circle = None
    handheld.run(0.1)
    assert handheld.tilting.standing == "ready: choose Tilt on the drive screen"
    handheld.tilting.clutch(down=True)
    assert handheld.said == ["Nothing is tilted yet: choose Tilt on the drive screen first."]
    handheld.tilting.clutch(down=False)
    assert len(handheld.said) == 1


def test_whatever_puts_the_circle_to_rest_opens_the_clutch_until_it_is_pressed_anew(
    handheld: Handheld,
) -> None:
    handheld.run(0.5)
    handheld.tilting.clutch(down=True)
    handheld.run(1.0, pitch=30)
    handheld.circle.rest()
    handheld.run(1.0, pitch=50)
    assert handheld.last == (0.0, 0.0)
    handheld.tilting.clutch(down=True)
    handheld.run(0.5, pitch=50)
    handheld.run(1.0, pitch=80)
    assert handheld.last[1] == pytest.approx(1.0)


def test_a_disabled_circle_is_not_led(handheld: Handheld) -> None:
    handheld.run(0.5)
    handheld.circle.state = "disabled"
    handheld.tilting.clutch(down=True)
    handheld.run(1.0, pitch=30)
    assert handheld.told == []


def test_a_screen_that_is_turned_opens_the_clutch(handheld: Handheld) -> None:
    handheld.run(0.5)
    handheld.tilting.clutch(down=True)
    handheld.run(1.0, pitch=30)
    handheld.quarters = 1
    handheld.run(0.3, pitch=30)
    assert handheld.last == (0.0, 0.0)


def test_a_silent_sensor_opens_it_and_is_said_once(handheld: Handheld) -> None:
    handheld.run(0.5)
    handheld.tilting.clutch(down=True)
    handheld.run(1.0, pitch=30)
    handheld.source.stop()
    handheld.run(1.0, pitch=30)
    assert handheld.last == (0.0, 0.0)
    assert handheld.said == ["The gravity sensor is silent."]
    assert handheld.circle.opened
    assert handheld.tilting.problem == "The gravity sensor is silent."


def test_a_frozen_sensor_opens_it(handheld: Handheld) -> None:
    handheld.run(0.5)
    handheld.tilting.clutch(down=True)
    handheld.run(1.0, pitch=30)
    for _ in range(60):
        handheld.time += 0.03
        handheld.source.put("gravity", handheld.time, leaned(0.0, math.radians(30)))
        handheld.sensing.update()
        handheld.tilting.update(handheld.time)
    assert handheld.last == (0.0, 0.0)
    assert "stood still" in handheld.said[0]


def test_a_screen_without_a_circle_needs_no_sensor(handheld: Handheld) -> None:
    handheld.run(0.5)
    assert handheld.source.running
    handheld.hands.circle = None
    handheld.run(0.1)
    assert not handheld.source.running
    assert not handheld.circle.needs_hold


def test_switched_off_in_mid_drive_it_is_zero_and_the_sensor_off(handheld: Handheld) -> None:
    handheld.run(0.5)
    handheld.tilting.clutch(down=True)
    handheld.run(1.0, pitch=30)
    handheld.tilting.on = False
    handheld.tilting.stop()
    assert handheld.last == (0.0, 0.0)
    assert not handheld.source.running
    assert handheld.inputs.presses.takers == handheld.inputs.meanings.held["tilt"] == []


def test_a_robot_without_a_circle_is_offered_one_unless_the_operator_does_not_want_that(
    handheld: Handheld,
) -> None:
    handheld.run(0.1)
    assert (handheld.hands.tablet, handheld.met) == (True, 1)
    handheld.tilting.change_others(False)
    handheld.run(0.1)
    assert (handheld.hands.tablet, handheld.met) == (False, 2)


def test_to_try_it_out_it_leads_another_circle_and_the_robots_rests(handheld: Handheld) -> None:
    trial = TiltCircle(size=(200, 200))
    handheld.tilting.lend(trial)
    handheld.run(0.5)
    handheld.tilting.clutch(down=True)
    handheld.run(1.0, pitch=30)
    assert trial.forward == pytest.approx(1.0)
    assert handheld.told == []
    handheld.tilting.lend(None)
    assert trial.forward == 0.0


def test_without_a_gyroscope_the_accelerometer_does() -> None:
    handheld = Handheld(kinds=["acceleration"]).on()
    handheld.run(1.0)
    handheld.tilting.clutch(down=True)
    handheld.run(6.0, pitch=30)
    assert handheld.last[1] > 0.9


def test_gravity_that_the_system_refuses_is_made_of_the_acceleration() -> None:
    handheld = Handheld()
    handheld.source = WithoutGravity(now=handheld.now)
    handheld.sensing.use(handheld.source)
    handheld.on().run(1.0)
    assert handheld.tilting.problem == ""
    handheld.tilting.clutch(down=True)
    handheld.run(6.0, pitch=30)
    assert handheld.last[1] > 0.9


def test_what_a_gamepad_commands_is_shown_while_the_clutch_is_open(handheld: Handheld) -> None:
    handheld.run(0.5, pitch=-10)
    handheld.circle.lean(1.0, 0.0)
    handheld.run(0.1, pitch=-10)
    assert (handheld.circle.forward, handheld.circle.ahead) == (1.0, 1.0)
    handheld.circle.lean(0.0, 0.0)
    handheld.run(0.1, pitch=-10)
    assert handheld.circle.ahead == 0.0, "then the tablet's again"


def test_a_desktop_says_that_it_has_no_sensor_and_leans_by_arrow_keys(handheld: Handheld) -> None:
    handheld.sensing.use(NoMotion("No sensor here."))
    assert handheld.tilting.problem == "No sensor here."
    assert handheld.tilting.can_simulate
    handheld.tilting.simulate(on=True)
    handheld.run(0.5)
    assert not handheld.tilting.pressed(handheld.key("up")), "arrows are the keyboard's without the clutch"
    handheld.tilting.clutch(down=True)
    handheld.run(0.1)
    assert handheld.tilting.pressed(handheld.key("up"))
    handheld.run(1.0)
    assert handheld.last[1] > 0.4
    handheld.tilting.released(handheld.key("up"))
    handheld.run(1.0)
    assert handheld.last == (0.0, 0.0)
    handheld.tilting.close()
    assert not handheld.tilting.simulated


def test_what_is_set_is_kept_and_checked(handheld: Handheld) -> None:
    handheld.tilting.change(full=20.0, walking=True)
    with pytest.raises(ValueError, match="full is 90 and must be 15 to 40"):
        handheld.tilting.change(full=90)
    handheld.run(0.5, pitch=20)
    assert handheld.tilting.set_neutral(fixed=True)
    again = Handheld(handheld.settings["tilt"])
    assert (again.tilting.on, again.tilting.settings) == (True, handheld.tilting.settings)
    assert again.tilting.tilt.neutral == pytest.approx(leaned(0.0, math.radians(20)), abs=1e-3)


@pytest.mark.parametrize(
    "kept", ["nonsense", {"full": 900, "neutral": [0, math.nan, 1]}, {"neutral": [0, 0, 0]}]
)
def test_settings_that_are_no_good_are_as_at_first(kept: Any) -> None:
    handheld = Handheld(kept).on()
    assert handheld.tilting.settings.full == 25.0
    assert handheld.tilting.tilt.neutral is None
    assert len(handheld.said) == (2 if isinstance(kept, dict) and "full" in kept else 1)


def test_neutral_cannot_be_set_where_nothing_is_known_of_it() -> None:
    assert not Handheld().tilting.set_neutral(fixed=True)


def test_without_a_sensor_the_circle_looks_disabled_and_says_why_and_none_is_offered_beside_a_stick(
    handheld: Handheld,
) -> None:
    handheld.run(0.1)
    assert handheld.hands.tablet, "with a sensor it is offered"
    live = handheld.circle.veil[3]
    handheld.sensing.use(NoMotion())
    handheld.run(0.1)
    circle = handheld.circle
    assert circle.missing == "This computer has no motion sensor."
    assert circle.veil[3] > live
    assert not any("hold" in words for words in circle._idle_words())
    assert circle._idle_words()[0] == circle.missing
    assert not handheld.hands.tablet, "nothing to choose where no tablet can be tilted"
    handheld.tilting.simulate(on=True)
    handheld.run(0.1)
    assert not circle.missing, "a simulated tablet is one"
    assert handheld.hands.tablet


def test_what_was_kept_and_is_no_good_is_said_without_a_robot_as_well() -> None:
    handheld = Handheld({"full": "much"})
    handheld.shell = None
    handheld.connect = SimpleNamespace(say=handheld._say)
    handheld.tilting.start()
    assert len(handheld.said) == 1
    assert "much" in handheld.said[0]
