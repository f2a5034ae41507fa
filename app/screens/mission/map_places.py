"""Places that have names on the map: made, opened and moved by a finger, asked for in a card beside which the map stays."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import msgspec
from kivy.uix.widget import Widget

from app.link.commands import Outcome
from app.screens.mission.place_card import PlaceCard
from app.screens.shell.screen_host import ScreenHost
from app.session.session import Session
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Place, PlaceArray
from widgets.core.language import tr
from widgets.map.map_overlay import MapOverlay

__all__ = ["MapPlaces"]


class PlacesMap(Protocol):
    """The mission screen, as far as the places on its map need it."""

    @property
    def app(self) -> ScreenHost:
        """The app behind the screen."""

    @property
    def map(self) -> MapOverlay:
        """The map on the glass."""

    @property
    def mode(self) -> str:
        """What a finger on the map does."""

    @mode.setter
    def mode(self, value: str) -> None: ...

    def show_card(self, card: Widget | None) -> None:
        """Have a card over the map, beside which what it asks of is seen; None takes it away."""


class MapPlaces:
    """The places of one robot on the maps of one mission screen."""

    def __init__(self, screen: PlacesMap, session: Session, on_change: Callable[[], object]) -> None:
        """`on_change` is called when what is asked of the operator has changed."""
        self._screen, self._session, self._on_change = screen, session, on_change
        self._told = PlaceArray()
        self._moving: Place | None = None
        """The place whose position the next tap says; None for a new one."""
        self._mode = ""
        """What a finger did before that, and does again after it; empty where it does the same."""
        self._choose: Callable[[Place], object] | None = None
        """Gets the place that the next tap on one chooses; None while none is to be chosen."""
        self._card: PlaceCard | None = None

    @property
    def card(self) -> PlaceCard:
        """The card, made when it is first asked for."""
        if self._card is None:
            card = self._card = PlaceCard(self._session)
            card.bind(
                on_shut=lambda _: self._shut(),
                on_move=lambda _, place: self.move(place),
                on_go=lambda _, place: self._go(place),
            )
            card.form.bind(on_command=lambda *_: self._draw())
            card.pane.bind(on_back=lambda _, place: self._open(place))
        return self._card

    @property
    def open(self) -> bool:
        """A place is asked for in the card."""
        return self._card is not None and self._card.parent is not None

    @property
    def asks(self) -> str:
        """What a tap on the map is wanted for, as a sentence; empty where it is for nothing in particular."""
        if self._choose is not None:
            return tr("Tap the place to choose.")
        return tr("Tap where {place} is.").format(place=self._moving.name) if self._moving is not None else ""

    # what comes in

    def show(self, one: MapOverlay, msg: PlaceArray) -> None:
        """Show the places that have names on a map."""
        self._told = msg
        one.places = self._marks()
        if self._card is not None:
            self._card.pane.name_places(msg)

    def on_pose(self, msg: PoseWithCovarianceStamped) -> None:
        """The robot is there, from which a direction to stand in begins."""
        if self._card is not None:
            self._card.form.show(msg)

    def on_outcome(self, outcome: Outcome) -> None:
        """The robot answered to a command."""
        if self._card is not None:
            self._card.on_outcome(outcome)

    def tick(self) -> None:
        """Bring up to date what time changes."""
        if self._card is not None and self.open:
            self._card.tick()

    def rest(self) -> None:
        """Fingers let go of what they hold."""
        if self._card is not None:
            self._card.rest()

    # what fingers do

    def point(self, x: float, y: float) -> None:
        """A finger pointed at (x, y) in `map` [m]: there is a new place, or the one that is asked for or moved."""
        if self._choose is not None or not self._session.robot.offers("/places/set"):
            return
        if self.open:
            self.card.move_to(x, y)
            self._draw()
            return
        place, self._moving = self._moving or Place(), None
        if self._mode:
            self._screen.mode, self._mode = self._mode, ""
        self._open(msgspec.structs.replace(place, x=x, y=y))
        self.card.edited = True

    def open_at(self, index: int) -> None:
        """A finger pointed at the place with this number, from 0."""
        if index >= len(self._told.places):
            return  # the one that is being made
        place = self._told.places[index]
        if self._choose is not None:
            chosen, self._choose = self._choose, None
            self._screen.mode, self._mode = self._mode, ""
            chosen(place)
            return
        if self._moving is not None or (self.open and self.card.edited):
            self.point(place.x, place.y)  # a place may come to lie on another one's mark
        else:
            self._open(place)

    def move(self, place: Place) -> None:
        """Let the next tap say where a place is."""
        if self._card is not None and self.open:
            self._card.leave()
        self._moving, self._choose, self._mode = place, None, self._screen.mode
        self._screen.mode = "place"
        self._on_change()

    def choose(self, on_chosen: Callable[[Place], object]) -> None:
        """Let the next tap on a place choose it."""
        if self._card is not None and self.open:
            self._card.leave()
        self._moving, self._choose, self._mode = None, on_chosen, self._screen.mode
        self._screen.mode = "place"
        self._on_change()

    def stay(self) -> None:
        """The next tap says nothing of a place that was to be moved or chosen."""
        self._moving, self._choose, self._mode = None, None, ""

    def _go(self, place: Place) -> None:
        self.card.leave()
        app = self._screen.app
        app.show("tasks")
        app.screens["tasks"].begin("go_to", (place.name,))

    def _open(self, place: Place) -> None:
        card = self.card
        card.edit(place)
        pose: PoseWithCovarianceStamped | None = self._session.feeds.latest("/pose")
        if pose is not None:
            card.form.show(pose)
        self._screen.show_card(card)
        self._draw()
        self._screen.map.reveal(place.x, place.y)
        self._on_change()

    def _shut(self) -> None:
        self._screen.show_card(None)
        self._draw()
        self._on_change()

    # what is drawn

    def _draw(self) -> None:
        self._screen.map.places = self._marks()

    def _marks(self) -> list[tuple[float, float, str, str]]:
        """The places as the robot has them, the one on the card as it stands there."""
        marks = [(place.x, place.y, place.name, place.kind) for place in self._told.places]
        if not self.open:
            return marks
        made = self.card.place
        mark = (made.x, made.y, made.name or tr("New place"), made.kind)
        at = next(
            (at for at, one in enumerate(self._told.places) if made.id and one.id == made.id), len(marks)
        )
        return [*marks[:at], mark, *marks[at + 1 :]]
