"""Messages to the operator about gamepads: plugged, unplugged, silent."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from app.inputs.base.method_app import MethodApp
from app.inputs.bindings import Bindings
from app.inputs.gamepad.gamepad import Gamepads, PadEvent
from app.inputs.gamepad.pad_map import button_words
from widgets.core.language import tr

__all__ = ["PadNews"]


class PadNews:
    """Says it over the screen on the glass; nothing where there is none."""

    def __init__(self, app: MethodApp, gamepads: Callable[[], Gamepads]) -> None:
        """`app` is asked for its `shell` and its `settings`, `gamepads` for the sticks that drive."""
        self._app, self._gamepads = app, gamepads
        self._offered: set[str] = set()
        """Gamepads whose silence was told before."""

    def notify(self, news: PadEvent) -> None:
        """Say one piece of news."""
        shell = self._app.shell
        if shell is None:
            return
        if news.what == "plugged":
            hands = (
                tr("both its sticks drive")
                if len(self._gamepads().sticks) > 1
                else tr("its left stick drives")
            )
            stop = button_words(self._gamepads().profile(news.name).stops[0]).partition(",")[0]
            words = tr("{name}: {hands}, {button} is STOP.")
            shell.say(words.format(name=news.name, hands=hands, button=stop), "info", about="gamepad")
        elif news.what == "unplugged":
            shell.say(tr("{name} is unplugged.").format(name=news.name), "info", about="gamepad")
        elif news.what == "unplugged driving":
            shell.say(
                tr("{name} is unplugged: the robot rests.").format(name=news.name), "warn", about="gamepad"
            )
        else:
            self._tell_silence(shell, news.name)

    def problems(self, mapped: Bindings) -> list[str]:
        """What is wrong in the settings, each told once, as soon as there is somewhere to say it."""
        found, mapped.problems = (
            (mapped.problems, []) if self._app.shell is not None else ([], mapped.problems)
        )
        return found

    def _tell_silence(self, shell: Any, name: str) -> None:
        """With a way out the first time: what hangs on a cable and is held still tells nothing either."""
        shell.unsay("gamepad")
        if name in self._offered:
            shell.say(tr("The gamepad is silent: the robot rests."), "warn", about="gamepad")
        else:
            self._offered.add(name)
            text = tr("The gamepad is silent: the robot rests. Is it wired?")
            shell.notices.offer(text, tr("Wired"), lambda: self._trust(name), icon="cable")

    def _trust(self, name: str) -> None:
        """The operator says that it hangs on a cable: it may be held still from now on."""
        wired = [*self._gamepads().wired, name]
        self._app.settings.set("wired_gamepads", wired)
        self._gamepads().wired = wired
