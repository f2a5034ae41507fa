"""An arm from the side whose tip a finger drags, with a button for each pose that has a name and one for its gripper.

arm = ArmPanel()
robot.on("/arm", arm.show)
arm.bind(on_command=lambda _, order: robot.call("/arm/move", order))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.metrics import dp, sp
from kivy.properties import (
    BooleanProperty,
    ListProperty,
    ObjectProperty,
    OptionProperty,
)
from kivy.uix.widget import Widget

from bridge.msgs.arrays import Float64Array
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import ArmOrder, ArmState
from widgets.controls.goals.arm_dials import ROOMY, ArmDials
from widgets.controls.goals.arm_keys import pose_words
from widgets.controls.goals.arm_picture import (
    Links,
    draw_aim,
    draw_arm,
    draw_deck,
    moved_tip,
    side_points,
)
from widgets.controls.slide_confirm import OUTCOMES
from widgets.core.canvas_ink import Word
from widgets.core.geometry import DASH
from widgets.core.language import figure, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import first_fitting, wide

__all__ = ["ArmPanel", "samples"]

OUTCOME_TIMEOUT = 3.0
"""How long an outcome is shown [s]."""
MOVING_THRESHOLD = 0.02
"""Joints nearer than this to where they go are there [rad]."""
MAX_POSES = 32
"""Poses that are taken from a message."""
MIN_DRAG = 6
"""A finger that went no further meant nothing [dp]."""
ARRIVAL_TOLERANCE = 0.015
"""A tip nearer than this to where it was sent is there [m]."""


class ArmPanel(ArmDials):
    """Dispatches `on_command(order)` for a pose, the gripper, a point for the tip, or a turn of the foot or the hand.

    A finger drags the tip, or the hand of a dial; what it means is asked for when it is lifted. Where the panel is small
    one button opens the poses.
    """

    accepts: ClassVar = (ArmState,)
    sends: ClassVar = (ArmOrder,)
    drawn_from: ClassVar = (
        "angles", "wanted", "gripper", "pose", "tip", "touching", "choosing", "outcome", "links", "held", "aim", "bearing",
    )  # fmt: skip

    wanted: ListProperty[float] = ListProperty()
    """Where each is going [rad]; empty when that is not known."""
    tip: ListProperty[float] = ListProperty()
    """Between the fingertips, in `base_link` [m]; empty before the first."""
    touching = BooleanProperty(False)
    """The hand touches something."""
    links: ObjectProperty[Links] = ObjectProperty(Links())
    """Lengths for the picture."""
    outcome = OptionProperty("ready", options=list(OUTCOMES))
    """What became of the last order."""

    def __init__(self, **kwargs: Any) -> None:
        self._start = (0.0, 0.0)
        self._joints = []
        self._forget = Clock.create_trigger(lambda _: self.answer("ready"), OUTCOME_TIMEOUT)
        super().__init__(**{"title": tr("Arm"), **kwargs})

    def show(self, msg: ArmState) -> None:
        """Show where the arm is and where it goes; one joint that is not known is a dash for all."""
        self.angles, self.wanted = _whole(msg.angles), _whole(msg.wanted)
        self.gripper = round(msg.gripper, 3) if math.isfinite(msg.gripper) else math.nan
        tip = [round(value, 3) for value in (msg.tip.x, msg.tip.y, msg.tip.z)]
        self.tip = tip if all(map(math.isfinite, tip)) else []
        self.poses, self.pose, self.touching = [*msg.poses[:MAX_POSES]], msg.pose, msg.touching
        self._joints = [*(msg.wanted if self.wanted else msg.angles)]
        if self.aim and not self.held and self._arrived():
            self.aim = []

    def _arrived(self) -> bool:
        """It is where it was sent, or rests and nothing is heard any more of the order."""
        if not self.known:
            return False
        tip = side_points(tuple(self.angles), self.links)[-1]
        near = math.hypot(tip[0] - self.aim[0], tip[1] - self.aim[1]) < ARRIVAL_TOLERANCE
        return near or (self.outcome == "ready" and not self.moving)

    @property
    def moving(self) -> bool:
        """It is on its way."""
        pairs = zip(self.angles, self.wanted, strict=False)
        return any(abs(now - goal) > MOVING_THRESHOLD for now, goal in pairs)

    def press(self, pose: str) -> None:
        """Go to a pose as a finger would say it, and no longer to a point."""
        self.aim = []
        super().press(pose)

    def reach(self, out: float, up: float) -> None:
        """Send the tip there in the plane of the arm, ahead of and above the foot [m], as a finger would."""
        self.aim = [out, up]
        x, y, z = moved_tip(tuple(self.tip), tuple(self.angles), (out, up), self.links)
        self.dispatch("on_command", ArmOrder(point=Point(x, y, z)))

    def spring(self) -> None:
        """What was being dragged is forgotten; where the arm was sent before stays."""
        if self.held == "tip":
            self.aim = []
        self.held, self.bearing = "", math.nan

    # what the finger drags

    def holds(self, x: float, y: float) -> bool:
        """On the tip, or on the dial of the foot."""
        return bool(self._handle(x, y))

    @property
    def tip_on_glass(self) -> tuple[float, float]:
        """Where the tip is drawn [px]; only while all joints are known."""
        return self.side.at(side_points(tuple(self.angles), self.links)[-1])

    def _handle(self, x: float, y: float) -> str:
        if not self.known or not self.tip or (self.choosing and not self.beside):
            return ""
        far = {name: math.dist((x, y), dial[:2]) for name, dial in self.dials.items()}
        far["tip"] = math.dist((x, y), self.tip_on_glass)
        nearest = min(far, key=lambda name: far[name])
        return nearest if far[nearest] <= theme.target * (0.75 if nearest == "tip" else 0.5) else ""

    def follow(self, touch: Any) -> None:
        """Move what is dragged as far as the finger went, so that it is seen beside it."""
        if not self.held:
            self.held, self._start = self._handle(*touch.pos), touch.pos
        if math.dist(touch.pos, self._start) < dp(MIN_DRAG) and not self.aim and math.isnan(self.bearing):
            return
        if self.held == "tip":
            tip = self.tip_on_glass
            place = tip[0] + touch.x - self._start[0], tip[1] + touch.y - self._start[1]
            self.aim = [round(value, 3) for value in self.side.point(place)]
        elif self.held in self.dials:
            self.follow_dial(*touch.pos)

    def on_touch_up(self, touch: Any) -> bool:
        """Ask for what was dragged, where it was."""
        held, aim, bearing = (
            (self.held, [*self.aim], self.bearing) if touch.grab_current is self else ("", [], 0)
        )
        done = bool(super().on_touch_up(touch))
        if held == "tip" and aim:
            self.reach(*aim)
        elif held and not math.isnan(bearing):
            self._send(held, bearing)
        return done

    def answer(self, outcome: str) -> None:
        """Say what became of an order: `sent`, `accepted`, `refused` or `no_reply`; all but the first for three seconds."""
        self._forget.cancel()
        if outcome == "ready" and self.outcome in ("refused", "no_reply") and not self.held:
            self.aim = []
        self.outcome = outcome
        if outcome not in ("ready", "sent"):
            self._forget()

    # the picture

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The header, and the arm from the side where the poses do not lie over it."""
        words, role = self._standing()
        yield from self.header(words, role)
        if self.choosing and not self.beside:
            return
        left, low, width, height = self.view
        if height < dp(36):
            return
        if not self.known:
            yield Word(DASH, left + width / 2, low + height / 2, sp(20), theme.muted)
            return
        roomy, side = height >= dp(ROOMY), self.side
        draw_deck(shapes, (side.x, side.y), (left, left + width), side.scale, self.links)
        if self.moving and len(self.wanted) == len(self.angles):
            goal = side_points(tuple(self.wanted), self.links) * side.scale + (side.x, side.y)
            shapes.dashes(goal, dp(3), theme.plan, period=dp(10), dash=dp(4))
        points = side_points(tuple(self.angles), self.links) * side.scale + (side.x, side.y)
        draw_arm(shapes, points, side.scale, opening=self.gripper, touching=self.touching)
        if self.tip and self.state != "disabled":
            shapes.ring(
                float(points[-1][0]),
                float(points[-1][1]),
                dp(14),
                dp(1.5),
                theme.text if self.held == "tip" else theme.muted,
            )
        if self.aim:
            failed = self.outcome in ("refused", "no_reply") and not self.held
            draw_aim(shapes, points[-1], side.at(self.aim), theme.danger if failed else theme.plan)
        yield from self._figures((left, low, width, height), roomy)
        yield from self.dial_marks(shapes, roomy=roomy)

    def _figures(self, box: tuple[float, float, float, float], roomy: bool) -> Iterator[Word]:
        """Where the tip is and how wide the gripper is open."""
        left, low, width, _ = box
        wide_open = "" if math.isnan(self.gripper) else f"{figure(self.gripper * 1000, 0)} mm"
        if not roomy:
            yield Word("GRIP", left, low + sp(22), sp(11), theme.muted, anchor=(0, 0.5))
            yield Word(wide_open or DASH, left, low + sp(8), sp(13), theme.text, bold=True, anchor=(0, 0.5))
            return
        y, held = low + sp(7), self.held == "tip" and bool(self.aim)
        grip = "" if held else f"grip {wide_open or DASH}"
        yield Word(grip, left + width, y, sp(12.5), theme.text, anchor=(1, 0.5))
        if not self.tip:
            return
        word, tip, role = "tip", tuple(self.tip), theme.muted
        if held:
            word, role = "to", theme.plan
            tip = moved_tip(tip, tuple(self.angles), (self.aim[0], self.aim[1]), self.links)
        out, up = math.hypot(tip[0], tip[1]), tip[2]
        room = width - (0 if held else wide(grip, sp(12.5)) + dp(8))
        texts = (f"{word} {out:.2f} m out, {figure(up, 2)} m up", f"{word} {out:.2f}, {figure(up, 2)} m")
        yield Word(first_fitting(texts, sp(12.5), room), left, y, sp(12.5), role, anchor=(0, 0.5))

    def _standing(self) -> tuple[tuple[str, ...], str]:
        """What it does, or what became of an order, longest first, and the role of that."""
        word, role, _ = OUTCOMES[self.outcome]
        if self.outcome in ("sent", "refused", "no_reply"):
            return (tr(word),), role
        if not self.angles:
            return (), "muted"
        if self.touching:
            return (tr("touches something"), tr("touches")), "warn"
        if self.moving:
            return ("moving",), "plan"
        return (pose_words(self.pose),) if self.pose else ("still",), "text"


