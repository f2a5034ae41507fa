"""The mission screen: the map with everything on it, and beside it (or on a sheet for the thumb) what to do about it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import mm
from kivy.properties import ListProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.widget import Widget

from app.layout import arrange
from app.layout.arrange import Rect
from app.link.camera_decoder import Picture
from app.link.channels import CAPABILITIES, EVENT, OUTCOME
from app.link.commands import Outcome
from app.link.feeds import Post
from app.screens.mission.intruder_card import IntruderCard
from app.screens.mission.map_card import MapCard, map_insets
from app.screens.mission.map_corner import MapCorner
from app.screens.mission.map_pointing import MODES, MapPointing
from app.screens.mission.map_tools import MapTools, float_over
from app.screens.mission.mission_maps import MissionMaps
from app.screens.mission.mission_on_map import MissionOnMap
from app.screens.mission.mission_panel import MissionPanel
from app.screens.mission.picture_swap import PictureSwap
from app.screens.parts.picture_boxes import PictureBoxes
from app.screens.parts.placing import put
from app.screens.parts.robot_screen import RobotScreen
from app.screens.shell.check_card import CheckCard
from app.screens.shell.screen_host import ScreenHost
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Place, RobotInfo
from widgets import Compass, Video
from widgets.core.theme import theme
from widgets.map.map_overlay import MapOverlay

__all__ = ["MissionScreen"]


Builder.load_string("""
<MissionScreen>:
    FloatLayout:
        id: ground
    FloatLayout:
        id: floats
    BoxLayout:
        id: side
        size_hint: None, None
        canvas.before:
            Color:
                rgba: theme.line
            Rectangle:
                pos: self.x - theme.outline, self.y
                size: self.width + 2 * theme.outline, self.height + theme.outline
            Color:
                rgba: theme.surface
            Rectangle:
                pos: self.pos
                size: self.size
    SheetGrip:
        id: handle
        size_hint: None, None
    Segmented:
        id: modes
        options: root.modes
        value: root.mode
        size_hint: None, None
        font_size: sp(15)
        on_choose: root.mode = args[1]
