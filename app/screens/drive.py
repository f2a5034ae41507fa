"""The drive screen: video fills the glass, instruments float on it, a control is under one thumb and STOP under the other."""

from __future__ import annotations

from typing import Any

from kivy.properties import ObjectProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.gridlayout import GridLayout
from kivy.uix.widget import Widget

from app import arrange
from app.actions import Actions
from app.arrange import Rect
from app.camera import Picture
from app.dashboard import Dashboard
from app.feeds import Post
from app.layout import Action, Layout
from app.link import OFFER
from app.screens.action_buttons import ActionButtons
from app.screens.check_card import CheckCard
from app.screens.hands import Hands
from app.screens.in_vain import InVain
from app.screens.instruments import Instruments
from app.screens.placing import AWAY, put
from app.screens.senses import Senses
from app.screens.sight import Sight
from app.session import Session
from bridge.msgs.vision_msgs import Detection2DArray
from widgets import SlideToConfirm, Video
from widgets.choices import Segmented
from widgets.kit import Card
from widgets.stick import Stick

__all__ = ["DriveScreen"]

HIDES = ("top_left", "top_right", "readouts", "top")
"""Places that may lie under the unfolded sensors, or under what is said."""


class DriveScreen(FloatLayout):
    """Drive one robot by hand."""

    app = ObjectProperty()
    session: Session = ObjectProperty()

    def __init__(self, layout: Layout, **kwargs: Any) -> None:
        """`layout` says what sits where."""
        super().__init__(**kwargs)
        self._arranged: dict[str, Rect] = {}
        self._cover: Rect | None = None
        self._strip = Rect(0, 0, 0, 0)
        self._two = layout.arrangement == "two_sticks"
        self.dashboard = Dashboard(self.session.feeds)
        self.video = Video(fit="cover", corner=0)
        self.in_vain = InVain(self.session, self.app)
        self.does = Actions(
            (*layout.actions, *(Action(one.action) for one in layout.controls if one.action)),
            self.session,
            self.app,
        )
        self.instruments = Instruments(layout, self.dashboard, self.session.feeds)
        self.hands = Hands(layout, self.session, self.dashboard, self.does, self.in_vain)
        self.actions = ActionButtons(layout, self.does)
        self.senses = Senses(self.session.feeds)
        self.senses.bind(open=self._uncover, opacity=self._uncover)
        self.sight = Sight(self.session, self.video, self.dashboard)
        self.places: dict[str, list[Widget]] = {}
        self._fill()
        self.low = BoxLayout(orientation="vertical", spacing="8dp", size_hint=(None, None))
        """For cards that hold on until they are dealt with, each with a height of its own; they grow upwards."""
        self.low.bind(minimum_height=self.low.setter("height"), height=self._uncover)
        self.add_widget(self.low)
        self.checks = CheckCard(self.session, self.dashboard, brief=True, pos_hint={"center_x": 0.5})
        self.low.add_widget(self.checks)
        self.dashboard.bind(
            self.video,
            "/detections",
            lambda found: self.video.show(self.session.found_in_picture(found)),
            fresh=False,
            empty=Detection2DArray(),
        )
        self.ids.update({"video": self.video, **self._named()})

    def _fill(self) -> None:
        """Put everything on the glass: the picture below, what is touched above what is only seen."""
        self._place("video", self.video)
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
                    self._place(slot, widget)
        self.switch = Segmented()
        self.switch.bind(on_choose=lambda _, title: setattr(self.hands, "chosen", title))
        self.hands.bind(chosen=self._choose)
        self.add_widget(self.sight)
        for gauge, topics in self.instruments.senses:
            self.senses.add(gauge, topics)
        self.add_widget(self.senses)

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
        return self.hands.grips

    @property
    def speed(self) -> Any:
        """How fast the others are at the end of their way; None where nothing says that."""
        return self.hands.speed

    def _place(self, slot: str, widget: Widget) -> None:
        self.places.setdefault(slot, []).append(widget)
        self.add_widget(widget)

    # what the shell calls

    def arrange(self, body: Rect, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self._take_up()
        places = self._arranged = self._arrange(body, form, dp)
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
        self.low.pos, self.low.width, self.low.height = (low.x, low.y), low.width, self.low.minimum_height
        touched = (places[slot] for slot in ("switch", "actions") if slot in places)
        over = (one.y for one in touched if one.y > low.y and one.x < low.right and low.x < one.right)
        ceiling = min([places["top"].y, *over])
        self.checks.wide, self.checks.room = min(low.width, 340 * dp), ceiling - 8 * dp - low.y
        self._strip = Rect(0, 0, 0, 0)
        self._uncover()
        self.sight.place(places["badge"], to_right=form != "wide")
        chip = places["badge" if form == "wide" else "top"].y
        aside = max(0.0, body.right - self.notice.right - 8 * dp)
        self.video.insets = [self.notice.x - 8 * dp - body.x, 0, aside, body.top - chip]
        return places["stop"]

    def _arrange(self, body: Rect, form: str, dp: float) -> dict[str, Rect]:
        if self._two:
            return arrange.two_sticks(body, form, dp, switch=bool(self.hands.choices))
        return arrange.drive(body, form, dp, switch=bool(self.hands.choices))

    def _choose(self, *_: object) -> None:
        """Of two controls in one place one is on the glass; what is no stick needs no slider and takes its room too."""
        if not (self._arranged and self.hands.choices):
            return
        stick, slider = self._arranged["stick"], self._arranged["slider"]
        alone = not isinstance(self.hands.choices[self.hands.chosen], Stick)
        low, top = min(stick.y, slider.y), max(stick.top, slider.top)
        whole = Rect(stick.x, low, slider.right - stick.x, top - low) if alone else stick
        for widget in self.hands.choices.values():
            put(widget, whole if self.hands.shown(widget) else _off(whole))
        for widget in self.places.get("slider", ()):
            put(widget, _off(slider) if alone else slider)

    def clear(self, cover: Rect | None) -> None:
        """Take away what would be seen only in part behind what is said over the screen."""
        self._cover = cover
        self._uncover()

    def _uncover(self, *_: object) -> None:
        """What lies under the unfolded sensors, or under what is said, is not seen, not even at its corners."""
        if not self._arranged:
            return
        lids = [self._cover] if self._cover is not None else []
        if self.senses.covers:
            lids.append(self._arranged["senses_open"])
        for slot in HIDES:
            place = self._arranged[slot]
            hidden = any(lid.overlaps(place) for lid in lids)
            for widget in self.places.get(slot, ()):
                widget.opacity = 0 if hidden else 1
                # what has a shader of its own knows nothing of opacity
                put(widget, _off(place) if hidden else place)
        low, cover = self.low, self._cover
        under = cover is not None and cover.overlaps(Rect(*low.pos, *low.size))
        low.opacity, low.disabled = float(not under), under
        self.sight.covered = cover is not None and cover.overlaps(self._arranged["badge"])
        strip = self._arranged["senses"]
        if cover is not None and cover.overlaps(strip) and self.senses.folded:
            strip = _off(strip)
        if strip != self._strip:
            self._strip = strip
            self.senses.place(strip, self._arranged["senses_open"])

    def _trim(self, roomy: bool) -> None:
        """A phone has room for two figures."""
        wanted = self._figures if roomy else self._figures[:2]
        if list(reversed(self.readouts.children)) != wanted:
            self.readouts.clear_widgets()
            for widget in wanted:
                self.readouts.add_widget(widget)

    def hear(self, channel: str, post: Post) -> None:
        """A message came."""
        self.dashboard.deliver(channel, post.value)
        self.hands.hear(channel, post)
        if channel == OFFER:
            self.instruments.name_sources(self.session.offer)
            if self.hands.take_up():
                self.app.shell.settle()

    def enter(self) -> None:
        """Come onto the glass."""
        self.hands.take_limits()
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
        self.senses.tick()
        self.sight.tick()
        self.in_vain.tick()
        self.checks.tick()
        self.hands.tick()
        self.actions.tick()

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """A decoded camera frame; `rate` [Hz] and `latency` [s] are said on it, NaN for unknown."""
        self.video.show_frame(picture.width, picture.height, picture.rgba, picture.taken)
        self.video.rate, self.video.latency = rate, latency


def _off(place: Rect) -> Rect:
    """As large, off the glass."""
    return Rect(AWAY, place.y, place.width, place.height)


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
