"""Buttons of a task: start, pause, resume, end, go home; and the outcome of the last command.

buttons = TaskButtons()
robot.on("/task/status", buttons.show)
buttons.bind(on_command=lambda _, name: commands.ask(name))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.widget import Widget

import widgets.parts.buttons  # noqa: F401 - its rules draw the buttons
from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets.core.base import VEIL, Control, fitting_size
from widgets.core.language import mark, tr, within
from widgets.core.theme import theme
from widgets.parts.column import Column

__all__ = ["COMMANDS", "TaskButtons"]

COMMANDS = {
    "start": (mark("Start patrol"), "play_arrow_fill"),
    "pause": (mark("Pause"), "pause"),
    "resume": (mark("Resume"), "play_arrow_fill"),
    "stop": (mark("End task"), "stop"),
    "home": (mark("Go home"), "home"),
}
"""Name of each command to its words and its icon."""

BRIEF = {"start": mark("Start"), "stop": mark("End"), "home": mark("Home")}
"""Shorter words where there is no room."""

OUTCOMES = {
    "none": ("", "info", "muted"),
    "sent": (mark("Sent: {what}"), "schedule", "muted"),
    "accepted": (mark("Accepted: {what}{after}"), "check_circle", "ok"),
    "refused": (mark("Refused: {why}"), "block", "danger"),
    "no_reply": (mark("No reply to: {what}"), "signal_disconnected", "warn"),
}
"""What became of a command, to its sentence, icon and role."""

OUTCOME_TIMEOUTS = {"accepted": 6.0, "refused": 15.0, "no_reply": 15.0}
"""How long an outcome is shown before the robot's own sentence comes back [s]."""

LEADS_TO = {"start": "RUNNING", "resume": "RUNNING", "home": "RUNNING", "pause": "PAUSED", "stop": "CANCELED"}
"""State of the task that a command brings about."""

Builder.load_string("""
<TaskButtons>:
    spacing: theme.gap * .6
    BoxLayout:
        id: row
        size_hint_y: None
        height: max(theme.target, dp(54 if root.low else 64)) if root.flow == 'vertical' else theme.target
        spacing: theme.gap * .8
        PushButton:
            text: root.main_words
            meaning: root.main
            icon: root.main_icon
            fill: 'accent' if root.inviting else 'raised'
            border: 'accent' if root.inviting else 'line'
            ink: 'ink_accent' if root.inviting else 'text'
            flow: root.flow
            height: row.height
            disabled: root.disabled or (root.held and root.main != 'pause') or (root.empty and root.main == 'start')
            size_hint_x: 1 if root.brief else 1.12 if root.narrow else 1.25
            on_release: root.ask(root.main)
        QuietButton:
            text: root.stop_words
            icon: 'stop'
            flow: root.flow
            height: row.height
            disabled: root.disabled or not root.running
            on_release: root.ask('stop')
        QuietButton:
            text: root.home_words
            icon: 'home'
            flow: root.flow
            height: row.height
            disabled: root.disabled or root.held
            on_release: root.ask('home')
    BoxLayout:
        size_hint_y: None
        height: dp(22) if root.brief else max(dp(22), said.height)
        opacity: 1 if root.sentence else 0
        spacing: dp(8)
        Icon:
            name: root.outcome_icon
            role: root.outcome_role
            font_size: sp(19)
            pos_hint: {'center_y': .5}
        Text:
            id: said
            text: root.sentence
            font_size: sp(14)
            shorten: root.brief
            shorten_from: 'right'
            role: 'text' if root.outcome in ('refused', 'no_reply') else 'muted'
            pos_hint: {'center_y': .5}
""")


