"""Controls of a view: the drive screen's own path from a finger to the robot, and who of them may drive at all just now."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from app.layout.layout_tables import SLIDER, Control, Layout
from app.layout.view_checks import is_control
from app.layout.views import Panel
from app.link.feeds import Post
from app.screens.drive.drive_blocked import DriveBlocked
from app.screens.drive.drive_controls import DriveControls
from app.screens.shell.screen_host import ScreenHost
from app.session.dashboard import Dashboard
from app.session.layout_actions import LayoutActions
from app.session.session import Session
from widgets.controls.sticks.stick import Stick

__all__ = ["PanelControls"]


class Asked:
    """One action of a view, as `LayoutActions` reads it."""

    def __init__(self, what: str) -> None:
        self.what, self.text, self.icon = what, "", ""


class PanelControls:
    """Made anew for every view, and for every change of one. A control that is not in sight lets go and drives nothing."""

    def __init__(
        self,
        panels: Sequence[Panel | None],
        session: Session,
        app: ScreenHost,
        seen: Callable[[Any], bool],
    ) -> None:
        """`panels` by their index in the view, None for one that is hidden; `seen` says of a widget whether it is on the glass, in sight and not edited."""
        self._seen = seen
        self._dashboard = Dashboard(session.feeds)
        self.in_vain = DriveBlocked(session, app)
        controls = [
            (index, _control(index, panel, session))
            for index, panel in enumerate(panels)
            if panel is not None and is_control(panel.widget)
        ]
        actions = LayoutActions([Asked(one.action) for _, one in controls if one.action], session, app)
        layout = Layout("view", "view", (), controls=tuple(one for _, one in controls))
        self._hands = DriveControls(layout, session, self._dashboard, actions, self.in_vain)
        self.widgets: dict[int, Any] = {index: self._hands.places[one.slot][0] for index, one in controls}
        """By the index of the panel in the view."""

    @property
    def sticks(self) -> list[tuple[Stick, str]]:
        """What drives and is in sight, each with the stick of a gamepad that pushes it too."""
        return [(stick, pad) for stick, pad in self._hands.sticks if self._seen(stick)]

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold besides and is in sight."""
        return [grip for grip in self._hands.grips if self._seen(grip)]

    def enter(self) -> None:
        """Come onto the glass."""
        self._hands.take_limits()
        self._dashboard.enter()
        self.tick()

    def leave(self) -> None:
        """Leave the glass: everything lets go."""
        self.rest()
        self._dashboard.leave()

    def rest(self) -> None:
        """Every control lets go."""
        self._hands.rest()

    def rest_unseen(self) -> None:
        """Every control that is not in sight lets go."""
        for widget in self.widgets.values():
            if not self._seen(widget) and hasattr(widget, "rest"):
                widget.rest()

    def on_post(self, channel: str, post: Post) -> None:
        """A message came."""
        self._dashboard.deliver(channel, post.value)
        self._hands.on_post(channel, post)

    def tick(self) -> None:
        """Bring up to date what may be used."""
        if not self.widgets:
            return
        self.rest_unseen()
        self._dashboard.tick()
        self.in_vain.tick()
        self._hands.tick()


def _control(index: int, panel: Panel, session: Session) -> Control:
    """The panel as a drive screen would have it, in a place of its own."""
    topics = [name for name in panel.topics if name in session.feeds]
    return Control(
        slot=f"panel {index}",
        widget=panel.widget,
        title=panel.title if panel.widget != SLIDER else "",
        topic=topics[0] if topics else "",
        forward=panel.forward,
        left=panel.left,
        pad=panel.pad,
        action=panel.action,
        icon=panel.icon,
        also=tuple(topics[1:]),
    )
