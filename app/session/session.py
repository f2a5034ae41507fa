"""Being connected to one robot, as the UI thread sees it: what it said, what it was asked, what is being edited."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from app.core.command_origin import NOBODY, gave_stop, origins
from app.core.settings_store import Settings
from app.discovery.known_robots import address
from app.link.capabilities import CAMERA, Offer
from app.link.commands import Outcome
from app.link.feeds import Feeds, Post
from app.link.link import EVENT, KNOWN, LINK, MISSED, OFFER, OUTCOME, Link
from app.session.check_list import Checks
from app.session.control import Authority
from app.session.fence_refusals import Refusals
from app.session.logbook import Logbook
from app.session.mission_editor import Draft, MissionEditor
from app.session.own_events import OwnName
from app.session.stored_missions import KeptMissions
from app.session.tasking import Tasking
from app.stop.local_stop import LocalStop
from app.stop.stop_state import Stopping
from bridge.client.client import LinkState, Phase
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
    Twist,
)
from bridge.msgs.pilothouse_msgs import ControlStatus, Mission, RobotInfo, TaskStatus
from bridge.msgs.std_msgs import Header, Time
from bridge.msgs.vision_msgs import Detection2DArray
from widgets.core.task_words import known

__all__ = ["Session"]

UNDECIDED = 20
"""So many events may wait for the robot's word of control."""
PLACED_WITHIN = (0.25, 0.25, 0.07)
"""Variance of a place pointed at by finger: x, y [m2] and yaw [rad2]."""


