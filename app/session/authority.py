"""Control of the robot, as this handheld knows it: its holder, the one who asks for it, and the time left.

The robot decides and tells everybody on `/control/status`; what is said here is what changed between two of those.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Protocol

from app.core.command_origin import NOBODY, origins
from app.link.feeds import Feeds
from app.session.robot_profile import RobotProfile
from bridge.core.link_state import CONTROL_TIMEOUT
from bridge.msgs.pilothouse_msgs import ControlStatus
from widgets.core.language import tr

__all__ = ["LAPSE_PERIOD", "Authority", "ControlledRobot", "Line"]

LAPSE_PERIOD = 60.0
"""Control that lapses again within this is said once, with how often it did [s]."""

News = Callable[[str, str], None]
"""A sentence for the operator and its level, as of a banner."""


class Line(Protocol):
    """The link to the robot, as far as control needs it."""

    @property
    def silence(self) -> float:
        """Time since anything came [s]; infinite before the first message."""

    def robot_time(self) -> float:
        """The robot's clock [s]; NaN while it is not known."""


class ControlledRobot(Protocol):
    """The session with one robot, as far as control needs it."""

    feeds: Feeds
    robot: RobotProfile

    @property
    def link(self) -> Line:
        """The link over which the robot is reached just now."""

    @property
    def connected(self) -> bool:
        """The link stands."""

    def now(self) -> float:
        """Our clock [s]."""

    def command(self, name: str, /, **fields: Any) -> None:
        """Send a one-shot command of `app.link.commands.COMMANDS`."""

    def rest(self) -> None:
        """Tell the robot to rest; the stick must be pushed anew."""

    @property
    def own_id(self) -> str:
        """The id by which the robot publishes this handheld."""


