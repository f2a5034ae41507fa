"""The session with one robot, as the UI thread sees it: its messages, its answers, and what is being edited."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from app.core.command_origin import NOBODY, origins
from app.core.settings_store import Settings
from app.link.capabilities import Capabilities
from app.link.channels import CAPABILITIES, EVENT, KNOWN, LINK, MISSED, OUTCOME
from app.link.commands import Outcome
from app.link.feeds import Feeds, Post
from app.link.link import Link
from app.missions.intruder_pictures import IntruderPictures
from app.missions.mission_drafts import MissionDrafts
from app.missions.mission_editor import Draft
from app.missions.refusals import Refusals
from app.missions.stored_missions import StoredMissions
from app.missions.tasking import Tasking
from app.session.authority import Authority
from app.session.camera_choice import CameraChoice
from app.session.check_list import CheckListState
from app.session.event_intake import EventIntake
from app.session.initial_pose import initial_pose
from app.session.logbook import Logbook
from app.session.robot_profile import RobotProfile
from app.stop.robot_stop import RobotStop
from app.trust.keyring import RobotKey, host_of
from bridge.client.client import LinkState, Phase
from bridge.core.identity import public_id
from bridge.discovery.hello import is_loopback
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import ControlStatus, TaskStatus
from widgets.core.language import tr

__all__ = ["Session"]


class Session:
    """One robot, from Connect to Back. Everything here happens in the UI thread."""

    def __init__(
        self,
        link: Link,
        feeds: Feeds,
        settings: Settings,
        *,
        now: Callable[[], float],
        client_id: str,
        wants_control: bool,
        key: RobotKey | None = None,
    ) -> None:
        """`wants_control` takes control whenever it is free; without it the robot is only watched.

        `key` is that of a paired robot, by which it has to prove who it is.
        """
        self.link, self.feeds, self.client_id, self.key = link, feeds, client_id, key
        self._now, self.placed = now, (-math.inf, 0.0, 0.0)
        """When [s, robot clock] and where in `map` x, y [m] the robot was put from here last; -inf for never."""
        self.outcomes: dict[str, Outcome] = {}
        """The last outcome of each command by its name."""
        self.listeners: list[Callable[[str, Post], None]] = []
        """Called with each channel and post, after the session took it in."""
        self.on_rest: Callable[[], object] = lambda: None
        """Called when anything that pushes the stick has to let go."""
        self.robot = RobotProfile(feeds, link.url)
        self.robot_stop = RobotStop(
            self.robot, feeds, now, self.own_id, drives=lambda: self.link.drive_topic is not None
        )
        self.authority = Authority(self, wants_control=wants_control)
        self.cameras = CameraChoice(self.robot)
        self.drafts = MissionDrafts(settings, self.robot)
        self.mission = self.drafts.editor
        self.tasking = Tasking(self)
        self.checks = CheckListState(feeds, lambda: self.running)
        self.refusals = Refusals(feeds)
        self.missions = StoredMissions(self)
        self.logbook = Logbook(settings, self.command)
        self.pictures = IntruderPictures(self, now)
        """Of intruders."""
        self.listeners.append(self.pictures.on_post)
        self.events = EventIntake(self, self.own_id, self.logbook, lambda post: self._publish(EVENT, post))
        self.link_state: LinkState = link.state
        self.ever_connected = False
        self._state_since = now()
        self.robot_stop.set_reachable(self.connected)

    def now(self) -> float:
        """Our clock [s]."""
        return self._now()

    # how the robot and the link are

    @property
    def own_id(self) -> str:
        """The public id by which that robot publishes this handheld."""
        return self.key.id if self.key else public_id(self.client_id)

    @property
    def protected(self) -> bool:
        """Nobody in between reads or changes what is said: the link is to a paired robot, or within this machine."""
        return self.key is not None or is_loopback(host_of(self.robot.url))

    @property
    def boot(self) -> str:
        """Identity of the robot's log, alike for one robot under two addresses; empty until it is known."""
        return self.logbook.known.boot

    @property
    def fingerprint(self) -> str:
        """Of the certificate that the robot has shown over the link that stands; empty without one."""
        return self.link.health.fingerprint

    @property
    def control_status(self) -> ControlStatus | None:
        """The robot's newest word of control and STOP; None before the first."""
        status: ControlStatus | None = self.feeds.latest("/control/status")
        return status

    @property
    def connected(self) -> bool:
        """The link stands."""
        return self.link_state.phase is Phase.CONNECTED

    @property
    def retry_in(self) -> float:
        """Time until the next attempt to connect [s]; 0 while one is under way."""
        return max(0.0, self.link_state.retry_in - (self._now() - self._state_since))

    @property
    def control(self) -> str:
        """Who has control, as `Authority.who` says."""
        return self.authority.who

    @property
    def may_drive(self) -> bool:
        """The stick may be pushed: the link is alive, its clock known, STOP not pressed and control not another's.

        Of a robot that is not ours: the link is alive, it has a topic to drive by, and STOP is not latched here.
        """
        alive = self.connected and not self.link.silent and not self.robot_stop.latched
        if self.robot.foreign:
            return alive and self.link.drive_topic is not None
        return alive and math.isfinite(self.link.robot_time()) and self.control != "other"

    @property
    def may_ask(self) -> bool:
        """The robot can be asked for something from here: the link stands, and nobody else is known to have control."""
        return self.connected and self.control not in ("other", "unknown")

    @property
    def running(self) -> bool:
        """A task runs or is paused."""
        status: TaskStatus | None = self.feeds.latest("/task/status")
        return status is not None and status.state in ("RUNNING", "PAUSED")

    def command_sent(self, name: str) -> bool:
        """A command is under way: sent and not yet answered."""
        outcome = self.outcomes.get(name)
        return outcome is not None and outcome.phase == "sent"

    # what comes in

    def deliver(self, channel: str, post: Post) -> None:
        """Take in what the mailbox held."""
        if channel == EVENT:
            self.events.on_event(post)
            return
        if channel == "/task/status":
            post = self.events.word_task(post)
        if channel in self.feeds:
            self.feeds.put(channel, post)
        self._take_in(channel, post)
        self._publish(channel, post)

    def _take_in(self, channel: str, post: Post) -> None:
        """Hand a post to the part of the session that it concerns."""
        takes: dict[str, Callable[[Any], object]] = {
            LINK: lambda state: self._on_link(state, post.received),
            CAPABILITIES: self._on_capabilities,
            OUTCOME: self._on_outcome,
            MISSED: self.logbook.miss,
            KNOWN: self.logbook.know,
            "/task/queue": self.tasking.queue.robot_has,
            "/odom": lambda odometry: self.robot_stop.on_odometry(odometry, post.received),
            "/robot/info": lambda _: self.drafts.on_introduced(),
            "/mission": self.drafts.on_mission,
            "/control/status": lambda status: self._on_control(status, post.received),
        }
        take = takes.get(channel)
        if take is not None:
            take(post.value)

    def _publish(self, channel: str, post: Post) -> None:
        for listener in list(self.listeners):
            listener(channel, post)

    def _on_control(self, status: ControlStatus, received: float) -> None:
        self.robot_stop.on_status(status, received)
        self.authority.on_status(status)

    def _on_capabilities(self, capabilities: Capabilities) -> None:
        self.robot.capabilities = capabilities
        if capabilities.ours:
            self.robot_stop.local.release()

    def _on_link(self, state: LinkState, at: float) -> None:
        self.link_state, self._state_since = state, self._now()
        self.feeds.link(self.connected)
        hopeless = state.phase is Phase.CLOSED
        self.robot_stop.set_reachable(self.connected, state.sentence, at=at, hopeless=hopeless)
        self.ever_connected = self.ever_connected or self.connected
        self.authority.on_link()
        if not self.connected:
            self.on_rest()  # it may be back before anybody looks

    def _on_outcome(self, outcome: Outcome) -> None:
        if outcome.name != "stop" or self.robot_stop.on_outcome(outcome):
            self.outcomes[outcome.name] = outcome
        if outcome.name == "mission" and outcome.phase != "sent":
            sent = Draft.of(outcome.fields["mission"])
            self.mission.answered(sent, outcome.phase == "accepted", outcome.sentence)
        self.tasking.answered(outcome)
        self.logbook.answered(outcome)
        self.missions.answered(outcome)

    def resume(self, link: Link) -> None:
        """Go on over a new link to the same robot; what was entered and heard stays."""
        self.link = link
        if self.robot_stop.local.latched:
            link.latch()
        if self.robot_stop.unanswered:
            stop = self.outcomes.get("stop")
            with origins.during(stop.origin if stop is not None else NOBODY):
                link.stop()
        if self.mission.sent is not None:
            self.mission.answered(self.mission.sent, False, tr("No reply: the link was closed."))
        self.tasking.dropped()
        self.logbook.dropped()
        self.missions.dropped()
        self._on_link(link.state, self._now())

    # what goes out

    def command(self, name: str, /, **fields: Any) -> None:
        """Send a one-shot command of `app.link.commands.COMMANDS`, from the origin that is current (`app.core.command_origin`)."""
        self.link.command(name, **fields)

    def stop(self) -> None:
        """STOP, by the robot's own service or, where it has none, by zero speed until `release_stop`."""
        if self.robot.capabilities is None or self.robot.foreign:
            self.robot_stop.local.press()
        self.robot_stop.press()
        self.link.stop()

    def hold_stop(self) -> None:
        """The operator begins to hold Release; the robot counts the time by its own clock."""
        self.outcomes.pop("stop_hold", None)
        if self.robot.offers("/stop/hold"):
            self.command("stop_hold")

    def release_stop(self) -> None:
        """The operator held Release for long enough and wants to drive again; nothing moves by that alone."""
        self.robot_stop.release()
        self.outcomes.pop("stop", None)
        self.link.unlatch()
        hold = self.outcomes.get("stop_hold")
        if not self.robot.foreign and (hold is None or hold.phase != "refused"):
            self.command("stop_release")

    def take_control(self) -> None:
        """Take control, or ask who has it; it is taken again after a reconnect."""
        self.authority.acquire()

    def rest(self) -> None:
        """The robot is told to rest before anything that is asked of it afterwards; the stick must be pushed anew."""
        self.link.drive(Twist())
        self.on_rest()

    def send_mission(self) -> None:
        """Send the draft to the robot."""
        self.command("mission", mission=self.mission.sending())

    def place_robot(self, x: float, y: float, yaw: float) -> None:
        """Tell the robot that it is at (x, y) in `map` [m], turned to `yaw` [rad]."""
        now = self.link.robot_time()
        self.placed = now, x, y
        self.link.place(initial_pose(x, y, yaw, now))
