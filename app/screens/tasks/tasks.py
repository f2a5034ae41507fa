"""The tasks screen: what runs and what comes next, what starts by itself, what was done and what happened, the
places and the missions by name, and the robot's settings."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import ObjectProperty, StringProperty

from app.layout.arrange import Rect
from app.link.channels import OUTCOME
from app.link.feeds import Post
from app.screens.mission.place_pane import PlacePane
from app.screens.parts.placing import Area  # noqa: F401 - a rule names the area
from app.screens.parts.robot_screen import RobotScreen
from app.screens.shell.screen_host import ScreenHost
from app.screens.tasks.settings_pane import SettingsPane
from app.screens.tasks.task_actions import TaskActions
from app.screens.tasks.task_layout import TaskLayout
from app.screens.tasks.task_lists import TaskLists
from app.screens.tasks.task_panes import TaskPanes
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import (
    KeptMission,
    Place,
)
from widgets.core.language import tr
from widgets.tasks.place_form import PlaceForm

__all__ = ["TasksScreen"]

Builder.load_string("""
<TasksScreen>:
    Area:
        id: listed
    Area:
        id: detail
    GridLayout:
        id: strip
        size_hint: None, None
        spacing: dp(8)
""")


class TasksScreen(RobotScreen):
    """Everything about tasks but the map."""

    app: ObjectProperty[ScreenHost] = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()
    tab = StringProperty("now")
    """The list that is shown: one of `task_layout.DETAILS`."""
    detail = StringProperty("")
    """What is opened beside the list, or on a phone in its place: `order`, `schedule`, `place`, `mission`, `settings`
    or nothing."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        for name in ("listed", "detail", "strip"):  # kv holds ids weakly
            self.ids[name] = self.ids[name].__self__
        session = self.session
        self.dashboard = Dashboard(session.feeds)
        self.lists = lists = TaskLists(session, self.dashboard)
        self.tabs, self.now, self.events = lists.tabs, lists.now, lists.events
        self.places, self.runs, self.schedule = lists.places, lists.runs, lists.schedule
        self.missions = lists.missions
        self.panes = TaskPanes(
            session,
            self.dashboard,
            on_close=self.close,
            on_place=self._bind_place,
            on_settings=lambda pane: pane.bind(
                on_reset=lambda _: self._ask_reset(), on_setup=lambda _: self.app.show("setup")
            ),
        )
        self.pane, self.mission_pane = self.panes.order, self.panes.mission
        self._takes_places = False
        self.notice = Rect(0, 0, 1, 1)
        self.acts = TaskActions(self)
        self.layout = TaskLayout(self)
        self.ids.update({**self.acts.by_name, "tabs": self.tabs})
        self._bind()

    def _bind(self) -> None:
        self.places.bind(on_command=lambda _, place: self.edit_place(place))
        self.missions.bind(on_command=lambda _, mission: self._look_at(mission))
        self.schedule.bind(on_open=lambda _, task: self.open_scheduled(task))
        self.session.missions.on_recalled = self._recalled
        self.tabs.bind(
            tab=lambda _, tab: setattr(self, "tab", tab), on_settings=lambda _: self._turn_settings()
        )
        self.pane.bind(complete=lambda *_: self.acts.tick())
        self.pane.form.bind(task=self._task_changed, robot=self._task_changed, on_map=self._choose_on_map)
        self.bind(tab=self._tab_changed, detail=self._lay)

    def _bind_place(self, pane: PlacePane) -> None:
        pane.form.bind(on_command=lambda *_: self.acts.tick())
        pane.bind(on_back=lambda _, place: self.edit_place(place))

    @property
    def place_pane(self) -> PlacePane:
        """The pane of a place, made when it is first asked for."""
        return self.panes.place

    @property
    def settings_pane(self) -> SettingsPane:
        """The pane of the robot's settings, made when it is first asked for."""
        return self.panes.settings

    @property
    def form(self) -> PlaceForm:
        """The place that is made or changed."""
        return self.place_pane.form

    # what the shell calls

    def arrange(self, body: Rect, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self.now.brief = form == "short"
        places = self.layout.arrange(body, form, dp)
        self.notice = places["notice"]
        self._lay()
        return places["stop"]

    def clear(self, cover: Rect | None) -> None:
        """Make room for what is said over the screen."""
        self.layout.clear(cover)

    def on_post(self, channel: str, post: Post) -> None:
        """A message came."""
        self.dashboard.deliver(channel, post.value)
        if channel == OUTCOME:
            self.panes.on_outcome(post.value)

    def enter(self) -> None:
        """Come onto the glass."""
        self.dashboard.enter()
        self.places.refresh()
        if self.events.has_new_alarms and not self.detail:
            self.tab = "events"
        self._lay()
        self.lists.ask()
        self.tick()

    def leave(self) -> None:
        """Leave the glass."""
        self.rest()
        self.events.leave()
        self.dashboard.leave()

    def rest(self) -> None:
        """Fingers let go of what they hold."""
        self.now.queue.rest()
        self.panes.rest()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self.dashboard.tick()
        self.lists.tick(mine=self.mine)
        self.panes.tick(mine=self.mine)
        self.acts.tick()

    def back(self) -> bool:
        """Back within the screen; False when it is at its lists."""
        if self.detail in ("order", "schedule") and self.pane.back():
            return True
        if self.layout.form == "tall" and self.detail:
            self.close()
            return True
        return False

    @property
    def mine(self) -> bool:
        """The robot can be asked for something from here."""
        return self.session.may_ask

    # what is where

    def _lay(self, *_: object) -> None:
        self.layout.lay()
        if self.panes.made_place is not None:
            self.panes.made_place.open = self.detail == "place"
        self.missions.chosen = self.mission_pane.chosen.name if self.mission_pane.chosen else ""
        seen = self.events.parent is self.ids.listed and self.dashboard.active
        (self.events.enter if seen else self.events.leave)()

    def _task_changed(self, *_: object) -> None:
        """The map is beside the form where the task goes to places."""
        self.layout.refresh()
        takes = self.pane.form.takes_places
        if takes != self._takes_places:
            self._takes_places = takes
            self._lay()

    def _choose_on_map(self, *_: object) -> None:
        """An upright phone has the mission's map for it."""
        self.app.show("mission")
        self.app.screens["mission"].choose_place(self._chosen_on_map)

    def _chosen_on_map(self, place: Place) -> None:
        self.app.show("tasks")
        self.pane.form.choose(place)

    def _tab_changed(self, *_: object) -> None:
        self.detail = ""
        self.tabs.tab = self.tab
        if self.tab == "missions":
            self.mission_pane.begin()
        self._lay()
        self.lists.ask()

    def open(self, detail: str) -> None:
        """Open what is beside the lists, on a phone in their place."""
        self.detail = detail
        self._lay()

    def keep(self) -> object:
        """The tab, and the order that is being written."""
        return self.tab, self.detail, self.pane.order if self.detail == "order" else None

    def take_up(self, kept: Any) -> None:
        """Go on with them."""
        self.tab, detail, order = kept
        if order is not None and order.task:
            self.begin(order.task, tuple(order.places))
            numbers = {"speed": order.speed, "at_height": order.height, "duration": order.duration}
            self.pane.form.set(heading=order.heading, throttle=order.throttle, **numbers)
            self.pane.form.set(message=order.message, recipient_tag=order.recipient_tag)
        elif detail in ("settings", "order"):
            self.open(detail)

    def close(self) -> None:
        """Back to the lists."""
        self.rest()
        self.detail = ""

    # orders

    def begin(self, task: str, places: tuple[str, ...] = ()) -> None:
        """Open the form of a task, with places known already."""
        self.tab = "now"
        self.open("order")
        self.pane.begin(task, places)

    # the schedule

    def open_scheduled(self, task: Any) -> None:
        """Change a scheduled task; None for a new one."""
        self.pane.schedule(task)
        self.open("schedule")

    # places

    def edit_place(self, place: Place) -> None:
        """Make a place (id 0) or change one."""
        if self.tab != "places":
            self.tab = "places"
        self.place_pane.edit(place)
        self.open("place")

    # missions

    def _look_at(self, mission: KeptMission) -> None:
        self.mission_pane.chosen = mission
        self.open("mission")

    def _recalled(self, words: str, undo: Any) -> None:
        shell = self.app.shell
        if shell is not None:
            shell.notices.offer(words, tr("Undo"), undo)

    def _ask_reset(self) -> None:
        shell = self.app.shell
        if shell is not None:
            shell.reset.ask()

    # the robot's settings

    def _turn_settings(self) -> None:
        self.open("" if self.detail == "settings" else "settings")
