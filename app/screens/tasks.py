"""The tasks screen: what runs and what comes next, what starts by itself, what was done, and the places by name."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import ObjectProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.gridlayout import GridLayout
from kivy.uix.widget import Widget

from app import arrange
from app.arrange import Rect
from app.camera import Picture
from app.dashboard import Dashboard
from app.feeds import Post
from app.screens.now_list import NowList
from app.screens.order_pane import OrderPane
from app.screens.placing import put
from app.session import Session
from bridge.msgs.pilothouse_msgs import GetHistoryResponse, Place, PlaceArray, TaskStatus
from widgets import PlaceForm, PlaceList, RunList, ScheduleList
from widgets.kit import IconButton, PrimaryButton, QuietButton, Text
from widgets.task_words import title

__all__ = ["TasksScreen"]

TABS = [("now", "Now"), ("schedule", "Schedule"), ("history", "History"), ("places", "Places")]
DETAILS = {"now": "order", "schedule": "schedule", "history": "order", "places": "place"}
"""What is beside each list where there is room for both."""
NO_TASKS = "This robot offers no tasks and knows no places."

Builder.load_string("""
<TasksScreen>:
    BoxLayout:
        id: listed
        orientation: 'vertical'
        size_hint: None, None
        spacing: dp(8)
    BoxLayout:
        id: detail
        orientation: 'vertical'
        size_hint: None, None
        spacing: dp(8)
    GridLayout:
        id: strip
        size_hint: None, None
        spacing: dp(8)
    Segmented:
        id: tabs
        options: root.tab_options
        value: root.tab
        font_size: sp(15)
        on_choose: root.tab = args[1]

<PlacePane>:
    orientation: 'vertical'
    spacing: dp(8)
    BoxLayout:
        id: head
        size_hint_y: None
        height: dp(44)
        spacing: dp(6)
        Text:
            text: root.title
            bold: True
            font_size: theme.size_title
            pos_hint: {'center_y': .5}
    Text:
        text: root.sentence
        role: 'muted'
        font_size: sp(15)
        height: self.texture_size[1] if root.sentence else 0
    BoxLayout:
        id: body
