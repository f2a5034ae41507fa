"""The connect screen: a card for each robot with one big button, and the ways to get to others."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.floatlayout import FloatLayout

from app.discovery.known_robots import Entry
from app.layout.arrange import connect_columns, form
from app.screens.connect.robot_card import RobotCard, same_named
from app.screens.parts.method_chip import InputsChip  # noqa: F401 - its rule draws what is used here
from app.screens.parts.safe_area import safe_area
from app.screens.parts.themes import THEMES
from app.session.last_pictures import LastPictures
from app.stop.robot_count import count
from bridge.discovery.domain import discovery_domain
from widgets.core.base import fitting_size
from widgets.core.language import mark, tr
from widgets.core.surfaces import EdgedBox  # noqa: F401 - its rule draws the bar
from widgets.core.theme import theme
from widgets.parts.kit import Banner, Text

__all__ = ["ConnectScreen"]

WAYS_WIDTH = 240
"""Of the ways to get to others beside the cards of a phone on its side [dp]."""
HINT = mark(
    "No robot found on this network yet.\nSwitch one on, enter its address, or start the built-in simulator."
)
Builder.load_string("""
#:import tr widgets.core.language.tr
#:import safe_area app.screens.parts.safe_area.safe_area
<ConnectScreen>:
    room: page.height - page.padding[1] - page.padding[3] - (0 if root.short else ways.height + 2 * root.between)
    BoxLayout:
        orientation: 'vertical'
        padding: safe_area.insets
        EdgedBox:
            size_hint_y: None
            height: dp(48) if root.short else max(dp(56), theme.least)
            padding: dp(16) if root.roomy else dp(12), 0
            spacing: dp(12) if root.roomy else dp(7)
            Text:
                id: title
                text: tr('Pilothouse')
                bold: True
                font_size: min(theme.size_title, self.width / 5.6)
                pos_hint: {'center_y': .5}
            Chip:
                icon: 'wifi_find'
                role: 'accent'
                text: root.nearby if root.roomy else root.nearby_short if root.width > sp(380) else ''
                spacing: dp(8) if self.text else 0
                pos_hint: {'center_y': .5}
            InputsChip:
                id: inputs
                brief: not root.roomy
                pos_hint: {'center_y': .5}
                on_release: root.app.show_inputs()
            Chip:
                id: setup
                icon: 'tune'
                role: 'text'
                text: tr('Setup') if root.roomy else ''
                spacing: dp(8) if self.text else 0
                edge: dp(13) if self.text else dp(8)
                pressable: True
                narrowest: min(theme.least, root.width / 5.8)
                scan_words: tr('Setup')
                pos_hint: {'center_y': .5}
                on_release: root.app.show_setup()
            Chip:
                id: theme
                icon: root.theme_icon
                role: 'text'
                text: root.theme_text if root.roomy else ''
                spacing: dp(8) if self.text else 0
                edge: dp(13) if self.text else dp(8)
                pressable: True
                narrowest: min(theme.least, root.width / 5.8)
                pos_hint: {'center_y': .5}
                on_release: root.app.themes.choose_next()
        BoxLayout:
            id: page
            orientation: 'horizontal' if root.short else 'vertical'
            padding: root.edge, root.between, root.edge - (root.between if root.short else 0), 0 if root.short else max(root.between, root.keep_free[0])
            spacing: root.between
            BoxLayout:
                id: near
                orientation: 'vertical'
                size_hint_y: 1 if root.short else None
                height: notices.height + root.between + listed.height
                spacing: root.between
                Column:
                    id: notices
                    spacing: dp(10)
                ScrollView:
                    id: listed
                    do_scroll_x: False
                    size_hint_y: None
                    height: max(0, min(cards.height, root.room - notices.height - root.between))
                    Grid:
                        id: cards
                        cols: root.columns
                        spacing: dp(18)
                Widget:
                    size_hint_y: 1 if root.short else None
                    height: 0
            ScrollView:
                id: ways
                do_scroll_x: False
                size_hint: None if root.short else 1, None
                width: root.action_width
                height: min(actions.height, page.height * .5) if not root.short else page.height - root.between - (dp(82) if root.keep_free[1] else root.between)
                pos_hint: {'top': 1} if root.short else {}
                Grid:
                    id: actions
                    cols: root.across
                    spacing: dp(18) if not root.short else dp(6)
                    QuietButton:
                        id: add
                        icon: 'add_link'
                        text: tr('Add by address')
                        size_hint_x: None
                        size: root.action_width, root.action_height
                        type_size: root.type_size
                        on_release: root.app.robot_list.ask_address()
                    QuietButton:
                        id: pair
                        icon: 'qr_code_scanner'
                        text: tr('Pair with a QR code')
                        size_hint_x: None
                        size: root.action_width, root.action_height
                        type_size: root.type_size
                        on_release: root.app.robot_list.trust.ask()
                    QuietButton:
                        id: simulate
                        icon: 'play_circle'
                        text: root.simulator_text
                        size_hint_x: None
                        size: root.action_width, root.action_height
                        type_size: root.type_size
                        disabled: not root.can_simulate or root.simulating
                        opacity: 1 if root.can_simulate else 0
                        on_release: root.app.simulating.ask()
                    QuietButton:
                        id: recordings
                        icon: 'history'
                        text: tr('Recordings')
                        size_hint_x: None
                        size: root.action_width, root.action_height
                        type_size: root.type_size
                        on_release: root.app.show_replay()
            Widget:
                size_hint: (0, 0) if root.short else (1, 1)
