"""The app as a whole: what it owns, what it shows, and what the life of a phone does to it."""

from __future__ import annotations

import logging
import math
import sys
import time
import uuid
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from kivy.app import App
from kivy.clock import Clock
from kivy.core.window import Window

from app.core.checked_settings import known
from app.core.notifications import tell
from app.core.settings_store import Settings
from app.device import device_name, is_android, own_folder
from app.discovery.beacon_listener import HELLO, LATENCY, Nearby
from app.discovery.known_robots import Robots, check_address
from app.garbage_collector import Collector
from app.inputs.inputs import Inputs
from app.inputs.methods import Methods
from app.intents.intent_executor import IntentExecutor
from app.intents.intents import Intents
from app.intents.method_permits import Permits
from app.layout.layout import Layout, choose, load, load_all
from app.link.camera_decoder import PICTURE, Camera
from app.link.commands import Commands
from app.link.event_order import Known
from app.link.feeds import Feeds, Mailbox, Post
from app.link.link import Link
from app.root import Root
from app.screens.connect.connect import ConnectScreen
from app.screens.connect.simulator_card import CHANNEL as SIMULATED
from app.screens.connect.simulator_card import Simulating
from app.screens.inputs.page import InputsPage
from app.screens.parts.dialogs import AddressDialog, Question
from app.screens.parts.themes import THEMES
from app.screens.shell.key_help import toggle_help
from app.screens.shell.stop_corner import StopCorner
from app.session.logbook import marks
from app.session.mission_editor import MissionEditor
from app.session.picture_feed import Pictures
from app.session.recordings import Records
from app.session.session import Session
from app.stop.fleet import Fleet
from bridge.core.camera_frames import Frame
from bridge.core.network_thread import NetworkThread
from bridge.msgs.pilothouse_msgs import Event
from widgets import CATALOGUE
from widgets.core.theme import theme

__all__ = ["PilothouseApp"]

log = logging.getLogger(__name__)

GLASS = 1 / 30
"""Between two looks at what came that is not urgent [s]."""
TICK = 3
"""Every so many of them what only time changes is brought up to date as well."""
BEAT = 0.03
"""Between two heartbeats of the user interface [s]; without one for 0.15 s the robot rests."""
LIST = 0.5
"""Between two looks at the list of robots [s]."""
SWITCH = 0.001
"""How long one thread may keep the others waiting for Python [s]: drawing must not delay the network."""