""")


class PlacePane(BoxLayout):
    """The place that is being made or changed, or how to come to one."""

    title = StringProperty("Places")
    sentence = StringProperty("")


class TasksScreen(FloatLayout):
    """Everything about tasks but the map."""

    app = ObjectProperty()
    session: Session = ObjectProperty()
    tab_options = TABS
    tab = StringProperty("now")
    """The list that is shown: one of `TABS`."""
    detail = StringProperty("")
    """What is opened beside the list, or on a phone in its place: `order`, `schedule`, `place` or nothing."""
    video = None
    """There is none here."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        for name in ("listed", "detail", "strip", "tabs"):  # kv holds ids weakly
            self.ids[name] = self.ids[name].__self__
        self.dashboard = Dashboard(self.session.feeds)
        self.now = NowList(self.session)
        self.places, self.runs, self.schedule = PlaceList(), RunList(), ScheduleList()
        self.pane, self.place_pane = OrderPane(self.session), PlacePane()
        self.form = PlaceForm()
        self._body, self._form, self._dp = Rect(0, 0, 1, 1), "", 1.0
        self._lacking = Text(text=NO_TASKS, role="muted")
        self._state, self._returns = "", False
        self._buttons: dict[str, Any] = {}
        self.notice = Rect(0, 0, 1, 1)
        self._build()
        self._bind()

    def _build(self) -> None:
        self.place_pane.ids.body.add_widget(self.form)
        self._back = IconButton(icon="arrow_back", bare=True, pos_hint={"center_y": 0.5})
        self._back.bind(on_release=lambda _: self.close())
        self.remove_widget(self.ids.tabs)
        self.under = GridLayout(cols=2, spacing=("8dp", "8dp"), size_hint_y=None)
        """The buttons below the list."""
        self.under.bind(minimum_height=self.under.setter("height"))
        for name, text, icon, act in self._acts():
            primary = name in ("start", "save", "keep", "new", "new_scheduled")
            button = PrimaryButton(text=text, icon=icon) if primary else QuietButton(text=text, icon=icon)
            button.bind(on_release=lambda _, act=act: act())
            self._buttons[name] = self.ids[name] = button

    def _acts(self) -> list[tuple[str, str, str, Callable[[], object]]]:
        return [
            ("start", "Start", "play_arrow_fill", self._start),
            ("queue", "Add to queue", "add", self._queue),
            ("save", "Save", "check", self._save_scheduled),
            ("unschedule", "Delete", "delete", self._unschedule),
            ("keep", "Save", "check", self._keep_place),
            ("forget", "Delete", "delete", self._forget_place),
            ("go", "Go", "near_me", self._go_there),
            ("move", "Move", "edit_location_alt", self._move_place),
            ("new", "New task", "add", lambda: self.open("order")),
            ("new_scheduled", "New", "add", lambda: self.open_scheduled(None)),
            ("again", "Newest", "refresh", self.session.tasking.ask_history),
            ("on_map", "New on map", "add_location_alt", self._point_at_place),
            ("here", "New here", "my_location", self._place_here),
        ]

    def _bind(self) -> None:
        bind, tasking = self.dashboard.bind, self.session.tasking
        bind(self.now.card, "/task/status")
        bind(self.now.card, "/task/progress", fresh=False)
        bind(self.schedule, "/schedule", fresh=False)
        bind(self.places, "/places")
        bind(self.form, "/places", self._name_places, fresh=False)
        for widget in (self.places, self.form, self.pane.form):
            bind(widget, "/pose", fresh=False)
        bind(self.pane.form, "/places", fresh=False)
        bind(self.runs, "/task/status", self._task_changed, fresh=False)
        self.places.bind(on_command=lambda _, place: self.edit_place(place))
        self.form.bind(on_command=lambda *_: self._show_place())
        self.schedule.bind(
            on_command=lambda _, task: tasking.keep_scheduled(task),
            on_open=lambda _, task: self.open_scheduled(task),
        )
        self.runs.bind(on_command=lambda _, before: tasking.ask_history(before))
        tasking.on_history = self._take_history
        self.pane.bind(on_close=lambda _: self.close(), complete=lambda *_: self._show_buttons())
        self.bind(tab=self._tab_changed, detail=self._lay)

    # what the shell calls

    def arrange(self, body: Rect, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self._body, self._form, self._dp = body, form, dp
        places = arrange.tasks(body, form, dp)
        for name in ("detail", "strip"):
            put(self.ids[name], places[name])
        put(self.ids.listed, places["list"])
        self.notice = places["notice"]
        self.pane.compact = form != "wide"
        self.pane.closable = form == "tall"
        self.pane.titled = form != "short"
        self.now.brief = form == "short"
        self._lay()
        return places["stop"]

    def hear(self, channel: str, post: Post) -> None:
        """A message came."""
        self.dashboard.deliver(channel, post.value)

    def enter(self) -> None:
        """Come onto the glass."""
        self.dashboard.enter()
        self.places.refresh()
        self._lay()
        self._ask_history()
        self.tick()

    def leave(self) -> None:
        """Leave the glass."""
        self.rest()
        self._returns = False
        self.dashboard.leave()

    def rest(self) -> None:
        """Fingers let go of what they hold."""
        self.now.queue.rest()
        self.pane.rest()
        self.form.rest()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self.dashboard.tick()
        self.now.tick(self.mine)
        self.pane.refresh()
        self.pane.form.max_speed = self.session.info.max_speed or 1.0
        clock = self.session.link.robot_time()
        if math.isfinite(clock) and not abs(clock - self.schedule.now) < 5.0:
            self.schedule.now = self.runs.now = clock
        self.schedule.state = self.session.feeds.state("/schedule") if self.mine else "disabled"
        self._show_buttons()

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """A camera frame came; there is no picture here."""

    def back(self) -> bool:
        """Back within the screen; False when it is at its lists."""
        if self.detail in ("order", "schedule") and self.pane.back():
            return True
        if self._form == "tall" and self.detail:
            self.close()
            return True
        return False

    @property
    def mine(self) -> bool:
        """The robot can be asked for something from here."""
        return self.session.connected and self.session.control != "other"

    # what is where

    def _shown_detail(self) -> str:
        """What is beside the list, or on a phone over it; empty for the list alone."""
        if self._form == "tall":
            return self.detail
        return self.detail or DETAILS[self.tab]

    def _lay(self, *_: object) -> None:
        listed, area, shown = self.ids.listed, self.ids.detail, self._shown_detail()
        lists = {"now": self.now, "schedule": self.schedule, "history": self.runs, "places": self.places}
        if self.session.lacks_tasks:
            lists, shown = dict.fromkeys(lists, self._lacking), ""
        tall = self._form == "tall"
        listed.clear_widgets()
        area.clear_widgets()
        if not (tall and shown):
            for widget in (
                self.ids.tabs,
                lists[self.tab],
                *([] if tall or self.tab == "now" else [self.under]),
            ):
                listed.add_widget(widget)
        if shown == "place":
            area.add_widget(self.place_pane)
        elif shown:
            if (shown == "schedule") != (self.pane.scheduled is not None):
                self.pane.schedule() if shown == "schedule" else self.pane.now()
            area.add_widget(self.pane)
        head = self.place_pane.ids.head.__self__  # kv holds ids weakly
        if tall != (self._back.parent is head):
            (
                head.add_widget(self._back, index=len(head.children))
                if tall
                else head.remove_widget(self._back)
            )
        listed.opacity, area.opacity = float(not (tall and shown)), float(bool(shown))
        self._show_place()
        self._lay_buttons(shown, tall)

    def _lay_buttons(self, shown: str, tall: bool) -> None:
        strip, under = self.ids.strip, self.under
        strip.clear_widgets()
        under.clear_widgets()
        for_list = {
            "now": ["new"] if tall else [],
            "schedule": ["new_scheduled"],
            "history": ["again"],
            "places": ["on_map", "here"],
        }[self.tab]
        for_detail = {
            "order": ["start", "queue"],
            "schedule": ["save", *(["unschedule"] if self._scheduled_id() else [])],
            "place": ["keep", *(["forget", "go", "move"] if self.form.shown.id else [])],
        }.get(shown, [])
        if self.session.lacks_tasks:
            for_list = for_detail = []
        if shown == "place" and not self._has_place():
            for_detail = []
        names = for_list if tall and not shown else for_detail
        strip.cols = (2 if len(names) > 2 else 1) if tall else max(1, len(names))
        brief = len(names) > 2 or self._form == "short"
        for name in names:
            self._add(strip, name, None)
            self._buttons[name].flow = "vertical" if brief and not tall else "horizontal"
        if not tall:
            under.cols = max(1, len(for_list))
            for name in for_list:
                self._add(under, name, 1)
        self._show_buttons()

    def _add(self, parent: Widget, name: str, fixed: int | None) -> None:
        button = self._buttons[name]
        if button.parent is not None:
            button.parent.remove_widget(button)
        button.size_hint_y = None if fixed else 1
        if fixed:
            button.height, button.flow = "52dp", "horizontal"
        parent.add_widget(button)

    def _scheduled_id(self) -> int:
        return self.pane.scheduled.id if self.pane.scheduled is not None else 0

    def _show_buttons(self) -> None:
        """What cannot be asked for just now cannot be pressed."""
        session, buttons, mine = self.session, self._buttons, self.mine
        complete = self.pane.complete and mine
        busy = session.running
        buttons["start"].disabled = not complete or session.stop_latched or busy
        buttons["queue"].disabled = not complete
        buttons["save"].disabled = not complete
        buttons["keep"].disabled = not mine or bool(self.form.lacking)
        for name in ("forget", "unschedule", "here"):
            buttons[name].disabled = not mine
        located = math.isfinite(self.places.robot[0])
        buttons["here"].disabled = not mine or not located

    def _tab_changed(self, *_: object) -> None:
        self.detail, self._returns = "", False
        self._lay()
        self._ask_history()

    def _ask_history(self) -> None:
        if self.tab == "history" and self.session.connected and self.session.offers("/history/get"):
            self.session.tasking.ask_history()

    def open(self, detail: str) -> None:
        """Open what is beside the lists, on a phone in their place."""
        self.detail = detail
        self._lay()

    def close(self) -> None:
        """Back to the lists, or to the map where a place was pointed at."""
        self.rest()
        self.detail = ""
        if self._returns:
            self._returns = False
            self.app.show("mission")

    # orders

    def begin(self, task: str, places: tuple[str, ...] = ()) -> None:
        """Open the form of a task, with places known already."""
        self.tab = "now"
        self.open("order")
        self.pane.begin(task, places)

    def _start(self) -> None:
        self.session.tasking.start(self.pane.order, send_first=self.pane.unsent)
        self.detail = ""
        self.tab = "now"

    def _queue(self) -> None:
        if self.pane.unsent:
            self.session.send_mission()
        self.session.tasking.queue.add(self.pane.order)
        self.pane.begin("")
        self.detail = ""
        self.tab = "now"

    # the schedule

    def open_scheduled(self, task: Any) -> None:
        """Change a scheduled task; None for a new one."""
        self.pane.schedule(task)
        self.open("schedule")

    def _save_scheduled(self) -> None:
        if self.pane.unsent:
            self.session.send_mission()
        self.session.tasking.keep_scheduled(self.pane.made())
        self.pane.schedule()
        self.close()

    def _unschedule(self) -> None:
        task = self.pane.scheduled
        self.session.tasking.forget_scheduled(task, title(task.order))
        self.pane.schedule()
        self.close()

    # places

    def edit_place(self, place: Place, *, returns: bool = False) -> None:
        """Make a place (id 0) or change one; `returns` to the map afterwards."""
        if self.tab != "places":
            self.tab = "places"
        self.form.show(place)
        self._name_places(self.session.feeds.latest("/places") or PlaceArray())
        self._returns = returns
        self.open("place")

    def _name_places(self, msg: PlaceArray) -> None:
        self.form.taken = [place.name for place in msg.places if place.id != self.form.shown.id]

    def _has_place(self) -> bool:
        return bool(self.form.shown.id) or self.detail == "place"

    def _show_place(self) -> None:
        pane, there = self.place_pane, self._has_place()
        pane.title = "Places" if not there else "Place" if self.form.shown.id else "New place"
        pane.sentence = self.form.lacking if there else "Choose a place to change it, or make a new one."
        self.form.opacity, self.form.disabled = float(there), not there
        self._show_buttons()

    def _point_at_place(self) -> None:
        self.app.show("mission")
        self.app.screens["mission"].mode = "place"

    def _place_here(self) -> None:
        x, y = self.places.robot
        yaw = self.form.dial.robot
        self.edit_place(Place(x=x, y=y, yaw=yaw))

    def _keep_place(self) -> None:
        self.session.tasking.keep_place(self.form.place)
        self.form.show(Place())
        self.close()

    def _forget_place(self) -> None:
        self.session.tasking.forget_place(self.form.shown)
        self.form.show(Place())
        self.close()

    def _go_there(self) -> None:
        name = self.form.shown.name
        self._returns = False
        self.begin("go_to", (name,))

    def _move_place(self) -> None:
        self._returns = False
        place = self.form.place
        self.detail = ""
        self.app.show("mission")
        self.app.screens["mission"].move_place(place)

    # history

    def _take_history(self, answer: GetHistoryResponse) -> None:
        self.runs.show(answer)
        self.runs.more = bool(self.runs.runs) and self.runs.runs[-1].id > 1

    def _task_changed(self, _: TaskStatus) -> None:
        self._ask_history()
