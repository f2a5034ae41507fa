"""Outcome of STOP ALL, robot by robot: SENT, STOPPED, NO ANSWER, and the number of stopped ones.

result = StopList()
result.update(fleet.rows, fleet.stopped, fleet.total)
result.bind(on_command=lambda _: fleet.let_go(), on_close=lambda _: fold())
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Protocol

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from widgets.controls.hold_progress import Hold
from widgets.core.base import Control
from widgets.core.language import mark, tr, trn
from widgets.parts.buttons import QuietButton

__all__ = ["WORDS", "StopList", "StopRow"]

MIN_HEAD_WIDTH = 320
"""A narrower line has no cross [dp]."""

WORDS = {
    "sent": (mark("SENT"), "warn", "hourglass_top"),
    "stopped": (mark("STOPPED"), "ok", "lock"),
    "moves": (mark("MOVES"), "danger", "warning"),
    "no_answer": (mark("NO ANSWER"), "danger", "signal_disconnected"),
    "lost": (mark("NO ANSWER"), "danger", "signal_disconnected"),
    "released": (mark("RELEASED"), "muted", "lock_open"),
}
"""What became of a robot's STOP to its word, the role of that, and its icon."""

_WORST = ("moves", "no_answer", "lost", "sent", "released", "stopped")

Builder.load_string("""
<StopRow>:
    size_hint_y: None
    height: max(dp(44), words.height + dp(10))
    padding: 0, 0, dp(8), 0
    spacing: dp(10)
    Icon:
        name: root.icon
        role: root.role
        pos_hint: {'center_y': .5}
    TwoLines:
        id: words
        title: root.title
        detail: root.detail
        whole: True
    Label:
        text: root.word
        font_name: theme.font
        font_size: sp(14)
        bold: True
        color: theme.roles[root.role]
        disabled_color: self.color
        size_hint: None, None
        size: self.texture_size
        pos_hint: {'center_y': .5}

<HoldButton>:
    canvas.after:
        Rounded:
            rgba: theme.danger[:3] + [.35 if root.held else 0]
            pos: self.pos
            size: max(self.width * root.held, theme.corner * 2), self.height
            radius: [theme.corner]

<StopList>:
    orientation: 'vertical'
    Card:
        id: card
        outline: 'ok' if root.all_stopped else 'danger'
        padding: dp(14), dp(4), dp(14), dp(12)
        BoxLayout:
            id: head
            size_hint_y: None
            height: theme.target
            Column:
                pos_hint: {'center_y': .5}
                Text:
                    text: root.title
                    bold: True
                    role: 'ok' if root.all_stopped else 'danger'
                    font_size: theme.size_title
                Text:
                    text: root.worst
                    font_size: sp(14)
                    shorten: True
                    shorten_from: 'right'
                    height: self.texture_size[1] if root.folded and root.worst else 0
                    opacity: 1 if root.folded else 0
            IconButton:
                id: fold
                icon: 'expand_less' if root.folded else 'expand_more'
                role: 'muted'
                bare: True
                size: (theme.target, theme.target) if root.cramped else (0, 0)
                opacity: 1 if root.cramped else 0
                disabled: not root.cramped
                on_release: root.dispatch('on_fold')
            IconButton:
                id: close
                icon: 'close'
                role: 'muted'
                bare: True
                size: (0, 0) if root.slim else (theme.target, theme.target)
                opacity: 0 if root.slim else 1
                disabled: root.slim
                on_release: root.dispatch('on_close')
        Roll:
            id: roll
            Column:
                id: column
        Remark:
            id: footnote
            text: root.footnote
        HoldButton:
            id: release
            text: root.offer
            height: theme.target if root.offer else 0
            opacity: 1 if root.offer else 0
            disabled: not root.offer
            on_held_long: root.dispatch('on_command')
""")


