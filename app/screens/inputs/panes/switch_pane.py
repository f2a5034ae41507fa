"""The pane of switches: one or two, their keys, how they move the mark, and a test that finds the pace."""

from __future__ import annotations

import random
from functools import partial
from typing import Any

from kivy.clock import Clock
from kivy.uix.boxlayout import BoxLayout

from app.inputs.switch_access.scan.presses import Event
from app.inputs.switch_access.scan.reaction import Reaction
from app.inputs.switch_access.scan.settings import DEFAULTS, MAX_KEYS, RANGES, Key, Options
from app.inputs.switch_access.switches import SwitchAccess
from app.screens.inputs.parts.pane_app import PaneApp
from app.screens.inputs.parts.setting_row import number_row, switch_row
from widgets.core.language import figure, mark, tr
from widgets.inputs.reaction_test import ReactionTest
from widgets.parts.kit import Column, IconButton, ListRow, PrimaryButton, QuietButton, Remark, Roll, Segmented
from widgets.parts.rows import group_label

__all__ = ["SwitchPane"]

NUMBERS: dict[str, tuple[str, str, str, float, str]] = {
    "interval": (
        "timer",
        mark("Each step stays"),
        mark("The test below finds what fits the hand."),
        0.1,
        "s",
    ),
    "first": (
        "hourglass_empty",
        mark("The first one longer by"),
        mark("Time to find the mark again."),
        0.1,
        "s",
    ),
    "loops": ("repeat", mark("Rounds, then rest"), mark("Asleep, the next press wakes it."), 1, ""),
    "ignore_repeat": (
        "block",
        mark("Repeats ignored for"),
        mark("A second press of a hand that trembles."),
        0.05,
        "s",
    ),
    "acceptance": (
        "touch_app",
        mark("A press counts after"),
        mark("For a hand that brushes over switches."),
        0.05,
        "s",
    ),
    "debounce": (
        "bolt",
        mark("A contact bounces for"),
        mark("A switch is let go when it is open for longer."),
        0.01,
        "s",
    ),
}
"""Figure to its icon, title, what it is for, step and unit."""
BY_ITSELF = ("interval", "first", "loops")
"""Those of a mark that moves by itself."""
FELT: dict[str, tuple[str, str, str]] = {
    "tones": ("volume_up", mark("Each step is heard"), mark("A short tone; another one for a press.")),
    "vibrates": ("mobile_vibrate", mark("Each step is felt"), mark("On a handheld that vibrates.")),
    "spoken": ("text_fields", mark("The mark is spoken"), mark("By the voice chosen in Voice.")),
}
KEYS = {
    "a": ("skip_next", mark("Next")),
    "b": ("check_circle_fill", mark("Do it")),
}
ASKED = mark("Press the key, the switch or the button now.")
STOPS = mark("Escape and the button B of a gamepad stay STOP, and cannot be switches.")


