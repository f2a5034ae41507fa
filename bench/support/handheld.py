"""The real app under remote control, `python -m bench.support.handheld --started T [--size WxH] [flags]`.

It draws off screen. `T` is the parent's `time.monotonic()` [s] just before it made this process; the first
line says how long after that the first frame was drawn. Then each line of JSON on the standard input, as in
`{"do": "connect", "url": "ws://…"}`, is answered by one. At the end of the input the app stops.

`--bare` is a Kivy app with one button instead. `--no-gl` swallows every call to OpenGL, which leaves the work of the app
on a device with a GPU. `--frame-loop` has Kivy's default clock and has the frame loop
send the stick 20 times a second, as simple apps do; `--json-camera` takes pictures from the rosbridge topic. `--no-life`
switches off the checks of the input that pushes the stick, and the heartbeat.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import random
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from typing import Any, TypeVar

import psutil

from bench.support.watching import Watching, in_ui

T = TypeVar("T")

PERIOD = 1 / 20
"""How often the frame loop sends [s]."""
BETWEEN = (0.06, 0.12)
"""Between two moves of the finger [s]: not in step with the frames, and slow enough to be distinguished."""
HELD, COOL_DOWN = 1.2, 3.0
"""How long Release is held, and how long the robot then takes no other release [s]."""
PAUSE = (0.1, 0.3)
"""Before a tap [s]."""
ASK_AGAIN = 2.5
"""A question without an answer is asked again after this [s]."""
CONFIRMED = 5.0
"""A STOP that is not confirmed within this time never is [s]."""
REACH = 0.55
"""How far the finger moves from the stick's middle, as a share of its radius."""


