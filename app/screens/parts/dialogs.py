"""Questions over everything else: one card on a shade, answered or cancelled."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import ListProperty, StringProperty
from kivy.uix.floatlayout import FloatLayout

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.inputs.base.modal import Modal
from app.layout.rects import Rect
from app.screens.parts.safe_area import safe_area
from widgets import StopAll, StopButton

__all__ = ["AddressDialog", "Question", "free_room"]

Builder.load_string("""
<Question>:
    canvas.before:
        StencilPush
        SmoothRoundedRectangle:
            pos: self.hole[:2]
            size: self.hole[2:]
            radius: [theme.radius * 1.3]
        StencilUse:
            func_op: 'notequal'
        Color:
            rgba: theme.shade[:3] + [.6]
        Rectangle:
            pos: self.pos
            size: self.size
        StencilUnUse
        SmoothRoundedRectangle:
            pos: self.hole[:2]
            size: self.hole[2:]
            radius: [theme.radius * 1.3]
        StencilPop

# in the middle of the room that a question has, at most as large as it is told
<RoomCard@Card>:
    room: [0, 0, 1, 1]
    wide: 0
    high: 0
    size_hint: None, None
    width: min(self.wide, self.room[2] - dp(28))
    height: min(self.high, self.room[3] - dp(24))
    x: self.room[0] + (self.room[2] - self.width) / 2
    y: self.room[1] + (self.room[3] - self.height) / 2
    padding: dp(18)
    spacing: dp(10)

<AddressDialog>:
    Card:
        id: card
        size_hint: None, None
        width: min(dp(440), root.room[2] - dp(28))
        height: self.minimum_height
        x: root.room[0] + (root.room[2] - self.width) / 2
        y: max(root.room[1] + dp(8), root.room[1] + root.room[3] - self.height - max(dp(40), min(root.room[3] * .28, dp(180))))
        padding: dp(20)
        spacing: dp(14)
        Text:
            text: tr('Add a robot by its address')
            bold: True
            font_size: theme.size_title
        TextField:
            id: field
            hint_text: '192.168.1.7'
            wrong: bool(root.problem)
            input_type: 'url'
            on_text: root.problem = ''
            on_text_validate: root.answer()
        Text:
            text: root.problem or tr('The port is 9090 unless it is given, as in 192.168.1.7:9091.')
            role: 'danger' if root.problem else 'muted'
            font_size: sp(14)
        BoxLayout:
            size_hint_y: None
            height: theme.target
            spacing: dp(12)
            QuietButton:
                id: cancel
                text: tr('Cancel')
                on_release: root.close()
            PrimaryButton:
                id: connect
                text: tr('Connect')
                on_release: root.answer()
""")


def free_room(
    whole: Rect, kept: Sequence[Rect], gap: float, wanted: tuple[float, float] = (0.0, 0.0)
) -> Rect:
    """The largest part of `whole` beside, above or below all of `kept`, `gap` away from them; all of it without any [px].

    One that holds what is `wanted`, width and height, is preferred, and no more of either than there is at all.
    """
    if not kept:
        return whole
    left, right = min(one.x for one in kept) - gap, max(one.right for one in kept) + gap
    low, top = min(one.y for one in kept) - gap, max(one.top for one in kept) + gap
    parts = (
        Rect(whole.x, top, whole.width, whole.top - top),
        Rect(whole.x, whole.y, left - whole.x, whole.height),
        Rect(right, whole.y, whole.right - right, whole.height),
        Rect(whole.x, whole.y, whole.width, low - whole.y),
    )
    wide, high = min(wanted[0], whole.width), min(wanted[1], whole.height)

    def worth(part: Rect) -> tuple[bool, float]:
        return part.width >= wide and part.height >= high, max(0.0, part.width) * max(0.0, part.height)

    return max(parts, key=worth)


class Question(Modal, FloatLayout):
    """Lies over everything else until it is answered or cancelled; its rule has a `card`.

    STOP is not among what it lies over: it is seen through the shade, the card leaves it free, and it takes its finger.
    """

    __events__ = ("on_close",)

    hole = ListProperty([0, 0, 0, 0])
    """x, y, width and height of STOP, where there is no shade [px]."""
    room = ListProperty([0, 0, 1, 1])
    """x, y, width and height of where the card may be [px]: STOP and STOP ALL are elsewhere."""
    wanted: ClassVar[tuple[float, float]] = (0.0, 0.0)
    """Width and height that the card is best read at, with what is round it [dp]; 0 where more is better."""

    def __init__(self, **kwargs: Any) -> None:
        self._stops: list[Any] = []
        self._over: Any = None
        self._placing = Clock.create_trigger(self._place, -1)
        super().__init__(**kwargs)
        self.bind(pos=self._place, size=self._place)
        self.bind(pos=self._placing, size=self._placing)  # STOP ALL goes to its new place in the same frame

    def on_parent(self, _: object, parent: Any) -> None:
        """It comes over a page, whose STOP it finds, or leaves it."""
        for stop in self._stops:
            stop.unbind(pos=self._placing, size=self._placing)
        if self._over is not None:
            self._over.unbind(children=self._placing)
        pages = parent.children if parent is not None else ()
        found = (getattr(page, "stop", None) for page in pages)
        self._stops = [stop for stop in found if isinstance(stop, StopButton)]
        self._over = getattr(parent, "over", None)
        for stop in self._stops:
            stop.bind(pos=self._placing, size=self._placing)
        if self._over is not None:
            self._over.bind(children=self._placing)
        self._place()
        if parent is None:  # another page takes it away, too
            self.dispatch("on_close")

    def _place(self, *_: object) -> None:
        kept = [Rect(*stop.pos, *stop.size) for stop in self._stops]
        self.hole = [kept[0].x, kept[0].y, kept[0].width, kept[0].height] if kept else [0, 0, 0, 0]
        over = self._over.children if self._over is not None else ()
        kept += [Rect(*one.pos, *one.size) for one in over if isinstance(one, StopAll)]
        wide, high = self.wanted
        room = free_room(safe_area.within(self.width, self.height), kept, dp(8), (dp(wide), dp(high)))
        self.room = [room.x, room.y, room.width, room.height]

    def close(self) -> None:
        """Leave the glass."""
        if self.parent is not None:
            self.parent.remove_widget(self)

    def on_close(self) -> None:
        """It was answered or cancelled, or another page came."""

    def on_touch_down(self, touch: Any) -> bool:
        """Nothing behind the question gets a finger, but STOP before all else; one beside the card cancels."""
        for stop in self._stops:
            if stop.collide_point(*touch.pos):
                return bool(stop.dispatch("on_touch_down", touch))
        if not self.ids.card.collide_point(*touch.pos):
            self.close()
        else:
            super().on_touch_down(touch)
        return True


class AddressDialog(Question):
    """Asks for an address; `on_answer` may raise ValueError, whose sentence is shown, and what was typed stays."""

    problem = StringProperty("")
    wanted = (468.0, 300.0)

    def __init__(self, on_answer: Callable[[str], object], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._on_answer = on_answer

    def answer(self) -> None:
        """Hand over what was typed; stays open when it is wrong."""
        try:
            self._on_answer(self.ids.field.text)
        except ValueError as error:
            self.problem = str(error)
        else:
            self.close()

    def on_close(self) -> None:
        """The keyboard leaves the glass with it."""
        self.ids.field.focus = False