class Stopped(Protocol):
    """One robot, as of `app.stop.fleet.Row`."""

    @property
    def url(self) -> str:
        """Its address."""

    @property
    def name(self) -> str:
        """What to call it."""

    @property
    def phase(self) -> str:
        """Key in `WORDS`."""

    @property
    def sentence(self) -> str:
        """More about it; empty for nothing."""

    @property
    def foreign(self) -> bool:
        """It is held by zero speed alone."""


class StopRow(BoxLayout):
    """One robot: its name, the word, and why."""

    title = StringProperty("")
    detail = StringProperty("")
    word = StringProperty("")
    role = StringProperty("muted")
    icon = StringProperty("lock")

    def update(self, robot: Stopped) -> None:
        """Show what is known of the robot."""
        self.title, self.detail = robot.name, robot.sentence
        word, self.role, self.icon = WORDS[robot.phase]
        self.word = tr(word)


class HoldButton(Hold, QuietButton):
    """Dispatches `on_held_long` after a finger has stayed for a second."""

    def __init__(self, **kwargs: Any) -> None:
        kwargs.setdefault("min_state_time", 0)  # a finger that leaves early is gone at once
        super().__init__(**kwargs)

    def on_state(self, *_: object) -> None:
        """A finger came down or left."""
        if self.state == "down":
            self.hold()
        else:
            self.rest()


class StopList(Control, BoxLayout):
    """Dispatches `on_command` after the hold by which the operator lets go, and `on_close` to be folded away."""

    veiled = False
    __events__ = ("on_close", "on_fold")

    folded = BooleanProperty(False)
    """One line only, because something else needs the room."""
    cramped = BooleanProperty(False)
    """Something else needs the room: it can be folded and unfolded."""

    def _slim(self) -> bool:
        return self.folded and self.width < dp(MIN_HEAD_WIDTH)

    slim = AliasProperty(_slim, bind=["folded", "width"], cache=True)
    """There is room for one thing to press: it is unfolded before it is closed."""
    worst = StringProperty("")
    """Who is not stopped, in few words; empty when all are. Said where it is folded."""
    title = StringProperty("")
    all_stopped = BooleanProperty(False)
    footnote = StringProperty("")
    """What goes on, and what letting go means; how to release them when nothing is sent any more."""
    offer = StringProperty("")
    """Words of the hold; empty when there is nothing to let go."""
    wanted = NumericProperty(0.0)
    """The height at which every row is seen [px]."""
    line = NumericProperty(0.0)
    """The height when it is folded [px]."""

    def __init__(self, **kwargs: Any) -> None:
        self._rows: list[StopRow] = []
        super().__init__(**kwargs)
        self._unfolded = [self.ids[name].__self__ for name in ("roll", "footnote", "release")]
        """What is away while it is folded: kv holds ids weakly."""
        for part in (self.ids.column, self.ids.footnote, self.ids.head, self.ids.release):
            part.bind(height=self._measure)
        self._measure()
        self.bind(folded=self._fold)
        if self.folded:
            self._fold()

    def _fold(self, *_: object) -> None:
        """All but the head away, or back."""
        card = self.ids.card
        self.ids.release.rest()
        for part in self._unfolded:
            if self.folded:
                card.remove_widget(part)
            else:
                card.add_widget(part)
        self._measure()

    def update(
        self,
        robots: Iterable[Stopped],
        stopped: int,
        total: int,
        *,
        untried: int = 0,
        since: int = 0,
        unmet: int = 0,
    ) -> None:
        """Take over what is known, worst first; `untried` were too many, `since` came after the press.

        STOP goes to `unmet` addresses as well, where no robot was ever met: they are none of `total`.
        """
        robots = sorted(robots, key=lambda robot: _WORST.index(robot.phase))
        while len(self._rows) > len(robots):
            self.ids.column.remove_widget(self._rows.pop())
        while len(self._rows) < len(robots):
            self._rows.append(StopRow())
            self.ids.column.add_widget(self._rows[-1])
        for row, robot in zip(self._rows, robots, strict=True):
            row.update(robot)
        self.title, self.all_stopped = (
            tr("STOPPED {count} of {total}").format(count=stopped, total=total),
            stopped == total,
        )
        worst = robots[0] if robots and robots[0].phase != "stopped" else None
        self.worst = f"{worst.name}: {tr(WORDS[worst.phase][0])}" if worst is not None else ""
        held = sum(robot.foreign for robot in robots)
        open_ones = sum(robot.phase not in ("stopped", "released") for robot in robots)
        self.footnote = _footnote(open_ones, held, untried, since, unmet) or tr(HINT)
        self.offer = tr("Hold to stop sending") if open_ones or held else ""

    def _measure(self, *_: object) -> None:
        ids, card = self.ids, self.ids.card
        parts = (ids.head.height, ids.column.height, ids.footnote.height, ids.release.height)
        around = card.padding[1] + card.padding[3]
        self.line = ids.head.height + around
        self.wanted = sum(parts) + card.spacing * 3 + around

    def rest(self) -> None:
        """Forget a hold that has begun."""
        self.ids.release.rest()

    def on_close(self) -> None:
        """To be folded away; what is sent goes on being sent."""

    def on_fold(self) -> None:
        """To be folded, or unfolded over what needs the room."""

    def on_touch_down(self, touch: Any) -> bool:
        """Nothing behind it gets a finger."""
        return bool(super().on_touch_down(touch) or self.collide_point(*touch.pos))


