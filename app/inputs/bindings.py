"""Bindings of keys and gamepads as the user has set them up: read from the settings, checked, and kept there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from app.core.checked_settings import CheckedSettings, shown
from app.inputs.binding_actions import MEANINGS
from app.inputs.gamepad import pad_map
from app.inputs.gamepad.pad_map import Profile
from app.inputs.keys import key_table
from app.inputs.keys.key_table import KeyTable
from widgets.core.language import mark, tr

__all__ = ["Bindings"]


class _Settings(Protocol):
    def get(self, name: str, default: Any = None) -> Any: ...

    def set(self, name: str, value: Any) -> None: ...


class Bindings:
    """The table of the keys, and a profile for each gamepad by its name."""

    def __init__(self, settings: _Settings) -> None:
        """What is wrong in the settings is said in `problems` and is as it was at first."""
        self._settings = settings
        self.problems: list[str] = []
        self.keys, wrong = key_table.read(settings.get("keys"), MEANINGS)
        self.problems += wrong
        kept = CheckedSettings(settings.get(mark("gamepads", "settings")), mark("gamepads", "settings"))
        self.pads_on = kept.flag("on", usual=True)
        """Gamepads drive and their buttons mean something; STOP does all the same."""
        found = kept.values.get("profiles", {})
        self._kept: dict[str, Any] = dict(found) if isinstance(found, Mapping) else {}
        if not isinstance(found, Mapping):
            kept.mistaken("profiles", "a table")
        self.problems += [kept.sentence] if kept.sentence else []
        self._profiles: dict[str, Profile] = {}
        wired = settings.get("wired_gamepads")
        self.wired = [name for name in wired if isinstance(name, str)] if isinstance(wired, list) else []
        """Names of gamepads that hang on a cable and may be held still."""
        if wired is not None and self.wired != wired:
            self.problems.append(
                tr("Gamepads on a cable are a list of names, not {wired}.").format(wired=shown(wired))
            )

    def profile(self, name: str) -> Profile:
        """That of the gamepads of that name; one that nobody has changed is as they all are at first."""
        if name not in self._profiles:
            self._profiles[name], wrong = pad_map.read(self._kept.get(name), MEANINGS)
            self.problems += wrong
        return self._profiles[name]

    def changed(self, name: str) -> bool:
        """The user has changed something about the gamepads of that name."""
        return name in self._kept

    def set_profile(self, name: str, profile: Profile) -> None:
        """Keep another one."""
        self._profiles[name] = profile
        self._kept[name] = profile.kept()
        self._keep_pads()

    def reset_profile(self, name: str) -> None:
        """As it was at first."""
        self._profiles.pop(name, None)
        if self._kept.pop(name, None) is not None:
            self._keep_pads()

    def use_pads(self, on: bool) -> None:
        """Let gamepads drive, or not."""
        self.pads_on = on
        self._keep_pads()

    @property
    def profiles_kept(self) -> dict[str, Any]:
        """What was changed, by the gamepad's name, as JSON."""
        return dict(self._kept)

    def set_keys(self, table: KeyTable) -> None:
        """Keep another table of keys."""
        self.keys = table
        self._settings.set("keys", table.kept())

    def _keep_pads(self) -> None:
        self._settings.set("gamepads", {"on": self.pads_on, "profiles": dict(self._kept)})
