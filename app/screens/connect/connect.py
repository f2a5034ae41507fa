"""The connect screen: a card for each robot with one big button, and the ways to get to others."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any, Protocol

from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.floatlayout import FloatLayout

from app.discovery.known_robots import Entry
from app.layout.arrange import connect_columns
from app.screens.parts.method_chip import InputsChip  # noqa: F401 - its rule draws what is used here
from app.screens.parts.safe_area import safe_area
from app.screens.parts.themes import THEMES
from app.session.last_pictures import LastPictures, Thumb
from widgets.core.icons import ICONS
from widgets.core.language import tr
from widgets.core.surfaces import EdgedBox  # noqa: F401 - its rule draws the bar
from widgets.core.theme import theme
from widgets.parts.kit import Banner, Card, Text

__all__ = ["ConnectScreen", "RobotCard", "robot_icon", "same_named"]

GENERIC_ICON = "smart_toy_fill"
"""Of a robot that names none, or one that this app cannot draw."""
HINT = (
    "No robot found on this network yet.\nSwitch one on, enter its address, or start the built-in simulator."
)
NARROW = 420.0
"""A card narrower than this has no room for the words `driven by` [dp]."""

TRUST = {
    "paired": ("lock", "Paired", "ok"),
    "stranger": ("vpn_key", "Not paired", "muted"),
    "open": ("lock_open", "Not protected", "warn"),
    "": ("", "", "muted"),
}
"""How a robot is reached, to icon, words and role of the colour."""
LOW, MIDDLE = 0.20, 0.40
"""Below these a battery is empty or getting low, 0 to 1."""

Builder.load_string("""
#:import tr widgets.core.language.tr
#:import safe_area app.screens.parts.safe_area.safe_area
<RobotCard>:
    size_hint: None, None
    height: self.minimum_height
    padding: dp(18), dp(18)
    spacing: dp(14)
    outline: 'danger' if root.lost else 'line'
    BoxLayout:
        size_hint_y: None
        height: dp(50)
        spacing: dp(11)
        Icon:
            name: root.icon
            role: 'muted' if root.lost else 'accent'
            font_size: sp(44)
            pos_hint: {'center_y': .5}
        Widget:
            id: snapshot
            size_hint: None, 1
            width: dp(72) if root.snapshot else 0
            canvas:
                Color:
                    rgba: (1, 1, 1, .5 if root.lost else 1) if root.snapshot else (0, 0, 0, 0)
                RoundedRectangle:
                    texture: root.snapshot
                    pos: self.pos
                    size: self.size
                    radius: [dp(8)]
        BoxLayout:
            orientation: 'vertical'
            Text:
                text: root.title
                bold: True
                font_size: theme.size_title
                size_hint_y: 1
                shorten: True
                shorten_from: 'right'
            BoxLayout:
                spacing: dp(5) if root.trust_text else 0
                Icon:
                    id: lock
                    name: root.trust_icon or 'lock'
                    role: root.trust_role
                    font_size: sp(18)
                    size_hint: None, 1
                    width: dp(20) if root.trust_text else 0
                    opacity: 1 if root.trust_text else 0
                Label:
                    id: trust
                    text: root.trust_text
                    font_name: theme.font
                    font_size: sp(15)
                    color: theme.roles[root.trust_role]
                    disabled_color: self.color
                    size_hint: None, 1
                    width: self.texture_size[0]
                Text:
                    text: '· ' + root.subtitle if root.trust_text else root.subtitle
                    role: 'muted'
                    font_size: sp(15)
                    size_hint_y: 1
                    shorten: True
                    shorten_from: 'right'
        IconButton:
            id: remove
            icon: 'delete'
            role: 'muted'
            bare: True
            size: (theme.target if root.saved else 0, dp(50))
            opacity: 1 if root.saved else 0
            disabled: not root.saved
            on_release: root.dispatch('on_remove')
    BoxLayout:
        orientation: 'vertical'
        size_hint_y: None
        height: self.minimum_height
        Remark:
            text: root.note
            role: root.note_role
            font_size: sp(15)
            size_hint_y: None
            height: self.texture_size[1] if root.note else 0
        Remark:
            text: root.warning
            role: 'danger'
            font_size: sp(15)
            size_hint_y: None
            height: self.texture_size[1] if root.warning else 0
    BoxLayout:
        size_hint_y: None
        height: dp(34)
        spacing: dp(10)
        Chip:
            icon: 'bolt'
            role: root.battery_role
            text: root.battery_text
        Chip:
            icon: 'signal_disconnected' if root.lost else 'wifi'
            role: root.link_role
            text: root.link_text
        Chip:
            icon: root.driver_icon
            text: root.driver_text
            role: root.driver_role
            tinted: True
            spacing: dp(6) if root.driver_icon else 0
            opacity: 1 if root.driver_text else 0
        Widget:
    PushButton:
        id: connect
        height: root.button_height
        text: root.action
        fill: 'raised' if root.quiet else 'accent'
        border: 'line' if root.quiet else 'accent'
        ink: 'text' if root.quiet else 'ink_accent'
        on_release: root.dispatch('on_connect')

