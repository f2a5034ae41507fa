"""The frame round every screen of a connected robot: top bar, navigation, banner, and STOP in its corner."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import BooleanProperty, ListProperty, ObjectProperty, OptionProperty, StringProperty
from kivy.uix.floatlayout import FloatLayout

import widgets.battery
import widgets.link_quality  # noqa: F401
from app import arrange
from app.commands import Outcome
from app.dashboard import Dashboard
from app.feeds import Post
from app.link import EVENT, OFFER, OUTCOME
from app.screens import standing
from app.screens.connect import THEMES
from app.screens.placing import put
from app.session import Session
from widgets import QuestionCard, StopButton
from widgets.kit import ActionToast, Banner, NavButton, Toast
from widgets.theme import theme

__all__ = ["Shell"]

BRIEF, LONG = 4.0, 10.0
"""How long a sentence stays over the screen, and one that is said once of a robot [s]."""
BAR = ("back", "name", "mode", "battery", "link", "satellites", "gap", "control")
"""What the top bar holds, from left to right; a narrow one only the first five."""
RAIL = ("drive", "mission", "tasks", "topics", "control_nav", "record", "theme")
"""Buttons of the navigation; elsewhere than on a phone the third from the end is in the bar."""
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
    BoxLayout:
        id: bar
        size_hint: None, None
        padding: (dp(4), 0) if root.form == 'tall' else (dp(6), 0, dp(16), 0)
        spacing: dp(5) if root.form == 'tall' else dp(12)
        canvas.before:
            Color:
                rgba: theme.surface
            Rectangle:
                pos: self.pos
                size: self.size
            Color:
                rgba: theme.line
            Rectangle:
                pos: self.pos
                size: self.width, theme.outline
        IconButton:
            id: back
            icon: 'arrow_back'
            role: 'muted'
            bare: True
            width: dp(46) if root.form != 'tall' else dp(38)
            pos_hint: {'center_y': .5}
            on_release: root.app.leave()
        Text:
            id: name
            text: root.robot_name
            bold: True
            font_size: theme.size_title if root.form != 'tall' else sp(17)
            shorten: root.form == 'tall'
            shorten_from: 'right'
            pos_hint: {'center_y': .5}
            size_hint_x: 1 if root.form == 'tall' else None
            text_size: (self.width, None) if root.form == 'tall' else (None, None)
            width: self.texture_size[0]
        Chip:
            id: mode
            icon: root.mode_icon if root.form != 'tall' else ''
            role: root.mode_role
            text: root.mode_text
            usual: 'STOPPED' if root.form == 'tall' else 'PAUSED · patrol'
            spacing: dp(8) if self.icon else 0
            edge: dp(13) if root.form != 'tall' else dp(10)
            outlined: True
            pos_hint: {'center_y': .5}
        BatteryChip:
            id: battery
            brief: root.form == 'tall'
            pos_hint: {'center_y': .5}
        LinkQuality:
            id: link
            brief: root.form != 'wide'
            pos_hint: {'center_y': .5}
        Chip:
            id: satellites
            icon: 'satellite_alt'
            role: root.fix_role
            text: root.fix_text
            pos_hint: {'center_y': .5}
        Widget:
            id: gap
        Chip:
            id: control
            icon: root.control_icon
            role: root.control_role
            text: root.control_text
            pressable: True
            pos_hint: {'center_y': .5}
            on_release: root.toggle_control()
    FloatLayout:
        id: nav
        size_hint: None, None
        canvas.before:
            Color:
                rgba: theme.surface
            Rectangle:
                pos: self.pos
                size: self.size
            Color:
                rgba: theme.line
            Rectangle:
                pos: (self.x, self.top - theme.outline) if root.form == 'tall' else (self.right - theme.outline, self.y)
                size: (self.width, theme.outline) if root.form == 'tall' else (theme.outline, self.height)
    BoxLayout:
        id: notices
        orientation: 'vertical'
        size_hint: None, None
        height: self.minimum_height
        spacing: dp(8)
""")


