"""Base of controls that one finger or a gamepad pushes and that spring back: `Joystick`, `RudderThrottle`.

class Lever(Stick):
    def shaped(self, forward, left): return forward, 0.0
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, ClassVar

from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, OptionProperty

from bridge.msgs import Msg
from widgets.controls.finger_grip import Grip
from widgets.core.base import text_texture
from widgets.core.canvas_ink import Drawing, Ink, tint
from widgets.core.icons import icon
from widgets.core.language import tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["DEAD_ZONE", "MIN_PUSH", "Stick"]

DEAD_ZONE = 0.07
"""Of the way to the rim, round the middle: a resting thumb commands nothing."""
MIN_PUSH = 1e-6
"""A share of the way that is only an error of rounding."""

GAMEPAD = {
    "none": ("", ""),
    "ready": ("muted", "sports_esports"),
    "drives": ("accent", "sports_esports_fill"),
    "silent": ("warn", "link_off"),
    "let go": ("warn", "block"),
    "keys": ("accent", "keyboard"),
}
"""What is known of a gamepad, which is also the word beside its sign, to the role and the icon of that; `keys` push it instead."""

Builder.load_string("""
<Stick>:
    canvas.after:
        Rounded:
            rgba: theme.roles[root.sign_role] if root.sign_role else (0, 0, 0, 0)
            pos: root.sign_pos
            size: root.sign_size
            radius: [root.sign_size[1] / 2]
        Rounded:
            rgba: theme.surface if root.sign_role else (0, 0, 0, 0)
            pos: root.sign_pos[0] + theme.outline, root.sign_pos[1] + theme.outline
            size: root.sign_size[0] - 2 * theme.outline, root.sign_size[1] - 2 * theme.outline
            radius: [root.sign_size[1] / 2 - theme.outline]
        Tinted:
            rgba: theme.roles[root.sign_role] if root.sign_role else (0, 0, 0, 0)
            texture: root.sign
            size: root.sign.size
            pos: root.sign_pos[0] + dp(7), root.sign_pos[1] + (root.sign_size[1] - root.sign.height) / 2
        Tinted:
            rgba: theme.roles[root.sign_role] if root.sign_role else (0, 0, 0, 0)
            texture: root.sign_word
            size: root.sign_word.size
            pos: root.sign_pos[0] + root.sign.width + dp(11), root.sign_pos[1] + (root.sign_size[1] - root.sign_word.height) / 2
