"""The panes beside the lists of the tasks screen: an order or a scheduled task, a place, a mission, the robot's settings."""

from __future__ import annotations

from collections.abc import Callable

from kivy.uix.widget import Widget

from app.link.commands import Outcome
from app.screens.mission.mission_pane import MissionPane
from app.screens.tasks.order_pane import OrderPane
from app.screens.tasks.place_pane import PlacePane
from app.screens.tasks.settings_pane import SettingsPane
from app.session.dashboard import Dashboard
from app.session.session import Session

__all__ = ["TaskPanes"]


class TaskPanes:
    """One pane at a time is on the glass."""

    def __init__(self, session: Session, dashboard: Dashboard, on_close: Callable[[], object]) -> None:
        """`on_close` is called when a finger wants back to the lists."""
        self._session = session
        self.order, self.place = OrderPane(session), PlacePane(session)
        self.mission, self.settings = MissionPane(session), SettingsPane(session)
        bind = dashboard.bind
        bind(self.place.form, "/places", self.place.name_places, fresh=False)
        bind(self.settings.options, "/control/status", fresh=False)
        for form in (self.place.form, self.order.form):
            bind(form, "/pose", fresh=False)
        bind(self.order.form, "/places", fresh=False)
        for pane in (self.order, self.place, self.mission, self.settings):
            pane.bind(on_close=lambda _: on_close())

    def arrange(self, form: str) -> None:
        """Show each as it fits a window of that `form`."""
        self.order.compact = form != "wide"
        self.order.closable = form == "tall"
        self.order.titled = form != "short"
        for head in (self.place.head, self.mission.head, self.settings.head):
            head.closable = form == "tall"

    def of(self, name: str) -> Widget:
        """The pane of that name: `order`, `schedule`, `place`, `mission` or `settings`."""
        panes: dict[str, Widget] = {"place": self.place, "mission": self.mission, "settings": self.settings}
        if name in panes:
            return panes[name]
        if (name == "schedule") != (self.order.scheduled is not None):
            self.order.schedule() if name == "schedule" else self.order.now()
        return self.order

    def on_outcome(self, outcome: Outcome) -> None:
        """The robot answered to a command."""
        self.settings.on_outcome(outcome)
        self.place.on_outcome(outcome)

    def rest(self) -> None:
        """Fingers let go of what they hold."""
        self.order.rest()
        self.place.form.rest()
        self.mission.rest()

    def tick(self, *, mine: bool) -> None:
        """Bring up to date what time changes; `mine` while the robot can be asked for something from here."""
        self.order.refresh()
        self.order.meet(self._session.robot.info)
        self.mission.refresh()
        self.settings.tick(mine)
