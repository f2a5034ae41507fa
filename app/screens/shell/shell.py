"""The frame round every screen of a connected robot: top bar, navigation, banner, and STOP in its corner."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import AliasProperty, BooleanProperty, ObjectProperty, OptionProperty, StringProperty
from kivy.uix.floatlayout import FloatLayout

from app.layout import arrange
from app.link.channels import EVENT, LINK, OFFER, OUTCOME
from app.link.commands import Outcome
from app.link.feeds import Post
from app.screens.parts.placing import put
from app.screens.shell import status_text as standing
from app.screens.shell.control_cards import ControlCards
from app.screens.shell.intent_prompts import Wishes
from app.screens.shell.notices import BRIEF, LONG, Notices
from app.screens.shell.rail import Rail
from app.screens.shell.reset_card import Resetting
from app.screens.shell.top_bar import TopBar
from app.session.dashboard import Dashboard
from app.session.session import Session
from app.stop.stop_state import silence
from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets import QuestionCard, StopButton
from widgets.core.base import age_text
from widgets.core.theme import theme
from widgets.parts.kit import Banner

__all__ = ["Shell"]

STANDING = ("/control/status", "/task/status", "/robot/info", LINK, OFFER)
"""Channels that tell how the robot stands."""
LONGEST_TAG = 40
"""Letters of a tag that are shown."""

Builder.load_string("""
<Shell>:
    canvas.before:
        Color:
            rgba: theme.bg
        Rectangle:
            pos: self.pos
            size: self.size
    FloatLayout:
        id: body
        size_hint: None, None
