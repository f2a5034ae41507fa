"""Pads and keyboards that open for a target that takes more than a press.

Every step reaches the thing as a finger would (`finger`), and is over when it returns. What drives is pushed for a moment
only; a press goes on with it, and whatever else is marked ends it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from kivy.clock import Clock
from kivy.uix.widget import Widget

from app.inputs.switch_access.window import finger
from app.inputs.switch_access.window.area import Area
from app.inputs.switch_access.window.finding import Box, in_window
from app.inputs.switch_access.window.placing import beside
from app.inputs.switch_access.window.window_app import WindowApp
from widgets.controls.stop.stop_button import LONG_HOLD_DURATION, RELEASE_DURATION
from widgets.core.language import tr
from widgets.inputs.scan_keyboard import ScanKeyboard
from widgets.inputs.scan_pad import PadKey, ScanPad

__all__ = ["PUSH_TIME", "Openings"]

PUSH_TIME = 1.0
"""One press drives for so long [s]; then the stick is at rest again."""
MAX_HOLD_FACTOR = 6.0
"""A hold by a switch may last so many times as long as it must: where frames are slow they count for less than they took."""
SLOW_SHARE = 0.4
"""Of the whole way, where a stick is pushed gently."""
FADER_STEPS = 10
LEANS = {"ahead": (1.0, 0.0), "back": (-1.0, 0.0), "left": (0.0, 1.0), "right": (0.0, -1.0)}
"""Key to how a stick leans: forward, left."""


class Openings:
    """One pad at a time, over the page; `pad` is the one that is open, or None."""

    def __init__(self, app: WindowApp, words: Callable[[str], Iterable[str]]) -> None:
        """`words` are those that are likely to be typed: for a kind of field, as `url`."""
        self._app, self._words = app, words
        self.pad: ScanPad | None = None
        self.kind = ""
        """Of what it belongs to, as in `app.inputs.switch_access.window.kinds`."""
        self._of: Widget | None = None
        self._area: Area | None = None
        self._slow = True
        self._ending: Any = None
        self._lift: Callable[[], None] | None = None

    def open(self, kind: str, widget: Any, words: str) -> None:
        """Open what belongs to a widget of that kind, as in `app.inputs.switch_access.window.kinds`; `words` name it."""
        self.close()
        self._of, self.kind = widget, kind
        if kind == "field":
            self._show(self._keyboard(widget, words))
        elif kind in ("map", "area"):
            self._area = Area(self._app.root, widget, moves=kind == "map")
            self._show(ScanPad(title=words, rows=self._area.rows()), self._area.press)
        else:
            rows, press = self._steps(kind, widget)
            self._show(ScanPad(title=words, rows=rows), press)

    def close(self) -> None:
        """Take the pad away; what it pushes comes to rest."""
        self.halt()
        if self._area is not None:
            self._area.close()
        if self.pad is not None and self.pad.parent is not None:
            self.pad.parent.remove_widget(self.pad)
        self.pad = self._of = self._area = None

    def halt(self) -> None:
        """STOP: nothing that was begun goes on, a release of STOP least of all."""
        self.rest()
        if self._lift is not None:
            self._lift()
            self._lift = None

    def update(self) -> None:
        """What the pad belongs to is gone, or may not be used any more: so is the pad."""
        if self.pad is None:
            return
        widget = self._of
        gone = widget is None or widget.get_root_window() is None or widget.disabled
        if gone or self.pad.parent is not self._app.root:
            self.close()

    def rest(self) -> None:
        """What is pushed for a moment is let go; a hold that releases something goes on to its end."""
        if self._ending is not None:
            self._ending.cancel()
            self._ending = None
            stick: Any = self._of
            if stick is not None and stick.finger is None:
                stick.rest()

    # what they are

    def _show(self, pad: ScanPad, press: Callable[[str], object] | None = None) -> None:
        self.pad = pad
        if press is not None:
            pad.bind(on_key=lambda _, name: self.close() if name == "done" else press(name))
        self._place()
        pad.bind(height=self._place)
        self._app.root.add_widget(pad)

    def _place(self, *_: object) -> None:
        """Beside what it belongs to, and never over STOP."""
        root, pad = self._app.root, self.pad
        if pad is None or self._of is None:
            return
        keep = [in_window(self._of)]
        pad.width = min(max(pad.least, 360.0), root.width - 16)
        pad.pos = beside((pad.width, pad.height), (0, 0, root.width, root.height), [*self.stops(), *keep])
        if self._area is not None:
            self._area.beside(pad)

    def stops(self) -> list[Box]:
        """Where STOP and STOP ALL are [px]."""
        shell, corner = self._app.shell, self._app.corner
        shown = [shell.stop] if shell is not None else []
        shown += [corner.button] if corner.button.parent is not None else []
        return [in_window(one) for one in shown]

    def _keyboard(self, field: Any, words: str) -> ScanKeyboard:
        kind = field.input_type if field.input_type in ("url", "number", "tel") else "text"
        if field.input_filter in ("int", "float"):
            kind = "number"
        title = str(getattr(field, "label", "") or field.hint_text or words)
        board = ScanKeyboard(title=title, kind=kind, text=field.text, words=list(self._words(kind)))
        board.room = self._app.root.height * 0.62
        board.bind(on_type=lambda _, text: setattr(field, "text", text))
        board.bind(on_done=lambda _: self.close(), on_enter=lambda _: self._enter(field))
        return board

    def _enter(self, field: Any) -> None:
        self.close()
        field.dispatch("on_text_validate")

    def _steps(self, kind: str, widget: Any) -> tuple[list[list[PadKey]], Callable[[str], object]]:
        if kind == "stick":
            return self._stick_rows(widget), lambda name: self._push(widget, name)
        if kind == "fader":
            less, more = (
                PadKey("less", tr("Less"), "remove", repeats=True),
                PadKey("more", tr("More"), "add", repeats=True),
            )
            return [[less, more, _done()]], lambda name: _slide_fader(widget, 1 if name == "more" else -1)
        if kind == "handle":
            up = PadKey("up", tr("Up"), "arrow_upward", repeats=True)
            down = PadKey("down", tr("Down"), "arrow_downward", repeats=True)
            return [[up, down, _done()]], lambda name: _carry(widget, 1 if name == "up" else -1)
        yes = {
            "slide": (tr("Slide to {what}").format(what=getattr(widget, "text", "")), "chevron_right")
        }.get(kind)
        text, icon = yes or (_held_words(widget), "lock_open")
        sure = PadKey("sure", text, icon)
        return [[PadKey("done", tr("Not now"), "close"), sure]], lambda _: self._sure(kind, widget)

    def _stick_rows(self, stick: Any) -> list[list[PadKey]]:
        aside = bool(stick.shaped(0.0, 1.0)[1])
        slow = PadKey(
            "slow", tr("Slow"), "speed", tr("Full push") if self._slow else tr("Slow push"), on=self._slow
        )

        def push(name: str, words: str, icon: str) -> PadKey:
            return PadKey(name, words, icon, repeats=True)

        ahead, back = (
            push("ahead", tr("Ahead"), "arrow_upward"),
            push("back", tr("Back", context="way"), "arrow_downward"),
        )
        if not aside:
            return [[ahead, back], [slow, _done()]]
        return [
            [push("left", tr("Left"), "arrow_back"), ahead, push("right", tr("Right"), "arrow_forward")],
            [slow, back, _done()],
        ]

    def _push(self, stick: Any, name: str) -> None:
        """Drive for a moment; again goes on with it."""
        if name == "slow":
            self._slow = not self._slow
            if self.pad is not None:
                self.pad.rows = self._stick_rows(stick)
            return
        if self._ending is not None:
            self._ending.cancel()
        share = SLOW_SHARE if self._slow else 1.0
        forward, left = LEANS[name]
        if not stick.disabled and stick.lean(forward * share, left * share):
            self._ending = Clock.create_trigger(lambda _: self.rest(), PUSH_TIME)
            self._ending()

    def _sure(self, kind: str, widget: Any) -> None:
        """It was chosen twice: do what a finger does by sliding or by staying."""
        self.close()
        if kind == "slide":
            left, low, wide, high = widget.track
            middle = low + high / 2
            finger.drag(widget, [(left + high / 2, middle), (left + wide + high, middle)])
            return
        latched = getattr(widget, "phase", "stopped") == "stopped"
        self._lift = finger.hold(
            widget,
            (RELEASE_DURATION if latched else LONG_HOLD_DURATION) * MAX_HOLD_FACTOR,
            until="on_held_long",
        )


def _done() -> PadKey:
    return PadKey("done", tr("Done"), "check")


def _held_words(widget: Any) -> str:
    return str(getattr(widget, "text", "") or tr("Release STOP"))


def _slide_fader(fader: Any, steps: int) -> None:
    share = min(max(fader.value_normalized + steps / FADER_STEPS, 0.0), 1.0)
    finger.tap(fader, (fader.center_x, fader.low + share * (fader.high - fader.low)))


def _carry(handle: Any, rows: int) -> None:
    """Drag a row past its neighbour."""
    row: Any = handle
    while row.parent is not None and len(row.parent.children) < 2:
        row = row.parent
    while row.parent is not None and row.height < handle.height:
        row = row.parent
    row = handle.parent or handle
    x, y = handle.center
    finger.drag(handle, [(x, y), (x, y + rows * row.height * 1.1)])