""")


class Stick(Grip, Drawing):
    """Dispatches `on_command(order)` at every change. It follows the finger that came down on it and no other.

    A subclass says how a push is `shaped`, where its middle and its `travel` are, which `order` that is, and draws it.
    """

    to_topic: ClassVar = True
    drawn_from: ClassVar[tuple[str, ...]] = ("forward", "left")

    forward = NumericProperty(0.0)
    """How far the stick is pushed away from the operator, -1 to 1."""
    left = NumericProperty(0.0)
    """How far it is pushed to the left, -1 to 1."""

    bare = BooleanProperty(False)
    """Over a picture that shall be seen: no ground below it, faint lines, and a full knob only while it is pushed."""

    knob_pos: Any
    """The knob's middle [px]."""
    knob_radius: Any
    """Of the knob [px]."""

    gamepad = OptionProperty("none", options=list(GAMEPAD))
    """A gamepad drives the stick too: `none`, `ready`, `drives`, `silent`, which commands nothing, or `let go`, which is pushed and
    commands nothing before it was let go; `keys` where keys drive it."""

    def _sign(self) -> Texture:
        return text_texture(icon(GAMEPAD[self.gamepad][1] or "sports_esports"), sp(20), theme.icons)

    sign = AliasProperty(_sign, bind=["gamepad"], cache=True)
    """Of a gamepad, with its word in a corner."""

    def _sign_word(self) -> Texture:
        return text_texture(self.gamepad, sp(12.5), theme.font, bold=True)

    sign_word = AliasProperty(_sign_word, bind=["gamepad"], cache=True)
    """What the gamepad does."""

    def _sign_size(self) -> tuple[float, float]:
        return self.sign.width + self.sign_word.width + dp(20), dp(26)

    sign_size = AliasProperty(_sign_size, bind=["sign", "sign_word"], cache=True)
    """[px]"""

    def _sign_pos(self) -> tuple[float, float]:
        return self.sign_place()

    sign_pos = AliasProperty(_sign_pos, bind=["sign_size", "pos", "size"], cache=True)
    """[px]"""

    def _sign_role(self) -> str:
        return GAMEPAD[self.gamepad][0]

    sign_role = AliasProperty(_sign_role, bind=["gamepad"], cache=True)
    """Role of its colour; empty while there is none."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not hasattr(self, "_ink"):  # a gauge has its own, below its words
            self._ink = Ink()
            self.canvas.add(self._ink)
        for name in ("bare", "state"):
            self.fbind(name, self.redraw)

    def _veil(self) -> list[float]:
        """None that would hide the picture: of a bare stick the colour of the knob says what it would say."""
        return [*theme.surface[:3], 0.0] if self.bare else super()._veil()

    veil = AliasProperty(_veil, bind=["state", "bare"])

    def glassy(self, colour: Sequence[float], alpha: float = 1.0) -> tuple[float, ...]:
        """`colour` as it is drawn with so much `alpha`, 0 to 1: of a bare stick only a little of it."""
        return tint(colour, alpha * (0.45 if self.bare else 1.0))

    def draw_knob(
        self, shapes: Shapes, place: tuple[float, float], radius: float, colour: Sequence[float]
    ) -> None:
        """The knob at `place`, in `colour`; of a bare stick at rest only its rim, grey while it is disabled."""
        if self.bare and not (self.forward or self.left):
            rim = theme.muted if self.state == "disabled" else colour
            shapes.disc(*place, radius, tint(theme.surface, 0.25))
            shapes.ring(*place, radius - dp(1.5), dp(3), tint(rim, 0.9))
            return
        shapes.disc(*place, radius, colour)
        shapes.ring(*place, radius - dp(6), dp(2), tint(theme.knob, 0.6))

    @property
    def hides(self) -> list[tuple[float, float, float, float]]:
        """Left, low, width and height of what of a picture behind it cannot be seen [px]."""
        if not self.bare:
            return [(*self.pos, *self.size)]
        (x, y), radius = self.knob_pos, self.knob_radius
        return [(x - radius, y - radius, 2 * radius, 2 * radius)]

    @property
    def order(self) -> Msg:
        """What the stick commands now."""
        raise NotImplementedError(f"{type(self).__name__} does not say what it commands")

    @property
    def middle(self) -> tuple[float, float]:
        """Where the knob's middle is at rest [px]."""
        return self.center_x, self.center_y

    @property
    def travel(self) -> tuple[float, float]:
        """From there to where it can be at most, across and up [px]."""
        raise NotImplementedError(f"{type(self).__name__} does not say how far it goes")

    def shaped(self, forward: float, left: float) -> tuple[float, float]:
        """What a push to `forward` and `left`, of any length, comes to: each -1 to 1."""
        raise NotImplementedError(f"{type(self).__name__} does not say what a push comes to")

    def sign_place(self) -> tuple[float, float]:
        """Lower left corner of the gamepad's sign [px]."""
        return self.right - self.sign_size[0], self.top - self.sign_size[1]

    def lean(self, forward: float, left: float) -> bool:
        """Push the stick to `forward` and `left`, each -1 to 1, and command what that means; for gamepads.

        False, and nothing is commanded, while a finger has it. ValueError for what is not finite.
        """
        if not math.isfinite(forward + left):
            raise ValueError(
                tr("A stick leans from -1 to 1, not to {forward}, {left}.").format(forward=forward, left=left)
            )
        if self._finger is not None:
            return False
        self._push(forward, left)
        return True

    def _push(self, forward: float, left: float) -> None:
        shaped = self.shaped(forward, left)
        forward, left = (0.0 if abs(share) < MIN_PUSH else share for share in shaped)
        if (forward, left) != (self.forward, self.left):
            self.forward, self.left = forward, left
            self.dispatch("on_command", self.order)

    def follow(self, touch: Any) -> None:
        """Lean towards the finger."""
        (x, y), (across, up) = self.middle, self.travel
        self._push((touch.y - y) / up, (x - touch.x) / across)

    def spring(self) -> None:
        """Back to the middle; commands zero if it was not there already."""
        self._push(0.0, 0.0)