class PilothouseApp(App):
    """The handheld. Everything here happens in the UI thread."""

    title = "Pilothouse"
    icon = str(Path(__file__).with_name("icon.png"))
    use_kivy_settings = False

    def __init__(
        self,
        url: str | None = None,
        screen: str | None = None,
        theme: str | None = None,
        layout: str | None = None,
        settings_dir: Path | str | None = None,
        simulator: Sequence[str] | None = None,
        *,
        discover: bool = True,
        poll: bool = False,
        now: Callable[[], float] = time.monotonic,
        **kwargs: Any,
    ) -> None:
        """`url` is connected to at once; `screen` is shown once connected, `inputs` without a robot too.

        `theme` overrides the remembered one, `layout` the one that is made for the robot; `simulator` is the command that starts the built-in simulator;
        `discover` listens to robots saying HELLO; `poll` looks for fingers once more a frame. Raises LayoutError for a layout that cannot be shown.
        """
        super().__init__(**kwargs)
        self._url, self._first_screen, self._theme = url, screen or "mission", theme
        self._layouts = load_all(CATALOGUE)
        self._layout = load(layout, CATALOGUE) if layout is not None else None
        self._settings_dir = settings_dir
        self.simulating = Simulating(self, simulator, self._say, now)
        self._discover, self._poll, self._now = discover, poll, now
        self.now = now
        """Our clock [s]."""
        self.session: Session | None = None
        self.shell: Any = None
        """The frame round the robot's screens; None on the connect screen."""
        self._pictures = Pictures(now)
        self._unproven = ""
        """The address that was typed last, until something answers there."""
        self._drained, self._looks = -math.inf, 0

    # what tests and the demo look at

    @property
    def link(self) -> Link | None:
        """The link to the robot; None while none is wanted."""
        return self.session.link if self.session else None

    @property
    def feeds(self) -> Feeds | None:
        """The newest message of each topic; None while no robot is wanted."""
        return self.session.feeds if self.session else None

    @property
    def commands(self) -> Commands | None:
        """The one-shot commands; None while no robot is wanted."""
        return self.session.link.commands if self.session else None

    @property
    def mission(self) -> MissionEditor | None:
        """The mission being edited; None while no robot is wanted."""
        return self.session.mission if self.session else None

    @property
    def screens(self) -> dict[str, Any]:
        """Every screen there is now by its name: `connect`, and with a robot `mission`, `drive`, `tasks`, `topics` and `inputs`."""
        return {"connect": self.connect, **(self.shell.screens if self.shell else {})}

    # life

    def build(self) -> Root:
        """Make the connect screen; the others are made when there is a robot to show."""
        folder = Path(self._settings_dir or own_folder(lambda: self.user_data_dir))
        self.settings = Settings(folder)
        self.records = Records(folder, self._say)
        theme.name = self._theme or self._remembered_theme()
        self.client_id = self._identity()
        self.client_name = str(self.settings.get("client_name") or device_name())
        self.robots = Robots(self._now, self.settings.get("robots") or ())
        self.acting = IntentExecutor(self)
        self.acting.on_help = partial(toggle_help, self)
        self.intents = Intents(self.acting, Permits(self.settings), self._now)
        self.methods = Methods(self)
        self.inputs_page = InputsPage(app=self)
        """Where methods are set up while there is no robot."""
        self.connect = ConnectScreen(app=self, can_simulate=self.simulating.possible)
        self.fleet = Fleet(client_id=self.client_id, client_name=self.client_name, now=self._now)
        self.corner = StopCorner(self, self.fleet, self._say)
        root = Root()
        root.over = self.corner.layer
        root.show_page(self.connect)
        return root

    def _remembered_theme(self) -> str:
        name = self.settings.get("theme")
        return name if known(name, THEMES) else "dark"

    def _identity(self) -> str:
        if not isinstance(self.settings.get("client_id"), str):
            self.settings.set("client_id", uuid.uuid4().hex)
        return str(self.settings.get("client_id"))

    def on_start(self) -> None:
        """Open the network and begin to look at the clock."""
        sys.setswitchinterval(SWITCH)
        self.collector = Collector()
        make = getattr(Clock, "create_trigger_free", None) if hasattr(Clock, "get_min_free_timeout") else None
        wake = (make or Clock.create_trigger)(lambda _: self._drain(), 0)
        self.mailbox = Mailbox(wake)
        self.network = NetworkThread()
        self.camera = Camera(self.mailbox)
        self.nearby = Nearby(self.mailbox, self.network, now=self._now)
        if self._discover:
            self.nearby.start()
        self._events = [
            Clock.schedule_interval(lambda _: self._look(), GLASS),
            Clock.schedule_interval(lambda _: self._beat(), BEAT),
            Clock.schedule_interval(lambda _: self._list(), LIST),
        ]
        if self._poll:  # Kivy hands a touch on two frames after it came; this saves one of them
            self._events.append(Clock.schedule_interval(lambda _: Window.mainloop(), 0))
        self.inputs = Inputs(self, self._now)
        self.inputs.open()
        self.methods.open()
        Window.allow_screensaver = False
        self._list()
        if self._url:
            self.open(self._url)
        elif self._first_screen == "inputs":
            self.show_inputs()

    def on_stop(self) -> None:
        """Leave the robot at rest, end every thread and the simulator."""
        self.methods.close()
        self.inputs.close()
        for event in self._events:
            event.cancel()
        self.fleet.close()
        self.leave()
        self.stop_recording()
        self.nearby.close()
        self.camera.close()
        self.network.close()
        self.simulating.close()
        self.settings.close()
        self.collector.close()

    def on_pause(self) -> bool:
        """The glass is taken away: rest, and let go of the robot; the patrol goes on without us."""
        self.inputs.rest()
        self.methods.pause()
        self.fleet.look(None)
        if self.session is not None:
            self.session.link.close(0.3)
        self.stop_recording()
        self.collector.pause()
        return True

    def on_resume(self) -> None:
        """Come back: connect again; whoever wants to drive has to push the stick anew."""
        self.collector.resume()
        self.methods.resume()
        if self.session is not None:
            self.session.resume(self._new_link(self.session.link.url, self.session.logbook.known))
            self._pictures.ask_again()

    def back(self) -> bool:
        """Back closes a question, then leaves the robot; on the connect screen it is left to the system."""
        dialogs = [child for child in self.root.children if isinstance(child, Question)]
        if dialogs:
            dialogs[0].close()
            return True
        if self.session is not None:
            if self.shell is None or not self.shell.back():
                self.leave()
            return True
        return self.inputs_page.back() or not is_android()

    # what comes in

    def _look(self) -> None:
        """Take in what is not urgent, unless something urgent has just brought it along: each time is a drawing."""
        if self._now() - self._drained >= GLASS * 0.6:
            self._drain()
        self._looks += 1
        if self._looks % TICK == 0:  # in the same frame: one of its own would be drawn for it
            self._tick()
        self.collector.look()

    def _drain(self) -> None:
        self._drained = self._now()
        for channel, post in self.mailbox.drain():
            self._deliver(channel, post)

    def _deliver(self, channel: str, post: Post) -> None:
        if channel.startswith(HELLO):
            self.robots.heard(post.value, post.received)
        elif channel.startswith(LATENCY):
            self.robots.measured(*post.value)
        elif channel == PICTURE:
            self._pictures.show(post.value, post.received, self.shell, self.session)
        elif channel.startswith(SIMULATED):
            self.simulating.hear(*post.value)
        elif self.session is not None:
            self.session.deliver(channel, post)
            self.records.put(channel, post.value)
            if channel == "/robot/info":
                info = post.value
                self.robots.name(self.session.link.url, info.name, info.kind, info.description, info.icon)
                self._save_robots()

    def _on_frame(self, frame: Frame, received: float) -> None:
        """In the network thread: keep the frame for a snapshot and have it decoded."""
        self.records.frame = frame
        self.camera.show(frame, received)

    def _beat(self) -> None:
        self.inputs.look()
        self.methods.look(self._now())
        if self.session is not None:
            self.session.link.beat()

    def _tick(self) -> None:
        self.corner.tick()
        self.inputs_page.tick()
        if self.session is not None and self.shell is None:
            self._tick_connecting()
            return
        if problem := self.settings.news():
            self._say(problem, "warn")
        if self.shell is not None:
            self.shell.tick()
            self._pictures.judge(self.shell)
            self._pictures.watch(self.session)
            self._tick_recording()

    def _tick_connecting(self) -> None:
        session = self.session
        if session.ever_connected:
            self._enter_robot()
            return
        state = session.link_state
        waiting = f" Trying again in {math.ceil(session.retry_in)} s." if session.retry_in > 0 else ""
        trouble = state.attempt > 1 or state.retry_in > 0
        sentence = state.sentence + ("" if "Trying again" in state.sentence else waiting)
        self.connect.say(
            f"{sentence} Tap to cancel." if trouble else sentence, "warn" if trouble else "info", self.leave
        )
        if state.phase.name == "CLOSED" and state.attempt:
            self.leave()
            self.connect.say(state.sentence, "danger")

    # the list of robots

    def _list(self) -> None:
        if self.session is None:
            entries = self.robots.entries()
            self.connect.show_entries(entries, self.client_id)
            self.nearby.measure(entries)
            self.connect.ids.inputs.show(self.methods.standing(), self.methods.idle())

    def _save_robots(self) -> None:
        self.settings.set("robots", self.robots.save())

    def ask_address(self) -> None:
        """Ask for an address to connect to."""
        dialog = AddressDialog(self._add_address)
        self.root.add_widget(dialog)
        dialog.ids.field.focus = True

    def _add_address(self, text: str) -> None:
        url = check_address(text)
        self.open(url)
        self._unproven = url

    def forget(self, url: str) -> None:
        """Take a saved address off the list."""
        self.robots.remove(url)
        self._save_robots()
        self._list()

    def next_theme(self) -> None:
        """Go on to the next theme and remember it."""
        theme.name = THEMES[theme.name][2]
        self.settings.set("theme", theme.name)

    # a robot

    def _new_link(self, url: str, known: Known | None = None) -> Link:
        link = Link(
            url,
            self.mailbox,
            self.network,
            client_id=self.client_id,
            client_name=self.client_name,
            known=known,
            marks=marks(self.settings),
            on_picture=self._on_frame,
            now=self._now,
        )
        link.start()
        return link

    def open(self, url: str, *, watch: bool = False) -> None:
        """Connect to a robot; with `watch` without asking for control. Its screens come when it answers."""
        self.leave()
        self.session = Session(
            self._new_link(url),
            Feeds(self._now),
            self.settings,
            now=self._now,
            client_id=self.client_id,
            client_name=self.client_name,
            wants_control=not watch,
        )
        self.session.on_rest = self.inputs.rest
        self.connect.say(f"Connecting to {url} …", "info", self.leave)

    def _keep_address(self) -> None:
        """Save an address that was typed: something has answered there."""
        if self.session is not None and self._unproven == self.session.robot.url:
            self.robots.add(self._unproven)
            self._save_robots()
        self._unproven = ""

    def _enter_robot(self) -> None:
        from app.screens.robot_screens import robot_shell

        self._keep_address()
        self.connect.say("")
        place = {"size": self.root.size, "pos": self.root.pos}
        self.shell = robot_shell(self, self.session, self.layout_for, **place)
        self.root.show_page(self.shell)
        for post in self.session.events.early:
            self.shell.replay(post)
        self.session.events.shown = True
        self.show(self._first_screen)
        self.shell.tick()  # nothing comes onto the glass that says less than is known

    def layout_for(self, model: str, kind: str) -> Layout:
        """The drive screen for a robot of that model and kind."""
        return self._layout or choose(self._layouts, model, kind)

    def show(self, screen: str) -> None:
        """Put `mission`, `drive`, `tasks`, `topics` or `inputs` on the glass; KeyError for another."""
        self.shell.go(screen)
        self._first_screen = screen
        self.corner.tick()  # STOP ALL is never where STOP is, not for a frame

    def show_inputs(self) -> None:
        """Put on the glass where the ways in are set up, with a robot or without one."""
        if self.shell is not None:
            self.show("inputs")
        elif self.session is None:
            self.root.show_page(self.inputs_page)
            self.inputs_page.enter()

    def leave(self) -> None:
        """Back to the connect screen; the robot goes on with what it does."""
        if self.session is None:
            return
        self.intents.rest()
        self.inputs.rest()
        if self.shell is not None:
            self.shell.close()
            self.collector.expect(self.shell)
            self.shell = None
        self.fleet.look(None)
        self.session.link.close()
        self.session = None
        self.records.frame = None
        self._pictures.forget()
        self.connect.say("")
        self.stop_recording()
        self.root.show_page(self.connect)
        self.corner.tick()
        self._list()

    def _say(self, text: str, level: str) -> None:
        tell(self, text, level)

    def alarm(self, event: Event) -> None:
        """Something happened that the operator must not miss."""
        if self.shell is not None:
            self.shell.say(event.text, "danger", about=event.kind)

    # pictures and recordings

    def toggle_recording(self) -> None:
        """Start recording, or finish the one that runs."""
        self.records.toggle(self.session)
        self._tick_recording()

    def start_recording(self, path: Path) -> bool:
        """Record everything that comes into an MCAP file; False, and said, when it cannot be written."""
        return self.records.start(path, self.session)

    def stop_recording(self) -> None:
        """Finish the recording; nothing when none runs."""
        self.records.stop()

    def _tick_recording(self) -> None:
        self.records.check()
        self.shell.recording = self.records.recorder is not None
        self.shell.ids.record.text = self.records.clock
