"""The connect screen: a card for each robot with one big button, and the ways to get to others."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.floatlayout import FloatLayout

from app.discovery.known_robots import Entry
from app.layout.arrange import connect_columns
from app.screens.connect.robot_card import RobotCard, same_named
from app.screens.parts.method_chip import InputsChip  # noqa: F401 - its rule draws what is used here
from app.screens.parts.safe_area import safe_area
from app.screens.parts.themes import THEMES
from app.session.last_pictures import LastPictures
from app.stop.robot_count import count
from widgets.core.language import mark, tr
from widgets.core.surfaces import EdgedBox  # noqa: F401 - its rule draws the bar
from widgets.core.theme import theme
from widgets.parts.kit import Banner, Text

__all__ = ["ConnectScreen"]

HINT = mark(
    "No robot found on this network yet.\nSwitch one on, enter its address, or start the built-in simulator."
)
Builder.load_string("""
#:import tr widgets.core.language.tr
#:import safe_area app.screens.parts.safe_area.safe_area
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
                text: tr('Pilothouse')
                bold: True
                font_size: min(theme.size_title, self.width / 5.6)
                pos_hint: {'center_y': .5}
            Chip:
                icon: 'wifi_find'
                role: 'accent'
                text: root.nearby if root.columns > 1 else root.nearby_short if root.width > sp(380) else ''
                spacing: dp(8) if self.text else 0
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
                scan_words: tr('Setup')
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
                padding: root.keep_free[1] if root.left_hand else 0, 0, 0, 0
                QuietButton:
                    id: add
                    icon: 'add_link'
                    text: tr('Add by address')
                    size_hint_x: None
                    width: root.action_width
                    on_release: root.app.robot_list.ask_address()
                QuietButton:
                    id: pair
                    icon: 'qr_code_scanner'
                    text: tr('Pair with a QR code')
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
    action_width = NumericProperty("300dp")
    """[px]"""
    theme_icon = StringProperty("light_mode")
    theme_text = StringProperty("")
    can_simulate = BooleanProperty(False)
    simulating = BooleanProperty(False)
    simulator_text = StringProperty("")
    cards = ListProperty()
    """The cards on the glass, in their order."""

    def __init__(self, **kwargs: Any) -> None:
        self.simulator_text = tr("Start the built-in simulator")
        self.nearby, self.nearby_short = tr("Looking for robots"), tr("searching")
        super().__init__(**kwargs)
        self._banner: Banner | None = None
        self._hint = Text(text=tr(HINT), role="muted", halign="center", padding=(16, 24))
        self.bind(size=self._arrange, keep_free=self._arrange)
        safe_area.bind(insets=self._arrange)
        theme.bind(name=self._follow_theme)
        self._follow_theme()
        self._arrange()

    def _follow_theme(self, *_: object) -> None:
        self.theme_icon, title, _ = THEMES[theme.name]
        self.theme_text = tr(title)

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
            card.show_thumb(self.app.visit.seen.of(entry.url) if self.app is not None else None)
        known = count(entries, None)
        self.nearby = known.words if known.robots else tr("Looking for robots")
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
