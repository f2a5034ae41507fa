"""Settings of a patrol: the motion, the dwell, the laps, and whether an intruder stops it.

motion = MotionSelector()
motion.show(mission)
motion.bind(on_command=lambda _, choice: editor.set_motion(**choice))
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, NumericProperty, OptionProperty
from kivy.uix.widget import Widget

import widgets.parts.choices
import widgets.parts.stepper  # noqa: F401 - same
from bridge.msgs.pilothouse_msgs import MAX_DWELL, MAX_LAPS, MOTIONS, REACTIONS, Mission
from widgets.core.base import Control
from widgets.core.language import mark
from widgets.parts.column import Column

__all__ = ["MotionSelector"]


Builder.load_string("""
<MotionSelector>:
    spacing: theme.gap * .6
    SectionLabel:
        title: tr('Motion')
        height: 0 if root.brief else self.texture_size[1]
        opacity: 0 if root.brief else 1
    Segmented:
        id: choice
        options: [(name, tr(words)) for name, words in root.motions]
        value: root.motion_name
        on_choose: root.choose('motion', args[1])
    MotionRow:
        title: tr('Dwell at each point')
        role: 'text' if root.motion_name == 'intermittent' else 'muted'
        Stepper:
            value: root.dwell
            unit: 's'
            minimum: 1
            maximum: root.longest_dwell
            disabled: root.motion_name != 'intermittent'
            pos_hint: {'center_y': .5}
            on_change: root.choose('dwell', args[1])
    MotionRow:
        title: tr('Laps')
        Stepper:
            value: root.laps
            zero: tr('until stopped')
            maximum: root.most_laps
            pos_hint: {'center_y': .5}
            on_change: root.choose('laps', int(args[1]))
    SectionLabel:
        title: tr('When it finds an intruder')
    Segmented:
        options: [(name, tr(words)) for name, words in root.reactions]
        value: root.reaction
        on_choose: root.choose('on_intruder', args[1])

<MotionRow@BoxLayout>:
    title: ''
    role: 'text'
    size_hint_y: None
    height: max(dp(44), theme.target * .8)
    spacing: dp(8)
    Text:
        text: root.title
        role: root.role
        pos_hint: {'center_y': .5}
""")


class MotionSelector(Control, Column):
    """Dispatches `on_command({name: value})` for the one thing that a finger changed."""

    accepts = (Mission,)
    sends = (Mission,)

    motions = [("loop", mark("Loop")), ("random", mark("Random")), ("intermittent", mark("Intermittent"))]
    """Each motion and its word."""
    longest_dwell, most_laps = MAX_DWELL, MAX_LAPS
    motion_name = OptionProperty("loop", options=list(MOTIONS))
    """A property called `motion` would be given Kivy's touches by its `on_motion`."""
    dwell = NumericProperty(5.0)
    """How long it stands at each point in intermittent motion [s]."""
    laps = NumericProperty(0)
    """0 goes on until stopped."""
    reactions = [("report", mark("Report")), ("stop", mark("Stop")), ("circle", mark("Circle it"))]
    """Each reaction to an intruder and its word."""
    reaction = OptionProperty("report", options=list(REACTIONS))
    """What it does when it finds an intruder; a property called `on_intruder` would be an event to Kivy."""
    brief = BooleanProperty(False)
    """Leaves its name away, for a phone."""

    @property
    def choice_height(self) -> float:
        """From its upper edge to below the choice of the motion [px]; what follows may be scrolled to."""
        title = self.children[-1].height + self.spacing
        return float(title + self.ids.choice.height)

    def show(self, msg: Mission) -> None:
        """Take over how a mission moves; nothing is dispatched."""
        self.motion_name = msg.motion if msg.motion in MOTIONS else "loop"
        self.dwell = msg.dwell
        self.laps = msg.laps
        known = msg.on_intruder if msg.on_intruder in REACTIONS else "report"
        self.reaction = "stop" if msg.stop_on_intruder else known

    def choose(self, name: str, value: Any) -> None:
        """Change `motion`, `dwell`, `laps` or `on_intruder` as a finger would."""
        setattr(self, {"motion": "motion_name", "on_intruder": "reaction"}.get(name, name), value)
        self.dispatch("on_command", {name: value})


def samples() -> dict[str, Callable[[], Widget]]:
    """Each motion."""

    def make(mission: Mission, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            selector = MotionSelector(size_hint_x=None, width="330dp", **kwargs)
            selector.show(mission)
            return selector

        return build

    return {
        "loop": make(Mission(stop_on_intruder=True)),
        "random": make(Mission(motion="random", laps=3, on_intruder="circle")),
        "intermittent": make(Mission(motion="intermittent", dwell=8.0)),
        "disabled": make(Mission(), state="disabled"),
    }
