"""The tour over the glass: a card at its upper edge and a ring round what it tells of; neither keeps a finger from anything else.

tour = Tour(app)
tour.begin()        # `step` is the card on the glass, None once it was left
"""

from __future__ import annotations

from typing import Any

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.metrics import Metrics, dp
from kivy.properties import BooleanProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.layout.rects import Rect
from app.screens.parts.dialogs import free_room
from app.screens.parts.placing import put
from app.screens.tour.cards import CARDS
from widgets.core.language import tr
from widgets.core.visible import Outline  # noqa: F401 - a rule names it
from widgets.parts.kit import Card, PrimaryButton, QuietButton

__all__ = ["SEEN", "Tour", "TourCard"]

SEEN = "toured"
"""Name in the settings of whether it was seen or left."""
WIDTH, BAR, GAP = 420.0, 56.0, 10.0
"""Of the card, of the bar above it and between the two [dp]."""
LOOK_PERIOD = 0.2
"""How often it looks whether what it points at is elsewhere [s]."""

Builder.load_string("""
<TourRing>:
    size_hint: None, None
    canvas:
        Outline:
            rgba: theme.accent
            rounded_rectangle: self.pos + self.size + [theme.corner]
            width: dp(3)

<TourCard>:
    size_hint: None, None
    height: self.minimum_height
    padding: dp(16)
    spacing: dp(10)
    outline: 'accent'
    BoxLayout:
        size_hint_y: None
        height: max(dp(30), heading.height)
        spacing: dp(10)
        Icon:
            name: root.icon
            role: 'accent'
            pos_hint: {'center_y': .5}
        Text:
            id: heading
            text: root.title
            bold: True
            font_size: sp(18)
            pos_hint: {'center_y': .5}
    Remark:
        text: root.words
        role: 'text'
        font_size: sp(15)
    Remark:
        text: root.note
""")


class TourRing(Widget):
    """Round what is told of; takes no finger."""

    def on_touch_down(self, touch: Any) -> bool:
        """Leave it to what lies below."""
        return False


class TourCard(Card):
    """Dispatches `on_next` and `on_leave`, and `on_simulate` where that is offered."""

    __events__ = ("on_leave", "on_next", "on_simulate")

    number = NumericProperty(0)
    icon, title = StringProperty("info"), StringProperty("")
    words, note = StringProperty(""), StringProperty("")
    offers = BooleanProperty(False)
    """The simulator can be started from here."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.next = PrimaryButton(text=tr("Next"))
        self.leave = QuietButton(text=tr("Leave the tour"))
        self.simulate = QuietButton(text=tr("Start the built-in simulator"), icon="play_circle")
        self.next.bind(on_release=lambda _: self.dispatch("on_next"))
        self.leave.bind(on_release=lambda _: self.dispatch("on_leave"))
        self.simulate.bind(on_release=lambda _: self.dispatch("on_simulate"))
        self.row = BoxLayout(size_hint_y=None, spacing=dp(10))
        self.row.bind(minimum_height=self.row.setter("height"))
        self.row.add_widget(self.leave)
        self.row.add_widget(self.next)
        self.add_widget(self.row)
        self.bind(offers=self._lay)

    def _lay(self, *_: object) -> None:
        if self.offers != (self.simulate.parent is self):
            if self.offers:
                self.add_widget(self.simulate, index=1)
            else:
                self.remove_widget(self.simulate)

    def show(self, number: int) -> None:
        """Say what the card of that number says."""
        step = CARDS[number]
        self.number, self.icon, self.title, self.words = number, step.icon, tr(step.title), tr(step.words)
        last = number == len(CARDS) - 1
        self.note = tr("{number} of {count}").format(number=number + 1, count=len(CARDS))
        self.next.text = tr("Done") if last else tr("Next")

    def on_next(self) -> None:
        """A finger wants the next one."""

    def on_leave(self) -> None:
        """A finger has had enough."""

    def on_simulate(self) -> None:
        """A finger wants a robot to try things on."""


class Tour:
    """Lies in the layer over every page, and is not modal: STOP and all else is pressed as ever."""

    def __init__(self, app: Any) -> None:
        """`app` has the layer of `corner`, the `settings`, and what the cards point at."""
        self._app = app
        self.card: TourCard | None = None
        """None while there is no tour."""
        self.ring = TourRing()
        self._looking = Clock.create_trigger(lambda _: self.look(), LOOK_PERIOD, interval=True)

    @property
    def step(self) -> int | None:
        """Number of the card on the glass, from 0; None while there is none."""
        return int(self.card.number) if self.card is not None else None

    def begin(self) -> None:
        """Show the first card."""
        self.leave(seen=False)
        self.card = TourCard()
        self.card.bind(
            on_next=lambda _: self.go_on(),
            on_leave=lambda _: self.leave(),
            on_simulate=lambda _: self._simulate(),
        )
        self.card.show(0)
        self._app.corner.layer.add_widget(self.card)
        self._looking()
        self.look()

    def go_on(self) -> None:
        """Show the next card; after the last there is none."""
        if self.card is None:
            return
        if self.card.number + 1 == len(CARDS):
            self.leave()
            return
        self.card.show(int(self.card.number) + 1)
        self.look()

    def leave(self, *, seen: bool = True) -> None:
        """Take it off the glass; `seen`: it does not begin by itself again."""
        self._looking.cancel()
        layer = self._app.corner.layer
        for widget in (self.card, self.ring):
            if widget is not None and widget.parent is layer:
                layer.remove_widget(widget)
        self.card = None
        if seen:
            self._app.settings.set(SEEN, True)

    def renew(self) -> None:
        """Make the card anew, as in another size of text."""
        number = self.step
        if number is not None:
            self.begin()
            for _ in range(number):
                self.go_on()

    def look(self) -> None:
        """Stand clear of STOP, and put the ring round what is told of, wherever that is now."""
        if self.card is None:
            return
        app, card, layer = self._app, self.card, self._app.corner.layer
        possible = app.simulating.possible and app.session is None and not app.connect.simulating
        card.offers = bool(possible and card.number == 0)
        room = free_room(
            self._whole(), self._kept(), dp(GAP), (min(dp(WIDTH), layer.width - dp(24)), card.height)
        )
        width = min(dp(WIDTH), room.width - dp(8))
        put(
            card,
            Rect(room.x + (room.width - width) / 2, max(room.y, room.top - card.height), width, card.height),
        )
        target = CARDS[int(card.number)].target(app)
        if target is None:
            if self.ring.parent is layer:
                layer.remove_widget(self.ring)
            return
        x, y = target.to_window(*target.pos)
        edge = dp(3)
        put(self.ring, Rect(x - edge, y - edge, target.width + 2 * edge, target.height + 2 * edge))
        if self.ring.parent is None:
            layer.add_widget(self.ring)

    def _whole(self) -> Rect:
        layer, density = self._app.corner.layer, Metrics.density
        return Rect(dp(12), dp(8), layer.width - dp(24), layer.height - (BAR + GAP) * density - dp(8))

    def _kept(self) -> list[Rect]:
        """What is never covered: STOP and STOP ALL, the bar along the lower edge of a phone, and what is pointed at."""
        app = self._app
        kept = [app.corner.button] if app.corner.button.parent is not None else []
        if app.shell is not None:
            kept += [app.shell.stop]
        return [Rect(*widget.to_window(*widget.pos), *widget.size) for widget in kept]

    def _simulate(self) -> None:
        self._app.simulating.start()
        self.look()
