"""An arm from the side, with a button for each pose that has a name and one for its gripper.

arm = ArmPanel()
robot.on("/arm", arm.show)
arm.bind(on_command=lambda _, order: robot.call("/arm/move", order))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.clock import Clock
from kivy.metrics import dp, sp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    ListProperty,
    NumericProperty,
    ObjectProperty,
    OptionProperty,
    StringProperty,
)
from kivy.uix.widget import Widget

from bridge.msgs.arrays import Float64Array
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import ArmOrder, ArmState
from widgets.arm_picture import Links, draw_arm, draw_deck, side_points
from widgets.base import Control
from widgets.buttons import QuietButton
from widgets.gauge import Gauge, first_fitting, wide
from widgets.geometry import DASH, dial_point
from widgets.ink import Word
from widgets.readout import figure
from widgets.shapes import Shapes
from widgets.slide_confirm import OUTCOMES
from widgets.theme import theme

__all__ = ["ArmPanel", "samples"]

TOLD = 3.0
"""How long an outcome is told [s]."""
CHOICE = 8.0
"""How long the poses stay open without a finger [s]."""
WIDE = 1.25
"""From this share of its height on the buttons stand beside the picture."""
SEEN = (-0.20, 0.42, -0.12, 0.44)
"""What the picture shows: behind and ahead of, below and above the foot [m]."""
STILL = 0.02
"""Joints nearer than this to where they go are there [rad]."""
MOST = 32
"""Poses that are taken from a message."""


class PoseKey(QuietButton):
    """One of the panel's buttons."""

    name = StringProperty("")
    """Of the pose; empty for what is none."""


