"""The link to one robot: its socket in the network thread, its messages into the mailbox, its commands out."""

from __future__ import annotations

import concurrent.futures
import logging
import time
import uuid
from collections.abc import Callable, Coroutine, Mapping
from functools import partial
from typing import Any

from app.core.command_origin import Origin, origins
from app.link.advertising import INITIAL_POSE, Advertiser
from app.link.camera_watch import CameraWatch
from app.link.capabilities import Capabilities
from app.link.capability_watch import CapabilityWatch
from app.link.channels import CAPABILITIES, EVENT, LINK, MISSED, OUTCOME, SIGNAL, LinkPosts
from app.link.commands import SERVICES, Commands
from app.link.drive_sender import DriveSender
from app.link.drive_slot import Drive
from app.link.event_fetch import EventFetch
from app.link.event_order import KnownEvents
from app.link.feeds import Mailbox
from app.link.link_health import LinkHealth
from app.link.signals.signal_sender import SignalSender
from app.link.subscriptions import Peek, Sources, Watches
from app.link.task_set import TaskSet
from bridge.client.ask_as_stranger import even_as_stranger
from bridge.client.client import BridgeClient, LinkState, Phase
from bridge.client.credentials import Credentials
from bridge.core.camera_frames import Frame
from bridge.core.network_thread import NetworkThread
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped, Twist
from bridge.msgs.pilothouse_msgs import ControlStatus, Event

__all__ = ["Link"]

log = logging.getLogger(__name__)


