"""Main-thread cost of the widgets: of one message and the frame that shows it, the drawing by OpenGL left out.

Each case runs alone in a window off screen whose calls to OpenGL are swallowed. A message differs from the one before it, so that
each is drawn; the CPU time of the UI thread over 300 of them, less that of as many frames without one, counts, the least of five
runs. Thirty widgets are five of each kind but the laser, each with ten messages a second at 60 frames. The idle screen is the same
thirty with nothing new, as a share of a core at 60 frames a second. Growth is the memory, by `tracemalloc`, that 100 000 further updates leave.

The naive way clears the canvas at each message and makes an instruction for each mark and a label for each text.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from bench.support.child import child
from bench.support.figures import Figure
from bench.support.harness import Context, Sides

NAIVE = "a canvas cleared and filled at every message"
_TAPE = 0.08
FIGURES = (
    Figure("laser", "ms", "laser of 1080 points, one sweep", 0.15, against=NAIVE),
    Figure("compass", "ms", "compass, one message", _TAPE, against=NAIVE),
    Figure("horizon", "ms", "artificial horizon, one message", _TAPE, against=NAIVE),
    Figure("heading_tape", "ms", "heading tape, one message", _TAPE, against=NAIVE),
    Figure("turn_tape", "ms", "turn, bank and pitch, one message", _TAPE, against=NAIVE),
    Figure("plot", "ms", "plot of one field, one message", 0.15, against=NAIVE),
    Figure("thirty", "ms", "thirty live widgets, a frame", 2.0, against=NAIVE),
    Figure("idle", "% of a core", "thirty widgets with nothing new, 60 frames a second", 2.0, against=NAIVE),
    Figure("growth", "kB", "memory that 100 000 updates leave", 100.0),
)
REPEATS = 3


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(lambda: _measured("ours"), lambda: _measured("naive"))


def _measured(way: str) -> Mapping[str, float]:
    with child("bench.support.widget_costs", way) as process:
        found: Mapping[str, float] = process.receive()
    return found
