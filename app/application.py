"""The app as a whole: what it owns, what it shows, and what the life of a phone does to it."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kivy.app import App
from kivy.clock import Clock
from kivy.core.window import Window

from app.core.client_identity import client_identity
from app.core.low_memory import make_room
from app.core.preferences import Preferences
from app.core.returning import Returning
from app.core.settings_store import Settings
from app.device import device_name, own_folder
from app.device.documents import documents
from app.garbage_collector import Collector
from app.idle_work import get_ready
from app.inputs.inputs import Inputs
from app.inputs.methods import Methods
from app.inputs.motion.motion_sensing import MotionSensing
from app.intents.intent_executor import IntentExecutor
from app.intents.intents import Intents
from app.intents.method_permits import MethodPermits
from app.layout.layout_choice import LayoutChoice
from app.leaving import Leaving
from app.link.feeds import Post
from app.network_side import NetworkSide
from app.opened_profiles import OpenedProfiles
from app.pages import LONE, Pages, lone_page
from app.profiles.profile_choice import ProfileChoice
from app.profiles.profile_store import ProfileStore
from app.renewal import Renewal
from app.robot_directory import RobotDirectory
from app.robot_visit import RobotVisit
from app.root import Root
from app.screens.connect.connect import ConnectScreen
from app.screens.connect.simulator_launcher import SimulatorLauncher
from app.screens.parts.screen_table import names
from app.screens.parts.themes import Themes
from app.screens.shell.stop_corner import StopCorner
from app.session.recordings import Recordings
from app.showing import Showing
from app.sounds.sounds import Sounds
from app.timers import TICK_EVERY, Timers
from widgets import CATALOGUE

if TYPE_CHECKING:
    from app.screens.shell.shell import Shell  # made when there is a robot, for a quick start
    from app.session.session import Session

__all__ = ["PilothouseApp"]

SWITCH_INTERVAL = 0.001
"""How long one thread may keep the others waiting for Python [s]: drawing must not delay the network."""


class PilothouseApp(Showing, App):
    """The handheld. Everything here happens in the UI thread."""

    title = "Pilothouse"
    icon = str(Path(__file__).with_name("icon.png"))
    use_kivy_settings = False
    sensing: MotionSensing
    """The motion sensors; made with the input methods."""

    def __init__(
        self,
        url: str | None = None,
        screen: str | None = None,
        theme: str | None = None,
        layout: str | None = None,
        settings_dir: Path | str | None = None,
        simulator: Sequence[str] | None = None,
        *,
        pair: Sequence[str] = (),
        discover: bool = True,
        poll: bool = False,
        tour: bool = False,
        now: Callable[[], float] = time.monotonic,
        **kwargs: Any,
    ) -> None:
        """`url` is connected to at once, robots whose links are in `pair` are paired with unasked; `screen` is shown once connected, `inputs` without a robot too.

        `theme` overrides the remembered one, `layout` the one that is made for the robot; `simulator` is the command that starts the built-in simulator;
        `discover` listens to robots saying HELLO; `tour` begins the first look round where nobody has seen it; `poll` looks for fingers once more a frame, and before it is drawn, as a desktop needs it. Raises LayoutError for a layout that cannot be shown.
        """
        super().__init__(**kwargs)
        self._url, self._first_screen, self._theme, self._pair = url, screen or "mission", theme, pair
        self.layouts, self._settings_dir = LayoutChoice(CATALOGUE, layout), settings_dir
        self.simulating = SimulatorLauncher(self, simulator, self.say, now)
        self._discover, self._poll, self._tours, self._looks = discover, poll, tour, 0
        self.now = now
        """Our clock [s]."""

    # life

    def build(self) -> Root:
        """Make the connect screen; the others are made when there is a robot to show."""
        folder = Path(self._settings_dir or own_folder(lambda: self.user_data_dir))
        self.settings = Settings(folder)
        self.profiles = ProfileChoice(
            self.layouts, ProfileStore(folder / "profiles", CATALOGUE), self.settings
        )
        kept = folder if self._settings_dir is not None else documents(folder)
        self.records = Recordings(kept, self.say, old=folder)
        self.preferences, self.returning = Preferences(self.settings), Returning(self, names())
        self.themes = Themes(self.settings, self._theme)
        self.client_id = client_identity(self.settings)
        self.client_name = str(self.settings.get("client_name") or device_name())
        self.connect = ConnectScreen(app=self, can_simulate=self.simulating.possible)
        self.robot_list = RobotDirectory(self, self.settings, self.client_name, self.now)
        root = Root()
        self.pages = Pages(root, self.connect, lambda name: lone_page(self, name), self._first_screen)
        self.acting = IntentExecutor(self)
        self.acting.on_help = self.toggle_help
        self.intents = Intents(self.acting, MethodPermits(self.settings), self.now)
        self.methods = Methods(self)
        self.fleet = self.robot_list.fleet(self.client_id)
        self.corner = StopCorner(self, self.fleet, self.say)
        self.visit, self.leaving = self._make_visit(), Leaving(self)
        self.renewal, self.sounds = Renewal(self), Sounds(self.settings)
        self.opened = OpenedProfiles(self, self.profiles, self.robot_list.trust)
        self.preferences.on_anew = self.renewal.ask
        root.over = self.corner.layer
        self.pages.show_connect()
        return root

    def _make_visit(self) -> RobotVisit:
        return RobotVisit(
            self.pages,
            self.connect,
            self.records,
            connector=lambda: self._network.connector,
            make_shell=self._make_shell,
            rest=self._rest,
            on_cut=self._cut,
            on_left=self._left,
            ask_to_pair=self.robot_list.trust.ask,
            pacer=lambda: self.timers.pacer,
            now=self.now,
        )

    def on_start(self) -> None:
        """Open the network and begin to look at the clock."""
        sys.setswitchinterval(SWITCH_INTERVAL)
        self.collector = Collector()
        self._network = NetworkSide(
            self.settings,
            self.records,
            client_id=self.client_id,
            client_name=self.client_name,
            key_for=self.robot_list.trust.key_for,
            deliver=self._deliver,
            discover=self._discover,
            now=self.now,
        )
        self.mailbox, self.robot_list.trust.attempts = self._network.mailbox, self._network.pairing
        self.timers = Timers(self._look, self._beat, self._list, lambda: self.inputs.pushed, poll=self._poll)
        self.inputs: Inputs = Inputs(self, self.now)
        self.inputs.open()
        self.methods.open()
        Window.allow_screensaver = False
        Window.bind(on_memorywarning=make_room)
        self.pages.on_show = self.corner.tick  # STOP ALL is never where STOP is, not for a frame
        self._idle = get_ready(self)
        self._list()
        self.opened.begin()
        self.robot_list.trust.begin(self._pair)
        if self._url:
            self.returning.forget()
            self.open(self._url)
        elif screen := self.returning.begin():
            self.pages.screen = screen
        elif self._first_screen in LONE:
            self._show_anywhere(self._first_screen)
        if self._tours and not self._url and self.session is None:
            self.begin_tour_if_new()

    def on_stop(self) -> None:
        """Leave the robot at rest, end every thread and the simulator."""
        Window.unbind(on_memorywarning=make_room)
        self._idle.close()
        self.opened.close()
        self.renewal.close()
        self.end_tour()
        self.sounds.close()
        self.methods.close()
        self.inputs.close()
        self.timers.close()
        self.leave()
        self.pages.close_lone()
        self.fleet.close()
        self.records.stop()
        if "maps" in vars(self):
            self.maps.close()
        self._network.close()
        self.simulating.close()
        self.settings.close()
        self.preferences.close()
        self.collector.close()

    def on_pause(self) -> bool:
        """The glass is taken away: rest, and let go of the robot; the patrol goes on without us."""
        self.inputs.rest()
        self.methods.pause()
        self.corner.leave(self.session)
        self.visit.suspend()
        self.records.stop()
        robot = (
            None if self.simulating.current else self.session
        )  # a simulator of this device ends with the app
        watched = robot is not None and not robot.authority.wanted
        self.returning.put_away(robot.link.url if robot else "", self.pages.screen, watch=watched)
        self.collector.pause()
        return True

    def on_resume(self) -> None:
        """Come back: connect again; whoever wants to drive has to push the stick anew."""
        self.returning.forget()
        self.collector.resume()
        self.methods.resume()
        self.visit.resume()

    def back(self) -> bool:
        """As `Leaving.back`."""
        return self.leaving.back()

    # what comes in

    def _look(self) -> None:
        """Take in what is not urgent."""
        self._network.drain_if_due()
        self._looks += 1
        if self._looks % TICK_EVERY == 0:  # in the same frame: one of its own would be drawn for it
            self._tick()
        self.collector.step(pushed=self.timers.pacer.touched or self.inputs.pushed)

    def _deliver(self, channel: str, post: Post) -> None:
        if self.robot_list.on_post(channel, post) or self.simulating.on_post(channel, post):
            return
        self.visit.deliver(channel, post)
        self.sounds.hear(channel, post.value)
        if channel == "/robot/info" and self.session is not None:
            self.robot_list.on_info(self.session.link.url, post.value)

    def _beat(self) -> None:
        self.inputs.update()
        self.methods.update(self.now())
        if self.session is not None:
            self.session.link.beat()

    def _tick(self) -> None:
        self.corner.tick()
        self.pages.tick_lone()
        if self.session is None or self.shell is not None:
            self._say_problems()
        self.visit.tick()

    # the list of robots

    def _list(self) -> None:
        if self.session is None:
            self.robot_list.show(self._network.nearby)
            self.connect.ids.inputs.show(self.methods.standing(), self.methods.idle())

    # a robot

    def open(self, url: str, *, watch: bool = False) -> None:
        """Connect to a robot, or pair by its link; with `watch` without asking for control. Its screens come when it answers.

        The robot that is on the glass is left by `Leaving.leave`, which may ask first.
        """
        if not self.robot_list.trust.asks_first(url):
            go = partial(self.visit.open, url, wants_control=not watch, on_rest=self.inputs.rest)
            self.leaving.leave(go)

    def leave(self) -> None:
        """Back to the connect screen; the robot goes on with what it does."""
        self.visit.leave()

    def _rest(self) -> None:
        self.intents.rest()
        self.inputs.rest()

    def _cut(self, shell: Shell | None) -> None:
        """The link is about to be closed: STOP and STOP ALL go on over links of their own."""
        if shell is not None:
            self.collector.expect(shell)
        self.corner.leave(self.session)

    def _left(self) -> None:
        self.corner.tick()
        self._list()

    def _make_shell(self, session: Session) -> Shell:
        from app.screens.robot_screens import robot_shell

        self.methods.open_rest()  # none of them misses what a robot says
        self.robot_list.on_answer(session)
        Clock.schedule_once(lambda _: self.returning.tell())
        return robot_shell(self, session, self.profiles, size=self.pages.root.size, pos=self.pages.root.pos)
