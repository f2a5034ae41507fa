"""Unsent missions, remembered on this handheld for each robot by its name."""

from __future__ import annotations

from typing import Any, Protocol

from app.core.settings_store import Settings
from app.missions.mission_editor import MissionEditor
from bridge.msgs.pilothouse_msgs import Mission

__all__ = ["MissionDrafts"]


class NamedRobot(Protocol):
    """The robot that the missions are for."""

    @property
    def name(self) -> str:
        """Its name, or its address while the name is not known."""


class MissionDrafts:
    """The mission being edited for one robot, and its copy in the settings."""

    def __init__(self, settings: Settings, robot: NamedRobot) -> None:
        self._settings, self._robot = settings, robot
        self.editor = MissionEditor(on_change=self._save)
        self._restored = False
        """The robot's name is known, and a draft of an earlier day is back in the editor."""
        self._pending: Mission | None = None
        """The robot's mission, received before its name."""

    def deaf(self) -> None:
        """Nobody listens any more but these: the screens are left."""
        self.editor.on_change = self._save

    def on_introduced(self) -> None:
        """The robot's name came: restore its draft once, before its mission is compared with it.

        What was entered before the name was known stays, with the restored draft one step of undo behind it.
        """
        if not self._restored:
            self._restored = True
            entered = self.editor.draft if self.editor.can_undo else None
            restored = self.editor.load(self._drafts().get(self._robot.name))
            if entered is not None and restored:
                self.editor.put(entered)
            elif entered is not None:
                self._save()
            self._compare()

    def on_mission(self, mission: Mission) -> None:
        """The robot's own mission came."""
        self._pending = mission
        self._compare()

    def _compare(self) -> None:
        if self._restored and self._pending is not None:
            self.editor.robot_has(self._pending)
            self._pending = None

    def _drafts(self) -> dict[str, Any]:
        drafts = self._settings.get("drafts", {})
        return drafts if isinstance(drafts, dict) else {}

    def _save(self) -> None:
        if not self._restored:
            return
        name = self._robot.name
        drafts = {robot: draft for robot, draft in self._drafts().items() if robot != name}
        if self.editor.dirty:
            drafts[name] = self.editor.save()
        self._settings.set("drafts", drafts)
