"""End points of speech: where words begin and end, by loudness over the noise."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.noise import RATE, decibels

__all__ = ["HOP_SAMPLES", "MAX_WORDS", "MIN_LEVEL", "Endpointer", "Segment"]

HOP_SAMPLES = 320
"""Samples that are judged together: 20 ms."""
START_LEVEL = 9.0
"""So far over the noise words begin [dB]."""
END_LEVEL = 5.0
"""So far over it they still go on [dB]."""
MIN_LEVEL = -58.0
"""Below this nobody speaks into this microphone [dB over full scale]."""
MIN_LOUD_HOPS = 3
"""Of the last five hops so many must be loud for words to begin."""
LEAD_TIME = 0.4
"""Taken along of what was before: an `s` is more quiet than the rest of its word [s]."""
PAUSE_TIME = 0.42
"""Words are over after so long a silence: the gap of a `t` or `p` is under 0.15 s, that between two words under 0.3 s [s]."""
MIN_WORDS = 0.12
"""Shorter is a click [s]."""
MAX_WORDS = 4.0
"""Longer is no command: it is cut there, and all until the next silence is the same talk [s]."""
FALLS, RISES = 0.2, 0.006
"""How quickly the noise floor follows what is more quiet and what is louder, of the difference, each hop."""
NOISE_TIME = 4.0
"""What goes on for longer than this without a pause is noise [s]."""
STEADY_TIME, STEADY_SPREAD = 1.2, 4.5
"""What is so long [s] as even as that, from its softer to its louder tenth [dB], is no voice: a motor, a fan, rain."""
TENTH = 0.1


@dataclass(frozen=True, slots=True)
class Segment:
    """Words, with a little silence about them."""

    samples: NDArray[np.float32]
    began: float
    """When the words began [s]."""
    ended: float
    """When the last loud hop ended [s]."""
    whole: bool = True
    """False for talk that was too long to be a command."""


class Endpointer:
    """Fed with samples as they come; tells when words began, keeps them, and gives them when they are over."""

    def __init__(self, pause: float = PAUSE_TIME) -> None:
        """`pause` is the silence after which words are over [s]."""
        self._pause = pause
        self._before: deque[NDArray[np.float32]] = deque(maxlen=int(LEAD_TIME * RATE / HOP_SAMPLES))
        self._loud: deque[bool] = deque(maxlen=5)
        self._rest: NDArray[np.float32] = np.zeros(0, np.float32)
        self._kept: list[NDArray[np.float32]] = []
        self._began = self._last = math.nan
        self._overlong = False
        self._spoken = 0
        self._levels: deque[float] = deque(maxlen=int(STEADY_TIME * RATE / HOP_SAMPLES))
        self.floor = math.nan
        """The noise [dB over full scale]; NaN before anything was heard."""

    @property
    def speaking(self) -> bool:
        """Words have begun and are not over."""
        return bool(self._kept) or self._overlong

    def so_far(self) -> Segment | None:
        """The words that are being said; None where nobody speaks."""
        if not self._kept:
            return None
        return Segment(np.concatenate(self._kept), self._began, self._last)

    def feed(self, samples: NDArray[np.float32], at: float) -> list[Segment]:
        """The next samples, -1 to 1, of which the last one was heard at `at` [s]; gives the words that are over."""
        heard = np.concatenate((self._rest, samples)) if len(self._rest) else samples
        whole = len(heard) // HOP_SAMPLES * HOP_SAMPLES
        found = []
        for start in range(0, whole, HOP_SAMPLES):
            end = at - (len(heard) - start - HOP_SAMPLES) / RATE
            segment = self._hop(heard[start : start + HOP_SAMPLES], end)
            if segment is not None:
                found.append(segment)
        self._rest = heard[whole:]
        return found

    def finish(self) -> Segment | None:
        """The ears close: what was begun is over now; None where nobody spoke."""
        segment = self._over() if self._kept else None
        self._overlong = False
        self._before.clear()
        self._loud.clear()
        self._levels.clear()
        self._rest = np.zeros(0, np.float32)
        return segment

    def _hop(self, hop: NDArray[np.float32], end: float) -> Segment | None:
        level = max(-90.0, decibels(hop))
        over = level - self._learn(level)
        if self._steady() and self.speaking:
            return self._before_noise(end)
        if not self.speaking:
            self._before.append(hop)
            self._loud.append(over > START_LEVEL and level > MIN_LEVEL)
            if sum(self._loud) >= MIN_LOUD_HOPS:
                self._kept, self._spoken = list(self._before), sum(self._loud)
                self._began = end - len(self._loud) * HOP_SAMPLES / RATE
                self._last = end
            return None
        if self._kept:
            self._kept.append(hop)
        if over > END_LEVEL and level > MIN_LEVEL:
            self._last, self._spoken = end, self._spoken + 1
        if end - self._last >= self._pause:
            return self._over()
        if self._kept and end - self._began > MAX_WORDS:
            segment = Segment(np.concatenate(self._kept), self._began, end, whole=False)
            self._kept, self._overlong = [], True
            return segment
        return None

    def _steady(self) -> bool:
        """What is heard now is an even noise, and louder than the floor knew: now it knows."""
        if len(self._levels) < (self._levels.maxlen or 0) or self._levels[-1] < self.floor + END_LEVEL:
            return False
        levels = np.array(self._levels)
        soft, middle, loud = np.quantile(levels, (TENTH, 0.5, 1 - TENTH))
        if max(loud, float(levels[-MIN_LOUD_HOPS:].mean())) - soft > STEADY_SPREAD:
            return False
        self.floor = float(middle)
        return True

    def _before_noise(self, end: float) -> Segment | None:
        """What was said before the even noise that is heard until `end` [s]; nobody speaks now."""
        kept, self._kept, self._overlong = self._kept, [], False
        self._before.clear()
        self._loud.clear()
        noise = STEADY_TIME * (1 - TENTH)
        words = np.concatenate(kept)[: -int(noise * RATE)] if kept else np.zeros(0, np.float32)
        if len(words) / RATE < LEAD_TIME + 2 * MIN_WORDS:
            return None
        return Segment(words, self._began, end - noise)

    def _over(self) -> Segment | None:
        kept, self._kept, self._overlong = self._kept, [], False
        self._before.clear()
        self._loud.clear()
        if not kept or self._spoken * HOP_SAMPLES / RATE < MIN_WORDS:
            return None
        return Segment(np.concatenate(kept), self._began, self._last)

    def _learn(self, level: float) -> float:
        """The floor follows quickly down and slowly up; what goes on for seconds is noise, however loud."""
        self._levels.append(level)
        if math.isnan(self.floor):
            self.floor = min(level, -40.0)
        lasting = self._overlong and self._spoken * HOP_SAMPLES / RATE > NOISE_TIME
        rate = FALLS if level < self.floor else RISES * (8 if lasting else 1)
        if level < self.floor or not self._kept:
            self.floor += rate * (level - self.floor)
        return self.floor