class Session:
    """One robot, from Connect to Back. Everything here happens in the UI thread."""

    shown = False
    """There are screens: what is heard is shown as it comes."""

    def __init__(
        self,
        link: Link,
        feeds: Feeds,
        settings: Settings,
        *,
        now: Callable[[], float],
        client_id: str,
        client_name: str = "",
        wants_control: bool,
    ) -> None:
        """`wants_control` takes control whenever it is free; without it the robot is only watched.

        `client_name` is what this handheld calls itself.
        """
        self.link, self.feeds = link, feeds
        self.client_id = client_id
        self.own_name = OwnName(client_id, client_name, now)
        self._undecided: list[Post] = []
        """Events that may be about us, until the robot's word of control comes."""
        self._task: Post | None = None
        """What the robot said last of its task, in its own words."""
        self.wants_control = wants_control
        self.mission = MissionEditor(on_change=self._mission_changed)
        self.tasking = Tasking(self)
        self.checks = Checks(feeds, lambda: self.running)
        self.refusals = Refusals(feeds)
        self.missions = KeptMissions(self)
        self.logbook = Logbook(settings, self.command)
        self.authority = Authority(self)
        self.outcomes: dict[str, Outcome] = {}
        """The last outcome of each command by its name."""
        self.listeners: list[Callable[[str, Post], None]] = []
        """Called with each channel and post, after the session took it in."""
        self.on_rest: Callable[[], object] = lambda: None
        """Called when whatever pushes the stick has to let go."""
        self.early: list[Post] = []
        """Events that came before there was a screen to show them."""
        self.offer: Offer | None = None
        """What the robot offers; None until it said so."""
        self.local_stop = LocalStop(now)
        """STOP of a robot that has none of its own."""
        self.link_state: LinkState = link.state
        self.ever_connected = False
        self._settings, self._now = settings, now
        self._state_since = now()
        self._stopping = Stopping(now, client_id)
        self._stopping.reach(self.connected)
        self._asked_control = False
        self._chosen = ""
        """The camera that the operator chose; empty for the robot's first."""
        self._known = False
        self._told_mission: Mission | None = None

    def now(self) -> float:
        """Our clock [s]."""
        return self._now()

    # what the robot is

    @property
    def url(self) -> str:
        """The robot's address."""
        return self.link.url

    @property
    def boot(self) -> str:
        """Identity of the robot's log, alike for one robot under two addresses; empty until it is known."""
        return self.logbook.known.boot

    @property
    def control_status(self) -> ControlStatus | None:
        """What the robot said last of control and STOP; None before it did."""
        status: ControlStatus | None = self.feeds.latest("/control/status")
        return status

    @property
    def connected(self) -> bool:
        """The link stands."""
        return self.link_state.phase is Phase.CONNECTED

    @property
    def info(self) -> RobotInfo:
        """Who the robot is; all fields empty until it said so."""
        return self.feeds.latest("/robot/info") or RobotInfo()

    @property
    def name(self) -> str:
        """What to call the robot: its name, else its address."""
        return self.info.name or address(self.link.url)

    @property
    def foreign(self) -> bool:
        """The robot is known to have no Pilothouse services."""
        return self.offer is not None and not self.offer.ours

    @property
    def lacks_tasks(self) -> bool:
        """The robot is known to store no missions and to offer no tasks."""
        return not (self.offers("/task/start") or self.offers("/mission/set"))

    def offers(self, service: str) -> bool:
        """Whether the robot has that service, or has not yet said which ones it has."""
        return self.offer is None or self.offer.serves(service)

    def camera(self, watched: str | None) -> str | None:
        """Which camera to show, as `Link.watch` takes it; `watched` while the robot has not said what there is."""
        info: RobotInfo | None = self.feeds.latest("/robot/info")
        if info is not None:
            return self._chosen if self._chosen in info.cameras else next(iter(info.cameras), None)
        if self.foreign and self.offer is not None:
            return "" if self.offer.source(CAMERA) else None
        return watched

    def next_camera(self) -> None:
        """Show the next one of the robot's cameras, after the last the first; nothing where it has one or none."""
        cameras = self.info.cameras
        shown = self.camera(None)
        if shown in cameras:
            self._chosen = cameras[(cameras.index(shown) + 1) % len(cameras)]

    @property
    def shows_first_camera(self) -> bool:
        """What is shown is of the robot's first camera: the one that it searches and whose field of view it tells."""
        return not self._chosen or self._chosen == next(iter(self.info.cameras), "")

    def found_in_picture(self, found: Detection2DArray) -> Detection2DArray:
        """What was found in the picture that is shown; nothing in another than the one that is searched."""
        return found if self.shows_first_camera else Detection2DArray()

    def knows(self, task: str) -> bool:
        """Whether the robot can be asked for that task, as `task_words.known` says."""
        return task in known(self.info)

    @property
    def control(self) -> str:
        """Who has control, as `Authority.who` says."""
        return self.authority.who

    @property
    def may_drive(self) -> bool:
        """The stick may be pushed: the link is alive, its clock known, STOP not pressed and control not another's.

        Of a robot that is not ours: the link is alive, it has a topic to drive by, and STOP is not latched here.
        """
        if self.foreign:
            alive = self.connected and not self.link.silent
            return alive and self.link.drive_topic is not None and not self.local_stop.latched
        status: ControlStatus | None = self.feeds.latest("/control/status")
        return (
            self.connected
            and not self.link.silent
            and math.isfinite(self.link.robot_time())
            and self.control != "other"
            and not (status is not None and status.stopped)
        )

    @property
    def may_ask(self) -> bool:
        """The robot can be asked for something from here: the link stands, and it is known that nobody else has control."""
        return self.connected and self.control not in ("other", "unknown")

    @property
    def stop_latched(self) -> bool:
        """STOP is known to be pressed, at the robot or, where it has none, here; whether it rests is another question."""
        if self.foreign:
            return self.local_stop.latched
        status: ControlStatus | None = self.feeds.latest("/control/status")
        return status is not None and status.stopped

    @property
    def stop_phase(self) -> str:
        """What became of STOP, as of `stopping.Verdict`; `ready` again when somebody has released it."""
        phase = self.local_stop.phase if self.foreign else self._stopping.verdict.phase
        return "ready" if phase == "released" else phase

    @property
    def stop_sentence(self) -> str:
        """The same for the operator; empty where the phase says it all."""
        if self.foreign:
            return self.local_stop.sentence(self.link.drive_topic is not None, self.connected)
        return self._stopping.verdict.sentence

    @property
    def stop_lost_for(self) -> float:
        """So long ago the link to a robot was lost that was stopped then [s]; NaN where it was not."""
        return self._stopping.lost_for

    @property
    def retry_in(self) -> float:
        """Until the next attempt to connect [s]; 0 while one is under way."""
        return max(0.0, self.link_state.retry_in - (self._now() - self._state_since))

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
            self._hear_event(post)
            return
        if channel == "/task/status":
            self._task = post
            post = replace(post, value=self.own_name.task(post.value, self.link.robot_time()))
        if channel in self.feeds:
            self.feeds.put(channel, post)
        takes: dict[str, Callable[[Any], None]] = {
            LINK: lambda state: self._link_changed(state, post.received),
            OFFER: self._offered,
            OUTCOME: self._outcome,
            MISSED: self.logbook.miss,
            KNOWN: self.logbook.know,
            "/task/queue": self.tasking.queue.robot_has,
        }
        if channel in takes:
            takes[channel](post.value)
        elif channel == "/odom":
            self.local_stop.hear(post.value, post.received)
        elif channel == "/robot/info":
            self._introduced()
        elif channel == "/mission":
            self._told_mission = post.value
            self._take_mission()
        elif channel == "/control/status":
            self._stopping.hear(post.value, post.received)
            self._learn_name(post.value)
            self._decide()
            self.authority.hear(post.value)
            self._take_control()
        self._tell(channel, post)

    def _hear_event(self, post: Post) -> None:
        if (
            self.wants_control
            and len(self._undecided) < UNDECIDED
            and self.own_name.undecided(post.value, self.link.robot_time())
        ):
            self._undecided.append(post)
        else:
            self._take_event(post)

    def _take_event(self, post: Post) -> None:
        stop = self.outcomes.get("stop" if "pressed" in post.value.text else "stop_release")
        asked = post.value.kind == "stop" and stop is not None and stop.phase in ("sent", "accepted")
        how = gave_stop(stop.origin) if asked and stop is not None else ""
        event = self.own_name.said(post.value, self.link.robot_time(), asked=asked, how=how)
        if self.logbook.take(event):
            post = replace(post, value=event)
            if not self.shown:
                self.early.append(post)
            self._tell(EVENT, post)

    def _decide(self) -> None:
        """The robot's word of control says whether what was told of somebody of our name was about us."""
        undecided, self._undecided = self._undecided, []
        for post in undecided:
            self._take_event(post)

    def _learn_name(self, status: ControlStatus) -> None:
        """What was said before of the task may have been about us."""
        before = self.own_name.known
        self.own_name.hear(status)
        if self.own_name.known != before and self._task is not None:
            self.deliver("/task/status", self._task)

    def _tell(self, channel: str, post: Post) -> None:
        for listener in list(self.listeners):
            listener(channel, post)

    def resume(self, link: Link) -> None:
        """Go on over a new link to the same robot; what was entered and heard stays."""
        self.link = link
        self._decide()
        if self.local_stop.latched:
            link.latch()
        stop = self.outcomes.get("stop")
        if stop is not None and stop.phase != "accepted":
            with origins.during(stop.origin):
                link.stop()
        if self.mission.sent is not None:
            self.mission.answered(self.mission.sent, False, "No reply: the link was closed.")
        self.tasking.dropped()
        self.logbook.dropped()
        self.missions.dropped()
        self._link_changed(link.state, self._now())

    def _offered(self, offer: Offer) -> None:
        self.offer = offer
        if offer.ours:
            self.local_stop.release()

    def _link_changed(self, state: LinkState, at: float) -> None:
        self.link_state, self._state_since = state, self._now()
        self.feeds.link(self.connected)
        hopeless = state.phase is Phase.CLOSED
        self._stopping.reach(self.connected, state.sentence, at=at, hopeless=hopeless)
        self.authority.link_changed()
        if not self.connected:
            self.on_rest()  # it may be back before anybody looks
        else:
            self.ever_connected = True
            self._asked_control = False
            self._take_control()

    def _outcome(self, outcome: Outcome) -> None:
        self.outcomes[outcome.name] = outcome
        if outcome.name == "stop":
            self._stopping.answered(outcome)
        if outcome.name == "mission" and outcome.phase != "sent":
            sent = Draft.of(outcome.fields["mission"])
            self.mission.answered(sent, outcome.phase == "accepted", outcome.sentence)
        self.tasking.answered(outcome)
        self.logbook.answered(outcome)
        self.missions.answered(outcome)

    def _introduced(self) -> None:
        if not self._known:
            self._known = True
            self.mission.load(self._drafts().get(self.name))
            self._take_mission()

    def _take_mission(self) -> None:
        """A draft of an earlier day is brought back before the robot's mission is compared with it."""
        if self._known and self._told_mission is not None:
            self.mission.robot_has(self._told_mission)
            self._told_mission = None

    def _take_control(self) -> None:
        """Ask once each time that control becomes free."""
        if self.control == "unknown":
            return
        if self.control != "free":
            self._asked_control = False
        elif self.wants_control and not self._asked_control:
            self._asked_control = True
            with origins.during(NOBODY):
                self.command("acquire")

    def _drafts(self) -> dict[str, Any]:
        drafts = self._settings.get("drafts", {})
        return drafts if isinstance(drafts, dict) else {}

    def _mission_changed(self) -> None:
        if not self._known:
            return
        drafts = {name: draft for name, draft in self._drafts().items() if name != self.name}
        if self.mission.dirty:
            drafts[self.name] = self.mission.save()
        self._settings.set("drafts", drafts)

    # what goes out

    def command(self, name: str, /, **fields: Any) -> None:
        """Send a one-shot command of `app.link.commands.COMMANDS`, from the origin that is current (`app.core.command_origin`)."""
        self.link.command(name, **fields)

    def stop(self) -> None:
        """STOP, by the robot's own service or, where it has none, by zero speed until `release_stop`."""
        if self.offer is None or self.foreign:
            self.local_stop.press()
        self._stopping.press()
        self.link.stop()

    def release_stop(self) -> None:
        """The operator wants to drive again; nothing moves by that alone."""
        self.local_stop.release()
        self._stopping.forget()
        self.outcomes.pop("stop", None)
        self.link.unlatch()
        if not self.foreign:
            self.command("stop_release")

    def take_control(self) -> None:
        """Take control, or ask who has it; it is taken again after a reconnect."""
        self.authority.take()

    def rest(self) -> None:
        """The robot is told to rest before anything that is asked of it afterwards; the stick must be pushed anew."""
        self.link.drive(Twist())
        self.on_rest()

    def send_mission(self) -> None:
        """Send the draft to the robot."""
        self.command("mission", mission=self.mission.sending())

    def place_robot(self, x: float, y: float, yaw: float) -> None:
        """Tell the robot that it is at (x, y) in `map` [m], turned to `yaw` [rad]."""
        covariance = [0.0] * 36
        for index, variance in zip((0, 7, 35), PLACED_WITHIN, strict=True):
            covariance[index] = variance
        stamp = self.link.robot_time()
        header = Header(Time.at(stamp) if math.isfinite(stamp) else Time(), "map")
        pose = Pose(Point(x, y), Quaternion.from_yaw(yaw))
        self.link.place(PoseWithCovarianceStamped(header, PoseWithCovariance(pose, covariance)))
