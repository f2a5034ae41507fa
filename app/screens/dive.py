"""The drive screen in three columns: how the robot is on the left, what it sees and the hands in the middle, what can be
done on the right, with STOP below it."""

from __future__ import annotations

from typing import Any

from kivy.properties import ObjectProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.widget import Widget

from app.actions import CARRIED, Actions
from app.arrange_dive import dive
from app.camera import Picture
from app.dashboard import Dashboard
from app.feeds import Post
from app.layout import Action, Layout
from app.link import OFFER
from app.rects import Rect, StopPlace
from app.screens.check_card import CheckCard
from app.screens.hands import Hands
from app.screens.in_vain import InVain
from app.screens.instruments import Instruments
from app.screens.placing import AWAY, put
from app.session import Session
from bridge.msgs.vision_msgs import Detection2DArray
from widgets import ActionColumn, Video
from widgets.action_column import Action as Offered
from widgets.kit import Card
from widgets.stick import Stick

__all__ = ["DiveScreen"]

SEEN = ("legs", "compass", "horizon")
"""Where the instruments of the left column go, in the order of the layout; the last two share a card."""
HIDES = ("corner", "motion")
"""Places that may lie under what is said."""
ARM = "arm"
"""The line of the column that opens an arm over what is seen of the robot, and closes it."""
SWITCHES = ("Tab", "Enter")
"""Keys that work the column, as switches send them: on to the next action, and do it."""


