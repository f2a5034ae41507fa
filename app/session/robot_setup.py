"""Protocols and payloads of the connected robot: how each is, what was asked for, and whether this handheld may ask."""

from __future__ import annotations

import math

from app.core.robot_docs import ROLES
from app.link.channels import ANSWER, LINK, OUTCOME, Answer
from app.link.commands import Outcome
from app.link.feeds import Post
from app.session.session import Session
from bridge.core.identity import Role
from bridge.msgs.pilothouse_msgs import (
    Gateway,
    GatewayArray,
    GetMeRequest,
    GetMeResponse,
    Payload,
    PayloadArray,
)
from widgets.core.language import mark, tr

__all__ = ["GATEWAYS", "PAYLOADS", "RobotSetup", "State"]

GATEWAYS, PAYLOADS, ME = "/gateways", "/payloads", "/people/me"
MAX_SHOWN = 64
"""Protocols, and payloads, that are shown of a robot that has more."""
State = tuple[str, str]
"""A sentence, and the role of its colour: `muted`, `text`, `accent`, `ok`, `warn` or `danger`."""
_GATEWAY_COMMANDS = ("gateway_up", "gateway_down")
SILENCE_SHOWN = 2.0
"""A silence of the robot over a link that stands is told from here on [s]; shorter ones come and go."""
MAX_WAIT = 60.0
"""What has no answer by then gets none, as when its link was exchanged for another: it may be asked for again [s]."""
_TURNING = {"coming_up": mark("Coming up"), "going_down": mark("Going down")}
_WISHES = {"gateway_up": (mark("come up"), "coming_up"), "gateway_down": (mark("go down"), "going_down")}


