"""The profile of each robot: one of the operator's own that was chosen for it, or the built-in layout of its model or kind."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from app.core.settings_store import Settings
from app.layout.layout import Layout, LayoutError, LayoutFault
from app.layout.layout_choice import LayoutChoice
from app.profiles.profile_store import ProfileStore
from bridge.msgs.pilothouse_msgs import RobotInfo
from widgets.core.language import tr

__all__ = ["ProfileChoice"]

SETTING = "profiles"
"""Setting with the chosen profile of each robot, by its name or else its kind."""
NOTHING = Layout("", "", ())
"""Whose drive screen is none."""
MAX_ROBOTS = 200
"""Of whose choice is remembered; of more the oldest are forgotten."""


class ProfileChoice:
    """Every profile there is. Everything here happens in the UI thread."""

    def __init__(self, built_in: LayoutChoice, store: ProfileStore, settings: Settings) -> None:
        """`store` keeps the operator's own."""
        self.store = store
        self._built_in, self._settings = built_in, settings
        self._read: dict[str, Layout | LayoutError] = {}
        self.on_change: Callable[[], object] = lambda: None
        """Called after another profile was chosen for a robot, or one was changed."""
        self.faults: tuple[LayoutFault, ...] = ()
        """All that is wrong with the profile that was asked for last; empty where it is shown."""

    @property
    def mistake(self) -> str:
        """Why the profile that was asked for last is not shown, in one sentence; empty where it is."""
        if self.faults:
            more = len(self.faults) - 1
            others = tr(" {more} more: see Panels.").format(more=more) if more else ""
            return f"{self.faults[0].sentence}{others}"
        return self._built_in.mistake

    def of(self, info: RobotInfo) -> Layout:
        """The profile of that robot; the built-in one where its own is wrong, which are `faults` then.

        One that says nothing of the drive screen has the built-in one's: else driving had neither stick nor buttons.
        """
        self.faults = ()
        name = self.chosen(info)
        if name:
            try:
                own = self._own(name)
                return own if own.drives else own.with_drive_of(self.built_in(info))
            except LayoutError as error:
                self.faults = error.faults
        return self.built_in(info)

    def built_in(self, info: RobotInfo) -> Layout:
        """The layout that the app brings for that robot."""
        return self._built_in.of(info.model, info.kind)

    def chosen(self, info: RobotInfo) -> str:
        """Name of the operator's own profile that is chosen for that robot; empty for the built-in one."""
        chosen = self._choices().get(_key(info))
        return chosen if isinstance(chosen, str) and re.fullmatch(r"[a-z0-9_-]{1,60}", chosen) else ""

    def choose(self, info: RobotInfo, name: str) -> None:
        """Show the operator's own profile of that name for that robot from now on; empty for the built-in one."""
        choices = {key: value for key, value in self._choices().items() if key != _key(info)}
        if name:
            choices[_key(info)] = name
        self._settings.set(SETTING, dict(list(choices.items())[-MAX_ROBOTS:]))
        self.on_change()

    def save(self, info: RobotInfo, layout: Layout) -> Layout:
        """Keep a changed profile and choose it for that robot, under a name of its own where it was built in; as it is kept.

        OSError where it cannot be written.
        """
        name = self.chosen(info) or self.store.unused(layout.name)
        kept = replace(layout, name=name)
        lent = kept.with_drive_of(self.built_in(info)) == kept and self._lends(name)
        written = kept.with_drive_of(NOTHING) if lent else kept
        self.store.save(written)
        self._read[name] = written
        self.choose(info, name)
        return kept

    def _lends(self, name: str) -> bool:
        """Its file says nothing of the drive screen, and shall not begin to: what the app brings may be another one day."""
        try:
            return not self._own(name).drives
        except LayoutError:
            return False

    def adopt(self, info: RobotInfo, layout: Layout) -> Layout:
        """Keep a profile that came from elsewhere under a name that is not taken, and choose it for that robot; as it is kept.

        OSError where it cannot be written.
        """
        kept = replace(layout, name=self.store.unused(layout.title), robots=())
        self.store.save(kept)
        self._read[kept.name] = kept
        self.choose(info, kept.name)
        return kept

    def forget(self, name: str) -> None:
        """Read the file of that name anew when it is next asked for."""
        self._read.pop(name, None)

    def _choices(self) -> dict[str, object]:
        choices = self._settings.get(SETTING)
        return choices if isinstance(choices, dict) else {}

    def _own(self, name: str) -> Layout:
        if name not in self._read:
            try:
                self._read[name] = self.store.load(name)
            except LayoutError as error:
                self._read[name] = error
        found = self._read[name]
        if isinstance(found, LayoutError):
            raise found
        return found


def _key(info: RobotInfo) -> str:
    return info.name or info.kind
