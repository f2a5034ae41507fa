"""Form of an order: places by name, a message, a direction, speed and duration, as the task needs them.

form = OrderForm()
robot.on("/places", form.show), robot.on("/mission", form.show)
form.begin("deliver")
form.bind(on_command=lambda _, order: print(order))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Mission, Place, PlaceArray, RobotInfo, TaskOrder, Waypoint
from widgets.controls.heading_dial import HeadingDial
from widgets.core.language import mark, tr, trn
from widgets.core.task_words import KINDS, fields
from widgets.parts.buttons import IconButton, QuietButton
from widgets.parts.choices import Segmented
from widgets.parts.labels import SectionLabel
from widgets.parts.rows import ListRow
from widgets.parts.text_field import TextField
from widgets.tasks.order_draft import OrderDraft
from widgets.tasks.order_numbers import NUMBERS, FormRow
from widgets.tasks.place_list import SOME, PlaceList

__all__ = ["OrderForm"]

ASKS = {
    "from": (mark("From"), mark("Where is it fetched?")),
    "to": (mark("To"), mark("Where does it go?")),
    "then": (mark("Then on to"), mark("Where does it go afterwards?")),
    "dock": (mark("Dock"), mark("Which dock?")),
    "stops": (mark("Places"), mark("Which place next?")),
}
"""Field for places to its name and the question over the list of places."""
SLOTS = {"from": 0, "to": 1, "then": 2, "dock": 0}
"""Field to its place in `TaskOrder.places`; `to` is the first where there is no `from`."""
OPTIONAL = {"then": mark("Stay there"), "dock": mark("Its own dock")}
"""Field that may be left open to what that means."""
MAX_TEXT_LENGTH = 200
"""Characters of a message."""
Builder.load_string("""
<OrderForm>:
    orientation: 'vertical'
    spacing: theme.gap * .6
    Roll:
        id: roll
        Column:
            id: column
            spacing: dp(8)

