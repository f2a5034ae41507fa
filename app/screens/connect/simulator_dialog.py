"""Which robots the built-in simulator starts, and in which world."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import BooleanProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.gridlayout import GridLayout

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.discovery.simulator_options import SimulationChoice, SimulatorOptions
from app.screens.connect.robot_card import robot_icon
from app.screens.parts.dialogs import Question
from widgets.core.language import mark, tr
from widgets.parts.labels import Icon
from widgets.parts.rows import ListRow

__all__ = ["SimulatorDialog"]

WORLD = "map"
ASKING = mark("Looking which robots and worlds there are …")

Builder.load_string("""
<SimulatorDialog>:
    columns: 1 if root.width < dp(560) else 2 if root.width < dp(800) else 3
    Card:
        id: card
        size_hint: None, None
        width: min(dp(940), root.room[2] - dp(20))
        height: min(root.room[3] - dp(24), head.height + column.height + foot.height + 2 * self.spacing + self.padding[1] + self.padding[3])
        pos: root.room[0] + (root.room[2] - self.width) / 2, root.room[1] + (root.room[3] - self.height) / 2
        padding: dp(14)
        spacing: dp(12)
        Column:
            id: head
            spacing: dp(4)
            Text:
                text: tr('Start the built-in simulator')
                bold: True
                font_size: theme.size_title
                shorten: True
                shorten_from: 'right'
            Text:
                text: root.sentence
                role: 'danger' if root.problem else 'muted'
                font_size: sp(14)
        Roll:
            BoxLayout:
                id: column
                orientation: 'vertical'
                size_hint_y: None
                height: self.minimum_height if root.offered else 0
                opacity: 1 if root.offered else 0
                spacing: dp(8)
                SectionLabel:
                    title: tr('Robots')
                    size_hint_y: None
                    height: dp(22)
                Grid:
                    id: robots
                    cols: root.columns
                    spacing: dp(8)
                    row_default_height: max(theme.target, root.robot_height)
                    row_force_default: True
                SectionLabel:
                    title: tr('World')
                    size_hint_y: None
                    height: dp(30)
                Grid:
                    id: worlds
                    cols: root.columns
                    spacing: dp(8)
                    row_default_height: max(theme.target, root.world_height)
                    row_force_default: True
        BoxLayout:
            id: foot
            size_hint_y: None
            height: theme.target
            spacing: dp(12)
            QuietButton:
                id: cancel
                text: tr('Cancel')
                on_release: root.close()
            PrimaryButton:
                id: start
                text: root.action
                disabled: not root.offered
                opacity: 1 if root.offered else .4
                on_release: root.answer()
""")


class SimulatorDialog(Question):
    """Robots to switch on and off, one world for all of them, and a button that starts them."""

    offered = ObjectProperty(None, allownone=True)
    """What there is; None until that is known."""
    problem = StringProperty("")
    """Why it is not known, as one sentence."""
    running = BooleanProperty(False)
    """There is a simulator already, which ends."""
    columns = NumericProperty(1)
    robot_height = NumericProperty(0)
    """What the words of the longest row need, so that all are alike [px]."""
    world_height = NumericProperty(0)
    """The same of the worlds [px]."""
    sentence = StringProperty("")
    action = StringProperty("")

    def __init__(
        self, choice: SimulationChoice, on_answer: Callable[[SimulationChoice], object], **kwargs: Any
    ) -> None:
        self._rows: dict[tuple[str, str], ListRow] = {}
        self.choice = choice
        super().__init__(**kwargs)
        self._on_answer = on_answer
        for name in ("problem", "running"):
            self.fbind(name, self._tell)
        self._tell()

    def show_offered(self, offered: SimulatorOptions) -> None:
        """Show what there is."""
        self.choice = self.choice.within(offered)
        self._rows.clear()
        robots: GridLayout = self.ids.robots
        worlds: GridLayout = self.ids.worlds
        robots.clear_widgets()
        worlds.clear_widgets()
        for robot in offered.robots:
            row = self._add(robots, "robot", robot.name, robot_icon(robot.icon), tr(robot.title))
            row.detail = tr(robot.description)
            row.bind(on_release=lambda _, name=robot.name: self.tap(name))
        for world in offered.worlds:
            row = self._add(worlds, "world", world.name, WORLD, tr(world.title))
            row.bind(on_release=lambda _, name=world.name: self.move(name))
        self.offered = offered
        self._tell()

    def _add(self, grid: GridLayout, what: str, name: str, icon: str, title: str) -> ListRow:
        row = self._rows[what, name] = ListRow(icon=icon, title=title, whole=True, size_hint_y=1)
        mark = Icon(name="check_circle", role="accent", font_size="18sp", pos_hint={"center_y": 0.5})
        row.bind(chosen=lambda _, chosen: setattr(mark, "opacity", int(chosen)))
        mark.opacity = 0
        row.add_widget(mark)
        row.ids.words.bind(height=lambda *_: self._fit(what))
        grid.add_widget(row)
        return row

    def _fit(self, what: str) -> None:
        """Make all rows as high as the one with most words."""
        heights = [row.ids.words.height for (kind, _), row in self._rows.items() if kind == what]
        setattr(self, f"{what}_height", max(heights) + dp(18))

    def row(self, what: str, name: str) -> ListRow:
        """What stands for the `robot` or the `world` of that name."""
        return self._rows[what, name]

    def tap(self, robot: str) -> None:
        """Switch a robot on or off."""
        self.choice = self.choice.tapped(robot, self.offered)
        self._tell()

    def move(self, world: str) -> None:
        """Have them in another world."""
        self.choice = self.choice.moved(world, self.offered)
        self._tell()

    def answer(self) -> None:
        """Start what is chosen."""
        if self.offered is not None:
            self.close()
            self._on_answer(self.choice)

    def _tell(self, *_: object) -> None:
        count = len(self.choice.robots)
        self.action = (
            tr("Start {count} robots").format(count=count) if count > 1 and self.offered else tr("Start")
        )
        if self.problem or self.offered is None:
            self.sentence = self.problem or tr(ASKING)
            return
        ends = tr(" The one that runs now ends.") if self.running else ""
        self.sentence = tr("One robot, or several that meet in one world.{ends}").format(ends=ends)
        fitting = {world.name for world in self.offered.fitting(self.choice.robots)}
        for world in self.offered.worlds:
            row = self.row("world", world.name)
            row.disabled = row.faded = world.name not in fitting
            row.detail = tr("Not for the robots that are chosen.") if row.disabled else world.description
        for (what, name), row in self._rows.items():
            row.chosen = name in self.choice.robots if what == "robot" else name == self.choice.world
            row.role = "accent" if row.chosen else "muted"
