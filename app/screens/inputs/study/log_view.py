"""Charts of the response log: success, response times, false activations; and export and erasure."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, Literal

from kivy.properties import StringProperty
from kivy.uix.boxlayout import BoxLayout

from app.device.sharing import Sharing
from app.intents.intents import INTENTS, METHODS
from app.screens.inputs.parts.setting_row import switch_row
from app.screens.inputs.study.zip_row import SURE, ZipRow
from app.screens.parts.method_signs import METHOD_SIGNS
from app.study.response_log import Response
from app.study.response_statistics import (
    PAPER,
    false_activations,
    presses,
    rates,
    times,
    used_well,
    wrong,
)
from widgets.parts.kit import Column, QuietButton, Remark, Segmented, Toggle
from widgets.study.response_chart import ResponseChart
from widgets.study.success_bars import SuccessBars

__all__ = ["LogView", "facts", "look_of"]

LOOKS = {"button": ("touch_app", "Buttons"), "map": ("map", "Map")}
UNTIL = [("sent", "Until sent"), ("ack", "Until answered"), ("effect", "Until done")]
READING = "Reading …"
READ_PERIOD = 2.0
"""What comes while it is looked at is read no more often [s]."""


def look_of(method: str) -> tuple[str, str]:
    """Icon and name of a method."""
    return LOOKS.get(method) or METHOD_SIGNS[method]


def _words(intent: str) -> str:
    return INTENTS[intent].words if intent in INTENTS else intent.replace("_", " ").capitalize()


def _order(method: str) -> int:
    return METHODS.index(method) if method in METHODS else len(METHODS)


def facts(responses: Iterable[Response]) -> str:
    """The figures that have no bar of their own, as sentences; empty where there are none."""
    kept, said = list(responses), []
    for method, falses in false_activations(kept).items():
        if method in METHODS and math.isfinite(falses.hourly):
            name = look_of(method)[1]
            said.append(f"{name}: {falses.hourly:.1f} false activations an hour, in {falses.hours:.1f} h.")
    for method, rate in wrong(kept).items():
        if method in METHODS:
            said.append(f"{look_of(method)[1]}: {rate.share * 100:.0f} % understood as another command.")
    pressed = presses(kept)
    if math.isfinite(pressed):
        said.append(f"Switches: {pressed:.1f} presses for a selection.")
    return "\n".join(said)


class LogView(Column):
    """The charts, over switches and buttons."""

    source = StringProperty("use")
    """`use` or `study`."""
    until = StringProperty("sent")
    """To what response times go, as of `response_statistics.seconds`."""

    def __init__(
        self,
        log: Any,
        ask: Callable[..., None],
        now: Callable[[], float],
        sharing: Sharing | None = None,
        **kwargs: Any,
    ) -> None:
        """`log` is the app's `ResponseRecording`; `ask(job, then)` has a job done elsewhere and its result told.

        `sharing` hands a zip to another app; None where its folder can be looked into.
        """
        super().__init__(spacing="10dp", **kwargs)
        self._sharing = sharing
        self._log, self._ask, self._now = log, ask, now
        self._responses: list[Response] = []
        self._sure, self._problem = -math.inf, ""
        self._busy: Literal["", "read", "file"] = ""
        """What is asked for elsewhere, of which only the newest is done: nothing takes the place of work on files."""
        self._known, self._since = -1, -math.inf
        """Lines of this run that were kept when it was read last, and when that was asked for [s]."""
        self.choice = Segmented(options=[("use", "In use"), ("study", "In the study")], value=self.source)
        self.choice.bind(on_choose=lambda _, value: setattr(self, "source", value))
        self.success = SuccessBars(state="live")
        self.ends = Segmented(options=UNTIL, value=self.until)
        self.ends.bind(on_choose=lambda _, value: setattr(self, "until", value))
        self.chart = ResponseChart(state="live")
        self.facts, self.said = Remark(font_size="15sp"), Remark(role="text", font_size="15sp")
        self._nothing = [(chart, chart.nothing) for chart in (self.success, self.chart)]
        for chart, _ in self._nothing:
            chart.nothing = READING
        self._fill()
        self.bind(source=self._show, until=self._show)

    def _fill(self) -> None:
        for widget in (self.choice, self.success, self.ends, self.chart, self.facts):
            self.add_widget(widget)
        self.keeps = self._switch(
            "save", "Keep a log", "On this handheld only; 8 MB, then the oldest goes.", self._log.turn
        )
        self.agrees = self._switch(
            "sensors",
            "Keep raw measurements, too",
            "The movement of a shake, the sound of a word. Only if the person agrees.",
            lambda on: setattr(self._log, "snippets", on),
        )
        self.export = QuietButton(text="Export a zip", icon="download")
        self.export.bind(on_release=lambda _: self._export())
        self.erase = QuietButton(text="Erase all", icon="delete")
        self.erase.bind(on_release=lambda _: self._erase())
        row = BoxLayout(size_hint_y=None, spacing="10dp")
        self.export.bind(height=row.setter("height"))
        row.height = self.export.height
        row.add_widget(self.export)
        row.add_widget(self.erase)
        self.add_widget(row)
        self.zips = ZipRow(self._now, None if self._sharing is None else self._sharing.where)
        self.zips.bind(on_share=lambda _: self._share(), on_delete=lambda _: self._discard())
        self.add_widget(self.zips)
        self.add_widget(self.said)

    def _switch(self, icon: str, title: str, detail: str, turn: Callable[[bool], object]) -> Toggle:
        row, switch = switch_row(icon, title, detail, turn)
        self.add_widget(row)
        return switch

    def enter(self) -> None:
        """Come onto the glass: what is kept is read."""
        self._busy = ""
        self._ask_for_lines()
        self.zips.show(self._log.archive.zips())
        self.tick()

    def _ask_for_lines(self) -> None:
        self._busy, self._known, self._since = "read", self._log.lines, self._now()
        self._ask(self._log.archive.read, self._read)

    def leave(self) -> None:
        """Leave the glass."""

    def tick(self) -> None:
        """Bring the switches up to date, and what has come since it was read."""
        if not self._busy and self._log.lines != self._known and self._now() - self._since >= READ_PERIOD:
            self._ask_for_lines()
        self.zips.tick()
        self.keeps.active, self.agrees.active = self._log.on, self._log.snippets
        sure = self._now() - self._sure < SURE
        self.erase.text = "Press again: erase" if sure else "Erase all"
        problem, before = self._log.problem, self._problem
        if problem and problem != before:  # once: it would hide what is said of an export
            self.said.text, self.said.role = problem, "warn"
        self._problem = problem

    def _read(self, result: Any) -> None:
        self._busy = ""
        for chart, nothing in self._nothing:
            chart.nothing = nothing
        if isinstance(result, list):
            self._responses = result
            self._show()
        else:
            self.said.text, self.said.role = (
                f"The log could not be read: {result.strerror or result}.",
                "warn",
            )

    def _show(self, *_: object) -> None:
        study = self.source == "study"
        shown = [
            one for one in self._responses if bool(one.user) == study or one.kind in ("armed", "selection")
        ]
        found = rates(shown) if study else used_well(shown)
        self.success.title = "Understood as prompted" if study else "Done and not taken back"
        self.success.rates = [
            (
                *look_of(method),
                rate.hits,
                rate.trials,
                *rate.interval,
                PAPER.get(method, math.nan) if study else math.nan,
            )
            for (method, _), rate in sorted(found.items(), key=lambda item: _order(item[0][0]))
            if method in METHODS
        ]
        order = {name: number for number, name in enumerate(INTENTS)}
        spreads = sorted(
            times(shown, self.until).items(),
            key=lambda item: (order.get(item[0][0], 99), item[0][0], _order(item[0][1])),
        )
        self.chart.times = [
            (_words(intent), *look_of(method), one.median, one.low, one.high, one.count)
            for (intent, method), one in spreads
            if method in METHODS
        ]
        self.facts.text = facts(shown)

    def _work(self, said: str, job: Callable[[], Any], done: Callable[[Any], str], failed: str) -> None:
        """Have it done, unless something of the kind is; `done` says what came of it, `failed` begins what did not."""
        if self._busy == "file":
            return
        if self._busy == "read":
            self._known = -1  # what was to be read is so afterwards
        self._busy = "file"
        self.said.text, self.said.role = said, "muted"

        def then(result: Any) -> None:
            self._busy = ""
            if isinstance(result, OSError):
                why = str(result.strerror or result).rstrip(".")
                self.said.text, self.said.role = f"{failed}: {why}.", "warn"
            else:
                self.said.text, self.said.role = done(result), "ok"
            self.zips.show(self._log.archive.zips())

        self._ask(job, then)

    def _export(self) -> None:
        self._work("Writing …", self._log.export, self._exported, "It could not be written")

    def _exported(self, path: Path) -> str:
        return f"Written: {path if self._sharing is None else path.name}"

    def _share(self) -> None:
        sharing, zips = self._sharing, self._log.archive.zips()
        if sharing is not None and zips:
            said = f"{zips[-1].name}: its copy is in {sharing.where}."
            self._work("Copying …", lambda: sharing.share(zips[-1]), lambda _: said, "It is not shared")

    def _discard(self) -> None:
        def job() -> str:
            if self._sharing is not None:
                self._sharing.forget()
            return str(self._log.archive.discard())

        self._work("Deleting …", job, str, "They are not deleted")

    def _erase(self) -> None:
        """The first press asks, the second one erases."""
        if self._now() - self._sure >= SURE:
            self._sure = self._now()
        elif self._busy != "file":
            self._sure = -math.inf
            self._log.forget()
            self._work("Erasing …", self._log.archive.erase, self._erased, "It is not erased")
        self.tick()

    def _erased(self, said: str) -> str:
        self._responses = []
        self._show()
        return said
