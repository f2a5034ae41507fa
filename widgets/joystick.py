"""A stick for one thumb: pushed forward it drives, pushed aside it turns, let go it springs back.

stick = Joystick(max_speed=0.5, max_yaw_rate=1.5)
stick.bind(on_command=lambda _, twist: drive.command(twist))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, NumericProperty, OptionProperty
from kivy.uix.widget import Widget

from bridge.msgs.geometry_msgs import Twist
from widgets.base import Control, text_texture
from widgets.icons import icon
from widgets.ink import Drawing, Ink, tint
from widgets.shapes import Shapes
from widgets.theme import theme

__all__ = ["Joystick"]

DEAD = 0.07
"""Of the way to the rim, round the middle: a resting thumb commands nothing."""
SLIGHT = 1e-6
"""A share of the way that is only an error of rounding."""

GAMEPAD = {
    "none": ("", ""),
    "ready": ("muted", "sports_esports"),
    "drives": ("accent", "sports_esports_fill"),
    "silent": ("warn", "link_off"),
}
"""What is known of a gamepad, which is also the word beside its sign, to the role and the icon of that."""

Builder.load_string("""
<Joystick>:
    canvas.after:
        Color:
            rgba: theme.roles[root.sign_role] if root.sign_role else (0, 0, 0, 0)
        RoundedRectangle:
            pos: root.sign_pos
            size: root.sign_size
            radius: [root.sign_size[1] / 2]
        Color:
            rgba: theme.surface if root.sign_role else (0, 0, 0, 0)
        RoundedRectangle:
            pos: root.sign_pos[0] + theme.outline, root.sign_pos[1] + theme.outline
            size: root.sign_size[0] - 2 * theme.outline, root.sign_size[1] - 2 * theme.outline
            radius: [root.sign_size[1] / 2 - theme.outline]
        Color:
            rgba: theme.roles[root.sign_role] if root.sign_role else (0, 0, 0, 0)
        Rectangle:
            texture: root.sign
            size: root.sign.size
            pos: root.sign_pos[0] + dp(7), root.sign_pos[1] + (root.sign_size[1] - root.sign.height) / 2
        Rectangle:
            texture: root.sign_word
            size: root.sign_word.size
            pos: root.sign_pos[0] + root.sign.width + dp(11), root.sign_pos[1] + (root.sign_size[1] - root.sign_word.height) / 2
