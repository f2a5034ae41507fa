"""Which events make a sound, how loud, and the way to talk-back."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

from kivy.uix.widget import Widget

from app.screens.setup.panes.settings_pane import SettingsPane, switch_row
from app.sounds.sounds import SOUNDS
from widgets.core.language import tr
from widgets.parts.kit import ListRow, QuietButton, Stepper

__all__ = ["SoundsPane"]


class SoundsPane(SettingsPane):
    """A switch each, the volume, and a button to try it."""

    def fill(self) -> Iterable[Widget]:
        """From the switches to talk-back."""
        sounds = self.app.sounds
        self.switches = {
            name: switch_row(
                "notifications",
                tr(words),
                "",
                on=sounds.on[name],
                take=partial(sounds.choose, name),
            )
            for name, words in SOUNDS.items()
        }
        yield self.heading(tr("A sound when"))
        yield from self.switches.values()
        row = ListRow(icon="volume_up", title=tr("Volume"))
        self.volume = Stepper(value=round(sounds.volume * 100), step=10, maximum=100, unit="%")
        self.volume.pos_hint = {"center_y": 0.5}
        self.volume.bind(on_change=lambda _, value: sounds.set_volume(value / 100))
        row.add_widget(self.volume)
        yield row
        self.try_it = QuietButton(text=tr("Try it"), icon="play_arrow", size_hint_y=None, height="52dp")
        self.try_it.bind(on_release=lambda _: self._try())
        yield self.try_it
        self.told = self.remark("")
        yield self.told
        yield self.heading(tr("Talk-back"))
        yield self.remark(tr("Says aloud what was asked for, what the robot made of it, and alarms."))
        self.talk = QuietButton(text=tr("Set up talk-back"), icon="mic", size_hint_y=None, height="52dp")
        self.talk.bind(on_release=lambda _: self._to_voice())
        yield self.talk

    def _try(self) -> None:
        self.app.sounds.play("alarm")
        self.told.text = tr("This device makes no sound.") if self.app.sounds.silent else ""

    def _to_voice(self) -> None:
        self.app.show_inputs("voice")
