"""Missions that the robot keeps under names: points, motion, revisions, and the time each was stored.

missions = MissionList()
missions.show(await robot.call("/missions/get", GetMissionsRequest(), GetMissionsResponse))
missions.bind(on_command=lambda _, mission: print(mission.name))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import UTC, datetime
from typing import Any

from kivy.properties import ListProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import GetMissionsResponse, KeptMission
from bridge.msgs.std_msgs import Time
from widgets.core.language import mark, tr, trn, within
from widgets.parts.listing import Listing
from widgets.parts.rows import ListRow
from widgets.status.event_row import when_words

__all__ = ["MissionList", "mission_words"]


def mission_words(mission: KeptMission) -> str:
    """How many points, how they are visited, how often it was changed, as in `6 points · loop · 3 revisions`."""
    points = trn("{count} point", "{count} points", mission.points)
    many = mission.revisions
    revisions = trn("{count} revision", "{count} revisions", many) if many > 1 else ""
    return " · ".join(filter(None, (points, within(tr(mission.motion.capitalize())), revisions)))


class MissionList(Listing):
    """Dispatches `on_command(mission)` with the `KeptMission` that was pressed."""

    accepts = (GetMissionsResponse,)
    sends = (KeptMission,)

    missions: ListProperty[KeptMission] = ListProperty()
    """Every `KeptMission`."""
    chosen = StringProperty("")
    """Name of the one that is looked at; empty for none."""
    current = StringProperty("")
    """Name of the one that the robot patrols; empty when that has none."""
    now = NumericProperty(math.nan)
    """The operators' clock [s]; NaN while it is not known."""
    nothing = StringProperty(mark("The robot has no stored missions."))

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        for name in ("missions", "chosen", "current", "nothing"):
            self.fbind(name, self._build)
        self._build()

    def show(self, msg: GetMissionsResponse) -> None:
        """Take over which there are."""
        self.missions = msg.missions

    def _build(self, *_: object) -> None:
        self.fill(self._row(mission) for mission in self.missions)

    def _row(self, mission: KeptMission) -> ListRow:
        current = mission.name == self.current
        stored = mission.stamp.seconds
        row = ListRow(
            icon="check_circle" if current else "route",
            role="ok" if current else "plan",
            title=mission.name,
            detail=(tr("Current mission · {what}") if current else "{what}").format(
                what=mission_words(mission)
            ),
            aside=when_words(stored, self.now) if stored > 0 else "",
            chosen=mission.name == self.chosen,
            whole=True,
        )
        row.bind(on_release=lambda _: self.dispatch("on_command", mission))
        return row


NOON = datetime(2026, 3, 4, 12, 0, tzinfo=UTC).timestamp()
SOME = [
    KeptMission("East wing", Time.at(NOON - 300), 8, "loop", 1),
    KeptMission("Night", Time.at(NOON - 90000), 14, "random", 6),
    KeptMission("Round the house, with the cellar and the yard", Time.at(NOON - 9e6), 1, "intermittent", 20),
]
"""For the samples here and elsewhere."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Some, one of them the mission now and one looked at; none; not to be touched."""

    def make(missions: list[KeptMission] = SOME, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            widget = MissionList(size_hint=(None, None), size=("388dp", "220dp"), now=NOON, **kwargs)
            widget.show(GetMissionsResponse(missions=missions))
            return widget

        return build

    return {
        "some": make(current="Night", chosen="East wing"),
        "none": make([]),
        "disabled": make(state="disabled"),
    }
