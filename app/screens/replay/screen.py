"""The replay screen: the list of recordings, and the one that is open at a moment of it.

It is given no session: what is played can reach no robot. STOP beside it is that of the robot of now.
"""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import Any

from kivy.lang import Builder
from kivy.properties import NumericProperty, ObjectProperty, OptionProperty, StringProperty

from app.layout.arrange import Body, Rect
from app.replay.player import Player
from app.replay.recording_index import Index
from app.replay.recording_list import RecordingList
from app.screens.parts.field_chooser import FieldChooser
from app.screens.parts.placing import Area, above, put  # noqa: F401 - a rule names the area
from app.screens.parts.robot_screen import RobotScreen
from app.screens.replay.moment_view import MomentView
from app.screens.replay.places import moment, replay, replay_alone
from app.screens.replay.recording_rows import RecordingRows
from app.screens.replay.transport import Transport
from widgets.core.language import mark, tr
from widgets.core.theme import theme
from widgets.plots.time_line import TimeLine, length_text

__all__ = ["ReplayScreen"]

TABS = (("map", mark("Map")), ("plots", mark("Plots")), ("events", mark("Events")))
Builder.load_string("""
#:import without_date app.screens.replay.transport.without_date
<ReplayScreen>:
    canvas.after:
        Color:
            rgba: theme.plan if root.opened else (0, 0, 0, 0)
        Line:
            rectangle: self.x + dp(1), self.y + dp(1), self.width - dp(2), self.height - dp(2)
            width: dp(1.5)
    Area:
        id: listed
    BoxLayout:
        id: head
        size_hint: None, None
        spacing: dp(8)
        IconButton:
            id: back
            icon: 'arrow_back'
            bare: True
            pos_hint: {'center_y': .5}
            on_release: root.back()
        BoxLayout:
            size_hint: None, None
            size: self.minimum_size
            padding: dp(10), dp(5)
            spacing: dp(6)
            pos_hint: {'center_y': .5}
            fill: 'plan'
            canvas.before:
                Rounded:
                    rgba: theme.plan
                    pos: self.pos
                    size: self.size
                    radius: [theme.corner * .8]
            Icon:
                name: 'history'
                role: 'ink_plan'
                font_size: sp(18)
                size_hint: None, None
                size: self.texture_size
                pos_hint: {'center_y': .5}
            Label:
                text: root.badge if root.form != 'tall' else without_date(root.badge)
                font_name: theme.font
                bold: True
                font_size: sp(14)
                color: theme.ink_plan
                disabled_color: self.color
                size_hint: None, None
                size: self.texture_size
                pos_hint: {'center_y': .5}
        Text:
            id: title
            text: root.title
            role: 'muted'
            font_size: sp(14)
            size_hint_y: 1
            text_size: self.size
            valign: 'middle'
            shorten: True
        QuietButton:
            id: choose
            icon: 'timeline'
            text: root.choose_words if root.form == 'wide' else ''
            size_hint_x: None
            width: dp(170) if root.form == 'wide' else self.height
            height: max(dp(52), theme.least)
            pos_hint: {'center_y': .5}
    Segmented:
        id: tabs
        size_hint: None, None
        options: root.tabs
        value: root.tab
        font_size: sp(15)
        on_choose: root.tab = args[1]
""")


