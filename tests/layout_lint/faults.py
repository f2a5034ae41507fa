"""What is wrong with what lies on the glass: geometry and colours alone, nothing is drawn.

A fault is named by its kind and by where it is in the tree, without its words, so that it is one in every language and size.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from kivy.metrics import mm
from kivy.uix.label import Label
from kivy.uix.scrollview import ScrollView
from kivy.uix.stencilview import StencilView
from kivy.uix.textinput import TextInput

from app.inputs.base.modal import Modal
from app.inputs.switch_access.window.kinds import kind_of
from widgets import StopAll, StopButton
from widgets.core.surfaces import Glass, Outlined
from widgets.core.theme import PALETTES, contrast, theme
from widgets.parts.cards import Banner, Card
from widgets.parts.choices import Segment
from widgets.parts.labels import Icon

__all__ = ["KINDS", "Fault", "contrasts", "faults"]

KINDS = {
    "cut": "a text is larger than its label, or written beyond what it lies on",
    "shortened": "words end in dots that are no name, path or address",
    "small": "a target is under 10 mm, in gloves under 20 mm",
    "outside": "a target or a text lies outside the window",
    "overlap": "two targets share glass, or one lies under a card",
    "contrast": "a text can hardly be read on its ground",
}
SLACK = 1.5
"""Rounding of a text's size [px]."""
TOUCHES = 2.0
"""Neighbours whose borders are drawn one over the other share so much [px]."""
LEAST, LEAST_IN_GLOVES = 10.0, 20.0
"""Width and height of a target [mm]."""
PASSIVE = ("", "scroll", "map")
"""Kinds that a finger does not press: lists that scroll, and the map that lies below all that floats over it."""
NAMES = ("/", "Fake-1", "Pilothouse-", "ws://", "http", "PH1:", "·")
"""What is in a text that is, or ends in, a name, a path or an address."""

STOPS = (StopButton, StopAll)

Box = tuple[float, float, float, float]
"""Left, low, right, top [px, window]."""
NOWHERE: Box = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Fault:
    """One thing that is wrong."""

    kind: str
    """As in `KINDS`."""
    where: str
    """Classes of what it is in and its own, outermost first."""
    words: str = field(compare=False, default="")
    """What is written there, and by how much it is wrong."""

    def __str__(self) -> str:
        return f"{self.kind}: {self.where}: {self.words}"


@dataclass(slots=True)
class Seen:
    """One widget on the glass."""

    widget: Any
    box: Box
    clip: Box
    """What of the glass it is drawn on."""
    kind: str
    """How a finger uses it, as `kind_of` has it."""
    chain: tuple[Any, ...]
    """What it is in, outermost first."""
    rolls: bool
    """It is in something that scrolls."""

    @property
    def shown(self) -> Box:
        return cut(self.box, self.clip)


def faults(root: Any, window: tuple[float, float]) -> list[Fault]:
    """All that is wrong with the widgets under `root` in a window of that size [px]; contrast apart."""
    seen = _in_reach(list(_walk(root, (0.0, 0.0, *window), (), rolls=False)))
    glass = (0.0, 0.0, *window)
    found = [*_texts(seen, glass), *_targets(seen, glass)]
    return list(dict.fromkeys(found))


def _in_reach(seen: list[Seen]) -> list[Seen]:
    """Without what lies below a question, which takes every finger but that for STOP; STOP and what is drawn later stay."""
    asked = next(
        (number for number in range(len(seen) - 1, -1, -1) if isinstance(seen[number].widget, Modal)), 0
    )
    return [one for one in seen[:asked] if isinstance(one.widget, STOPS)] + seen[asked:]


def _walk(widget: Any, clip: Box, chain: tuple[Any, ...], *, rolls: bool) -> Iterator[Seen]:
    """In the order in which they are drawn."""
    if not widget.opacity:
        return
    left, low = widget.to_window(*widget.pos)
    right, top = widget.to_window(widget.right, widget.top)
    one = Seen(widget, (left, low, right, top), clip, kind_of(widget), chain, rolls)
    yield one
    if isinstance(widget, ScrollView | StencilView):
        clip = one.shown
        if not area(clip):
            return
    for child in reversed(widget.children):
        yield from _walk(child, clip, (*chain, widget), rolls=rolls or isinstance(widget, ScrollView))


