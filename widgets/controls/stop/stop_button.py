"""STOP: the largest thing to touch, in the same corner of every screen.

stop = StopButton()
stop.bind(on_command=lambda _: commands.stop())
stop.bind(on_hold_stop=lambda _: commands.hold(), on_release_stop=lambda _: commands.release())
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.anchorlayout import AnchorLayout
from kivy.uix.widget import Widget

from widgets.controls.hold_progress import Hold
from widgets.core.base import Control, text_texture
from widgets.core.language import mark, tr
from widgets.core.surfaces import Outlined
from widgets.parts.labels import spaced

__all__ = ["LONG_HOLD_DURATION", "PHASES", "RELEASE_DURATION", "StopButton"]

RELEASE_DURATION = 1.2
"""How long the finger must stay to release STOP [s]: the second that a robot asks for by its own clock, and what a link varies."""

LONG_HOLD_DURATION = 3.0
"""How long the finger must stay to release a STOP held here alone that is not confirmed [s]: who presses it again and
stays on it wants it to stop."""

HOLD_MEMORY = 4.5
"""A hold that was told longer ago [s] is told anew before it releases: a robot forgets one after five."""

MIN_STACKED_HEIGHT = 130
"""Lower than this it has the icon beside the word while it says a sentence [dp]."""
NO_BREAK = "\u00a0"
"""A space at which no line ends."""
MIN_WORD_HEIGHT = 72
"""Lower than this its word is smaller, so that two lines fit below it [dp]."""
MIN_AGE_SIDE = 110
"""Smaller than a square with this side it says only what can be done, and not how long ago something was [dp]."""
MIN_FONT_SIZE = 14.0
"""Smallest type that anything is written in [sp]."""

STOP = "STOP"
"""The same in every language, as on the buttons of machines."""
PHASES = {
    "ready": (STOP, "", "pan_tool_fill"),
    "sent": (STOP, mark("sent, not confirmed"), "pan_tool_fill"),
    "stopped": (mark("STOPPED"), mark("hold to release"), "lock"),
    "moves": (STOP, mark("pressed, still moving"), "warning"),
    "no_answer": (STOP, mark("no answer, sending again"), "signal_disconnected"),
    "lost": (STOP, mark("no link, was STOPPED"), "signal_disconnected"),
}
"""Phase to its word, its sentence and its icon."""
LOCAL = {
    "sent": ("", mark("zero speed is sent")),
    "moves": (mark("still moves · "), mark("hold 3 s to release")),
    "no_answer": (mark("not confirmed · "), mark("hold 3 s to release")),
}
"""Sentences of a STOP that this handheld alone holds, or that is pressed and not obeyed, where they are others.

In two parts: a small button has room for the second alone.
"""

Builder.load_string("""
<StopButton>:
    veil_radius: theme.radius * 1.3
    rim: 'stop'
    ground: 'surface' if root.phase == 'stopped' else 'stop'
    corner: theme.radius * 1.3
    rim_width: dp(3)
    canvas.before:
        Rounded:
            rgba: (theme.stop if root.phase == 'stopped' else theme.shade)[:3] + [.4 if root.held else 0]
            pos: self.pos
            size: max(self.width * root.held, theme.radius * 2.6), self.height
            radius: [theme.radius * 1.3]
        Rounded:
            rgba: theme.shade[:3] + [.22 if root.pressed and root.phase != 'stopped' else 0]
            pos: self.pos
            size: self.size
            radius: [theme.radius * 1.3]
    BoxLayout:
        orientation: 'vertical'
        size_hint: None, None
        size: self.minimum_size
        spacing: dp(2)
        BoxLayout:
            orientation: 'vertical' if root.upright else 'horizontal'
            size_hint: None, None
            size: self.minimum_size
            spacing: 0 if root.upright else root.word_size * .28
            pos_hint: {'center_x': .5}
            Icon:
                name: root.icon
                role: root.ink
                font_size: root.word_size * (1.5 if root.upright else 1.25)
                pos_hint: {'center_x': .5, 'center_y': .5}
            Label:
                text: root.word
                font_name: theme.font
                font_size: root.word_size
                bold: True
                color: theme.roles[root.ink]
                disabled_color: self.color
                size_hint: None, None
                size: self.texture_size
                pos_hint: {'center_x': .5, 'center_y': .5}
        Label:
            id: sentence
            text: root.sentence
            font_name: theme.font
            font_size: root.sentence_size
            color: theme.roles[root.ink]
            disabled_color: self.color
            text_size: root.width - dp(16), None
            halign: 'center'
            size_hint: None, None
            size: self.texture_size if root.sentence else (0, 0)
            pos_hint: {'center_x': .5}
