"""Problems of the methods that are on, said over the screen that is shown: who relies on one must not have to look for it."""

from __future__ import annotations

from typing import Any

from app.inputs.base.method_app import MethodApp

__all__ = ["MethodProblems"]

CHECK_PERIOD = 0.2
"""So often they are asked [s]."""
CALM_TIME = 2.0
"""A problem that was away for less is still the same one [s]: a sensor may be just too slow by turns."""
MESSAGE_TIME = 10.0
"""How long the sentence stands [s], unless the problem ends before."""
MESSAGE_TOPIC = "methods"


class MethodProblems:
    """Says each once when it begins, and takes it away when it has ended. Everything in the UI thread."""

    def __init__(self, app: MethodApp) -> None:
        """`app` is asked for its `shell`, its `connect` and its `methods`."""
        self._app = app
        self._shell: Any = None
        self._seen: dict[str, float] = {}
        """Name of each method that has one, and when it was seen last [s]."""
        self._shown: frozenset[str] = frozenset()
        """Of which of them the sentence tells."""
        self._text = ""
        self._next = 0.0

    def update(self, now: float) -> None:
        """With each heartbeat."""
        if now < self._next:
            return
        self._next = now + CHECK_PERIOD
        if self._app.shell is not self._shell:
            self._shell = self._app.shell
            self._seen.clear()  # on another glass it is news again
        methods = self._app.methods
        wrong = {name: problem for name in methods.armed if (problem := methods.get(name).problem)}
        begun = [name for name in wrong if name not in self._seen]
        self._seen.update(dict.fromkeys(wrong, now))
        self._seen = {name: at for name, at in self._seen.items() if now - at < CALM_TIME}
        if not self._shown <= self._seen.keys():
            self._unsay()
        if begun:
            self._say({name: wrong[name] for name in begun})

    def _say(self, wrong: dict[str, str]) -> None:
        self._shown = frozenset(wrong)
        self._text = " ".join(f"{name.capitalize()}: {problem}" for name, problem in wrong.items())
        if self._shell is not None:
            self._shell.say(self._text, "warn", about=MESSAGE_TOPIC, stay=MESSAGE_TIME)
        else:
            self._app.connect.say(self._text, "warn")

    def _unsay(self) -> None:
        self._shown = frozenset()
        if self._shell is not None:
            self._shell.unsay(MESSAGE_TOPIC)
        else:
            self._app.connect.unsay(self._text)
