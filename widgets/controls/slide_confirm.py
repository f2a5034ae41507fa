"""Knob to slide to the other end, for what must not start by a touch in passing, such as taking off.

take_off = SlideToConfirm(text="take off", icon="arrow_upward")
take_off.bind(on_confirm=lambda _: commands.give("task.take_off"))
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.animation import Animation
from kivy.clock import Clock
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, ListProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.widget import Widget

from widgets.controls.finger_grip import Grip
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word, tint
from widgets.core.icons import icon
from widgets.core.language import mark, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["OUTCOMES", "SlideToConfirm", "samples"]

CONFIRM_SHARE = 0.98
"""Of the way; from there on it is confirmed."""
RETURN_DURATION = 0.15
"""How long it takes to slide back [s]."""
OUTCOME_TIMEOUT = 3.0
"""How long an outcome is shown [s]."""

OUTCOMES = {
    "ready": ("", "muted", ""),
    "sent": (mark("sent"), "accent", "hourglass_top"),
    "accepted": (mark("accepted"), "ok", "check_circle_fill"),
    "refused": (mark("refused"), "danger", "block"),
    "no_reply": (mark("no reply"), "warn", "signal_disconnected"),
}
"""Outcome of what was confirmed to its word, the role of its colour and its icon."""

Builder.load_string("""
<SlideToConfirm>:
    size_hint_y: None
    height: theme.target + dp(10)
    canvas.before:
        Rounded:
            rgba: theme.glass
            pos: root.track[0], root.track[1]
            size: root.track[2], root.track[3]
            radius: [root.track[3] / 2]
        Rounded:
            rgba: theme.roles[root.role][:3] + [.3]
            pos: root.track[0], root.track[1]
            size: root.knob[0] - root.track[0] + root.track[3] / 2, root.track[3]
            radius: [root.track[3] / 2]
        Color:
            rgba: theme.roles[root.role]
        SmoothLine:
            rounded_rectangle: root.track + (root.track[3] / 2,)
            width: theme.outline
        SmoothEllipse:
            pos: root.knob[0] - root.knob[2], root.knob[1] - root.knob[2]
            size: 2 * root.knob[2], 2 * root.knob[2]
