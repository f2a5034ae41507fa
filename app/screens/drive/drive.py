"""The drive screen: video fills the glass, instruments float on it, a control is under one thumb and STOP under the other."""

from __future__ import annotations

from typing import Any

from kivy.clock import Clock
from kivy.uix.widget import Widget

from app.core.hand import hand
from app.layout import arrange
from app.layout.arrange import Rect
from app.layout.arrange_phone import whole
from app.layout.layout import Layout
from app.layout.rects import between
from app.screens.drive.action_buttons import ActionButtons
from app.screens.drive.driving_base import Driving
from app.screens.drive.inset_map import add_inset, checks_beside
from app.screens.drive.intruder_overlay import IntruderOverlay
from app.screens.parts.placing import off, put
from widgets import SlideToConfirm
from widgets.controls.sticks.stick import Stick
from widgets.core.language import tr
from widgets.instruments.readout import ReadoutGrid
from widgets.parts.choices import Segmented
from widgets.parts.kit import Card

__all__ = ["DriveScreen"]

HIDES = ("top_left", "top_right", "top")
"""Places of instruments that may lie under the unfolded sensors, or under what is said."""
MIN_HEIGHT, FIGURES = 110.0, 52.0
"""Of an instrument, and of the figures in one row, less height shows nothing that can be read [dp]."""
THREE, FIGURES_HEIGHT = 236.0, 48.0
"""Width that three figures need on a phone's side, and their height there [dp]."""
SLIDE = 52
"""Height of a slide over the picture [dp]."""