class ArmPanel(Control, Gauge):
    """Dispatches `on_command(order)` for a pose or the gripper. Where it is small one button opens the poses."""

    accepts: ClassVar = (ArmState,)
    sends: ClassVar = (ArmOrder,)
    drawn_from: ClassVar = (
        "angles",
        "wanted",
        "gripper",
        "pose",
        "tip",
        "touching",
        "choosing",
        "outcome",
        "links",
    )

    angles = ListProperty()
    """Of the joints from the foot on [rad]; empty before the first, or while one is not known."""
    wanted = ListProperty()
    """Where each is going [rad]; empty when that is not known."""
    gripper = NumericProperty(math.nan)
    """Opening between the fingers [m]; NaN when not known."""
    tip = ListProperty()
    """Between the fingertips, in `base_link` [m]; empty before the first."""
    pose = StringProperty("")
    """The named pose that it is in; empty for any other."""
    poses = ListProperty()
    """Those that have names."""
    touching = BooleanProperty(False)
    """The hand touches something."""
    links = ObjectProperty(Links())
    """Lengths for the picture."""
    open_width = NumericProperty(0.075)
    """Opening of the gripper when it is wide open [m]."""
    choosing = BooleanProperty(False)
    """The poses are open over the picture."""
    page = NumericProperty(0)
    """Which of the poses are shown where there is no room for all."""
    outcome = OptionProperty("ready", options=list(OUTCOMES))
    """What became of the last order."""

    def _beside(self) -> bool:
        return bool(self.width >= WIDE * self.height and self.width >= dp(260))

    beside = AliasProperty(_beside, bind=["size"], cache=True)
    """There is room for the poses beside the picture."""

    def __init__(self, **kwargs: Any) -> None:
        self._keys: list[PoseKey] = []
        self._forget = Clock.create_trigger(lambda _: self.answer("ready"), TOLD)
        self._close = Clock.create_trigger(lambda _: self.rest(), CHOICE)
        self.arrange = Clock.create_trigger(self._arrange, -1)
        super().__init__(**{"title": "Arm", **kwargs})
        self.chooser = PoseKey(text="Poses", icon="precision_manufacturing", size_hint=(None, None))
        self.chooser.bind(on_release=lambda _: self.choose())
        self.grip = PoseKey(size_hint=(None, None))
        self.grip.bind(on_release=lambda _: self.press_gripper())
        for name in ("pos", "size", "poses", "pose", "choosing", "page", "card"):
            self.fbind(name, self.arrange)
        self.fbind("gripper", self._label_gripper)
        theme.bind(target=self._on_target)
        self._arrange()

    def _on_target(self, *_: object) -> None:
        self.arrange()

    def show(self, msg: ArmState) -> None:
        """Show where the arm is and where it goes; one joint that is not known is a dash for all."""
        self.angles, self.wanted = _whole(msg.angles), _whole(msg.wanted)
        self.gripper = round(msg.gripper, 3) if math.isfinite(msg.gripper) else math.nan
        tip = [round(value, 3) for value in (msg.tip.x, msg.tip.y, msg.tip.z)]
        self.tip = tip if all(map(math.isfinite, tip)) else []
        self.poses, self.pose, self.touching = [*msg.poses[:MOST]], msg.pose, msg.touching

    @property
    def moving(self) -> bool:
        """It is on its way."""
        pairs = zip(self.angles, self.wanted, strict=False)
        return any(abs(now - goal) > STILL for now, goal in pairs)

    @property
    def opens(self) -> bool:
        """The gripper's button opens it, and does not close it."""
        return not self.gripper > self.open_width / 2

    def press(self, pose: str) -> None:
        """Go to a pose as a finger would say it."""
        self.choosing = False
        self.dispatch("on_command", ArmOrder(pose=pose))

    def press_gripper(self) -> None:
        """Open or close the gripper as a finger would."""
        self.dispatch("on_command", ArmOrder(gripper=self.open_width if self.opens else 0.0))

    def choose(self) -> None:
        """Open the poses over the picture; they close by themselves after a while."""
        self.choosing, self.page = True, 0
        self._close()

    def turn_page(self) -> None:
        """Show the next of the poses; after the last ones the first again."""
        self.page += 1
        self._close.cancel()
        self._close()

    def rest(self) -> None:
        """Close the poses; the arm goes on."""
        self._close.cancel()
        self.choosing = False

    def answer(self, outcome: str) -> None:
        """Say what became of an order: `sent`, `accepted`, `refused` or `no_reply`; all but the first for three seconds."""
        self._forget.cancel()
        self.outcome = outcome
        if outcome not in ("ready", "sent"):
            self._forget()

    # where things are

    @property
    def inside(self) -> tuple[float, float, float, float]:
        """Left, low, width and height of what is below the header [px]."""
        edge = self.edge
        return self.x + edge, self.y + edge, self.width - 2 * edge, self.height - 2 * edge - sp(12) - dp(6)

    @property
    def view(self) -> tuple[float, float, float, float]:
        """Left, low, width and height of the picture [px]."""
        left, low, width, height = self.inside
        if self.beside:
            return left, low, width - self._keys_wide(width) - dp(10), height
        foot = theme.target + dp(8)
        return left, low + foot, width, max(height - foot, 1.0)

    def _keys_wide(self, width: float) -> float:
        return max(width * 0.48, min(2 * theme.target + dp(8), width * 0.6))

    def _arrange(self, *_: object) -> None:
        """Put the buttons where they belong."""
        for child in self.children[:]:
            self.remove_widget(child)
        left, low, width, height = self.inside
        if self.width < dp(120) or height < theme.target:
            return
        self._label_gripper()
        gap = dp(8)
        if self.beside:
            keys = self._keys_wide(width)
            x = left + width - keys
            rows = self._rows(height - theme.target - gap)
            self._put_poses((x, low, keys, height), rows + 1, rows)
            high = (height - rows * gap) / (rows + 1) if self.poses else theme.target
            self._put(self.grip, (x, low, keys, high))
        elif self.choosing:
            rows = self._rows(height)
            self._put_poses((left, low, width, height), rows, rows)
        else:
            half = (width - gap) / 2
            self.chooser.disabled = not self.poses
            self._put(self.chooser, (left, low, half, theme.target))
            self._put(self.grip, (left + half + gap, low, half, theme.target))

    def _rows(self, high: float) -> int:
        """Rows of two poses each that have room in `high` [px]: as many as there are poses for, one at least."""
        fits = max(1, int((high + dp(8)) // (theme.target + dp(8))))
        return min(fits, max(1, math.ceil(len(self.poses) / 2)))

    def _put_poses(self, box: tuple[float, float, float, float], rows: int, own: int) -> None:
        """Keys for the poses in `own` upper rows of `rows`, and one that turns the page where there are more."""
        left, low, width, height = box
        gap, names = dp(8), list(self.poses)
        half, high = (width - gap) / 2, (height - (rows - 1) * gap) / rows
        room = 2 * own
        paged = len(names) > room
        if paged:
            pages = math.ceil(len(names) / (room - 1))
            first = self.page % pages * (room - 1)
            names = names[first : first + room - 1]
            self._put(self._key(room - 1, ""), self._place(left, low, (half, high), rows, room - 1))
        for number, name in enumerate(names):
            alone = number == len(names) - 1 and number % 2 == 0 and not paged
            x, y, wide_, tall = self._place(left, low, (half, high), rows, number)
            self._put(self._key(number, name), (x, y, width if alone else wide_, tall))

    @staticmethod
    def _place(
        left: float, low: float, size: tuple[float, float], rows: int, number: int
    ) -> tuple[float, float, float, float]:
        row, column = divmod(number, 2)
        return left + column * (size[0] + dp(8)), low + (rows - 1 - row) * (size[1] + dp(8)), *size

    def _key(self, number: int, name: str) -> PoseKey:
        """The key of that number, made when it is first needed; without a name it turns the page."""
        while number >= len(self._keys):
            key = PoseKey(size_hint=(None, None))
            key.bind(on_release=self._pressed)
            self._keys.append(key)
        key, here = self._keys[number], bool(name) and name == self.pose
        key.name, key.text = name, _said(name) if name else "More"
        key.meaning = name or "more"
        key.icon = "check" if here else "" if name else "more_horiz"
        key.ink, key.border = ("accent", "accent") if here else ("text", "line")
        return key

    def _pressed(self, key: PoseKey) -> None:
        if key.name:
            self.press(key.name)
        else:
            self.turn_page()

    def _put(self, key: PoseKey, box: tuple[float, float, float, float]) -> None:
        key.pos, key.size = box[:2], box[2:]
        key.flow = "horizontal" if key.width >= dp(126) else "vertical"
        if key.name and not key.icon and wide(key.text, sp(14), bold=True) > key.width - dp(20):
            key.text = key.text.replace(" ", "\n")
        self.add_widget(key)

    def _label_gripper(self, *_: object) -> None:
        """A press does the one or the other, by how wide it is open."""
        word = "Open" if self.opens else "Close"
        self.grip.text = self.grip.meaning = f"{word} gripper" if self.beside else word
        self.grip.icon = "zoom_out_map" if self.opens else "filter_center_focus"
        self.grip.disabled = math.isnan(self.gripper)

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
        if len(self.angles) != 4:
            yield Word(DASH, left + width / 2, low + height / 2, sp(20), theme.muted)
            return
        roomy = height >= dp(118)
        foot = sp(18) if roomy else 0.0
        scale = min(width / (SEEN[1] - SEEN[0]), (height - foot) / (SEEN[3] - SEEN[2]))
        x = left + (width - (SEEN[1] - SEEN[0]) * scale) / 2 - SEEN[0] * scale
        if not roomy:
            x = left + width - dp(6) - SEEN[1] * scale
        y = low + foot - SEEN[2] * scale + max(0.0, height - foot - (SEEN[3] - SEEN[2]) * scale) / 2
        draw_deck(shapes, (x, y), (left, left + width), scale, self.links)
        if self.moving and len(self.wanted) == 4:
            goal = side_points(tuple(self.wanted), self.links) * scale + (x, y)
            shapes.dashes(goal, dp(3), theme.plan, period=dp(10), dash=dp(4))
        points = side_points(tuple(self.angles), self.links) * scale + (x, y)
        draw_arm(shapes, points, scale, opening=self.gripper, touching=self.touching)
        yield from self._figures((left, low, width, height), roomy)
        if height >= dp(62):
            yield from self._turn(shapes, left, low + height, roomy)

    def _standing(self) -> tuple[tuple[str, ...], str]:
        """What it does, or what became of an order, longest first, and the role of that."""
        word, role, _ = OUTCOMES[self.outcome]
        if self.outcome in ("sent", "refused", "no_reply"):
            return (word,), role
        if not self.angles:
            return (), "muted"
        if self.touching:
            return ("touches something", "touches"), "warn"
        if self.moving:
            return ("moving",), "plan"
        return (_said(self.pose),) if self.pose else ("at rest",), "text"

    def _figures(self, box: tuple[float, float, float, float], roomy: bool) -> Iterator[Word]:
        """Where the tip is and how wide the gripper is open."""
        left, low, width, _ = box
        wide_open = "" if math.isnan(self.gripper) else f"{figure(self.gripper * 1000, 0)} mm"
        if not roomy:
            yield Word("GRIP", left, low + sp(22), sp(11), theme.muted, anchor=(0, 0.5))
            yield Word(wide_open or DASH, left, low + sp(8), sp(13), theme.text, bold=True, anchor=(0, 0.5))
            return
        y = low + sp(7)
        grip = f"grip {wide_open or DASH}"
        yield Word(grip, left + width, y, sp(12.5), theme.text, anchor=(1, 0.5))
        if self.tip:
            out, up = math.hypot(self.tip[0], self.tip[1]), self.tip[2]
            room = width - wide(grip, sp(12.5)) - dp(8)
            texts = (f"tip {out:.2f} m out, {figure(up, 2)} m up", f"tip {out:.2f}, {figure(up, 2)} m")
            yield Word(first_fitting(texts, sp(12.5), room), left, y, sp(12.5), theme.muted, anchor=(0, 0.5))

    def _turn(self, shapes: Shapes, left: float, top: float, roomy: bool) -> Iterator[Word]:
        """How far its foot is turned, seen from above."""
        radius = dp(15 if roomy else 12)
        x, y = left + radius, top - radius - dp(1)
        shapes.disc(x, y, radius, theme.raised)
        shapes.ring(x, y, radius - dp(0.75), dp(1.5), theme.line)
        degrees = math.degrees(self.angles[0])
        end = dial_point(-degrees, radius * 0.8)
        shapes.line(np.array([[x, y], [x + end[0], y + end[1]]]), dp(3), theme.accent)
        shapes.disc(x, y, dp(2.5), theme.text)
        side = "" if abs(degrees) < 0.5 else " left" if degrees > 0 else " right"
        text = f"{abs(degrees):.0f}°{side}" if roomy else f"{abs(degrees):.0f}°{side[:2].upper()}"
        yield Word(text, x + radius + dp(6), y, sp(12.5 if roomy else 12), theme.muted, anchor=(0, 0.5))


def _whole(values: Float64Array) -> list[float]:
    """Rounded to what is seen; empty when one of them is no number."""
    told = [round(float(value), 2) for value in values]
    return told if all(map(math.isfinite, told)) else []


def _said(name: str) -> str:
    """A name as people write it."""
    return name.replace("_", " ").capitalize()


POSES = {
    "rest": (0.0, -1.6, 1.25, 0.35),
    "home": (0.0, -1.05, 0.35, 0.70),
    "stretch": (0.0, 0.9, -0.55, -0.35),
    "look_down": (0.0, -0.6, 0.2, 1.6),
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


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the panel by name."""

    def made(
        msg: ArmState | None, size: tuple[float, float] = (326.0, 228.0), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> ArmPanel:
            panel = ArmPanel(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if msg is not None:
                panel.show(msg)
            return panel

        return build

    home, stretch = _state("home"), _state("stretch")
    moving = _state("home", angles=(0.4, -0.5, 0.1, 0.3), wanted=POSES["stretch"])
    many = _state("home", poses=[*POSES, "pick", "place", "wave"])
    return {
        "never": made(None, state="never"),
        "live": made(home),
        "moving": made(moving),
        "touching": made(_state("stretch", gripper=0.02, touching=True)),
        "look down": made(_state("look_down", gripper=0.075)),
        "refused": made(home, outcome="refused"),
        "many poses": made(many),
        "small": made(home, SMALL),
        "small moving": made(moving, SMALL),
        "small poses": made(home, SMALL, choosing=True),
        "small many poses": made(many, SMALL, choosing=True),
        "small never": made(None, SMALL, state="never"),
        "tall": made(stretch, (228.0, 330.0)),
        "large": made(home, (520.0, 330.0)),
        "not known": made(_state("home", angles=(0.0, math.nan, 0.0, 0.0))),
        "stale": made(home, state="stale", age=2.0),
        "alarm": made(home, state="alarm"),
        "disabled": made(home, state="disabled"),
    }
