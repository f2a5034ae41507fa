"""The study that is led just now: its prompts, its forms, and the place where it was left."""

from __future__ import annotations

from collections.abc import Callable

from app.intents.intents import INTENTS, Heard
from app.study.response_timing import Asked, ResponseTracks
from app.study.study import Plan, Prompt, Trials, saved
from app.study.study_settings import StudySettings

__all__ = ["StudyRun"]


class StudyRun:
    """Of one app. Everything in the UI thread."""

    def __init__(self, tracks: ResponseTracks, settings: StudySettings, now: Callable[[], float]) -> None:
        """Goes on with the study that was left in the middle, if there is one; `now` is our clock [s]."""
        self._tracks, self._settings, self._now = tracks, settings, now
        self.trials: Trials | None = None
        """Those that are led just now, or were left in the middle; None for none."""
        if settings.left is not None:
            plan, block, trial = settings.left
            self._follow(Trials(plan, now=now, block=block, trial=trial))

    def lead(self, plan: Plan) -> Trials:
        """Begin a study."""
        trials = self._follow(Trials(plan, now=self._now))
        self._keep()
        return trials

    def _follow(self, trials: Trials) -> Trials:
        self.trials = trials
        trials.on_missed = lambda prompt: self._tracks.missed(_of(prompt))
        trials.on_moved = self._keep
        return trials

    def end(self) -> None:
        """Leave the study; what was answered stays in the log."""
        self.trials = None
        self._settings.keep("plan", None)

    def _keep(self) -> None:
        done = self.trials is None or self.trials.stage == "done"
        self._settings.keep("plan", None if done or self.trials is None else saved(self.trials))

    def update(self, now: float) -> None:
        """Each tick [s]."""
        if self.trials is not None:
            self.trials.update(now)

    def pause(self) -> None:
        """Wait until prompts are wanted again."""
        if self.trials is not None:
            self.trials.pause()

    def on_command(self, intent: str, method: str) -> None:
        """A command was given: it may answer the prompt."""
        if self.trials is not None:
            self.trials.on_command(intent, method)

    def practise(self, heard: Heard, *, can_stop: bool) -> str:
        """While prompts are shown nothing is done but STOP, where something `can_stop`: the sentence that says so; else empty."""
        if self.trials is None or not self.trials.running or heard.intent in ("yes", "no"):
            return ""
        if heard.intent == "stop" and can_stop:
            return ""
        return f"Understood: {INTENTS[heard.intent].words}. Nothing is done."

    def asked(self) -> Asked:
        """What is prompted just now."""
        trials = self.trials
        if trials is None or not trials.running:
            return Asked()
        block, prompt = trials.now_block, trials.prompt
        if prompt is None:
            return Asked(trials.plan.user, block.posture, block.method)
        return _of(prompt)

    def about(self, task: str) -> dict[str, str]:
        """What a form that is filled in now is about: the study where it asks for one, else `task`."""
        trials = self.trials
        if trials is None or trials.stage not in ("tlx", "sus"):
            return {"task": task}
        about = {"user": trials.plan.user, "task": "prompts"}
        block = trials.now_block
        return about | ({"method": block.method, "posture": block.posture} if trials.stage == "tlx" else {})


def _of(prompt: Prompt) -> Asked:
    return Asked(prompt.user, prompt.posture, prompt.method, prompt.id, prompt.intent, prompt.at)
