"""The frame round every screen of a connected robot: top bar, navigation, banner, and STOP in its corner."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import AliasProperty, BooleanProperty, ObjectProperty, OptionProperty, StringProperty
from kivy.uix.floatlayout import FloatLayout

from app.core.hand import hand
from app.inputs.methods import Methods
from app.intents.intents import Intents
from app.layout import arrange
from app.layout.arrange import Rect, StopPlace
from app.link.channels import CAPABILITIES, LINK, OUTCOME
from app.link.feeds import Post
from app.screens.parts.placing import put
from app.screens.parts.robot_screen import RobotScreen
from app.screens.parts.safe_area import safe_area
from app.screens.parts.screen_table import MORE
from app.screens.parts.themes import Themes
from app.screens.shell import status_text
from app.screens.shell.announcements import Announcements
from app.screens.shell.control_cards import ControlCards
from app.screens.shell.control_toggle import ControlToggle
from app.screens.shell.intent_prompts import IntentPrompts
from app.screens.shell.notices import BRIEF_DURATION, Notices
from app.screens.shell.rail import Rail
from app.screens.shell.reset_card import ResetPrompt
from app.screens.shell.screen_set import ScreenSet
from app.screens.shell.standing_banners import StandingBanners
from app.screens.shell.stop_display import StopDisplay
from app.screens.shell.task_question import TaskQuestion
from app.screens.shell.top_bar import TopBar
from app.screens.trust.people_dialog import PeopleDialog
from app.session.dashboard import Dashboard
from app.session.session import Session
from widgets.core.language import tr
from widgets.core.theme import theme

__all__ = ["Shell"]

STANDING = ("/control/status", "/task/status", "/robot/info", LINK, CAPABILITIES)
"""Channels that tell how the robot stands."""


Builder.load_string("""
<Shell>:
    FloatLayout:
        id: body
        size_hint: None, None
""")


def place_of_stop(place: Rect) -> StopPlace:
    """The place of STOP [px], with that of STOP ALL where the screen gave one."""
    alone = StopPlace(place.x, place.y, place.width, place.height)
    return place if isinstance(place, StopPlace) else alone


class Visit(Protocol):
    """The visit to the robot, as far as the frame needs it."""

    @property
    def draws_slowly(self) -> bool:
        """What is seen of it changes less often than usual, because this device takes long for a frame."""

    def toggle_recording(self) -> None:
        """Start recording, or finish the one that runs."""


class Leaving(Protocol):
    """The ways out, as far as the frame needs them."""

    def back(self) -> bool:
        """One step back, as the gesture does."""

    def leave(self, then: Callable[[], object] | None = None) -> None:
        """Leave the robot, where it moves after a question, and do `then`."""


class ShellHost(Protocol):
    """The app, as far as the frame of a robot's screens needs it."""

    intents: Intents
    methods: Methods
    themes: Themes

    @property
    def visit(self) -> Visit:
        """The visit to the robot."""

    @property
    def leaving(self) -> Leaving:
        """The ways out."""

    def show(self, screen: str) -> None:
        """Put the screen of that name on the glass."""

    def show_inputs(self) -> None:
        """Put the inputs on the glass."""


