"""The pane of shakes: what was understood, what each direction does, and the lesson."""

from __future__ import annotations

import math
from typing import Any

from kivy.uix.boxlayout import BoxLayout

from app.inputs.motion.shake import AXES, WORDS, Axis
from app.inputs.motion.shake_input import CHOICES, ShakeInput
from app.intents.intents import INTENTS
from app.screens.inputs.parts.meaning_list import MeaningList
from app.screens.inputs.parts.pane_app import PaneApp
from app.screens.inputs.parts.setting_row import switch_row
from widgets.core.language import mark, tr
from widgets.inputs.shake_lesson import ShakeLesson
from widgets.parts.kit import Column, ListRow, PrimaryButton, QuietButton, Roll
from widgets.parts.labels import Remark
from widgets.parts.rows import group_label

__all__ = ["ShakePane"]

HOW = mark(
    "Hold the device and shake it three times to and fro. Left and right is STOP and acts while you shake; "
    "the others act when you have stopped."
)
ACTS = mark("Listening. A shake acts here as anywhere; the result appears here.")
TRY = mark("Shake: the result appears here, and only STOP acts.")
LESSON = mark("Ten seconds: left and right, up and down, forward and back, as you would do it.")
FRESH = 6.0
"""For so long what was understood last is shown as new [s]."""


def _words(intent: str) -> tuple[str, str]:
    return (INTENTS[intent].words, INTENTS[intent].icon) if intent else (tr("Nothing"), "block")