""")


class StopButton(Outlined, Hold, Control, AnchorLayout):
    """Dispatches `on_command` the moment a finger comes down, once stopped `on_hold_stop` as a hold begins, and `on_release_stop` after it.

    Where few frames are drawn the hold outlasts what a robot remembers: then `on_hold_stop` comes once more, and the finger stays
    for as long as the robot asks for from there.
    """

    veiled = False
    __events__ = ("on_hold_stop", "on_release_stop")

    phase = OptionProperty("ready", options=list(PHASES))
    """`ready`; `sent`, not confirmed; `stopped`, confirmed and latched; `moves`, latched and not at rest in time;
    `no_answer`, sent and not confirmed in time; `lost`, stopped when the link was lost: it is unknown whether it still is."""
    local = BooleanProperty(False)
    """It is latched, or the robot has no STOP of its own: a hold releases it even while it is not confirmed."""
    ago = StringProperty("")
    """How long ago the link was lost, as in `8 s`; for `lost`."""
    pressed = NumericProperty(0)
    """Fingers on it."""

    def _sentence(self) -> str:
        head, sentence = "", PHASES[self.phase][1]
        if self.local:
            head, sentence = map(tr, LOCAL.get(self.phase, (head, sentence)))
        else:
            sentence = tr(sentence)
        if self.width * self.height < dp(MIN_AGE_SIDE) * dp(MIN_AGE_SIDE):
            return sentence
        sentence = head + sentence
        if self.phase == "lost" and self.ago:
            return f"{sentence} " + tr("{time} ago").format(time=self.ago).replace(" ", NO_BREAK)
        return sentence

    sentence = AliasProperty(_sentence, bind=["phase", "local", "ago", "size"], cache=True)

    def _icon(self) -> str:
        return PHASES[self.phase][2]

    icon = AliasProperty(_icon, bind=["phase"], cache=True)

    def _word(self) -> str:
        word = PHASES[self.phase][0]
        return spaced(word if word == STOP else tr(word))

    word = AliasProperty(_word, bind=["phase"], cache=True)

    def _ink(self) -> str:
        return "danger" if self.phase == "stopped" else "ink_stop"

    ink = AliasProperty(_ink, bind=["phase"], cache=True)
    """Role of the words."""

    def _upright(self) -> bool:
        low = bool(self.sentence) and self.height < dp(MIN_STACKED_HEIGHT)
        return self.width < self.height * 2 and not low

    upright = AliasProperty(_upright, bind=["size", "sentence"], cache=True)
    """Icon above the word, because it is not wide and there is room below for what it says."""

    def _word_size(self) -> float:
        width, height = self.size
        across = width / (5.2 if self.upright else 6.4) * (0.78 if self.phase == "stopped" else 1.0)
        low = bool(self.sentence) and height < dp(MIN_WORD_HEIGHT)
        size = max(min(across, height * (0.23 if self.upright else 0.27 if low else 0.36)), sp(MIN_FONT_SIZE))
        wide = text_texture(self.word, size, bold=True).width + (0 if self.upright else size * 1.53)
        return float(size * min(1.0, max(width - dp(12), 1) / wide))

    word_size = AliasProperty(_word_size, bind=["size", "phase", "upright", "sentence", "word"], cache=True)
    """Height of the type [px]."""

    def _sentence_size(self) -> float:
        return max(min(self.word_size * 0.55, self.width / 16), sp(MIN_FONT_SIZE))

    sentence_size = AliasProperty(_sentence_size, bind=["word_size", "size", "upright"], cache=True)
    """Height of the sentence's type [px]; it goes on two lines where it is too long."""

    def __init__(self, **kwargs: Any) -> None:
        self._holding: set[int] = set()
        """Touches that came down to hold; one that stopped the robot and rests there is not among them."""
        self._told = 0.0
        """Since the robot was told of the hold [s]."""
        self._stayed = 0.0
        """What of that a finger was seen to stay [s]; no frame is more than half of what it takes, so that it was looked for in between."""
        super().__init__(**kwargs)

    def rest(self) -> None:
        """Forget a hold that has begun, whoever holds."""
        self._holding.clear()
        super().rest()

    def on_phase(self, *_: object) -> None:
        """A hold belongs to the phase that it began in."""
        self.rest()

    def _count(self, elapsed: float) -> None:
        self._told += elapsed
        self._stayed += min(elapsed, RELEASE_DURATION / 2)
        super()._count(elapsed)

    def is_over(self) -> bool:
        """The robot knows of the hold, and has seen it last; one that it has forgotten is told anew."""
        if self._told > HOLD_MEMORY:
            self._tell()
        return self._stayed >= RELEASE_DURATION - 1e-6

    def _tell(self) -> None:
        self._told = self._stayed = 0.0
        self.dispatch("on_hold_stop")

    def on_held_long(self) -> None:
        """It was held long enough."""
        self.dispatch("on_release_stop")

    def on_hold_stop(self) -> None:
        """A finger came down to release STOP, or is there still after the robot has forgotten that; it has to stay."""

    def on_release_stop(self) -> None:
        """It was held long enough: the operator wants to drive again."""

    def on_touch_down(self, touch: Any) -> bool:
        """Command at once; when stopped already, or held here alone without an answer, begin to count the hold."""
        if not self.collide_point(*touch.pos):
            return False
        touch.grab(self)
        self.pressed += 1
        unanswered = self.local and self.phase in ("no_answer", "moves")
        holds = self.phase == "stopped" or unanswered
        begins = holds and not self._holding
        if holds:
            self._holding.add(touch.uid)
            self.hold(RELEASE_DURATION if self.phase == "stopped" else LONG_HOLD_DURATION)
        if self.phase != "stopped":
            self.dispatch("on_command")
        if begins:  # after a STOP that is given once more, and not by a second finger
            self._tell()
        return True

    def on_touch_up(self, touch: Any) -> bool:
        """A hold that ends early releases nothing."""
        if touch.grab_current is not self:
            return False
        touch.ungrab(self)
        self.pressed = max(0, self.pressed - 1)
        self._holding.discard(touch.uid)
        if not self._holding:
            self.rest()
        return True