class DriveScreen(Driving):
    """Drive one robot by hand."""

    def fill(self, layout: Layout) -> None:
        """Put everything on the glass: the picture below, what is touched above what is only seen."""
        self._strip, self._form, self._dp = Rect(0, 0, 0, 0), "wide", 1.0
        self._two = layout.arrangement == "two_sticks"
        self.actions = ActionButtons(layout, self.does)
        self.sight = IntruderOverlay(self.session, self.video, self.dashboard)
        self.place("video", self.video)
        self.add_widget(self.sheet)
        places = dict(self.instruments.places)
        self._figures = places.pop("readouts", [])
        card = self._figures_card = Card(floating=True, padding=("12dp", "8dp"))
        self.readouts = ReadoutGrid(cols=2, spacing=("10dp", "4dp"))
        for figure in self._figures:
            self.readouts.add_widget(figure)
        card.add_widget(self.readouts)
        for found in (places, {"readouts": [card]}, self.hands.places, {"actions": [self.actions]}):
            for slot, those in found.items():
                for widget in those:
                    self.place(slot, widget)
        self.switch = Segmented()
        self.switch.bind(on_choose=lambda _, title: setattr(self.hands, "chosen", title))
        self.hands.bind(chosen=self._choose)
        self.add_widget(self.sight)
        self.add_widget(self.senses)
        anew = Clock.create_trigger(lambda _: self.settle() if self._form == "tall" else None, -1)
        self.senses.bind(opacity=anew)  # upright they have a place only while there are any
        self.inset = add_inset(self)
        self.ids.update({"video": self.video, **self._named()})

    def _take_up(self) -> None:
        """Put an arm that the robot carries and the circle of a tablet on the glass, or take them off, and a switch where there is something to choose."""
        self.hands.take_up()
        choices = self.hands.choices
        wanted = {self.switch: "switch"} | dict.fromkeys(choices.values(), "stick") if choices else {}
        for widget in (self.switch, *self.hands.lent):
            if widget.parent is not None and widget not in wanted:
                self.remove_widget(widget)
                kept = {
                    slot: [one for one in found if one is not widget] for slot, found in self.places.items()
                }
                self.places = {slot: found for slot, found in kept.items() if found}
        for widget, slot in wanted.items():
            if widget.parent is None:
                self.places.setdefault(slot, []).append(widget)
                self.add_widget(widget, self.children.index(self.senses) + 1)
        self.switch.options = [(name, tr(name)) for name in choices]
        self.switch.value = self.hands.chosen

    def _named(self) -> dict[str, Widget]:
        """Buttons and controls by short names."""
        named: dict[str, Any] = {
            what.removeprefix("task.go_"): button for what, button in self.actions.buttons.items()
        }
        if self.stick is not None:
            named["stick"] = self.stick
        if self.speed is not None:
            named |= {"speed": self.speed, "fader": self.speed.ids.fader}
        return named

    @property
    def speed(self) -> Any:
        """How fast the others are at the end of their way; None where nothing says that."""
        return self.hands.speed

    # what the shell calls

    def arrange(self, body: Rect, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self._take_up()
        if form != "short":
            self.handle.pulled = False
        self._form, self._dp = form, dp
        places = self.arranged = self._arrange(body, form, dp)
        self.place_drawer(form)
        for slot, found in self.places.items():
            for widget, place in zip(found, _beside(places[slot], found, dp), strict=True):
                put(widget, place)
        self._show_slides()
        self._choose()
        tall, row = form == "tall", places["actions"]
        self.actions.across = row.width > 2 * row.height
        self.actions.tick()
        self.notice, low = places["notice"], checks_beside(places, form, dp)
        self.checks.tight = form != "wide"
        touched = (places[slot] for slot in ("switch", "actions") if slot in places)
        over = (one.y for one in touched if one.y > low.y and one.x < low.right and low.x < one.right)
        beside = self._two and tall  # beside the picture's own words; unfolded it takes the tape's room
        aside = hand.left if beside else not hand.left  # at the left
        self.checks.pos_hint = (
            ({"x": 0} if aside else {"right": 1}) if beside or form == "short" else {"center_x": 0.5}
        )
        self.place_checks(low, self.video.top if beside else min([places["top"].y, *over]), dp)
        self._strip = Rect(0, 0, 0, 0)
        self.sight.place(places["badge"], to_right=form != "wide" and not hand.left)
        self._frame_video(places, body, form, dp)
        self.inset.arrange(places, form, dp)
        self.uncover()
        return places["stop"]

    def _frame_video(self, places: dict[str, Rect], body: Rect, form: str, dp: float) -> None:
        """What of the picture is covered, so that its own words and marks are beside that."""
        start, chip = self.notice.x, places["badge" if form == "wide" else "top"].y
        self.video.chip_inset = 0.0
        if form == "short":
            start, chip = body.x + 10 * dp, places["drawer" if self.handle.pulled else "readouts"].y
            self.video.chip_inset = max(0.0, places["readouts"].x - start)
        aside = max(0.0, body.right - self.notice.right - 8 * dp)
        self.video.insets = [start - 8 * dp - body.x, 0, aside, body.top - chip]

    def _arrange(self, body: Rect, form: str, dp: float) -> dict[str, Rect]:
        how, switch = arrange.two_sticks if self._two else arrange.drive, bool(self.hands.choices)
        if form != "short":
            return how(body, form, dp, switch=switch, sensed=bool(self.senses.shown))
        closed, out = (how(body, form, dp, switch=switch, pulled=pulled) for pulled in (False, True))
        return whole(out, closed) if self.handle.pulled else whole(closed, out)

    def _show_slides(self) -> None:
        """On a phone's side only what can be confirmed now lies over the picture: of what takes off and lands, one."""
        found: list[Any] = [*self.places.get("confirm", ())]
        if self._form != "short" or not found:
            return
        room = self.arranged["confirm"]
        shown = [slide for slide in found if slide.state != "disabled"] or found[:1]
        high = min(SLIDE * self._dp, room.height / 2)
        for row, slide in enumerate(reversed(shown)):
            put(slide, Rect(room.x, room.y + row * (room.height - high), room.width, high))
        for slide in found:
            if slide not in shown:
                put(slide, off(room))

    def _choose(self, *_: object) -> None:
        """Of two controls in one place one is on the glass; what is no stick needs no slider and takes its room too."""
        if not (self.arranged and self.hands.choices):
            return
        self.switch.value = self.hands.chosen
        stick, slider = self.arranged["stick"], self.arranged["slider"]
        alone = not isinstance(self.hands.choices[self.hands.chosen], Stick)
        low, top = min(stick.y, slider.y), max(stick.top, slider.top)
        left, right = min(stick.x, slider.x), max(stick.right, slider.right)
        apart = self._two and hand.left  # the slider is beside the other stick
        both = between(left, low, right, top) if alone and not apart else stick
        room = self.arranged.get("alone", both) if alone else stick
        for widget in self.hands.choices.values():
            put(widget, room if self.hands.shown(widget) else off(room))
        for widget in self.places.get("slider", ()):
            put(widget, off(slider) if alone else slider)

    def uncover(self) -> None:
        """What lies under the unfolded sensors, or under what is said, is not seen, not even at its corners.

        What of an instrument's place is left and can be read, is shown there; the figures are never taken away by what is said.
        """
        cover = self.cover
        lids = [cover] if cover is not None else []
        if self.senses.covers:
            lids.append(self.arranged["senses_open"])
        if not self.hide_checks() and self.checks.open:
            lids.append(Rect(*self.low.pos, *self.low.size))
        left = {slot: _left(self.arranged[slot], lids, MIN_HEIGHT * self._dp, 8 * self._dp) for slot in HIDES}
        figures = left["readouts"] = self._figures_left(lids, alone=left["top_left"] is None)
        self._show_figures(figures or self.arranged["readouts"])
        if figures is not None and figures.overlaps(Rect(*self.low.pos, *self.low.size)):
            self.low.opacity, self.low.disabled = 0.0, True
        lids += [figures] if figures is not None else []
        self.hide_chip([*lids, *self.checks_place, self.arranged["badge"]])
        for slot, place in left.items():
            for widget in self.places.get(slot, ()):
                widget.opacity = 0 if place is None else 1
                # what has a shader of its own knows nothing of opacity
                put(widget, off(self.arranged[slot]) if place is None else place)
        said = [lid for lid in (cover, figures) if lid is not None]
        self.sight.covered = any(lid.overlaps(self.arranged["badge"]) for lid in said)
        strip = self.arranged["senses"]
        if self.senses.folded and any(lid.overlaps(strip) for lid in said):
            strip = off(strip)
        if strip != self._strip:
            self._strip = strip
            self.senses.place(strip, self.arranged["senses_open"])
        drawn = [self.arranged["drawer"]] if self.handle.pulled else []
        self.inset.uncover([*lids, *self.checks_place, *drawn])

    def _figures_left(self, lids: list[Rect], *, alone: bool) -> Rect | None:
        """Where the figures are: in their own place, in all of the row whose instruments are away, or over what is said."""
        place, least, gap = self.arranged["readouts"], FIGURES * self._dp, 8 * self._dp
        cover = self.cover
        if cover is None or not cover.overlaps(place):
            return _left(place, lids, MIN_HEIGHT * self._dp, gap)
        if self._form != "tall" or not alone:
            return _left(place, lids, least, gap)
        row = [self.arranged[slot] for slot in ("top_left", "top_right", "readouts")]
        low, top = min(one.y for one in row), max(one.top for one in row)
        whole = between(min(one.x for one in row), low, max(one.right for one in row), top)
        over = Rect(whole.x, cover.top + gap, whole.width, least)
        free = over.top <= self.arranged["top"].y and not any(lid.overlaps(over) for lid in lids)
        return _left(whole, lids, least, gap) or (over if free else None)

    def _show_figures(self, place: Rect) -> None:
        """In columns, and as many of them, as the place has room for."""
        dp, tall = self._dp, self._form == "tall"
        roomy = self._form == "wide" or place.width >= 330 * dp
        narrow = self._form != "short" and place.width < 160 * dp
        self.readouts.cols = 1 if narrow else 4 if roomy and tall else 3 if self._form == "short" else 2
        self._figures_card.padding = 12 * dp, (8 if place.height >= 62 * dp or narrow else 2) * dp
        least = THREE * dp * min(1.0, place.height / (FIGURES_HEIGHT * dp))
        seen = 3 if self._form == "short" and place.width >= least else 2
        self._trim(len(self._figures) if roomy or place.height >= 200 * dp else seen)

    def _trim(self, count: int) -> None:
        """A phone has room for two figures, and for three on its side."""
        wanted = self._figures[:count]
        if list(reversed(self.readouts.children)) != wanted:
            self.readouts.clear_widgets()
            for widget in wanted:
                self.readouts.add_widget(widget)

    def meet(self) -> None:
        """The robot said what it is, or what it offers: it may carry an arm."""
        if self.hands.take_up():
            self.settle()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        super().tick()
        self.sight.tick()
        self.actions.tick()
        self.inset.tick()
        self._show_slides()

    def rest(self) -> None:
        """Every control lets go, and fingers on the map do."""
        super().rest()
        self.inset.rest()

    def end(self) -> None:
        """Let go of the map."""
        super().end()
        self.inset.end()


def _left(place: Rect, lids: list[Rect], least: float, gap: float) -> Rect | None:
    """What is left of a place above or below what lies over it, at a gap; None where that is lower than `least` [px]."""
    low, top = place.y, place.top
    for lid in lids:
        if lid.overlaps(between(place.x, low, place.right, top)):
            if lid.y - low >= top - lid.top:
                top = lid.y - gap
            else:
                low = lid.top + gap
            if top - low < least:
                return None
    return between(place.x, low, place.right, top)


def _beside(place: Rect, found: list[Widget], dp: float) -> list[Rect]:
    """The places of slides that share one: side by side, or one above the other where that is narrow; else each has all of it."""
    if len(found) < 2 or not all(isinstance(widget, SlideToConfirm) for widget in found):
        return [place] * len(found)
    gap, count = 12 * dp, len(found)
    if place.width < 3 * place.height:
        high = (place.height - gap * (count - 1)) / count
        return [Rect(place.x, place.top - (n + 1) * high - n * gap, place.width, high) for n in range(count)]
    wide = (place.width - gap * (count - 1)) / count
    return [Rect(place.x + n * (wide + gap), place.y, wide, place.height) for n in range(count)]
