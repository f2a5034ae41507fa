"""STOP ALL on every page: a small button in STOP's corner whenever there is more to stop than STOP does, and what became of it.

It lies over everything else, questions included, and lets every finger through that is not on it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, Protocol

from kivy.clock import Clock
from kivy.metrics import Metrics
from kivy.uix.floatlayout import FloatLayout

from app.core.hand import hand
from app.discovery.known_robots import Entry, KnownRobots
from app.layout import arrange
from app.layout.arrange import Body, Rect, StopPlace
from app.screens.connect.connect import ConnectScreen
from app.screens.parts.placing import put
from app.screens.parts.safe_area import safe_area
from app.stop.fleet import Fleet
from app.stop.robot_count import count
from widgets import StopAll
from widgets.core.language import tr

if TYPE_CHECKING:
    from app.screens.shell.shell import Shell
    from app.session.session import Session
    from widgets import StopList

__all__ = ["StopCorner"]

MIN_READABLE_HEIGHT = 280
"""So high must be what is left of a screen above the list and what is said, else the list is folded [dp]."""


class Host(Protocol):
    """The app, as far as STOP ALL needs it."""

    connect: ConnectScreen

    @property
    def robots(self) -> KnownRobots:
        """Every robot that is heard or saved."""

    @property
    def session(self) -> Session | None:
        """The session with the robot; None while none is wanted."""

    @property
    def shell(self) -> Shell | None:
        """The frame round the robot's screens; None where there is no robot."""