<ConnectScreen>:
    BoxLayout:
        orientation: 'vertical'
        padding: safe_area.insets
        EdgedBox:
            size_hint_y: None
            height: dp(56)
            padding: dp(16) if root.columns > 1 else dp(12), 0
            spacing: dp(12) if root.columns > 1 else dp(7)
            Text:
                id: title
                text: 'Pilothouse'
                bold: True
                font_size: min(theme.size_title, self.width / 5.6)
                pos_hint: {'center_y': .5}
            Chip:
                icon: 'wifi_find'
                role: 'accent'
                text: root.nearby if root.columns > 1 else root.nearby_short
                pos_hint: {'center_y': .5}
            InputsChip:
                id: inputs
                brief: root.columns == 1
                pos_hint: {'center_y': .5}
                on_release: root.app.show_inputs()
            Chip:
                id: setup
                icon: 'tune'
                role: 'text'
                text: tr('Setup') if root.columns > 1 else ''
                spacing: dp(8) if self.text else 0
                edge: dp(13) if self.text else dp(8)
                pressable: True
                scan_words: 'Setup'
                pos_hint: {'center_y': .5}
                on_release: root.app.show_setup()
            Chip:
                id: theme
                icon: root.theme_icon
                role: 'text'
                text: root.theme_text if root.columns > 1 else ''
                spacing: dp(8) if self.text else 0
                edge: dp(13) if self.text else dp(8)
                pressable: True
                pos_hint: {'center_y': .5}
                on_release: root.app.themes.choose_next()
        BoxLayout:
            id: page
            orientation: 'vertical'
            padding: root.edge, dp(22), root.edge, max(dp(22), root.keep_free[0])
            spacing: dp(22)
            Column:
                id: notices
                spacing: dp(10)
            ScrollView:
                do_scroll_x: False
                size_hint_y: None
                height: min(cards.height, page.height - page.padding[1] - page.padding[3] - notices.height - actions.height - dp(66))
                Grid:
                    id: cards
                    cols: root.columns
                    spacing: dp(18)
            Grid:
                id: actions
                cols: root.across
                spacing: dp(18)
                QuietButton:
                    id: add
                    icon: 'add_link'
                    text: 'Add by address'
                    size_hint_x: None
                    width: root.action_width
                    on_release: root.app.robot_list.ask_address()
                QuietButton:
                    id: pair
                    icon: 'qr_code_scanner'
                    text: 'Pair with a QR code'
                    size_hint_x: None
                    width: root.action_width
                    on_release: root.app.robot_list.trust.ask()
                QuietButton:
                    id: simulate
                    icon: 'play_circle'
                    text: root.simulator_text
                    size_hint_x: None
                    width: root.action_width
                    disabled: not root.can_simulate or root.simulating
                    opacity: 1 if root.can_simulate else 0
                    on_release: root.app.simulating.ask()
                QuietButton:
                    id: recordings
                    icon: 'history'
                    text: tr('Recordings')
                    size_hint_x: None
                    width: root.action_width
                    on_release: root.app.show_replay()
            Widget:
""")


def _shortened(name: str, most: int) -> str:
    """`name`, cut to `most` characters with a sign that it was cut; `somebody` where there is nothing to read in it."""
    name = " ".join(letters for letters in name.split() if letters.isprintable()) or "somebody"
    return name if len(name) <= most else f"{name[: most - 1].rstrip()}…"


def robot_icon(name: str) -> str:
    """The icon that a robot calls `name`; GENERIC_ICON for one that is not in this app's font."""
    return name if name in ICONS else GENERIC_ICON


def same_named(entries: Sequence[Entry]) -> set[str]:
    """Names that more than one robot has."""
    named = Counter(
        name for name, _ in {(entry.name, entry.boot or entry.url) for entry in entries if entry.name}
    )
    return {name for name, count in named.items() if count > 1}


