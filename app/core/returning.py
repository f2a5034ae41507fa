"""Where the app was when the system took the glass away: a process that was ended meanwhile goes back there at its next start."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection
from typing import Protocol

from app.core.settings_store import Settings
from widgets.core.language import mark, tr

__all__ = ["MAX_AWAY", "Returning"]

KEY = "put_away"
MAX_AWAY = 3600.0
"""Who comes back later than that [s] begins with the list of robots."""
MAX_URL = 300
"""Characters of an address; nothing longer was kept by this app."""
WRITTEN_WITHIN = 0.3
"""The system lets an app that goes to the background do this much [s]; after it the process may be frozen or ended."""
ENDED = mark(
    "The system ended the app while it was away. This is where you were; the app drives nothing until you push the stick."
)


class Host(Protocol):
    """The app, as far as going back needs it."""

    settings: Settings

    def open(self, url: str, *, watch: bool = ...) -> None:
        """Connect to a robot, only to `watch` it or to take control when that is free."""

    def say(self, text: str, level: str) -> None:
        """Show one sentence, wherever the operator looks."""


class Returning:
    """Kept in the settings while the app is away, and at no other time: who ends the app by hand, or leaves the robot, begins anew.

    Everything here happens in the UI thread.
    """

    def __init__(self, app: Host, screens: Collection[str], clock: Callable[[], float] = time.time) -> None:
        """`screens` are the names of those that there are; `clock` is the system's [s]: ours does not outlive the process."""
        self._app, self._screens, self._clock = app, screens, clock
        self._untold = False
        """This process began where one before it was ended, and nobody was told."""

    def put_away(self, url: str, screen: str, *, watch: bool) -> None:
        """The glass is taken away from a robot's screen; what is kept is on the disk when this returns, or shortly after.

        `url` is the robot's address, empty where there is none to go back to; `watch` says that control was not wanted of it.
        """
        place = {"url": url, "screen": screen, "watch": watch, "at": self._clock()} if url else None
        self._app.settings.set(KEY, place)
        self._app.settings.flush(WRITTEN_WITHIN)

    def forget(self) -> None:
        """The glass is back."""
        if self._app.settings.get(KEY) is not None:
            self._app.settings.set(KEY, None)

    def begin(self) -> str:
        """Go back to a robot, and say to which screen; empty, and nothing happens, where there is none.

        Nor where it was too long ago, by a clock that was set since, or what was kept is nothing that this app keeps.
        """
        kept = self._app.settings.get(KEY)
        self.forget()
        if not isinstance(kept, dict):
            return ""
        url, screen, at = kept.get("url"), kept.get("screen"), kept.get("at")
        if not isinstance(url, str) or len(url) > MAX_URL or not url.startswith(("ws://", "wss://")):
            return ""
        if not isinstance(at, int | float) or not 0 <= self._clock() - at <= MAX_AWAY:
            return ""
        if not isinstance(screen, str) or screen not in self._screens:
            return ""
        self._untold = True
        self._app.open(url, watch=kept.get("watch") is True)
        return screen

    def tell(self) -> None:
        """Say once why the app did not begin with the list of robots; the robot's screens are on the glass."""
        if self._untold:
            self._untold = False
            self._app.say(tr(ENDED), "info")
