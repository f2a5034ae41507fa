"""The lists of the tasks screen: the task under way, schedule, history, events, places and missions by name."""

from __future__ import annotations

import math

from kivy.uix.widget import Widget

from app.screens.tasks.current_task import CurrentTask
from app.screens.tasks.event_list import EventList
from app.screens.tasks.task_tabs import TaskTabs
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import GetHistoryResponse, Mission
from widgets import MissionList, PlaceList, RunList, ScheduleList
from widgets.core.language import mark, tr
from widgets.parts.kit import Text

__all__ = ["TaskLists"]

NO_TASKS = mark("This robot offers no tasks and knows no places.")
CLOCK_STEP = 5.0
"""Ages in the lists are brought up to date so often [s]."""


class TaskLists:
    """One list for each tab, and the tabs."""

    def __init__(self, session: Session, dashboard: Dashboard) -> None:
        self._session, self._dashboard = session, dashboard
        self.tabs = TaskTabs()
        self.now, self.events = CurrentTask(session), EventList(session)
        self.places, self.runs, self.schedule = PlaceList(), RunList(), ScheduleList()
        self.missions = MissionList()
        self._by_tab: dict[str, Widget] = {
            "now": self.now,
            "schedule": self.schedule,
            "history": self.runs,
            "events": self.events,
            "places": self.places,
            "missions": self.missions,
        }
        self._lacking = Text(text=tr(NO_TASKS), role="muted")
        self._bind()

    def _bind(self) -> None:
        bind, tasking = self._dashboard.bind, self._session.tasking
        bind(self.now.card, "/task/status")
        bind(self.now.card, "/task/progress", fresh=False)
        bind(self.schedule, "/schedule", fresh=False)
        bind(self.places, "/places")
        bind(self.places, "/pose", fresh=False)
        bind(self.missions, "/mission", self._on_mission, fresh=False)
        bind(self.runs, "/task/status", lambda _: self._ask_of("history"))
        self.schedule.bind(on_command=lambda _, task: tasking.keep_scheduled(task))
        self.runs.bind(on_command=lambda _, before: tasking.ask_history(before))
        tasking.on_history = self._on_history
        self._session.missions.on_change = self._on_missions
        self._on_missions()

    def of(self, tab: str) -> Widget:
        """The list of a tab, or a sentence on a robot without tasks."""
        return self._lacking if self._session.robot.lacks_tasks else self._by_tab[tab]

    def ask(self) -> None:
        """Ask for what the robot does not publish by itself, where its list is chosen."""
        session, tab = self._session, self.tabs.tab
        if tab == "history" and session.connected and session.robot.offers("/history/get"):
            session.tasking.ask_history()
        if tab == "missions" and session.connected and session.robot.offers("/missions/get"):
            session.missions.ask()

    def _ask_of(self, tab: str) -> None:
        if self.tabs.tab == tab:
            self.ask()

    def tick(self, *, mine: bool) -> None:
        """Bring up to date what time changes; `mine` while the robot can be asked for something from here."""
        session = self._session
        self.now.tick(mine)
        clock = session.link.robot_time()
        if math.isfinite(clock) and not abs(clock - self.schedule.now) < CLOCK_STEP:
            self.schedule.now = self.runs.now = self.missions.now = clock
        self.tabs.waiting, self.tabs.has_settings = len(session.logbook.asking), not session.robot.lacks_tasks
        self.events.tick()
        self.schedule.state = session.feeds.state("/schedule") if mine else "disabled"

    def _on_history(self, answer: GetHistoryResponse) -> None:
        self.runs.show(answer)
        self.runs.more = bool(self.runs.runs) and self.runs.runs[-1].id > 1

    def _on_missions(self) -> None:
        self.missions.missions = list(self._session.missions.kept)

    def _on_mission(self, mission: Mission) -> None:
        self.missions.current = mission.name
        if self._dashboard.active:
            self._ask_of("missions")