class RobotCard(Card):
    """One robot: what it is, its battery, how far, who drives, and one big button."""

    __events__ = ("on_connect", "on_remove")

    title = StringProperty("")
    subtitle = StringProperty("")
    icon = StringProperty(GENERIC_ICON)
    lost = BooleanProperty(False)
    saved = BooleanProperty(False)
    warning = StringProperty("")
    """What is wrong with it, as a sentence; empty when nothing is known to be."""
    note = StringProperty("")
    """What it does, or by what it is told from others of its name; empty for nothing."""
    note_role = StringProperty("muted")
    snapshot = ObjectProperty(None, allownone=True)
    """The last picture that this handheld has seen of it, as a texture; None without one."""
    quiet = BooleanProperty(False)
    """The button offers nothing to look forward to: it tries again."""
    battery_text = StringProperty("—")
    battery_role = StringProperty("muted")
    link_text = StringProperty("")
    link_role = StringProperty("ok")
    driver_text = StringProperty("")
    driver_icon = StringProperty("")
    """Stands for `driven by` where a card has no room for the words."""
    driver_role = StringProperty("ok")
    action = StringProperty("Connect")
    button_height = NumericProperty("52dp")
    trust_text = StringProperty("")
    """How it is reached, in a word; empty within this machine."""
    trust_icon = StringProperty("")
    trust_role = StringProperty("muted")
    entry = ObjectProperty(None, allownone=True)
    """The robot, as of the list."""

    def show_entry(self, entry: Entry, me: str) -> None:
        """Take over what is known of the robot; `me` is what this handheld is called."""
        self.entry = entry
        self.icon, self.lost = robot_icon(entry.icon), entry.state == "lost"
        self.title = entry.name or entry.address
        about = [entry.description or "Saved address"]
        self.warning = entry.warning
        self.subtitle = " · ".join([*about, entry.address] if entry.name else about)
        self.saved = entry.saved or entry.trust == "paired"
        self.trust_icon, self.trust_text, self.trust_role = TRUST[entry.trust]
        self._show_battery(entry)
        self._show_link(entry)
        self._show_driver(entry, me)

    def show_place(self, *, twin: bool) -> None:
        """Say by what it is told from a robot that has its name too; nothing where none has."""
        said = tr("Another robot has this name too. This one is at {address}.")
        self.note = said.format(address=self.entry.address) if twin else ""
        self.note_role = "warn" if twin else "muted"

    def show_thumb(self, thumb: Thumb | None) -> None:
        """Show the last picture of it; None for none."""
        at = thumb.at if thumb is not None else math.nan
        if thumb is None:
            self.snapshot = None
        elif at != self._seen_at:
            texture = Texture.create(size=(thumb.width, thumb.height), colorfmt="rgba")
            texture.blit_buffer(thumb.rgba, colorfmt="rgba", bufferfmt="ubyte")
            texture.flip_vertical()
            self.snapshot = texture
        self._seen_at = at

    _seen_at = math.nan

    def _show_battery(self, entry: Entry) -> None:
        known = not math.isnan(entry.battery) and not self.lost
        self.battery_text = f"{entry.battery * 100:.0f} %" if known else "—"
        level = "danger" if entry.battery < LOW else "warn" if entry.battery < MIDDLE else "ok"
        self.battery_role = level if known else "muted"

    def _show_link(self, entry: Entry) -> None:
        if entry.state == "lost":
            said = f"no heartbeat for {entry.silent:.0f} s" if entry.reached else "its robot is not reached"
            self.link_text, self.link_role = said, "danger"
        elif not math.isnan(entry.latency):
            ms = entry.latency * 1000
            self.link_text, self.link_role = (f"{ms:.0f} ms" if ms >= 1 else "< 1 ms"), "ok"
        elif entry.state == "live":
            self.link_text, self.link_role = "in reach", "ok"
        else:
            self.link_text, self.link_role = "not heard yet", "muted"

    def _show_driver(self, entry: Entry, me: str) -> None:
        # a HELLO tells a name and not an identity: under this handheld's own name it may have control from before
        mine, other = entry.driver == me and bool(me), bool(entry.driver)
        if entry.state != "live":
            self.driver_text, self.driver_role = ("lost" if self.lost else ""), "danger"
        elif other:
            narrow = self.width < NARROW * Metrics.density
            name = _shortened(entry.driver, 10 if narrow else 18)
            self.driver_text, self.driver_role = name if narrow else f"driven by {name}", "warn"
        else:
            self.driver_text, self.driver_role = "free", "ok"
        self.driver_icon = "person" if other and self.driver_text == _shortened(entry.driver, 10) else ""
        self.quiet = self.lost
        self.action = "Retry" if self.lost else "Watch" if other and not mine else "Connect"
        if entry.trust == "stranger" and not self.lost:
            self.action = "Pair"

    def on_connect(self) -> None:
        """The big button was pressed."""

    def on_remove(self) -> None:
        """The saved address is to be forgotten."""


class RobotList(Protocol):
    """The list of robots, as far as its cards need it."""

    def forget(self, url: str) -> None:
        """Take a saved address off the list."""


class Visit(Protocol):
    """The visits to robots, as far as the cards need them."""

    seen: LastPictures


