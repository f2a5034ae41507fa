"""Buttons of the tasks screen: which are shown, when each can be pressed, and what it does."""

from __future__ import annotations

import math
from typing import Any, Protocol

from app.layout.arrange import Rect
from app.screens.mission.mission_pane import MissionPane
from app.screens.mission.place_pane import PlacePane
from app.screens.parts.list_buttons import ListButtons
from app.screens.shell.screen_host import ScreenHost
from app.screens.tasks.event_list import EventList
from app.screens.tasks.order_pane import OrderPane
from app.screens.tasks.task_panes import TaskPanes
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Place, ScheduledTask
from widgets import PlaceForm, PlaceList
from widgets.core.language import tr
from widgets.core.task_words import title

__all__ = ["TaskActions"]

PRIMARY = ("start", "save", "keep", "new", "new_scheduled", "recall", "keep_mission", "seen_all")


class TasksView(Protocol):
    """The tasks screen, as far as its buttons need it."""

    ids: Any
    session: Session
    tab: str
    detail: str
    events: EventList
    places: PlaceList
    pane: OrderPane
    panes: TaskPanes
    mission_pane: MissionPane

    @property
    def place_pane(self) -> PlacePane:
        """The pane of a place, made when it is first asked for."""

    @property
    def form(self) -> PlaceForm:
        """The place that is made or changed."""

    @property
    def app(self) -> ScreenHost:
        """The app behind the screen."""

    @property
    def mine(self) -> bool:
        """The robot can be asked for something from here."""

    def open(self, detail: str) -> None:
        """Open what is beside the lists."""

    def open_scheduled(self, task: ScheduledTask | None) -> None:
        """Change a scheduled task; None for a new one."""

    def close(self) -> None:
        """Back to the lists."""

    def begin(self, task: str, places: tuple[str, ...] = ()) -> None:
        """Open the form of a task, with places known already."""

    def edit_place(self, place: Place) -> None:
        """Make a place (id 0) or change one."""


