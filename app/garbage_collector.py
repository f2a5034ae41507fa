"""Collects Python's cyclic garbage between frames, and never in the middle of one.

A kv rule knows its widget by a weak reference. A row or a dialog that was thrown away is mostly a cycle: it stays bound
to what outlives it, the theme or the session, until Python's collector comes, and that comes whenever something is made,
in any thread. When it comes while such a widget's own rule is computed, the widget is gone in the middle of the
expression, and the ReferenceError ends the app. So the app collects by itself, from its clock.
"""

from __future__ import annotations

import gc
import sys
import weakref

__all__ = ["Collector", "spare_the_start"]

START_OBJECTS = 50_000
"""Objects made between two looks of Python's own collector while the app starts: next to nothing of them goes again."""

YOUNG = 700
"""Objects made since the last look that are worth one at the young ones: 0.1 ms, every five seconds while live."""
OLD = 100_000
"""Blocks of memory by which Python has grown that are worth a look at everything.

A robot's screens are 230 000, so there is one when they were made; while live it grows by 3 000 in 20 s. On a desktop
with software GL a look takes 12 to 18 ms then, for 125 000 objects, and 26 to 38 ms when the screens were left and
73 000 of them go; several times that while others keep the processor busy. The 56 000 objects that were there from the
start are left out of it, else it would be 34 and 51 ms.
"""
GROWTH = 3_000
"""Blocks by which it has grown since the last step where something is being made: a look at everything waits until it is there."""
MAX_PUSHED = 500_000
"""Blocks by which Python may grow while a finger is down or something is made: some 40 MB; by then one pause is the lesser evil."""
RECHECK_OBJECTS = 10_000
"""Objects found in a look at everything that are worth another one with the next."""
MAX_RECHECKS = 7
"""How often what was expected to go, and is still held, is waited for: twice as long each time, 4 s in all.

Its last frame, an animation, a touch or an answer on its way may hold a screen for a while after it was left.
"""


def spare_the_start() -> None:
    """Have Python's own collector look seldom, from the first import on, until a `Collector` takes it over."""
    gc.set_threshold(START_OBJECTS, 10, 10)


class Collector:
    """Takes Python's collector over from the moment it is made until it is closed.

    It holds for the whole process, other threads included; what those leave behind goes with the next frame. What is
    there from the start stays for good and is never looked at. One may be made while another is at work, as by an app that
    is tested: then what was there before the first one stays, until the last one is closed.
    """

    _at_work = 0

    def __init__(self) -> None:
        self._was_enabled = gc.isenabled()
        self._due = False
        self._left: weakref.ref[object] | None = None
        self._looks = self._wait = 0
        self._blocks = self._last = sys.getallocatedblocks()
        Collector._at_work += 1
        if Collector._at_work == 1:
            gc.freeze()
        self.resume()

    def close(self) -> None:
        """Give everything back as it was."""
        Collector._at_work -= 1
        if not Collector._at_work:
            gc.unfreeze()
        self.pause()

    def pause(self) -> None:
        """Let Python collect when it likes: no frame comes until `resume`, and other threads go on."""
        if self._was_enabled:
            gc.enable()

    def resume(self) -> None:
        """From now on only `look` collects."""
        gc.disable()

    def keep(self) -> None:
        """What there is now stays for good too, unless something that was left is still to go."""
        if self._left is None and not self._due:
            gc.freeze()

    def expect(self, left: object) -> None:
        """Much was thrown away with `left`, as when a screen is left: look at everything until it is gone."""
        self._due, self._left = True, weakref.ref(left)
        self._looks = self._wait = 0

    def step(self, *, pushed: bool = False) -> None:
        """Collect if there may be enough; to be called between frames, from the clock and from no binding.

        While something is `pushed`, by a finger or otherwise, it waits: a hand that steers must not feel it.
        """
        blocks = sys.getallocatedblocks()  # 0.01 to 0.05 ms
        grown, made, self._last = blocks - self._blocks, blocks - self._last, blocks
        if pushed and grown < MAX_PUSHED:
            return
        if self._due or self._again() or (grown >= OLD and (made < GROWTH or grown >= MAX_PUSHED)):
            # a screen comes apart in two goes: the first lets go of the second
            self._due = gc.collect() >= RECHECK_OBJECTS
            self._blocks = sys.getallocatedblocks()
            return
        self._blocks = min(self._blocks, blocks)
        if gc.get_count()[0] >= YOUNG:
            gc.collect(0)

    def _again(self) -> bool:
        """What was expected to go is still there, and it is time for another look."""
        if self._left is None:
            return False
        if self._left() is None or self._wait == MAX_RECHECKS:
            self._left = None
            return False
        self._looks += 1
        if self._looks < 2**self._wait:
            return False
        self._looks, self._wait = 0, self._wait + 1
        return True