""")


class Joystick(Control, Drawing):
    """Dispatches `on_command(twist)` at every change. It follows the finger that came down on it and no other."""

    __events__ = ("on_in_vain",)
    sends = (Twist,)
    drawn_from: ClassVar[tuple[str, ...]] = ("forward", "left", "max_speed", "max_yaw_rate")

    max_speed = NumericProperty(0.5)
    """Forward speed at the rim [m/s], 0 or more."""
    max_yaw_rate = NumericProperty(1.0)
    """Yaw rate at the rim [rad/s], 0 or more."""

    forward = NumericProperty(0.0)
    """How far the stick is pushed away from the operator, -1 to 1."""
    left = NumericProperty(0.0)
    """How far it is pushed to the left, -1 to 1."""

    gamepad = OptionProperty("none", options=list(GAMEPAD))
    """A gamepad drives the stick too: `none`, `ready`, `drives`, or `silent`, which commands nothing."""

    def _reach(self) -> float:
        return max(1.0, min(self.size) / 2 - self.knob_radius - dp(6))

    def _knob_radius(self) -> float:
        return min(min(self.size) * 0.18, theme.target)

    knob_radius = AliasProperty(_knob_radius, bind=["size"], cache=True)
    """[px]"""
    reach = AliasProperty(_reach, bind=["size"], cache=True)
    """From the middle to where the knob's middle can be at most [px]."""

    def _knob_pos(self) -> tuple[float, float]:
        return self.center_x - self.left * self.reach, self.center_y + self.forward * self.reach

    knob_pos = AliasProperty(_knob_pos, bind=["left", "forward", "reach", "pos"], cache=True)
    """The knob's middle [px]."""

    def _sign(self) -> Texture:
        return text_texture(icon(GAMEPAD[self.gamepad][1] or "sports_esports"), sp(20), theme.icons)

    sign = AliasProperty(_sign, bind=["gamepad"], cache=True)
    """Of a gamepad, with its word in the corner that the round leaves free."""

    def _sign_word(self) -> Texture:
        return text_texture(self.gamepad, sp(12.5), theme.font, bold=True)

    sign_word = AliasProperty(_sign_word, bind=["gamepad"], cache=True)
    """What the gamepad does."""

    def _sign_size(self) -> tuple[float, float]:
        return self.sign.width + self.sign_word.width + dp(20), dp(26)

    sign_size = AliasProperty(_sign_size, bind=["sign", "sign_word"], cache=True)
    """[px]"""

    def _sign_pos(self) -> tuple[float, float]:
        return self.right - self.sign_size[0], self.top - self.sign_size[1]

    sign_pos = AliasProperty(_sign_pos, bind=["sign_size", "pos", "size"], cache=True)
    """[px]"""

    def _sign_role(self) -> str:
        return GAMEPAD[self.gamepad][0]

    sign_role = AliasProperty(_sign_role, bind=["gamepad"], cache=True)
    """Role of its colour; empty while there is none."""

    def __init__(self, **kwargs: Any) -> None:
        self._finger: Any = None
        super().__init__(**kwargs)
        self._ink = Ink()
        self.canvas.add(self._ink)
        self.fbind("size", self._round_veil)
        self.fbind("size", self._rest_under_finger)
        self.fbind("pos", self._rest_under_finger)
        self._round_veil()

    def _round_veil(self, *_: object) -> None:
        self.veil_radius = min(self.size) / 2

    def _twist(self) -> Twist:
        # + 0.0 turns the minus zero of a stick at rest into zero
        return Twist.planar(self.forward * self.max_speed + 0.0, self.left * self.max_yaw_rate + 0.0)

    twist = AliasProperty(_twist, bind=["forward", "left", "max_speed", "max_yaw_rate"])
    """What the stick commands now."""

    @property
    def finger(self) -> Any:
        """The touch that it follows; None without one."""
        return self._finger

    def lean(self, forward: float, left: float) -> bool:
        """Push the stick to `forward` and `left`, each -1 to 1, and command what that means; for gamepads.

        False, and nothing is commanded, while a finger has it. ValueError for what is not finite.
        """
        length = math.hypot(forward, left)
        if not math.isfinite(length):
            raise ValueError(f"A stick leans from -1 to 1, not to {forward}, {left}.")
        if self._finger is not None:
            return False
        self._push(forward, left)
        return True

    def _push(self, forward: float, left: float) -> None:
        length = math.hypot(forward, left)
        scale = 0.0 if length < DEAD else 1.0 / max(1.0, length)
        forward, left = (0.0 if abs(share) < SLIGHT else share * scale for share in (forward, left))
        if (forward, left) != (self.forward, self.left):
            self.forward, self.left = forward, left
            self.dispatch("on_command", self.twist)

    def rest(self) -> None:
        """Spring back and let the finger go; commands zero if it was not at rest already."""
        if self._finger is not None:
            self._finger.ungrab(self)
            self._finger = None
        self._push(0.0, 0.0)

    def _rest_under_finger(self, *_: object) -> None:
        """It was moved: where the finger is now says nothing of where it was to be pushed."""
        if self._finger is not None:
            self.rest()

    def on_touch_down(self, touch: Any) -> bool:
        """Take the first finger that comes down on the round; one that comes down again has been away, unseen."""
        if touch is self._finger:
            self.rest()
        inside = math.dist(touch.pos, self.center) <= min(self.size) / 2
        if self.disabled and inside:
            self.dispatch("on_in_vain")
        if self.disabled or self._finger is not None or not inside:
            return bool(super().on_touch_down(touch))
        touch.grab(self)
        self._finger = touch
        self._follow(touch)
        return True

    def on_touch_move(self, touch: Any) -> bool:
        """Follow it, over the rim as well."""
        if touch.grab_current is not self:
            return bool(super().on_touch_move(touch))
        self._follow(touch)
        return True

    def on_touch_up(self, touch: Any) -> bool:
        """Spring back."""
        if touch.grab_current is not self:
            return bool(super().on_touch_up(touch))
        self.rest()
        return True

    def _follow(self, touch: Any) -> None:
        self._push((touch.y - self.center_y) / self.reach, (self.center_x - touch.x) / self.reach)

    def on_in_vain(self) -> None:
        """A finger came down on it while it is disabled."""

    def draw(self) -> None:
        """The pad, its arrows, the way from the middle to the knob, the knob."""
        shapes, radius, (x, y) = Shapes(), min(self.size) / 2 - dp(1), self.center
        pushed = self.forward or self.left
        shapes.disc(x, y, radius, tint(theme.surface, 0.88))
        shapes.ring(x, y, radius - dp(0.75), dp(1.5), theme.line)
        shapes.ring(x, y, radius * 0.6, dp(1.5), theme.line, dashes=36)
        for index, share in enumerate((self.forward, self.left, -self.forward, -self.left)):
            shapes.polygon(self._arrow(index, radius), theme.accent if share > DEAD else theme.muted)
        knob = self.knob_pos
        if pushed:
            shapes.line(np.array([self.center, knob]), dp(5), theme.accent)
        shapes.disc(*knob, self.knob_radius, theme.accent)
        shapes.ring(*knob, self.knob_radius - dp(6), dp(2), tint(theme.knob, 0.6))
        self._ink.draw(shapes)

    def _arrow(self, index: int, radius: float) -> list[tuple[float, float]]:
        """A triangle that points outward: 0 ahead, and on anticlockwise by quarters."""
        yaw, size, tip = index * math.pi / 2, radius * 0.075, radius * 0.9
        ahead, aside = (-math.sin(yaw), math.cos(yaw)), (math.cos(yaw), math.sin(yaw))
        corners = ((tip, 0.0), (tip - size * 1.7, size), (tip - size * 1.7, -size))
        return [
            (self.center_x + a * ahead[0] + b * aside[0], self.center_y + a * ahead[1] + b * aside[1])
            for a, b in corners
        ]


def samples() -> dict[str, Callable[[], Widget]]:
    """At rest, pushed each way, disabled."""

    def make(forward: float = 0.0, left: float = 0.0, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            stick = Joystick(size_hint=(None, None), size=("242dp", "242dp"), **kwargs)
            stick.lean(forward, left)
            return stick

        return build

    return {
        "at rest": make(),
        "ahead to the right": make(0.8, -0.35),
        "back": make(-0.6, 0.0),
        "disabled": make(state="disabled"),
        "gamepad there": make(gamepad="ready"),
        "gamepad drives": make(0.7, 0.2, gamepad="drives"),
        "gamepad silent": make(gamepad="silent"),
        "small": lambda: Joystick(size_hint=(None, None), size=("140dp", "140dp")),
    }