""")


class OrderForm(OrderDraft, BoxLayout):
    """Dispatches `on_command(order)` at every change, and `on_react(reaction)` when the one to intruders is changed.

    Only what the task takes is asked for; a place is always one of those that have a name.
    """

    accepts = (TaskOrder, PlaceArray, Mission, PoseWithCovarianceStamped)
    __events__ = ("on_react", "on_map")

    picking = StringProperty("")
    """The field that a place is being chosen for; empty for none."""
    has_map = BooleanProperty(False)
    """A map can be opened to choose places on: there is a button for it, which dispatches `on_map`."""

    def __init__(self, **kwargs: Any) -> None:
        self.list = PlaceList()
        """Where places are chosen; over the fields while `picking`."""
        self.dial = HeadingDial(pos_hint={"center_x": 0.5})
        hints = {"message": tr("Message for the person"), "recipient_tag": tr("Tag of the recipient")}
        self._texts = {name: TextField(hint_text=hint, label=hint) for name, hint in hints.items()}
        super().__init__(**kwargs)
        for field in self._texts.values():
            field.bind(text=self._typed)
        self._roll = self.ids.roll.__self__
        self.list.bind(on_command=lambda _, place: self.pick(place))
        self.dial.bind(on_command=lambda _, yaw: self.set(heading=yaw))
        self.bind(robot=self._build, has_map=self._build)
        self._build()

    # what comes in

    def show(self, msg: Msg) -> None:
        """Take over places, mission or pose, or an order to be changed; nothing is dispatched."""
        if isinstance(msg, TaskOrder):
            self._load(msg)
        elif isinstance(msg, Mission):
            self.mission = msg
            if self.task == "patrol" and not self.picking:
                self._build()
        elif isinstance(msg, PoseWithCovarianceStamped):
            self.list.show(msg)
            self.dial.show(msg)
        elif isinstance(msg, PlaceArray):
            self.list.show(msg)
        else:
            super().show(msg)

    def begin(self, task: str, places: tuple[str, ...] = ()) -> None:
        """Ask for what `task` needs, with nothing filled in but `places`."""
        self._load(TaskOrder(task=task, places=list(places)))

    def _load(self, order: TaskOrder) -> None:
        self.fill(order)
        self.dial.value = order.heading
        self.picking = ""
        self._build()

    # what the fingers do

    def ask(self, field: str) -> None:
        """Let a place be chosen for a field."""
        self.picking = field
        self.list.search = ""
        self.list.chosen = [name for name in self.places if name]
        self.list.refresh()
        self._build()

    def pick(self, place: Place) -> None:
        """Take a place for the field that is being asked for."""
        field, self.picking = self.picking, ""
        self._put(field, place.name)

    @property
    def takes_places(self) -> bool:
        """The task goes to places that have names."""
        return any(field in ASKS for field in self._fields()) or "points" in self._fields()

    def choose(self, place: Place) -> None:
        """Take a place that was tapped on a map: for the field that is asked for, else the first open one, else the last."""
        if self.picking:
            self.pick(place)
            return
        slots = [field for field in self._fields() if field in SLOTS]
        asked = [field for field in slots if field not in OPTIONAL] or slots
        if asked:
            names = [self.places[at] if at < len(self.places) else "" for at in range(len(asked))]
            self._put(
                next((field for field, name in zip(asked, names, strict=True) if not name), asked[-1]),
                place.name,
            )
        elif self.takes_places:
            self._put("stops", place.name)

    def _put(self, field: str, name: str) -> None:
        places = list(self.places)
        if field == "stops":
            places = [*places, name]
        else:
            slot = 0 if field == "to" and "from" not in self._fields() else SLOTS[field]
            places += [""] * (slot + 1 - len(places))
            places[slot] = name
        self.set(places=places)
        self._build()

    def _drop(self, index: int) -> None:
        self.set(places=[name for at, name in enumerate(self.places) if at != index])
        self._build()

    def back(self) -> bool:
        """From the list of places to the fields; False when it was not there."""
        if not self.picking:
            return False
        self.picking = ""
        self._build()
        return True

    def on_map(self) -> None:
        """A finger wants to choose on the map."""

    def on_react(self, reaction: str) -> None:
        """A finger chose what a patrol does about an intruder: `stop`, `report` or `circle`."""

    # how it is built

    def _fields(self) -> tuple[str, ...]:
        return fields(self.task, self.robot)

    def _build(self, *_: object) -> None:
        self.clear_widgets()
        if self.picking:
            self._build_picking()
            return
        self.add_widget(self._roll)
        column = self.ids.column
        column.clear_widgets()
        for field in self._fields():
            for widget in self._field(field):
                column.add_widget(widget)
            if self.has_map and field == self._last_of_places():
                column.add_widget(self._map_button())

    def _last_of_places(self) -> str:
        found = [field for field in self._fields() if field in ASKS or field == "points"]
        return found[-1] if found else ""

    def _map_button(self) -> QuietButton:
        button = QuietButton(text=tr("Choose on the map"), icon="map")
        button.bind(on_release=lambda _: self.dispatch("on_map"))
        return button

    def _build_picking(self) -> None:
        row = FormRow(title=tr(ASKS[self.picking][1]))
        back = IconButton(icon="arrow_back", bare=True, pos_hint={"center_y": 0.5})
        back.bind(on_release=lambda _: self.back())
        row.add_widget(back, index=1)
        if self.picking in OPTIONAL:
            none = QuietButton(
                text=tr(OPTIONAL[self.picking]), size_hint_x=None, width="140dp", pos_hint={"center_y": 0.5}
            )
            none.bind(on_release=lambda _: self.pick(Place()))
            row.add_widget(none)
        self.add_widget(row)
        self.add_widget(self.list)

    def _field(self, field: str) -> list[Widget]:
        if field in SLOTS:
            return [self._place_row(field)]
        if field in NUMBERS:
            return [NUMBERS[field](self)]
        make: dict[str, Callable[[], list[Widget]]] = {
            "stops": self._stops,
            "points": self._points,
            "reaction": self._reaction,
            "message": lambda: [self._text("message")],
            "recipient": lambda: [self._text("recipient_tag")],
            "heading": lambda: [self.dial],
        }
        return make[field]()

    def _place_row(self, field: str) -> ListRow:
        slot = 0 if field == "to" and "from" not in self._fields() else SLOTS[field]
        name = self.places[slot] if slot < len(self.places) else ""
        kinds = {place.name: place.kind for place in self.list.places}
        row = ListRow(
            icon=KINDS[kinds.get(name, "place")][0] if name else "search",
            role="plan" if name else "muted",
            title=name or tr(OPTIONAL.get(field, mark("Choose a place"))),
            aside=tr(ASKS[field][0]),
            faded=not name,
        )
        row.bind(on_release=lambda _: self.ask(field))
        return row

    def _stops(self) -> list[Widget]:
        rows: list[Widget] = []
        for index, name in enumerate(self.places):
            row = ListRow(icon="flag", role="plan", title=name, aside=f"{index + 1}", end="4dp")
            gone = IconButton(icon="close", bare=True, pos_hint={"center_y": 0.5})
            gone.bind(on_release=lambda _, index=index: self._drop(index))
            row.add_widget(gone)
            rows.append(row)
        more = QuietButton(text=tr("Add a place"), icon="add")
        more.bind(on_release=lambda _: self.ask("stops"))
        return [*rows, more]

    def _points(self) -> list[Widget]:
        count = len(self.mission.waypoints)
        words = trn("{count} point on the map", "{count} points on the map", count)
        choice = Segmented(options=[("map", words), ("names", tr("Places by name"))])
        choice.value = "names" if self.places else "map"
        choice.bind(on_choose=lambda _, way: self.ask("stops") if way == "names" else self._on_map())
        return [choice, *(self._stops() if self.places else [])]

    def _on_map(self) -> None:
        self.set(places=[])
        self._build()

    def _reaction(self) -> list[Widget]:
        options = [("report", tr("Report")), ("stop", tr("Stop")), ("circle", tr("Circle it"))]
        choice = Segmented(options=options)
        choice.value = "stop" if self.mission.stop_on_intruder else self.mission.on_intruder or "report"
        choice.bind(on_choose=lambda _, reaction: self.dispatch("on_react", reaction))
        return [SectionLabel(title=tr("When it finds an intruder")), choice]

    def _text(self, name: str) -> TextField:
        field = self._texts[name]
        if field.text != getattr(self, name):
            field.text = getattr(self, name)
        return field

    def _typed(self, field: TextField, text: str) -> None:
        name = next(name for name, one in self._texts.items() if one is field)
        if len(text) > MAX_TEXT_LENGTH:
            field.text = text[:MAX_TEXT_LENGTH]
        elif text != getattr(self, name):
            self.set(**{name: text})


def samples() -> dict[str, Callable[[], Widget]]:
    """Each task with what it asks for, and the list of places."""
    mission = Mission(waypoints=[Waypoint(float(x), 0.0) for x in range(6)])

    def make(order: TaskOrder, pick: str = "", **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            form = OrderForm(size_hint=(None, None), size=("388dp", "340dp"), **kwargs)
            form.show(PlaceArray(places=SOME))
            form.show(mission)
            form.show(order)
            if pick:
                form.ask(pick)
            return form

        return build

    return {
        "patrol": make(TaskOrder(task="patrol")),
        "deliver": make(TaskOrder(task="deliver", places=["Office 12", "Lab"], message="For Ms. Weber")),
        "deliver empty": make(TaskOrder(task="deliver")),
        "guide": make(TaskOrder(task="guide", places=["Reception", "Lab"])),
        "guide blind": make(TaskOrder(task="guide", places=["Lab"]), follows=False),
        "heading": make(TaskOrder(task="follow_heading", heading=math.pi / 2, duration=120.0)),
        "hold": make(TaskOrder(task="hold")),
        "hold a depth": make(
            TaskOrder(task="hold", height=-4.5),
            robot=RobotInfo(holds="Keeps its place in the water", dives=True, max_climb=0.5),
        ),
        "heading of a boat": make(
            TaskOrder(task="follow_heading", heading=0.0, throttle=0.6),
            robot=RobotInfo(moves="Sails", order_fields=["throttle"]),
        ),
        "take off": make(
            TaskOrder(task="take_off"), robot=RobotInfo(moves="Flies", flies=True, max_climb=1.0)
        ),
        "dock": make(TaskOrder(task="dock")),
        "from where": make(TaskOrder(task="deliver"), pick="from"),
        "disabled": make(TaskOrder(task="dock"), state="disabled"),
    }