def samples() -> dict[str, Callable[[], Widget]]:
    """Every phase, wide as on a tablet's side and square as on the drive screen."""

    def make(width: str, height: str, **kwargs: Any) -> Callable[[], Widget]:
        return lambda: StopButton(size_hint=(None, None), size=(width, height), **kwargs)

    wide = {phase: make("329dp", "76dp", phase=phase, ago="8 s") for phase in PHASES}
    square = {f"{phase} square": make("210dp", "180dp", phase=phase, ago="8 s") for phase in PHASES}
    return {
        **wide,
        **square,
        "phone stopped": make("112dp", "172dp", phase="stopped"),
        "phone no answer": make("112dp", "172dp", phase="no_answer"),
        "phone lost": make("112dp", "172dp", phase="lost", ago="8 s"),
        "phone moves": make("177dp", "118dp", phase="moves", local=True),
        "small lost": make("128dp", "68dp", phase="lost", ago="8 s"),
        "small latched": make("128dp", "68dp", phase="stopped"),
        "small local no answer": make("128dp", "68dp", phase="no_answer", local=True),
        "small sent": make("160dp", "64dp", phase="sent"),
        "small": make("160dp", "64dp"),
        "local sent": make("329dp", "76dp", phase="sent", local=True),
        "local no answer": make("329dp", "76dp", phase="no_answer", local=True),
        "phone local no answer": make("112dp", "172dp", phase="no_answer", local=True),
        "small stopped": make("160dp", "64dp", phase="stopped"),
        "being released": _being_released,
    }


def _being_released() -> StopButton:
    button = StopButton(size_hint=(None, None), size=("329dp", "76dp"), phase="stopped")
    button.held = 0.6
    return button