class SwitchPane(BoxLayout):
    """A pane of the inputs screen."""

    def __init__(self, app: PaneApp, **kwargs: Any) -> None:
        super().__init__(orientation="vertical", spacing="8dp", **kwargs)
        self._app = app
        self.switches: SwitchAccess = app.methods.get("switches")
        """The method that is set up here."""
        self.test = Reaction(random.Random())
        self._clock = Clock.create_trigger(lambda _: self._watch(), 0, interval=True)
        self._asked = ""
        """The switch that a key is being chosen for: `a`, `b` or empty."""
        self._refused = ""
        self.numbers: dict[str, Any] = {}
        self.rows: dict[str, ListRow] = {}
        self.toggles: dict[str, Any] = {}
        self._column = Column(spacing="6dp")
        self._parts: list[tuple[Any, bool | None]] = []
        """Each part with whether it is only for one switch, or only for two; None for both."""
        self._build()
        roll = Roll()
        roll.add_widget(self._column)
        self.add_widget(roll)

    def _build(self) -> None:
        self.kind = Segmented(
            options=[("two", tr("Two switches")), ("one", tr("One switch"))], size_hint_y=None, height="48dp"
        )
        self.kind.bind(on_choose=lambda _, value: self._set(one=value == "one"))
        self.remark = Remark(font_size="14sp")
        self._put(self.kind)
        self._put(self.remark)
        for name in KEYS:
            self._put(self._key_row(name), False if name == "a" else None)
        for name in BY_ITSELF:
            self._put(self._number(name), True)
        self._put(group_label(tr("How fast is the hand?")), True)
        self.picture = ReactionTest(total=self.test.of)
        self._put(self.picture, True)
        self.begin = PrimaryButton(text=tr("Begin the test"), icon="play_arrow", size_hint_y=None)
        self.begin.bind(on_release=lambda _: self._begin_or_take())
        self._put(self.begin, True)
        self._put(group_label(tr("Press timing")))
        for name in NUMBERS:
            if name not in BY_ITSELF:
                self._put(self._number(name))
        self._put(group_label(tr("Feedback")))
        for name, (icon, title, detail) in FELT.items():
            row, self.toggles[name] = switch_row(icon, tr(title), tr(detail), partial(self._switch, name))
            self._put(row)
        self.reset = QuietButton(text=tr("As it was at first"), icon="replay", size_hint_y=None)
        self.reset.bind(on_release=lambda _: self._put_back())
        self._put(self.reset)

    def _put(self, widget: Any, one: bool | None = None) -> None:
        self._parts.append((widget, one))

    def _key_row(self, name: str) -> ListRow:
        icon, title = KEYS[name]
        row = self.rows[name] = ListRow(icon=icon, title=tr(title), whole=True)
        row.bind(on_release=lambda _: self._ask(name))
        less = IconButton(icon="delete", bare=True, role="muted", pos_hint={"center_y": 0.5})
        less.bind(on_release=lambda _: self._clear(name))
        row.add_widget(less)
        return row

    def _number(self, name: str) -> ListRow:
        icon, title, detail, step, unit = NUMBERS[name]
        low, high = RANGES[name]
        row, self.numbers[name] = number_row(
            icon,
            tr(title),
            tr(detail),
            lambda value: self._set(**{name: round(value, 3)}),
            minimum=low,
            maximum=high,
            step=step,
            unit=unit,
        )
        return row

    # what a finger asks for

    def _switch(self, name: str, on: bool) -> None:
        self._set(**{name: on})

    def _set(self, **values: Any) -> None:
        self.switches.change(**values)
        self.tick()

    def _put_back(self) -> None:
        kept = DEFAULTS.save() | {"on": self.switches.on, "one": self.switches.options.one}
        del kept["a"], kept["b"]
        self._set(**kept, a=DEFAULTS.a, b=DEFAULTS.b)

    def _ask(self, name: str) -> None:
        self._asked, self._refused = ("", "") if self._asked == name else (name, "")
        self.switches.ask(self._take if self._asked else None)
        self.tick()

    def _take(self, key: Key) -> None:
        name, self._asked = self._asked, ""
        if not name:
            return
        options = self.switches.options
        mine = [*(one for one in getattr(options, name) if one != key), key]
        other = "b" if name == "a" else "a"
        rest = tuple(one for one in getattr(options, other) if one != key)
        if len(mine) > MAX_KEYS:
            self._refused = tr("A switch has at most {max_keys} keys: take some away first.").format(
                max_keys=MAX_KEYS
            )
        else:
            self._set(**{name: tuple(mine), other: rest})
        self.tick()

    def _clear(self, name: str) -> None:
        """Take the key away that came last."""
        self._set(**{name: getattr(self.switches.options, name)[:-1]})

    # the test

    def _begin_or_take(self) -> None:
        if self.test.phase == "done":
            self._set(interval=self.test.interval)
            self._end()
        elif self.test.phase == "idle":
            self.switches.engine.first = self._hear
            self.test.start(self._app.now())
            self._clock()
        else:
            self._end()
        self.tick()

    def _hear(self, event: Event) -> bool:
        """A press of the switch is one of the test; STOP stays STOP."""
        if event.what == "down":
            self.test.press(event.at)
            self._watch()
        return True

    def _watch(self) -> None:
        test = self.test
        test.update(self._app.now())
        self.picture.phase, self.picture.count = test.phase, test.done
        if test.phase == "done":
            self.picture.result = tr(
                "You press within {mean} s: the mark should stay for {interval} s."
            ).format(mean=figure(test.mean, 2), interval=figure(test.interval, 1))
            self._deafen()
            self.tick()

    def _deafen(self) -> None:
        self._clock.cancel()
        if self.switches.engine.first == self._hear:
            self.switches.engine.first = lambda _: False

    def _end(self) -> None:
        if self.test.phase != "idle":
            self.test.quit()
            self._deafen()
            self.picture.phase, self.picture.count = "idle", 0

    # what the screen calls

    def enter(self) -> None:
        """Come onto the glass."""
        self.tick()

    def leave(self) -> None:
        """Leave it: nothing is asked for or tested any more."""
        self.back()

    def back(self) -> bool:
        """End what goes on here; False where nothing does."""
        busy = bool(self._asked) or self.test.phase != "idle"
        if self._asked:
            self._asked = ""
            self.switches.ask(None)
        self._end()
        return busy

    def tick(self) -> None:
        """Bring up to date how it is set."""
        options = self.switches.options
        self.kind.value = "one" if options.one else "two"
        self.remark.text = self.switches.problem or self._explained(options)
        self.remark.role = "warn" if self.switches.problem else "muted"
        for name, stepper in self.numbers.items():
            stepper.value = getattr(options, name)
        for name, toggle in self.toggles.items():
            toggle.active = getattr(options, name)
        for name, row in self.rows.items():
            self._write_keys(name, row, options)
        self._write_begin()
        wanted = [widget for widget, one in self._parts if one in (None, options.one)]
        if list(reversed(self._column.children)) != wanted:
            self._column.clear_widgets()
            for widget in wanted:
                self._column.add_widget(widget)

    def _write_keys(self, name: str, row: ListRow, options: Options) -> None:
        keys = getattr(options, name) if name == "b" or not options.one else ()
        listed = ", ".join(key.words for key in keys) or tr("No key yet")
        asked = self._asked == name
        row.chosen, row.role = asked, "accent" if keys else "warn"
        said = self._refused or f"{listed}. {_held(name, options)}"
        row.detail = f"{tr(ASKED)} {tr(STOPS)}" if asked else said

    def _write_begin(self) -> None:
        phase = self.test.phase
        done = phase == "done"
        self.begin.text = (
            tr("Take {interval} s").format(interval=figure(self.test.interval, 1))
            if done
            else tr("Begin the test")
            if phase == "idle"
            else tr("End the test")
        )
        self.begin.icon = "check" if done else "play_arrow" if phase == "idle" else "close"
        self.begin.disabled = not self.switches.on

    @staticmethod
    def _explained(options: Options) -> str:
        if options.one:
            moves = tr("The mark moves by itself; the switch presses the target.")
            return f"{moves} {_held('b', options)}"
        return tr(
            "The first switch moves the mark, the second presses the target on release. The first press only wakes it."
        )


def _held(name: str, options: Options) -> str:
    """What comes of holding the switch `a` or `b`."""
    if name == "a":
        return tr("Held {hold_back} s: back, or out of the group.").format(
            hold_back=figure(options.timing.hold_back, 1)
        )
    both = "" if options.one else tr(", or both together")
    return tr("Held {hold_stop} s{both}: STOP.").format(
        hold_stop=figure(options.timing.hold_stop, 1), both=both
    )
