"""The app's rhythm: how often it looks at its mailbox, its hands and its lists."""

from __future__ import annotations

from collections.abc import Callable

from kivy.clock import Clock
from kivy.core.window import Window

from app.device import sdl_library
from app.device.gl_fences import GlFences
from app.frame_pacing import FramePacer

__all__ = ["BEAT_PERIOD", "GLASS_PERIOD", "LIST_PERIOD", "TICK_EVERY", "Timers"]

GLASS_PERIOD = 1 / 30
"""Between two looks at what came that is not urgent [s]."""
TICK_EVERY = 3
"""Every so many of them what only time changes is brought up to date as well."""
BEAT_PERIOD = 0.03
"""Between two heartbeats of the user interface [s]; without one for 0.15 s the robot rests."""
LIST_PERIOD = 0.5
"""Between two looks at the list of robots [s]."""


class Timers:
    """Calls what is due in the UI thread until it is closed."""

    def __init__(
        self,
        look: Callable[[], object],
        beat: Callable[[], object],
        refresh_list: Callable[[], object],
        pushed: Callable[[], bool],
        *,
        poll: bool,
    ) -> None:
        """`pushed` says whether a control is out of its middle. `poll` looks for fingers once more a frame, and before it is drawn, and begins a frame when the one before is through.

        It is for desktops: Android's window system paces frames by itself, and this was not tried on a phone.
        """
        self.pacer = FramePacer(Window, GlFences.of(sdl_library()) if poll else None, pushed=pushed)
        self._events = [
            Clock.schedule_interval(lambda _: look(), GLASS_PERIOD),
            Clock.schedule_interval(lambda _: beat(), BEAT_PERIOD),
            Clock.schedule_interval(lambda _: refresh_list(), LIST_PERIOD),
        ]
        if poll:  # Kivy hands a touch on two frames after it came; this saves one of them
            self._events.append(Clock.schedule_interval(lambda _: Window.mainloop(), 0))
            self.pacer.open()

    def close(self) -> None:
        """Call nothing any more."""
        for event in self._events:
            event.cancel()
        self.pacer.close()
