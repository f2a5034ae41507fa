"""The missions that the robot keeps under names: listing them, recalling one, saving the points on the map as one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from app.link.commands import Outcome
from app.missions.mission_editor import Draft, MissionEditor
from bridge.msgs.pilothouse_msgs import KeptMission
from widgets.core.language import tr

__all__ = ["MAX_NAME_LENGTH", "StoredMissions", "Robot"]

MAX_NAME_LENGTH = 60
"""Characters of a mission's name; the robot keeps no more."""


def nobody(*_: object) -> None:
    """Listens to what is told."""


class Robot(Protocol):
    """What is needed of the session."""

    mission: MissionEditor

    def command(self, name: str, /, **fields: Any) -> None:
        """Send a one-shot command of `app.link.commands.COMMANDS`."""

    def send_mission(self) -> None:
        """Send the draft to the robot."""


class StoredMissions:
    """Asks the robot and keeps what brings back the mission that was there before."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self.kept: list[KeptMission] = []
        """In the order of the alphabet; empty before the first answer."""
        self.known = False
        """The robot has said which there are."""
        self.on_change: Callable[[], object] = nobody
        """Called when there are others."""
        self.on_recalled: Callable[[str, Callable[[], None]], object] = nobody
        """Called with a sentence and how to take it back, once a recall is confirmed."""
        self._before: tuple[Draft, Draft | None] | None = None

    # what is asked

    def ask(self) -> None:
        """Ask which there are."""
        self._robot.command("missions")

    def recall(self, name: str) -> None:
        """Make a kept mission the robot's, and the one on the map."""
        editor = self._robot.mission
        self._before = editor.draft, editor.stored
        editor.recalling()
        self._robot.command("recall", name=name)

    def save(self, name: str) -> None:
        """Send the points on the map to the robot, to be kept under a name."""
        self._robot.mission.set_name(name.strip()[:MAX_NAME_LENGTH])
        self._robot.send_mission()

    def lacking(self, name: str) -> str:
        """What is missing before the points on the map can be kept under a name, as a sentence; empty when nothing."""
        if not self._robot.mission.draft.points:
            return tr("There are no points on the map to save; set some on the mission screen.")
        return "" if name.strip() else tr("Enter a name.")

    # what comes in

    def answered(self, outcome: Outcome) -> None:
        """Take in what became of a command."""
        if outcome.phase == "sent":
            return
        accepted = outcome.phase == "accepted"
        if outcome.name == "missions" and accepted:
            self.kept, self.known = list(outcome.answer.missions), True
            self.on_change()
        elif outcome.name == "recall":
            self._recalled(outcome, accepted)
        elif outcome.name == "mission" and accepted and self.known:
            self.ask()

    def dropped(self) -> None:
        """The link is another one now: what was under way has no answer."""
        self._before = None
        self._robot.mission.recalled(False)

    def deaf(self) -> None:
        """Nobody listens any more: the screens are left."""
        self.on_change = self.on_recalled = nobody

    def _recalled(self, outcome: Outcome, accepted: bool) -> None:
        self._robot.mission.recalled(accepted)
        before, self._before = self._before, None
        if not accepted or before is None:
            return
        self.on_recalled(
            outcome.reason or tr("{fields} is the mission now.").format(fields=outcome.fields["name"]),
            lambda: self._undo(*before),
        )
        self.ask()

    def _undo(self, draft: Draft, stored: Draft | None) -> None:
        """Give the robot back what it had, and the map what was on it."""
        if stored is not None:
            self._robot.command("mission", mission=stored.message())
        self._robot.mission.put(draft)
