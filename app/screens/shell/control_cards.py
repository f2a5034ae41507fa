"""Cards over the screens about control: hand-over, mode, a task paused by the stick, and a capped speed."""

from __future__ import annotations

from collections.abc import Callable

from kivy.metrics import Metrics

from app.link.commands import Outcome
from app.screens.shell.notices import LONG_DURATION, Notices
from app.session.dashboard import Dashboard
from app.session.session import Session
from app.session.steering import steering
from bridge.msgs.pilothouse_msgs import TaskQueue, TaskStatus
from widgets import HandoverCard, ModeCard, PausedCard, SpeedCap
from widgets.core.language import tr
from widgets.core.task_words import TASKS
from widgets.status.notice_card import TINY

__all__ = ["ControlCards"]

DRIVING = ("drive",)
"""Screens on which it matters how fast the robot may be driven."""
TASKLESS = ("drive", "topics")
"""Screens that do not show the task themselves."""
ABOUT = "authority"
"""What the sentences tell of."""

Say = Callable[..., None]
"""`Shell.say`."""


class ControlCards:
    """The cards of one robot and when each of them is on the glass."""

    def __init__(self, session: Session, notices: Notices, dashboard: Dashboard, say: Say) -> None:
        self._session, self._notices, self._say = session, notices, say
        self._unknown = False
        self.yields = False
        """There is no room now for what can wait."""
        self.alone = False
        """There is room for one card, as on a phone: the others wait until it is answered or gone."""
        self.handover = HandoverCard(me=session.own_id)
        self.mode, self.paused, self.cap = ModeCard(), PausedCard(client_id=session.own_id), SpeedCap()
        self._closed = self._pause_asked = False
        for card in (self.handover, self.mode, self.cap):
            dashboard.bind(card, "/control/status", fresh=False)
        dashboard.bind(self.paused, "/task/status", self._show_task, fresh=False)
        self.handover.bind(on_command=lambda _, name: self._answer(name))
        self.mode.bind(on_command=lambda _, name: self._choose(name))
        self.paused.bind(on_command=lambda _, name: self._resume(name))
        self.cap.bind(open=lambda card, is_open: None if is_open else notices.keep(card, shown=False))
        self.cap.bind(on_command=lambda _, value: session.command("setting", name="follow_link", value=value))
        session.authority.on_news = self._tell
        session.authority.on_past = lambda: notices.unsay(ABOUT)

    def close(self) -> None:
        """Hear of control no longer."""
        self._session.authority.on_news = lambda *_: None
        self._session.authority.on_past = lambda: None

    def ask_mode(self) -> None:
        """Open the choice of the mode, or close it."""
        self.mode.open = not self.mode.open

    def on_outcome(self, outcome: Outcome) -> None:
        """What became of a command."""
        name, phase = outcome.name, outcome.phase
        if name in ("grant", "object", "release"):
            self.handover.answer(phase)
        elif name == "setting" and outcome.fields.get("name") == "follow_link":
            self.cap.answer(phase)
        elif name == "mode":
            self.mode.answer(phase)
            if phase == "accepted":
                self._say(outcome.reason, "ok", about="mode")
        if name == "pause" or (name == "mode" and outcome.fields.get("mode") == "MANUAL"):
            self._pause_asked = phase in ("sent", "accepted")

    def tick(self, screen: str) -> None:
        """Bring up to date what time and the link change; `screen` is on the glass."""
        session, authority = self._session, self._session.authority
        other, unknown = authority.who == "other", authority.who == "unknown"
        if unknown and not self._unknown:
            self._notices.unsay(ABOUT)
        self._unknown = unknown
        self.handover.left = authority.left
        self._tick_mode(other=other)
        self.paused.held = session.link.driving
        self.cap.rtt = session.link.health.rtt
        self.cap.driver = authority.status.driver if other else ""
        self.cap.blocked = other
        self._place(screen, usable=session.connected and not session.robot.foreign, other=other)

    def _place(self, screen: str, *, usable: bool, other: bool) -> None:
        """Put on the glass what is open; where there is little room only what cannot wait."""
        tight = self._notices.width < TINY * Metrics.density
        asked, chosen = usable and self.handover.open, usable and self.mode.open
        free = usable and not self.yields and not (tight and (asked or chosen))
        paused = self.paused.open and not (
            self._closed or self._pause_asked or other or self._session.robot_stop.latched
        )
        paused, capped = free and paused and screen in TASKLESS, free and self.cap.open and screen in DRIVING
        if self.alone:
            chosen = chosen and not asked
            paused = paused and not (asked or chosen)
            capped = capped and not (asked or chosen or paused)
        self._notices.keep(self.handover, shown=asked, first=True)
        for card, shown in (
            (self.cap, capped),
            (self.paused, paused),
            (self.mode, chosen and not (tight and asked)),
        ):  # below the hand-over, which stays where it is under a finger
            self._notices.keep(card, shown=shown, first=True, under=self.handover)

    def _tick_mode(self, *, other: bool) -> None:
        session, card = self._session, self.mode
        card.open = card.open and session.connected
        task: TaskStatus | None = session.feeds.latest("/task/status")
        queue: TaskQueue | None = session.feeds.latest("/task/queue")
        card.task = TASKS[task.task].doing if task is not None and task.task in TASKS else ""
        waits = task is not None and task.state in ("PAUSED", "INTERRUPTED")
        how = steering(session)
        card.who = how.who if how else ""
        card.ready = waits or bool(queue is not None and queue.orders)
        if session.robot_stop.latched:
            card.why_not = tr("STOP is pressed; hold it to release.")
        else:
            card.why_not = (
                tr("{driver} has control.").format(driver=session.authority.status.driver) if other else ""
            )

    def _show_task(self, status: TaskStatus) -> None:
        self.paused.show(status)
        if status.state != "PAUSED":
            self._closed = False
        if status.state == "RUNNING":
            self._pause_asked = False

    def _answer(self, name: str) -> None:
        if name == "take_back":
            self._session.authority.take_back()
        else:
            self._session.command(name)

    def _choose(self, name: str) -> None:
        if name == "close":
            self.mode.open = False
        else:
            self._session.command("mode", mode=name)

    def _resume(self, name: str) -> None:
        if name == "close":
            self._closed = True
        else:
            self._session.command("resume")

    def _tell(self, text: str, level: str) -> None:
        self._say(text, level, about=ABOUT, stay=LONG_DURATION)
