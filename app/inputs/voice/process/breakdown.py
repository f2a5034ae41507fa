"""When a recogniser has broken down: it crashed, or it hangs and gives no sign of life. What is said then, and whether it is started again.

signs = Signs(now); signs.beat(now)     # with each beat, whether or not something came
signs.heard(now)                        # with each line that came
if signs.hangs: …
"""

from __future__ import annotations

import math

from widgets.core.language import mark, tr

__all__ = [
    "ASK_TIMEOUT",
    "CHECK_PERIOD",
    "LOAD_TIMEOUT",
    "HANG_TIMEOUT",
    "LOADING_HANG_TIMEOUT",
    "RESTART_WINDOW",
    "Breakdowns",
    "LifeSigns",
    "reason",
]

CHECK_PERIOD = 1.0
"""Signs are looked for so often [s]."""
ASK_TIMEOUT = 2.0
"""Whoever gave none for so long is asked whether it is there [s]; while it listens its level comes ten times a second."""
HANG_TIMEOUT = 12.0
"""One that gives none for so long hangs [s]: a machine that swaps, or a Bluetooth microphone that opens, takes up to 10 s."""
LOADING_HANG_TIMEOUT = 30.0
"""While it loads [s]: from a slow card the interpreter and its libraries alone take ten or more, and can answer nothing then."""
LOAD_TIMEOUT = 180.0
"""One that answers but is not ready after so long hangs in its load [s]."""
RESTART_WINDOW = 600.0
"""It is started again once within so long [s]."""
MAX_REASON = 120
"""The reason has at most so many characters."""


class LifeSigns:
    """Of one process. Times are `time.monotonic()` [s].

    A beat counts for no more than two: where the whole machine stood still, nobody else can be blamed."""

    def __init__(self, now: float) -> None:
        """It is started now."""
        self._at, self._loads, self.silent = now, 0.0, 0.0
        self.loading = True
        """It is not ready yet."""
        self._asked = False

    def heard(self, now: float) -> None:
        """It gave a sign."""
        self.beat(now)
        self.silent, self._asked = 0.0, False

    def beat(self, now: float) -> None:
        """Time goes on."""
        passed, self._at = min(max(0.0, now - self._at), 2 * CHECK_PERIOD), now
        self.silent += passed
        self._loads = self._loads + passed if self.loading else 0.0

    @property
    def hangs(self) -> bool:
        """It will give no sign any more."""
        return self._loads >= LOAD_TIMEOUT or self.silent >= (
            LOADING_HANG_TIMEOUT if self.loading else HANG_TIMEOUT
        )

    def asks(self) -> bool:
        """It has to be asked now; once for each silence."""
        asks = self.silent >= ASK_TIMEOUT and not self._asked
        self._asked = self._asked or asks
        return asks

    @property
    def why(self) -> str:
        """What is told as the reason."""
        if self._loads >= LOAD_TIMEOUT:
            return tr("it was not ready after {time:.0f} s").format(time=LOAD_TIMEOUT)
        return tr("it gave no sign for {time:.0f} s").format(time=self.silent)


AGAIN = {
    "crashed": mark("Voice recognition crashed and is started again{because}"),
    "hung": mark("Voice recognition hung and is started again{because}"),
}
TWICE = {
    "crashed": mark(
        "Voice recognition crashed, the second time within {minutes:.0f} min, and is off{because} "
        "Switch it on again, or command by touch."
    ),
    "hung": mark(
        "Voice recognition hung, the second time within {minutes:.0f} min, and is off{because} "
        "Switch it on again, or command by touch."
    ),
}
"""How voice broke down, to what is said of it where it is started again, and where it is off."""


class Breakdowns:
    """Counts them; one that is long ago is forgiven."""

    def __init__(self) -> None:
        """None so far."""
        self._last = -math.inf

    def sentence(self, word: str, why: str, now: float) -> tuple[bool, str]:
        """It `crashed` or `hung` just now [s]: whether it may be started again, and what is said; `why` may be empty."""
        again, self._last = now - self._last >= RESTART_WINDOW, now
        told = AGAIN if again else TWICE
        because = f": {why.rstrip('.')}." if why else "."
        return again, tr(told[word]).format(because=because, minutes=RESTART_WINDOW / 60)


def reason(text: str) -> str:
    """A line of somebody else's as part of a sentence: one line, bounded; empty where there is nothing to read."""
    line = " ".join("".join(one if one.isprintable() else " " for one in text).split())
    return line if len(line) <= MAX_REASON else line[: MAX_REASON - 1] + "…"
