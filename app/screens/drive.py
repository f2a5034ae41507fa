"""The drive screen: video fills the glass, instruments float on it, a control is under one thumb and STOP under the other."""

from __future__ import annotations

from typing import Any

from kivy.uix.gridlayout import GridLayout
from kivy.uix.widget import Widget

from app import arrange
from app.arrange import Rect
from app.layout import Layout
from app.screens.action_buttons import ActionButtons
from app.screens.driving import Driving
from app.screens.placing import off, put
from app.screens.sight import Sight
from widgets import SlideToConfirm
from widgets.choices import Segmented
from widgets.kit import Card
from widgets.stick import Stick

__all__ = ["DriveScreen"]

HIDES = ("top_left", "top_right", "readouts", "top")
"""Places that may lie under the unfolded sensors, or under what is said."""


class DriveScreen(Driving):
    """Drive one robot by hand."""

    def fill(self, layout: Layout) -> None:
        """Put everything on the glass: the picture below, what is touched above what is only seen."""
        self._strip = Rect(0, 0, 0, 0)
        self._two = layout.arrangement == "two_sticks"
        self.actions = ActionButtons(layout, self.does)
        self.sight = Sight(self.session, self.video, self.dashboard)
        self.place("video", self.video)
        places = dict(self.instruments.places)
        self._figures = places.pop("readouts", [])
        card = Card(floating=True, padding=("12dp", "8dp"))
        self.readouts = GridLayout(cols=2, spacing=("10dp", "4dp"))
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
        self.ids.update({"video": self.video, **self._named()})

    def _take_up(self) -> None:
        """Put the arm that the robot carries on the glass, or take it off, and a switch where there is something to choose."""
        self.hands.take_up()
        choices, arm = self.hands.choices, self.hands.arm.made
        wanted = {self.switch: "switch"} | dict.fromkeys(choices.values(), "stick") if choices else {}
        for widget in (self.switch, arm):
            if widget is not None and widget.parent is not None and widget not in wanted:
                self.remove_widget(widget)
                kept = {
                    slot: [one for one in found if one is not widget] for slot, found in self.places.items()
                }
                self.places = {slot: found for slot, found in kept.items() if found}
        for widget, slot in wanted.items():
            if widget.parent is None:
                self.places.setdefault(slot, []).append(widget)
                self.add_widget(widget, self.children.index(self.senses) + 1)
        self.switch.options, self.switch.value = list(choices), self.hands.chosen

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
        places = self.arranged = self._arrange(body, form, dp)
        for slot, found in self.places.items():
            for widget, place in zip(found, _beside(places[slot], found, dp), strict=True):
                put(widget, place)
        self._choose()
        tall, row = form == "tall", places["actions"]
        self.actions.across = row.width > 2 * row.height
        self.actions.tick()
        figures = places["readouts"]
        roomy = form == "wide" or figures.width >= 330 * dp
        narrow = form == "short" or figures.width < 160 * dp
        self.readouts.cols = 1 if narrow else 4 if roomy and tall else 2
        self._trim(roomy or figures.height >= 200 * dp)
        self.notice, low = places["notice"], places["notice_low"]
        touched = (places[slot] for slot in ("switch", "actions") if slot in places)
        over = (one.y for one in touched if one.y > low.y and one.x < low.right and low.x < one.right)
        beside = self._two and tall  # beside the picture's own words; unfolded it takes the tape's room
        self.checks.pos_hint = {"right": 1} if beside else {"center_x": 0.5}
        self.place_checks(low, self.video.top if beside else min([places["top"].y, *over]), dp)
        self._strip = Rect(0, 0, 0, 0)
        self.sight.place(places["badge"], to_right=form != "wide")
        start, chip = self.notice.x, places["badge" if form == "wide" else "top"].y
        if (
            self._two and form == "short"
        ):  # under the tape is what is done once, under the instrument room for a line
            start, chip = places["top_left"].x, places["top_left"].y + 7 * dp
        aside = max(0.0, body.right - self.notice.right - 8 * dp)
        self.video.insets = [start - 8 * dp - body.x, 0, aside, body.top - chip]
        self.uncover()
        return places["stop"]

    def _arrange(self, body: Rect, form: str, dp: float) -> dict[str, Rect]:
        if self._two:
            return arrange.two_sticks(body, form, dp, switch=bool(self.hands.choices))
        return arrange.drive(body, form, dp, switch=bool(self.hands.choices))

    def _choose(self, *_: object) -> None:
        """Of two controls in one place one is on the glass; what is no stick needs no slider and takes its room too."""
        if not (self.arranged and self.hands.choices):
            return
        stick, slider = self.arranged["stick"], self.arranged["slider"]
        alone = not isinstance(self.hands.choices[self.hands.chosen], Stick)
        low, top = min(stick.y, slider.y), max(stick.top, slider.top)
        whole = Rect(stick.x, low, slider.right - stick.x, top - low) if alone else stick
        for widget in self.hands.choices.values():
            put(widget, whole if self.hands.shown(widget) else off(whole))
        for widget in self.places.get("slider", ()):
            put(widget, off(slider) if alone else slider)

    def uncover(self) -> None:
        """What lies under the unfolded sensors, or under what is said, is not seen, not even at its corners."""
        cover = self.cover
        lids = [cover] if cover is not None else []
        if self.senses.covers:
            lids.append(self.arranged["senses_open"])
        if not self.hide_checks() and self.checks.open:
            lids.append(Rect(*self.low.pos, *self.low.size))
        self.hide_chip(lids)
        for slot in HIDES:
            place = self.arranged[slot]
            hidden = any(lid.overlaps(place) for lid in lids)
            for widget in self.places.get(slot, ()):
                widget.opacity = 0 if hidden else 1
                # what has a shader of its own knows nothing of opacity
                put(widget, off(place) if hidden else place)
        self.sight.covered = cover is not None and cover.overlaps(self.arranged["badge"])
        strip = self.arranged["senses"]
        if cover is not None and cover.overlaps(strip) and self.senses.folded:
            strip = off(strip)
        if strip != self._strip:
            self._strip = strip
            self.senses.place(strip, self.arranged["senses_open"])

    def _trim(self, roomy: bool) -> None:
        """A phone has room for two figures."""
        wanted = self._figures if roomy else self._figures[:2]
        if list(reversed(self.readouts.children)) != wanted:
            self.readouts.clear_widgets()
            for widget in wanted:
                self.readouts.add_widget(widget)

    def meet(self) -> None:
        """The robot said what it is, or what it offers: it may carry an arm."""
        if self.hands.take_up():
            self.app.shell.settle()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        super().tick()
        self.sight.tick()
        self.actions.tick()


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