""")


def _both(first: Callable[[], object], then: Callable[[], object]) -> Callable[[], None]:
    def both() -> None:
        first()
        then()

    return both


class MissionScreen(RobotScreen):
    """Supervise one robot on its map."""

    app: ObjectProperty[ScreenHost] = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()
    modes = ListProperty(MODES)
    mode = StringProperty("view")
    """What a finger on the map does: one of `MODES`."""
    sheet = NumericProperty(0)
    """The sheet of a phone is drawn up: 0 no, 1 yes."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.dashboard = Dashboard(self.session.feeds)
        self._maps = MissionMaps(self.session, self.dashboard, self.app.maps)
        self.video = Video(fit="cover")
        self._boxes = PictureBoxes(self.session, self.dashboard, self.video)
        self.compass = Compass(transparent=True)
        self.panel = MissionPanel(self.session, self.dashboard)
        self._pointing = MapPointing(self, self.session)
        self.selection = self._pointing.bar
        self.checks = CheckCard(self.session, self.dashboard)
        self.intruder = IntruderCard(self.session, self.dashboard)
        self._drawing = MissionOnMap(self.session, self._maps, self.panel, self._pointing)
        self._corner = MapCorner(self.selection, self.checks, self.intruder)
        self.corner = self._corner.box
        """Over the map: what is selected and the check list, one above the other."""
        self.card = MapCard(self)
        self._tools = MapTools(
            self.session, self._look, lambda: self._maps.toggle_card(self), self._pointing.measure
        )
        self._form, self._body, self._dp = "wide", Rect(0, 0, 1, 1), 1.0
        self._build()
        self.swap = PictureSwap(self)
        self._bind_map()
        self.bind(mode=self._mode_changed, sheet=self._rearrange)
        self.session.mission.on_change = _both(self.session.mission.on_change, self._drawing.show_draft)
        self.notice = self._body
        self._drawing.show_draft()

    @property
    def map(self) -> MapOverlay:
        """The map on the glass."""
        return self._maps.shown

    def _build(self) -> None:
        ids = self.ids
        for name in ("ground", "floats", "side", "handle", "modes"):  # kv holds ids weakly
            ids[name] = ids[name].__self__
        ids.ground.add_widget(self.map)
        for widget in (self.video, self.compass, self.panel.readouts):
            widget.size_hint = (None, None)
        ids.update(self._tools.buttons)
        self.add_widget(self.panel)
        self.panel.tasks.size_hint = (None, None)
        self.panel.tasks.bind(on_command=lambda _, name: self._pointing.commanded(name))
        self.panel.lacking.bind(on_choose=lambda _, screen: self.app.show(screen))
        ids.handle.bind(on_touch_down=self._pull)
        ids.floats.add_widget(self.corner)
        ids.update({"map": self.map, "video": self.video, "selection": self.selection, "panel": self.panel})
        ids.update({"tasks": self.panel.tasks, "send": self.panel.ids.send, "motion": self.panel.motion})

    def _look(self, how: str) -> None:
        """Change what is seen of the map that is on the glass now, which need not be the first one."""
        getattr(self.map, how)()

    def _bind_map(self) -> None:
        bind = self.dashboard.bind
        self._maps.follow(self._pointing)
        bind(self.map, "/robot/info", self._show_info, fresh=False)
        bind(self.map, "/task/status", self._drawing.show_task, fresh=False)
        for topic in ("/limits", "/map"):
            bind(self.map, topic, lambda _: self._drawing.show_draft(), fresh=False)
        bind(self.compass, "/pose")
        bind(self, "/pose", self._pointing.places.on_pose, fresh=False)

    # what the shell calls

    def arrange(self, body: Rect, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self._form, self._body, self._dp = form, body, dp
        grip = max(mm(10), theme.target if theme.gloves else 0.0)
        places = arrange.mission(body, form, dp, sheet_open=bool(self.sheet), grip=grip)
        tall = form == "tall"
        put(self.ids.side, places["side"])
        put(self.map, places["map"])
        whole = places["modes"]
        put(self.ids.modes, Rect(whole.x, whole.y, whole.width * len(self.modes) / len(MODES), whole.height))
        float_over(self.ids.floats, self.video, places.get("video"))
        self.video.show_chip = form == "wide"
        float_over(self.ids.floats, self.compass, places.get("compass"))
        self.panel.take_form(form)
        self.panel.sheet_open = bool(self.sheet) and tall
        float_over(self.ids.floats, self.panel.readouts, places.get("readouts"))
        put(self.panel, places["panel"])
        put(self.ids.handle, places.get("handle", Rect(-100, -100, 1, 1)))
        self.ids.handle.opacity = 1 if tall else 0
        self.panel.put_tasks(self, places.get("tasks"))
        self._tools.arrange(self.ids.floats, places["tools"], dp, tall=tall, has_layers=self._maps.offered)
        self._place_floats(places)
        self._tools.clear(self.ids.floats, self.card.place)
        self.notice = places["notice"]
        self._pointing.show()
        up = bool(self.sheet) and tall
        self._corner.arrange(self.map, places["selection"], self.notice, form, dp, sheet_up=up)
        self.swap.arrange(places)
        return places["stop"]

    def _place_floats(self, places: dict[str, Rect]) -> None:
        """With the sheet up, what would lie on it is away; the map fits into what is left free."""
        up = bool(self.sheet) and self._form == "tall"
        covered = up or (self.card.open and self._form == "short")
        self.ids.modes.disabled = covered or len(self.modes) < 2
        self.ids.modes.opacity = 0 if self.ids.modes.disabled else 1
        self.card.arrange(places, self._body, self._form, self._dp)
        self.map.insets = map_insets(places, self._form, self.card.place)
        ends = sorted((places["video"], places["tools"]), key=lambda place: place.x)
        self.map.badge_span = [ends[0].right, ends[1].x] if self._form == "tall" else [0, 0]

    def show_selection(self, shown: bool) -> None:
        """Have the bar that says what is selected on the glass, or away; the map that is edited is not covered by more."""
        self._corner.show(selection=shown, looks=self.mode == "view", covered=self.card.open)

    def show_card(self, card: Widget | None) -> None:
        """Have a card over the map, beside which what it asks of is seen; None takes it away."""
        self.card.show(card)
        self._rearrange()

    @property
    def picture(self) -> Video:
        """The camera's picture."""
        return self.video

    def clear(self, cover: Rect | None) -> None:
        """Take away what would be seen only in part behind what is said over the map."""
        self._corner.clear(cover)
        self._maps.make_room(cover)

    def _rearrange(self, *_: object) -> None:
        self.arrange(self._body, self._form, self._dp)

    def _pull(self, _: object, touch: Any) -> bool:
        if self._form != "tall" or not self.ids.handle.collide_point(*touch.pos):
            return False
        self.sheet = 1 - self.sheet
        return True

    def on_post(self, channel: str, post: Post) -> None:
        """A message came."""
        self.dashboard.deliver(channel, post.value)
        if channel == EVENT:
            self.panel.events.show(post.value)
        elif channel == OUTCOME:
            self._pointing.places.on_outcome(post.value)
            self._show_outcome(post.value)
        elif channel == CAPABILITIES:
            self._take_offer()

    def _take_offer(self) -> None:
        """A finger on the map can do only what this robot takes."""
        modes = self._pointing.modes()
        if modes != self.modes:
            self.modes = modes
            self.mode = "view"
        self._rearrange()

    def enter(self) -> None:
        """Come onto the glass."""
        self._take_offer()
        self.dashboard.enter()
        self._drawing.show_draft()
        self.tick()

    def leave(self) -> None:
        """Leave the glass."""
        self.rest()
        self.dashboard.leave()

    def end(self) -> None:
        """Let go of the maps."""
        self._maps.end()

    def back(self) -> bool:
        """Take the card over the map away, else what a finger on the map would do."""
        if self.card.leave():
            return True
        armed, self.mode = self.mode != "view", "view"
        return armed

    def rest(self) -> None:
        """Fingers on the map and on what lies over it let go of what they hold."""
        self.map.let_go()
        self._pointing.places.rest()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self.dashboard.tick()
        self._drawing.tick()
        self.panel.tick()
        self.checks.tick()
        self.intruder.tick()
        self._boxes.tick()
        self._tools.tick(self.map, self.mode)
        if self._maps.tick(self):
            self._rearrange()
        self._pointing.tick()

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """A decoded camera frame; `rate` [Hz] and `latency` [s] are said on it, NaN for unknown."""
        self.intruder.keep(picture)
        self.video.show_frame(picture.width, picture.height, picture.rgba, picture.taken)
        self.video.rate, self.video.latency = rate, latency

    def _show_info(self, info: RobotInfo) -> None:
        self._drawing.show_info(info)
        self._rearrange()

    def _show_outcome(self, outcome: Outcome) -> None:
        name = {"cancel": "stop"}.get(outcome.name, outcome.name)
        if name in ("start", "pause", "resume", "home") or outcome.name == "cancel":
            what = outcome.label if name == "start" else ""
            self.panel.tasks.answer(name, outcome.phase, outcome.reason, outcome.latency, what)

    def _mode_changed(self, *_: object) -> None:
        self.map.mode = self.mode
        self._pointing.mode_changed()

    def choose_place(self, on_chosen: Callable[[Place], object]) -> None:
        """Let the next tap on a place choose it."""
        self._pointing.places.choose(on_chosen)

    def move_place(self, place: Place) -> None:
        """Let the next tap say where a place is."""
        self._pointing.places.move(place)