HINT = mark("To release one: connect to it, take control, hold STOP.")


def _footnote(open_ones: int, held: int, untried: int, since: int, unmet: int) -> str:
    parts = []
    if since:
        parts.append(tr("{since} more found since: press STOP ALL again.").format(since=since))
    if untried:
        parts.append(tr("{untried} more not tried: too many at once.").format(untried=untried))
    if unmet:
        words = trn(
            "{count} address that never answered is not counted; STOP is sent there too.",
            "{count} addresses that never answered are not counted; STOP is sent there too.",
            unmet,
        )
        parts.append(words)
    if open_ones:
        parts.append(tr("STOP is sent until every robot rests."))
    if held:
        parts.append(tr("A robot without its own STOP rests only while zero speed is sent."))
    return " ".join(parts)


@dataclass(frozen=True)
class _Sample:
    url: str
    name: str
    phase: str
    sentence: str = ""
    foreign: bool = False


SOME = [
    _Sample("a", "Patrol-1", "stopped", "Pressed by tablet-B."),
    _Sample("b", "Minnow-2", "sent"),
    _Sample("c", "Commander", "moves", "STOP is pressed, and it does not come to rest."),
    _Sample("d", "Scout", "no_answer", "Not heard for 3 min. No robot answers at 10.0.0.52:9090."),
    _Sample("e", "Aqua", "released", "STOP was released."),
    _Sample("f", "turtle1", "stopped", "No STOP of its own: zero speed is sent while the link stands.", True),
]
"""For the samples."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Every phase, all stopped, and more robots than there is room for."""

    def make(robots: list[_Sample], height: str, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            widget = StopList(size_hint=(None, None), size=("388dp", height))
            stopped = sum(robot.phase == "stopped" for robot in robots)
            widget.update(robots, stopped, len(robots) + kwargs.get("untried", 0), **kwargs)
            return widget

        return build

    many = [_Sample(f"{n}", f"Robot-{n}", "stopped") for n in range(30)]
    return {
        "some": make(SOME, "530dp"),
        "folded": _folded,
        "all": make([SOME[0], _Sample("b", "Minnow-2", "stopped")], "220dp"),
        "many": make(many, "320dp", untried=2),
    }


def _folded() -> StopList:
    widget = StopList(size_hint=(None, None), size=("388dp", "69dp"), cramped=True, folded=True)
    widget.update(SOME, 2, 6)
    return widget