class Shell(FloatLayout):
    """Everything on the glass while a robot is connected."""

    app: ObjectProperty[ShellHost] = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()
    form = OptionProperty("wide", options=["wide", "short", "tall"])
    """Shape of the window, as in `app.layout.arrange.form`."""
    screen = StringProperty("")
    """Name of the screen on the glass, as in `screens`."""
    shares_stop = BooleanProperty(False)
    """STOP ALL is in STOP's corner as well."""

    def __init__(self, screens: ScreenSet, **kwargs: Any) -> None:
        """`screens` are the screens by name, each with `arrange`, `enter`, `leave`, `tick` and `rest`."""
        super().__init__(**kwargs)
        self.screens = screens
        self.stop_place = arrange.StopPlace(0, 0, 1, 1)
        """Where STOP is, alone or together with STOP ALL [px]."""
        self.control = ControlToggle(self.session, self.say)
        self._build_frame()
        self._question = TaskQuestion(self.session, self.notices)
        self.question = self._question.card
        self.standing = StandingBanners(self.session, self.notices, lambda puts: _show_map(self, puts))
        for widget in (*self.standing.banners, self._stop.banner, self.question, self.notices):
            widget.bind(height=self._place_notices)
        self._followers: list[Callable[[str, Post], None]] = []
        self.at_close: list[Callable[[], object]] = []
        """Called once it is closed."""
        self._stands: object = None
        """What was last said of the robot, as of `_look`."""
        self.session.tasking.on_forgotten = self._offer_undo
        self._dashboard = Dashboard(self.session.feeds)
        self._dashboard.bind(self.bar.ids.battery, "/battery_state")
        self._dashboard.bind(self.question, "/task/status", fresh=False)
        self.cards = ControlCards(self.session, self.notices, self._dashboard, self.say)
        self.reset = ResetPrompt(self.session, self.notices)
        self._announcements = Announcements(self.session, self, self.reset)
        self.wishes = IntentPrompts(self.app.intents, self.notices, self.say)
        self._dashboard.enter()
        self.session.listeners.append(self._hear)
        self._announcements.greet()
        self.bind(size=self._arrange, pos=self._arrange, shares_stop=self._arrange)
        self.nav.bind(talks=self._arrange)
        theme.bind(target=self._arrange)
        safe_area.bind(insets=self._arrange)
        self._arrange()

    def _build_frame(self) -> None:
        """Bar, navigation, STOP and what is said over them; the ids of their parts are found here too."""
        self.bar, self.nav, self.notices = TopBar(), Rail(), Notices()
        self.bar.bind(on_back=lambda _: self.app.leaving.back(), on_control=lambda _: self.toggle_control())
        self.bar.bind(on_people=lambda _: self.show_people(), on_more=lambda _: self.app.show(MORE))
        self.bar.bind(on_record=lambda _: self.app.visit.toggle_recording())
        self.bar.bind(on_mode=lambda _: self.cards.ask_mode(), on_inputs=lambda _: self.app.show_inputs())
        self.nav.bind(on_press=lambda _, name: self.app.show(name), on_talk=lambda _, down: self._talk(down))
        self._stop = StopDisplay(self.session, self.notices, self.rest)
        self.stop = self._stop.button
        for widget in (self.bar, self.nav, self.stop, self.notices):
            self.add_widget(widget)
        self.ids.update({**self.bar.ids, **self.nav.ids})
        self.ids.update({"bar": self.bar, "nav": self.nav, "stop": self.stop, "notices": self.notices})

    rail = AliasProperty(lambda shell: list(shell.nav.buttons))
    """Buttons of the navigation, in their order."""

    def close(self) -> None:
        """Let go of the session."""
        self.rest()
        theme.unbind(target=self._arrange)
        safe_area.unbind(insets=self._arrange)
        if self._hear in self.session.listeners:
            self.session.listeners.remove(self._hear)
        self.session.tasking.deaf()
        self.session.missions.deaf()
        self.session.drafts.deaf()
        self.session.logbook.listeners.clear()
        self.cards.close()
        self.wishes.close()
        self.screens.close()
        for let_go in self.at_close:
            let_go()

    # navigation

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

    def replace(self, name: str) -> None:
        """Have the screen of that name made anew, where it is made; where it is on the glass its controls rest first."""
        old = self.made(name)
        if old is None:
            return
        old.rest()
        self.screens.make_anew(name)
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
            waiting=self.session.logbook.asking,
            talk=getattr(self.app.methods.made("voice"), "sign", ""),
        )

    # places

    def settle(self) -> None:
        """Put everything into its place anew: what is on the glass of a screen is another."""
        self._arrange()

    def places(self, inside: Rect) -> dict[str, Rect]:
        """Of bar, navigation and body in a window of which `inside` is free, as in `app.layout.arrange.shell`."""
        talks, target = self.nav.talks, _least(self.width, self.height)
        size = self.width, self.height, Metrics.density
        return arrange.shell(*size, talks=talks, inside=inside, target=target, left_hand=hand.left)

    def _arrange(self, *_: object) -> None:
        dp = Metrics.density
        self.form = arrange.form(self.width, self.height, dp)
        inside = safe_area.within(self.width, self.height)
        places = self.places(inside)
        put(self.bar, places["bar"])
        put(self.ids.body, places["body"])
        self.bar.arrange(self.form)
        self.nav.at_right = hand.left
        self.nav.arrange(places["nav"], self.form, dp)
        if self.screen:
            screen = self.screens[self.screen]
            room = places["body"]
            put(screen, room)
            size = room.x, room.y, room.width, room.height
            body = arrange.Body(*size, self.shares_stop, hand.left, theme.least)
            self.stop_place = place_of_stop(screen.arrange(body, self.form, dp))
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
        self.screens.on_post(channel, post)
        if channel in STANDING:
            self._look()
        if channel in (OUTCOME, "/control/status"):
            self._stop.show()
        if channel == OUTCOME:
            self._question.on_outcome(post.value)
        self._announcements.on_post(channel, post)
        if channel == OUTCOME:
            self.cards.on_outcome(post.value)
            self.reset.on_outcome(post.value)

    def _look(self) -> None:
        """Say in the same frame what the robot is and who has it, as soon as that is another."""
        stands = status_text.standing(self.session)
        if stands != self._stands:
            self._stands = stands
            self.tick()

    def say(self, text: str, level: str = "info", about: str = "", stay: float = BRIEF_DURATION) -> None:
        """One sentence over the screen for `stay` [s]; `about` is the command or the kind of event it tells of."""
        self.notices.say(text, level, about, stay)
        self._place_notices()

    def unsay(self, about: str) -> None:
        """Take the sentence away that was said about something: it is no longer true."""
        self.notices.unsay(about)

    def _offer_undo(self, words: str, undo: Callable[[], None]) -> None:
        self.notices.offer(tr("Deleted: {words}.").format(words=words), tr("Undo"), undo)
        self._place_notices()

    def tick(self) -> None:
        """Bring everything up to date that time changes; ten times a second."""
        if not self.session.connected:
            self.rest()
        mapped, slow = self.screen == "mission", self.app.visit.draws_slowly
        self.standing.tick(slow=slow, tight=self.form != "wide", mapped=mapped)
        self.bar.tick(self.session)
        self.bar.show_methods(self.app.methods.standing(), self.app.methods.idle())
        self._dashboard.tick()
        _share_room(self.form, self._question, self.wishes, self.cards, self.reset)
        self.cards.tick(self.screen)
        self.reset.tick()
        self._stop.show()
        self._stop.tick()
        self.control.tick()
        self._show_rail()
        self._announcements.tick()
        if self.screen:
            self.screens[self.screen].tick()
        self._place_notices()

    # what is asked

    def toggle_control(self) -> None:
        """A tap on control, as `ControlToggle.toggle` has it."""
        self.control.toggle(self.parent)

    def show_people(self) -> None:
        """Who has a key of the robot, over the page."""
        self.parent.add_widget(PeopleDialog(self.session))

    def back(self) -> bool:
        """Back within the screen that is on the glass; False when it has nowhere to go back to."""
        return self.shown is not None and self.shown.back()

    @property
    def shown(self) -> RobotScreen | None:
        """The screen on the glass; None before there is one."""
        return self.made(self.screen)

    def made(self, name: str) -> RobotScreen | None:
        """The screen of that name; None where it was not needed yet."""
        return self.screens.made.get(name)

    def rest(self) -> None:
        """Every control of every screen lets go."""
        for screen in self.screens.made.values():
            screen.rest()
        self.stop.rest()


def _least(width: float, height: float) -> float:
    """Least width and height of bar and navigation [px]; 0 on a phone's side without gloves, where a finger hits what is in them from beside them too."""
    beside = arrange.form(width, height, Metrics.density) == "short" and not theme.gloves
    return 0.0 if beside else float(theme.least)


def _share_room(
    form: str, question: TaskQuestion, wishes: IntentPrompts, cards: ControlCards, reset: ResetPrompt
) -> None:
    """Bring the robot's question up to date, and let cards give way to each other where there is little room."""
    # a phone on its side has room for one card: the one that counts down goes first
    short = form == "short"
    question.tick(tight=short, gives_way=short and cards.handover.parent is not None)
    wishes.tight = short and wishes.card.parent is not None
    cards.alone = form != "wide"
    others = question.card, reset.card
    cards.yields = wishes.tight or (cards.alone and any(card.parent is not None for card in others))


def _show_map(shell: Shell, places: bool) -> None:
    """Show the map; a finger on it says where the robot is if it `places`."""
    if "mission" in shell.screens:
        shell.app.show("mission")
        screen: Any = shell.screens["mission"]
        screen.mode = "place_robot" if places else "view"
