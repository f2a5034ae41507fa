"""What is on the glass of the app, and what leads there: the robot's screens, the pages without one, and the list of keys."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

from app.core.notifications import notify
from app.core.preferences import Preferences
from app.core.settings_store import Settings
from app.discovery.known_robots import KnownRobots
from app.network_side import NetworkSide
from app.pages import Pages, toggle_help
from app.robot_directory import RobotDirectory
from app.robot_visit import RobotVisit
from app.screens.connect.connect import ConnectScreen
from app.screens.parts.themes import Themes
from app.sounds.sounds import Sounds

if TYPE_CHECKING:
    from app.maps.maps import Maps
    from app.screens.shell.shell import Shell  # made when there is a robot, for a quick start
    from app.screens.tour.tour import Tour
    from app.session.session import Session

__all__ = ["SEEN", "Showing"]

SEEN = "toured"
"""Name in the settings of whether the tour was seen or left."""


class Showing:
    """Mixin of the app, which makes what is declared here."""

    pages: Pages
    visit: RobotVisit
    robot_list: RobotDirectory
    settings: Settings
    preferences: Preferences
    themes: Themes
    connect: ConnectScreen
    sounds: Sounds
    client_name: str
    _network: NetworkSide
    _tour: Tour | None = None

    @cached_property
    def maps(self) -> Maps:
        """Maps of the operator's choice; made when they are first asked for, which needs what the first frame does not."""
        from app.maps.maps import Maps

        return Maps(self.settings, self.settings.path.parent)

    @property
    def tour(self) -> Tour:
        """The look round, made when it is first asked for."""
        if self._tour is None:
            from app.screens.tour.tour import Tour

            self._tour = Tour(self)
        return self._tour

    def begin_tour_if_new(self) -> None:
        """Begin it for somebody who has neither seen nor left it."""
        if self.settings.get(SEEN) is not True:
            self.tour.begin()

    def end_tour(self) -> None:
        """Take it off the glass with the app; who has not left it sees it again."""
        if self._tour is not None:
            self._tour.leave(seen=False)

    def renew_tour(self) -> None:
        """Make what is on the glass of it anew."""
        if self._tour is not None:
            self._tour.renew()

    @property
    def session(self) -> Session | None:
        """The session with the robot; None while none is wanted."""
        return self.visit.session

    @property
    def shell(self) -> Shell | None:
        """The frame round the robot's screens; None on the connect screen."""
        return self.pages.shell

    @property
    def screens(self) -> Mapping[str, Any]:
        """Every screen there is now by its name: `connect`, and with a robot `mission`, `drive`, `tasks`, `topics` and `inputs`, each made when it is looked up."""
        return self.pages.screens

    @property
    def robots(self) -> KnownRobots:
        """Every robot that is heard or saved."""
        return self.robot_list.robots

    def show(self, screen: str) -> None:
        """Put `mission`, `drive`, `tasks`, `topics` or `inputs` on the glass; KeyError for another."""
        self.pages.show(screen)

    def show_inputs(self, pane: str = "") -> None:
        """Put on the glass where the ways in are set up, with a robot or without one; `pane` is open where there is one of that name."""
        self._show_anywhere("inputs", pane)

    def show_setup(self, pane: str = "") -> None:
        """Put on the glass what is chosen for this handheld, with a robot or without one; `pane` is open where there is one of that name."""
        self._show_anywhere("setup", pane)

    def show_replay(self) -> None:
        """Put the recordings on the glass, with a robot or without one."""
        self._show_anywhere("replay")

    def _show_anywhere(self, name: str, pane: str = "") -> None:
        if self.shell is not None:
            self.show(name)
        elif self.session is None:
            self.pages.show_lone(name)
        if pane and (screen := self.pages.screen_of(name)) is not None:
            screen.open(pane)

    def _say_problems(self) -> None:
        """What is wrong with the settings, once each."""
        checked = (self.preferences, self.themes, self.sounds)
        for problem in filter(None, (self.settings.news(), *(one.sentence for one in checked))):
            self.say(problem, "warn")
        for one in checked:
            one.sentence = ""

    def say(self, text: str, level: str) -> None:
        """Show one sentence, wherever the operator looks."""
        notify(self, text, level)

    def toggle_help(self) -> None:
        """Show what keys and buttons mean over the page, or hide it."""
        toggle_help(self)

    def rename(self, name: str) -> None:
        """Call this handheld `name`, for robots from the next connection on."""
        self.client_name = self.robot_list.client_name = name
        self._network.connector.client_name = self._network.pairing.client_name = name
        self.settings.set("client_name", name)
