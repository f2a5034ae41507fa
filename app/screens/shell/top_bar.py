"""The bar on top of every screen of a robot: which one it is, its mode, battery and link, and who has control."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.metrics import Metrics, dp
from kivy.properties import BooleanProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout

import widgets.instruments.battery
import widgets.instruments.link_quality
import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.screens.parts.method_chip import InputsChip  # noqa: F401 - its rule draws what is used here
from app.screens.shell import status_text as standing
from app.session.session import Session
from widgets.core.base import text_texture
from widgets.core.language import tr
from widgets.core.surfaces import EdgedBox
from widgets.core.theme import theme

__all__ = ["TopBar"]

PARTS = (
    *("back", "name", "trust", "mode", "battery", "link", "satellites", "gap"),
    *("inputs", "record", "control", "more"),
)
"""What it holds, from left to right."""
NARROW = ("back", "name", "trust", "mode", "stack", "record", "control", "inputs")
"""What a narrow one holds: battery and link are above each other there."""
STACKED = ("link", "battery")
"""From the upper one down."""
HIGH = 34.0
"""Height of a chip that is not stacked [dp]."""
LEAST_NAME = 60.0
"""Of a name that is cut short, this much at least is read [dp]."""

Builder.load_string("""
#:import fitting_size widgets.core.base.fitting_size
<TopBar>:
    narrowest: min(theme.least, self.width / (6 if self.form == 'tall' else 11))
    size_hint: None, None
    padding: (dp(2), 0, dp(8), 0) if root.form == 'tall' else (dp(6), 0, dp(16), 0)
    spacing: dp(4) if root.form == 'tall' else dp(12)
    IconButton:
        id: back
        icon: 'arrow_back'
        role: 'muted'
        bare: True
        width: max(dp(46) if root.form != 'tall' else dp(34), root.narrowest)
        height: min(theme.target, root.height)
        pos_hint: {'center_y': .5}
        on_release: root.dispatch('on_back')
    Text:
        id: name
        text: root.robot_name
        bold: True
        font_size: theme.size_title if root.form != 'tall' else max(sp(13), fitting_size([self.text], sp(16), self.width - dp(8), bold=True))  # smaller is not read; its end is left out instead
        shorten: root.form == 'tall' or root.name_room > 0
        shorten_from: 'right'
        pos_hint: {'center_y': .5}
        size_hint_x: 1 if root.form == 'tall' else None
        text_size: (self.width, None) if root.form == 'tall' else (root.name_room or None, None)
        width: root.name_room or self.texture_size[0]
    Chip:
        id: trust
        narrowest: root.narrowest
        icon: 'lock' if root.protected else 'lock_open'
        role: 'ok' if root.protected else 'warn'
        text: '' if root.protected or root.form != 'wide' else tr('Not protected')
        tinted: True
        spacing: dp(8) if self.text else 0
        edge: dp(8)
        pressable: True
        pos_hint: {'center_y': .5}
        on_release: root.dispatch('on_people')
    Chip:
        id: mode
        narrowest: root.narrowest
        icon: root.mode_icon if root.form != 'tall' else ''
        role: root.mode_role
        text: root.mode_text
        usual: tr('STOPPED') if root.form == 'tall' else tr('MANUAL') + ' · ' + tr('patrol') + ' ' + tr('paused') if root.form == 'wide' else tr('PAUSED') + ' · ' + tr('patrol')
        spacing: dp(8) if self.icon else 0
        edge: dp(13) if root.form != 'tall' else dp(7)
        outlined: True
        pressable: root.mode_offered
        pos_hint: {'center_y': .5}
        on_release: root.dispatch('on_mode')
    BatteryChip:
        id: battery
        brief: root.form == 'tall'
        pos_hint: {'center_y': .5}
    LinkQuality:
        id: link
        brief: root.form != 'wide'
        tight: root.form == 'tall'
        pos_hint: {'center_y': .5}
    Chip:
        id: satellites
        icon: 'satellite_alt'
        role: root.fix_role
        text: root.fix_text
        pos_hint: {'center_y': .5}
    Widget:
        id: gap
    InputsChip:
        id: inputs
        brief: root.form != 'wide'
        pos_hint: {'center_y': .5}
        on_release: root.dispatch('on_inputs')
    Chip:
        id: record
        narrowest: root.narrowest
        icon: 'fiber_manual_record_fill'
        role: 'danger'
        text: root.recorded if root.form != 'tall' else ''
        spacing: dp(8) if self.text else 0
        edge: dp(13) if self.text else dp(7)
        pressable: True
        scan_words: tr('Stop recording')
        pos_hint: {'center_y': .5}
        on_release: root.dispatch('on_record')
    Chip:
        id: control
        narrowest: root.narrowest
        icon: root.control_icon
        role: root.control_role
        text: root.control_text if root.form != 'tall' else root.named
        spacing: dp(8) if self.text and root.form != 'tall' else dp(4) if self.text else 0
        edge: dp(13) if root.form != 'tall' else dp(7)
        pressable: True
        scan_words: root.control_text
        pos_hint: {'center_y': .5}
        on_release: root.dispatch('on_control')
    IconButton:
        id: more
        icon: 'more_vert'
        role: 'muted'
        bare: True
        width: max(dp(40), root.narrowest)
        height: min(theme.target, root.height)
        pos_hint: {'center_y': .5}
        scan_words: tr('More')
        on_release: root.dispatch('on_more')
