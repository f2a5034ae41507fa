"""The drive screen in three columns: how the robot is on the left, what it sees and the hands in the middle, what can be
done on the right, with STOP below it."""

from __future__ import annotations

from typing import Any

from kivy.clock import Clock
from kivy.metrics import dp as dp_of

from app.core.hand import hand
from app.layout.arrange_dive import dive
from app.layout.arrange_phone import whole
from app.layout.layout import Layout
from app.layout.rects import Rect, StopPlace
from app.screens.drive.driving_base import Driving
from app.screens.drive.inset_map import add_inset
from app.screens.parts.placing import AWAY_X, off, put
from app.session.layout_actions import CARRIED
from widgets import ActionColumn
from widgets.controls.action_column import Action as Offered
from widgets.core.language import tr
from widgets.parts.kit import Card

__all__ = ["DiveScreen"]

SEEN = ("legs", "compass", "horizon")
"""Where the instruments of the left column go, in the order of the layout; the last two share a card."""
HIDES = ("corner", "motion")
"""Places that may lie under what is said."""
ARM = "arm"
"""The line of the column that opens an arm over what is seen of the robot, and closes it."""


class DiveScreen(Driving):
    """Drive one robot by hand, and have it do things."""

    corner = 14
    speed = None
    """Nothing here says how fast the hands are at the end of their way: as fast as the robot may."""

    def fill(self, layout: Layout) -> None:
        """Put everything on the glass: the picture below, what is touched above what is only seen."""
        self._listed = (*(line.what for line in layout.actions), *CARRIED)
        self.column = ActionColumn()
        self.column.bind(on_action=lambda _, what: self._act(what))
        self._arm_open, self._strip = False, Rect(0, 0, 0, 0)
        self.panel, self.ground = Card(), Card()
        found = self.instruments.places
        left = found.get("left", [])
        for widget in left[1:]:
            if hasattr(widget, "card"):
                widget.card = False
        self.place("video", self.video)
        self.add_widget(self.sheet)
        self.place("panel", self.panel)
        self.place("hands", self.ground)
        for slot, widget in zip(SEEN, left, strict=False):
            self.place(slot, widget)
        for places in ({slot: found.get(slot, []) for slot in HIDES}, self.hands.places):
            for slot, those in places.items():
                for widget in those:
                    self.place(slot, widget)
        self.place("actions", self.column)
        self.add_widget(self.senses)
        self.inset = add_inset(self)
        anew = Clock.create_trigger(lambda _: self.settle() if "handle" in self.arranged else None, -1)
        self.senses.bind(opacity=anew)  # in the drawer of a phone they have a place only while there are any
        self.ids.update({"video": self.video, "column": self.column})

    def _act(self, what: str) -> None:
        if what == ARM:
            self._arm_open = not self._arm_open
            self.hands.arm.rest()
            self.settle()
        else:
            self.does.act(what)

    def _place_arm(self, wide: bool) -> None:
        """Over the column of instruments while it is open; what it would cover in part is away."""
        self._arm_open = self._arm_open and self.hands.arm.carried
        panel = self.hands.arm.panel if self._arm_open else self.hands.arm.made
        if panel is not None and panel.parent is not None:
            self.remove_widget(panel)
        if panel is None or not self._arm_open:
            return
        legs, other = self.arranged["legs"], self.arranged["panel"]
        low, left, right = min(legs.y, other.y), min(legs.x, other.x), max(legs.right, other.right)
        place = legs if wide else Rect(left, low, right - left, legs.top - low)
        put(panel, place)
        self.add_widget(panel)
        for slot, found in self.places.items():
            rect = self.arranged.get(slot)
            for widget in found if rect is not None and rect.overlaps(place) else ():
                put(widget, off(Rect(*widget.pos, *widget.size)))

    # what the inputs look at

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold besides."""
        return [*super().grips, *([self.hands.arm.panel] if self._arm_open else [])]

    # what the shell calls

    def arrange(self, body: Rect, form: str, dp: float) -> StopPlace:
        """Put everything into its place; returns where STOP goes."""
        if form != "short":
            self.handle.pulled = False
        places, stop = dive(body, form, dp)
        if form == "short":
            out = dive(body, form, dp, pulled=True, sensed=bool(self.senses.shown))[0]
            places = whole(out, places) if self.handle.pulled else whole(places, out)
        self.arranged = places
        self.place_drawer(form)
        wide = form == "wide"
        column, self.notice = self.column, places["notice"]
        column.framed = column.titled = wide
        column.inset = (12 if wide else 0) * dp
        column.across = 1 if wide else max(1, int(places["actions"].width // (104 * dp)))
        self.video.corner = 14 * dp if wide else 0
        aside: dict[str, float] = {"right": 1} if hand.left else {"x": 0}
        self.checks.pos_hint = aside if form == "short" else {"center_x": 0.5}
        for slot, found in self.places.items():
            for widget in found:
                put(widget, places.get(slot, Rect(AWAY_X, 0, 1, 1)))
        self._place_arm(wide)
        self.checks.tight = not wide
        self.place_checks(places["notice_low"], places["video"].top, dp)
        self._strip = Rect(0, 0, 0, 0)
        self.inset.arrange(places, form, dp)
        self.uncover()
        return stop

    def uncover(self) -> None:
        """What lies under what is said, or under what holds on, is not seen, not even at its corners."""
        low = None if self.hide_checks() else Rect(*self.low.pos, *self.low.size)
        lids = [lid for lid in (self.cover, low) if lid is not None]
        strip, unfolded = self.arranged["senses"], self.arranged["senses_open"]
        away = any(lid.overlaps(strip) for lid in lids)
        place = off(strip) if away else strip
        if place != self._strip:
            self._strip = place
            self.senses.place(place, off(unfolded) if away else unfolded)
        if self.senses.covers:
            lids.append(unfolded)
        self._frame_video(strip)
        self.hide_chip([*lids, *self.checks_place])
        for slot in HIDES:
            place = self.arranged[slot]
            hidden = any(lid.overlaps(place) for lid in lids)
            for widget in self.places.get(slot, ()):
                widget.opacity = 0 if hidden else 1
                put(widget, off(place) if hidden else place)
        drawn = [self._drawn] if self._drawn is not None else []
        self.inset.uncover([*lids, *self.checks_place, *drawn])

    def _frame_video(self, strip: Rect) -> None:
        """What of the picture is covered, so that its own words are beside that; nothing while it is small."""
        whole, corner = self.arranged["video"], self.arranged["corner"]
        self.video.chip_inset = 0.0
        if self.inset.large:
            self.video.insets = [0, 0, 0, 0]
        elif "handle" in self.arranged:  # on a phone's side, below the figures
            self.video.insets = [0, 0, 0, whole.top - corner.y]
            self.video.chip_inset = max(0.0, corner.x - dp_of(8) - whole.x)
        else:
            beside = [0, 0, whole.right - corner.x] if hand.left else [corner.right - whole.x, 0, 0]
            self.video.insets = [*beside, whole.top - strip.y if self.senses.shown else 0]

    def meet(self) -> None:
        """The robot said what it is: what swims shows its motion in the water."""
        for widget in self.instruments.places.get("motion", ()):
            if hasattr(widget, "under_water"):
                widget.under_water = self.session.robot.info.dives

    def tick(self) -> None:
        """Bring up to date what time changes."""
        super().tick()
        self.inset.tick()
        actions = [action for action in self.does.current() if action.name in self._listed]
        if self.hands.arm.carried:
            said = "open" if self._arm_open else ""
            actions.append(Offered(ARM, tr("Arm"), "precision_manufacturing", said=said))
        elif self._arm_open:
            self.settle()
        if actions != self.column.actions:
            self.column.actions = actions
        switches = self.app.methods.made("switches")
        self.column.hint = switches.hint if switches is not None else ""

    def rest(self) -> None:
        """Every control lets go, and fingers on the map do."""
        super().rest()
        self.inset.rest()

    def end(self) -> None:
        """Let go of the map."""
        super().end()
        self.inset.end()
