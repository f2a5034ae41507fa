"""The map on the glass, and what lies beneath its grid: what the operator chose and what covers the robot."""

from __future__ import annotations

import math

import numpy as np

from app.layout.arrange import Rect
from app.maps.ground_keeper import GroundKeeper
from app.maps.maps import Maps
from app.screens.mission.layers_card import LayersCard
from app.screens.mission.map_pointing import EditedMap, MapPointing
from app.session.dashboard import Dashboard
from app.session.session import Session
from widgets import GridMap

__all__ = ["MissionMaps"]


class MissionMaps:
    """One map, and the keeper of its ground."""

    def __init__(self, session: Session, dashboard: Dashboard, maps: Maps) -> None:
        self._dashboard = dashboard
        self.shown = GridMap()
        """The map on the glass."""
        self.keeper = GroundKeeper(self.shown, maps, session.feeds.latest)
        """Keeps tiles or a picture beneath it."""

        self._maps, self._offered = maps, False
        self._cover: Rect | None = None
        self._asked: tuple[object, ...] = ()
        self.shown.bind(candidates=self._show_asked, mode=self._show_asked)
        self._card: LayersCard | None = None

    def follow(self, pointing: MapPointing) -> None:
        """Let the map show what the robot says, and `pointing` do what fingers on it ask for."""
        bind, one = self._dashboard.bind, self.shown
        pointing.follow(one)
        bind(one, "/places", lambda msg: pointing.places.show(one, msg), fresh=False)
        bind(one, "/pose", always=True)
        for topic in ("/plan", "/intruders", "/scan", "/limits", "/map", "/localisation/candidates"):
            bind(one, topic, fresh=False)

    def make_room(self, cover: Rect | None) -> None:
        """Something lies over the map: what the robot asks about is seen beneath it."""
        self._cover = cover
        self._show_asked()

    def _show_asked(self, *_: object) -> None:
        """Bring the places at which the robot may be into sight, once for each question and each card over the map."""
        one, found = self.shown, self.shown.candidates
        if not found:
            one.look_away()
        asked = (self._cover, *sorted(each.id for each in found)) if found else ()
        if asked == self._asked or one.mode != "view":
            return
        self._asked = asked
        if found:
            below = math.inf if self._cover is None else self._cover.y
            one.look_at(np.array([(each.x, each.y) for each in found]), below)

    @property
    def offered(self) -> bool:
        """There is something to be chosen to lie beneath the map."""
        return self.keeper.place.datum is not None or bool(self.keeper.covering())

    def tick(self, screen: EditedMap) -> bool:
        """Bring what lies beneath the map up to date, and say once where that goes wrong; True where `offered` changed."""
        self.keeper.look()
        if self._card is not None and self._card.parent is not None:
            self._card.tick()
        shell = screen.app.shell
        if shell is not None and (trouble := self.keeper.news()):
            shell.say(trouble, "warn", about="map")
        before, self._offered = self._offered, self.offered
        return self._offered != before

    def toggle_card(self, screen: EditedMap) -> None:
        """Ask on a card what lies beneath the map, or do not any more."""
        if self._card is None:
            card = self._card = LayersCard(self._maps, self.keeper, lambda: self.shown)
            card.bind(on_shut=lambda _: screen.show_card(None), on_setup=lambda _: _set_up(screen))
        if self._card.parent is not None:
            screen.show_card(None)
            return
        self._card.open()
        screen.show_card(self._card)

    def end(self) -> None:
        """End the reading of what lies beneath the map."""
        self.keeper.close()
        self.shown.close()


def _set_up(screen: EditedMap) -> None:
    """Where maps are added and taken away."""
    screen.show_card(None)
    screen.app.show("setup")
    screen.app.screens["setup"].open("maps")