def options() -> argparse.Namespace:
    """What the command line asks for."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--started", type=float, required=True)
    parser.add_argument("--size", default="1280x800")
    parser.add_argument("--settings", default="")
    for flag in ("--bare", "--no-gl", "--frame-loop", "--json-camera", "--no-life"):
        parser.add_argument(flag, action="store_true")
    return parser.parse_args()


def prepare(asked: argparse.Namespace) -> None:
    """Everything that must be set before Kivy is imported."""
    os.environ.pop("DISPLAY", None)
    os.environ.update(SDL_VIDEODRIVER="offscreen", KIVY_NO_CONSOLELOG="1", KIVY_NO_ENV_CONFIG="1")
    if asked.no_gl:
        os.environ["KIVY_GL_BACKEND"] = "mock"
    if asked.frame_loop:
        os.environ["KIVY_CLOCK"] = "default"
    from app.__main__ import prepare as prepare_app

    prepare_app(asked.size)


def reply(value: object) -> None:
    """Print a line of JSON."""
    print(json.dumps(value), flush=True)


class Script(Watching):
    """The commands to the app; each method's result is its answer."""

    def __init__(self, app: Any) -> None:
        super().__init__()
        self.app = app
        self.commands: list[tuple[float, ...]] = []
        self.touched = (0.0, 0.0)
        self._grip: Any = None

    def connect(self, url: str) -> dict[str, Any]:
        """Connect, and wait until every widget of the drive screen is live and there is a picture."""
        began = time.monotonic()
        in_ui(lambda: self.app.open(url))
        while not in_ui(self._entered):
            time.sleep(0.01)
        entered = time.monotonic() - began
        while (waiting := in_ui(self._waiting)) and time.monotonic() - began < 10:
            time.sleep(0.01)
        return {"entered": entered, "live": time.monotonic() - began, "waiting": waiting}

    def _entered(self) -> bool:
        if self.app.shell is None or not self.app.shell.screen:
            return False
        drive = self.app.shell.screens["drive"]
        if not self.commands and not hasattr(drive, "bench"):
            drive.bench = True
            drive.stick.bind(on_command=self._commanded, on_touch_move=self._touched)
            drive.show_picture = self._watched(drive.show_picture)
        return True

    def _touched(self, _: object, touch: Any) -> None:
        from kivy.core.window import Window

        if touch.grab_current is not None:
            self.touched = touch.sx * Window.width, (1 - touch.sy) * Window.height

    def _commanded(self, _: object, twist: Any) -> None:
        self.commands.append((time.monotonic(), *self.touched, twist.linear.x, twist.angular.z))

    def _watched(self, show: Callable[..., None]) -> Callable[..., None]:
        def show_picture(picture: Any, *args: Any) -> None:
            show(picture, *args)
            self.pictures.append((time.monotonic(), picture.stamp))

        return show_picture

    def _waiting(self) -> list[str]:
        """Widgets that are not live yet."""
        from widgets.core.base import RobotWidget

        seen = [w for w in self.app.shell.walk() if isinstance(w, RobotWidget) and w.accepts]
        late = [type(w).__name__ for w in seen if w.state not in ("live", "alarm")]
        return late + ([] if self.pictures else ["picture"])

    def finger(self, count: int, seed: int) -> dict[str, Any]:
        """Move the stick `count` times; gives when and whereto the finger moved, and what the stick commanded when."""
        from bench.support.finger import Finger

        finger, rng = Finger(), random.Random(seed)
        x, y, radius = in_ui(self._stick)
        self.commands.clear()
        finger.down(x, y)
        time.sleep(0.3)
        moved = []
        for _ in range(count):
            time.sleep(rng.uniform(*BETWEEN))
            turn, reach = rng.uniform(0, math.tau), rng.uniform(0.3, REACH) * radius
            place = round(x + reach * math.cos(turn)), round(y + reach * math.sin(turn))
            moved.append((time.monotonic(), *place))
            finger.move(*place)
        time.sleep(0.3)
        commands = list(self.commands)
        finger.up(x, y)
        time.sleep(0.5)
        return {"moved": moved, "commands": commands}

    def _stick(self) -> tuple[int, int, float]:
        from kivy.core.window import Window

        stick = self.app.shell.screens["drive"].stick
        x, y = stick.to_window(*stick.center)
        return round(x), round(Window.height - y), min(stick.size) / 2

    def stop(self, count: int, seed: int) -> dict[str, Any]:
        """Tap STOP `count` times at odd moments and release it; gives how long each took to be confirmed [s].

        One that is not confirmed within CONFIRMED counts as infinite: null.
        """
        from bench.support.finger import Finger

        finger, rng, taken = Finger(), random.Random(seed), []
        x, y = in_ui(self._stop_at)
        for _ in range(count):
            self._until(lambda: self.app.shell.stop.phase == "ready" and self.app.session.control == "mine")
            time.sleep(rng.uniform(*PAUSE))
            confirmed = threading.Event()
            moments: list[float] = []
            in_ui(lambda confirmed=confirmed, moments=moments: self._note_stopped(confirmed, moments))
            tapped = time.monotonic()
            finger.down(x, y)
            done = confirmed.wait(CONFIRMED)
            finger.up(x, y)
            taken.append(moments[0] - tapped if done else None)
            time.sleep(0.05)
            in_ui(self.app.session.hold_stop)
            time.sleep(HELD)
            in_ui(self.app.session.release_stop)
            time.sleep(COOL_DOWN)
        return {"taken": taken}

    def _stop_at(self) -> tuple[int, int]:
        from kivy.core.window import Window

        stop = self.app.shell.stop
        x, y = stop.to_window(*stop.center)
        return round(x), round(Window.height - y)

    def _note_stopped(self, confirmed: threading.Event, moments: list[float]) -> None:
        stop = self.app.shell.stop

        def changed(_: object, phase: str) -> None:
            if phase == "stopped":
                moments.append(time.monotonic())
                stop.unbind(phase=changed)
                confirmed.set()

        stop.bind(phase=changed)

    def _until(self, condition: Callable[[], bool]) -> None:
        end = time.monotonic() + 10.0
        while not in_ui(condition):
            if time.monotonic() > end:
                raise TimeoutError("The handheld does not come to rest.")
            time.sleep(0.02)

    def push(self, kind: str) -> dict[str, Any]:
        """Push the stick and hold it, by `finger` or `pad`."""
        if self._grip is None:
            self._grip = in_ui(lambda: grip(self.app))
        if kind == "pad":
            in_ui(self._grip.plug_in)
        self._until(lambda: self._grip.ready)
        in_ui(lambda: self._grip.take(kind))
        return {}

    def lose(self, way: str) -> dict[str, Any]:
        """Lose it in that way of `bench.support.ways`; gives when."""
        return {"at": in_ui(lambda: self._grip.lose(way))}

    def let_go(self) -> dict[str, Any]:
        """Release everything, and restore the input."""
        self._until(lambda: self._grip.settled)
        in_ui(self._grip.again)
        return {}

    def attach(self, url: str, task: int, runs: int, queued: int, events: list[int]) -> dict[str, Any]:
        """Connect and wait until it knows the task that runs, `runs` of the history, the queue and all `events`.

        Gives how long that took [s] and what was missing after CONFIRMED, empty when nothing was.
        """
        began = time.monotonic()
        in_ui(lambda: self.app.open(url))
        asked = -math.inf
        while (missing := in_ui(lambda: self._unknown(task, runs, queued, events))) and (
            time.monotonic() - began < CONFIRMED
        ):
            if time.monotonic() - asked > ASK_AGAIN and in_ui(lambda: self.app.session.connected):
                asked = time.monotonic()
                in_ui(self.app.session.tasking.ask_history)
            time.sleep(0.005)
        return {"took": time.monotonic() - began, "missing": missing}

    def _unknown(self, task: int, runs: int, queued: int, events: list[int]) -> list[str]:
        session = self.app.session
        if not session.connected or self.app.shell is None or not self.app.shell.screen:
            return ["the robot"]
        status, queue = session.feeds.latest("/task/status"), session.feeds.latest("/task/queue")
        history = session.outcomes.get("history")
        told = history.answer.runs if history is not None and history.answer is not None else []
        heard = {event.id for event in session.logbook.events}
        found = {
            "the task": status is not None and (status.task_id, status.state) == (task, "RUNNING"),
            "the queue": queue is not None and len(queue.orders) == queued,
            "the history": len(told) >= runs,
            "its progress": session.feeds.state("/task/progress") == "live",
            "the events": heard.issuperset(events),
        }
        return [name for name, known in found.items() if not known]

    def command(self, name: str) -> dict[str, Any]:
        """Give a command that needs no more than its name."""
        in_ui(lambda: self.app.session.command(name))
        return {}

    def hold(self, seconds: float) -> dict[str, Any]:
        """Have the robot stay where it is as its task."""
        from bridge.msgs.pilothouse_msgs import TaskOrder

        order = TaskOrder(task="hold", duration=seconds)
        in_ui(lambda: self.app.session.command("start", order=order))
        return {}

    def knows(self) -> dict[str, Any]:
        """Who has control, and the state of the task, empty while it is not known."""
        return in_ui(self._known)

    def _known(self) -> dict[str, Any]:
        session = self.app.session
        status = session.feeds.latest("/task/status")
        return {"control": session.control, "task": status.state if status else ""}

    def flood(self, topic: str) -> dict[str, Any]:
        """Listen to everything on a topic of Odometry."""
        from bridge.msgs.nav_msgs import Odometry

        link = self.app.session.link
        client, network = link._client, link._network
        network.call(lambda: client.subscribe(topic, Odometry, lambda *_: None))
        return {}


