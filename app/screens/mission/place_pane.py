"""The place that is being made or changed, or how to come to one."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.link.commands import Outcome
from app.screens.parts.pane_head import PaneHead
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Place, PlaceArray
from widgets import PlaceForm
from widgets.core.language import tr

__all__ = ["PlacePane"]

Builder.load_string("""
<PlacePane>:
    orientation: 'vertical'
    spacing: dp(8)
""")


class PlacePane(BoxLayout):
    """The form of a place; dispatches `on_close`, and `on_back(place)` when the robot did not take one that was made here."""

    __events__ = ("on_close", "on_back")

    open = BooleanProperty(False)
    """A new place is being made, which has no number yet."""
    title = StringProperty("")

    def __init__(self, session: Session, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._session = session
        self._kept: Place | None = None
        """What is on its way to the robot."""
        self.head, self.form, self._rest = PaneHead(), PlaceForm(), Widget()
        self.add_widget(self.head)
        self.head.bind(on_close=lambda _: self.dispatch("on_close"))
        self.form.bind(on_command=lambda *_: self.refresh())
        self.bind(open=lambda *_: self.refresh())
        self.refresh()

    @property
    def sentence(self) -> str:
        """What is missing, or what to do."""
        return str(self.head.sentence)

    @property
    def there(self) -> bool:
        """There is a place to be looked at."""
        return bool(self.form.shown.id) or self.open

    def edit(self, place: Place) -> None:
        """Make a place (id 0) or change one."""
        self.form.show(place)
        self.refresh()
        self.name_places(self._session.feeds.latest("/places") or PlaceArray())

    def name_places(self, msg: PlaceArray) -> None:
        """No two places have the same name."""
        self.form.taken = [place.name for place in msg.places if place.id != self.form.shown.id]

    def refresh(self) -> None:
        """Say what there is to say of it."""
        there = self.there
        self.head.title = (
            tr("Places") if not there else tr("Place") if self.form.shown.id else tr("New place")
        )
        refused = self._session.refusals.place(self.form.place) if there else ""
        self.head.refused = bool(refused)
        asks = refused or self.form.lacking
        self.head.sentence = asks if there else tr("Choose a place to change it, or make a new one.")
        self.form.disabled = not there
        for widget, shown in ((self.form, there), (self._rest, not there)):
            if shown != (widget.parent is self):
                (self.add_widget if shown else self.remove_widget)(widget)

    def keep(self) -> None:
        """Store it at the robot."""
        self._kept = self.form.place
        self._session.tasking.keep_place(self._kept)
        self.form.show(Place())
        self.refresh()

    def on_outcome(self, outcome: Outcome) -> None:
        """What became of a command: what was typed for a place that is refused comes back, unless another is made."""
        if outcome.name != "place" or outcome.phase == "sent" or outcome.fields["place"] != self._kept:
            return
        place, self._kept = self._kept, None
        if outcome.phase != "accepted" and place is not None and not self.there:
            self.dispatch("on_back", place)

    def forget(self) -> None:
        """Delete it; can be undone."""
        self._session.tasking.forget_place(self.form.shown)
        self.form.show(Place())
        self.refresh()

    def rest(self) -> None:
        """Fingers let go of what they hold."""
        self.form.rest()

    def on_close(self) -> None:
        """A finger asked to go back to the lists."""

    def on_back(self, place: Place) -> None:
        """The robot did not take `place`."""
