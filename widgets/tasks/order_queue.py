"""Queue behind the running task: drag a row by its handle to another place, or take it out.

queue = OrderQueue()
robot.on("/task/queue", queue.show)
queue.bind(on_command=lambda _, what, index, target: print(what, index, target))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import AliasProperty, BooleanProperty, ListProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import TaskOrder, TaskQueue
from widgets.core.base import Control
from widgets.core.language import mark, tr
from widgets.core.task_words import TASKS, title
from widgets.parts.buttons import IconButton
from widgets.parts.labels import Text
from widgets.parts.rows import DragHandle, ListRow

__all__ = ["OrderQueue"]

Builder.load_string("""
<OrderQueue>:
    orientation: 'vertical'
    row_height: max(dp(60), theme.least + dp(6))
    Roll:
        id: roll
        Widget:
            id: column
            size_hint_y: None
            height: max(root.whole, roll.height)
""")


class OrderQueue(Control, BoxLayout):
    """Dispatches `on_command("move", index, target)` or `on_command("remove", index, -1)`, both from 0."""

    accepts = (TaskQueue,)

    orders: ListProperty[TaskOrder] = ListProperty()
    """Every `TaskOrder` that waits, the next one first."""
    waits = BooleanProperty(False)
    """The robot has not confirmed what is shown."""
    held = StringProperty("")
    """Why the next one does not start by itself, as the end of a sentence; empty when it does."""
    nothing = StringProperty(mark("No tasks are waiting. A new one starts after the one before."))
    """What to say while nothing waits."""
    gap = NumericProperty("6dp")
    """Between two rows [px]."""
    row_height = NumericProperty("60dp")
    """Of every row [px], so that they can change places."""

    def _whole(self) -> float:
        return max(1, len(self.orders)) * (self.row_height + self.gap)

    whole = AliasProperty(_whole, bind=["orders", "row_height", "gap"], cache=True)
    """Of all rows [px]."""

    def __init__(self, **kwargs: Any) -> None:
        self._rows: list[ListRow] = []
        self._dragged: tuple[int, float] | None = None
        self._sentence = Text(role="muted", font_size="15sp")
        super().__init__(**kwargs)
        self._sentence.bind(height=self._place)
        self.bind(orders=self._build, waits=self._mark, held=self._mark, nothing=self._build)
        for place in ("pos", "size"):
            self.ids.column.fbind(place, self._place)
        self._build()

    def show(self, msg: TaskQueue) -> None:
        """Take over what waits, unless a finger is just moving it."""
        if self._dragged is None:
            self.orders, self.held = list(msg.orders), msg.held

    def rest(self) -> None:
        """What a finger holds goes back to where it was."""
        self._dragged = None
        self._place()

    def _build(self, *_: object) -> None:
        column = self.ids.column
        column.clear_widgets()
        self._dragged = None
        self._rows = [self._row(index, order) for index, order in enumerate(self.orders)]
        for row in self._rows:
            column.add_widget(row)
        if not self._rows:
            self._sentence.text = tr(self.nothing)
            column.add_widget(self._sentence)
        self._mark()
        self._place()

    def _row(self, index: int, order: TaskOrder) -> ListRow:
        words = TASKS.get(order.task)
        row = ListRow(icon=words.icon if words else "help", title=title(order), end="4dp")
        row.size_hint = (None, None)
        delete = IconButton(icon="delete", bare=True, pos_hint={"center_y": 0.5})
        delete.bind(on_release=lambda _: self.remove(index))
        handle = DragHandle()
        handle.bind(on_drag=lambda _, up: self.drag(index, up), on_drop=lambda _: self._drop())
        row.add_widget(delete)
        row.add_widget(handle)
        return row

    def remove(self, index: int) -> None:
        """Take a row out as a finger would."""
        self.dispatch("on_command", "remove", index, -1)

    def drag(self, index: int, up: float) -> None:
        """Lift a row by `up` [px] as a finger on its handle would."""
        if self._dragged is None:  # over the others
            self.ids.column.remove_widget(self._rows[index])
            self.ids.column.add_widget(self._rows[index])
        self._dragged = (index, up)
        self._rows[index].chosen = True
        self._place()

    def _drop(self) -> None:
        if self._dragged is None:
            return
        index, target = self._dragged[0], self._target()
        self._rows[index].chosen = False
        self._dragged = None
        if target != index:
            self.dispatch("on_command", "move", index, target)
        self._place()

    def _target(self) -> int:
        """Where the dragged row would come to lie."""
        if self._dragged is None:
            return -1
        index, up = self._dragged
        wanted = index - up / (self.row_height + self.gap)
        return int(min(max(math.floor(wanted + 0.5), 0), len(self._rows) - 1))

    def _place(self, *_: object) -> None:
        column, step = self.ids.column, self.row_height + self.gap
        top = column.y + column.height  # `top` itself may not have followed yet
        self._sentence.pos = column.x, top - dp_below(self._sentence)
        self._sentence.width = column.width
        order = list(range(len(self._rows)))
        if self._dragged is not None:
            order.insert(self._target(), order.pop(self._dragged[0]))
        for place, index in enumerate(order):
            row = self._rows[index]
            row.size = column.width, self.row_height
            row.pos = column.x, top - (place + 1) * step + self.gap
        if self._dragged is not None:
            index, up = self._dragged
            self._rows[index].y = top - (index + 1) * step + self.gap + up

    def _mark(self, *_: object) -> None:
        for number, row in enumerate(self._rows):
            row.role = "muted" if self.waits else "plan"
            row.detail = details(self.orders[number], first=number == 0, held=bool(self.held))
            row.faded = self.waits


def dp_below(text: Text) -> float:
    """From the top of the column to the lower edge of the sentence [px]."""
    return float(text.height + text.font_size * 0.4)


def details(order: TaskOrder, *, first: bool, held: bool = False) -> str:
    """Remarks on an order, in one line; of the `first` one also when it starts."""
    turn = (tr("Waits until resumed") if held else tr("Next")) if first else ""
    return " · ".join(part for part in (turn, order.message) if part)


THREE = [
    TaskOrder(id=3, task="deliver", places=["Office 12", "Lab"], message="The parcel for Ms. Weber"),
    TaskOrder(id=4, task="patrol"),
    TaskOrder(id=5, task="dock", places=["Charger"]),
]
"""For the samples here and elsewhere."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Some tasks, on their way to the robot, while one is dragged, none."""

    def make(
        orders: list[TaskOrder] = THREE, drag: float = 0.0, held: str = "", **kwargs: Any
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            queue = OrderQueue(size_hint=(None, None), size=("388dp", "210dp"), **kwargs)
            queue.show(TaskQueue(orders=orders, held=held))
            if drag:
                queue.drag(0, drag)
            return queue

        return build

    return {
        "three": make(),
        "held": make(held="the robot's computer was restarted"),
        "on its way": make(waits=True),
        "dragged": make(drag=-80.0),
        "none": make([]),
        "disabled": make(state="disabled"),
    }