class Host(Protocol):
    """The app, as far as the cards need it; the bar's buttons are bound in kv."""

    @property
    def visit(self) -> Visit:
        """The visits to robots."""

    @property
    def robot_list(self) -> RobotList:
        """Every robot that can be connected to."""

    def open(self, url: str, *, watch: bool = False) -> None:
        """Connect to a robot; with `watch` without asking for control."""


class ConnectScreen(FloatLayout):
    """All robots that can be connected to."""

    app: ObjectProperty[Host] = ObjectProperty()
    nearby = StringProperty("Looking for robots")
    nearby_short = StringProperty("searching")
    card_width = NumericProperty("300dp")
    """[px]"""
    columns = NumericProperty(1)
    edge = NumericProperty("26dp")
    keep_free = ListProperty([0.0, 0.0])
    """What is left to STOP ALL: height along the lower edge, or width beside the ways to get to others [px]."""
    across = NumericProperty(4)
    """So many ways to get to others stand side by side."""
    action_width = NumericProperty("300dp")
    """[px]"""
    theme_icon = StringProperty("light_mode")
    theme_text = StringProperty("Sunlight")
    can_simulate = BooleanProperty(False)
    simulating = BooleanProperty(False)
    simulator_text = StringProperty("Start the built-in simulator")
    cards = ListProperty()
    """The cards on the glass, in their order."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._banner: Banner | None = None
        self._hint = Text(text=HINT, role="muted", halign="center", padding=(16, 24))
        self.bind(size=self._arrange, keep_free=self._arrange)
        safe_area.bind(insets=self._arrange)
        theme.bind(name=self._follow_theme)
        self._follow_theme()
        self._arrange()

    def _follow_theme(self, *_: object) -> None:
        self.theme_icon, self.theme_text, _name = THEMES[theme.name]

    def _arrange(self, *_: object) -> None:
        dp = Metrics.density
        wide = safe_area.within(self.width, self.height).width
        self.columns = connect_columns(wide, dp)
        self.edge = (26 if wide > 600 * dp else 14) * dp
        self.card_width = (wide - 2 * self.edge - (self.columns - 1) * 18 * dp) / self.columns
        across = self.across = 4 if self.columns > 1 else 1
        room = wide - 2 * self.edge - (across - 1) * 18 * dp - self.keep_free[1]
        self.action_width = room / across
        for card in self.cards:
            card.width = self.card_width

    def show_entries(self, entries: list[Entry], me: str) -> None:
        """Bring the cards up to date; a card stays where it is while its robot is listed."""
        if [card.entry.url for card in self.cards] != [entry.url for entry in entries]:
            self._rebuild(entries)
        double = same_named(entries)
        for card, entry in zip(self.cards, entries, strict=True):
            card.show_entry(entry, me)
            card.show_place(twin=entry.name in double)
            card.show_thumb(self.app.visit.seen.of(entry.url))
        live = sum(entry.state == "live" for entry in entries)
        self.nearby = f"{live} robot{'' if live == 1 else 's'} nearby" if live else "Looking for robots"
        self.nearby_short = f"{live} nearby" if live else "searching"
        if entries and self._hint.parent is not None:
            self.ids.notices.remove_widget(self._hint)
        elif not entries and self._hint.parent is None:
            self.ids.notices.add_widget(self._hint)

    def _rebuild(self, entries: list[Entry]) -> None:
        known = {card.entry.url: card for card in self.cards}
        self.ids.cards.clear_widgets()
        self.cards = [known.get(entry.url) or self._card() for entry in entries]
        for card in self.cards:
            self.ids.cards.add_widget(card)

    def _card(self) -> RobotCard:
        card = RobotCard(width=self.card_width)
        card.bind(
            on_connect=lambda one: self.app.open(one.entry.url, watch=one.action == "Watch"),
            on_remove=lambda one: self.app.robot_list.forget(one.entry.url),
        )
        return card

    def say(self, text: str, level: str = "info", on_tap: Callable[[], object] | None = None) -> None:
        """Show one sentence above the cards; empty takes it away. A tap takes it away and calls `on_tap`."""
        if self._banner is not None and self._banner.parent is not None and not text:
            self.ids.notices.remove_widget(self._banner)
        if not text:
            self._banner = None
            return
        if self._banner is None or self._banner.parent is None:
            self._banner = Banner(closable=True)
            self.ids.notices.add_widget(self._banner, index=len(self.ids.notices.children))
        self._banner.text, self._banner.level = text, level
        self._tap = on_tap
        self._banner.unbind(on_close=self._tapped)
        self._banner.bind(on_close=self._tapped)

    def unsay(self, text: str) -> None:
        """Take that sentence away, where it is still the one that is shown: it is no longer true."""
        if self._banner is not None and self._banner.text == text:
            self.say("")

    def _tapped(self, *_: object) -> None:
        if self._tap is not None:
            self._tap()

    def rest(self) -> None:
        """Nothing here moves a robot."""