class Shell(FloatLayout):
    """Everything on the glass while a robot is connected."""

    app = ObjectProperty()
    session: Session = ObjectProperty()
    form = OptionProperty("wide", options=["wide", "short", "tall"])
    """Shape of the window, as in `app.arrange.form`."""
    screen = StringProperty("")
    """Name of the screen on the glass, as in `screens`."""
    robot_name = StringProperty("")
    mode_text = StringProperty("—")
    mode_icon = StringProperty("help")
    mode_role = StringProperty("muted")
    fix_text = StringProperty("—")
    fix_role = StringProperty("muted")
    control_text = StringProperty("")
    control_icon = StringProperty("help")
    control_role = StringProperty("muted")
    recording = BooleanProperty(False)
    rail = ListProperty()
    """Buttons of the navigation, in their order."""

    def __init__(self, screens: dict[str, Any], **kwargs: Any) -> None:
        """`screens` are the screens by name, each with `arrange`, `enter`, `leave`, `tick` and `rest`."""
        super().__init__(**kwargs)
        self.screens = screens
        self.stop = StopButton(size_hint=(None, None))
        self.stop.bind(on_command=self._stop, on_release_stop=self._release_stop)
        self.ids["stop"] = self.stop
        self.add_widget(self.stop, index=1)
        for name in BAR:  # kv holds ids weakly, and the narrow bar takes some of them out
            self.ids[name] = self.ids[name].__self__
        self._said = ""
        self._banner = Banner(level="danger")
        self._stop_banner = Banner(level="warn")
        for banner in (self._banner, self._stop_banner):
            banner.bind(height=self._place_notices)
        self.ids.notices.bind(height=self._place_notices)
        self._greeted = ""
        self.question = QuestionCard()
        self.question.bind(on_command=lambda _, name: self.session.command(name), height=self._place_notices)
        self.session.tasking.on_forgotten = self._offer_undo
        self._build_rail()
        self._dashboard = Dashboard(self.session.feeds)
        self._dashboard.bind(self.ids.battery, "/battery_state")
        self._dashboard.bind(self.question, "/task/status", fresh=False)
        self._dashboard.enter()
        self.session.listeners.append(self._hear)
        self._greet()
        self.bind(size=self._arrange, pos=self._arrange)
        theme.bind(target=self._arrange)
        self._arrange()

    def close(self) -> None:
        """Let go of the session."""
        self.rest()
        theme.unbind(target=self._arrange)
        if self._hear in self.session.listeners:
            self.session.listeners.remove(self._hear)
        self.session.tasking.deaf()
        for screen in self.screens.values():
            screen.leave()

    # navigation

    def _build_rail(self) -> None:
        entries: list[tuple[str, str, str, Callable[[], object]]] = [
            ("drive", "sports_esports", "Drive", lambda: self.app.show("drive")),
            ("mission", "map", "Mission", lambda: self.app.show("mission")),
            ("tasks", "list", "Tasks", lambda: self.app.show("tasks")),
            ("topics", "data_object", "Topics", lambda: self.app.show("topics")),
            ("control_nav", "person", "Control", self.toggle_control),
            ("record", "fiber_manual_record", "Record", self.app.toggle_recording),
            ("theme", "light_mode", "Sunlight", self.app.next_theme),
        ]
        for name, icon, text, act in entries:
            button = NavButton(icon=icon, text=text)
            button.bind(on_release=lambda _, act=act: act())
            self.ids[name] = button
            self.rail.append(button)

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

    def _show_rail(self) -> None:
        for name in self.screens:
            self.ids[name].active = self.screen == name
        icon, text, _ = THEMES[theme.name]
        self.ids.theme.icon, self.ids.theme.text = icon, text
        self.ids.record.tint = "danger" if self.recording else ""
        self.ids.record.icon = "fiber_manual_record_fill" if self.recording else "fiber_manual_record"
        self.ids.control_nav.icon = self.control_icon
        self.ids.control_nav.tint = "warn" if self.session.control == "other" else ""

    # places

    def _arrange(self, *_: object) -> None:
        dp = Metrics.density
        self.form = arrange.form(self.width, self.height, dp)
        places = arrange.shell(self.width, self.height, dp)
        for name in ("bar", "nav", "body"):
            put(self.ids[name], places[name])
        self._arrange_bar()
        self._arrange_rail(places["nav"], dp)
        if self.screen:
            screen = self.screens[self.screen]
            put(screen, places["body"])
            put(self.stop, screen.arrange(places["body"], self.form, dp))
        self._place_notices()

    def _arrange_bar(self) -> None:
        """The narrow bar leaves out what is said elsewhere."""
        bar, tall = self.ids.bar, self.form == "tall"
        wanted = list(BAR[:5] if tall else BAR)
        if self.form == "short" and self.width < 840 * Metrics.density:
            wanted.remove("satellites")
        widgets = [self.ids[name] for name in wanted]
        if list(reversed(bar.children)) != widgets:
            bar.clear_widgets()
            for widget in widgets:
                bar.add_widget(widget)

    def _arrange_rail(self, rect: arrange.Rect, dp: float) -> None:
        nav, tall = self.ids.nav, self.form == "tall"
        buttons = [self.ids[name] for name in RAIL]
        if not tall:
            buttons.remove(self.ids.control_nav)
        nav.clear_widgets()
        step = rect.width / len(buttons) if tall else min(72 * dp, (rect.height - 24 * dp) / len(buttons))
        high = min(64 * dp, step)
        for index, button in enumerate(buttons):
            nav.add_widget(button)
            button.framed = not tall
            button.size = (min(step, 82 * dp), rect.height) if tall else (rect.width - 12 * dp, high)
            button.pos_hint = {}
            if tall:
                button.pos = (rect.x + step * index + (step - button.width) / 2, rect.y)
            else:
                low = index >= 4
                y = (
                    rect.y + 12 * dp + (len(buttons) - 1 - index) * step
                    if low
                    else rect.top - 12 * dp - high - index * step
                )
                button.pos = (rect.x + 6 * dp, y)

    def _place_notices(self, *_: object) -> None:
        notices = self.ids.notices
        if self.screen:
            screen = self.screens[self.screen]
            room = screen.notice
            notices.width = min(560 * Metrics.density, room.width)
            # what is too much for its room goes up, never down over what can be touched
            low = max(room.y, room.top - notices.height)
            notices.pos = (room.x + (room.width - notices.width) / 2, low)
            if screen.video is not None:
                screen.video.below = low if notices.children else math.inf

    # what is heard

    def _hear(self, channel: str, post: Post) -> None:
        self._dashboard.deliver(channel, post.value)
        for screen in self.screens.values():
            screen.hear(channel, post)
        if channel == OUTCOME:
            self._show_outcome(post.value)
        elif channel == OFFER:
            self._greet()
        elif channel == EVENT:
            self.unsay(post.value.kind)
            if post.value.level == "alarm":
                self.app.alarm(post.value)

    def _greet(self) -> None:
        """Say once what is missing on a robot that is not ours."""
        offer = self.session.offer
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

    def say(self, text: str, level: str = "info", about: str = "", stay: float = BRIEF) -> None:
        """One sentence over the screen for `stay` [s]; `about` is the command or the kind of event it tells of."""
        self.unsay(self._said)
        self._said = about
        self.ids.notices.add_widget(Toast(text=text, level=level, stay=stay))
        self._place_notices()

    def _offer_undo(self, words: str, undo: Callable[[], None]) -> None:
        toast = ActionToast(text=f"Deleted: {words}.", action="Undo", stay=LONG)
        toast.bind(on_act=lambda _: undo())
        self.ids.notices.add_widget(toast)
        self._place_notices()

    def unsay(self, about: str) -> None:
        """Take the sentence away that was said about something: it is no longer true."""
        if about != self._said:
            return
        for child in list(self.ids.notices.children):
            if isinstance(child, Toast) and not isinstance(child, ActionToast):
                self.ids.notices.remove_widget(child)

    def tick(self) -> None:
        """Bring everything up to date that time changes; ten times a second."""
        self._tick_banner()
        self._tick_bar()
        self._dashboard.tick()
        self._tick_question()
        if self.stop.phase == "stopped" != self.session.stop_phase:
            for kind in ("stop", "task"):
                self.unsay(kind)
        self.stop.local = self.session.foreign or self.session.stop_latched
        self.stop.phase = self.session.stop_phase
        self._tick_stop()
        self._show_rail()
        if self.screen:
            self.screens[self.screen].tick()
        self._place_notices()

    def _tick_banner(self) -> None:
        session, notices = self.session, self.ids.notices
        if session.connected:
            if self._banner.parent is not None:
                notices.remove_widget(self._banner)
            return
        self.rest()
        wait = session.retry_in
        again = f" Trying again in {math.ceil(wait)} s." if wait > 0 else ""
        sentence = session.link_state.sentence
        self._banner.text = sentence + ("" if "Trying again" in sentence else again)
        if self._banner.parent is None:
            notices.add_widget(self._banner, index=len(notices.children))

    def _tick_stop(self) -> None:
        """What is known of a STOP that this handheld alone holds, for as long as it holds it."""
        session, banner = self.session, self._stop_banner
        drives = session.link.drive_topic is not None
        text = session.local_stop.sentence(drives, session.connected) if session.foreign else ""
        banner.text = text or banner.text
        banner.level = "ok" if session.stop_phase == "stopped" else "warn"
        if text and banner.parent is None:
            self.unsay("offer")
            self.ids.notices.add_widget(banner)
        elif not text and banner.parent is not None:
            self.ids.notices.remove_widget(banner)

    def _tick_bar(self) -> None:
        session = self.session
        self.robot_name = session.name
        self.mode_text, self.mode_icon, self.mode_role = standing.mode(session, brief=self.form == "tall")
        self.fix_text, self.fix_role = standing.fix(session)
        self.control_text, self.control_icon, self.control_role = standing.control(
            session, brief=self.form != "wide"
        )
        chip = self.ids.link
        chip.state = "live"
        chip.rtt, chip.lost = session.link.rtt, session.link.lost
        chip.silence = session.link.silence if session.connected and session.link.silent else 0.0
        chip.sentence = "" if session.connected else "no link"

    def _tick_question(self) -> None:
        """What the task asks is over every screen until it is answered."""
        card, notices = self.question, self.ids.notices
        card.blocked = not self.session.connected or self.session.control == "other"
        card.held = self.session.stop_latched
        if card.open == (card.parent is None):
            (notices.add_widget if card.open else notices.remove_widget)(card)

    # what is asked

    def toggle_control(self) -> None:
        """Take control, or give it up when it is ours; a robot without any says so."""
        if self.session.control == "none":
            self.say(
                "This robot knows no control: whoever pushes a stick drives it.", "info", about="control"
            )
            return
        if self.session.control == "mine":
            self.rest()
            self.session.release_control()
        else:
            self.session.take_control()

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
