"""Sign to press a switch at, too large to be missed, and the result of the press.

test = ReactionTest()
test.phase, test.count, test.total = "go", 3, 8
"""

from __future__ import annotations

from collections.abc import Callable

from kivy.lang import Builder
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.anchorlayout import AnchorLayout
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.labels  # noqa: F401 - its rules draw the icon and the words
from widgets.core.language import mark, tr
from widgets.core.surfaces import Outlined

__all__ = ["PHASES", "ReactionTest"]

PHASES = {
    "idle": ("timer", mark("Not begun"), mark("Press the switch as soon as the sign is full and says NOW.")),
    "wait": ("hourglass_empty", mark("Wait"), mark("Press when it says NOW, not before.")),
    "go": ("touch_app", mark("NOW"), mark("Press!")),
    "early": ("block", mark("Too early"), mark("Once more: press after the sign.")),
    "missed": ("schedule", mark("Missed"), mark("Once more: press when it says NOW.")),
    "taken": ("check", mark("Good"), mark("The next sign comes at once.")),
    "done": ("check_circle_fill", mark("Done"), ""),
}
"""Phase to its icon, its word and its sentence."""

Builder.load_string("""
<ReactionTest>:
    size_hint_y: None
    height: dp(176)
    padding: dp(14)
    spacing: dp(16)
    rim: 'line'
    ground: 'surface'
    corner: theme.radius
    Sign:
        id: sign
        size_hint: None, None
        size: root.height - dp(28), root.height - dp(28)
        filled: root.phase == 'go'
        Icon:
            name: root.icon
            role: 'ink_accent' if root.phase == 'go' else 'warn' if root.phase in ('early', 'missed') else 'text'
            font_size: sp(58)
    BoxLayout:
        orientation: 'vertical'
        size_hint_y: None
        height: self.minimum_height
        spacing: dp(6)
        pos_hint: {'center_y': .5}
        Text:
            text: root.word
            bold: True
            font_size: sp(30)
        Remark:
            text: root.sentence
            font_size: sp(15)
        Remark:
            text: root.progress
            font_size: sp(15)

<Sign>:
    canvas.before:
        Color:
            rgba: theme.accent if self.filled else theme.raised
        SmoothEllipse:
            pos: self.pos
            size: self.size
        Color:
            rgba: theme.text if self.filled else theme.line
        SmoothLine:
            circle: self.center_x, self.center_y, self.width / 2 - dp(3)
            width: dp(3)
""")


class Sign(AnchorLayout):
    """The disc: hollow, and full when it is time."""

    filled = BooleanProperty(False)


class ReactionTest(Outlined, BoxLayout):
    """Shows a test of how fast a switch is pressed; takes no touch itself."""

    phase = OptionProperty("idle", options=list(PHASES))
    """As of `PHASES`; only in `go` the sign is full."""
    count = NumericProperty(0)
    """Presses so far."""
    total = NumericProperty(0)
    """Presses in all; 0 says nothing of them."""
    result = StringProperty("")
    """What came out, once it is done."""

    def _icon(self) -> str:
        return PHASES[self.phase][0]

    icon = AliasProperty(_icon, bind=["phase"], cache=True)

    def _word(self) -> str:
        return tr(PHASES[self.phase][1])

    word = AliasProperty(_word, bind=["phase"], cache=True)

    def _sentence(self) -> str:
        return self.result if self.phase == "done" else tr(PHASES[self.phase][2])

    sentence = AliasProperty(_sentence, bind=["phase", "result"], cache=True)

    def _progress(self) -> str:
        if not self.total or self.phase in ("idle", "done"):
            return ""
        return f"{self.count:.0f} of {self.total:.0f}"

    progress = AliasProperty(_progress, bind=["phase", "count", "total"], cache=True)


def samples() -> dict[str, Callable[[], Widget]]:
    """Each phase."""

    def make(phase: str) -> Callable[[], Widget]:
        result = "You press within 0.62 s: the mark should stay for 1.0 s."
        return lambda: ReactionTest(
            phase=phase, count=3, total=8, result=result, size_hint_x=None, width="380dp"
        )

    return {phase: make(phase) for phase in PHASES}
