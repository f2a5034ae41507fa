"""A view on the glass: its cards on the board, their widgets, the topics that feed them, and the controls among them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec

from app.layout.panel_grid import FORMS
from app.layout.view_checks import is_control, is_signal
from app.layout.views import Panel, View, places_of, stacks_of
from app.link.camera_decoder import Picture
from app.link.feeds import Post
from app.screens.panels.board import Board
from app.screens.panels.offers import title_of
from app.screens.panels.panel_card import PanelCard
from app.screens.panels.panel_controls import PanelControls
from app.screens.panels.panel_feeds import PanelFeeds
from app.screens.panels.panel_signals import PanelSignals
from app.screens.panels.panel_widgets import make_instrument
from app.screens.shell.screen_host import ScreenHost
from app.session.session import Session
from widgets import Video
from widgets.controls.sticks.stick import Stick
from widgets.core.language import tr
from widgets.map.map_overlay import MapOverlay

__all__ = ["ViewShow"]

PLACES_ASKED = "/localisation/candidates"
"""Where the robot may be while it is unsure: every map shows it, whatever else its panel does."""


class ViewShow:
    """Shows one view at a time. What is not in sight is neither drawn nor drives."""

    def __init__(
        self, board: Board, session: Session, app: ScreenHost, on_act: Callable[[int, str], object]
    ) -> None:
        """`on_act` is called with the index of a panel and what its card was asked for."""
        self._board, self._session, self._app, self._on_act = board, session, app, on_act
        self._feeds = PanelFeeds(session)
        self._controls: PanelControls | None = None
        self._signals: PanelSignals | None = None
        self._view = View("")
        self._cards: dict[int, PanelCard] = {}
        """By the index of the first panel of a stack."""
        self._tabs: dict[int, int] = {}
        """Which of a stack is in sight, by the index of its first."""
        self.active = False
        """The screen is on the glass."""
        board.bind(scroll_y=lambda *_: self._scrolled())

    # what is shown

    def show(self, view: View, form: str, *, editing: bool) -> None:
        """Put a view on the board; where only places differ from what is there, its widgets stay."""
        known = (_without_places(view), editing) == (_without_places(self._view), self._board.editing)
        if not known or not self._cards:
            self.clear()
            self._board.editing, self._board.form, self._view = editing, form, view
            self._make()
        self._view = view
        self._board.form = form
        self._place()
        if self.active and not known:
            self.enter()
        self._rest_unseen()

    def _make(self) -> None:
        """The cards of the view, with the widgets that are in sight."""
        view, editing = self._view, self._board.editing
        self._feeds = PanelFeeds(self._session)
        panels = self._shown_panels()
        self._controls = PanelControls(panels, self._session, self._app, self._seen)
        self._signals = PanelSignals(panels, self._session, self._seen)
        for group in stacks_of(view.panels):
            there = [index for index in group if editing or not view.panels[index].hidden]
            if there:
                card = PanelCard(editing=editing, indices=there)
                card.bind(on_act=lambda one, what: self._on_act(int(one.shown), what))
                card.bind(on_tab=self._turn)
                self._cards[group[0]] = card
                self._turn(card, self._tabs.get(group[0], 0), opened=False)

    def _shown_panels(self) -> list[Panel | None]:
        """The panels by their index, None in the place of one that is hidden."""
        editing = self._board.editing
        return [None if one.hidden and not editing else one for one in self._view.panels]

    def _turn(self, card: PanelCard, number: int, *, opened: bool = True) -> None:
        """Bring a panel of a stack into sight; the one before lets go."""
        number = min(number, len(card.indices) - 1)
        first = next((key for key, one in self._cards.items() if one is card), card.indices[0])
        self._tabs[first] = number
        if card.widget is not None and hasattr(card.widget, "rest"):
            card.widget.rest()
        index = card.indices[number]
        panel = self._view.panels[index]
        card.shown, card.away, card.title = index, panel.hidden, title_of(panel)
        card.brief = title_of(panel, brief=True)
        names = [title_of(self._view.panels[one], brief=True) for one in card.indices]
        card.name_tabs(names, number)
        widget = self._hands.get(index)
        if widget is None and not _commands(panel):
            widget = make_instrument(panel, self._kind(panel))
            self._bind(card, panel, widget)
        elif widget is not None and is_signal(panel.widget) and panel.also:
            self._feeds.bind(widget, panel.also[0], lambda: card.widget is widget, fresh=False)
        card.put(widget)
        if opened and self.active:
            self._feeds.open()
            self._rest_unseen()

    @property
    def _parts(self) -> list[PanelControls | PanelSignals]:
        """What of the view a finger commands with."""
        return [part for part in (self._controls, self._signals) if part is not None]

    @property
    def _hands(self) -> dict[int, Any]:
        """Their widgets by the index of the panel."""
        return {index: widget for part in self._parts for index, widget in part.widgets.items()}

    def _kind(self, panel: Panel) -> str:
        """Type of a panel's topic, its ROS 1 name; empty where the robot has not said it."""
        offer = self._session.robot.capabilities
        return offer.topics.get(panel.topic, "") if offer is not None else ""

    def _bind(self, card: PanelCard, panel: Panel, widget: Any) -> None:
        def seen() -> bool:
            return card.widget is widget and self._board.in_sight(card)

        if isinstance(widget, Video):
            found = self._session.cameras.detections_shown
            if panel.topic.endswith("/compressed"):
                self._feeds.bind(
                    widget,
                    "/detections",
                    lambda: seen() and not self._other_camera(panel),
                    lambda said: widget.show(found(said)),
                    fresh=False,
                )
                return
        for number, topic in enumerate(panel.topics):
            self._feeds.bind(widget, topic, seen, fresh=number == 0)
        if isinstance(widget, MapOverlay) and PLACES_ASKED not in panel.topics:
            self._feeds.bind(widget, PLACES_ASKED, seen, fresh=False)

    def _place(self) -> None:
        """Put the cards where the view has them in a window of this form."""
        keys = list(self._cards)
        panels = [self._view.panels[key] for key in keys]
        alone = [msgspec.structs.replace(one, stack="") for one in panels]
        places = places_of(alone, self._board.form)
        chosen = self._board.selected
        self._board.arrange([(self._cards[key], place) for key, place in zip(keys, places, strict=True)])
        self._board.select(chosen if chosen in self._cards.values() else None)

    def clear(self) -> None:
        """Take everything off the board; every control lets go first."""
        for part in self._parts:
            part.leave()
        self._controls = self._signals = None
        self._feeds.close()
        self._cards.clear()
        self._board.clear()

    def card_of(self, index: int) -> PanelCard | None:
        """The card in which the panel of that index lies."""
        return next((card for card in self._cards.values() if index in card.indices), None)

    def select(self, index: int | None) -> None:
        """Mark the card of a panel and bring it into sight; None for none."""
        card = None if index is None else self.card_of(index)
        self._board.select(card)
        if card is not None:
            self._board.reveal(card)

    # what the screen calls

    @property
    def sticks(self) -> list[tuple[Stick, str]]:
        """What drives and is in sight; nothing while the view is edited."""
        return self._controls.sticks if self._controls is not None else []

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold besides and is in sight."""
        return [grip for part in self._parts for grip in part.grips]

    @property
    def videos(self) -> list[Video]:
        """Pictures of the chosen camera that are in sight."""
        cards = (card for card in self._cards.values() if isinstance(card.widget, Video))
        return [
            card.widget
            for card in cards
            if self._board.in_sight(card) and not self._other_camera(self._view.panels[int(card.shown)])
        ]

    def _other_camera(self, panel: Panel) -> bool:
        """The panel is of a camera, and the pictures that come are known to be of another: it must not show them as its own."""
        watched = self._session.cameras.topic
        camera = panel.widget == "Video" and panel.topic.endswith("/compressed")
        return camera and bool(watched) and panel.topic != watched

    def enter(self) -> None:
        """Come onto the glass."""
        self.active = True
        self._feeds.open()
        for part in self._parts:
            part.enter()
        self._say_problems()

    def leave(self) -> None:
        """Leave the glass: every control lets go, and nothing is listened to any longer."""
        self.active = False
        self.clear()

    def rest(self) -> None:
        """Every control lets go."""
        for part in self._parts:
            part.rest()

    def on_post(self, channel: str, post: Post) -> None:
        """A message came."""
        if not self.active:
            return
        self._feeds.on_post(channel, post)
        for part in self._parts:
            part.on_post(channel, post)

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self._feeds.tick()
        for part in self._parts:
            part.tick()
        self._say_problems()

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """A camera frame came."""
        for video in self.videos:
            video.show_frame(picture.width, picture.height, picture.rgba, picture.taken)
            video.rate, video.latency = rate, latency

    def _say_problems(self) -> None:
        for card in self._cards.values():
            index = int(card.shown)
            topic = self._view.panels[index].topic
            told = self._signals is not None and index in self._signals.widgets
            card.beneath = self._signals.problem(index) if self._signals is not None and told else ""
            card.problem = self._feeds.problem(topic) if topic and not told else ""
            if self._other_camera(self._view.panels[index]):
                watched = self._session.cameras.topic
                card.problem = tr("Another camera is chosen: {topic}.").format(topic=watched)
        videos = self.videos
        for video in videos[1:]:
            video.state, video.age = videos[0].state, videos[0].age

    def _seen(self, widget: Any) -> bool:
        """A control is on the glass, in sight, and not edited."""
        if not self.active or self._board.editing:
            return False
        card = next((one for one in self._cards.values() if one.widget is widget), None)
        return card is not None and self._board.in_sight(card)

    def _rest_unseen(self) -> None:
        for part in self._parts:
            part.rest_unseen()

    def _scrolled(self) -> None:
        self._rest_unseen()
        if self.active:
            self._feeds.refresh()


def _commands(panel: Panel) -> bool:
    """A finger commands with it."""
    return is_control(panel.widget) or is_signal(panel.widget)


def _without_places(view: View) -> list[Panel]:
    nowhere: dict[str, Any] = dict.fromkeys(FORMS)
    return [msgspec.structs.replace(panel, **nowhere) for panel in view.panels]
