"""The bar on top of every screen of a robot: which one it is, its mode, battery and link, and who has control."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.metrics import Metrics, dp, sp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    DictProperty,
    NumericProperty,
    OptionProperty,
    StringProperty,
)
from kivy.uix.boxlayout import BoxLayout

import widgets.instruments.battery
import widgets.instruments.link_quality
import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.screens.parts.giving_way import giving_way
from app.screens.parts.method_chip import InputsChip  # noqa: F401 - its rule draws what is used here
from app.screens.shell import status_text
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
GIVING_WAY = (
    *("satellites", "link", "trust", "inputs", "name", "control", "mode", "stack"),
    *("inputs", "control", "type"),
)
"""What gives up words, then lies above another, and then is left out, the first first; what the robot does and who has it stay."""
NARROW_GIVING_WAY = ("inputs", "inputs", "control", "control", "type")
"""The same of a narrow one."""
BETWEEN, AROUND = 2.0, 5.0
"""From one to the next of what is stacked, and from there to the edge of the bar [dp]."""

Builder.load_string("""
#:import fitting_size widgets.core.base.fitting_size
<TopBar>:
    narrowest: min(theme.least, self.width / (5.8 if self.form == 'tall' else 11))
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
        font_size: theme.size_title if root.form != 'tall' else max(min(sp(13), dp(15)), fitting_size([self.text], sp(16), self.width - dp(8), bold=True))  # smaller is not read; its end is left out instead
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
        largest: root.largest
        text: root.trust_shown
        tinted: True
        edge: dp(8)
        pressable: True
        pos_hint: {'center_y': .5}
        on_release: root.dispatch('on_people')
    Chip:
        id: mode
        narrowest: root.narrowest
        icon: root.mode_icon if root.form != 'tall' else ''
        role: root.mode_role
        largest: root.largest
        text: root.mode_shown
        usual: root.mode_usual
        edge: dp(13) if root.form != 'tall' else dp(7)
        outlined: True
        pressable: root.mode_offered
        pos_hint: {'center_y': .5}
        on_release: root.dispatch('on_mode')
    BatteryChip:
        id: battery
        brief: root.stacked
        largest: root.largest
        pos_hint: {'center_y': .5}
    LinkQuality:
        id: link
        brief: root.form != 'wide' or root.stacked or 'link' in root.given
        tight: root.stacked
        largest: root.largest
        pos_hint: {'center_y': .5}
    Chip:
        id: satellites
        icon: 'satellite_alt'
        largest: root.largest
        role: root.fix_role
        text: root.fix_text
        pos_hint: {'center_y': .5}
    Widget:
        id: gap
    InputsChip:
        id: inputs
        brief: root.form != 'wide' or 'inputs' in root.given
        wordless: root.form == 'tall' or 'inputs' in root.given
        pos_hint: {'center_y': .5}
        on_release: root.dispatch('on_inputs')
    Chip:
        id: record
        narrowest: root.narrowest
        icon: 'fiber_manual_record_fill'
        role: 'danger'
        largest: root.largest
        text: root.recorded if root.form != 'tall' else ''
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
        largest: root.largest
        text: root.control_shown
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
    given: DictProperty[str, int] = DictProperty()
    """What gave way for want of room, as of `GIVING_WAY`, and how often."""
    stacked = BooleanProperty(False)
    """Battery and link are above each other."""
    largest = NumericProperty("15sp")
    """Size of type of its chips [px]."""
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
    mode_brief = StringProperty("—")
    """Who steers without the task."""
    control_text = StringProperty("")
    control_brief = StringProperty("")
    """Where there is little room."""
    named = StringProperty("")
    """On an upright phone, who has control or asks for it, in a word."""
    control_icon = StringProperty("help")
    control_role = StringProperty("muted")

    trust_shown = AliasProperty(
        lambda bar: _trust_words(bar, bar.given), bind=["protected", "form", "given"], cache=True
    )
    mode_shown = AliasProperty(
        lambda bar: _mode_words(bar, bar.given), bind=["mode_text", "mode_brief", "form", "given"], cache=True
    )
    mode_usual = AliasProperty(lambda bar: _usual_mode(bar, bar.given), bind=["form", "given"], cache=True)
    control_shown = AliasProperty(
        lambda bar: _control_words(bar, bar.given),
        bind=["control_text", "control_brief", "named", "form", "given"],
        cache=True,
    )

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.ids["stack"] = self._stack = BoxLayout(
            orientation="vertical", size_hint=(None, 1), padding=(0, dp(AROUND)), spacing=dp(BETWEEN)
        )
        for name in PARTS:  # kv holds ids weakly, and the narrow bar takes some of them out
            self.ids[name] = self.ids[name].__self__
        for name in ("located", "given", "protected", "recorded"):
            self.fbind(name, lambda *_: self.arrange(self.form))
        self.ids.inputs.fbind("methods", lambda *_: self.arrange(self.form))
        self._fit = Clock.create_trigger(lambda _: self._fitted(), -1)
        for name in ("trust", "mode", "battery", "link", "satellites", "inputs", "record", "control"):
            self.ids[name].bind(width=self._fit)
        self.ids.inputs.bind(methods=self._fit)
        for name in (
            "size",
            "form",
            "robot_name",
            "located",
            "protected",
            "recorded",
            "mode_shown",
            "control_shown",
        ):
            self.fbind(name, self._fit)

    def arrange(self, form: str) -> None:
        """Take the shape of the window; the narrow bar leaves out what is said elsewhere."""
        self.form = form
        self.largest = _largest(self.given)
        self.stacked = form == "tall" or "stack" in self.given
        self._stack_up(stacked=self.stacked)
        shown = [self.ids[name] for name in self._wanted(self.given)]
        if list(reversed(self.children)) != shown:
            self.clear_widgets()
            for widget in shown:
                self.add_widget(widget)

    def _wanted(self, given: Mapping[str, int]) -> list[str]:
        """What there is something to say of, and room for where so much gave way."""
        tall = self.form == "tall"
        absent = {
            "satellites": "satellites" in given or not self.located,
            "record": not self.recorded,
            "trust": tall and self.protected,  # what is as it should be is said under More
            "inputs": given.get("inputs", 0) > 1 or (tall and not self.ids.inputs.faulty),  # More leads there
            "more": self.form != "wide",  # a phone's navigation leads there
            "battery": "stack" in given,
        }
        parts: Sequence[str] = NARROW if tall else PARTS
        if "stack" in given and not tall:
            parts = ["stack" if name == "link" else name for name in parts]
        return [name for name in parts if not absent.get(name)]

    def _fitted(self) -> None:
        """Have things give way so that what the robot does and who has it are always read whole."""
        tall = self.form == "tall"
        room = self.width - self.padding[0] - self.padding[2]
        given = giving_way(room, NARROW_GIVING_WAY if tall else GIVING_WAY, self._width_of)
        if given != self.given:
            self.given = given
        if tall:
            self.name_room = 0
            return
        whole = _whole_name(self)
        left = room - self._width_of({**given, "name": 0}) + whole
        self.name_room = max(left, dp(LEAST_NAME)) if whole > left else 0

    def _width_of(self, given: Mapping[str, int]) -> float:
        """How wide everything is [px] where so much gave way."""
        wanted = self._wanted(given)
        return sum(_part_width(self, name, given) for name in wanted) + self.spacing * (len(wanted) - 1)

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
        self.mode_text, self.mode_icon, self.mode_role = status_text.mode(session, self.form)
        self.mode_brief, *_ = status_text.mode(session, "tall")
        self.mode_offered = (
            session.connected and not session.robot.foreign and session.robot.offers("/mode/set")
        )
        self.fix_text, self.fix_role = status_text.fix(session)
        offer = session.robot.capabilities
        self.located = offer is None or "/fix" in offer.topics or session.feeds.latest("/fix") is not None
        self.control_text, self.control_icon, self.control_role = status_text.control(
            session, brief=self.form != "wide"
        )
        self.control_brief, *_ = status_text.control(session, brief=True)
        words, _, other = status_text.control_nav(session)
        self.named = words if other else self.control_text if self.form == "tall" else ""
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