class RobotSetup:
    """What is here is only what the robot said, while somebody looks; lives in the UI thread."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._gateways: GatewayArray | None = None
        self._payloads: PayloadArray | None = None
        self._role: Role | None = None
        self._outcomes: dict[tuple[str, str], Outcome] = {}
        """What became of the newest wish for each protocol and payload, by its kind and name."""
        self._ended: dict[tuple[str, str], float] = {}
        """When that was heard, by our clock [s]."""
        self._told = {GATEWAYS: -math.inf, PAYLOADS: -math.inf}
        """When the robot last said how its protocols, and payloads, are [s]."""
        self._heard = math.nan
        """When the robot was last heard of before the link was lost [s]; NaN before that."""

    # who looks

    def enter(self) -> None:
        """Somebody looks: have the robot tell."""
        for topic in (GATEWAYS, PAYLOADS):
            self._session.link.want(topic, True)
        self._ask_role()

    def leave(self) -> None:
        """Nobody looks any more; what is known is forgotten, for it will not be true."""
        for topic in (GATEWAYS, PAYLOADS):
            self._session.link.want(topic, False)
        self._gateways = self._payloads = None
        self._outcomes = {key: each for key, each in self._outcomes.items() if each.phase == "sent"}

    def on_post(self, channel: str, post: Post) -> bool:
        """Take in what came; whether anything is otherwise now."""
        value = post.value
        if channel in self._told:
            self._told[channel] = post.received
        if channel == GATEWAYS:
            self._gateways = value
        elif channel == PAYLOADS:
            self._payloads = value
        elif channel == OUTCOME and value.name in (*_GATEWAY_COMMANDS, "payload"):
            kind = PAYLOADS if value.name == "payload" else GATEWAYS
            key = kind, value.fields["key" if kind == PAYLOADS else "name"]
            self._outcomes[key], self._ended[key] = value, post.received
        elif channel == ANSWER and isinstance(value, Answer) and value.service == ME:
            found = value.message
            self._role = _role(found.role) if isinstance(found, GetMeResponse) else None
        elif channel == LINK:
            self._on_link()
        else:
            return False
        return True

    def _on_link(self) -> None:
        if self._session.connected:
            self._ask_role()
        elif math.isfinite(self._session.link.silence):
            self._heard = self._session.now() - self._session.link.silence

    def _ask_role(self) -> None:
        self._role = None
        if self._session.robot.offers(ME):
            self._session.link.ask(ME, GetMeRequest(), GetMeResponse)
        else:
            self._role = Role.MANAGE  # a robot that knows nobody lets everybody do it

    # how it is

    @property
    def gateways(self) -> list[Gateway]:
        """The robot's protocols; empty until it told."""
        return self._gateways.gateways[:MAX_SHOWN] if self._gateways else []

    @property
    def payloads(self) -> list[Payload]:
        """The robot's payloads; empty until it told."""
        return self._payloads.payloads[:MAX_SHOWN] if self._payloads else []

    @property
    def why_not(self) -> str:
        """Why nothing can be switched from here, as one sentence; empty where it can."""
        session = self._session
        if not session.connected:
            return tr("There is no link; what can be seen was so before.")
        offer = session.robot.capabilities
        if offer is not None and not (offer.serves("/gateways/bring_up") or offer.serves("/payloads/set")):
            return tr("This robot's protocols and payloads cannot be switched from here.")
        if self._role is None:
            return tr("Asking the robot what may be switched from here …")
        if self._role < Role.MANAGE:
            return tr("Only who manages the robot switches these; this handheld has the role {role}.").format(
                role=tr(ROLES[self._role.word])
            )
        return ""

    @property
    def age(self) -> float:
        """Since when the robot has said nothing [s]: what is seen was so then. 0 while it is heard; NaN when not known."""
        if self._session.connected:
            silence = self._session.link.silence
            return silence if silence >= SILENCE_SHOWN and math.isfinite(silence) else 0.0
        return self._session.now() - self._heard

    @property
    def sentence(self) -> State:
        """What is to be known of all of it: how old it is, or why it cannot be switched."""
        if not self._session.connected:
            since = (
                tr(" It is {age:.0f} s old.").format(age=self.age)
                if self.gateways and math.isfinite(self.age)
                else ""
            )
            return f"{self.why_not}{since}", "warn"
        if self.age > 0.0:
            return tr("The robot is silent; what can be seen is {age:.0f} s old.").format(
                age=self.age
            ), "warn"
        if self.why_not:
            return self.why_not, "muted"
        if not self.gateways and not self.payloads:
            return tr("Asking the robot …"), "muted"
        return tr(
            "As the robot says it now. A payload that is off takes no power, a protocol no port."
        ), "muted"

    def gateway_state(self, gateway: Gateway) -> State:
        """How a protocol is, in one sentence."""
        wish = self._open(GATEWAYS, gateway.name)
        if wish is not None and not _fulfilled(wish, gateway):
            return self._waiting(wish, gateway)
        if gateway.state == "up":
            return self._up(gateway), "ok" if self.age == 0.0 else "muted"
        if gateway.state == "lost":
            return gateway.fault or tr("Its broker is not reached."), "warn"
        if gateway.state in _TURNING:
            word = tr(_TURNING[gateway.state])
            return (f"{word} …", "accent") if self.age == 0.0 else (_ago(word, self.age), "warn")
        if gateway.package:
            return tr("Needs {package}, which the robot lacks.").format(package=gateway.package), "warn"
        return (gateway.fault, "warn") if gateway.fault else (tr(gateway.doc), "muted")

    @staticmethod
    def _up(gateway: Gateway) -> str:
        words = [
            gateway.endpoint or tr("up", context="gateway"),
            *([tr("always up")] if gateway.fixed else []),
        ]
        return " · ".join(words)

    def _waiting(self, wish: Outcome, gateway: Gateway) -> State:
        """What was asked for, and for how long; that the robot turns already, where it said so, is its last word."""
        asked, turning = _WISHES[wish.name]
        since = tr("{seconds:.0f} s").format(seconds=max(0.0, self._session.now() - wish.sent))
        if wish.phase == "sent" and self.age == 0.0:
            return f"{tr(_TURNING[turning])} … {since}", "accent"
        if gateway.state == turning and math.isfinite(self.age):
            return _ago(tr(_TURNING[turning]), self.age), "warn"
        words = tr("Asked to {act}; not answered for {time}")
        return words.format(act=tr(asked), time=since), "warn"

    def payload_state(self, payload: Payload) -> State:
        """How a payload is, in one sentence."""
        asked = self._asked_for(payload)
        if asked is not None:
            return asked
        return tr(payload.why or payload.doc), "muted"

    def on_or_off(self, payload: Payload) -> State:
        """The same in a word, with its age where the robot is not heard."""
        asked = self._asked_for(payload)
        if asked is not None:
            return asked
        on, heard = tr("On") if payload.on else tr("Off"), self.age == 0.0
        told = on if heard or math.isnan(self.age) else _ago(on, self.age)
        return told, "ok" if payload.on and heard else "muted"

    def _asked_for(self, payload: Payload) -> State | None:
        wish = self._open(PAYLOADS, payload.key)
        if wish is None or (wish.phase == "no_reply" and wish.fields["on"] == payload.on):
            return None
        if wish.phase == "sent" and self.age == 0.0:
            return tr("Asked for …"), "accent"
        since = max(0.0, self._session.now() - wish.sent)
        asked = (
            tr("Asked for on; not answered for {since:.0f} s")
            if wish.fields["on"]
            else tr("Asked for off; not answered for {since:.0f} s")
        )
        return asked.format(since=since), "warn"

    def refusal(self, kind: str, name: str) -> str:
        """What the robot has against what was last asked of it, `kind` `GATEWAYS` or `PAYLOADS`; empty for nothing."""
        outcome = self._outcomes.get((kind, name))
        if outcome is None or outcome.phase in ("sent", "accepted"):
            return ""
        return (
            outcome.reason
            if outcome.phase == "refused"
            else tr("The robot did not answer. {reason}").format(reason=outcome.reason)
        )

    def may(self, kind: str, name: str) -> bool:
        """It can be switched now: the robot told how it is, and nothing is on its way."""
        outcome = self._outcomes.get((kind, name))
        if self.why_not or outcome is None or outcome.phase != "sent":
            return not self.why_not
        return self._session.now() - outcome.sent > MAX_WAIT

    def _open(self, kind: str, name: str) -> Outcome | None:
        """What was asked for and not answered, until the robot says how it is after it was given up; None for nothing."""
        outcome = self._outcomes.get((kind, name))
        if outcome is None or outcome.phase not in ("sent", "no_reply"):
            return None
        over = outcome.phase == "no_reply" or self._session.now() - outcome.sent > MAX_WAIT
        given_up = self._ended[kind, name] if outcome.phase == "no_reply" else outcome.sent
        return None if over and self._told[kind] > given_up else outcome

    # what is asked

    def bring_up(self, name: str, url: str) -> None:
        """Ask for a protocol, at `url` or where that is empty at its usual one."""
        self._session.command("gateway_up", name=name, url=url)

    def bring_down(self, name: str) -> None:
        """Ask for the end of a protocol."""
        self._session.command("gateway_down", name=name)

    def switch(self, key: str, on: bool) -> None:
        """Ask for a payload on or off."""
        self._session.command("payload", key=key, on=on)


def _fulfilled(wish: Outcome, gateway: Gateway) -> bool:
    """The robot says that it is as it was wished."""
    return gateway.state in (("up", "lost") if wish.name == "gateway_up" else ("down",))


def _role(word: str) -> Role | None:
    try:
        return Role.read(word)
    except ValueError:
        return None


def _ago(what: str, age: float) -> str:
    """What was so, and how long ago that was heard [s]."""
    return tr("{what} {age:.0f} s ago").format(what=what, age=age)
