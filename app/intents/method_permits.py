"""Permissions of each input method, set by the operator, kept in the settings and checked when they are read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from widgets.core.language import tr

__all__ = ["ALWAYS", "FORBIDDEN", "SAYS", "Kept", "MethodPermits"]

ALWAYS = ("stop", "no")
"""Never to be forbidden to a method that can say it."""
LOOKS = ("screen.drive", "screen.mission", "screen.tasks", "screen.inputs", "theme", "help", "back")
"""What only changes the glass."""
TASKS = ("pause", "resume", "start", "patrol", "go_home", "end_task", "hold", "surface", "take_off", "land")
REST = ("faster", "slower", "lights", "snapshot", "record", "camera", "take_control", "yes", "no")
SPOKEN = ("stop", *TASKS, *REST)
SENTENCES = ("lights_on", "lights_off", "dock", "tell_battery", "tell_task")
"""What only a sentence says."""

SAYS: dict[str, tuple[str, ...]] = {
    "voice": (*SPOKEN, *SENTENCES),
    "shake": SPOKEN,
    "tilt": (),
    "switches": (*SPOKEN, *LOOKS),
    "gamepad": (*SPOKEN, *LOOKS),
    "keyboard": (*SPOKEN, *LOOKS),
}
"""What each method can say at all; a finger on a button or on the map is always allowed what it presses."""
FORBIDDEN: dict[str, tuple[str, ...]] = {
    "shake": ("start", "patrol", "take_off", "faster", "take_control"),
    "voice": ("take_off",),
}
"""What a method may not do until the operator allows it: a jolt and a word in passing set nothing in motion by mistake."""


class Kept(Protocol):
    """What is needed of the settings."""

    def get(self, name: str, default: Any = None) -> Any:
        """The value of `name`, or `default`."""

    def set(self, name: str, value: Any) -> None:
        """Remember a JSON value."""


class MethodPermits:
    """The table of methods and intents, with what the operator changed in it."""

    def __init__(self, settings: Kept) -> None:
        """What is kept under `intents` is `{method: {intent: true or false}}`, where it differs from what is usual."""
        self._settings = settings
        self.problem = ""
        """One sentence about what was kept and means nothing; empty when all is well."""
        self._changed = self._read(settings.get("intents"))

    def says(self, method: str, intent: str) -> bool:
        """The method can say that at all."""
        return intent in SAYS[method] if method in SAYS else True

    def fixed(self, method: str, intent: str) -> bool:
        """It stands as it is: it cannot be said, or must not be forbidden."""
        return not self.says(method, intent) or intent in ALWAYS or method not in SAYS

    def allowed(self, method: str, intent: str) -> bool:
        """The method may do that."""
        if self.fixed(method, intent):
            return self.says(method, intent)
        usual = intent not in FORBIDDEN.get(method, ())
        return self._changed.get(method, {}).get(intent, usual)

    def allow(self, method: str, intent: str, allowed: bool) -> None:
        """Allow it, or forbid it; ValueError where it stands as it is."""
        if self.fixed(method, intent):
            raise ValueError(
                tr("Whether {method} may do {intent!r} cannot be changed.").format(
                    method=method, intent=intent
                )
            )
        changed = {name: dict(row) for name, row in self._changed.items()}
        changed.setdefault(method, {})[intent] = allowed
        self._keep(changed)

    def reset(self, method: str) -> None:
        """What that method may do is as usual again; the others stay as they were set."""
        self._keep({name: row for name, row in self._changed.items() if name != method})

    def usual(self, method: str) -> bool:
        """Nothing was changed of what that method may do."""
        forbidden = FORBIDDEN.get(method, ())
        return all(
            allowed == (intent not in forbidden) for intent, allowed in self._changed.get(method, {}).items()
        )

    def _keep(self, changed: dict[str, dict[str, bool]]) -> None:
        self._changed = changed
        self._settings.set("intents", changed)

    def _read(self, kept: object) -> dict[str, dict[str, bool]]:
        """What makes sense of what was kept."""
        if kept is None:
            return {}
        found: dict[str, dict[str, bool]] = {}
        void = not isinstance(kept, Mapping)
        for method, row in kept.items() if isinstance(kept, Mapping) else ():
            if method not in SAYS or not isinstance(row, Mapping):
                void = True
                continue
            right = {
                intent: allowed
                for intent, allowed in row.items()
                if isinstance(allowed, bool) and not self.fixed(method, intent)
            }
            void = void or len(right) < len(row)
            found[method] = right
        if void:
            self.problem = tr(
                "The stored permissions could not be read in part; that part is reset to default."
            )
        return found