class TaskActions(ListButtons):
    """The buttons of one tasks screen."""

    def __init__(self, screen: TasksView) -> None:
        """`screen` has its lists and panes already."""
        self._screen, self._session = screen, screen.session
        super().__init__(
            [
                ("start", tr("Start"), "play_arrow_fill", self._start),
                ("queue", tr("Add to queue"), "add", self._queue),
                ("save", tr("Save"), "check", self._save_scheduled),
                ("unschedule", tr("Delete"), "delete", self._unschedule),
                ("keep", tr("Save"), "check", self._keep_place),
                ("forget", tr("Delete"), "delete", self._forget_place),
                ("go", tr("Go"), "near_me", self._go_there),
                ("move", tr("Move"), "edit_location_alt", self._move_place),
                ("new", tr("New task"), "add", lambda: screen.open("order")),
                ("new_scheduled", tr("New"), "add", lambda: screen.open_scheduled(None)),
                ("again", tr("Newest"), "refresh", screen.session.tasking.ask_history),
                ("on_map", tr("New on map"), "add_location_alt", self._point_at_place),
                ("here", tr("New here"), "my_location", self._place_here),
                ("save_as", tr("Save under a name"), "save", self._save_as),
                ("keep_mission", tr("Save"), "check", self._keep_mission),
                ("recall", tr("Recall"), "upload", self._recall),
                ("seen_all", tr("All seen"), "check", screen.events.see_all),
            ],
            PRIMARY,
        )

    # which are where

    def lay_for(self, tab: str, shown: str, *, form: str, stop: Rect) -> None:
        """Put out those of the list `tab` and of what is `shown` beside it, in a window of that `form` with STOP there [px]."""
        screen, tall = self._screen, form == "tall"
        for_list = {
            "now": ["new"] if tall else [],
            "schedule": ["new_scheduled"],
            "history": ["again"],
            "events": ["seen_all"],
            "places": ["on_map", "here"],
            "missions": ["save_as"],
        }[tab]
        for_detail = {
            "order": ["start", "queue"],
            "schedule": ["save", *(["unschedule"] if self._scheduled_id() else [])],
            "place": self._for_place() if shown == "place" else [],
            "mission": ["recall" if screen.mission_pane.chosen is not None else "keep_mission"],
        }.get(shown, [])
        if self._session.robot.lacks_tasks:
            for_list = for_detail = []
        names = for_list if tall and not shown else for_detail
        self.lay(screen.ids.strip, names, [] if tall else for_list, form=form, stop=stop)
        self.tick()

    def _for_place(self) -> list[str]:
        """Those of the place that is looked at, which is none before one was chosen."""
        screen = self._screen
        if not screen.place_pane.there:
            return []
        return ["keep", *(["forget", "go", "move"] if screen.form.shown.id else [])]

    def _scheduled_id(self) -> int:
        scheduled = self._screen.pane.scheduled
        return int(scheduled.id) if scheduled is not None else 0

    def tick(self) -> None:
        """What cannot be asked for just now cannot be pressed."""
        screen, session, buttons, mine = self._screen, self._session, self.by_name, self._screen.mine
        complete = screen.pane.complete and mine
        buttons["start"].disabled = not complete or session.robot_stop.latched or session.running
        buttons["queue"].disabled = not complete
        buttons["save"].disabled = not complete
        place = screen.panes.made_place
        buttons["keep"].disabled = not mine or (place is not None and bool(place.form.lacking))
        for name in ("forget", "unschedule", "here"):
            buttons[name].disabled = not mine
        buttons["recall"].disabled = not mine or not session.robot.offers("/mission/recall")
        buttons["keep_mission"].disabled = not mine or bool(screen.mission_pane.lacking)
        waiting = len(screen.events.waiting)
        buttons["seen_all"].disabled = not waiting or not screen.events.log.acts
        buttons["seen_all"].text = (
            tr("All seen ({waiting})").format(waiting=waiting) if waiting else tr("All seen")
        )
        buttons["go"].disabled = not session.robot.knows("go_to")
        located = math.isfinite(screen.places.robot[0])
        buttons["here"].disabled = not mine or not located

    # orders and the schedule

    def _start(self) -> None:
        screen = self._screen
        self._session.tasking.start(screen.pane.order, send_first=screen.pane.unsent)
        screen.detail = ""
        screen.tab = "now"

    def _queue(self) -> None:
        screen = self._screen
        if screen.pane.unsent:
            self._session.send_mission()
        self._session.tasking.queue.add(screen.pane.order)
        screen.pane.begin("")
        screen.detail = ""
        screen.tab = "now"

    def _save_scheduled(self) -> None:
        screen = self._screen
        if screen.pane.unsent:
            self._session.send_mission()
        self._session.tasking.keep_scheduled(screen.pane.made())
        screen.pane.schedule()
        screen.close()

    def _unschedule(self) -> None:
        screen = self._screen
        task = screen.pane.scheduled
        self._session.tasking.forget_scheduled(task, title(task.order))
        screen.pane.schedule()
        screen.close()

    # places

    def _point_at_place(self) -> None:
        self._screen.app.show("mission")
        self._screen.app.screens["mission"].mode = "place"

    def _place_here(self) -> None:
        x, y = self._screen.places.robot
        self._screen.edit_place(Place(x=x, y=y, yaw=self._screen.form.dial.robot))

    def _keep_place(self) -> None:
        self._screen.place_pane.keep()
        self._screen.close()

    def _forget_place(self) -> None:
        self._screen.place_pane.forget()
        self._screen.close()

    def _go_there(self) -> None:
        name = self._screen.form.shown.name
        self._screen.begin("go_to", (name,))

    def _move_place(self) -> None:
        screen = self._screen
        place = screen.form.place
        screen.detail = ""
        screen.app.show("mission")
        screen.app.screens["mission"].move_place(place)

    # missions

    def _save_as(self) -> None:
        self._screen.mission_pane.begin()
        self._screen.open("mission")

    def _keep_mission(self) -> None:
        self._screen.mission_pane.save()
        self._screen.close()

    def _recall(self) -> None:
        self._screen.mission_pane.recall()
        self._screen.mission_pane.begin()
        self._screen.close()
