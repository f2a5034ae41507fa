"""What the operator's hands and the system do to the app as a whole: keys, and a window that goes away."""

from __future__ import annotations

from collections.abc import Callable

from kivy.core.window import Window

__all__ = ["BACK", "Inputs"]

RESTING = ("size", "on_hide", "on_minimize")
"""What happens to the window and brings every control to rest."""
BACK = 27
"""Key code of Android's Back and of Escape."""


class Inputs:
    """Listens to the window from `open` to `close`. Everything here happens in the UI thread."""

    def __init__(self, rest: Callable[[], object], back: Callable[[], bool]) -> None:
        """`rest` lets every control go; `back` is Back, true when it is not left to the system."""
        self._rest_all, self._back = rest, back

    def open(self) -> None:
        """Begin to listen."""
        Window.bind(on_keyboard=self._key, focus=self._focus, **dict.fromkeys(RESTING, self._rest))

    def close(self) -> None:
        """Listen no longer."""
        Window.unbind(on_keyboard=self._key, focus=self._focus, **dict.fromkeys(RESTING, self._rest))

    def _rest(self, *_: object) -> None:
        self._rest_all()

    def _focus(self, _: object, focus: bool) -> None:
        if not focus:
            self._rest_all()

    def _key(self, _window: object, key: int, *_: object) -> bool:
        return self._back() if key == BACK else False