""")


class TopBar(EdgedBox):
    """Dispatches `on_back`, `on_people`, `on_mode`, `on_inputs`, `on_record`, `on_control` and `on_more` as they are tapped."""

    __events__ = ("on_back", "on_control", "on_inputs", "on_mode", "on_more", "on_people", "on_record")

    form = OptionProperty("wide", options=["wide", "short", "tall"])
    """Shape of the window, as in `app.layout.arrange.form`."""
    name_room = NumericProperty(0)
    """What is left for the name of the robot where all of it would push the last chip off the glass [px]; 0 where it has room."""
    narrowest = NumericProperty(0)
    """Least width of what is pressed [px]: in gloves less than else, so that the bar holds it."""
    crowded = BooleanProperty(False)
    """There is no room for the satellites."""
    tight = BooleanProperty(False)
    """A narrow one has no room for the ways in beside the name: More leads there."""
    robot_name = StringProperty("")
    mode_text = StringProperty("—")
    mode_icon = StringProperty("help")
    mode_role = StringProperty("muted")
    mode_offered = BooleanProperty(False)
    """The robot takes a command for its mode."""
    located = BooleanProperty(True)
    """The robot tells its position by satellite, or has not yet said what it tells."""
    fix_text = StringProperty("—")
    fix_role = StringProperty("muted")
    protected = BooleanProperty(True)
    """Nobody on the way reads or changes what is said: as of `Session.protected`."""
    recorded = StringProperty("")
    """How long a recording runs; empty while none does, and then nothing is said of it."""
    control_text = StringProperty("")
    named = StringProperty("")
    """On a phone, who else has control or asks for it; empty while it is as it should be, which the icon says."""
    control_icon = StringProperty("help")
    control_role = StringProperty("muted")

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.ids["stack"] = self._stack = BoxLayout(
            orientation="vertical", size_hint=(None, 1), padding=(0, "5dp"), spacing="2dp"
        )
        for name in PARTS:  # kv holds ids weakly, and the narrow bar takes some of them out
            self.ids[name] = self.ids[name].__self__
        for name in ("located", "crowded", "protected", "recorded", "tight"):
            self.fbind(name, lambda *_: self.arrange(self.form))
        self._fit = Clock.create_trigger(lambda _: self._fitted(), -1)
        for name in ("trust", "mode", "battery", "link", "satellites", "inputs", "record", "control"):
            self.ids[name].bind(width=self._fit)
        for name in ("width", "form", "robot_name", "located", "protected", "recorded"):
            self.fbind(name, self._fit)

    def arrange(self, form: str) -> None:
        """Take the shape of the window; the narrow bar leaves out what is said elsewhere."""
        self.form = form
        self._stack_up(stacked=form == "tall")
        shown = [self.ids[name] for name in self._wanted()]
        if list(reversed(self.children)) != shown:
            self.clear_widgets()
            for widget in shown:
                self.add_widget(widget)

    def _wanted(self) -> list[str]:
        """What there is room for and something to say of."""
        tall = self.form == "tall"
        absent = {
            "satellites": self.crowded or not self.located,
            "record": not self.recorded,
            "trust": tall and self.protected,  # what is as it should be is said under More
            "inputs": tall and self.tight,
            "more": self.form != "wide",  # a phone's navigation leads there
        }
        return [name for name in (NARROW if tall else PARTS) if not absent.get(name)]

    def _fitted(self) -> None:
        """Leave out the satellites, and then the end of the name, so that who has control is always read whole."""
        if self.form == "tall":
            self.crowded, self.name_room = False, 0
            self._fit_narrow()
            return
        chips = [self.ids[name] for name in self._wanted() if name not in ("name", "gap", "satellites")]
        around = self.padding[0] + self.padding[2] + self.spacing * (len(chips) + 1)
        left = self.width - around - sum(chip.width for chip in chips)
        name = text_texture(self.robot_name, self.ids.name.font_size, theme.font, bold=True).width
        fix = self.ids.satellites.width + self.spacing
        self.crowded = name + fix > left
        self.name_room = max(left, dp(LEAST_NAME)) if name > left else 0

    def _fit_narrow(self) -> None:
        """Leave out the ways in where they would leave next to nothing of the name."""
        others = [self.ids[name] for name in self._wanted() if name not in ("name", "inputs")]
        around = self.padding[0] + self.padding[2] + self.spacing * (len(others) + 1)
        left = self.width - around - sum(chip.width for chip in others) - self.ids.inputs.width
        self.tight = left < dp(LEAST_NAME)

    def _stack_up(self, *, stacked: bool) -> None:
        """Battery and link come into the stack, or out of it."""
        for name in STACKED:
            chip = self.ids[name]
            if stacked == (chip.parent is self._stack):
                continue
            if chip.parent is not None:
                chip.parent.remove_widget(chip)
            chip.size_hint_y = 1 if stacked else None
            chip.height = HIGH * Metrics.density
            for pill in chip.children:  # it is as high as there is room
                pill.size_hint_y = 1
            if stacked:
                self._stack.add_widget(chip)
                chip.bind(width=self._stack_width)
            else:
                chip.unbind(width=self._stack_width)
        self._stack_width()

    def _stack_width(self, *_: object) -> None:
        self._stack.width = max((chip.width for chip in self._stack.children), default=0)

    def tick(self, session: Session) -> None:
        """Say how the robot stands now."""
        self.robot_name, self.protected = session.robot.name, session.protected
        self.mode_text, self.mode_icon, self.mode_role = standing.mode(session, self.form)
        self.mode_offered = (
            session.connected and not session.robot.foreign and session.robot.offers("/mode/set")
        )
        self.fix_text, self.fix_role = standing.fix(session)
        offer = session.robot.capabilities
        self.located = offer is None or "/fix" in offer.topics or session.feeds.latest("/fix") is not None
        self.control_text, self.control_icon, self.control_role = standing.control(
            session, brief=self.form != "wide"
        )
        words, _, other = standing.control_nav(session)
        self.named = words if other else ""
        chip = self.ids.link
        chip.state = "live"
        chip.rtt, chip.lost = session.link.health.rtt, session.link.health.lost
        chip.silence = session.link.silence if session.connected and session.link.silent else 0.0
        chip.sentence = "" if session.connected else tr("no link")

    def on_back(self) -> None:
        """The arrow was tapped."""

    def show_methods(self, methods: Sequence[tuple[str, bool]], idle: Sequence[str] = ()) -> None:
        """Say which methods are armed, as `InputsChip.show`."""
        self.ids.inputs.show(methods, idle)

    def on_inputs(self) -> None:
        """The ways in were tapped."""

    def on_people(self) -> None:
        """The lock was tapped: who has a key of the robot."""

    def on_mode(self) -> None:
        """The mode was tapped."""

    def on_record(self) -> None:
        """The recording that runs was tapped."""

    def on_control(self) -> None:
        """Who has control was tapped."""

    def on_more(self) -> None:
        """What leads to all other screens was tapped."""