class StopCorner:
    """The button, the list, and where they are. `tick` brings them up to date, ten times a second."""

    def __init__(self, app: Host, fleet: Fleet, say: Callable[[str, str], object]) -> None:
        """`say(text, level)` says one sentence."""
        self._app, self._fleet, self._say = app, fleet, say
        self.on_pressed: list[Callable[[], object]] = []
        """Called when STOP ALL was pressed and is on its way."""
        self.layer = FloatLayout()
        """To be put over the whole glass."""
        self.button = self._made_button()
        self._list: StopList | None = None
        self._spread = False
        """The operator wants to see all of the list, whatever it lies over."""
        self._arranging = Clock.create_trigger(self._place, -1)
        self.layer.bind(size=self._arranging)
        safe_area.bind(insets=self._arranging)

    def _made_button(self) -> StopAll:
        button = StopAll(size_hint=(None, None))
        button.bind(on_command=lambda _: self.press())
        return button

    def renew(self) -> None:
        """Make button and list anew, as in another size of text; what is sent goes on being sent, and is seen where it was."""
        listed = self._list is not None and self._list.parent is not None
        for widget in (self.button, self._list):
            if widget is not None:
                self._show(widget, shown=False)
        self.button, self._list = self._made_button(), None
        if listed:
            self._show(self.list, shown=True)
        self.tick()

    @property
    def list(self) -> StopList:
        """What became of STOP ALL, robot by robot; made when it is first looked at."""
        if self._list is None:
            from widgets import StopList

            self._list = StopList(size_hint=(None, None))
            self._list.bind(
                on_command=lambda _: self._let_go(),
                on_close=lambda _: self._fold(),
                on_fold=lambda _: self._turn(),
                wanted=self._place,
            )
        return self._list

    def press(self) -> None:
        """STOP to every robot that is known, the connected one first."""
        if self._app.shell is not None:
            self._app.shell.rest()
        self._fleet.press(self._entries(), self._app.session)
        for hear in list(self.on_pressed):
            hear()
        self._show(self.list, shown=True)
        self.tick()

    def leave(self, session: Session | None) -> None:
        """The link of `session` is about to be closed: what it has to stop goes on being stopped, and that is seen."""
        if session is None:
            self._fleet.update(None)
        elif self._fleet.leave(session):
            self._show(self.list, shown=True)

    def _entries(self) -> Iterator[Entry]:
        yield from self._app.robots.entries()

    def tick(self) -> None:
        """Look who is known and what became of STOP."""
        fleet, button = self._fleet, self.button
        fleet.update(self._app.session)
        entries, session = self._app.robots.entries(), self._app.session
        button.robots, button.lost, button.silent = count(entries, session)
        folded = self._list is None or self._list.parent is None
        button.active = fleet.active and (fleet.meant_all or folded)  # else the list says it all
        button.stopped, button.total = fleet.stopped, fleet.total
        least = 2 if self._app.shell is not None else 1
        # by address: that two of them are one robot is what somebody says, and takes STOP ALL away from nobody
        # and an address where nothing was ever met is no robot
        addresses = {entry.url for entry in entries if entry.met}
        if session is not None and session.ever_connected:
            addresses.add(session.robot.url)
        self._show(button, shown=fleet.active or len(addresses) >= least)
        if not fleet.active:
            if self._list is not None:
                self._show(self._list, shown=False)
        elif self.list.parent is not None:
            since = fleet.since(entries)
            self.list.update(
                fleet.rows,
                fleet.stopped,
                fleet.total,
                untried=fleet.untried,
                since=since,
                unmet=fleet.unmet,
            )
        elif not fleet.sending:
            self._finish()
        self._place()

    def _finish(self) -> None:
        """The list was folded away before all was done: it ends by itself, and is said."""
        stopped, total = self._fleet.stopped, self._fleet.total
        what = "STOP ALL" if self._fleet.meant_all else "STOP"
        self._say(
            tr("{what} is done: {stopped} of {total} stopped.").format(
                what=what, stopped=stopped, total=total
            ),
            "ok" if stopped == total else "warn",
        )
        self._fleet.let_go()

    def _let_go(self) -> None:
        self._fleet.let_go()
        self.tick()

    def _fold(self) -> None:
        """What is sent goes on being sent; when nothing is, there is nothing left to say."""
        if self._fleet.sending:
            self._show(self.list, shown=False)
        else:
            self._let_go()

    def _show(self, widget: Any, *, shown: bool) -> None:
        if shown and widget.parent is None:
            self.layer.add_widget(widget)
        elif not shown and widget.parent is not None:
            widget.rest()
            self.layer.remove_widget(widget)

    # places

    def _place(self, *_: object) -> None:
        dp, shell = Metrics.density, self._app.shell
        shared = self.button.parent is not None
        form = arrange.form(self.layer.width, self.layer.height, dp)
        inside = safe_area.within(self.layer.width, self.layer.height)
        if shell is None:
            corner = arrange.corner(inside, dp, left_hand=hand.left)
            place = StopPlace(corner.x, corner.y, corner.width, corner.height, corner)
            below, beside = (0.0, corner.width + 18 * dp) if form == "short" else (arrange.CORNER * dp, 0.0)
            self._app.connect.left_hand = hand.left
            self._app.connect.keep_free = (below, beside) if shared else (0.0, 0.0)
            room = Rect(inside.x, inside.y, inside.width, inside.height - 56 * dp)
        else:
            shell.shares_stop = shared
            place = shell.stop_place
            room = shell.places(inside)["body"]
        body = Body(room.x, room.y, room.width, room.height, left_hand=hand.left)
        if place.other is not None:
            put(self.button, place.other)
        if self._list is not None:
            self._place_list(self._list, body, place, form, dp)

    def _place_list(self, listed: StopList, body: Rect, place: StopPlace, form: str, dp: float) -> None:
        """Above STOP; in one line where a card has to be answered there, and what is only said goes above it."""
        shell = self._app.shell
        whole = arrange.stop_list(body, place, form, listed.wanted, dp)
        cramped = False
        if shell is not None and listed.parent is not None:
            said = shell.notices.room
            left = body.top - whole.top - 8 * dp - said.height
            alone = not shell.notices.asks and left >= MIN_READABLE_HEIGHT * dp
            cramped = said.height > 0 and whole.overlaps(said) and not alone
        self._spread = self._spread and cramped
        listed.cramped, listed.folded = cramped, cramped and not self._spread
        line = arrange.stop_list(body, place, form, listed.line, dp, folded=True)
        put(listed, line if listed.folded else whole)
        if shell is not None:
            shell.notices.above = (line if listed.folded else whole) if listed.parent is not None else None

    def _turn(self) -> None:
        self._spread = not self._spread
        self._place()
