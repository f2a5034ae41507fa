"""The gate of a robot's door: who a client is, and the role that an operation needs."""

from __future__ import annotations

from typing import Protocol

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import Identity, Role
from bridge.core.robot_catalogue import Operator
from robotside.core.notice import Notice
from robotside.trust.permissions import needed_role

__all__ = ["OPEN", "Gate", "check_role", "who_comes"]


class Gate(Protocol):
    """Knows the people of a robot."""

    def admit(self, address: str, *, trusted: bool) -> Identity:
        """Who a client from `address`, `HOST:PORT`, is that shows no token.

        One that is not `trusted` may be a web page and never counts as a program of this machine.
        """

    def identify(self, token: str, address: str, client: str = "", *, forgeable: bool = False) -> Identity:
        """Whose token it is; raises Refused, with one sentence for every reason.

        `client` is the name of who shows it where `address` is that of a broker with many behind it. An address that nothing
        proves is `forgeable`: wrong tokens from there lock out nobody who connects.
        """

    def needed(self, verb: str, name: str) -> Role:
        """The role that an operation needs, as of `robotside.trust.permissions`."""


class _Open:
    """Lets everybody in: for a robot that only this process reaches."""

    def admit(self, address: str, *, trusted: bool) -> Identity:
        return Identity("", "", Role.MANAGE)

    def identify(self, token: str, address: str, client: str = "", *, forgeable: bool = False) -> Identity:
        raise Refused("This robot knows no keys.")

    def needed(self, verb: str, name: str) -> Role:
        return needed_role(verb, name)


OPEN: Gate = _Open()
"""The gate of a robot that only this process reaches."""


def who_comes(
    gate: Gate,
    address: str,
    token: str,
    *,
    trusted: bool,
    role: Role | None,
    client: str = "",
    forgeable: bool = False,
) -> Identity:
    """Who a client is: by its token, else with the `role` that everybody has who comes its way, None where its address decides.

    Raises Refused for a wrong token.
    """
    if token and forgeable:
        return gate.identify(token, address, client, forgeable=True)
    if token:
        return gate.identify(token, address, client)
    return gate.admit(address, trusted=trusted) if role is None else Identity("", "", role)


def check_role(gate: Gate, operator: Operator, now: float, verb: str, name: str) -> None:
    """Raises Refused when the role of `operator` at `now` [s, operators' clock] is too small for an operation."""
    role = operator.role(now)
    needed = gate.needed(verb, name)
    if role >= needed:
        return
    if role is Role.NONE:
        said = f"{name} is for those whom this robot knows: pair with it first, or show a token."
        raise Refused(Notice(Code.TRUST_UNKNOWN, said, operation=f"{verb} {name}"))
    said = f"{name} needs the role {needed.word}; you have {role.word}."
    raise Refused(
        Notice(Code.TRUST_ROLE, said, operation=f"{verb} {name}", role=role.word, needed=needed.word)
    )
