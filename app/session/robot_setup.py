"""Protocols and payloads of the connected robot: how each is, what was asked for, and whether this handheld may ask."""

from __future__ import annotations

import math

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

__all__ = ["GATEWAYS", "PAYLOADS", "RobotSetup", "State"]

GATEWAYS, PAYLOADS, ME = "/gateways", "/payloads", "/people/me"
MAX_SHOWN = 64
"""Protocols, and payloads, that are shown of a robot that has more."""
State = tuple[str, str]
"""A sentence, and the role of its colour: `muted`, `text`, `accent`, `ok`, `warn` or `danger`."""
_GATEWAY_COMMANDS = ("gateway_up", "gateway_down")


class RobotSetup:
    """What is here is only what the robot said, while somebody looks; lives in the UI thread."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._gateways: GatewayArray | None = None
        self._payloads: PayloadArray | None = None
        self._role: Role | None = None
        self._outcomes: dict[tuple[str, str], Outcome] = {}
        """What became of the newest wish for each protocol and payload, by its kind and name."""

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
        if channel == GATEWAYS:
            self._gateways = value
        elif channel == PAYLOADS:
            self._payloads = value
        elif channel == OUTCOME and value.name in (*_GATEWAY_COMMANDS, "payload"):
            kind = PAYLOADS if value.name == "payload" else GATEWAYS
            self._outcomes[kind, value.fields["key" if kind == PAYLOADS else "name"]] = value
        elif channel == ANSWER and isinstance(value, Answer) and value.service == ME:
            found = value.message
            self._role = _role(found.role) if isinstance(found, GetMeResponse) else None
        elif channel == LINK and self._session.connected:
            self._ask_role()
        else:
            return False
        return True

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
            return "There is no link; what can be seen was so before."
        offer = session.robot.capabilities
        if offer is not None and not (offer.serves("/gateways/bring_up") or offer.serves("/payloads/set")):
            return "This robot's protocols and payloads cannot be switched from here."
        if self._role is None:
            return "Asking the robot what may be switched from here …"
        if self._role < Role.MANAGE:
            return f"Only who manages the robot switches these; this handheld has the role {self._role.word}."
        return ""

    @property
    def sentence(self) -> State:
        """What is to be known of all of it: how old it is, or why it cannot be switched."""
        if not self._session.connected:
            age = self._session.feeds.age(GATEWAYS)
            since = f" It is {age:.0f} s old." if self.gateways and math.isfinite(age) else ""
            return f"{self.why_not}{since}", "warn"
        if self.why_not:
            return self.why_not, "muted"
        if not self.gateways and not self.payloads:
            return "Asking the robot …", "muted"
        return "As the robot says it now. A payload that is off takes no power, a protocol no port.", "muted"

    def gateway_state(self, gateway: Gateway) -> State:
        """How a protocol is, in one sentence."""
        asked = self._asked(GATEWAYS, gateway.name)
        if gateway.state == "up":
            return gateway.endpoint or "up", "ok"
        if gateway.state == "lost":
            return gateway.fault or "Its broker is not reached.", "warn"
        if gateway.state == "going_down":
            return "Going down …", "accent"
        if gateway.state == "coming_up" or asked:
            return f"Coming up … {asked}".strip(), "accent"
        if gateway.package:
            return f"Needs {gateway.package}, which the robot lacks.", "warn"
        return (gateway.fault, "warn") if gateway.fault else (gateway.doc, "muted")

    def payload_state(self, payload: Payload) -> State:
        """How a payload is, in one sentence."""
        if self._asked(PAYLOADS, payload.key):
            return "Asked for …", "accent"
        return (payload.why, "muted") if payload.why else (payload.doc, "muted")

    def refusal(self, kind: str, name: str) -> str:
        """What the robot has against what was last asked of it, `kind` `GATEWAYS` or `PAYLOADS`; empty for nothing."""
        outcome = self._outcomes.get((kind, name))
        if outcome is None or outcome.phase in ("sent", "accepted"):
            return ""
        return outcome.reason if outcome.phase == "refused" else f"The robot did not answer. {outcome.reason}"

    def may(self, kind: str, name: str) -> bool:
        """It can be switched now: the robot told how it is, and nothing is on its way."""
        return not self.why_not and not self._asked(kind, name)

    def _asked(self, kind: str, name: str) -> str:
        """For how long something has been asked for, as words; empty when nothing is."""
        outcome = self._outcomes.get((kind, name))
        if outcome is None or outcome.phase != "sent" or not self._session.connected:
            return ""
        return f"{max(0.0, self._session.now() - outcome.sent):.0f} s"

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


def _role(word: str) -> Role | None:
    try:
        return Role.read(word)
    except ValueError:
        return None