# texts


def _texts(seen: list[Seen], glass: Box) -> Iterator[Fault]:
    for one in seen:
        label = one.widget
        if not isinstance(label, Label) or isinstance(label, Icon) or not label.text.strip():
            continue
        if not area(one.shown):
            continue
        width, height = label.texture_size
        if not label.shorten and (width > label.width + SLACK or height > label.height + SLACK):
            yield _fault(
                "cut", one, f"{label.text!r} {width}x{height} in {label.width:.0f}x{label.height:.0f}"
            )
        elif label.shorten and (lost := _lost(label)) and not any(name in label.text for name in NAMES):
            yield _fault("shortened", one, f"{label.text!r} to {lost!r}")
        written = _written(one)
        yield from _beyond(one, written)
        if not one.rolls and (over := _over(written, glass)) > SLACK:
            yield _fault("outside", one, f"{label.text!r} by {over:.0f}")


def _lost(label: Any) -> str:
    """What is written in the place of all the words; empty where that is all."""
    drawn = "".join(word.text for line in label._label._cached_lines for word in line.words)
    whole = "".join(label.text.split())
    return "" if "".join(drawn.split()) == whole else drawn


def _written(one: Seen) -> Box:
    """Where the letters are [px, window]."""
    label = one.widget
    left, low, right, top = one.box
    width, height = (min(size, room) for size, room in zip(label.texture_size, label.size, strict=True))
    width, height = label.texture_size if not label.shorten else (width, height)
    x, y = (left + right) / 2, (low + top) / 2
    return x - width / 2, y - height / 2, x + width / 2, y + height / 2


def _beyond(one: Seen, written: Box) -> Iterator[Fault]:
    """Letters over the edge of the card, button or row that they lie on."""
    for holder in reversed(one.chain):
        if isinstance(holder, ScrollView):
            return  # what is beyond is scrolled to
        if isinstance(holder, Outlined | Glass) or kind_of(holder) not in PASSIVE:
            left, low = holder.to_window(*holder.pos)
            over = _over(written, (left, low, left + holder.width, low + holder.height))
            if over > SLACK:
                yield _fault("cut", one, f"{one.widget.text!r} {over:.0f} over {type(holder).__name__}")
            return


# targets


def _targets(seen: list[Seen], glass: Box) -> Iterator[Fault]:
    least = mm(LEAST_IN_GLOVES if theme.gloves else LEAST) - SLACK
    targets = [
        (number, one) for number, one in enumerate(seen) if one.kind not in PASSIVE and area(one.shown)
    ]
    for number, one in targets:
        reach = _reach(one)
        yield from _too_small(one, reach, least)
        if not one.rolls and (over := _over(one.box, glass)) > SLACK:
            yield _fault("outside", one, f"by {over:.0f}")
        yield from _covered(number, one, seen)


def _too_small(one: Seen, reach: tuple[float, float], least: float) -> Iterator[Fault]:
    whole = _over(one.box, one.clip) <= SLACK  # one that is scrolled out in part is larger when it is in
    if whole and min(reach) < least and not isinstance(one.widget, TextInput):
        yield _fault("small", one, f"{_words(one.widget)} {reach[0]:.0f}x{reach[1]:.0f} of {least:.0f}")


def _reach(one: Seen) -> tuple[float, float]:
    """Width and height in which it takes a finger [px]: some do beyond their box."""
    widget = one.widget
    x, y = widget.center
    least = mm(LEAST_IN_GLOVES)
    wide = next(
        (2 * reach for reach in _steps(least / 2, widget.width / 2) if _takes(widget, x, y, reach, 0)),
        widget.width,
    )
    high = next(
        (2 * reach for reach in _steps(least / 2, widget.height / 2) if _takes(widget, x, y, 0, reach)),
        widget.height,
    )
    return max(wide, widget.width), max(high, widget.height)


def _steps(most: float, least: float) -> Iterator[float]:
    while most > least:
        yield most
        most -= 2.0