class TaskButtons(Control, Column):
    """Dispatches `on_command(name)`: `start`, `pause`, `resume`, `stop` or `home`. Shows the outcome that `answer` was given."""

    accepts = (TaskStatus,)

    veils: ClassVar = {"stale": VEIL["stale"]}
    """Buttons that cannot be pressed are drawn so one by one; the sentence, which says why, stays readable."""

    task_state = StringProperty("IDLE")
    """State of the robot's task, as in TaskStatus."""
    brief = BooleanProperty(False)
    """Icons above the words, for a phone."""
    cramped = BooleanProperty(False)
    """Words beside their icons would be small, so that the icons are above them."""

    low = BooleanProperty(False)
    """Lower ones, for a phone on its side."""

    ready = BooleanProperty(True)
    """There is a patrol that the robot would start; without one Start is as quiet as the rest."""
    empty = BooleanProperty(False)
    """There are no points to start a patrol of, and Start cannot be pressed."""
    held = BooleanProperty(False)
    """STOP is pressed: nothing that moves the robot can be asked for."""

    def _narrow(self) -> bool:
        return self.brief or self.width < dp(400)

    narrow = AliasProperty(_narrow, bind=["brief", "width"], cache=True)
    """Has room for short words only."""

    command = StringProperty("")
    """The last command that was requested."""
    outcome = OptionProperty("none", options=list(OUTCOMES))
    """What became of it: `none`, `sent`, `accepted`, `refused` or `no_reply`."""
    why = StringProperty("")
    """The robot's sentence when it refused."""
    what = StringProperty("")
    """The command in words; empty for those of its button."""
    took = NumericProperty(math.nan)
    """From the command to its answer [s]; NaN unknown."""

    reason = StringProperty("")
    """The robot's sentence about its task; shown until a command has an outcome."""

    def _running(self) -> bool:
        return self.task_state in {"RUNNING", "PAUSED"}

    running = AliasProperty(_running, bind=["task_state"], cache=True)
    """There is a task to pause or end."""

    def _main(self) -> str:
        return {"RUNNING": "pause", "PAUSED": "resume"}.get(self.task_state, "start")

    main = AliasProperty(_main, bind=["task_state"], cache=True)
    """The command that the first button gives."""

    def _inviting(self) -> bool:
        return self.main == "resume" or (self.main == "start" and self.ready)

    inviting = AliasProperty(_inviting, bind=["main", "ready"], cache=True)
    """The first button stands out."""

    def _main_words(self) -> str:
        return self.words(self.main)

    main_words = AliasProperty(_main_words, bind=["main", "narrow"], cache=True)

    def _stop_words(self) -> str:
        return self.words("stop")

    stop_words = AliasProperty(_stop_words, bind=["narrow"], cache=True)

    def _home_words(self) -> str:
        return self.words("home")

    home_words = AliasProperty(_home_words, bind=["narrow"], cache=True)

    def _main_icon(self) -> str:
        return COMMANDS[self.main][1]

    main_icon = AliasProperty(_main_icon, bind=["main"], cache=True)

    def _flow(self) -> str:
        return "vertical" if self.brief or self.cramped else "horizontal"

    flow = AliasProperty(_flow, bind=["brief", "cramped"], cache=True)

    def _sentence(self) -> str:
        if self.outcome == "none":
            return self.reason
        words = self.what or tr(COMMANDS.get(self.command, (self.command,))[0])
        after = f" ({self.took * 1000:.0f} ms)" if math.isfinite(self.took) else ""
        what = within(words)
        return tr(OUTCOMES[self.outcome][0]).format(what=what, after=after, why=self.why or what)

    sentence = AliasProperty(
        _sentence, bind=["outcome", "command", "what", "why", "took", "reason"], cache=True
    )
    """What became of the last command, or what the task does, in words."""

    def _outcome_icon(self) -> str:
        return OUTCOMES[self.outcome][1]

    outcome_icon = AliasProperty(_outcome_icon, bind=["outcome"], cache=True)

    def _outcome_role(self) -> str:
        return OUTCOMES[self.outcome][2]

    outcome_role = AliasProperty(_outcome_role, bind=["outcome"], cache=True)

    def __init__(self, **kwargs: Any) -> None:
        self._told = Clock.create_trigger(lambda _: None)
        super().__init__(**kwargs)
        self.bind(held=self._contradict, task_state=self._contradict)
        for button in self.ids.row.children:
            button.fbind("text", self._fit)
            button.fbind("width", self._fit)
        self.bind(brief=self._fit)
        self._fit()

    def _fit(self, *_: object) -> None:
        """One size of type for all buttons."""
        beside = self._size_in(theme.size_body, theme.size_icon + dp(8))
        self.cramped = beside < min(sp(14), dp(14))
        size = self._size_in(sp(14), 0.0) if self.flow == "vertical" else beside
        for button in self.ids.row.children:
            button.type_size = size

    def _size_in(self, largest: float, taken: float) -> float:
        """Size of type [px] in which each button's words have room beside what is `taken` [px]."""
        return min(
            fitting_size([one.text], largest, max(one.width - 2 * one.padding[0] - taken, 1.0), bold=True)
            for one in self.ids.row.children
        )

    def words(self, name: str) -> str:
        """What the button of a command says."""
        return tr(BRIEF.get(name, COMMANDS[name][0]) if self.narrow else COMMANDS[name][0])

    def show(self, msg: TaskStatus) -> None:
        """Offer what can be done in the task's state, and say what the robot says about it."""
        self.task_state, self.reason = msg.state, msg.reason

    def ask(self, name: str) -> None:
        """Ask for a command as a finger would; KeyError when there is no such command."""
        self.command = COMMANDS[name] and name
        self.dispatch("on_command", name)

    def answer(self, name: str, outcome: str, why: str = "", took: float = math.nan, what: str = "") -> None:
        """Say what became of a command: `sent`, `accepted`, `refused` (and why) or `no_reply`, after `took` [s].

        `what` is the command in words, where it is not what the button says, as in `start heading 120°`.
        """
        self.command, self.why, self.took, self.what, self.outcome = name, why, took, what, outcome
        self._told.cancel()
        if outcome in OUTCOME_TIMEOUTS:
            self._told = Clock.schedule_once(lambda _: self._forget(), OUTCOME_TIMEOUTS[outcome])

    def _forget(self) -> None:
        self._told.cancel()
        self.outcome = "none"

    def _contradict(self, *_: object) -> None:
        """What was accepted holds no longer when STOP is pressed or the task went on to something else."""
        if self.outcome == "accepted" and (self.held or self.task_state != LEADS_TO.get(self.command)):
            self._forget()