def _whole(values: Float64Array) -> list[float]:
    """Rounded to what is seen; empty when one of them is no number."""
    told = [round(float(value), 2) for value in values]
    return told if all(map(math.isfinite, told)) else []


POSES = {
    "rest": (0.0, -1.6, 1.25, 0.35, 0.0),
    "home": (0.0, -1.05, 0.35, 0.70, 0.0),
    "stretch": (0.0, 0.9, -0.55, -0.35, 0.0),
    "look_down": (0.0, -0.6, 0.2, 1.6, 0.0),
}
"""Of the samples."""
SMALL = (176.0, 176.0)


def _state(pose: str, **figures: Any) -> ArmState:
    """In that pose, or as `figures` have it."""
    angles = figures.get("angles", POSES[pose])
    return ArmState(
        angles=Float64Array(angles),
        wanted=Float64Array(figures.get("wanted", angles)),
        gripper=figures.get("gripper", 0.04),
        pose="" if "angles" in figures else pose,
        poses=figures.get("poses", list(POSES)),
        tip=Point(0.29, 0.05, 0.21),
        touching=figures.get("touching", False),
    )


def _made(
    msg: ArmState | None, size: tuple[float, float] = (326.0, 228.0), **more: Any
) -> Callable[[], Widget]:
    """Builds a panel that shows a message, or nothing yet."""

    def build() -> ArmPanel:
        panel = ArmPanel(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
        if msg is not None:
            panel.show(msg)
        return panel

    return build


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the panel by name."""
    home, stretch = _state("home"), _state("stretch")
    moving = _state("home", angles=(0.4, -0.5, 0.1, 0.3, 0.5), wanted=POSES["stretch"])
    many = _state("home", poses=[*POSES, "pick", "place", "wave"])
    return {
        "never": _made(None, state="never"),
        "live": _made(home),
        "moving": _made(moving),
        "touching": _made(_state("stretch", gripper=0.02, touching=True)),
        "look down": _made(_state("look_down", gripper=0.075)),
        "refused": _made(home, outcome="refused", aim=[0.38, 0.36]),
        "dragged": _made(home, held="tip", aim=[0.33, 0.04]),
        "turned": _made(home, held="turn", bearing=0.9),
        "rolled": _made(home, held="roll", bearing=-0.6),
        "four joints": _made(_state("home", angles=POSES["home"][:4])),
        "many poses": _made(many),
        "small": _made(home, SMALL),
        "small moving": _made(moving, SMALL),
        "stacked": _made(home, (268.0, 176.0)),
        "stacked dragged": _made(home, (268.0, 176.0), held="tip", aim=[0.3, 0.05]),
        "small dragged": _made(home, SMALL, held="tip", aim=[0.2, 0.1]),
        "small poses": _made(home, SMALL, choosing=True),
        "small many poses": _made(many, SMALL, choosing=True),
        "small never": _made(None, SMALL, state="never"),
        "tall": _made(stretch, (228.0, 330.0)),
        "large": _made(home, (520.0, 330.0)),
        "not known": _made(_state("home", angles=(0.0, math.nan, 0.0, 0.0))),
        "stale": _made(home, state="stale", age=2.0),
        "alarm": _made(home, state="alarm"),
        "disabled": _made(home, state="disabled"),
    }
