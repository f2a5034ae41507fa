"""The panes beside the lists of the tasks screen: an order or a scheduled task, a place, a mission, the robot's settings."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, cast

from kivy.uix.widget import Widget

from app.link.commands import Outcome
from app.screens.mission.mission_pane import MissionPane
from app.screens.mission.place_pane import PlacePane
from app.screens.tasks.order_pane import OrderPane
from app.screens.tasks.place_chooser import PlaceChooser
from app.screens.tasks.settings_pane import SettingsPane
from app.session.dashboard import Dashboard
from app.session.session import Session

__all__ = ["TaskPanes"]


class TaskPanes:
    """One pane at a time is on the glass; those of a place and of the settings are made when they are first asked for."""

    def __init__(
        self,
        session: Session,
        dashboard: Dashboard,
        *,
        on_close: Callable[[], object],
        on_place: Callable[[PlacePane], object],
        on_settings: Callable[[SettingsPane], object],
    ) -> None:
        """`on_close` is called when a finger wants back to the lists, `on_place` and `on_settings` with their pane once it is made."""
        self._session, self._dashboard, self._on_close = session, dashboard, on_close
        self._on_place, self._on_settings = on_place, on_settings
        self._form = ""
        self.order, self.mission = OrderPane(session), MissionPane(session)
        self.made_place: PlacePane | None = None
        """The pane of a place; None until it was needed."""
        self.made_settings: SettingsPane | None = None
        """The same of the settings."""
        self._chooser: PlaceChooser | None = None
        for topic in ("/pose", "/places"):
            dashboard.bind(self.order.form, topic, fresh=False)
        for pane in (self.order, self.mission):
            pane.bind(on_close=lambda _: on_close())

    @property
    def place(self) -> PlacePane:
        """The pane of a place."""
        if self.made_place is None:
            pane = self.made_place = PlacePane(self._session)
            self._take_up(pane)
            self._feed(pane.form, "/places", pane.name_places)
            self._feed(pane.form, "/pose", pane.form.show)
            self._on_place(pane)
        return self.made_place

    @property
    def chooser(self) -> PlaceChooser:
        """The map beside the form of an order, made when it is first asked for."""
        if self._chooser is None:
            self._chooser = PlaceChooser(self.order.form, self._session, self._dashboard)
        return self._chooser

    def has_map(self, shown: str) -> bool:
        """The pane of that name is one beside which places are chosen on a map."""
        return shown in ("order", "schedule") and self.order.form.takes_places and self._form != "tall"

    @property
    def settings(self) -> SettingsPane:
        """The pane of the settings."""
        if self.made_settings is None:
            pane = self.made_settings = SettingsPane(self._session)
            self._take_up(pane)
            self._feed(pane.options, "/control/status", pane.options.show)
            pane.tick(self._session.may_ask)
            self._on_settings(pane)
        return self.made_settings

    def _take_up(self, pane: PlacePane | SettingsPane) -> None:
        pane.bind(on_close=lambda _: self._on_close())
        pane.head.closable = self._form == "tall"

    def _made(self) -> Iterator[PlacePane | SettingsPane]:
        """Those of the two that there are."""
        if self.made_place is not None:
            yield self.made_place
        if self.made_settings is not None:
            yield self.made_settings

    def _feed(self, widget: Widget, topic: str, show: Callable[[Any], None]) -> None:
        """Have `show` called with what comes from now on, and with what came last."""
        self._dashboard.bind(widget, topic, show, fresh=False)
        newest = self._session.feeds.latest(topic)
        if newest is not None:
            show(newest)

    def arrange(self, form: str) -> None:
        """Show each as it fits a window of that `form`."""
        self._form = form
        self.order.compact = form != "wide"
        self.order.closable = form == "tall"
        self.order.titled = form != "short"
        self.order.form.has_map = form == "tall"
        self.mission.head.closable = form == "tall"
        for pane in self._made():
            pane.head.closable = form == "tall"

    def of(self, name: str) -> Widget:
        """The pane of that name: `order`, `schedule`, `place`, `mission` or `settings`."""
        if name in ("place", "mission", "settings"):
            return cast("Widget", getattr(self, name))
        if (name == "schedule") != (self.order.scheduled is not None):
            self.order.schedule() if name == "schedule" else self.order.now()
        return self.order

    def on_outcome(self, outcome: Outcome) -> None:
        """The robot answered to a command."""
        for pane in self._made():
            pane.on_outcome(outcome)

    def rest(self) -> None:
        """Fingers let go of what they hold."""
        self.order.rest()
        if self._chooser is not None:
            self._chooser.rest()
        if self.made_place is not None:
            self.made_place.rest()
        self.mission.rest()

    def tick(self, *, mine: bool) -> None:
        """Bring up to date what time changes; `mine` while the robot can be asked for something from here."""
        self.order.refresh()
        self.order.meet(self._session.robot.info)
        self.mission.refresh()
        if self.made_settings is not None:
            self.made_settings.tick(mine)