REASONS = {"RUNNING": "Driving to point 3 of 6.", "PAUSED": "Paused by tablet-B at point 2."}
"""What a robot says, for the samples."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Each state of a task and each outcome of a command."""

    def make(
        task_state: str = "IDLE", answer: tuple[Any, ...] = (), width: str = "360dp", **kwargs: Any
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            buttons = TaskButtons(size_hint_x=None, width=width, **kwargs)
            buttons.show(TaskStatus(state=task_state, reason=REASONS.get(task_state, "")))
            if answer:
                buttons.answer(*answer)
            return buttons

        return build

    return {
        "idle": make(width="420dp"),
        "sent": make(width="420dp", answer=("start", "sent")),
        "running": make("RUNNING"),
        "accepted": make("RUNNING", ("start", "accepted", "", 0.018)),
        "paused": make("PAUSED", ("pause", "accepted", "", 0.024)),
        "refused": make(
            answer=("start", "refused", "The mission has no points; set at least 1."), width="420dp"
        ),
        "refused, in two lines": make(
            answer=("start", "refused", "Home is not set; set it on the map first."), width="316dp"
        ),
        "no reply": make("RUNNING", ("home", "no_reply")),
        "disabled": make("RUNNING", state="disabled"),
        "would be refused": make(ready=False),
        "nothing to start": make(ready=False, empty=True),
        "held": make("PAUSED", held=True),
        "phone": make("RUNNING", brief=True, width="300dp"),
        "phone paused": make("PAUSED", brief=True, width="300dp"),
    }