def obey(script: Script, stop: Callable[[], None]) -> None:
    """Do what the standard input asks for until it ends."""
    for line in sys.stdin:
        asked = json.loads(line)
        try:
            reply(getattr(script, asked.pop("do"))(**asked))
        except Exception as fault:  # noqa: BLE001 - the parent has to know of it, of any kind
            reply({"fault": repr(fault)})
    stop()


def send_by_frame_loop() -> None:
    """Have the frame loop pass the stick on, 20 times a second."""
    from kivy.clock import Clock

    from app.link.link import Link

    drive = Link.drive

    def keep(self: Link, twist: Any) -> None:
        self.wanted = twist  # type: ignore[attr-defined]
        if not hasattr(self, "sender"):
            self.sender = Clock.schedule_interval(lambda _: drive(self, self.wanted), PERIOD)  # type: ignore[attr-defined]

    Link.drive = keep  # type: ignore[method-assign]


def believe_fingers() -> None:
    """Events in SDL's queue leave the state of its mouse as it was: no finger would be there."""
    from app.inputs.gamepad.sdl import Sdl

    lifted = Sdl.lifted
    Sdl.lifted = lambda self, device, finger: device != "mouse" and lifted(self, device, finger)  # type: ignore[method-assign]


def grip(app: Any) -> Any:
    """A hand on the app's stick that goes on with each frame."""
    from kivy.base import EventLoop
    from kivy.clock import Clock

    from bench.support.losses import Grip
    from examples.demo.fingers import Hand

    hand = Hand()
    EventLoop.add_input_provider(hand)
    made = Grip(app, hand)
    Clock.schedule_interval(lambda _: made.frame(), 0)
    return made


