"""Buttons of an arm's panel: one for each named pose, and one for its gripper."""

from __future__ import annotations

import math
from typing import Any

from kivy.clock import Clock
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, ListProperty, NumericProperty, StringProperty

from bridge.msgs.pilothouse_msgs import ArmOrder
from widgets.controls.finger_grip import Grip
from widgets.core.language import tr
from widgets.core.theme import theme
from widgets.parts.buttons import QuietButton
from widgets.parts.sensor_card import Gauge, wide

__all__ = ["CHOICE_TIMEOUT", "ArmKeys", "PoseKey", "pose_words"]

CHOICE_TIMEOUT = 8.0
"""How long the poses stay open without a finger [s]."""
HIGH = 76
"""A key of this height has room for a tick above two lines [dp]."""
WIDE = 1.25
"""From this share of its height on the buttons stand beside the picture."""


class PoseKey(QuietButton):
    """One of the panel's buttons."""

    name = StringProperty("")
    """Of the pose; empty for what is none."""


class ArmKeys(Grip, Gauge):
    """Its buttons, below what it shows or beside it, or where it is small one that opens the poses over that."""

    gripper = NumericProperty(math.nan)
    """Opening between the fingers [m]; NaN when not known."""
    pose = StringProperty("")
    """The named pose that it is in; empty for any other."""
    poses: ListProperty[str] = ListProperty()
    """Those that have names."""
    open_width = NumericProperty(0.075)
    """Opening of the gripper when it is wide open [m]."""
    choosing = BooleanProperty(False)
    """The poses are open over the picture."""
    page: NumericProperty[int] = NumericProperty(0)
    """Which of the poses are shown where there is no room for all."""

    def _beside(self) -> bool:
        return bool(self.width >= WIDE * self.height and self.width >= dp(300))

    beside = AliasProperty(_beside, bind=["size"], cache=True)
    """There is room for the poses beside the picture."""

    @property
    def stacked(self) -> bool:
        """There is room for two buttons beside the picture, one above the other."""
        high = 2 * theme.target + dp(8)
        return bool(not self.beside and self.width >= dp(240) and self.inside[3] >= high > self.inside[3] / 2)

    def __init__(self, **kwargs: Any) -> None:
        self._keys: list[PoseKey] = []
        self._close = Clock.create_trigger(lambda _: self.rest(), CHOICE_TIMEOUT)
        self.arrange = Clock.create_trigger(self._arrange, -1)
        super().__init__(**kwargs)
        self.chooser = PoseKey(text=tr("Poses"), icon="precision_manufacturing", size_hint=(None, None))
        self.chooser.bind(on_release=lambda _: self.choose())
        self.grip = PoseKey(size_hint=(None, None))
        self.grip.bind(on_release=lambda _: self.press_gripper())
        for name in ("pos", "size", "poses", "pose", "choosing", "page", "card"):
            self.fbind(name, self.arrange)
        self.fbind("gripper", self._label_gripper)
        theme.bind(target=self._on_target)
        self._arrange()

    def _on_target(self, *_: object) -> None:
        self.arrange()

    @property
    def opens(self) -> bool:
        """The gripper's button opens it, and does not close it."""
        return not self.gripper > self.open_width / 2

    def press(self, pose: str) -> None:
        """Go to a pose as a finger would say it."""
        self.choosing = False
        self.dispatch("on_command", ArmOrder(pose=pose))

    def press_gripper(self) -> None:
        """Open or close the gripper as a finger would."""
        self.dispatch("on_command", ArmOrder(gripper=self.open_width if self.opens else 0.0))

    def choose(self) -> None:
        """Open the poses over the picture; they close by themselves after a while."""
        self.choosing, self.page = True, 0
        self._close()

    def turn_page(self) -> None:
        """Show the next of the poses; after the last ones the first again."""
        self.page += 1
        self._close.cancel()
        self._close()

    def rest(self) -> None:
        """Let the finger go, and close the poses; the arm goes on."""
        super().rest()
        self._close.cancel()
        self.choosing = False

    # where they are

    @property
    def inside(self) -> tuple[float, float, float, float]:
        """Left, low, width and height of what is below the header [px]."""
        edge = self.edge
        return self.x + edge, self.y + edge, self.width - 2 * edge, self.height - 2 * edge - sp(12) - dp(6)

    def _keys_wide(self, width: float) -> float:
        if self.stacked:
            return float(max(theme.target, dp(96)))
        return float(max(width * 0.48, min(2 * theme.target + dp(8), width * 0.6)))

    def _arrange(self, *_: object) -> None:
        """Put the buttons where they belong."""
        for child in self.children[:]:
            self.remove_widget(child)
        left, low, width, height = self.inside
        if self.width < dp(120) or height < theme.target:
            return
        self._label_gripper()
        gap = dp(8)
        if self.beside:
            keys = self._keys_wide(width)
            x = left + width - keys
            rows = self._rows(height - theme.target - gap)
            self._put_poses((x, low, keys, height), rows + 1, rows)
            high = (height - rows * gap) / (rows + 1) if self.poses else theme.target
            self._put(self.grip, (x, low, keys, high))
        elif self.choosing:
            rows = self._rows(height)
            self._put_poses((left, low, width, height), rows, rows)
        elif self.stacked:
            keys, half = self._keys_wide(width), (height - gap) / 2
            self.chooser.disabled = not self.poses
            self._put(self.chooser, (left + width - keys, low + half + gap, keys, half))
            self._put(self.grip, (left + width - keys, low, keys, half))
        else:
            half = (width - gap) / 2
            self.chooser.disabled = not self.poses
            self._put(self.chooser, (left, low, half, theme.target))
            self._put(self.grip, (left + half + gap, low, half, theme.target))

    def _rows(self, high: float) -> int:
        """Rows of two poses each that have room in `high` [px]: as many as there are poses for, one at least."""
        fits = max(1, int((high + dp(8)) // (theme.target + dp(8))))
        return min(fits, max(1, math.ceil(len(self.poses) / 2)))

    def _put_poses(self, box: tuple[float, float, float, float], rows: int, own: int) -> None:
        """Keys for the poses in `own` upper rows of `rows`, and one that turns the page where there are more."""
        left, low, width, height = box
        gap, names = dp(8), list(self.poses)
        half, high = (width - gap) / 2, (height - (rows - 1) * gap) / rows
        room = 2 * own
        paged = len(names) > room
        if paged:
            pages = math.ceil(len(names) / (room - 1))
            first = self.page % pages * (room - 1)
            names = names[first : first + room - 1]
            self._put(self._key(room - 1, ""), self._place(left, low, (half, high), rows, room - 1))
        for number, name in enumerate(names):
            alone = number == len(names) - 1 and number % 2 == 0 and not paged
            x, y, wide_, tall = self._place(left, low, (half, high), rows, number)
            self._put(self._key(number, name), (x, y, width if alone else wide_, tall))

    @staticmethod
    def _place(
        left: float, low: float, size: tuple[float, float], rows: int, number: int
    ) -> tuple[float, float, float, float]:
        row, column = divmod(number, 2)
        return left + column * (size[0] + dp(8)), low + (rows - 1 - row) * (size[1] + dp(8)), *size

    def _key(self, number: int, name: str) -> PoseKey:
        """The key of that number, made when it is first needed; without a name it turns the page."""
        while number >= len(self._keys):
            key = PoseKey(size_hint=(None, None))
            key.bind(on_release=self._pressed)
            self._keys.append(key)
        key, here = self._keys[number], bool(name) and name == self.pose
        key.name, key.text = name, pose_words(name) if name else tr("More")
        key.meaning = name or "more"
        key.icon = "check" if here else "" if name else "more_horiz"
        key.ink, key.border = ("accent", "accent") if here else ("text", "line")
        key.rim_width = dp(3) if here else theme.outline
        return key

    def _pressed(self, key: PoseKey) -> None:
        if key.name:
            self.press(key.name)
        else:
            self.turn_page()

    def _put(self, key: PoseKey, box: tuple[float, float, float, float]) -> None:
        key.pos, key.size = box[:2], box[2:]
        key.flow = "horizontal" if key.width >= dp(126) else "vertical"
        if "_" in key.name and wide(key.text, sp(14), bold=True) > key.width - dp(20):
            key.text = key.text.replace(" ", "\n")
            if key.height < dp(HIGH):
                key.icon = ""  # a thick border marks it too, and its words are as large as the others'
        self.add_widget(key)

    def _label_gripper(self, *_: object) -> None:
        """A press does the one or the other, by how wide it is open."""
        word = tr("Open") if self.opens else tr("Close")
        self.grip.text = self.grip.meaning = f"{word} gripper" if self.beside else word
        self.grip.icon = "zoom_out_map" if self.opens else "filter_center_focus"
        self.grip.disabled = math.isnan(self.gripper)


def pose_words(name: str) -> str:
    """A name as people write it."""
    return name.replace("_", " ").capitalize()
