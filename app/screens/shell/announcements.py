"""Sentences about what came from the robot, over every screen: answers that went wrong, alarms, tags, what it lacks."""

from __future__ import annotations

import math
from typing import Protocol

from app.link.channels import CAPABILITIES, EVENT, OUTCOME
from app.link.commands import Outcome
from app.link.feeds import Post
from app.missions.first_home import first_home
from app.screens.shell.notices import BRIEF_DURATION, LONG_DURATION
from app.screens.shell.reset_card import ResetPrompt
from app.session.session import Session
from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Event
from widgets.core.language import tr
from widgets.core.quantities import said

__all__ = ["Announcements"]

MAX_TAG_LENGTH = 40
"""Letters of a tag that are shown."""
PLACED_LATELY = 60.0
"""So long after a placing the robot's finding itself elsewhere overrules it [s, robot clock]."""


class Speaker(Protocol):
    """The frame, as far as announcements need it."""

    def say(self, text: str, level: str = "info", about: str = "", stay: float = BRIEF_DURATION) -> None:
        """Show one sentence for `stay` [s]."""

    def unsay(self, about: str) -> None:
        """Take the sentence about something away."""


class Announcements:
    """Decides what is said of one robot, and when it is true no longer."""

    def __init__(self, session: Session, speaker: Speaker, reset: ResetPrompt) -> None:
        """`reset` shows an alarm that it caused itself."""
        self._session, self._speaker, self._reset = session, speaker, reset
        self._greeting = ""
        self._homed = False

    def on_post(self, channel: str, post: Post) -> None:
        """Something came from the robot or its link."""
        if channel == OUTCOME:
            self._on_outcome(post.value)
        elif channel == "/tag":
            self._show_tag(post.value.tag)
        elif channel == CAPABILITIES:
            self.greet()
        elif channel == EVENT:
            self._on_event(post.value)
        elif channel == "/pose" and not self._homed:
            self._set_first_home()

    def _set_first_home(self) -> None:
        """Draw home where the robot is for the first time sure to be, once, and say so; only who may send it does."""
        session = self._session
        place = first_home(session.feeds, session.mission) if session.control == "mine" else None
        if place is not None:
            self._homed = True
            session.mission.set_home(*place)
            words = tr("Home is here, where the robot is now. It goes to the robot with the points.")
            self._speaker.say(words, "info", about="home")

    def greet(self) -> None:
        """Say once what is missing on a robot that is not ours."""
        offer = self._session.robot.capabilities
        if offer is not None and offer.sentence != self._greeting:
            self._greeting = offer.sentence
            if offer.sentence:
                self._speaker.say(offer.sentence, "info", about="offer", stay=LONG_DURATION)

    def tick(self) -> None:
        """Say what was missed."""
        if missed := self._session.logbook.news():
            self._speaker.say(missed, "info", about="missed")

    def _on_outcome(self, outcome: Outcome) -> None:
        """What went wrong is said over every screen; what went well is said where it was asked."""
        if outcome.phase in ("refused", "no_reply") and outcome.name != "stop":
            self._speaker.say(outcome.sentence, "warn", about=outcome.name)
        elif outcome.phase == "accepted":
            self._speaker.unsay(outcome.name)

    def _on_event(self, event: Event) -> None:
        self._speaker.unsay(event.kind)
        news = self._session.logbook.is_news(event, self._session.link.robot_time())
        if event.level == "alarm" and news and not self._reset.on_alarm(event):
            self._speaker.say(event.text, "danger", about=event.kind)
        elif event.code in (Code.POSITION_FOUND, Code.POSITION_UNSURE, Code.POSITION_UNSEEN) and news:
            # its place is what all that it does by itself goes by; by its own name, since "sure again" follows at once
            self._speaker.say(self._found_words(event), "warn", about=event.code, stay=LONG_DURATION)
        elif event.code == Code.DRIVE_NOT_RELEASED and news and self._session.link.driving:
            # whoever only watches pushes nothing
            self._speaker.say(event.text, "warn", about="stick")

    def _found_words(self, event: Event) -> str:
        """How far off the robot found itself from where it was put here a short while ago; else its own words."""
        at, x, y = self._session.placed
        told = {each.key: each.value for each in event.parameters}
        try:
            off = math.hypot(float(told["x"]) - x, float(told["y"]) - y)
        except (KeyError, ValueError):  # another program's robot leaves out what its code should name
            return event.text
        if event.code != Code.POSITION_FOUND or not abs(event.stamp.seconds - at) < PLACED_LATELY:
            return event.text
        distance = said(off, "height", 1).words
        return tr("It found itself {distance} from where you put it.").format(distance=distance)

    def _show_tag(self, tag: str) -> None:
        """The tag before the robot's reader, said once; empty when that is gone."""
        if tag:
            short = tag if len(tag) <= MAX_TAG_LENGTH else f"{tag[: MAX_TAG_LENGTH - 1]}…"
            self._speaker.say(tr("Tag read: {short}").format(short=short), "info", about="tag")
        else:
            self._speaker.unsay("tag")
