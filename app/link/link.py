"""The link to one robot: its socket in the network thread, its messages into the mailbox, its commands out."""

from __future__ import annotations

import asyncio
import concurrent.futures
import logging
import math
import time
import uuid
from collections.abc import Callable, Coroutine, Mapping
from functools import partial
from typing import Any

from app.core.command_origin import NOBODY, origins
from app.link.capabilities import DRIVE, MANOEUVRE, Offer, ask
from app.link.commands import Commands, Outcome
from app.link.drive_slot import Drive, DriveSlot, stamped_at
from app.link.event_order import EventStream, Known
from app.link.feeds import Mailbox
from app.link.subscriptions import Peek, Seen, Sources
from bridge.client.client import BridgeClient, CameraStream, LinkState, Phase
from bridge.core.camera_frames import Frame
from bridge.core.errors import BridgeError, NoReply, NotConnected
from bridge.core.network_thread import NetworkThread
from bridge.core.topic_choice import drive_message
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped, Twist, TwistStamped
from bridge.msgs.pilothouse_msgs import ControlStatus, Event, GetEventsResponse, Manoeuvre
from bridge.msgs.sensor_msgs import CompressedImage

__all__ = ["EVENT", "KNOWN", "LINK", "MISSED", "OFFER", "OUTCOME", "SEEN", "Link"]

log = logging.getLogger(__name__)

