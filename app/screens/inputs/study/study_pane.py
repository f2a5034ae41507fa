"""Log and study: what the log says, the study, and the forms; one of the three at a time."""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable
from typing import Any

from kivy.metrics import dp
from kivy.properties import ObjectProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout

from app.core.newest_worker import NewestWorker
from app.device.sharing import sharing
from app.screens.inputs.study.form_view import FormView
from app.screens.inputs.study.load_view import LoadView
from app.screens.inputs.study.log_view import LogView
from app.screens.inputs.study.setup_view import SetupView
from app.screens.inputs.study.trial_view import TrialView
from widgets.parts.kit import Roll, Segmented

__all__ = ["StudyPane"]

log = logging.getLogger(__name__)

PARTS = [("log", "Log"), ("study", "Study"), ("load", "Workload")]


class StudyPane(BoxLayout):
    """Reading and writing files is done by a worker that lives as long as the pane is on the glass."""

    app = ObjectProperty()
    part = StringProperty("log")

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(orientation="vertical", spacing="8dp", **kwargs)
        self._worker: NewestWorker[tuple[Callable[[], Any], Callable[[Any], None]]] | None = None
        self._results: deque[tuple[Callable[[Any], None], Any]] = deque(maxlen=8)
        self._views: dict[str, Any] = {}
        self._stage, self._on = "", False
        self._face: tuple[Any, ...] = ()
        self.choice = Segmented(options=PARTS, value=self.part)
        self.choice.bind(on_choose=lambda _, part: setattr(self, "part", part))
        self.roll = Roll()
        self.add_widget(self.choice)
        self.add_widget(self.roll)
        self.bind(part=self._show)

    @property
    def log(self) -> Any:
        """The app's `ResponseRecording`."""
        return self.app.methods.get("log")

    @property
    def view(self) -> Any:
        """What is shown below the choice; None before it is looked at."""
        return self.roll.children[0] if self.roll.children else None

    def enter(self) -> None:
        """Come onto the glass."""
        self._on = True
        if self._worker is None:
            self._worker = NewestWorker(self._work, "study files")
        if self.log.trials is not None and self.log.trials.stage not in ("ready", "done"):
            self.part = self.choice.value = "study"
        self._show()

    def leave(self) -> None:
        """Leave the glass: the study waits."""
        self._on = False
        if self.log is not None and self.log.trials is not None:
            self.log.trials.pause()
        worker, self._worker = self._worker, None
        if worker is not None:
            worker.close()

    def back(self) -> bool:
        """Close a form that is open by itself; False where none is."""
        return bool(self.part == "load" and self._views.get("load") and self._views["load"].back())

    def tick(self) -> None:
        """Take in what the worker has done, and bring the part up to date."""
        while self._results:
            then, result = self._results.popleft()
            then(result)
        if self.part == "study" and self._study_stage() != self._stage:
            self._show()
        self._give_room()
        if self.view is not None and hasattr(self.view, "tick"):
            self.view.tick()

    def _give_room(self) -> None:
        """While prompts are shown nothing else can be chosen; what has changed its face is read from its upper end."""
        alone = self.part == "study" and self.log.trials is not None and self.log.trials.running
        if alone == (self.choice.parent is self):
            if alone:
                self.remove_widget(self.choice)
            else:
                self.add_widget(self.choice, index=len(self.children))
        if isinstance(self.view, TrialView):
            self.view.low = self.roll.height < dp(430)
        face = (self.view, getattr(self.view, "form", None), alone)
        if face != self._face and self.view is not None:
            self._face = face
            self._unroll(self.view)

    def ask(self, job: Callable[[], Any], then: Callable[[Any], None]) -> None:
        """Have a job done beside the glass; `then` is told what came of it, or the OSError."""
        if self._worker is not None:
            self._worker.put((job, then))

    def _work(self, item: tuple[Callable[[], Any], Callable[[Any], None]]) -> None:
        job, then = item
        try:
            self._results.append((then, job()))
        except OSError as error:
            self._results.append((then, error))
        except Exception as error:
            log.exception("a job of the study failed")
            self._results.append((then, OSError(str(error) or type(error).__name__)))

    # what is shown

    def _study_stage(self) -> str:
        """Which view the study needs: a form, prompts, or what is asked before it."""
        trials = self.log.trials
        if trials is None:
            return "none"
        return f"{trials.stage}{trials.block}" if trials.stage in ("tlx", "sus") else "led"

    def _show(self, *_: object) -> None:
        if not self._on:
            return
        view = self._study() if self.part == "study" else self._made(self.part)
        if view is not self.view:
            self._unroll(view)
        if hasattr(view, "enter"):
            view.enter()

    def _unroll(self, view: Any) -> None:
        """Show it from its upper end: a fresh roll, for one that was scrolled keeps its place for whatever comes next."""
        self.roll.clear_widgets()
        self.remove_widget(self.roll)
        self.roll = Roll()
        self.roll.add_widget(view)
        self.add_widget(self.roll)

    def _made(self, part: str) -> Any:
        if part not in self._views:
            now, log = self.app.now, self.log
            is_log = part == "log"
            self._views[part] = LogView(log, self.ask, now, sharing()) if is_log else LoadView(log, now)
        return self._views[part]

    def _study(self) -> Any:
        stage = self._study_stage()
        if stage == self._stage and "study" in self._views:
            return self._views["study"]
        self._stage, trials = stage, self.log.trials
        if trials is None:
            view: Any = SetupView(self.app)
            view.bind(on_begin=lambda _, plan: self._lead(plan))
        elif stage == "led":
            view = TrialView(self.app, trials)
            view.bind(on_leave=lambda _: self._leave_study())
        else:
            view = FormView(trials.stage, self.log, self.app.now)
            view.bind(on_done=lambda *_: self._filled())
        self._views["study"] = view
        return view

    def _lead(self, plan: Any) -> None:
        self.log.lead(plan)
        self._show()

    def _filled(self) -> None:
        self.log.trials.filled()
        self._show()

    def _leave_study(self) -> None:
        self.log.end()
        self._show()
