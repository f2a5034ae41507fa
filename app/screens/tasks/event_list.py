"""Everything that happened, with who has seen to it and what was missed."""

from __future__ import annotations

import math
from typing import Any

from kivy.uix.boxlayout import BoxLayout

from app.session.logbook import MAX_EVENTS
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Event
from widgets import EventLog

__all__ = ["EventList"]


class EventList(BoxLayout):
    """The logbook as a list; brought up to date while it is on the glass."""

    def __init__(self, session: Session, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._session, self._book = session, session.logbook
        self.log = EventLog(most=MAX_EVENTS, state="live")
        self.add_widget(self.log)
        self.log.bind(on_command=lambda _, event: self._book.acknowledge([event]))
        self._stale, self._shown = True, False
        self._looked: set[tuple[str, int]] = set()
        self._book.listeners.append(self._changed)
        session.pictures.listeners.append(self._changed)

    def _changed(self) -> None:
        self._stale = True

    @property
    def waiting(self) -> list[Event]:
        """Warnings and alarms that nobody has seen to and of which the robot is not being told."""
        return [event for event in self._book.open if not self._book.is_asked(event)]

    @property
    def has_new_alarms(self) -> bool:
        """There are alarms that nobody has seen to and that were not on the glass yet."""
        return any(
            event.level == "alarm" and (event.boot, event.id) not in self._looked for event in self._book.open
        )

    def see_all(self) -> None:
        """All that wait have been seen to."""
        self._book.acknowledge(self.waiting)

    def enter(self) -> None:
        """Come onto the glass."""
        self._shown = True
        self.tick()

    def leave(self) -> None:
        """Leave the glass: what was missed has been looked at."""
        if self._shown:
            self._shown = False
            self._looked = {(event.boot, event.id) for event in self._book.open}
            self._book.clear_missed()

    def tick(self) -> None:
        """Bring up to date what time changes, and what came."""
        session, log = self._session, self.log
        if not self._shown:
            return
        clock = session.link.robot_time()
        if math.isfinite(clock) and not abs(clock - log.now) < 1.0:
            log.now = clock
        log.acts = session.connected and session.robot.offers("/events/acknowledge")
        if self._stale:
            self._stale = False
            events = self._book.events
            log.show_all(events)
            log.missed = [(one.boot, one.id) for one in self._book.missed]
            log.asked = [(one.boot, one.id) for one in events if self._book.is_asked(one)]
            log.head = self._book.words
            log.pictures = session.pictures.newest()
