"""Settings of the tilt as a pane changes them: what is chosen is kept at once, and the clutch opens."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

from app.core.checked_settings import CheckedSettings, number
from app.device.motion import Axes
from app.inputs.base.toggleable_method import ToggleableMethod
from app.inputs.motion.motion_app import MotionApp
from app.inputs.motion.tilt import Tilt, TiltSettings
from widgets.core.language import tr

__all__ = ["TiltOptions"]

NAMES = frozenset(field.name for field in fields(TiltSettings))


class TiltOptions(ToggleableMethod):
    """Part of the method `tilt`."""

    name = "tilt"
    _app: MotionApp

    def __init__(self, app: MotionApp) -> None:
        """`app` is asked for its `settings`."""
        self._app = app
        read = CheckedSettings(app.settings.get("tilt"), tr("the tilt"))
        kept = read.values
        self._on = read.flag("on", usual=False)
        self.others = read.flag("others", usual=True)
        """Robots that are driven by sticks alone can be driven by it as well."""
        settings, self.faults = TiltSettings.of({name: kept[name] for name in kept if name in NAMES})
        """What was kept and is no good, as sentences."""
        self.tilt = Tilt(settings)
        self.tilt.neutral = _axes(kept.get("neutral"))
        if kept.get("neutral") is not None and self.tilt.neutral is None:
            read.mistaken("neutral", tr("three numbers"))
        self.faults += [read.sentence] if read.sentence else []

    def let_go(self) -> None:
        """Zero now; whoever holds the clutch has to let go and press anew."""
        raise NotImplementedError

    @property
    def settings(self) -> TiltSettings:
        """What the operator has chosen."""
        return self.tilt.settings

    def change(self, **values: Any) -> None:
        """Choose something else, as in `full=20.0`; the clutch opens. ValueError for what is not allowed."""
        fresh, faults = TiltSettings.of(replace(self.settings, **values).save())
        if faults:
            raise ValueError(" ".join(faults))
        self.let_go()
        self.tilt.settings = fresh
        self._keep()

    def change_others(self, others: bool) -> None:
        """Whether it may drive what has sticks alone."""
        self.others = others
        self._keep()

    def set_neutral(self, *, fixed: bool) -> bool:
        """Neutral is how the tablet is held now, or again wherever the clutch closes; False where that is not known."""
        up = self.tilt.up if fixed else None
        if fixed and up is None:
            return False
        self.let_go()
        self.tilt.neutral = up
        self._keep()
        return True

    def _kept(self) -> dict[str, Any]:
        more = {
            "on": self._on,
            "others": self.others,
            "neutral": self.tilt.neutral and list(self.tilt.neutral),
        }
        return self.settings.save() | more


def _axes(kept: object) -> Axes | None:
    """Three finite numbers that are no zeros, or None."""
    if not isinstance(kept, list) or len(kept) != 3:
        return None
    x, y, z = (number(one, -1e3, 1e3) for one in kept)
    if x is None or y is None or z is None:
        return None
    return (x, y, z) if any((x, y, z)) else None
