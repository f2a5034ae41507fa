"""The glass as the engine of scanning sees it: what can be done now, and the mark over it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from kivy.uix.label import Label
from kivy.uix.scrollview import ScrollView

from app.inputs.base.modal import Modal
from app.inputs.switch_access.scan.target import Mark, Target
from app.inputs.switch_access.window import finger
from app.inputs.switch_access.window.finding import Box, Found, find, in_window
from app.inputs.switch_access.window.kinds import kind_of
from app.inputs.switch_access.window.naming import beside, intent_of, slug, words_of
from app.inputs.switch_access.window.openings import Openings
from app.inputs.switch_access.window.ring import Ring
from app.inputs.switch_access.window.window_app import WindowApp
from bridge.discovery.interfaces import broadcast_addresses
from bridge.msgs.pilothouse_msgs import PlaceArray
from widgets.core.language import mark, tr
from widgets.inputs.scan_pad import PadButton, ScanPad
from widgets.parts.cards import ActionToast

__all__ = ["WindowTargets"]

OPENS = ("field", "map", "area", "stick", "fader", "handle", "slide")
"""Kinds that take more than a press."""
BARE = ("step", "handle", "fader")
"""Kinds that say nothing of themselves, but beside them something may be said."""
URGENT_WEIGHT = 8.0
"""How much likelier than all else is what waits for an answer."""
PAGE_SHARE = 0.8
"""Of what is in sight is scrolled on by one step."""
LEAVES = (mark("Cancel"), mark("Close"), mark("Back"), mark("Not now"), mark("No"), mark("Leave"))
"""What the button says that closes a question; one that has it needs no other way out."""
PRESSED = ("press", "hold", "step", "field", "fader", "slide")
"""Kinds that words of the mark should not lie on; a map or a stick has room."""
PADDING = 24
"""Kept free round what is scrolled to [px]."""
MAX_WORDS = 200


class WindowTargets:
    """What of `app` can be done by switches; a `Glass`. In the UI thread."""

    def __init__(self, app: WindowApp) -> None:
        """`app` is asked for its `root`, `shell`, `session`, `corner`, `robots` and `connect`."""
        self._app = app
        self.openings = Openings(app, self._likely_words)
        self.ring = Ring(app, self.openings.stops)
        self._step = -1
        self._names: tuple[str, ...] = ()
        """Of the targets that are marked."""
        self._met: set[Any] = set()
        """Offers that the mark has been on."""
        self.marked: Mark | None = None
        """What stands out now."""

    def close(self) -> None:
        """Take everything away that belongs to the switches."""
        self.openings.close()
        self.ring.show([], "")

    # what there is

    @property
    def place(self) -> str:
        """The screen or the dialog on top, as `drive` or `dialog.address`."""
        self.openings.update()
        if self.openings.pad is not None:
            return f"pad.{self.openings.kind}"
        dialog = self._dialog()
        if dialog is not None:
            return f"dialog.{slug(type(dialog).__name__)}"
        shell = self._app.shell
        return str(shell.screen) if shell is not None else "connect"

    def targets(self) -> Sequence[Target]:
        """All that can be done now, rows from the top, from the left, never STOP."""
        self.openings.update()
        found = find(self._roots(), self._app.corner.layer)
        dialog = self._dialog()
        made = [self._target(one) for one in found]
        ways_out = {one.words.casefold() for one in made} & {tr(words).casefold() for words in LEAVES}
        if dialog is not None and self.openings.pad is None and not ways_out:
            made.append(
                Target(
                    f"{self.place}.leave",
                    tr("Close"),
                    dialog.close,
                    group=(tr("Dialog"),),
                    key=dialog.ids.card,
                )
            )
        return _unique(made)

    def _roots(self) -> list[Any]:
        """What lies on top first; where it keeps a finger from the rest, nothing of the rest."""
        shell, dialog, layer = self._app.shell, self._dialog(), self._app.corner.layer
        waits = [shell.wishes.card] if shell is not None and shell.wishes.card.parent is not None else []
        if self.openings.pad is not None:
            return [*waits, self.openings.pad]
        if dialog is not None:
            return [*waits, dialog, layer]
        notices = [shell.notices] if shell is not None and shell.notices.children else []
        return [*waits, *notices, layer, *(one for one in self._app.root.children if one is not layer)]

    def _dialog(self) -> Any:
        """The question that is over everything; None without one."""
        return next((one for one in self._app.root.children if isinstance(one, Modal)), None)

    def _likely_words(self, kind: str) -> Iterable[str]:
        """Names that the app knows; for `url` addresses, and what those of the local networks begin with."""
        entries = self._app.robots.entries()
        if kind == "url":
            yield from (entry.address for entry in entries)
            for told_to in broadcast_addresses():
                if not told_to.startswith("127."):
                    yield told_to.rpartition(".")[0] + "."
            return
        session = self._app.session
        if session is not None:
            told: PlaceArray | None = session.feeds.latest("/places")
            yield from (place.name for place in (told.places if told is not None else [])[:MAX_WORDS])
            yield from (mission.name for mission in session.missions.kept[:MAX_WORDS])
        yield from (entry.name for entry in entries)

    # what they do

    def _target(self, one: Found) -> Target:
        widget, kind = one.widget, one.kind
        if kind == "scroll":
            return self._scroll(one)
        words = words_of(widget)
        told = beside(widget.parent if kind == "step" else widget) if kind in BARE or _mute(widget) else ""
        if kind == "step":
            words = f"{tr('More') if widget.step > 0 else tr('Less')} {told}".strip()
        elif told:
            words = told
        intent = intent_of(widget, words)
        pad = isinstance(widget, PadButton)
        return Target(
            name=self._name(one, words),
            words=words,
            act=self._act(one, words),
            repeatable=kind == "step" or (pad and widget.repeats),
            group=_pad_group(widget) if pad else one.group,
            fixed=pad,
            weight=URGENT_WEIGHT if one.group[:1] in (("Asked",), ("Question",)) else 1.0,
            intent=intent,
            key=widget,
        )

    def _act(self, one: Found, words: str) -> Callable[[], None]:
        widget, kind = one.widget, one.kind
        if kind in OPENS:
            return partial(self.openings.open, kind, widget, words)
        if kind == "hold":
            return partial(self.openings.open, kind, widget, words)
        return partial(_press, widget)

    def _scroll(self, one: Found) -> Target:
        """A list or a text that is longer than its room: on, and at its end back to its beginning."""
        view: ScrollView = one.widget
        ends = view.scroll_y <= 0.001 if view.do_scroll_y else view.scroll_x >= 0.999
        words = tr("Back to the beginning") if ends else tr("Scroll on")
        return Target(
            self._name(one, "scroll"),
            words,
            partial(_scroll_on, view),
            repeatable=True,
            group=one.group,
            key=view,
            weight=0.5,
        )

    def _name(self, one: Found, words: str) -> str:
        """By the ids that lead to it, else by its icon, else by what it says; of a list by its kind."""
        place, path = self.place, ".".join(one.path)
        if isinstance(one.widget, PadButton):
            return f"{place}.{one.widget.name}"
        own = one.path[-1:] == (self._own_id(one),)
        if own:
            return f"{place}.{path}"
        widget = one.widget
        kind = type(widget).__name__
        rows = kind in ("ListRow", "TopicRow", "FieldRow", "RobotCard")
        known = "" if rows else getattr(widget, "icon", "") or slug(words)
        return ".".join(part for part in (place, path, kind.lower(), known) if part)

    @staticmethod
    def _own_id(one: Found) -> str:
        parent = one.widget.parent
        ids = getattr(parent, "ids", {}) if parent is not None else {}
        return next(
            (name for name, other in ids.items() if getattr(other, "__self__", other) is one.widget), ""
        )

    # the mark

    def mark(self, mark: Mark | None) -> None:
        """Show it, scrolled into view; what drives for a moment rests when another one is marked."""
        self.marked = mark
        self._keep_offers(mark)
        if mark is None:
            self.openings.rest()
            self._step, self._names = -1, ()
            self.ring.show([], "")
            return
        names = tuple(target.name for target in mark.targets)
        if names != self._names:
            self._names = names
            self.openings.rest()
        if mark.step != self._step:
            self._step = mark.step
            for target in mark.targets[:1]:
                _into_view(target.key)
        keys = [target.key for target in mark.targets if _there(target.key)]
        seen = [box for key in keys if (box := _in_sight(key)) is not None]
        leaves = mark.targets[0].name.endswith(".leave")
        self.ring.show(
            seen, mark.kind, mark.words, lambda: self._texts(keys), named=mark.kind == "item" and leaves
        )

    def _texts(self, keys: Sequence[Any]) -> list[Box]:
        """Where something can be read or pressed that is not marked, each in sight."""
        boxes, widgets = [], list(self._roots())
        while widgets:
            widget = widgets.pop()
            if not widget.opacity or any(widget is key for key in keys):
                continue
            reads = isinstance(widget, Label) and str(widget.text).strip()
            box = _in_sight(widget) if reads or kind_of(widget) in PRESSED else None
            if box is not None:
                boxes.append(box)
            widgets += getattr(widget, "__self__", widget).children
        return boxes

    def _keep_offers(self, mark: Mark | None) -> None:
        """What can be undone for a while can be until the mark has been there and gone on."""
        shell = self._app.shell
        offers = (
            [] if shell is None else [one for one in shell.notices.children if isinstance(one, ActionToast)]
        )
        keys = [] if mark is None else [target.key for target in mark.targets]
        met = {one for one in offers if any(_holds(one, key) for key in keys)}
        self._met = {one for one in self._met if one in offers} | met
        for one in offers:
            one.kept = mark is not None and (one in met or one not in self._met)


def _holds(card: Any, widget: Any) -> bool:
    return any(one is widget for one in card.walk(restrict=True))


def _press(widget: Any) -> None:
    finger.tap(widget)


def _there(widget: Any) -> bool:
    return widget is not None and widget.get_root_window() is not None


def _in_sight(widget: Any) -> Box | None:
    """Where it can be seen [px]; None where it is scrolled away."""
    left, low, right, top = in_window(widget)
    parent = widget.parent
    while parent is not None and parent.parent is not parent:
        if isinstance(parent, ScrollView):
            view = in_window(parent)
            left, low = max(left, view[0]), max(low, view[1])
            right, top = min(right, view[2]), min(top, view[3])
        parent = parent.parent
    return (left, low, right, top) if right - left > 1 and top - low > 1 else None


def _mute(widget: Any) -> bool:
    """A switch says nothing of itself."""
    return type(widget).__name__ == "Toggle"


def _pad_group(button: PadButton) -> tuple[str, ...]:
    """Its row of the pad, which stays as it stands."""
    pad: Any = button.parent
    while not isinstance(pad, ScanPad):
        pad = pad.parent
    lines = list(reversed(pad.ids.grid.children))
    return (pad.title or tr("Keys"), tr("Row {parent}").format(parent=lines.index(button.parent) + 1))


def _scroll_on(view: ScrollView) -> None:
    inner = view.children[0] if view.children else None
    if inner is None:
        return
    if view.do_scroll_y and inner.height > view.height:
        by = PAGE_SHARE * view.height / (inner.height - view.height)
        view.scroll_y = 1.0 if view.scroll_y <= 0.001 else max(view.scroll_y - by, 0.0)
    elif inner.width > view.width:
        by = PAGE_SHARE * view.width / (inner.width - view.width)
        view.scroll_x = 0.0 if view.scroll_x >= 0.999 else min(view.scroll_x + by, 1.0)


def _into_view(widget: Any) -> None:
    """Scroll all that it is in until it can be seen."""
    if not _there(widget):
        return
    parent = widget.parent
    while parent is not None and parent.parent is not parent:
        if isinstance(parent, ScrollView) and not _within(in_window(widget), in_window(parent)):
            parent.scroll_to(widget, padding=PADDING, animate=False)
        parent = parent.parent


def _within(one: Box, other: Box) -> bool:
    return (
        one[0] >= other[0] - 1
        and one[1] >= other[1] - 1
        and one[2] <= other[2] + 1
        and one[3] <= other[3] + 1
    )


def _unique(targets: list[Target]) -> list[Target]:
    """Names twice on one glass get a number."""
    counts: dict[str, int] = {}
    unique = []
    for target in targets:
        counts[target.name] = number = counts.get(target.name, 0) + 1
        unique.append(target if number == 1 else replace(target, name=f"{target.name}#{number}"))
    return unique