EVENT, MISSED, LINK, OUTCOME = "event", "missed", "link", "outcome"
"""Channels of the mailbox beside the topics: `Event`s, what was `Missed`, `LinkState`s, `Outcome`s, all queued."""
KNOWN = "known"
"""One more, newest wins: how far the robot's events are `Known`; it comes after them."""
OFFER, SEEN = "offer", "seen"
"""Two more: the robot's `Offer` when it is known and when it changed, and what is `Seen` of the topic looked at."""
SILENT = 0.7
"""A link on which nothing came for longer carries no drive commands [s]: they would arrive late, if at all."""
TICK = 0.05
"""How often the drive slot is looked at when nothing wakes it [s]."""
EVENTS_TIMEOUT = 10.0
"""For a part of the events that were missed [s]: many of them take a while on a slow link."""
ASK_AGAIN, LOOK_AGAIN = 1.0, 5.0
"""Between two questions for what the robot offers, while it does not answer and, where it is not ours, later on [s]."""


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
        known: Known | None = None,
        marks: Mapping[str, int] | None = None,
        on_picture: Callable[[Frame, float], object] | None = None,
        now: Callable[[], float] = time.monotonic,
        new_id: Callable[[], str] = lambda: uuid.uuid4().hex,
    ) -> None:
        """`client_id` and `client_name` are who this handheld is to the robot; `now` is our clock [s].

        `known` and `marks` are how far its events are known, as `EventStream` takes them. `on_picture` is called in the network thread with each camera frame and when it came [s].
        """
        self.url = url
        self._mailbox, self._network, self._now = mailbox, network, now
        self._client = BridgeClient(url, on_state=self._on_state, now=now)
        self._slot = DriveSlot(now)
        self.commands = Commands(
            self._client.call,
            self._tell,
            now=now,
            robot_time=self._client.robot_time,
            new_id=new_id,
            client_id=client_id,
            client_name=client_name,
        )
        self._events = self._stream(known, marks)
        self._on_picture = on_picture or (lambda *_: None)
        self._wake = asyncio.Event()
        self._heard = -math.inf
        self.rtt = math.nan
        """Round trip [s]; NaN while it is not known."""
        self.lost = 0
        """How many of the last 20 pings had no answer."""
        self._offset = math.nan
        self._tasks: set[asyncio.Task[Any]] = set()
        self._running: concurrent.futures.Future[None] | None = None
        self._camera_task: asyncio.Task[None] | None = None
        self._camera_topic: Callable[[], None] | None = None
        self.offer: Offer | None = None
        """What the robot offers; None until it said so, which a robot that is not ours does before it is listened to."""
        self._sources = Sources(self._client, self._on_message, self._on_event)
        self._peek = Peek(self._client, self._on_seen)
        self._known = Known()
        self._asking: asyncio.Task[None] | None = None
        self._fetching: asyncio.Task[None] | None = None
        self._followed = False
        self._advertised: set[str] = set()
        self._moved = False
        """The robot was told over this link to move."""
        self.driven_by = NOBODY
        """Whence the last order came that moves the robot; whether it still does is `driving`."""

    def _stream(self, known: Known | None, marks: Mapping[str, int] | None) -> EventStream:
        mailbox, now = self._mailbox, self._now
        return EventStream(
            lambda event: mailbox.queue(EVENT, event, now()),
            lambda missed: mailbox.queue(MISSED, missed, now()),
            known=known,
            marks=marks,
        )

    # what the UI thread calls

    @property
    def state(self) -> LinkState:
        """The connection as it stands."""
        return self._client.state

    def robot_time(self) -> float:
        """The robot's clock [s]; NaN while it is not known."""
        return self._now() + self._offset

    @property
    def silence(self) -> float:
        """How long nothing came [s]; infinite before the first."""
        return self._now() - self._heard

    @property
    def silent(self) -> bool:
        """Nothing came for a while, though the connection still stands: whoever drives has to push anew."""
        return self.silence > SILENT

    @property
    def foreign(self) -> bool:
        """The robot is known to have no Pilothouse services."""
        return self.offer is not None and not self.offer.ours

    @property
    def drive_topic(self) -> str | None:
        """Where drive commands go; None when the robot has no such topic."""
        return DRIVE if self.offer is None else self.offer.drive

    def start(self) -> None:
        """Connect, and go on reconnecting until `close`."""
        self._running = self._network.start(self._run())

    def close(self, patience: float = 2.0) -> None:
        """Say rest, close the socket and end every task; returns after at most `patience` [s]."""
        if self._running is None:
            return
        try:
            self._network.start(self._close()).result(patience)
        except (TimeoutError, concurrent.futures.TimeoutError, concurrent.futures.CancelledError):
            log.warning("the link did not close within %.1f s", patience)
        self._running.cancel()
        self._running = None

    @property
    def steers(self) -> bool:
        """The robot has a topic for manoeuvres; without one it is driven by twists alone."""
        return self.offer is not None and self.offer.steers

    def drive(self, order: Drive) -> None:
        """Drive so until told otherwise; leaves at once. A manoeuvre goes only to a robot that `steers`.

        ValueError for a manoeuvre that is no drive command.
        """
        if order != Twist():
            self.driven_by = origins.current()
        self._slot.want(order)
        self._network.call(self._wake.set)

    def amend(self, order: Drive) -> None:
        """What the hand that drives now means has changed; a robot that rests goes on resting."""
        self._slot.amend(order)
        self._network.call(self._wake.set)

    @property
    def driving(self) -> bool:
        """The robot was last told to move."""
        return self._slot.driving

    @property
    def voided(self) -> int:
        """As of `DriveSlot.voided`."""
        return self._slot.voided

    def beat(self) -> None:
        """The user interface is alive; without this for 0.15 s the robot is told to rest."""
        self._slot.beat()

    def command(self, name: str, /, **fields: Any) -> None:
        """Send a one-shot command of `app.link.commands.COMMANDS`; its `Outcome`s come through the mailbox.

        It has the origin that is current now.
        """
        self._network.call(self._spawn, partial(self.commands.send, name, origins.current(), **fields))

    def stop(self) -> None:
        """STOP: the stick is let go and the robot is told until it confirms.

        A robot without that service, or not yet known to have it, is sent zero speed until `unlatch`.
        """
        self._slot.want(Twist())
        ours = self.offer is not None and self.offer.ours
        if not ours:
            self._slot.latch(True)
        self._network.call(self._wake.set)
        if ours or self.offer is None:
            self._network.call(self._spawn, partial(self.commands.stop, origins.current()))

    def latch(self) -> None:
        """Send zero speed until `unlatch`; over a new link too, where STOP was pressed on the one before."""
        self._slot.latch(True)
        self._network.call(self._wake.set)

    def unlatch(self) -> None:
        """Neither STOP nor zero speed is sent of itself any longer; the stick must be pushed anew."""
        self._slot.latch(False)
        self._network.call(self.commands.void_stop)

    def look(self, topic: str, type_name: str) -> None:
        """Listen to one topic and tell what is `SEEN` of it; the one before ends."""
        self._network.call(self._spawn, partial(self._peek.open, topic=topic, type_name=type_name))

    def look_away(self) -> None:
        """Listen to that topic no longer."""
        self._network.call(self._peek.close)

    def ask_offer(self) -> None:
        """Ask again what the robot offers; told when it changed."""
        self._network.call(self._spawn, self._renew_offer)

    def place(self, message: PoseWithCovarianceStamped) -> None:
        """Tell the robot where it is."""
        self._network.call(self._client.publish, "/initialpose", message)

    def watch(self, camera: str | None) -> None:
        """Show a camera stream by its name; empty for the one of the rosbridge topic, None for none."""
        self._network.call(self._watch, camera)

    # what happens in the network thread

    async def _run(self) -> None:
        sender = asyncio.create_task(self._send())
        self._keep(sender)
        try:
            await self._client.run()
        finally:
            sender.cancel()

    async def _send(self) -> None:
        while True:
            try:
                async with asyncio.timeout(self._slot.patience(TICK)):
                    await self._wake.wait()
            except TimeoutError:
                pass
            self._wake.clear()
            self._measure()
            stamp = self._client.robot_time()
            forbidden = self.commands.stopping or self.silent or (math.isnan(stamp) and not self.foreign)
            self._publish(self._slot.due(allowed=not forbidden), stamp)

    def _publish(self, order: Drive | None, stamp: float) -> None:
        """Send a drive command by the topic of its type; `stamp` is the robot's clock [s], NaN while it is not known."""
        rest = order == Twist()
        topic = MANOEUVRE if isinstance(order, Manoeuvre) and self.steers else self.drive_topic
        if order is None or topic is None or (isinstance(order, Manoeuvre) and not self.steers):
            return
        # rest goes out whatever is known of the clock; what moves a robot of ours does not without one
        void = rest and (self._slot.latched or math.isnan(stamp))
        self._moved = self._moved or not rest
        self._client.publish(topic, self._said(order), stamp=None if void else stamp, even_late=rest)

    def _said(self, order: Drive) -> Msg:
        """A drive command as the robot takes it."""
        if isinstance(order, Manoeuvre):
            return stamped_at(order, self._client.robot_time())
        stamped = self.offer is not None and self.offer.stamped
        return drive_message(order, self._client.robot_time(), stamped=stamped)

    def _measure(self) -> None:
        """Copy what the client knows for other threads; an answered ping is a sign of life as well."""
        rtt = self._client.rtt
        if rtt != self.rtt:
            self._heard = self._now() if math.isfinite(rtt) else self._heard
        self.rtt, self.lost, self._offset = rtt, self._client.lost, self._client.offset

    def _on_state(self, state: LinkState) -> None:
        self._mailbox.queue(LINK, state, self._now())
        if state.phase is Phase.CONNECTED:
            self._heard = self._now()
            if self.foreign and self._moved and self.drive_topic is not None:
                # whatever is left of what was sent before the link was lost; who only watched says nothing
                self._client.publish(self.drive_topic, self._said(Twist()), even_late=True)
                self._slot.rest()
            self._events.start()
            self._asking = asyncio.get_running_loop().create_task(self._arrive())
            self._keep(self._asking)
        else:
            self._slot.drop()
            for task in (self._asking, self._fetching):
                if task is not None:
                    task.cancel()
            self._fetching = None

    async def _arrive(self) -> None:
        """Find out what the robot offers and listen to that; of a foreign one, look again now and then."""
        known = await self._renew_offer()
        if not known:
            self._sources.follow(self.offer)
        if known and self.offer is not None and not self.offer.serves("/events/get"):
            self._events.without_store()
        self._catch_up()
        while not known or self.foreign:
            await asyncio.sleep(LOOK_AGAIN if known else ASK_AGAIN)
            known = await self._renew_offer() or known

    async def _renew_offer(self) -> bool:
        """Ask what the robot offers, and follow it; False when there was no answer."""
        try:
            offer = await ask(self._client.call, self.offer)
        except (NoReply, NotConnected) as problem:
            log.info("what the robot offers is not known: %s", problem)
            return False
        if offer != self.offer or not self._followed:
            self._follow(offer)
        return True

    def _follow(self, offer: Offer) -> None:
        """Listen to what is there, advertise what is wanted, and stop a robot by the STOP that it has."""
        self.offer, self._followed = offer, True
        self._sources.follow(offer)
        if offer.drive is not None and offer.drive not in self._advertised:
            self._advertised.add(offer.drive)
            self._client.advertise(offer.drive, TwistStamped if offer.stamped else Twist)
        if offer.steers and MANOEUVRE not in self._advertised:
            self._advertised.add(MANOEUVRE)
            self._client.advertise(MANOEUVRE, Manoeuvre)
        if "/initialpose" not in self._advertised and (offer.ours or "/initialpose" in offer.topics):
            self._advertised.add("/initialpose")
            self._client.advertise("/initialpose", PoseWithCovarianceStamped)
        if offer.ours:
            self._slot.latch(False)
        elif self.commands.stopping:
            self.commands.void_stop()
        self._mailbox.queue(OFFER, offer, self._now())

    def _catch_up(self) -> None:
        """Have events asked for where some are missing, unless that is under way."""
        if self._events.behind and (self._fetching is None or self._fetching.done()):
            self._fetching = asyncio.get_running_loop().create_task(self._fetch_events())
            self._keep(self._fetching)

    def _tell_known(self) -> None:
        known = self._events.known
        if known != self._known:
            self._known = known
            self._mailbox.post(KNOWN, known, self._now())

    async def _fetch_events(self) -> None:
        while self._events.behind:
            request = self._events.request()
            try:
                answer = await self._client.call(
                    "/events/get", request, GetEventsResponse, timeout=EVENTS_TIMEOUT
                )
            except (NoReply, NotConnected) as problem:
                log.info("stored events did not come: %s", problem)
                self._events.no_answer()
                await asyncio.sleep(ASK_AGAIN)
            except BridgeError as problem:
                log.info("no stored events: %s", problem)
                self._events.without_store()
            else:
                self._events.answered(answer)
            self._tell_known()

    def _on_message(self, name: str, message: Msg, received: float) -> None:
        self._heard = received
        if isinstance(message, ControlStatus) and message.stopped and message.at_rest:
            self.commands.confirm_stop()
        # whether a STOP is obeyed is shown in the next frame
        self._mailbox.post(name, message, received, urgent=isinstance(message, ControlStatus))

    def _on_seen(self, seen: Seen, received: float) -> None:
        if seen.message is None:
            self._mailbox.queue(SEEN, seen, self._now())
        else:
            self._mailbox.post(SEEN, seen, received)

    def _on_event(self, event: Event, received: float) -> None:
        self._events.live(event)
        self._tell_known()
        if self._client.state.phase is Phase.CONNECTED and self._asking is not None and self._asking.done():
            self._catch_up()

    def _tell(self, outcome: Outcome) -> None:
        self._mailbox.queue(OUTCOME, outcome, self._now())

    def _spawn(self, begin: Callable[[], Coroutine[Any, Any, Any]]) -> None:
        self._keep(self._network.loop.create_task(begin()))

    def _keep(self, task: asyncio.Task[Any]) -> None:
        """The loop holds tasks only weakly: keep each until it is done."""
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def _watch(self, camera: str | None) -> None:
        if self._camera_task is not None:
            self._camera_task.cancel()
            self._camera_task = None
        if self._camera_topic is not None:
            self._camera_topic()
            self._camera_topic = None
        if camera:
            self._camera_task = self._network.loop.create_task(self._show_camera(camera))
            self._keep(self._camera_task)
        elif camera == "":
            self._camera_topic = self._sources.camera(self._on_image)

    async def _show_camera(self, name: str) -> None:
        stream = CameraStream(f"{self.url.rstrip('/')}/camera/{name}", self._on_frame)
        try:
            await stream.run()
        finally:
            await stream.close()

    def _on_frame(self, frame: Frame, received: float) -> None:
        self._on_picture(frame, received)

    def _on_image(self, image: CompressedImage, received: float) -> None:
        self._on_frame(Frame(0, image.header.stamp.seconds, 0, 0, image.data), received)

    async def _close(self) -> None:
        rest = self._slot.driving or self._slot.latched
        self._slot.drop()
        if rest and self.drive_topic is not None:
            self._client.publish(self.drive_topic, self._said(Twist()), even_late=True)
        self._watch(None)
        self._peek.close()
        await self._client.close()
        for task in self._tasks - {asyncio.current_task()}:
            task.cancel()
        await asyncio.gather(*self._tasks - {asyncio.current_task()}, return_exceptions=True)