class ReplayScreen(RobotScreen):
    """The same with a robot, in its frame, and without one, on a page of its own."""

    app = ObjectProperty()
    opened = StringProperty("")
    """Name of the file of the recording that is open; empty for the list."""
    badge = StringProperty("")
    title = StringProperty("")
    form = OptionProperty("wide", options=["wide", "short", "tall"])
    tab = StringProperty("map")
    """What a phone shows of the moment."""
    speed = NumericProperty(1.0)

    def __init__(self, **kwargs: Any) -> None:
        self.tabs = [(name, tr(words)) for name, words in TABS]
        self.choose_words = tr("Plot a number")
        super().__init__(**kwargs)
        for name in ("listed", "head", "tabs"):  # kv holds ids weakly
            self.ids[name] = self.ids[name].__self__
        self.player: Player | None = None
        self.recordings = RecordingList(lambda: self.app.records.files)
        self.recordings.on_change = self._show_list
        self.list, self.view = RecordingRows(), MomentView()
        self.line, self.transport = TimeLine(), Transport()
        self.chooser: FieldChooser | None = None
        self._places: dict[str, Rect] = {}
        self._dp = 1.0
        self._cover: Rect | None = None
        self._kept: tuple[Path, float] | None = None
        """What was open when the screen was left, and at which moment."""
        self._active = self._watching = False
        self._build()

    def _build(self) -> None:
        self.list.bind(on_open=lambda _, path: self.open(path))
        self.list.nothing.bind(on_open=lambda _, path: self.open(path) if self._active else None)
        self.ids.listed.add_widget(self.list)
        self.ids.choose.bind(on_release=lambda _: self.toggle_chooser())
        self.view.bind(on_seek=lambda _, at: self.seek(at))
        self.line.bind(on_seek=lambda _, at: self.seek(at))
        self.transport.bind(
            on_play=lambda _: self.toggle_playing(),
            on_step=lambda _, way: self._step(way),
            on_pace=lambda _, speed: self.set_speed(speed),
        )
        self.bind(tab=self._lay)

    # what the frame calls

    def arrange(self, body: Body, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self.form, self._dp, self._places = form, dp, replay(body, form, dp, theme.least)
        self.notice = self._places["notice"]
        self._lay()
        return self._places["stop"]

    def spread(self, body: Rect, form: str, dp: float) -> None:
        """The same where there is no robot."""
        self.form, self._dp, self._places = form, dp, replay_alone(body, form, dp, theme.least)
        self._lay()

    def clear(self, cover: Rect | None) -> None:
        """Have the list end above what is said over the screen."""
        self._cover = cover
        self._lay()

    def enter(self) -> None:
        """Come onto the glass; what was open when it was left is opened again."""
        self._active = True
        self.recordings.refresh()
        self._show_list()
        if self._kept is not None:
            path, at = self._kept
            if path.exists():
                self.open(path, at)

    def leave(self) -> None:
        """Leave the glass: nothing is read for it any more."""
        if not self._active:
            return
        self._active = False
        kept = (self.player.path, self.player.position) if self.player is not None else None
        self.shut()
        self._kept = kept
        self.recordings.close()

    def end(self) -> None:
        """Let go of the threads and of the map."""
        self.leave()
        self.view.map.close()

    def back(self) -> bool:
        """From the choice of numbers to the moment, from there to the list; False when that is on the glass."""
        if self.chooser is not None:
            self.toggle_chooser()
            return True
        if self.player is None:
            return False
        self.shut()
        self._show_list()
        return True

    def tick(self) -> None:
        """Go on with what is played."""
        player = self.player
        if player is None:
            self.list.nothing.update(self.app)
            return
        player.tick()
        if player.problem:
            self.title = player.problem
        elif player.index is None:
            self.title = tr("Reading {name}: {part} %").format(
                name=player.path.name, part=round(player.progress * 100)
            )
        else:
            self._show_moment(player)

    # the list

    def _show_list(self) -> None:
        if self.player is None and self._active:
            self.list.show(self.recordings.glimpses)
            self.list.nothing.update(self.app)
            self._lay()

    # one recording

    def open(self, path: Path, at: float = math.nan) -> None:
        """Open a recording, at the moment `at` [s since 1970] or at its beginning."""
        self.shut()
        self.player = Player(path, self.app.now)
        self._kept = (path, at)
        self.player.speed = self.speed
        self.opened, self.badge = path.name, tr("Replay").upper()
        self.title = tr("Reading {name}: {part} %").format(name=path.name, part=0)
        self._lay()

    def shut(self) -> None:
        """Close the one that is open."""
        if self.chooser is not None:
            self.toggle_chooser()
        self.view.close()
        if self.player is not None:
            self.player.close()
        self.player, self._kept, self.opened, self._watching = None, None, "", False
        self.line.state, self.line.marks = "never", []
        self.transport.playing = False
        if self._places:
            self._lay()

    def _watch(self, player: Player) -> None:
        """It is open now: show its first moment."""
        index = player.index
        if index is None:
            return
        self._watching = True
        self.view.open(player)
        self.line.start, self.line.end, self.line.state = index.start, index.end, "live"
        self.line.marks = [(at, event.level) for at, event in index.events]
        if self._kept is not None:
            player.seek(self._kept[1])
        self.title = _title(index)
        self._lay()

    def _show_moment(self, player: Player) -> None:
        if not self._watching:
            self._watch(player)
        self.view.tick()
        self.line.position = player.position
        self.transport.playing = player.playing
        when = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(player.position))
        self.badge = f"{tr('Replay').upper()} · {when}"

    def seek(self, at: float) -> None:
        """Go to a moment [s since 1970]."""
        if self.player is not None:
            self.player.seek(at)
            self.tick()

    def toggle_playing(self) -> None:
        """Play, or stand still."""
        if self.player is not None:
            if self.player.playing:
                self.player.pause()
            else:
                self.player.play()
            self.tick()

    def set_speed(self, speed: float) -> None:
        """Play so many times as fast as it was."""
        self.speed = self.transport.speed = speed
        if self.player is not None:
            self.player.speed = speed

    def _step(self, way: int) -> None:
        if self.player is not None:
            self.player.step_event(way)
            self.tick()

    def toggle_chooser(self) -> None:
        """Show the numbers that can be drawn, or put them away."""
        if self.chooser is None:
            if self.player is None or self.player.index is None:
                return
            self.chooser = FieldChooser(drawn=self.view.drawn)
            self.chooser.offer(self.view.choices())
            self.chooser.bind(
                on_turn=lambda _, *field: self._turn(*field), on_close=lambda _: self.toggle_chooser()
            )
            self.tab = "plots"
        else:
            self.remove_widget(self.chooser)
            self.chooser = None
        self._lay()

    def _turn(self, topic: str, path: str, unit: str) -> None:
        self.view.turn(topic, path, unit)
        if self.chooser is not None:
            self.chooser.drawn = self.view.drawn

    # places

    def _lay(self, *_: object) -> None:
        if not self._places:
            return
        main, dp, open_ = self._places["main"], self._dp, self.player is not None
        ready, phone, chooser = open_ and self._watching, self.form != "wide", self.chooser
        places = moment(main, self.form, dp, theme.least, chooser=chooser is not None)
        self._place(self.ids.listed, above(main, self._cover, dp), not open_)
        self._place(self.ids.head, places["head"], open_)
        self.ids.choose.disabled = not ready
        self._place(self.ids.tabs, places.get("tabs", places["head"]), ready and phone)
        if chooser is not None:
            self._place(chooser, places["chooser"], True)
        self._place(self.view, places["view"], ready)
        if ready:
            self.view.arrange(places["view"], self.form, dp, self.tab)
        for widget, name in ((self.line, "line"), (self.transport, "buttons")):
            place = self._places[name]
            if widget is self.transport:  # in the middle of its place
                high = self.transport.height_in(place.width, dp)
                place = Rect(place.x, place.y + max(0.0, (place.height - high) / 2), place.width, high)
            self._place(widget, place, ready and not (chooser is not None and phone))

    def _place(self, widget: Any, place: Rect, wanted: bool) -> None:
        put(widget, place)
        if wanted != (widget.parent is self):
            (self.add_widget if wanted else self.remove_widget)(widget)


def _title(index: Index) -> str:
    """Whose recording it is, how long, and what is wrong with it."""
    robot = index.info.name if index.info is not None else tr("Unknown robot")
    return " · ".join(part for part in (robot, length_text(index.duration), index.problem) if part)
