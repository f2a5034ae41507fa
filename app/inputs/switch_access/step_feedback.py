"""Feedback for each step of the mark: a tone, a short vibration, its words spoken."""

from __future__ import annotations

from app.device.vibration import STEP, vibrate
from app.inputs.base.method_app import MethodApp
from app.inputs.switch_access.scan.settings import Options
from app.inputs.switch_access.scan.target import Mark
from app.inputs.switch_access.tones import Tones

__all__ = ["StepFeedback"]


class StepFeedback:
    """Of one app, as its options say."""

    def __init__(self, app: MethodApp) -> None:
        """`app` is asked for its `talk`, which one that cannot talk has not."""
        self._app, self._tones = app, Tones()

    def step(self, sound: str, mark: Mark | None, options: Options) -> None:
        """The mark is now `mark`, None for nowhere; `sound` is one of `app.inputs.switch_access.tones.TONES`."""
        if options.tones:
            self._tones.play(sound)
        if options.vibrates:
            vibrate(STEP)
        talk = getattr(self._app, "talk", None)
        if options.spoken and talk is not None and mark is not None:
            talk.say(mark.words)

    def close(self) -> None:
        """Let go of the loudspeaker."""
        self._tones.close()