class Link:
    """One robot. Made, told and closed in the UI thread; everything it does happens in the network thread."""

    def __init__(
        self,
        url: str,
        mailbox: Mailbox,
        network: NetworkThread,
        *,
        client_id: str,
        client_name: str,
        credentials: Credentials | None = None,
        known: KnownEvents | None = None,
        marks: Mapping[str, int] | None = None,
        on_picture: Callable[[Frame, float], None] | None = None,
        now: Callable[[], float] = time.monotonic,
        new_id: Callable[[], str] = lambda: uuid.uuid4().hex,
    ) -> None:
        """`client_id` and `client_name` are who this handheld is to the robot; `now` is our clock [s].

        With `credentials` it speaks to the robot with that key only. `known` and `marks` are how far its events are known, as `EventStream` takes them. `on_picture` is called in the network thread with each camera frame and when it came [s].
        """
        self.url, self.credentials, self._network, self._now = url, credentials, network, now
        self._posts = posts = LinkPosts(mailbox, now)
        self._client = client = BridgeClient(url, on_state=self._on_state, now=now, credentials=credentials)
        self._tasks, self._advertiser = TaskSet(), Advertiser(client)
        self.commands = Commands(
            even_as_stranger(client, credentials, "/stop"),
            posts.queue(OUTCOME),
            now=now,
            robot_time=client.robot_time,
            new_id=new_id,
            client_id=client_id,
            client_name=client_name,
        )
        self._robot = CapabilityWatch(
            client.call, self._tasks, on_change=self._on_capabilities, on_arrived=self._on_arrived
        )
        self.health = LinkHealth(client, now)
        """Round trip and losses."""
        self._sender = DriveSender(
            client, network, self._robot, self.health, now=now, forbidden=lambda: self.commands.stopping
        )
        self.signals = SignalSender(
            client, network, self._robot, self.health, now, self._is_stopping, SERVICES, posts.queue(SIGNAL)
        )
        """What controls of a view tell topics of the robot's own."""
        self._events = EventFetch(
            client,
            self._tasks,
            on_event=posts.queue(EVENT),
            on_missed=posts.queue(MISSED),
            on_known=posts.post_known,
            known=known,
            marks=marks,
        )
        self._sources = Sources(client, self._on_message, self._on_event)
        self._peek = Peek(client, posts.post_seen)
        self.watches = Watches(client, posts.post_watched, self._tasks.start, network.call)
        """The topics that anybody looks at beside those that every screen shows."""
        self._camera = CameraWatch(url, self._sources, self._tasks, on_picture or _no_picture, credentials)
        self._running: concurrent.futures.Future[None] | None = None

    @property
    def state(self) -> LinkState:
        """The connection as it stands."""
        return self._client.state

    def robot_time(self) -> float:
        """The robot's clock [s]; NaN while it is not known."""
        return self.health.robot_time()

    @property
    def silence(self) -> float:
        """Time since anything came [s]; infinite before the first message."""
        return self.health.silence

    @property
    def silent(self) -> bool:
        """Nothing came for a while, though the connection still stands: whoever drives has to push anew."""
        return self.health.silent

    @property
    def drive_topic(self) -> str | None:
        """Topic of drive commands; None when the robot has none."""
        return self._robot.drive_topic

    @property
    def steers(self) -> bool:
        """The robot has a topic for manoeuvres; without one it is driven by twists alone."""
        return self._robot.steers

    def start(self) -> None:
        """Connect, and go on reconnecting until `close`."""
        self._running = self._network.start(self._run())

    def close(self, timeout: float = 2.0) -> None:
        """Send rest, close the socket and end every task; returns after at most `timeout` [s]."""
        if self._running is None:
            return
        try:
            self._network.start(self._close()).result(timeout)
        except (TimeoutError, concurrent.futures.TimeoutError, concurrent.futures.CancelledError):
            log.warning("the link did not close within %.1f s", timeout)
        self._running.cancel()
        self._running = None

    def drive(self, order: Drive) -> None:
        """As of `DriveSender.want`; a manoeuvre goes only to a robot that `steers`."""
        self._sender.want(order)

    def amend(self, order: Drive) -> None:
        """What the hand that drives now means has changed; a robot that rests goes on resting."""
        self._sender.amend(order)

    @property
    def driving(self) -> bool:
        """The robot was last told to move."""
        return self._sender.slot.driving

    @property
    def driven_by(self) -> Origin:
        """Origin of the last command that moves the robot; whether it still does is `driving`."""
        return self._sender.driven_by

    @property
    def voided(self) -> int:
        """As of `DriveSlot.voided`."""
        return self._sender.slot.voided

    def beat(self) -> None:
        """The user interface is alive; without this for 0.15 s the robot is told to rest."""
        self._sender.slot.beat()

    def command(self, name: str, /, **fields: Any) -> None:
        """Send a one-shot command of `app.link.commands.COMMANDS` from the current origin; its `Outcome`s come through the mailbox."""
        self._spawn(partial(self.commands.send, name, origins.current(), **fields))

    def ask(self, service: str, request: Msg, response: type[Msg]) -> None:
        """Call a service that is no command; its `channels.Answer` comes through the mailbox."""
        self._spawn(partial(self._posts.answer, self._client, service, request, response))

    def stop(self) -> None:
        """STOP: controls let go and the robot is told until it confirms; without, or before, that service it gets zero speed until `unlatch`."""
        self._sender.slot.want(Twist())
        self.signals.drop()
        capabilities = self._robot.capabilities
        ours = capabilities is not None and capabilities.ours
        if not ours:
            self._sender.slot.latch(True)
        self._sender.wake()
        if ours or capabilities is None:
            self._spawn(partial(self.commands.stop, origins.current()))

    def latch(self) -> None:
        """Send zero speed until `unlatch`; over a new link too, where STOP was pressed on the one before."""
        self._sender.latch(True)

    def unlatch(self) -> None:
        """Neither STOP nor zero speed is sent of itself any longer; the stick must be pushed anew."""
        self._sender.slot.latch(False)
        self._network.call(self.commands.void_stop)

    def inspect(self, topic: str, type_name: str) -> None:
        """Listen to one topic and tell what is `SEEN` of it; the one before ends."""
        self._spawn(partial(self._peek.open, topic=topic, type_name=type_name))

    def end_inspection(self) -> None:
        """Listen to that topic no longer."""
        self._network.call(self._peek.close)

    def ask_offer(self) -> None:
        """Ask again what the robot offers; told when it changed."""
        self._spawn(self._robot.renew)

    def want(self, topic: str, wanted: bool) -> None:
        """Listen to a topic that the robot makes only while somebody looks, or no longer."""
        self._network.call(self._sources.want, topic, wanted)

    def place(self, message: PoseWithCovarianceStamped) -> None:
        """Tell the robot where it is."""
        self._network.call(self._client.publish, INITIAL_POSE, message)

    def watch(self, camera: str | None) -> None:
        """Show a camera stream by its name; empty for the one of the rosbridge topic, None for none."""
        self._network.call(self._camera.show, camera)

    def _spawn(self, begin: Callable[[], Coroutine[Any, Any, Any]]) -> None:
        self._network.call(lambda: self._tasks.start(begin()))

    async def _run(self) -> None:
        senders = [self._tasks.start(one.run()) for one in (self._sender, self.signals)]
        try:
            await self._client.run()
        finally:
            for sender in senders:
                sender.cancel()

    def _is_stopping(self) -> bool:
        return self.commands.stopping or self.commands.stopped or self._sender.slot.latched

    def _on_state(self, state: LinkState) -> None:
        self._posts.queue(LINK)(state)
        connected = state.phase is Phase.CONNECTED
        if connected:
            self.health.on_sign(self._now())
        for part in (self._sender, self.signals, self._events, self._robot):
            (part.on_connected if connected else part.on_lost)()
        if connected:
            self.watches.renew()

    def _on_arrived(self, known: bool) -> None:
        """The robot was asked what it offers; where it did not answer, the usual names are listened to."""
        capabilities = self._robot.capabilities
        if not known:
            self._sources.follow(capabilities)
        if known and capabilities is not None and not capabilities.serves("/events/get"):
            self._events.without_store()
        self._events.catch_up()

    def _on_capabilities(self, offer: Capabilities) -> None:
        """Listen to what is there, advertise what is wanted, and stop a robot by the STOP that it has."""
        self._sources.follow(offer)
        self._advertiser.follow(offer)
        if offer.ours:
            self._sender.slot.latch(False)
        elif self.commands.stopping:
            self.commands.void_stop()
        self._posts.queue(CAPABILITIES)(offer)

    def _on_message(self, name: str, message: Msg, received: float) -> None:
        self.health.on_sign(received)
        if isinstance(message, ControlStatus):
            self.commands.on_status(message)
        self._posts.post_message(name, message, received)

    def _on_event(self, event: Event, received: float) -> None:
        self._events.on_live(event)
        if self._client.state.phase is Phase.CONNECTED and self._robot.settled:
            self._events.catch_up()

    async def _close(self) -> None:
        self._sender.finish()
        self.signals.finish()
        self._camera.show(None)
        self._peek.close()
        await self._client.close()
        await self._tasks.cancel()


def _no_picture(_frame: Frame, _received: float) -> None:
    """Nobody looks at the camera."""
