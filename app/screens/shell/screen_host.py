"""The app, as the screens of a connected robot know it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from app.inputs.methods import Methods
from app.maps.maps import Maps
from app.screens.shell.shell import Shell, Visit
from app.session.recordings import Recordings

__all__ = ["ScreenHost"]


class ScreenHost(Protocol):
    """What a screen asks of the app: to speak, to show another screen, to say which inputs are armed."""

    methods: Methods
    records: Recordings

    @property
    def maps(self) -> Maps:
        """Maps of the operator's choice."""

    @property
    def visit(self) -> Visit:
        """The visit to the robot."""

    @property
    def shell(self) -> Shell | None:
        """The frame round the screens; None before it is made."""

    @property
    def screens(self) -> Mapping[str, Any]:
        """Every screen by its name."""

    def show(self, screen: str) -> None:
        """Put the screen of that name on the glass; KeyError for an unknown one."""