def trust_blindly() -> None:
    """Forward what the stick says as it comes."""
    from app.inputs.inputs import Inputs
    from app.link import drive_slot

    def update(self: Any) -> None:
        for stick, _ in self.sticks:
            for state in self._source.pads():
                stick.lean(state.forward, state.left)
            stick.gamepad = "ready"

    def rest(self: Any, *_: object) -> None:
        """Kivy finds it by its name."""

    Inputs.update, Inputs.rest = update, rest  # type: ignore[method-assign]
    drive_slot.HEARTBEAT_TIMEOUT = drive_slot.REARM_DELAY = math.inf


def watch_by_topic() -> None:
    """Have pictures come as base64 in JSON."""
    from app.link.link import Link

    watch = Link.watch
    Link.watch = lambda self, camera: watch(self, None if camera is None else "")  # type: ignore[method-assign]


def bare() -> Any:
    """A Kivy app with one button."""
    from kivy.app import App
    from kivy.uix.button import Button

    class Bare(App):
        def build(self) -> Button:
            return Button(text="Pilothouse")

    return Bare()


def real(asked: argparse.Namespace, folder: str) -> Any:
    """The handheld."""
    from app.application import PilothouseApp

    if asked.frame_loop:
        send_by_frame_loop()
    if asked.json_camera:
        watch_by_topic()
    if asked.no_life:
        trust_blindly()
    believe_fingers()
    return PilothouseApp(screen="drive", settings_dir=folder, discover=False, poll=not asked.frame_loop)


def main() -> None:
    """Run the app until the standard input ends."""
    asked = options()
    prepare(asked)
    from kivy.clock import Clock
    from kivy.core.window import Window

    with tempfile.TemporaryDirectory() as folder:
        app = bare() if asked.bare else real(asked, asked.settings or folder)

        def drawn(*_: object) -> None:
            Window.unbind(on_flip=drawn)
            Clock.schedule_once(begin, 0)

        def begin(_: float) -> None:
            reply(
                {"first_frame": time.monotonic() - asked.started, "rss": psutil.Process().memory_info().rss}
            )
            stop = lambda: Clock.schedule_once(lambda _: app.stop(), 0)  # noqa: E731
            threading.Thread(target=obey, args=(Script(app), stop), daemon=True).start()

        Window.bind(on_flip=drawn)
        app.run()


if __name__ == "__main__":
    main()
