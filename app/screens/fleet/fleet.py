"""The fleet screen: every robot that is known as a card, with the one on the glass among them, and a tap to go to another."""

from __future__ import annotations

import math
from typing import Any

from kivy.lang import Builder
from kivy.properties import ObjectProperty

from app.discovery.known_robots import Entry
from app.layout import arrange
from app.layout.arrange import Body, Rect
from app.screens.connect.robot_card import RobotCard, same_named
from app.screens.parts.placing import Area, above, put  # noqa: F401 - a rule names the area
from app.screens.parts.robot_screen import RobotScreen
from app.screens.parts.screen_table import SCREENS
from app.screens.shell import status_text
from app.session.session import Session
from app.stop.robot_count import count
from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets.core.language import tr
from widgets.core.task_words import TASKS
from widgets.parts.column import Grid
from widgets.parts.kit import Roll, Text

__all__ = ["FleetScreen"]

SHOW_EVERY = 5
"""The cards are brought up to date in every so many ticks: a HELLO comes twice a second."""

Builder.load_string("""
<FleetScreen>:
    Area:
        id: listed
        spacing: dp(10)
""")


class FleetScreen(RobotScreen):
    """Who is there, what each does, and one tap to another; STOP ALL is in its corner as everywhere."""

    app = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.ids.listed = self.ids.listed.__self__  # kv holds ids weakly
        self.head = Text(bold=True, font_size="19sp")
        self.grid = Grid(spacing="14dp")
        roll = Roll()
        roll.add_widget(self.grid)
        self.ids.listed.add_widget(self.head)
        self.ids.listed.add_widget(roll)
        self.cards: dict[str, RobotCard] = {}
        """By address, in the order of the list."""
        self._ticks = 0
        self._cover: Rect | None = None
        self._whole, self.notice = Rect(0, 0, 1, 1), Rect(0, 0, 1, 1)

    def arrange(self, body: Body, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        places = arrange.more(body, form, dp)
        self.notice, self._whole = places["notice"], places["list"]
        self.grid.cols = arrange.connect_columns(self._whole.width, dp)
        self._place()
        return places["stop"]

    def _place(self) -> None:
        room = above(self._whole, self._cover, 1.0)
        put(self.ids.listed, room)
        columns = self.grid.cols or 1
        for card in self.cards.values():
            card.width = (room.width - (columns - 1) * self.grid.spacing[0]) / columns

    def clear(self, cover: Rect | None) -> None:
        """End above what is said over the screen."""
        self._cover = cover
        self._place()

    def enter(self) -> None:
        """Come onto the glass."""
        self._ticks = 0
        self.tick()

    def tick(self) -> None:
        """Bring the cards up to date."""
        if self._ticks % SHOW_EVERY == 0:
            self._show()
        self._ticks += 1

    def _show(self) -> None:
        entries = self._known()
        if list(self.cards) != [entry.url for entry in entries]:
            self._fill(entries)
        double = same_named(entries)
        for entry in entries:
            card = self.cards[entry.url]
            card.show_entry(entry, self.app.robot_list.client_name)
            card.show_place(twin=entry.name in double)
            card.show_thumb(self.app.visit.seen.of(entry.url))
            if entry.url == self.session.link.url:
                self._show_own(card)
            card.saved = False  # what is forgotten is forgotten on the connect page
        self._level()
        self.head.text = count(entries, self.session).words

    def _level(self) -> None:
        """Cards beside each other are as high as the highest of them."""
        cards, columns = list(self.cards.values()), self.grid.cols or 1
        for first in range(0, len(cards), columns):
            row = cards[first : first + columns]
            high = max(card.minimum_height for card in row)
            for card in row:
                card.row_height = high

    def _known(self) -> list[Entry]:
        """All of the list, the one on the glass first, be it heard or not."""
        entries: list[Entry] = self.app.robot_list.entries()
        url, info = self.session.link.url, self.session.robot.info
        own = next((entry for entry in entries if entry.url == url), None)
        if own is None:
            own = Entry(url, self.session.robot.name, info.kind, info.description, icon=info.icon)
        return [own, *(entry for entry in entries if entry.url != url)]

    def _fill(self, entries: list[Entry]) -> None:
        kept, self.cards = self.cards, {}
        self.grid.clear_widgets()
        for entry in entries:
            card = self.cards[entry.url] = kept.get(entry.url) or self._card()
            self.grid.add_widget(card)
        self._place()

    def _card(self) -> RobotCard:
        card = RobotCard()
        card.bind(on_connect=self._go)
        return card

    def _show_own(self, card: RobotCard) -> None:
        """What its link says is newer than its HELLO."""
        session = self.session
        words, _, role = status_text.mode(session)
        task: TaskStatus | None = session.feeds.latest("/task/status")
        doing = (
            TASKS[task.task].doing
            if task is not None and task.task in TASKS and task.state == "RUNNING"
            else ""
        )
        card.lost = not session.connected
        if not card.note:
            said = [words, doing if doing and doing not in words else ""]
            card.note, card.note_role = " · ".join(filter(None, said)), role
        battery = session.feeds.latest("/battery_state")
        if battery is not None and math.isfinite(battery.percentage):
            card.battery_text = f"{battery.percentage * 100:.0f} %"
        card.driver_text, _, card.driver_role = status_text.control(session, brief=True)
        card.driver_icon, card.outline = "", "accent"
        card.quiet, card.action = True, tr("On the glass: drive it")

    def _go(self, card: RobotCard) -> None:
        """To the drive screen of the one on the glass, or to another robot; a robot that moves is asked about before."""
        entry = card.entry
        if entry.url == self.session.link.url:
            self.app.show(next(one.name for one in SCREENS if not one.maker))
            return
        watch = entry.driver not in ("", self.app.robot_list.client_name)
        self.app.leaving.leave(lambda: self.app.open(entry.url, watch=watch))