""")


class Shell(FloatLayout):
    """Everything on the glass while a robot is connected."""

    app = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()
    form = OptionProperty("wide", options=["wide", "short", "tall"])
    """Shape of the window, as in `app.layout.arrange.form`."""
    screen = StringProperty("")
    """Name of the screen on the glass, as in `screens`."""
    recording = BooleanProperty(False)
    shares_stop = BooleanProperty(False)
    """STOP ALL is in STOP's corner as well."""

    def __init__(self, screens: dict[str, Any], **kwargs: Any) -> None:
        """`screens` are the screens by name, each with `arrange`, `enter`, `leave`, `tick` and `rest`."""
        super().__init__(**kwargs)
        self.screens = screens
        self.stop_place = arrange.StopPlace(0, 0, 1, 1)
        """Where STOP is, alone or together with STOP ALL [px]."""
        self._build_frame()
        self._banner = Banner(level="danger")
        self._stop_banner = Banner(level="warn")
        self.question = QuestionCard()
        self.question.bind(on_command=lambda _, name: self.session.command(name))
        for widget in (self._banner, self._stop_banner, self.question, self.notices):
            widget.bind(height=self._place_notices)
        self._greeted = ""
        self._followers: list[Callable[[str, Post], None]] = []
        self._stands: object = None
        """What was last said of the robot, as of `_look`."""
        self.session.tasking.on_forgotten = self._offer_undo
        self._dashboard = Dashboard(self.session.feeds)
        self._dashboard.bind(self.bar.ids.battery, "/battery_state")
        self._dashboard.bind(self.question, "/task/status", fresh=False)
        self.cards = ControlCards(self.session, self.notices, self._dashboard, self.say)
        self.reset = Resetting(self.session, self.notices)
        self.wishes = Wishes(self.app.intents, self.notices, self.say)
        self._dashboard.enter()
        self.session.listeners.append(self._hear)
        self._greet()
        self.bind(size=self._arrange, pos=self._arrange, shares_stop=self._arrange)
        self.nav.bind(talks=self._arrange)
        theme.bind(target=self._arrange)
        self._arrange()

    def _build_frame(self) -> None:
        """Bar, navigation, STOP and what is said over them; the ids of their parts are found here too."""
        self.bar, self.nav, self.notices = TopBar(), Rail(), Notices()
        self.bar.bind(on_back=lambda _: self.app.leave(), on_control=lambda _: self.toggle_control())
        self.bar.bind(on_mode=lambda _: self.cards.ask_mode(), on_inputs=lambda _: self.app.show_inputs())
        self.nav.bind(on_press=lambda _, name: self._press(name), on_talk=lambda _, down: self._talk(down))
        self.stop = StopButton(size_hint=(None, None))
        self.stop.bind(on_command=self._stop, on_release_stop=self._release_stop)
        for widget in (self.bar, self.nav, self.stop, self.notices):
            self.add_widget(widget)
        self.ids.update({**self.bar.ids, **self.nav.ids})
        self.ids.update({"bar": self.bar, "nav": self.nav, "stop": self.stop, "notices": self.notices})

    def _rail(self) -> list[Any]:
        return list(self.nav.buttons)

    rail = AliasProperty(_rail)
    """Buttons of the navigation, in their order."""

    def close(self) -> None:
        """Let go of the session."""
        self.rest()
        theme.unbind(target=self._arrange)
        if self._hear in self.session.listeners:
            self.session.listeners.remove(self._hear)
        self.session.tasking.deaf()
        self.session.missions.deaf()
        self.session.logbook.listeners.clear()
        self.cards.close()
        self.wishes.close()
        for screen in self.screens.values():
            screen.leave()

    # navigation

    def _press(self, name: str) -> None:
        acts: dict[str, Callable[[], object]] = {
            "control_nav": self.toggle_control,
            "record": self.app.visit.toggle_recording,
            "theme": self.app.themes.choose_next,
        }
        acts.get(name, lambda: self.app.show(name))()

    def _talk(self, down: bool) -> None:
        voice = self.app.methods.get("voice")
        if voice is not None:
            (voice.press if down else voice.release)()

    def go(self, name: str) -> None:
        """Put a screen on the glass; every control of the last one rests. KeyError for an unknown one."""
        screen = self.screens[name]
        if name == self.screen:
            return
        self.rest()
        if self.screen:
            self.screens[self.screen].leave()
        self.ids.body.clear_widgets()
        self.ids.body.add_widget(screen)
        self.screen = name
        self._arrange()
        screen.enter()
        self._show_rail()

    def replace(self, name: str, screen: Any) -> None:
        """Take another screen in the place of the one of that name; where that is on the glass its controls rest first."""
        old, self.screens[name] = self.screens[name], screen
        old.rest()
        if self.screen == name:
            old.leave()
            self.screen = ""
            self.go(name)

    def follow(self, hear: Callable[[str, Post], None]) -> None:
        """Tell `hear` what this frame hears, until it is closed."""
        self._followers.append(hear)

    def _show_rail(self) -> None:
        self.nav.show(
            self.screen,
            recording=self.recording,
            control=standing.control_nav(self.session),
            waiting=self.session.logbook.open,
            talk=getattr(self.app.methods.get("voice"), "sign", ""),
        )

    # places

    def settle(self) -> None:
        """Put everything into its place anew: what is on the glass of a screen is another."""
        self._arrange()

    def _arrange(self, *_: object) -> None:
        dp = Metrics.density
        self.form = arrange.form(self.width, self.height, dp)
        places = arrange.shell(self.width, self.height, dp, talks=self.nav.talks)
        put(self.bar, places["bar"])
        put(self.ids.body, places["body"])
        self.bar.arrange(self.form)
        self.nav.arrange(places["nav"], self.form, dp)
        if self.screen:
            screen = self.screens[self.screen]
            room = places["body"]
            put(screen, room)
            body = arrange.Body(room.x, room.y, room.width, room.height, self.shares_stop)
            self.stop_place = screen.arrange(body, self.form, dp)
            put(self.stop, self.stop_place)
        self._place_notices()

    def _place_notices(self, *_: object) -> None:
        if self.screen:
            self.notices.place(self.screens[self.screen])

    # what is heard

    def _hear(self, channel: str, post: Post) -> None:
        self._dashboard.deliver(channel, post.value)
        for follower in self._followers:
            follower(channel, post)
        for screen in self.screens.values():
            screen.hear(channel, post)
        if channel in STANDING:
            self._look()
        if channel in (OUTCOME, "/control/status"):
            self._show_stop()
        if channel == OUTCOME:
            self._show_outcome(post.value)
        elif channel == "/tag":
            self._show_tag(post.value.tag)
        elif channel == OFFER:
            self._greet()
        elif channel == EVENT:
            self.unsay(post.value.kind)
            news = self.session.logbook.is_news(post.value, self.session.link.robot_time())
            if post.value.level == "alarm" and news and not self.reset.take(post.value):
                self.say(post.value.text, "danger", about=post.value.kind)

    def _look(self) -> None:
        """Say in the same frame what the robot is and who has it, as soon as that is another."""
        session, status = self.session, self.session.control_status
        task: TaskStatus | None = session.feeds.latest("/task/status")
        told = (
            session.robot.name,
            session.link_state.phase,
            session.robot.capabilities,
            task and (task.task_id, task.state),
        )
        held = status and (status.mode, status.stopped, status.driver_id, status.requested_by_id)
        if (told, held) != self._stands:
            self._stands = told, held
            self.tick()

    def _greet(self) -> None:
        """Say once what is missing on a robot that is not ours."""
        offer = self.session.robot.capabilities
        if offer is not None and offer.sentence != self._greeted:
            self._greeted = offer.sentence
            if offer.sentence:
                self.say(offer.sentence, "info", about="offer", stay=LONG)

    def replay(self, post: Post) -> None:
        """An event that came before this frame was there."""
        for screen in self.screens.values():
            screen.hear(EVENT, post)

    def _show_outcome(self, outcome: Outcome) -> None:
        """What went wrong is said over every screen; what went well is said where it was asked."""
        if outcome.name in ("confirm", "resume", "cancel"):
            self.question.answer(outcome.label, outcome.phase, outcome.reason)
        if outcome.phase in ("refused", "no_reply") and outcome.name != "stop":
            self.say(outcome.sentence, "warn", about=outcome.name)
        elif outcome.phase == "accepted":
            self.unsay(outcome.name)
        self.cards.hear(outcome)
        self.reset.hear(outcome)

    def _show_tag(self, tag: str) -> None:
        """What the robot's reader has before it, said once; empty when that is gone."""
        if tag:
            short = tag if len(tag) <= LONGEST_TAG else f"{tag[: LONGEST_TAG - 1]}…"
            self.say(f"Tag read: {short}", "info", about="tag")
        else:
            self.unsay("tag")

    def say(self, text: str, level: str = "info", about: str = "", stay: float = BRIEF) -> None:
        """One sentence over the screen for `stay` [s]; `about` is the command or the kind of event it tells of."""
        self.notices.say(text, level, about, stay)
        self._place_notices()

    def unsay(self, about: str) -> None:
        """Take the sentence away that was said about something: it is no longer true."""
        self.notices.unsay(about)

    def _offer_undo(self, words: str, undo: Callable[[], None]) -> None:
        self.notices.offer(f"Deleted: {words}.", "Undo", undo)
        self._place_notices()

    def tick(self) -> None:
        """Bring everything up to date that time changes; ten times a second."""
        self._tick_banner()
        self.bar.tick(self.session)
        self.bar.show_methods(self.app.methods.standing(), self.app.methods.idle())
        self._dashboard.tick()
        self._tick_question()
        self.wishes.tight = self.form == "short" and self.wishes.card.parent is not None
        self.cards.alone = self.form != "wide"
        others = self.question, self.reset.card
        self.cards.yields = self.wishes.tight or (
            self.cards.alone and any(card.parent is not None for card in others)
        )
        self.cards.tick(self.screen)
        self.reset.tick()
        self._show_stop()
        self._tick_stop()
        self._show_rail()
        if missed := self.session.logbook.news():
            self.say(missed, "info", about="missed")
        if self.screen:
            self.screens[self.screen].tick()
        self._place_notices()

    def _show_stop(self) -> None:
        """What became of STOP; as soon as it is known, not when the next tick comes."""
        if self.stop.phase == "stopped" != self.session.robot_stop.phase:
            for kind in ("stop", "task"):
                self.unsay(kind)
        lost_for = self.session.robot_stop.lost_for
        self.stop.ago = "" if math.isnan(lost_for) else silence(lost_for)
        # without a link nothing can be let go, and nothing is offered to be held
        self.stop.local = self.session.connected and (
            self.session.robot.foreign or self.session.robot_stop.latched
        )
        self.stop.phase = self.session.robot_stop.phase

    def _tick_banner(self) -> None:
        session = self.session
        if not session.connected:
            self.rest()
            wait = session.retry_in
            again = f" Trying again in {math.ceil(wait)} s." if wait > 0 else ""
            self._banner.text = session.link_state.sentence + again
        self.notices.keep(self._banner, shown=not session.connected, first=True)

    def _tick_stop(self) -> None:
        """What is known of a STOP that this handheld alone holds, for as long as it holds it."""
        session, banner = self.session, self._stop_banner
        drives = session.link.drive_topic is not None
        text = session.robot_stop.local.sentence(drives, session.connected) if session.robot.foreign else ""
        banner.text = text or banner.text
        banner.level = "ok" if session.robot_stop.phase == "stopped" else "warn"
        if text and banner.parent is None:
            self.unsay("offer")
        self.notices.keep(banner, shown=bool(text))

    def _tick_question(self) -> None:
        """What the task asks is over every screen until it is answered."""
        card = self.question
        card.blocked = not self.session.may_ask
        card.held = self.session.robot_stop.latched
        card.tight = self.form == "short"
        card.old = "" if self.session.connected else age_text(self.session.feeds.age("/task/status"))
        # a phone on its side has room for one card: the one that counts down goes first
        waits = self.form == "short" and self.cards.handover.parent is not None
        self.notices.keep(card, shown=card.open and not waits)

    # what is asked

    def toggle_control(self) -> None:
        """Take control or ask for it, give it up, or take back that it is asked for; a robot without any says so."""
        if self.session.control == "none":
            self.say(
                "This robot knows no control: whoever pushes a stick drives it.", "info", about="control"
            )
            return
        self.session.authority.toggle()

    def _stop(self, *_: object) -> None:
        self.rest()
        self.session.stop()

    def _release_stop(self, *_: object) -> None:
        self.session.release_stop()

    def back(self) -> bool:
        """Back within the screen that is on the glass; False when it has nowhere to go back to."""
        step = getattr(self.screens.get(self.screen), "back", None)
        return bool(step is not None and step())

    def rest(self) -> None:
        """Every control of every screen lets go."""
        for screen in self.screens.values():
            screen.rest()
        self.stop.rest()