""")


class RobotList(Protocol):
    """The list of robots, as far as its cards need it."""

    def forget(self, url: str) -> None:
        """Take a saved address off the list."""


def looking() -> str:
    """What is said while no robot is found: of which discovery domain robots are looked for, if of one with a name."""
    domain = discovery_domain()
    return tr("Looking for robots of {domain}").format(domain=domain) if domain else tr("Looking for robots")


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
    nearby = StringProperty("")
    nearby_short = StringProperty("")
    card_width = NumericProperty("300dp")
    """[px]"""
    columns = NumericProperty(1)
    edge = NumericProperty("26dp")
    keep_free = ListProperty([0.0, 0.0])
    """What is left to STOP ALL: height along the lower edge, or width beside the ways to get to others [px]."""
    left_hand = BooleanProperty(False)
    """STOP ALL is at the left."""
    across = NumericProperty(4)
    """So many ways to get to others stand side by side."""
    action_width, action_height = NumericProperty("300dp"), NumericProperty("52dp")
    """Of each of them [px]."""
    type_size = NumericProperty(0)
    """Of the words on all of them [px]."""
    short = BooleanProperty(False)
    """A phone on its side: the ways to get to others stand beside the cards, above STOP ALL."""
    roomy = BooleanProperty(False)
    """The bar has room for words."""
    between = NumericProperty("22dp")
    """From one thing to the next [px]."""
    room = NumericProperty(0)
    """Height that notices and cards have [px]."""
    theme_icon = StringProperty("light_mode")
    theme_text = StringProperty("")
    can_simulate = BooleanProperty(False)
    simulating = BooleanProperty(False)
    simulator_text = StringProperty("")
    cards = ListProperty()
    """The cards on the glass, in their order."""

    def __init__(self, **kwargs: Any) -> None:
        self.simulator_text = tr("Start the built-in simulator")
        self.nearby, self.nearby_short = looking(), tr("searching")
        super().__init__(**kwargs)
        self._banner: Banner | None = None
        self._hint = Text(text=tr(HINT), role="muted", halign="center", padding=(16, 24))
        self._columns = list(reversed(self.ids.page.children))  # kv holds ids weakly
        self.bind(size=self._arrange, keep_free=self._arrange, left_hand=self._arrange)
        safe_area.bind(insets=self._arrange)
        theme.bind(name=self._follow_theme, target=self._arrange)
        self.bind(simulator_text=self._arrange)
        self._follow_theme()
        self._arrange()

    def _follow_theme(self, *_: object) -> None:
        self.theme_icon, title, _next = THEMES[theme.name]
        self.theme_text = tr(title)

    def _arrange(self, *_: object) -> None:
        dp = Metrics.density
        inside = safe_area.within(self.width, self.height)
        self.short = form(inside.width, inside.height, dp) == "short"
        self.roomy = connect_columns(inside.width, dp) > 1
        self._order()
        self.edge = (26 if inside.width > 600 * dp and not self.short else 14) * dp
        self.between = (10 if self.short else 22) * dp
        beside = max(WAYS_WIDTH * dp, self.keep_free[1] - 18 * dp) if self.short else 0.0
        wide = inside.width - beside - (self.between if self.short else 0)
        self.columns = connect_columns(wide, dp)
        self.card_width = (wide - 2 * self.edge - (self.columns - 1) * 18 * dp) / self.columns
        self.across = 4 if self.roomy and not self.short else 1
        self.action_width = beside or (wide - 2 * self.edge - (self.across - 1) * 18 * dp) / self.across
        self._size_ways(inside.height, dp)
        for card in self.cards:
            card.width = self.card_width

    def _order(self) -> None:
        """Beside each other the ways to get to others are where STOP ALL is."""
        near, ways, rest = self._columns
        wanted = [ways, near, rest] if self.short and self.left_hand else [near, ways, rest]
        page = self.ids.page
        if list(reversed(page.children)) != wanted:
            page.clear_widgets()
            for column in wanted:
                page.add_widget(column)

    def _size_ways(self, height: float, dp: float) -> None:
        """One height and one size of type for all ways to get to others; on a phone's side they share what STOP ALL leaves."""
        self.action_height = theme.target
        if self.short:
            left = height - 48 * dp - self.between - ((82 if self.keep_free[1] else 10) + 3 * 6) * dp
            self.action_height = max(theme.least, min(theme.target, left / 4))
        ways = [self.ids[name] for name in ("add", "pair", "simulate", "recordings")]
        room = min(way.words_room for way in ways)
        self.type_size = fitting_size(
            [way.text for way in ways] + [self.simulator_text], theme.size_body, room, bold=True
        )

    def show_entries(self, entries: list[Entry], me: str) -> None:
        """Bring the cards up to date; a card stays where it is while its robot is listed."""
        if [card.entry.url for card in self.cards] != [entry.url for entry in entries]:
            self._rebuild(entries)
        double = same_named(entries)
        for card, entry in zip(self.cards, entries, strict=True):
            card.show_entry(entry, me)
            card.show_place(twin=entry.name in double)
            card.show_thumb(self.app.visit.seen.of(entry.url) if self.app is not None else None)
        known = count(entries, None)
        self.nearby = known.words if known.robots else looking()
        self.nearby_short = known.brief_words if known.robots else tr("searching")
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
            on_connect=lambda one: self.app.open(one.entry.url, watch=one.watches),
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