class DiveScreen(FloatLayout):
    """Drive one robot by hand, and have it do things by two switches."""

    app = ObjectProperty()
    session: Session = ObjectProperty()
    speed = None
    """Nothing here says how fast the hands are at the end of their way: as fast as the robot may."""

    def __init__(self, layout: Layout, **kwargs: Any) -> None:
        """`layout` says what sits where."""
        super().__init__(**kwargs)
        session = self.session
        self._arranged: dict[str, Rect] = {}
        self._cover: Rect | None = None
        self.notice = Rect(0, 0, 1, 1)
        self.dashboard = Dashboard(session.feeds)
        self.video = Video(fit="cover", corner=14)
        self.in_vain = InVain(session, self.app)
        self._listed = (*(line.what for line in layout.actions), *CARRIED)
        confirmed = (Action(one.action) for one in layout.controls if one.action)
        self.does = Actions((*layout.actions, *confirmed), session, self.app)
        self.instruments = Instruments(layout, self.dashboard, session.feeds)
        self.hands = Hands(layout, session, self.dashboard, self.does, self.in_vain)
        self.column = ActionColumn()
        self.column.bind(on_action=lambda _, what: self._act(what))
        self._arm_open = False
        self.panel, self.ground = Card(), Card()
        self.places: dict[str, list[Widget]] = {}
        self._fill()
        self.low = BoxLayout(orientation="vertical", spacing="8dp", size_hint=(None, None))
        """For cards that hold on until they are dealt with, each with a height of its own; they grow upwards."""
        self.low.bind(minimum_height=self.low.setter("height"), height=self._uncover)
        self.add_widget(self.low)
        self.checks = CheckCard(session, self.dashboard, brief=True, pos_hint={"center_x": 0.5})
        self.low.add_widget(self.checks)
        self.dashboard.bind(
            self.video,
            "/detections",
            lambda found: self.video.show(session.found_in_picture(found)),
            fresh=False,
            empty=Detection2DArray(),
        )
        self.ids.update({"video": self.video, "column": self.column})

    def _fill(self) -> None:
        """Put everything on the glass: the picture below, what is touched above what is only seen."""
        found = self.instruments.places
        left = found.get("left", [])
        for widget in left[1:]:
            if hasattr(widget, "card"):
                widget.card = False
        self._place("video", self.video)
        self._place("panel", self.panel)
        self._place("hands", self.ground)
        for slot, widget in zip(SEEN, left, strict=False):
            self._place(slot, widget)
        for places in ({slot: found.get(slot, []) for slot in HIDES}, self.hands.places):
            for slot, those in places.items():
                for widget in those:
                    self._place(slot, widget)
        self._place("actions", self.column)

    def _place(self, slot: str, widget: Widget) -> None:
        self.places.setdefault(slot, []).append(widget)
        self.add_widget(widget)

    def _act(self, what: str) -> None:
        if what == ARM:
            self._arm_open = not self._arm_open
            self.hands.arm.rest()
            self.app.shell.settle()
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
        legs, other = self._arranged["legs"], self._arranged["panel"]
        low, right = min(legs.y, other.y), max(legs.right, other.right)
        place = legs if wide else Rect(legs.x, low, right - legs.x, legs.top - low)
        put(panel, place)
        self.add_widget(panel)
        for slot, found in self.places.items():
            rect = self._arranged.get(slot)
            for widget in found if rect is not None and rect.overlaps(place) else ():
                put(widget, Rect(AWAY, widget.y, widget.width, widget.height))

    # what the inputs look at

    @property
    def stick(self) -> Any:
        """The first control that drives; None without one."""
        return next((stick for stick, _ in self.sticks), None)

    @property
    def sticks(self) -> list[tuple[Stick, str]]:
        """What drives and is on the glass, each with the stick of a gamepad that pushes it too."""
        return self.hands.sticks

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold besides."""
        return [*self.hands.grips, *([self.hands.arm.panel] if self._arm_open else [])]

    def press_switch(self, key: str) -> None:
        """`Tab` or `Enter` was pressed: on to the next action, or do it. The first press of any shows which is the next."""
        column = self.column
        if not column.switches:
            column.switches = list(SWITCHES)
        elif key == SWITCHES[0]:
            column.next()
        else:
            column.act()

    # what the shell calls

    def arrange(self, body: Rect, form: str, dp: float) -> StopPlace:
        """Put everything into its place; returns where STOP goes."""
        places, stop = dive(body, form, dp)
        self._arranged = places
        wide = form == "wide"
        column, self.notice = self.column, places["notice"]
        column.framed = column.titled = wide
        column.inset = (12 if wide else 0) * dp
        column.foot = stop.head - stop.y + 8 * dp if wide else 0
        column.across = 1 if form != "tall" else max(1, int(places["actions"].width // (104 * dp)))
        self.video.corner = 0 if form == "tall" else 14 * dp
        for slot, found in self.places.items():
            for widget in found:
                put(widget, places.get(slot, Rect(AWAY, 0, 1, 1)))
        self._place_arm(wide)
        corner = places["corner"]
        self.video.insets = [corner.right - self.video.x, 0, 0, 0]
        low = places["notice_low"]
        self.low.pos, self.low.width = (low.x, low.y), low.width
        self.checks.wide, self.checks.room = min(low.width, 340 * dp), self.video.top - 8 * dp - low.y
        self._uncover()
        return stop

    def clear(self, cover: Rect | None) -> None:
        """Take away what would be seen only in part behind what is said over the screen."""
        self._cover = cover
        self._uncover()

    def _uncover(self, *_: object) -> None:
        """What lies under what is said, or under what holds on, is not seen, not even at its corners."""
        if not self._arranged:
            return
        cover, low = self._cover, Rect(*self.low.pos, *self.low.size)
        under = cover is not None and cover.overlaps(low)
        self.low.opacity, self.low.disabled = float(not under), under
        lids = [lid for lid in (cover, None if under else low) if lid is not None]
        for slot in HIDES:
            place = self._arranged[slot]
            hidden = any(lid.overlaps(place) for lid in lids)
            for widget in self.places.get(slot, ()):
                widget.opacity = 0 if hidden else 1
                put(widget, Rect(AWAY, place.y, place.width, place.height) if hidden else place)

    def hear(self, channel: str, post: Post) -> None:
        """A message came."""
        self.dashboard.deliver(channel, post.value)
        self.hands.hear(channel, post)
        if channel == "/robot/info":
            self._meet()
        elif channel == OFFER:
            self.instruments.name_sources(self.session.offer)

    def _meet(self) -> None:
        for widget in self.instruments.places.get("motion", ()):
            if hasattr(widget, "under_water"):
                widget.under_water = self.session.info.kind == "hexapod"

    def enter(self) -> None:
        """Come onto the glass."""
        self.hands.take_limits()
        self._meet()
        self.instruments.name_sources(self.session.offer)
        self.dashboard.enter()
        self.tick()

    def leave(self) -> None:
        """Leave the glass."""
        self.rest()
        self.dashboard.leave()

    def rest(self) -> None:
        """Every control lets go."""
        self.hands.rest()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self.dashboard.tick()
        self.in_vain.tick()
        self.checks.tick()
        self.hands.tick()
        actions = [action for action in self.does.look() if action.name in self._listed]
        if self.hands.arm.carried:
            said = "open" if self._arm_open else ""
            actions.append(Offered(ARM, "Arm", "precision_manufacturing", said=said))
        elif self._arm_open:
            self.app.shell.settle()
        if actions != self.column.actions:
            self.column.actions = actions

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """A decoded camera frame; `rate` [Hz] and `latency` [s] are said on it, NaN for unknown."""
        self.video.show_frame(picture.width, picture.height, picture.rgba, picture.taken)
        self.video.rate, self.video.latency = rate, latency