# words and widths, where so much gave way


def _largest(given: Mapping[str, int]) -> float:
    """Size of type of the chips [px]: where there is no room at all, that of usual text."""
    return float(min(dp(15), sp(15)) if "type" in given else sp(15))


def _trust_words(bar: TopBar, given: Mapping[str, int]) -> str:
    worded = not bar.protected and bar.form == "wide" and "trust" not in given
    return tr("Not protected") if worded else ""


def _mode_words(bar: TopBar, given: Mapping[str, int]) -> str:
    return str(bar.mode_brief if bar.form == "tall" or "mode" in given else bar.mode_text)


def _usual_mode(bar: TopBar, given: Mapping[str, int]) -> str:
    if bar.form == "tall" or "mode" in given:
        return "" if "type" in given else tr("STOPPED")
    if bar.form == "wide":
        return f"{tr('MANUAL')} · {tr('patrol')} {tr('paused')}"
    return f"{tr('PAUSED')} · {tr('patrol')}"


def _control_words(bar: TopBar, given: Mapping[str, int]) -> str:
    words = (bar.control_text, bar.control_brief, bar.named, "")
    first = 2 if bar.form == "tall" else 0
    return str(words[min(first + given.get("control", 0), len(words) - 1)])


def _whole_name(bar: TopBar) -> float:
    return float(text_texture(bar.robot_name, bar.ids.name.font_size, theme.font, bold=True).width)


def _part_width(bar: TopBar, name: str, given: Mapping[str, int]) -> float:
    """Of one part [px]."""
    part, tall = bar.ids[name], bar.form == "tall"
    words: dict[str, Callable[[], str]] = {
        "trust": lambda: _trust_words(bar, given),
        "mode": lambda: _mode_words(bar, given),
        "control": lambda: _control_words(bar, given),
        "record": lambda: "" if tall else bar.recorded,
        "satellites": lambda: bar.fix_text,
    }
    if name in words:
        usual = _usual_mode(bar, given) if name == "mode" else ""
        return float(part.width_with(words[name](), usual, largest=_largest(given)))
    if name in ("stack", "battery", "link"):
        return _standing_width(bar, name, given)
    if name == "name":
        whole = _whole_name(bar)
        return min(whole, dp(LEAST_NAME)) if tall or given.get("name") else whole
    if name == "inputs":
        less = "inputs" in given
        return float(part.width_as(brief=bar.form != "wide" or less, wordless=tall or less))
    return 0.0 if name == "gap" else float(part.width)


def _standing_width(bar: TopBar, name: str, given: Mapping[str, int]) -> float:
    """Of battery and link, or of the wider one where they are above each other [px]."""
    stacked, largest = name == "stack", _largest(given)
    high = (bar.height - 2 * dp(AROUND) - dp(BETWEEN)) / 2 if stacked else dp(HIGH)
    brief = stacked or bar.form != "wide" or "link" in given
    link = bar.ids.link.width_as(brief=brief, tight=stacked, high=high, largest=largest)
    battery = bar.ids.battery.width_as(brief=stacked, high=high, largest=largest)
    return float(max(link, battery) if stacked else link if name == "link" else battery)