class Authority:
    """Control of one robot. Everything here happens in the UI thread."""

    def __init__(self, session: ControlledRobot, *, wants_control: bool) -> None:
        """`wants_control` takes control whenever it is free."""
        self._session = session
        self.wanted = wants_control
        """Control is taken whenever it is free; without it the robot is only watched."""
        self._claimed = False
        """Control was asked for since it became free."""
        self.on_news: News = lambda *_: None
        """Called with what the operator has to be told of a change."""
        self.on_past: Callable[[], object] = lambda: None
        """Called when what was told last is true no longer and nothing is told in its place."""
        self._before = ControlStatus()
        self._held = False
        """Control was ours, and nothing explains yet that it is not any more."""
        self._away = False
        """The link was gone since control was last known to be ours."""
        self._lapsed = ""
        """When control that was ours lapsed, in words, until it is had again or somebody else's."""
        self._lapses, self._lapsed_at = 0, -math.inf
        """How often control lapsed in a row, each time within `LAPSE_PERIOD` after the last, and when it did last [s]."""
        self._released = self._withdrawn = False
        """We gave control back, or took back that we ask for it."""

    # how it stands

    @property
    def status(self) -> ControlStatus:
        """The robot's last word; that of a robot without a driver before it said any."""
        return self._session.feeds.latest("/control/status") or ControlStatus()

    @property
    def who(self) -> str:
        """Who has control: `mine`, `free`, `other`, or `unknown` while the link is down, silent, or nothing was heard.

        `none` on a robot that is not ours: there is none to have, and whoever sends drives it.
        """
        session = self._session
        if session.robot.foreign and session.connected:
            return "none"
        status: ControlStatus | None = session.feeds.latest("/control/status")
        if status is None or not session.connected or session.link.silence > CONTROL_TIMEOUT:
            return "unknown"
        if not status.driver_id and not status.driver:
            return "free"
        return "mine" if status.driver_id == session.own_id else "other"

    @property
    def asking(self) -> bool:
        """This handheld asks somebody else for control."""
        return self.who == "other" and self.status.requested_by_id == self._session.own_id

    @property
    def asked(self) -> bool:
        """Another person asks this handheld for control."""
        return self.who == "mine" and bool(self.status.requested_by)

    @property
    def left(self) -> float:
        """Until it goes over to who asks [s]; NaN while nobody asks or the robot's clock is unknown."""
        if not self.status.requested_by:
            return math.nan
        left = self.status.handover.seconds - self._session.link.robot_time()
        return max(0.0, left) if math.isfinite(left) else math.nan

    # what is asked

    def toggle(self) -> None:
        """Give control up when it is ours, take back that we ask for it, else take it or ask for it."""
        if self.who == "mine":
            self.release()
        elif self.asking:
            self.take_back()
        else:
            self.acquire()

    def acquire(self) -> None:
        """Take control, or ask who has it; it is taken again after a reconnect."""
        session = self._session
        self.wanted = True
        self._released = self._withdrawn = False
        ask = self.who == "other" and session.robot.offers("/control/request")
        session.command("request" if ask else "acquire")

    def release(self) -> None:
        """Give control up, and do not ask for it again; a stick that went on being pushed would take it anew."""
        self._session.rest()
        self.wanted = False
        self._released = self._held
        self._session.command("release")

    def take_back(self) -> None:
        """Ask for control no longer."""
        self.wanted = False
        self._withdrawn = True
        self._session.command("release")

    # what is heard

    def on_link(self) -> None:
        """The link came or went."""
        self._away = self._away or not self._session.connected
        if self._session.connected:
            self._claimed = False
            self._claim()

    def on_status(self, status: ControlStatus) -> None:
        """The robot says who has control: report the change, and claim control that is wanted and free."""
        self._report(status)
        self._claim()

    def _claim(self) -> None:
        """Ask once each time that control becomes free."""
        if self.who == "unknown":
            return
        if self.who != "free":
            self._claimed = False
        elif self.wanted and not self._claimed:
            self._claimed = True
            with origins.during(NOBODY):
                self._session.command("acquire")

    def _report(self, status: ControlStatus) -> None:
        before, self._before = self._before, status
        news = self._end(before, status) or self._beginning(before, status)
        counted = False
        mine = status.driver_id == self._session.own_id
        if mine:
            counted = bool(self._lapsed) and self._lapses > 1  # what was said of that stays true
            news = news or self._regained()
            self._held, self._away = True, False
        elif self._held:
            news = news if self._released else self._lost(before, status)
            self._held = self._released = self._away = False
        if status.driver_id:
            self._lapsed = ""
        if news:
            self.on_news(*news)
        elif not counted and _parties(before) != _parties(status):
            self.on_past()

    def _regained(self) -> tuple[str, str] | None:
        """Control lapsed and is ours again: that it did must not go by unseen."""
        when, self._lapsed = self._lapsed, ""
        if self._lapses > 1:  # as it was counted
            return None
        words = tr("You have control again; it lapsed {when}.")
        return (words.format(when=when), "info") if when else None

    def _beginning(self, before: ControlStatus, status: ControlStatus) -> tuple[str, str] | None:
        """Who watches is told that somebody asks; who asks or is asked has a card for it."""
        me = self._session.own_id
        fresh = status.requested_by_id if status.requested_by_id != before.requested_by_id else ""
        if not fresh or me in (fresh, status.driver_id):
            return None
        return tr("{requested_by} asks {driver} for control.").format(
            requested_by=status.requested_by, driver=status.driver
        ), "info"

    def _end(self, before: ControlStatus, status: ControlStatus) -> tuple[str, str] | None:
        """What became of somebody's asking."""
        me, asker = self._session.own_id, before.requested_by_id
        if not asker or status.requested_by_id == asker:
            return None
        if status.driver_id == asker:
            return (
                (tr("You have control."), "ok")
                if asker == me
                else (tr("{driver} has control.").format(driver=status.driver), "info")
            )
        if asker == me and self._withdrawn:
            self._withdrawn = False
            return None
        if status.driver_id != before.driver_id or not status.driver_id:
            return None
        if status.driver_id == me:
            return tr("You keep control: {requested_by} does not ask any more.").format(
                requested_by=before.requested_by
            ), "info"
        return tr("{driver} keeps control.").format(driver=status.driver), "info"

    def _lost(self, before: ControlStatus, status: ControlStatus) -> tuple[str, str] | None:
        """Control was ours and is not: handed over to who asked, or lapsed."""
        if before.requested_by_id and status.driver_id == before.requested_by_id:
            self.wanted = False
            return tr("{driver} has control now.").format(driver=status.driver), "info"
        silence = tr("after {control_timeout:.0f} s without contact").format(control_timeout=CONTROL_TIMEOUT)
        when = tr("while the link was away") if self._away else silence
        again = self._count_lapse() if self.wanted and not status.driver else 1
        if again > 1:
            self._lapsed = when
            words = tr("Control lapsed {count} times, last {when}.")
            return words.format(count=again, when=when), "warn"
        free = tr("Requesting it again…") if self.wanted else tr("It is free.")
        now = tr("{driver} has it now.").format(driver=status.driver) if status.driver else free
        self._lapsed = when if self.wanted else ""
        return tr("Control lost {when}. {now}").format(when=when, now=now), "warn"

    def _count_lapse(self) -> int:
        """How often control has lapsed in a row now."""
        now = self._session.now()
        self._lapses = self._lapses + 1 if now - self._lapsed_at <= LAPSE_PERIOD else 1
        self._lapsed_at = now
        return self._lapses


def _parties(status: ControlStatus) -> tuple[str, str]:
    """Who drives and who asks."""
    return status.driver_id, status.requested_by_id