""")


class SlideToConfirm(Grip, Gauge):
    """Dispatches `on_confirm` the moment the knob is at the end; let go before, it slides back and nothing is done."""

    __events__ = ("on_confirm",)
    drawn_from: ClassVar = ("text", "kin", "icon", "role", "share", "outcome")

    text = StringProperty("confirm")
    """What sliding does, in the words of an order, as in `take off`."""
    kin = ListProperty()
    """What slides beside it do: the words of all are on one line, or of all on two."""
    icon = StringProperty("chevron_right")
    """Name of the icon on the knob."""
    role = OptionProperty("accent", options=["accent", "plan", "danger"])
    """Role of its colour."""
    share = NumericProperty(0.0)
    """How far the knob is on its way, 0 to 1."""
    outcome = OptionProperty("ready", options=list(OUTCOMES))
    """What became of what was confirmed; while that is `sent`, it takes no finger."""

    def _track(self) -> tuple[float, float, float, float]:
        high = min(self.height, theme.target * 1.4)
        return self.x, self.center_y - high / 2, self.width, high

    track = AliasProperty(_track, bind=["pos", "size"], cache=True)
    """Left, low, width and height of what the knob slides in [px]."""

    def _knob(self) -> tuple[float, float, float]:
        left, low, width, high = self._track()
        radius = high / 2 - dp(5)
        start, travel = left + high / 2, max(width - high, 1.0)
        return start + self.share * travel, low + high / 2, radius

    knob = AliasProperty(_knob, bind=["share", "track"], cache=True)
    """Middle and radius of the knob [px]."""

    def __init__(self, **kwargs: Any) -> None:
        self._offset: float | None = None
        self._confirmed = False
        self._forget = Clock.create_trigger(lambda _: self.answer("ready"), OUTCOME_TIMEOUT)
        super().__init__(**{"card": False, **kwargs})
        self.fbind("track", self._round_veil)
        self._round_veil()

    def _round_veil(self, *_: object) -> None:
        self.veil_radius = self.track[3] / 2

    def answer(self, outcome: str) -> None:
        """Say what became of it: `sent`, `accepted`, `refused` or `no_reply`; all but the first for three seconds."""
        self._forget.cancel()
        self.outcome = outcome
        if outcome not in ("ready", "sent"):
            self._forget()

    def holds(self, x: float, y: float) -> bool:
        """On the knob, and nowhere else on the way; not while an order is under way."""
        at_x, at_y, radius = self.knob
        reach = max(radius + dp(5), theme.target / 2)
        return self.outcome != "sent" and abs(x - at_x) <= reach and abs(y - at_y) <= reach

    def follow(self, touch: Any) -> None:
        """Slide with the finger, and confirm at the end."""
        if self._confirmed:
            return
        Animation.cancel_all(self, "share")
        if self._offset is None:
            self._offset = touch.x - self.knob[0]
        left, _, width, high = self.track
        self.share = min(max((touch.x - self._offset - left - high / 2) / max(width - high, 1.0), 0.0), 1.0)
        if self.share >= CONFIRM_SHARE:
            self.share, self._confirmed = 1.0, True
            self.dispatch("on_confirm")

    def spring(self) -> None:
        """Slide back."""
        self._offset, self._confirmed = None, False
        Animation.cancel_all(self, "share")
        if self.share:
            Animation(share=0.0, duration=RETURN_DURATION, transition="out_quad").start(self)

    def on_confirm(self) -> None:
        """It was slid to the end: the operator means it."""

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The icon on the knob and what it does, which fades as the knob comes over it."""
        x, y, radius = self.knob
        yield Word(icon(self.icon), x, y, radius * 1.05, theme.roles[f"ink_{self.role}"], font=theme.icons)
        left, _, width, high = self.track
        start, end = left + high, left + width - high * 0.22
        room = end - start - dp(4)
        word, role, sign = OUTCOMES[self.outcome]
        if sign:
            yield from self._outcome((start + end) / 2, room, (tr(word), role, sign))
            return
        strength = min(max(1.0 - 2.2 * self.share, 0.0), 1.0)
        whole, middle = tr("slide to {text}").format(text=self.text), (start + end) / 2
        size = sp(16 if room > dp(200) else 14)
        taken = wide(whole, size, bold=True)
        if (
            max(
                taken,
                *(wide(tr("slide to {text}").format(text=text), size, bold=True) for text in self.kin),
                0,
            )
            > room
        ):
            yield Word(tr("slide to"), middle, y + sp(9), sp(12), tint(theme.muted, strength))
            size = fitting_size([self.text], sp(14), room, bold=True)
            yield Word(self.text, middle, y - sp(8), size, tint(theme.text, strength), bold=True)
            return
        yield Word(whole, middle, y, size, tint(theme.text, strength), bold=True)
        free = (room - taken) / 2
        if free > dp(34) and strength:
            self._chevrons(shapes, start + free / 2 - dp(2), y, strength)
            self._chevrons(shapes, end - free / 2 + dp(2), y, strength)

    def _outcome(self, x: float, room: float, told: tuple[str, str, str]) -> Iterator[Word]:
        word, role, sign = told
        said = first_fitting((f"{self.text}: {word}", word), sp(14), room - sp(28), bold=True)
        half = (wide(said, sp(14), bold=True) + sp(26)) / 2
        yield Word(
            icon(sign), x - half, self.center_y, sp(20), theme.roles[role], font=theme.icons, anchor=(0, 0.5)
        )
        yield Word(said, x + half, self.center_y, sp(14), theme.text, bold=True, anchor=(1, 0.5))

    def _chevrons(self, shapes: Shapes, x: float, y: float, strength: float) -> None:
        for number, share in ((-1, 0.35), (0, 0.6), (1, 0.9)):
            at = x + number * dp(9)
            points = np.array([[at - dp(3), y + dp(6)], [at + dp(3), y], [at - dp(3), y - dp(6)]])
            shapes.line(points, dp(2.4), tint(theme.muted, share * strength))


def samples() -> dict[str, Callable[[], Widget]]:
    """At rest, half way, what became of it, disabled; narrow and wide."""

    def make(
        width: float = 326, share: float = 0.0, outcome: str = "ready", **more: Any
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            return SlideToConfirm(size_hint_x=None, width=dp(width), share=share, outcome=outcome, **more)

        return build

    up: dict[str, Any] = {"text": "take off", "icon": "arrow_upward"}
    down: dict[str, Any] = {"text": "land", "icon": "arrow_downward", "role": "plan"}
    return {
        "take off": make(**up),
        "land": make(**down),
        "half way": make(share=0.5, **up),
        "confirmed": make(share=1.0, **up),
        "sent": make(outcome="sent", **up),
        "accepted": make(outcome="accepted", **up),
        "refused": make(outcome="refused", **up),
        "no reply": make(outcome="no_reply", **up),
        "narrow": make(176, **up),
        "narrow land": make(176, **down),
        "narrow land beside take off": make(176, kin=["take off"], **down),
        "narrow sent": make(176, outcome="sent", **up),
        "narrow no reply": make(176, outcome="no_reply", **up),
        "danger": make(text="cut the motors", icon="warning", role="danger"),
        "disabled": make(state="disabled", **up),
    }
