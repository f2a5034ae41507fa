"""The screen as a person sees it: the visible widgets, and where to touch them."""

from __future__ import annotations

import time
from collections.abc import Callable, Generator, Iterator
from typing import Any

from kivy.core.window import Window
from kivy.uix.scrollview import ScrollView
from kivy.uix.widget import Widget

from examples.demo.fingers import Hand, Point

__all__ = ["Glass", "Unseen"]

SCROLL_TOLERANCE = 12
"""Greatest distance of a widget from where it should be scrolled to [px]."""
Wait = Generator[None, None, Any]


class Unseen(Exception):
    """A widget that should be visible is not; the text is the sentence to print."""


def _tree(widget: Widget) -> Iterator[Widget]:
    for child in widget.children:
        yield from _tree(child)
    yield widget


def _visible(widget: Widget) -> bool:
    """Whether its middle lies on the screen and it is not transparent."""
    if widget.width < 1 or widget.height < 1:
        return False
    above: Any = widget
    while above is not None and above is not Window and above is not getattr(above, "parent", None):
        if above.opacity == 0:
            return False
        above = above.parent
    if above is not Window:
        return False
    x, y = middle(widget)
    return 0 <= x <= Window.width and 0 <= y <= Window.height


def middle(widget: Widget) -> Point:
    """The middle of a widget [px, window]."""
    return tuple(widget.to_window(*widget.center))  # type: ignore[return-value]


class Glass:
    """Looks for widgets by their class or by the words on them, and touches them with a hand."""

    def __init__(self, hand: Hand) -> None:
        self.hand = hand

    def all(self, kind: str) -> list[Widget]:
        """Visible widgets of the class named `kind`, or of one derived from it."""
        return self._seen(lambda widget: any(base.__name__ == kind for base in type(widget).__mro__))

    def _seen(self, wanted: Callable[[Any], bool]) -> list[Widget]:
        # few match, and the check of visibility takes the most time
        return [w for root in Window.children for w in _tree(root) if wanted(w) and _visible(w)]

    def texts(self) -> list[str]:
        """Everything that can be read."""
        found: list[Any] = self._seen(lambda widget: bool(getattr(widget, "text", "")))
        return [str(widget.text) for widget in found]

    def shows(self, words: str) -> bool:
        """Whether `words` can be read somewhere."""
        return any(words.lower() in text.lower() for text in self.texts())

    def labelled(self, words: str, kind: str = "Widget") -> list[Widget]:
        """Visible widgets of class `kind` whose own text is `words`, or begins with them; the best match first."""

        def says(widget: Any) -> str:
            return str(getattr(widget, "text", "")).strip().lower()

        def meant(widget: Any) -> bool:
            derived = any(base.__name__ == kind for base in type(widget).__mro__)
            return (
                derived and says(widget).startswith(words.lower()) and not getattr(widget, "disabled", False)
            )

        found = self._seen(meant)
        return sorted(found, key=lambda w: (says(w) != words.lower(), "on_press" not in w.events()))

    def icons(self, icon: str) -> list[Widget]:
        """Visible buttons that show `icon` and nothing else, and that can be pressed."""
        return [w for w in self.all("IconButton") if getattr(w, "icon", "") == icon and not w.disabled]

    def one(self, kind: str, seconds: float = 5.0) -> Wait:
        """Wait for a visible widget of the class `kind` and return it; Unseen when there is none in time."""
        yield from self.until(lambda: self.all(kind), seconds, f"a {kind} on the screen")
        return self.all(kind)[0]

    def until(self, condition: Callable[[], Any], seconds: float, what: str) -> Wait:
        """Wait until `condition` holds and return what it gave; Unseen when it does not within `seconds`."""
        found = yield from self.soon(condition, seconds)
        if not found:
            raise Unseen(f"waited {seconds:g} s for {what} in vain.")
        return found

    def soon(self, condition: Callable[[], Any], seconds: float) -> Wait:
        """Wait until `condition` holds, at most `seconds`; returns what it gave at last."""
        end = time.monotonic() + seconds
        while not (found := condition()) and time.monotonic() < end:
            yield
        return found

    def pause(self, seconds: float) -> Wait:
        """Let so much time pass."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            yield

    def press(self, words: str, seconds: float = 5.0, kind: str = "Widget") -> Wait:
        """Tap what has `words` written on it; Unseen when there is nothing of the kind in time."""
        found = yield from self.until(
            lambda: self.labelled(words, kind), seconds, f"something that says {words!r}"
        )
        yield from self.tap(found[0])

    def press_icon(self, icon: str, seconds: float = 5.0) -> Wait:
        """Tap the button with `icon` on it; Unseen when there is none in time."""
        found = yield from self.until(lambda: self.icons(icon), seconds, f"a button with the icon {icon}")
        yield from self.tap(found[0])

    def reach(self, kind: str) -> Wait:
        """Bring the widget of class `kind` into sight where a phone has no room for it, and return it.

        Scrolls, but does not draw a sheet up; Unseen when there is no such widget.
        """
        found = [w for root in Window.children for w in _tree(root) if type(w).__name__ == kind]
        if not found:
            raise Unseen(f"there is no {kind} on the screen.")
        yield from self.bring(found[0])
        return found[0]

    def sheet(self, up: int) -> Wait:
        """Draw a phone's sheet up (1) or down (0); nothing where there is none or it is so."""
        screens: list[Any] = self.all("MissionScreen")
        grips = self.all("SheetGrip")
        if grips and screens and screens[0].sheet != up:
            yield from self.tap(grips[0])
            yield from self.pause(0.3)

    def bring(self, widget: Widget) -> Wait:
        """Scroll until a widget is in sight."""
        above: Any = widget
        while above is not None and above is not Window and not isinstance(above, ScrollView):
            above = above.parent
        for _ in range(8):
            if not isinstance(above, ScrollView):
                return
            x, y = above.to_window(*above.center)
            off = y - middle(widget)[1]
            if (
                abs(off) + widget.height / 2 <= above.height / 2 + SCROLL_TOLERANCE
                or abs(off) < SCROLL_TOLERANCE
            ):
                return
            step = max(-above.height / 2.5, min(above.height / 2.5, off))
            yield from self.hand.drag([(x, y - step / 2), (x, y + step / 2)], hold=20)
            yield from self.pause(0.6)

    def tap(self, widget: Widget) -> Wait:
        """Tap a widget in its middle."""
        yield from self.hand.tap(middle(widget))

    def write(self, hint: str, words: str) -> Wait:
        """Tap the field that says `hint` while it is empty, and type `words`; Unseen when there is none."""

        def fields() -> list[Widget]:
            return [w for w in self.all("TextInput") if getattr(w, "hint_text", "").startswith(hint)]

        found = yield from self.until(fields, 5.0, f"a field that says {hint!r}")
        field: Any = found[0]
        yield from self.tap(field)
        yield from self.until(lambda: field.focus, 2.0, "the keyboard")
        for letter in words:
            Window.dispatch("on_textinput", letter)
        yield from self.until(lambda: words in field.text, 2.0, f"{words!r} in the field")
        field.focus = False