def _takes(widget: Any, x: float, y: float, across: float, up: float) -> bool:
    return bool(widget.collide_point(x - across, y - up) and widget.collide_point(x + across, y + up))


def _covered(number: int, one: Seen, seen: list[Seen]) -> Iterator[Fault]:
    """What is drawn later lies over it: a target, or a card."""
    box = one.shown
    for other in seen[number + 1 :]:
        if not (other.kind not in PASSIVE or isinstance(other.widget, Glass | Banner | Card)):
            continue
        if one.widget in other.chain or other.widget in one.chain or _see_through(other):
            continue
        shared = cut(box, other.shown)
        if shared[2] - shared[0] > TOUCHES and shared[3] - shared[1] > TOUCHES:
            yield _fault(
                "overlap",
                one,
                f"{_words(one.widget)} by {type(other.widget).__name__} {_words(other.widget)}"
                f" {shared[2] - shared[0]:.0f}x{shared[3] - shared[1]:.0f}",
            )


def _see_through(other: Seen) -> bool:
    return isinstance(other.widget, Glass) and not other.widget.card


# contrast


def contrasts(root: Any, window: tuple[float, float]) -> list[Fault]:
    """Texts whose colour is too near to that of the ground they lie on, in the theme that is chosen."""
    least = 7.0 if theme.name == "sunlight" else 4.5
    found = []
    for one in _walk(root, (0.0, 0.0, *window), (), rolls=False):
        label = one.widget
        if not isinstance(label, Label) or not label.text.strip() or isinstance(label, Icon):
            continue
        if not area(one.shown) or label.color[3] < 1 or list(label.color) == theme.roles["faint"]:
            continue  # faint is what cannot be used now
        ground = _ground(one)
        share = contrast(_hex(label.color), _hex(ground))
        if share < least - 0.05:
            found.append(
                _fault("contrast", one, f"{label.text!r} {_role(label.color)} on {_role(ground)} {share:.1f}")
            )
    return list(dict.fromkeys(found))


def _ground(one: Seen) -> list[float]:
    """The colour under a label: of the nearest thing below it that has one."""
    for holder in reversed((*one.chain, one.widget)):
        if isinstance(holder, Segment) and holder.chosen:
            return list(theme.accent)
        role = getattr(holder, "ground", "") if isinstance(holder, Outlined) else ""
        if getattr(holder, "fill", "") and not getattr(holder, "disabled", False):
            role = holder.fill
        if isinstance(role, str) and role in theme.roles:
            return list(theme.roles[role])
        if isinstance(holder, Glass) and holder.card:
            return list(theme.surface)
    return list(theme.bg)


def _hex(colour: Any) -> str:
    return "".join(f"{round(part * 255):02X}" for part in colour[:3])


def _role(colour: Any) -> str:
    name = _hex(colour)
    return next((role for role, value in PALETTES[theme.name].items() if value == name), name)


# boxes and names


def cut(one: Box, other: Box) -> Box:
    """What both have; nothing where that is nothing."""
    left, low = max(one[0], other[0]), max(one[1], other[1])
    right, top = min(one[2], other[2]), min(one[3], other[3])
    return (left, low, right, top) if right > left and top > low else NOWHERE


def area(box: Box) -> float:
    """Of a box [px²]."""
    return (box[2] - box[0]) * (box[3] - box[1])


def _over(box: Box, room: Box) -> float:
    """How far it reaches out of the room [px]."""
    return max(room[0] - box[0], room[1] - box[1], box[2] - room[2], box[3] - room[3])


def _words(widget: Any) -> str:
    words = getattr(widget, "text", "") or getattr(widget, "icon", "") or getattr(widget, "title", "")
    return repr(words) if words else ""


def _fault(kind: str, one: Seen, words: str) -> Fault:
    own = [
        type(part).__name__
        for part in (*one.chain, one.widget)
        if not type(part).__module__.startswith("kivy")
    ]
    tail = (
        own[-4:]
        if not type(one.widget).__module__.startswith("kivy")
        else [*own[-3:], type(one.widget).__name__]
    )
    return Fault(kind, ">".join(tail), words)