class ShakePane(BoxLayout):
    """A pane of the inputs screen."""

    def __init__(self, app: PaneApp, **kwargs: Any) -> None:
        super().__init__(orientation="vertical", spacing="8dp", **kwargs)
        self._app = app
        self._asked: Axis = "ud"
        self.standing = Remark(font_size="15sp")
        self.rows: dict[Axis, ListRow] = {}
        self.lists: dict[Axis, MeaningList] = {}
        self.roll = Roll()
        column = Column(spacing="6dp")
        self.trial = QuietButton(text=tr("Try it"), icon="mobile_vibrate", size_hint_y=None)
        self.trial.bind(on_release=lambda _: self._try())
        column.add_widget(self.standing)
        column.add_widget(self.trial)
        column.add_widget(Remark(text=tr(HOW), font_size="15sp"))
        column.add_widget(group_label(tr("What it means")))
        for axis in AXES:
            row = self.rows[axis] = ListRow(icon="mobile_vibrate", title=tr(WORDS[axis]), whole=True)
            row.bind(on_release=lambda _, axis=axis: self._ask(axis))
            column.add_widget(row)
        row, self.any_stops = switch_row(
            "front_hand",
            tr("Any strong shake stops"),
            tr("While the robot moves, in any direction."),
            lambda on: setattr(self.shaking, "any_stops", on),
        )
        column.add_widget(row)
        column.add_widget(group_label(tr("The lesson")))
        self.learnt = Remark(font_size="15sp")
        column.add_widget(self.learnt)
        self.teach = PrimaryButton(text=tr("Begin the lesson"), icon="play_arrow", size_hint_y=None)
        self.teach.bind(on_release=lambda _: self._teach())
        self.unlearn = QuietButton(text=tr("Forget the lesson"), icon="replay", size_hint_y=None)
        self.unlearn.bind(on_release=lambda _: self._unlearn())
        column.add_widget(self.teach)
        column.add_widget(self.unlearn)
        self.roll.add_widget(column)
        self.lesson_page = self._lesson_page()
        self.add_widget(self.roll)
        self._write()

    @property
    def shaking(self) -> ShakeInput:
        """The method."""
        method: ShakeInput = self._app.methods.get("shake")
        return method

    def _lesson_page(self) -> BoxLayout:
        page = BoxLayout(orientation="vertical", spacing="8dp")
        self.picture = ShakeLesson()
        self.told = Remark(font_size="17sp")
        self.leave_lesson = QuietButton(text=tr("Leave the lesson"), icon="close", size_hint_y=None)
        self.leave_lesson.bind(on_release=lambda _: self.back())
        for widget in (self.picture, self.told, self.leave_lesson):
            page.add_widget(widget)
        return page

    # what the screen calls

    def enter(self) -> None:
        """Come onto the glass."""
        self._write()
        self.tick()

    def leave(self) -> None:
        """Leave the glass, and a lesson or a try with it."""
        self.back()
        self.shaking.try_out(on=False)

    def back(self) -> bool:
        """From the lesson or a choice back to the list; False where it is there."""
        if self.roll.parent is self:
            return False
        if self.shaking.lesson is not None:
            self.shaking.end_lesson()
        self._page(self.roll)
        self._write()
        return True

    def tick(self) -> None:
        """Show how it stands, and move the lesson's picture."""
        shaking, now = self.shaking, self._app.now()
        if self.lesson_page.parent is self:
            self._follow_lesson(now)
            return
        new = shaking.last is not None and now - shaking.at < FRESH
        self.standing.role = "warn" if shaking.problem else "accent" if new else "muted"
        self._write_lesson()
        self.standing.text = shaking.problem or self._last(new) or self._usual()

    def _last(self, new: bool) -> str:
        shake = self.shaking.last
        if shake is None or not new:
            return ""
        sure = (
            tr(", {percent:.0f} % sure").format(percent=shake.confidence * 100)
            if math.isfinite(shake.confidence)
            else ""
        )
        return tr("{words}, {count} half cycles{sure}. {said}").format(
            words=tr(WORDS[shake.axis]), count=shake.count, sure=sure, said=self.shaking.said
        )

    def _usual(self) -> str:
        if self.shaking.trying:
            return tr(TRY)
        if not self.shaking.on:
            here = "" if self.trial.disabled else tr(", or try it here")
            return tr("Off: nothing is measured. Switch it on in the list of inputs{here}.").format(here=here)
        return tr(ACTS)

    def _follow_lesson(self, now: float) -> None:
        lesson = self.shaking.lesson
        if lesson is None:  # the app was in the background
            self.back()
            return
        self.picture.update(lesson.axis or "", doing=lesson.doing, progress=lesson.progress, beat=now)
        self.told.role = "warn" if self.shaking.problem or lesson.sentence else "muted"
        if lesson.over:
            self.told.text = tr("Done: that is how you shake. It is kept.")
            self.leave_lesson.text, self.leave_lesson.icon = tr("Good"), "check"
        else:
            self.told.text = (
                self.shaking.problem
                or lesson.sentence
                or tr("Three seconds each. It vibrates when one is done.")
            )

    # what fingers change

    def _write(self) -> None:
        shaking = self.shaking
        self.rows["lr"].detail, self.rows["lr"].role, self.rows["lr"].icon = (
            tr("STOP, always"),
            "danger",
            "front_hand",
        )
        for axis in CHOICES:
            self.rows[axis].detail, self.rows[axis].icon = _words(shaking.meaning[axis])
        self.any_stops.active = shaking.any_stops
        self._write_lesson()
        self.teach.text = tr("Do the lesson again") if shaking.own else tr("Begin the lesson")
        self.unlearn.disabled = not shaking.own

    def _write_lesson(self) -> None:
        """No lesson begins that could not be heard: its place says why."""
        sensing, shaking = self._app.sensing, self.shaking
        self.teach.disabled = self.trial.disabled = not sensing.has("acceleration")
        self.trial.text = tr("End the try") if shaking.trying else tr("Try it")
        self.trial.icon = "close" if shaking.trying else "mobile_vibrate"
        if self.teach.disabled:
            self.learnt.text, self.learnt.role = str(sensing.health("acceleration").sentence), "warn"
        else:
            self.learnt.text = tr("It goes by how you shake.") if shaking.own else tr(LESSON)
            self.learnt.role = "muted"

    def _ask(self, axis: Axis) -> None:
        if axis not in CHOICES:
            return
        self._asked = axis
        if axis not in self.lists:
            choices = self.lists[axis] = MeaningList({name: _words(name) for name in CHOICES[axis]})
            choices.bind(on_choose=lambda _, name: self._chosen(name), on_close=lambda _: self.back())
        self.lists[axis].ask(tr(WORDS[axis]), tr("Choose a command"), self.shaking.meaning[axis])
        self._page(self.lists[axis])

    def _chosen(self, name: str) -> None:
        self.shaking.mean(self._asked, name)
        self.back()

    def _try(self) -> None:
        self.shaking.try_out(on=not self.shaking.trying)
        self.tick()

    def _teach(self) -> None:
        if self.teach.disabled:
            return
        self.shaking.teach()
        self.leave_lesson.text, self.leave_lesson.icon = tr("Leave the lesson"), "close"
        self._page(self.lesson_page)
        self.tick()

    def _unlearn(self) -> None:
        self.shaking.unlearn()
        self._write()

    def _page(self, page: Any) -> None:
        self.clear_widgets()
        self.add_widget(page)
